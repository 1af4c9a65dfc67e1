/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file eye.h  Where a camera stands in a model, and how it looks: from a place to a place, or a camera of the file.
 */
#ifndef SCENE_EYE_H
#define SCENE_EYE_H

#include <stdbool.h>
#include <stddef.h>

#include "model/model.h"

/** The directions have length 1 and are at right angles: right is ahead x up, to 2^-50. */
typedef struct scene_eye {
    double place[3]; /**< scene units */
    double right[3], up[3], ahead[3];
    size_t line; /**< of the file that it was read from, counted from 1; 0: of none */
} scene_eye;

/**
 * An eye at `from` that looks at the place `at`. Up on the screen is `up`, as far as that is at right angles to the
 * look; where it is along the look (within 1e-6), the axis that is farthest from the look takes its place.
 *
 * @param from, at  scene units, magnitudes up to 1e50
 * @param up        not 0
 * @return false where both places are the same or a number is not finite; *out is then left as it was
 */
bool scene_eye_look(const double from[3], const double at[3], const double up[3], scene_eye *out);

/** A camera of a file. @return false where it looks nowhere: its node has no extent along its axis */
bool scene_eye_of(const model_camera *camera, scene_eye *out);

/** A place as the eye sees it: to the right, upwards, and ahead, which is the eye depth. Scene units. */
void scene_eye_sees(const scene_eye *eye, const double place[3], double seen[3]);

#endif
