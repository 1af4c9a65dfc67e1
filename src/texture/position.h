/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file position.h  Ways from a window depth to a place, a row each, in binary32 as shaders do it.
 */
#ifndef TEXTURE_POSITION_H
#define TEXTURE_POSITION_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "texture/camera.h"

/** Constants that an engine would upload, prepared once for a camera. Each row uses what it needs. */
typedef struct position_state {
    const texture_camera *camera;
    float inverse[16];  /**< inverse view-projection, row-major */
    float corner[4][3]; /**< camera rays through the corners of the image: see position.c */
    float top_left[3], x_extent[3], y_extent[3], z_extent[3];
    float origin[3];
    float ray[3][3];       /**< plain: world ray = ray[0] u + ray[1] v + ray[2], times z */
    float z_scale, z_base; /**< eye depth, see decode.h */
} position_state;

typedef struct position_row {
    const char *name; /**< "matrix", "rays", "extents", "extents-half", "view" */
    const char *note;
    bool ortho; /**< has an orthographic form */
    const char *source;
    /** Places of `count` pixels of a row from `column` on: three planes, world coordinates. */
    void (*run)(const position_state *s, uint32_t row, uint32_t column, const float *d, size_t count, float *x,
                float *y, float *z);
} position_row;

const position_row *position_get(size_t index);
const position_row *position_find(const char *name);

/** @return false when the far plane or mapping has no such form */
bool position_prepare(position_state *s, const texture_camera *camera);

/** The place exactly (double arithmetic on the exact eye depth), and relative to the camera. */
void position_exact(const texture_camera *camera, uint32_t row, uint32_t column, double d, double world[3]);

/** Condition number (2-norm, by SVD) of the view-projection matrix; INFINITY when singular to double precision. */
double position_condition(const texture_camera *camera);

#endif
