/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The budget of a logarithmic depth: no log2 that the language allows stores two surfaces a separation apart in the
 * wrong order or alike, and some log2 does so nearly that far. The shaders are written here from the sources of the
 * engines; log2 and the divisions, which a language only bounds, are taken at either end of what it allows, by MPFR.
 */

#include <mpfr.h>

#include "depthprec/depthprec.h"
#include "nvidia.h"
#include "quantity/quantity.h"
#include "support.h"

enum { BITS = 256, RULES = 3 };

/* Additions and products of a shader round once. */
static float sum(float a, float b) {
    volatile float r = a + b;
    return r;
}

static float product(float a, float b) {
    volatile float r = a * b;
    return r;
}

/* a b + c, which a compiler may fuse. */
static float product_sum(float a, float b, float c, bool fused) {
    return fused ? fmaf(a, b, c) : sum(product(a, b), c);
}

static float quotient(float a, float b) {
    volatile float r = a / b;
    return r;
}

/* A unit in the last place of binary32 at x. */
static void ulp_at(mpfr_t out, const mpfr_t x) {
    mpfr_set_ui_2exp(out, 1, mpfr_zero_p(x) ? -149 : mpfr_get_exp(x) - 24, MPFR_RNDN);
}

/* The last binary32 number within `off` of x, towards `sign`. */
static float last_within(const mpfr_t x, const mpfr_t off, int sign) {
    mpfr_t end;
    mpfr_init2(end, BITS);
    if (sign > 0)
        mpfr_add(end, x, off, MPFR_RNDD);
    else
        mpfr_sub(end, x, off, MPFR_RNDU);
    const float f = mpfr_get_flt(end, sign > 0 ? MPFR_RNDD : MPFR_RNDU);
    mpfr_clear(end);
    return f;
}

/* log2 of a binary32 number, as high or as low as the rule lets it be; 0: the nearest. */
static float log2_by(int rule, float x, int sign) {
    mpfr_t l, off, ulp;
    mpfr_inits2(BITS, l, off, ulp, (mpfr_ptr)0);
    mpfr_set_flt(l, x, MPFR_RNDN);
    mpfr_log2(l, l, MPFR_RNDN);
    ulp_at(ulp, l);
    if (rule == 2 || sign == 0) {
        mpfr_div_2ui(off, ulp, 1, MPFR_RNDN);
    } else if (x >= 0.5F && x <= 2.0F) {
        mpfr_set_ui_2exp(off, 1, -21, MPFR_RNDN);
        mpfr_sub_d(off, off, 0x1p-100, MPFR_RNDN); /* GLSL: below it */
    } else if (rule == 0) {
        mpfr_mul_ui(off, ulp, 3, MPFR_RNDN);
    } else {
        mpfr_mul_2si(off, l, -21, MPFR_RNDN);
    }
    const float f = rule == 2 || sign == 0 ? mpfr_get_flt(l, MPFR_RNDN) : last_within(l, off, sign);
    mpfr_clears(l, off, ulp, (mpfr_ptr)0);
    return f;
}

/* a/b within 2.5 units in the last place. */
static float divided(float a, float b, int sign) {
    mpfr_t q, off;
    mpfr_inits2(BITS, q, off, (mpfr_ptr)0);
    mpfr_set_flt(q, a, MPFR_RNDN);
    mpfr_set_flt(off, b, MPFR_RNDN);
    mpfr_div(q, q, off, MPFR_RNDN);
    ulp_at(off, q);
    mpfr_mul_d(off, off, 2.5, MPFR_RNDN);
    const float f = last_within(q, off, sign);
    mpfr_clears(q, off, (mpfr_ptr)0);
    return f;
}

/* A set-up with what the program hands its shader. */
typedef struct shader {
    dp_setup setup;
    const dp_arith_row *arith;
    int rule;
    float near, far, c, k;
    float top;     /* three-webgpu: what it makes of log2(far/near) */
    bool fused[2]; /* does it fuse, for the nearer surface and for the farther one: two materials are two shaders */
} shader;

/* 1/log2 of the argument at far, rounded once; per vertex twice that, which is exact. */
static float constant_of(const dp_spec *s) {
    mpfr_t x, one;
    mpfr_inits2(BITS, x, one, (mpfr_ptr)0);
    mpfr_set_d(x, s->zfar, MPFR_RNDN);
    if (s->mapping == DP_MAPPING_CESIUM)
        mpfr_sub_d(x, x, s->znear, MPFR_RNDN);
    mpfr_mul_d(x, x, s->log_c, MPFR_RNDN);
    mpfr_log1p(x, x, MPFR_RNDN);
    mpfr_const_log2(one, MPFR_RNDN);
    mpfr_div(x, one, x, MPFR_RNDN);
    const float k = mpfr_get_flt(x, MPFR_RNDN);
    mpfr_clears(x, one, (mpfr_ptr)0);
    return k;
}

static shader shader_of(const dp_spec *spec, int rule, int top) {
    shader s = {.arith = dp_arith_get(spec->arith), .rule = rule};
    assert_int_equal(dp_setup_init(&s.setup, spec), DP_OK);
    s.near = (float)spec->znear;
    s.far = (float)spec->zfar;
    s.c = (float)spec->log_c;
    s.k = constant_of(spec);
    s.top = log2_by(rule, top == 0 ? quotient(s.far, s.near) : divided(s.far, s.near, top), top);
    return s;
}

/* The window depth that is written for w, as high (sign 1) or as low (-1) as it may be. */
static float written(const shader *s, float w, int sign) {
    const dp_mapping m = s->setup.spec.mapping;
    if (m == DP_MAPPING_THREE_WEBGPU)
        return divided(log2_by(s->rule, divided(w, s->near, sign), sign), s->top, sign);
    const float from = m == DP_MAPPING_CESIUM ? sum(w, -s->near) : w;
    const bool fused = s->fused[sign < 0];
    const float l = log2_by(s->rule, product_sum(s->c, from, 1.0F, fused), sign);
    if (m != DP_MAPPING_OSGEARTH)
        return product(l, s->k);
    float clip = product(product_sum(l, 2.0F * s->k, -1.0F, fused), w);
    if (s->arith->remap)
        clip = product(sum(clip, w), 0.5F);
    const float ndc = s->arith->reciprocal == DP_RECIPROCAL_UNIT ? product(clip, dp_reciprocal_unit(w))
                      : s->arith->reciprocal                     ? product(clip, quotient(1.0F, w))
                                                                 : quotient(clip, w);
    return s->arith->remap ? ndc : sum(product(0.5F, ndc), 0.5F);
}

/* The stored value: a code of a UNORM, the value of a float, which is as good to compare. */
static double stored(const shader *s, float d) {
    const dp_format *f = &s->setup.spec.format;
    const float x = d > 0.0F ? (d < 1.0F ? d : 1.0F) : 0.0F;
    const double most = (double)f->code_max;
    if (f->kind == DP_FORMAT_FLOAT) {
        const int lowest = 1 - f->bias, own = x > 0.0F ? ilogb((double)x) : lowest;
        const double step = ldexp(1.0, (own > lowest ? own : lowest) - f->mantissa_bits);
        return rint((double)x / step) * step;
    }
    if (s->arith->conversion == DP_CONVERT_SIXTEENTHS)
        return nvidia_code(f->bits, x);
    if (s->arith->conversion == DP_CONVERT_EXACT)
        return floor((double)x * most + 0.5); /* 24 bits by at most 24 */
    const double p = (double)product(x, (float)f->code_max);
    return fmin(s->arith->conversion == DP_CONVERT_PRODUCT_ZERO ? trunc(p) : rint(p), most);
}

/* May a surface that enters at z2 be stored no farther than one at z1? */
static bool fails(const shader *s, float z1, float z2) {
    return stored(s, written(s, z1, 1)) >= stored(s, written(s, z2, -1));
}

/* ---- Set-ups ----------------------------------------------------------------------------------------------------- */

static const dp_mapping mappings[] = {DP_MAPPING_LOG, DP_MAPPING_THREE_WEBGL, DP_MAPPING_THREE_WEBGPU,
                                      DP_MAPPING_CESIUM, DP_MAPPING_OSGEARTH};
enum { MAPPINGS = sizeof mappings / sizeof mappings[0] };

static dp_spec spec_of(dp_mapping mapping, const char *format, double n, double f) {
    dp_spec spec = dp_spec_default();
    dp_format found[2];
    assert_true(dp_format_parse(format, found) >= 1);
    spec.format = found[0];
    spec.mapping = mapping;
    spec.znear = n;
    spec.zfar = f;
    return spec;
}

static dp_spec random_spec(rng *r, uint64_t i) {
    static const char *const formats[] = {"unorm24", "fp32", "unorm16", "fp16", "unorm24"};
    const double n = rng_log(r, 1e-3, 10);
    dp_spec spec = spec_of(mappings[i % MAPPINGS], formats[rng_below(r, 5)], n, n * rng_log(r, 3, 1e11));
    spec.arith = rng_below(r, dp_arith_count());
    if ((spec.mapping == DP_MAPPING_LOG || spec.mapping == DP_MAPPING_CESIUM) && rng_below(r, 2) == 0)
        spec.log_c = rng_below(r, 2) == 0 ? 0x1p-10 : rng_log(r, 1e-4, 1e3);
    return spec;
}

/* Where the logarithm's argument is that. */
static double depth_of(const dp_spec *s, double argument) {
    const double from = s->mapping == DP_MAPPING_CESIUM ? s->znear : 0.0;
    return s->mapping == DP_MAPPING_THREE_WEBGPU ? argument * s->znear : (argument - 1.0) / s->log_c + from;
}

/* One where the logarithm is a power of 2, where its units double. */
static double random_power(rng *r) {
    return ldexp(1.0, 1 << rng_below(r, 6));
}

/* A depth: anywhere, at the near plane, or next to such an argument. */
static double random_depth(rng *r, const dp_spec *s) {
    const double z = rng_log(r, s->znear, s->zfar);
    const double there = depth_of(s, random_power(r) * (1.0 + rng_uniform(r, -1e-5, 1e-7)));
    switch (rng_below(r, 4)) {
    case 0:
        return there >= s->znear && there <= s->zfar ? there : z;
    case 1:
        return fmin(s->znear * (1.0 + rng_log(r, 1e-9, 1.0)), s->zfar);
    default:
        return z;
    }
}

static dp_budget budget_of(const shader *s, double z) {
    const dp_budget_terms terms = {.log2 = (dp_log2_rule)s->rule};
    dp_budget b;
    assert_int_equal(dp_budget_at(&s->setup, z, &terms, &b), DP_OK);
    return b;
}

/* ---- Never violated ---------------------------------------------------------------------------------------------- */

static void check_pairs(rng *r, tally *t, const shader *s, double z) {
    const dp_spec *spec = &s->setup.spec;
    const float z1 = (float)z;
    /* The last real surface that enters at z1. */
    const double real = nextafter(((double)z1 + (double)nextafterf(z1, HUGE_VALF)) / 2, 0.0);
    const double from = fmin(fmax(real, spec->znear), spec->zfar);
    const dp_budget b = budget_of(s, from);
    for (int i = 0; i < 6; i++) {
        const double behind = from + b.separation * (i == 0 ? 1.0 : 1.0 + rng_log(r, 1e-7, 30.0));
        if (!(behind <= spec->zfar))
            continue;
        TALLY(t, !fails(s, (float)from, (float)behind),
              "%s %s C %.17g near %.17g far %.17g %s %s: %.17g and %.17g, %g behind",
              dp_mapping_get(spec->mapping)->name, spec->format.name, spec->log_c, spec->znear, spec->zfar,
              s->arith->name, dp_log2_get((dp_log2_rule)s->rule)->name, from, behind, behind - from);
    }
}

TEST(never_violated) {
    tally t = {.name = "never violated"};
    rng r = rng_make("log budget");
    for (uint64_t i = test_cases(300, 1500, 200000); i > 0; i--) {
        const dp_spec spec = random_spec(&r, i);
        shader s = shader_of(&spec, (int)rng_below(&r, RULES), (int)rng_below(&r, 3) - 1);
        s.fused[0] = rng_below(&r, 2) == 0;
        s.fused[1] = rng_below(&r, 2) == 0;
        for (int k = 0; k < 5; k++)
            check_pairs(&r, &t, &s, random_depth(&r, &spec));
        const double there = depth_of(&spec, random_power(&r));
        if (!(there > spec.znear && there < spec.zfar))
            continue;
        /* Where all that is behind by less than the separation lies on either side of it. */
        const double wide = budget_of(&s, there).separation;
        for (int k = 0; k < 5; k++)
            check_pairs(&r, &t, &s, fmax(there - rng_uniform(&r, 0.3, 1.0) * wide, spec.znear));
    }
    tally_end(&t);
}

/* ---- Not slack --------------------------------------------------------------------------------------------------- */

/* The farthest real surfaces found next to z that may share their code or swap. */
static double farthest(rng *r, const shader *s, double z, double most) {
    const double wide = fmax(1e-4 * z, fmin(1.5 * most, 0.2 * z)); /* all of a cell, where cells are wide */
    double best = 0.0;
    for (int i = 0; i < 100; i++) {
        const float z1 = (float)(z + rng_uniform(r, -1.0, 1.0) * wide);
        if (!((double)z1 >= s->setup.spec.znear) || !((double)z1 + most <= s->setup.spec.zfar))
            continue;
        double in = 0.0, out = 1.1 * most;
        for (int k = 0; k < 24; k++) {
            const double middle = (in + out) / 2;
            if (fails(s, z1, (float)((double)z1 + middle)))
                in = middle;
            else
                out = middle;
        }
        const float z2 = (float)((double)z1 + in);
        best = fmax(best, ((double)z2 + (double)nextafterf(z2, HUGE_VALF)) / 2 -
                              ((double)z1 + (double)nextafterf(z1, 0.0F)) / 2);
    }
    return best;
}

typedef struct slack {
    double worst, total, rounded;
    uint64_t count;
} slack;

static void add_slack(slack *s, const dp_budget *b, double found, int rule) {
    const double ratio = b->separation / found;
    if (rule < 2) {
        s->worst = fmax(s->worst, ratio);
        s->total += ratio;
        s->count++;
    } else {
        s->rounded = fmax(s->rounded, ratio);
    }
}

TEST(not_slack) {
    static const double worst[2] = {2.0, 3.0}, average[2] = {1.15, 1.45}; /* per fragment, per vertex */
    static const double rounded = 5.0;                                    /* hardly all roundings fall badly at once */
    slack all[MAPPINGS] = {0};
    rng r = rng_make("log slack");
    for (uint64_t i = test_cases(50, 150, 5000); i > 0; i--) {
        dp_spec spec = random_spec(&r, i);
        spec.zfar = fmax(spec.zfar, 100 * spec.znear);
        const int rule = (int)rng_below(&r, RULES);
        const double z = rng_log(&r, 1.1 * spec.znear, 0.5 * spec.zfar);
        double found = 0.0;
        dp_budget b = {0};
        for (int top = -1; top <= 1; top += 2) {
            const shader s = shader_of(&spec, rule, top);
            b = budget_of(&s, z);
            found = fmax(found, farthest(&r, &s, z, b.separation));
        }
        if (z + 2 * b.separation <= spec.zfar && b.separation < 0.5 * z) /* else hardly any cell is there to be met */
            add_slack(&all[i % MAPPINGS], &b, found, rule);
    }
    for (size_t m = 0; m < MAPPINGS; m++) {
        const bool vertex = mappings[m] == DP_MAPPING_OSGEARTH;
        printf("# %s: bound over found %.3f on average, at most %.3f; log2 rounded at most %.3f\n",
               dp_mapping_get(mappings[m])->name, all[m].total / (double)all[m].count, all[m].worst, all[m].rounded);
        if (test_effort() == EFFORT_QUICK) /* an average of few */
            continue;
        assert_true(all[m].worst <= worst[vertex] && all[m].total <= average[vertex] * (double)all[m].count);
        assert_true(all[m].rounded <= rounded);
    }
}

/*
 * Where a cause takes much: less half of its part, the bound is exceeded. Less all of it, where roundings hardly fall
 * badly at once: w cancels in fl(t w)/w but for a unit of t, and products with C lie on a coarse lattice.
 */
static const struct {
    dp_cause cause;
    dp_mapping mapping;
    const char *format, *arith;
    int rule;
    double lo, hi; /* depths */
    double share;  /* of the cause that is left out */
} needs[] = {
    {DP_CAUSE_FORMAT, DP_MAPPING_THREE_WEBGL, "unorm16", "ieee", 0, 0.2, 500, 0.5},
    {DP_CAUSE_FORMAT, DP_MAPPING_THREE_WEBGPU, "fp16", "ieee", 0, 0.2, 500, 0.5},
    {DP_CAUSE_FORMAT, DP_MAPPING_OSGEARTH, "unorm16", "ieee", 0, 0.2, 500, 0.5},
    {DP_CAUSE_LOG2, DP_MAPPING_LOG, "fp32", "ieee", 0, 0.2, 0.9, 0.5},
    {DP_CAUSE_LOG2, DP_MAPPING_CESIUM, "fp32", "ieee", 0, 2, 500, 0.5},
    {DP_CAUSE_LOG2, DP_MAPPING_THREE_WEBGPU, "unorm24", "ieee", 0, 0.2, 500, 0.5},
    {DP_CAUSE_LOG2, DP_MAPPING_CESIUM, "fp32", "ieee", 1, 2, 500, 0.5},
    {DP_CAUSE_LOG2, DP_MAPPING_OSGEARTH, "fp32", "ieee", 1, 2, 500, 0.5},
    {DP_CAUSE_LOG2, DP_MAPPING_THREE_WEBGL, "fp32", "ieee", 2, 2, 500, 0.5},
    {DP_CAUSE_ARGUMENT, DP_MAPPING_LOG, "fp32", "ieee", 2, 6.7, 7, 1.0},
    {DP_CAUSE_ARGUMENT, DP_MAPPING_THREE_WEBGL, "fp32", "ieee", 2, 0.2, 0.9, 0.5},
    {DP_CAUSE_ARGUMENT, DP_MAPPING_CESIUM, "fp32", "ieee", 2, 0.25, 0.9, 0.5},
    {DP_CAUSE_ARGUMENT, DP_MAPPING_THREE_WEBGPU, "fp32", "ieee", 2, 0.2, 500, 0.5},
    {DP_CAUSE_SCALE, DP_MAPPING_THREE_WEBGL, "fp32", "ieee", 2, 2, 500, 0.5},
    {DP_CAUSE_SCALE, DP_MAPPING_THREE_WEBGPU, "fp32", "ieee", 2, 2, 500, 0.5},
    {DP_CAUSE_NDC, DP_MAPPING_OSGEARTH, "unorm24", "ieee-remap", 2, 0.2, 500, 1.0},
    {DP_CAUSE_NDC, DP_MAPPING_OSGEARTH, "fp32", "mesa", 2, 0.2, 2, 1.0},
};

TEST(each_needed) {
    tally t = {.name = "each needed"};
    rng r = rng_make("log causes");
    for (size_t i = 0; i < sizeof needs / sizeof needs[0]; i++) {
        dp_spec spec = spec_of(needs[i].mapping, needs[i].format, 0.1, 1000);
        spec.log_c = needs[i].mapping == DP_MAPPING_LOG ? 0.3 : 1.0;
        assert_int_equal(dp_arith_parse(needs[i].arith, &spec.arith), DP_OK);
        double most = 0.0;
        for (int k = 0; k < 60 && most <= 1.0; k++) {
            const shader s = shader_of(&spec, needs[i].rule, k % 2 == 0 ? 1 : -1);
            const double z = rng_log(&r, needs[i].lo, needs[i].hi);
            const dp_budget b = budget_of(&s, z);
            const double found = farthest(&r, &s, z, b.separation);
            most = fmax(most, found / (b.separation - needs[i].share * b.cause[needs[i].cause]));
            const double around = fmax(budget_of(&s, 0.9999 * z).separation, budget_of(&s, 1.0001 * z).separation);
            TALLY(&t, found <= fmax(b.separation, around) || strcmp(spec.format.name, "fp32") != 0,
                  "%s, z %.17g: %.9g, not within %.9g", dp_mapping_get(spec.mapping)->name, z, found, b.separation);
        }
        TALLY(&t, most > 1.0, "%s %s rule %d, z from %g: %s could be less, %g", dp_mapping_get(spec.mapping)->name,
              spec.format.name, needs[i].rule, needs[i].lo, dp_cause_name(needs[i].cause), most);
    }
    tally_end(&t);
}

/* ---- The error --------------------------------------------------------------------------------------------------- */

/* A depth as it is read back, with the constants that wrote it; three-webgpu's ratio as it really is. */
static long double read_back(const shader *s, double code) {
    const dp_format *f = &s->setup.spec.format;
    const long double d = (long double)code / (f->kind == DP_FORMAT_FLOAT ? 1 : (long double)f->code_max);
    if (s->setup.spec.mapping == DP_MAPPING_THREE_WEBGPU)
        return (long double)s->near * exp2l(d * log2l((long double)s->far / (long double)s->near));
    const long double from = s->setup.spec.mapping == DP_MAPPING_CESIUM ? (long double)s->near : 0;
    return from + expm1l(d / (long double)s->k * logl(2)) / (long double)s->c;
}

/* The worst that any log2 does to the depths next to z. */
static double worst_read(const shader *s, double z, double wide, rng *r, int tries) {
    double worst = 0;
    for (int i = 0; i < tries; i++) {
        const double real = fmin(fmax(z + (i == 0 ? 0 : rng_uniform(r, -wide, 0)), s->setup.spec.znear), z);
        for (int sign = -1; sign <= 1; sign += 2)
            worst =
                fmax(worst, fabs((double)(read_back(s, stored(s, written(s, (float)real, sign))) - (long double)real)));
    }
    return worst;
}

/* No depth of a range is read back farther off than is said, and some nearly as far. */
TEST(errors) {
    tally never = {.name = "no error above the bound"};
    rng r = rng_make("log errors");
    double closest[MAPPINGS] = {0};
    for (uint64_t i = test_cases(100, 600, 20000); i > 0; i--) {
        const dp_spec spec = random_spec(&r, i);
        const double z = rng_below(&r, 8) == 0 ? spec.zfar : random_depth(&r, &spec),
                     lo = fmax(spec.znear, z / rng_log(&r, 1.0001, 100.0));
        dp_setup asked;
        dp_spec model = spec;
        model.model = DP_MODEL_FLOAT;
        assert_int_equal(quantity_setup(&model, &asked), DP_OK);
        const quantity_worst range = quantity_over(QUANTITY_ERROR, &asked, lo, z, NAN),
                             here = quantity_over(QUANTITY_ERROR, &asked, z, z, NAN);
        for (int top = -1; top <= 1; top++) {
            shader s = shader_of(&spec, 0, top);
            s.fused[0] = s.fused[1] = rng_below(&r, 2) == 0;
            const double at = worst_read(&s, z, 0, &r, 1), next = worst_read(&s, z, fmin(1e-3 * z, z - lo), &r, 40);
            TALLY(&never, at <= here.value && next <= range.value && here.value <= range.value * (1 + 1e-9),
                  "%s %s C %.17g near %.17g far %.17g %s: %.17g off at %.17g, not %.17g; %.17g over a range, not %.17g",
                  dp_mapping_get(spec.mapping)->name, spec.format.name, spec.log_c, spec.znear, spec.zfar,
                  s.arith->name, at, z, here.value, next, range.value);
            if (here.value < 0.1 * z)
                closest[i % MAPPINGS] = fmax(closest[i % MAPPINGS], next / here.value);
        }
        TALLY(&never,
              range.z >= lo && range.z <= z &&
                  quantity_over(QUANTITY_ERROR, &asked, range.z, range.z, NAN).value <= range.value * (1 + 1e-9),
              "%.17g to %.17g: worst at %.17g", lo, z, range.z);
    }
    for (size_t m = 0; m < MAPPINGS; m++) {
        printf("# %s: found up to %.3f of the bound\n", dp_mapping_get(mappings[m])->name, closest[m]);
        assert_true(closest[m] > 0.7);
    }
    tally_end(&never);
}

/* ---- Codes ------------------------------------------------------------------------------------------------------- */

/* Whatever log2 stores is among the codes that are said, and those are hardly more. Codes of 32 bits show all that
 * binary32 rounds. */
static void check_codes(tally *t, const shader *s, float z) {
    const dp_spec *spec = &s->setup.spec;
    uint32_t lowest, highest;
    if ((double)z < spec->znear || (double)z > spec->zfar)
        return;
    assert_int_equal(dp_code_range(&s->setup, (double)z, &lowest, &highest), DP_OK);
    const uint32_t low = (uint32_t)stored(s, written(s, z, -1)), high = (uint32_t)stored(s, written(s, z, 1));
    TALLY(t, lowest <= low && high <= highest, "%s near %.17g far %.17g, %.9g: %u to %u, not %u to %u",
          dp_mapping_get(spec->mapping)->name, spec->znear, spec->zfar, (double)z, low, high, lowest, highest);
    if (spec->mapping == DP_MAPPING_THREE_WEBGL && spec->format.bits == 24)
        TALLY(t, highest - lowest <= 2 * (high - low) + 8, "far %.17g, %.9g: %u to %u, not %u to %u", spec->zfar,
              (double)z, low, high, lowest, highest);
}

TEST(code_range) {
    tally t = {.name = "code range"};
    rng r = rng_make("log codes");
    for (uint64_t i = test_cases(200, 3000, 100000); i > 0; i--) {
        dp_spec spec = random_spec(&r, i);
        const bool fine = rng_below(&r, 2) == 0;
        spec.format = spec_of(spec.mapping, fine ? "unorm32" : "unorm24", 1, 2).format;
        if (fine) { /* what log2 may be off by hides least where far is far away */
            spec.zfar = spec.znear * rng_log(&r, 1e6, 1e11);
            while (dp_arith_get(spec.arith)->conversion != DP_CONVERT_EXACT)
                spec.arith = rng_below(&r, dp_arith_count());
        }
        const shader s = shader_of(&spec, 0, (int)rng_below(&r, 3) - 1);
        for (int k = fine ? 8 : 1; k > 0; k--)
            check_codes(&t, &s, (float)random_depth(&r, &spec));
    }
    tally_end(&t);
}

/*
 * At far 1e9 three units of log2 are 3.2 codes of 24 bits from 65535 on, where the logarithm is in [16, 32): that is
 * what one depth may be off by. Of two surfaces both are, so their separation has twice as much.
 */
TEST(codes_at_1e9) {
    const dp_spec spec = spec_of(DP_MAPPING_THREE_WEBGL, "unorm24", 0.1, 1e9);
    const shader s = shader_of(&spec, 0, 0);
    const double codes = 3 * 0x1p-19 / log2(1 + 1e9) * 0xFFFFFF;
    double most = 0.0;
    assert_relative(codes, 3.2, 0.01);
    for (double z = 65536; z < 9e8; z *= 1.37) {
        const float w = (float)z;
        const double real = log2(1 + (double)w);
        for (int sign = -1; sign <= 1; sign += 2) {
            const float l = log2_by(0, sum(1.0F, w), sign);
            most = fmax(most, sign * ((double)l - real) / log2(1 + 1e9) * 0xFFFFFF);
        }
        const dp_budget b = budget_of(&s, z);
        const double per_code = (1 + z) * log(1 + 1e9) / 0xFFFFFF; /* scene units */
        assert_relative(b.cause[DP_CAUSE_LOG2] / per_code, 2 * codes, 0.02);
    }
    assert_true(most > 0.9 * codes && most <= codes * (1 + 1e-6));
}

/* ---- Over a range ------------------------------------------------------------------------------------------------ */

/*
 * What is guaranteed over a range is never violated at any depth of it, is hardly more than what the worst depth found
 * needs, and is what the budget says there; that of another depth may be above it by 4 % and a step of binary32.
 */
TEST(over_ranges) {
    tally never = {.name = "never violated over a range"};
    tally tight = {.name = "hardly above the worst depth"};
    tally about = {.name = "not far below any depth"};
    rng r = rng_make("log ranges");
    for (uint64_t i = test_cases(100, 500, 50000); i > 0; i--) {
        const dp_spec spec = random_spec(&r, i);
        const shader s = shader_of(&spec, 0, (int)rng_below(&r, 3) - 1);
        const dp_setup full = dp_setup_guaranteed(&s.setup);
        const double a = random_depth(&r, &spec), b = fmin(a * rng_log(&r, 1.0 + 1e-6, 1e3), spec.zfar);
        dp_separation_worst w;
        dp_spec staged = spec; /* whose codes it keeps */
        dp_setup lattice;
        staged.model = DP_MODEL_STAGED;
        assert_int_equal(dp_setup_init(&lattice, &staged), DP_OK);
        assert_int_equal(dp_code(&full, a), dp_code(&lattice, a));
        assert_int_equal(dp_separation_over(&full, a, b, 0.0, &w), DP_OK);
        TALLY(&tight, w.bound <= w.separation * (1.0 + 0x1p-9), "%.17g to %.17g: %g above %g", a, b, w.bound,
              w.separation);
        assert_true(dp_separation(&full, w.z) == budget_of(&s, w.z).separation);
        for (int k = 0; k < 12; k++) {
            const double z = k < 2 ? (k == 0 ? a : b) : fmin(fmax(random_depth(&r, &spec), a), b);
            const double inside = k < 6 ? z : rng_uniform(&r, a, b);
            const double behind = inside + w.bound * (k % 2 ? 1.0 : 1.0 + rng_log(&r, 1e-7, 30.0));
            const double step = (double)nextafterf((float)b, HUGE_VALF) - (double)(float)b;
            TALLY(&about, budget_of(&s, inside).separation <= w.bound * 1.04 + step, "%s at %.17g: %g, not %g",
                  dp_mapping_get(spec.mapping)->name, inside, budget_of(&s, inside).separation, w.bound);
            if (behind <= spec.zfar)
                TALLY(&never, !fails(&s, (float)inside, (float)behind), "%s %s C %.17g near %.17g far %.17g: %.17g, %g",
                      dp_mapping_get(spec.mapping)->name, spec.format.name, spec.log_c, spec.znear, spec.zfar, inside,
                      w.bound);
        }
    }
    tally_end(&never);
    tally_end(&tight);
    tally_end(&about);
}
