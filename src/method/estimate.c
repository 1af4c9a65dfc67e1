/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "method/estimate.h"

#include <float.h>
#include <math.h>

float estimate_reciprocal(float x) {
    int exponent;
    const float part = frexpf(fabsf(x), &exponent); /* in [1/2, 1) */
    if (isnan(x))
        return x;
    if (isinf(x) || fabsf(x) < FLT_MIN)
        return copysignf(isinf(x) ? 0.0f : INFINITY, x);
    const int middle =
        2 * (int)(part * 0x1p12f) + 1; /* 2^12 times the middle of the 2048th that x, in [1, 2), lies in */
    const int entry = ((1 << 25) + middle) / (2 * middle);
    const float y = ldexpf((float)entry, -11 - exponent);
    return copysignf(y < FLT_MIN ? 0.0f : y, x);
}
