/* SPDX-License-Identifier: MIT */
/**
 * @file budget.h  The guaranteed separation of the binary32 pipeline, and which cause takes how much of it.
 *
 * For all real depths z1 < z2 in [near, far] with z2 - z1 >= separation(z1) the codes are strictly in order, where what
 * enters the pipeline is each depth rounded to binary32. Forward error analysis of the operations in pipeline.h;
 * depthprec(7) derives each term. Never below the separation of DP_MODEL_EXACT.
 *
 * Where a shader writes a logarithmic depth, the codes are in order for every log2 that the language allows; what
 * enters is the eye depth w in binary32 as a fragment has it.
 *
 * This speaks of depths computed at a point, and so of surfaces that face the camera. Across a slanted triangle a
 * rasterizer interpolates: what is promised there needs the set-up's `triangles`, or its error as `interpolation`.
 */
#ifndef DEPTHPREC_BUDGET_H
#define DEPTHPREC_BUDGET_H

#include <stddef.h>
#include <stdint.h>

#include "depthprec/setup.h"
#include "depthprec/status.h"

DP_BEGIN

/** The causes, in the order in which they arise. */
typedef enum dp_cause {
    DP_CAUSE_EYE = 0,       /**< eye depth rounded to binary32: surfaces are real, what enters is not */
    DP_CAUSE_COMPOSITION,   /**< world positions through view and projection */
    DP_CAUSE_PROJECTION,    /**< A z + B in binary32 (and the remap, if any) */
    DP_CAUSE_ARGUMENT,      /**< of a logarithmic depth: 1 + C w, in the shader */
    DP_CAUSE_LOG2,          /**< of it: log2 within what the language allows */
    DP_CAUSE_SCALE,         /**< of it: the product with 1/log2(C f + 1), or the quotient */
    DP_CAUSE_NDC,           /**< the divide and the viewport */
    DP_CAUSE_SNAPPING,      /**< vertices moved to the subpixel grid, of slanted triangles */
    DP_CAUSE_SETUP,         /**< the plane of a slanted triangle: set up and evaluated in binary32 */
    DP_CAUSE_INTERPOLATION, /**< across a triangle, as given */
    DP_CAUSE_FORMAT,        /**< the step of the format and its conversion */
    DP_CAUSE_LINEARIZATION, /**< reading back: eye depth from the stored value in a binary32 shader */
    DP_CAUSE_COUNT
} dp_cause;

/** How world positions become clip coordinates. Entries and positions are binary32 unless said otherwise. */
typedef enum dp_composition {
    DP_COMPOSITION_ONCE = 0, /**< P V formed in double, each entry rounded once; one matrix-vector product */
    DP_COMPOSITION_PRODUCTS, /**< P and V each rounded to binary32, multiplied in binary32; then as above */
    DP_COMPOSITION_RELATIVE, /**< position - camera in double, rounded once; then a matrix without translation */
    DP_COMPOSITION_COUNT
} dp_composition;

typedef struct dp_composition_row {
    const char *name; /**< "once" */
    const char *note;
} dp_composition_row;

/** The row of a way from world to clip coordinates; null when out of range. */
DP_API const dp_composition_row *dp_composition_get(dp_composition composition);

/** The largest error of a place's view z before the projection, scene units; found for all places asked about. */
typedef struct dp_displaced {
    double own;    /**< by itself, and so each coordinate of view space */
    double shared; /**< as all others, but for `turn` of what lies between two places, a share of it */
    double turn;   /**< below 1 */
} dp_displaced;

/** Causes that may be added to the pipeline. All zero: those that the separation of DP_MODEL_FLOAT counts. */
typedef struct dp_budget_terms {
    double interpolation; /**< error of an interpolated window depth, in units of 2^-24 of d; at least 0 */
    double world;         /**< largest |coordinate| of world positions and camera, scene units; 0: eye depth is given */
    int linearize;        /**< nonzero: the depth is read back by 1/(z d + w) in binary32 */
    dp_composition composition; /**< of view and projection; read where `world` is positive */
    dp_displaced displaced;     /**< in place of a composition: the projection is applied to places in view space; read
                                     where `world` is 0 */
    dp_log2_rule log2;          /**< what a shader's log2 may be off by; read where the mapping is logarithmic */
} dp_budget_terms;

/** A separation and its parts. */
typedef struct dp_budget {
    double separation;            /**< scene units; INFINITY where nothing behind z is certain */
    double window;                /**< the same as a distance in window depth */
    double cause[DP_CAUSE_COUNT]; /**< the parts of `separation`, which they add up to; that of the composition is what
                                       it adds, the others are what they are without it */
} dp_budget;

/** A word for a cause, "projection"; null when out of range. */
DP_API const char *dp_cause_name(dp_cause cause);

/**
 * How much each cause takes of the separation that is guaranteed at a depth, in the arithmetic of setup->spec.arith,
 * whatever the set-up's model.
 *
 * @param z      eye depth in [near, far]; rounded to binary32 as a shader has it
 * @param terms  null for none
 * @return DP_OK, DP_ERROR_NULL, DP_ERROR_DEPTH, DP_ERROR_BINARY32 where z rounds to infinity, or DP_ERROR_MODEL for
 *         linear, which has no pipeline, for a composition or a rule of log2 out of range, and for logarithmic mappings
 *         with triangles, a world, displaced places or reading back, which they have no terms for
 *
 * Where the set-up has triangles z is the eye depth of the farther plane and the separation is along the normal. It is
 * never less than that of dp_setup_facing(), and the same where slant_hi is 0; INFINITY where nothing in front of z is
 * certain.
 *
 * With terms->world, of two surfaces that the same matrix transforms and that one pixel sees, at real places in the
 * world box: on one ray from the camera within 60 degrees of its axis, or parallel to the axis if orthographic (with
 * the camera-relative composition, no farther beside it than the plane of larger magnitude). Where the set-up has
 * triangles: of two planes that are parallel in the world, all vertices in the world box; depths and the class are then
 * as the rounded matrix makes them, pixels and slimness as they are drawn, and the cone is that of the class.
 *
 * Bound: never violated by the pipeline of pipeline.h with depth clamp, nor by a shader of depthprec(7), "The budget of
 * a logarithmic depth". Cost: some 300 operations; logarithmic some 20 logarithms.
 */
DP_API dp_status dp_budget_at(const dp_setup *setup, double z, const dp_budget_terms *terms, dp_budget *out);

/**
 * By how much the window depths of one plane differ at a pixel when it is drawn twice, as different triangles: decals,
 * two levels of detail. With m the greater change of the plane's window depth from one pixel to the next, on x
 * or y, they are at most window + pixels m apart, before the format rounds them. Of triangles at least a pixel high a
 * rasterizer's own m, which scales a bias, is at least (1 - lost) m - lost_window.
 */
typedef struct dp_coplanar {
    double window, pixels;
    double lost, lost_window;
} dp_coplanar;

/**
 * How far apart the depths of one plane may be in a pixel when it is drawn twice, as different triangles: at any slant,
 * whatever the set-up's triangles say, and at every eye depth of a range. depthprec(7), "Two tessellations of one
 * plane", derives it.
 *
 * @param lo, hi  within [near, far]; hi may be INFINITY
 * @return DP_OK, DP_ERROR_NULL, DP_ERROR_DEPTH, DP_ERROR_TRIANGLES where the set-up has none, or DP_ERROR_MODEL for
 *         linear and log; *out is then left as it was
 */
DP_API dp_status dp_coplanar_over(const dp_setup *setup, double lo, double hi, dp_coplanar *out);

/**
 * The codes that the pipeline may store at a depth, given only the set-up's matrix entries and the error bound of its
 * arithmetic: what another implementation of the same operations, in whatever order of rounding, must fall into.
 *
 * @param z  eye depth in [near, far], finite; rounded to binary32
 * @return DP_OK, DP_ERROR_NULL, DP_ERROR_DEPTH, DP_ERROR_MODEL
 */
DP_API dp_status dp_code_range(const dp_setup *setup, double z, uint32_t *lowest, uint32_t *highest);

/** The chosen model, and the shares on which the choice rests. */
typedef struct dp_choice {
    dp_model model;                 /**< the simplest whose neglected share stays within the tolerance */
    double share[DP_MODEL_COUNT];   /**< largest share that each model neglects; NaN for one the set-up lacks */
    double share_z[DP_MODEL_COUNT]; /**< the depth where it does */
} dp_choice;

/**
 * Chooses the simplest model that is good enough: at every depth, what it neglects adds at most `tolerance` to the
 * separation that it finds, or to half a step of binary32 depths where that is larger: a depth is rounded by as much,
 * however narrow the cell at a plane is. The measure is the fullest model that the set-up has: float, or staged for
 * linear and log; both count the rounding of the eye depth.
 *
 * @param z, count   eye depths in [near, far]; count >= 1
 * @param tolerance  share, 0.05 for 5 %; at least 0
 * @return DP_OK, DP_ERROR_NULL (also for count 0), DP_ERROR_DEPTH; *out is then left as it was
 */
DP_API dp_status dp_model_choose(const dp_setup *setup, const double *z, size_t count, double tolerance,
                                 dp_choice *out);

DP_END
#endif
