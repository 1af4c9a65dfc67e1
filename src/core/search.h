/* SPDX-License-Identifier: MIT */
/*
 * For the rooms above too: where a condition turns. It holds at one number and fails at another, above or below; the
 * caller asks between them until there is nothing left to ask:
 *
 *     dp_edge e = {.holds = a, .fails = b};
 *     for (double x; dp_edge_between(&e, &x);)
 *         *(condition(x) ? &e.holds : &e.fails) = x;
 *
 * Then e.holds is the last number where it holds and e.fails, its neighbour, the first where it fails. Where it turns
 * more than once, they stand at one of the turns. Neither end is asked about. Between two positive numbers that takes
 * at most some 70 steps; where an end is 0 or negative halving is not logarithmic, and takes up to some 2,200.
 */
#ifndef CORE_SEARCH_H
#define CORE_SEARCH_H

#include <math.h>

#include "core/bits.h"
#include "core/extremes.h"

typedef struct dp_edge {
    double holds, fails; /* finite; NaN, or the same: nothing lies between them */
    double apart;        /* they may stay so far apart, a share of the larger magnitude; 0: not at all */
    double straight;     /* positive ones are halved on a logarithmic scale where their ratio is above that */
    int single;          /* binary32 numbers alone are asked about */
} dp_edge;

/* A number about halfway between the two, strictly between them; 0: there is none. */
static inline int dp_edge_between(const dp_edge *e, double *x) {
    const double lo = smaller(e->holds, e->fails), hi = larger(e->holds, e->fails);
    const double even = 0.5 * lo + 0.5 * hi;
    *x = lo > 0.0 && lo * e->straight < hi ? sqrt(lo) * sqrt(hi) : even;
    if (!(*x > lo && *x < hi)) /* next to each other a product of roots may be rounded beyond them, this is not */
        *x = even;
    if (e->single) {
        *x = (double)(float)*x;
        if (*x <= lo)
            *x = (double)dp_ranked32(dp_rank32((float)*x) + 1U);
    }
    return *x > lo && *x < hi && hi - lo > e->apart * larger(fabs(lo), fabs(hi));
}

#endif
