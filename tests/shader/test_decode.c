/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Decoding rows: the exact values against rationals and MPFR, the binary32 rows against their bounds, and the sky. */
#include <float.h>

#include "core/elementary.h"
#include "named.h"
#include "oracle.h"
#include "shader/decode.h"
#include "support.h"

/* Every curve and direction, both projections, finite and infinite far planes. */
static dp_spec random_spec(rng *r) {
    dp_spec spec = dp_spec_default();
    spec.mapping = (dp_mapping)rng_below(r, DP_MAPPING_COUNT);
    const dp_mapping_row *row = dp_mapping_get(spec.mapping);
    spec.ortho = row->ortho && rng_below(r, 3) == 0;
    spec.znear = rng_log(r, 1e-12, 1e5);
    spec.zfar = spec.znear * (1 + rng_log(r, 1e-4, 1e12));
    if (row->far_infinite && !spec.ortho && rng_below(r, 6) == 0)
        spec.zfar = INFINITY;
    spec.log_c = rng_log(r, 1e-3, 1e3) / spec.znear;
    if (spec.log_c > 1e12)
        spec.log_c = 1e12;
    if (spec.ortho && rng_below(r, 2))
        rng_planes(r, &spec.znear, &spec.zfar);
    if (spec.zfar == 0) /* shares of which there are none */
        spec.zfar = -spec.znear;
    return spec;
}

static double random_window(rng *r) {
    const double away = rng_log(r, 1e-12, 1);
    switch (rng_below(r, 6)) {
    case 0:
        return rng_unit(r);
    case 1:
        return 0;
    case 2:
        return 1;
    case 3:
        return away;
    default:
        return 1 - away;
    }
}

/* What d was before a viewport moved it into its depth range; beyond an end it is that. */
static void undone(const dp_spec *s, double d, mpq_t t) {
    mpq_t lo, by;
    mpq_inits(lo, by, NULL);
    mpq_set_d(lo, (double)(float)s->depth_range[0]);
    mpq_set_d(by, s->depth_range[0] == s->depth_range[1] ? 1 : (double)(float)s->depth_range[1]); /* both 0: 0 and 1 */
    mpq_sub(by, by, lo);
    mpq_set_d(t, d);
    mpq_sub(t, t, lo);
    mpq_div(t, t, by);
    if (mpq_sgn(t) < 0)
        mpq_set_ui(t, 0, 1);
    if (mpq_cmp_ui(t, 1, 1) > 0)
        mpq_set_ui(t, 1, 1);
    mpq_clears(lo, by, NULL);
}

/* z(d) of the mappings that are rational, from 1/z = q/n + d/f and its like, and the two shares. */
static void rational(const dp_spec *s, double d, decode_quantity quantity, mpq_t out) {
    mpq_t n, f, t, q, x;
    mpq_inits(n, f, t, q, x, NULL);
    mpq_set_d(n, s->znear);
    undone(s, d, t);
    if (dp_mapping_get(s->mapping)->reversed) { /* t: share of the way to the far plane */
        mpq_set_ui(x, 1, 1);
        mpq_sub(t, x, t);
    }
    mpq_set_ui(x, 1, 1);
    mpq_sub(q, x, t);
    if (isinf(s->zfar)) {
        mpq_div(out, n, q);
    } else {
        mpq_set_d(f, s->zfar);
        if (s->mapping == DP_MAPPING_LINEAR) {
            mpq_mul(out, f, t);
        } else if (s->ortho) {
            mpq_mul(out, n, q);
            mpq_mul(x, f, t);
            mpq_add(out, out, x);
        } else {
            mpq_mul(out, f, q);
            mpq_mul(x, n, t);
            mpq_add(out, out, x);
            mpq_mul(x, n, f);
            mpq_div(out, x, out);
        }
        if (quantity == DECODE_01) {
            mpq_div(out, out, f);
        } else if (quantity == DECODE_01_NEAR) {
            mpq_sub(out, out, n);
            mpq_sub(x, f, n);
            mpq_div(out, out, x);
        }
    }
    mpq_clears(n, f, t, q, x, NULL);
}

/* The logarithmic ones with 300 bits: a + ((C (f - a) + 1)^d - 1)/C from 0 or from near; and n (f/n)^d. */
static void logarithmic(const dp_spec *s, double d, decode_quantity quantity, mpq_t out) {
    const bool over_near = s->mapping == DP_MAPPING_THREE_WEBGPU,
               from_near = over_near || s->mapping == DP_MAPPING_CESIUM;
    mpfr_t a, b, c;
    mpfr_inits2(300, a, b, c, (mpfr_ptr)NULL);
    mpfr_set_d(c, s->log_c, MPFR_RNDN);
    if (over_near)
        mpfr_d_div(c, 1, (mpfr_set_d(b, s->znear, MPFR_RNDN), b), MPFR_RNDN);
    mpfr_set_d(a, s->zfar, MPFR_RNDN);
    if (from_near)
        mpfr_sub_d(a, a, s->znear, MPFR_RNDN);
    mpfr_mul(a, a, c, MPFR_RNDN);
    mpfr_log1p(a, a, MPFR_RNDN);
    mpfr_mul_d(a, a, d, MPFR_RNDN);
    mpfr_expm1(a, a, MPFR_RNDN);
    mpfr_div(a, a, c, MPFR_RNDN);
    if (from_near)
        mpfr_add_d(a, a, s->znear, MPFR_RNDN);
    if (quantity == DECODE_01)
        mpfr_div_d(a, a, s->zfar, MPFR_RNDN);
    if (quantity == DECODE_01_NEAR) {
        mpfr_sub_d(a, a, s->znear, MPFR_RNDN);
        mpfr_set_d(b, s->zfar, MPFR_RNDN);
        mpfr_sub_d(b, b, s->znear, MPFR_RNDN);
        mpfr_div(a, a, b, MPFR_RNDN);
    }
    mpfr_get_q(out, a);
    mpfr_clears(a, b, c, (mpfr_ptr)NULL);
}

TEST(exact_is_exact) {
    rng r = rng_make("exact");
    tally t = {.name = "exact"};
    mpq_t want;
    mpq_init(want);
    double worst = 0;
    for (uint64_t k = test_cases(2000, 20000, 300000); k > 0; k--) {
        dp_spec spec = random_spec(&r);
        double d = random_window(&r);
        const decode_quantity quantity = (decode_quantity)rng_below(&r, DECODE_QUANTITIES);
        char text[512];
        dp_setup setup;
        if (dp_mapping_get(spec.mapping)->curve == DP_CURVE_PERSPECTIVE && rng_below(&r, 2)) {
            const bool outside = rng_below(&r, 8) == 0;
            rng_range(&r, spec.depth_range);
            d = outside ? d : spec.depth_range[0] + (spec.depth_range[1] - spec.depth_range[0]) * d;
        }
        assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
        const double got = decode_exact(&setup, quantity, d);
        if (isinf(spec.zfar)) {
            mpq_t share;
            mpq_init(share);
            undone(&spec, d, share);
            const double at = mpq_get_d(share), q = dp_mapping_get(spec.mapping)->reversed ? at : 1 - at;
            mpq_clear(share);
            if (quantity != DECODE_EYE || q == 0) {
                TALLY(&t, got == (quantity != DECODE_EYE ? 0 : INFINITY), "an infinite far plane");
                continue;
            }
        }
        if (setup.curve == DP_CURVE_LOG)
            logarithmic(&spec, d, quantity, want);
        else
            rational(&spec, d, quantity, want);
        const double off = oracle_relative(got, want);
        worst = fmax(worst, off);
        TALLY(&t, off <= 0x1p-50, "%s, d %.17g, quantity %d: %.17g is off by %.3g",
              oracle_describe(&spec, text, sizeof text), d, (int)quantity, got, off);
    }
    mpq_clear(want);
    print_message("# worst relative error %.3g\n", worst);
    tally_end(&t);
}

/* No row's error is above its bound; each row comes within a quarter of it somewhere in each direction. */
TEST(rows_keep_their_bounds) {
    enum { ROWS = 16, PIXELS = 64 };
    rng r = rng_make("rows");
    tally t = {.name = "bounds"};
    double most[ROWS][2] = {{0}};
    size_t rows = 0;
    for (uint64_t k = test_cases(2000, 20000, 200000); k > 0; k--) {
        const dp_spec spec = random_spec(&r);
        dp_setup setup;
        float d[PIXELS], out[PIXELS];
        char text[512];
        assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
        for (int i = 0; i < PIXELS; i++)
            d[i] = (float)random_window(&r);
        for (rows = 0; decode_get(rows) != NULL; rows++) {
            const decode_row *row = decode_get(rows);
            if (!decode_applies(row, &setup))
                continue;
            decode_run(row, &setup, d, out, PIXELS);
            for (int i = 0; i < PIXELS; i++) {
                const double want = decode_exact(&setup, row->quantity, (double)d[i]), got = (double)out[i];
                if (fabs(want) > (double)FLT_MAX * 0.99 || fabs(want) < 1e-30) {
                    TALLY(&t, want != 0 || got == 0, "%s: nothing becomes %g", row->name, got);
                    TALLY(&t, !isinf(want) || isinf(got), "%s: infinity becomes %g", row->name, got);
                    continue;
                }
                const double bound = decode_bound(row, &setup, (double)d[i]), off = fabs(got - want) / want;
                TALLY(&t, off <= bound, "%s, %s, d %.9g: %g above the bound %g", row->name,
                      oracle_describe(&spec, text, sizeof text), (double)d[i], off, bound);
                if (bound > 0 && bound < 0.1)
                    most[rows][setup.reversed] = fmax(most[rows][setup.reversed], off / bound);
            }
        }
    }
    assert_true(rows <= ROWS);
    for (size_t i = 0; i < rows; i++)
        for (int k = 0; k < 2; k++)
            if (k == 0 || decode_get(i)->perspective || decode_get(i)->ortho)
                TALLY(&t, most[i][k] > 0.25, "%s, direction %d: the bound is %g times the error", decode_get(i)->name,
                      k, 1 / most[i][k]);
    tally_end(&t);
}

/* The hardest depths known: no term of a bound is too small by half, nor too large. The exact value is a rational. */
static void check_hard(const vector_row *row, void *context) {
    tally *t = context;
    const decode_row *decoding = decode_find(vector_text(row, 0));
    dp_spec spec = dp_spec_default();
    dp_setup setup;
    mpq_t want;
    spec.mapping = (dp_mapping)vector_number(row, 1);
    spec.ortho = vector_number(row, 2) != 0;
    spec.znear = vector_number(row, 3);
    spec.zfar = vector_number(row, 4);
    spec.log_c = vector_number(row, 5);
    const float d = (float)vector_number(row, 6);
    float got;
    assert_non_null(decoding);
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    mpq_init(want);
    (setup.curve == DP_CURVE_LOG ? logarithmic : rational)(&spec, (double)d, decoding->quantity, want);
    decode_run(decoding, &setup, &d, &got, 1);
    const double off = oracle_relative((double)got, want), bound = decode_bound(decoding, &setup, (double)d);
    TALLY(t, off <= bound, "%s, line %d: %g above %g", decoding->name, row->line, off, bound);
    TALLY(t, off >= 0.97 * vector_number(row, 7) * bound, "%s, line %d: %g is %g of %g", decoding->name, row->line, off,
          off / bound, bound);
    mpq_clear(want);
}

TEST(the_hardest_depths_need_each_term) {
    tally t = {.name = "hardest"};
    vectors_read("decode.txt", check_hard, &t);
    tally_end(&t);
}

/* The bound of log-eye takes this for granted: exp2f within 0.55 ulp, expm1f within 1. */
TEST(exponentials_are_as_exact_as_assumed) {
    rng r = rng_make("library");
    tally t = {.name = "exp2f, expm1f"};
    for (uint64_t k = test_cases(20000, 500000, 20000000); k > 0; k--) {
        const float x = (float)rng_log(&r, 1e-6, 60);
        const double two = exp2((double)x), e = expm1((double)x);
        TALLY(&t, fabs((double)dp_exp2f(x) - two) <= 1.1 * 0x1p-24 * two, "exp2f(%.9g)", (double)x);
        TALLY(&t, fabs((double)dp_expm1f(x) - e) <= 2 * 0x1p-24 * e, "expm1f(%.9g)", (double)x);
    }
    tally_end(&t);
}

/* A cancelling sum has no digit left: the bound says so, and the complement keeps its own. */
TEST(the_complement_cancels_nothing) {
    dp_spec spec = dp_spec_default();
    dp_setup setup;
    spec.zfar = 1e8;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    assert_true(isinf(decode_bound(decode_find("linear-eye"), &setup, 1)));
    assert_true(decode_bound(decode_find("complement"), &setup, 1) < 6 * 0x1p-24);
    spec.zfar = 1000;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    const double lost = decode_bound(decode_find("linear-eye"), &setup, 1);
    assert_true(lost > 1.7e-3 && lost < 1.9e-3); /* 3 units far/near */
}

/* _ZBufferParams of near 0.1 and far 1000, by hand. */
TEST(parameters_are_those_of_engines) {
    dp_spec spec = dp_spec_default();
    dp_setup setup;
    spec.znear = 0.5;
    spec.zfar = 64;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    zbuffer_params p = zbuffer_params_of(&setup);
    assert_true(p.x == -127 && p.y == 128 && p.z == -127.0f / 64 && p.w == 2);
    spec.mapping = DP_MAPPING_REVERSED;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    p = zbuffer_params_of(&setup);
    assert_true(p.x == 127 && p.y == 1 && p.z == 127.0f / 64 && p.w == 1.0f / 64);
    spec.zfar = INFINITY;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    p = zbuffer_params_of(&setup);
    assert_true(isinf(p.x) && p.z == 2 && p.w == 0);
}

/* Which row applies where is data: for each set-up exactly one usual row, and the best one always. */
TEST(rows_apply_where_they_say) {
    rng r = rng_make("applies");
    for (size_t i = 0; decode_get(i) != NULL; i++)
        assert_ptr_equal(decode_find(decode_get(i)->name), decode_get(i));
    assert_null(decode_find("linear"));
    for (int k = 0; k < 1000; k++) {
        const dp_spec spec = random_spec(&r);
        dp_setup setup;
        assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
        if (setup.curve == DP_CURVE_LOG && setup.anchor > 0) { /* no row begins at near */
            for (size_t i = 0; decode_get(i) != NULL; i++)
                assert_false(decode_applies(decode_get(i), &setup));
            continue;
        }
        const char *want = spec.ortho                          ? "ortho-eye"
                           : setup.curve == DP_CURVE_LOG       ? "log-eye"
                           : spec.mapping == DP_MAPPING_LINEAR ? "w-eye"
                                                               : "linear-eye";
        assert_string_equal(decode_usual(&setup)->name, want);
        assert_true(decode_applies(&decode_rows[DECODE_COMPLEMENT], &setup));
        assert_int_equal(decode_applies(decode_find("linear-01"), &setup),
                         strcmp(want, "linear-eye") == 0 && !isinf(spec.zfar));
    }
}

/* Any length and place, and in place: the same bits as one by one. */
TEST(loops_have_no_edges) {
    enum { MOST = 100 };
    float d[MOST], one[MOST], all[MOST];
    dp_spec spec = dp_spec_default();
    for (int i = 0; i < MOST; i++)
        d[i] = i == 7 ? (float)NAN : (float)i / (MOST - 1);
    for (int mapping = 0; mapping < DP_MAPPING_COUNT; mapping++)
        for (int ortho = 0; ortho < 2; ortho++) {
            dp_setup setup;
            spec.mapping = (dp_mapping)mapping;
            spec.ortho = ortho;
            if (dp_setup_init(&setup, &spec) != DP_OK)
                continue;
            for (size_t k = 0; decode_get(k) != NULL; k++) {
                if (!decode_applies(decode_get(k), &setup))
                    continue;
                for (int i = 0; i < MOST; i++)
                    decode_run(decode_get(k), &setup, &d[i], &one[i], 1);
                assert_true(isnan(one[7]));
                for (size_t count = 0; count <= MOST; count++) {
                    memcpy(all, d, sizeof d);
                    decode_run(decode_get(k), &setup, all, all, count);
                    assert_memory_equal(all, one, count * sizeof *all);
                    assert_memory_equal(all + count, d + count, (MOST - count) * sizeof *all);
                }
            }
        }
}

TEST(many_are_what_each_is) {
    enum { SETUPS = 300, COUNT = 67 };
    rng r = rng_make("decode many");
    for (int k = 0; k < SETUPS; k++) {
        const dp_spec spec = random_spec(&r);
        dp_setup setup;
        if (dp_setup_init(&setup, &spec) != DP_OK)
            continue;
        float d[COUNT];
        double got[COUNT];
        for (size_t i = 0; i < COUNT; i++)
            d[i] = (float)random_window(&r);
        for (int q = 0; q < DECODE_QUANTITIES; q++) {
            decode_exact_run(&setup, (decode_quantity)q, d, got, COUNT);
            for (size_t i = 0; i < COUNT; i++) {
                const double want = decode_exact(&setup, (decode_quantity)q, (double)d[i]);
                if (!(got[i] == want || (isnan(got[i]) && isnan(want))))
                    fail_msg("quantity %d at %.9g: %.17g, alone %.17g", q, (double)d[i], got[i], want);
            }
        }
    }
}
