/* SPDX-License-Identifier: MIT */
/* Slanted triangles in a budget; depthprec(7), "Slanted triangles", derives every line. */
#ifndef CORE_TRIANGLES_H
#define CORE_TRIANGLES_H

#include "core/chain.h"
#include "core/composition.h"
#include "depthprec/budget.h"

/* The rows of clip x and y, and the rays of vertices. */
dp_composed_view dp_triangles_view(const dp_triangles *t);

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
void dp_triangles_add(const dp_chain *c, dp_span run, const dp_triangles *t, const double asked[DP_CAUSE_COUNT],
                      const dp_composed_vertex *moved, dp_budget *out);

#endif
