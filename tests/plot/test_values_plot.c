/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The numbers of figures: those of a map and of a budget against the library, the envelopes of error and interval
 * between the value at each point and the worst up to its neighbours; and CSV against JSON, of figures whose series
 * have places of their own (the others: test_drawn_data.c).
 */
#include "core/engine.h"
#include "method/choose.h"
#include "named.h"
#include "printed.h"
#include "zfight/census.h"

/* ---- What a run printed ------------------------------------------------------------------------------------------ */

static void check_axis(const json_t *root, const char *axis, const char *key, const char *label, const char *unit,
                       const char *scale) {
    assert_string_equal(text_at(root, "%s.key", axis), key);
    assert_string_equal(text_at(root, "%s.label", axis), label);
    assert_string_equal(text_at(root, "%s.unit", axis), unit);
    assert_string_equal(text_at(root, "%s.scale", axis), scale);
}

/* ---- CSV against JSON -------------------------------------------------------------------------------------------- */

/* The values of one point, under the names of the columns. @return whether some have labels */
static bool want_points(values *v, const json_t *root, double end) {
    bool labels = false;
    static const char *const axes[] = {"x", "y", "second", "value"};
    size_t p, s, i, lines = 0;
    json_t *panel, *series, *point;
    json_array_foreach(node_at(root, "panels"), p, panel) json_array_foreach(node_at(panel, "series"), s, series)
        json_array_foreach(node_at(series, "points"), i, point) {
        values_under(v, "lines[%zu].", lines++);
        want(v, "panel=%s series=%s", text_at(panel, "title"), text_at(series, "name"));
        for (int k = 0; k < 4; k++) {
            const json_t *axis = node_at(root, "%s", axes[k]);
            const json_t *j = axis != NULL ? node_at(point, "%s", text_at(axis, "key")) : NULL;
            if (j != NULL)
                want_number(v, axes[k], json_is_number(j) ? json_number_value(j) : k == 3 ? NAN : end);
        }
        if (json_object_get(point, "label") != NULL) {
            want_text(v, "label", text_at(point, "label"));
            labels = true;
        }
    }
    assert_true(lines > 0);
    return labels;
}

/* JSON says null where a curve ends and CSV says inf, or nothing; a field of a map is empty in both. */
static void check_both(const char *arguments, double end) {
    static const char *const axes[] = {"x", "y", "second", "value"};
    char columns[1024] = "panel, series", line[512];
    json_t *root = json_printed(0, "plot %s", arguments);
    values v = values_of("plot");
    const bool labels = want_points(&v, root, end);
    for (int k = 0; k < 4; k++)
        if (node_at(root, "%s", axes[k]) != NULL) {
            const char *unit = text_at(root, "%s.unit", axes[k]);
            snprintf(columns + strlen(columns), sizeof columns - strlen(columns), ", %s%s%s%s%s = %s", k > 0 ? "?" : "",
                     text_at(root, "%s.key", axes[k]), *unit != '\0' ? " [" : "", unit, *unit != '\0' ? "]" : "",
                     axes[k]);
        }
    if (labels)
        snprintf(columns + strlen(columns), sizeof columns - strlen(columns), ", ?label = label");
    snprintf(line, sizeof line, "plot %s", arguments);
    line_places lines = places_of(&v, "lines[]");
    check_csv(&v, 0, line, columns, &lines);
    places_free(&lines);
    json_decref(root);
    values_free(&v);
}

TEST(both_forms) {
    static const char *const figures[] = {"distribution -F unorm4 -n 1 -f 10 -m d3d,log",
                                          "map -F unorm16 -m d3d --at 7", "stability linearize"};
    for (size_t i = 0; i < sizeof figures / sizeof figures[0]; i++)
        check_both(figures[i], INFINITY);
    check_both("needs tests/needs/village.need", NAN);
}

/* ---- Values ------------------------------------------------------------------------------------------------------ */

/* A field is the widest cell of a camera with the near and far plane that stand beside it, on even steps of the axes.
 */
static void check_map(const json_t *root, dp_spec spec, bool any_sign) {
    tally t = {.name = "map"};
    json_t *point;
    const char *scale = any_sign ? "linear" : "log";
    size_t i, known = 0, nears = 0, fars = 0, behind = 0;
    double last[2] = {0, 0};
    check_axis(root, "x", "near", "near plane", "scene units", scale);
    check_axis(root, "y", "far", "far plane", "scene units", scale);
    check_axis(root, "value", "interval", "worst z-fighting interval", "scene units", "log");
    assert_string_equal(text_at(root, "figure"), "map");
    assert_string_equal(text_at(root, "panels[0].series[1].name"), "map");
    assert_string_equal(text_at(root, "panels[0].series[0].name"), "camera");
    assert_true(number_at(root, "panels[0].series[0].points[0].near") == spec.znear);
    assert_true(number_at(root, "panels[0].series[0].points[0].far") == spec.zfar);
    json_array_foreach(node_at(root, "panels[0].series[1].points"), i, point) {
        const double znear = number_at(point, "near"), zfar = number_at(point, "far");
        dp_worst worst = {.interval = NAN};
        dp_setup setup;
        spec.znear = znear;
        spec.zfar = zfar;
        if (dp_setup_init(&setup, &spec) == DP_OK)
            assert_int_equal(dp_worst_over(&setup, znear, zfar, &worst), DP_OK);
        const double got = number_at(point, "interval");
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

TEST(map) {
    json_t *root = json_printed(0, "plot map -F unorm16 -m d3d -n 0.5 -f 300 --title 'a \"quoted\" ti\\tle'");
    dp_spec spec = SETUP("unorm16", .znear = 0.5, .zfar = 300).spec;
    assert_string_equal(text_at(root, "title"), "a \"quoted\" ti\\tle");
    assert_string_equal(text_at(root, "subtitle"), "unorm16 d3d, near 0.5, far 300, perspective, nearest, exact "
                                                   "(lattice of codes). Hatched: far is not behind near");
    check_map(root, spec, false);
    json_decref(root);
    root = json_printed(0, "plot map --ortho -F unorm16 -m d3d -n -10 -f 50");
    spec.ortho = true;
    spec.znear = -10;
    spec.zfar = 50;
    check_map(root, spec, true);
    json_decref(root);
}

/* Each band is the share of the cause that it is named after; the line is the separation, on the second axis. */
static void check_budget(const char *options, const dp_setup *setup, const dp_budget_terms *terms, size_t causes) {
    tally t = {.name = options};
    json_t *root = json_printed(0, "plot budget -F fp32 -n 0.5 -f 300 -m %s", options), *series, *point;
    size_t s, i, seen = 0;
    check_axis(root, "x", "z", "eye depth z", "scene units", "log");
    check_axis(root, "y", "share", "share of the separation", "%", "linear");
    check_axis(root, "second", "separation", "guaranteed separation", "scene units", "log");
    json_array_foreach(node_at(root, "panels[0].series"), s, series) {
        const char *name = text_at(series, "name");
        int cause = 0;
        while (cause < DP_CAUSE_COUNT && strcmp(name, dp_cause_name((dp_cause)cause)) != 0)
            cause++;
        const bool is_band = cause < DP_CAUSE_COUNT;
        seen += is_band ? 1 : 0;
        TALLY(&t, is_band || strcmp(name, "separation, right axis") == 0, "%s", name);
        json_array_foreach(node_at(series, "points"), i, point) {
            dp_budget b;
            const double z = number_at(point, "z"), got = number_at(point, is_band ? "share" : "separation");
            assert_int_equal(dp_budget_at(setup, z, terms, &b), DP_OK);
            const double want = !is_band ? b.separation : 100 * b.cause[cause] / b.separation;
            /* A curve is an envelope over a pixel column: it may lie a little above what is at its point. */
            TALLY(&t, isnan(got) ? isinf(b.separation) : fabs(got - want) <= 0.05 * fabs(want) + 0.5 * is_band,
                  "%s at %g: %g, not %g", name, z, got, want);
        }
    }
    TALLY(&t, seen == causes, "%zu causes", seen);
    json_decref(root);
    tally_end(&t);
}

TEST(budget) {
    dp_setup setup = SETUP("fp32", .znear = 0.5, .zfar = 300, .model = DP_MODEL_FLOAT);
    const dp_budget_terms terms = {.interpolation = 2, .world = 50, .linearize = 1};
    check_budget("d3d --interpolation 2 --from-origin 50 --linearize", &setup, &terms, 7);
    setup.spec.triangles = (dp_triangles){640, 480, 50, 0, {3, 10, 2, 4}, 20, 90, 2, 100, 16};
    assert_int_equal(dp_arith_parse("mesa", &setup.spec.arith), DP_OK); /* the rasterizer brings it */
    check_budget("d3d --viewport 640x480 --fov 50 --raster llvmpipe --slant 20:90 --triangle-class pixels=100", &setup,
                 &(dp_budget_terms){0}, 6);
    setup = SETUP("fp32", .znear = 0.5, .zfar = 300, .mapping = DP_MAPPING_LOG);
    check_budget("log --log2 d3d", &setup, &(dp_budget_terms){.log2 = 1}, 5);
    setup = SETUP("fp32", .znear = 0.5, .zfar = 300, .mapping = DP_MAPPING_OSGEARTH);
    check_budget("osgearth --interpolation 3", &setup, &(dp_budget_terms){.interpolation = 3}, 7);
}

/* An envelope is above the value at each point, and not above the worst between its neighbours. */
static void check_envelope(const char *figure, bool is_error, const double range[2]) {
    static const struct {
        const char *name, *format;
        dp_mapping mapping;
    } setups[] = {{"unorm16 d3d", "unorm16", DP_MAPPING_D3D},
                  {"unorm16 reversed", "unorm16", DP_MAPPING_REVERSED},
                  {"fp32 d3d", "fp32", DP_MAPPING_D3D},
                  {"fp32 reversed", "fp32", DP_MAPPING_REVERSED}};
    tally t = {.name = figure};
    char moved[64] = "";
    if (range[0] != 0 || range[1] != 1)
        snprintf(moved, sizeof moved, "--depth-range %g:%g", range[0], range[1]);
    json_t *root =
        json_printed(0, "plot %s --model exact -F unorm16,fp32 -m d3d,reversed -n 0.5 -f 300 %s", figure, moved);
    const char *key = is_error ? "error" : "interval";
    check_axis(root, "x", "z", "eye depth z", "scene units", "log");
    assert_string_equal(text_at(root, "y.key"), key);
    for (size_t s = 0; s < 4; s++) {
        const dp_setup setup = SETUP(setups[s].format, .znear = 0.5, .zfar = 300, .mapping = setups[s].mapping,
                                     .depth_range = {range[0], range[1]});
        const json_t *points = node_at(root, "panels[0].series[%zu].points", s);
        const char *name = text_at(root, "panels[0].series[%zu].name", s);
        TALLY(&t, strcmp(name, setups[s].name) == 0, "%s", name);
        for (size_t i = 1; i + 1 < json_array_size(points); i++) {
            const double z = number_at(points, "[%zu].z", i), got = number_at(points, "[%zu].%s", i, key);
            dp_sample here;
            dp_worst worst;
            assert_int_equal(dp_sample_at(&setup, z, &here), DP_OK);
            double from = number_at(points, "[%zu].z", i - 1), to = number_at(points, "[%zu].z", i + 1);
            if (*moved != '\0') { /* so few codes that cells, which count whole, are wider than columns */
                from = dp_cell_of(&setup, dp_code(&setup, from)).lo;
                to = dp_cell_of(&setup, dp_code(&setup, to)).hi;
            }
            assert_int_equal(dp_worst_over(&setup, from, to, &worst), DP_OK);
            TALLY(&t, got >= (is_error ? fabs(here.error) : here.interval) * (1 - 1e-6), "%s at %g: %g below",
                  setups[s].name, z, got);
            TALLY(&t, got <= (is_error ? worst.error : worst.interval) * (1 + 1e-6), "%s at %g: %g above",
                  setups[s].name, z, got);
        }
    }
    json_decref(root);
    tally_end(&t);
}

TEST(envelopes) {
    static const double ranges[][2] = {{0, 1}, {0, 0.1}, {0.1, 1}, {1, 0.25}};
    for (size_t i = 0; i < sizeof ranges / sizeof ranges[0]; i++) {
        check_envelope("error", true, ranges[i]);
        check_envelope("interval", false, ranges[i]);
    }
}

/* ---- What a table says --------------------------------------------------------------------------------------------
 */

static const char *const cameras[] = {"-F fp16,fp32,d16,d24 -m gl,d3d,reversed,log",
                                      "-n 2 -f inf -F fp16,fp32,d16,d24 -m gl,d3d,reversed",
                                      "--ortho -n 0.5 -f 300 -F fp16,fp32,d24 -m gl,d3d,reversed",
                                      "-F fp32,d24 -m linear,cesium,three-webgl",
                                      "-n 0.05 -f 5000 -F d24,fp32 -m gl-reversed --arith fused",
                                      "-F fp32,d24 -m gl,d3d --depth-range 0.1:1",
                                      "-F fp32,d16 -m gl,reversed --depth-range 1:0.25",
                                      "-f inf -F fp32,d24 -m reversed --depth-range 0:0.1"};

/* A point of a thick curve, as the table of its set-up has it at that depth and over the column. */
static void check_point(tally *t, const char *camera, size_t k, const json_t *series, double z, double got,
                        double column) {
    json_t *planes = json_printed(0, "table %s --at 3", camera);
    const double near = number_at(planes, "setups[0].near"), far = number_at(planes, "setups[0].far");
    json_t *root = json_printed(0, "table %s --at %.17g --range %.17g:%.17g", camera, z, fmax(z / column, near),
                                isnan(far) ? z * column : fmin(z * column, far));
    const json_t *row = node_at(root, "setups[%zu]", k);
    const double here = number_at(row, "rows[0].guaranteed"), most = number_at(row, "worst_separation.bound");
    char name[64];
    snprintf(name, sizeof name, "%s %s", text_at(row, "format"), text_at(row, "mapping"));
    assert_string_equal(name, text_at(series, "name"));
    TALLY(t, got >= here / (1 + 1e-12) && got <= most * (1 + 0x1p-9), "%s %s at %.17g: %.9g, not %.9g to %.9g", camera,
          name, z, got, here, most);
    json_decref(root);
    json_decref(planes);
}

/* The thick curves of `plot interval` are the column `guaranteed`; each is drawn by its second name, behind all of the
 * lattice. */
TEST(guaranteed_as_in_the_table) {
    tally t = {.name = "plot interval"};
    for (size_t c = 0; c < sizeof cameras / sizeof cameras[0]; c++) {
        json_t *root = json_printed(0, "plot interval %s", cameras[c]), *series;
        const json_t *all = node_at(root, "panels[0].series");
        const size_t setups = json_array_size(all) / 2;
        size_t s, checked = 0;
        json_array_foreach(all, s, series) {
            const json_t *points = node_at(series, "points");
            const size_t count = json_array_size(points);
            const double lo = number_at(points, "[0].z"), hi = number_at(points, "[%zu].z", count - 1);
            if (s < setups) {
                assert_non_null(strstr(text_at(series, "name"), ", lattice"));
                continue;
            }
            for (size_t i = 0; i < count; i += count / 5 + 1) {
                const double got = number_at(points, "[%zu].interval", i);
                if (!isfinite(got))
                    continue;
                check_point(&t, cameras[c], s - setups, series, number_at(points, "[%zu].z", i), got,
                            pow(hi / lo, 2.0 / 800));
                checked++;
            }
        }
        assert_true(checked > 3 * setups);
        json_decref(root);
    }
    tally_end(&t);
}

/* No error that the table has in binary32 is above the curve of `plot error`, nor does that lie above what is known of
 * its column. */
TEST(errors_as_in_the_table) {
    static const char *const formats[] = {"fp16", "fp32", "unorm16", "unorm24"};
    static const dp_mapping mappings[] = {DP_MAPPING_GL, DP_MAPPING_D3D, DP_MAPPING_REVERSED};
    tally t = {.name = "plot error"};
    for (size_t c = 0; c < 12; c++) {
        const dp_setup setup = SETUP(formats[c / 3], .mapping = mappings[c % 3], .model = DP_MODEL_FLOAT);
        const dp_setup lattice = SETUP(formats[c / 3], .mapping = mappings[c % 3]);
        char camera[64];
        snprintf(camera, sizeof camera, "-F %s -m %s", formats[c / 3], dp_mapping_get(mappings[c % 3])->name);
        json_t *root = json_printed(0, "plot error %s", camera);
        const json_t *points = node_at(root, "panels[0].series[1].points");
        const size_t count = json_array_size(points);
        const double column = pow(1e4, 1.0 / 800);
        assert_true(count > 5);
        for (size_t i = 0; i < count; i += count / 8 + 1) {
            const double z = number_at(points, "[%zu].z", i), got = number_at(points, "[%zu].error", i);
            const double lo = fmax(z / column, 0.1), hi = fmin(z * column, 1000);
            json_t *table = json_printed(0, "table %s --model float --at %.17g,%.17g,%.17g", camera, z,
                                         z / sqrt(sqrt(column)), fmin(z * sqrt(sqrt(column)), 1000));
            double where;
            dp_worst cells;
            assert_int_equal(dp_worst_over(&lattice, dp_cell_of(&lattice, dp_code(&lattice, lo)).lo,
                                           dp_cell_of(&lattice, dp_code(&lattice, hi)).hi, &cells),
                             DP_OK);
            for (int k = 0; k < 3; k++) {
                const double error = fabs(number_at(table, "setups[0].rows[%d].error", k));
                TALLY(&t, error <= got, "%s at %.17g: %.9g above %.9g", camera, z, error, got);
            }
            TALLY(&t, got <= fmax(cells.error, dp_computed_error_over(&setup, lo, hi, &where)) * (1 + 1e-9),
                  "%s at %.17g: %.9g", camera, z, got);
            json_decref(table);
        }
        json_decref(root);
    }
    tally_end(&t);
}

/* A curve by a method names the one that --tolerance takes; the exact one names none. */
TEST(method) {
    const method_family_row *family = method_family_find("interval");
    const method_wish wish = {.tolerance = 0.01, .ratio_lo = 600, .ratio_hi = 600};
    json_t *root = json_printed(0, "plot interval -F unorm24,fp16 -m d3d -n 0.5 -f 300 --tolerance 1%%");
    assert_string_equal(family->cases[0].name, "unorm24 d3d");
    assert_string_equal(text_at(root, "panels[0].series[0].method"), method_choose(family, 0, &wish)->name);
    assert_non_null(node_at(root, "panels[0].series[1]"));
    assert_null(node_at(root, "panels[0].series[1].method"));
    json_decref(root);
}

/* The points of a census: the longest interval of each band, at its nearer depth. */
TEST(census) {
    static census_result r;
    const dp_setup setup = SETUP("unorm16", .znear = 1.95, .zfar = 2.05, .model = DP_MODEL_FLOAT);
    const census_request q = {.setup = &setup, .lo = 1.95, .hi = 2.05};
    json_t *root = json_printed(0, "plot interval -F unorm16 -m d3d -n 1.95 -f 2.05 --model float");
    const json_t *points = node_at(root, "panels[0].series[2].points");
    assert_string_equal(text_at(root, "panels[0].series[2].name"), "unorm16 d3d, census");
    assert_int_equal(census_run(&q, &r), CENSUS_DONE);
    assert_int_equal(r.band_count, 2);
    assert_int_equal(json_array_size(points), 2);
    for (size_t i = 0; i < 2; i++) {
        assert_true(r.bands[i].longest_z > r.bands[i].lo);
        assert_true(number_at(points, "[%zu].z", i) == r.bands[i].longest_z);
        assert_true(number_at(points, "[%zu].interval", i) == r.bands[i].longest);
    }
    json_decref(root);
}

static bool same_csv(const char *figure, const char *setup, const char *model) {
    printed a = print_of("plot %s %s --csv", figure, setup);
    printed b = print_of("plot %s %s --model %s --csv", figure, setup, model);
    assert_true(a.status == 0 && b.status == 0);
    const char *one = strchr(a.out, '\n'), *other = strchr(b.out, '\n'); /* heads may name the model */
    const bool same = one != NULL && other != NULL && strcmp(one, other) == 0;
    printed_free(&a);
    printed_free(&b);
    return same;
}

/* Figures that count codes count those that are reached: with NDC of [-1, 1] of two roundings, staged; else all. */
TEST(codes_that_are_reached) {
    size_t count = 0;
    for (size_t i = 0; figure_get(i) != NULL; i++) {
        const figure_row *row = figure_get(i);
        const bool small = (row->takes & FIGURE_SMALL) != 0;
        if ((row->takes & FIGURE_STAGED) == 0 && strcmp(row->name, "share") != 0)
            continue;
        count++;
        const char *gl = small ? "-F float4.3 -m gl" : "-F fp32 -m gl",
                   *d3d = small ? "-F float4.3 -m d3d" : "-F fp32 -m d3d";
        if (!same_csv(row->name, gl, "staged") || !same_csv(row->name, d3d, "exact") ||
            (!small && same_csv(row->name, gl, "exact")))
            fail_msg("plot %s", row->name);
    }
    assert_true(count >= 3);
}
