/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdio.h>

#include "plot/envelope.h"

/* Codes are ordered as depths are, forwards or backwards, so the distance of two codes counts what lies between. */
static double distance(uint32_t a, uint32_t b) {
    return fabs((double)a - (double)b);
}

const char *share_build(const figure_request *request, chart *out) {
    chart_panel *panel = chart_add_panel(out);
    if (panel == NULL)
        return NULL;
    double lo, hi;
    figure_range(request, &lo, &hi);
    panel->x = figure_depth_axis(CHART_LOG, lo, hi);
    panel->y =
        (chart_axis){CHART_LINEAR, 0, 100, "codes between near and z", "share", "% of all between the planes", NULL};
    for (size_t i = 0; i < request->count; i++) {
        const dp_setup *setup = &request->setups[i];
        uint32_t near_code = dp_code(setup, setup->spec.znear);
        double all = distance(dp_code(setup, setup->spec.zfar), near_code);
        chart_series *s = chart_add_series(out, panel, CHART_LINE, (size_t)request->columns + 1);
        if (s == NULL)
            return NULL;
        s->style = figure_style(request, i);
        snprintf(s->name, sizeof s->name, "%s", request->names[i]);
        for (int k = 0; k <= request->columns; k++) {
            s->x[k] = envelope_edge(CHART_LOG, lo, hi, k, request->columns);
            s->y[k] = all > 0 ? 100 * distance(dp_code(setup, s->x[k]), near_code) / all : 0;
        }
    }
    return NULL;
}
