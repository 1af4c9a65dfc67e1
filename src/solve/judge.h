/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file judge.h  One requirement in one model: what `check` decides by and what `solve` looks for, so that they agree.
 */
#ifndef SOLVE_JUDGE_H
#define SOLVE_JUDGE_H

#include <stdbool.h>

#include "depthprec/depthprec.h"

typedef enum measure_kind {
    MEASURE_SEPARATION = 0, /**< dp_separation(): how far behind z a surface must lie to be told apart */
    MEASURE_ERROR           /**< |stored - z| */
} measure_kind;

typedef struct judgement {
    double value;  /**< scene units: the separation or error at z; the bound where only that is above the limit */
    double z;      /**< the depth that is worst */
    uint32_t code; /**< an error: stored there */
    bool passed;   /**< certified: the requirement holds at every depth asked about */
} judgement;

/**
 * The set-up in which a spec is judged. That is dp_setup_init()'s, but in the model float, which knows only the
 * pipeline, a logarithmic depth is what its shader computes: dp_setup_guaranteed().
 *
 * @return what dp_setup_init() has against it
 */
dp_status judge_setup(const dp_spec *spec, dp_setup *out);

/**
 * Judges a set-up in its own model over [lo, hi], near <= lo <= hi <= far, or at lo = hi.
 *
 *     separation  dp_separation() at one depth, the bound of dp_separation_over() over more
 *     error       |stored - z| at one depth, the bound of dp_worst_over() over more; models exact and staged
 *
 * @param limit  scene units, positive; NaN to ask what is reached: then value is the certified bound
 */
judgement judge(measure_kind kind, const dp_setup *setup, double lo, double hi, double limit);

#endif
