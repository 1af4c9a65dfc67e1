/* SPDX-License-Identifier: MIT */
/**
 * @file bounds.h  Certified worst cases over a range of depths, without visiting the codes.
 *
 * Inside one uniform piece of a format (all of a UNORM, one binade of a float) the error and the interval are
 * monotone in the code, so the worst of all codes in a range lies at an end of one of the pieces that the range
 * touches: some hundred evaluations for fp32 in place of 1,065,353,217. depthprec(7) has the proof.
 */
#ifndef DEPTHPREC_BOUNDS_H
#define DEPTHPREC_BOUNDS_H

#include <stdint.h>

#include "depthprec/setup.h"
#include "depthprec/status.h"

DP_BEGIN

/**
 * The worst error and the worst interval over a range. Where several depths reach the same worst value the nearest
 * is named. Values are rounded outward: never below the truth, at most 1e-12 relative above.
 */
typedef struct dp_worst {
    double lo, hi;       /**< the range asked about */
    double error;        /**< max |stored - z| over depths in the range; INFINITY where the last cell is unbounded */
    double error_z;      /**< the depth that reaches it: an end of a cell or of the range */
    uint32_t error_code; /**< the code stored there (on the side of the cell that has this error) */
    double interval;     /**< widest cell, whole, of those that touch the range */
    double interval_lo;  /**< that cell */
    double interval_hi;
    uint32_t interval_code;
    double blind_from; /**< where the unbounded cell of an infinite far plane begins: behind it nothing is told
                            apart; NaN when the range touches no unbounded cell */
} dp_worst;

/**
 * The worst case over [lo, hi].
 *
 * @param lo, hi  eye depths, near <= lo <= hi <= far; hi may be INFINITY when far is
 * @return DP_OK, or DP_ERROR_RANGE, DP_ERROR_NULL; *out is then left as it was
 *
 * In the model `staged` the cells of a piece hold varying numbers of binary32 steps: error and interval are then at
 * most one step of window depth and one of NDC depth above what is reached at the depths named. In `fp32` there are no
 * cells: all values are NaN.
 *
 * Cost: O(pieces): one for UNORM, at most 128 for fp32, most of them dismissed by a bound.
 */
DP_API dp_status dp_worst_over(const dp_setup *setup, double lo, double hi, dp_worst *out);

DP_END
#endif
