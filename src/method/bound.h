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

#include "method/term.h"

#include "depthprec/depthprec.h"

/** Window depths next to each other, and what is exact there. */
typedef struct bound_piece {
    bool reversed;
    term d;
    range near;    /**< the share of the way from the far plane: 1 - d, or d itself where near is stored as 1 */
    range inverse; /**< 1/z */
    range eye;     /**< z */
} bound_piece;

enum { BOUND_CONSTANTS = 4 };

/** A method as its operations: what is the same for all depths, and what each depth goes through. */
typedef struct bound_steps {
    void (*constants)(const dp_setup *setup, term k[BOUND_CONSTANTS]);
    term (*run)(const term k[BOUND_CONSTANTS], const bound_piece *p);
} bound_steps;

/**
 * Of a perspective set-up with a standard or reversed mapping onto [0, 1]: no binary32 window depth, whose eye depth is
 * at most 2^127, has a greater relative error. INFINITY where the divisor may come to 0.
 */
double bound_over(const bound_steps *steps, const dp_setup *setup);

/** Of linearize, by name and in the order of its rows. */
extern const bound_steps bound_unity, bound_complement_unity, bound_linear_01, bound_linear_01_near, bound_textbook,
    bound_fused, bound_complement, bound_newton, bound_magic, bound_double, bound_phi, bound_pair;

#endif
