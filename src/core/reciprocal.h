/* SPDX-License-Identifier: MIT */
/* 1/w as a GPU's multifunction unit makes it: a table and a quadratic, as in Oberman and Siu, A high-performance area-
 * efficient multifunction interpolator, 2005. */
#ifndef CORE_RECIPROCAL_H
#define CORE_RECIPROCAL_H

#include "depthprec/arith.h"

/**
 * NVIDIA's, of positive normal numbers; others are divided. It never rises with w, is exact for powers of two, off by
 * less than 0.975 units in the last place and 1.65 2^-24 of itself, and what is below 2^-126 becomes 0.
 */
float dp_reciprocal_unit(float w);

/** The most that 1/w is off by: half units of the greatest one's last place, 2^-24 of itself, and what below 2^-126. */
typedef struct dp_reciprocal_error {
    double half_ulps, units, subnormal;
} dp_reciprocal_error;

static inline dp_reciprocal_error dp_reciprocal_error_of(dp_reciprocal kind) {
    static const dp_reciprocal_error errors[] = {[DP_RECIPROCAL_NONE] = {0.0, 0.0, 0.0},
                                                 [DP_RECIPROCAL_ROUNDED] = {1.0, 1.0, 0x1p-150},
                                                 [DP_RECIPROCAL_UNIT] = {1.95, 1.65, 0x1p-126}};
    return errors[kind];
}

#endif
