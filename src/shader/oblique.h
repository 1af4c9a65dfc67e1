/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file oblique.h  The eye depths of codes where they may differ from pixel to pixel: see projection.h.
 *
 * With k the constant of the pixel in d = k + e/z, carried as a sum of two doubles, z = e/(d - k). Bound: 2^-50
 * relative where |d - k| is above 2^-45 of the largest term of k. At d = k and beyond lies nothing, not even at
 * infinity: INFINITY stands for it.
 *
 * Distances along the rays, of a camera that is radial, are those of the set-up; eye depths are these over
 * camera_radial(), within 2^-48 (1 + half[0] + half[1]) relative: see depthprec(7).
 */
#ifndef SHADER_OBLIQUE_H
#define SHADER_OBLIQUE_H

#include "shader/camera.h"
#include "shader/sample_rounding.h"

/** The ranges of codes of pixels from (column, row) on to the right, as grain_ranges_of(); by that where the camera
 *  is shared. */
void pixel_ranges_of(const texture_camera *camera, const grain *g, uint32_t column, uint32_t row, const uint32_t *codes,
                     size_t count, const grain_rows *out);

/** Eye depths of a whole row of a camera that is not shared in binary32; NaN where there are none. Codes above
 *  code_max are skipped. */
void pixel_eyes(const texture_camera *camera, uint32_t row, const uint32_t *codes, float *eyes);

/** The same of one pixel as grain_range_of() and dp_stored() have it. */
grain_range pixel_range_of(const texture_camera *camera, const grain *g, uint32_t column, uint32_t row, uint32_t code);
double pixel_stored(const texture_camera *camera, uint32_t column, uint32_t row, uint32_t code);

#endif
