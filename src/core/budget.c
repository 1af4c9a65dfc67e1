/* SPDX-License-Identifier: MIT */
#include "depthprec/budget.h"

#include "core/curve.h"
#include "core/engine.h"
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

static double larger(double a, double b) {
    return a > b ? a : b;
}

static double smaller(double a, double b) {
    return a < b ? a : b;
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

/* Rounding errors in window depth, by cause. */
typedef struct errors {
    double projection;
    double ndc;
} errors;

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

/*
 * The errors of the pipeline for every depth in [z1, z2], which must not be wide: each rounding at the largest value
 * that it meets there. A sum whose terms are multiples of a granule, and smaller than 2^24 of them, is exact.
 */
static errors errors_over(const chain *c, double z1, double z2) {
    const dp_arith_row *arith = c->pipeline.arith;
    const double p = fabs(c->a) * z2;
    const double product = c->a_exact || arith->fused ? 0.0 : half_ulp(p);
    const double p_granule = c->a_exact ? granule(c->a) * 2.0 * half_ulp(z1) : 2.0 * half_ulp(fabs(c->a) * z1);
    double clip = larger(fabs(real_clip(c, z1)), fabs(real_clip(c, z2))) + product;
    const int sum_exact = c->a == 0.0 || (!arith->fused && clip < 0x1p24 * smaller(p_granule, c->b_granule));
    double error = product + (sum_exact ? 0.0 : half_ulp(clip));
    clip += error;
    if (c->pipeline.ndc_signed && arith->remap) {
        const double w = c->pipeline.ortho ? 1.0 : z2;
        const double sum =
            larger(fabs(real_clip(c, z1) + (c->pipeline.ortho ? 1.0 : z1)), fabs(real_clip(c, z2) + w)) + error;
        error = 0.5 * (error + half_ulp(sum));
        clip = 0.5 * sum + error;
    }
    errors e = {.projection = error, .ndc = 0.0};
    double ndc = clip;
    if (!c->pipeline.ortho) {
        const double reciprocal = arith->reciprocal ? clip * half_ulp(1.0 / z1) : 0.0;
        e.projection = error / z1;
        ndc = clip / z1 + reciprocal;
        e.ndc = reciprocal + half_ulp(smaller(ndc, 1.0 - unit_below_one));
    }
    if (!c->two_stage)
        return e;
    e.projection *= 0.5;
    e.ndc *= 0.5;
    /* 0.5 ndc + 0.5: both are multiples of half of ndc's last place, taken where ndc is smallest */
    const double ndc_least = smaller(fabs(real_clip(c, z1)) / (c->pipeline.ortho ? 1.0 : z1),
                                     fabs(real_clip(c, z2)) / (c->pipeline.ortho ? 1.0 : z2)) -
                             2.0 * (e.projection + e.ndc);
    const double window =
        smaller(larger(real_window(c, z1), real_window(c, z2)) + e.projection + e.ndc, 1.0 - unit_below_one);
    const int crosses = (real_clip(c, z1) < 0.0) != (real_clip(c, z2) < 0.0);
    const double step = crosses || ndc_least <= 0.0 ? 0.0 : half_ulp(ndc_least);
    if (!(window < 0x1p24 * step))
        e.ndc += half_ulp(larger(window, 0.0));
    return e;
}

/* The errors for every depth from z to the far plane: each rounding relative to a value that only falls, or at most 1.
 */
static errors errors_beyond(const chain *c, double z) {
    const dp_arith_row *arith = c->pipeline.arith;
    const double w = c->pipeline.ortho ? 1.0 : z;
    const double g = larger(fabs(real_clip(c, z)) / w, c->g_far) * (1.0 + 0x1p-20);
    const double zfar = (double)c->pipeline.zfar;
    const double slope = c->pipeline.ortho ? fabs(c->a) * zfar : fabs(c->a);
    double error = c->a_exact || arith->fused ? 0.0 : unit * slope;
    error += c->a == 0.0 ? 0.0 : unit * (g + error);
    if (c->pipeline.ndc_signed && arith->remap)
        error = 0.5 * (error + unit * (1.0 + g + error));
    errors e = {.projection = error, .ndc = 0.0};
    if (!c->pipeline.ortho)
        e.ndc = half_ulp(smaller(g + error, 1.0 - unit_below_one)) + (arith->reciprocal ? unit * (g + error) : 0.0);
    if (c->two_stage) {
        e.projection *= 0.5;
        e.ndc = 0.5 * e.ndc + unit_below_one;
    }
    return e;
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

/* The distance behind z at which the real window depth has moved by `window`. */
static double distance(const chain *c, double z, double window) {
    if (c->pipeline.ortho)
        return window / (c->half * fabs(c->a));
    const double x = window * z / (c->half * fabs(c->b));
    return x < 1.0 ? z * x / (1.0 - x) : HUGE_VAL;
}

/* World positions through one binary32 matrix: four rounded entries, four products, three sums, in any order. */
static double composition_error(const chain *c, double z, double world) {
    if (world <= 0.0)
        return 0.0;
    const double entries = 3.0 * fabs(c->a) * world;               /* |m| |x| of the three axes at most */
    const double constant = 3.0 * fabs(c->a) * world + fabs(c->b); /* the camera's own position, and B */
    const double clip = 8.0 * unit * (entries + constant);
    const double w = c->pipeline.ortho ? 0.0 : 8.0 * unit * 6.0 * world; /* the row of w, from the same positions */
    return c->half * (clip + w) / (c->pipeline.ortho ? 1.0 : z);
}

/* 1/(z d + w) in binary32, relative to the depth, carried back to window depth by the slope. */
static double linearization_error(const dp_setup *setup, const chain *c, double z) {
    const double n = setup->spec.znear;
    const double f = setup->spec.zfar;
    const double slope = c->half * fabs(c->b) / z; /* d changes by slope for a relative change of z */
    if (c->pipeline.ortho)
        return unit * (1.0 + n / (f - n)) + unit * z / (f - n);
    const double sum = 1.0 / z; /* = zb d + wb, of terms up to 1/n when the mapping is standard */
    const double terms = setup->reversed ? sum : 1.0 / n + (1.0 / n - sum);
    return slope * unit * (3.0 * terms / sum + 2.0);
}

static double total_of(const errors *e) {
    return e->projection + e->ndc;
}

dp_status dp_budget_at(const dp_setup *setup, double z, const dp_budget_terms *terms, dp_budget *out) {
    if (setup == NULL || out == NULL)
        return DP_ERROR_NULL;
    if (!(z >= setup->spec.znear && z <= setup->spec.zfar))
        return DP_ERROR_DEPTH;
    dp_pipeline pipeline;
    const dp_status status = dp_pipeline_init(&pipeline, setup);
    if (status != DP_OK)
        return status;
    *out = (dp_budget){.separation = HUGE_VAL, .window = 1.0};
    if (isinf(z))
        return DP_OK;
    const dp_budget_terms none = {0};
    const dp_budget_terms t = terms != NULL ? *terms : none;
    const chain c = make_chain(&pipeline);
    const double z1 = (double)(float)z;

    const double extra = 2.0 * (composition_error(&c, z1, t.world) + t.interpolation * unit +
                                (t.linearize ? linearization_error(setup, &c, z1) : 0.0));
    const errors here = errors_over(&c, z1, z1);

    /* First a separation that holds against every depth behind; then, up to there, the errors are those near z. */
    const errors beyond = errors_beyond(&c, z1);
    const double g = real_window(&c, z1);
    const double far_step = format_step(setup, &c, setup->reversed ? g + total_of(&here) : 1.0);
    double safe = total_of(&here) + total_of(&beyond) + extra;
    safe = larger(safe, c.overshoot + total_of(&here)) + far_step;
    const double z_end =
        smaller(z1 + distance(&c, z1, safe) * outward, isinf(setup->spec.zfar) ? HUGE_VAL : setup->spec.zfar);

    errors behind = beyond;
    double step = far_step;
    if (!isinf(z_end) && z_end < 2.0 * z1) {
        const errors close = errors_over(&c, z1, z_end);
        if (total_of(&close) < total_of(&beyond))
            behind = close;
        const double w_end = real_window(&c, z_end) + total_of(&behind);
        step = smaller(step, format_step(setup, &c, larger(g + total_of(&here), w_end)));
    }
    const double projection = here.projection + behind.projection;
    double ndc = here.ndc + behind.ndc;
    ndc += larger(0.0, c.overshoot + total_of(&here) - (projection + ndc)); /* clamped ends tie as well */
    const double part[DP_CAUSE_COUNT] = {
        [DP_CAUSE_COMPOSITION] = 2.0 * composition_error(&c, z1, t.world),
        [DP_CAUSE_PROJECTION] = projection,
        [DP_CAUSE_NDC] = ndc,
        [DP_CAUSE_INTERPOLATION] = 2.0 * t.interpolation * unit,
        [DP_CAUSE_FORMAT] = step,
        [DP_CAUSE_LINEARIZATION] = t.linearize ? 2.0 * linearization_error(setup, &c, z1) : 0.0,
    };
    double sum = 0.0;
    for (int i = 0; i < DP_CAUSE_COUNT; i++)
        sum += part[i];
    out->window = sum * outward;
    out->separation = distance(&c, z1, out->window) * outward;
    for (int i = 0; i < DP_CAUSE_COUNT; i++)
        out->cause[i] = part[i] > 0.0 ? out->separation * (part[i] / sum) : 0.0;
    return DP_OK;
}
