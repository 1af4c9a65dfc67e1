/* SPDX-License-Identifier: MIT */
/*
 * The engine's inner steps, for the bounds, the tests and the benchmarks; and all that rooms above the core may use of
 * it beside the public headers and append.h: bits, roundings, exact sums, points of the lattice, curves and logarithms.
 */
#ifndef CORE_ENGINE_H
#define CORE_ENGINE_H

#include "core/curve.h"
#include "core/expansion.h"
#include "core/guarantee.h"
#include "core/lattice.h"
#include "core/logarithm.h"
#include "core/rounding.h"
#include "depthprec/depth.h"

/*
 * The quick estimate of a code. *certain tells whether it is proven: whether d(z), as computed, keeps its distance
 * from every rounding boundary by more than its own error. Otherwise the code is within one of the right one.
 */
uint32_t dp_code_quick(const dp_setup *setup, double z, int *certain);

/* d(z) as dp_window() computes it is within 6 units of 2^-53; this leaves room for the product with a scale. */
#define DP_WINDOW_ERROR 0x1p-49

/* Whether a code of the format is the bits of its window depth as a binary32 number. */
static inline int dp_format_is_fp32(const dp_format *f) {
    return f->kind == DP_FORMAT_FLOAT && f->exponent_bits == 8 && f->mantissa_bits == 23 && f->bias == 127;
}

/* Whether a viewport of that depth range moves depth, and whether a set-up may have it: ends of 0, or so large that
 * binary32 has many numbers there, and so far apart. */
#define DP_RANGE_LEAST 1e-6
int dp_range_moves(const double range[2]);
int dp_range_fits(const double range[2]);

/* Fills in what dp_pipeline_init() takes from a set-up whose mapping has a pipeline. */
void dp_pipeline_prepare(dp_setup *setup);

/* The right code, decided exactly from any stored code to start from. */
uint32_t dp_code_exact(const dp_setup *setup, double z, uint32_t start);

/* The same set-up in another model; 0 where its mapping has none such: *out is then left as it was. May be its own. */
static inline int dp_setup_in(const dp_setup *setup, dp_model m, dp_setup *out) {
    dp_spec spec = setup->spec;
    spec.model = m;
    return dp_setup_init(out, &spec) == DP_OK;
}

/* Is the separation that of depths computed in binary32, by dp_budget_at(), and not one of a lattice. */
static inline int dp_is_computed(const dp_setup *setup) {
    return setup->spec.model == DP_MODEL_FLOAT || setup->shader;
}

/*
 * Whether the separation of depths computed in binary32 counts the few steps in which a numerator falls: between two of
 * them it falls as z rises, by no more than z does, and then leaps up. Else it is nearly a straight line.
 */
int dp_counts_steps(const dp_setup *setup);

/* dp_separation() of the models exact and staged, at a finite depth. */
double dp_lattice_separation(const dp_setup *setup, double z);

/* Whether a separation behind z leaves room up to far: else nothing behind z is certain. Decided exactly. */
int dp_is_certain(const dp_setup *setup, double z, double separation);

/* dp_lattice_separation() of the model exact, whatever the set-up's. */
double dp_lattice_exact(const dp_setup *setup, double z);

/*
 * In a fraction of the time: it is not above z h/(1 - h), as dp_curve_ahead() has it, with h = z times this rate, where
 * 1 - h does not cancel. Between two depths the rate is not above that of both.
 */
double dp_lattice_rate(const dp_setup *setup, double z);

static inline int dp_lattice_is_within(double rate, double z, double separation) {
    const double h = z * rate;
    return h >= 0.0 && h < 0.5 && z * h * DP_OUTWARD <= separation * (1.0 - h);
}

/*
 * How far from itself any depth of lo..hi can lie at most once it was computed in binary32, stored and decoded: by a
 * pipeline, decoded by the exact curve, or by the shader of a logarithm, whatever its log2, decoded with its constants.
 * Scene units; *z is where. Only for a set-up whose depths are computed.
 */
double dp_computed_error_over(const dp_setup *setup, double lo, double hi, double *z);
double dp_shader_error_between(const dp_setup *outer, const dp_setup *inner, double lo,
                               double hi); /* of a run, below */

/* The changes of A and B by their rounding to binary32, good to 2^-50 of them. */
void dp_pipeline_rounded(const dp_setup *setup, double *a, double *b);

/*
 * A run of cameras is all whose near or far lies between those of two set-ups that are alike but for that plane:
 * `outer` has the smaller near or the larger far. What follows is a bound of each of them, not samples.
 */

/* Whether dp_separation() is at most `limit` at every depth of [lo, hi] in a run; 0 also where it could not be shown.
 */
int dp_separation_within(const dp_setup *outer, const dp_setup *inner, double lo, double hi, double limit);

/* Whether dp_separation_over() with this limit has a bound within it, found sooner, as no worst depth is sought; 0
 * where that takes as long. */
int dp_separation_soon(const dp_setup *setup, double lo, double hi, double limit);

/*
 * The same of the error of a stored depth, |stored - z|, however z is aligned to the codes: half a step of the format
 * behind it; truncated, a step before it, or behind it when reversed. Models exact and staged; of a logarithm that a
 * shader writes, whatever its log2.
 */
int dp_error_within(const dp_setup *outer, const dp_setup *inner, double lo, double hi, double limit);

/* The least that the model exact needs at a depth in any camera of a run: a separation or, `half`, an error. */
double dp_lattice_least(const dp_setup *outer, const dp_setup *inner, double z, int half);

/* The step of d, as a share of one of the format, at which the depth lies whose distance from z is that error. */
static inline double dp_error_share(const dp_setup *setup) {
    return setup->spec.rounding != DP_ROUND_ZERO ? 0.5 : setup->reversed ? 1.0 : -1.0;
}

/*
 * The models exact and staged: the steps of d that dp_separation(), or such an error, takes at the depths of [nearest,
 * farthest] in any camera of a run, at most.
 */
double dp_separation_step(const dp_setup *setup, const dp_setup *other, double nearest, double farthest, int half);

#endif
