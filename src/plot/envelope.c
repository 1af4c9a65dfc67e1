/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "plot/envelope.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "core/elementary.h"
#include "draw/ticks.h"

/* The greatest error that any depth of z's cell has. */
static double cell_error(const dp_setup *setup, double z) {
    dp_cell cell = dp_cell_of(setup, dp_code(setup, z));
    if (isinf(cell.hi))
        return INFINITY;
    return fmax(fabs(dp_error(setup, cell.code, cell.lo)), fabs(dp_error(setup, cell.code, cell.hi)));
}

/* How much neighbouring cells differ, relatively: a width goes with the square of z at most. Depths of 0 and less are
 * orthographic, with cells alike. */
static double step_of(const dp_worst *w) {
    return w->interval_lo <= 0 ? 0 : 2 * (w->interval_hi - w->interval_lo) / w->interval_lo;
}

/* A staged cell holds a whole number of binary32 steps, now one more, now one less: of a float in turns, so that three
 * cells show both. */
static double flicker_of(const dp_setup *setup, const dp_worst *w, double length) {
    const bool in_turns = setup->spec.format.kind == DP_FORMAT_FLOAT && 3 * (w->interval_hi - w->interval_lo) < length;
    if (setup->spec.model != DP_MODEL_STAGED || in_turns || isinf(w->interval))
        return 0;
    const double a = dp_window(setup, w->interval_lo), b = dp_window(setup, w->interval_hi);
    const double step = dp_mapping_get(setup->spec.mapping)->ndc_signed ? 0x1p-24 : ldexp(1.0, ilogb(fmax(a, b)) - 23);
    return step / fabs(a - b);
}

/* The cells at both ends of a slice count whole: the error of a depth depends on where in its cell it lies, and that
 * is chance. So the curve runs along the tops of the teeth, as the interval does, in place of a thicket of them. */
void envelope_slice(const dp_setup *setup, double from, double to, quantity_kind q, refine_sample *out) {
    dp_worst worst;
    if (dp_worst_over(setup, from, to, &worst) != DP_OK) {
        *out = (refine_sample){.y = {(double)NAN}};
        return;
    }
    worst.error = fmax(worst.error, fmax(cell_error(setup, from), cell_error(setup, to)));
    *out = (refine_sample){.y = {quantity_get(q)->of_cells(&worst)},
                           .step = {step_of(&worst)},
                           .flicker = {flicker_of(setup, &worst, to - from)}};
}

/* The guarantee of binary32 arithmetic is a whole number of binary32 steps of z, now one more, now one less. Within a
 * separation it goes up and down by what it gains over some: where a column is no wider, the worst in it depends on
 * where the column lies. */
static double flicker_of_separation(const dp_setup *setup, double z, double width, double separation) {
    const double steps = setup->spec.model == DP_MODEL_EXACT ? 0 : 2;
    const double rounded = steps * ldexp(1.0, ilogb(z) - 23) / separation;
    const bool within = width > 0 && 2 * separation > width;
    return isinf(separation) ? 0 : within ? fmax(rounded, 2 * separation / z) : rounded;
}

void envelope_separation(const void *setup, double from, double to, refine_sample *out) {
    const double bound = quantity_bound(QUANTITY_SEPARATION, setup, from, to);
    const double size = from > 0 ? from : fmax(-from, to);
    *out = (refine_sample){.y = {bound}, .flicker = {flicker_of_separation(setup, size, to - from, bound)}};
}

/* ---- Knots ------------------------------------------------------------------------------------------------------- */

typedef struct knot_list {
    double *at;
    size_t count;
} knot_list;

static void add_knot(knot_list *k, double z) {
    if (k->count < REFINE_KNOTS)
        k->at[k->count++] = z;
}

/* The step of a float halves at every power of two of d. */
static void add_binades(knot_list *k, const dp_setup *setup, int most) {
    for (int i = 0; i <= most; i++)
        add_knot(k, dp_eye(setup, ldexp(1.0, -i), 1 - ldexp(1.0, -i)));
}

/* Eye depths have powers of two of their own, and so have A z and A z + B of the projection. */
static void add_clip_binades(knot_list *k, const dp_setup *setup, double hi) {
    const dp_spec *spec = &setup->spec;
    const double phi = isinf(spec->zfar) ? 0 : spec->znear / spec->zfar;
    const dp_mapping_row *row = dp_mapping_get(spec->mapping); /* whose direction a viewport does not change */
    const double a = row->ndc_signed ? 1 + phi : row->reversed ? -phi : 1; /* times 1/(1 - phi) or its negative, as b */
    const double b = row->ndc_signed ? -2 * spec->znear : row->reversed ? spec->znear : -spec->znear;
    const bool either_sign = spec->znear <= 0;
    const double most = either_sign ? fmax(-spec->znear, fabs(hi)) : hi;
    for (int e = ilogb(either_sign ? most : spec->znear) - 24; e <= ilogb(most); e++) {
        const double power = ldexp(1.0, e), scaled = power * (1 - phi);
        add_knot(k, power);
        if (either_sign)
            add_knot(k, -power);
        if (a == 0 || spec->ortho)
            continue;
        add_knot(k, scaled / fabs(a));
        add_knot(k, (scaled - b) / a);
        add_knot(k, (-scaled - b) / a);
    }
}

static size_t find_knots(const dp_setup *setup, double hi, double at[REFINE_KNOTS]) {
    const dp_spec *spec = &setup->spec;
    const bool rounded = spec->model != DP_MODEL_EXACT;
    knot_list k = {at, 0};
    if (spec->format.kind == DP_FORMAT_FLOAT || rounded)
        add_binades(&k, setup, rounded ? 150 : spec->format.bias + 1);
    if (spec->model == DP_MODEL_FLOAT)
        add_clip_binades(&k, setup, hi);
    return k.count;
}

refine_request envelope_request(const figure_request *request, const dp_setup *setup, chart *out,
                                const chart_panel *panel, refine_function *sample, const void *context) {
    double *knots = chart_memory(out, REFINE_KNOTS, sizeof *knots);
    return (refine_request){.scale = panel->x.scale,
                            .lo = panel->x.lo,
                            .hi = panel->x.hi,
                            .columns = request->columns,
                            .rows = request->rows,
                            .every = request->every,
                            .values = 1,
                            .axis = {panel->y},
                            .knots = knots,
                            .knot_count = knots != NULL ? find_knots(setup, panel->x.hi, knots) : 0,
                            .sample = sample,
                            .context = context};
}

/* ---- Curves ------------------------------------------------------------------------------------------------------ */

chart_axis envelope_axis(quantity_kind q) {
    const quantity_row *row = quantity_get(q);
    return (chart_axis){.scale = CHART_LOG, .label = row->axis, .key = row->name, .unit = row->unit};
}

bool envelope_way(const dp_setup *setup, double tolerance, way *out) {
    if (!(tolerance > 0) || setup->spec.model == DP_MODEL_FLOAT)
        return false;
    *out = way_choose(setup, tolerance, false);
    return out->row != NULL && strcmp(out->name, "cell") != 0;
}

bool envelope_is_cut(const dp_setup *setup, double z) {
    const uint32_t code = dp_code(setup, z);
    return code == dp_code(setup, setup->spec.znear) || code == dp_code(setup, setup->spec.zfar);
}

typedef struct curve {
    const dp_setup *setup;
    quantity_kind q;
    bool by_way;
    way way;
} curve;

/* By a way: a column is too narrow for the interval to change by more than its ends do. */
static void sample(const void *context, double from, double to, refine_sample *out) {
    const curve *c = context;
    if (!c->by_way || envelope_is_cut(c->setup, from) || envelope_is_cut(c->setup, to))
        envelope_slice(c->setup, from, to, c->q, out);
    else
        *out = (refine_sample){.y = {fmax(way_interval(&c->way, c->setup, from), way_interval(&c->way, c->setup, to))}};
}

chart_series *envelope_line(chart *out, chart_panel *panel, chart_kind kind, const refine *r, int value) {
    chart_series *s = chart_add_series(out, panel, kind, r->points);
    if (s != NULL)
        refine_take(r, value, s->x, s->y);
    return s;
}

chart_series *envelope_curve(chart *out, chart_panel *panel, const refine_request *request) {
    refine r;
    if (!refine_begin(&r, request, out))
        return NULL;
    refine_finish(&r);
    return envelope_line(out, panel, CHART_LINE, &r, 0);
}

static void add_curve(const figure_request *request, chart *out, chart_panel *panel, size_t i, const curve *c,
                      refine *r) {
    dp_worst worst;
    refine_finish(r);
    chart_series *s = envelope_line(out, panel, CHART_LINE, r, 0);
    if (s == NULL)
        return;
    s->style = figure_style(request, i);
    s->method = c->by_way ? c->way.name : NULL;
    snprintf(s->name, sizeof s->name, "%s", request->names[i]);
    if (dp_worst_over(c->setup, panel->x.lo, panel->x.hi, &worst) == DP_OK && !isnan(worst.blind_from)) {
        char text[TICKS_TEXT];
        ticks_label(worst.blind_from, worst.blind_from >= 1e6, text);
        snprintf(s->note, sizeof s->note, " (blind from %s)", text);
    }
}

chart_panel *envelope_curves(const figure_request *request, chart *out, quantity_kind q) {
    chart_panel *panel = figure_panel(request, out, envelope_axis(q));
    curve *curves = chart_memory(out, request->count, sizeof *curves);
    refine *refined = chart_memory(out, request->count, sizeof *refined);
    if (curves == NULL || refined == NULL)
        return NULL;
    for (size_t i = 0; i < request->count; i++) {
        curves[i] = (curve){.setup = &request->setups[i], .q = q};
        refine_request asked = envelope_request(request, curves[i].setup, out, panel, sample, &curves[i]);
        asked.slices = true;
        if (!refine_begin(&refined[i], &asked, out))
            return panel;
    }
    refine_share_axis(refined, request->count);
    for (size_t i = 0; i < request->count; i++) {
        /* Differences that the axis cannot show need not be computed: half of them are left to the line. */
        const bool unsaid = isnan(request->tolerance);
        const double tolerance = unsaid ? dp_expm1(refine_half_pixel(&refined[i], 0) / 2) : request->tolerance;
        curves[i].by_way = q == QUANTITY_INTERVAL && envelope_way(curves[i].setup, tolerance, &curves[i].way);
        add_curve(request, out, panel, i, &curves[i], &refined[i]);
    }
    return panel;
}
