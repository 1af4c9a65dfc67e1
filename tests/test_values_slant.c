/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What table and budget print of slanted triangles, against the library; options spelled out here by hand. */
#include "api/bias.h"
#include "printed.h"

enum { DEPTHS = 4 };

typedef struct slant_case {
    const char *camera, *options;
    double znear, zfar;
    dp_mapping mapping;
    double z[DEPTHS];
    dp_triangles triangles;
    const char *raster; /* null: none is named */
} slant_case;

static const slant_case cases[] = {
    {"-n 0.25 -f inf -F fp32 -m reversed",
     "--viewport 1920x1080 --fov 40",
     0.25,
     INFINITY,
     DP_MAPPING_REVERSED,
     {0.25, 3, 700, 5e4},
     {1920, 1080, 40, 8, {2, 11, 2, 0}, 0, 90, 2, 512, 16},
     NULL},
    {"-n 0.5 -f 300 -F fp32 -m d3d",
     "--viewport 640x360 --subpixel 4 --slant 10:45.5 --triangle-class slim=4,pixels=100,depth=1.5",
     0.5,
     300,
     DP_MAPPING_D3D,
     {0.5, 2, 30, 299},
     {640, 360, 60, 4, {2, 11, 2, 0}, 10, 45.5, 1.5, 100, 4},
     NULL},
    {"-n 0.001 -f 1e6 -F fp32 -m d3d",
     "--viewport 100x100",
     0.001,
     1e6,
     DP_MAPPING_D3D,
     {0.5, 30, 1e4, 1e5},
     {100, 100, 60, 8, {2, 11, 2, 0}, 0, 90, 2, 512, 16},
     NULL},
    {"-n 0.1 -f inf -F fp32 -m reversed",
     "--viewport 800x600 --raster llvmpipe",
     0.1,
     INFINITY,
     DP_MAPPING_REVERSED,
     {0.1, 1, 70, 5e4},
     {800, 600, 60, 0, {3, 10, 2, 4}, 0, 90, 2, 512, 16},
     "llvmpipe"},
    {"-n 0.1 -f 500 -F fp32 -m reversed",
     "--viewport 800x600 --raster softpipe",
     0.1,
     500,
     DP_MAPPING_REVERSED,
     {0.1, 1, 70, 400},
     {800, 600, 60, 0, {5, 8, 2, 5}, 0, 90, 2, 512, 16},
     "softpipe"},
    {"-n 0.1 -f 500 -F fp32 -m reversed",
     "--viewport 800x600 --raster SwiftShader",
     0.1,
     500,
     DP_MAPPING_REVERSED,
     {0.1, 1, 70, 400},
     {800, 600, 60, 4, {2, 11, 2, 0}, 0, 90, 2, 512, 16},
     "swiftshader"},
    {"-n 0.1 -f 500 -F fp32 -m d3d",
     "--viewport 800x600 --raster spec-d3d",
     0.1,
     500,
     DP_MAPPING_D3D,
     {0.1, 1, 70, 400},
     {800, 600, 60, 8, {5, 11, 2, 5}, 0, 90, 2, 512, 16},
     "spec-d3d"},
    {"-n 0.1 -f 500 -F fp32 -m reversed",
     "--viewport 800x600 --raster spec-vulkan --subpixel 6",
     0.1,
     500,
     DP_MAPPING_REVERSED,
     {0.1, 1, 70, 400},
     {800, 600, 60, 6, {5, 11, 2, 5}, 0, 90, 2, 512, 16},
     "spec-vulkan"},
    {"-n 0.1 -f 500 -F fp32 -m reversed",
     "--viewport 800x600 --raster spec-gl",
     0.1,
     500,
     DP_MAPPING_REVERSED,
     {0.1, 1, 70, 400},
     {800, 600, 60, 4, {5, 11, 2, 5}, 0, 90, 2, 512, 16},
     "spec-gl"},
};

/* As 'depthprec list arithmetic' has it beside the rasterizers' names. */
static const char *arith_of(const char *raster) {
    static const char *const known[][2] = {{"llvmpipe", "mesa"}, {"swiftshader", "mesa"}, {"softpipe", "softpipe"}};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
        if (raster != NULL && strcmp(known[i][0], raster) == 0)
            return known[i][1];
    return "ieee";
}

static dp_budget budget_of(const slant_case *c, double z, bool slanted) {
    dp_spec spec = dp_spec_default();
    dp_setup setup;
    dp_budget b;
    dp_triangles t = c->triangles;
    spec.znear = c->znear;
    spec.zfar = c->zfar;
    spec.mapping = c->mapping;
    assert_int_equal(dp_arith_parse(arith_of(c->raster), &spec.arith), DP_OK);
    if (slanted)
        spec.triangles = t;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    assert_int_equal(dp_budget_at(&setup, z, NULL, &b), DP_OK);
    return b;
}

static double at(const json_t *object, const char *key) {
    const json_t *value = json_object_get(object, key);
    if (value == NULL)
        fail_msg("no '%s'", key);
    return json_is_null(value) ? INFINITY : json_number_value(value);
}

static void check_triangles(const json_t *root, const dp_triangles *t, const char *raster) {
    const json_t *got = json_object_get(root, "triangles"), *named = json_object_get(got, "raster");
    assert_true(raster == NULL ? json_is_null(named) : strcmp(json_string_value(named), raster) == 0);
    assert_string_equal(json_string_value(json_object_get(got, "arith")), arith_of(raster));
    assert_true(at(got, "width") == t->width && at(got, "height") == t->height && at(got, "fov") == t->fov_y);
    assert_true(at(got, "subpixel") == t->subpixel && at(got, "slant_lo") == t->slant_lo);
    assert_true(at(got, "slant_hi") == t->slant_hi && at(got, "depth") == t->depth);
    assert_true(at(got, "pixels") == t->pixels && at(got, "slim") == t->slim);
}

static const json_t *row_of(const json_t *root, size_t k) {
    const json_t *setup = json_array_get(json_object_get(root, "setups"), 0);
    return json_array_get(json_object_get(setup, "rows"), k);
}

/* The field of a line of CSV that stands below a name. */
static double csv_at(const char *text, const char *name, int line) {
    int column = 0;
    const char *head = text, *found = strstr(text, name);
    assert_non_null(found);
    for (; head < found; head++)
        column += *head == ',';
    for (; line >= 0; line--)
        text = strchr(text, '\n') + 1;
    for (; column > 0; column--)
        text = strchr(text, ',') + 1;
    return *text == ',' ? INFINITY : strtod(text, NULL);
}

static void check_rows(const slant_case *c, const char *command) {
    char arguments[512];
    const bool table = strcmp(command, "table") == 0;
    snprintf(arguments, sizeof arguments, "%s %s %s --at %.17g,%.17g,%.17g,%.17g", command, c->camera, c->options,
             c->z[0], c->z[1], c->z[2], c->z[3]);
    printed json = print_of("%s --json", arguments), csv = print_of("%s --csv", arguments);
    json_t *root = json_of(json.out);
    check_triangles(root, &c->triangles, c->raster);
    for (int k = 0; k < DEPTHS; k++) {
        const json_t *row = row_of(root, (size_t)k), *causes = json_object_get(row, "causes");
        const dp_budget facing = budget_of(c, c->z[k], false), slanted = budget_of(c, c->z[k], true);
        assert_true(at(row, "guarantee_facing") == facing.separation);
        assert_true(at(row, "guarantee_slanted") == slanted.separation);
        assert_true(at(row, table ? "guaranteed" : "separation") == (table ? facing : slanted).separation);
        assert_true(csv_at(csv.out, "guarantee_facing [scene]", k) == facing.separation);
        assert_true(csv_at(csv.out, "guarantee_slanted [scene]", k) == slanted.separation);
        for (int i = 0; i < DP_CAUSE_COUNT && !table && isfinite(slanted.separation); i++)
            assert_true(json_object_get(causes, dp_cause_name((dp_cause)i)) == NULL /* of logarithmic mappings */
                            ? slanted.cause[i] == 0
                            : at(causes, dp_cause_name((dp_cause)i)) == slanted.cause[i]);
        if (!table && isfinite(slanted.separation))
            assert_true(csv_at(csv.out, "set-up [scene]", k) == slanted.cause[DP_CAUSE_SETUP] &&
                        csv_at(csv.out, "snapping [scene]", k) == slanted.cause[DP_CAUSE_SNAPPING]);
    }
    json_decref(root);
    printed_free(&json);
    printed_free(&csv);
}

TEST(test_rows) {
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        check_rows(&cases[i], "table");
        check_rows(&cases[i], "budget");
    }
}

/* With world positions: each guarantee has its own composition, and what it adds is that cause. */
TEST(test_world) {
    static const char *const names[] = {"once", "products", "relative"};
    const slant_case *c = &cases[0];
    dp_spec spec = dp_spec_default();
    dp_setup slanted;
    spec.znear = c->znear;
    spec.zfar = c->zfar;
    spec.mapping = c->mapping;
    spec.triangles = c->triangles;
    assert_int_equal(dp_setup_init(&slanted, &spec), DP_OK);
    const dp_setup facing = dp_setup_facing(&slanted);
    for (int i = 0; i < DP_COMPOSITION_COUNT; i++) {
        const dp_budget_terms terms = {.world = 20000, .composition = (dp_composition)i};
        const double z = 700;
        dp_budget of_slanted, of_facing, without;
        printed p = print_of("budget %s %s --at 700 --from-origin 20000 --composition %s --json", c->camera, c->options,
                             names[i]);
        json_t *root = json_of(p.out);
        const json_t *row = row_of(root, 0);
        const double part = at(json_object_get(row, "causes"), "composition");
        assert_int_equal(dp_budget_at(&slanted, z, &terms, &of_slanted), DP_OK);
        assert_int_equal(dp_budget_at(&facing, z, &terms, &of_facing), DP_OK);
        assert_int_equal(dp_budget_at(&slanted, z, NULL, &without), DP_OK);
        assert_true(at(row, "guarantee_slanted") == of_slanted.separation);
        assert_true(at(row, "guarantee_facing") == of_facing.separation);
        assert_true(of_slanted.separation > of_facing.separation && of_slanted.separation > without.separation);
        assert_relative(part, of_slanted.separation - without.separation, 1e-9);
        /* At least what positions alone do, edge-on, as the page has them: once more for the nearer plane. */
        if (i != DP_COMPOSITION_RELATIVE)
            assert_true(part >= 3 * sqrt(3) * 0x1p-10);
        json_decref(root);
        printed_free(&p);
    }
}

/* What the subpixel grid costs at the worst slant, per depth, as published for these views; 28.8 mm at 5 km. */
TEST(test_published) {
    static const struct {
        const char *view;
        double per_depth;
    } published[] = {
        {"--viewport 1920x1080 --hfov 90", 5.75e-6},     {"--viewport 1920x1080 --hfov 90 --subpixel 4", 9.2e-5},
        {"--viewport 1920x1080 --hfov 60", 3.32e-6},     {"--viewport 1920x1080 --hfov 60 --subpixel 4", 5.3e-5},
        {"--viewport 3840x2160 --hfov 90", 5.75e-6 / 2}, {"--viewport 3840x2160 --hfov 60 --subpixel 4", 5.3e-5 / 2}};
    for (size_t i = 0; i < sizeof published / sizeof published[0]; i++) {
        printed p = print_of("budget -n 0.1 -f inf -F fp32 -m reversed --slant 89.999:90 --at 5000 --json %s",
                             published[i].view);
        json_t *root = json_of(p.out);
        const double got = at(json_object_get(row_of(root, 0), "causes"), "snapping");
        assert_relative(got / 5000, published[i].per_depth, 0.004);
        assert_true(i > 0 || fabs(got - 0.0288) < 0.0001);
        json_decref(root);
        printed_free(&p);
    }
}

/* Of text the last column of a table is that at any slant, rounded up. */
TEST(test_text) {
    const slant_case *c = &cases[0];
    printed p = print_of("table %s %s --at 700", c->camera, c->options);
    const char *head = strstr(p.out, " guaranteed  any slant\n");
    assert_non_null(head);
    const char *line = strchr(head, '\n') + 1, *end = strchr(line, '\n');
    while (end[-1] != ' ')
        end--;
    const double got = strtod(end, NULL), want = budget_of(c, 700, true).separation;
    assert_true(got >= want && got <= want * (1 + 1e-4));
    assert_non_null(strstr(p.out, "viewport 1920x1080, fov 40, 8 subpixel bits, slant 0 to 90 degrees, ieee\n"));
    assert_non_null(strstr(p.out, "triangles from z/2 to 2 z, at most 512 pixels, no slimmer than 1:16\n"));
    assert_non_null(strstr(p.out, "told apart, facing the camera: surfaces"));
    printed_free(&p);
}

/* Who draws, on which grid, and how depth is set up. */
TEST(test_rasterizer) {
    static const struct {
        const char *options, *line;
    } said[] = {{"--raster llvmpipe", "llvmpipe: depth from unsnapped vertices, anchor origin, arithmetic mesa\n"},
                {"--raster swiftshader", "swiftshader: 4 subpixel bits, anchor vertex, arithmetic mesa\n"},
                {"--raster spec-d3d", "spec-d3d: 8 subpixel bits, any anchor: the worst is counted, arithmetic ieee\n"},
                {"--raster spec-gl --subpixel 5",
                 "spec-gl: at least 5 subpixel bits, any anchor: the worst is counted, arithmetic\n"}};
    for (size_t i = 0; i < sizeof said / sizeof said[0]; i++) {
        printed p = print_of("budget -F fp32 -m reversed --viewport 640x480 --at 10 %s", said[i].options);
        assert_non_null(strstr(p.out, "viewport 640x480, fov 60, slant 0 to 90 degrees\n"));
        assert_non_null(strstr(p.out, said[i].line));
        printed_free(&p);
    }
}

/* A preset's view and rasterizer hold with a viewport, and where they are not given. */
TEST(test_presets) {
    static const struct {
        const char *options, *raster;
        double fov;
        int bits;
    } asked[] = {{"--preset godot-forward", "spec-vulkan", 75, 4},
                 {"--preset unity-gl", "spec-gl", 60, 4},
                 {"--preset godot-forward --fov 40", "spec-vulkan", 40, 4},
                 {"--preset godot-forward --raster spec-d3d", "spec-d3d", 75, 8},
                 {"--preset godot-forward --raster spec-vulkan --subpixel 6", "spec-vulkan", 75, 6},
                 {"--preset godot-forward --subpixel 6", NULL, 75, 6}};
    for (size_t i = 0; i < sizeof asked / sizeof asked[0]; i++) {
        printed p = print_of("table --viewport 1920x1080 --at 10 --json %s", asked[i].options);
        json_t *root = json_of(p.out), *got = json_object_get(root, "triangles");
        const json_t *named = json_object_get(got, "raster");
        assert_true(at(got, "fov") == asked[i].fov && at(got, "subpixel") == asked[i].bits);
        assert_true(asked[i].raster == NULL ? json_is_null(named)
                                            : strcmp(json_string_value(named), asked[i].raster) == 0);
        json_decref(root);
        printed_free(&p);
    }
    printed p = print_of("table --preset godot-forward --at 10 --json");
    assert_null(strstr(p.out, "triangles"));
    printed_free(&p);
    /* Of several each has its own. */
    p = print_of("table --preset bevy,three --viewport 800x800 --at 10m --json");
    json_t *root = json_of(p.out);
    assert_null(json_object_get(root, "triangles"));
    for (size_t i = 0; i < 2; i++) {
        const json_t *setup = json_array_get(json_object_get(root, "setups"), i);
        const json_t *got = json_object_get(setup, "triangles");
        const slant_case bevy = {.znear = 0.1,
                                 .zfar = INFINITY,
                                 .mapping = DP_MAPPING_REVERSED,
                                 .triangles = {800, 800, 45, 4, {5, 11, 2, 5}, 0, 90, 2, 512, 16}};
        assert_true(at(got, "fov") == (i == 0 ? 45 : 50));
        assert_string_equal(json_string_value(json_object_get(got, "raster")), i == 0 ? "spec-vulkan" : "spec-gl");
        if (i == 0)
            assert_true(at(json_array_get(json_object_get(setup, "rows"), 0), "guarantee_slanted") ==
                        budget_of(&bevy, 10, true).separation);
    }
    json_decref(root);
    printed_free(&p);
}

/* The bias of one plane drawn twice: the least factor, or the one given, and the units with it. */
static void check_bias(const slant_case *c, const char *options, double slope, double given) {
    static const char *const apis[] = {"d3d11", "vulkan-unorm"};
    for (size_t a = 0; a < 2; a++) {
        const char *const common = "bias %s %s %s --api %s --at %.17g %s";
        printed json = print_of(common, c->camera, c->options, options, apis[a], c->z[2], "--json");
        printed csv = print_of(common, c->camera, c->options, options, apis[a], c->z[2], "--csv");
        printed all = print_of(common, c->camera, c->options, options, "all", c->z[2], "--json");
        json_t *root = json_of(json.out), *every = json_of(all.out);
        const json_t *setup = json_array_get(json_object_get(root, "setups"), 0), *row = row_of(root, 0);
        bias_goal goal = {.slope = slope};
        dp_spec spec = dp_spec_default();
        dp_setup slanted;
        size_t i = 0;
        while (strcmp(bias_api_get(i)->name, apis[a]) != 0)
            i++;
        goal.api = bias_api_get(i);
        spec.znear = c->znear;
        spec.zfar = c->zfar;
        spec.mapping = c->mapping;
        spec.triangles = c->triangles;
        assert_int_equal(dp_setup_init(&slanted, &spec), DP_OK);
        goal.factor = isnan(given) ? bias_factor_least(&slanted) : given;
        const double sign = c->mapping == DP_MAPPING_REVERSED ? 1 : -1;
        const double units = sign * bias_needed(&slanted, &goal, c->z[2]);
        check_triangles(root, &c->triangles, c->raster);
        check_triangles(every, &c->triangles, c->raster);
        assert_true(isnan(given) ? json_is_null(json_object_get(root, "factor")) : at(root, "factor") == sign * given);
        assert_true(at(setup, "factor") == sign * goal.factor && at(row, "units_apart") == units);
        assert_true(at(row, "guarantee_facing") == budget_of(c, c->z[2], false).separation);
        assert_true(at(row, "guarantee_slanted") == budget_of(c, c->z[2], true).separation);
        assert_true(csv_at(csv.out, "units_apart", 0) == units && csv_at(csv.out, "factor", 0) == sign * goal.factor);
        assert_true(csv_at(csv.out, "guarantee_slanted [scene]", 0) == budget_of(c, c->z[2], true).separation);
        assert_true(at(row_of(every, i), "units") == units && at(row_of(every, i), "factor") == sign * goal.factor);
        json_decref(root);
        json_decref(every);
        printed_free(&json);
        printed_free(&csv);
        printed_free(&all);
    }
}

TEST(test_bias) {
    check_bias(&cases[0], "", 0, NAN);
    check_bias(&cases[0], "--slope 0.5", 0.5, 0);
    check_bias(&cases[1], "", 0, NAN);
    check_bias(&cases[1], "--factor -0.5", 0, 0.5);
    check_bias(&cases[3], "--slope 0.01 --factor 0.25", 0.01, 0.25);
    /* What no units are enough for. */
    printed p = print_of("bias %s %s --factor 0.001 --at 3", cases[0].camera, cases[0].options);
    assert_non_null(strstr(p.out, "no bias is enough at z = 3"));
    assert_non_null(strstr(p.out, "no units are enough with a factor below 0.0"));
    printed_free(&p);
    p = print_of("bias %s %s --at 3 --api gl", cases[0].camera, cases[0].options);
    assert_non_null(strstr(p.out, "gl, factor 0.0"));
    assert_non_null(strstr(p.out, "viewport 1920x1080, fov 40, 8 subpixel bits, slant 0 to 90 degrees, ieee\n"));
    printed_free(&p);
}

/* The figure has both: each point is that of a pixel column, and no less than what is guaranteed there. */
TEST(test_plot) {
    const slant_case *c = &cases[0];
    printed p = print_of("plot interval --model float %s %s --range 1:1e4 --json", c->camera, c->options);
    json_t *root = json_of(p.out), *series, *point;
    const json_t *panel = json_array_get(json_object_get(root, "panels"), 0);
    size_t s, i, points[2] = {0};
    json_array_foreach(json_object_get(panel, "series"), s, series) {
        const char *name = json_string_value(json_object_get(series, "name"));
        const bool slanted = strcmp(name, "fp32 reversed, any slant") == 0;
        if (!slanted && strcmp(name, "fp32 reversed") != 0)
            continue;
        json_array_foreach(json_object_get(series, "points"), i, point) {
            const double z = at(point, "z"), got = at(point, "interval");
            assert_true(got >= budget_of(c, z, slanted).separation * 0.98);
            assert_true(got <= budget_of(c, fmin(z * 1.05, 1e4), slanted).separation * (slanted ? 1.02 : 2.05));
            points[slanted]++;
        }
    }
    assert_true(points[0] > 5 && points[1] >= 2);
    assert_non_null(strstr(json_string_value(json_object_get(root, "subtitle")),
                           ", 1920x1080, fov 40, 8 subpixel bits, slant 0 to 90"));
    json_decref(root);
    printed_free(&p);
}

/* A census stays what it is; beside each band stands what holds at any slant all over it. */
TEST(test_zfight) {
    const slant_case *c = &cases[0];
    static const char *const same[] = {"pairs", "ties", "swaps", "longest", "longest_z", "bound", "used"};
    const char *const common = "zfight %s --range 5.5:9 --json %s";
    printed with = print_of(common, c->camera, c->options), without = print_of(common, c->camera, "");
    printed csv = print_of("zfight %s --range 5.5:9 --csv %s", c->camera, c->options);
    json_t *roots[] = {json_of(with.out), json_of(without.out)};
    const json_t *setups[2], *bands[2];
    dp_spec spec = dp_spec_default();
    dp_setup slanted;
    spec.znear = c->znear;
    spec.zfar = c->zfar;
    spec.mapping = c->mapping;
    spec.model = DP_MODEL_FLOAT;
    spec.triangles = c->triangles;
    assert_int_equal(dp_setup_init(&slanted, &spec), DP_OK);
    check_triangles(roots[0], &c->triangles, c->raster);
    for (int k = 0; k < 2; k++) {
        setups[k] = json_array_get(json_object_get(roots[k], "setups"), 0);
        bands[k] = json_object_get(setups[k], "bands");
    }
    assert_int_equal(json_array_size(bands[0]), 2);
    for (size_t b = 0; b < 3; b++) { /* the last: all of them */
        const json_t *got = b < 2 ? json_array_get(bands[0], b) : setups[0];
        const json_t *other = b < 2 ? json_array_get(bands[1], b) : setups[1];
        dp_separation_worst worst;
        assert_int_equal(dp_separation_over(&slanted, b == 1 ? 8 : 5.5, b == 0 ? 8 : 9, 0, &worst), DP_OK);
        assert_true(at(got, "guarantee_slanted") == worst.bound);
        assert_true(at(got, "guarantee_facing") == at(got, "bound"));
        assert_true(b == 2 || csv_at(csv.out, "guarantee_slanted [scene]", (int)b) == worst.bound);
        for (size_t i = 0; i < sizeof same / sizeof same[0]; i++)
            assert_true(at(got, same[i]) == at(other, same[i]));
    }
    assert_non_null(strstr(with.out, "\"raster\":null"));
    for (int k = 0; k < 2; k++)
        json_decref(roots[k]);
    printed_free(&with);
    printed_free(&without);
    printed_free(&csv);
}

/* Over a range, of both. */
TEST(test_range) {
    const slant_case *c = &cases[0];
    printed p = print_of("table %s %s --at 700 --range 3:5e4 --json", c->camera, c->options);
    json_t *root = json_of(p.out);
    const json_t *setup = json_array_get(json_object_get(root, "setups"), 0);
    for (int slanted = 0; slanted < 2; slanted++) {
        const json_t *got = json_object_get(setup, slanted ? "worst_separation_slanted" : "worst_separation");
        dp_spec spec = dp_spec_default();
        dp_setup full;
        dp_separation_worst worst;
        spec.znear = c->znear;
        spec.zfar = c->zfar;
        spec.mapping = c->mapping;
        spec.model = DP_MODEL_FLOAT;
        if (slanted)
            spec.triangles = c->triangles;
        assert_int_equal(dp_setup_init(&full, &spec), DP_OK);
        assert_int_equal(dp_separation_over(&full, 3, 5e4, 0, &worst), DP_OK);
        assert_true(at(got, "bound") == worst.bound && at(got, "separation") == worst.separation);
        assert_true(at(got, "z") == worst.z && at(got, "lo") == 3 && at(got, "hi") == 5e4);
    }
    json_decref(root);
    printed_free(&p);
}

/* Where nothing is certain, it is what lies in front of the farther surface that is not. */
TEST(test_hopeless) {
    const slant_case *c = &cases[2];
    printed p = print_of("budget %s %s --at 30,1e4,1e5", c->camera, c->options);
    assert_true(isfinite(budget_of(c, 30, true).separation) && isinf(budget_of(c, 1e4, true).separation));
    assert_non_null(strstr(p.out, "at z = 10000 no separation is guaranteed: everything nearer may share its code\n"));
    printed_free(&p);
}
