/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file plane_order.h  The plane of window depth through three vertices, in the orders of operations that exist. */
#ifndef TESTS_PLANE_ORDER_H
#define TESTS_PLANE_ORDER_H

/** Window coordinates and window depth of a vertex as the set-up reads them; y runs as the plane's y does. */
typedef struct corner {
    float x, y, z, w;
} corner;

/** Depth at a place, each operation rounded to binary32. */
typedef float plane_order(const corner v[3], float px, float py);

plane_order plane_at_vertex; /**< anchored at the farthest vertex, that of the largest w */
plane_order plane_at_origin; /**< at the centre of the target's first pixel, two fused operations a pixel */
plane_order plane_unfused;   /**< the same, by multiply and add */
plane_order plane_stepped;   /**< gradients by one division of each, and a step to pixels of odd places */
plane_order plane_exact;     /**< in double, rounded once: what is left are the errors of the vertices */

#endif
