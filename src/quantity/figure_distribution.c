/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdio.h>

#include "plot/envelope.h"

/* A linear axis shows the picture of the textbooks, but not beyond a factor of a hundred; only it has 0. */
static chart_scale scale_of(double lo, double hi) {
    return !(lo > 0) || hi / lo <= 100 ? CHART_LINEAR : CHART_LOG;
}

/* An infinite far ends a little behind the depth from which nothing is told apart, seen by the farthest sighted. */
static void staircase_range(const figure_request *request, double *lo, double *hi) {
    figure_range(request, lo, hi);
    if (!isnan(request->hi) || !isinf(request->setups[0].spec.zfar))
        return;
    double end = 0;
    for (size_t i = 0; i < request->count; i++) {
        dp_worst worst;
        if (dp_worst_over(&request->setups[i], *lo, INFINITY, &worst) == DP_OK && !isnan(worst.blind_from))
            end = fmax(end, worst.blind_from);
    }
    if (end > *lo)
        *hi = end * (scale_of(*lo, 1.15 * end) == CHART_LINEAR ? 1.15 : 2);
}

static bool is_reached(const dp_setup *setup, uint32_t code) {
    const double step = figure_step(setup);
    return !(step > 0) || fmod(dp_format_value(&setup->spec.format, code), step) == 0;
}

/* From near to far. */
static uint32_t reached(const dp_setup *setup) {
    const uint32_t a = dp_code(setup, setup->spec.znear), b = dp_code(setup, setup->spec.zfar);
    uint32_t count = 0;
    for (uint32_t code = a < b ? a : b; code <= (a < b ? b : a); code++)
        count += is_reached(setup, code);
    return count;
}

static void add_codes(const figure_request *request, chart *out, chart_panel *panel, size_t i) {
    const dp_setup *setup = &request->setups[i];
    uint32_t a = dp_code(setup, panel->x.lo), b = dp_code(setup, panel->x.hi);
    uint32_t first = a < b ? a : b, last = a < b ? b : a;
    chart_series *s = chart_add_series(out, panel, CHART_DROPS, (size_t)(last - first) + 1);
    if (s == NULL)
        return;
    s->style.colour = 1;
    snprintf(s->name, sizeof s->name, "codes and their decoded depths");
    s->count = 0;
    for (uint32_t code = first; code <= last; code++) {
        double z = dp_stored(setup, code);
        if (!(z >= panel->x.lo && z <= panel->x.hi) || !is_reached(setup, code))
            continue;
        s->x[s->count] = z;
        s->y[s->count++] = dp_format_value(&setup->spec.format, code);
    }
}

static void window(const void *context, double from, double to, refine_sample *out) {
    (void)to;
    *out = (refine_sample){.y = {dp_window(context, from)}};
}

static void add_curve(const figure_request *request, chart *out, chart_panel *panel, size_t i) {
    const dp_setup *setup = &request->setups[i];
    refine_request q = envelope_request(request, setup, out, panel, window, setup);
    q.knot_count = 0; /* it is smooth */
    q.every = false;  /* codes have their own depths */
    chart_series *s = envelope_curve(out, panel, &q);
    if (s != NULL)
        snprintf(s->name, sizeof s->name, "window depth d(z)");
}

static void build_staircases(const figure_request *request, chart *out) {
    const chart_axis y = {CHART_LINEAR, 0, 1, "window depth d", "depth", "", NULL};
    double lo, hi;
    staircase_range(request, &lo, &hi);
    for (size_t i = 0; i < request->count; i++) {
        chart_panel *panel = figure_panel(request, out, y);
        panel->x.scale = scale_of(lo, hi);
        panel->x.lo = lo;
        panel->x.hi = hi;
        const uint32_t all = request->setups[i].spec.format.code_max + 1, met = reached(&request->setups[i]);
        char of[24] = "";
        if (met < all)
            snprintf(of, sizeof of, "%u of ", met);
        snprintf(panel->title, sizeof panel->title, "%s, %s%u codes", request->names[i], of, all);
        add_codes(request, out, panel, i);
        add_curve(request, out, panel, i);
    }
}

const char *distribution_build(const figure_request *request, chart *out) {
    size_t small = 0;
    for (size_t i = 0; i < request->count; i++)
        small += figure_draws_codes(&request->setups[i].spec.format);
    if (small == request->count) {
        if (small > CHART_PANELS)
            return "--format, --mapping: must make at most 8 set-ups for staircases";
        build_staircases(request, out);
        return NULL;
    }
    envelope_curves(request, out, QUANTITY_DENSITY);
    chart_fit(out);
    return NULL;
}
