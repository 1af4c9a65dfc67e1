/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file rows.h  One row of a product: between frame.c, which prepares the strips, and rows.c. */
#ifndef TEXTURE_ROWS_H
#define TEXTURE_ROWS_H

#include <math.h>

#include "core/bits.h"
#include "shader/oblique.h"
#include "texture/frame.h"

enum { FRAME_NUMBERS = 8 };

/** The inputs from which a row of a product is made. */
typedef struct frame_row {
    const frame *frame;
    const frame_product *product;
    const position_state *position;
    const float *slope_x; /**< of column 0, with the same margins as the eye depths */
    uint32_t row;
    const uint32_t *codes;                   /**< rows beside it, as far as the image goes, lie a width apart */
    const float *depth;                      /**< window depth; of FRAME_RAW, FRAME_POSITION and FRAME_EFFECT only */
    const float *eyes[2 * NORMAL_REACH + 1]; /**< eye depths of this row and its neighbours, as in normal_rows */
    const float *seen[2 * NORMAL_REACH + 1]; /**< the same with sky at far; null unless a product sees it */
    float *planes[3];                        /**< room for three times the width */
    bool found;                              /**< the planes hold this product, whose error is wanted */
    const dp_batch *stored;                  /**< codes to eye depths in double */
    grain_memo *memo;                        /**< of a thread's own */
    double *numbers;                         /**< room for FRAME_NUMBERS times the width */
    float *out;
} frame_row;

typedef void frame_make(const frame_row *in);

/** The true surface in a pixel of a synthetic image; z is NaN where it is sky, or counts as such. */
static inline synthetic_hit frame_truth(const frame_row *in, uint32_t x) {
    synthetic_hit hit;
    in->frame->synthetic->hit(in->frame->camera, in->frame->parameters, x, in->row, &hit);
    if (isinf(hit.z) && in->frame->sky < 0)
        hit = (synthetic_hit){.z = frame_planes(in->frame)->spec.zfar, .normal = {0, 0, -1}};
    if (isinf(hit.z) || isnan(in->eyes[NORMAL_REACH][x]))
        hit.z = NAN;
    return hit;
}

/** The depths that a code stands for, kept because neighbours often share one. */
typedef struct frame_ranges {
    uint32_t code;
    grain_range range;
} frame_ranges;

static inline frame_ranges frame_no_range(void) {
    return (frame_ranges){.code = UINT32_MAX};
}

static inline const grain_range *frame_range_of(const frame_row *in, frame_ranges *last, uint32_t x) {
    const texture_camera *c = in->frame->camera;
    const uint32_t code = in->codes[x];
    if (code != last->code || !camera_is_shared(c))
        *last = (frame_ranges){code, pixel_range_of(c, in->frame->grain, x, in->row, code)};
    return &last->range;
}

/** An error map must not be below the error: the nearest binary32 number that is not. A few roundings to double came
 *  before. */
DP_INLINE float frame_upwards(double error) {
    return dp_float_up(error * (1 + DP_ROUNDINGS_30));
}

/** The exact place at z, from the camera, along the world's axes. */
static inline void frame_exact_place(const frame_row *in, uint32_t x, double z, double relative[3]) {
    double view[3];
    camera_view(in->frame->camera, x, in->row, z, view);
    camera_turn(in->frame->camera, view, relative);
}

/** World places of what is stored, in the planes. */
static inline void frame_exact_places(const frame_row *in) {
    const texture_camera *c = in->frame->camera;
    for (uint32_t x = 0; x < c->width; x++) {
        double relative[3] = {(double)NAN, (double)NAN, (double)NAN};
        if (!isnan(in->eyes[NORMAL_REACH][x]))
            frame_exact_place(in, x, pixel_stored(c, x, in->row, in->codes[x]), relative);
        for (int k = 0; k < 3; k++)
            in->planes[k][x] = (float)(c->origin[k] + relative[k]);
    }
}

/** Those of FRAME_EFFECT, in effect.c. */
frame_make frame_effect, frame_effect_error;

/** The functions that make rows: by kind, and error or not. */
extern frame_make *const frame_makers[FRAME_KINDS][2];

#endif
