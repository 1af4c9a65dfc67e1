/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * NVIDIA's arithmetic against an H100 (driver 580.159.04): all reciprocals of its unit, rcp.approx of PTX, and the
 * codes that it stored of the probe's shots by Vulkan. Of each the FNV-1a hash of what came from there is kept.
 */
#include <string.h>

#include "core/bits.h"
#include "core/log_shader.h"
#include "depthprec/pipeline.h"
#include "nvidia.h"
#include "probe/plan.h"
#include "support.h"

static void hash(uint64_t *h, uint32_t word) {
    for (int byte = 0; byte < 4; byte++)
        *h = (*h ^ (word >> (8 * byte) & 0xFF)) * 0x100000001B3U;
}

enum { SIGNIFICANDS = 1 << 23 };
static const uint64_t basis = 0xCBF29CE484222325U;

static float nth(uint32_t i) {
    return dp_float32(0x3F800000U | i);
}

TEST(all_reciprocals_are_the_hardwares) {
    uint64_t h = basis;
    for (uint32_t i = 0; i < SIGNIFICANDS; i++)
        hash(&h, dp_bits32(dp_reciprocal_unit(nth(i))));
    assert_true(h == 0xF6C4479B058C7200U);
}

/* The bounds of core/reciprocal.h: 1.95 half units in the last place, which is 2^-24 above 1/2, and 1.65 2^-24 of
 * itself.
 */
TEST(reciprocals_are_within_what_bounds_take) {
    const dp_reciprocal_error most = dp_reciprocal_error_of(DP_RECIPROCAL_UNIT);
    double half_ulps = 0, units = 0;
    float last = 1;
    for (uint32_t i = 0; i < SIGNIFICANDS; i++) {
        const float w = nth(i), y = dp_reciprocal_unit(w);
        const double off = fabs((double)fmal((long double)y, (long double)w, -1)); /* exact */
        assert_true(y <= last && y > 0.5F);
        half_ulps = fmax(half_ulps, off / (double)w * 0x1p25);
        units = fmax(units, off * 0x1p24);
        last = y;
    }
    assert_true(half_ulps <= most.half_ulps && half_ulps > 0.999 * most.half_ulps);
    assert_true(units <= most.units && units > 0.999 * most.units);
}

TEST(binades_are_alike) {
    rng r = rng_make("binades");
    for (int e = -126; e <= 126; e++)
        for (int i = 0; i < 100; i++) {
            const float w = nth((uint32_t)rng_below(&r, SIGNIFICANDS)), y = dp_reciprocal_unit(w);
            const double want = ldexp((double)y, -e);
            assert_true((double)dp_reciprocal_unit(ldexpf(w, e)) == (want < 0x1p-126 ? 0 : want));
        }
    for (int e = -126; e <= 126; e++)
        assert_true(dp_reciprocal_unit(ldexpf(1, e)) == ldexpf(1, -e));
    assert_true(dp_reciprocal_unit(INFINITY) == 0 && isinf(dp_reciprocal_unit(0)) && isnan(dp_reciprocal_unit(NAN)));
    assert_true(dp_reciprocal_unit(-3) == -1.0F / 3);
}

TEST(shots_are_stored_as_there) {
    static const struct {
        plan_shot shot;
        shot_format format;
        const char *name;
        uint64_t hash;
    } shots[] = {
        {PLAN_STORED, SHOT_D16, "unorm16", 0xD10A4B953DB63405U},
        {PLAN_STORED, SHOT_D24, "unorm24", 0x187D3C17C8C4580AU},
        {PLAN_STORED, SHOT_D32F, "fp32", 0x0C37FCD777BC3757U},
        {PLAN_ROUNDING, SHOT_D16, "unorm16", 0x53D2A0AA262AC356U},
        {PLAN_ROUNDING, SHOT_D24, "unorm24", 0xDC6C1D1928D20792U},
        {PLAN_DIVISION, SHOT_D32F, "fp32", 0xF6CCC561C818E2AAU},
        {PLAN_PROJECTION, SHOT_D32F, "fp32", 0x8A33AEAC77887BF9U},
    };
    dp_arith nvidia;
    shot_plan plan;
    assert_int_equal(dp_arith_parse("nvidia", &nvidia), DP_OK);
    assert_true(plan_make(&plan, 0));
    for (size_t k = 0; k < sizeof shots / sizeof shots[0]; k++) {
        const shot *s = plan_find(&plan, shots[k].shot, shots[k].format);
        dp_format found[2];
        assert_int_equal(dp_format_parse(shots[k].name, found), 1);
        const dp_pipeline p = {.format = found[0], .arith = dp_arith_get(nvidia), .a = s->a, .b = s->b};
        uint64_t h = basis;
        for (uint32_t i = 0; i < s->count; i++) {
            const float z = s->vertex[i][2], w = s->vertex[i][3];
            const float clip = s->program == SHOT_PROJECT ? dp_pipeline_clip(&p, z) : z;
            hash(&h, dp_pipeline_convert(&p, dp_pipeline_divide(&p, clip, w)));
        }
        if (h != shots[k].hash)
            fail_msg("%s of %s", s->name, shots[k].name);
    }
    plan_free(&plan);
}

/* A cell of 16 bits has 16 or 17 parts of 2^-20, and codes are off by 9/16 at most; of 24 bits by as much. */
TEST(conversions_are_within_what_bounds_take) {
    static const char *const names[] = {"unorm16", "unorm24"};
    const dp_arith_row row = {.conversion = DP_CONVERT_SIXTEENTHS};
    rng r = rng_make("conversions");
    for (int k = 0; k < 2; k++) {
        dp_format found[2];
        assert_int_equal(dp_format_parse(names[k], found), 1);
        const dp_pipeline p = {.format = found[0], .arith = &row};
        const double levels = (double)found[0].code_max;
        double most = 0;
        for (int i = 0; i < 1000000; i++) {
            const float d = (float)(rng_below(&r, 2) == 0 ? rng_unit(&r) : rng_log(&r, 0x1p-12, 1));
            const float more = (float)((double)d + 17.0 / 16 / levels);
            most = fmax(most, fabs((double)d * levels - dp_pipeline_convert(&p, d)));
            assert_true(dp_pipeline_convert(&p, nextafterf(d, 0)) <= dp_pipeline_convert(&p, d));
            assert_true(!((double)more - (double)d > 17.0 / 16 / levels && more <= 1) ||
                        dp_pipeline_convert(&p, more) > dp_pipeline_convert(&p, d));
        }
        assert_true(most <= 9.0 / 16 && most > 0.54);
        assert_int_equal(dp_pipeline_convert(&p, 0), 0);
        assert_int_equal(dp_pipeline_convert(&p, 1), found[0].code_max);
    }
}

/* A product of 54 bits, 2^-23 below the middle of two codes. */
TEST(conversions_are_exact_of_32_bits) {
    const dp_arith_row row = {.conversion = DP_CONVERT_SIXTEENTHS};
    dp_format found[2];
    assert_int_equal(dp_format_parse("unorm32", found), 1);
    const dp_pipeline p = {.format = found[0], .arith = &row};
    assert_true(dp_pipeline_convert(&p, 0x1.000004p-1F) == 0x800001FFU);
    assert_true(nvidia_code(32, 0x1.000004p-1F) == 0x800001FFU);
}

/* Wherever a bound counts a reciprocal, NVIDIA's has 1.65 times the part of one that is rounded once. */
TEST(bounds_take_it_everywhere) {
    static const char *const names[] = {"fused", "fused-reciprocal", "nvidia"};
    double written[3], beyond[3];
    for (int i = 0; i < 3; i++) {
        dp_format found[2];
        dp_spec spec = dp_spec_default();
        dp_setup setup;
        assert_int_equal(dp_format_parse("fp32", found), 1);
        assert_int_equal(dp_arith_parse(names[i], &spec.arith), DP_OK);
        spec.format = found[0];
        spec.model = DP_MODEL_FLOAT;
        spec.mapping = DP_MAPPING_REVERSED;
        assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
        dp_pipeline pipeline;
        assert_int_equal(dp_pipeline_init(&pipeline, &setup), DP_OK);
        const dp_chain chain = dp_chain_make(&setup, &pipeline);
        beyond[i] = dp_chain_steps_beyond(&chain, 0.3).quotient.error;
        spec.mapping = DP_MAPPING_OSGEARTH;
        spec.model = DP_MODEL_STAGED;
        assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
        const dp_log_shader shader = dp_log_shader_make(&setup, dp_log2_get(0));
        written[i] = dp_log_shader_steps(&shader, (dp_span){300, 300}).ndc;
    }
    assert_true(fabs((beyond[2] - beyond[0]) / (beyond[1] - beyond[0]) - 1.65) < 1e-6);
    assert_true(fabs((written[2] - written[0]) / (written[1] - written[0]) - 1.65) < 1e-6);
}
