/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file pack_parts.h  The parts of pack_measure(), and the shader arithmetic that it shares with the rows. */
#ifndef TEXTURE_PACK_PARTS_H
#define TEXTURE_PACK_PARTS_H

#include "texture/pack.h"

enum { PACK_BYTE = 255 };

/** The row whose depths those of depth-normal are. */
enum { PACK_RG_DEPTH = 0 };

/** kScale of EncodeViewNormalStereo. */
#define PACK_STEREO_SCALE 1.7777

/** frac() of a number that is not negative and below 2^31. */
static inline float pack_fraction(float x) {
    return x - (float)(int32_t)x;
}

/** UNORM conversion of a render target: the product is exact, ties go up; what is below 0 is stored as 0. x <= 1. */
static inline uint32_t pack_store(float x, double half) {
    return (uint32_t)(int32_t)((double)x * PACK_BYTE + half);
}

/** EncodeFloatRG of v in [0, 1) in binary32, the coarse code times 256 and the fine one.
 *  @param half  0.5 to store the nearest code, 0 to truncate */
static inline uint32_t pack_rg32_encode(float v, double half) {
    const float y = pack_fraction((float)PACK_BYTE * v);
    const float x = v - y * (1.0F / PACK_BYTE);
    return pack_store(x, half) << 8 | pack_store(y, half);
}

/** DecodeFloatRG in binary32. */
static inline float pack_rg32_decode(uint32_t code) {
    const float x = (float)(int32_t)(code >> 8) / PACK_BYTE, y = (float)(int32_t)(code & PACK_BYTE) / PACK_BYTE;
    return x + y * (1.0F / PACK_BYTE);
}

/** Fills in the fields of the depth. For rows of the kind PACK_DEPTH. */
void pack_measure_depth(const pack_row *row, pack_error *out);

#endif
