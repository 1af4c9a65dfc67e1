/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file synthetic.h  Synthetic images: a ray through a pixel's centre meets a surface at a known depth.
 *
 * Everything is a closed formula in double: eye depths and normals are good to a few units of 2^-53, but for pixels
 * that graze a sphere's rim. What lies outside [near, far] is not drawn.
 */
#ifndef TEXTURE_SYNTHETIC_H
#define TEXTURE_SYNTHETIC_H

#include "core/named.h"
#include "shader/camera.h"
#include "shader/parameter.h"

/** The surface that a pixel sees. */
typedef struct synthetic_hit {
    double z;         /**< eye depth; INFINITY for sky */
    double normal[3]; /**< view space, unit, towards the camera; zero for sky */
    int surface;      /**< 0 sky; pixels of different surfaces meet in a silhouette */
} synthetic_hit;

/** Two surfaces. */
typedef struct synthetic_pair {
    double front, back; /**< eye depths */
    double at[2];       /**< where in the image they meet: shares of its width and height */
} synthetic_pair;

typedef struct synthetic_row {
    NAMED_FIELDS;
    /** The nearest hit at a pixel's centre (or between: column and row need not be whole). */
    void (*hit)(const texture_camera *camera, const double *parameters, double column, double row, synthetic_hit *out);
    /** Pair `index` of surfaces, one behind the other, that a depth buffer should tell apart. Null where there are
     *  none. @return false behind the last */
    bool (*pair)(const double *parameters, size_t index, synthetic_pair *out);
    texture_parameter parameters[PARAMETERS_MAX + 1];
} synthetic_row;

enum { SYNTHETIC_PLANE = 0, SYNTHETIC_SPHERE, SYNTHETIC_STEPS, SYNTHETIC_DECALS, SYNTHETIC_ROWS };
extern const synthetic_row synthetic_rows[SYNTHETIC_ROWS];

NAMED_ROWS(synthetic_row, synthetic);

/** The codes that a row of pixels stores: dp_code() of each hit, the far plane's code for sky. */
void synthetic_codes(const synthetic_row *synthetic, const texture_camera *camera, const double *parameters,
                     uint32_t row, uint32_t *codes);

#endif
