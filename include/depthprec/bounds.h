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

#include <stddef.h>
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
 * The largest error of a stored depth and the widest z-fighting interval in a range of eye depths, and where they are.
 *
 * @param lo, hi  eye depths, near <= lo <= hi <= far; hi may be INFINITY when far is
 * @return DP_OK, or DP_ERROR_RANGE, DP_ERROR_NULL; *out is then left as it was
 *
 * In the model `staged` the cells of a piece hold varying numbers of binary32 steps: error and interval are then at
 * most one step of window depth and one of NDC depth above what is reached at the depths named. In `float` there are no
 * cells: all values are NaN.
 *
 * Cost: O(pieces): one for UNORM, at most 128 for fp32, most of them dismissed by a bound.
 */
DP_API dp_status dp_worst_over(const dp_setup *setup, double lo, double hi, dp_worst *out);

/** The largest separation over a range. */
typedef struct dp_separation_worst {
    double lo, hi;     /**< the range asked about */
    double bound;      /**< holds at every depth of the range: what lies farther behind any of them is told apart, and
                          with triangles what lies farther in front of any of them, along the normal */
    double separation; /**< dp_separation() at z, at most `bound` */
    double z;          /**< the depth where the largest one was found; where several tie, one of them */
} dp_separation_worst;

/**
 * How far apart surfaces must be to be resolved at every depth of a range: the largest dp_separation() in [lo, hi].
 *
 * In the model `exact` the separation rises with z inside a binade, so the ends of binades are all that can be worst.
 * In `staged` and `float` the range is divided until an upper bound of each part is either at most 2^-10 above the
 * largest separation found, or at most `limit`, or the part is a single depth.
 *
 * @param lo, hi  eye depths, near <= lo <= hi <= far, lo finite
 * @param limit   scene units; where it lies between `separation` and `bound`, the search goes on until it does not.
 *                0: no limit
 * @return DP_OK, DP_ERROR_RANGE, DP_ERROR_NULL; *out is then left as it was
 *
 * Bound: `bound` is never below the truth; `exact`: at most 1e-12 relative above it, else as above unless 2^16
 * evaluations are not enough. In `float` it is a guarantee of its own, found with the error analysis of dp_budget_at()
 * over parts of the range, and never below that of a depth in it.
 */
DP_API dp_status dp_separation_over(const dp_setup *setup, double lo, double hi, double limit,
                                    dp_separation_worst *out);

/**
 * Bounds of dp_separation() over many short ranges, for tables: bound[i] holds at every depth from lo[i] to hi[i].
 * Nothing is searched, so it is as good as the worst depth of the range where that is short, a thousandth of a binade
 * or so, and never below it.
 *
 * @param lo, hi  eye depths, near <= lo[i] <= hi[i] <= far, finite
 * @return DP_OK, DP_ERROR_RANGE, DP_ERROR_NULL; *bound is then left as it was
 *
 * Cost: about as much as dp_separation() for each range within a binade.
 */
DP_API dp_status dp_separation_runs(const dp_setup *setup, const double *lo, const double *hi, double *bound,
                                    size_t count);

DP_END
#endif
