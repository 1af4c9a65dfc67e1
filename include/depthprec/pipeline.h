/* SPDX-License-Identifier: MIT */
/**
 * @file pipeline.h  The binary32 arithmetic between an eye depth and its code, operation by operation.
 *
 * A depth buffer does not receive d(z) but what a vertex shader, a divider and a viewport made of it in binary32.
 * Here every operation is rounded to binary32 as the hardware rounds it, so the codes are those that a rasterizer
 * of that arithmetic stores, bit for bit. With fl() the rounding and w the clip w (z, or 1 if orthographic):
 *
 *     z_clip = fl(fl(A z) + B)                 fused: fl(A z + B)
 *     ndc    = fl(z_clip / w)                  reciprocal: fl(z_clip fl(1/w))
 *     window = ndc                             NDC in [0, 1]
 *            = fl(fl(0.5 ndc) + 0.5)           NDC in [-1, 1]
 *            = fl(fl(S ndc) + O)               a depth range; fused: fl(S ndc + O)
 *     code   = the format's conversion of window
 *
 * A and B are the projection's two entries, formed in double and rounded once; so are S and O: from the ends LO and HI
 * of the range, S is HI - LO and O LO, or S (HI - LO)/2 and O (LO + HI)/2 where NDC runs over [-1, 1]. The result is
 * not monotone in z: two depths may tie or swap. Models: perspective and orthographic mappings; linear and log have no
 * such pipeline.
 */
#ifndef DEPTHPREC_PIPELINE_H
#define DEPTHPREC_PIPELINE_H

#include <stddef.h>
#include <stdint.h>

#include "depthprec/setup.h"
#include "depthprec/status.h"

DP_BEGIN

/** A checked set-up with an arithmetic, ready to compute codes. Made by dp_pipeline_init(); for reading. */
typedef struct dp_pipeline {
    dp_format format;
    dp_rounding rounding;
    const dp_arith_row *arith;
    float a, b;          /**< z_clip = A z + B */
    float scale, offset; /**< of the viewport: S and O */
    int reversed;        /**< window depth falls from near to far */
    int clip_reversed;   /**< NDC depth does */
    int moved;           /**< the viewport is more than the identity */
    int ndc_signed;      /**< NDC runs over [-1, 1] */
    int ortho;           /**< clip w is 1 */
    float znear, zfar;   /**< the binary32 depths nearest to the planes from inside; zfar may be INFINITY */
} dp_pipeline;

/**
 * Prepares the pipeline of a set-up, in the arithmetic of setup->spec.arith.
 * @return DP_OK, DP_ERROR_NULL, or DP_ERROR_MODEL for a mapping without a pipeline (linear, log)
 */
DP_API dp_status dp_pipeline_init(dp_pipeline *pipeline, const dp_setup *setup);

/** The clip z of a binary32 eye depth, before the divide (after the remap, if the arithmetic has one). */
DP_API float dp_pipeline_clip(const dp_pipeline *pipeline, float z);

/** The window depth in binary32 of a vertex that has clip z and w from elsewhere: remap, divide and viewport. */
DP_API float dp_pipeline_divide(const dp_pipeline *pipeline, float clip_z, float clip_w);

/** The window depth of a binary32 eye depth, not clamped. z > 0 under a perspective. */
DP_API float dp_pipeline_window(const dp_pipeline *pipeline, float z);

/** The code that a GPU stores for a binary32 eye depth; a window depth outside [0, 1] is clamped, as a depth clamp
 * does. */
DP_API uint32_t dp_pipeline_code(const dp_pipeline *pipeline, float z);

/** The code of a binary32 window depth in the arithmetic's conversion and the format. */
DP_API uint32_t dp_pipeline_convert(const dp_pipeline *pipeline, float window);

/** Whether clipping keeps a point at z: -w <= z_clip <= w, or 0 <= z_clip <= w, in binary32. */
DP_API int dp_pipeline_drawn(const dp_pipeline *pipeline, float z);

/**
 * The effective planes: the nearest and the farthest binary32 depth in [near, far] that clipping keeps. They differ
 * from the asked ones because A and B are rounded. Both are NaN when nothing is drawn.
 * Cost: O(log) evaluations next to each plane, certified by the error bound of z_clip.
 */
DP_API void dp_pipeline_planes(const dp_pipeline *pipeline, float *znear, float *zfar);

DP_END
#endif
