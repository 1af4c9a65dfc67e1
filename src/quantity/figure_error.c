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
    const bool computed = dp_is_computed(setup) && dp_setup_in(setup, DP_MODEL_EXACT, &lattice);
    envelope_slice(&lattice, from, to, QUANTITY_ERROR, out);
    if (computed)
        out->y[0] = fmax(out->y[0], quantity_bound(QUANTITY_ERROR, setup, from, to));
}

const char *error_build(const figure_request *request, chart *out) {
    chart_panel *panel = guaranteed_begin(request, out, QUANTITY_ERROR);
    for (size_t i = 0; i < request->count; i++)
        guaranteed_add(request, out, panel, i, &request->setups[i], sample);
    guaranteed_end(request, out, "Guaranteed error of the decoded depth");
    return NULL;
}
