/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every number that shadow prints of spot and point lights, against the room shadow with a light of the test's own. */
#include "bias/cmd_bias/call.h"
#include "printed.h"
#include "shadow/engine.h"
#include "shadow/shadow.h"

static const char *const ways[SHADOW_WAY_COUNT] = {"constant", "slope", "normal"};

/* Each line, and its light by hand. */
static const struct {
    const char *line;
    shadow_kind kind;
    double fov, znear, zfar, lo, hi;
    int size, kernel;
    double angle, world;
    bool distance;
    const char *format;
    dp_mapping mapping;
    const char *api;
    double at[5];
} given[] = {
    {"shadow --spot 90 -n 0.1 -f 3 --size 512 -F d16 --kernel 1 --angle 45 --at 0.5,1,3",
     SHADOW_SPOT,
     90,
     0.1,
     3,
     0.1,
     3,
     512,
     1,
     45,
     0,
     false,
     "unorm16",
     DP_MAPPING_D3D,
     "d3d11",
     {0.5, 1, 3}},
    {"shadow --spot 50 -n 0.25 -f inf --range 1:64 --size 1024 -m reversed --kernel 5 --angle 70 --api gl "
     "--from-origin 8",
     SHADOW_SPOT,
     50,
     0.25,
     INFINITY,
     1,
     64,
     1024,
     5,
     70,
     8,
     false,
     "fp32",
     DP_MAPPING_REVERSED,
     "gl",
     {0}},
    {"shadow --point -n 0.5 -f 32 -F d24 -m gl --api vulkan-float --angle 10",
     SHADOW_POINT,
     90,
     0.5,
     32,
     0.5,
     32,
     2048,
     3,
     10,
     0,
     false,
     "unorm24",
     DP_MAPPING_GL,
     "vulkan-float",
     {0}},
    /* Units have no effect at the near plane: an octave of receivers is left out. */
    {"shadow --point -n 0.5 -f 32",
     SHADOW_POINT,
     90,
     0.5,
     32,
     1,
     32,
     2048,
     3,
     75,
     0,
     false,
     "fp32",
     DP_MAPPING_D3D,
     "d3d11",
     {0}},
    {"shadow --point -n 0.5 -f 32 -m reversed",
     SHADOW_POINT,
     90,
     0.5,
     32,
     0.5,
     16,
     2048,
     3,
     75,
     0,
     false,
     "fp32",
     DP_MAPPING_REVERSED,
     "d3d11",
     {0}},
    {"shadow --point --distance -n 0.5 -f 32 -F fp16 --size 256",
     SHADOW_POINT,
     90,
     0.5,
     32,
     0.5,
     32,
     256,
     3,
     75,
     0,
     true,
     "fp16",
     DP_MAPPING_D3D,
     "vulkan-float",
     {0}},
};

enum { CASES = sizeof given / sizeof given[0] };

static shadow_light light_of(size_t i) {
    shadow_light light = shadow_light_default();
    dp_spec spec = dp_spec_default();
    dp_format found[2];
    assert_int_equal(dp_format_parse(given[i].format, found), 1);
    spec.znear = given[i].znear;
    spec.zfar = given[i].zfar;
    spec.ortho = given[i].distance;
    spec.mapping = given[i].mapping;
    spec.format = found[0];
    assert_int_equal(dp_setup_init(&light.setup, &spec), DP_OK);
    light.kind = given[i].kind;
    light.fov = given[i].fov;
    light.triangles.width = light.triangles.height = given[i].size;
    light.triangles.slant_hi = given[i].angle;
    light.kernel = 0.5 * given[i].kernel;
    light.world = given[i].world;
    light.receiver_lo = given[i].lo;
    light.receiver_hi = given[i].hi;
    assert_int_equal(shadow_light_check(&light), SHADOW_OK);
    return light;
}

/* Null where no such bias is enough. */
static void check_number(tally *t, const json_t *root, const char *path, double expected) {
    const double shown = number_at(root, "%s", path);
    const double value = isfinite(expected) ? expected : (double)NAN;
    TALLY(t, isnan(value) ? isnan(shown) : fabs(shown - value) <= 1e-12 * fabs(value), "%s: %.17g, not %.17g", path,
          shown, value);
}

#define CHECK(expected, ...)                                                                                           \
    do {                                                                                                               \
        char path[256];                                                                                                \
        snprintf(path, sizeof path, __VA_ARGS__);                                                                      \
        check_number(t, root, path, expected);                                                                         \
    } while (0)

/* A bias that is enough for all receivers, in the first lines and in the rows: units of one depth, gaps of all. */
static void check_way(tally *t, const json_t *root, size_t i, int way, size_t rows) {
    const shadow_light light = light_of(i);
    const bias_api *api = bias_api_find(given[i].api);
    const double sign = shadow_sign(&light);
    shadow_need need, here;
    shadow_need_of(&light, &need);
    const shadow_bias *b = &need.bias[way];
    const shadow_state all = shadow_state_of(&light, b, api);
    CHECK(isfinite(b->factor) ? sign * all.units : (double)NAN, "setups[0].answers[0].%s_units", ways[way]);
    for (size_t k = 0; k < rows; k++) {
        shadow_light one = light;
        shadow_state state = all;
        one.receiver_lo = one.receiver_hi = number_at(root, "setups[0].rows[%zu].z", k);
        shadow_need_of(&one, &here);
        const shadow_state needed = shadow_state_of(&one, &here.bias[way], api);
        state.gap_light = state.gap_normal = state.gap_facing = 0.0;
        shadow_state_widen(&one, b, api, &state);
        const bool none = !isfinite(b->factor) || !isfinite(needed.units);
        CHECK(here.bias[way].window, "setups[0].rows[%zu].%s_bias", k, ways[way]);
        CHECK(none ? (double)NAN : sign * needed.units, "setups[0].rows[%zu].%s_units", k, ways[way]);
        CHECK(none ? (double)NAN : state.gap_light, "setups[0].rows[%zu].%s_gap", k, ways[way]);
        CHECK(none ? (double)NAN : state.gap_normal, "setups[0].rows[%zu].%s_gap_normal", k, ways[way]);
        if (way != SHADOW_CONSTANT)
            CHECK(none ? (double)NAN : state.gap_facing, "setups[0].rows[%zu].%s_gap_facing", k, ways[way]);
    }
    if (way == SHADOW_SLOPE)
        CHECK(sign * b->factor, "setups[0].answers[0].slope_factor");
    if (way == SHADOW_NORMAL)
        CHECK(b->offset / (2.0 * tan(given[i].fov * 3.14159265358979323846 / 360.0) / given[i].size),
              "setups[0].answers[0].normal_texels");
}

/* These follow by hand: a texel, and a plane on the axis that is steepest along a row of texels. */
static void check_axis(tally *t, const json_t *root, size_t i, size_t k) {
    const double n = given[i].znear, f = given[i].zfar, pi = 3.14159265358979323846;
    const double z = number_at(root, "setups[0].rows[%zu].z", k);
    const double texel = 2.0 * tan(given[i].fov * pi / 360.0) * z / given[i].size;
    const double rise = 0.5 * given[i].kernel * texel * tan(given[i].angle * pi / 180.0);
    const double bias = given[i].distance ? rise / (f - n) : rise / (z * z * (1.0 / n - 1.0 / f));
    const double codes = strcmp(given[i].format, "unorm16") == 0   ? 65535.0
                         : strcmp(given[i].format, "unorm24") == 0 ? 16777215.0
                                                                   : (double)NAN;
    CHECK(texel, "setups[0].rows[%zu].texel_size", k);
    CHECK(bias, "setups[0].rows[%zu].axis_bias", k);
    CHECK(bias * codes, "setups[0].rows[%zu].axis_codes", k);
    CHECK(given[i].at[0] > 0 ? given[i].at[k] : given[i].lo * pow(given[i].hi / given[i].lo, (double)k / 4.0),
          "setups[0].rows[%zu].z", k);
}

TEST(each_number) {
    tally all = {.name = "numbers"}, *t = &all;
    for (size_t i = 0; i < CASES; i++) {
        json_t *root = json_printed(0, "%s", given[i].line);
        const size_t rows = given[i].at[0] > 0 ? 3 : 5;
        assert_int_equal(json_array_size(node_at(root, "setups[0].rows")), rows);
        CHECK(given[i].fov, "light.fov");
        CHECK(given[i].znear, "light.near");
        CHECK(given[i].zfar, "light.far");
        CHECK(given[i].lo, "setups[0].lit_from");
        CHECK(given[i].hi, "setups[0].lit_to");
        assert_string_equal(text_at(root, "light.kind"), given[i].kind == SHADOW_SPOT ? "spot" : "point");
        assert_int_equal(flag_at(root, "light.distance"), given[i].distance);
        for (int way = 0; way < SHADOW_WAY_COUNT; way++)
            check_way(t, root, i, way, rows);
        for (size_t k = 0; k < rows; k++)
            check_axis(t, root, i, k);
        json_decref(root);
    }
    tally_end(&all);
}

/* The least that is told of an engine's number, as the text has it, is enough; half of it is not. */
TEST(told_numbers_are_enough) {
    static const char *const lights[] = {"--spot 60 -n 0.5 -f 40 -F d24 --size 1024",
                                         "--spot 90 -n 0.1 -f 3 -F d16 --size 512 --angle 60",
                                         "--light-box 40x40x100 -F d16", "--point -n 0.1 -f 25 -F fp32 --distance"};
    static const char *const options[] = {"bias", "normal-bias"};
    tally enough = {.name = "enough"}, less = {.name = "half"};
    for (size_t i = 0; i < sizeof lights / sizeof lights[0]; i++)
        for (size_t e = 0; shadow_engine_get(e) != NULL; e++) {
            const char *name = shadow_engine_get(e)->name;
            if (shadow_engine_get(e)->instead[0] != '\0') {
                check_says(2, "no bias in depth follows", "shadow %s --engine %s", lights[i], name);
                continue;
            }
            printed p = print_of("shadow %s --engine %s", lights[i], name);
            char *row = strstr(p.out, "\nengine "), told[2][32];
            assert_non_null(row);
            assert_int_equal(sscanf(strstr(row, name), "%*s %*s %*s %*s %*s %*s %31s %31s", told[0], told[1]), 2);
            printed_free(&p);
            for (int k = 0; k < 2; k++) {
                const double value = strtod(told[k], NULL);
                if (value == 0) /* "-", or the other number alone suffices */
                    continue;
                json_t *with = json_printed(0, "shadow %s --engine %s --%s=%s", lights[i], name, options[k], told[k]);
                TALLY(&enough, flag_at(with, "setups[0].engines[0].enough"), "%s, %s: %s %s", lights[i], name,
                      options[k], told[k]);
                json_decref(with);
                with = json_printed(0, "shadow %s --engine %s --%s=%.17g", lights[i], name, options[k], value / 2);
                TALLY(&less, !flag_at(with, "setups[0].engines[0].enough"), "%s, %s: %s %g", lights[i], name,
                      options[k], value / 2);
                json_decref(with);
            }
        }
    tally_end(&enough);
    tally_end(&less);
    assert_true(enough.cases >= 30);
}

/* An edge as the light sees it, between two places of a disc of radius 1: how far its points, each put into the
 * paraboloid by itself, lie beside the line between its ends. */
static double rise_of(const double ends[2][2]) {
    const double dx = ends[1][0] - ends[0][0], dy = ends[1][1] - ends[0][1], length = hypot(dx, dy);
    double from[2][3], most = 0.0;
    for (int k = 0; k < 2; k++) { /* q = (x, y)/(|P| + z) has P = (2 q, 1 - q q)/(1 + q q) */
        const double square = ends[k][0] * ends[k][0] + ends[k][1] * ends[k][1];
        from[k][0] = 2.0 * ends[k][0] / (1.0 + square);
        from[k][1] = 2.0 * ends[k][1] / (1.0 + square);
        from[k][2] = (1.0 - square) / (1.0 + square);
    }
    for (int i = 0; i <= 1000; i++) {
        double p[3];
        for (int a = 0; a < 3; a++)
            p[a] = from[0][a] + (from[1][a] - from[0][a]) * i / 1000.0;
        const double sum = sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) + p[2];
        most = fmax(most, fabs((p[0] / sum - ends[0][0]) * dy - (p[1] / sum - ends[0][1]) * dx) / length);
    }
    return most;
}

/* Of two paraboloids it is said why no bias follows: how far an edge of N texels is drawn off its place. */
TEST(paraboloids) {
    rng r = rng_make("paraboloids");
    tally t = {.name = "N^2/(4 SIZE)"};
    double most = 0.0;
    check_says(2, "N^2/(4 SIZE) of them off", "shadow --dual-paraboloid -n 0.1 -f 25");
    check_says(2, "--point", "shadow --point --paraboloid");
    for (int i = 0; i < 2000; i++) {
        const double size = rng_log(&r, 256, 4096), texels = size * rng_uniform(&r, 0.01, 0.125),
                     turn = 2.0 * texels / size;
        const double at = i % 2 ? 1.0 : rng_uniform(&r, 0.0, 1.0), u = rng_uniform(&r, -3.0, 3.0);
        const double v = i % 2 ? u + 2.0 * asin(0.5 * turn) : rng_uniform(&r, -3.0, 3.0);
        const double ends[2][2] = {
            {at * cos(u), at * sin(u)},
            {i % 2 ? cos(v) : at * cos(u) + turn * cos(v), i % 2 ? sin(v) : at * sin(u) + turn * sin(v)}};
        const double share = rise_of(ends) * size / 2.0 / (texels * texels / (4.0 * size));
        TALLY(&t, share < 1.01, "an edge of %g of %g texels: %g", texels, size, share);
        most = fmax(most, share);
    }
    TALLY(&t, most > 0.99, "at most %g", most);
    tally_end(&t);
}

/* The numbers of the thread on a spot light's D16 map of 512 texels. */
TEST(by_hand) {
    json_t *root = json_printed(0, "%s", given[0].line);
    static const double codes[] = {26.5, 13.2, 4.4};
    for (size_t k = 0; k < 3; k++)
        assert_true(fabs(number_at(root, "setups[0].rows[%zu].axis_codes", k) - codes[k]) < 0.05);
    json_decref(root);
    check_says(0, "26.48", "%s", given[0].line);
    check_says(0, "no API biases a depth that a fragment shader writes", "%s", given[5].line);
    check_says(0, "seam", "%s", given[2].line);
    check_says(0, "!seam", "%s --kernel 1", given[2].line);
    check_says(2, "must lie from near to far, 0.5 to 40, and within 60 octaves and 1e12, got '0.1:50'",
               "shadow --spot 60 -n 0.5 -f 40 --range 0.1:50");
}
