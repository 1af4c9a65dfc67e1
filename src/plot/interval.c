/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "plot/envelope.h"

static double widest_cell(const dp_worst *worst) {
    return worst->interval;
}

const char *interval_build(const figure_request *request, chart *out) {
    chart_axis y = {.scale = CHART_LOG, .label = "z-fighting interval", .key = "interval", .unit = "scene units"};
    envelope_build(request, out, y, widest_cell);
    return NULL;
}
