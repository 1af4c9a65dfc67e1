/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The error of the decoded depth: of the cells of a model; or what is guaranteed of depths that are computed in
 * binary32, over that of the lattice.
 */
#include <math.h>

#include "core/engine.h"
#include "plot/guaranteed.h"

/* Never below the lattice, whose cells count whole: see envelope_slice(). */
static void sample(const void *context, double from, double to, refine_sample *out) {
    const dp_setup *setup = context;
    dp_setup lattice = *setup;
    dp_spec spec = setup->spec;
    double z;
    spec.model = DP_MODEL_EXACT;
    const bool computed = dp_is_computed(setup) && dp_setup_init(&lattice, &spec) == DP_OK;
    envelope_slice(&lattice, from, to, envelope_error, out);
    if (computed)
        out->y[0] = fmax(out->y[0], dp_computed_error_over(setup, from, to, &z));
}

const char *error_build(const figure_request *request, chart *out) {
    const chart_axis y = {
        .scale = CHART_LOG, .label = "worst |decoded depth \u2212 z|", .key = "error", .unit = "scene units"};
    chart_panel *panel = guaranteed_begin(request, out, y, y.label, envelope_error, false);
    for (size_t i = 0; i < request->count; i++)
        guaranteed_add(request, out, panel, i, &request->setups[i], sample);
    guaranteed_end(request, out, "Guaranteed error of the decoded depth");
    return NULL;
}
