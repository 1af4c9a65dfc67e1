/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file half.h  Numbers that shaders keep in binary16: half, half3. */
#ifndef SHADER_HALF_H
#define SHADER_HALF_H

#include "core/bits.h"

/** To binary16 and back: nearest, ties to even; beyond 65504 infinite from 65520 on. */
DP_INLINE float half_of(float a) {
    const uint32_t sign = dp_bits32(a) & 0x80000000u, bits = dp_bits32(a) ^ sign;
    const uint32_t rounded = (bits + 0xfffu + (bits >> 13 & 1u)) & ~0x1fffu;
    const uint32_t normal = bits >= 0x477ff000u ? 0x7f800000u : rounded;
    const float tiny = (dp_float32(bits) + 0.5f) - 0.5f; /* multiples of 2^-24 */
    const float half = dp_float32((bits < 0x38800000u ? dp_bits32(tiny) : normal) | sign);
    return a == a ? half : a;
}

#endif
