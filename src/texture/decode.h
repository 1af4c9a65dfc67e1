/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file decode.h  What shaders make of a stored depth: eye depth and its shares, a row each.
 */
#ifndef TEXTURE_DECODE_H
#define TEXTURE_DECODE_H

#include <stdbool.h>
#include <stddef.h>

#include "depthprec/depthprec.h"

/** What a decoding gives. */
typedef enum decode_quantity {
    DECODE_EYE = 0, /**< eye depth z, scene units */
    DECODE_01,      /**< z/f */
    DECODE_01_NEAR, /**< (z - n)/(f - n) */
    DECODE_QUANTITIES
} decode_quantity;

/** _ZBufferParams as an engine uploads it: formed in double, rounded once to binary32. */
typedef struct zbuffer_params {
    float x, y, z, w;
} zbuffer_params;
zbuffer_params zbuffer_params_of(const dp_setup *setup);

typedef struct decode_row {
    const char *name; /**< "linear-eye", "linear-01", "linear-01-near", "ortho-eye", "complement" */
    const char *note; /**< the formula */
    decode_quantity quantity;
    bool perspective, ortho; /**< for which projections */
    bool far_infinite;
    const char *source;
    /** In binary32, as a shader does, `count` window depths. In place is allowed. */
    void (*run)(const dp_setup *setup, const float *d, float *out, size_t count);
} decode_row;

const decode_row *decode_get(size_t index); /**< null beyond the last */
const decode_row *decode_find(const char *name);

/** Does the row apply to the set-up's curve, projection and far plane? */
bool decode_applies(const decode_row *row, const dp_setup *setup);

/** The same quantity exactly, rounded to double: the reference. `d` is taken as it is. */
double decode_exact(const dp_setup *setup, decode_quantity quantity, double d);

#endif
