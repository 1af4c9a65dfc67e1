/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file bound.h  A bound on the error of a method for the camera at hand, proven from its operations one by one
 * (term.h), in microseconds: no depth is tried.
 *
 * The window depths are cut into pieces. Of each the terms say how far the result may be off there; the piece that is
 * worst is halved again, so that a power of two lies between two pieces where it matters.
 */
#ifndef METHOD_BOUND_H
#define METHOD_BOUND_H

#include <stdbool.h>

#include "method/steps.h"
#include "method/term.h"

#include "depthprec/depthprec.h"

/** Window depths next to each other, and what is exact there. */
typedef struct bound_piece {
    term d;
    range near;    /**< from the far plane's window depth on: 1 - d, or d itself where near is stored as 1 */
    range inverse; /**< 1/z */
    range eye;     /**< z */
} bound_piece;

/** Standard and reversed depth from 0 to 1; the same in another depth range. */
enum { BOUND_VARIANTS = 4 };
int bound_variant(const dp_setup *setup);

/** A method as its operations: texts of steps.h for each variant. */
typedef struct bound_steps {
    const char *constants[BOUND_VARIANTS], *steps[BOUND_VARIANTS]; /**< null where only `off` is known, or nothing is */
    bool wide;                                                     /**< in binary64, the result rounded once */
    double off;                                                    /**< the share before the last rounding */
} bound_steps;

/** The errors that a language allows its operations. */
typedef struct bound_arithmetic {
    double rounding; /**< of sums, differences and products: half units, 1 for to nearest, 2 for to either neighbour */
    double division; /**< the same of quotients: 5 for 2.5 units in the last place */
    bool contracts;  /**< a product that is added may not be rounded */
    bool flushes;    /**< numbers below 2^-126 may become 0 */
    double exp2[2];  /**< of exp2(x) the relative error is at most the first and |x| times the second; 0: no promise */
    double log2[2];  /**< of log2(x) the absolute error from 0.5 to 2, and the relative one elsewhere; 0: no promise */
} bound_arithmetic;
extern const bound_arithmetic bound_nearest; /**< IEEE 754 */

typedef struct bound_known {
    const char *name;
    term term;
} bound_known;

/** A row at a camera, at work. */
typedef struct bound_walk {
    const bound_steps *row;
    int variant;
    const bound_arithmetic *how;
    steps constants, steps;
    bound_known known[2 * STEPS_MAX + 1]; /**< the constants, d and the steps */
} bound_walk;
/** The numbers that form constants; the ends of a depth range are those that binary32 has. */
steps_given bound_given(const dp_setup *setup);
void bound_begin(const bound_steps *row, const dp_setup *setup, const bound_arithmetic *how, bound_walk *w);
term bound_run(bound_walk *w, const bound_piece *p); /**< the eye depth throughout the piece */

/**
 * For a perspective set-up with a standard or reversed mapping onto its depth range: no binary32 window depth of that,
 * whose eye depth is at most 2^127, has a greater relative error. INFINITY where the divisor may come to 0. Where
 * numbers may be flushed and far is infinite the depth is at most 2^125, too, and that of window depth 2^-125.
 */
double bound_over(const bound_steps *row, const dp_setup *setup, const bound_arithmetic *how);

/** The bounds of linearize, by name and in the order of its rows. */
extern const bound_steps bound_unity, bound_complement_unity, bound_linear_01, bound_linear_01_near, bound_textbook,
    bound_fused, bound_complement, bound_newton, bound_magic, bound_double, bound_phi, bound_pair;

#endif
