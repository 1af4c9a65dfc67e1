/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file transform.h  World points through a view matrix and the pipeline: the view and projection apart, or
 * precomposed.
 *
 * An eye depth is itself computed: with the view's row v = (forward, -forward . eye), entries formed in double and
 * rounded once to binary32, and p = (x, y, z, 1) the point,
 *
 *     separate      w = v . p                     z_clip = fl(fl(A w) + B)
 *     precomposed   w = v . p                     z_clip = c . p,  c = (fl(A v0), fl(A v1), fl(A v2), fl(fl(A v3) + B))
 *
 * Each dot product is four binary32 products and three sums in one of ORDER_COUNT orders; with a fused arithmetic
 * each product but the first of a sum is fused into it. The rest is pipeline.h. Perspective mappings only.
 */
#ifndef TESTS_TRANSFORM_H
#define TESTS_TRANSFORM_H

#include <stddef.h>
#include <stdint.h>

#include "depthprec/depthprec.h"

/** Distinct orders of a sum of four: 0 to 11 one after the other, 12 to 14 two sums of two. */
enum { ORDER_COUNT = 15 };

/** A camera. */
typedef struct view_row {
    const char *name;
    double eye[3];     /**< world position, scene units */
    double forward[3]; /**< not necessarily of length 1 */
    const char *note;
} view_row;

/** The views; index below view_count(), else null. */
size_t view_count(void);
const view_row *view_get(size_t index);

typedef struct transform {
    dp_pipeline pipeline;
    int precomposed;
    unsigned order;
    float view[4]; /**< w = view . p */
    float clip[4]; /**< precomposed: z_clip = clip . p */
} transform;

/**
 * @param precomposed  nonzero: one matrix for view and projection
 * @param order  below ORDER_COUNT
 * @return DP_OK, DP_ERROR_NULL, or DP_ERROR_MODEL for a set-up without a pipeline, an orthographic one or an unknown
 *         order
 */
dp_status transform_init(transform *transform, const dp_setup *setup, const view_row *view, int precomposed,
                         unsigned order);

/** z_clip (after the remap, if the arithmetic has one) and w of a world point. */
void transform_vertex(const transform *transform, const float world[3], float *clip, float *w);

/** The stored code of a world point in front of the camera. */
uint32_t transform_code(const transform *transform, const float world[3]);

/**
 * The binary32 world point nearest to the one that lies z ahead of the eye and `right`, `up` beside the axis, and,
 * through *depth (may be null), the eye depth of that rounded point.
 */
void view_point(const view_row *view, double right, double up, double z, float world[3], double *depth);

#endif
