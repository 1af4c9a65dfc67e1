/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file reach.h  What a scheme leaves of a depth buffer and of a picture, and how far from the origin that is enough.
 */
#ifndef WORLD_REACH_H
#define WORLD_REACH_H

#include "depthprec/depthprec.h"
#include "world/world.h"

/** Who looks at what, but for the distance from the origin. */
typedef struct world_asked {
    const dp_setup *setup; /**< perspective, or a box no wider than `lean` says */
    double z;              /**< eye depth in [near, far], finite and positive */
    double ray_ratio;      /**< no place is farther from the camera than this times its eye depth; from 1 to 1e7 */
    double pixels;         /**< of the picture's height that a tangent of 1 takes: height/(2 tan(fov/2)) */
    bool shared_origin;    /**< both surfaces are of meshes about one origin */
} world_asked;

/** The largest distance that is asked about, scene units. */
#define WORLD_FARTHEST 1e12

/** The bound of view z of a place at the depth asked about, in any direction that the camera sees. */
double world_off(const world_scheme *s, const world_asked *a, double distance);

/**
 * The budget of the set-up at that depth, with the scheme in front of it: the separation is that of surfaces that are
 * surely stored in the right order.
 *
 * @param terms  what else is added; its displacement becomes that of the scheme, its world 0
 * @return as dp_budget_at()
 */
dp_status world_budget(const world_scheme *s, const world_asked *a, double distance, dp_budget_terms *terms,
                       dp_budget *out);

/** Its separation; INFINITY where none is certain. */
double world_separation(const world_scheme *s, const world_asked *a, double distance);

/** The same for each depth of [lo, hi], in [near, far] and finite; a->z is not read. */
double world_separation_over(const world_scheme *s, const world_asked *a, double distance, double lo, double hi);

/**
 * By how many pixels a place in the middle of the picture is off at most, along either axis, before it moves to a
 * subpixel grid. INFINITY: it may be behind the camera.
 */
double world_jitter(const world_scheme *s, const world_asked *a, double distance);

/** One of the two above. Both rise with the distance. */
typedef double world_loss(const world_scheme *s, const world_asked *a, double distance);

/**
 * The largest distance up to which it is at most `limit`, rounded down by no more than 1e-9 of itself; 0: nowhere;
 * WORLD_FARTHEST: as far as is asked.
 */
double world_reach(world_loss *loss, const world_scheme *s, const world_asked *a, double limit);

#endif
