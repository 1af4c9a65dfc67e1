/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every value of bias --api all; what a program writes, in the words of each API. */
#include "named.h"
#include "printed.h"

enum { APIS = 11, DEPTHS = 2 };

/* As the reference of each API has it, U and F in their places. */
static const struct {
    const char *api, *alone, *sloped;
    bool turned; /* the factor comes first */
} calls[APIS] = {
    {"d3d11", "D3D11_RASTERIZER_DESC.DepthBias = %s", "D3D11_RASTERIZER_DESC.DepthBias = %s, SlopeScaledDepthBias = %s",
     false},
    {"d3d12", "D3D12_RASTERIZER_DESC.DepthBias = %s", "D3D12_RASTERIZER_DESC.DepthBias = %s, SlopeScaledDepthBias = %s",
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

static const char *const lines[] = {
    "bias --api all -n 0.1 -f 1000 -F fp32,unorm24 -m d3d,reversed --at 300,41.5 --separation 0.02",
    "bias --api all -n 0.3 -f 500 -F unorm16 -m gl --at 3,200 --factor=-0.25 --slope 0.01",
    "bias --api all -n 0.1 -f 1000 -F fp32 -m reversed --range 1:1000 --factor 0 --slope 0.01 --separation 0.02",
    "bias --api all -n 0.1 -f 1000 -F fp32 -m d3d --range 0.1:900 --factor 0 --slope 0.01 --separation 1e-5",
    "bias --api all -n 1 -f 50 -F unorm24 -m reversed --ortho --range 1:50 --factor=1.5 --slope 0.001 --separation 3",
};

typedef struct all_case {
    double z[DEPTHS], range[2]; /* of the first depth 0: the range */
    double factor, slope, gap;
} all_case;

static all_case case_of(const char *line) {
    all_case c = {.factor = number_behind(line, "--factor", 0),
                  .slope = number_behind(line, "--slope", 0),
                  .gap = number_behind(line, "--separation", 0)};
    numbers_behind(line, "--at", c.z, DEPTHS);
    numbers_behind(line, "--range", c.range, 2);
    return c;
}

/* Nine digits that are no less in magnitude: the decimal nearest to it, or where that is less the next one. */
static void nine_outward(double units, char text[32]) {
    char unit[32];
    snprintf(text, 32, "%.8e", fabs(units));
    snprintf(unit, sizeof unit, "1e%d", atoi(strchr(text, 'e') + 1) - 8);
    const double nearest = strtod(text, NULL), shown = nearest < fabs(units) ? nearest + strtod(unit, NULL) : nearest;
    snprintf(text, 32, "%.9g", copysign(shown, units));
}

/* The units as a program writes them: whole, or nine digits that still suffice. */
static void want_call(values *v, const all_case *c, size_t api, double units) {
    char text[32], factor[32], call[256];
    if (isnan(units)) {
        want_text(v, "call", NULL);
        return;
    }
    if (units == nearbyint(units))
        snprintf(text, sizeof text, "%.0f", units);
    else
        nine_outward(units, text);
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
    const bias_goal goal = {
        .api = row, .factor = setup->reversed ? c->factor : -c->factor, .slope = c->slope, .gap = c->gap};
    double units, units_z, from, to;
    if (z > 0) {
        const bias_unit r = bias_unit_at(row, &setup->spec.format, dp_window(setup, z));
        want(v, "z=%f r=%f r_most=%f", z, r.least, r.most);
        units = signed_units(setup, bias_needed(setup, &goal, z));
    } else {
        const double lo = fmax(c->range[0], setup->spec.znear + c->gap), hi = c->range[1];
        units = signed_units(setup, bias_needed_over(setup, &goal, lo, hi, &units_z));
        bias_enough_over(setup, &goal, INFINITY, lo, hi, &from, &to);
        want(v, "lo=%f hi=%f units_z=%f from=%f to=%f", lo, hi, units_z, from, to);
    }
    want(v, "api=%s units=%f", row->name, units);
    want_call(v, c, api, units);
}

/* The goal above the calls: of a gap it begins where near leaves room for that. */
static void check_goal(const all_case *c, double znear, const char *text) {
    char gap[64] = "To be resolved", place[96] = "", slope[64] = "", goal[256];
    if (c->gap > 0)
        snprintf(gap, sizeof gap, "To bring a layer %g nearer", c->gap);
    if (c->z[0] == 0)
        snprintf(place, sizeof place, " from z = %.8g to %.8g", fmax(c->range[0], znear + c->gap), c->range[1]);
    if (c->slope > 0)
        snprintf(slope, sizeof slope, ", slope %g per pixel", c->slope);
    snprintf(goal, sizeof goal, "\n%s%s%s:\n", gap, place, slope);
    assert_non_null(strstr(text, goal));
}

/* The text has the call behind the name of each API, or where a bias is enough. */
static void check_text(const values *v, const char *arguments, size_t setups, size_t places) {
    const all_case c = case_of(arguments);
    printed p = print_of("%s --full", arguments);
    assert_int_equal(p.status, 0);
    check_goal(&c, number_behind(arguments, "-n", 0), p.out);
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

TEST(each_number) {
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++) {
        const all_case c = case_of(lines[i]);
        const bool by_range = c.z[0] == 0;
        const size_t places = by_range ? 1 : DEPTHS;
        values v = values_of(lines[i]);
        dp_setup setups[SETUPS_MAX];
        want(&v, "api=%s slope=%f factor=%f gap=%f", "all", c.slope, c.factor, c.gap);
        const size_t n = setups_of(lines[i], DP_MODEL_EXACT, setups);
        for (size_t k = 0; k < n; k++) {
            values_under(&v, "setups[%zu].", k);
            want_setup(&v, &setups[k]);
            for (size_t row = 0; row < places * APIS; row++) {
                values_under(&v, "setups[%zu].rows[%zu].", k, row);
                want_row(&v, &c, &setups[k], row % APIS, by_range ? 0 : c.z[row / APIS]);
            }
        }
        check_forms(&v, 0, lines[i], "setups[].rows[]",
                    SETUP_CSV "api, ?z [scene], ?r, ?r_most, ?lo [scene], ?hi [scene], units, ?units_z [scene], "
                              "?from [scene], ?to [scene], call");
        check_text(&v, lines[i], n, places);
        values_free(&v);
    }
}

/* Set-ups beside each other: the units of each, whole ones in full, others rounded away from 0 in four digits. */
TEST(beside_each_other) {
    static const char asked[] = "bias --api all -F fp32,unorm24 -m d3d,reversed --separation 0.02 --at 300";
    printed p = print_of("%s", asked);
    dp_setup setups[SETUPS_MAX];
    const size_t n = setups_of(asked, DP_MODEL_EXACT, setups);
    assert_int_equal(n, 4);
    for (size_t i = 0; i < APIS; i++) {
        char name[32];
        double shown[4];
        snprintf(name, sizeof name, "\n%s ", calls[i].api);
        char *line = strstr(p.out, name);
        assert_non_null(line);
        assert_int_equal(sscanf(line + strlen(name), "%lf %lf %lf %lf", &shown[0], &shown[1], &shown[2], &shown[3]), 4);
        for (size_t k = 0; k < n; k++) {
            const bias_goal goal = {.api = bias_api_find(calls[i].api), .gap = 0.02};
            const double units = signed_units(&setups[k], bias_needed(&setups[k], &goal, 300));
            const double over = shown[k] / units - 1;
            assert_true(units == nearbyint(units) ? shown[k] == units : over >= 0 && over < 1e-3);
        }
    }
    assert_non_null(strstr(p.out, "  metal         setDepthBias(U, slopeScale: 0, clamp: 0)\n"));
    printed_free(&p);
}

/* Several APIs: the lines that all of them have of these, and no others; names that mean one are one. */
TEST(several) {
    static const char *const commands[] = {"bias --at 7,90 --separation 0.02 -F d24,fp32 -m d3d",
                                           "bias --separation 0.02 -F d24 -m reversed",
                                           "shadow --light-box 40x40x100 -F d16"};
    for (size_t i = 0; i < sizeof commands / sizeof commands[0]; i++) {
        printed every = print_of("%s --api all --csv", commands[i]);
        printed some = print_of("%s --api Direct3D12,opengl,gl,three --csv", commands[i]);
        printed one = print_of("%s --api gl,opengl", commands[i]);
        size_t kept = 0;
        char *want = calloc(1, strlen(every.out) + 1);
        for (const char *line = every.out; *line != '\0'; line += strcspn(line, "\n") + 1) {
            const char *const end = strchr(line, '\n') + 1;
            char text[4096];
            snprintf(text, sizeof text, "%.*s", (int)(end - line), line);
            if (line == every.out || strstr(text, ",d3d12,") != NULL || strstr(text, ",gl,") != NULL ||
                strstr(text, ",three,") != NULL) {
                strcat(want, text);
                kept += line != every.out;
            }
        }
        assert_true(kept >= 3 && kept % 3 == 0);
        assert_string_equal(some.out, want);
        assert_non_null(strstr(one.out, "glPolygonOffset("));
        assert_null(strstr(one.out, "U)"));
        free(want);
        printed_free(&every);
        printed_free(&some);
        printed_free(&one);
    }
}

LIST_TEST(check_apart)
