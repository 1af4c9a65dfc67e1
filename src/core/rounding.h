/* SPDX-License-Identifier: MIT */
/* The errors of rounding to binary32. */
#ifndef CORE_ROUNDING_H
#define CORE_ROUNDING_H

#include <math.h>

#include "core/extremes.h"
#include "core/lattice.h"

/* DP_UNIT just below 1. */
#define DP_UNIT_BELOW_ONE 0x1p-25

/* Half a unit in the last place of binary32 at x >= 0: the most that rounding a number up to x changes it by. */
static inline double dp_half_ulp(double x) {
    return x < 0x1p-126 ? 0x1p-150 : dp_power2(dp_exponent(x) - 24);
}

/*
 * The most that rounding a result of `least` to `most` changes it by. A result below the normal numbers may be flushed
 * to zero or not, as the hardware likes: the worse of the two.
 */
static inline double dp_result_error(double least, double most) {
    const double error = dp_half_ulp(most);
    const double flushed = most < 0x1p-126 ? most : 0x1p-126;
    return least < 0x1p-126 && flushed > error ? flushed : error;
}

/* The most that rounding an eye depth of either sign changes it by: one as small as this may be flushed, too. */
static inline double dp_depth_rounding(double z) {
    const double size = fabs(z);
    return size < 0x1p-126 ? 0x1p-126 : dp_half_ulp(size);
}

/* Surfaces are real: each is up to half a step of binary32 away from the depth that enters the pipeline. */
static inline double dp_eye_rounding(double z1, double z2) {
    return isinf(z2) ? 0.0 : dp_depth_rounding(z1) + dp_depth_rounding(z2);
}

/*
 * The most that lies between surfaces from lo to hi and others at most `apart` behind them, with what rounding the
 * eye depths adds. Where the others are nearer to 0, more is added only to those that are not as far behind, as to
 * those that may be flushed to 0.
 */
static inline double dp_apart_with_eye(double lo, double hi, double apart) {
    const double tiny = 0x1p-126, size = dp_depth_rounding(larger(-lo, hi));
    const double first = lo < tiny && hi > -tiny ? larger(size, tiny) : size;
    const double behind = larger(-(lo + apart), hi + apart);
    const double power = 2.0 * dp_power2(dp_exponent(larger(behind, tiny)));
    double most = apart + (first + dp_depth_rounding(behind));
    if (-lo > power)
        most = larger(most, smaller(apart, -lo - power) + (first + dp_depth_rounding(lo)));
    if (lo < tiny && hi + apart > -tiny)
        most = larger(most, smaller(apart, tiny - lo) + (first + tiny));
    return most;
}

/* The lowest set bit of a normal binary32 number, as a value: the number is a whole multiple of it. 0 has none. */
static inline double dp_granule(float x) {
    const uint32_t mantissa = (dp_bits32(x) & 0x7FFFFFU) | 0x800000U;
    const double lowest = (double)(mantissa & -mantissa);
    return x == 0.0F ? HUGE_VAL : lowest * 2.0 * dp_half_ulp(fabs((double)x));
}

#endif
