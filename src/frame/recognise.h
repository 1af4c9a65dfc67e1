/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file recognise.h  What is stored in a depth image: on which lattice its samples lie, and which way they run.
 *
 * Integers are codes of unorm16 (u2), of unorm24 or the bits of binary32 (u4), or shares of 255 (u1). Numbers of f2
 * are codes of fp16. Numbers of f4 are compared one by one with the lattices of fp16, unorm16 and unorm24, those of f8
 * too: a code c of unormN is recognised within 1 ulp of c/(2^N - 1), because drivers multiply by a rounded reciprocal
 * instead of dividing. The coarsest lattice that holds every sample is the answer, fp32 when none does.
 *
 * Chance: of numbers without a lattice, and of codes of a finer unorm, a share p(x) lies on a given one all the same:
 * 3 ulp(x) (2^N - 1), at most 1, on that of unormN, 2^-13 on that of fp16. The answer is certain where at least
 * RECOGNISE_LEAST different samples with p < 1 were seen and the product of their p is below 2^-RECOGNISE_BITS.
 *
 * A file of u1, u2 or f2 says what it can hold, not what the buffer held, which may have been finer: never certain. And
 * samples may be coarser than their type or lattice: see `steps`.
 *
 * In [1/4, 1] every binary32 number lies within 1 ulp of a code of unorm24, so that images of a standard mapping, whose
 * samples are near 1, are often uncertain: fp32 cannot be told from unorm24 there, and nothing is lost by it but small
 * depths. Numbers that somebody chose, such as k/256, are not random and look like fp16.
 */
#ifndef FRAME_RECOGNISE_H
#define FRAME_RECOGNISE_H

#include "depthprec/depthprec.h"
#include "image/image.h"

enum { RECOGNISE_LEAST = 16, RECOGNISE_BITS = 64, RECOGNISE_DISTINCT_MAX = 1 << 16 };

/** What was found. */
typedef struct recognised {
    bool depth;         /**< finite samples, all in [0, 1] or codes of a format: it can be window depth. Holes,
                             which are not finite, are no hindrance */
    dp_format format;   /**< the coarsest of the named formats whose lattice holds every sample; without depth
                             it says nothing */
    bool certain;       /**< proved: enough different samples to tell that lattice from the next finer one, or
                             off all coarser ones. Never where the type of the file holds nothing finer */
    double steps;       /**< all samples are multiples of 1/steps, up to their own rounding, which is coarser than
                             the format; 0: some are not. It
                                  may be by chance where there are few values */
    bool steps_certain; /**< by a chance below 2^-RECOGNISE_BITS, or by the type of the file */
    int reversed;       /**< 1 likely reversed, 0 likely not, -1 cannot tell */
    bool direction;     /**< `reversed` is found and not only likely: an end of [0, 1] that a cleared buffer has, in a
                             sixteenth of the samples and 16 times as often as others are on average, none at the
                             other end, and nine of ten others in the same quarter; never where `metric` */
    bool metric;        /**< more likely metric depth: numbers above 1, or integers like millimetres with holes at 0 */
    size_t samples, invalid; /**< invalid: NaN, infinite or outside [0, 1] */
    size_t holes;            /**< of these NaN or infinite */
    size_t distinct;         /**< different valid values, counted up to RECOGNISE_DISTINCT_MAX */
    size_t at_zero, at_one;
    double lo, hi;       /**< of the valid samples, as window depth; NaN when there is none */
    const char *towards; /**< what shows the direction, or that nothing does; null without depth */
    char why[320];       /**< one sentence for people: how it was told, or why it is no window depth, and `towards` */
} recognised;

/** Looks at channel 0 of every pixel. Never fails: an image that cannot be window depth has depth == false. */
void recognise(const image *image, recognised *out);

#endif
