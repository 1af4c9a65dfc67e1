/* SPDX-License-Identifier: MIT */
/* Which model is enough: judged by the separation, which every model has. */
#include <math.h>

#include "core/engine.h"
#include "depthprec/budget.h"

/*
 * By so much a depth itself is rounded: a cell below it, as at a plane whose code is 0, tells no two apart. Around an
 * orthographic camera's own place it is that of depths 2^24 times nearer than a plane.
 */
static double rounding_of(const dp_spec *spec, double z) {
    const double plane = -spec->znear > fabs(spec->zfar) ? -spec->znear : fabs(spec->zfar);
    const double least = spec->znear > 0.0 ? 0x1p-126 : 0x1p-24 * plane;
    return dp_half_ulp(fabs(z) < least ? least : fabs(z));
}

/* The share by which `part` falls short of `whole`: of itself, or of the depths' rounding where that is larger. */
static double missing_share(double part, double rounding, double whole) {
    part = part < rounding ? rounding : part;
    return isinf(part) || whole <= part ? 0.0 : whole / part - 1.0;
}

dp_status dp_model_choose(const dp_setup *setup, const double *z, size_t count, double tolerance, dp_choice *out) {
    if (setup == NULL || z == NULL || out == NULL || count == 0)
        return DP_ERROR_NULL;
    for (size_t i = 0; i < count; i++)
        if (!(z[i] >= setup->spec.znear && z[i] <= setup->spec.zfar))
            return DP_ERROR_DEPTH;

    dp_setup model[DP_MODEL_COUNT];
    int has[DP_MODEL_COUNT];
    int fullest = DP_MODEL_EXACT;
    dp_choice choice = {0};
    for (int m = 0; m < DP_MODEL_COUNT; m++) {
        has[m] = dp_setup_in(setup, (dp_model)m, &model[m]);
        fullest = has[m] ? m : fullest;
        choice.share[m] = has[m] ? 0.0 : (double)NAN;
        choice.share_z[m] = z[0];
    }
    for (size_t i = 0; i < count; i++) {
        const double whole = dp_separation(&model[fullest], z[i]);
        for (int m = 0; m < fullest; m++) {
            if (!has[m]) /* no viewport that moves depth has staged */
                continue;
            const double share = missing_share(dp_separation(&model[m], z[i]), rounding_of(&setup->spec, z[i]), whole);
            if (share > choice.share[m]) {
                choice.share[m] = share;
                choice.share_z[m] = z[i];
            }
        }
    }
    int chosen = DP_MODEL_EXACT;
    while (chosen < fullest && !(has[chosen] && choice.share[chosen] <= tolerance))
        chosen++;
    choice.model = (dp_model)chosen;
    *out = choice;
    return DP_OK;
}
