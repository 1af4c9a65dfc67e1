/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file frame_rows.h  One row of a product: between frame.c, which prepares the strips, and frame_rows.c. */
#ifndef TEXTURE_FRAME_ROWS_H
#define TEXTURE_FRAME_ROWS_H

#include "texture/frame.h"

enum { FRAME_NUMBERS = 8 };

/** What a row is made of. */
typedef struct frame_row {
    const frame *frame;
    const frame_product *product;
    const position_state *position;
    const float *slope_x; /**< of column 0, with the same margins as the eye depths */
    uint32_t row;
    const uint32_t *codes;
    const float *depth;                      /**< window depth, FRAME_POSITION only */
    const float *eyes[2 * NORMAL_REACH + 1]; /**< eye depths of this row and its neighbours, as in normal_rows */
    float *planes[3];                        /**< room for three times the width */
    grain_memo *memo;                        /**< of a thread's own */
    double *numbers;                         /**< room for FRAME_NUMBERS times the width */
    float *out;
} frame_row;

typedef void frame_make(const frame_row *in);

/** By kind, and error or not. */
extern frame_make *const frame_makers[FRAME_KINDS][2];

#endif
