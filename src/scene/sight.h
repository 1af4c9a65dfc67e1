/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file sight.h  What an eye in a model sees of two surfaces that are nearly in one place, and whether they fight
 * there.
 *
 * An eye *sees* an overlap where some of it lies between the planes of its camera and within the sides of the view, and
 * both triangles are drawn: their front is towards the eye, or they are two-sided. Whatever else stands in between is
 * not looked at: the overlap may be out of sight behind a wall. What is turned away by less than 2^-8 radians counts as
 * seen, because vertices that move to a grid may turn a narrow triangle round.
 *
 * The guarantee is that of the very triangles: dp_triangles with their own slants, depths, pixels and slimness as this
 * eye has them. Where there is none, because a vertex lies before near or beyond far, or the triangle is slimmer or
 * larger than the library takes, or a side of the view cuts it and the rasterizer's depth is anchored at the window's
 * origin, the class of the set-up stands for them; what is told apart that way alone is not *covered*.
 *
 * The pixels judged are those whose ray meets both surfaces within the overlap. Beside its edge a ray may meet the one
 * and, behind it, more of the other.
 */
#ifndef SCENE_SIGHT_H
#define SCENE_SIGHT_H

#include <stdbool.h>
#include <stddef.h>

#include "depthprec/setup.h"
#include "scene/eye.h"
#include "scene/find.h"

/** Distances are measured to this share of the model's extent: what is less is none. */
#define SCENE_NO_GAP 1e-12

/** Eye depths, scene units. */
typedef struct scene_sight {
    double seen_from, seen_to; /**< of the overlaps in view; NaN where none is */
    double fights_from;        /**< the least depth at which they can fight: nearer, all that is seen is told apart;
                                    NaN where all is */
    double lift;               /**< what would have to be added to their distance so that all that is seen nearer than
                                    asked is told apart, judged again with either of them moved, and where they touch
                                    or cross either way; 0 where it is; INFINITY where no distance was found */
    dp_triangles triangles;    /**< the class of all triangles by which it was judged; width 0: none was */
    bool covered;              /**< false: all is told apart, but some of it only in triangles of the class */
    size_t eye;                /**< its index */
} scene_sight;

typedef struct sight_asked {
    const model *m;
    const finder_found *found;
    const dp_setup *setup; /**< a perspective whose triangles say the view, width not 0 */
    double within;         /**< eye depth up to which a lift is wanted; 0: as far as they are seen */
    double gap;            /**< of the search, see finder_corners() */
    bool any_side;         /**< triangles are drawn whichever way they face */
    bool classes;          /**< the class of the answer is that of all eyes, not of the worst alone */
    const scene_eye *eye;
    size_t eyes;        /**< at least one */
    bool (*stop)(void); /**< asked at each pair; true ends it, and the answer is then of no use. May be null */
} sight_asked;

/**
 * The length to add to the distance of a finding, along any of its normals, so that it grows by `lift` everywhere:
 * more where triangles are tilted against each other; infinite where they meet in some places and part in others, which
 * no distance mends.
 */
double scene_lift(const model *m, const finder_found *found, const finder_finding *f, double lift);

/**
 * Judges a finding from the eye from which it is worst: where it fights nearest; else where it is not covered; else
 * where it is seen from nearest. Of several that are alike the first.
 * @param sight  room for asked->eyes, to work in
 */
scene_sight scene_sight_worst(const sight_asked *asked, const finder_finding *f, scene_sight *sight);

#endif
