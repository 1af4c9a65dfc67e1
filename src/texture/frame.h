/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file frame.h  A whole depth image, or a synthetic one, through decoding, positions, normals and effects.
 *
 * Work goes over strips of rows on all cores, as strips.h has it, and the bits do not depend on the number of threads.
 * Besides the image no more than a few strips are in memory: of a product and its error up to 8192 pixels wide 40 MiB
 * in all and 2 MiB a thread (tests/bench_maps.c measures 3840 pixels).
 */
#ifndef TEXTURE_FRAME_H
#define TEXTURE_FRAME_H

#include "image/image.h"
#include "shader/camera.h"
#include "shader/decode.h"
#include "shader/effect.h"
#include "shader/normal.h"
#include "shader/position.h"
#include "shader/sample_rounding.h"
#include "texture/sensor.h"
#include "texture/synthetic.h"

/** Window depths this close to the far plane's are sky: nothing was drawn there. Unity's shaders use it. */
#define FRAME_SKY 1e-4

enum { FRAME_NORMAL_DEGREE = 256 };

/** Normals beside the depths: see normals.h. */
typedef struct frame_normals {
    const uint8_t *texels; /**< two channels a pixel, as packing_normal() reads them */
    bool truncated;        /**< channels were cut off; else they are the nearest */
    uint8_t *own;          /**< what is behind `texels`, where that was made */
    uint16_t *off;         /**< how far each was off at most before it was packed, of FRAME_NORMAL_DEGREE a degree;
                                null: not at all, or not known */
} frame_normals;

/** Where the depths come from. */
typedef struct frame {
    const texture_camera *camera; /**< its set-up in the model exact */
    const texture_camera *last;   /**< last frame's; null: none is known */
    const image *image;           /**< null for a synthetic image */
    const synthetic_row *synthetic;
    const double *parameters; /**< of the synthetic image */
    const grain *grain;       /**< of an image: how it was rounded; null: its samples are codes */
    bool metric;              /**< the samples are eye depths, none of them sky; the camera's set-up is their lattice */
    const sensor *sensor;     /**< metric: what was rounded to its samples; else null */
    const dp_setup *planes;   /**< metric: the planes that effects use; else null: the camera's */
    const frame_normals *normals; /**< for effects; null: those of the synthetic image, or none */
    double sky;                   /**< window depths this close to the far plane's are sky, [0, 0.5]; below 0 none:
                                       what was cleared lies at far */
    int threads;                  /**< 0: as many as there are cores */
} frame;

/**
 * Codes ordered by distance: the rank of a code is the code, or code_max - code in a reversed set-up. Ranks from
 * frame_sky_rank() on are sky: their values are within frame->sky of the far plane's. Metric, or without sky: code_max
 * + 1.
 */
uint32_t frame_sky_rank(const frame *f);
static inline uint32_t frame_rank(const dp_setup *setup, uint32_t code) {
    return setup->reversed ? setup->spec.format.code_max - code : code;
}
static inline uint32_t frame_code(const dp_setup *setup, uint32_t rank) {
    return frame_rank(setup, rank);
}

/** The set-up whose planes effects use. */
static inline const dp_setup *frame_planes(const frame *f) {
    return f->planes != NULL ? f->planes : &f->camera->setup;
}

/** The number of threads on which a frame is made. */
int frame_threads(const frame *f);

/** The codes of a row; UINT32_MAX where the image has no depth. */
void frame_codes(const frame *f, uint32_t row, uint32_t *codes);

typedef enum frame_kind {
    FRAME_EYE = 0,
    FRAME_LINEAR01, /**< eye depth over far, as Unity's Linear01Depth; far is that of frame_planes() */
    FRAME_RAW,      /**< window depth */
    FRAME_POSITION,
    FRAME_NORMAL,
    FRAME_EFFECT,
    FRAME_KINDS
} frame_kind;

/** A product that is made of the depths. Sky and invalid pixels are NaN in all of them, but sky has edges, EFFECT_STEP,
 * and a window depth. */
typedef struct frame_product {
    frame_kind kind;
    /**
     * The error in place of the product, one number a pixel. For a synthetic image what is off from the truth, with the
     * rounding to binary32; for an image, whose truth is not known, what it can be off:
     *
     *     eye       |product - z|; image: |product - stored|, and from there to the farther end of its range
     *     linear01  the same over far
     *     raw       |product - d(z)|; image: |product - value of the code|, and from there to the farther end of the
     *               window depths that became it, which is half a cell where samples are codes
     *     position  distance from the true place; image: |method - exact| and the range's reach along the ray
     *     normal    angle to the true normal, degrees; image: the method's bound, of "projective" on a plane, of the
     *               others for a plane through the three places, see normal_corner.h
     *     effect    levels of 1/255: from the output in binary32 to the exact one
     *
     * Ranges are those of grain_range_of(). Errors are rounded up to binary32.
     */
    bool error;
    bool lost; /**< FRAME_EFFECT: what binary32 has added to the output that is exact for what is stored, instead */
    const sensor *as;             /**< FRAME_EYE: rounded to its levels, and NaN beyond them; null: not */
    bool radial;                  /**< FRAME_EYE: distance from the camera in place of eye depth */
    const position_row *position; /**< FRAME_POSITION; null: exact, rounded to binary32 */
    const normal_row *normal;     /**< FRAME_NORMAL */
    const effect_row *effect;     /**< FRAME_EFFECT */
    /** Its parameters. Where a row is `given` and its reference is not, errors are those of the worst one. */
    const double *effect_settings;
    bool hides;  /**< FRAME_EFFECT of a `surface`: none where the scene is before it */
    bool vector; /**< FRAME_EFFECT that has one: its parts, and its length */
} frame_product;

/** Distances along the rays of a radial frame, as depths of one whose camera, in `camera`, is not: they have the codes
 *  and levels. Another frame is itself. */
frame frame_along(const frame *f, texture_camera *camera);

/** Numbers a pixel: 3 for places, normals and vectors, else 1. */
int frame_channels(const frame_product *product);

/** Null, or a sentence about why this cannot be made of this frame. */
const char *frame_refuses(const frame *f, const frame_product *product);

/** Takes `count` rows from `row` on, channels interleaved. Called strip by strip in order, by one thread at a time.
 *  @return false to stop */
typedef bool frame_take(void *context, uint32_t row, uint32_t count, const float *values);
/** The same of several products: the rows of each. */
typedef bool frame_take_all(void *context, uint32_t row, uint32_t count, const float *const *values);

/**
 * Makes a product that frame_refuses() lets through.
 * @param bottom_up  the last strip first; rows within a strip go down all the same
 * @return false when out of memory or stopped
 */
bool frame_run(const frame *f, const frame_product *product, bool bottom_up, frame_take *take, void *context);

/** Several products in one pass, at most FRAME_PRODUCTS_MAX. */
enum { FRAME_PRODUCTS_MAX = 32 };
bool frame_run_all(const frame *f, const frame_product *products, size_t count, bool bottom_up, frame_take_all *take,
                   void *context);

/** All finite numbers of a product. The bits do not depend on the number of threads. */
typedef struct frame_summary {
    uint64_t count, infinite;
    double lo, hi, mean;
    double p99;                 /**< of the magnitudes: the least number that 99 % do not exceed, at most 2^-11 above */
    uint32_t hi_column, hi_row; /**< the first that reaches hi */
} frame_summary;

bool frame_summarise(const frame *f, const frame_product *product, frame_summary *out);

/**
 * The error that a decoding in binary32 adds to stored depths: relative, over the pixels that are not sky; p99 is NaN.
 * `undone`: of (d - LO)/(HI - LO) in binary32, in place of the depth that a viewport of that range has moved.
 * An error that is NaN counts as infinite. @return false when out of memory
 */
bool frame_summarise_decoding(const frame *f, const decode_row *row, bool undone, frame_summary *out);

#endif
