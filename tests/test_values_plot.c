/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The numbers of figures: those of a map and of a budget against the library, the envelopes of error and interval
 * between the value at each point and the worst up to its neighbours; and CSV against JSON, for every figure.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "census/census.h"
#include "method/choose.h"
#include "named.h"
#include "printed.h"

/* ---- What a run printed ------------------------------------------------------------------------------------------ */

static json_t *at(const json_t *root, const char *key, size_t index) {
    json_t *found = json_array_get(json_object_get(root, key), index);
    assert_non_null(found);
    return found;
}

static const char *text_in(const json_t *o, const char *key) {
    const char *text = json_string_value(json_object_get(o, key));
    assert_non_null(text);
    return text;
}

/* Null is NaN here; in CSV it may be infinite. */
static double number_in(const json_t *o, const char *key) {
    const json_t *j = json_object_get(o, key);
    assert_non_null(j);
    return json_is_number(j) ? json_number_value(j) : NAN;
}

static void check_axis(const json_t *root, const char *axis, const char *key, const char *label, const char *unit,
                       const char *scale) {
    const json_t *o = json_object_get(root, axis);
    assert_non_null(o);
    assert_string_equal(text_in(o, "key"), key);
    assert_string_equal(text_in(o, "label"), label);
    assert_string_equal(text_in(o, "unit"), unit);
    assert_string_equal(text_in(o, "scale"), scale);
}

static json_t *plot(const char *arguments) {
    printed p = print_of("plot %s --json", arguments);
    if (p.status != 0)
        fail_msg("plot %s: %s", arguments, p.errors);
    json_t *root = json_of(p.out);
    printed_free(&p);
    return root;
}

/* ---- CSV against JSON -------------------------------------------------------------------------------------------- */

static void head_of(const json_t *root, const char *axis, char out[160]) {
    const json_t *o = json_object_get(root, axis);
    snprintf(out, 160, *text_in(o, "unit") != '\0' ? "%.70s [%.70s]" : "%.70s%.0s", text_in(o, "key"),
             text_in(o, "unit"));
}

/* The values of one point, under the names of the columns. */
static void want_points(values *v, const json_t *root, double end, line_places *lines) {
    static const char *const axes[] = {"x", "y", "second", "value"};
    size_t p, s, i;
    json_t *panel, *series, *point;
    json_array_foreach(json_object_get(root, "panels"), p, panel)
        json_array_foreach(json_object_get(panel, "series"), s, series)
            json_array_foreach(json_object_get(series, "points"), i, point) {
        values_under(v, "%zu.", lines->count);
        want_text(v, "panel", text_in(panel, "title"));
        want_text(v, "series", text_in(series, "name"));
        for (int k = 0; k < 4; k++) {
            const json_t *axis = json_object_get(root, axes[k]);
            const json_t *j = axis != NULL ? json_object_get(point, text_in(axis, "key")) : NULL;
            if (j != NULL)
                want_number(v, axes[k], json_is_number(j) ? json_number_value(j) : k == 3 ? NAN : end);
        }
        place_add(lines, "", "%zu.", lines->count);
    }
}

/* JSON says null where a curve ends and CSV says inf, or nothing; a field of a map is empty in both. */
static void check_both(const char *arguments, double end) {
    static const char *const axes[] = {"x", "y", "second", "value"}, *const paths[] = {"x", "?y", "?second", "?value"};
    char heads[4][160];
    csv_column columns[6] = {{"panel", "panel"}, {"series", "series"}};
    json_t *root = plot(arguments);
    values v = values_of("plot");
    line_places lines = {0};
    size_t count = 2;
    want_points(&v, root, end, &lines);
    for (int k = 0; k < 4; k++)
        if (json_object_get(root, axes[k]) != NULL) {
            head_of(root, axes[k], heads[k]);
            columns[count++] = (csv_column){heads[k], paths[k]};
        }
    assert_true(lines.count > 0);
    char line[512];
    snprintf(line, sizeof line, "plot %s", arguments);
    check_csv(&v, 0, line, columns, count, &lines);
    json_decref(root);
    values_free(&v);
    places_free(&lines);
}

static void test_both_forms(void **state) {
    static const char *const figures[] = {"distribution -F unorm4 -n 1 -f 10 -m d3d,log",
                                          "share -F unorm16,fp32",
                                          "error -F unorm16 -m d3d,reversed -f inf",
                                          "interval -F unorm24,fp32 -m reversed --tolerance 1%",
                                          "interval -F fp32 -n 1 -f 1.25 --model float",
                                          "budget -F unorm16,fp32 -m d3d",
                                          "map -F unorm16 -m d3d --at 7"};
    (void)state;
    for (size_t i = 0; i < sizeof figures / sizeof figures[0]; i++)
        check_both(figures[i], INFINITY);
    check_both("needs tests/needs/village.need", NAN);
}

/* ---- Values ------------------------------------------------------------------------------------------------------ */

static dp_setup setup_of(double znear, double zfar, const char *format, dp_mapping mapping, dp_model model) {
    dp_spec spec = dp_spec_default();
    dp_format found[2];
    dp_setup setup;
    spec.znear = znear;
    spec.zfar = zfar;
    spec.mapping = mapping;
    spec.model = model;
    assert_int_equal(dp_format_parse(format, found), 1);
    spec.format = found[0];
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    return setup;
}

/* A field is the widest cell of a camera with the near and far plane that stand beside it. */
/* Near and far of every field, on even steps of the axes; what is known of each against the library. */
static void check_map(const json_t *root, dp_spec spec, bool any_sign) {
    tally t = {.name = "map"};
    json_t *point;
    const json_t *panel = at(root, "panels", 0), *camera = at(panel, "series", 0), *map = at(panel, "series", 1);
    const char *scale = any_sign ? "linear" : "log";
    size_t i, known = 0, nears = 0, fars = 0, behind = 0;
    double last[2] = {0, 0};
    check_axis(root, "x", "near", "near plane", "scene units", scale);
    check_axis(root, "y", "far", "far plane", "scene units", scale);
    check_axis(root, "value", "interval", "worst z-fighting interval", "scene units", "log");
    assert_string_equal(text_in(root, "figure"), "map");
    assert_string_equal(text_in(map, "name"), "map");
    assert_string_equal(text_in(camera, "name"), "camera");
    const json_t *place = at(camera, "points", 0);
    assert_true(number_in(place, "near") == spec.znear && number_in(place, "far") == spec.zfar);
    json_array_foreach(json_object_get(map, "points"), i, point) {
        const double znear = number_in(point, "near"), zfar = number_in(point, "far");
        dp_worst worst = {.interval = NAN};
        dp_setup setup;
        spec.znear = znear;
        spec.zfar = zfar;
        if (dp_setup_init(&setup, &spec) == DP_OK)
            assert_int_equal(dp_worst_over(&setup, znear, zfar, &worst), DP_OK);
        const double got = number_in(point, "interval");
        TALLY(&t, got == worst.interval || (isnan(got) && isnan(worst.interval)), "near %g far %g: %g, not %g", znear,
              zfar, got, worst.interval);
        known += isfinite(got) ? 1 : 0;
        behind += isfinite(got) && znear < 0 ? 1 : 0;
        nears += znear != last[0];
        fars += zfar != last[1];
        last[0] = znear;
        last[1] = zfar;
    }
    TALLY(&t, known > 100 && nears > 2 * fars && fars > 10, "%zu values, %zu and %zu steps", known, nears, fars);
    assert_true((behind > 0) == any_sign);
    tally_end(&t);
}

static void test_map(void **state) {
    json_t *root = plot("map -F unorm16 -m d3d -n 0.5 -f 300 --title 'a \"quoted\" ti\\tle'");
    dp_spec spec = setup_of(0.5, 300, "unorm16", DP_MAPPING_D3D, DP_MODEL_EXACT).spec;
    (void)state;
    assert_string_equal(text_in(root, "title"), "a \"quoted\" ti\\tle");
    assert_string_equal(text_in(root, "subtitle"),
                        "unorm16 d3d, near 0.5, far 300, perspective, nearest, exact. Hatched: far is not behind near");
    check_map(root, spec, false);
    json_decref(root);
    root = plot("map --ortho -F unorm16 -m d3d -n -10 -f 50");
    spec.ortho = true;
    spec.znear = -10;
    spec.zfar = 50;
    check_map(root, spec, true);
    json_decref(root);
}

static const char *cause_of(const json_t *series, int *cause) {
    for (*cause = 0; *cause < DP_CAUSE_COUNT; (*cause)++)
        if (strcmp(text_in(series, "name"), dp_cause_name((dp_cause)*cause)) == 0)
            return dp_cause_name((dp_cause)*cause);
    return NULL;
}

/* Each band is the share of the cause that it is named after; the line is the separation, on the second axis. */
static void check_budget(const char *options, const dp_setup *setup, const dp_budget_terms *terms, size_t causes) {
    tally t = {.name = options};
    char command[256];
    snprintf(command, sizeof command, "budget -F fp32 -n 0.5 -f 300 -m %s", options);
    json_t *root = plot(command), *series, *point;
    size_t s, i, seen = 0;
    check_axis(root, "x", "z", "eye depth z", "scene units", "log");
    check_axis(root, "y", "share", "share of the separation", "%", "linear");
    check_axis(root, "second", "separation", "guaranteed separation", "scene units", "log");
    json_array_foreach(json_object_get(at(root, "panels", 0), "series"), s, series) {
        int cause;
        const bool is_band = cause_of(series, &cause) != NULL;
        seen += is_band ? 1 : 0;
        TALLY(&t, is_band || strcmp(text_in(series, "name"), "separation, right axis") == 0, "%s",
              text_in(series, "name"));
        json_array_foreach(json_object_get(series, "points"), i, point) {
            dp_budget b;
            const double z = number_in(point, "z"), got = number_in(point, is_band ? "share" : "separation");
            assert_int_equal(dp_budget_at(setup, z, terms, &b), DP_OK);
            const double want = !is_band ? b.separation : 100 * b.cause[cause] / b.separation;
            /* A curve is an envelope over a pixel column: it may lie a little above what is at its point. */
            TALLY(&t, isnan(got) ? isinf(b.separation) : fabs(got - want) <= 0.05 * fabs(want) + 0.5 * is_band,
                  "%s at %g: %g, not %g", text_in(series, "name"), z, got, want);
        }
    }
    TALLY(&t, seen == causes, "%zu causes", seen);
    json_decref(root);
    tally_end(&t);
}

static void test_budget(void **state) {
    dp_setup setup = setup_of(0.5, 300, "fp32", DP_MAPPING_D3D, DP_MODEL_FLOAT);
    const dp_budget_terms terms = {.interpolation = 2, .world = 50, .linearize = 1};
    (void)state;
    check_budget("d3d --interpolation 2 --from-origin 50 --linearize", &setup, &terms, 7);
    setup.spec.triangles = (dp_triangles){640, 480, 50, 0, {3, 10, 2, 4}, 20, 90, 2, 100, 16};
    assert_int_equal(dp_arith_parse("mesa", &setup.spec.arith), DP_OK); /* the rasterizer brings it */
    check_budget("d3d --viewport 640x480 --fov 50 --raster llvmpipe --slant 20:90 --triangle-class pixels=100", &setup,
                 &(dp_budget_terms){0}, 6);
    setup = setup_of(0.5, 300, "fp32", DP_MAPPING_LOG, DP_MODEL_EXACT);
    check_budget("log --log2 d3d", &setup, &(dp_budget_terms){.log2 = 1}, 5);
    setup = setup_of(0.5, 300, "fp32", DP_MAPPING_OSGEARTH, DP_MODEL_EXACT);
    check_budget("osgearth --interpolation 3", &setup, &(dp_budget_terms){.interpolation = 3}, 7);
}

/* An envelope is above the value at each point, and not above the worst between its neighbours. */
static void check_envelope(const char *figure, bool is_error) {
    static const struct {
        const char *name, *format;
        dp_mapping mapping;
    } setups[] = {{"unorm16 d3d", "unorm16", DP_MAPPING_D3D},
                  {"unorm16 reversed", "unorm16", DP_MAPPING_REVERSED},
                  {"fp32 d3d", "fp32", DP_MAPPING_D3D},
                  {"fp32 reversed", "fp32", DP_MAPPING_REVERSED}};
    char arguments[256];
    tally t = {.name = figure};
    snprintf(arguments, sizeof arguments, "%s -F unorm16,fp32 -m d3d,reversed -n 0.5 -f 300", figure);
    json_t *root = plot(arguments);
    const char *key = is_error ? "error" : "interval";
    check_axis(root, "x", "z", "eye depth z", "scene units", "log");
    assert_string_equal(text_in(json_object_get(root, "y"), "key"), key);
    for (size_t s = 0; s < 4; s++) {
        const dp_setup setup = setup_of(0.5, 300, setups[s].format, setups[s].mapping, DP_MODEL_EXACT);
        const json_t *series = at(at(root, "panels", 0), "series", s), *points = json_object_get(series, "points");
        TALLY(&t, strcmp(text_in(series, "name"), setups[s].name) == 0, "%s", text_in(series, "name"));
        for (size_t i = 1; i + 1 < json_array_size(points); i++) {
            const double z = number_in(json_array_get(points, i), "z"), got = number_in(json_array_get(points, i), key);
            dp_sample here;
            dp_worst worst;
            assert_int_equal(dp_sample_at(&setup, z, &here), DP_OK);
            assert_int_equal(dp_worst_over(&setup, number_in(json_array_get(points, i - 1), "z"),
                                           number_in(json_array_get(points, i + 1), "z"), &worst),
                             DP_OK);
            TALLY(&t, got >= (is_error ? fabs(here.error) : here.interval) * (1 - 1e-6), "%s at %g: %g below",
                  setups[s].name, z, got);
            TALLY(&t, got <= (is_error ? worst.error : worst.interval) * (1 + 1e-6), "%s at %g: %g above",
                  setups[s].name, z, got);
        }
    }
    json_decref(root);
    tally_end(&t);
}

static void test_envelopes(void **state) {
    (void)state;
    check_envelope("error", true);
    check_envelope("interval", false);
}

/* A curve by a method names the one that --tolerance takes; the exact one names none. */
static void test_method(void **state) {
    const method_family_row *family = method_family_find("interval");
    const method_wish wish = {.tolerance = 0.01, .ratio_lo = 600, .ratio_hi = 600};
    json_t *root = plot("interval -F unorm24,fp16 -m d3d -n 0.5 -f 300 --tolerance 1%");
    (void)state;
    assert_string_equal(family->cases[0].name, "unorm24 d3d");
    assert_string_equal(text_in(at(at(root, "panels", 0), "series", 0), "method"),
                        method_choose(family, 0, &wish)->name);
    assert_null(json_object_get(at(at(root, "panels", 0), "series", 1), "method"));
    json_decref(root);
}

/* The points of a census: the longest interval of each band, at its nearer depth. */
static void test_census(void **state) {
    static census_result r;
    const dp_setup setup = setup_of(1.95, 2.05, "unorm16", DP_MAPPING_D3D, DP_MODEL_FLOAT);
    const census_request q = {.setup = &setup, .lo = 1.95, .hi = 2.05};
    json_t *root = plot("interval -F unorm16 -m d3d -n 1.95 -f 2.05 --model float");
    const json_t *series = at(at(root, "panels", 0), "series", 2);
    (void)state;
    assert_string_equal(text_in(series, "name"), "unorm16 d3d, census");
    assert_int_equal(census_run(&q, &r), CENSUS_DONE);
    assert_int_equal(r.band_count, 2);
    assert_int_equal(json_array_size(json_object_get(series, "points")), 2);
    for (size_t i = 0; i < 2; i++) {
        assert_true(r.bands[i].longest_z > r.bands[i].lo);
        assert_true(number_in(at(series, "points", i), "z") == r.bands[i].longest_z);
        assert_true(number_in(at(series, "points", i), "interval") == r.bands[i].longest);
    }
    json_decref(root);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_both_forms), cmocka_unit_test(test_map),    cmocka_unit_test(test_budget),
        cmocka_unit_test(test_envelopes),  cmocka_unit_test(test_method), cmocka_unit_test(test_census),
    };
    return run_tap(tests);
}
