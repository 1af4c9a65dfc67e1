/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file measure.h  What a requirement is judged by: the separation, or the error, whatever the alignment to the codes.
 *
 * Neither saw-tooths from code to code, so both can be solved for. Only the steps of a FLOAT make them jump, where
 * d(z) crosses a power of two. Models exact and staged.
 */
#ifndef REQUIREMENT_MEASURE_H
#define REQUIREMENT_MEASURE_H

#include "depthprec/depthprec.h"

typedef enum measure_kind {
    MEASURE_SEPARATION = 0, /**< dp_separation(): how far behind z a surface must lie to be told apart */
    MEASURE_ERROR /**< no code that z may be stored as lies farther from z, however z is aligned: half a step behind
                       it; truncated, a step before it, or behind it when reversed */
} measure_kind;

/**
 * The measure at a depth in [near, far], scene units. INFINITY where no depth lies that far behind z.
 * Bound: never below the true value, within 1e-12 relative of it.
 */
double measure_at(measure_kind kind, const dp_setup *setup, double z);

typedef struct measure_worst {
    double value;
    double z; /**< the depth that reaches it */
} measure_worst;

/** The largest measure over [lo, hi], near <= lo <= hi <= far: at an end of the range or of a binade of d inside it. */
measure_worst measure_over(measure_kind kind, const dp_setup *setup, double lo, double hi);

/**
 * The same in two parts, the larger of which it is. While near grows and measure_field() of lo, of hi and of
 * measure_summit() stay as they are, `falling` falls and `rising` rises; `rising` is 0 at z = lo where there is none.
 */
void measure_parts(measure_kind kind, const dp_setup *setup, double lo, double hi, measure_worst *falling,
                   measure_worst *rising);

/** The depth that parts the two: binade ends nearer than it count in `rising`. Depends on far, not on near. */
double measure_summit(measure_kind kind, const dp_setup *setup, double lo, double hi);

/** The depth that decides over [lo, hi] when there is but one: hi, or lo where the steps shrink towards far. */
double measure_governing(const dp_setup *setup, double lo, double hi);

/** The exponent field of the FLOAT step that the separation takes at z, exactly; 0 for UNORM. */
uint32_t measure_field(const dp_setup *setup, double z);

/** The window depth at which measure_field() turns into `field`, field >= 1. */
double measure_threshold(const dp_setup *setup, uint32_t field);

#endif
