/* SPDX-License-Identifier: MIT */
/* For the rooms above too: floating-point numbers as their bits, positive ones being ordered as these are; and bits at
 * random. */
#ifndef CORE_BITS_H
#define CORE_BITS_H

#include <stdint.h>
#include <string.h>

#include "core/outward.h"

/* Also into functions that are compiled for another instruction set. */
#define DP_INLINE static inline __attribute__((always_inline))

DP_INLINE uint32_t dp_bits32(float x) {
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

DP_INLINE float dp_float32(uint32_t bits) {
    float x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* The place of a number among all of binary32, from the least on: one more is the next number. Both zeros are one. */
DP_INLINE uint32_t dp_rank32(float x) {
    const uint32_t bits = dp_bits32(x);
    return bits < 0x80000000U ? 0x80000000U + bits : 0U - bits;
}

DP_INLINE float dp_ranked32(uint32_t rank) {
    return dp_float32(rank < 0x80000000U ? 0U - rank : rank - 0x80000000U);
}

/* The least binary32 number that is not below a double. */
DP_INLINE float dp_float_up(double x) {
    const float nearest = (float)x;
    return (double)nearest < x ? dp_ranked32(dp_rank32(nearest) + 1U) : nearest;
}

/* The greatest that is not above it. */
DP_INLINE float dp_float_down(double x) {
    const float nearest = (float)x;
    return (double)nearest > x ? dp_ranked32(dp_rank32(nearest) - 1U) : nearest;
}

DP_INLINE uint64_t dp_bits64(double x) {
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

DP_INLINE double dp_float64(uint64_t bits) {
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* The finalizer of splitmix64: random bits, the same on every machine. */
DP_INLINE uint64_t dp_mixed64(uint64_t x) {
    x = (x ^ x >> 30) * UINT64_C(0xBF58476D1CE4E5B9);
    x = (x ^ x >> 27) * UINT64_C(0x94D049BB133111EB);
    return x ^ x >> 31;
}

/* Draw i of a seed: splitmix64 over a counter, so that any draw can be made without the others. */
DP_INLINE uint64_t dp_draw64(uint64_t seed, uint64_t i) {
    return dp_mixed64(seed + (i + 1) * UINT64_C(0x9E3779B97F4A7C15));
}

/* One of [0, 1). */
DP_INLINE double dp_uniform(uint64_t random) {
    return (double)(random >> 11) * 0x1p-53;
}

#endif
