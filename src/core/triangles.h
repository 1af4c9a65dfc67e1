/* SPDX-License-Identifier: MIT */
/* Slanted triangles in a budget; depthprec(7), "Slanted triangles", derives every line. */
#ifndef CORE_TRIANGLES_H
#define CORE_TRIANGLES_H

#include "core/chain.h"
#include "depthprec/budget.h"

/* The depths of the vertices of pixels at the depths of a run: from z/k to z k, between the planes. */
dp_span dp_triangles_depths(const dp_chain *c, dp_span run, const dp_triangles *t);

/*
 * Turns the budget of surfaces that face the camera into that of slanted ones, the farther at any depth of a run; never
 * less. `asked` is window depth for interpolation and linearization, the other causes are not read.
 */
void dp_triangles_add(const dp_chain *c, dp_span run, const dp_triangles *t, const double asked[DP_CAUSE_COUNT],
                      dp_budget *out);

#endif
