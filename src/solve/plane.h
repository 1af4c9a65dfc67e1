/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file plane.h  The near or far plane from which on a requirement holds, in any model, judged as `check` judges.
 *
 * The need of a plane is not monotone: the steps of a FLOAT double at powers of two, and in binary32 each plane is
 * rounded in its own way. So no single value is sought, but an interval of them, all of which are shown to do by a
 * bound over all cameras in between (core/engine.h): first a place where the bound holds, then its ends, by bisection.
 */
#ifndef SOLVE_PLANE_H
#define SOLVE_PLANE_H

#include "quantity/quantity.h"

typedef enum solve_unknown { SOLVE_NEAR = 0, SOLVE_FAR } solve_unknown;

typedef struct solve_problem {
    dp_spec spec; /**< all but the unknown, whose value in it is not read */
    solve_unknown unknown;
    quantity_kind kind;
    double limit;  /**< the measure may be at most this, scene units, positive */
    double lo, hi; /**< at these depths, lo <= hi, finite; lo = hi for one depth */
} solve_problem;

typedef struct plane_answer {
    bool possible;
    double value; /**< the least near, or the largest far, from which on all pass; else one that comes near */
    double until; /**< the other end of the values that pass with it */
    bool certain; /**< a part in 10^9 beyond `value` none passes, or there is none; impossible: that is certain */
    quantity_worst reached; /**< at `value` */
    double least, most;     /**< the values looked at: near from 1e-12 to lo, far from hi to 1e18 or INFINITY */
} plane_answer;

/** The set-up of a problem with its unknown filled in. */
dp_status solve_setup(const solve_problem *problem, double value, dp_setup *out);

/** Whether a value of the unknown passes, as `check` judges it. */
bool plane_passes(const solve_problem *problem, double value);

/**
 * Solves a problem in the model of its set-up.
 *
 * Bound: every value from `value` to `until` passes; `value` is where the bound over cameras ends, to 2^-31 of itself.
 * Where values pass in several intervals it is the uppermost: the one next to the depths for near, the farthest for
 * far. Narrow ones may be missed, but in the model exact. A single plane, far infinite or one of few bits, is an answer
 * where no interval is.
 *
 * @return DP_OK (also when impossible), DP_ERROR_NULL, DP_ERROR_RANGE (depths or limit), DP_ERROR_MODEL for an error in
 *         float, which has no stored depth, or what dp_setup_init() has against every value of the unknown
 */
dp_status plane_solve(const solve_problem *problem, plane_answer *out);

#endif
