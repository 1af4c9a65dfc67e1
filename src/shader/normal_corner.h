/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file normal_corner.h  Bound of the error of an image's normals that are cross products of three places. */
#ifndef SHADER_NORMAL_CORNER_H
#define SHADER_NORMAL_CORNER_H

#include "shader/normal.h"

/** One of the three pixels. */
typedef struct normal_tap {
    double column, row;
    double stored; /**< eye depth */
    double reach;  /**< from there to the true one, at most */
} normal_tap;

/**
 * The largest angle, radians, between the normal that a method other than "projective" finds and that of the plane
 * through the three true places, each on its pixel's ray within `reach` of what is stored. Derived in depthprec(7).
 *
 * @param taps     the pixel, and those beside and above or below it that were taken
 * @param reading  relative error of reading eye depths back
 * @return pi where the errors could turn the triangle round
 */
double normal_corner_bound(const texture_camera *camera, const normal_row *method, const normal_tap taps[3],
                           double reading);

#endif
