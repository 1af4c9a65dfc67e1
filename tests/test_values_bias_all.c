/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every value of bias --api all; what a program writes, in the words of each API. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "named.h"
#include "printed.h"

enum { APIS = 10, DEPTHS = 2 };

/* As the reference of each API has it, U and F in their places. */
static const struct {
    const char *api, *alone, *sloped;
    bool turned; /* the factor comes first */
} calls[APIS] = {
    {"d3d11", "D3D11_RASTERIZER_DESC.DepthBias = %s", "D3D11_RASTERIZER_DESC.DepthBias = %s, SlopeScaledDepthBias = %s",
     false},
    {"webgpu", "depthBias: %s", "depthBias: %s, depthBiasSlopeScale: %s", false},
    {"metal", "setDepthBias(%s, slopeScale: 0, clamp: 0)", "setDepthBias(%s, slopeScale: %s, clamp: 0)", false},
    {"vulkan", "depthBiasConstantFactor = %s", "depthBiasConstantFactor = %s, depthBiasSlopeFactor = %s", false},
    {"vulkan-exact", "depthBiasConstantFactor = %s", "depthBiasConstantFactor = %s, depthBiasSlopeFactor = %s", false},
    {"vulkan-unorm", "depthBiasConstantFactor = %s", "depthBiasConstantFactor = %s, depthBiasSlopeFactor = %s", false},
    {"vulkan-float", "depthBiasConstantFactor = %s", "depthBiasConstantFactor = %s, depthBiasSlopeFactor = %s", false},
    {"gl", "glPolygonOffset(0, %s)", "glPolygonOffset(%s, %s)", true},
    {"three", "polygonOffsetFactor = 0, polygonOffsetUnits = %s", "polygonOffsetFactor = %s, polygonOffsetUnits = %s",
     true},
    {"d3d9", "D3DRS_DEPTHBIAS = %s", "D3DRS_DEPTHBIAS = %s, D3DRS_SLOPESCALEDEPTHBIAS = %s", false},
};

typedef struct all_case {
    camera_case camera;
    double z[DEPTHS]; /* the first 0: the range */
    double lo, hi, factor, slope, gap;
} all_case;

static const all_case cases[] = {
    {{0.1, 1000, {"fp32", "unorm24"}, {"d3d", "reversed"}, .ortho = 0}, {300, 41.5}, 0, 0, 0, 0, 0.02},
    {{0.3, 500, {"unorm16"}, {"gl"}, .ortho = 0}, {3, 200}, 0, 0, -0.25, 0.01, 0},
    {{0.1, 1000, {"fp32"}, {"reversed"}, .ortho = 0}, {0}, 1, 1000, 0, 0.01, 0.02},
    {{0.1, 1000, {"fp32"}, {"d3d"}, .ortho = 0}, {0}, 0.1, 900, 0, 0.01, 1e-5},
    {{1, 50, {"unorm24"}, {"reversed"}, .ortho = 1}, {0}, 1, 50, 1.5, 0.001, 3},
};

static void arguments_of(const all_case *c, char out[1024]) {
    char options[512];
    size_t used = (size_t)snprintf(out, 1024, "bias --api all %s", camera_options(&c->camera, options));
    if (c->z[0] > 0)
        used += (size_t)snprintf(out + used, 1024 - used, " --at %.17g,%.17g", c->z[0], c->z[1]);
    else
        used += (size_t)snprintf(out + used, 1024 - used, " --range %.17g:%.17g", c->lo, c->hi);
    used += (size_t)snprintf(out + used, 1024 - used, " --factor=%.17g --slope %.17g", c->factor, c->slope);
    if (c->gap > 0)
        snprintf(out + used, 1024 - used, " --separation %.17g", c->gap);
}

/* The units as a program writes them: whole, or nine digits of a float. */
static void want_call(values *v, const all_case *c, size_t api, double units) {
    char text[32], factor[32], call[256];
    if (isnan(units)) {
        want_text(v, "call", NULL);
        return;
    }
    const bool whole = units == nearbyint(units);
    snprintf(text, sizeof text, whole ? "%.0f" : "%.9g", units);
    snprintf(factor, sizeof factor, "%g", c->factor);
    snprintf(call, sizeof call, c->factor != 0 ? calls[api].sloped : calls[api].alone,
             calls[api].turned && c->factor != 0 ? factor : text, calls[api].turned ? text : factor);
    want_text(v, "call", call);
}

static double signed_units(const dp_setup *setup, double units) {
    return isinf(units) ? NAN : units > 0 && !setup->reversed ? -units : units;
}

static void want_row(values *v, const all_case *c, const dp_setup *setup, size_t api, double z) {
    const bias_api *row = bias_api_find(calls[api].api);
    const bias_goal goal = {row, setup->reversed ? c->factor : -c->factor, c->slope, c->gap};
    double units, units_z, from, to;
    want_text(v, "api", row->name);
    if (z > 0) {
        const bias_unit r = bias_unit_at(row, &setup->spec.format, dp_window(setup, z));
        want_number(v, "z", z);
        want_number(v, "r", r.least);
        want_number(v, "r_most", r.most);
        units = signed_units(setup, bias_needed(setup, &goal, z));
    } else {
        const double lo = fmax(c->lo, setup->spec.znear + c->gap);
        units = signed_units(setup, bias_needed_over(setup, &goal, lo, c->hi, &units_z));
        bias_enough_over(setup, &goal, lo, c->hi, &from, &to);
        want_number(v, "lo", lo);
        want_number(v, "hi", c->hi);
        want_number(v, "units_z", units_z);
        want_number(v, "from", from);
        want_number(v, "to", to);
    }
    want_number(v, "units", units);
    want_call(v, c, api, units);
}

/* The text has the call behind the name of each API, or where a bias is enough. */
static void check_text(const values *v, const char *arguments, size_t setups, size_t places) {
    printed p = print_of("%s --full", arguments);
    assert_int_equal(p.status, 0);
    const char *line = p.out;
    for (size_t k = 0; k < setups; k++)
        for (size_t i = 0; i < places * APIS; i++) {
            char path[PATH_SIZE], name[32];
            snprintf(name, sizeof name, "%s ", calls[i % APIS].api);
            line = strstr(line + 1, name);
            assert_non_null(line);
            snprintf(path, sizeof path, "setups[%zu].rows[%zu].call", k, i);
            const wanted *call = value_at(v, path);
            char *said = strndup(line, strcspn(line, "\n"));
            if (!call->is_null) {
                assert_non_null(strstr(said, call->text));
            } else {
                double shown;
                const char *const end = strstr(said, "up to z = ");
                snprintf(path, sizeof path, "setups[%zu].rows[%zu].%s", k, i, end != NULL ? "to" : "from");
                const double true_end = value_at(v, path)->number;
                assert_int_equal(sscanf(strstr(said, "z = "), "z = %lf", &shown), 1);
                assert_true(fabs(shown / true_end - 1) < 2e-8 && (end != NULL ? shown <= true_end : shown >= true_end));
            }
            free(said);
        }
    printed_free(&p);
}

static void test_all(void **state) {
    static const csv_column at[] = {SETUP_COLUMNS,        {"api", "api"},     {"z [scene]", "z"}, {"r", "r"},
                                    {"r_most", "r_most"}, {"units", "units"}, {"call", "call"}};
    static const csv_column over[] = {SETUP_COLUMNS,
                                      {"api", "api"},
                                      {"lo [scene]", "lo"},
                                      {"hi [scene]", "hi"},
                                      {"units", "units"},
                                      {"units_z [scene]", "units_z"},
                                      {"from [scene]", "from"},
                                      {"to [scene]", "to"},
                                      {"call", "call"}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const all_case *c = &cases[i];
        const bool by_range = c->z[0] == 0;
        const size_t places = by_range ? 1 : DEPTHS;
        values v = values_of("bias");
        line_places lines = {0};
        dp_setup setups[CAMERA_SETUPS];
        char arguments[1024];
        arguments_of(c, arguments);
        want_text(&v, "api", "all");
        want_number(&v, "slope", c->slope);
        want_number(&v, "factor", c->factor);
        want_number(&v, "gap", c->gap);
        const size_t n = camera_setups(&c->camera, setups);
        for (size_t k = 0; k < n; k++) {
            values_under(&v, "setups[%zu].", k);
            want_setup(&v, &setups[k]);
            for (size_t row = 0; row < places * APIS; row++) {
                char inner[32];
                values_under(&v, "setups[%zu].rows[%zu].", k, row);
                want_row(&v, c, &setups[k], row % APIS, by_range ? 0 : c->z[row / APIS]);
                snprintf(inner, sizeof inner, "rows[%zu].", row);
                place_add(&lines, inner, "setups[%zu].", k);
            }
        }
        check_json(&v, 0, arguments);
        check_csv(&v, 0, arguments, by_range ? over : at,
                  by_range ? sizeof over / sizeof over[0] : sizeof at / sizeof at[0], &lines);
        check_text(&v, arguments, n, places);
        values_free(&v);
        places_free(&lines);
    }
}

/* Set-ups beside each other: the units of each, whole ones in full, others rounded away from 0 in four digits. */
static void test_beside(void **state) {
    const camera_case camera = {0.1, 1000, {"fp32", "unorm24"}, {"d3d", "reversed"}, .ortho = 0};
    printed p = print_of("bias --api all -F fp32,unorm24 -m d3d,reversed --separation 0.02 --at 300");
    dp_setup setups[CAMERA_SETUPS];
    const size_t n = camera_setups(&camera, setups);
    (void)state;
    assert_int_equal(n, 4);
    for (size_t i = 0; i < APIS; i++) {
        char name[32];
        double shown[4];
        snprintf(name, sizeof name, "\n%s ", calls[i].api);
        char *line = strstr(p.out, name);
        assert_non_null(line);
        assert_int_equal(sscanf(line + strlen(name), "%lf %lf %lf %lf", &shown[0], &shown[1], &shown[2], &shown[3]), 4);
        for (size_t k = 0; k < n; k++) {
            const bias_goal goal = {bias_api_find(calls[i].api), 0, 0, 0.02};
            const double units = signed_units(&setups[k], bias_needed(&setups[k], &goal, 300));
            const double over = shown[k] / units - 1;
            assert_true(units == nearbyint(units) ? shown[k] == units : over >= 0 && over < 1e-3);
        }
    }
    assert_non_null(strstr(p.out, "  metal         setDepthBias(U, slopeScale: 0, clamp: 0)\n"));
    printed_free(&p);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_all), cmocka_unit_test(test_beside),
                                       cmocka_unit_test(check_apart)};
    return run_tap(tests);
}
