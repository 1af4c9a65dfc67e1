/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file solve.h  The near or far plane that meets a requirement: every value that does, to the last double.
 *
 * As near or far moves, the measure (measure.h) is monotone except where it jumps because d(z) crosses a power of two
 * of a FLOAT. The crossings are known in closed form, and placed exactly by the exact codes; between two of them a
 * bracketed root finder (root.h) finds where the requirement begins to hold. What is reported has been evaluated: an
 * end of an island passes.
 */
#ifndef REQUIREMENT_SOLVE_H
#define REQUIREMENT_SOLVE_H

#include <stdbool.h>

#include "requirement/measure.h"

typedef enum solve_unknown { SOLVE_NEAR = 0, SOLVE_FAR } solve_unknown;

typedef struct solve_problem {
    dp_spec spec; /**< all but the unknown, whose value in it is not read; model exact */
    solve_unknown unknown;
    measure_kind kind;
    double limit;  /**< the measure may be at most this, scene units, positive */
    double lo, hi; /**< at these depths, 0 < lo <= hi, finite; lo = hi for one depth */
} solve_problem;

/** A closed interval of values of the unknown, all of which pass, with values that fail, or cannot be, around it. */
typedef struct solve_island {
    double lo, hi; /**< hi may be INFINITY for far */
} solve_island;

enum { SOLVE_ISLANDS_MAX = 512 };

typedef struct solve_result {
    double least, most; /**< the values searched: near from 1e-12 to lo, far from hi to 1e18 or INFINITY */
    bool possible;
    double value; /**< the near beyond which all pass up to `until`, or the largest far; impossible: the value that
                       comes nearest */
    double until; /**< the other end of the island of `value`; equal to `value` when impossible */
    measure_worst worst;                     /**< the measure at `value`, evaluated, and the depth that reaches it */
    int island_count;                        /**< the last one is that of `value` */
    solve_island islands[SOLVE_ISLANDS_MAX]; /**< ascending */
} solve_result;

/** The set-up of a problem with its unknown filled in. */
dp_status solve_setup(const solve_problem *problem, double value, dp_setup *out);

/**
 * Solves a problem.
 *
 * Bound: each end of an island passes, and so does all between; beyond an end that is not a limit the neighbouring
 * double fails, or, where the measure hardly depends on the unknown (far many times near), a value beyond which the
 * measure grows by 2^-48 of itself (log: 2^-44) fails.
 *
 * @return DP_OK (also when impossible), DP_ERROR_NULL, DP_ERROR_RANGE (depths or limit), DP_ERROR_MODEL, or what
 *         dp_setup_init() has against every value of the unknown
 * Cost: some hundred evaluations for each binade that d(z) can take.
 */
dp_status solve(const solve_problem *problem, solve_result *result);

#endif
