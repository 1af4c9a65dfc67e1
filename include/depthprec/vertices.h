/* SPDX-License-Identifier: MIT */
/**
 * @file vertices.h  Window depth written per vertex: what it is off by between the vertices.
 *
 * A rasterizer interpolates window depth linearly on the screen. Under a perspective that is right for mappings of the
 * form a + b/z alone. Of `log` and `linear`, written by a vertex shader as d w, what is interpolated between vertices
 * is farther than the surface, and no format or separation makes up for it; written per fragment it is not.
 *
 * This is about real arithmetic: what a rasterizer adds to a plane of window depth is not in it.
 */
#ifndef DEPTHPREC_VERTICES_H
#define DEPTHPREC_VERTICES_H

#include "depthprec/setup.h"
#include "depthprec/status.h"

DP_BEGIN

/** How much farther than the surface an interpolated depth lies at most. */
typedef struct dp_vertex_error {
    double window; /**< window depth */
    double eye;    /**< scene units of eye depth */
} dp_vertex_error;

/**
 * The error in a pixel of a surface at z whose triangle has all vertices at eye depths from z/depth to z depth, and
 * within [near, far]: for log, with the weight l = 1/(depth + 1) of the nearer end,
 *
 *     window = (l log(C z/depth + 1) + (1 - l) log(C z depth + 1) - log(C z + 1)) / log(C f + 1)
 *
 * and eye = (z + 1/C) (e^(window log(C f + 1)) - 1); for linear eye = z (depth - 1)^2/depth = far window. 0 for the
 * other mappings, which are affine on the screen or written per fragment, at a plane, and where depth is 1.
 *
 * @param z      eye depth in [near, far], finite
 * @param depth  1 to 1e6, as in dp_triangles
 * @return DP_OK, DP_ERROR_NULL, DP_ERROR_DEPTH, DP_ERROR_TRIANGLES for a depth out of range; *out is then as it was
 *
 * Bound: reached by a triangle that has vertices at both ends; rounded up, by at most 1e-14 z over the distance of z
 * from the nearer end, relative. Source: depthprec(7), "Logarithmic depth at vertices".
 */
DP_API dp_status dp_vertex_error_at(const dp_setup *setup, double z, double depth, dp_vertex_error *out);

/**
 * The largest `depth` whose error at z is at most `eye` scene units, not negative: triangles that span more have to
 * write their depth per fragment. From 1 to 1e6, which all triangles have, within 1e-9 of depth - 1, rounded down.
 *
 * @return DP_OK, DP_ERROR_NULL, DP_ERROR_DEPTH (also of an error that is negative or no number)
 */
DP_API dp_status dp_vertex_depth_at(const dp_setup *setup, double z, double eye, double *depth);

DP_END
#endif
