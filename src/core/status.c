/* SPDX-License-Identifier: MIT */
#include "depthprec/depthprec.h"

/* One row a status; the index is the status. */
static const char *const sentences[DP_STATUS_COUNT] = {
    [DP_OK] = "no error",
    [DP_ERROR_NULL] = "a pointer is null",
    [DP_ERROR_NEAR] = "near must be from 1e-12 to 1e12",
    [DP_ERROR_FAR] =
        "far must be greater than near and at most 1e18, or 1e28 with near x far and C x far at most 1e30, or inf",
    [DP_ERROR_PLANES] = "far must be beyond near by at least 1e-6 of near",
    [DP_ERROR_INFINITE] =
        "an infinite far needs a perspective projection and one of the mappings " DP_MAPPING_NAMES_PERSPECTIVE,
    [DP_ERROR_ORTHO] = "an orthographic projection needs one of the mappings " DP_MAPPING_NAMES_PERSPECTIVE,
    [DP_ERROR_LOG_C] = "the constant C of the log mapping must be from 1e-12 to 1e12",
    [DP_ERROR_FORMAT] = "not a format: see the list of formats, or unormN with N = 1..32, or floatE.M[bB] with "
                        "E = 2..8, M = 1..23, B = 1..2^E-1; rg is linear and nearest",
    [DP_ERROR_MAPPING] = "a mapping must be one of " DP_MAPPING_NAMES,
    [DP_ERROR_ROUNDING] = "rounding must be one of nearest, even, zero",
    [DP_ERROR_MODEL] = "this set-up does not have that model",
    [DP_ERROR_ARITH] = "not a variant of binary32 arithmetic: see dp_arith_get()",
    [DP_ERROR_DEPTH] = "a depth must lie in [near, far]",
    [DP_ERROR_RANGE] = "a range must have its near end first and lie in [near, far]",
    [DP_ERROR_BINARY32] = "a depth in the model float must be at most 3.4028235e+38, the largest binary32 number",
    [DP_ERROR_BATCH] = "not a task, element type or path, or not one that this processor has",
    [DP_ERROR_ORTHO_NEAR] = "near must be 0, or from 1e-12 to 1e12 of either sign, in an orthographic projection",
    [DP_ERROR_ORTHO_FAR] =
        "far must be greater than near, and 0, or from 1e-12 to 1e18 of either sign, in an orthographic projection",
    [DP_ERROR_TRIANGLES] = "triangles need a perspective, and fields in their ranges",
    [DP_ERROR_MATRIX] = "not a projection matrix",
    [DP_ERROR_CONVENTION] =
        "more than one convention fits the matrix: say which of d3d, gl, reversed, gl-reversed, and "
        "whether it lies by rows or by columns",
    [DP_ERROR_WINDOW] =
        "a depth range must have two ends from 0 to 1 and at least 1e-6 apart, each 0 or at least 1e-6, "
        "and one of the mappings " DP_MAPPING_NAMES_PERSPECTIVE,
};

const char *dp_status_text(dp_status status) {
    return (unsigned)status < DP_STATUS_COUNT ? sentences[status] : "not a status";
}

const char *dp_version(void) {
    return DP_VERSION;
}
