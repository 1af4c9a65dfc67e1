/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file image_depths.h  Samples of an image as they are, as window depths, and as codes. */
#ifndef FRAME_IMAGE_DEPTHS_H
#define FRAME_IMAGE_DEPTHS_H

#include "depthprec/depthprec.h"
#include "image/image.h"

/** Channel 0 of a pixel, counted along the rows, as it is; NaN for the infinities of f2. */
double image_sample(const image *image, size_t pixel);

/**
 * Whether integers of an image are codes of the format, which is so where the type has at least as many bits as the
 * codes; else they are shares of the type's maximum.
 */
bool image_are_codes(const image *image, const dp_format *format);

/**
 * The window depth of `count` pixels of a row from `column` on, channel 0: codes by their format, shares of the type's
 * maximum, correctly rounded, or the numbers themselves. NaN where it is not finite or outside [0, 1], or above
 * code_max; never -0.
 */
void image_depths(const image *image, const dp_format *format, uint32_t row, uint32_t column, uint32_t count,
                  double *d);

/** The same as codes of the format, the nearest where a sample is not on the lattice; UINT32_MAX where invalid (and for
 *  1 in unorm32). */
void image_codes(const image *image, const dp_format *format, uint32_t row, uint32_t column, uint32_t count,
                 uint32_t *codes);

#endif
