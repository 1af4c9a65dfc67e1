/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Which cause takes how much: bands that fill the height together, because on a logarithmic axis, which the separation
 * needs, lengths do not add up. The separation itself is a line on an axis of its own.
 */
#include <math.h>
#include <stdio.h>

#include "plot/envelope.h"

/* From the axis upwards: first what no arithmetic could do without. */
static const dp_cause stack[DP_CAUSE_COUNT] = {
    DP_CAUSE_FORMAT,      DP_CAUSE_NDC,           DP_CAUSE_PROJECTION,
    DP_CAUSE_COMPOSITION, DP_CAUSE_INTERPOLATION, DP_CAUSE_LINEARIZATION,
};

/* A cause that nobody asked to count takes no part anywhere. */
static bool counts(const dp_budget_terms *terms, dp_cause cause) {
    switch (cause) {
    case DP_CAUSE_COMPOSITION:
        return terms->world > 0;
    case DP_CAUSE_INTERPOLATION:
        return terms->interpolation > 0;
    case DP_CAUSE_LINEARIZATION:
        return terms->linearize != 0;
    default:
        return true;
    }
}

static chart_series *add_band(chart *out, chart_panel *panel, int layer, size_t count) {
    chart_series *s = chart_add_series(out, panel, CHART_AREA, count);
    if (s == NULL)
        return NULL;
    s->style.colour = layer;
    snprintf(s->name, sizeof s->name, "%s", dp_cause_name(stack[layer]));
    return s;
}

static void add_panel(const figure_request *request, chart *out, size_t i, int steps) {
    const dp_setup *setup = &request->setups[i];
    chart_series *bands[DP_CAUSE_COUNT] = {NULL};
    double lo, hi;
    figure_range(request, &lo, &hi);
    chart_panel *panel = chart_add_panel(out);
    if (panel == NULL)
        return;
    panel->x = figure_depth_axis(CHART_LOG, lo, hi);
    panel->y = (chart_axis){CHART_LINEAR, 0, 100, "share of the separation", "share", "%", NULL};
    panel->second =
        (chart_axis){.scale = CHART_LOG, .label = "guaranteed separation", .key = "separation", .unit = "scene units"};
    if (request->count > 1)
        snprintf(panel->title, sizeof panel->title, "%s", request->names[i]);
    for (int layer = 0; layer < DP_CAUSE_COUNT; layer++)
        if (counts(&request->terms, stack[layer]))
            bands[layer] = add_band(out, panel, layer, (size_t)steps + 1);
    chart_series *line = chart_add_series(out, panel, CHART_LINE, (size_t)steps + 1);
    if (line == NULL || chart_failed(out))
        return;
    line->style.colour = -1;
    line->second = true;
    snprintf(line->name, sizeof line->name, "separation, right axis");
    for (int k = 0; k <= steps; k++) {
        dp_budget b = {.separation = NAN};
        const double z = envelope_edge(CHART_LOG, lo, hi, k, steps);
        dp_budget_at(setup, z, &request->terms, &b);
        line->x[k] = z;
        line->y[k] = b.separation;
        for (int layer = 0; layer < DP_CAUSE_COUNT; layer++)
            if (bands[layer] != NULL) {
                bands[layer]->x[k] = z;
                bands[layer]->y[k] = isfinite(b.separation) ? 100 * b.cause[stack[layer]] / b.separation : (double)NAN;
            }
    }
}

const char *budget_build(const figure_request *request, chart *out) {
    const int steps = (int)fmax(40, request->columns / sqrt((double)request->count));
    for (size_t i = 0; i < request->count; i++)
        add_panel(request, out, i, steps);
    chart_fit(out);
    return NULL;
}
