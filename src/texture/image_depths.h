/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file image_depths.h  Channel 0 of an image, as reading.h reads it. */
#ifndef TEXTURE_IMAGE_DEPTHS_H
#define TEXTURE_IMAGE_DEPTHS_H

#include "core/reading.h"
#include "image/image.h"

_Static_assert((int)IMAGE_F64 == DP_IMAGE_F64 && (int)IMAGE_TYPE_COUNT == DP_IMAGE_TYPE_COUNT, "other types");

static inline dp_image image_channel(const image *img) {
    return (dp_image){img->data, (dp_image_type)img->type, img->width, img->height, img->channels};
}

static inline double image_sample(const image *img, size_t pixel) {
    const dp_image channel = image_channel(img);
    return dp_image_number(&channel, pixel);
}

static inline bool image_are_codes(const image *img, const dp_format *format) {
    return dp_image_holds_codes((dp_image_type)img->type, format);
}

/** Reads the depths of `count` pixels of a row, from x on. */
static inline void image_depths(const image *img, const dp_format *format, uint32_t row, uint32_t x, uint32_t count,
                                double *d) {
    const dp_image channel = image_channel(img);
    dp_reading r;
    dp_reading_begin(&r, &channel, format, DP_REAL_DOUBLE);
    dp_reading_depths(&r, (size_t)row * img->width + x, count, d);
}

static inline void image_codes(const image *img, const dp_format *format, uint32_t row, uint32_t x, uint32_t count,
                               uint32_t *codes) {
    const dp_image channel = image_channel(img);
    dp_image_codes(&channel, format, (size_t)row * img->width + x, count, codes);
}

#endif
