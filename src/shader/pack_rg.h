/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The shader's two channels, in binary32 as it computes them: for the rows of pack.c and for the tests, which try every
 * number and want it inline. */
#ifndef SHADER_PACK_RG_H
#define SHADER_PACK_RG_H

#include <stdint.h>

enum { PACK_BYTE = 255 };

/* frac() of a number that is not negative and below 2^31. */
static inline float pack_fraction(float x) {
    return x - (float)(int32_t)x;
}

/* UNORM conversion of a render target: the product is exact, ties go up; what is below 0 is stored as 0. x <= 1. */
static inline uint32_t pack_store(float x, double half) {
    return (uint32_t)(int32_t)((double)x * PACK_BYTE + half);
}

/* EncodeFloatRG of v in [0, 1) in binary32, the coarse code times 256 and the fine one; half is
 * 0.5 to store the nearest code, 0 to truncate. */
static inline uint32_t pack_rg_code(float v, double half) {
    const float y = pack_fraction((float)PACK_BYTE * v);
    const float x = v - y * (1.0F / PACK_BYTE);
    return pack_store(x, half) << 8 | pack_store(y, half);
}

/* DecodeFloatRG in binary32. */
static inline float pack_rg_depth(uint32_t code) {
    const float x = (float)(int32_t)(code >> 8) / PACK_BYTE, y = (float)(int32_t)(code & PACK_BYTE) / PACK_BYTE;
    return x + y * (1.0F / PACK_BYTE);
}

#endif
