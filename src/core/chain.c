/* SPDX-License-Identifier: MIT */
#include "core/chain.h"

#include <float.h>

#include "core/extremes.h"
#include "core/reciprocal.h"
#include "core/rounding.h"

/* A z + B */
static double clip_of(const dp_chain *c, double z) {
    return c->a * z + c->b;
}

/* How much larger or smaller the clip depth may be in a run of cameras. */
static double clip_more(const dp_chain *c, double z) {
    return c->a_more * fabs(z) + c->b_more;
}

/* The clip w of a depth. */
static double w_of(const dp_chain *c, double z) {
    return c->pipeline.ortho ? 1.0 : z;
}

double dp_chain_window(const dp_chain *c, double z) {
    const double ndc = clip_of(c, z) / w_of(c, z);
    const double d = c->pipeline.ndc_signed ? 0.5 * ndc + 0.5 : ndc;
    return !c->ranged ? d
           : c->remap ? (double)c->pipeline.scale * d + (double)c->pipeline.offset
                      : (double)c->pipeline.scale * ndc + (double)c->pipeline.offset;
}

double dp_chain_window_more(const dp_chain *c, double z) {
    return c->half * clip_more(c, z) / w_of(c, z);
}

/* The dividend over w: the clip depth, or what the shader's remap makes of it. A sum of the same shape, a z + b. */
static double dividend(const dp_chain *c, double z) {
    return c->remap ? 0.5 * (clip_of(c, z) + w_of(c, z)) : clip_of(c, z);
}

/*
 * How far g leaves [0, 1] at a plane. Below 0 that is the clip depth over w; above 1 it is the difference of the two
 * over w. The clip depth is computed with a relative error of 2^-53, which next to 1 has to be added.
 */
static double excess_below(const dp_chain *c, double z) {
    const double w = w_of(c, z);
    const double clip = clip_of(c, z) + (c->pipeline.ndc_signed ? w : 0.0);
    const double rounding = c->pipeline.ndc_signed ? 0x1p-51 * w : 0.0;
    return clip - rounding < 0.0 ? c->half * (rounding - clip) / w * (1.0 + DP_ROUNDINGS_6) : 0.0;
}

static double excess_above(const dp_chain *c, double z) {
    const double w = w_of(c, z);
    const double past = clip_of(c, z) - w + 0x1p-51 * w;
    return past > 0.0 ? c->half * past / w * (1.0 + DP_ROUNDINGS_6) : 0.0;
}

static double resolved_up_to(double zfar) {
    return isinf(zfar) ? (double)FLT_MAX : (double)(float)zfar;
}

/*
 * In a binade of z, of 2^23 steps, the numerator falls by |A| - 1 of each: by few in all where far is far. Then it
 * counts where they lie.
 */
static int has_few_steps(const dp_chain *c) {
    enum { FEW = 16 };
    const double steepest = fabs(c->a) + c->a_more - 1.0;
    return !c->pipeline.ortho && (!c->pipeline.clip_reversed || c->pipeline.ndc_signed) && steepest < FEW * 0x1p-23;
}

/* Some viewports clamp to their range, others to [0, 1] alone; the sum of a product by 1 is exact in double. */
static void set_ends(dp_chain *c, const dp_setup *setup) {
    const double scale = (double)c->pipeline.scale, offset = (double)c->pipeline.offset;
    const double lower = (c->two_stage && c->pipeline.ndc_signed && !c->remap ? -scale : 0.0) + offset;
    const int reversed = c->pipeline.clip_reversed;
    c->ends[0] = setup->ends[0];
    c->ends[1] = setup->ends[1];
    c->ends_off = larger(fabs(lower - c->ends[!reversed ? 0 : 1]), fabs(scale + offset - c->ends[!reversed ? 1 : 0]));
}

dp_chain dp_chain_make(const dp_setup *setup, const dp_pipeline *p) {
    dp_chain c = {.pipeline = *p, .a = (double)p->a, .b = (double)p->b};
    c.a_granule = dp_granule(p->a);
    c.b_granule = dp_granule(p->b);
    c.remap = p->ndc_signed && p->arith->remap;
    c.two_stage = p->moved;
    c.ranged = setup->ranged;
    c.per_clip = c.remap ? 0.5 : 1.0;
    c.per_ndc = fabs((double)p->scale);
    c.half = c.per_ndc * c.per_clip;
    set_ends(&c, setup);
    c.a_exact = c.a == 0.0 || c.a_granule == fabs(c.a);
    c.fused = p->arith->fused && !c.a_exact;
    c.reach.lo = (double)(float)setup->spec.znear;
    c.reach.hi = resolved_up_to(setup->spec.zfar);
    c.below = larger(excess_below(&c, c.reach.lo), excess_below(&c, c.reach.hi)) + c.ends_off;
    c.above = larger(excess_above(&c, c.reach.lo), excess_above(&c, c.reach.hi)) + c.ends_off;
    c.few_steps = has_few_steps(&c);
    return c;
}

/*
 * A and B as they are rounded: each rises or falls evenly with each plane, so it lies between those of the two, or one
 * step beside them where the entries are rounded in double before.
 */
static void span_of(float x, float y, double *least, double *more) {
    const float lo = x < y ? x : y;
    const float hi = x < y ? y : x;
    const double below = (double)nextafterf(lo, -HUGE_VALF);
    const double above = (double)nextafterf(hi, HUGE_VALF);
    const double nearer = below > 0.0 ? below : smaller(above, 0.0); /* to 0 */
    *least = nearer;
    *more = fabs(below > 0.0 ? above : below) - fabs(nearer);
}

/* A plane is where g is 0 or 1 but for the roundings of A, B and the plane itself. */
static double excess_at(const dp_chain *c, double z) {
    const double a = (fabs(c->a) + c->a_more) * fabs(z);
    const double b = fabs(c->b) + c->b_more;
    return c->half * (a + b + (c->pipeline.ortho ? a : b)) / w_of(c, z) * DP_UNIT * (1.0 + DP_ROUNDINGS32_14);
}

dp_chain dp_chain_between(const dp_setup *one, const dp_setup *other, const dp_pipeline *p) {
    dp_chain c = dp_chain_make(one, p);
    c.run = 1;
    span_of(one->matrix[1], other->matrix[1], &c.b, &c.b_more);
    const int finite = !isinf(one->spec.zfar) || !isinf(other->spec.zfar);
    if (finite) {
        span_of(one->matrix[0], other->matrix[0], &c.a, &c.a_more);
        c.a_exact = 0;
    }
    c.fused = p->arith->fused && !c.a_exact;
    c.a_granule = c.a_exact ? c.a_granule : 2.0 * dp_half_ulp(fabs(c.a));
    c.b_granule = 2.0 * dp_half_ulp(fabs(c.b));
    const double hi = resolved_up_to(other->spec.zfar);
    const double nearest_far = smaller(c.reach.hi, hi);
    c.reach.lo = smaller(c.reach.lo, (double)(float)other->spec.znear);
    c.reach.hi = larger(c.reach.hi, hi);
    const double at_near = excess_at(&c, c.reach.lo);
    const double at_far = finite ? excess_at(&c, nearest_far) : 0x1p-51; /* no depth comes as far as infinity */
    c.below = (p->clip_reversed ? at_far : at_near) + c.ends_off;
    c.above = (p->clip_reversed ? at_near : at_far) + c.ends_off;
    c.few_steps = has_few_steps(&c);
    return c;
}

/* ---- A z + B ----------------------------------------------------------------------------------------------------- */

/* Room for the rounding of this file's own sums of two products. */
static const double raised = 1.0 + DP_ROUNDINGS_6;
static const double lowered = 1.0 - DP_ROUNDINGS_6;

/* Magnitudes of a sum before it is rounded; `least` is 0 where its sign changes. */
typedef struct magnitude {
    double most, least;
} magnitude;

static int has_product(const dp_chain *c) {
    return c->a != 0.0 || c->a_more != 0.0;
}

static magnitude magnitude_of(double v1, double v2, double error) {
    const double small = smaller(fabs(v1), fabs(v2)) * lowered - error;
    return (magnitude){.most = larger(fabs(v1), fabs(v2)) * raised + error,
                       .least = (v1 < 0.0) != (v2 < 0.0) ? 0.0 : larger(small, 0.0)};
}

/* The least and the greatest magnitude of the depths of a span. */
static magnitude size_of(dp_span r) {
    const double least = r.lo < 0.0 && r.hi > 0.0 ? 0.0 : smaller(fabs(r.lo), fabs(r.hi));
    return (magnitude){.most = larger(fabs(r.lo), fabs(r.hi)), .least = least};
}

/* The step of a rounding whose results have such magnitudes. */
static dp_step step_of(magnitude m) {
    return (dp_step){.error = dp_half_ulp(m.most), .grid = 2.0 * dp_half_ulp(m.least)};
}

static dp_step scaled(dp_step s, double factor) {
    return (dp_step){s.error * factor, s.grid * factor};
}

/* fl(A z), in clip depth. Orthographic depths may be so small that it is subnormal, whatever A is. */
static dp_step product_of(const dp_chain *c, dp_span r) {
    const magnitude z = size_of(r);
    const magnitude product = {(fabs(c->a) + c->a_more) * z.most, fabs(c->a) * z.least};
    const int subnormal = c->pipeline.ortho && product.least < 0x1p-126;
    if (c->fused || (c->a_exact && !subnormal))
        return (dp_step){0.0, 0.0};
    dp_step s = step_of(product);
    if (subnormal)
        s.error = dp_result_error(product.least, c->a_exact ? smaller(product.most, 0x1p-126) : product.most);
    return s;
}

/* How much larger or smaller the clip depths of a span may be. */
static double clip_more_over(const dp_chain *c, dp_span r) {
    return c->run ? clip_more(c, size_of(r).most) : 0.0;
}

/* Before the sum is rounded; `error` is that of the products. */
static magnitude clip_over(const dp_chain *c, dp_span r, double error) {
    return magnitude_of(clip_of(c, r.lo), clip_of(c, r.hi), error + clip_more_over(c, r));
}

/* A number that all computed products of a span, and with B all sums, are multiples of. */
static double product_granule(const dp_chain *c, dp_span r) {
    const double least = size_of(r).least;
    return c->a_exact ? c->a_granule * 2.0 * dp_half_ulp(least) : 2.0 * dp_half_ulp(fabs(c->a) * least);
}

/*
 * The change that adding B makes where every sum is rounded to a multiple of `ulp` as B is: of both ends of a run's B,
 * or half of it either way, as one of several is nearest. Whether sums are rounded so in each camera, `even`: as
 * products are even multiples; else B may not be in the middle of two.
 */
static int keep(const dp_chain *c, double ulp, int even, double *lo, double *hi) {
    const double last = c->b + (c->b < 0.0 ? -c->b_more : c->b_more);
    const double nearest[2] = {rint(c->b / ulp), rint(last / ulp)};
    const double kept[2] = {nearest[0] * ulp - c->b, nearest[1] * ulp - last};
    const int one = nearest[0] == nearest[1] && fabs(kept[0]) != 0.5 * ulp && fabs(kept[1]) != 0.5 * ulp;
    const double least = one || !c->run ? smaller(kept[0], kept[1]) : -0.5 * ulp;
    const double most = one || !c->run ? larger(kept[0], kept[1]) : 0.5 * ulp;
    *lo = smaller(*lo, c->pipeline.clip_reversed ? least : -most);
    *hi = larger(*hi, c->pipeline.clip_reversed ? most : -least);
    return one || even;
}

/*
 * Adding B. Where all sums have fewer than 25 bits above the granule of their terms it is exact. Where the products are
 * multiples of the sums' last place, every sum is rounded alike: the product stays, and B is rounded to a multiple. In
 * the middle of two it goes to the even one where the products are even multiples; else sums are not rounded alike.
 * Next to a power of two there are two such cases, each with its own last place.
 */
static dp_step add_b(const dp_chain *c, dp_span r, magnitude m, double *lo, double *hi, double *one) {
    *lo = *hi = *one = 0.0;
    if (!has_product(c) || (c->b == 0.0 && !c->fused))
        return (dp_step){0.0, 0.0};
    if (c->fused) {
        *hi = dp_result_error(m.least, m.most);
        *lo = -*hi;
        return (dp_step){*hi, step_of(m).grid};
    }
    const double granule = product_granule(c, r);
    if (m.most < 0x1p24 * smaller(granule, c->b_granule))
        return (dp_step){0.0, 0.0};
    const double ulp[2] = {2.0 * dp_half_ulp(m.least), 2.0 * dp_half_ulp(m.most)};
    int alike = m.least > 0.0 && ulp[1] <= granule && ulp[1] <= 2.0 * ulp[0];
    *lo = HUGE_VAL;
    *hi = -HUGE_VAL;
    for (int i = 0; i < 2 && alike; i++)
        alike = keep(c, ulp[i], granule >= 2.0 * ulp[i], lo, hi);
    *one = alike && ulp[0] == ulp[1] ? ulp[0] : 0.0;
    if (!alike) {
        *hi = dp_half_ulp(m.most);
        *lo = -*hi;
        return step_of(m);
    }
    return (dp_step){0.0, 0.0};
}

/* A number that all computed clip depths of a span are multiples of; 0 when unknown. */
static double clip_granule(const dp_chain *c, dp_span r, magnitude clip) {
    const double common = smaller(product_granule(c, r), c->b_granule);
    const double exact = !has_product(c) ? c->b_granule : clip.most < 0x1p24 * common && !c->fused ? common : 0.0;
    const double least = clip.least - dp_half_ulp(clip.most);
    return larger(exact, least > 0.0 ? 2.0 * dp_half_ulp(least) : 0.0);
}

static double w_granule(const dp_chain *c, dp_span r) {
    return c->pipeline.ortho ? 1.0 : 2.0 * dp_half_ulp(r.lo);
}

/* The shader's clip + w: exact where both are multiples of a granule and the sum has fewer than 25 bits above it. */
static dp_step add_w(const dp_chain *c, dp_span r, magnitude clip, double error) {
    const magnitude m = magnitude_of(clip_of(c, r.lo) + w_of(c, r.lo), clip_of(c, r.hi) + w_of(c, r.hi),
                                     error + clip_more_over(c, r) + dp_half_ulp(clip.most));
    const double granule = smaller(clip_granule(c, r, clip), w_granule(c, r));
    return m.most < 0x1p24 * granule ? (dp_step){0.0, 0.0} : step_of(m);
}

/* How much larger or smaller the quotients of a span may be in a run of cameras. */
static double ndc_more(const dp_chain *c, dp_span r) {
    return clip_more_over(c, r) / w_of(c, r.lo);
}

/* ---- All operations ---------------------------------------------------------------------------------------------- */

/* 0.5 ndc + 0.5: exact where all terms are multiples of the sum's last place. `error` is that of ndc. */
static dp_step viewport_of(double ndc1, double ndc2, double error) {
    const double top = smaller(0.5 + 0.5 * (larger(ndc1, ndc2) + error), 1.0 - DP_UNIT_BELOW_ONE);
    const double bottom = 0.5 + 0.5 * (smaller(ndc1, ndc2) - error);
    const double nearest = (ndc1 < 0.0) != (ndc2 < 0.0) ? 0.0 : smaller(fabs(ndc1), fabs(ndc2)) - error;
    if (nearest > 0.0 && top < 0x1p24 * dp_half_ulp(nearest))
        return (dp_step){0.0, 0.0};
    return step_of((magnitude){larger(top, 0.0), larger(bottom, 0.0)});
}

/* The viewport of a range: a product and a sum, which hardware may fuse; neither of values beyond the clamp at 1. */
static dp_step ranged_viewport_of(const dp_chain *c, double ndc1, double ndc2, double error) {
    const double scale = (double)c->pipeline.scale, offset = (double)c->pipeline.offset;
    const magnitude ndc = magnitude_of(ndc1, ndc2, error);
    const double least = c->per_ndc * ndc.least;
    const int power = c->per_ndc == dp_power2(dp_exponent(c->per_ndc));
    const double product = !power ? dp_result_error(least, c->per_ndc * ndc.most) : least < 0x1p-126 ? 0x1p-126 : 0.0;
    if (offset == 0.0)
        return (dp_step){product, 2.0 * dp_half_ulp(larger(least - product, 0.0))};
    const magnitude sum = magnitude_of(scale * ndc1 + offset, scale * ndc2 + offset, c->per_ndc * error + product);
    dp_step s = step_of((magnitude){smaller(sum.most, 1.0 - DP_UNIT_BELOW_ONE), sum.least});
    s.error += product;
    return s;
}

/* The divide, or the product with the reciprocal. `error` is that of the quotient's numerator over w. */
static void divide(const dp_chain *c, dp_span r, double q1, double q2, double error, dp_steps *s) {
    const magnitude q = magnitude_of(q1, q2, error);
    if (c->pipeline.arith->reciprocal) {
        s->inverse = step_of((magnitude){1.0 / r.lo * raised, 1.0 / r.hi * lowered});
        const dp_reciprocal_error most = dp_reciprocal_error_of(c->pipeline.arith->reciprocal);
        const int normal = r.hi < 0x1p125;
        /* of w as large as it may be; or relative, of 1/w */
        const double by = larger(most.half_ulps * s->inverse.error, normal ? 0.0 : most.subnormal);
        s->inverse.error = q.most * (normal ? smaller(r.hi * by, most.units * DP_UNIT) : r.hi * by);
        s->inverse_off = normal ? smaller(by, most.units * DP_UNIT / r.lo * raised) : by;
    }
    /* Quotients above 1 are clamped, and demand.c counts that; the rest have the last place of 1 at most. Not so before
     * a viewport that takes them into [0, 1]. */
    const magnitude result = {c->ranged ? q.most + s->inverse.error
                                        : smaller(q.most + s->inverse.error, 1.0 - DP_UNIT_BELOW_ONE),
                              larger(q.least - s->inverse.error, 0.0)};
    s->quotient = step_of(result);
    s->quotient.error = dp_result_error(result.least, result.most);
}

/* A z + B of the depths of a span, in clip depth. */
typedef struct clip_steps {
    dp_step product, sum;
    magnitude before; /* before the sum is rounded */
    double kept_lo, kept_hi, kept_one;
} clip_steps;

static clip_steps clip_steps_of(const dp_chain *c, dp_span r) {
    clip_steps s = {.product = product_of(c, r)};
    s.before = clip_over(c, r, s.product.error);
    s.sum = add_b(c, r, s.before, &s.kept_lo, &s.kept_hi, &s.kept_one);
    if (c->decisions != NULL) {
        const double made[] = {s.product.error,
                               s.product.grid,
                               s.sum.error,
                               s.sum.grid,
                               s.kept_lo,
                               s.kept_hi,
                               s.kept_one,
                               dp_half_ulp(s.before.most),
                               dp_half_ulp(s.before.least),
                               clip_of(c, r.lo) < 0.0,
                               clip_of(c, r.hi) < 0.0};
        for (size_t i = 0; i < sizeof made / sizeof made[0]; i++)
            dp_decided(c, made[i]);
    }
    return s;
}

static dp_steps steps_of(const dp_chain *c, dp_span r, const clip_steps *clip) {
    const double w = w_of(c, r.lo);
    dp_steps s = {.product = clip->product,
                  .sum = clip->sum,
                  .kept_lo = clip->kept_lo,
                  .kept_hi = clip->kept_hi,
                  .kept_one = clip->kept_one};
    double error = s.product.error + larger(s.kept_hi, -s.kept_lo);
    if (c->remap)
        s.remap = add_w(c, r, clip->before, s.product.error);
    error += s.remap.error;
    const double off = c->per_clip * error / w; /* of NDC */
    const double unknown = off + (c->run ? c->per_clip * ndc_more(c, r) : 0.0);
    const double q1 = dividend(c, r.lo) / w;
    const double q2 = dividend(c, r.hi) / w_of(c, r.hi);
    if (!c->pipeline.ortho)
        divide(c, r, q1, q2, unknown, &s);
    if (c->two_stage)
        s.viewport = c->ranged ? ranged_viewport_of(c, q1, q2, unknown + s.inverse.error + s.quotient.error)
                               : viewport_of(q1, q2, unknown + s.inverse.error + s.quotient.error);
    dp_decided(c, s.quotient.error), dp_decided(c, s.quotient.grid);
    dp_decided(c, s.viewport.error), dp_decided(c, s.viewport.grid);
    const double per = c->per_ndc * c->per_clip / w;
    s.product = scaled(s.product, per);
    s.sum = scaled(s.sum, per);
    s.remap = scaled(s.remap, per);
    s.inverse.error *= c->per_ndc;
    s.quotient = scaled(s.quotient, c->per_ndc);
    s.full = c->per_ndc * off + s.inverse.error + s.quotient.error + s.viewport.error;
    return s;
}

/* Errors relative to values over w: those run evenly to the far plane, so they are greatest at one of the two ends. */
dp_steps dp_chain_steps_beyond(const dp_chain *c, double z) {
    const double zfar = c->reach.hi;
    const double w1 = w_of(c, z);
    const double w2 = w_of(c, zfar);
    const double up = 1.0 + DP_ROUNDINGS32_14;
    const double more = c->run ? larger(clip_more(c, z) / w1, clip_more(c, zfar) / w2) : 0.0;
    const double g = up * (larger(fabs(clip_of(c, z)) / w1, fabs(clip_of(c, zfar)) / w2) + more);
    const double q = up * (larger(fabs(dividend(c, z)) / w1, fabs(dividend(c, zfar)) / w2) + more);
    const int rounded = !c->a_exact && !c->fused;
    const double flushed = c->pipeline.ortho && c->reach.lo <= 0.0 ? 0x1p-126 : 0.0;
    double clip =
        rounded ? DP_UNIT * (fabs(c->a) + c->a_more) * (c->pipeline.ortho ? larger(fabs(z), fabs(zfar)) : 1.0) : 0.0;
    clip = larger(clip, flushed);
    clip += has_product(c) ? larger(DP_UNIT * (g + clip), flushed) : 0.0;
    if (c->remap)
        clip = 0.5 * clip + DP_UNIT * (q + clip);
    double ndc = 0.0;
    if (!c->pipeline.ortho) {
        const dp_reciprocal_error most = dp_reciprocal_error_of(c->pipeline.arith->reciprocal);
        const double subnormal = zfar > 0x1p126 ? (fabs(dividend(c, zfar)) + more * w2) * most.subnormal : 0.0;
        const double inverse = most.units * DP_UNIT * (q + clip) + subnormal;
        ndc = inverse +
              dp_half_ulp(c->ranged ? q + clip + inverse : smaller(q + clip + inverse, 1.0 - DP_UNIT_BELOW_ONE));
    }
    const double product = c->ranged ? dp_half_ulp(c->per_ndc * (q + clip + ndc)) : 0.0;
    dp_decided(c, ndc), dp_decided(c, fabs(clip_of(c, z)) / w1 > fabs(clip_of(c, zfar)) / w2);
    dp_steps s = {.product = {c->per_ndc * clip, 0.0},
                  .quotient = {c->per_ndc * ndc + product + (c->two_stage ? DP_UNIT_BELOW_ONE : 0.0), 0.0}};
    s.full = s.product.error + s.quotient.error;
    return s;
}

/* ---- The numerator ----------------------------------------------------------------------------------------------- */

/*
 * How much less than z the product may grow, all in one binade of z. |A| >= 1, so each step u of z moves the real
 * product by u or more. If the products' last place is no more than that, they move by u at least. Otherwise, where the
 * product is in a binade above z's, it is so for every ulp/u-th step, and between those it does not fall.
 */
static double product_lag(const dp_chain *c, double hi) {
    if (c->a_exact || c->fused)
        return 0.0;
    const double u = 2.0 * dp_half_ulp(hi);
    const double ulp = 2.0 * dp_half_ulp((fabs(c->a) + c->a_more) * hi);
    return ulp <= fabs(c->a) * u ? 0.0 : ulp - u;
}

/* The most that adding B may take from the growth of the clip depth: the sums round alike, or, fused, there is no
 * product. */
static double sum_lag(const dp_chain *c, dp_span r, magnitude clip, double kept) {
    const double most = dp_half_ulp(clip.most);
    const double least = dp_half_ulp(clip.least);
    if (!c->fused || c->run || clip.least <= 0.0 || most > 2.0 * least)
        return kept;
    return most == least && most <= dp_half_ulp(r.lo) ? 0.0 : most + least;
}

/* Whether t is the clip depth itself, and A <= 0. */
static int is_plain(const dp_chain *c) {
    return c->pipeline.clip_reversed && !c->pipeline.ndc_signed;
}

/* The least t of a span, as computed: that of its farthest depth, less what it may have lost. */
static double least_of(const dp_chain *c, dp_span r, const clip_steps *clip) {
    const double of_clip = clip_granule(c, r, clip->before);
    const double granule = is_plain(c) ? of_clip : smaller(of_clip, w_granule(c, r));
    const double least = dp_on_lattice(
        dp_numerator_least(c, r.hi, clip_of(c, r.hi), clip->kept_lo, clip->product.error, clip_more_over(c, r)),
        granule);
    if (c->decisions != NULL) {
        c->decisions->kept_lo = clip->kept_lo;
        c->decisions->product = clip->product.error;
        c->decisions->granule = dp_decided(c, granule);
    }
    return c->remap ? larger(least - add_w(c, r, clip->before, clip->product.error).error, 0.0) : least;
}

/* How much greater a farther depth's t may be in a span. */
static double rise_of(const dp_chain *c, dp_span r, const clip_steps *clip) {
    if (is_plain(c))
        return 0.0;
    const int binades = dp_exponent(r.hi) - dp_exponent(r.lo);
    if (binades > 1)
        return HUGE_VAL;
    double rise =
        product_lag(c, r.hi) + sum_lag(c, r, clip->before, clip->kept_one > 0.0 ? 0.0 : clip->kept_hi - clip->kept_lo);
    if (binades == 1)
        rise += product_lag(c, dp_power2(dp_exponent(r.hi)) * (1.0 - DP_UNIT));
    if (!c->remap || (rise == 0.0 && c->pipeline.clip_reversed)) /* t itself keeps falling */
        return rise;
    return rise + 2.0 * add_w(c, r, clip->before, clip->product.error).error;
}

dp_steps dp_chain_steps(const dp_chain *c, dp_span r) {
    const clip_steps clip = clip_steps_of(c, r);
    dp_steps s = steps_of(c, r, &clip);
    s.numerator = c->pipeline.ortho ? 0.0 : least_of(c, r, &clip);
    return s;
}

/* B is raised by what adding it changes and by products that were rounded towards near. */
static void falls(const dp_chain *c, dp_span r, const clip_steps *clip, dp_numerator *n) {
    const double a = c->pipeline.clip_reversed ? c->a : -c->a;
    const double b = c->pipeline.clip_reversed ? c->b : -c->b;
    n->fall = -1.0 - a;
    n->granule = smaller(clip_granule(c, r, clip->before), w_granule(c, r));
    n->most = b + clip->kept_hi + clip->product.error + clip_more_over(c, r) + (b + n->fall * r.hi) * 0x1p-50;
    n->off = c->remap ? add_w(c, r, clip->before, clip->product.error).error : 0.0;
}

dp_steps dp_chain_steps_behind(const dp_chain *c, double from, dp_span r, dp_numerator *numerator) {
    clip_steps clip = clip_steps_of(c, r);
    const dp_steps s = steps_of(c, r, &clip);
    const dp_span range = {from, r.hi};
    if (c->pipeline.ortho)
        return s;
    if (c->few_steps)
        falls(c, r, &clip, numerator);
    if (from != r.lo)
        clip = clip_steps_of(c, range);
    numerator->rise = dp_decided(c, rise_of(c, range, &clip));
    return s;
}
