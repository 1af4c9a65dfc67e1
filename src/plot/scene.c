/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A requirement file: a panel for each set-up, in it what the set-up gives as curves, and each requirement as a level
 * line over its range, marked where it is worst. A requirement is met where the curve runs below its line.
 */
#include <math.h>
#include <stdio.h>

#include "plot/envelope.h"

enum { COLOUR_SEPARATION = 0, COLOUR_MISSED = 1, COLOUR_MET = 2, COLOUR_ERROR = 3 };
enum { MARKER_MET = 0, MARKER_MISSED = 4 };

/* The depths to show: those that are asked about, with a margin, behind them one that a name fits into. */
static void range_of(const figure_request *r, double *lo, double *hi) {
    *lo = r->lo;
    *hi = r->hi;
    if (!isnan(r->lo))
        return;
    *lo = INFINITY;
    *hi = 0;
    for (size_t i = 0; i < r->need_count; i++) {
        const figure_need *n = &r->needs[i];
        *lo = fmin(*lo, n->lo);
        *hi = fmax(*hi, isinf(n->hi) ? 100 * n->lo : n->hi);
    }
    if (r->need_count == 0) { /* cameras without requirements: what there is to see of the first */
        *lo = r->setups[0].spec.znear;
        *hi = fmin(r->setups[0].spec.zfar, 1e6 * *lo);
    }
    const double margin = pow(*hi / *lo, 0.05) * 1.2;
    *lo /= margin;
    *hi *= pow(margin, 5);
}

static double worst_error(const dp_worst *worst) {
    return worst->error;
}

static void error_of(const void *context, double from, double to, refine_sample *out) {
    envelope_slice(context, from, to, worst_error, out);
}

static void add_curve(const figure_request *r, chart *out, chart_panel *panel, const dp_setup *given, bool is_error) {
    dp_setup staged;
    dp_spec spec = given->spec;
    spec.model = DP_MODEL_STAGED; /* an error is judged in this one where fp32, which has none, is the fullest */
    const bool other = is_error && given->spec.model == DP_MODEL_FP32 && dp_setup_init(&staged, &spec) == DP_OK;
    const dp_setup *setup = other ? &staged : given;
    const double lo = fmax(panel->x.lo, setup->spec.znear), hi = fmin(panel->x.hi, setup->spec.zfar);
    double knots[REFINE_KNOTS];
    refine curve;
    if (!(lo < hi))
        return;
    refine_request q = envelope_request(r, setup, CHART_LOG, lo, hi, knots);
    q.slices = true;
    q.axis[0] = panel->y;
    q.sample = is_error ? error_of : envelope_separation;
    q.context = setup;
    if (!refine_begin(&curve, &q, out))
        return;
    refine_finish(&curve);
    refine_account(&curve, out);
    chart_series *s = envelope_line(out, panel, CHART_LINE, &curve, 0);
    if (s == NULL)
        return;
    s->style = (chart_style){is_error ? COLOUR_ERROR : COLOUR_SEPARATION, is_error ? 1 : 0, -1, false};
    snprintf(s->name, sizeof s->name, "%s",
             is_error ? "error that the set-up gives" : "separation that the set-up gives");
}

/* Level lines, a gap between each two; then the markers with the names. */
static void add_needs(const figure_request *r, chart *out, chart_panel *panel, size_t setup, bool passed) {
    size_t count = 0, line = 0, point = 0;
    for (size_t i = 0; i < r->need_count; i++)
        count += r->needs[i].setup == setup && r->needs[i].passed == passed;
    if (count == 0)
        return;
    chart_series *lines = chart_add_series(out, panel, CHART_LINE, 3 * count);
    chart_series *points = chart_add_series(out, panel, CHART_POINTS, count);
    if (lines == NULL || points == NULL)
        return;
    points->labels = chart_memory(out, count, sizeof *points->labels);
    if (points->labels == NULL)
        return;
    lines->unlisted = true;
    lines->style = (chart_style){passed ? COLOUR_MET : COLOUR_MISSED, 0, -1, false};
    points->style =
        (chart_style){passed ? COLOUR_MET : COLOUR_MISSED, passed ? 0 : 1, passed ? MARKER_MET : MARKER_MISSED, false};
    snprintf(lines->name, sizeof lines->name, "range of what is %s", passed ? "met" : "missed");
    snprintf(points->name, sizeof points->name, "requirement %s, where it is worst", passed ? "met" : "missed");
    for (size_t i = 0; i < r->need_count; i++) {
        const figure_need *n = &r->needs[i];
        if (n->setup != setup || n->passed != passed)
            continue;
        double hi = fmin(n->hi, panel->x.hi);
        lines->x[line] = n->lo;
        lines->x[line + 1] = lines->x[line + 2] = hi;
        lines->y[line] = lines->y[line + 1] = n->limit;
        lines->y[line + 2] = NAN;
        line += 3;
        points->x[point] = fmin(isfinite(n->z) ? n->z : hi, hi);
        points->y[point] = n->limit;
        snprintf(points->labels[point++], sizeof *points->labels, "%s%s", n->name, n->is_error ? " (error)" : "");
    }
}

const char *scene_build(const figure_request *request, chart *out) {
    double lo, hi;
    range_of(request, &lo, &hi);
    for (size_t i = 0; i < request->count; i++) {
        bool wanted[2] = {false, false};
        chart_panel *panel = chart_add_panel(out);
        if (panel == NULL)
            return NULL;
        panel->x = figure_depth_axis(CHART_LOG, lo, hi);
        panel->y =
            (chart_axis){.scale = CHART_LOG, .label = "allowed and given", .key = "length", .unit = "scene units"};
        snprintf(panel->title, sizeof panel->title, "%s", request->names[i]);
        for (size_t n = 0; n < request->need_count; n++)
            wanted[request->needs[n].is_error] |= request->needs[n].setup == i;
        for (int is_error = 0; is_error < 2; is_error++)
            if (wanted[is_error])
                add_curve(request, out, panel, &request->setups[i], is_error);
        add_needs(request, out, panel, i, true);
        add_needs(request, out, panel, i, false);
    }
    chart_fit(out);
    return NULL;
}
