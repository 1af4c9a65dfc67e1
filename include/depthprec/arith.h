/* SPDX-License-Identifier: MIT */
/**
 * @file arith.h  Variants of the binary32 arithmetic between a vertex and the depth buffer, and of the log2 that a
 * shader has, a row each.
 */
#ifndef DEPTHPREC_ARITH_H
#define DEPTHPREC_ARITH_H

#include <stddef.h>

#include "depthprec/status.h"

DP_BEGIN

/** How a binary32 window depth becomes a UNORM code; FLOAT formats are rounded as the set-up's rounding says. */
typedef enum dp_conversion {
    DP_CONVERT_EXACT = 0,    /**< the exact product d (2^N - 1), rounded as the set-up says (nearest: ties up) */
    DP_CONVERT_PRODUCT_EVEN, /**< the binary32 product fl(d (2^N - 1)), to nearest even */
    DP_CONVERT_PRODUCT_ZERO, /**< that product truncated */
    DP_CONVERT_SIXTEENTHS    /**< 2^N d less d, both cut to sixteenths, see depthprec-camera(7): of 16 and 24 bits */
} dp_conversion;

/** How clip z is divided by w. */
typedef enum dp_reciprocal {
    DP_RECIPROCAL_NONE = 0, /**< z / w, rounded once */
    DP_RECIPROCAL_ROUNDED,  /**< z times the rounded 1/w */
    DP_RECIPROCAL_UNIT      /**< z times NVIDIA's 1/w, off by up to 0.975 units in the last place */
} dp_reciprocal;

/** One variant. The index of a row is its dp_arith. */
typedef struct dp_arith_row {
    const char *name;
    int fused; /**< A z + B is one fused operation */
    dp_reciprocal reciprocal;
    int remap; /**< NDC of [-1, 1] is moved to [0, 1] before the divide, fl(fl(z_clip + w) 0.5), by the shader */
    dp_conversion conversion;
    const char *note;
    const char *source;
} dp_arith_row;

/** An index into the rows. */
typedef size_t dp_arith;

/** How many variants of binary32 arithmetic there are. */
DP_API size_t dp_arith_count(void);

/** The row of a variant of arithmetic, the first being the default `ieee`; null when out of range. */
DP_API const dp_arith_row *dp_arith_get(dp_arith index);

/** Finds a variant by name, letter case ignored. @return DP_OK; DP_ERROR_ARITH or DP_ERROR_NULL and *out unchanged */
DP_API dp_status dp_arith_parse(const char *name, dp_arith *out);

/**
 * The largest error of a shader's log2 of x: `inside` where x is in [0.5, 2] and that is not 0; else `ulps` units in
 * the last place of log2(x) and `relative` of its size, together. The index of a row is its dp_log2_rule.
 */
typedef struct dp_log2_row {
    const char *name;
    const char *aliases; /**< other accepted spellings, separated by one space */
    double inside;       /**< absolute */
    double ulps;
    double relative;
    const char *note;
    const char *source;
} dp_log2_row;

/** An index into the rows. */
typedef size_t dp_log2_rule;

/** The row of a rule for how wrong a shader's log2 may be, the first being the default `vulkan`; null when out of
 * range. */
DP_API const dp_log2_row *dp_log2_get(dp_log2_rule index);

DP_END
#endif
