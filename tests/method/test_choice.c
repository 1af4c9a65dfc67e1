/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The choice in the words of set-ups: what it takes keeps its claim, and figures drawn by it look the same. */
#include "method/truth.h"
#include "method/ways.h"
#include "named.h"
#include "plot/figure.h"
#include "plot/refine.h"
#include "quantity/cmd/choice.h"
#include "support.h"

static const struct {
    const char *format;
    dp_mapping mapping;
    bool claimed;
} kinds[] = {{"unorm24", DP_MAPPING_D3D, true},     {"fp32", DP_MAPPING_REVERSED, true},
             {"unorm16", DP_MAPPING_D3D, true},     {"fp16", DP_MAPPING_REVERSED, true},
             {"unorm24", DP_MAPPING_LINEAR, false}, {"fp32", DP_MAPPING_D3D, false}};
enum { KINDS = sizeof kinds / sizeof kinds[0] };

static dp_setup make(int kind, double znear, double zfar, bool ortho) {
    dp_format format[2];
    dp_setup setup;
    dp_spec spec = dp_spec_default();
    assert_true(dp_format_parse(kinds[kind].format, format) == 1);
    spec.format = format[0];
    spec.mapping = kinds[kind].mapping;
    spec.znear = znear;
    spec.zfar = zfar;
    spec.ortho = ortho && !isinf(zfar) && spec.mapping != DP_MAPPING_LINEAR;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    return setup;
}

static dp_setup random_setup(rng *r, int kind) {
    const double znear = rng_log(r, 1e-3, 10);
    const bool infinite = kinds[kind].mapping != DP_MAPPING_LINEAR && rng_below(r, 4) == 0;
    return make(kind, znear, infinite ? (double)INFINITY : znear * rng_log(r, 2, 1e9), rng_below(r, 4) == 0);
}

/* An independent width: the definition in long double. */
static double width_at(const dp_setup *setup, double z, bool *cut) {
    return truth_width(setup, dp_code(setup, z), cut);
}

TEST(what_is_chosen_keeps_its_claim) {
    rng r = rng_make("ways");
    tally t = {.name = "ways"};
    uint64_t cheap = 0;
    const uint64_t cases = test_cases(500, 5000, 100000);
    for (uint64_t n = cases; n > 0; n--) {
        const int kind = (int)rng_below(&r, KINDS);
        const dp_setup setup = random_setup(&r, kind);
        const bool cut_cells = rng_below(&r, 4) == 0;
        const double tolerance = rng_log(&r, 1e-6, 1);
        const way w = way_choose(&setup, tolerance, cut_cells);
        const char *name = kinds[kind].format;
        if (!kinds[kind].claimed || setup.spec.zfar / setup.spec.znear < METHOD_RATIO_LO) {
            TALLY(&t, w.row == NULL && strcmp(w.name, "cell") == 0 && w.claim == 0, "%s: %s without a claim", name,
                  w.name);
            continue;
        }
        TALLY(&t, w.row != NULL && w.claim <= tolerance, "%s: claim %g, tolerance %g", name, w.claim, tolerance);
        if (w.row == NULL)
            continue;
        cheap += strcmp(w.name, "cell") != 0;
        for (int k = 0; k < 8; k++) {
            const double hi = isinf(setup.spec.zfar) ? 1e6 * setup.spec.znear : setup.spec.zfar;
            const double z = fmin(fmax(rng_log(&r, setup.spec.znear, hi), setup.spec.znear), hi);
            bool cut = false;
            const double want = width_at(&setup, z, &cut), got = way_interval(&w, &setup, z);
            const bool outside = cut && !cut_cells;
            TALLY(&t, outside || isinf(want) || fabs(got - want) <= w.claim * want, "%s %s at %a: %g, not %g", name,
                  w.name, z, got, want);
        }
    }
    assert_true(cheap > cases / 50); /* else nothing but the cell was tried */
    tally_end(&t);
}

/* Nothing is claimed of other roundings, models and arithmetic. */
TEST(other_set_ups_keep_to_the_engine) {
    for (int k = 0; k < 4; k++) {
        dp_setup setup = make(0, 0.1, 1000, false);
        dp_spec spec = setup.spec;
        spec.rounding = k == 0 ? DP_ROUND_ZERO : DP_ROUND_NEAREST;
        spec.model = k == 0 ? DP_MODEL_EXACT : k == 1 ? DP_MODEL_STAGED : DP_MODEL_FLOAT;
        spec.arith = k == 3;
        assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
        const way w = way_choose(&setup, 0.5, false);
        if (k < 2)
            assert_true(w.row == NULL && strcmp(w.name, "cell") == 0);
        else if (k == 2)
            assert_true(w.row != NULL && (w.row->domain & METHOD_PIPELINE) != 0);
        else
            assert_true(w.row == NULL && w.name == NULL);
    }
}

/* Eight guaranteed separations to either side, 2^12 steps of z at least, at most 2^15 of the binade below. */
TEST(window_of_an_interval) {
    rng r = rng_make("windows");
    tally t = {.name = "windows"};
    uint64_t least = 0, most = 0, eight = 0;
    for (uint64_t n = test_cases(300, 3000, 30000); n > 0; n--) {
        const dp_setup exact = random_setup(&r, (int)rng_below(&r, 2) * 5); /* unorm24 d3d or fp32 d3d */
        dp_spec spec = exact.spec;
        dp_setup setup;
        double lo, hi;
        spec.model = DP_MODEL_FLOAT;
        if (dp_setup_init(&setup, &spec) != DP_OK)
            continue;
        const double end = isinf(spec.zfar) ? 1e6 * spec.znear : spec.zfar;
        const double z = fmin(fmax((double)(float)rng_log(&r, spec.znear, end), spec.znear), end);
        const bool all = truth_window(&setup, z, &lo, &hi);
        const double step = ldexp(1.0, ilogb(z) - 23), separation = dp_separation(&setup, z);
        const double reach = fmin(fmax(8 * separation, 4096 * step), 16384 * step);
        *(8 * separation > 16384 * step ? &most : reach > 4096 * step ? &eight : &least) += 1;
        TALLY(&t,
              fabs(lo - fmax(z - reach, spec.znear)) <= 0.01 * reach &&
                  fabs(hi - fmin(z + reach, spec.zfar)) <= 0.01 * reach && all == (8 * separation <= 16384 * step),
              "near %a far %a at %a: %a to %a, reach %a", spec.znear, spec.zfar, z, lo, hi, reach);
    }
    print_message("# %lu of eight, %lu of the least, %lu of the most\n", (unsigned long)eight, (unsigned long)least,
                  (unsigned long)most);
    assert_true(least > 0 && most > 0 && eight > 0);
    tally_end(&t);
}

/* No interval of the pipeline near z is longer, by a plain scan. */
TEST(the_pipeline_has_methods_too) {
    for (int kind = 0; kind < 2; kind++) {
        dp_setup setup = make(kind, 0.1, 1000, false);
        dp_spec spec = setup.spec;
        spec.model = DP_MODEL_FLOAT;
        assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
        const way w = way_choose(&setup, 0.01, false);
        assert_non_null(w.row);
        for (double z = 0.15; z < 900; z *= 3.7) {
            double lo, hi;
            truth_window(&setup, z, &lo, &hi);
            assert_relative(way_interval(&w, &setup, z), truth_longest(&setup, lo, hi, truth_step(z)), w.claim);
        }
        assert_true(isnan(way_interval(&w, &setup, 1000)));
    }
}

/* The model chosen is the library's, tolerance by tolerance, over more depths than a block holds. */
TEST(models_are_chosen_as_the_library_does) {
    rng r = rng_make("models");
    tally t = {.name = "models"};
    for (uint64_t n = test_cases(100, 1000, 10000); n > 0; n--) {
        enum { DEPTHS = 3 * CHOICE_BLOCK + 5 };
        const dp_setup setup = random_setup(&r, (int)rng_below(&r, KINDS));
        const double tolerance = rng_below(&r, 8) == 0 ? 0 : rng_log(&r, 1e-5, 10);
        double z[DEPTHS];
        dp_choice want;
        choosing c = choosing_start(&setup, tolerance);
        for (int i = 0; i < DEPTHS; i++) {
            const double hi = isinf(setup.spec.zfar) ? 1e5 * setup.spec.znear : setup.spec.zfar;
            z[i] = fmin(fmax(rng_log(&r, setup.spec.znear, hi), setup.spec.znear), hi);
            choosing_add(&c, z[i]);
        }
        choosing_finish(&c);
        assert_int_equal(dp_model_choose(&setup, z, DEPTHS, tolerance, &want), DP_OK);
        TALLY(&t, c.choice.model == want.model, "%s tolerance %g: %s, not %s", setup.spec.format.name, tolerance,
              dp_model_name(c.choice.model), dp_model_name(want.model));
    }
    tally_end(&t);
}

/* A figure drawn by the method that is good enough lies within half a pixel of the exact one. */
TEST(figures_look_the_same) {
    rng r = rng_make("figures");
    tally t = {.name = "figures"};
    uint64_t by_method = 0;
    for (uint64_t n = test_cases(20, 150, 2000); n > 0; n--) {
        enum { ROWS = 400 };
        const dp_setup setup = random_setup(&r, (int)(n % 2));
        const char *const names[] = {"curve"};
        figure_request q = {.setups = &setup,
                            .count = 1,
                            .names = names,
                            .lo = NAN,
                            .hi = NAN,
                            .at = NAN,
                            .columns = 600,
                            .rows = ROWS,
                            .tolerance = NAN};
        chart *drawn = chart_new();
        assert_null(figure_find("interval")->build(&q, drawn));
        const chart_panel *panel = &drawn->panels[0];
        const chart_series *s = &panel->series[0];
        by_method += s->method != NULL;
        double from = setup.spec.znear, hi;
        figure_range(&q, &from, &hi);
        for (size_t i = 0, k = 0; k < 600; k++) {
            const double a = refine_edge(CHART_LOG, from, hi, (int)k, 600);
            const double b = refine_edge(CHART_LOG, from, hi, (int)k + 1, 600), x = sqrt(a) * sqrt(b);
            dp_worst w;
            assert_int_equal(dp_worst_over(&setup, a, b, &w), DP_OK);
            while (i + 2 < s->count && s->x[i + 1] < x * (1 - 1e-12))
                i++;
            const double share = log(x / s->x[i]) / log(s->x[i + 1] / s->x[i]);
            const double y = log(s->y[i]) + share * (log(s->y[i + 1]) - log(s->y[i]));
            const double off = fabs(y - log(w.interval)) / log(panel->y.hi / panel->y.lo) * ROWS;
            TALLY(&t, isinf(w.interval) || isnan(y) || off <= 0.5 + 1e-6, "%s near %a far %a column %zu: %g px off",
                  setup.spec.format.name, setup.spec.znear, setup.spec.zfar, k, off);
        }
        chart_free(drawn);
    }
    assert_true(by_method > 0);
    tally_end(&t);
}
