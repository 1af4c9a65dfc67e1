/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file distance.h  How far a requirement holds throughout, from a depth on. */
#ifndef SOLVE_DISTANCE_H
#define SOLVE_DISTANCE_H

#include "quantity/quantity.h"

typedef struct distance_answer {
    bool possible;          /**< it holds at `lo` at least */
    bool throughout;        /**< it holds up to `hi`, or 1e18 where that is infinite */
    double value;           /**< certified: it holds at every depth from lo to here */
    double fails;           /**< a depth beyond `value` where it does not, or is not certain to; NaN where throughout */
    quantity_worst reached; /**< what is worst from lo to `value`; impossible: at lo */
} distance_answer;

/**
 * The largest depth of [lo, hi] up to which a requirement holds at every depth, in the model of the set-up: what lies
 * beyond `fails` and holds again, as binades of a float may, is left out.
 *
 * Bound: quantity_over() passes [lo, value]. `fails` is the next binary32 depth in fp32, and within 2^-48 of `value` in
 * the other models, unless the search for a certain bound was given up.
 *
 * @param lo, hi  near <= lo <= hi <= far; hi may be INFINITY
 * @return DP_OK, DP_ERROR_NULL, DP_ERROR_RANGE (depths, limit), DP_ERROR_MODEL (an error in float)
 */
dp_status distance_solve(quantity_kind kind, const dp_setup *setup, double lo, double hi, double limit,
                         distance_answer *out);

/**
 * The same for a separation, cheaper: certified too, and equal to the largest when both are rounded down to so many
 * digits. Of a set-up and depths that distance_solve() takes, and 1 to 15 digits. @return NaN where it does not hold at
 * `lo`
 */
double distance_about(const dp_setup *setup, double lo, double hi, double limit, int digits);

/** Depths from lo to hi, throughout which it holds. */
typedef struct distance_span {
    double lo, hi;
} distance_span;

/**
 * Where a separation holds again beyond the depth `after`, up to which distance_solve() found it to: each span is
 * certified as that is, longer than 2^-24 of its depth, and begins where a bisection ends. Only those are found of
 * which a depth is tried: 64 an octave over 16 octaves, and as many just behind the ends of the binades of window
 * depth, where a float gets finer. Given up where 16 in a row end where they begin: rounding hides how depths differ.
 *
 * @return how many there are in `out`, ascending
 */
size_t distance_again(const dp_setup *setup, double after, double hi, double limit, distance_span *out, size_t room);

#endif
