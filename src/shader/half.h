/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file half.h  Numbers that shaders keep in binary16: half, half3. */
#ifndef SHADER_HALF_H
#define SHADER_HALF_H

#include "core/bits.h"

/**
 * To binary16 and back: nearest, ties to even; beyond 65504 infinite from 65520 on. 1.5 2^(e + 13) leaves of a number
 * from 2^e on the ten bits behind the first; the last of them are worth 2^-24 at least.
 */
DP_INLINE float half_of(float a) {
    const int32_t power = (int32_t)(dp_bits32(a) & 0x7f800000u), least = 0x38800000, most = 0x47800000;
    const int32_t above = power > least ? power : least, within = above < most ? above : most;
    const float grid = dp_float32((uint32_t)within + 0x06c00000u), rounded = (a + grid) - grid;
    const float half = rounded * 0x1p112f * 0x1p-112f; /* infinite from 2^16 on */
    return dp_float32(dp_bits32(half) | (dp_bits32(a) & 0x80000000u));
}

#endif
