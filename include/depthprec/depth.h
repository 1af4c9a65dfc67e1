/* SPDX-License-Identifier: MIT */
/**
 * @file depth.h  What one depth becomes: its code, the depth that code gives back, and the cell around it.
 *
 * The cell of a code is the set of eye depths stored as that code: two surfaces inside one cell fight for the same
 * pixels. Its width is the z-fighting interval, the local resolution of the buffer.
 *
 * Every function takes a set-up made by dp_setup_init() and eye depths in [near, far]; only dp_sample_at() checks.
 * The derivation of each formula and bound is in depthprec(7).
 */
#ifndef DEPTHPREC_DEPTH_H
#define DEPTHPREC_DEPTH_H

#include <stdint.h>

#include "depthprec/setup.h"
#include "depthprec/status.h"

DP_BEGIN

/** The set of eye depths that share a code, clipped to [near, far]. */
typedef struct dp_cell {
    uint32_t code;
    double lo;     /**< nearest depth of the cell, scene units */
    double hi;     /**< farthest depth of the cell; INFINITY for the last cell of an infinite far plane */
    double width;  /**< hi - lo without cancellation, good to 1e-12 relative; INFINITY where hi is */
    double stored; /**< the depth that the code gives back */
} dp_cell;

/** All that a table shows about one depth. */
typedef struct dp_sample {
    double z;          /**< eye depth, scene units */
    uint32_t code;     /**< the correctly rounded code */
    double depth;      /**< window depth before quantization, [0, 1], within 8 units of 2^-53 relative */
    double stored;     /**< the eye depth that the code gives back; INFINITY when it is the infinite far plane's */
    double error;      /**< stored - z, good to 1e-12 of the interval */
    double lo, hi;     /**< the cell that contains z, clipped to [near, far] */
    double interval;   /**< the cell's width: the z-fighting interval at z */
    double separation; /**< see dp_separation() */
} dp_sample;

/**
 * The window depth d(z) in [0, 1], before quantization.
 * Bound: 2^-50 relative. Cost: one division, or one logarithm.
 */
DP_API double dp_window(const dp_setup *setup, double z);

/**
 * The eye depth of a window depth given as the pair d and q = 1 - d, each to full accuracy: so nothing cancels near
 * either end. Never pass 1 - d computed from a rounded d.
 *
 * Formula: perspective 1/z = q/n + d/f (standard) or d/n + q/f (reversed); orthographic z = q n + d f, or the reverse.
 * Bound: 2^-50 relative (log: 2^-45), of that formula with d and q as given where depth 0 lies between the planes.
 * In a depth range from the near plane's window depth a to the far plane's b: the same of (d - a)/(b - a), and beyond
 * an end that plane.
 * Special cases: INFINITY at the infinite far plane. Results are not clipped to [near, far].
 */
DP_API double dp_eye(const dp_setup *setup, double d, double q);

/**
 * The code that stores z: in the model `exact` the correctly rounded value of d(z) in the set-up's format and rounding
 * mode, for every double z in [near, far].
 *
 * Perspective, linear and orthographic depths are rational functions of doubles, so the rounding is decided exactly
 * (floating-point expansions) whenever the quick estimate lies within its own error of a rounding boundary, about one
 * input in 2^25 for 24-bit formats. The logarithmic mapping is decided with a logarithm of about 100 bits: it is the
 * correctly rounded code unless log(Cz+1)/log(Cf+1) lies within 2^-90 (relative) of a boundary.
 * In the model `staged` it is that of the staged roundings, decided with the same care; in `float` that of the pipeline
 * at z rounded to binary32. Outside [near, far] z is clamped, as a depth clamp does.
 */
DP_API uint32_t dp_code(const dp_setup *setup, double z);

/** The eye depth that a code gives back: the inverse mapping of its value. Bound: as dp_eye(). code <= code_max. */
DP_API double dp_stored(const dp_setup *setup, uint32_t code);

/**
 * How far a stored depth is from the true one: dp_stored(code) - z without cancellation, good to 1e-12 of the
 * z-fighting interval even where the two agree in every printed digit. INFINITY where the code is that of an infinite
 * far plane and z is finite.
 */
DP_API double dp_error(const dp_setup *setup, uint32_t code, double z);

/**
 * The cell of a code. A code that no depth in [near, far] is stored as (below the near plane of the linear and log
 * mappings) has lo = hi = the plane it lies beyond, and width 0; so has, between its neighbours, a code that the stages
 * of `staged` skip. In the model `float` the depths of a code need not be an interval: lo, hi and width are NaN.
 */
DP_API dp_cell dp_cell_of(const dp_setup *setup, uint32_t code);

/**
 * The separation: how far behind z a surface must lie to be certain of a code behind z's, however the two are
 * aligned to the lattice. In the model `exact` it is one step of the format taken from z, z(d + step) - z, with the
 * larger of the two steps where d to d + step reaches across a binade end; so it has no sawtooth inside a binade.
 *
 * In `staged` a step of each binary32 rounding is added, that of the eye depths too, since surfaces stand anywhere; in
 * `float` it is the guaranteed separation of dp_budget_at(), INFINITY for depths that binary32 cannot hold. With
 * triangles in the set-up that is how far in front of z, along the normal, a parallel surface must lie; the other
 * models know of none.
 *
 * Bound: never below the true value, in `exact` at most 1e-12 relative above. The far plane does not end it: where one
 * step passes far but has a depth, that depth is used; INFINITY where no depth lies one step behind z.
 */
DP_API double dp_separation(const dp_setup *setup, double z);

/**
 * The code that a depth is stored as, with its error, cell and separation there: all of the above in one call.
 * @return DP_OK or DP_ERROR_DEPTH (outside [near, far] or NaN), DP_ERROR_NULL, DP_ERROR_BINARY32 (in `float`, above
 *         3.4028235e+38)
 */
DP_API dp_status dp_sample_at(const dp_setup *setup, double z, dp_sample *out);

DP_END
#endif
