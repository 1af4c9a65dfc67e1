/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Bisection with three tests. Between two places the middle must lie near the chord, the quarters nearer still to the
 * two half chords (for a smooth curve their distance is a quarter of the middle's, and the line through all five four
 * times better again), and of slices the value over all columns between must not leave the range of the five. Steps
 * defeat the first two, so a stepped curve is settled only where it is level. Jumps are the caller's knots.
 */
#include "plot/refine.h"

#include <math.h>

#include "core/elementary.h"

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
    return r->request.axis[value].scale == CHART_LOG ? dp_log(y) : y;
}

static double along_at(const refine *r, int value, int place) {
    return along(r, value, r->at[place].y[value]);
}

static void evaluate(refine *r, int first, int last, refine_sample *out) {
    r->account->evaluations++;
    r->request.sample(r->request.context, edge(r, first), r->request.slices ? edge(r, last + 1) : edge(r, last), out);
}

static void visit(refine *r, int i) {
    if (i < 0 || i >= r->places || r->visited[i])
        return;
    evaluate(r, i, i, &r->at[i]);
    r->visited[i] = true;
    r->points++;
    for (int v = 0; v < r->request.values; v++) {
        const double y = r->at[i].y[v];
        if (isfinite(y) && (r->request.axis[v].scale == CHART_LINEAR || y > 0))
            r->seen[v] = (chart_extent){fmin(r->seen[v].lo, y), fmax(r->seen[v].hi, y)};
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
    *r = (refine){.request = *request, .account = account, .places = places};
    r->visited = chart_memory(account, (size_t)places, sizeof *r->visited);
    r->at = chart_memory(account, (size_t)places, sizeof *r->at);
    if (r->visited == NULL || r->at == NULL)
        return false;
    for (int v = 0; v < request->values; v++)
        r->seen[v] = (chart_extent){INFINITY, -INFINITY};
    for (int k = 0; k < 2; k++) { /* the planes cut the cells at the ends */
        visit(r, k);
        visit(r, places - 1 - k);
    }
    for (size_t k = 0; k < request->knot_count; k++)
        visit_around(r, request->knots[k]);
    return true;
}

void refine_share_axis(refine *curves, size_t count) {
    chart_extent all = {INFINITY, -INFINITY};
    for (size_t i = 0; i < count; i++) {
        all.lo = fmin(all.lo, curves[i].seen[0].lo);
        all.hi = fmax(all.hi, curves[i].seen[0].hi);
    }
    for (size_t i = 0; i < count; i++)
        curves[i].seen[0] = all;
}

/* Half a pixel along the axis. What is seen later can only make it longer. */
double refine_half_pixel(const refine *r, int value) {
    const chart_axis *axis = &r->request.axis[value];
    const bool fitted = axis->lo < axis->hi;
    const chart_extent *seen = &r->seen[value];
    const double lo = fitted ? axis->lo : seen->lo, hi = fitted ? axis->hi : seen->hi;
    if (!(lo <= hi))
        return 0;
    const double length = axis->scale == CHART_LOG ? fmax(dp_log(hi / lo), 2 * dp_log(least_air)) : hi - lo;
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

static chart_extent range_of(const refine *r, int value, const int at[5]) {
    chart_extent e = {INFINITY, -INFINITY};
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
        const chart_extent e = range_of(r, v, at);
        double step = 0, flicker = 0, half = refine_half_pixel(r, v);
        for (int k = 0; k < 5; k++) {
            step = fmax(step, r->at[at[k]].step[v]);
            flicker = fmax(flicker, r->at[at[k]].flicker[v]);
        }
        if (isfinite(e.hi) && (flicker > half / 2 || (step > half && !(e.hi - e.lo <= half))))
            return false;
        if (r->request.slices && v == 0)
            evaluate(r, at[0], at[4], &whole);
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
    for (int i = 0; r->request.every && i < r->places; i++)
        visit(r, i);
    for (int i = 0, j; i + 1 < r->places; i = j) {
        for (j = i + 1; !r->visited[j]; j++) { /* the last place is known */
        }
        split(r, i, j);
    }
    r->account->places += (size_t)r->places;
    r->account->curves++;
}

void refine_take(const refine *r, int value, double *x, double *y) {
    size_t k = 0;
    for (int i = 0; i < r->places; i++)
        if (r->visited[i]) {
            x[k] = place_x(r, i);
            y[k++] = r->at[i].y[value];
        }
}
