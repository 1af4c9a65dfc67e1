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

typedef dp_batch_numbers numbers;

/*
 * A kernel out of what it does to an element; what is the same for all of them the compiler does before the loop. The
 * reduction stands here too, though nothing is reduced: without it GCC 12 adds vector loops for the rest of the
 * elements, and the kernels get slower.
 */
#define LOOP(NAME, IN, OUT, ELEMENT)                                                                                   \
    TARGET static int32_t kernel_##NAME(const dp_batch *batch, const void *in, void *out, size_t count) {              \
        const IN *restrict from = in;                                                                                  \
        OUT *restrict to = out;                                                                                        \
        const numbers k = dp_batch_read(batch)->numbers;                                                               \
        int32_t least = INT32_MAX;                                                                                     \
        PRAGMA(omp simd reduction(min : least))                                                                        \
        for (size_t i = 0; i < count; i++)                                                                             \
            to[i] = (OUT)ELEMENT(&k, from[i]);                                                                         \
        return least;                                                                                                  \
    }

/* The same for codes, whose distances from the next boundary count; of a number that is made of the element first. */
#define LOOP_CODES(NAME, IN, OUT, NUMBER, PLACED)                                                                      \
    TARGET static int32_t kernel_##NAME(const dp_batch *batch, const void *in, void *out, size_t count) {              \
        const IN *restrict from = in;                                                                                  \
        OUT *restrict to = out;                                                                                        \
        const numbers k = dp_batch_read(batch)->numbers;                                                               \
        int32_t least = INT32_MAX;                                                                                     \
        PRAGMA(omp simd reduction(min : least))                                                                        \
        for (size_t i = 0; i < count; i++) {                                                                           \
            const placed p = PLACED(&k, NUMBER(&k, from[i]));                                                          \
            least = p.rest < least ? p.rest : least;                                                                   \
            to[i] = (OUT)p.code;                                                                                       \
        }                                                                                                              \
        return least;                                                                                                  \
    }

/* ---- Depth to code: the code stands in the upper bits of a number, and below it how far the next boundary is ----- */

typedef struct placed {
    uint32_t code;
    int32_t rest;
} placed;

DP_INLINE placed place(const numbers *k, uint64_t bits) {
    return (placed){(uint32_t)(bits >> k->shift) - k->rebias, (int32_t)((uint32_t)(bits >> k->cut) & 0xFFFFFU)};
}

/* t + 2^32 has steps of 2^-20. */
DP_INLINE placed place_unorm(const numbers *k, double x) {
    return place(k, dp_bits64(x * k->scale + k->magic));
}

/*
 * A double has the same shape as the format, but for the subnormals, which take it when the least normal value is
 * added. Halves are chosen as doubles, because every instruction set can.
 */
DP_INLINE placed place_float(const numbers *k, double x) {
    const double high_half = dp_float64(k->half);
    const double low_half = dp_float64(k->half - ((uint64_t)1 << k->shift << k->mantissa));
    const double d = x * k->scale;
    const double v = d + (d < k->least_normal ? k->least_normal : 0.0);
    return place(k, dp_bits64(v) + dp_bits64(d < k->least_normal ? low_half : high_half));
}

DP_INLINE double clamped(const numbers *k, double x) {
    const double raised = x > k->lo ? x : k->lo;
    return raised < k->hi ? raised : k->hi;
}

DP_INLINE double linear(const numbers *k, double z) {
    return k->from + k->slope * clamped(k, z);
}

DP_INLINE double perspective(const numbers *k, double z) {
    return linear(k, z) / clamped(k, z);
}

LOOP_CODES(CODE_PERSPECTIVE_UNORM, real64, word32, perspective, place_unorm)
LOOP_CODES(CODE_PERSPECTIVE_FLOAT, real64, word32, perspective, place_float)
LOOP_CODES(CODE_LINEAR_UNORM, real64, word32, linear, place_unorm)
LOOP_CODES(CODE_LINEAR_FLOAT, real64, word32, linear, place_float)
LOOP_CODES(ENCODE_UNORM, real64, word32, clamped, place_unorm)
LOOP_CODES(ENCODE_FLOAT, real64, word32, clamped, place_float)

/* ---- Code to depth ----------------------------------------------------------------------------------------------- */

DP_INLINE uint32_t kept_code(const numbers *k, uint32_t code) {
    return code < k->code_max ? code : k->code_max;
}

/* Exact; signed conversions are in every set. */
DP_INLINE double as_real(uint32_t code) {
    return (double)(int32_t)(code ^ 0x80000000U) + 0x1p31;
}

/* The numerators of codes, as dp_point_of_code() has them. */
DP_INLINE double unorm_num(const numbers *k, uint32_t code) {
    return 2.0 * as_real(kept_code(k, code));
}

DP_INLINE double float_value(const numbers *k, uint32_t code) {
    const uint64_t bits = ((uint64_t)code << (52 - k->mantissa)) + ((uint64_t)(1023 - k->bias) << 52);
    const double normal = dp_float64(bits);
    const double subnormal = dp_float64(bits + ((uint64_t)1 << 52)) - k->least_normal;
    return normal < k->least_normal ? subnormal : normal;
}

DP_INLINE double float_num(const numbers *k, uint32_t code) {
    return float_value(k, kept_code(k, code));
}

DP_INLINE double unorm_value(const numbers *k, uint32_t code) {
    const double c = as_real(kept_code(k, code));
    return c * k->value + c * k->value_rest;
}

DP_INLINE double unorm_value_wide(const numbers *k, uint32_t code) {
    return unorm_num(k, code) / k->den;
}

LOOP(DECODE_UNORM, word32, real64, unorm_value)
LOOP(DECODE_UNORM_WIDE, word32, real64, unorm_value_wide)
LOOP(DECODE_FLOAT, word32, real64, float_num)

/* The operations of dp_curve_eye(), one for one. */
DP_INLINE double shares(const numbers *k, double num) {
    const double comp = k->den - num;
    const double near_share = k->reversed ? num : comp;
    const double far_share = k->reversed ? comp : num;
    return k->to_near * near_share + k->to_far * far_share;
}

DP_INLINE double eye_linear_unorm(const numbers *k, uint32_t code) {
    return shares(k, unorm_num(k, code)) / k->den;
}

DP_INLINE double eye_linear_float(const numbers *k, uint32_t code) {
    return shares(k, float_num(k, code)) / k->den;
}

LOOP(EYE_LINEAR_UNORM, word32, real64, eye_linear_unorm)
LOOP(EYE_LINEAR_FLOAT, word32, real64, eye_linear_float)

#ifndef QUOTIENTS_BY_HAND
DP_INLINE double eye_perspective_unorm(const numbers *k, uint32_t code) {
    return k->top / shares(k, unorm_num(k, code));
}

DP_INLINE double eye_perspective_float(const numbers *k, uint32_t code) {
    return k->top / shares(k, float_num(k, code));
}

LOOP(EYE_PERSPECTIVE_UNORM, word32, real64, eye_perspective_unorm)
LOOP(EYE_PERSPECTIVE_FLOAT, word32, real64, eye_perspective_float)
#endif

/*
 * Widths: z2 - z1 = z1 z2 kappa step with one divide for both depths. The cells of the planes' codes are cut there and
 * were computed beforehand; codes beyond them have none.
 */
DP_INLINE double with_ends(const numbers *k, uint32_t code, double inner) {
    const double real = as_real(code);
    const double after = real > k->first ? inner : k->first_width;
    const double within = real < k->last ? after : k->last_width;
    const double kept = real < k->first ? k->before_width : within;
    return real > k->last ? k->after_width : kept;
}

#ifndef QUOTIENTS_BY_HAND
/* The depths of a cell of UNORM are (v - 1/2) and (v + 1/2) over a number that k->width and k->rest took up. */
DP_INLINE double width_perspective_unorm(const numbers *k, uint32_t code) {
    const uint32_t c = kept_code(k, code);
    const double comp = k->steps - as_real(c);
    const double v = (k->reversed ? as_real(c) : comp) + k->rest;
    return with_ends(k, c, k->width / (v * v - 0.25));
}

LOOP(WIDTH_PERSPECTIVE_UNORM, word32, real64, width_perspective_unorm)
#endif

/* The boundary below a FLOAT code: half way from the one before it, or the code itself when truncated. */
DP_INLINE double float_boundary(const numbers *k, uint32_t code) {
    const double value = float_value(k, code);
    return k->truncates ? value : 0.5 * (float_value(k, code - 1U) + value);
}

DP_INLINE double width_perspective_float(const numbers *k, uint32_t code) {
    const uint32_t c = kept_code(k, code);
    const double a = float_boundary(k, c), b = float_boundary(k, c + 1U);
    return with_ends(k, c, k->width * (b - a) / (shares(k, a) * shares(k, b)));
}

DP_INLINE double width_linear_unorm(const numbers *k, uint32_t code) {
    return with_ends(k, kept_code(k, code), k->width);
}

DP_INLINE double width_linear_float(const numbers *k, uint32_t code) {
    const uint32_t c = kept_code(k, code);
    return with_ends(k, c, k->width * (float_boundary(k, c + 1U) - float_boundary(k, c)));
}

LOOP(WIDTH_PERSPECTIVE_FLOAT, word32, real64, width_perspective_float)
LOOP(WIDTH_LINEAR_UNORM, word32, real64, width_linear_unorm)
LOOP(WIDTH_LINEAR_FLOAT, word32, real64, width_linear_float)

/*
 * Ends of cells, with the operations of dp_cell_of(): the boundaries around a code are its midpoints with its
 * neighbours, or truncated the codes themselves. Cells of the planes' codes, and of codes beyond them, end at the
 * planes.
 */
DP_INLINE double boundary_num(const numbers *k, uint32_t code, int is_float) {
    const double middle = 2.0 * as_real(code) - 1.0;
    return is_float ? float_boundary(k, code) : k->truncates ? 2.0 * as_real(code) : middle;
}

DP_INLINE double boundary_depth(const numbers *k, uint32_t code, int is_float, int is_linear) {
    const double divisor = shares(k, boundary_num(k, code, is_float));
    return is_linear ? divisor / k->den : k->top / divisor;
}

/* A code counted from the near plane on. */
DP_INLINE double from_near(const numbers *k, uint32_t code) {
    return k->slope * as_real(code);
}

DP_INLINE double nearest_of(const numbers *k, uint32_t code, int is_float, int is_linear) {
    const uint32_t c = kept_code(k, code);
    const double z = boundary_depth(k, c + (k->reversed ? 1U : 0U), is_float, is_linear), at = from_near(k, c);
    const double raised = at > k->first && z > k->lo ? z : k->lo;
    return raised > k->hi ? k->hi : raised;
}

DP_INLINE double farthest_of(const numbers *k, uint32_t code, int is_float, int is_linear) {
    const uint32_t c = kept_code(k, code);
    const double z = boundary_depth(k, c + (k->reversed ? 0U : 1U), is_float, is_linear), at = from_near(k, c);
    const double least = nearest_of(k, code, is_float, is_linear);
    const double raised = z > least ? z : least;
    return at >= k->last || raised > k->hi ? k->hi : raised;
}

#define ENDS(NAME, IS_FLOAT, IS_LINEAR)                                                                                \
    DP_INLINE double lo_##NAME(const numbers *k, uint32_t code) {                                                      \
        return nearest_of(k, code, IS_FLOAT, IS_LINEAR);                                                               \
    }                                                                                                                  \
    DP_INLINE double hi_##NAME(const numbers *k, uint32_t code) {                                                      \
        return farthest_of(k, code, IS_FLOAT, IS_LINEAR);                                                              \
    }                                                                                                                  \
    LOOP(LO_##NAME, word32, real64, lo_##NAME)                                                                         \
    LOOP(HI_##NAME, word32, real64, hi_##NAME)
ENDS(PERSPECTIVE_UNORM, 0, 0)
ENDS(PERSPECTIVE_FLOAT, 1, 0)
ENDS(LINEAR_UNORM, 0, 1)
ENDS(LINEAR_FLOAT, 1, 1)

/* ---- Conversions ------------------------------------------------------------------------------------------------- */

DP_INLINE double widened(const numbers *k, float x) {
    (void)k;
    return (double)x;
}

DP_INLINE double same_real(const numbers *k, double x) {
    (void)k;
    return x;
}

DP_INLINE uint32_t same_code(const numbers *k, uint32_t code) {
    (void)k;
    return code;
}

LOOP(WIDEN_REAL, real32, real64, widened)
DP_INLINE float rounded_down(const numbers *k, double x) {
    (void)k;
    return dp_float_down(x);
}

DP_INLINE float rounded_up(const numbers *k, double x) {
    (void)k;
    return dp_float_up(x);
}

LOOP(NARROW_REAL, real64, real32, same_real)
LOOP(NARROW_DOWN, real64, real32, rounded_down)
LOOP(NARROW_UP, real64, real32, rounded_up)
LOOP(WIDEN_CODE, word16, word32, same_code)
LOOP(NARROW_CODE, word32, word16, same_code)

#include "core/batch_direct.h"

#define ROW(K) [DP_KERNEL_##K] = kernel_##K,
dp_batch_kernel *const TABLE[DP_KERNEL_COUNT] = {
    ROW(CODE_PERSPECTIVE_UNORM) ROW(CODE_PERSPECTIVE_FLOAT) ROW(CODE_LINEAR_UNORM) ROW(CODE_LINEAR_FLOAT)
        ROW(ENCODE_UNORM) ROW(ENCODE_FLOAT) ROW(DECODE_UNORM) ROW(DECODE_UNORM_WIDE) ROW(DECODE_FLOAT)
            ROW(EYE_PERSPECTIVE_UNORM) ROW(EYE_PERSPECTIVE_FLOAT) ROW(EYE_LINEAR_UNORM) ROW(EYE_LINEAR_FLOAT)
                ROW(WIDTH_PERSPECTIVE_UNORM) ROW(WIDTH_PERSPECTIVE_FLOAT) ROW(WIDTH_LINEAR_UNORM)
                    ROW(WIDTH_LINEAR_FLOAT) ROW(LO_PERSPECTIVE_UNORM) ROW(HI_PERSPECTIVE_UNORM)
                        ROW(LO_PERSPECTIVE_FLOAT) ROW(HI_PERSPECTIVE_FLOAT) ROW(LO_LINEAR_UNORM) ROW(HI_LINEAR_UNORM)
                            ROW(LO_LINEAR_FLOAT) ROW(HI_LINEAR_FLOAT) ROW(WIDEN_REAL) ROW(NARROW_REAL) ROW(NARROW_DOWN)
                                ROW(NARROW_UP) ROW(WIDEN_CODE) ROW(NARROW_CODE)
#if FUSED
                                    ROW(STANDARD_16) ROW(STANDARD_32) ROW(REVERSED_16) ROW(REVERSED_32)
                                        ROW(BINARY32_STANDARD) ROW(BINARY32_REVERSED)
#endif
                                            ROW(UNORM_OF_FLOAT_16) ROW(UNORM_OF_FLOAT_32) ROW(UNORM24_OF_FLOAT)
                                                ROW(FLOAT_OF_UNORM_16) ROW(FLOAT_OF_UNORM_32) ROW(HALF_OF_FLOAT)
                                                    ROW(FLOAT_OF_HALF) ROW(BITS_OF_FLOAT) ROW(FLOAT_OF_BITS)
                                                        ROW(FAST_EYE_16) ROW(FAST_EYE_32)};
