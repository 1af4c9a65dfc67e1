/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "draw/alike.h"

#include <math.h>

/* Half a stroke as a share of the vertical axis, as figures are laid out; and how much of the other must be shared. */
static const double half_stroke = 1.0 / 300, enough = 0.5;

/* How high a line runs at x, as a share of the axis: straight between its points. */
static double height_at(const chart_panel *panel, const chart_series *s, double x) {
    size_t i = 0;
    while (i + 2 < s->count && s->x[i + 1] < x)
        i++;
    const double x0 = chart_axis_share(&panel->x, s->x[i]), x1 = chart_axis_share(&panel->x, s->x[i + 1]);
    const double y0 = chart_axis_share(&panel->y, s->y[i]), y1 = chart_axis_share(&panel->y, s->y[i + 1]);
    const double t = x1 > x0 ? (chart_axis_share(&panel->x, x) - x0) / (x1 - x0) : 0;
    return y0 == y1 || t <= 0 ? y0 : t >= 1 ? y1 : y0 + t * (y1 - y0);
}

static bool meet(const chart_panel *panel, const chart_series *a, const chart_series *b, double x) {
    const double u = height_at(panel, a, x), v = height_at(panel, b, x);
    return fabs(u - v) <= half_stroke || u == v || (isnan(u) && isnan(v));
}

static bool near_on(const chart_axis *axis, double a, double b) {
    return fabs(chart_axis_share(axis, a) - chart_axis_share(axis, b)) <= half_stroke;
}

/* Is there a point of `b` where point i of `a` is? */
static bool has_point(const chart_panel *panel, const chart_series *a, const chart_series *b, size_t i) {
    for (size_t k = 0; k < b->count; k++)
        if (near_on(&panel->x, a->x[i], b->x[k]) && near_on(&panel->y, a->y[i], b->y[k]))
            return true;
    return false;
}

/* Where the points of `a` part from `b`: the first and the last x. */
static void parted(const chart_panel *panel, const chart_series *a, const chart_series *b, chart_extent *at) {
    for (size_t i = 0; i < a->count; i++)
        if (!(a->kind == CHART_LINE ? meet(panel, a, b, a->x[i]) : has_point(panel, a, b, i)))
            *at = (chart_extent){fmin(at->lo, a->x[i]), fmax(at->hi, a->x[i])};
}

static double length(const chart_panel *panel, double from, double to) {
    return chart_axis_share(&panel->x, to) - chart_axis_share(&panel->x, from);
}

static bool takes_part(const chart_series *s) {
    return !s->unlisted && !s->second && s->count > 1 && (s->kind == CHART_LINE || s->kind == CHART_POINTS);
}

alike alike_find(const chart_panel *panel, size_t index) {
    const chart_series *s = &panel->series[index];
    alike best = {.other = NULL};
    double longest = enough;
    for (size_t k = index + 1; k < panel->series_count && takes_part(s); k++) {
        const chart_series *other = &panel->series[k];
        const double lo = s->x[0], hi = s->x[s->count - 1];
        chart_extent at = {INFINITY, -INFINITY};
        if (!takes_part(other) || other->kind != s->kind)
            continue;
        parted(panel, s, other, &at);
        parted(panel, other, s, &at);
        const double before = length(panel, lo, at.lo), behind = length(panel, at.hi, hi);
        const bool everywhere = at.lo > at.hi;
        const double own = everywhere ? 2 : s->kind == CHART_LINE ? fmax(before, behind) : 0;
        if (!(own > longest))
            continue;
        longest = own;
        best = (alike){other, everywhere || before > behind ? (double)NAN : at.hi,
                       everywhere || before <= behind ? (double)NAN : at.lo};
    }
    return best;
}
