/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file packing.h  Textures of 8-bit channels that hold a depth in several of them, as files have them, a row each.
 *
 * The channels with a weight make one whole number, k = sum of weight x channel, and the depth is k/steps, at most 1:
 * window depth, or eye depth over far. An image is brought to one channel of these numbers, in binary32 where that
 * tells all k apart, else in binary64; from there on it goes the way of all depth images.
 */
#ifndef SHADER_PACKING_H
#define SHADER_PACKING_H

#include "core/named.h"
#include "image/image.h"
#include "shader/pack.h"
#include "shader/sample_rounding.h"

typedef struct packing {
    NAMED_FIELDS;
    uint32_t channels;                   /**< of the texture; a file may have more */
    uint32_t weight[IMAGE_CHANNELS_MAX]; /**< 0: holds no depth */
    double steps;                        /**< 0: it holds no depth, but normals alone */
    bool linear;                         /**< eye depth over far, or no depth; else window depth */
    const char *encoded;                 /**< the row of pack.h of the normals in the first channels; null: none */
    bool world;         /**< they lie along the world's axes; else along the view's, z towards the camera */
    bool wraps;         /**< the shader's frac makes 0 of the far plane, which it reads back as the camera; of f4 */
    const char *format; /**< whose codes come nearest to the numbers: "fp32" where no format has them */
    double off;         /**< what the shader's binary32 arithmetic loses beside half a step, a share of 1 */
    double cut; /**< what truncated channels may lose, a share of 1, because x - y/255 came out just below a code */
} packing;

NAMED_ROWS(packing, packing);

/** The whole number of a texel, and its depth, at most 1. */
uint64_t packing_number(const packing *p, const uint8_t *texel);
double packing_depth(const packing *p, uint64_t number);

/** The nearest number of a depth, which is taken into [0, 1]. */
uint64_t packing_nearest(const packing *p, double depth);

/** The channels of a number that packing_nearest() may return; those without a weight stay as they are. */
void packing_texel(const packing *p, uint64_t number, uint8_t *texel);

/** How its normals are encoded; null where it has none. */
const pack_row *packing_normals(const packing *p);

/** A view-space normal of two channels: x to the right, y up, z towards the camera, of length 1; and the way back. */
void packing_normal(const uint8_t *texel, double normal[3]);
void packing_normal_texel(const double normal[3], uint8_t *texel);

/**
 * How far |x| + |y| of a normal that faces the camera may be from that of its texel, derived in depthprec(7).
 * @param truncated  channels were cut off; else they are the nearest
 */
double packing_normal_reach(const uint8_t *texel, bool truncated);

/** The parts of an unpacked image besides its depths. */
typedef struct unpacked {
    grain grain;                  /**< the packing's own rounding: to nearest, as render targets store */
    uint8_t *normals;             /**< the channels of packing_normals(), malloc'ed; null where there are none */
    uint64_t zeros;               /**< pixels of packing_unwrap() */
    bool premultiplied;           /**< no channel is above alpha anywhere, which is not by chance */
    char wrong[IMAGE_ERROR_SIZE]; /**< why not: one sentence */
} unpacked;

/** Whether a target was cleared to black there, and no normal is: what a packing without a depth has for a hole, and of
 * the others what packing_unwrap() has replaced where the normal's channels are 0, too. */
static inline bool packing_cleared(const packing *p, const uint8_t *normal, double depth) {
    return normal[0] == 0 && normal[1] == 0 && (p->steps > 0 ? !(depth < 1) : normal[2] == 0);
}

/**
 * Converts the image, of u1, or of u2, f4 or f8 whose samples are those of 8 bits, which becomes one channel of f4 or
 * f8: of NaN where it holds no depth, and as it was where it is one channel of more than 8 bits. SNORM channels are
 * bytes as they lie in memory, or numbers from -1 to 1. Refused are fewer channels, SNORM texels of which an eighth
 * have no length of 1, and what was resampled: samples between those of 8 bits, or neighbours where the coarse channel
 * steps by one and the finer one has been averaged over its jump, far more often than surfaces stand out elsewhere.
 * @param zero  channels were truncated; what that tears apart is in the margin of the grain, and nothing is refused
 * @return false after the sentence; the image is then as it was
 */
bool packing_convert(const packing *p, bool zero, image *img, unpacked *out);

/** Replaces the zeros of such an image where the packing wraps: clears to black, or wrapped. @return how many */
uint64_t packing_unwrap(const packing *p, image *depths, float zero);

#endif
