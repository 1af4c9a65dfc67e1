/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by figures: styles of set-ups, ranges, panels. */
#include "plot/figure.h"

#include <math.h>
#include <string.h>

#include "draw/theme.h"

/* The first set-up with the format (or mapping) of set-up i. */
static size_t first_alike(const figure_request *r, size_t i, bool mapping) {
    const dp_spec *asked = &r->setups[i].spec;
    size_t k = 0;
    while (mapping ? r->setups[k].spec.mapping != asked->mapping
                   : strcmp(r->setups[k].spec.format.name, asked->format.name) != 0)
        k++;
    return k;
}

/* How many different formats (or mappings) the first `count` set-ups have. */
static int kinds(const figure_request *r, size_t count, bool mapping) {
    int found = 0;
    for (size_t i = 0; i < count; i++)
        found += first_alike(r, i, mapping) == i;
    return found;
}

/* Odd ones, with hollow markers, are those of reversed mappings. */
static int stroke_of(const figure_request *r, size_t i) {
    const size_t first = first_alike(r, i, true);
    int before = 0;
    for (size_t k = 0; k < first; k++)
        before += first_alike(r, k, true) == k && r->setups[k].reversed == r->setups[i].reversed;
    return THEME_DOTTED * before + (r->setups[i].reversed != 0 ? THEME_REVERSED : THEME_SOLID);
}

chart_style figure_style(const figure_request *request, size_t i) {
    const int formats = kinds(request, request->count, false);
    const bool own = formats == 1 || kinds(request, request->count, true) == 1;
    const int colour = own ? (int)i : kinds(request, first_alike(request, i, false), false);
    return (chart_style){
        colour, (size_t)formats < request->count ? stroke_of(request, i) : THEME_DOTTED * (colour / THEME_COLOURS),
        colour, false};
}

bool figure_draws_codes(const dp_format *format) {
    return format->code_max < 128; /* the most lines that can be told apart in one frame */
}

double figure_step(const dp_setup *setup) {
    const dp_format *f = &setup->spec.format;
    const bool stepped = setup->spec.model != DP_MODEL_EXACT && dp_mapping_get(setup->spec.mapping)->ndc_signed &&
                         f->kind == DP_FORMAT_FLOAT;
    return stepped ? ldexp(1, -2 - (figure_draws_codes(f) ? f->mantissa_bits : 23)) : 0;
}

uint32_t figure_code(const dp_setup *setup, double z) {
    const dp_format *f = &setup->spec.format;
    if (!(figure_step(setup) > 0) || !figure_draws_codes(f))
        return dp_code(setup, z);
    const double real = 2 * dp_window(setup, z) - 1;
    const double ndc = dp_format_value(f, dp_format_encode(f, setup->spec.rounding, fabs(real)));
    return dp_format_encode(f, setup->spec.rounding, 0.5 + 0.5 * copysign(ndc, real));
}

void figure_range(const figure_request *request, double *lo, double *hi) {
    const dp_spec *spec = &request->setups[0].spec;
    *lo = isnan(request->lo) ? spec->znear : request->lo;
    *hi = isnan(request->hi) ? spec->zfar : request->hi;
    if (isinf(*hi))
        *hi = fmax(spec->znear * 1e6, *lo * 1e3);
}

chart_panel *figure_panel(const figure_request *request, chart *out, chart_axis y) {
    chart_panel *panel = chart_add_panel(out);
    panel->x = (chart_axis){.label = "eye depth z", .key = "z", .unit = "scene units"};
    figure_range(request, &panel->x.lo, &panel->x.hi);
    panel->x.scale = panel->x.lo > 0 ? CHART_LOG : CHART_LINEAR;
    panel->y = y;
    return panel;
}
