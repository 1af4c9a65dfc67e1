/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file sweep.h  The exact worst case over a range by visiting every code: what dp_worst_over() must equal.
 *
 * All codes of the range are evaluated in double with closed forms (good to 1e-14); every code within 1e-13 of the
 * greatest is then compared exactly. Where more than that tie (a linear curve ties in every code) the nearest and the
 * farthest few thousand are.
 */
#ifndef TESTS_SWEEP_H
#define TESTS_SWEEP_H

#include "oracle.h"

typedef struct sweep_best {
    int infinite;
    mpq_t value;          /* scene units */
    mpq_t z;              /* the depth that has it; of a cell, its near end */
    uint32_t code, other; /* both sides of one boundary may have the same error there */
} sweep_best;

typedef struct sweep {
    sweep_best error, interval;
    mpq_t interval_hi;
    int blind; /* the range touches an unbounded cell */
    mpq_t blind_from;
    uint64_t codes, candidates;
} sweep;

void sweep_init(sweep *s);
void sweep_clear(sweep *s);
/** hi may be INFINITY where far is. */
void sweep_over(sweep *s, oracle *o, double lo, double hi);

#endif
