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

/* dp_guarantee_at() of many depths, to the bit; of most cameras several times as fast (`make bench`: separations). */
void dp_guarantee_many(const dp_guarantee *g, const double *z, double *separation, size_t count);

/*
 * Where depths are computed: a separation that is guaranteed at every binary32 depth from `nearest` to `farthest`, two
 * depths of one binade: as good as the worst of them when the run is short. INFINITY where there is none.
 */
double dp_guarantee_bound(const dp_guarantee *g, float nearest, float farthest);

#endif
