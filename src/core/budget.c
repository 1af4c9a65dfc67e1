/* SPDX-License-Identifier: MIT */
#include "depthprec/budget.h"

#include "core/composition.h"
#include "core/curve.h"
#include "core/engine.h"
#include "core/extremes.h"
#include "depthprec/pipeline.h"

/* Half a unit in the last place of binary32 at 1 and just below 1, and the smallest there is. */
static const double unit = 0x1p-24;
static const double unit_below_one = 0x1p-25;

/* Outward by more than the rounding of this file's own arithmetic. */
static const double outward = 1.0 + 0x1p-40;

static const char *const names[DP_CAUSE_COUNT] = {
    [DP_CAUSE_COMPOSITION] = "composition",
    [DP_CAUSE_PROJECTION] = "projection",
    [DP_CAUSE_NDC] = "ndc",
    [DP_CAUSE_INTERPOLATION] = "interpolation",
    [DP_CAUSE_FORMAT] = "format",
    [DP_CAUSE_LINEARIZATION] = "linearization",
};

const char *dp_cause_name(dp_cause cause) {
    return (unsigned)cause < DP_CAUSE_COUNT ? names[cause] : NULL;
}

/* The largest error of rounding a number of magnitude up to x to binary32. */
static double half_ulp(double x) {
    return x < 0x1p-126 ? 0x1p-150 : dp_power2(dp_exponent(x) - 24);
}

/* The lowest set bit of a binary32 number, as a value; a multiple of it is all that the number can be. */
static double granule(double x) {
    double g = 2.0 * half_ulp(fabs(x));
    while (x != 0.0 && fmod(x, 2.0 * g) == 0.0)
        g *= 2.0;
    return g;
}

/* The pipeline's real function: window depth g(z) = half (A + B/w z..) and what bounds its errors. */
typedef struct chain {
    dp_pipeline pipeline;
    double a, b;
    double b_granule;
    double half;      /* window depth per NDC depth, or per remapped clip depth */
    int a_exact;      /* A z is exact: A is 0 or a power of two */
    int two_stage;    /* the viewport halves and moves */
    double g_far;     /* the largest |NDC| beyond any z: at the far plane or, for a finite one behind, at infinity */
    double overshoot; /* how far the real window depth leaves [0, 1] inside the planes: clamped there */
} chain;

/*
 * What the roundings of two depths can take from the distance of their window depths, by cause, and the slope of that
 * distance: half slope (1/z1 - 1/z2), or half slope (z2 - z1) when orthographic.
 */
typedef struct demand {
    double projection;
    double ndc;
    double format;
    double slope;
    double error; /* of one window depth */
} demand;

static double real_clip(const chain *c, double z) {
    return c->a * z + c->b;
}

static double real_window(const chain *c, double z) {
    const double ndc = real_clip(c, z) / (c->pipeline.ortho ? 1.0 : z);
    return c->pipeline.ndc_signed ? 0.5 * ndc + 0.5 : ndc;
}

static chain make_chain(const dp_pipeline *p) {
    chain c = {.pipeline = *p, .a = (double)p->a, .b = (double)p->b};
    c.b_granule = granule(c.b);
    c.half = p->ndc_signed ? 0.5 : 1.0;
    c.a_exact = c.a == 0.0 || granule(c.a) == dp_power2(dp_exponent(fabs(c.a)));
    c.two_stage = p->ndc_signed && !p->arith->remap;
    const double z1 = (double)p->znear;
    const double z2 = (double)p->zfar;
    const double w1 = real_window(&c, z1);
    const double w2 = isinf(z2) ? (p->ndc_signed ? 0.5 * c.a + 0.5 : c.a) : real_window(&c, z2);
    const double high = larger(w1, w2);
    const double low = smaller(w1, w2);
    c.overshoot = larger(0.0, larger(high - 1.0, -low)) + 0x1p-48;
    c.g_far = isinf(z2) ? fabs(c.a) : fabs(real_clip(&c, z2) / (p->ortho ? 1.0 : z2));
    return c;
}

/* The clip depths of one narrow range of eye depths, as they are computed. */
typedef struct clip_range {
    double error;  /* of one clip depth, where the errors of two are independent */
    double shared; /* an error that all clip depths of the range have in common */
    double most;   /* largest magnitude */
    double least;  /* smallest, never above the truth; negative when the sign changes */
    int exact;     /* adding B loses nothing */
    int falls;     /* it never rises with z, as computed */
} clip_range;

/*
 * A z + B. Where the products are multiples of a granule that is no finer than the sums' last place, adding B rounds
 * every sum alike: then two sums differ exactly as their products do.
 */
static clip_range clip_over(const chain *c, double z1, double z2) {
    const int fused = c->pipeline.arith->fused;
    const double product = c->a_exact || fused ? 0.0 : half_ulp(fabs(c->a) * z2);
    const double p_granule = c->a_exact ? granule(c->a) * 2.0 * half_ulp(z1) : 2.0 * half_ulp(fabs(c->a) * z1);
    const double c1 = fabs(real_clip(c, z1));
    const double c2 = fabs(real_clip(c, z2));
    clip_range r = {.error = product, .most = larger(c1, c2) + product, .least = smaller(c1, c2) - product};
    if ((real_clip(c, z1) < 0.0) != (real_clip(c, z2) < 0.0))
        r.least = -1.0;
    r.falls = c->pipeline.reversed; /* A <= 0, and each rounding keeps the order */
    if (c->a == 0.0)
        return r;
    const double sum = half_ulp(r.most);
    const int exact = !fused && r.most < 0x1p24 * smaller(p_granule, c->b_granule);
    r.exact = exact;
    const int alike = !fused && r.least > 0.0 && half_ulp(r.least) == sum && 2.0 * sum <= p_granule &&
                      fmod(fabs(c->b), 2.0 * sum) != sum;
    if (alike)
        r.shared = exact ? 0.0 : sum;
    else if (!exact)
        r.error += sum;
    r.most += sum;
    r.least -= sum;
    return r;
}

/*
 * (clip + w)/2, the remap of the vertex shader. clip falls and w rises, so the sum as computed has no direction of its
 * own. But where A <= -1, and z and its product share a binade, each step of z moves the product by a whole step or
 * more; with an exact sum behind it, clip + z never rises.
 */
static clip_range remap_over(const chain *c, clip_range r, double z1, double z2) {
    const double s1 = real_clip(c, z1) + (c->pipeline.ortho ? 1.0 : z1);
    const double s2 = real_clip(c, z2) + (c->pipeline.ortho ? 1.0 : z2);
    const double most = larger(fabs(s1), fabs(s2)) + r.error + r.shared;
    const double least = smaller(s1, s2) - r.error - r.shared;
    const double sum = half_ulp(most);
    const double first = half_ulp(z1);
    const int one_binade =
        half_ulp(z2) == first && half_ulp(fabs(c->a) * z1) == first && half_ulp(fabs(c->a) * z2) == first;
    const int falls = c->pipeline.ortho ? r.falls : r.falls && r.exact && c->a <= -1.0 && one_binade;
    return (clip_range){.falls = falls,
                        .error = 0.5 * (r.error + sum),
                        .shared = 0.5 * r.shared,
                        .most = 0.5 * (most + sum),
                        .least = 0.5 * (least - sum)};
}

/* The rounding of the viewport, 0.5 ndc + 0.5: none where all terms are multiples of the sum's last place. */
static double viewport_error(const chain *c, double z1, double z2, double error) {
    const double w1 = c->pipeline.ortho ? 1.0 : z1;
    const double w2 = c->pipeline.ortho ? 1.0 : z2;
    const double n1 = real_clip(c, z1) / w1;
    const double n2 = real_clip(c, z2) / w2;
    const double window = smaller(0.5 + 0.5 * larger(n1, n2) + error, 1.0 - unit_below_one);
    const double ndc_least = (n1 < 0.0) != (n2 < 0.0) ? 0.0 : smaller(fabs(n1), fabs(n2)) - 2.0 * error;
    if (ndc_least > 0.0 && window < 0x1p24 * half_ulp(ndc_least))
        return 0.0;
    return half_ulp(larger(window, 0.0));
}

/* The largest distance of two binary32 window depths up to `window` that are stored as one code. */
static double format_step(const dp_setup *setup, const chain *c, double window) {
    const dp_format *format = &setup->spec.format;
    const double w = smaller(window, 1.0);
    if (format->kind == DP_FORMAT_FLOAT) {
        const double step = dp_step_num(format, dp_binade(format, w));
        return step <= 2.0 * half_ulp(w) ? 0.0 : step; /* no coarser than the window depth: nothing is lost */
    }
    const double levels = (double)format->code_max;
    if (c->pipeline.arith->conversion == DP_CONVERT_EXACT)
        return 1.0 / levels;
    /* The product is rounded to binary32, then to a whole number, which changes nothing where binary32 has no
     * fractions. */
    const double ulp = 2.0 * half_ulp(w * levels);
    return (ulp < 1.0 ? 1.0 + ulp : ulp) / levels;
}

/*
 * Whether every binary32 window depth of [lo, hi] has a code of its own. Where a step of the window depth is at most
 * one code, codes rise by 0 or 1 a step: so they all rise if they do in total.
 */
static int codes_are_distinct(const dp_setup *setup, const chain *c, double lo, double hi) {
    const dp_format *format = &setup->spec.format;
    if (format->kind != DP_FORMAT_UNORM || lo <= 0.0)
        return 0;
    const float first = nextafterf((float)lo, 0.0F);
    const float last = nextafterf((float)hi, 2.0F);
    if (!(last < 1.0F) || half_ulp((double)first) != half_ulp((double)last))
        return 0;
    const double step = 2.0 * half_ulp((double)first);
    const double levels = (double)format->code_max;
    if (step * levels > 1.0 ||
        (c->pipeline.arith->conversion != DP_CONVERT_EXACT && half_ulp((double)first * levels) < 0.5))
        return 0;
    const double codes =
        (double)dp_pipeline_convert(&c->pipeline, last) - (double)dp_pipeline_convert(&c->pipeline, first);
    return codes == ((double)last - (double)first) / step;
}

/*
 * The demand of any two depths of [z1, z2], z1 being one of them: each rounding at the largest value that it meets.
 */
static demand demand_over(const dp_setup *setup, const chain *c, double z1, double z2) {
    const dp_arith_row *arith = c->pipeline.arith;
    const int ortho = c->pipeline.ortho;
    clip_range clip = clip_over(c, z1, z2);
    if (c->pipeline.ndc_signed && arith->remap)
        clip = remap_over(c, clip, z1, z2);
    const double per_ndc = c->two_stage ? 0.5 : 1.0;
    const double w = ortho ? 1.0 : z1;
    const double error = clip.error / w;
    const double reciprocal = !ortho && arith->reciprocal ? clip.most * half_ulp(1.0 / z1) : 0.0;
    const double ndc = ortho ? 0.0 : reciprocal + half_ulp(smaller(clip.most / z1 + reciprocal, 1.0 - unit_below_one));
    demand d = {.projection = 2.0 * per_ndc * error,
                .ndc = 2.0 * per_ndc * ndc,
                .slope = ortho ? fabs(c->a) : larger(fabs(c->b) - clip.shared / c->half * per_ndc, 0.0)};
    const double so_far = per_ndc * (error + clip.shared / w + ndc);
    const double viewport = c->two_stage ? viewport_error(c, z1, z2, so_far) : 0.0;
    d.ndc += 2.0 * viewport;
    const double g1 = real_window(c, z1);
    const double g2 = real_window(c, z2);
    d.error = so_far + viewport;
    const double high = larger(g1, g2) + d.error;
    const double low = smaller(g1, g2) - d.error;
    d.format = codes_are_distinct(setup, c, low, high) ? 0.0 : format_step(setup, c, high);
    /*
     * Where the computed clip depth never rises with z, and is not negative, the distance of two quotients is at least
     * clip (1/z1 - 1/z2) with the farther clip depth: its rounding can only help.
     */
    const int remapped = c->pipeline.ndc_signed && arith->remap;
    const double gentle = remapped ? clip.least / c->half : real_clip(c, z2) > 0.0 ? clip.least : 0.0;
    if (clip.falls && !ortho && gentle > 0.0 && d.projection > 0.0 &&
        (d.ndc + d.format) * d.slope < (d.projection + d.ndc + d.format) * gentle) {
        d.projection = 0.0;
        d.slope = gentle;
    }
    return d;
}

/* The demand of z and any depth behind it: each rounding relative to a value that only falls, or that is at most 1. */
static demand demand_beyond(const dp_setup *setup, const chain *c, double z) {
    const dp_arith_row *arith = c->pipeline.arith;
    const int ortho = c->pipeline.ortho;
    const double zfar = (double)c->pipeline.zfar;
    const double g = larger(fabs(real_clip(c, z)) / (ortho ? 1.0 : z), c->g_far) * (1.0 + 0x1p-20);
    double error = c->a_exact || arith->fused ? 0.0 : unit * fabs(c->a) * (ortho ? zfar : 1.0);
    error += c->a == 0.0 ? 0.0 : unit * (g + error);
    if (c->pipeline.ndc_signed && arith->remap)
        error = 0.5 * (error + unit * (1.0 + g + error));
    double ndc = 0.0;
    if (!ortho)
        ndc = half_ulp(smaller(g + error, 1.0 - unit_below_one)) + (arith->reciprocal ? unit * (g + error) : 0.0);
    if (c->two_stage) {
        error *= 0.5;
        ndc = 0.5 * ndc + unit_below_one;
    }
    const double high = setup->reversed ? real_window(c, z) + error + ndc : 1.0;
    return (demand){.projection = 2.0 * error,
                    .ndc = 2.0 * ndc,
                    .format = format_step(setup, c, high),
                    .slope = ortho ? fabs(c->a) : fabs(c->b),
                    .error = error + ndc};
}

/* The distance behind z at which the window depth has moved by `window`, at a slope. */
static double distance(const chain *c, double z, double window, double slope) {
    if (c->pipeline.ortho)
        return window / (c->half * slope);
    const double x = window * z / (c->half * slope);
    return x < 1.0 ? z * x / (1.0 - x) : HUGE_VAL;
}

/*
 * Reading back in binary32, as window depth: z = 1/(zb d + wb), or n + (f - n) d when orthographic. Each constant is
 * rounded once, d is converted once, then product, sum and reciprocal; errors are relative to the terms of the sum.
 */
static double linearization_error(const dp_setup *setup, const chain *c, double z) {
    const double n = setup->spec.znear;
    const double f = setup->spec.zfar;
    if (c->pipeline.ortho) {
        const double start = setup->reversed ? f : n;
        return unit * (3.0 * fabs(z - start) + start + z) / (f - n) * outward;
    }
    const double start = setup->reversed ? 1.0 / f : 1.0 / n;
    const double relative = unit * ((3.0 * fabs(1.0 / z - start) + start) * z + 2.0) * outward;
    return relative * c->half * fabs(c->b) / z;
}

/*
 * Window depth that a pair needs in all. Where the rounded matrix carries the window depth of a plane out of [0, 1],
 * all beyond is clamped to one value: a tie that no rounding of the pair accounts for.
 */
static double total_of(const chain *c, const demand *d, double z1, double extra) {
    const double g = real_window(c, z1);
    const int clamped = g + d->error >= 1.0 || g - d->error <= 0.0;
    const double roundings = d->projection + d->ndc;
    return (clamped ? larger(roundings, c->overshoot + d->error) : roundings) + d->format + extra;
}

/*
 * Two binary32 depths from z on lie whole steps of z apart. So what holds beyond `separation` holds beyond the whole
 * steps in it: they are the answer, and a little, because two depths just so far apart may still tie.
 */
static double whole_steps(double separation, double step) {
    const double steps = floor(separation / step);
    return steps >= 1.0 && steps < 0x1p20 ? steps * step * outward : separation;
}

/*
 * The same for a run of depths at once: every rounding at the largest value that it meets anywhere in it. All that the
 * demands are made of rises with the range that they are taken over, so this is a separation of each depth of the run.
 */
static double run_bound(const dp_setup *setup, const chain *c, double z1, double z2, double extra) {
    demand d = demand_beyond(setup, c, z1);
    const demand end = demand_beyond(setup, c, z2);
    d.projection = larger(d.projection, end.projection);
    d.ndc = larger(d.ndc, end.ndc);
    d.format = larger(d.format, end.format);
    d.error = larger(d.error, end.error);
    double window = larger(total_of(c, &d, z1, extra), total_of(c, &d, z2, extra));
    double separation = distance(c, z2, window, d.slope) * outward;
    for (double before = HUGE_VAL; separation < z1 && separation < 0.97 * before;) {
        before = separation;
        const demand close = demand_over(setup, c, z1, z2 + separation);
        window = larger(total_of(c, &close, z1, extra), total_of(c, &close, z2, extra));
        const double s = close.slope > 0.0 ? distance(c, z2, window, close.slope) * outward : HUGE_VAL;
        if (s >= separation)
            break;
        separation = s;
    }
    return separation;
}

/* The separation of depths that a composition moves: that of any depth which a surface at z may be moved to. */
static double composed_separation(const dp_setup *setup, const chain *c, const dp_composed *m, double z, double extra) {
    if (!(m->reach < z))
        return HUGE_VAL;
    const double n = setup->spec.znear;
    const double first = larger(z - m->reach, smaller(n, z) * (1.0 - 0x1p-20));
    const double plain = run_bound(setup, c, first, z + m->reach, extra);
    const double s = dp_composition_separation(m, z, plain, 0);
    const int clamped = z - m->reach <= n * (1.0 + 0x1p-20) || z + m->reach + s >= setup->spec.zfar * (1.0 - 0x1p-20);
    return clamped ? dp_composition_separation(m, z, plain, 1) : s;
}

/* World positions: the separation then, and what it is more is the composition's part. */
static void add_composition(const dp_setup *setup, const chain *c, double z, const dp_budget_terms *terms, double extra,
                            dp_budget *out) {
    const dp_pipeline *p = &c->pipeline;
    const dp_composing in = {.composition = terms->composition,
                             .world = terms->world,
                             .a = c->a,
                             .b = c->b,
                             .znear = setup->spec.znear,
                             .zfar = setup->spec.zfar,
                             .ortho = p->ortho,
                             .fused = p->arith->fused,
                             .remap = p->ndc_signed && p->arith->remap};
    /* As below: first a separation from all that is behind, then from what is nearer than that. */
    double separation = HUGE_VAL;
    double until = HUGE_VAL;
    for (double before = HUGE_VAL; isinf(before) || separation < 0.97 * before;) {
        before = separation;
        const dp_composed m = dp_composition_at(&in, z, until);
        separation = smaller(separation, composed_separation(setup, c, &m, z, extra));
        if (isinf(separation))
            break;
        until = smaller(z + separation, setup->spec.zfar);
    }
    separation = larger(separation, out->separation);
    const double part = separation - out->separation;
    out->cause[DP_CAUSE_COMPOSITION] = part > 0.0 ? part : 0.0; /* infinity less infinity too */
    out->separation = separation;
    const double slope = c->half * (p->ortho ? fabs(c->a) * separation : fabs(c->b));
    out->window = p->ortho ? slope : slope / z * (isinf(separation) ? 1.0 : separation / (z + separation));
}

dp_status dp_budget_at(const dp_setup *setup, double z, const dp_budget_terms *terms, dp_budget *out) {
    if (setup == NULL || out == NULL)
        return DP_ERROR_NULL;
    if (!(z >= setup->spec.znear && z <= setup->spec.zfar))
        return DP_ERROR_DEPTH;
    if (terms != NULL && dp_composition_get(terms->composition) == NULL)
        return DP_ERROR_MODEL;
    dp_pipeline pipeline;
    const dp_status status = dp_pipeline_init(&pipeline, setup);
    if (status != DP_OK)
        return status;
    *out = (dp_budget){.separation = HUGE_VAL, .window = 1.0};
    if (isinf(z))
        return DP_OK;
    const chain c = make_chain(&pipeline);
    const double z1 = (double)(float)z;
    double part[DP_CAUSE_COUNT] = {0};
    if (terms != NULL) {
        part[DP_CAUSE_INTERPOLATION] = 2.0 * terms->interpolation * unit;
        part[DP_CAUSE_LINEARIZATION] = terms->linearize ? 2.0 * linearization_error(setup, &c, z1) : 0.0;
    }
    const double extra = part[DP_CAUSE_INTERPOLATION] + part[DP_CAUSE_LINEARIZATION];

    /*
     * First a separation that holds against every depth behind. Then, as long as it helps: all depths farther than the
     * separation so far are safe, so only those between need a demand of their own, which is smaller.
     */
    demand best = demand_beyond(setup, &c, z1);
    double window = total_of(&c, &best, z1, extra);
    double separation = distance(&c, z1, window, best.slope) * outward;
    for (double before = HUGE_VAL; separation < z1 && separation < 0.97 * before;) {
        before = separation;
        const demand close = demand_over(setup, &c, z1, z1 + separation);
        const double need = total_of(&c, &close, z1, extra);
        const double s = close.slope > 0.0 ? distance(&c, z1, need, close.slope) * outward : HUGE_VAL;
        if (s >= separation)
            break;
        separation = s;
        best = close;
        window = need;
    }
    separation = whole_steps(separation, 2.0 * half_ulp(z1));
    part[DP_CAUSE_PROJECTION] = best.projection;
    part[DP_CAUSE_FORMAT] = best.format;
    part[DP_CAUSE_NDC] = window - extra - best.projection - best.format; /* with what clamping takes */
    out->separation = separation;
    out->window = window;
    for (int i = 0; i < DP_CAUSE_COUNT; i++)
        out->cause[i] = part[i] > 0.0 ? separation * (part[i] / window) : 0.0;
    if (terms != NULL && terms->world > 0.0)
        add_composition(setup, &c, z, terms, extra, out);
    return DP_OK;
}

double dp_budget_bound(const dp_setup *setup, float nearest, float farthest) {
    dp_pipeline pipeline;
    if (dp_pipeline_init(&pipeline, setup) != DP_OK || isinf(farthest))
        return HUGE_VAL;
    const chain c = make_chain(&pipeline);
    const double bound = run_bound(setup, &c, (double)nearest, (double)farthest, 0.0);
    return whole_steps(bound, 2.0 * half_ulp((double)farthest));
}

dp_status dp_code_range(const dp_setup *setup, double z, uint32_t *lowest, uint32_t *highest) {
    if (setup == NULL || lowest == NULL || highest == NULL)
        return DP_ERROR_NULL;
    if (!(z >= setup->spec.znear && z <= setup->spec.zfar) || isinf(z))
        return DP_ERROR_DEPTH;
    dp_pipeline pipeline;
    const dp_status status = dp_pipeline_init(&pipeline, setup);
    if (status != DP_OK)
        return status;
    const chain c = make_chain(&pipeline);
    const double z1 = (double)(float)z;
    const double error = demand_over(setup, &c, z1, z1).error * outward + 0x1p-149;
    const double g = real_window(&c, z1);
    *lowest = dp_pipeline_convert(&pipeline, nextafterf((float)(g - error), -2.0F));
    *highest = dp_pipeline_convert(&pipeline, nextafterf((float)(g + error), 2.0F));
    return DP_OK;
}
