/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file scene.h  Synthetic scenes with exact answers: a ray through a pixel's centre meets a surface at a known depth.
 *
 * Everything is a closed formula in double: eye depths and normals are good to a few units of 2^-53, but for pixels
 * that graze a sphere's rim. What lies outside [near, far] is not drawn.
 */
#ifndef TEXTURE_SCENE_H
#define TEXTURE_SCENE_H

#include "texture/camera.h"
#include "texture/parameter.h"

/** What a pixel sees. */
typedef struct scene_hit {
    double z;         /**< eye depth; INFINITY for sky */
    double normal[3]; /**< view space, unit, towards the camera; zero for sky */
    int surface;      /**< 0 sky; pixels of different surfaces meet in a silhouette */
} scene_hit;

/** Two surfaces. */
typedef struct scene_pair {
    double front, back; /**< eye depths */
    double at[2];       /**< where in the image they meet: shares of its width and height */
} scene_pair;

typedef struct scene_row {
    const char *name; /**< "plane", "sphere", "steps", "decals" */
    const char *note;
    /** The nearest hit at a pixel's centre (or between: column and row need not be whole). */
    void (*hit)(const texture_camera *camera, const double *parameters, double column, double row, scene_hit *out);
    /** Pair `index` of surfaces, one behind the other, that a depth buffer should tell apart. Null where a scene has
     *  none. @return false behind the last */
    bool (*pair)(const double *parameters, size_t index, scene_pair *out);
    texture_parameter parameters[TEXTURE_PARAMETERS + 1];
} scene_row;

enum { SCENE_PLANE = 0, SCENE_SPHERE, SCENE_STEPS, SCENE_DECALS, SCENE_ROWS };
extern const scene_row scene_rows[SCENE_ROWS];

const scene_row *scene_get(size_t index); /**< null beyond the last */

/** The codes that a row of pixels stores: dp_code() of each hit, the far plane's code for sky. */
void scene_codes(const scene_row *scene, const texture_camera *camera, const double *parameters, uint32_t row,
                 uint32_t *codes);

#endif
