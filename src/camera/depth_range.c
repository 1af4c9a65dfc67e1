/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "camera/depth_range.h"

#include <math.h>

bool camera_range_moves(const double range[2]) {
    return range[0] != 0.0 || (range[1] != 0.0 && range[1] != 1.0);
}

/* 0, or so large that binary32 has many numbers there. */
static bool is_end(double d) {
    return d == 0.0 || (d >= 1e-6 && d <= 1.0);
}

bool camera_range_takes(const char *api, const double range[2], camera_fault *fault) {
    if (!camera_range_moves(range))
        return true;
    if (is_end(range[0]) && is_end(range[1]) && fabs(range[1] - range[0]) >= 1e-6)
        return camera_range_suits(api != NULL ? bias_api_find(api) : NULL, range, fault);
    return camera_fails(fault, "depth_range",
                        "must be two window depths, each 0 or from 1e-6 to 1, and at least 1e-6 apart, got %g and %g",
                        range[0], range[1]);
}

bool camera_range_suits(const bias_api *api, const double range[2], camera_fault *fault) {
    return api == NULL || !api->rising || range[0] <= range[1] ||
           camera_fails(fault, "depth_range",
                        "must not fall in %s, got %g and %g: a reversed mapping turns depth, too; gl, vulkan and metal "
                        "let it",
                        api->name, range[0], range[1]);
}

bool camera_range_refused(const dp_spec *spec, dp_status status, camera_fault *fault) {
    if (status == DP_ERROR_WINDOW) /* its ends were checked */
        camera_fails(fault, "depth_range",
                     "needs one of the mappings " DP_MAPPING_NAMES_PERSPECTIVE ", got %s, whose depth a shader writes",
                     dp_mapping_get(spec->mapping)->name);
    else if (status == DP_ERROR_MODEL && spec->model == DP_MODEL_STAGED)
        camera_fails(fault, "model", "must be exact, float or auto where the depth range is not 0 to 1, got staged");
    else
        return false;
    return true;
}
