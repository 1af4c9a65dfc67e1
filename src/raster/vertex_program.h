/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file vertex_program.h  Vertex programs: how a shader makes clip z and clip w of a world position in
 * binary32, a row each.
 *
 * Two programs that are the same on paper round differently, so a depth prepass by the one and a main pass by the other
 * store different depths of the same vertex.
 */
#ifndef RASTER_VERTEX_PROGRAM_H
#define RASTER_VERTEX_PROGRAM_H

#include <stdbool.h>
#include <stddef.h>

#include "core/named.h"
#include "depthprec/pipeline.h"

/** Which matrices a position meets: P is the projection, V the view. */
typedef enum vertex_matrices {
    VERTEX_ONCE = 0, /**< one, P V formed in double and rounded once */
    VERTEX_PRODUCTS, /**< one, P V formed in binary32 from both, rounded */
    VERTEX_SEPARATE  /**< V first, then P */
} vertex_matrices;

/** The order in which the terms of a row, those of x, y, z and the constant, are summed. */
typedef enum vertex_order {
    VERTEX_LEFT = 0, /**< ((x + y) + z) + constant */
    VERTEX_RIGHT,    /**< x + (y + (z + constant)) */
    VERTEX_PAIRS     /**< (x + y) + (z + constant) */
} vertex_order;

typedef struct vertex_program {
    NAMED_FIELDS;
    vertex_matrices matrices;
    vertex_order order;
    bool fused; /**< each product but the first is fused into a sum */
} vertex_program;

/** The rows, the first being the default `once`. */
NAMED_ROWS(vertex_program, vertex_program);

/** A camera and a projection as a shader has them: in each matrix the row that matters. */
typedef struct vertex_camera {
    float view[4];     /**< of V: eye depth; of P V also clip w */
    float once[4];     /**< of P V: clip z, VERTEX_ONCE */
    float products[4]; /**< the same, VERTEX_PRODUCTS */
    float a, b;        /**< of P: clip z is a times eye depth, and b */
    bool ortho;        /**< clip w is 1 */
} vertex_camera;

/**
 * The camera at a place that looks along an axis of length 1.
 * @param setup  perspective or orthographic; `pipeline` is its own
 */
vertex_camera vertex_camera_of(const dp_setup *setup, const dp_pipeline *pipeline, const double axis[3],
                               const double place[3]);

typedef struct vertex_clip {
    float z, w;
} vertex_clip;

/** Clip z and clip w of a position, each operation rounded to binary32. */
vertex_clip vertex_run(const vertex_program *program, const vertex_camera *camera, const float position[3]);

#endif
