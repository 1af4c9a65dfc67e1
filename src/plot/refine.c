/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Bisection with three tests. Between two places the middle must lie near the chord, the quarters nearer still to the
 * two half chords (for a smooth curve their distance is a quarter of the middle's, and the line through all five four
 * times better again), and of slices the value over all columns between must not leave the range of the five. Steps
 * defeat the first two, so a stepped curve is settled only where it is level. Jumps are the caller's knots.
 */
#include "plot/refine.h"

#include <math.h>

typedef struct extent {
    double lo, hi;
} extent;

/* What one value is at one place; as many of them a place as the request has values. */
typedef struct known {
    double y, step, flicker;
} known;

struct refine_places {
    chart *account;
    int count;
    bool *visited;
    known *at;
    extent seen[REFINE_VALUES]; /* what has been seen of each value */
};

static known *known_at(const refine *r, int place, int value) {
    return &r->places->at[place * r->request.values + value];
}

/* A log axis is fitted with this much air at least: see chart_fit(). */
static const double least_air = 1.05;

double refine_edge(chart_scale scale, double lo, double hi, int i, int count) {
    if (i <= 0)
        return lo;
    if (i >= count)
        return hi;
    chart_axis axis = {.scale = scale, .lo = lo, .hi = hi};
    return fmin(fmax(chart_axis_at(&axis, (double)i / count), lo), hi);
}

static double edge(const refine *r, int i) {
    return refine_edge(r->request.scale, r->request.lo, r->request.hi, i, r->request.columns);
}

static double place_x(const refine *r, int i) {
    if (!r->request.slices)
        return edge(r, i);
    double from = edge(r, i), to = edge(r, i + 1);
    return r->request.scale == CHART_LOG ? sqrt(from) * sqrt(to) : from + (to - from) / 2;
}

/* Along the axis, where half a pixel is as long everywhere. */
static double along(const refine *r, int value, double y) {
    return r->request.axis[value].scale == CHART_LOG ? log(y) : y;
}

static double along_at(const refine *r, int value, int place) {
    return along(r, value, known_at(r, place, value)->y);
}

static void measure(refine *r, int first, int last, refine_sample *out) {
    r->evaluations++;
    r->request.sample(r->request.context, edge(r, first), r->request.slices ? edge(r, last + 1) : edge(r, last), out);
}

static void visit(refine *r, int i) {
    struct refine_places *p = r->places;
    refine_sample s = {.step = {0}};
    if (i < 0 || i >= p->count || p->visited[i])
        return;
    measure(r, i, i, &s);
    p->visited[i] = true;
    r->points++;
    for (int v = 0; v < r->request.values; v++) {
        *known_at(r, i, v) = (known){s.y[v], s.step[v], s.flicker[v]};
        if (isfinite(s.y[v]) && (r->request.axis[v].scale == CHART_LINEAR || s.y[v] > 0)) {
            p->seen[v].lo = fmin(p->seen[v].lo, s.y[v]);
            p->seen[v].hi = fmax(p->seen[v].hi, s.y[v]);
        }
    }
}

/* The places next to a depth, so that what happens there happens between neighbours. */
static void visit_around(refine *r, double x) {
    const chart_axis axis = {.scale = r->request.scale, .lo = r->request.lo, .hi = r->request.hi};
    if (!(x >= axis.lo && x <= axis.hi))
        return;
    const int i = (int)floor(chart_axis_share(&axis, x) * r->request.columns);
    for (int k = i - r->request.slices; k <= i + 1; k++)
        visit(r, k);
}

bool refine_begin(refine *r, const refine_request *request, chart *account) {
    const int places = request->columns + !request->slices;
    *r = (refine){.request = *request, .places = chart_memory(account, 1, sizeof *r->places)};
    struct refine_places *p = r->places;
    if (p == NULL)
        return false;
    *p = (struct refine_places){.account = account, .count = places};
    p->visited = chart_memory(account, (size_t)places, sizeof *p->visited);
    p->at = chart_memory(account, (size_t)places * (size_t)request->values, sizeof *p->at);
    if (p->visited == NULL || p->at == NULL)
        return false;
    for (int v = 0; v < request->values; v++)
        p->seen[v] = (extent){INFINITY, -INFINITY};
    for (int k = 0; k < 2; k++) { /* the planes cut the cells at the ends */
        visit(r, k);
        visit(r, places - 1 - k);
    }
    for (size_t k = 0; k < request->knot_count; k++)
        visit_around(r, request->knots[k]);
    return true;
}

void refine_share_axis(refine *curves, size_t count) {
    extent all = {INFINITY, -INFINITY};
    for (size_t i = 0; i < count; i++) {
        all.lo = fmin(all.lo, curves[i].places->seen[0].lo);
        all.hi = fmax(all.hi, curves[i].places->seen[0].hi);
    }
    for (size_t i = 0; i < count; i++)
        curves[i].places->seen[0] = all;
}

/* Half a pixel along the axis. What is seen later can only make it longer. */
double refine_half_pixel(const refine *r, int value) {
    const chart_axis *axis = &r->request.axis[value];
    const bool fitted = axis->lo < axis->hi;
    const extent *seen = &r->places->seen[value];
    const double lo = fitted ? axis->lo : seen->lo, hi = fitted ? axis->hi : seen->hi;
    if (!(lo <= hi))
        return 0;
    const double length = axis->scale == CHART_LOG ? fmax(log(hi / lo), 2 * log(least_air)) : hi - lo;
    return 0.5 * length / r->request.rows;
}

/* The distance of place i from the line between two others; infinite and missing values are near their like alone. */
static double off_line(const refine *r, int value, int from, int i, int to) {
    const double a = along_at(r, value, from), b = along_at(r, value, to), y = along_at(r, value, i);
    if (isfinite(a) && isfinite(b) && isfinite(y))
        return fabs(y - a - (b - a) * (i - from) / (to - from));
    const bool alike = isnan(a) ? isnan(b) && isnan(y) : a == b && a == y;
    return alike ? 0 : (double)INFINITY;
}

/* Half a pixel in all: here for each of the tests' shares of it. */
static bool is_straight(const refine *r, const int at[5]) {
    for (int v = 0; v < r->request.values; v++) {
        const double half = refine_half_pixel(r, v);
        if (!(off_line(r, v, at[0], at[2], at[4]) <= half && off_line(r, v, at[0], at[1], at[2]) <= half / 4 &&
              off_line(r, v, at[2], at[3], at[4]) <= half / 4))
            return false;
    }
    return true;
}

static extent range_of(const refine *r, int value, const int at[5]) {
    extent e = {INFINITY, -INFINITY};
    for (int k = 0; k < 5; k++) {
        e.lo = fmin(e.lo, along_at(r, value, at[k]));
        e.hi = fmax(e.hi, along_at(r, value, at[k]));
    }
    return e;
}

/* No value of the columns between stands out from the five, and where steps would be seen the five are one level. */
static bool is_contained(refine *r, const int at[5]) {
    refine_sample whole = {.step = {0}};
    for (int v = 0; v < r->request.values; v++) {
        const extent e = range_of(r, v, at);
        double step = 0, flicker = 0, half = refine_half_pixel(r, v);
        for (int k = 0; k < 5; k++) {
            step = fmax(step, known_at(r, at[k], v)->step);
            flicker = fmax(flicker, known_at(r, at[k], v)->flicker);
        }
        if (isfinite(e.hi) && (flicker > half / 2 || (step > half && !(e.hi - e.lo <= half))))
            return false;
        if (r->request.slices && v == 0)
            measure(r, at[0], at[4], &whole);
        const double y = along(r, v, whole.y[v]);
        if (r->request.slices && isfinite(e.hi) && !(y >= e.lo - half && y <= e.hi + half))
            return false;
    }
    return true;
}

static void split(refine *r, int i, int j) {
    const int m = (i + j) / 2, at[5] = {i, (i + m) / 2, m, (m + j) / 2, j};
    if (j - i < 2)
        return;
    for (int k = 1; k < 4; k++)
        visit(r, at[k]);
    if (j - i <= 4 || (is_straight(r, at) && is_contained(r, at)))
        return;
    split(r, i, m);
    split(r, m, j);
}

void refine_finish(refine *r) {
    const struct refine_places *p = r->places;
    for (int i = 0, j; i + 1 < p->count; i = j) {
        for (j = i + 1; !p->visited[j]; j++) { /* the last place is known */
        }
        split(r, i, j);
    }
    p->account->evaluations += r->evaluations;
    p->account->places += (size_t)p->count;
    p->account->curves++;
}

void refine_take(const refine *r, int value, double *x, double *y) {
    size_t k = 0;
    for (int i = 0; i < r->places->count; i++)
        if (r->places->visited[i]) {
            x[k] = place_x(r, i);
            y[k++] = known_at(r, i, value)->y;
        }
}
