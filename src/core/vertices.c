/* SPDX-License-Identifier: MIT */
/* depthprec(7), "Logarithmic depth at vertices", derives both errors: a chord over 1/z lies above a convex function. */
#include "depthprec/vertices.h"

#include <math.h>

#include "core/elementary.h"
#include "core/extremes.h"
#include "core/search.h"

static const double most_depth = 1e6, least_beyond = 0x1p-48;

/* The sum of two terms of opposite signs, at least 0, rounded up by what it may have lost. */
static double rounded_up(double nearer, double farther) {
    return larger(nearer + farther + DP_ROUNDINGS_6 * (fabs(nearer) + fabs(farther)), 0.0);
}

static dp_vertex_error error_of(const dp_setup *setup, double z, double depth) {
    const double z1 = larger(z / depth, setup->spec.znear);
    const double z2 = smaller(z * depth, setup->spec.zfar);
    const double before = z - z1, behind = z2 - z;
    dp_vertex_error e = {0};
    const int affine = setup->curve == DP_CURVE_PERSPECTIVE || setup->spec.ortho;
    if (affine || dp_mapping_get(setup->spec.mapping)->written == DP_WRITTEN_BY_FRAGMENT ||
        !(before > 0.0 && behind > 0.0))
        return e;
    const double part = behind * (before / (z * (z2 - z1))); /* the weights are part z1/before and part z2/behind */
    if (setup->curve == DP_CURVE_LINEAR) {
        e.eye = rounded_up(before * (behind / z), 0.0) + 0x1p-51 * (before + behind); /* of z/depth and z depth */
        e.window = e.eye / setup->kappa * (1.0 + DP_ROUNDINGS_6);
    } else {
        const double c = setup->log_c, scale = c / (c * (z - setup->anchor) + 1.0);
        const double chord =
            rounded_up(part * z1 / before * dp_log1p(-scale * before), part * z2 / behind * dp_log1p(scale * behind));
        e.eye = dp_expm1(chord) / scale * (1.0 + DP_ROUNDINGS_6);
        e.window = chord / setup->kappa * (1.0 + DP_ROUNDINGS_6);
    }
    return e;
}

static int is_inside(const dp_setup *setup, double z) {
    return z >= setup->spec.znear && z <= setup->spec.zfar && isfinite(z);
}

dp_status dp_vertex_error_at(const dp_setup *setup, double z, double depth, dp_vertex_error *out) {
    if (setup == NULL || out == NULL)
        return DP_ERROR_NULL;
    if (!is_inside(setup, z))
        return DP_ERROR_DEPTH;
    if (!(depth >= 1.0 && depth <= most_depth))
        return DP_ERROR_TRIANGLES;
    *out = error_of(setup, z, depth);
    return DP_OK;
}

/* The error rises with the depth. What it is beyond 1 is looked for, as small as that may be. */
dp_status dp_vertex_depth_at(const dp_setup *setup, double z, double eye, double *depth) {
    if (setup == NULL || depth == NULL)
        return DP_ERROR_NULL;
    if (!is_inside(setup, z) || !(eye >= 0.0))
        return DP_ERROR_DEPTH;
    dp_edge beyond = {.holds = least_beyond, .fails = most_depth - 1.0};
    if (error_of(setup, z, most_depth).eye <= eye)
        beyond.holds = beyond.fails;
    for (double x; dp_edge_between(&beyond, &x);)
        *(error_of(setup, z, 1.0 + x).eye <= eye ? &beyond.holds : &beyond.fails) = x;
    *depth = beyond.holds > least_beyond ? 1.0 + beyond.holds : 1.0;
    return DP_OK;
}
