/* SPDX-License-Identifier: MIT */
/*
 * Curves: from lattice points back to eye depths, and differences of eye depths without cancellation.
 *
 * With t the share of the way from the near to the far end (t = d, or q when reversed) and s = 1 - t, both from 0 to 1
 * (what lies beyond the ends of a viewport's range counts as the end):
 *
 *     PERSPECTIVE   1/z = s/n + t/f
 *     LINEAR        z = s anchor + t f
 *     LOG           C (z - anchor) + 1 = (C (f - anchor) + 1)^t, C = 1/n where that is z/n = (f/n)^t
 *
 * The private fields of dp_setup:
 *     reversed    d falls with z
 *     curve       the curve in force: an orthographic projection turns PERSPECTIVE into LINEAR
 *     shader      LOG: the separation is that of the shader, see dp_setup_guaranteed()
 *     anchor      the depth that a LINEAR or LOG curve sends to its near end: near or 0
 *     log_c       LOG: C, or 1/n, rounded, where the logarithm is that of z/n
 *     log_by      LOG: C, or 0 where the logarithm is that of z/n
 *     spans_zero  depth 0 lies between the planes: eye depths are differences, and take the exact way
 *     ends        window depth at near and at far, binary32 numbers
 *     ranged      the ends are not those of [0, 1]: a viewport moves depth, d = low + span d' with d' what follows
 *     low, span   the lesser end, and how far apart they are
 *     kappa       PERSPECTIVE: 1/n - 1/f; LINEAR: f - anchor; LOG: the logarithm at far; over span
 *     scale       d' is this times (z - n)/z, (f - z)/z, z - n, f - z, z or the logarithm
 *     den         lattice points and rounding boundaries are num/den: UNORM 2 (2^N - 1); FLOAT 1
 *     log_hi, log_lo        LOG: the logarithm at far as an unevaluated sum of two doubles
 *     code_near, code_far   the codes of the two planes
 *     matrix      where a pipeline computes depth: z_clip = matrix[0] z + matrix[1], see pipeline.h
 *     inside      and the binary32 depths nearest to the planes from inside
 */
#ifndef CORE_CURVE_H
#define CORE_CURVE_H

#include "core/lattice.h"
#include "depthprec/setup.h"

/* The eye depth of a point, num/den: few units of 2^-53 relative, log 2^-45. */
double dp_curve_eye(const dp_setup *setup, dp_point point);

/*
 * dp_curve_eye(point) - z, good to 2^-49 relative and with the right sign. LOG: good to 2^-44, and the sign is right
 * where the difference is not below 2^-88 of the depth's logarithm. Positive: the point lies behind z. INFINITY at the
 * infinite far plane.
 */
double dp_curve_gap(const dp_setup *setup, dp_point point, double z);

/* The distance between two points, a not farther than b; few units of 2^-53 relative. */
double dp_curve_span(const dp_setup *setup, dp_point a, dp_point b);

/*
 * An upper bound of the distance from z to the depth that lies `step` of d nearer to the camera, for z as
 * dp_curve_eye() rounds it, too.
 */
double dp_curve_reach(const dp_setup *setup, double z, double step);

/* z(d + step) - z for a step of num/den in d towards far, z as it is given; INFINITY where there is no such depth. */
double dp_curve_ahead(const dp_setup *setup, double num, double den, double z);

/*
 * A factor that outweighs the rounding errors of any width, error or separation computed here: some 19 units of 2^-53,
 * or 214 for each of the exponentials of LOG, whose arguments reach 70.
 */
static inline double dp_curve_outward(const dp_setup *setup) {
    return setup->curve == DP_CURVE_LOG ? 1.0 + DP_ROUNDINGS_510 : 1.0 + DP_ROUNDINGS_30;
}

#endif
