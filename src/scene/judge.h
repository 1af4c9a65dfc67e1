/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file judge.h  From where two surfaces that are so far apart fight: for a camera, at any place and direction. */
#ifndef SCENE_JUDGE_H
#define SCENE_JUDGE_H

#include "depthprec/setup.h"

/** Eye depths, scene units. */
typedef struct scene_verdict {
    double certain_to; /**< told apart at every depth from near to here, rounded down; far where it is everywhere;
                            NaN where not even at near */
    double ties_from;  /**< from here to `within`, where they face the camera, every cell of depth is wider than their
                            distance, so that it may hold both and pixels tie; NaN where that is at no depth */
    double lift;       /**< what would have to be added to their distance for all depths up to `within`; 0 where that is
                            enough; INFINITY where no distance is */
} scene_verdict;

/**
 * Judges a distance of surfaces.
 *
 * certain_to: by dp_separation() of the set-up, in the model float the guaranteed one, at any slant where the set-up
 * has triangles. The distance is along the normal; surfaces that face the camera are meant where it has none.
 * ties_from: of the lattice. Where a cell is wider than the distance, the nearer surface may lie in its nearer part and
 * the other one in the same cell.
 * Both hold for parallel surfaces: `least` is for the first, `most`, as a distance nowhere is more, for the second.
 *
 * @param setup   a perspective
 * @param least   scene units, from 0
 * @param most    at least `least`
 * @param within  an eye depth in [near, far], finite
 */
scene_verdict scene_judge(const dp_setup *setup, double least, double most, double within);

#endif
