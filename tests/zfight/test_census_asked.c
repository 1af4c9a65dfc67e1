/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pairs that a census looks at again, and how often it asks for the guarantee: little, and the same comes out. */
#include "core/engine.h"
#include "depthprec/depthprec.h"
#include "setups.h"
#include "support.h"
#include "zfight/census.h"
#include "zfight/ground.h"

static uint64_t looked_at, asked;

static void counting_keys(const census_plan *plan, const float *z, size_t count, int32_t *key) {
    looked_at += count;
    census_level_best()->keys(plan, z, count, key);
}

static double counting_bound(const dp_setup *setup, double z) {
    asked++;
    return dp_separation(setup, z);
}

static dp_setup setup_of(const char *format, dp_mapping mapping) {
    return SETUP(format, .mapping = mapping, .model = DP_MODEL_FLOAT);
}

static const struct {
    const char *format;
    dp_mapping mapping;
} rows[] = {
    {"fp32", DP_MAPPING_D3D}, {"unorm24", DP_MAPPING_GL}, {"unorm16", DP_MAPPING_D3D}, {"fp16", DP_MAPPING_REVERSED}};

/* The farthest binade of a camera, 8192 blocks. */
static void far_binade(size_t row, double (*bound)(const dp_setup *, double)) {
    static census_result result;
    const dp_setup setup = setup_of(rows[row].format, rows[row].mapping);
    census_level level = *census_level_best();
    census_request q = census_of_guarantee(&setup, 256.0, 512.0);
    level.keys = counting_keys;
    q.bound = bound;
    q.level = &level;
    q.threads = 1;
    looked_at = asked = 0;
    assert_int_equal(census_run(&q, &result), CENSUS_DONE);
    printf("# %s %s: looked again at %.4f of the depths, asked %.3f times a block\n", rows[row].format,
           dp_mapping_get(rows[row].mapping)->name, (double)looked_at / (double)result.all.pairs,
           1024.0 * (double)asked / (double)result.all.pairs);
}

TEST(without_a_bound) {
    for (size_t i = 0; i < 4; i++) {
        far_binade(i, NULL);
        assert_true(looked_at < (1 << 23) / (i == 2 ? 10 : 20));
    }
}

/* Nearly all of a cell of unorm16 is an interval. */
TEST(with_the_guarantee) {
    for (size_t i = 0; i < 4; i++) {
        far_binade(i, counting_bound);
        assert_true((double)asked < (i == 2 ? 1.6 : 0.8) * 8192);
    }
}

/* ---- What it relies on --------------------------------------------------------------------------------------------
 */

static const char *const format_names[] = {"fp32", "unorm24", "unorm16", "fp16", "unorm32", "unorm8"};

static bool random_setup(rng *r, dp_setup *setup) {
    static const dp_mapping mappings[] = {DP_MAPPING_D3D, DP_MAPPING_GL, DP_MAPPING_REVERSED, DP_MAPPING_GL_REVERSED};
    dp_spec spec = dp_spec_default();
    dp_format formats[2];
    dp_format_parse(format_names[rng_below(r, 6)], formats);
    spec.format = formats[0];
    spec.mapping = mappings[rng_below(r, 4)];
    spec.rounding = (dp_rounding)rng_below(r, DP_ROUNDING_COUNT);
    spec.model = DP_MODEL_FLOAT;
    spec.arith = rng_below(r, dp_arith_count());
    spec.znear = rng_log(r, 1e-3, 1e3);
    spec.zfar = spec.znear * (1.0 + rng_log(r, 1e-2, 1e7));
    spec.ortho = rng_below(r, 6) == 0;
    return dp_setup_init(setup, &spec) == DP_OK;
}

static const char *name_of(const dp_setup *s) {
    static char text[200];
    snprintf(text, sizeof text, "%s %s near %a far %a%s %s %s", s->spec.format.name,
             dp_mapping_get(s->spec.mapping)->name, s->spec.znear, s->spec.zfar, s->spec.ortho ? " ortho" : "",
             dp_rounding_name(s->spec.rounding), dp_arith_get(s->spec.arith)->name);
    return text;
}

/* The separation is as calm as the census takes it to be. */
TEST(separation_is_calm) {
    tally t = {.name = "calm"};
    rng r = rng_make("calm");
    for (uint64_t n = 0; n < test_cases(100, 1500, 30000); n++) {
        dp_setup s;
        if (!random_setup(&r, &s))
            continue;
        const census_request request = census_of_guarantee(&s, s.spec.znear, s.spec.zfar);
        const uint32_t calm = request.calm;
        const uint32_t from = dp_bits32((float)s.spec.znear) + 1, to = dp_bits32((float)s.spec.zfar) - 1;
        for (int k = 0; k < 40 && to > from && to - from > calm; k++) {
            const uint32_t first = from + (uint32_t)rng_below(&r, to - from - calm);
            if ((first & 0x7FFFFF) < calm || (first & 0x7FFFFF) + calm > 0x800000)
                continue;
            const double step = (double)dp_float32(first + 1) - (double)dp_float32(first);
            const double ends = fmin(dp_separation(&s, (double)dp_float32(first)),
                                     dp_separation(&s, (double)dp_float32(first + calm - 1)));
            const uint32_t at = first + (uint32_t)rng_below(&r, calm);
            const double here = dp_separation(&s, (double)dp_float32(at));
            const double fall = request.falls ? calm * step : 0;
            TALLY(&t, here >= ends * (1.0 - CENSUS_CALM) - 2.0 * step - fall,
                  "%s: %u of %u at %a: %g steps, at the ends %g", name_of(&s), at - first, calm,
                  (double)dp_float32(first), here / step, ends / step);
        }
    }
    tally_end(&t);
}

/* Where a guarantee counts steps it falls as z rises and leaps behind each: the floor under a part lies below that,
 * too. */
TEST(a_floor_lies_below) {
    tally t = {.name = "floors"};
    rng r = rng_make("floors");
    double nearest = HUGE_VAL;
    uint64_t falling = 0;
    for (uint64_t n = 0; n < test_cases(3000, 20000, 200000); n++) {
        dp_setup s;
        if (!random_setup(&r, &s) || !dp_counts_steps(&s) || s.spec.ortho)
            continue;
        const census_request request = census_of_guarantee(&s, s.spec.znear, s.spec.zfar);
        const double z = rng_log(&r, s.spec.znear, s.spec.zfar);
        const uint32_t begin = dp_rank32((float)z) & ~0x7FFFFFU, calm = request.calm;
        const uint32_t part = calm * (1 + (uint32_t)rng_below(&r, 0x800000 / calm - 1));
        if ((double)dp_ranked32(begin) < s.spec.znear || (double)dp_ranked32(begin + 0x7FFFFF) > s.spec.zfar)
            continue;
        census_ground ground = census_ground_make(&request, begin, begin + 0x7FFFFF);
        const double floor = census_ground_at(&ground, begin + part);
        falling += floor > 0.0;
        for (int k = 0; k < 200 && floor > 0.0; k++) {
            const uint32_t at = begin + part + (uint32_t)rng_below(&r, calm);
            const double here = dp_separation(&s, (double)dp_ranked32(at));
            TALLY(&t, floor <= here, "%s: %a, at %a %a", name_of(&s), floor, (double)dp_ranked32(at), here);
            nearest = fmin(nearest, here / floor);
        }
    }
    print_message("# %llu parts, the nearest %g times its floor\n", (unsigned long long)falling, nearest);
    assert_true(falling > 5);
    tally_end(&t);
}

/* The same to the last bit, with any number of threads, as where it is asked for in each block. */
TEST(the_same_comes_out) {
    static census_result every, calm;
    tally t = {.name = "the same"};
    rng r = rng_make("asked");
    for (uint64_t n = 0; n < test_cases(5, 120, 3000); n++) {
        dp_setup s;
        if (!random_setup(&r, &s))
            continue;
        const double lo = fmin(rng_log(&r, s.spec.znear, s.spec.zfar), s.spec.zfar);
        const double hi = fmin(lo * (1.0 + rng_log(&r, 0.01, 1.0)), s.spec.zfar);
        if (lo < s.spec.znear || census_count(lo, hi) < 2)
            continue;
        census_request q = census_of_guarantee(&s, lo, hi);
        q.threads = 1 + (int)rng_below(&r, 3);
        q.segment = rng_below(&r, 2) == 0 ? 0 : 1000 + (uint32_t)rng_below(&r, 100000);
        assert_int_equal(census_run(&q, &calm), CENSUS_DONE);
        q.calm = 0;
        q.threads = 1;
        assert_int_equal(census_run(&q, &every), CENSUS_DONE);
        TALLY(&t, memcmp(&every, &calm, sizeof every) == 0, "%s: from %a to %a: used %a at %a, or %a at %a",
              name_of(&s), lo, hi, calm.all.slack, calm.all.slack_z, every.all.slack, every.all.slack_z);
    }
    tally_end(&t);
}
