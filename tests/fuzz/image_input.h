/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file image_input.h  What the fuzz targets of images share: an image or a sentence, and nothing outside [0, 1]. */
#ifndef TESTS_FUZZ_IMAGE_INPUT_H
#define TESTS_FUZZ_IMAGE_INPUT_H

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "shader/camera.h"
#include "texture/image_depths.h"
#include "texture/recognise.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static inline void demand(int truth) {
    if (!truth)
        abort();
}

static inline void use_row(const image *img, const dp_format *format, uint32_t row) {
    double d[64];
    uint32_t codes[64];
    const uint32_t count = img->width < 64 ? img->width : 64;
    image_depths(img, format, row, img->width - count, count, d);
    image_codes(img, format, row, img->width - count, count, codes);
    for (uint32_t i = 0; i < count; i++) {
        demand(d[i] != d[i] || (d[i] >= 0.0 && d[i] <= 1.0));
        demand((d[i] != d[i]) == (codes[i] == UINT32_MAX) && (codes[i] <= format->code_max || d[i] != d[i]));
    }
}

static inline void use_image(const uint8_t *data, size_t size, image_file file) {
    image img = {.data = NULL};
    image_error error;
    if (!image_parse(data, size, &img, &error)) {
        demand(img.data == NULL && !error.unreadable && error.text[0] != '\0');
        for (const char *c = error.text; *c != '\0'; c++)
            demand(*c >= 0x20 && *c < 0x7f);
        return;
    }
    demand(img.file == file && image_holds(file, img.type, img.channels));
    demand(img.width >= 1 && img.height >= 1 && img.width <= IMAGE_SIDE_MAX && img.height <= IMAGE_SIDE_MAX);
    /* Deflate makes at most 258 bytes of two bits; other compressions of EXR and TIFF are bounded by their blocks. */
    if (file != IMAGE_EXR && file != IMAGE_TIFF)
        demand((uint64_t)img.width * img.height * img.channels * image_type_size(img.type) <=
               (uint64_t)size * (file == IMAGE_ROS ? 2064 : 1032)); /* which becomes twice as wide */
    dp_recognised found;
    char why[RECOGNISE_WHY_SIZE];
    recognise(&img, &found, why);
    demand(found.samples == (size_t)img.width * img.height && found.invalid <= found.samples);
    demand(found.depth == (found.invalid == found.holes && found.holes < found.samples) &&
           memchr(why, '\0', sizeof why) != NULL);
    demand(found.at_zero + found.at_one + found.invalid <= found.samples);
    demand(found.distinct <= found.samples && !(found.lo > found.hi) && !(found.lo < 0.0) && !(found.hi > 1.0));
    for (size_t i = 0; i < dp_format_count(); i++)
        use_row(&img, &dp_format_get(i)->format, img.height - 1);
    image_free(&img);
}

#endif
