/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdio.h>

#include "plot/envelope.h"

/* The codes below one that are reached: where they are finer than the steps of NDC, as many as there are steps. */
static double reached(const dp_setup *setup, uint32_t code) {
    const dp_format *f = &setup->spec.format;
    const double step = figure_step(setup);
    if (!(step > 0))
        return code;
    const double from = ldexp(step, f->mantissa_bits); /* where codes become as wide as steps */
    const double depth = dp_format_value(f, code), steps = fmin(depth, from) / step;
    const uint32_t at = dp_format_encode(f, DP_ROUND_NEAREST, from);
    return fmin(code < at ? code : at, steps) + (code > at ? code - at : 0);
}

/* Codes are ordered as depths are, forwards or backwards, so the distance of two codes counts what lies between. */
static double distance(const dp_setup *setup, uint32_t a, uint32_t b) {
    return fabs(reached(setup, a) - reached(setup, b));
}

typedef struct counted {
    const dp_setup *setup;
    uint32_t last;
    double all; /* codes between the planes */
} counted;

static void sample(const void *context, double from, double to, refine_sample *out) {
    const counted *c = context;
    (void)to;
    const double left = distance(c->setup, figure_code(c->setup, from), c->last);
    *out = (refine_sample){.y = {c->all > 0 ? 100 * left / c->all : 0}, .step = {left > 0 ? 1 / left : 0}};
}

const char *share_build(const figure_request *request, chart *out) {
    const chart_axis y = {
        .scale = CHART_LOG, .label = "codes between z and far", .key = "share", .unit = "% of all between the planes"};
    chart_panel *panel = figure_panel(request, out, y);
    for (size_t i = 0; i < request->count; i++) {
        const dp_setup *setup = &request->setups[i];
        const uint32_t last = figure_code(setup, setup->spec.zfar);
        const counted c = {setup, last, distance(setup, figure_code(setup, setup->spec.znear), last)};
        const refine_request q = envelope_request(request, setup, out, panel, sample, &c);
        chart_series *s = envelope_curve(out, panel, &q);
        if (s == NULL)
            return NULL;
        s->style = figure_style(request, i);
        snprintf(s->name, sizeof s->name, "%s", request->names[i]);
    }
    chart_fit(out);
    return NULL;
}
