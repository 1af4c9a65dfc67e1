/* SPDX-License-Identifier: MIT */
/* dp_separation() of a set-up at many depths: what computes them is prepared once. */
#ifndef CORE_GUARANTEE_H
#define CORE_GUARANTEE_H

#include "core/log_shader.h"
#include "core/triangles.h"

typedef struct dp_guarantee {
    const dp_setup *setup;
    int computed; /* dp_is_computed(); else it is of the lattice, and nothing below is there */
    union {
        dp_chain chain;       /* of a matrix */
        dp_log_shader shader; /* of a logarithm */
    };
    dp_slant slant; /* where there are triangles */
} dp_guarantee;

dp_guarantee dp_guarantee_make(const dp_setup *setup);

/*
 * A guarantee for all cameras between two set-ups, alike but for one plane: at every depth and run it is at least
 * each camera's own, but for what the lattice alone asks for. `outer` has the smaller near or the larger far. 0:
 * nothing is known of them together.
 */
int dp_guarantee_between(const dp_setup *outer, const dp_setup *inner, dp_guarantee *out);

/* The separation at a depth; INFINITY: there is none. Of slanted triangles a shader's knows as little as a lattice's.
 */
double dp_guarantee_at(const dp_guarantee *g, double z);

/* At least what the lattice alone needs: no arithmetic before it makes two surfaces easier to tell apart. */
double dp_with_lattice(const dp_setup *setup, double z, double needs);

/*
 * Stretches of depths whose guarantees follow from a few numbers. Perspective cameras in the arithmetic ieee, facing,
 * have some where they are reversed from 1 to 0, or far is at most 1e5 near; finding them takes as long as
 * DP_STRETCHES_PAY depths one by one, or less.
 */
enum { DP_STRETCHES = 384, DP_STRETCH_CELLS = 1024, DP_STRETCHES_PAY = 3072 };
typedef struct dp_stretch {
    double from, to, linear, linear_rise, falling, falling_rise, kept_lo, product, granule, end, lattice;
} dp_stretch;

/* In order; of each cell of depths the first stretch that does not end before it. */
typedef struct dp_stretches {
    int count, shift;
    uint32_t first, last; /* bits of the depths */
    uint16_t in_cell[DP_STRETCH_CELLS + 1];
    dp_stretch list[DP_STRETCHES + 1];
} dp_stretches;

/* A camera may have none: each depth is then for dp_guarantee_at(). */
void dp_stretches_find(dp_stretches *all, const dp_guarantee *g);

/* dp_guarantee_at() of many depths, to the bit, and many times as fast (`make bench`: separations). */
void dp_guarantee_many(const dp_guarantee *g, const dp_stretches *all, const double *z, double *separation,
                       size_t count);

/*
 * Where depths are computed: a separation that is guaranteed at every binary32 depth from `nearest` to `farthest`, two
 * depths of one binade: as good as the worst of them when the run is short. INFINITY where there is none.
 */
double dp_guarantee_bound(const dp_guarantee *g, float nearest, float farthest);

#endif
