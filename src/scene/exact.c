/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene/exact.h"

#include <math.h>
#include <string.h>

#include "core/expansion.h"
#include "core/outward.h"

/*
 * Relative to the same sum with every term's magnitude: a difference, a product, their difference and the sum of two
 * normals cost at most 6 roundings a factor, the product of both and the sum of three 4 more: 16 x 2^-53. In pairs each
 * operation is good to 2^-102.
 */
#define ROUNDED DP_ROUNDINGS_30
#define PAIRED  0x1p-96

static bool same(const double p[3], const double q[3]) {
    return p[0] == q[0] && p[1] == q[1] && p[2] == q[2];
}

static int sign_of(double x) {
    return (x > 0.0) - (x < 0.0);
}

static int sign_beyond(double x, double size, double relative) {
    return fabs(x) > size * relative ? sign_of(x) : size == 0.0 ? 0 : EXACT_UNSURE;
}

/* ---- In double: a value, and the sum of the magnitudes that bounds its error --------------------------------------
 */

typedef struct bounded {
    double value, size;
} bounded;

static bounded cross_component(exact_triangle t, int k) {
    const int i = (k + 1) % 3;
    const int j = (k + 2) % 3;
    const double l = (t[1][i] - t[0][i]) * (t[2][j] - t[0][j]);
    const double r = (t[1][j] - t[0][j]) * (t[2][i] - t[0][i]);
    return (bounded){l - r, fabs(l) + fabs(r)};
}

/* ---- In pairs of doubles ------------------------------------------------------------------------------------------
 */

static dp_pair pair_cross(exact_triangle t, int k) {
    const int i = (k + 1) % 3;
    const int j = (k + 2) % 3;
    const dp_pair l = dp_pair_product(dp_two_sum(t[1][i], -t[0][i]), dp_two_sum(t[2][j], -t[0][j]));
    const dp_pair r = dp_pair_product(dp_two_sum(t[1][j], -t[0][j]), dp_two_sum(t[2][i], -t[0][i]));
    return dp_pair_sum(l, (dp_pair){-r.hi, -r.lo});
}

/* ---- Expansions: components that do not overlap, in increasing magnitude, without zeros ----------------------------
 */

/* The longest: three products of a sum of two normals' components, 32, and one normal's, 16. */
enum { CROSS = 16, NORMAL = 2 * CROSS, LONGEST = 3 * 2 * NORMAL * CROSS };

typedef struct expansion {
    int count;
    double at[LONGEST];
} expansion;

static void expansion_add(expansion *e, double x) {
    int kept = 0;
    for (int i = 0; i < e->count; i++) {
        const dp_pair s = dp_two_sum(x, e->at[i]);
        x = s.hi;
        if (s.lo != 0.0)
            e->at[kept++] = s.lo;
    }
    if (x != 0.0)
        e->at[kept++] = x;
    e->count = kept;
}

/* e += factor (x_0 + x_1 + ...) */
static void add_scaled(expansion *e, const double *x, int count, double factor) {
    for (int i = 0; i < count; i++) {
        const dp_pair p = dp_two_product(x[i], factor);
        expansion_add(e, p.lo);
        expansion_add(e, p.hi);
    }
}

/* e += sign (x1 - x0) (y1 - y0) */
static void add_product(expansion *e, double x1, double x0, double y1, double y0, double sign) {
    const dp_pair x = dp_two_sum(x1, -x0);
    const dp_pair y = dp_two_sum(y1, -y0);
    const double terms[2] = {x.lo, x.hi};
    add_scaled(e, terms, 2, sign * y.lo);
    add_scaled(e, terms, 2, sign * y.hi);
}

/* e += sign component k of (t1 - t0) x (t2 - t0) */
static void add_cross(expansion *e, exact_triangle t, int k, double sign) {
    const int i = (k + 1) % 3;
    const int j = (k + 2) % 3;
    add_product(e, t[1][i], t[0][i], t[2][j], t[0][j], sign);
    add_product(e, t[1][j], t[0][j], t[2][i], t[0][i], -sign);
}

static double total(const expansion *e) {
    double sum = 0.0;
    for (int i = 0; i < e->count; i++)
        sum += e->at[i];
    return sum;
}

static int sign_of_expansion(const expansion *e) {
    return e->count == 0 ? 0 : sign_of(e->at[e->count - 1]);
}

/* ---- Decisions ----------------------------------------------------------------------------------------------------
 */

bool exact_normal(exact_triangle t, double normal[3]) {
    double error = 0.0;
    double length = 0.0;
    for (int k = 0; k < 3; k++) {
        const bounded c = cross_component(t, k);
        normal[k] = c.value;
        error = fmax(error, c.size * ROUNDED);
        length = fmax(length, fabs(c.value));
    }
    if (length * 0x1p-42 > error)
        return true;
    for (int k = 0; k < 3; k++) {
        expansion e;
        e.count = 0;
        add_cross(&e, t, k, 1.0);
        normal[k] = total(&e);
    }
    return normal[0] != 0.0 || normal[1] != 0.0 || normal[2] != 0.0;
}

static int above_exactly(exact_triangle t, const double p[3]) {
    expansion volume;
    volume.count = 0;
    for (int k = 0; k < 3; k++) {
        expansion cross;
        cross.count = 0;
        add_cross(&cross, t, k, 1.0);
        const dp_pair d = dp_two_sum(p[k], -t[0][k]);
        add_scaled(&volume, cross.at, cross.count, d.lo);
        add_scaled(&volume, cross.at, cross.count, d.hi);
    }
    return sign_of_expansion(&volume);
}

int exact_above(exact_triangle t, const double p[3]) {
    if (same(p, t[0]) || same(p, t[1]) || same(p, t[2]))
        return 0;
    bounded sum = {0.0, 0.0};
    for (int k = 0; k < 3; k++) {
        const bounded c = cross_component(t, k);
        sum.value += c.value * (p[k] - t[0][k]);
        sum.size += c.size * fabs(p[k] - t[0][k]);
    }
    const int quick = sign_beyond(sum.value, sum.size, ROUNDED);
    if (quick != EXACT_UNSURE)
        return quick;
    dp_pair pairs = {0.0, 0.0};
    for (int k = 0; k < 3; k++)
        pairs = dp_pair_sum(pairs, dp_pair_product(pair_cross(t, k), dp_two_sum(p[k], -t[0][k])));
    const int paired = sign_beyond(pairs.hi, sum.size, PAIRED);
    return paired != EXACT_UNSURE ? paired : above_exactly(t, p);
}

/* In one plane it is enough to look along the axis that is nearest to the normal. */
static int turn_in_plane(const exact_view *view, const double p[3], const double q[3], const double r[3]) {
    double n[3];
    exact_normal(view->a, n);
    int k = fabs(n[1]) > fabs(n[0]) ? 1 : 0;
    k = fabs(n[2]) > fabs(n[k]) ? 2 : k;
    const double *const t[3] = {p, q, r};
    const bounded c = cross_component(t, k);
    const int side = sign_of(n[k]);
    const int quick = sign_beyond(c.value, c.size, ROUNDED);
    if (quick != EXACT_UNSURE)
        return quick * side;
    expansion e;
    e.count = 0;
    add_cross(&e, t, k, 1.0);
    return sign_of_expansion(&e) * side;
}

static int turn_in_pairs(const exact_view *view, exact_triangle t) {
    dp_pair sum = {0.0, 0.0};
    double size = 0.0;
    for (int k = 0; k < 3; k++) {
        const dp_pair b = pair_cross(view->b, k);
        const dp_pair n = dp_pair_sum(pair_cross(view->a, k), (dp_pair){view->sign * b.hi, view->sign * b.lo});
        sum = dp_pair_sum(sum, dp_pair_product(n, pair_cross(t, k)));
        size += view->sizes[k] * cross_component(t, k).size;
    }
    return sign_beyond(sum.hi, size, PAIRED);
}

static int turn_exactly(const exact_view *view, exact_triangle t) {
    expansion sum;
    sum.count = 0;
    for (int k = 0; k < 3; k++) {
        expansion n;
        expansion cross;
        n.count = cross.count = 0;
        add_cross(&n, view->a, k, 1.0);
        add_cross(&n, view->b, k, view->sign);
        add_cross(&cross, t, k, 1.0);
        for (int i = 0; i < cross.count; i++)
            add_scaled(&sum, n.at, n.count, cross.at[i]);
    }
    return sign_of_expansion(&sum);
}

void exact_look(exact_view *view, exact_triangle a, exact_triangle b, double sign) {
    memcpy(view->a, a, sizeof view->a);
    memcpy(view->b, b, sizeof view->b);
    view->sign = sign;
    view->plane = false;
    for (int k = 0; k < 3; k++) {
        const bounded x = cross_component(a, k);
        const bounded y = cross_component(b, k);
        view->along[k] = x.value + sign * y.value;
        view->sizes[k] = x.size + y.size;
    }
}

int exact_turn_quick(const exact_view *view, const double p[3], const double q[3], const double r[3]) {
    if (same(r, p) || same(r, q))
        return 0;
    const double *const t[3] = {p, q, r};
    bounded sum = {0.0, 0.0};
    for (int k = 0; k < 3; k++) {
        const bounded c = cross_component(t, k);
        sum.value += view->along[k] * c.value;
        sum.size += view->sizes[k] * c.size;
    }
    return sign_beyond(sum.value, sum.size, ROUNDED);
}

int exact_turn(const exact_view *view, const double p[3], const double q[3], const double r[3]) {
    int turn = exact_turn_quick(view, p, q, r);
    if (turn != EXACT_UNSURE)
        return turn;
    if (view->plane)
        return turn_in_plane(view, p, q, r);
    const double *const t[3] = {p, q, r};
    turn = turn_in_pairs(view, t);
    return turn != EXACT_UNSURE ? turn : turn_exactly(view, t);
}
