/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file plane.h  The near or far plane that meets a requirement in any model, judged as `check` judges.
 *
 * No model has a separation below that of the lattice, so the lattice's answer (solve.h) bounds all others. In float
 * the measure is not monotone: whether a plane will do hangs on how its matrix entries are rounded to binary32. So
 * there are two answers: the first value that passes, beyond which every binary32 value fails for 2^-10 of itself at
 * least; and the one to use, on whose safe side all pass, which a bound over all cameras in between proves.
 */
#ifndef REQUIREMENT_PLANE_H
#define REQUIREMENT_PLANE_H

#include "requirement/judge.h"
#include "requirement/solve.h"

/** How much work: alternatives are only found, the answer is also surrounded. */
typedef enum plane_effort { PLANE_FIND = 0, PLANE_PROVE } plane_effort;

typedef struct plane_answer {
    bool possible;
    double value;      /**< the least near, or the largest far; impossible: one that comes near */
    double chosen;     /**< the one to use: from here to `until` all pass, or all that were tried */
    bool proven;       /**< all of them do, not only those that were tried */
    double until;      /**< the other end of the values that pass; between the two some may fail */
    double steady;     /**< from here to `until` all that were tried pass; NaN where the last that was tried fails */
    uint64_t tried;    /**< values tried from `value` to `until`; 0 where all of them pass for certain */
    uint64_t passed;   /**< of these */
    bool certain;      /**< nothing passes next beyond `value`: see `fails_to` */
    double fails_to;   /**< every binary32 value from here to `value` fails; NaN: the very next double does, or none is
                            left to look at */
    judgement reached; /**< at `chosen`, in the model asked about */
} plane_answer;

/**
 * Solves a problem in the model of its set-up.
 *
 * @param lattice  receives the answer of the lattice, model exact, whatever the model asked about; its islands hold in
 *                 that model, and for an error however the depths are aligned
 * @return DP_OK (also when impossible), or what solve() and dp_setup_init() have against it; DP_ERROR_MODEL for an
 *         error in float, which has no stored depth
 */
dp_status plane_solve(const solve_problem *problem, plane_effort effort, solve_result *lattice, plane_answer *out);

/** Whether a value of the unknown passes, as `check` judges it. */
bool plane_passes(const solve_problem *problem, double value);

/** Over a range the ends are judged first: they are looked at anyhow, and where one fails so does the range. */
bool plane_fails_at_ends(const solve_problem *problem, const dp_setup *setup);

/**
 * The plane that an error needs, |stored - z| of the codes that the depths really have. From the plane that will do
 * however the depths are aligned to the codes, on through the codes that the deciding depth takes, to the first value
 * that fails: all from there to `until` pass. Models exact and staged.
 *
 * @param lattice  what solve() found in the model exact
 */
void plane_error_solve(const solve_problem *problem, const solve_result *lattice, plane_answer *out);

#endif
