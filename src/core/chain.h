/* SPDX-License-Identifier: MIT */
/*
 * The binary32 pipeline as a real function, and what each of its operations rounds away.
 *
 * Everything here is about a span of binary32 depths and bounds what happens at each of them; demand.c puts two
 * together. depthprec(7) derives it.
 */
#ifndef CORE_CHAIN_H
#define CORE_CHAIN_H

#include <math.h>

#include "core/extremes.h"
#include "depthprec/pipeline.h"

/* Binary32 eye depths, as doubles, lo <= hi; of either sign where the camera is orthographic. */
typedef struct dp_span {
    double lo, hi;
} dp_span;

/* The binary32 depth of a surface; and 0, where hardware may make that of it. */
static inline dp_span dp_flushed_span(double z) {
    return fabs(z) < 0x1p-126 ? (dp_span){smaller(z, 0.0), larger(z, 0.0)} : (dp_span){z, z};
}

/*
 * All that is decided on the way to a demand, in order: binades, choices, what a format loses; and what follows from it
 * at a depth z. guarantee_stretches.c looks for depths that share the decisions.
 */
enum { DP_DECISIONS = 256 };
#define DP_SENSITIVE 0x1p20 /* up to so many |B| the window depth moves by more with z than its errors do */
typedef struct dp_decisions {
    double made[DP_DECISIONS];
    int count, unknown;     /* unknown: not all of them are here */
    double linear, falling; /* the demands as x, see distance(): that of a constant slope, and t times the other's */
    double kept_lo, product, granule; /* of the numerator t, see dp_numerator_least() */
    double end;                       /* no depth out of order is beyond; INFINITY: the demands alone say where */
} dp_decisions;

/*
 * The pipeline's real function g(z), with the rounded A and B that both surfaces share. Or of a run of cameras: then a
 * and b are the least that A and B are in any of them, whatever their bits, and all that follows holds in each.
 */
typedef struct dp_chain {
    dp_pipeline pipeline;
    double a, b;
    double a_more, b_more; /* of a run of cameras: how much larger the magnitudes may be; else 0 */
    int run;               /* of cameras: the bits of A and B are unknown */
    double a_granule;      /* A is a multiple of it, and B of its own; infinity where they are 0 */
    double b_granule;
    double half;         /* window depth per depth over w: 1/2 where NDC is signed, times what a viewport leaves */
    double per_clip;     /* what the shader's remap leaves of the clip depth, 1/2 or 1 */
    double per_ndc;      /* what the viewport leaves of the NDC depth */
    int a_exact;         /* A z is exact: A is 0 or a power of two */
    int fused;           /* A z + B is rounded once, and A z is not exact: else that makes no difference */
    int two_stage;       /* the viewport scales and moves */
    int ranged;          /* to other ends than 0 and 1 */
    int remap;           /* the vertex shader halves and moves */
    int few_steps;       /* the numerator, below, falls by so few steps of its lattice that each counts */
    dp_span reach;       /* the depths that enter: near and far in binary32, at most its largest number */
    double below, above; /* how far g leaves its range at the lower and the upper end of NDC, inside the planes: it may
                            be clamped there */
    double ends[2];      /* the range, at near and at far */
    double ends_off;     /* the most that g is beside it by the roundings of the viewport's numbers */
    dp_decisions *decisions; /* null: nobody asks for them */
} dp_chain;

static inline double dp_decided(const dp_chain *c, double what) {
    dp_decisions *d = c->decisions;
    if (d != NULL) {
        d->unknown |= d->count == DP_DECISIONS;
        if (!d->unknown)
            d->made[d->count++] = what;
    }
    return what;
}

dp_chain dp_chain_make(const dp_setup *setup, const dp_pipeline *pipeline);

/*
 * The chain of all cameras whose planes lie between those of two set-ups, alike but for near or far. Every demand made
 * of it is at least that made of each camera's own, in one of which A or B may not be 0 unless it is in all.
 */
dp_chain dp_chain_between(const dp_setup *one, const dp_setup *other, const dp_pipeline *pipeline);

/* g(z), not clamped; and by how much more that may be in a run of cameras. */
double dp_chain_window(const dp_chain *c, double z);
double dp_chain_window_more(const dp_chain *c, double z);

/*
 * One operation: the most that it changes a result by, and the lattice on which all its results lie. An exact operation
 * has an error of 0, and its lattice does not matter.
 */
typedef struct dp_step {
    double error, grid;
} dp_step;

/* The operations at every depth of a span, each as window depth, but for `inverse`. */
typedef struct dp_steps {
    dp_step product, sum, remap, quotient, viewport;
    dp_step inverse;    /* 1/w: its lattice in units of 1/w, its error as window depth */
    double inverse_off; /* the most that 1/w is off by */
    double numerator;   /* of dp_chain_steps(): t is at least this, see below */
    double kept_lo;     /* what adding B changes, in clip depth and towards near: where all sums of the span are */
    double kept_hi;     /* rounded alike the two are one, but for a run of cameras */
    double kept_one;    /* the last place of all sums, where each camera rounds its own alike; else 0 */
    double full;        /* all errors of one window depth */
} dp_steps;

dp_steps dp_chain_steps(const dp_chain *c, dp_span span);

/* A value that all multiples of a granule reach which are not below `least`. */
static inline double dp_on_lattice(double least, double granule) {
    if (least <= 0.0)
        return 0.0;
    return granule > 0.0 && least < 0x1p50 * granule ? ceil(least / granule) * granule : least;
}

/* The numerator, below, of a depth z and its clip depth, less what it may have lost. */
static inline double dp_numerator_least(const dp_chain *c, double z, double clip, double kept_lo, double product,
                                        double more) {
    const int plain = c->pipeline.clip_reversed && !c->pipeline.ndc_signed;
    const double t = plain ? clip : c->pipeline.clip_reversed ? z + clip : z - clip;
    return t + kept_lo - product - ((fabs(clip) + z) * 0x1p-52 + more);
}

/* The errors at every depth from z on, however far: product and sum together as `product`, the rest as `quotient`. */
dp_steps dp_chain_steps_beyond(const dp_chain *c, double z);

/*
 * The numerator t: the window depth's distance from the far end is half t/w, with t = clip where a reversed mapping
 * stores clip/w itself, else t = w - clip or w + clip. As computed it hardly ever rises with z.
 */
typedef struct dp_numerator {
    double rise; /* a farther depth may have a greater one by this; INFINITY: nothing is known */
    /* As computed at a depth z of the span it is at most the largest multiple of `granule` that is not above
     * most - fall z, and `off`. But for few steps these stay as they are. */
    double most, fall, granule, off;
} dp_numerator;

/* The operations at every depth of a span, and its numerators: they have the first operations in common. They rise from
 * a depth, before the span or its nearest, to its end. Orthographic: there are none, and *numerator stays. */
dp_steps dp_chain_steps_behind(const dp_chain *c, double from, dp_span span, dp_numerator *numerator);

#endif
