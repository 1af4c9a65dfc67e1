/* SPDX-License-Identifier: MIT */
#include "core/demand.h"

#include "core/extremes.h"
#include "core/rounding.h"

/* ---- The format -------------------------------------------------------------------------------------------------- */

/*
 * Whether every binary32 window depth of [low, high] has a code of its own in a UNORM, or every multiple of `grid` if
 * that is no finer than binary32 there. So it is where a step of the window depth is more than one code. Where it is at
 * most one, codes rise by 0 or 1 a step: then they all rise if they do in total.
 */
static int codes_are_distinct(const dp_pipeline *p, double low, double high, double grid) {
    const double levels = (double)p->format.code_max;
    const int sixteenths = p->arith->conversion == DP_CONVERT_SIXTEENTHS;
    const int product_exact = p->arith->conversion == DP_CONVERT_EXACT || (p->format.bits > 24 && !sixteenths);
    const int coarse = product_exact && grid >= 2.0 * dp_half_ulp(smaller(high, 1.0));
    if (low <= 0.0 && !coarse)
        return 0;
    float first = nextafterf((float)low, 0.0F);
    float last = (float)high < 1.0F ? nextafterf((float)high, 2.0F) : 1.0F;
    if (coarse) {
        first = (float)(ceil(larger(low - 0x1p-50, 0.0) / grid) * grid);
        last = (float)(floor(smaller(high + 0x1p-50, 1.0) / grid) * grid);
    }
    const double step = coarse ? grid : 2.0 * dp_half_ulp((double)first);
    if (step * levels > 1.0 || (coarse && last <= first))
        return product_exact;
    if (!coarse && dp_half_ulp((double)first) != dp_half_ulp((double)nextafterf(last, 0.0F)))
        return 0;
    if (p->arith->conversion != DP_CONVERT_EXACT && !coarse && dp_half_ulp((double)first * levels) < 0.5)
        return 0;
    const double codes = (double)dp_pipeline_convert(p, last) - (double)dp_pipeline_convert(p, first);
    return codes == ((double)last - (double)first) / step;
}

/* Clamped, no window depth is 1, nor is one below 0. */
double dp_format_loss(const dp_pipeline *p, double low, double high, double grid) {
    const dp_format *format = &p->format;
    const double top = smaller(larger(high, 0.0), 1.0 - DP_UNIT_BELOW_ONE);
    const double bottom = smaller(larger(low, 0.0), top);
    if (format->kind == DP_FORMAT_FLOAT) {
        /* With 23 bits as fine as binary32, but for subnormals that begin above those of binary32. */
        const int fine = format->mantissa_bits >= 23;
        const double step = dp_step_num(format, fine ? 1 - format->bias : dp_binade(format, top));
        const int finest = fine && (bottom >= dp_power2(1 - format->bias) || step <= 2.0 * dp_half_ulp(bottom));
        return finest || step <= grid ? 0.0 : step;
    }
    if (codes_are_distinct(p, low, high, grid))
        return 0.0;
    const double levels = (double)format->code_max;
    if (p->arith->conversion == DP_CONVERT_SIXTEENTHS)
        return (format->bits <= 16 || (low < 1.0 / 16.0 && high >= 1.0 / 16.0) ? 17.0 / 16.0 : 1.0) / levels;
    if (p->arith->conversion == DP_CONVERT_EXACT || format->bits > 24)
        return 1.0 / levels;
    /* The product is rounded to binary32, then to a whole number, which changes nothing where it is one. */
    const double ulp = 2.0 * dp_half_ulp(top * levels);
    const int whole = 2.0 * dp_half_ulp(bottom * levels) >= 1.0; /* every product is */
    return (whole ? ulp : larger(1.0 + smaller(ulp, 0.5), ulp)) / levels;
}

double dp_stored_error(const dp_pipeline *p, double high) {
    const dp_format *format = &p->format;
    const double share = p->rounding == DP_ROUND_ZERO || p->arith->conversion == DP_CONVERT_PRODUCT_ZERO ? 1.0 : 0.5;
    const double top = smaller(larger(high, 0.0), 1.0 - DP_UNIT_BELOW_ONE);
    if (format->kind == DP_FORMAT_FLOAT && format->mantissa_bits < 23)
        return dp_step_num(format, dp_binade(format, top)) * (p->rounding == DP_ROUND_ZERO ? 1.0 : 0.5);
    if (format->kind == DP_FORMAT_FLOAT)
        return share * dp_step_num(format, 1 - format->bias); /* of subnormals */
    const double levels = (double)format->code_max;
    if (p->arith->conversion == DP_CONVERT_SIXTEENTHS)
        return (0.5 + (format->bits <= 16 ? 1.0 / 16.0 : smaller(top, 1.0 / 16.0))) / levels;
    /* Where half a unit of the product is 1/2 it is whole; above 24 bits the factor is off by 1, which is a level. */
    const double product = p->arith->conversion == DP_CONVERT_EXACT ? 0.0
                           : format->bits > 24                      ? 1.0
                                                                    : smaller(dp_half_ulp(top * levels), 0.25);
    return (share + product) / levels;
}

/* ---- A pair ------------------------------------------------------------------------------------------------------ */

/* The more demanding of two: window depth over slope decides. */
static void keep_larger(dp_demand *d, double window, double slope) {
    if (window * d->slope > d->window * slope) {
        d->window = window;
        d->slope = slope;
    }
}

/* Window depths of the ends of a span, and by how much more they may be in a run of cameras. */
typedef struct windows {
    double near, far, near_more, far_more;
} windows;

static windows windows_of(const dp_chain *c, double near, double far) {
    return (windows){dp_chain_window(c, near), dp_chain_window(c, far), dp_chain_window_more(c, near),
                     dp_chain_window_more(c, far)};
}

/*
 * Where the window depth of one of the two leaves its range it is clamped, and its own errors count no more: the other
 * one's do, all of them, and how far g itself goes beyond.
 */
static int clamp_nearer(const dp_chain *c, dp_demand *d, double full2, const windows *at, double off1) {
    const double off = off1 + at->near_more;
    const int clamped = c->pipeline.reversed ? at->near + off >= c->ends[0] : at->near - off <= c->ends[0];
    if (clamped && c->decisions != NULL)
        c->decisions->unknown = 1;
    if (clamped)
        keep_larger(d, (c->pipeline.clip_reversed ? c->above : c->below) + full2 + d->rest,
                    fabs(c->pipeline.ortho ? c->a : c->b));
    return clamped;
}

static void clamp_farther(const dp_chain *c, dp_demand *d, double full1, const windows *at, double off2) {
    const double off = off2 + at->far_more;
    const double before = d->window;
    const int clamped = c->pipeline.reversed ? at->far - off <= c->ends[1] : at->far + off >= c->ends[1];
    if (clamped)
        keep_larger(d, (c->pipeline.clip_reversed ? c->below : c->above) + full1 + d->rest,
                    fabs(c->pipeline.ortho ? c->a : c->b));
    dp_decided(c, clamped), dp_decided(c, d->window != before);
}

/*
 * The difference from which on the roundings of two numbers differ by more than `rest`. All roundings lie on the finer
 * of two lattices, so they differ by more than `rest` once they differ by more than the whole steps in it.
 */
static double before_rounding(dp_step s1, dp_step s2, double rest) {
    const double errors = s1.error + s2.error;
    const double grid = smaller(s1.grid, s2.grid);
    return errors == 0.0 || grid == 0.0 ? rest + errors
                                        : smaller(rest, floor(rest / grid * DP_OUTWARD) * grid) + errors;
}

/*
 * The loss where each camera of a run rounds its sums alike, though not all cameras do: nothing where every sum has one
 * last place, else the difference of two roundings of one B.
 */
static double run_loss(const dp_steps *s1, const dp_steps *s2, double loss) {
    if (s1->sum.error == 0.0 || s2->sum.error == 0.0)
        return loss;
    const int one = s1->sum.error == s2->sum.error && s1->sum.grid == s2->sum.grid;
    return one && s1->sum.grid == 2.0 * s1->sum.error ? 0.0 : larger(s1->sum.error, s2->sum.error);
}

/* A demand where numerator or product is followed: what the other operations take, and the slope. */
static dp_demand demand_free(const dp_chain *c, const dp_steps *s1, const dp_steps *s2, double w, double need) {
    const int one = s1->kept_one > 0.0 && s1->kept_one == s2->kept_one;
    const double loss = one ? 0.0 : larger(s2->kept_hi - s1->kept_lo, 0.0) * c->per_ndc * c->per_clip / w;
    if (c->pipeline.ortho) {
        const int alike = s1->sum.error == 0.0 && s2->sum.error == 0.0;
        const double clip = before_rounding(s1->remap, s2->remap, need);
        const double rounded = alike ? clip + loss : before_rounding(s1->sum, s2->sum, clip);
        const double sum = c->run ? larger(rounded, clip + run_loss(s1, s2, loss)) : rounded;
        const double window = before_rounding(s1->product, s2->product, sum);
        return (dp_demand){.projection = window - need, .window = window, .slope = fabs(c->a)};
    }
    const double projection = s1->product.error + s2->product.error + s1->remap.error + s2->remap.error + loss;
    return (dp_demand){.projection = projection,
                       .window = need + projection,
                       .slope = larger(fabs(c->b) + smaller(s2->kept_lo, 0.0), 0.0)};
}

/*
 * The numerator hardly rises: the distance of two quotients is at least t (1/z1 - 1/z2) with the nearer one's t,
 * whether the farther one is clamped or not. Where t itself is multiplied with fl(1/w), the lattice of the reciprocals
 * counts, t times as wide; or their errors do.
 */
static dp_demand demand_falling(const dp_chain *c, double nearest, double rise, const dp_steps *s1, const dp_steps *s2,
                                double quotient) {
    const double t = s1->numerator;
    if (!(t > 0.0) || isinf(rise))
        return (dp_demand){.window = 1.0, .slope = 0.0};
    const int multiplied = c->pipeline.clip_reversed && !c->two_stage && !c->run;
    const double projection = c->half * rise / nearest * (1.0 + DP_UNIT);
    const double rest = quotient + projection;
    const double factor = c->half * t;
    double window = rest + s1->inverse.error + s2->inverse.error;
    if (multiplied && s1->inverse_off > 0.0)
        window = smaller(window, before_rounding((dp_step){factor * s1->inverse_off, factor * s1->inverse.grid},
                                                 (dp_step){factor * s2->inverse_off, factor * s2->inverse.grid}, rest));
    return (dp_demand){.projection = projection, .window = window, .slope = t};
}

/*
 * The farthest depth of a span whose numerator over w may still be `least`: it falls by steps of its lattice, so that
 * is where one of them ends, or on the way to that. INFINITY: nothing is known.
 */
static double until_steps(const dp_numerator *n, dp_span span, double least) {
    if (n->fall < 0.0 || !(least > 0.0))
        return HUGE_VAL;
    const double x = smaller((n->most + n->off) / (least + n->fall), span.hi);
    const double most = n->most - n->fall * x;
    if (!(fabs(most) < 0x1p50 * n->granule))
        return x < span.hi ? x : HUGE_VAL;
    const double t = floor(most / n->granule) * n->granule;
    const double before = n->fall > 0.0 ? (n->most - (t + n->granule)) / n->fall : 0.0; /* the end of the step before */
    const double end = smaller(x, larger((t + n->off) / least, before));
    return end < span.hi ? end : HUGE_VAL;
}

/* The format's loss between two depths of a span. Where the viewport is exact, it meets only NDC's own lattice. */
static double format_of(const dp_chain *c, const windows *w, const dp_steps *s1, const dp_steps *s2) {
    const double error = larger(s1->full, s2->full) + larger(w->near_more, w->far_more);
    const int exact = c->two_stage && s1->viewport.error == 0.0 && s2->viewport.error == 0.0;
    return dp_decided(c, dp_format_loss(&c->pipeline, smaller(w->near, w->far) - error, larger(w->near, w->far) + error,
                                        exact ? smaller(s1->quotient.grid, s2->quotient.grid) : 0.0));
}

/* The distance behind z, as a share of both, at which the window depth has moved by what is demanded. */
static double share_of(const dp_chain *c, double z, double window, double slope) {
    return window * z / (c->half * slope) * DP_OUTWARD;
}

static void keep_least(const dp_chain *c, double *least, double share) {
    if (dp_decided(c, share < *least) != 0.0)
        *least = share;
}

/* The demand of a depth of `first` and one of `second`, not nearer. */
static dp_demand demand_of(const dp_chain *c, const dp_steps *s1, dp_span first, dp_span second, double extra) {
    dp_numerator t = {.rise = HUGE_VAL, .fall = -1.0};
    const dp_steps s2 = dp_chain_steps_behind(c, first.lo, second, &t);
    const windows at = windows_of(c, first.lo, second.hi);
    const double format = format_of(c, &at, s1, &s2);
    const double rest = format + extra;
    const double window = before_rounding(s1->viewport, s2.viewport, rest);
    const double quotient = before_rounding(s1->quotient, s2.quotient, window);
    const double need = quotient + s1->inverse.error + s2.inverse.error;
    const double w = c->pipeline.ortho ? 1.0 : first.lo;
    dp_demand d = demand_free(c, s1, &s2, w, need);
    d.rest = rest;
    clamp_farther(c, &d, s1->full, &at, s2.full);
    const dp_demand falling = demand_falling(c, first.lo, t.rise, s1, &s2, quotient);
    if (c->decisions != NULL) {
        dp_decided(c, falling.slope > 0.0), dp_decided(c, dp_half_ulp(second.hi));
        keep_least(c, &c->decisions->linear, share_of(c, first.lo, d.window, d.slope));
        keep_least(c, &c->decisions->falling,
                   falling.slope > 0.0 ? share_of(c, first.lo, falling.window, 1.0) : HUGE_VAL);
    }
    if (falling.window * d.slope < d.window * falling.slope)
        d = falling;
    d.until = until_steps(&t, second, s1->numerator / first.hi * (1.0 - DP_ROUNDINGS_6) - need / c->half);
    d.format = format;
    d.rest = rest;
    if (clamp_nearer(c, &d, s2.full, &at, s1->full))
        d.until = HUGE_VAL;
    return d;
}

/* The demand of a depth of `first` and any depth behind it. */
static dp_demand demand_beyond(const dp_chain *c, const dp_steps *s1, dp_span first, double extra) {
    const dp_steps s2 = dp_chain_steps_beyond(c, first.lo);
    const windows at = windows_of(c, first.lo, c->reach.hi);
    const double format = format_of(c, &at, s1, &s2);
    dp_demand d = {.projection =
                       s1->full - s1->inverse.error - s1->quotient.error - s1->viewport.error + s2.product.error,
                   .format = format,
                   .rest = format + extra,
                   .window = s1->full + s2.full + format + extra,
                   .slope = fabs(c->pipeline.ortho ? c->a : c->b)};
    clamp_farther(c, &d, s1->full, &at, s2.full);
    clamp_nearer(c, &d, s2.full, &at, s1->full);
    return d;
}

/* ---- The distance ------------------------------------------------------------------------------------------------ */

/* The distance behind z at which the window depth has moved by what is demanded. */
static double distance(const dp_chain *c, double z, const dp_demand *d) {
    if (c->pipeline.ortho)
        return d->window / (c->half * d->slope) * DP_OUTWARD;
    const double x = share_of(c, z, d->window, d->slope);
    return x < 1.0 ? z * x / (1.0 - x) * DP_OUTWARD : HUGE_VAL;
}

/*
 * How far a depth of `second` may be from one of `first` and out of order. What lies beyond that is in order, so only
 * the depths up to there need a demand of their own, which is smaller; and so on, as often for a single depth as for a
 * run of them: so the distance of the run is never the shorter one.
 */
enum { REFINED = 3 };
static double longest_within(const dp_chain *c, const dp_steps *s1, dp_span first, dp_span second, double extra,
                             dp_demand *out, double *until) {
    double best = HUGE_VAL, last = HUGE_VAL;
    if (c->decisions != NULL)
        c->decisions->linear = c->decisions->falling = HUGE_VAL;
    for (int i = 0; i < REFINED; i++) {
        const dp_demand d = demand_of(c, s1, first, second, extra);
        const double s = distance(c, first.hi, &d);
        if (i == 0 || s < best) { /* the first one counts even where it is infinite: *out is what it demands */
            best = s;
            *out = d;
        }
        last = smaller(last, d.until);
        *until = smaller(last, first.hi + best);
        dp_decided(c, (*until >= second.hi) + 2 * (*until < second.lo));
        if (*until >= second.hi || *until < second.lo)
            break;
        if (i > 0 && c->run) /* a camera of the run may end here, where it gains little */
            break;
        second.hi = *until;
    }
    return isinf(last) ? best : smaller(best, larger(last - first.lo, 0.0));
}

/* The first depth of a binade of z, from `lo` on, whose product lies in the same binade as that of `hi`; |A| >= 1. */
static double products_begin(const dp_chain *c, double lo, double hi) {
    const double a = fabs(c->a), z = 2.0 * dp_power2(dp_exponent(hi)) / a;
    const double begin = (double)((double)(float)z < z ? nextafterf((float)z, HUGE_VALF) : (float)z);
    return begin < hi ? larger(lo, begin) : lo;
}

/* Where the binade ends whose farthest depth is `hi`, towards near; depths within `tiny` of 0 count as one binade. */
static double binade_begin(double hi, double tiny) {
    if (hi <= -tiny)
        return -2.0 * dp_power2(dp_exponent(-hi));
    if (hi <= tiny)
        return -tiny;
    const double power = dp_power2(dp_exponent(hi));
    return larger(power < hi ? power : 0.5 * power, tiny);
}

/*
 * Beyond 2^126 the reciprocal of w is subnormal: hardware that makes 0 of it tells nothing apart there.
 *
 * First a distance that holds against every depth behind. Then, from there back to `first`, binade by binade of z: the
 * farthest binade that may hold a depth out of order has the answer. Of a run of depths a nearer binade may have a
 * longer distance, from another depth of the run: there it is the longest of all.
 */
double dp_demand_longest(const dp_chain *c, dp_span first, double extra, dp_demand *out) {
    const dp_steps s1 = dp_chain_steps(c, first);
    *out = demand_beyond(c, &s1, first, extra);
    if (c->pipeline.arith->reciprocal && !c->pipeline.ortho && first.hi > 0x1p126)
        return HUGE_VAL;
    const double any = distance(c, first.hi, out);
    double hi = smaller(first.hi + any, c->reach.hi);
    const double linear_any = share_of(c, first.lo, out->window, out->slope);
    dp_decided(c, hi == c->reach.hi), dp_decided(c, hi <= first.lo);
    if (c->decisions != NULL)
        c->decisions->unknown |= !(hi <= DP_SENSITIVE * fabs(c->b));
    if (hi <= first.lo)
        hi = first.hi;
    const double tiny = first.lo > 0.0 ? 0.0 : larger(0x1p-24 * larger(-first.lo, fabs(hi)), 0x1p-126);
    double longest = 0.0;
    for (double end = HUGE_VAL;; end = hi) {
        double lo = binade_begin(hi, tiny);
        if (c->few_steps && !c->run)
            lo = products_begin(c, lo, hi);
        if (lo < first.hi)
            lo = first.lo;
        dp_decided(c, lo == first.lo ? 0.0 : lo);
        dp_demand d;
        double until;
        const double s = longest_within(c, &s1, first, (dp_span){lo, larger(hi, first.hi)}, extra, &d, &until);
        const int met = until >= lo;
        const double here = met ? smaller(s, end - first.lo) : 0.0;
        if (met && here >= longest && here < any)
            *out = d;
        longest = larger(longest, here);
        if (met && (first.lo == first.hi || lo <= first.lo)) {
            if (c->decisions != NULL) {
                c->decisions->end = end;
                keep_least(c, &c->decisions->linear, linear_any);
            }
            return smaller(longest, any);
        }
        hi = c->few_steps ? (double)nextafterf((float)lo, 0.0F) : lo;
    }
}
