/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file synthetic_stage.h  A synthetic image before a camera that is turned and moved, and products of it as whole
 * images. */
#ifndef TESTS_SYNTHETIC_STAGE_H
#define TESTS_SYNTHETIC_STAGE_H

#include "texture/frame.h"

typedef struct synthetic_stage {
    texture_camera camera;
    double parameters[PARAMETERS_MAX];
    frame frame;
} synthetic_stage;

void synthetic_stage_between(synthetic_stage *s, const char *synthetic, const char *format, const char *mapping,
                             double znear, double zfar, bool ortho, uint32_t width, uint32_t height);
/** The same with the near plane at 0.1. */
void synthetic_stage_set(synthetic_stage *s, const char *synthetic, const char *format, const char *mapping,
                         double zfar, bool ortho, uint32_t width, uint32_t height);

/** A product as a whole image, rows from the top, and the order in which the strips came: for frame_run(). */
typedef struct whole {
    float *values;
    size_t row_values;
    uint32_t strips, rows, first;
} whole;

bool whole_take(void *context, uint32_t row, uint32_t count, const float *values);

/** A product as a whole image, rows from the top, malloc'ed. */
float *frame_made(const frame *f, const frame_product *p, bool bottom_up);

/** The codes of a synthetic as an image; the data is malloc'ed. */
image synthetic_stage_image(const synthetic_stage *s);

#endif
