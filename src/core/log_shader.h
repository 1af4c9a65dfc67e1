/* SPDX-License-Identifier: MIT */
/*
 * The shader that writes a logarithmic depth, as a real function, and what each of its operations may change.
 *
 * With w the binary32 eye depth, C, n and k rounded once to binary32, and fl() the rounding of each operation:
 *
 *     s = fl(1 + fl(C w))              n is taken off of w first where near is stored as 0: fl(C fl(w - n))
 *     s = w / n                        where the logarithm is that of w/n
 *     l = log2(s)                      within what the language allows
 *     d = fl(l k)                      k = 1/log2 of the argument at far; there d = l / log2(far / n), in the shader
 *
 * A vertex shader writes w fl(fl(l 2k) - 1) as clip z instead, and the pipeline divides it by w. Additions, products
 * and the rows of dp_arith round once; a division of the shader is within 2.5 units in the last place.
 */
#ifndef CORE_LOG_SHADER_H
#define CORE_LOG_SHADER_H

#include "core/chain.h"

typedef struct dp_log_shader {
    dp_pipeline pipeline; /* format and conversion; no matrix */
    const dp_log2_row *log2;
    double from, by;   /* the argument is 1 + by (w - from); by is 0 where it is w/from */
    double from_hi;    /* of a run of cameras: the greatest, and `from` the least; else the same */
    double k_lo, k_hi; /* window depth per unit of the logarithm: all surfaces share one k in between */
    double decoded;    /* by how much, relative, the k that decodes may differ from that */
    double zfar;
    double above; /* how far the logarithm leaves that of [0, 1] at far */
    int by_exact; /* C w is exact */
    int vertex;   /* written by a vertex shader */
    int run;      /* of cameras */
} dp_log_shader;

/* The shader of a set-up with a logarithmic curve. */
dp_log_shader dp_log_shader_make(const dp_setup *setup, const dp_log2_row *log2);

/*
 * A bound over all cameras with planes between those of two set-ups, alike but for near or far: `outer` has the
 * smaller near or the larger far. Every distance that follows is at least that of each camera's own.
 */
dp_log_shader dp_log_shader_between(const dp_setup *outer, const dp_setup *inner, const dp_log2_row *log2);

/* The most that each step changes a depth by, at every depth of a span. */
typedef struct dp_log_steps {
    double argument, log2; /* of the logarithm */
    double scale, ndc;     /* of window depth: the product or quotient; what follows it in the pipeline */
    double lo, hi;         /* the logarithm, as it is without these errors */
} dp_log_steps;

dp_log_steps dp_log_shader_steps(const dp_log_shader *s, dp_span span);

/* The demand on a pair as window depth, by cause; they add up to `window`. */
typedef struct dp_log_demand {
    double argument, log2, scale, ndc, format, window;
} dp_log_demand;

/*
 * How far behind any depth of a run of binary32 depths another can lie at most without being stored strictly behind it;
 * see demand.h.
 */
double dp_log_longest(const dp_log_shader *s, dp_span run, double extra, dp_log_demand *out);

/* The largest error of any depth of a span once it is decoded with the shader's constants, scene units. */
double dp_log_shader_error(const dp_log_shader *s, dp_span span);

#endif
