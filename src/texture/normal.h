/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file normal.h  Normals from depth: cross products of differences of neighbouring places, a row each.
 */
#ifndef TEXTURE_NORMAL_H
#define TEXTURE_NORMAL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "texture/camera.h"

/** Rows that a method looks at above and below its own, at most. */
enum { NORMAL_REACH = 2 };

/** Eye depths around row `row`: rows[NORMAL_REACH + k] is row + k, clamped to the image; binary32, `width` each, with
 *  NORMAL_REACH more on either side that repeat the border. Sky is NaN. */
typedef struct normal_rows {
    const texture_camera *camera;
    const float *slope_x; /**< camera_slope_x() of each column, with the same margins (of columns beyond the border) */
    uint32_t row;
    const float *rows[2 * NORMAL_REACH + 1];
} normal_rows;

typedef struct normal_row {
    const char *name; /**< "low", "medium", "high", "projective" */
    const char *note;
    int reach; /**< 1 or 2 */
    const char *source;
    /** View-space unit normals that face the camera, three planes of `width`; NaN where a neighbour is sky. */
    void (*run)(const normal_rows *in, float *nx, float *ny, float *nz);
} normal_row;

const normal_row *normal_get(size_t index);
const normal_row *normal_find(const char *name);

/** The normal of the plane (view space) in double from exact slopes: angle between two, radians, without cancellation.
 */
double normal_angle(const double a[3], const double b[3]);

/**
 * A bound on the angular error of the method "projective" on a plane whose stored eye depths are off by at most
 * `half` in 1/z: derived in depthprec(7).
 */
double normal_plane_bound(const texture_camera *camera, uint32_t column, uint32_t row, const double plane[4],
                          double half);

#endif
