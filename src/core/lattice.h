/* SPDX-License-Identifier: MIT */
/*
 * The lattice: the window depths that a format can hold and the boundaries where rounding changes the code.
 *
 * Each is kept as an exact quotient num/den together with its complement comp/den. UNORM has den = 2 (2^N - 1), so
 * that codes are the even numerators and midpoints the odd ones, and comp is exact. FLOAT has den = 1 and num of at
 * most M + 2 significant bits; comp is 1 - num, correctly rounded.
 */
#ifndef CORE_LATTICE_H
#define CORE_LATTICE_H

#include <math.h>
#include <stdint.h>

#include "core/bits.h"
#include "depthprec/format.h"

typedef struct dp_point {
    double num;
    double comp;
    double den;
} dp_point;

/* The lattice in units of its local step: t = d scale, and a depth with that t is stored as base + t, rounded. */
typedef struct dp_scaled {
    double t;
    double scale;
    uint32_t base;
} dp_scaled;

enum { DP_RG_CODE_MAX = 255 * 255 };

/* Whether a shader multiplies the window depth by 255, in binary32, before two channels are stored. */
static inline int dp_format_is_rg(const dp_format *format) {
    return format->kind == DP_FORMAT_UNORM && format->code_max == DP_RG_CODE_MAX;
}

/* Whether the codes of a format are the bits of binary16 (10, 15) or of binary32 (23, 127). */
static inline int dp_format_is_ieee(const dp_format *format, int mantissa_bits, int bias) {
    return format->kind == DP_FORMAT_FLOAT && format->mantissa_bits == mantissa_bits && format->bias == bias;
}

/* 2^e for -1022 <= e <= 1023 */
static inline double dp_power2(int e) {
    return dp_float64((uint64_t)(e + 1023) << 52);
}

/* floor(log2(d)) of a normal positive double */
static inline int dp_exponent(double d) {
    return (int)(dp_bits64(d) >> 52) - 1023;
}

/* The binade whose step holds at d: the lowest normal one serves the subnormals too. */
static inline int dp_binade(const dp_format *format, double d) {
    int e = dp_exponent(d);
    int lowest = 1 - format->bias;
    return e > lowest ? e : lowest;
}

static inline dp_point dp_point_make(double num, double den) {
    return (dp_point){num, den - num, den};
}

static inline double dp_point_den(const dp_format *format) {
    return format->kind == DP_FORMAT_UNORM ? 2.0 * (double)format->code_max : 1.0;
}

static inline double dp_float_value(const dp_format *format, uint32_t code) {
    const int m = format->mantissa_bits;
    const uint32_t field = code >> m;
    const uint32_t mantissa = code & ((1U << m) - 1U);
    return field == 0 ? (double)mantissa * dp_power2(1 - format->bias - m)
                      : (double)(mantissa | (1U << m)) * dp_power2((int)field - format->bias - m);
}

static inline dp_point dp_point_of_code(const dp_format *format, uint32_t code) {
    double num = format->kind == DP_FORMAT_UNORM ? 2.0 * (double)code : dp_float_value(format, code);
    return dp_point_make(num, dp_point_den(format));
}

/* The rounding boundary between code - 1 and code; 1 <= code <= code_max. Sums and halves are exact. */
static inline dp_point dp_point_below(const dp_format *format, dp_rounding rounding, uint32_t code) {
    if (rounding == DP_ROUND_ZERO)
        return dp_point_of_code(format, code);
    double num = format->kind == DP_FORMAT_UNORM
                     ? 2.0 * (double)code - 1.0
                     : 0.5 * (dp_float_value(format, code - 1) + dp_float_value(format, code));
    return dp_point_make(num, dp_point_den(format));
}

/* The step from a code to the next in numerators: of the whole UNORM, or of the binade e of a FLOAT. */
static inline double dp_step_num(const dp_format *format, int e) {
    return format->kind == DP_FORMAT_UNORM ? 2.0 : dp_power2(e - format->mantissa_bits);
}

/* t is rounded for UNORM and exact for FLOAT. 0 <= d <= 1 + 2^-50. */
static inline dp_scaled dp_scale_depth(const dp_format *format, double d) {
    if (format->kind == DP_FORMAT_UNORM) {
        double scale = (double)format->code_max;
        return (dp_scaled){d * scale, scale, 0};
    }
    const int e = dp_binade(format, d);
    const double scale = dp_power2(format->mantissa_bits - e);
    return (dp_scaled){d * scale, scale, (uint32_t)(e + format->bias - 1) << format->mantissa_bits};
}

/* Whether a depth exactly on a boundary always takes the upper code; otherwise it takes the even one. */
static inline int dp_ties_up(const dp_format *format, dp_rounding rounding) {
    return rounding == DP_ROUND_ZERO || (rounding == DP_ROUND_NEAREST && format->kind == DP_FORMAT_UNORM);
}

#endif
