/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file camera.h  The camera behind a depth image: what turns a pixel and its eye depth into a place.
 *
 * View space is left-handed, as Unity's world: x to the right, y up, z along the view axis, so z is the eye depth.
 * Pixel (column i, row j) of a width x height image has its centre at u = (i + 1/2)/width from the left edge and
 * v = 1 - (j + 1/2)/height from the bottom edge: row 0 is the top one. With the half extents (hx, hy), which are
 * tangents of half the field of view (perspective) or scene units (orthographic):
 *
 *     perspective    (x, y, z) = (sx z, sy z, z)     sx = (2u - 1 - cx) hx,  sy = (2v - 1 - cy) hy
 *     orthographic   (x, y, z) = (sx, sy, z)
 *     world          origin + x right + y up + z forward
 *
 * (cx, cy) is where the view axis meets the picture, 0 but for the frustums of some matrices: see projection.h.
 */
#ifndef SHADER_CAMERA_H
#define SHADER_CAMERA_H

#include <math.h>
#include <stdbool.h>

#include "core/bits.h"
#include "core/expansion.h"
#include "depthprec/depthprec.h"
#include "image/image.h"

/** The camera asked for. Start from camera_spec_default(). */
typedef struct camera_spec {
    uint32_t width, height;
    double fov_y;                /**< perspective: vertical field of view in degrees, in [0.01, 179] */
    double half_height;          /**< orthographic: half the height of the view, scene units, in [1e-12, 1e12] */
    double yaw, pitch;           /**< degrees: to the right, then up; 0, 0 looks along the world's z axis */
    double origin[3];            /**< where the camera stands, world coordinates, each at most 1e12 in magnitude */
    const dp_projection *matrix; /**< says what fov_y and half_height would; or null */
    bool radial;                 /**< depths of the set-up are distances along the rays; perspective alone */
} camera_spec;

/** 60 degrees, half height 5, looking along z from the origin; width and height 0: to be filled in. */
camera_spec camera_spec_default(void);

/** Turns it so that it looks at a place, y upwards; straight up or down with yaw 0. @return false where it stands there
 */
bool camera_look(camera_spec *spec, const double at[3]);

/** Where each pixel has planes of its own: its window depth is column (2i + 1 - width) + row (height - 1 - 2j) + base
 *  + pull/z. */
typedef struct camera_oblique {
    bool on;
    double pull;
    dp_pair column, row, base;
} camera_oblique;

/** A checked camera. The fields are for reading. */
typedef struct texture_camera {
    dp_setup setup; /**< planes, projection, mapping, format */
    uint32_t width, height;
    bool ortho;
    double half[2];   /**< hx, hy */
    double centre[2]; /**< cx, cy */
    camera_oblique oblique;
    bool radial;       /**< a pixel's eye depth is that of the set-up over its camera_radial() */
    double axis[3][3]; /**< right, up, forward: world coordinates, orthonormal */
    double origin[3];
} texture_camera;

/** @return null, or what is wrong: one sentence that names the field, what is allowed and what was given */
const char *camera_init(texture_camera *camera, const dp_setup *setup, const camera_spec *spec);

/** Whether a code has one eye depth in all pixels, that of the set-up. */
static inline bool camera_is_shared(const texture_camera *c) {
    return !c->oblique.on && !c->radial;
}

/** Whether the frustum is centred and its planes are those of the set-up. */
static inline bool camera_is_centred(const texture_camera *c) {
    return c->centre[0] == 0 && c->centre[1] == 0 && camera_is_shared(c);
}

/** sx of column i and sy of row j: see above. Within 2 units of 2^-53 relative at whole columns and rows; where the
 *  frustum is not centred 4 units of the larger of hx and hx cx, hy and hy cy. */
DP_INLINE double camera_slope_x(const texture_camera *c, double i) {
    return ((2 * i + 1 - c->width) / c->width - c->centre[0]) * c->half[0];
}
DP_INLINE double camera_slope_y(const texture_camera *c, double j) {
    return ((c->height - 2 * j - 1) / c->height - c->centre[1]) * c->half[1];
}

/** The view-space place of a pixel at eye depth z, in double: the reference of everything that is faster. */
DP_INLINE void camera_view(const texture_camera *camera, double i, double j, double z, double view[3]) {
    const double scale = camera->ortho ? 1 : z;
    view[0] = camera_slope_x(camera, i) * scale;
    view[1] = camera_slope_y(camera, j) * scale;
    view[2] = z;
}

/** Turns a place in view space to the world's axes; the world's place is `origin` more. */
DP_INLINE void camera_turn(const texture_camera *camera, const double view[3], double world[3]) {
    for (int i = 0; i < 3; i++)
        world[i] = camera->axis[0][i] * view[0] + camera->axis[1][i] * view[1] + camera->axis[2][i] * view[2];
}

/** Distance from the camera (perspective: the ray's length) per unit of eye depth; orthographic: 1. */
DP_INLINE double camera_radial(const texture_camera *camera, double i, double j) {
    const double x = camera_slope_x(camera, i), y = camera_slope_y(camera, j);
    return camera->ortho ? 1 : sqrt(x * x + y * y + 1);
}

#endif
