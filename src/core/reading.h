/* SPDX-License-Identifier: MIT */
/* For the rooms above too: samples of an image as they are, as window depths, and as codes. Pixels are counted along
 * the rows. */
#ifndef CORE_READING_H
#define CORE_READING_H

#include <stdbool.h>

#include "depthprec/batch.h"
#include "depthprec/recognise.h"

/* A sample as it is; NaN for the infinities of binary16. */
double dp_image_number(const dp_image *image, size_t pixel);

/*
 * Whether integers of a type are codes of the format, which is so where the type has at least as many bits as the
 * codes; else they are shares of the type's maximum.
 */
bool dp_image_holds_codes(dp_image_type type, const dp_format *format);

/* How samples are read in a format, which for binary16 is always its own. */
typedef struct dp_reading {
    const dp_image *image;
    dp_format format;
    bool codes;
    dp_real real;    /* of what is read: binary32 for F16 and F32 alone */
    dp_batch decode; /* codes alone */
} dp_reading;

void dp_reading_begin(dp_reading *r, const dp_image *image, const dp_format *format, dp_real real);

/*
 * The window depth of pixels, of a reading in double: codes by their format, shares of the type's maximum, correctly
 * rounded, or the numbers themselves. NaN where it is not finite or outside [0, 1], or above code_max; never -0.
 */
void dp_reading_depths(const dp_reading *r, size_t first, size_t count, double *d);

/* The same as codes of the format, the nearest where a sample is not on the lattice; UINT32_MAX where invalid (and for
 * 1 in unorm32). */
void dp_image_codes(const dp_image *image, const dp_format *format, size_t first, size_t count, uint32_t *codes);

#endif
