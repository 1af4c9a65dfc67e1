/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "plot/envelope.h"

static double worst_error(const dp_worst *worst) {
    return worst->error;
}

const char *error_build(const figure_request *request, chart *out) {
    chart_axis y = {.scale = CHART_LOG, .label = "worst |stored \u2212 z|", .key = "error", .unit = "scene units"};
    envelope_build(request, out, y, worst_error);
    return NULL;
}
