/* SPDX-License-Identifier: MIT */
/* Slanted triangles in a budget; depthprec(7), "Slanted triangles", derives every line. */
#ifndef CORE_TRIANGLES_H
#define CORE_TRIANGLES_H

#include "core/chain.h"
#include "core/composition.h"
#include "depthprec/budget.h"

/* The constants of view, rasterizer and class of triangles that hold at every depth. */
typedef struct dp_slant {
    double pixel, ray, vertex_ray; /* scene units a pixel at z = 1; how far beside the axis rays lie there, of pixels
                                      and of vertices */
    double vertex_x, vertex_y;     /* the latter on each axis */
    double box;                    /* the area of the box around a triangle over twice its own, at most */
    double snap, snapped;          /* by how much a coordinate of a vertex moves, and a vertex; pixels */
    double lo, hi;                 /* the slants, radians */
    double longest;                /* along a ray, of a normal's length, at the slant where that is most */
} dp_slant;

dp_slant dp_slant_make(const dp_triangles *t);

/* The rows of clip x and y, and the rays of vertices. */
dp_composed_view dp_triangles_view(const dp_triangles *t, const dp_slant *slant);

/*
 * The depths of the vertices of pixels at the depths of a run: from z/k to z k, between the planes, and then as far as
 * a composition moves them (null: none). lo is 0 where it may move them behind the eye.
 */
dp_span dp_triangles_depths(const dp_chain *c, dp_span run, const dp_triangles *t, const dp_composed_vertex *moved);

/*
 * Turns the budget of surfaces that face the camera into that of slanted ones, the farther at any depth of a run; never
 * less. `asked` is window depth for interpolation and linearization, the other causes are not read. `moved` is what a
 * composition does to vertices, null for none; what that adds counts as set-up.
 */
void dp_triangles_add(const dp_chain *c, dp_span run, const dp_triangles *t, const dp_slant *slant,
                      const double asked[DP_CAUSE_COUNT], const dp_composed_vertex *moved, dp_budget *out);

#endif
