/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene_truth.h"

#include <math.h>
#include <stdlib.h>

#include <gmp.h>

/* ---- Rationals that live until the next pair ----------------------------------------------------------------------
 */

enum { POOL = 1 << 13, CORNERS = 12 };

typedef mpq_srcptr num;

static mpq_t pool[POOL];
static size_t used, made;

static mpq_ptr slot(void) {
    if (used == POOL)
        abort();
    if (used == made)
        mpq_init(pool[made++]);
    return pool[used++];
}

static num of(double x) {
    mpq_ptr out = slot();
    mpq_set_d(out, x);
    return out;
}

static num plus(num x, num y) {
    mpq_ptr out = slot();
    mpq_add(out, x, y);
    return out;
}

static num minus(num x, num y) {
    mpq_ptr out = slot();
    mpq_sub(out, x, y);
    return out;
}

static num times(num x, num y) {
    mpq_ptr out = slot();
    mpq_mul(out, x, y);
    return out;
}

static num over(num x, num y) {
    mpq_ptr out = slot();
    mpq_div(out, x, y);
    return out;
}

/* Good to 300 bits. */
static num root(num x) {
    mpf_t f;
    mpf_init2(f, 320);
    mpf_set_q(f, x);
    mpf_sqrt(f, f);
    mpq_ptr out = slot();
    mpq_set_f(out, f);
    mpf_clear(f);
    return out;
}

typedef struct vector {
    num at[3];
} vector;

static vector point(const double x[3]) {
    return (vector){{of(x[0]), of(x[1]), of(x[2])}};
}

static vector from_to(vector x, vector y) {
    return (vector){{minus(y.at[0], x.at[0]), minus(y.at[1], x.at[1]), minus(y.at[2], x.at[2])}};
}

static vector cross(vector x, vector y) {
    vector out;
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3;
        const int j = (k + 2) % 3;
        out.at[k] = minus(times(x.at[i], y.at[j]), times(x.at[j], y.at[i]));
    }
    return out;
}

static num dot(vector x, vector y) {
    return plus(plus(times(x.at[0], y.at[0]), times(x.at[1], y.at[1])), times(x.at[2], y.at[2]));
}

/* ---- Polygons in the plane of two axes -----------------------------------------------------------------------------
 */

typedef struct corner {
    num u, v, above; /* above: how much farther along the common normal the second plane is, in lengths of it */
} corner;

typedef struct polygon {
    int count;
    corner at[CORNERS];
} polygon;

static num mixed(num x, num y, num t) {
    return plus(x, times(t, minus(y, x)));
}

/* Keeps the part where the values, linear and given at the corners, are at least 0; lines and points stay. */
static polygon part(const polygon *p, const num *value) {
    polygon out = {.count = 0};
    for (int i = 0; i < p->count; i++) {
        const int j = (i + 1) % p->count;
        const int here = mpq_sgn(value[i]);
        const int there = mpq_sgn(value[j]);
        if (here >= 0)
            out.at[out.count++] = p->at[i];
        if (here * there < 0) {
            const num t = over(value[i], minus(value[i], value[j]));
            out.at[out.count++] = (corner){mixed(p->at[i].u, p->at[j].u, t), mixed(p->at[i].v, p->at[j].v, t),
                                           mixed(p->at[i].above, p->at[j].above, t)};
        }
    }
    return out;
}

static num turn(corner p, corner q, corner r) {
    return minus(times(minus(q.u, p.u), minus(r.v, p.v)), times(minus(q.v, p.v), minus(r.u, p.u)));
}

/* Twice the area, without its sign, and the centroid. */
static num area(const polygon *p, num centroid[2]) {
    num sum = of(0.0);
    num u = sum;
    num v = sum;
    const num three = of(3.0);
    for (int i = 1; i + 1 < p->count; i++) {
        const corner c[3] = {p->at[0], p->at[i], p->at[i + 1]};
        const num t = turn(c[0], c[1], c[2]);
        sum = plus(sum, t);
        u = plus(u, times(t, over(plus(plus(c[0].u, c[1].u), c[2].u), three)));
        v = plus(v, times(t, over(plus(plus(c[0].v, c[1].v), c[2].v), three)));
    }
    if (mpq_sgn(sum) != 0) {
        centroid[0] = over(u, sum);
        centroid[1] = over(v, sum);
    }
    return mpq_sgn(sum) < 0 ? minus(of(0.0), sum) : sum;
}

static polygon within(polygon p, num limit) {
    for (int side = -1; side <= 1; side += 2) {
        num value[CORNERS];
        for (int i = 0; i < p.count; i++)
            value[i] = side < 0 ? minus(limit, p.at[i].above) : plus(limit, p.at[i].above);
        p = part(&p, value);
    }
    return p;
}

static polygon clipped(polygon p, const corner b[3]) {
    const int way = mpq_sgn(turn(b[0], b[1], b[2]));
    for (int k = 0; k < 3; k++) {
        num value[CORNERS];
        for (int i = 0; i < p.count; i++) {
            const num t = turn(b[k], b[(k + 1) % 3], p.at[i]);
            value[i] = way < 0 ? minus(of(0.0), t) : t;
        }
        p = part(&p, value);
    }
    return p;
}

/* ---- The pair ------------------------------------------------------------------------------------------------------
 */

typedef struct view {
    vector a[3], b[3], na, nb, n;
    int u, v, w;
} view;

/* How far along n the plane through `on` is from the point of the plane w = 0 below (u, v). */
static num height(const view *s, vector normal, vector on, num u, num v) {
    vector x;
    x.at[s->u] = u;
    x.at[s->v] = v;
    x.at[s->w] = of(0.0);
    return over(dot(normal, from_to(x, on)), dot(normal, s->n));
}

static corner seen(const view *s, vector x) {
    const num t = over(x.at[s->w], s->n.at[s->w]);
    const num u = minus(x.at[s->u], times(t, s->n.at[s->u]));
    const num v = minus(x.at[s->v], times(t, s->n.at[s->v]));
    return (corner){u, v, minus(height(s, s->nb, s->b[0], u, v), height(s, s->na, s->a[0], u, v))};
}

static bool look(view *s, double cosine2) {
    const num d = dot(s->na, s->nb);
    if (mpq_cmp(times(d, d), times(of(cosine2), times(dot(s->na, s->na), dot(s->nb, s->nb)))) < 0)
        return false;
    s->w = 0;
    for (int k = 0; k < 3; k++) {
        s->n.at[k] = mpq_sgn(d) < 0 ? minus(s->na.at[k], s->nb.at[k]) : plus(s->na.at[k], s->nb.at[k]);
        if (mpq_sgn(s->n.at[s->w]) == 0)
            s->w = k;
    }
    s->u = (s->w + 1) % 3;
    s->v = (s->w + 2) % 3;
    return true;
}

/* Seen along the normal. */
static double area_across(const view *s, num twice) {
    return 0.5 * fabs(mpq_get_d(over(times(twice, s->n.at[s->w]), root(dot(s->n, s->n)))));
}

static void fill(const view *s, const polygon *p, const num centroid[2], num twice, scene_truth *out) {
    const num length = root(dot(s->n, s->n));
    out->lo = out->hi = mpq_get_d(times(p->at[0].above, length));
    for (int i = 1; i < p->count; i++) {
        const double h = mpq_get_d(times(p->at[i].above, length));
        out->lo = h < out->lo ? h : out->lo;
        out->hi = h > out->hi ? h : out->hi;
    }
    out->area = area_across(s, twice);
    const num t = height(s, s->na, s->a[0], centroid[0], centroid[1]);
    out->place[s->u] = mpq_get_d(plus(centroid[0], times(t, s->n.at[s->u])));
    out->place[s->v] = mpq_get_d(plus(centroid[1], times(t, s->n.at[s->v])));
    out->place[s->w] = mpq_get_d(times(t, s->n.at[s->w]));
}

static bool is_zero(vector x) {
    return mpq_sgn(x.at[0]) == 0 && mpq_sgn(x.at[1]) == 0 && mpq_sgn(x.at[2]) == 0;
}

scene_truth scene_truth_of(const double a[3][3], const double b[3][3], double gap, double cosine2) {
    scene_truth out = {0};
    view s;
    used = 0;
    for (int k = 0; k < 3; k++) {
        s.a[k] = point(a[k]);
        s.b[k] = point(b[k]);
    }
    s.na = cross(from_to(s.a[0], s.a[1]), from_to(s.a[0], s.a[2]));
    s.nb = cross(from_to(s.b[0], s.b[1]), from_to(s.b[0], s.b[2]));
    out.degenerate = is_zero(s.na) || is_zero(s.nb);
    if (out.degenerate || !look(&s, cosine2))
        return out;
    polygon p = {.count = 3};
    corner other[3];
    out.plane = true;
    for (int k = 0; k < 3; k++) {
        p.at[k] = seen(&s, s.a[k]);
        other[k] = seen(&s, s.b[k]);
        out.plane = out.plane && mpq_sgn(dot(s.na, from_to(s.a[0], s.b[k]))) == 0;
    }
    num centroid[2] = {of(0.0), of(0.0)};
    p = clipped(p, other);
    out.whole = area_across(&s, area(&p, centroid));
    out.overlap = out.whole > 0.0;
    out.touch = p.count > 0 && !out.overlap;
    p = within(p, over(of(gap), root(dot(s.n, s.n))));
    const num twice = area(&p, centroid);
    out.pair = mpq_sgn(twice) > 0;
    if (out.pair)
        fill(&s, &p, centroid, twice, &out);
    return out;
}
