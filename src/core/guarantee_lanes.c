/* SPDX-License-Identifier: MIT */
/*
 * dp_guarantee_at() of many depths: the operations of chain.c, demand.c and budget.c in their order, as choices without
 * jumps, so that loops over them become vectors and give the same bits. They are of what most cameras are: a
 * perspective in the arithmetic ieee, facing, far not so far that single steps of the numerator count. What is
 * otherwise, and the few depths that take longer, dp_guarantee_at() does.
 */
#include "core/clones.h"
#include "core/demand.h"
#include "core/engine.h"
#include "core/extremes.h"
#include "core/guarantee.h"
#include "core/lanes.h"
#include "core/rounding.h"

#ifdef DP_LANES

enum { LANES = 128, ROUNDS = 8, REFINED = 3 };

/* Far from where anything is subnormal or overflows. */
static const double least_z = 0x1p-90, most_z = 0x1p90;

/*
 * What is the same at every depth. Choices are numbers, factors of 0, 1 or -1 and addends of 0 or infinity: a choice
 * by what is the same everywhere would be a jump, or a loop for each.
 */
typedef struct same {
    double a, b, size_a, size_b, b_granule, half, per_ndc, near_end, far_end, ends[2], far;
    double rounds, no_product, exact_below; /* A z is rounded; infinity where there is no A z; sums below are exact */
    double moved, ndc_scale, ndc_offset;    /* there is a viewport; of NDC */
    double clip_sense, sense, z_share, clip_share, plain, binades; /* of the numerator t, see rise_of() */
    double levels, per_level, nearest, least_normal, step_scale, fine, fine_from, fine_step; /* of the format */
    double window_from, window_slope, window_scale, step, ahead, kappa,
        lattice_scale; /* as dp_lattice_above() has it */
} same;

/* The depths of a block: what is known of the nearer one, and of how far another may be behind it and out of order. */
typedef struct block {
    double z[LANES], product[LANES], kept_lo[LANES], kept_one[LANES], quotient[LANES], quotient_grid[LANES];
    double viewport[LANES], viewport_grid[LANES], full[LANES], numerator[LANES];
    double window[LANES], any[LANES], lo[LANES], hi[LANES], end[LANES], best[LANES], round[LANES], longest[LANES];
} block;

typedef struct pair_of {
    double most, least;
} pair_of;

DP_INLINE pair_of magnitude(double v1, double v2, double error) {
    const double small = smaller(size(v1), size(v2)) * (1.0 - DP_ROUNDINGS_6) - error;
    const double large = larger(size(v1), size(v2)) * (1.0 + DP_ROUNDINGS_6) + error;
    return (pair_of){large, where(are_alike(v1, v2), larger(small, 0.0))};
}

/* A z + B of a span, before it is over w. */
typedef struct clip_of {
    double v1, v2, product, granule; /* at both ends; the error of the product, its lattice */
    double kept_lo, kept_hi, kept_one;
    pair_of before;
} clip_of;

DP_INLINE clip_of clip_over(const same *c, double lo, double hi) {
    clip_of s = {.v1 = c->a * lo + c->b, .v2 = c->a * hi + c->b};
    s.product = c->rounds * half_ulp_of(c->size_a * hi);
    s.granule = 2.0 * half_ulp_of(c->size_a * lo) + c->no_product;
    s.before = magnitude(s.v1, s.v2, s.product);
    const choice exact = is_less(s.before.most, c->exact_below * smaller(s.granule, c->b_granule));
    const double ulp0 = 2.0 * half_ulp(s.before.least), ulp1 = 2.0 * half_ulp_of(s.before.most);
    const double kept0 = rint(c->b * inverse(ulp0)) * ulp0 - c->b, kept1 = rint(c->b * inverse(ulp1)) * ulp1 - c->b;
    const choice one0 = ~is_same(size(kept0), 0.5 * ulp0) | is_at_most(2.0 * ulp0, s.granule);
    const choice one1 = ~is_same(size(kept1), 0.5 * ulp1) | is_at_most(2.0 * ulp1, s.granule);
    const choice alike =
        is_less(0.0, s.before.least) & is_at_most(ulp1, s.granule) & is_at_most(ulp1, 2.0 * ulp0) & one0 & one1;
    const double error = half_ulp_of(s.before.most), towards0 = c->clip_sense * kept0, towards1 = c->clip_sense * kept1;
    s.kept_lo = where(~exact, choose(alike, smaller(towards0, towards1), -error));
    s.kept_hi = where(~exact, choose(alike, larger(towards0, towards1), error));
    s.kept_one = where(~exact & alike & is_same(ulp0, ulp1), ulp0);
    return s;
}

typedef struct steps {
    double product, quotient, quotient_grid, viewport, viewport_grid, full;
} steps;

DP_INLINE void viewport_of(const same *c, double q1, double q2, double error, steps *s) {
    const double top = smaller(0.5 + 0.5 * (larger(q1, q2) + error), 1.0 - DP_UNIT_BELOW_ONE);
    const double bottom = 0.5 + 0.5 * (smaller(q1, q2) - error);
    const double nearest = where(are_alike(q1, q2), smaller(size(q1), size(q2)) - error);
    const choice exact = is_less(0.0, nearest) & is_less(top, 0x1p24 * half_ulp(nearest));
    s->viewport = where(~exact, c->moved * half_ulp(larger(top, 0.0)));
    s->viewport_grid = where(~exact, c->moved * 2.0 * half_ulp(larger(bottom, 0.0)));
}

DP_INLINE steps steps_of(const same *c, double lo, double hi, const clip_of *clip) {
    const double error = clip->product + larger(clip->kept_hi, -clip->kept_lo);
    const double off = error / lo;
    const double q1 = clip->v1 / lo, q2 = clip->v2 / hi;
    const pair_of q = magnitude(q1, q2, off);
    const double high = smaller(q.most, 1.0 - DP_UNIT_BELOW_ONE);
    const double rounded = half_ulp(high), flushed = smaller(high, 0x1p-126);
    steps s = {.quotient = choose(is_less(q.least, 0x1p-126) & is_less(rounded, flushed), flushed, rounded),
               .quotient_grid = 2.0 * half_ulp(q.least)};
    viewport_of(c, q1, q2, off + s.quotient, &s);
    s.product = clip->product * (c->per_ndc / lo);
    s.quotient = s.quotient * c->per_ndc;
    s.quotient_grid = s.quotient_grid * c->per_ndc;
    s.full = c->per_ndc * off + s.quotient + s.viewport;
    return s;
}

/* ---- The format -------------------------------------------------------------------------------------------------- */

/* The code of a binary32 window depth, of at most 24 bits: the product is exact. */
DP_INLINE double code_of(const same *c, double d) {
    return floor(d * c->levels + c->nearest);
}

DP_INLINE double unorm_loss(const same *c, double low, double high, double grid) {
    const choice coarse = is_at_most(2.0 * half_ulp(smaller(high, 1.0)), grid);
    const double divisor = choose(coarse, grid, 1.0), per = inverse(divisor);
    const double from = ceil(larger(low - 0x1p-50, 0.0) * per) * divisor;
    const double to = floor(smaller(high + 0x1p-50, 1.0) * per) * divisor;
    const double first = choose(coarse, narrowed(from), below(narrowed(larger(low, 0.0))));
    const double last = choose(coarse, narrowed(to), smaller(above(narrowed(high)), 1.0));
    const double step = choose(coarse, grid, 2.0 * half_ulp(first));
    const choice apart = is_less(1.0, step * c->levels) | (coarse & is_at_most(last, first));
    const choice one = coarse | is_same(half_ulp(first), half_ulp(below(last)));
    const choice counted = is_same(code_of(c, last) - code_of(c, first), (last - first) * inverse(step));
    const choice known = coarse | is_less(0.0, low);
    return where(~(known & (apart | (one & counted))), c->per_level);
}

DP_INLINE double float_loss(const same *c, double low, double high, double grid) {
    const double top = smaller(larger(high, 0.0), 1.0 - DP_UNIT_BELOW_ONE);
    const double bottom = smaller(larger(low, 0.0), top);
    const double step = c->fine_step + larger(power(larger(top, 0x1p-1000)), c->least_normal) * c->step_scale;
    const choice finest = is_at_most(c->fine_from, bottom) | is_at_most(step, c->fine * 2.0 * half_ulp(bottom));
    return where(~(finest | is_at_most(step, grid)), step);
}

DP_INLINE double window_of(const same *c, double clip, double z) {
    return c->ndc_scale * (clip / z) + c->ndc_offset;
}

DP_INLINE double format_loss(const same *c, int is_unorm, double w1, double w2, double error, double grid) {
    const double low = smaller(w1, w2) - error, high = larger(w1, w2) + error;
    return is_unorm ? unorm_loss(c, low, high, grid) : float_loss(c, low, high, grid);
}

/* ---- A pair ------------------------------------------------------------------------------------------------------ */

typedef struct demand {
    double window, slope;
} demand;

DP_INLINE demand larger_of(demand d, double window, double slope, choice asked) {
    const choice more = asked & is_less(d.window * slope, window * d.slope);
    return (demand){choose(more, window, d.window), choose(more, slope, d.slope)};
}

DP_INLINE demand clamped(const same *c, demand d, double rest, double w2, double full1, double full2) {
    return larger_of(d, c->far_end + full1 + rest, c->size_b, is_at_most(c->ends[1], c->sense * w2 + full2));
}

DP_INLINE demand clamped_nearer(const same *c, demand d, double rest, double w1, double full1, double full2) {
    return larger_of(d, c->near_end + full2 + rest, c->size_b, is_at_most(c->sense * w1 - full1, c->ends[0]));
}

DP_INLINE double distance_of(const same *c, double z, demand d) {
    const double x = d.window * z / (c->half * d.slope) * DP_OUTWARD;
    return choose(is_less(x, 1.0), z * x / (1.0 - x) * DP_OUTWARD, HUGE_VAL);
}

DP_INLINE double before_rounding(double e1, double g1, double e2, double g2, double rest) {
    const double errors = e1 + e2, grid = smaller(g1, g2);
    const choice exact = is_same(errors, 0.0) | is_same(grid, 0.0);
    const double whole = floor(rest * inverse(choose(exact, 1.0, grid)) * DP_OUTWARD) * grid;
    return choose(exact, rest, smaller(rest, whole)) + errors;
}

DP_INLINE double product_lag(const same *c, double hi) {
    const double u = 2.0 * half_ulp_of(hi), ulp = 2.0 * half_ulp_of(c->size_a * hi);
    return where(is_less(c->size_a * u, ulp), c->plain * c->rounds * (ulp - u));
}

/* rise_of(), of a span whose depths are [z, hi] */
DP_INLINE double rise_of(const same *c, double z, double hi, const clip_of *clip) {
    const double loss = where(is_same(clip->kept_one, 0.0), c->plain * (clip->kept_hi - clip->kept_lo));
    const double one = product_lag(c, hi) + loss;
    const double two = one + product_lag(c, power(hi) * (1.0 - DP_UNIT));
    const double near = choose(is_less(power(z), power(hi)), two, one);
    return choose(is_less(c->binades * power(z), power(hi)), HUGE_VAL, near);
}

/* ---- The nearer depth -------------------------------------------------------------------------------------------- */

DP_INLINE double numerator_of(const same *c, double z, const clip_of *clip) {
    const double t = c->z_share * z + c->clip_share * clip->v2;
    const double fuzz = (size(clip->v2) + z) * 0x1p-52;
    const double common = smaller(clip->granule, c->b_granule);
    const double exact = where(is_less(clip->before.most, c->exact_below * common), common);
    const double least_clip = clip->before.least - half_ulp_of(clip->before.most);
    const double of_clip = larger(exact, where(is_less(0.0, least_clip), 2.0 * half_ulp(least_clip)));
    const double granule = smaller(of_clip, 2.0 * half_ulp_of(z) / c->z_share);
    const double lost = t + clip->kept_lo - clip->product - fuzz;
    const choice whole = is_less(0.0, granule) & is_less(lost, 0x1p50 * granule);
    const double on = ceil(lost * inverse(choose(whole, granule, 1.0))) * granule;
    return where(is_less(0.0, lost), choose(whole, on, lost));
}

/* demand_beyond(), and where the first span behind ends. */
DP_INLINE double beyond_of(const same *c, int is_unorm, double z, const steps *s1, const clip_of *clip) {
    const double clip_far = c->a * c->far + c->b;
    const double q = (1.0 + DP_ROUNDINGS32_14) * larger(size(clip->v1) / z, size(clip_far) / c->far);
    const double product = c->rounds * DP_UNIT * c->size_a;
    const double off = product + DP_UNIT * (q + product) / (1.0 + c->no_product);
    const double ndc = half_ulp(smaller(q + off, 1.0 - DP_UNIT_BELOW_ONE));
    const double rest = c->per_ndc * off, quotient = c->per_ndc * ndc + c->moved * DP_UNIT_BELOW_ONE;
    const double full2 = rest + quotient;
    const double w1 = window_of(c, clip->v1, z), w2 = window_of(c, clip_far, c->far);
    const double format = format_loss(c, is_unorm, w1, w2, larger(s1->full, full2), 0.0);
    demand d = {s1->full + full2 + format, c->size_b};
    d = clamped(c, d, format, w2, s1->full, full2);
    d = clamped_nearer(c, d, format, w1, s1->full, full2);
    return distance_of(c, z, d);
}

DP_INLINE double binade_before(double hi) {
    const double p = power(hi);
    return choose(is_less(p, hi), p, 0.5 * p);
}

DP_INLINE void begin_lanes(const same *c, int is_unorm, block *restrict b) {
#pragma omp simd
    for (int i = 0; i < LANES; i++) {
        const double z = b->z[i];
        const clip_of clip = clip_over(c, z, z);
        const steps s = steps_of(c, z, z, &clip);
        b->product[i] = s.product;
        b->kept_lo[i] = clip.kept_lo;
        b->kept_one[i] = clip.kept_one;
        b->quotient[i] = s.quotient;
        b->quotient_grid[i] = s.quotient_grid;
        b->viewport[i] = s.viewport;
        b->viewport_grid[i] = s.viewport_grid;
        b->full[i] = s.full;
        b->numerator[i] = numerator_of(c, z, &clip);
        const double any = beyond_of(c, is_unorm, z, &s, &clip);
        const double hi = larger(smaller(z + any, c->far), z);
        b->window[i] = window_of(c, clip.v1, z);
        b->any[i] = any;
        b->hi[i] = hi;
        b->lo[i] = larger(binade_before(hi), z);
        b->end[i] = HUGE_VAL;
        b->round[i] = 0.0;
        b->best[i] = 0.0;
        b->longest[i] = -1.0;
    }
}

/* demand_of() and distance() of lane i and what lies behind it from lo to hi. */
DP_INLINE double distance_within(const same *c, int is_unorm, const block *b, int i, double lo, double hi) {
    const double z = b->z[i];
    const clip_of clip = clip_over(c, lo, hi), range = clip_over(c, z, hi);
    const steps s2 = steps_of(c, lo, hi, &clip);
    const double w1 = b->window[i], w2 = window_of(c, clip.v2, hi);
    const choice exact = is_same(b->viewport[i], 0.0) & is_same(s2.viewport, 0.0);
    const double grid = where(exact, c->moved * smaller(b->quotient_grid[i], s2.quotient_grid));
    const double format = format_loss(c, is_unorm, w1, w2, larger(b->full[i], s2.full), grid);
    const double window = before_rounding(b->viewport[i], b->viewport_grid[i], s2.viewport, s2.viewport_grid, format);
    const double quotient = before_rounding(b->quotient[i], b->quotient_grid[i], s2.quotient, s2.quotient_grid, window);
    const choice one = is_less(0.0, b->kept_one[i]) & is_same(b->kept_one[i], clip.kept_one);
    const double loss = where(~one, larger(clip.kept_hi - b->kept_lo[i], 0.0) * c->per_ndc / z);
    const double projection = b->product[i] + s2.product + loss;
    demand d = {quotient + projection, larger(c->size_b + smaller(clip.kept_lo, 0.0), 0.0)};
    d = clamped(c, d, format, w2, b->full[i], s2.full);
    const double rise = rise_of(c, z, hi, &range), t = b->numerator[i];
    const choice falls = is_less(0.0, t) & is_less(rise, HUGE_VAL);
    const double window_falling = choose(falls, quotient + c->half * rise / z * (1.0 + DP_UNIT), 1.0);
    const double slope_falling = where(falls, t);
    const choice less = is_less(window_falling * d.slope, d.window * slope_falling);
    d = (demand){choose(less, window_falling, d.window), choose(less, slope_falling, d.slope)};
    return distance_of(c, z, clamped_nearer(c, d, format, w1, b->full[i], s2.full));
}

/*
 * One step of longest_within() and dp_demand_longest(): the span ends nearer, or the binade before is next, or it is
 * known. Gives the number of those that are not.
 */
DP_INLINE double step_lanes(const same *c, int is_unorm, block *restrict b) {
    double left = 0.0;
#pragma omp simd reduction(+ : left)
    for (int i = 0; i < LANES; i++) {
        const double z = b->z[i], lo = b->lo[i], hi = b->hi[i], round = b->round[i], before = b->best[i];
        const double end = b->end[i], longest = b->longest[i];
        const double s = distance_within(c, is_unorm, b, i, lo, hi);
        const double best = choose(is_same(round, 0.0) | is_less(s, before), s, before);
        const double until = z + best, found = smaller(smaller(best, end - z), b->any[i]);
        const choice met = is_at_most(lo, until);
        const choice stops = is_at_most(hi, until) | ~met | is_same(round, REFINED - 1.0);
        const choice known = is_at_most(0.0, longest), done = known | (stops & met);
        b->longest[i] = choose(known, longest, choose(stops & met, found, -1.0));
        b->best[i] = best;
        b->round[i] = where(~stops, round + 1.0);
        b->end[i] = choose(stops, lo, end);
        b->hi[i] = choose(done, hi, choose(stops, lo, until));
        b->lo[i] = choose(~done & stops, larger(binade_before(lo), z), lo);
        left += where(~done, 1.0);
    }
    return left;
}

CLONES static void begin_unorm(const same *c, block *restrict b) {
    const same own = *c;
    begin_lanes(&own, 1, b);
}

CLONES static void begin_float(const same *c, block *restrict b) {
    const same own = *c;
    begin_lanes(&own, 0, b);
}

CLONES static double step_unorm(const same *c, block *restrict b) {
    const same own = *c;
    return step_lanes(&own, 1, b);
}

CLONES static double step_float(const same *c, block *restrict b) {
    const same own = *c;
    return step_lanes(&own, 0, b);
}

/* ---- Of a block -------------------------------------------------------------------------------------------------- */

/* share_out(): less than 0 where the lattice may need more, NaN where it is for dp_guarantee_at(). */
CLONES static void finish(const same *of, const block *restrict b, double *restrict out) {
    const same own = *of, *const c = &own;
#pragma omp simd
    for (int i = 0; i < LANES; i++) {
        const double z = b->z[i], end = z + b->longest[i];
        const choice ends = is_less(end, most_z), infinite = is_same(end, HUGE_VAL);
        const double last = dp_float64(dp_bits64(end) & ~0x1FFFFFFFULL); /* dp_float_down() */
        const double needs = (last - z + (half_ulp_of(z) + half_ulp_of(last))) * DP_OUTWARD;
        const double off = c->size_b / z * 0x1p-22; /* the depth itself, before it was rounded, and d */
        const double d = larger((c->window_from + c->window_slope * z) / z * c->window_scale + off, c->least_normal);
        const double here = power(d) * c->lattice_scale;
        const double code = c->step + power(d + c->ahead * here) * c->lattice_scale;
        const double h = z * code * c->kappa * (1.0 + 0x1p-20);
        const double lattice = z * h / (1.0 - h) * (1.0 + 0x1p-20);
        const choice enough = is_less(h, 0.5) & is_at_most(lattice, needs);
        const double known = choose(infinite, HUGE_VAL, choose(enough, needs, -needs));
        out[i] = choose((infinite | ends) & is_at_most(0.0, b->longest[i]), known, (double)NAN);
    }
}

/* The numbers that stand for the choices of a format. */
static void set_format(same *c, const dp_setup *s) {
    const dp_format *f = &s->spec.format;
    c->levels = (double)f->code_max;
    c->per_level = 1.0 / c->levels;
    c->nearest = s->spec.rounding == DP_ROUND_ZERO ? 0.0 : 0.5;
    c->fine_from = HUGE_VAL;
    c->least_normal = 0x1p-1000;
    if (f->kind == DP_FORMAT_UNORM) {
        c->step = 2.0 / s->den;
        return;
    }
    c->least_normal = dp_power2(1 - f->bias);
    c->lattice_scale = dp_power2(-f->mantissa_bits);
    c->ahead = s->reversed ? 0.0 : 1.0;
    if (f->mantissa_bits < 23) {
        c->step_scale = c->lattice_scale;
        return;
    }
    c->fine = 1.0;
    c->fine_from = c->least_normal;
    c->fine_step = dp_step_num(f, 1 - f->bias);
}

static same same_of(const dp_guarantee *g) {
    const dp_setup *s = g->setup;
    const dp_chain *p = &g->chain;
    const double near = s->spec.znear, far = s->spec.zfar;
    const int reversed = p->pipeline.clip_reversed, plain = reversed && !p->pipeline.ndc_signed;
    same c = {.a = p->a,
              .b = p->b,
              .size_a = fabs(p->a),
              .size_b = fabs(p->b),
              .b_granule = p->b_granule,
              .half = p->half,
              .per_ndc = p->per_ndc,
              .near_end = reversed ? p->above : p->below,
              .far_end = reversed ? p->below : p->above,
              .sense = p->pipeline.reversed ? -1.0 : 1.0,
              .far = p->reach.hi,
              .rounds = p->a_exact ? 0.0 : 1.0,
              .no_product = p->a == 0.0 ? HUGE_VAL : 0.0,
              .exact_below = p->a == 0.0 ? HUGE_VAL : 0x1p24,
              .moved = p->two_stage ? 1.0 : 0.0,
              .ndc_scale = p->pipeline.ndc_signed ? 0.5 : 1.0,
              .ndc_offset = p->pipeline.ndc_signed ? 0.5 : 0.0,
              .clip_sense = reversed ? 1.0 : -1.0,
              .z_share = plain ? 0.0 : 1.0,
              .clip_share = reversed ? 1.0 : -1.0,
              .plain = plain ? 0.0 : 1.0,
              .binades = plain ? HUGE_VAL : 2.0,
              .kappa = s->kappa};
    c.ends[0] = c.sense * p->ends[0];
    c.ends[1] = c.sense * p->ends[1];
    c.window_from = !s->reversed ? -near : isinf(far) ? near : far;
    c.window_slope = !s->reversed ? 1.0 : isinf(far) ? 0.0 : -1.0;
    c.window_scale = isinf(far) ? 1.0 : (s->reversed ? near : far) / (far - near);
    set_format(&c, s);
    return c;
}

static int fits(const dp_guarantee *g) {
    if (!g->computed || g->setup->curve != DP_CURVE_PERSPECTIVE || g->setup->spec.triangles.width != 0)
        return 0;
    const dp_chain *c = &g->chain;
    const dp_pipeline *p = &c->pipeline;
    return !p->ortho && !c->run && !c->fused && !c->remap && !c->ranged && !c->few_steps &&
           p->arith->reciprocal == DP_RECIPROCAL_NONE && p->arith->conversion == DP_CONVERT_EXACT &&
           (p->format.kind == DP_FORMAT_FLOAT || (p->format.bits <= 24 && p->rounding != DP_ROUND_EVEN));
}

static int ordinary(const dp_setup *s, double z) {
    return z >= s->spec.znear && z <= s->spec.zfar && z >= least_z && z <= most_z;
}

static void of_blocks(const dp_guarantee *g, const double *z, double *separation, size_t count) {
    const same c = same_of(g);
    const int is_unorm = g->setup->spec.format.kind == DP_FORMAT_UNORM;
    for (size_t at = 0; at < count; at += LANES) {
        const int some = count - at < LANES ? (int)(count - at) : LANES;
        block b;
        double found[LANES];
        for (int i = 0; i < LANES; i++)
            b.z[i] = (double)(float)(i < some && ordinary(g->setup, z[at + (size_t)i]) ? z[at + (size_t)i] : 1.0);
        (is_unorm ? begin_unorm : begin_float)(&c, &b);
        for (int round = 0; round < ROUNDS && (is_unorm ? step_unorm : step_float)(&c, &b) > 0.0; round++)
            ;
        finish(&c, &b, found);
        for (int i = 0; i < some; i++) {
            const double depth = z[at + (size_t)i];
            separation[at + (size_t)i] = !ordinary(g->setup, depth) || isnan(found[i]) ? dp_guarantee_at(g, depth)
                                         : found[i] < 0.0 ? dp_with_lattice(g->setup, depth, -found[i])
                                                          : found[i];
        }
    }
}

#else
static int fits(const dp_guarantee *g) {
    (void)g;
    return 0;
}

static void of_blocks(const dp_guarantee *g, const double *z, double *separation, size_t count) {
    (void)g, (void)z, (void)separation, (void)count;
}
#endif

void dp_guarantee_many(const dp_guarantee *g, const double *z, double *separation, size_t count) {
    enum { FEW = 16 };
    if (fits(g) && count >= FEW) {
        of_blocks(g, z, separation, count);
        return;
    }
    for (size_t i = 0; i < count; i++)
        separation[i] = dp_guarantee_at(g, z[i]);
}
