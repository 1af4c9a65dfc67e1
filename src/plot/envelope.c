/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "plot/envelope.h"

#include <math.h>
#include <stdio.h>

#include "plot/ticks.h"

double envelope_edge(chart_scale scale, double lo, double hi, int i, int count) {
    if (i <= 0)
        return lo;
    if (i >= count)
        return hi;
    chart_axis axis = {.scale = scale, .lo = lo, .hi = hi};
    return fmin(fmax(chart_axis_at(&axis, (double)i / count), lo), hi);
}

/* The greatest error that any depth of z's cell has. */
static double cell_error(const dp_setup *setup, double z) {
    dp_cell cell = dp_cell_of(setup, dp_code(setup, z));
    if (isinf(cell.hi))
        return INFINITY;
    return fmax(fabs(dp_error(setup, cell.code, cell.lo)), fabs(dp_error(setup, cell.code, cell.hi)));
}

/* The cells at both ends of a slice count whole: the error of a depth depends on where in its cell it lies, and that
 * is chance. So the curve runs along the tops of the teeth, as the interval does, in place of a thicket of them. */
static double slice(const dp_setup *setup, double from, double to, envelope_value value) {
    dp_worst worst;
    if (dp_worst_over(setup, from, to, &worst) != DP_OK)
        return NAN;
    worst.error = fmax(worst.error, fmax(cell_error(setup, from), cell_error(setup, to)));
    return value(&worst);
}

static void add_curve(const figure_request *request, chart *out, chart_panel *panel, size_t i, envelope_value value) {
    const dp_setup *setup = &request->setups[i];
    double lo = panel->x.lo, hi = panel->x.hi;
    chart_series *s = chart_add_series(out, panel, CHART_LINE, (size_t)request->columns);
    if (s == NULL)
        return;
    s->style = figure_style(request, i);
    snprintf(s->name, sizeof s->name, "%s", request->names[i]);
    dp_worst worst;
    double from = lo;
    for (int k = 0; k < request->columns; k++) {
        double to = envelope_edge(CHART_LOG, lo, hi, k + 1, request->columns);
        s->x[k] = sqrt(from) * sqrt(to);
        s->y[k] = slice(setup, from, to, value);
        from = to;
    }
    if (dp_worst_over(setup, lo, hi, &worst) == DP_OK && !isnan(worst.blind_from)) {
        char text[TICKS_TEXT];
        ticks_label(worst.blind_from, worst.blind_from >= 1e6, text);
        snprintf(s->note, sizeof s->note, " (blind from %s)", text);
    }
}

chart_panel *envelope_curves(const figure_request *request, chart *out, chart_axis y, envelope_value value) {
    chart_panel *panel = chart_add_panel(out);
    if (panel == NULL)
        return NULL;
    double lo, hi;
    figure_range(request, &lo, &hi);
    panel->x = figure_depth_axis(CHART_LOG, lo, hi);
    panel->y = y;
    for (size_t i = 0; i < request->count; i++)
        add_curve(request, out, panel, i, value);
    return panel;
}

void envelope_build(const figure_request *request, chart *out, chart_axis y, envelope_value value) {
    envelope_curves(request, out, y, value);
    chart_fit(out);
}
