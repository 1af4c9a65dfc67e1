/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file half.h  Numbers that shaders keep in binary16: half, half3. */
#ifndef SHADER_HALF_H
#define SHADER_HALF_H

#include "core/bits.h"

/* A number from 2^e to 2^(e + 1), whose bits `power` are, to the ten bits behind the first: a sum with 1.5 2^(e + 13)
 * leaves no more. The last of them are worth 2^-24 at least. 0 loses its sign. */
DP_INLINE float half_from(float a, int32_t power) {
    const int32_t least = 0x38800000;
    const float grid = dp_float32((uint32_t)(power > least ? power : least) + 0x06c00000u);
    return (a + grid) - grid;
}

DP_INLINE int32_t half_power(float a) {
    return (int32_t)(dp_bits32(a) & 0x7f800000u);
}

/** To binary16 and back, nearest, ties to even: numbers of at most 65504; 0 keeps its sign */
DP_INLINE float half_within(float a) {
    return dp_float32(dp_bits32(half_from(a, half_power(a))) | (dp_bits32(a) & 0x80000000u));
}

/** The same of numbers below 2^115: infinite from 65520 on; 0 without its sign */
DP_INLINE float half_below(float a) {
    return half_from(a, half_power(a)) * 0x1p112f * 0x1p-112f;
}

/** The same of all. */
DP_INLINE float half_of(float a) {
    const int32_t power = half_power(a), most = 0x47800000;
    return half_from(a, power < most ? power : most) * 0x1p112f * 0x1p-112f;
}

#endif
