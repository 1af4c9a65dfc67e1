/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The error of depths that are computed in binary32: no depth that the second pipeline stores is decoded, in long
 * double, farther off than is said over a range, and the worst is nearly as far.
 */
#include "core/engine.h"
#include "reference.h"
#include "reference_pipeline.h"
#include "support.h"

static const char *const formats[] = {"unorm16", "unorm24", "unorm32", "fp16", "fp32", "float8.18"};

static bool random_setup(rng *r, uint64_t i, dp_setup *out) {
    dp_format f[2];
    dp_spec spec = dp_spec_default();
    spec.model = DP_MODEL_FLOAT;
    spec.mapping = (dp_mapping)(i % 4);
    spec.ortho = rng_below(r, 4) == 0;
    spec.znear = rng_log(r, 1e-3, 10);
    spec.zfar = spec.znear * rng_log(r, 1.5, 1e7);
    if (spec.ortho && rng_below(r, 2) == 0)
        rng_planes(r, &spec.znear, &spec.zfar);
    else if (!spec.ortho && rng_below(r, 3) == 0)
        spec.zfar = INFINITY;
    spec.arith = (dp_arith)rng_below(r, dp_arith_count());
    spec.rounding = rng_below(r, 4) == 0 ? DP_ROUND_ZERO : DP_ROUND_NEAREST;
    assert_true(dp_format_parse(formats[rng_below(r, sizeof formats / sizeof formats[0])], f) > 0);
    spec.format = f[0];
    return dp_setup_init(out, &spec) == DP_OK;
}

/* Where the value of a code lies. */
static long double decoded(const dp_setup *s, uint32_t code) {
    const dp_format *f = &s->spec.format;
    const long double n = (long double)s->spec.znear, far = (long double)s->spec.zfar;
    const long double value = f->kind == DP_FORMAT_UNORM ? (long double)code / (long double)f->code_max
                                                         : (long double)dp_format_value(f, code);
    const long double t = dp_mapping_get(s->spec.mapping)->reversed ? 1 - value : value;
    const long double left = dp_mapping_get(s->spec.mapping)->reversed ? value : 1 - value;
    if (s->spec.ortho)
        return n * left + far * t;
    return isinf(s->spec.zfar) ? n / left : 1 / (left / n + t / far);
}

static double off(const dp_setup *s, const reference_pipe *p, double z) {
    const uint32_t key = reference_key(p, reference_rank(z));
    return fabs((double)(decoded(s, reference_code(p, key)) - (long double)z));
}

/* A code is farthest off where it begins or ends: the depths next to such a place between two. */
static double off_at_change(const dp_setup *s, const reference_pipe *p, double a, double b) {
    uint32_t from = reference_rank(a), to = reference_rank(b);
    const uint32_t code = reference_code(p, reference_key(p, from));
    while (to - from > 1 && to > from) {
        const uint32_t middle = from + (to - from) / 2;
        *(reference_code(p, reference_key(p, middle)) == code ? &from : &to) = middle;
    }
    return fmax(off(s, p, fmin(fmax(reference_depth(from), a), b)), off(s, p, fmin(fmax(reference_depth(to), a), b)));
}

/* The worst of some depths of a range, its end among them, and next to that. */
static double worst_off(const dp_setup *s, double lo, double hi, rng *r, int tries) {
    const reference_pipe p = reference_pipe_make(s, rng_below(r, 2) == 0);
    double worst = off(s, &p, hi);
    for (int i = 0; i < tries; i++) {
        const double from = i % 2 == 0 ? lo : fmax(lo, hi - 1e-3 * fabs(hi));
        const double z = fmin(fmax(rng_uniform(r, from, hi), lo), hi);
        worst = fmax(worst, off(s, &p, z));
        if (i % 4 == 0)
            worst = fmax(worst, off_at_change(s, &p, z, fmin(fmax(rng_uniform(r, z, hi), z), hi)));
    }
    return worst;
}

TEST(never_farther_off) {
    tally t = {.name = "no error above the bound"};
    rng r = rng_make("computed errors");
    uint64_t finite = 0;
    for (uint64_t i = test_cases(500, 4000, 200000); i > 0; i--) {
        dp_setup s;
        double where;
        if (!random_setup(&r, i, &s))
            continue;
        const double n = s.spec.znear, end = isinf(s.spec.zfar) ? 1e6 * n : s.spec.zfar;
        const double low = rng_log(&r, 1e-6, 0.06); /* window depths where steps of binary32 are fine */
        const double little = fmin(fmax(dp_eye(&s, low, 1.0 - low), n), end);
        const double hi = rng_below(&r, 8) == 0   ? end
                          : rng_below(&r, 4) == 0 ? little
                          : n > 0                 ? fmin(rng_log(&r, n, end), end)
                                                  : fmin(fmax(rng_depth(&r, n, end), n), end);
        const double lo = rng_below(&r, 4) == 0 ? n
                          : n > 0               ? fmax(n, hi / rng_log(&r, 1.00001, 10))
                                                : rng_uniform(&r, n, hi);
        const double bound = dp_computed_error_over(&s, lo, hi, &where);
        const double found = worst_off(&s, lo, hi, &r, 40);
        TALLY(&t, found <= bound && where >= lo && where <= hi,
              "%s %s%s %s near %.17g far %.17g, %.17g to %.17g: %.17g off, not %.17g", s.spec.format.name,
              dp_mapping_get(s.spec.mapping)->name, s.spec.ortho ? " ortho" : "", dp_arith_get(s.spec.arith)->name, n,
              s.spec.zfar, lo, hi, found, bound);
        finite += isfinite(bound) ? 1 : 0;
    }
    assert_true(finite > test_cases(300, 2500, 100000));
    tally_end(&t);
}

/* Around a depth the worst of many is most of what is said of them. */
TEST(nearly_as_far_off) {
    static const struct {
        const char *format;
        dp_mapping mapping;
        int ortho;
        double zfar;
        const char *arith;
    } cases[] = {{"unorm24", DP_MAPPING_D3D, 0, 1000, NULL},
                 {"unorm24", DP_MAPPING_REVERSED, 0, 1000, NULL},
                 {"fp32", DP_MAPPING_D3D, 0, 1000, NULL},
                 {"fp32", DP_MAPPING_REVERSED, 0, 1000, NULL},
                 {"unorm16", DP_MAPPING_GL, 0, INFINITY, NULL},
                 {"fp16", DP_MAPPING_REVERSED, 0, INFINITY, NULL},
                 {"unorm24", DP_MAPPING_GL_REVERSED, 0, 1000, NULL},
                 {"unorm24", DP_MAPPING_D3D, 1, 1000, NULL},
                 {"unorm24", DP_MAPPING_D3D, 0, 1000, "product"},
                 {"unorm24", DP_MAPPING_REVERSED, 0, 1000, "product"}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        dp_format f[2];
        dp_spec spec = dp_spec_default();
        dp_setup s;
        double most = 0, least = INFINITY;
        spec.model = DP_MODEL_FLOAT;
        spec.mapping = cases[i].mapping;
        spec.ortho = cases[i].ortho;
        spec.zfar = cases[i].zfar;
        if (cases[i].arith != NULL)
            assert_int_equal(dp_arith_parse(cases[i].arith, &spec.arith), DP_OK);
        assert_true(dp_format_parse(cases[i].format, f) > 0);
        spec.format = f[0];
        assert_int_equal(dp_setup_init(&s, &spec), DP_OK);
        const reference_pipe p = reference_pipe_make(&s, false);
        for (double z = 0.3; z < 900; z *= 1.37) {
            double where, worst = 0, hi = z * 1.002;
            for (int k = 0; k <= 20000; k++)
                worst = fmax(worst, off(&s, &p, z + (hi - z) * k / 20000));
            const double share = worst / dp_computed_error_over(&s, z, hi, &where);
            most = fmax(most, share);
            least = fmin(least, share);
        }
        printf("# %s %s%s%s%s: %.3f to %.3f of the bound found\n", spec.format.name, dp_mapping_get(spec.mapping)->name,
               spec.ortho ? " ortho" : "", cases[i].arith != NULL ? " " : "",
               cases[i].arith != NULL ? cases[i].arith : "", least, most);
        assert_true(most <= 1 && most > 0.7 && least > 0.3);
    }
}
