/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "camera/depth_range.h"

#include "core/engine.h"

#define TEXT(number)    #number
#define TEXT_OF(number) TEXT(number)
#define LEAST           TEXT_OF(DP_RANGE_LEAST)

bool camera_range_takes(const char *api, const double range[2], camera_fault *fault) {
    char lo[CAMERA_NUMBER_SIZE], hi[CAMERA_NUMBER_SIZE];
    if (dp_range_fits(range))
        return camera_range_suits(api != NULL ? bias_api_find(api) : NULL, range, fault);
    return camera_fails(fault, "depth_range",
                        "must be two window depths, each 0 or from " LEAST " to 1, and at least " LEAST
                        " apart, got %s and %s",
                        camera_number(range[0], lo), camera_number(range[1], hi));
}

bool camera_range_suits(const bias_api *api, const double range[2], camera_fault *fault) {
    char lo[CAMERA_NUMBER_SIZE], hi[CAMERA_NUMBER_SIZE];
    return api == NULL || !api->rising || range[0] <= range[1] ||
           camera_fails(fault, "depth_range",
                        "must not fall in %s, got %s and %s: a reversed mapping turns depth, too; gl, vulkan and metal "
                        "let it",
                        api->name, camera_number(range[0], lo), camera_number(range[1], hi));
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
