/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Which cause takes how much: bands that fill the height together, because on a logarithmic axis, which the separation
 * needs, lengths do not add up. The separation itself is a line on an axis of its own.
 */
#include <math.h>
#include <stdio.h>

#include "plot/guaranteed.h"

/* From the axis upwards: first what no arithmetic could do without. */
static const dp_cause stack[DP_CAUSE_COUNT] = {
    DP_CAUSE_FORMAT,      DP_CAUSE_EYE,           DP_CAUSE_NDC,           DP_CAUSE_PROJECTION,
    DP_CAUSE_COMPOSITION, DP_CAUSE_INTERPOLATION, DP_CAUSE_LINEARIZATION, DP_CAUSE_SNAPPING,
    DP_CAUSE_SETUP,       DP_CAUSE_SCALE,         DP_CAUSE_LOG2,          DP_CAUSE_ARGUMENT,
};

/* A cause that nobody asked to count takes no part anywhere. */
static bool counts(const dp_setup *setup, const dp_budget_terms *terms, dp_cause cause) {
    const bool logarithmic = setup->curve == DP_CURVE_LOG;
    const bool divided = !logarithmic || dp_mapping_get(setup->spec.mapping)->ndc_signed;
    return cause == DP_CAUSE_ARGUMENT || cause == DP_CAUSE_LOG2 || cause == DP_CAUSE_SCALE ? logarithmic
           : cause == DP_CAUSE_PROJECTION                                                  ? !logarithmic
           : cause == DP_CAUSE_NDC                                                         ? divided
           : cause == DP_CAUSE_SNAPPING || cause == DP_CAUSE_SETUP ? setup->spec.triangles.width > 0
           : cause == DP_CAUSE_COMPOSITION                         ? terms->world > 0
           : cause == DP_CAUSE_INTERPOLATION                       ? terms->interpolation > 0
           : cause == DP_CAUSE_LINEARIZATION                       ? terms->linearize != 0
                                                                   : true;
}

/* The bands that take part, from the axis upwards, and behind them the separation. */
typedef struct stacked {
    const dp_setup *setup;
    const dp_budget_terms *terms;
    int count;
    int layer[DP_CAUSE_COUNT];
    double certain_to; /* where the separation ends; NaN: with its axis */
} stacked;

_Static_assert((int)DP_CAUSE_COUNT < (int)REFINE_VALUES, "all causes and the separation are sampled at once");

static double separation_at(const void *context, double z) {
    const stacked *s = context;
    dp_budget b = {.separation = NAN};
    dp_budget_at(s->setup, z, s->terms, &b);
    return b.separation;
}

static void sample(const void *context, double from, double to, refine_sample *out) {
    const stacked *s = context;
    dp_budget b = {.separation = NAN};
    (void)to;
    *out = (refine_sample){.step = {0}};
    dp_budget_at(s->setup, from, s->terms, &b);
    double sum = 0; /* the line that is drawn is the upper rim of a band */
    for (int k = 0; k < s->count; k++)
        out->y[k] = sum += isfinite(b.separation) ? 100 * b.cause[stack[s->layer[k]]] / b.separation : (double)NAN;
    out->y[s->count] = from > s->certain_to ? (double)NAN : b.separation;
    /* It jumps where the depth that is a separation away passes a power of two, and back soon: each column counts. */
    out->flicker[s->count] = INFINITY;
}

/* A cause that only a logarithmic depth has takes the colour of one that it lacks. */
static dp_cause lender_of(dp_cause cause) {
    return cause == DP_CAUSE_ARGUMENT ? DP_CAUSE_PROJECTION
           : cause == DP_CAUSE_LOG2   ? DP_CAUSE_COMPOSITION
           : cause == DP_CAUSE_SCALE  ? DP_CAUSE_LINEARIZATION
                                      : cause;
}

/*
 * There are eight colours: the set-up of triangles, on top, has that of a cause that is not counted, first of an
 * interpolation, for which it stands; where all are counted that of the band at the bottom.
 */
static int colour_of(const stacked *s, int layer) {
    static const dp_cause lenders[] = {DP_CAUSE_INTERPOLATION, DP_CAUSE_COMPOSITION, DP_CAUSE_LINEARIZATION};
    for (size_t i = 0; i < sizeof lenders / sizeof lenders[0] && stack[layer] == DP_CAUSE_SETUP; i++)
        for (int k = 0; k < DP_CAUSE_COUNT && !counts(s->setup, s->terms, lenders[i]); k++)
            if (stack[k] == lenders[i])
                return k;
    for (int k = 0; k < DP_CAUSE_COUNT; k++)
        if (stack[k] == lender_of(stack[layer]))
            return k;
    return layer;
}

static void add_bands(chart *out, chart_panel *panel, const stacked *split, const refine *r) {
    for (int k = 0; k < split->count; k++) {
        chart_series *band = envelope_line(out, panel, CHART_AREA, r, k);
        if (band == NULL)
            return;
        band->style.colour = colour_of(split, split->layer[k]);
        snprintf(band->name, sizeof band->name, "%s", dp_cause_name(stack[split->layer[k]]));
    }
    for (int k = split->count - 1; k > 0; k--) /* from rims to thicknesses */
        for (size_t i = 0; i < panel->series[k].count; i++)
            panel->series[k].y[i] -= panel->series[k - 1].y[i];
    chart_series *line = envelope_line(out, panel, CHART_LINE, r, split->count);
    if (line == NULL)
        return;
    line->style.colour = -1;
    line->second = true;
    line->certain_to = split->certain_to;
    snprintf(line->name, sizeof line->name, "separation, right axis");
}

static void add_panel(const figure_request *request, chart *out, size_t i) {
    const chart_axis y = {CHART_LINEAR, 0, 100, "share of the separation", "share", "%", NULL};
    stacked split = {.setup = &request->setups[i], .terms = &request->terms};
    refine r;
    chart_panel *panel = figure_panel(request, out, y);
    panel->second = envelope_axis(QUANTITY_SEPARATION);
    if (request->count > 1)
        snprintf(panel->title, sizeof panel->title, "%s", request->names[i]);
    refine_request q = envelope_request(request, split.setup, out, panel, sample, &split);
    for (int layer = 0; layer < DP_CAUSE_COUNT; layer++)
        if (counts(split.setup, &request->terms, stack[layer]))
            split.layer[split.count++] = layer;
    split.certain_to = guaranteed_certain_to(&q, split.setup, separation_at, &split);
    q.values = split.count + 1;
    if (!refine_begin(&r, &q, out))
        return;
    refine_finish(&r);
    add_bands(out, panel, &split, &r);
}

const char *budget_build(const figure_request *request, chart *out) {
    for (size_t i = 0; i < request->count; i++)
        add_panel(request, out, i);
    chart_fit(out);
    return NULL;
}
