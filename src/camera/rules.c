/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "camera/rules.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/append.h"

bool camera_fails(camera_fault *fault, const char *key, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(fault->text, sizeof fault->text, format, arguments);
    va_end(arguments);
    fault->key = key;
    return false;
}

const char *camera_fault_text(const camera_fault *fault, const char *mark, char out[CAMERA_FAULT_SIZE]) {
    *out = '\0';
    for (const char *at = fault->text; *at != '\0'; at++)
        append(out, CAMERA_FAULT_SIZE, "%.*s%s", *at != '@', at, *at == '@' ? mark : "");
    return out;
}

const char *camera_number(double value, char out[CAMERA_NUMBER_SIZE]) {
    int digits = 14;
    do
        snprintf(out, CAMERA_NUMBER_SIZE, "%.*g", ++digits, value);
    while (digits < 17 && strtod(out, NULL) != value);
    return out;
}

/* Which key a status is about; what is not here is about several, and far is the one to change. */
static const char *const keys[DP_STATUS_COUNT] = {
    [DP_ERROR_NEAR] = "near",          [DP_ERROR_ORTHO_NEAR] = "near", [DP_ERROR_LOG_C] = "log_c",
    [DP_ERROR_FORMAT] = "format",      [DP_ERROR_MAPPING] = "mapping", [DP_ERROR_ROUNDING] = "rounding",
    [DP_ERROR_MODEL] = "model",        [DP_ERROR_ARITH] = "arith",     [DP_ERROR_ORTHO] = "ortho",
    [DP_ERROR_TRIANGLES] = "viewport",
};

bool camera_refused(const dp_spec *spec, dp_status status, const char *aside, camera_fault *fault) {
    const char *key = keys[status] != NULL ? keys[status] : "far", *text = dp_status_text(status);
    const char *mapping = dp_mapping_get(spec->mapping)->name;
    char znear[CAMERA_NUMBER_SIZE], zfar[CAMERA_NUMBER_SIZE];
    if (status == DP_ERROR_MODEL) /* of the models that have a name, float alone is not for all */
        return camera_fails(
            fault, key,
            "float is a pipeline's arithmetic, and a shader writes the depth of %s: leave it out%s, or take "
            "one of the mappings " DP_MAPPING_NAMES_PERSPECTIVE,
            mapping, aside);
    if (strncmp(text, key, strlen(key)) == 0 && text[strlen(key)] == ' ') /* "far: must be", not "far: far must be" */
        text += strlen(key) + 1;
    if (status == DP_ERROR_INFINITE || status == DP_ERROR_ORTHO)
        return camera_fails(fault, key, "%s, got %s, %s", text, spec->ortho ? "orthographic" : "perspective", mapping);
    if (status == DP_ERROR_LOG_C)
        return camera_fails(fault, key, "%s, got %s", text, camera_number(spec->log_c, znear));
    return camera_fails(fault, key, "%s, got near %s, far %s", text, camera_number(spec->znear, znear),
                        camera_number(spec->zfar, zfar));
}

bool camera_vertical(double fov_x, int width, int height, double *fov_y, camera_fault *fault) {
    *fov_y = dp_fov_vertical(fov_x, width, height);
    return (*fov_y >= DP_FOV_LEAST && *fov_y <= DP_FOV_MOST) ||
           camera_fails(fault, "hfov", "makes a vertical angle of %.6g degrees, which must be from %g to %g", *fov_y,
                        DP_FOV_LEAST, DP_FOV_MOST);
}
