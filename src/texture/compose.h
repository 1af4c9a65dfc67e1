/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file compose.h  An effect on a picture of colours, as shaders mix it in. */
#ifndef TEXTURE_COMPOSE_H
#define TEXTURE_COMPOSE_H

#include "texture/frame.h"

/** An effect and the picture on which it is composed. Colours are taken as they are stored, from 0 to 1. */
typedef struct compose {
    const effect_row *row;
    const double *parameters;
    const image *picture; /**< IMAGE_U8 or IMAGE_U16, three channels, or four with alpha, which stays */
    double tint[4];       /**< red, green, blue, alpha */
} compose;

/**
 * A row of the picture. Between pixels it is bilinear, and beyond its border the outermost go on.
 * @param values  of the effect, three a pixel where row->mix is EFFECT_SMEARS; NaN leaves a pixel as it is
 * @param out     as many samples as the picture has in a row, of its type, rounded to nearest
 */
void compose_row(const compose *c, uint32_t row, const float *values, void *out);

#endif
