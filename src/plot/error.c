/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "plot/envelope.h"

const char *error_build(const figure_request *request, chart *out) {
    const chart_axis y = {
        .scale = CHART_LOG, .label = "worst |decoded depth \u2212 z|", .key = "error", .unit = "scene units"};
    envelope_curves(request, out, y, envelope_error, false);
    chart_fit(out);
    return NULL;
}
