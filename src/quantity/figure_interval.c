/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The z-fighting interval of the cells of a model; or the guaranteed separation over the interval of the lattice.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "camera/surfaces.h"
#include "core/append.h"
#include "plot/guaranteed.h"
#include "zfight/census.h"

/* Findings of a census of one set-up: the longest interval of each band, at its nearer depth. */
typedef struct found {
    size_t count;
    double z[CENSUS_BANDS_MAX], longest[CENSUS_BANDS_MAX];
} found;

/* Bands without an interval have no point. */
static bool count_one(const dp_setup *setup, const chart_axis *x, census_result *result, found *f) {
    const census_request q = {.setup = setup, .lo = x->lo, .hi = x->hi};
    if (census_run(&q, result) != CENSUS_DONE)
        return false;
    for (int b = 0; b < result->band_count; b++)
        if (result->bands[b].longest > 0) {
            f->z[f->count] = result->bands[b].longest_z;
            f->longest[f->count++] = result->bands[b].longest;
        }
    return true;
}

static bool has_census(const figure_request *request, size_t i) {
    return request->setups[i].spec.model == DP_MODEL_FLOAT;
}

/* A census of every set-up of the model float, when its depths are few enough; null: none of them has one. */
static found *count_all(const figure_request *request, const chart_axis *x, chart *out) {
    enum { SETUPS_MAX = 10 }; /* more points than that hide each other */
    const uint64_t visited = census_count(x->lo, x->hi);
    size_t count = 0;
    for (size_t i = 0; i < request->count; i++)
        count += has_census(request, i);
    if (request->count > SETUPS_MAX || count == 0 || visited < 2 || visited > request->census)
        return NULL;
    census_result *result = chart_memory(out, 1, sizeof *result);
    found *all = chart_memory(out, request->count, sizeof *all);
    for (size_t i = 0; i < request->count && !chart_failed(out); i++)
        if (has_census(request, i) && !count_one(&request->setups[i], x, result, &all[i]))
            chart_fail(out);
    return all;
}

static void add_separation(const figure_request *request, chart *out, chart_panel *panel, size_t i, const found *f) {
    const dp_setup setup = dp_setup_facing(&request->setups[i]);
    chart_series *s = guaranteed_add(request, out, panel, i, &setup, NULL);
    if (s != NULL && f != NULL && f->count > 0)
        s->style.marker = -1; /* its points have it */
}

/* In the colour of the facing one, above it, and with a stroke that no facing one has. */
static void add_slanted(const figure_request *request, chart *out, chart_panel *panel, size_t i) {
    const dp_spec *spec = &request->setups[i].spec;
    if (spec->triangles.width == 0 || spec->model != DP_MODEL_FLOAT)
        return;
    chart_series *s = guaranteed_add(request, out, panel, i, &request->setups[i], NULL);
    if (s == NULL)
        return;
    int strokes = 0;
    for (size_t k = 0; k < request->count; k++)
        strokes = figure_style(request, k).stroke >= strokes ? figure_style(request, k).stroke + 1 : strokes;
    s->style.stroke += strokes;
    s->style.marker = -1;
    append(s->name, sizeof s->name, ", %s", surfaces_words(&spec->triangles).text);
}

/* The longest intervals that there are, each where it begins: none of them lies above the guarantee. */
static void add_census(const figure_request *request, chart *out, chart_panel *panel, size_t i, const found *f) {
    chart_series *s = f->count > 0 ? chart_add_series(out, panel, CHART_POINTS, f->count) : NULL;
    if (s == NULL)
        return;
    s->style = figure_style(request, i);
    s->behind = true; /* the guarantee may rise to a point in one column, and the point must not hide that */
    snprintf(s->name, sizeof s->name, "%s, census", request->names[i]);
    memcpy(s->x, f->z, f->count * sizeof *s->x);
    memcpy(s->y, f->longest, f->count * sizeof *s->y);
}

const char *interval_build(const figure_request *request, chart *out) {
    bool all = true;
    chart_panel *panel = guaranteed_begin(request, out, QUANTITY_INTERVAL);
    if (panel == NULL)
        return NULL;
    const found *counted = count_all(request, &panel->x, out);
    for (size_t i = 0; i < request->count && !chart_failed(out); i++) {
        add_separation(request, out, panel, i, counted != NULL ? &counted[i] : NULL);
        add_slanted(request, out, panel, i);
        all = all && guaranteed_has(request, i);
        panel->y.label = guaranteed_has(request, i) ? "separation, interval" : panel->y.label;
    }
    for (size_t i = 0; i < request->count && counted != NULL; i++)
        add_census(request, out, panel, i, &counted[i]);
    guaranteed_end(request, out,
                   all ? "Guaranteed separation" : "Z-fighting interval; in the model float, guaranteed separation");
    if (counted != NULL)
        append(out->subtitle, sizeof out->subtitle,
               ". Points: the longest interval that there is in each power of two");
    return NULL;
}
