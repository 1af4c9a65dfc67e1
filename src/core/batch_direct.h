/* SPDX-License-Identifier: MIT */
/* The kernels of floats and codes as callers have them, without a conversion: a part of batch_loops.h. */

/* ---- Direct: float depth to UNORM, perspective ------------------------------------------------------------------- */

/* Not by constants, or the compiler sees that a clamped depth has a known code and makes two ways of it. */
DP_INLINE float clamped32(const numbers *k, float x) {
    const float raised = x > k->z_lo ? x : k->z_lo;
    return raised < k->z_hi ? raised : k->z_hi;
}

#if FUSED
/*
 * t = s - p/z, or p/z - s reversed, with the quotient as a sum of two floats: q = p/z rounded, whose remainder is exact
 * when fused, and the remainder over z. q is cut into a whole number and a fraction, and the fractions meet in [8, 16),
 * where a float has steps of 2^-20. batch_plan.c has the error bound.
 */
DP_INLINE placed place_quotient(const numbers *k, float z, int reversed) {
    const float q = k->reach / z;
    const float rest = fmaf(-q, z, k->reach) + k->reach_rest;
    const float inverse = q * k->reach_inverse;
    const int32_t whole = (int32_t)q;
    const float part = q - (float)whole;
    const float sum = reversed ? fmaf(rest, inverse, k->offset) + part : fmaf(-rest, inverse, k->offset) - part;
    const uint32_t bits = dp_bits32(sum);
    const int32_t floor_sum = (int32_t)(bits >> 20) + k->whole;
    return (placed){(uint32_t)(reversed ? floor_sum + whole : floor_sum - whole), (int32_t)(bits & 0xFFFFFU)};
}

DP_INLINE placed place_standard(const numbers *k, float z) {
    return place_quotient(k, z, 0);
}

DP_INLINE placed place_reversed(const numbers *k, float z) {
    return place_quotient(k, z, 1);
}

LOOP_CODES(STANDARD_16, real32, word16, clamped32, place_standard)
LOOP_CODES(STANDARD_32, real32, word32, clamped32, place_standard)
LOOP_CODES(REVERSED_16, real32, word16, clamped32, place_reversed)
LOOP_CODES(REVERSED_32, real32, word32, clamped32, place_reversed)

/* ---- Direct: float depth to binary32, perspective ---------------------------------------------------------------- */

/* The codes of both ends of what a depth may be. */
typedef struct ends {
    uint32_t least, most;
} ends;

/* LOOP(), of ends: where both are one it is the code. Bits in which they differ anywhere are gathered. */
#define LOOP_ENDS(NAME, IN, OUT, ENDS)                                                                                 \
    TARGET static int32_t kernel_##NAME(const dp_batch *batch, const void *in, void *out, size_t count) {              \
        const IN *restrict from = in;                                                                                  \
        OUT *restrict to = out;                                                                                        \
        const numbers k = dp_batch_read(batch)->numbers;                                                               \
        uint32_t apart = 0;                                                                                            \
        PRAGMA(omp simd reduction(| : apart))                                                                          \
        for (size_t i = 0; i < count; i++) {                                                                           \
            const ends e = ENDS(&k, from[i]);                                                                          \
            apart |= e.least ^ e.most;                                                                                 \
            to[i] = e.least;                                                                                           \
        }                                                                                                              \
        return apart == 0;                                                                                             \
    }

/*
 * d = s - p/z, or p/z - s reversed, each step as a sum of two floats. The code is certain where both ends of what d may
 * be are rounded to it; batch_plan.c has the error bound. Beyond the planes lie the skies and holes of pictures, whose
 * codes are known.
 */
DP_INLINE ends ends_binary32(const numbers *k, float z, int reversed) {
    const float inverse = 1.0F / z, q = k->reach * inverse, left = fmaf(-q, z, k->reach);
    const float more = reversed ? q : k->offset, less = reversed ? k->offset : q, d = more - less;
    const float rest = fmaf(k->reach_rest, inverse, more - d - less) + k->offset_rest;
    const float small = fmaf(reversed ? left : -left, inverse, rest);
    const float error = reversed ? fmaf(q, 0x1p-43F, 0x1p-120F) : k->unsure;
    const int behind = z >= k->beyond, inside = z >= k->z_lo && !behind;
    const uint32_t end = behind ? k->far_code : k->near_code;
    return (ends){inside ? dp_bits32(d + (small - error)) : end, inside ? dp_bits32(d + (small + error)) : end};
}

DP_INLINE ends ends_standard(const numbers *k, float z) {
    return ends_binary32(k, z, 0);
}

DP_INLINE ends ends_reversed(const numbers *k, float z) {
    return ends_binary32(k, z, 1);
}

LOOP_ENDS(BINARY32_STANDARD, real32, word32, ends_standard)
LOOP_ENDS(BINARY32_REVERSED, real32, word32, ends_reversed)
#endif

/* ---- Direct: float window depth to UNORM and back, N from 2 to 24, to nearest ------------------------------------ */

/*
 * N < 24: from 2^23 on floats are whole numbers apart, so that one fused operation rounds the exact product. Without
 * it: D = d 2^N, exact, is rounded so to r, and d M = D - d falls below r - 1/2 when D - r + 1/2 < d, whose left side
 * is exact where that can be. The only tie is d = 1/2, whose even neighbour is the upper one.
 */
DP_INLINE uint32_t unorm_code(const numbers *k, float x) {
    const float d = clamped32(k, x);
#if FUSED
    return dp_bits32(fmaf(d, k->unit, 0x1p23F)) - 0x4B000000U;
#else
    const float steps = d * k->split;
    const float r = steps + 0x1p23F;
    const float over = steps - (r - 0x1p23F);
    return dp_bits32(r) - 0x4B000000U - (over + 0.5F < d ? 1U : 0U);
#endif
}

LOOP(UNORM_OF_FLOAT_16, real32, word16, unorm_code)
LOOP(UNORM_OF_FLOAT_32, real32, word32, unorm_code)

/*
 * N = 24: d (2^24 - 1) rounded is the float below D = d 2^24, and the code is D - 1/2 rounded up, D - 1 above d = 1/2:
 * what is left when the float below 1/2 is added and the fraction cut off. test_batch.c tries every float.
 */
DP_INLINE uint32_t unorm24_code(const numbers *k, float x) {
    return (uint32_t)(int32_t)(clamped32(k, x) * 16777215.0F + 0x1.fffffep-2F);
}

LOOP(UNORM24_OF_FLOAT, real32, word32, unorm24_code)

DP_INLINE float whole32(const numbers *k, uint32_t code) {
    return (float)(int32_t)kept_code(k, code);
}

DP_INLINE float unorm_value32(const numbers *k, uint32_t code) {
    const float c = whole32(k, code);
    return c * k->unit + c * k->unit_rest;
}

LOOP(FLOAT_OF_UNORM_16, word16, real32, unorm_value32)
LOOP(FLOAT_OF_UNORM_32, word32, real32, unorm_value32)

/* ---- Direct: UNORM code to eye depth in float -------------------------------------------------------------------- */

#ifndef QUOTIENTS_BY_HAND
DP_INLINE float eye32(const numbers *k, uint32_t code) {
    const float c = whole32(k, code), comp = k->unit - c;
    return k->eye_top / (k->eye_slope * (k->reversed ? c : comp) + k->eye_base);
}

LOOP(FAST_EYE_16, word16, real32, eye32)
LOOP(FAST_EYE_32, word32, real32, eye32)
#endif

/* ---- Direct: binary32, whose codes are its bits, and binary16 ---------------------------------------------------- */

DP_INLINE uint32_t bits_of_float(const numbers *k, float x) {
    return dp_bits32(clamped32(k, x));
}

DP_INLINE float float_of_bits(const numbers *k, uint32_t code) {
    return dp_float32(kept_code(k, code));
}

LOOP(BITS_OF_FLOAT, real32, word32, bits_of_float)
LOOP(FLOAT_OF_BITS, word32, real32, float_of_bits)

#ifndef HALF_BY_HARDWARE
DP_INLINE int32_t half_of_float(const numbers *k, float x) {
    const float d = clamped32(k, x);
    const int32_t up = k->truncates ? 0 : 1, bits = (int32_t)dp_bits32(d);
    const int32_t normal = ((bits + up * (0xFFF + (bits >> 13 & 1))) >> 13) - (112 << 10);
    const float small = d < 0x1p-14F ? d : 0x1p-14F;
    const int32_t whole = (int32_t)(small * 0x1p24F);
    const int32_t even = (int32_t)(dp_bits32(small * 0x1p24F + 0x1p23F) & 0x7FFFFFU);
    return d < 0x1p-14F ? (up ? even : whole) : normal;
}

DP_INLINE float float_of_half(const numbers *k, int32_t code) {
    const int32_t c = code < 0x3C00 ? code : 0x3C00;
    const float normal = dp_float32((uint32_t)(c << 13) + (112U << 23));
    (void)k;
    return c < 0x400 ? (float)c * 0x1p-24F : normal;
}

LOOP(HALF_OF_FLOAT, real32, word16, half_of_float)
LOOP(FLOAT_OF_HALF, word16, real32, float_of_half)
#endif
