/* SPDX-License-Identifier: MIT */
/* The distance from which on the binary32 pipeline stores two depths in order; depthprec(7) has the proof. */
#ifndef CORE_DEMAND_H
#define CORE_DEMAND_H

#include "core/chain.h"

/* The demand on a pair, as a distance of window depths in real arithmetic, by cause. */
typedef struct dp_demand {
    double projection; /* roundings of A z + B, of both depths */
    double format;     /* the longest distance of two window depths with one code */
    double window;     /* all of it: the rest is the divide, the viewport and what clamping takes */
    double rest;       /* format and what was demanded on top */
    double slope;      /* the distance of two window depths is half slope (1/z1 - 1/z2), or half slope (z2 - z1) */
    double until;      /* no depth behind it is out of order, wherever the distance ends; INFINITY: nothing is known */
} dp_demand;

/*
 * How far behind a depth of `first`, which lies in one binade or next to 0, another binary32 depth can lie at most
 * without being stored strictly behind it. INFINITY where there is no such distance. `extra` is window depth that is
 * demanded on top.
 */
double dp_demand_longest(const dp_chain *chain, dp_span first, double extra, dp_demand *out);

/* The longest distance of two binary32 window depths of [low, high] that are stored as one code: multiples of `grid`,
 * or of anything if that is 0. */
double dp_format_loss(const dp_pipeline *pipeline, double low, double high, double grid);

/* The most that storing a window depth, a binary32 number of at most `high`, changes it by. */
double dp_stored_error(const dp_pipeline *pipeline, double high);

#endif
