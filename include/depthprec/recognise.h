/* SPDX-License-Identifier: MIT */
/**
 * @file recognise.h  What is stored in a depth image: on which lattice its samples lie, and which way they run.
 *
 * Integers of 32 bits are codes of unorm16 or unorm24 or the bits of binary32, those of 16 bits codes of unorm16, those
 * of 8 bits shares of 255. Numbers of binary16 are codes of fp16. Those of binary32 are compared one by one with the
 * lattices of fp16, unorm16 and unorm24, those of binary64 too: a code c of unormN is recognised within 1 ulp of
 * c/(2^N - 1), because drivers multiply by a rounded reciprocal instead of dividing. The coarsest lattice that holds
 * every sample is the answer, fp32 when none does.
 *
 * Chance: of numbers without a lattice, and of codes of a finer unorm, a share p(x) lies on a given one all the same:
 * 3 ulp(x) (2^N - 1), at most 1, on that of unormN, 2^-13 on that of fp16. The answer is proved where at least
 * DP_RECOGNISE_LEAST different samples with p < 1 were seen and the product of their p is below 2^-DP_RECOGNISE_BITS.
 *
 * 8 or 16 bits say what they can hold, not what the buffer held, which may have been finer: never certain. And samples
 * may be coarser than their type or lattice: see `steps`.
 *
 * In [1/4, 1] every binary32 number lies within 1 ulp of a code of unorm24, so that images of a standard mapping, whose
 * samples are near 1, are often uncertain: fp32 cannot be told from unorm24 there, and nothing is lost by it but small
 * depths. Numbers that somebody chose, such as k/256, are not random and look like fp16.
 */
#ifndef DEPTHPREC_RECOGNISE_H
#define DEPTHPREC_RECOGNISE_H

#include <stddef.h>
#include <stdint.h>

#include "depthprec/format.h"
#include "depthprec/status.h"

DP_BEGIN

enum {
    DP_RECOGNISE_LEAST = 16,         /**< different samples that prove a lattice, */
    DP_RECOGNISE_BITS = 64,          /**< by a chance below 2^-64 */
    DP_RECOGNISE_DISTINCT = 1 << 16, /**< up to how many different values are counted, */
    DP_RECOGNISE_SLOTS = 1 << 17     /**< in so many uint64_t, 1 MiB, of the caller's */
};

/** The type of samples: unsigned integers, and binary16 (as its bits), float and double. */
typedef enum dp_image_type {
    DP_IMAGE_U8 = 0,
    DP_IMAGE_U16,
    DP_IMAGE_U32,
    DP_IMAGE_F16,
    DP_IMAGE_F32,
    DP_IMAGE_F64,
    DP_IMAGE_TYPE_COUNT
} dp_image_type;

/** One channel of an image in the caller's memory, rows from either side without padding. */
typedef struct dp_image {
    const void *data;     /**< its first sample, aligned to the type; may be null where there is no sample */
    dp_image_type type;   /**< in the order of this machine's bytes */
    size_t width, height; /**< samples in a row, and rows; an array without rows is a row */
    size_t stride;        /**< samples from one to the next: how many channels are interleaved */
} dp_image;

/** The evidence for the format, or that there is no depth, and the fields that say more of it. */
typedef enum dp_reason {
    DP_REASON_EMPTY = 0,    /**< no depth: no sample is finite, or there is none */
    DP_REASON_OUTSIDE,      /**< no depth: `invalid` samples are not in [0, 1] or not codes, see `least`, `greatest` */
    DP_REASON_STENCIL_LOW,  /**< no depth: all low bytes are equal: stencil below 24 bits of depth? */
    DP_REASON_STENCIL_HIGH, /**< no depth: all high bytes are equal: stencil above 24 bits? */
    DP_REASON_LARGE,        /**< no depth: integers above 24 bits that are not bits of fp32 in [0, 1] */
    DP_REASON_GIVEN,        /**< the caller knew the format */
    DP_REASON_BYTES,        /**< 8 bits, fewer than any depth format has */
    DP_REASON_WIDENED,      /**< 16 bits that repeat 8 */
    DP_REASON_WORDS,        /**< 16 bits up to `greatest`, above any code of fp16 */
    DP_REASON_WORDS_LOW,    /**< 16 bits up to `greatest`, which may be codes of fp16 as well */
    DP_REASON_LONGS_16,     /**< 32 bits up to `greatest`; below 65535 they may be codes of unorm24 as well */
    DP_REASON_LONGS_24,     /**< 32 bits up to `greatest`, codes of unorm24 */
    DP_REASON_LONGS_32,     /**< 32 bits, those of fp32 */
    DP_REASON_HALVES,       /**< numbers of fp16, or rounded to it */
    DP_REASON_LATTICE, /**< numbers, `distinct` different ones on the format's lattice, of random ones `expected` */
    DP_REASON_SINGLES, /**< numbers of fp32, `off` of them off the lattice of `closest` */
    DP_REASON_DOUBLES, /**< finer ones, the same */
    DP_REASON_COUNT
} dp_reason;

/** The findings of dp_recognise() in an image. */
typedef struct dp_recognised {
    int depth;         /**< finite samples, all in [0, 1] or codes of a format: it can be window depth. Holes, which are
                            not finite, are no hindrance */
    dp_format format;  /**< fp16, unorm16, unorm24 or fp32, the coarsest whose lattice holds every sample: integers are
                            its codes where it has no more bits than they. Without depth it says nothing */
    int proved;        /**< enough different samples tell that lattice from the next finer one, or are off all coarser
                            ones, or the caller knew it. Never where the type holds nothing finer */
    int certain;       /**< proved, and there are no steps */
    double steps;      /**< all samples are multiples of 1/steps, up to their own rounding, which is coarser than the
                            format; 0: some are not. It may be by chance where there are few values */
    int steps_certain; /**< by a chance below 2^-DP_RECOGNISE_BITS, or by the type */
    int sky, mass; /**< 1 and 0: the end of [0, 1] that a cleared buffer has is 0, or 1; nine of ten others lie below
                        1/4, or above 3/4. -1: neither */
    int reversed;  /**< 1 likely reversed, 0 likely not, -1 cannot tell */
    int direction; /**< `reversed` is found and not only likely: sky in a sixteenth of the samples and 16 times as
                        often as others are on average, none at the other end, and mass; never where `metric` */
    int metric;    /**< more likely metric depth: numbers above 1, or integers like millimetres with holes at 0 */
    size_t samples, invalid; /**< invalid: NaN, infinite, outside [0, 1] or no code */
    size_t holes;            /**< of these NaN or infinite */
    size_t distinct;         /**< different valid values, counted up to DP_RECOGNISE_DISTINCT */
    size_t at_zero, at_one;  /**< window depths of 0 and 1 */
    double lo, hi;           /**< of the valid samples, as window depth; NaN when there is none */
    double least, greatest; /**< of the finite samples, as the codes or numbers that they are; NaN when there is none */
    dp_reason reason;
    double expected;     /**< LATTICE: how many of `distinct` random numbers would lie on it by chance */
    const char *closest; /**< SINGLES, DOUBLES: the coarser format with the fewest samples off its lattice; else null */
    size_t off;          /**< how many are off it; else 0 */
} dp_recognised;

/**
 * Recognises the format and the direction of a depth image.
 *
 * @param known  the format where it is known, one of dp_format_get(): all else is then found; or null
 * @param slots  memory for DP_RECOGNISE_SLOTS numbers, not read before it is written; null: no value is counted, so
 * that `distinct` and `steps` are 0 and neither a lattice of numbers, direction nor millimetres are found
 * @return DP_OK; DP_ERROR_NULL; DP_ERROR_BATCH for a type that does not exist; DP_ERROR_FORMAT for another `known`;
 *         *out is left as it was then
 *
 * No sample is no error: `depth` is 0. What is said to be certain or proved is wrong by a chance below
 * 2^-DP_RECOGNISE_BITS; the rest is likely at most. Cost: nanoseconds a sample, some 64 KiB of stack.
 * Source: depthprec(5), "How the format is recognised".
 */
DP_API dp_status dp_recognise(const dp_image *image, const dp_format *known, uint64_t *slots, dp_recognised *out);

DP_END
#endif
