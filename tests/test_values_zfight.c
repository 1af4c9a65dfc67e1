/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every value that zfight prints, against a census of the same depths. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "census/census.h"
#include "printed.h"

typedef struct zfight_case {
    camera_case camera;
    double lo, hi;
    double gap;
    uint64_t sample, seed;
} zfight_case;

static const zfight_case cases[] = {
    /* A fraction of the depths is clipped before far, none between the planes that are left. */
    {{0.1,
      16.1,
      {"unorm24", "fp16"},
      {"d3d", "gl-reversed"},
      .implied = true,
      .model = DP_MODEL_FLOAT,
      .arith = "mesa-remap"},
     15.99,
     16.1,
     0,
     0,
     0},
    /* Far is drawn, the depth before it is not: a hole. */
    {{1, 10, {"fp32"}, {"d3d"}, .implied = true, .model = DP_MODEL_FLOAT, .unit = "in"}, 9.99, 10, 0, 0, 0},
    {{0.3, 900, {"unorm16"}, {"gl", "reversed"}, .implied = true, .model = DP_MODEL_FLOAT, .rounding = DP_ROUND_ZERO},
     7.98,
     8.03,
     2.5e-3,
     0,
     0},
    {{0.3, 900, {"fp32"}, {"reversed"}, .implied = true, .model = DP_MODEL_FLOAT, .rounding = DP_ROUND_EVEN},
     5,
     300,
     0,
     5000,
     UINT64_C(8589934597)},
    {{2, 60, {"unorm24"}, {"d3d"}, .implied = true, .model = DP_MODEL_FLOAT, .ortho = 1}, 3, 50, 4e-6, 3000, 7},
    /* Behind the camera. */
    {{-100, 60, {"unorm24"}, {"d3d"}, .implied = true, .model = DP_MODEL_FLOAT, .ortho = 1}, -8.01, -7.99, 0, 0, 0},
    {{-100, 60, {"unorm24"}, {"d3d"}, .implied = true, .model = DP_MODEL_FLOAT, .ortho = 1}, -8.01, -7.99, 8e-6, 0, 0},
    {{-100, 60, {"unorm16"}, {"reversed"}, .implied = true, .model = DP_MODEL_FLOAT, .ortho = 1},
     -100,
     60,
     1e-3,
     900,
     3},
};

static void census_of(const zfight_case *c, const dp_setup *setup, census_result *out) {
    const census_sample_request q = {.common = {.setup = setup, .lo = c->lo, .hi = c->hi, .bound = dp_separation},
                                     .count = c->sample,
                                     .seed = c->seed,
                                     .gap = c->gap};
    assert_int_equal(c->sample > 0 || c->gap > 0 ? census_sample(&q, out) : census_run(&q.common, out), CENSUS_DONE);
}

/* With a gap there are no intervals, and no share of the bound that they take. */
static void want_counts(values *v, const zfight_case *c, const census_band *b) {
    const bool intervals = c->gap <= 0;
    want_number(v, "lo", b->lo);
    want_number(v, "hi", b->hi);
    want_count(v, "pairs", b->pairs);
    want_count(v, "ties", b->ties);
    want_count(v, "swaps", b->swaps);
    want_number(v, "longest", intervals ? b->longest : NAN);
    want_number(v, "longest_z", b->longest_z);
    want_number(v, "bound", b->bound);
    want_number(v, "used", intervals ? b->slack : NAN);
    want_derived(v, "ties_share", 100 * (double)b->ties / (double)b->pairs);
    want_derived(v, "swaps_share", 100 * (double)b->swaps / (double)b->pairs);
}

/* The depth behind the last pair in order; none where no pair of the range begins there. */
static double always_from(const zfight_case *c, double last) {
    float z = nextafterf((float)last, HUGE_VALF);
    if (isnan(last))
        for (z = (float)c->lo; (double)z < c->lo;)
            z = nextafterf(z, HUGE_VALF);
    return (double)(float)((double)z + c->gap) <= c->hi ? (double)z : NAN;
}

static void want_census(values *v, const zfight_case *c, const dp_setup *setup, size_t i, line_places *shown,
                        line_places *lines) {
    static census_result r;
    const bool counted = c->sample == 0 && c->gap <= 0;
    int kept = 0;
    census_of(c, setup, &r);
    for (int b = 0; b < r.band_count; b++) {
        char inner[32];
        if (r.bands[b].pairs == 0)
            continue;
        snprintf(inner, sizeof inner, "bands[%d].", kept);
        values_under(v, "setups[%zu].bands[%d].", i, kept++);
        want_counts(v, c, &r.bands[b]);
        want_derived(v, "clipped", counted ? (double)r.bands[b].clipped : NAN);
        place_add(shown, inner, "setups[%zu].", i);
        place_add(lines, inner, "setups[%zu].", i);
    }
    place_add(shown, "", "setups[%zu].", i);
    values_under(v, "setups[%zu].", i);
    want_setup(v, setup);
    want_text(v, "method", c->sample > 0 ? "sample" : "census");
    (c->sample > 0 ? want_number : want_derived)(v, "seed", (double)c->seed);
    (c->gap > 0 ? want_number : want_derived)(v, "gap", c->gap);
    want_counts(v, c, &r.all);
    want_derived(v, "guaranteed_there", dp_separation(setup, r.all.longest_z));
    if (counted) {
        want_count(v, "clipped", r.all.clipped);
        want_count(v, "holes", r.holes);
    }
    if (c->gap > 0) {
        want_number(v, "first", r.all.first);
        want_number(v, "always_from", always_from(c, r.all.last_apart));
    }
    want_number(v, "near_effective", r.near_effective);
    want_number(v, "far_effective", r.far_effective);
}

/* The sentence above the first set-up's table. */
static void check_answer(const values *v, const char *text) {
    static const char *const neighbours[] = {"setups[0].ties_share", "setups[0].swaps_share", NULL};
    static const char *const longest[] = {"setups[0].longest", "setups[0].longest_z", "setups[0].guaranteed_there",
                                          NULL};
    static const char *const always[] = {"setups[0].first", "setups[0].always_from", NULL};
    static const char *const first[] = {"setups[0].first", NULL};
    const wanted *from = value_find(v, "setups[0].first"), *on = value_find(v, "setups[0].always_from");
    if (from == NULL) {
        check_text_numbers(v, text, "Neighbouring binary32 depths", 3, neighbours);
        check_text_numbers(v, text, "longest interval", 6, longest);
        return;
    }
    char label[128];
    const double gap = value_at(v, "setups[0].gap")->number;
    snprintf(label, sizeof label, "%s %g apart %s",
             strstr(text, "Of the pairs drawn") != NULL ? "Of the pairs drawn, surfaces" : "Surfaces", gap,
             isnan(from->number) ? "never fight" : "first fight at z =");
    if (isnan(from->number))
        assert_non_null(strstr(text, label));
    else
        check_text_numbers(v, text, label, 6, isnan(on->number) ? first : always);
    assert_true(isnan(from->number) || (strstr(text, "at no depth do all") != NULL) == isnan(on->number));
}

static void test_zfight(void **state) {
    static const csv_column columns[] = {SETUP_COLUMNS,
                                         {"arith", "^arith"},
                                         {"method", "^method"},
                                         {"seed", "^seed"},
                                         {"gap [scene]", "^gap"},
                                         {"lo [scene]", "lo"},
                                         {"hi [scene]", "hi"},
                                         {"pairs", "pairs"},
                                         {"ties", "ties"},
                                         {"swaps", "swaps"},
                                         {"longest [scene]", "longest"},
                                         {"longest_z [scene]", "longest_z"},
                                         {"bound [scene]", "bound"},
                                         {"used", "used"},
                                         {"clipped", "clipped"},
                                         {"near_effective [scene]", "^near_effective"},
                                         {"far_effective [scene]", "^far_effective"}};
    static const text_column of_intervals[] = {{"lo", 6},          {"hi", 6},           {"pairs", 10},
                                               {"ties_share", -4}, {"swaps_share", -4}, {"longest", 6},
                                               {"longest_z", 6},   {"bound", 6},        {"used", -3}};
    static const text_column of_gaps[] = {{"lo", 6},          {"hi", 6},           {"pairs", 10},
                                          {"ties_share", -4}, {"swaps_share", -4}, {"bound", 6}};
    static const char *const drawn[] = {"setups[0].near_effective", "setups[0].far_effective", NULL};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const zfight_case *c = &cases[i];
        values v = values_of("zfight");
        v.unit = c->camera.unit;
        line_places shown = {0}, lines = {0};
        dp_setup setups[CAMERA_SETUPS];
        char options[512], arguments[1024];
        size_t used = (size_t)snprintf(arguments, sizeof arguments, "zfight %s --range %.17g:%.17g -q",
                                       camera_options(&c->camera, options), c->lo, c->hi);
        if (c->gap > 0)
            used += (size_t)snprintf(arguments + used, sizeof arguments - used, " --separation %.17g", c->gap);
        if (c->sample > 0)
            snprintf(arguments + used, sizeof arguments - used, " --sample %llu --seed %llu",
                     (unsigned long long)c->sample, (unsigned long long)c->seed);
        const size_t n = camera_setups(&c->camera, setups);
        for (size_t k = 0; k < n; k++)
            want_census(&v, c, &setups[k], k, &shown, &lines);
        check_json(&v, 0, arguments);
        check_csv(&v, 0, arguments, columns, sizeof columns / sizeof columns[0], &lines);
        printed p = print_of("%s --full", arguments);
        check_text_table(&v, p.out, c->gap > 0 ? of_gaps : of_intervals, c->gap > 0 ? 6 : 9, &shown);
        check_text_numbers(&v, p.out, "effective clip range", 9, drawn);
        check_answer(&v, p.out);
        printed_free(&p);
        values_free(&v);
        places_free(&shown);
        places_free(&lines);
    }
}

/* What stderr says about geometry that is not drawn: how many holes, between which planes. */
static void test_warning(void **state) {
    static const char *const hole[] = {"holes", "near_effective", "far_effective", NULL};
    static const char *const kept[] = {"near_effective", "far_effective", NULL};
    static const char *const labels[] = {"depthprec: warning: unorm24 d3d: clipping in binary32 keeps only",
                                         "depthprec: warning: fp32 d3d: clipping in binary32 loses"};
    static census_result r;
    (void)state;
    for (int i = 0; i < 2; i++) {
        const zfight_case *c = &cases[i];
        dp_setup setups[CAMERA_SETUPS];
        char options[512];
        values v = values_of("zfight");
        v.unit = c->camera.unit;
        camera_setups(&c->camera, setups);
        census_of(c, setups, &r);
        want_count(&v, "holes", r.holes);
        want_number(&v, "near_effective", r.near_effective);
        want_number(&v, "far_effective", r.far_effective);
        printed p = print_of("zfight %s --range %.17g:%.17g", camera_options(&c->camera, options), c->lo, c->hi);
        check_text_numbers(&v, p.errors, labels[i], 9, i == 0 ? kept : hole);
        printed_free(&p);
        values_free(&v);
    }
}

/* ---- The bound of a band ----------------------------------------------------------------------------------------- */

static double peak_z, peak;

/* 1 everywhere but at one depth. */
static double peaked(const dp_setup *setup, double z) {
    (void)setup;
    return z == peak_z ? peak : 1;
}

/* The guarantee is looked at where the longest interval is, and at both ends of the band; the sum of the bands has the
 * greatest. */
static void test_bound(void **state) {
    static census_result r;
    dp_setup setups[CAMERA_SETUPS];
    census_request q = {.setup = setups, .lo = 3.99, .hi = 4.01, .bound = peaked};
    (void)state;
    camera_setups(&cases[1].camera, setups);
    peak = 1;
    assert_int_equal(census_run(&q, &r), CENSUS_DONE);
    assert_int_equal(r.band_count, 2);
    for (int i = 0; i < 2; i++) /* inside, where the looks from one end to the other miss it */
        assert_true(r.bands[i].longest_z > r.bands[i].lo && r.bands[i].longest_z < r.bands[i].hi);
    const double places[] = {r.bands[1].longest_z, r.bands[1].lo, r.bands[1].hi};
    peak = 5;
    for (int i = 0; i < 3; i++) {
        peak_z = places[i];
        assert_int_equal(census_run(&q, &r), CENSUS_DONE);
        assert_true(r.bands[0].bound == 1 && r.bands[1].bound == 5 && r.all.bound == 5);
    }
    peak_z = r.bands[0].longest_z;
    assert_int_equal(census_run(&q, &r), CENSUS_DONE);
    assert_true(r.bands[0].bound == 5 && r.bands[1].bound == 1 && r.all.bound == 5);
}

/* 1 everywhere, by hand: no two surfaces are farther apart than what is left up to far, 10. */
static void test_bound_ends_at_far(void **state) {
    static const struct {
        double lo, hi, bound;
    } rows[] = {{9.25, 10, 0.75}, {9.5, 9.75, 0.5}, {8.5, 10, 1}, {8.5, 8.75, 1}};
    static census_result r;
    dp_setup setups[CAMERA_SETUPS];
    (void)state;
    camera_setups(&cases[1].camera, setups);
    peak = 1;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const census_request q = {.setup = setups, .lo = rows[i].lo, .hi = rows[i].hi, .bound = peaked};
        assert_int_equal(census_run(&q, &r), CENSUS_DONE);
        assert_true(r.band_count == 1 && r.bands[0].bound == rows[i].bound && r.all.bound == rows[i].bound);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_zfight), cmocka_unit_test(test_warning),
        cmocka_unit_test(test_bound),  cmocka_unit_test(test_bound_ends_at_far),
        cmocka_unit_test(check_apart),
    };
    return run_tap(tests);
}
