/* SPDX-License-Identifier: MIT */
/* One depth in any model: its code, error, cell and separation. */
#include <math.h>

#include "core/engine.h"
#include "core/guarantee.h"
#include "depthprec/depth.h"

double dp_separation(const dp_setup *setup, double z) {
    const dp_guarantee g = dp_guarantee_make(setup);
    return dp_guarantee_at(&g, z);
}

dp_status dp_sample_at(const dp_setup *setup, double z, dp_sample *out) {
    if (setup == NULL || out == NULL)
        return DP_ERROR_NULL;
    if (!(z >= setup->spec.znear && z <= setup->spec.zfar))
        return DP_ERROR_DEPTH;
    if (setup->spec.model == DP_MODEL_FLOAT && isinf((float)z) && !isinf(z))
        return DP_ERROR_BINARY32;
    const uint32_t code = dp_code(setup, z);
    const dp_cell cell = dp_cell_of(setup, code);
    *out = (dp_sample){
        .z = z,
        .code = code,
        .depth = dp_window(setup, z),
        .stored = cell.stored,
        .error = dp_error(setup, code, z),
        .lo = cell.lo,
        .hi = cell.hi,
        .interval = cell.width,
        .separation = dp_separation(setup, z),
    };
    return DP_OK;
}
