/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The z-fighting interval; of set-ups of the model fp32, which have no cells, the guaranteed separation, with the
 * interval of the lattice behind it for comparison.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "plot/envelope.h"

static double widest_cell(const dp_worst *worst) {
    return worst->interval;
}

static bool is_fp32(const figure_request *request, size_t i) {
    return request->setups[i].spec.model == DP_MODEL_FP32;
}

/* The same set-ups, each with cells. Returns how many had none. */
static size_t with_cells(const figure_request *request, dp_setup lattice[CHART_SERIES]) {
    size_t changed = 0;
    for (size_t i = 0; i < request->count && i < CHART_SERIES; i++) {
        dp_spec spec = request->setups[i].spec;
        lattice[i] = request->setups[i];
        if (!is_fp32(request, i))
            continue;
        spec.model = DP_MODEL_EXACT;
        dp_setup_init(&lattice[i], &spec);
        changed++;
    }
    return changed;
}

static void into_background(chart_series *s) {
    s->style.thin = true;
    s->style.marker = -1;
    s->unlisted = true;
    s->note[0] = '\0';
    snprintf(s->name + strlen(s->name), sizeof s->name - strlen(s->name), ", lattice");
}

static bool has_census(const figure_request *request, size_t i) {
    return request->census != NULL && request->census[i].count > 0;
}

static void add_separation(const figure_request *request, chart *out, chart_panel *panel, size_t i) {
    double knots[REFINE_KNOTS];
    refine r;
    refine_request q = envelope_request(request, &request->setups[i], CHART_LOG, panel->x.lo, panel->x.hi, knots);
    q.slices = true;
    q.axis[0] = panel->y;
    q.sample = envelope_separation;
    q.context = &request->setups[i];
    if (!refine_begin(&r, &q, out))
        return;
    refine_finish(&r);
    refine_account(&r, out);
    chart_series *s = envelope_line(out, panel, CHART_LINE, &r, 0);
    if (s == NULL)
        return;
    s->style = figure_style(request, i);
    if (has_census(request, i))
        s->style.marker = -1; /* its points have it */
    snprintf(s->name, sizeof s->name, "%s", request->names[i]);
}

/* The longest intervals that there are, each where it begins: none of them lies above the guarantee. */
static void add_census(const figure_request *request, chart *out, chart_panel *panel, size_t i) {
    if (!has_census(request, i))
        return;
    const figure_census *c = &request->census[i];
    chart_series *s = chart_add_series(out, panel, CHART_POINTS, c->count);
    if (s == NULL)
        return;
    s->style = figure_style(request, i);
    s->behind = true; /* the guarantee may rise to a point in one column, and the point must not hide that */
    snprintf(s->name, sizeof s->name, "%s, census", request->names[i]);
    memcpy(s->x, c->z, c->count * sizeof *s->x);
    memcpy(s->y, c->longest, c->count * sizeof *s->y);
}

const char *interval_build(const figure_request *request, chart *out) {
    dp_setup lattice[CHART_SERIES];
    figure_request cells = *request;
    chart_axis y = {.scale = CHART_LOG, .label = "z-fighting interval", .key = "interval", .unit = "scene units"};
    cells.setups = lattice;
    const size_t changed = with_cells(request, lattice);
    if (changed > 0)
        y.label = "separation, interval";
    chart_panel *panel = envelope_curves(&cells, out, y, widest_cell, true);
    for (size_t i = 0; i < request->count && panel != NULL && !chart_failed(out); i++)
        if (is_fp32(request, i)) {
            into_background(&panel->series[i]);
            add_separation(request, out, panel, i);
        }
    for (size_t i = 0; i < request->count && panel != NULL; i++)
        add_census(request, out, panel, i);
    chart_fit(out);
    if (changed == 0)
        return NULL;
    if (out->title[0] == '\0')
        snprintf(out->title, sizeof out->title, "%s",
                 changed == request->count ? "Guaranteed separation in binary32 arithmetic"
                                           : "Z-fighting interval; in the model fp32, guaranteed separation");
    snprintf(out->subtitle + strlen(out->subtitle), sizeof out->subtitle - strlen(out->subtitle),
             ". Thin: the interval of the lattice alone%s",
             request->census != NULL ? ". Points: the longest interval that there is in each power of two" : "");
    return NULL;
}
