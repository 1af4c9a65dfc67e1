/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which model is enough, and how the guaranteed separation is split: the sums, not the bounds themselves. */
#include "depthprec/depthprec.h"
#include "quantity/cmd/choice.h"
#include "setups.h"
#include "support.h"

enum { DEPTHS = 200 };

static dp_setup make(const char *format, dp_mapping mapping, double znear, double zfar) {
    return SETUP(format, .mapping = mapping, .znear = znear, .zfar = zfar);
}

static void spread(const dp_setup *setup, double *z, size_t count) {
    const double lo = setup->spec.znear;
    const double hi = isinf(setup->spec.zfar) ? 1e5 * lo : setup->spec.zfar;
    for (size_t i = 0; i < count; i++)
        z[i] = fmin(fmax(lo * pow(hi / lo, (double)i / (double)(count - 1)), lo), hi);
}

/* ---- The choice -------------------------------------------------------------------------------------------------- */

static const struct {
    const char *format;
    dp_mapping mapping;
    double znear, zfar;
    dp_model model;
} needs[] = {
    /* a step of 16 bits is coarser than all arithmetic before it */
    {"unorm16", DP_MAPPING_D3D, 0.1, 1000, DP_MODEL_EXACT},
    {"unorm16", DP_MAPPING_REVERSED, 0.1, 1000, DP_MODEL_EXACT},
    {"fp16", DP_MAPPING_REVERSED, 0.1, 1000, DP_MODEL_EXACT},
    {"unorm16", DP_MAPPING_LOG, 0.1, 1000, DP_MODEL_EXACT},
    /* reversed and infinite, z_clip is a constant: one rounding, that of the format, and that of the eye depth */
    {"fp32", DP_MAPPING_REVERSED, 0.1, INFINITY, DP_MODEL_STAGED},
    /* 24 bits lie on the binary32 lattice of the window depth, which is twice as coarse near 1 */
    {"unorm24", DP_MAPPING_LINEAR, 0.1, 1000, DP_MODEL_STAGED},
    {"unorm24", DP_MAPPING_LOG, 0.1, 1000, DP_MODEL_STAGED},
    /* the viewport of GL adds 0.5: its rounding covers those before it, once A z is exact */
    {"unorm24", DP_MAPPING_GL, 0.1, INFINITY, DP_MODEL_STAGED},
    /* A z + B cancels */
    {"unorm24", DP_MAPPING_D3D, 0.1, 1000, DP_MODEL_FLOAT},
    {"fp32", DP_MAPPING_D3D, 0.1, 1000, DP_MODEL_FLOAT},
    {"unorm24", DP_MAPPING_GL_REVERSED, 0.1, 1000, DP_MODEL_FLOAT},
};

TEST(each_model_is_needed) {
    for (size_t i = 0; i < sizeof needs / sizeof needs[0]; i++) {
        const dp_setup setup = make(needs[i].format, needs[i].mapping, needs[i].znear, needs[i].zfar);
        double z[DEPTHS];
        dp_choice choice;
        spread(&setup, z, DEPTHS);
        assert_int_equal(dp_model_choose(&setup, z, DEPTHS, 0.05, &choice), DP_OK);
        if (choice.model != needs[i].model)
            fail_msg("%s %s: %s, expected %s", needs[i].format, dp_mapping_get(needs[i].mapping)->name,
                     dp_model_name(choice.model), dp_model_name(needs[i].model));
    }
}

static const char *const formats[] = {"fp16", "fp32", "unorm16", "unorm24", "unorm20", "float5.10"};

static dp_setup random_setup(rng *r, bool with_pipeline) {
    const bool infinite = rng_below(r, 4) == 0;
    const double znear = rng_log(r, 1e-3, 10.0);
    const double zfar = infinite ? (double)INFINITY : znear * rng_log(r, 1.5, 1e6);
    const uint64_t mappings = infinite || with_pipeline ? 4 : DP_MAPPING_COUNT;
    dp_spec spec = make(formats[rng_below(r, 6)], (dp_mapping)rng_below(r, mappings), znear, zfar).spec;
    dp_setup setup;
    spec.arith = (dp_arith)rng_below(r, dp_arith_count());
    spec.ortho = spec.mapping < DP_MAPPING_LINEAR && !infinite && rng_below(r, 4) == 0;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    return setup;
}

static double depth_in(rng *r, const dp_setup *setup) {
    if (setup->spec.znear <= 0)
        return rng_depth(r, setup->spec.znear, setup->spec.zfar);
    const double hi = isinf(setup->spec.zfar) ? 1e5 * setup->spec.znear : setup->spec.zfar;
    return fmin(fmax(rng_log(r, setup->spec.znear, hi), setup->spec.znear), hi);
}

/* The share of one model at one depth, from the separations. */
static double share_at(const dp_setup *setup, int model, double z) {
    dp_setup part = *setup;
    dp_setup whole = *setup;
    dp_spec spec = setup->spec;
    spec.model = DP_MODEL_FLOAT;
    if (dp_setup_init(&whole, &spec) != DP_OK) {
        spec.model = DP_MODEL_STAGED;
        assert_int_equal(dp_setup_init(&whole, &spec), DP_OK);
    }
    spec.model = (dp_model)model;
    if (dp_setup_init(&part, &spec) != DP_OK)
        return (double)NAN;
    const float plane = (float)fmax(-setup->spec.znear, fabs(setup->spec.zfar)), least = ldexpf(plane, -24);
    float depth = setup->spec.znear > 0 ? (float)z : fmaxf(fabsf((float)z), least);
    if ((double)depth > fabs(z) && depth > least)
        depth = nextafterf(depth, 0);
    const double step = (double)nextafterf(depth, HUGE_VALF) - (double)depth; /* of the depths themselves */
    const double some = fmax(dp_separation(&part, z), step / 2);
    const double all = dp_separation(&whole, z);
    return isinf(some) || all <= some ? 0.0 : all / some - 1.0;
}

TEST(shares_are_those_of_the_separations) {
    rng r = rng_make("shares");
    tally t = {.name = "shares"};
    for (uint64_t n = test_cases(200, 3000, 30000); n > 0; n--) {
        dp_setup setup = random_setup(&r, false);
        if (setup.spec.ortho && n % 2 == 0) {
            dp_spec around = setup.spec; /* the camera's own place */
            rng_planes(&r, &around.znear, &around.zfar);
            assert_int_equal(dp_setup_init(&setup, &around), DP_OK);
        }
        const double z[3] = {depth_in(&r, &setup), depth_in(&r, &setup), depth_in(&r, &setup)};
        dp_choice c;
        assert_int_equal(dp_model_choose(&setup, z, 3, 0.05, &c), DP_OK);
        for (int m = 0; m < DP_MODEL_COUNT; m++) {
            double worst = share_at(&setup, m, z[0]);
            for (int i = 1; i < 3; i++)
                worst = isnan(worst) ? worst : fmax(worst, share_at(&setup, m, z[i]));
            const bool same = isnan(worst) ? isnan(c.share[m]) : c.share[m] == worst;
            const bool there = isnan(worst) || worst == 0.0 || share_at(&setup, m, c.share_z[m]) == worst;
            TALLY(&t, same && there, "%s %s %s at %a %a %a: %g, expected %g", setup.spec.format.name,
                  dp_mapping_get(setup.spec.mapping)->name, dp_model_name((dp_model)m), z[0], z[1], z[2], c.share[m],
                  worst);
        }
    }
    tally_end(&t);
}

/* A plane whose code is 0 has a cell of 1e-46 that no two depths share: nothing is 10^37 times worse than it. */
TEST(planes_are_no_measure) {
    static const struct {
        dp_mapping mapping;
        double znear, zfar, z;
        int ortho;
    } planes[] = {{DP_MAPPING_D3D, 0.1, INFINITY, 0.1, 0}, {DP_MAPPING_D3D, 0.1, 1000, 0.1, 0},
                  {DP_MAPPING_D3D, 0, 500, 0, 1},          {DP_MAPPING_D3D, -100, 500, -100, 1},
                  {DP_MAPPING_REVERSED, -500, 0, 0, 1},    {DP_MAPPING_REVERSED, 1, 1000, 1000, 0}};
    for (size_t i = 0; i < sizeof planes / sizeof planes[0]; i++) {
        dp_spec spec = make("fp32", planes[i].mapping, 1, 2).spec;
        dp_setup setup;
        dp_choice c;
        spec.znear = planes[i].znear;
        spec.zfar = planes[i].zfar;
        spec.ortho = planes[i].ortho;
        assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
        assert_int_equal(dp_model_choose(&setup, &planes[i].z, 1, 0.05, &c), DP_OK);
        if (!(c.share[DP_MODEL_EXACT] < 10))
            fail_msg("at z = %g the lattice lacks %g", planes[i].z, c.share[DP_MODEL_EXACT]);
    }
}

TEST(the_simplest_within_the_tolerance) {
    rng r = rng_make("tolerance");
    tally t = {.name = "tolerance"};
    for (uint64_t n = test_cases(200, 3000, 30000); n > 0; n--) {
        const dp_setup setup = random_setup(&r, false);
        const double tolerance = rng_below(&r, 8) == 0 ? 0.0 : rng_log(&r, 1e-4, 10.0);
        const double z[2] = {depth_in(&r, &setup), depth_in(&r, &setup)};
        dp_choice c;
        assert_int_equal(dp_model_choose(&setup, z, 2, tolerance, &c), DP_OK);
        bool good = c.share[c.model] <= tolerance;
        for (int m = 0; m < (int)c.model; m++)
            good = good && c.share[m] > tolerance;
        TALLY(&t, good, "%s %s, tolerance %g: %s", setup.spec.format.name, dp_mapping_get(setup.spec.mapping)->name,
              tolerance, dp_model_name(c.model));
    }
    tally_end(&t);
}

TEST(the_set_ups_own_model_does_not_matter) {
    dp_setup setup = make("unorm24", DP_MAPPING_D3D, 0.1, 1000);
    const double z[2] = {1.0, 100.0};
    dp_choice choice[DP_MODEL_COUNT];
    for (int m = 0; m < DP_MODEL_COUNT; m++) {
        dp_spec spec = setup.spec;
        spec.model = (dp_model)m;
        assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
        assert_int_equal(dp_model_choose(&setup, z, 2, 0.05, &choice[m]), DP_OK);
        assert_memory_equal(&choice[m], &choice[0], sizeof choice[0]);
    }
}

TEST(refusals) {
    const dp_setup setup = make("unorm24", DP_MAPPING_D3D, 0.1, 1000);
    const double good[2] = {1.0, 10.0};
    const double bad[2] = {1.0, 1001.0};
    const double nan[2] = {1.0, NAN};
    dp_choice c = {.model = DP_MODEL_COUNT};
    assert_int_equal(dp_model_choose(NULL, good, 2, 0.05, &c), DP_ERROR_NULL);
    assert_int_equal(dp_model_choose(&setup, NULL, 2, 0.05, &c), DP_ERROR_NULL);
    assert_int_equal(dp_model_choose(&setup, good, 2, 0.05, NULL), DP_ERROR_NULL);
    assert_int_equal(dp_model_choose(&setup, good, 0, 0.05, &c), DP_ERROR_NULL);
    assert_int_equal(dp_model_choose(&setup, bad, 2, 0.05, &c), DP_ERROR_DEPTH);
    assert_int_equal(dp_model_choose(&setup, nan, 2, 0.05, &c), DP_ERROR_DEPTH);
    assert_int_equal(c.model, DP_MODEL_COUNT);
}

/* The program asks in blocks, because it may be asked about a million depths: the same must come out. */
TEST(blocks_come_to_the_same) {
    rng r = rng_make("blocks");
    for (uint64_t n = test_cases(5, 50, 500); n > 0; n--) {
        const dp_setup setup = random_setup(&r, false);
        double z[DEPTHS];
        dp_choice whole;
        for (size_t i = 0; i < DEPTHS; i++)
            z[i] = depth_in(&r, &setup);
        assert_int_equal(dp_model_choose(&setup, z, DEPTHS, 0.05, &whole), DP_OK);
        const depths at = {.kind = DEPTHS_LIST, .count = DEPTHS, .list = z};
        const choosing c = choose_at(&setup, 0.05, &at);
        assert_int_equal(c.choice.model, whole.model);
        for (int m = 0; m < DP_MODEL_COUNT; m++) {
            assert_true(c.choice.share[m] == whole.share[m] || (isnan(c.choice.share[m]) && isnan(whole.share[m])));
            assert_true(c.choice.share_z[m] == whole.share_z[m]);
        }
    }
}

/* ---- The budget -------------------------------------------------------------------------------------------------- */

static dp_budget_terms random_terms(rng *r) {
    return (dp_budget_terms){.interpolation = rng_below(r, 2) != 0 ? rng_log(r, 0.1, 100.0) : 0.0,
                             .world = rng_below(r, 2) != 0 ? rng_log(r, 0.1, 1e4) : 0.0,
                             .linearize = (int)rng_below(r, 2),
                             .composition = (dp_composition)rng_below(r, DP_COMPOSITION_COUNT)};
}

/* A part that was not asked for is none; the others are shares of the window depth, and nothing is left over. */
TEST(parts_add_up) {
    rng r = rng_make("parts");
    tally t = {.name = "parts"};
    for (uint64_t n = test_cases(2000, 30000, 300000); n > 0; n--) {
        const dp_setup setup = random_setup(&r, true);
        const dp_budget_terms terms = random_terms(&r);
        const double z = depth_in(&r, &setup);
        dp_budget b;
        assert_int_equal(dp_budget_at(&setup, z, &terms, &b), DP_OK);
        if (isinf(b.separation)) {
            t.skipped++;
            continue;
        }
        double sum = 0.0;
        bool sound = true;
        for (int i = 0; i < DP_CAUSE_COUNT; i++) {
            sum += b.cause[i];
            sound = sound && b.cause[i] >= 0.0;
        }
        sound = sound && fabs(sum - b.separation) <= 1e-12 * b.separation;
        sound =
            sound && (terms.world > 0.0 || b.cause[DP_CAUSE_COMPOSITION] == 0.0); /* it may be less than the eye's */
        /* Both surfaces of a pair may be off by E units of 2^-24. */
        dp_budget_terms here = terms;
        dp_budget plain;
        here.world = 0.0;
        assert_int_equal(dp_budget_at(&setup, z, &here, &plain), DP_OK);
        /* The causes in window depth are meant; the lattice's floor is none, nor is the eye depth. What comes to less
         * than one step of binary32 takes nothing. */
        const double counted = plain.separation - plain.cause[DP_CAUSE_EYE];
        const int less = counted <= 1e-9 * plain.separation;
        sound = sound && (b.cause[DP_CAUSE_INTERPOLATION] > 0.0) == (terms.interpolation > 0.0 && !less);
        sound = sound && (b.cause[DP_CAUSE_LINEARIZATION] > 0.0) == (terms.linearize != 0 && !less);
        const double window = plain.cause[DP_CAUSE_INTERPOLATION] / counted * plain.window;
        dp_setup lattice = setup;
        lattice.spec.model = DP_MODEL_EXACT;
        if (!less && plain.separation > dp_separation(&lattice, z))
            sound = sound && fabs(window - terms.interpolation * 0x1p-23) <= 1e-12 * plain.window;
        /* A composition adds its part, and leaves the others as they are. */
        for (int i = DP_CAUSE_COMPOSITION + 1; i < DP_CAUSE_COUNT; i++)
            sound = sound && b.cause[i] == plain.cause[i];
        TALLY(&t, sound, "%s %s %s near %a far %a at %a, terms %g %g %d: separation %g, parts %g %g %g %g %g %g %g",
              setup.spec.format.name, dp_mapping_get(setup.spec.mapping)->name, dp_arith_get(setup.spec.arith)->name,
              setup.spec.znear, setup.spec.zfar, z, terms.interpolation, terms.world, terms.linearize, b.separation,
              b.cause[0], b.cause[1], b.cause[2], b.cause[3], b.cause[4], b.cause[5], b.cause[6]);
    }
    tally_end(&t);
}

/* A variable that was not set would show afterwards. */
__attribute__((noinline)) static void spoil_stack(void) {
    volatile double below[4096];
    for (size_t i = 0; i < sizeof below / sizeof below[0]; i++)
        below[i] = NAN;
}

/* The shares go on evenly where a binade behind z bounds the separation that the demands alone leave unbounded. From
 * 2^23 on the numerator falls in whole numbers, by which the guarantee is counted: one step of d, 2^-24, and nothing
 * else. */
TEST(parts_go_on_where_nothing_bounds) {
    dp_setup setup;
    dp_spec spec = dp_spec_default();
    dp_format format[2];
    assert_int_equal(dp_format_parse("fp32", format), 1);
    spec.format = format[0];
    spec.model = DP_MODEL_FLOAT;
    spec.mapping = DP_MAPPING_D3D;
    spec.znear = 0x1.c1e6c0e932ed4p+1;
    spec.zfar = 0x1.1e7b43acbf0dep+24;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    for (double z = 8.36e6; z < 8.39e6; z += 1e3) {
        dp_budget budget;
        spoil_stack();
        assert_int_equal(dp_budget_at(&setup, z, NULL, &budget), DP_OK);
        assert_relative(budget.window, z < 0x1p23 ? 3e-7 : 0x1p-24, z < 0x1p23 ? 0.35 : 0);
        assert_true(fabs(budget.cause[DP_CAUSE_PROJECTION] / budget.separation - (z < 0x1p23 ? 0.77 : 0)) < 0.077);
    }
}

/* Nothing but the divide rounds in reversed infinite fp32, so there the term is all that an error adds. */
TEST(interpolation_adds_itself) {
    const dp_setup setup = make("fp32", DP_MAPPING_REVERSED, 0.1, INFINITY);
    dp_budget none;
    assert_int_equal(dp_budget_at(&setup, 3.0, NULL, &none), DP_OK);
    for (double e = 0.125; e < 100.0; e *= 2.0) {
        const dp_budget_terms terms = {.interpolation = e};
        dp_budget some;
        assert_int_equal(dp_budget_at(&setup, 3.0, &terms, &some), DP_OK);
        assert_relative(some.window - none.window, 2.0 * e * 0x1p-24, 1e-9);
        assert_true(some.separation > none.separation);
    }
}

TEST(no_terms_are_zero_terms) {
    rng r = rng_make("no terms");
    const dp_budget_terms zero = {0};
    for (uint64_t n = test_cases(200, 2000, 20000); n > 0; n--) {
        dp_setup setup = random_setup(&r, true);
        dp_spec spec = setup.spec;
        const double z = depth_in(&r, &setup);
        dp_budget a;
        dp_budget b;
        assert_int_equal(dp_budget_at(&setup, z, NULL, &a), DP_OK);
        assert_int_equal(dp_budget_at(&setup, z, &zero, &b), DP_OK);
        assert_memory_equal(&a, &b, sizeof a);
        /* and it is what the model float calls the separation */
        spec.model = DP_MODEL_FLOAT;
        assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
        assert_true(dp_separation(&setup, z) == a.separation);
    }
}

TEST(causes_have_names) {
    for (int i = 0; i < DP_CAUSE_COUNT; i++)
        assert_non_null(dp_cause_name((dp_cause)i));
    assert_null(dp_cause_name(DP_CAUSE_COUNT));
}

TEST(budget_refusals) {
    const dp_setup setup = make("unorm24", DP_MAPPING_D3D, 0.1, 1000);
    const dp_setup log_setup = make("unorm24", DP_MAPPING_LOG, 0.1, 1000);
    dp_budget b;
    assert_int_equal(dp_budget_at(NULL, 1.0, NULL, &b), DP_ERROR_NULL);
    assert_int_equal(dp_budget_at(&setup, 1.0, NULL, NULL), DP_ERROR_NULL);
    assert_int_equal(dp_budget_at(&setup, 0.09, NULL, &b), DP_ERROR_DEPTH);
    assert_int_equal(dp_budget_at(&setup, NAN, NULL, &b), DP_ERROR_DEPTH);
    const dp_setup linear = make("unorm24", DP_MAPPING_LINEAR, 0.1, 1000);
    assert_int_equal(dp_budget_at(&linear, 1.0, NULL, &b), DP_ERROR_MODEL);
    /* terms that the shader of a logarithmic depth has not */
    const dp_budget_terms none[] = {{.world = 10}, {.linearize = 1}, {.displaced = {.own = 1e-3}}, {.log2 = 3}};
    for (size_t i = 0; i < sizeof none / sizeof none[0]; i++)
        assert_int_equal(dp_budget_at(&log_setup, 1.0, &none[i], &b), DP_ERROR_MODEL);
    dp_spec spec = log_setup.spec;
    dp_setup slanted;
    spec.triangles = (dp_triangles){800, 600, 60, 4, {5, 11, 2, 5}, 0, 90, 2, 512, 16};
    assert_int_equal(dp_setup_init(&slanted, &spec), DP_OK);
    assert_int_equal(dp_budget_at(&slanted, 1.0, NULL, &b), DP_ERROR_MODEL);
    assert_int_equal(dp_budget_at(&log_setup, 1.0, NULL, &b), DP_OK);
}
