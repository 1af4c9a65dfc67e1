/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file normal.h  Normals from depth, a row each: differences of a pixel and two neighbours, in binary32 as in a
 * shader.
 *
 * The methods differ in which neighbour they take on each axis, how many pixels away, and how they form the normal.
 * Missing depths are NaN: holes, whatever lies beyond the border of the image, and sky, unless the method sees it.
 * A method that can choose takes the other side then; where it cannot, or neither side is there, the normal is NaN.
 */
#ifndef SHADER_NORMAL_H
#define SHADER_NORMAL_H

#include "core/named.h"
#include "shader/camera.h"
#include "shader/sample_rounding.h"

/** Pixels that a method looks at in each direction, at most. */
enum { NORMAL_REACH = 4 };

/** `count` pixels of row `row` from column `column` on, and what lies around them. */
typedef struct normal_rows {
    const texture_camera *camera;
    uint32_t row, column, count;
    const float *slope_x; /**< camera_slope_x() of `column`; readable NORMAL_REACH before it and after the last */
    /** Eye depths of `column` in row `row` + k are rows[NORMAL_REACH + k], readable likewise; in [1e-30, 1e30] or NaN.
     */
    const float *rows[2 * NORMAL_REACH + 1];
} normal_rows;

/** Which neighbours were taken: bits. Left or right is then the one, below or above the other. */
enum { NORMAL_LEFT = 1, NORMAL_BELOW = 2 };

typedef struct normal_row {
    NAMED_FIELDS;
    int step;  /**< pixels to the neighbours */
    int reach; /**< pixels that are looked at in each direction */
    /** View-space unit normals that face the camera, `count` in each plane. The same bits on every processor. Those in
     *  binary16 are of places in binary16, along the camera's axes: NaN where these coincide or are beyond 65504. */
    void (*run)(const normal_rows *in, float *nx, float *ny, float *nz);
    /** The neighbours that run() takes. */
    void (*sides)(const normal_rows *in, uint8_t *sides);
    bool half;     /**< places and normals in binary16 */
    bool half_uv;  /**< the neighbours' shares of the picture, from the left and from below, and depths before that */
    bool sees_sky; /**< as the shader does, whose depth texture holds the far plane there; the sky itself has none */
} normal_row;

enum {
    NORMAL_LOW = 0,
    NORMAL_MEDIUM,
    NORMAL_MEDIUM_1,
    NORMAL_HIGH,
    NORMAL_HIGH_1,
    NORMAL_PROJECTIVE,
    NORMAL_LOW_HALF,
    NORMAL_MEDIUM_HALF,
    NORMAL_HIGH_HALF,
    NORMAL_METHODS
};
extern const normal_row normal_methods[NORMAL_METHODS];

NAMED_ROWS(normal_row, normal);

/** The angle between two vectors, radians in [0, pi], of any length and without cancellation; NaN for a null vector. */
double normal_angle(const double a[3], const double b[3]);

/** A plane of view space: the points p with normal . p = offset. */
typedef struct normal_plane {
    double normal[3];
    double offset;
} normal_plane;

/** The plane through what a pixel sees at eye depth z; the normal need not be of unit length. */
normal_plane normal_plane_at(const texture_camera *camera, double column, double row, double z, const double normal[3]);

/** The eye depth at which a pixel's ray meets a plane; negative, infinite or NaN where it does not. */
double normal_plane_depth(const texture_camera *camera, const normal_plane *plane, double column, double row);

/**
 * How far the stored depths of a plane are off at most, in a pixel and the four next to it that the image has: of 1/z,
 * or of z where the camera is orthographic. Half a cell each, and what reading the depth back into binary32 adds.
 *
 * @param reading  relative error of that, 2^-24 for one rounding
 * @return INFINITY where the plane is not between near and far in one of them
 */
double normal_plane_error(const texture_camera *camera, uint32_t column, uint32_t row, const normal_plane *plane,
                          double reading);

/** The same for samples of an image, which say less of the depth: see sample_rounding.h. Null: they are codes. */
double normal_plane_error_of(const texture_camera *camera, const grain *g, uint32_t column, uint32_t row,
                             const normal_plane *plane, double reading);

/**
 * The largest angular error, radians, that the method "projective" can make on a plane, whichever sides it takes, when
 * the eye depths it is given are off by at most `error` in 1/z (z where the camera is orthographic). Derived in
 * depthprec(7); some error within that limit reaches it, but for the rounding in binary32 that it includes.
 *
 * @return pi where the errors could turn the plane round
 */
double normal_plane_bound(const texture_camera *camera, uint32_t column, uint32_t row, const normal_plane *plane,
                          double error);

/** Planes through what the pixels of a row see, at eye depths z, with normals that were found. */
typedef struct normal_planes {
    const texture_camera *camera;
    uint32_t row;
    const float *normal[3];
    const double *z;
    grain_memo *memo; /**< of what is asked for; or null */
} normal_planes;

/** normal_plane_bound() of each with the error of normal_plane_error_of(), bit for bit; NaN where that is infinite. */
void normal_planes_bounds(const normal_planes *in, const grain *g, double reading, double *bounds);

#endif
