/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every value that table prints, against the library. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "method/choose.h"
#include "named.h"
#include "printed.h"

enum { DEPTHS = 6 };

typedef struct table_case {
    camera_case camera;
    double lo, hi; /* --range */
    double z[DEPTHS];
    bool automatic; /* --model auto */
    const char *tolerance;
    double allowed;
    const char *method; /* that --tolerance takes; null: none */
} table_case;

static const table_case tables[] = {
    {{0.3, 1000, {"unorm16", "fp32"}, {"d3d", "log"}, .rounding = DP_ROUND_ZERO, .log_c = 2, .unit = "km"},
     0.5,
     700,
     {0.3, 1.7, 55, 321.5, 900, 1000},
     .allowed = 0.05},
    {{0.1, INFINITY, {"unorm24", "fp16"}, {"reversed", "d3d"}, .rounding = DP_ROUND_EVEN},
     0.1,
     INFINITY,
     {0.1, 3, 4e4, 1e6, 1e7, 3e9},
     .allowed = 0.05},
    {{0.7, 5000.1, {"unorm24", "fp32"}, {"gl", "reversed"}, .model = DP_MODEL_FLOAT, .arith = "fused-reciprocal"},
     1,
     4000,
     {0.7, 2, 20, 333, 2500, 5000},
     .allowed = 0.05},
    {{0.1, INFINITY, {"fp32"}, {"reversed"}, .model = DP_MODEL_FLOAT},
     0.1,
     INFINITY,
     {0.1, 2, 20, 333, 2500, 5e6},
     .allowed = 0.05},
    {{1, 50, {"unorm16"}, {"d3d", "linear"}, .model = DP_MODEL_STAGED}, 1, 50, {1, 2, 3, 4, 5, 50}, .allowed = 0.05},
    {{2, 90, {"unorm24"}, {"reversed", "gl"}, .ortho = 1}, 3, 80, {2, 3, 5, 7, 60, 90}, .allowed = 0.05},
    {{0.1, 1000, {"unorm16", "unorm24", "fp32"}, {"d3d", "reversed", "log"}, .unit = "cm"},
     0.2,
     900,
     {0.1, 0.5, 3, 20, 100, 900},
     .automatic = true,
     .tolerance = "20%",
     .allowed = 0.2,
     .method = ""},
    {{0.1, 1000, {"unorm24"}, {"d3d"}, .ortho = 0},
     0.2,
     900,
     {0.5, 1, 2, 5, 10, 900},
     .tolerance = "1e-6",
     .allowed = 1e-6,
     .method = ""},
};

static void arguments_of(const table_case *c, char out[1024]) {
    char options[512];
    size_t used = (size_t)snprintf(out, 1024, "table %s --at ", camera_options(&c->camera, options));
    for (int i = 0; i < DEPTHS; i++)
        used += (size_t)snprintf(out + used, 1024 - used, "%s%.17g", i > 0 ? "," : "", c->z[i]);
    if (isfinite(c->hi))
        used += (size_t)snprintf(out + used, 1024 - used, " --range %.17g:%.17g", c->lo, c->hi);
    if (c->automatic)
        used += (size_t)snprintf(out + used, 1024 - used, " --model auto");
    if (c->tolerance != NULL)
        snprintf(out + used, 1024 - used, " --tolerance %s", c->tolerance);
}

static void want_worst(values *v, const dp_setup *setup, double lo, double hi) {
    dp_worst w;
    assert_int_equal(dp_worst_over(setup, lo, hi, &w), DP_OK);
    if (isnan(w.error)) {
        want_text(v, "worst", NULL);
        return;
    }
    values_under(v, "%.60sworst.", v->prefix);
    want_number(v, "lo", lo);
    want_number(v, "hi", hi);
    want_number(v, "error", w.error);
    want_number(v, "error_z", w.error_z);
    want_count(v, "error_code", w.error_code);
    want_number(v, "interval", w.interval);
    want_number(v, "interval_lo", w.interval_lo);
    want_number(v, "interval_hi", w.interval_hi);
    want_count(v, "interval_code", w.interval_code);
    want_number(v, "blind_from", w.blind_from);
}

/* What is guaranteed of the set-up, whatever the rows are in: of linear it is a lattice. */
static void want_separation(values *v, const dp_setup *setup, double lo, double hi) {
    dp_separation_worst w;
    const dp_setup full = dp_setup_guaranteed(setup);
    assert_int_equal(dp_separation_over(&full, lo, hi, 0, &w), DP_OK);
    assert_true(w.lo == lo && w.hi == hi && w.z >= lo && w.z <= hi);
    assert_true(w.separation == dp_separation(&full, w.z) && w.separation <= w.bound);
    values_under(v, "%.60sworst_separation.", v->prefix);
    want_text(v, "model", setup->spec.mapping == DP_MAPPING_LINEAR ? "staged" : "float");
    want_number(v, "lo", lo);
    want_number(v, "hi", hi);
    want_number(v, "bound", w.bound);
    want_number(v, "separation", w.separation);
    want_number(v, "z", w.z);
}

static double in_binary32(const dp_setup *setup, double z) {
    dp_budget b;
    return dp_budget_at(setup, z, NULL, &b) == DP_OK ? b.separation : NAN;
}

/* The interval by the method that --tolerance takes, or of the exact cell; none where it would end beyond far. */
static double interval_of(const method_row *row, const dp_setup *setup, double z) {
    const dp_cell cell = dp_cell_of(setup, dp_code(setup, z));
    const method_inputs in = {.count = 1, .z = &z};
    double width = cell.width;
    if (row != NULL && (row->domain & METHOD_PIPELINE) != 0 && z + dp_separation(setup, z) > setup->spec.zfar)
        return NAN;
    if (row != NULL)
        row->run(&(method_call){row, setup, NULL, &in, &(method_outputs){.value = &width}});
    return width;
}

static void want_row(values *v, const dp_setup *setup, const method_row *method, double z) {
    const uint32_t code = dp_code(setup, z);
    const dp_cell cell = dp_cell_of(setup, code);
    want_number(v, "z", z);
    want_count(v, "code", code);
    want_number(v, "depth", dp_window(setup, z));
    want_number(v, "z_stored", dp_stored(setup, code));
    want_number(v, "error", dp_error(setup, code, z));
    want_number(v, "cell_lo", cell.lo);
    want_number(v, "cell_hi", cell.hi);
    want_number(v, "interval", interval_of(method, setup, z));
    want_number(v, "separation", dp_separation(setup, z));
    dp_setup other;
    dp_spec spec = setup->spec;
    spec.model = DP_MODEL_EXACT;
    assert_int_equal(dp_setup_init(&other, &spec), DP_OK);
    want_number(v, "lattice", dp_separation(&other, z));
    spec.model = DP_MODEL_STAGED; /* of linear, which has no arithmetic */
    assert_int_equal(dp_setup_init(&other, &spec), DP_OK);
    const double computed = in_binary32(setup, z);
    want_number(v, "guaranteed", isnan(computed) ? dp_separation(&other, z) : computed);
}

/* What --tolerance takes for a set-up: the cheapest claim for these planes, in the pipeline or on its lattice. */
static const method_row *method_of(const table_case *c, const dp_setup *setup, double *claim, const char **name) {
    const method_family_row *family = method_family_find("interval");
    const double ratio = setup->spec.zfar / setup->spec.znear;
    const bool pipeline = setup->spec.model == DP_MODEL_FLOAT;
    const method_wish wish = {.tolerance = c->allowed,
                              .ratio_lo = ratio,
                              .ratio_hi = ratio,
                              .cut_cells = !pipeline && c->z[0] == setup->spec.znear,
                              .pipeline = pipeline};
    const method_row *row = NULL;
    for (size_t i = 0; i < family->case_count && setup->spec.model != DP_MODEL_STAGED; i++)
        if (strcmp(family->cases[i].format, setup->spec.format.name) == 0 &&
            family->cases[i].mapping == setup->spec.mapping) {
            row = method_choose(family, i, &wish);
            *claim = row != NULL ? method_claim_over(&row->claims[i], ratio, ratio) : *claim;
        }
    *name = row != NULL ? row->name : pipeline ? NULL : "cell";
    if (row == NULL)
        *claim = pipeline ? NAN : 0;
    return row;
}

static void want_table(values *v, const table_case *c, dp_setup *setup, size_t i, line_places *lines) {
    const method_row *method = NULL;
    double claim = NAN;
    const char *name;
    if (c->automatic) {
        dp_choice choice;
        assert_int_equal(dp_model_choose(setup, c->z, DEPTHS, c->allowed, &choice), DP_OK);
        dp_spec spec = setup->spec;
        spec.model = choice.model;
        assert_int_equal(dp_setup_init(setup, &spec), DP_OK);
    }
    values_under(v, "setups[%zu].", i);
    want_setup(v, setup);
    if (c->method != NULL) {
        method = method_of(c, setup, &claim, &name);
        want_text(v, "method", name);
        want_number(v, "claim", claim);
    }
    for (int k = 0; k < DEPTHS; k++) {
        values_under(v, "setups[%zu].rows[%d].", i, k);
        want_row(v, setup, method, c->z[k]);
        char inner[32];
        snprintf(inner, sizeof inner, "rows[%d].", k);
        place_add(lines, inner, "setups[%zu].", i);
    }
    values_under(v, "setups[%zu].", i);
    want_worst(v, setup, c->lo, c->hi);
    if (isfinite(c->hi)) {
        values_under(v, "setups[%zu].", i);
        want_separation(v, setup, c->lo, c->hi);
    }
    dp_pipeline p;
    if (setup->spec.model == DP_MODEL_FLOAT && dp_pipeline_init(&p, setup) == DP_OK) {
        float znear, zfar;
        dp_pipeline_planes(&p, &znear, &zfar);
        values_under(v, "setups[%zu].", i);
        want_number(v, "near_effective", (double)znear);
        want_number(v, "far_effective", (double)zfar);
    }
    char under[PATH_SIZE];
    snprintf(under, sizeof under, "setups[%zu].auto.", i);
    want_choice(v, under, setup, c->z, DEPTHS, c->allowed);
}

static void check_table_text(const values *v, const char *arguments, const line_places *lines) {
    static const text_column narrow[] = {{"z", 8},        {"code", 10},   {"depth", 7},     {"error", 5},
                                         {"interval", 5}, {"lattice", 5}, {"guaranteed", 5}};
    static const text_column full[] = {{"z", 8},       {"code", 10},    {"depth", 7},   {"z_stored", 9},
                                       {"error", 5},   {"interval", 5}, {"lattice", 5}, {"guaranteed", 5},
                                       {"cell_lo", 9}, {"cell_hi", 9}};
    static const struct {
        const char *options;
        const text_column *columns;
        size_t count;
    } forms[] = {{"", narrow, 7}, {"--full", full, 10}};
    for (size_t i = 0; i < sizeof forms / sizeof forms[0]; i++) {
        printed p = print_of("%s %s", arguments, forms[i].options);
        assert_int_equal(p.status, 0);
        check_text_table(v, p.out, forms[i].columns, forms[i].count, lines);
        printed_free(&p);
    }
}

static void test_table(void **state) {
    static const csv_column columns[] = {SETUP_COLUMNS,
                                         {"arith", "?^arith"},
                                         {"z [scene]", "z"},
                                         {"code", "code"},
                                         {"depth", "depth"},
                                         {"z_stored [scene]", "z_stored"},
                                         {"error [scene]", "error"},
                                         {"cell_lo [scene]", "cell_lo"},
                                         {"cell_hi [scene]", "cell_hi"},
                                         {"interval [scene]", "interval"},
                                         {"separation [scene]", "separation"},
                                         {"guaranteed [scene]", "guaranteed"},
                                         {"method", "?^method"}};
    (void)state;
    for (size_t i = 0; i < sizeof tables / sizeof tables[0]; i++) {
        const table_case *c = &tables[i];
        values v = values_of("table");
        v.unit = c->camera.unit;
        line_places lines = {0};
        dp_setup setups[CAMERA_SETUPS];
        csv_column used[sizeof columns / sizeof columns[0]];
        char arguments[1024];
        bool with_arith = false;
        size_t count = 0, n = camera_setups(&c->camera, setups);
        arguments_of(c, arguments);
        for (size_t k = 0; k < n; k++) {
            want_table(&v, c, &setups[k], k, &lines);
            with_arith = with_arith || setups[k].spec.model == DP_MODEL_FLOAT;
        }
        for (size_t k = 0; k < sizeof columns / sizeof columns[0]; k++)
            if ((k != 7 || with_arith) && (k + 1 < sizeof columns / sizeof columns[0] || c->method != NULL))
                used[count++] = columns[k];
        check_json(&v, 0, arguments);
        check_csv(&v, 0, arguments, used, count, &lines);
        check_table_text(&v, arguments, &lines);
        values_free(&v);
        places_free(&lines);
    }
}

/* The lines below a table, where they are spelt out. */
static void test_table_worst_lines(void **state) {
    static const char *const error[] = {"worst.error", "worst.error_z", "worst.error_code", NULL};
    static const char *const interval[] = {"worst.interval", "worst.interval_lo", "worst.interval_hi",
                                           "worst.interval_code", NULL};
    static const char *const drawn[] = {"near_effective", "far_effective", NULL};
    const camera_case exact = {2, 90, {"unorm16"}, {"reversed"}, .ortho = 1},
                      /* error and interval at other depths */ fp32 = {
                          0.7, 5000, {"unorm24"}, {"gl"}, .model = DP_MODEL_FLOAT};
    dp_setup setup[CAMERA_SETUPS];
    (void)state;
    camera_setups(&exact, setup);
    values v = values_of("table");
    want_worst(&v, setup, 3, 80);
    printed p = print_of("table -n 2 -f 90 -F unorm16 -m reversed --ortho --range 3:80");
    check_text_numbers(&v, p.out, "worst error", 6, error);
    check_text_numbers(&v, p.out, "worst interval", 6, interval);
    values_free(&v);
    printed_free(&p);
    dp_pipeline pipeline;
    float znear, zfar;
    camera_setups(&fp32, setup);
    assert_int_equal(dp_pipeline_init(&pipeline, setup), DP_OK);
    dp_pipeline_planes(&pipeline, &znear, &zfar);
    v = values_of("table");
    want_number(&v, "near_effective", (double)znear);
    want_number(&v, "far_effective", (double)zfar);
    p = print_of("table -n 0.7 -f 5000 -F unorm24 -m gl --model float -q");
    check_text_numbers(&v, p.out, "clip range", 9, drawn);
    values_free(&v);
    printed_free(&p);
}

/* "the arithmetic of the shader makes this 7.44 times worse at z = 1e+06": 3 digits, against the lattice. */
static void test_shader_line(void **state) {
    static const char *const formats[] = {"unorm24", "unorm12"};
    const double depths[] = {2, 1e6, 3e8};
    (void)state;
    for (int i = 0; i < 2; i++) {
        dp_spec spec = {.znear = 1, .zfar = 1e9, .mapping = DP_MAPPING_LOG, .log_c = 1};
        dp_format found[2];
        dp_setup setup;
        double worst = 0, z = 0;
        assert_int_equal(dp_format_parse(formats[i], found), 1);
        spec.format = found[0];
        assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
        for (int k = 0; k < 3; k++) {
            const double times = in_binary32(&setup, depths[k]) / dp_separation(&setup, depths[k]);
            z = times > worst ? depths[k] : z;
            worst = fmax(worst, times);
        }
        printed p = print_of("table --full -m log -n 1 -f 1e9 --at 2,1e6,3e8 -F %s", formats[i]);
        const char *at = strstr(p.out, "the arithmetic of the shader makes this ");
        assert_non_null(at);
        at += strlen("the arithmetic of the shader makes this ");
        double said, where;
        char end[64];
        const bool enough = worst <= 1.05;
        assert_int_equal(enough, i == 1);
        assert_int_equal(
            sscanf(at, enough ? "at most %lf %% worse at z = %lf: %63[^\n]" : "%lf times worse at z = %lf: %63[^\n]",
                   &said, &where, end),
            3);
        assert_relative(said, enough ? 100 * (worst - 1) : worst, 0.005);
        assert_relative(where, z, 1e-5);
        assert_string_equal(end, enough ? "the lattice is enough" : "'depthprec budget' says of what");
        printed_free(&p);
    }
}

/* ---- The comparison ---------------------------------------------------------------------------------------------- */

enum { LIMITS = 3 };

/* A row: its name, its set-up, and what one of its scene units is in those of the comparison. */
typedef struct compared_row {
    const char *name, *format;
    double znear, zfar;
    dp_mapping mapping;
    double unit;
} compared_row;

static dp_setup setup_of(const compared_row *r) {
    dp_setup setup;
    dp_format formats[2];
    dp_spec spec = {.znear = r->znear, .zfar = r->zfar, .mapping = r->mapping, .model = DP_MODEL_FLOAT};
    assert_int_equal(dp_format_parse(r->format, formats), 1);
    spec.format = formats[0];
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    return setup;
}

/* Rounded up to two digits, and up to which depth, rounded down to three: it holds there, and no farther than it says.
 */
static void check_row(tally *t, const char *text, const compared_row *r, const double *z, size_t count,
                      const double limits[LIMITS]) {
    const dp_setup setup = setup_of(r);
    const char *at = strstr(text, r->name);
    dp_separation_worst worst;
    assert_non_null(at);
    at += strlen(r->name);
    for (size_t i = 0; i < count; i++) {
        const double shown = strtod(at, (char **)&at), truth = dp_separation(&setup, z[i] / r->unit) * r->unit;
        TALLY(t, shown >= truth * (1 - 1e-12) && shown <= truth * 1.1, "%s at %g: %g, not %g", r->name, z[i], shown,
              truth);
    }
    for (int i = 0; i < LIMITS; i++) {
        const double shown = strtod(at, (char **)&at) / r->unit, limit = limits[i] / r->unit;
        assert_int_equal(dp_separation_over(&setup, r->znear, shown, 0, &worst), DP_OK);
        TALLY(t, worst.separation <= limit * (1 + 1e-12), "%s: %g apart up to %g", r->name, limits[i], shown);
        if (shown >= r->zfar)
            continue;
        assert_int_equal(dp_separation_over(&setup, r->znear, fmin(shown * 1.011, r->zfar), 0, &worst), DP_OK);
        TALLY(t, worst.bound > limit, "%s: %g apart beyond %g, too", r->name, limits[i], shown);
    }
}

static void test_comparison(void **state) {
    static const struct {
        const char *arguments, *head;
        double z[2], limits[LIMITS];
        compared_row rows[2];
    } cases[] = {
        {"-n 0.1 -f 1000 -F fp32,d24 -m gl --at 10,500",
         "  0.001   0.01    0.1  B",
         {10, 500},
         {0.001, 0.01, 0.1},
         {{"fp32 gl", "fp32", 0.1, 1000, DP_MAPPING_GL, 1}, {"unorm24 gl", "unorm24", 0.1, 1000, DP_MAPPING_GL, 1}}},
        {"--unit cm -n 10 -f 1km -F fp32,d24 -m d3d --at 5m,700m",
         "   1 mm   1 cm  10 cm  B",
         {500, 70000},
         {0.1, 1, 10},
         {{"fp32 d3d", "fp32", 10, 1e5, DP_MAPPING_D3D, 1}, {"unorm24 d3d", "unorm24", 10, 1e5, DP_MAPPING_D3D, 1}}},
        {"--preset unity,unreal --at 100m,700m",
         "   1 mm   1 cm  10 cm  B",
         {100, 700},
         {0.001, 0.01, 0.1},
         {{"unity fp32 reversed", "fp32", 0.3, 1000, DP_MAPPING_REVERSED, 1},
          {"unreal fp32 reversed", "fp32", 10, INFINITY, DP_MAPPING_REVERSED, 0.01}}},
        {"--preset unreal,unity -n 2 -F d24 -f 30000 --at 3,3000",
         "   1 mm   1 cm  10 cm  B",
         {3, 3000},
         {0.1, 1, 10},
         {{"unity unorm24 reversed", "unorm24", 0.02, 300, DP_MAPPING_REVERSED, 100},
          {"unreal unorm24 reversed", "unorm24", 2, 30000, DP_MAPPING_REVERSED, 1}}},
    };
    tally t = {.name = "comparison"};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        printed p = print_of("table %s", cases[i].arguments);
        TALLY(&t, p.status == 0 && strstr(p.out, cases[i].head) != NULL, "%s: %s", cases[i].arguments, p.errors);
        for (int k = 0; k < 2; k++)
            check_row(&t, p.out, &cases[i].rows[k], cases[i].z, 2, cases[i].limits);
        printed_free(&p);
    }
    tally_end(&t);
}

/* Each in its own unit, where the unit is not chosen. */
static void test_presets(void **state) {
    static const struct {
        const char *options, *unit;
        double znear, z, range_lo;
    } cases[] = {{"", "cm", 10, 10000, 500}, {" --unit ft", "ft", 0.1 / 0.3048, 100 / 0.3048, 5 / 0.3048}};
    (void)state;
    for (size_t i = 0; i < 2; i++) {
        printed p = print_of("table --preset unity,unreal --at 100m --range 5m:50m --json%s", cases[i].options);
        json_t *root = json_of(p.out), *unreal = json_array_get(json_object_get(root, "setups"), 1);
        assert_int_equal(json_array_size(json_object_get(root, "setups")), 2);
        assert_string_equal(json_string_value(json_object_get(unreal, "preset")), "unreal");
        assert_string_equal(json_string_value(json_object_get(unreal, "unit")), cases[i].unit);
        const double znear = json_number_value(json_object_get(unreal, "near"));
        const double z = json_number_value(json_object_get(json_array_get(json_object_get(unreal, "rows"), 0), "z"));
        const double lo = json_number_value(json_object_get(json_object_get(unreal, "worst"), "lo"));
        assert_true(fabs(znear - cases[i].znear) <= 1e-15 * znear && fabs(z - cases[i].z) <= 1e-15 * z);
        assert_true(fabs(lo - cases[i].range_lo) <= 1e-15 * lo);
        json_decref(root);
        printed_free(&p);
        p = print_of("table --preset unity,unreal --at 100m --csv%s", cases[i].options);
        char ending[32];
        snprintf(ending, sizeof ending, ",unreal,%s\r\n", cases[i].unit);
        assert_non_null(strstr(p.out, ",preset,unit\r\n"));
        assert_string_equal(p.out + strlen(p.out) - strlen(ending), ending);
        printed_free(&p);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_table),      cmocka_unit_test(test_table_worst_lines), cmocka_unit_test(test_shader_line),
        cmocka_unit_test(test_comparison), cmocka_unit_test(test_presets),           cmocka_unit_test(check_apart),
    };
    return run_tap(tests);
}
