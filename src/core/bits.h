/* SPDX-License-Identifier: MIT */
/* Floating-point numbers as their bits, for the rooms above too: positive ones are ordered as these are. */
#ifndef CORE_BITS_H
#define CORE_BITS_H

#include <stdint.h>
#include <string.h>

/* Also into functions that are compiled for another instruction set. */
#define DP_INLINE static inline __attribute__((always_inline))

/* Half a unit in the last place of binary32 at 1: the most that a rounding changes a number by, relatively. */
#define DP_UNIT 0x1p-24

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

#endif
