/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The advice of budget: the words name the change whose separation is printed, and no other change does much better. */
#include "quantity/cmd_budget/remedy.h"
#include "support.h"

static bool format_is(dp_spec *spec, const char *name) {
    dp_format found[2];
    assert_int_equal(dp_format_parse(name, found), 1);
    const bool finer = found[0].code_max > spec->format.code_max;
    spec->format = finer ? found[0] : spec->format;
    return finer;
}

/* Does to a set-up as the words say; false where it changes nothing. */
static bool do_it(const char *words, dp_spec *spec, dp_budget_terms *terms) {
    const dp_spec before = *spec;
    const dp_budget_terms given = *terms;
    const bool reversed = dp_mapping_get(spec->mapping)->reversed != 0;
    if (reversed && (strcmp(words, "reversed depth") == 0 || strstr(words, "reversed depth and") != NULL))
        return false; /* it is; to leave [-1, 1] is a change of its own */
    if (strcmp(words, "positions relative to the camera") == 0)
        terms->composition = DP_COMPOSITION_RELATIVE;
    else if (strcmp(words, "reading back by the complement form") == 0)
        terms->linearize = 0;
    else if (strcmp(words, "a fused A z + B") == 0) {
        const dp_arith_row *arith = dp_arith_get(spec->arith);
        if (!arith->fused) /* or it is that of a GPU, and stays */
            assert_int_equal(dp_arith_parse(arith->reciprocal ? "fused-reciprocal" : "fused", &spec->arith), DP_OK);
    } else if (strcmp(words, "NDC from 0 to 1") == 0)
        spec->mapping = dp_mapping_get(spec->mapping)->reversed ? DP_MAPPING_REVERSED : DP_MAPPING_D3D;
    else if (strcmp(words, "unorm24") == 0 || strcmp(words, "fp32") == 0)
        format_is(spec, words);
    else
        assert_true(strstr(words, "infinite far plane") != NULL || strncmp(words, "reversed depth", 14) == 0);
    if (strncmp(words, "reversed depth", 14) == 0)
        spec->mapping = DP_MAPPING_REVERSED;
    if (strstr(words, "infinite far plane") != NULL)
        spec->zfar = INFINITY;
    if (strcmp(words, "reversed depth in fp32") == 0)
        format_is(spec, "fp32");
    return memcmp(&before, spec, sizeof before) != 0 || memcmp(&given, terms, sizeof given) != 0;
}

/* Each change, and the causes that it is against. */
static const struct {
    const char *words;
    dp_cause causes[6];
    int cause_count;
} changes[] = {
    {"positions relative to the camera", {DP_CAUSE_COMPOSITION}, 1},
    {"reading back by the complement form", {DP_CAUSE_LINEARIZATION}, 1},
    {"a fused A z + B", {DP_CAUSE_PROJECTION}, 1},
    {"NDC from 0 to 1", {DP_CAUSE_PROJECTION, DP_CAUSE_NDC}, 2},
    {"unorm24", {DP_CAUSE_FORMAT}, 1},
    {"fp32", {DP_CAUSE_FORMAT}, 1},
    {"an infinite far plane", {DP_CAUSE_PROJECTION, DP_CAUSE_NDC}, 2},
    {"reversed depth", {DP_CAUSE_PROJECTION, DP_CAUSE_NDC, DP_CAUSE_FORMAT}, 3},
    {"reversed depth and an infinite far plane", {DP_CAUSE_PROJECTION, DP_CAUSE_NDC}, 2},
    {"reversed depth in fp32",
     {DP_CAUSE_PROJECTION, DP_CAUSE_NDC, DP_CAUSE_FORMAT, DP_CAUSE_ARGUMENT, DP_CAUSE_LOG2, DP_CAUSE_SCALE},
     6},
};
enum { CHANGES = sizeof changes / sizeof changes[0] };

static bool is_against(size_t i, dp_cause cause) {
    for (int k = 0; k < changes[i].cause_count; k++)
        if (changes[i].causes[k] == cause)
            return true;
    return cause == DP_CAUSE_LINEARIZATION && strcmp(changes[i].words, "reversed depth") == 0;
}

/* The separation that a change leaves, not below one binary32 step of z; INFINITY where it cannot be had or changes
 * nothing. */
static double left_by(const char *words, const dp_setup *setup, const dp_budget_terms *given, double z) {
    dp_spec spec = setup->spec;
    dp_budget_terms terms = *given;
    dp_setup changed;
    dp_budget b;
    const double step = (double)nextafterf((float)z, HUGE_VALF) - (double)(float)z;
    if (!do_it(words, &spec, &terms) || dp_setup_init(&changed, &spec) != DP_OK ||
        dp_budget_at(&changed, z, &terms, &b) != DP_OK)
        return INFINITY;
    return fmax(b.separation, step);
}

static dp_setup any_setup(rng *r) {
    static const char *const formats[] = {"unorm16", "unorm24", "fp16", "fp32", "unorm30"};
    dp_setup setup;
    dp_format format[2];
    dp_spec spec = dp_spec_default();
    do {
        spec.znear = rng_log(r, 0.01, 100);
        spec.zfar = rng_below(r, 4) == 0 ? INFINITY : spec.znear * rng_log(r, 2, 1e6);
        spec.ortho = rng_below(r, 4) == 0;
        spec.mapping = (dp_mapping)rng_below(r, DP_MAPPING_COUNT);
        spec.arith = rng_below(r, dp_arith_count());
        dp_format_parse(formats[rng_below(r, 5)], format);
        spec.format = format[0];
        spec.model = dp_mapping_get(spec.mapping)->curve == DP_CURVE_LOG ? DP_MODEL_EXACT : DP_MODEL_FLOAT;
    } while (dp_setup_init(&setup, &spec) != DP_OK);
    return setup;
}

TEST(words_and_numbers_agree) {
    rng r = rng_make("remedy");
    tally t = {.name = "remedy"};
    uint64_t seen[CHANGES] = {0};
    for (uint64_t i = 0; i < test_cases(2000, 20000, 200000); i++) {
        const dp_setup setup = any_setup(&r);
        const dp_budget_terms terms = {.interpolation = rng_below(&r, 2) ? 2 : 0,
                                       .world = rng_below(&r, 2) ? 1e4 : 0,
                                       .composition = (dp_composition)rng_below(&r, DP_COMPOSITION_COUNT),
                                       .linearize = (int)rng_below(&r, 2)};
        const dp_cause cause = (dp_cause)rng_below(&r, DP_CAUSE_COUNT);
        const double z = rng_log(&r, setup.spec.znear, fmin(setup.spec.zfar, 1e6 * setup.spec.znear));
        const remedy_result got = remedy_find(&setup, &terms, z, cause);
        double best = INFINITY;
        for (size_t k = 0; k < CHANGES; k++) {
            const double left = left_by(changes[k].words, &setup, &terms, z);
            const bool named = got.text != NULL && strcmp(got.text, changes[k].words) == 0;
            seen[k] += named ? 1 : 0;
            best = is_against(k, cause) ? fmin(best, left) : best;
            TALLY(&t, !named || is_against(k, cause), "%s against %s", got.text, dp_cause_name(cause));
            TALLY(&t, !named || got.separation == left, "%s: %g, but it leaves %g", got.text, got.separation, left);
        }
        /* The simpler first: each of the ten may be 5 % short of the one before it. */
        TALLY(&t, got.text == NULL || got.separation <= best / 0.95 * (1 + 1e-12), "%s leaves %g, another %g", got.text,
              got.separation, best);
    }
    for (size_t k = 0; k < CHANGES; k++)
        TALLY(&t, seen[k] > 0, "'%s' is never advised", changes[k].words);
    tally_end(&t);
}
