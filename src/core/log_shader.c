/* SPDX-License-Identifier: MIT */
#include "core/log_shader.h"

#include "core/demand.h"
#include "core/elementary.h"
#include "core/engine.h"
#include "core/extremes.h"
#include "core/reciprocal.h"
#include "core/rounding.h"

static const double ln2 = 0.69314718055994531;

/* A division of Vulkan, GLSL and WGSL, in units in the last place: where they say what log2 may be off by. */
static const double division = 2.5;

/* No computed argument or logarithm is farther than this from what it stands for: relative, and of the logarithm. */
static const double beside = 0x1p-20;

static double ulp_of(double x) {
    return 2.0 * dp_half_ulp(x);
}

/* The argument of the logarithm, and the logarithm, where that begins at `from`. */
static double argument_of(const dp_log_shader *s, double from, double z) {
    return s->by > 0.0 ? 1.0 + s->by * (z - from) : z / from;
}

static double log2_at(const dp_log_shader *s, double from, double z) {
    return s->by > 0.0 ? dp_log1p(s->by * (z - from)) / ln2 : dp_log2(z / from);
}

/* ---- log2 -------------------------------------------------------------------------------------------------------- */

/* The most that log2 is off by where the logarithm is in lo..hi. */
static double log2_error(const dp_log2_row *row, double lo, double hi) {
    const double size = larger(larger(fabs(lo), hi), beside) * (1.0 + beside);
    const double inside = lo - beside <= 1.0 ? row->inside : 0.0;
    const double outside =
        hi + beside > 1.0 || row->inside == 0.0 ? row->ulps * ulp_of(size) + row->relative * size : 0.0;
    return larger(inside, outside);
}

/* ---- The argument ------------------------------------------------------------------------------------------------ */

/* The most that rounding numbers of lo..hi to binary32 changes them by, relative to the smallest of them. */
static double relative_error(double lo, double hi) {
    return dp_exponent(lo) == dp_exponent(hi) ? dp_half_ulp(hi) / lo : DP_UNIT;
}

/* 1 + y is exact where it stays in the binade of y and y has no bits above those of 1: y is a float below 2^24. */
static int sum_is_exact(double y_lo, double y_hi) {
    const double lo = y_lo * (1.0 - beside);
    const double hi = y_hi * (1.0 + beside);
    return lo >= 1.0 && hi < 0x1p24 && dp_exponent(lo) == dp_exponent(1.0 + hi);
}

/*
 * Errors of the logarithm are errors of the argument, relative, over ln 2; and a little more, as s is not A. Rounding
 * part of the argument changes that by DP_UNIT of it at most, however long the span.
 */
static double argument_error(const dp_log_shader *s, dp_span r) {
    const double lo = argument_of(s, s->from_hi, r.lo);
    const double hi = argument_of(s, s->from, r.hi);
    if (s->by == 0.0)
        return division * 2.0 * relative_error(lo * (1.0 - beside), hi * (1.0 + beside)) / ln2 * (1.0 + beside);
    const double x = (r.hi - s->from) * (1.0 + beside);
    const double left = larger(lo * (1.0 - beside), 1.0 - beside);
    const double taken = r.hi <= 2.0 * s->from || s->from == 0.0 ? 0.0 : s->by * dp_half_ulp(x);
    const double product = s->by_exact ? 0.0 : dp_half_ulp(s->by * x);
    const double sum = sum_is_exact(s->by * (r.lo - s->from_hi), s->by * (r.hi - s->from))
                           ? 0.0
                           : smaller(relative_error(left, hi * (1.0 + beside)), 1.0 / left);
    return (smaller(taken / left, DP_UNIT) + smaller(product / left, DP_UNIT) + sum) / ln2 * (1.0 + beside);
}

/* ---- Behind the logarithm ---------------------------------------------------------------------------------------- */

/* Clip z, the divide and the viewport of a depth that a vertex shader wrote, as window depth; see clip.h. */
static void vertex_steps(const dp_log_shader *s, double lo, double hi, dp_log_steps *out) {
    const dp_arith_row *arith = s->pipeline.arith;
    const double t = larger(fabs(2.0 * lo - 1.0), fabs(2.0 * hi - 1.0)) * (1.0 + beside);
    const double top = larger(hi, 0.0);
    out->scale = dp_half_ulp(top) + (2.0 * lo < 0.5 + beside ? 0.5 * DP_UNIT_BELOW_ONE : 0.0);
    const double product = 0.5 * DP_UNIT * t;
    const double unit = dp_reciprocal_error_of(arith->reciprocal).units * DP_UNIT;
    const double inverse = unit * (arith->remap ? top : 0.5 * t);
    const double remap = arith->remap ? DP_UNIT * top : 0.5 * dp_half_ulp(t);
    const double last = dp_half_ulp(smaller(top, 1.0 - DP_UNIT_BELOW_ONE));
    out->ndc = (product + remap + inverse + last) * (1.0 + beside);
}

/* The least window depth of a logarithm. */
static double window_below(const dp_log_shader *s, double logarithm) {
    return smaller(logarithm * s->k_lo, logarithm * s->k_hi);
}

dp_log_steps dp_log_shader_steps(const dp_log_shader *s, dp_span r) {
    dp_log_steps out = {.lo = log2_at(s, s->from_hi, r.lo), .hi = log2_at(s, s->from, r.hi)};
    out.argument = argument_error(s, r) * DP_OUTWARD;
    out.log2 = log2_error(s->log2, out.lo, out.hi) * DP_OUTWARD;
    const double off = out.argument + out.log2;
    const double hi = larger((out.hi + off) * s->k_hi * DP_OUTWARD, 0.0);
    if (s->vertex)
        vertex_steps(s, window_below(s, out.lo - off), hi, &out);
    else if (s->by == 0.0)
        out.scale = division * ulp_of(hi);
    else
        out.scale = dp_half_ulp(smaller(hi, 1.0 - DP_UNIT_BELOW_ONE));
    return out;
}

/* ---- A shader ---------------------------------------------------------------------------------------------------- */

/* Where the scale is 1/log2(far/near) of the shader's own: by how much that is off; it is from `least` to `most`. */
static double scale_over_near(dp_log_shader *s, double least, double most) {
    const double off = division * 2.0 * DP_UNIT / ln2 * (1.0 + beside) + log2_error(s->log2, least, most);
    s->k_lo = 1.0 / ((most + off) * DP_OUTWARD);
    s->k_hi = 1.0 / ((least - off) * (2.0 - DP_OUTWARD));
    s->decoded = s->k_hi / (1.0 / ((least + off) * DP_OUTWARD)) - 1.0;
    return off;
}

dp_log_shader dp_log_shader_make(const dp_setup *setup, const dp_log2_row *log2) {
    const dp_spec *spec = &setup->spec;
    const dp_mapping_row *row = dp_mapping_get(spec->mapping);
    const double n = (double)(float)spec->znear;
    const double f = (double)(float)spec->zfar;
    dp_log_shader s = {.pipeline = {.format = spec->format,
                                    .rounding = spec->rounding,
                                    .arith = dp_arith_get(spec->arith),
                                    .ndc_signed = row->ndc_signed},
                       .log2 = log2,
                       .from = row->log_from_near ? n : 0.0,
                       .from_hi = row->log_from_near ? n : 0.0,
                       .by = row->log_over_near ? 0.0 : (double)(float)spec->log_c,
                       .zfar = f,
                       .vertex = row->ndc_signed};
    if (row->log_over_near) {
        const double top = dp_log2(f / n);
        scale_over_near(&s, top, top);
    } else {
        s.k_lo = s.k_hi = (double)(float)(ln2 / setup->kappa);
        s.by_exact = dp_granule((float)s.by) == s.by;
    }
    s.above = larger(log2_at(&s, s.from, f) - 1.0 / s.k_hi, 0.0);
    return s;
}

/*
 * How far the logarithm of far may lie above 1/k, whatever the bits of C, n, f and k: k is off by DP_UNIT of itself, C
 * and f - n by as much of what they are and of f + n.
 */
static double most_above(const dp_log_shader *s, double n, double f, double nearest_far) {
    const double argument = argument_of(s, s->from_hi, nearest_far);
    return DP_UNIT * (log2_at(s, s->from, f) + (1.0 + s->by * (f + n) / argument) / ln2) * (1.0 + beside);
}

dp_log_shader dp_log_shader_between(const dp_setup *outer, const dp_setup *inner, const dp_log2_row *log2) {
    dp_log_shader s = dp_log_shader_make(outer, log2);
    const dp_log_shader other = dp_log_shader_make(inner, log2);
    s.run = 1;
    s.from_hi = other.from;
    if (s.by > 0.0) {
        s.k_lo = (double)(float)(ln2 / outer->kappa * (1.0 - DP_ROUNDINGS_6));
        s.k_hi = (double)(float)(ln2 / inner->kappa * (1.0 + DP_ROUNDINGS_6));
        s.above = most_above(&s, s.from_hi, s.zfar, other.zfar);
    } else {
        const double most = dp_log2(s.zfar / s.from);
        s.above = scale_over_near(&s, dp_log2(other.zfar / other.from), most) + most * 0x1p-39;
    }
    return s;
}

/* ---- The distance ------------------------------------------------------------------------------------------------ */

/* The distance behind z at which the logarithm has grown by so much. */
static double distance(const dp_log_shader *s, double z, double growth) {
    return argument_of(s, s->from, z) / (s->by > 0.0 ? s->by : 1.0 / s->from) * dp_expm1(growth * ln2) * DP_OUTWARD;
}

/*
 * The demand of any depth of a run and any behind it up to hi, as growth of the logarithm. Where the farther one may
 * be clamped to 1, what the other is off by counts, and how far the logarithm itself goes beyond. The nearer one may be
 * clamped to 0, which brings the two closer by no more than it is off by: no logarithm of a binary32 depth is below 0.
 */
static double demand_of(const dp_log_shader *s, dp_span run, double hi, double extra, dp_log_demand *out) {
    const dp_log_steps a = dp_log_shader_steps(s, run);
    const dp_log_steps b = dp_log_shader_steps(s, (dp_span){run.lo, hi});
    const double off[2] = {a.argument + a.log2, b.argument + b.log2};
    const double ends[2] = {a.scale + a.ndc, b.scale + b.ndc};
    const double low = window_below(s, a.lo - off[0]) - ends[0];
    const double high = (b.hi + off[1]) * s->k_hi + ends[1];
    const double format = dp_format_loss(&s->pipeline, low, high, 0.0);
    const double rest = format + extra;
    double growth = (rest + ends[0] + ends[1]) / s->k_lo + off[0] + off[1];
    if (high >= 1.0)
        growth = larger(growth, s->above + off[0] + (rest + ends[0]) / s->k_lo);
    *out = (dp_log_demand){.argument = (a.argument + b.argument) * s->k_lo,
                           .log2 = (a.log2 + b.log2) * s->k_lo,
                           .ndc = a.ndc + b.ndc,
                           .format = format,
                           .window = growth * s->k_lo};
    out->scale = out->window - extra - out->argument - out->log2 - out->ndc - format; /* with what clamping takes */
    return growth;
}

/* First what holds against all depths behind; then only those nearer than that need a demand, which is smaller. */
double dp_log_longest(const dp_log_shader *s, dp_span run, double extra, dp_log_demand *out) {
    double longest = HUGE_VAL;
    double hi = larger(s->zfar, run.hi);
    for (int i = 0; i < 8; i++) {
        dp_log_demand d;
        const double next = distance(s, run.hi, demand_of(s, run, hi, extra, &d));
        if (i > 0 && !(next < longest))
            break;
        const double gain = longest - next;
        longest = next;
        *out = d;
        if (run.hi + next >= hi || gain <= 0x1p-6 * next)
            break;
        if (i > 0 && s->run) /* a camera of the run may end here, where it gains little */
            break;
        hi = run.hi + next;
    }
    return longest;
}

/* ---- The error --------------------------------------------------------------------------------------------------- */

double dp_log_shader_error(const dp_log_shader *s, dp_span span) {
    const dp_log_steps a = dp_log_shader_steps(s, span);
    const double off = a.argument + a.log2, ends = a.scale + a.ndc;
    const double high = (a.hi + off) * s->k_hi + ends;
    double growth = off + (ends + dp_stored_error(&s->pipeline, high)) / s->k_lo;
    growth += fabs(a.hi) * s->decoded; /* who decodes has a k of his own */
    growth += high >= 1.0 ? s->above : 0.0;
    return distance(s, span.hi, growth) + dp_half_ulp(span.hi); /* the depth enters as a binary32 number */
}
