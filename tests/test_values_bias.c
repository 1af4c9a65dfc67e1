/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every value that bias prints, in both forms: what a bias does, and how much of one is needed. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "api/bias.h"
#include "named.h"
#include "printed.h"

enum { DEPTHS = 6 };

typedef struct bias_case {
    camera_case camera;
    double z[DEPTHS];
    const char *api;
    bool inverse;
    double units, factor, clamp, slope, gap;
    double lo, hi; /* inverse: --range */
} bias_case;

static const bias_case cases[] = {
    {{0.3, 1000, {"unorm24", "fp32"}, {"d3d", "reversed"}, .unit = "cm"},
     {0.3, 1.7, 55, 321.5, 900, 1000},
     "vulkan",
     false,
     -7,
     0.75,
     -1e-6,
     0.02,
     0,
     0,
     0},
    {{0.1, INFINITY, {"unorm16", "fp32"}, {"reversed"}, .rounding = DP_ROUND_ZERO},
     {0.1, 3, 40, 555, 7e3, 9e4},
     "gl",
     false,
     3.25,
     0,
     2e-5,
     0,
     0,
     0,
     0},
    {{1, 200, {"unorm24"}, {"log", "linear"}, .log_c = 3},
     {1, 2, 30, 90, 150, 199},
     "d3d9",
     false,
     -2.5e-6,
     -1.5,
     0,
     0.5,
     0,
     0,
     0},
    {{2, 60, {"fp32"}, {"d3d"}, .ortho = 1}, {2, 3, 7, 20, 45, 60}, "d3d11", false, 4000, 0, 0, 0, 0, 0, 0},
    {{0.3, 1000, {"unorm24", "fp32"}, {"d3d", "reversed"}, .ortho = 0},
     {0.3, 1.7, 55, 321.5, 900, 1000},
     "d3d11",
     true,
     0,
     -0.25,
     0,
     0.02,
     0.01,
     0.4,
     700},
    {{0.3, 1000, {"unorm16"}, {"gl", "reversed"}, .ortho = 0},
     {0.3, 1.7, 55, 321.5, 900, 1000},
     "gl",
     true,
     0,
     0,
     0,
     0,
     0.125,
     0.3,
     800},
    {{0.1, INFINITY, {"unorm24", "fp32"}, {"reversed"}, .ortho = 0},
     {0.1, 3, 40, 555, 7e3, 9e4},
     "vulkan-unorm",
     true,
     0,
     0,
     0,
     0.001,
     0,
     0.2,
     5000},
    {{1, 200, {"unorm24"}, {"log"}, .log_c = 3}, {1, 2, 30, 90, 150, 199}, "vulkan-float", true, 0, 0, 0, 0, 3, 2, 150},
    /* Where a bias is enough: up to short of the far plane, whose depth is 0; and from beyond the near plane. */
    {{0.1, 1000, {"fp32"}, {"reversed"}, .ortho = 0},
     {0.3, 1, 3, 20, 45, 60},
     "metal",
     true,
     0,
     0,
     0,
     0.01,
     0.02,
     0.1,
     1000},
    {{0.1, 1000, {"fp32"}, {"d3d"}, .ortho = 0}, {0.3, 1, 3, 20, 45, 60}, "d3d11", true, 0, 0, 0, 0.01, 1e-5, 0.1, 900},
    /* The worth of a unit falls with z, so the far end decides. */
    {{2, 60, {"fp32"}, {"reversed"}, .ortho = 1}, {2, 3, 7, 20, 45, 60}, "d3d11", true, 0, 0, 0, 1e-5, 0.001, 3, 58},
};

static void arguments_of(const bias_case *c, char out[1024]) {
    char options[512];
    size_t used = (size_t)snprintf(out, 1024, "bias --api %s %s --at ", c->api, camera_options(&c->camera, options));
    for (int k = 0; k < DEPTHS; k++)
        used += (size_t)snprintf(out + used, 1024 - used, "%s%.17g", k > 0 ? "," : "", c->z[k]);
    const struct {
        const char *name;
        double number;
        bool given;
    } rest[] = {{"units", c->units, !c->inverse},
                {"factor", c->factor, c->factor != 0},
                {"clamp", c->clamp, c->clamp != 0},
                {"slope", c->slope, c->slope != 0},
                {"separation", c->gap, c->gap != 0}};
    for (size_t i = 0; i < sizeof rest / sizeof rest[0]; i++)
        if (rest[i].given)
            used += (size_t)snprintf(out + used, 1024 - used, " --%s=%.17g", rest[i].name, rest[i].number);
    if (c->inverse)
        snprintf(out + used, 1024 - used, " --range %.17g:%.17g", c->lo, c->hi);
}

/* The sign that brings a layer nearer; no bias where none is enough, and no -0. */
static double signed_units(const dp_setup *setup, double units) {
    return isinf(units) ? NAN : units > 0 && !setup->reversed ? -units : units;
}

static bias_goal goal_of(const bias_case *c, const dp_setup *setup, double gap) {
    return (bias_goal){bias_api_find(c->api), setup->reversed ? c->factor : -c->factor, c->slope, gap};
}

static void want_forward(values *v, const bias_case *c, const dp_setup *setup, double z) {
    const bias_state s = {bias_api_find(c->api), c->units, c->factor, c->clamp};
    const bias_unit r = bias_unit_at(s.api, &setup->spec.format, dp_window(setup, z));
    const double o = bias_offset(&s, r.least, bias_window_slope(setup, z, c->slope)), d = dp_window(setup, z) + o;
    const bias_effect e = bias_at(setup, &s, c->slope, z);
    const bool limited = d < 0 || d > 1;
    want_number(v, "bias", o);
    want_number(v, "depth", fmin(fmax(d, 0), 1));
    want_count(v, "code", dp_code(setup, z));
    want_count(v, "code_moved",
               o == 0 ? dp_code(setup, z) : dp_format_encode(&setup->spec.format, setup->spec.rounding, d));
    want_number(v, "z_moved",
                limited ? ((d > 0.5) != (setup->reversed != 0) ? setup->spec.zfar : setup->spec.znear) : e.to);
    want_number(v, "shift", e.shift);
    want_bool(v, "limited", limited);
}

static void want_inverse(values *v, const bias_case *c, const dp_setup *setup, double z) {
    const bias_state one = {bias_api_find(c->api), setup->reversed ? 1 : -1, 0, 0};
    const bias_effect e = bias_at(setup, &one, c->slope, z);
    const bias_goal apart = goal_of(c, setup, 0), gap = goal_of(c, setup, c->gap);
    const double units = signed_units(setup, bias_needed(setup, &gap, z));
    want_number(v, "one_unit", e.limited ? NAN : fabs(e.shift));
    want_number(v, "units_apart", signed_units(setup, bias_needed(setup, &apart, z)));
    (c->gap > 0 ? want_number : want_derived)(v, "units_gap", units);
}

static double shift_with(const bias_case *c, const dp_setup *setup, double units, double z) {
    const bias_state s = {bias_api_find(c->api), units, c->factor, 0};
    return isnan(units) ? NAN : bias_at(setup, &s, c->slope, z).shift;
}

/* With the exponent n + 1, which GL and Vulkan leave open: what half the worth of a unit needs. */
static double with_next(const bias_case *c, const dp_setup *setup, double gap, double lo) {
    const bias_goal goal = goal_of(c, setup, gap);
    bias_api next = *goal.api;
    double z;
    if (setup->spec.format.kind != DP_FORMAT_FLOAT || next.real != BIAS_EXPONENT || strchr("gv", next.name[0]) == NULL)
        return NAN;
    next.exponent = BIAS_EXPONENT_NEXT;
    const bias_goal other = {&next, goal.factor, goal.slope, goal.gap};
    return signed_units(setup, bias_needed_over(setup, &other, lo, c->hi, &z));
}

static void want_range(values *v, const bias_case *c, const dp_setup *setup) {
    const bias_goal apart = goal_of(c, setup, 0), gap = goal_of(c, setup, c->gap);
    const double gap_lo = fmax(c->lo, setup->spec.znear + c->gap);
    double apart_z, gap_z, from, to;
    const double alone = signed_units(setup, bias_needed_over(setup, &apart, c->lo, c->hi, &apart_z));
    const double with_gap = signed_units(setup, bias_needed_over(setup, &gap, gap_lo, c->hi, &gap_z));
    want_number(v, "lo", c->lo);
    want_number(v, "hi", c->hi);
    want_number(v, "units_apart", alone);
    want_number(v, "units_apart_z", apart_z);
    bias_enough_over(setup, &apart, c->lo, c->hi, &from, &to);
    want_number(v, "apart_from", from);
    want_number(v, "apart_to", to);
    want_number(v, "units_apart_next", with_next(c, setup, 0, c->lo));
    if (c->gap > 0) {
        want_number(v, "units_gap_next", with_next(c, setup, c->gap, gap_lo));
        want_number(v, "gap_lo", gap_lo);
        want_number(v, "units_gap", with_gap);
        want_number(v, "units_gap_z", gap_z);
        bias_enough_over(setup, &gap, gap_lo, c->hi, &from, &to);
        want_number(v, "gap_from", from);
        want_number(v, "gap_to", to);
    }
    const double shift_hi = shift_with(c, setup, c->gap > 0 ? with_gap : alone, c->hi);
    want_number(v, "shift_lo", shift_with(c, setup, c->gap > 0 ? with_gap : alone, c->gap > 0 ? gap_lo : c->lo));
    want_number(v, "shift_hi", shift_hi);
    want_derived(v, "nearer", fabs(shift_hi));
}

static void want_bias(values *v, const bias_case *c, const dp_setup *setup, size_t i, line_places *lines) {
    values_under(v, "setups[%zu].", i);
    want_setup(v, setup);
    for (int k = 0; k < DEPTHS; k++) {
        const bias_unit r = bias_unit_at(bias_api_find(c->api), &setup->spec.format, dp_window(setup, c->z[k]));
        char inner[32];
        values_under(v, "setups[%zu].rows[%d].", i, k);
        want_number(v, "z", c->z[k]);
        want_number(v, "r", r.least);
        want_number(v, "r_most", r.most);
        want_number(v, "slope", bias_window_slope(setup, c->z[k], c->slope));
        (c->inverse ? want_inverse : want_forward)(v, c, setup, c->z[k]);
        snprintf(inner, sizeof inner, "rows[%d].", k);
        place_add(lines, inner, "setups[%zu].", i);
    }
    values_under(v, "setups[%zu].range.", i);
    if (c->inverse)
        want_range(v, c, setup);
}

#define BOTH                                                                                                           \
    SETUP_COLUMNS, {"api", "/api"}, {"z [scene]", "z"}, {"r", "r"}, {"r_most", "r_most"}, {                            \
        "slope [per pixel]", "slope"                                                                                   \
    }
static const csv_column forward[] = {BOTH,
                                     {"bias", "bias"},
                                     {"depth", "depth"},
                                     {"code", "code"},
                                     {"code_moved", "code_moved"},
                                     {"z_moved [scene]", "z_moved"},
                                     {"shift [scene]", "shift"}};
static const csv_column inverse[] = {
    BOTH, {"one_unit [scene]", "one_unit"}, {"units_apart", "units_apart"}, {"units_gap", "units_gap"}};

/* The columns of the text; the slope and the gap only where they are asked about. */
static void check_text(const values *v, const bias_case *c, const char *arguments, const line_places *lines) {
    static const text_column forwards[] = {{"z", 9},     {"r", 6},           {"slope", 6},    {"bias", 6},
                                           {"code", 10}, {"code_moved", 10}, {"z_moved", 10}, {"shift", 6}};
    static const text_column inverses[] = {{"z", 9},        {"r", 6},           {"slope", 6},
                                           {"one_unit", 6}, {"units_apart", 9}, {"units_gap", 9}};
    static const char *const apart[] = {"setups[0].range.units_apart", "setups[0].range.lo", "setups[0].range.hi",
                                        "setups[0].range.units_apart_z", NULL};
    static const char *const gap[] = {"setups[0].range.units_gap", "setups[0].range.gap_lo", "setups[0].range.hi",
                                      "setups[0].range.units_gap_z", NULL};
    static const char *const apart_where[][3] = {{"setups[0].range.apart_from", "setups[0].range.lo", NULL},
                                                 {"setups[0].range.apart_to", "setups[0].range.hi", NULL}};
    static const char *const gap_where[][3] = {{"setups[0].range.gap_from", "setups[0].range.gap_lo", NULL},
                                               {"setups[0].range.gap_to", "setups[0].range.hi", NULL}};
    static const char *const nearer[] = {"setups[0].range.nearer", "setups[0].range.hi", NULL};
    text_column shown[8];
    size_t count = 0, all = c->inverse ? 6 : 8;
    for (size_t i = 0; i < all; i++) {
        shown[count] = c->inverse ? inverses[i] : forwards[i];
        if ((strcmp(shown[count].path, "slope") != 0 || c->slope > 0) &&
            (strcmp(shown[count].path, "units_gap") != 0 || c->gap > 0))
            count++;
    }
    printed p = print_of("%s --full", arguments);
    for (char *held = p.out; (held = strstr(held, "  held at a plane")) != NULL;) /* words behind the numbers */
        memset(held, ' ', strlen("  held at a plane"));
    check_text_table(v, p.out, shown, count, lines);
    const bool reversed = strcmp(value_at(v, "setups[0].mapping")->text, "reversed") == 0;
    const bool none = c->inverse && isnan(value_at(v, "setups[0].range.units_apart")->number);
    if (c->inverse)
        check_text_numbers(v, p.out, "told apart  ", 9, none ? apart_where[reversed] : apart);
    if (c->inverse && c->gap > 0 && isnan(value_at(v, "setups[0].range.units_gap")->number)) {
        check_text_numbers(v, p.out, "separated  ", 9, gap_where[reversed]);
    } else if (c->inverse && c->gap > 0) {
        check_text_numbers(v, p.out, "separated  ", 9, gap);
        check_text_numbers(v, p.out, "the same units bring", 6, nearer);
    }
    printed_free(&p);
}

static void test_bias(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const bias_case *c = &cases[i];
        values v = values_of("bias");
        v.unit = c->camera.unit;
        line_places lines = {0};
        dp_setup setups[CAMERA_SETUPS];
        char arguments[1024];
        arguments_of(c, arguments);
        want_text(&v, "api", c->api);
        want_number(&v, "units", c->inverse ? NAN : c->units);
        want_number(&v, "factor", c->factor);
        want_number(&v, "clamp", c->clamp);
        want_number(&v, "slope", c->slope);
        want_number(&v, "gap", c->inverse ? c->gap : NAN);
        const size_t n = camera_setups(&c->camera, setups);
        for (size_t k = 0; k < n; k++)
            want_bias(&v, c, &setups[k], k, &lines);
        check_json(&v, 0, arguments);
        check_csv(&v, 0, arguments, c->inverse ? inverse : forward,
                  c->inverse ? sizeof inverse / sizeof inverse[0] : sizeof forward / sizeof forward[0], &lines);
        check_text(&v, c, arguments, &lines);
        values_free(&v);
        places_free(&lines);
    }
}

/* What a browser does to units before they arrive, times what fp32 makes of one at a depth of 0.01: 2^(-7 - 23). */
static void test_platforms(void **state) {
    static const struct {
        const char *platform, *units;
        double times;
    } cases_of[] = {
        {"webgl-d3d", "1.5", 1},    {"webgl-d3d", "-2.75", -2}, {"webgl-d3d", "0.5", 0}, {"webgl-metal", "1.5", 1.5},
        {"webgl-gl", "3", 1.5},     {"webgl-gl", "-5", -2.5},   {"gl", "3", 3},          {"gl", "0.5", 0.5},
        {"webgl-vulkan", "3", 3},   {"vulkan", "3.25", 3.25},   {"safari", "3", 3},      {"metal", "-1.25", -1.25},
        {"firefox-vulkan", "7", 7}, {"chrome-d3d", "-2", -2},
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases_of / sizeof cases_of[0]; i++) {
        printed p = print_of("bias --platform %s -F fp32 -m reversed -n 0.1 -f inf --at 10 --units=%s --json",
                             cases_of[i].platform, cases_of[i].units);
        assert_int_equal(p.status, 0);
        json_t *root = json_of(p.out);
        json_t *setup = json_array_get(json_object_get(root, "setups"), 0);
        json_t *row = json_array_get(json_object_get(setup, "rows"), 0);
        const double bias = json_number_value(json_object_get(row, "bias"));
        if (bias != ldexp(cases_of[i].times, -30))
            fail_msg("%s, %s units: %g steps", cases_of[i].platform, cases_of[i].units, ldexp(bias, 30));
        json_decref(root);
        printed_free(&p);
    }
}

/* What is asked at a depth is answered for it: the units of its row, which bring the layer nearer by the gap, are what
 * is to be written. One unit is 2^-24 of window depth, f/(f - n) (1 - n/z) with near 0.1 and far 1000. */
static void one_answer(void **state) {
    (void)state;
    for (double z = 0.5; z < 1000; z *= 1.7)
        for (double gap = 1e-3; gap < z / 4; gap *= 7) {
            printed json = print_of("bias --api gl -F d24 -m gl --separation %.17g --at %.17g --json", gap, z);
            printed text = print_of("bias --api gl -F d24 -m gl --separation %.17g --at %.17g", gap, z);
            json_t *root = json_of(json.out);
            json_t *setup = json_array_get(json_object_get(root, "setups"), 0);
            json_t *row = json_array_get(json_object_get(setup, "rows"), 0), *range = json_object_get(setup, "range");
            const double units = json_number_value(json_object_get(row, "units_gap"));
            const double window = 1000 / 999.9 * 0.1 * gap / ((z - gap) * z);
            char call[64];
            assert_true(-units >= ldexp(window, 24) * (1 - 1e-9) && -units <= ldexp(window, 24) * (1 + 1e-9) + 1);
            assert_true(json_number_value(json_object_get(range, "units_gap")) == units);
            assert_true(json_number_value(json_object_get(range, "lo")) == z);
            assert_true(json_number_value(json_object_get(range, "hi")) == z);
            snprintf(call, sizeof call, "glPolygonOffset(0, %.0f)", units);
            assert_non_null(strstr(text.out, call));
            json_decref(root);
            printed_free(&json);
            printed_free(&text);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_bias), cmocka_unit_test(test_platforms),
                                       cmocka_unit_test(one_answer), cmocka_unit_test(check_apart)};
    return run_tap(tests);
}
