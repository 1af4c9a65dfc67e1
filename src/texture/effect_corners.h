/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file effect_corners.h  For effect.c: effects that compare a pixel, or the corners around it, with one another.
 */
#ifndef TEXTURE_EFFECT_CORNERS_H
#define TEXTURE_EFFECT_CORNERS_H

#include "texture/rows.h"

/** Outputs from 0 to 1 are shown in so many levels. */
#define EFFECT_LEVELS 255.0

/** The constants of a row of pixels. */
typedef struct effect_work {
    const frame_row *in;
    const effect_row *row;
    const texture_camera *camera;
    const dp_setup *planes;
    const double *parameters;
    float rounded[PARAMETERS_MAX]; /**< the parameters, as uniforms */
    double reference;              /**< NaN where none is given */
    effect_pixel other;            /**< the reference, as uniforms */
    decode_constants eye, eye01;
    bool decodes; /**< eye01 by a decoding of its own; else eye depth times inverse_far */
    float inverse_far;
    float last[3][4];
} effect_work;

/** A pixel as the shader reads it. @param d  the window depth of the code */
effect_pixel effect_seen_as(const effect_work *w, uint32_t column, uint32_t row, uint32_t code, float d);

/** The output at a pixel of the row, in binary32; NaN at a hole. */
float effect_corners(const effect_work *w, uint32_t x);

/** The same, exactly for what is stored. */
double effect_corners_exact(const effect_work *w, uint32_t x);

/** Its error in levels: in a synthetic image the true one, in an image the largest possible; NaN at a hole. */
double effect_corners_error(const effect_work *w, uint32_t x);

#endif
