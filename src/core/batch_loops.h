/* SPDX-License-Identifier: MIT */
/*
 * The kernels, once. A path defines TARGET, FUSED and TABLE and includes this file; HALF_BY_HARDWARE and
 * QUOTIENTS_BY_HAND say that it brings its own conversions of binary16, and its own kernels that divide constants.
 * Every operation is one IEEE operation, so that each path gives the same bits; fused operations stand where they make
 * a result exact, in kernels whose codes are proven whatever they do.
 */
#include "core/batch_plan.h"
#include "core/bits.h"

/* Arrays may be looked at as another type than the caller's, in place. */
#define ALIAS __attribute__((may_alias))
typedef float ALIAS real32;
typedef double ALIAS real64;
typedef uint16_t ALIAS word16;
typedef uint32_t ALIAS word32;

#define PRAGMA(TEXT) _Pragma(#TEXT)

/* clang-format off */
#define LOOP(NAME, IN, OUT, PREPARE, BODY)                                                                             \
    TARGET static int32_t kernel_##NAME(const dp_batch *batch, const void *in, void *out, size_t count) {              \
        const IN *restrict from = in;                                                                                  \
        OUT *restrict to = out;                                                                                        \
        const struct dp_batch_numbers k = batch->numbers;                                                              \
        int32_t least = INT32_MAX;                                                                                     \
        (void)k;                                                                                                       \
        PREPARE                                                                                                        \
        PRAGMA(omp simd reduction(min : least))                                                                        \
        for (size_t i = 0; i < count; i++) BODY                                                                        \
        return least;                                                                                                  \
    }
/* clang-format on */

/* ---- Depth to code: the code stands in the upper bits of a double, and below it how far the next boundary is ------
 */

/*
 * UNORM: t + 2^32 has steps of 2^-20. FLOAT: a double has the same shape as the format, but for the subnormals, which
 * take it when the least normal value is added.
 */
#define PLACE_UNORM(X) const uint64_t bits = dp_bits64((X)*k.scale + k.magic);
#define PLACE_FLOAT(X)                                                                                                 \
    const double d = (X)*k.scale;                                                                                      \
    const double v = d + (d < k.least_normal ? k.least_normal : 0.0);                                                  \
    const uint64_t bits = dp_bits64(v) + dp_bits64(d < k.least_normal ? low_half : high_half);

#define TAKE                                                                                                           \
    const int32_t rest = (int32_t)((uint32_t)(bits >> k.cut) & 0xFFFFFU);                                              \
    least = rest < least ? rest : least;                                                                               \
    to[i] = (uint32_t)(bits >> k.shift) - k.rebias;

#define CLAMPED                                                                                                        \
    const double raised = from[i] > k.lo ? from[i] : k.lo;                                                             \
    const double x = raised < k.hi ? raised : k.hi;

/* Chosen as doubles, because every instruction set can. */
#define HALVES                                                                                                         \
    const double high_half = dp_float64(k.half);                                                                       \
    const double low_half = dp_float64(k.half - ((uint64_t)1 << k.shift << k.mantissa));

LOOP(CODE_PERSPECTIVE_UNORM, real64, word32, , {CLAMPED PLACE_UNORM((k.from + k.slope * x) / x) TAKE})
LOOP(CODE_PERSPECTIVE_FLOAT, real64, word32, HALVES, {CLAMPED PLACE_FLOAT((k.from + k.slope * x) / x) TAKE})
LOOP(CODE_LINEAR_UNORM, real64, word32, , {CLAMPED PLACE_UNORM(k.from + k.slope * x) TAKE})
LOOP(CODE_LINEAR_FLOAT, real64, word32, HALVES, {CLAMPED PLACE_FLOAT(k.from + k.slope * x) TAKE})
LOOP(ENCODE_UNORM, real64, word32, , {CLAMPED PLACE_UNORM(x) TAKE})
LOOP(ENCODE_FLOAT, real64, word32, HALVES, {CLAMPED PLACE_FLOAT(x) TAKE})

/* ---- Code to depth ----------------------------------------------------------------------------------------------- */

DP_INLINE double value_float(uint32_t code, int shift, uint64_t lift, double least_normal) {
    const uint64_t bits = ((uint64_t)code << shift) + lift;
    const double normal = dp_float64(bits);
    const double subnormal = dp_float64(bits + ((uint64_t)1 << 52)) - least_normal;
    return normal < least_normal ? subnormal : normal;
}

#define LIFT                                                                                                           \
    const int up = 52 - k.mantissa;                                                                                    \
    const uint64_t lift = (uint64_t)(1023 - k.bias) << 52;

#define CODE       const uint32_t c = from[i] < k.code_max ? from[i] : k.code_max;
#define VALUE(C)   value_float((C), up, lift, k.least_normal)
#define AS_REAL(C) ((double)(int32_t)((C) ^ 0x80000000U) + 0x1p31) /* exact; signed conversions are in every set */

LOOP(DECODE_UNORM, word32, real64, , { CODE to[i] = AS_REAL(c) * k.value + AS_REAL(c) * k.value_rest; })
LOOP(DECODE_UNORM_WIDE, word32, real64, , { CODE to[i] = 2.0 * AS_REAL(c) / k.den; })
LOOP(DECODE_FLOAT, word32, real64, LIFT, { CODE to[i] = VALUE(c); })

/* The operations of dp_curve_eye(), one for one: to_near and to_far weigh num, the others comp. */
#define SHARES(NUM)                                                                                                    \
    const double num = (NUM);                                                                                          \
    const double comp = k.den - num;                                                                                   \
    const double near_share = reversed ? num : comp;                                                                   \
    const double far_share = reversed ? comp : num;

#define SENSE const int reversed = batch->setup.reversed;

#ifndef QUOTIENTS_BY_HAND
LOOP(EYE_PERSPECTIVE_UNORM, word32, real64, SENSE,
     { CODE SHARES(2.0 * AS_REAL(c)) to[i] = k.top / (k.to_near * near_share + k.to_far * far_share); })
LOOP(EYE_PERSPECTIVE_FLOAT, word32, real64, SENSE LIFT,
     { CODE SHARES(VALUE(c)) to[i] = k.top / (k.to_near * near_share + k.to_far * far_share); })
#endif

LOOP(EYE_LINEAR_UNORM, word32, real64, SENSE,
     { CODE SHARES(2.0 * AS_REAL(c)) to[i] = (k.to_near * near_share + k.to_far * far_share) / k.den; })
LOOP(EYE_LINEAR_FLOAT, word32, real64, SENSE LIFT,
     { CODE SHARES(VALUE(c)) to[i] = (k.to_near * near_share + k.to_far * far_share) / k.den; })

/*
 * Widths: z2 - z1 = z1 z2 kappa step with one divide for both depths. The cells of the planes' codes are cut there and
 * were computed beforehand; codes beyond them have none.
 */
#define ENDS(WIDTH)                                                                                                    \
    const double inner = (WIDTH);                                                                                      \
    const double real = AS_REAL(c);                                                                                    \
    const double after = real > k.first ? inner : k.first_width;                                                       \
    const double within = real < k.last ? after : k.last_width;                                                        \
    const double kept = real < k.first ? k.before_width : within;                                                      \
    to[i] = real > k.last ? k.after_width : kept;

#ifndef QUOTIENTS_BY_HAND
/* The depths of a cell of UNORM are (v - 1/2) and (v + 1/2) over a number that k.width and k.rest took up. */
LOOP(WIDTH_PERSPECTIVE_UNORM, word32, real64, SENSE, {
    CODE const double comp = k.steps - AS_REAL(c);
    const double v = (reversed ? AS_REAL(c) : comp) + k.rest;
    ENDS(k.width / (v * v - 0.25))
})
#endif

/* The boundaries of a FLOAT code: half way to the neighbours, or the code and the next when truncated. */
#define BOUNDARIES                                                                                                     \
    const double value = VALUE(c);                                                                                     \
    const double above = VALUE(c + 1U);                                                                                \
    const double a = truncated ? value : 0.5 * (VALUE(c - 1U) + value);                                                \
    const double b = truncated ? above : 0.5 * (value + above);
#define TRUNCATED const int truncated = batch->setup.spec.rounding == DP_ROUND_ZERO;

DP_INLINE double divisor_at(const struct dp_batch_numbers *k, int reversed, double num) {
    const double comp = k->den - num;
    return reversed ? k->to_near * num + k->to_far * comp : k->to_near * comp + k->to_far * num;
}

LOOP(WIDTH_PERSPECTIVE_FLOAT, word32, real64, SENSE LIFT TRUNCATED,
     {CODE BOUNDARIES ENDS(k.width * (b - a) / (divisor_at(&k, reversed, a) * divisor_at(&k, reversed, b)))})
LOOP(WIDTH_LINEAR_UNORM, word32, real64, , {CODE ENDS(k.width)})
LOOP(WIDTH_LINEAR_FLOAT, word32, real64, LIFT TRUNCATED, {CODE BOUNDARIES ENDS(k.width * (b - a))})

/* ---- Conversions ------------------------------------------------------------------------------------------------- */

LOOP(WIDEN_REAL, real32, real64, , { to[i] = (double)from[i]; })
LOOP(NARROW_REAL, real64, real32, , { to[i] = (float)from[i]; })
LOOP(WIDEN_CODE, word16, word32, , { to[i] = from[i]; })
LOOP(NARROW_CODE, word32, word16, , { to[i] = (uint16_t)from[i]; })

/* ---- Direct: float depth to UNORM, perspective ------------------------------------------------------------------- */

/*
 * t = s - p/z, or p/z - s reversed, with the quotient as a sum of two floats: q = p/z rounded, whose remainder is exact
 * when fused, and the remainder over z. q is cut into a whole number and a fraction, and the fractions meet in [8, 16),
 * where a float has steps of 2^-20. batch_plan.c has the error bound.
 */
#define QUOTIENT                                                                                                       \
    const float raised = from[i] > k.z_lo ? from[i] : k.z_lo;                                                          \
    const float z = raised < k.z_hi ? raised : k.z_hi;                                                                 \
    const float q = k.reach / z;                                                                                       \
    const float rest = fmaf(-q, z, k.reach) + k.reach_rest;                                                            \
    const float inverse = q * k.reach_inverse;                                                                         \
    const int32_t whole = (int32_t)q;                                                                                  \
    const float part = q - (float)whole;

#define SETTLE(SUM, CODE)                                                                                              \
    const uint32_t bits = dp_bits32(SUM);                                                                              \
    const int32_t distance = (int32_t)(bits & 0xFFFFFU);                                                               \
    least = distance < least ? distance : least;                                                                       \
    const int32_t floor_sum = (int32_t)(bits >> 20) + k.whole;                                                         \
    to[i] = (__typeof__(to[0]))(CODE);

#define STANDARD QUOTIENT SETTLE(fmaf(-rest, inverse, k.offset) - part, floor_sum - whole)
#define REVERSED QUOTIENT SETTLE(fmaf(rest, inverse, k.offset) + part, floor_sum + whole)

#if FUSED
LOOP(STANDARD_16, real32, word16, , {STANDARD})
LOOP(STANDARD_32, real32, word32, , {STANDARD})
LOOP(REVERSED_16, real32, word16, , {REVERSED})
LOOP(REVERSED_32, real32, word32, , {REVERSED})
#endif

/* ---- Direct: float window depth to UNORM and back, N from 2 to 24, to nearest ------------------------------------ */

/* Not by constants, or the compiler sees that a clamped depth has a known code and makes two ways of it. */
#define UNIT                                                                                                           \
    const float raised = from[i] > k.z_lo ? from[i] : k.z_lo;                                                          \
    const float d = raised < k.z_hi ? raised : k.z_hi;

/*
 * N < 24: from 2^23 on floats are whole numbers apart, so that one fused operation rounds the exact product. Without
 * it: D = d 2^N, exact, is rounded so to r, and d M = D - d falls below r - 1/2 when D - r + 1/2 < d, whose left side
 * is exact where that can be. The only tie is d = 1/2, whose even neighbour is the upper one.
 */
#if FUSED
#define PRODUCT const uint32_t code = dp_bits32(fmaf(d, k.unit, 0x1p23F)) - 0x4B000000U;
#else
#define PRODUCT                                                                                                        \
    const float steps = d * k.split;                                                                                   \
    const float r = steps + 0x1p23F;                                                                                   \
    const float over = steps - (r - 0x1p23F);                                                                          \
    const uint32_t code = dp_bits32(r) - 0x4B000000U - (over + 0.5F < d ? 1U : 0U);
#endif
LOOP(UNORM_OF_FLOAT_16, real32, word16, , { UNIT PRODUCT to[i] = (uint16_t)code; })
LOOP(UNORM_OF_FLOAT_32, real32, word32, , { UNIT PRODUCT to[i] = code; })

/*
 * N = 24: d (2^24 - 1) rounded is the float below D = d 2^24, and the code is D - 1/2 rounded up, D - 1 above d = 1/2:
 * what is left when the float below 1/2 is added and the fraction cut off. tests/test_batch.c tries every float.
 */
LOOP(UNORM24_OF_FLOAT, real32, word32, , { UNIT to[i] = (uint32_t)(int32_t)(d * 16777215.0F + 0x1.fffffep-2F); })

#define WHOLE                                                                                                          \
    const uint32_t clamped = from[i] < k.code_max ? from[i] : k.code_max;                                              \
    const float c = (float)(int32_t)clamped;
LOOP(FLOAT_OF_UNORM_16, word16, real32, , { WHOLE to[i] = c * k.unit + c * k.unit_rest; })
LOOP(FLOAT_OF_UNORM_32, word32, real32, , { WHOLE to[i] = c * k.unit + c * k.unit_rest; })

/* ---- Direct: UNORM code to eye depth in float ---------------------------------------------------------------------
 */

#ifndef QUOTIENTS_BY_HAND
#define FAST_EYE                                                                                                       \
    WHOLE const float comp = k.unit - c;                                                                               \
    to[i] = k.eye_top / (k.eye_slope * (reversed ? c : comp) + k.eye_base);
LOOP(FAST_EYE_16, word16, real32, SENSE, {FAST_EYE})
LOOP(FAST_EYE_32, word32, real32, SENSE, {FAST_EYE})
#endif

/* ---- Direct: binary32, whose codes are its bits, and binary16 -----------------------------------------------------
 */

LOOP(BITS_OF_FLOAT, real32, word32, , { UNIT to[i] = dp_bits32(d); })
LOOP(FLOAT_OF_BITS, word32, real32, , { CODE to[i] = dp_float32(c); })

#ifndef HALF_BY_HARDWARE
LOOP(HALF_OF_FLOAT, real32, word16, const int32_t up = batch->setup.spec.rounding == DP_ROUND_ZERO ? 0 : 1;, {
    UNIT const int32_t bits = (int32_t)dp_bits32(d);
    const int32_t normal = ((bits + up * (0xFFF + (bits >> 13 & 1))) >> 13) - (112 << 10);
    const float small = d < 0x1p-14F ? d : 0x1p-14F;
    const int32_t whole = (int32_t)(small * 0x1p24F);
    const int32_t even = (int32_t)(dp_bits32(small * 0x1p24F + 0x1p23F) & 0x7FFFFFU);
    to[i] = (uint16_t)(d < 0x1p-14F ? (up ? even : whole) : normal);
})
LOOP(FLOAT_OF_HALF, word16, real32, , {
    const int32_t c = from[i] < 0x3C00 ? from[i] : 0x3C00;
    const float normal = dp_float32((uint32_t)(c << 13) + (112U << 23));
    to[i] = c < 0x400 ? (float)c * 0x1p-24F : normal;
})
#endif

#define ROW(K) [DP_KERNEL_##K] = kernel_##K,
dp_batch_kernel *const TABLE[DP_KERNEL_COUNT] = {
    ROW(CODE_PERSPECTIVE_UNORM) ROW(CODE_PERSPECTIVE_FLOAT) ROW(CODE_LINEAR_UNORM) ROW(CODE_LINEAR_FLOAT)
        ROW(ENCODE_UNORM) ROW(ENCODE_FLOAT) ROW(DECODE_UNORM) ROW(DECODE_UNORM_WIDE) ROW(DECODE_FLOAT)
            ROW(EYE_PERSPECTIVE_UNORM) ROW(EYE_PERSPECTIVE_FLOAT) ROW(EYE_LINEAR_UNORM) ROW(EYE_LINEAR_FLOAT)
                ROW(WIDTH_PERSPECTIVE_UNORM) ROW(WIDTH_PERSPECTIVE_FLOAT) ROW(WIDTH_LINEAR_UNORM)
                    ROW(WIDTH_LINEAR_FLOAT) ROW(WIDEN_REAL) ROW(NARROW_REAL) ROW(WIDEN_CODE) ROW(NARROW_CODE)
#if FUSED
                        ROW(STANDARD_16) ROW(STANDARD_32) ROW(REVERSED_16) ROW(REVERSED_32)
#endif
                            ROW(UNORM_OF_FLOAT_16) ROW(UNORM_OF_FLOAT_32) ROW(UNORM24_OF_FLOAT) ROW(FLOAT_OF_UNORM_16)
                                ROW(FLOAT_OF_UNORM_32) ROW(HALF_OF_FLOAT) ROW(FLOAT_OF_HALF) ROW(BITS_OF_FLOAT)
                                    ROW(FLOAT_OF_BITS) ROW(FAST_EYE_16) ROW(FAST_EYE_32)};
