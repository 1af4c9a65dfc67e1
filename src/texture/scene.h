/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file scene.h  Synthetic scenes with exact answers: a ray through a pixel's centre meets a surface at a known depth.
 */
#ifndef TEXTURE_SCENE_H
#define TEXTURE_SCENE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "texture/camera.h"

/** What a pixel sees. */
typedef struct scene_hit {
    double z;         /**< eye depth; INFINITY for sky */
    double normal[3]; /**< view space, unit, towards the camera */
    int surface;      /**< 0 sky; pixels of different surfaces meet in a silhouette */
} scene_hit;

typedef struct scene_row {
    const char *name; /**< "plane", "sphere", "steps", "decals" */
    const char *note;
    /** The nearest hit at a pixel's centre (or between: column and row need not be whole). */
    void (*hit)(const texture_camera *camera, const double *parameters, double column, double row, scene_hit *out);
    struct {
        const char *name, *unit;
        double lo, hi, value;
    } parameters[4]; /**< a null name ends them */
} scene_row;

const scene_row *scene_get(size_t index);
const scene_row *scene_find(const char *name);

/** The codes that a row of pixels stores: dp_code() of each hit, the far plane's code for sky. */
void scene_codes(const scene_row *scene, const texture_camera *camera, const double *parameters, uint32_t row,
                 uint32_t *codes);

#endif
