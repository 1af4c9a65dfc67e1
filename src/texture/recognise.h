/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file recognise.h  What is stored in a depth image: on which lattice its samples lie, and which way they run.
 */
#ifndef TEXTURE_RECOGNISE_H
#define TEXTURE_RECOGNISE_H

#include "depthprec/depthprec.h"
#include "texture/image.h"

/** What was found. */
typedef struct recognised {
    bool depth;              /**< finite samples, all in [0, 1] or codes of a format: it can be window depth */
    dp_format format;        /**< the coarsest of the named formats whose lattice holds every sample */
    bool certain;            /**< enough different samples to tell that lattice from the next finer one */
    int reversed;            /**< 1 reversed, 0 not, -1 cannot tell */
    size_t samples, invalid; /**< invalid: NaN, infinite or outside [0, 1] */
    size_t distinct;         /**< different values, counted up to some limit */
    size_t at_zero, at_one;
    double lo, hi; /**< of the valid samples, as window depth */
    char why[256]; /**< one sentence for people: how it was told */
} recognised;

/** Looks at channel 0 of every pixel. Never fails: an image that cannot be window depth has depth == false. */
void recognise(const image *image, recognised *out);

/** Whether integers of an image are codes of the format (else they are fractions of the type's maximum). */
bool recognise_codes(const image *image, const dp_format *format);

/**
 * The window depth of `count` pixels of a row from `column` on, channel 0: codes by their format, fractions of the
 * type's maximum, or the numbers themselves. NaN where it is not finite or outside [0, 1].
 */
void image_depths(const image *image, const dp_format *format, uint32_t row, uint32_t column, uint32_t count, float *d);

/** The same as codes of the format, the nearest where a sample is not on the lattice; UINT32_MAX where invalid. */
void image_codes(const image *image, const dp_format *format, uint32_t row, uint32_t column, uint32_t count,
                 uint32_t *codes);

#endif
