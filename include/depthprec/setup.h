/* SPDX-License-Identifier: MIT */
/**
 * @file setup.h  A set-up: camera planes, mapping, format, rounding and model, checked once.
 *
 * dp_setup_init() is the only door. What it lets through cannot fail, overflow or divide by zero anywhere behind it.
 */
#ifndef DEPTHPREC_SETUP_H
#define DEPTHPREC_SETUP_H

#include "depthprec/arith.h"
#include "depthprec/format.h"
#include "depthprec/mapping.h"
#include "depthprec/status.h"
#include "depthprec/triangles.h"

DP_BEGIN

/** The roundings between the eye depth and the buffer that are modelled. */
typedef enum dp_model {
    DP_MODEL_EXACT = 0, /**< real arithmetic and one rounding into the format: the lattice of codes */
    DP_MODEL_STAGED,    /**< NDC depth, then window depth, each rounded once to binary32, then the format; of the depth
                             range 0 to 1 */
    DP_MODEL_FLOAT,     /**< every operation in binary32: see pipeline.h; perspective and orthographic mappings only */
    DP_MODEL_COUNT
} dp_model;

/** The camera and buffer asked for. Start from dp_spec_default() and change what differs. */
typedef struct dp_spec {
    double
        znear; /**< near plane, scene units, in [1e-12, 1e12]; orthographic: 0, or of that magnitude, of either sign */
    double zfar; /**< far plane, scene units, at most 1e18, or 1e28 with near and C times it at most
1e30, or INFINITY; (far - near)/near >= 1e-6. Orthographic:
                    finite; 0, or of a magnitude in [1e-12, 1e18], of either sign; (far - near)/|near| >= 1e-6 */
    int ortho;   /**< nonzero: orthographic projection (d3d, gl, reversed and gl-reversed only) */
    dp_mapping mapping;
    dp_format format;
    dp_rounding rounding;
    dp_model model;
    dp_arith arith;         /**< the arithmetic of DP_MODEL_FLOAT and of dp_pipeline_init() */
    double log_c;           /**< constant C of the logarithmic mappings, in [1e-12, 1e12]; not read for three-webgpu */
    double depth_range[2];  /**< the viewport's minimum and maximum, the window depths where NDC depth begins and ends:
                               glDepthRange(), minDepth and maxDepth (OpenGL 4.6, 13.8.1; Vulkan 1.3, Controlling the
                               Viewport). Of either order, in [0, 1], at least 1e-6 apart, each 0 or at least 1e-6;
                               rounded to binary32, as viewports have them. Both 0: 0 and 1, as from
                               dp_spec_default(). Else DP_ERROR_WINDOW, as under linear and logarithmic mappings,
                               whose shaders write depth; DP_MODEL_STAGED has 0 and 1 alone */
    dp_triangles triangles; /**< surfaces slant as this says, under a perspective: what the float model guarantees is
                               in triangles.h, and z is the depth of the farther one. Width 0: they face the camera */
} dp_spec;

/** The camera to start from: near 0.1, far 1000, perspective, d3d, fp32, nearest, exact, C = 1, surfaces that face the
 *  camera. */
DP_API dp_spec dp_spec_default(void);

/** A checked set-up. What follows `spec` is derived from it by dp_setup_init() and private: it may change. */
typedef struct dp_setup {
    dp_spec spec;
    /* private to the library: */
    dp_curve curve;
    int reversed, shader, ranged;
    double anchor, log_c, log_by;
    int spans_zero;
    double ends[2], low, span;
    double kappa, scale, den, log_hi, log_lo;
    uint32_t code_near, code_far;
    float matrix[2], inside[2];
} dp_setup;

/**
 * Checks a specification and prepares a set-up.
 * @return DP_OK, or what is wrong with it; *setup is then left as it was
 */
DP_API dp_status dp_setup_init(dp_setup *setup, const dp_spec *spec);

/** A set-up without its triangles: for surfaces that face the camera. */
DP_API dp_setup dp_setup_facing(const dp_setup *setup);

/**
 * A set-up in the model in which dp_separation() and dp_separation_over() promise most: float where a pipeline computes
 * depth; in staged for the others, and where a shader writes a logarithm these two functions, and only they, then give
 * the guarantee of dp_budget_at(), for every log2 that Vulkan, GLSL and WGSL allow, of surfaces that face the camera.
 * A linear depth that a shader writes is still a lattice.
 */
DP_API dp_setup dp_setup_guaranteed(const dp_setup *setup);

/** The name of a model of the arithmetic, "exact", "staged" or "float"; null when out of range. */
DP_API const char *dp_model_name(dp_model model);

DP_END
#endif
