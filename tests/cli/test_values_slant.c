/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Slanted triangles in table and budget, against the library; options spelled out here by hand. */

#include "bias/bias.h"
#include "printed.h"

enum { DEPTHS = 4 };

typedef struct slant_case {
    const char *line; /* -n -f -m and what is asked of triangles; fp32 */
    double z[DEPTHS];
    dp_triangles triangles;
    const char *raster; /* null: none is named */
} slant_case;

static const slant_case cases[] = {
    {"-n 0.25 -f inf -F fp32 -m reversed --viewport 1920x1080 --fov 40",
     {0.25, 3, 700, 5e4},
     {1920, 1080, 40, 8, {2, 11, 2, 0}, 0, 90, 2, 512, 16},
     NULL},
    {"-n 0.5 -f 300 -F fp32 -m d3d --viewport 640x360 --subpixel 4 --slant 10:45.5 "
     "--triangle-class slim=4,pixels=100,depth=1.5",
     {0.5, 2, 30, 299},
     {640, 360, 60, 4, {2, 11, 2, 0}, 10, 45.5, 1.5, 100, 4},
     NULL},
    {"-n 0.001 -f 1e6 -F fp32 -m d3d --viewport 100x100",
     {0.5, 30, 1e4, 1e5},
     {100, 100, 60, 8, {2, 11, 2, 0}, 0, 90, 2, 512, 16},
     NULL},
    {"-n 0.1 -f inf -F fp32 -m reversed --viewport 800x600 --raster llvmpipe",
     {0.1, 1, 70, 5e4},
     {800, 600, 60, 0, {3, 10, 2, 4}, 0, 90, 2, 512, 16},
     "llvmpipe"},
    {"-n 0.1 -f 500 -F fp32 -m reversed --viewport 800x600 --raster softpipe",
     {0.1, 1, 70, 400},
     {800, 600, 60, 0, {5, 8, 2, 5}, 0, 90, 2, 512, 16},
     "softpipe"},
    {"-n 0.1 -f 500 -F fp32 -m reversed --viewport 800x600 --raster SwiftShader",
     {0.1, 1, 70, 400},
     {800, 600, 60, 4, {2, 11, 2, 0}, 0, 90, 2, 512, 16},
     "swiftshader"},
    {"-n 0.1 -f 500 -F fp32 -m d3d --viewport 800x600 --raster spec-d3d",
     {0.1, 1, 70, 400},
     {800, 600, 60, 8, {5, 11, 2, 5}, 0, 90, 2, 512, 16},
     "spec-d3d"},
    {"-n 0.1 -f 500 -F fp32 -m reversed --viewport 800x600 --raster spec-vulkan --subpixel 6",
     {0.1, 1, 70, 400},
     {800, 600, 60, 6, {5, 11, 2, 5}, 0, 90, 2, 512, 16},
     "spec-vulkan"},
    {"-n 0.1 -f 500 -F fp32 -m reversed --viewport 800x600 --raster spec-gl",
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

/* With the rasterizer's arithmetic. */
static dp_setup setup_of(const slant_case *c, bool slanted, dp_model model) {
    dp_setup setup[SETUPS_MAX];
    assert_int_equal(setups_of(c->line, model, setup), 1);
    dp_spec spec = setup[0].spec;
    assert_int_equal(dp_arith_parse(arith_of(c->raster), &spec.arith), DP_OK);
    if (slanted)
        spec.triangles = c->triangles;
    assert_int_equal(dp_setup_init(setup, &spec), DP_OK);
    return setup[0];
}

static dp_budget budget_of(const slant_case *c, double z, bool slanted) {
    const dp_setup setup = setup_of(c, slanted, DP_MODEL_EXACT);
    dp_budget b;
    assert_int_equal(dp_budget_at(&setup, z, NULL, &b), DP_OK);
    return b;
}

static double separation_of(const slant_case *c, double z, bool slanted) {
    return budget_of(c, z, slanted).separation;
}

/* Null is no number, and means that there is no end. */
static double at(const json_t *object, const char *key) {
    const double number = number_at(object, "%s", key);
    return isnan(number) ? INFINITY : number;
}

static void check_raster(const json_t *root, const char *raster) {
    const char *named = text_at(root, "triangles.raster");
    assert_true(raster == NULL ? named == NULL : strcmp(named, raster) == 0);
}

static void check_triangles(const json_t *root, const dp_triangles *t, const char *raster) {
    const json_t *got = node_at(root, "triangles");
    check_raster(root, raster);
    assert_string_equal(text_at(got, "arith"), arith_of(raster));
    assert_true(at(got, "width") == t->width && at(got, "height") == t->height && at(got, "fov") == t->fov_y);
    assert_true(at(got, "subpixel") == t->subpixel && at(got, "slant_lo") == t->slant_lo);
    assert_true(at(got, "slant_hi") == t->slant_hi && at(got, "depth") == t->depth);
    assert_true(at(got, "pixels") == t->pixels && at(got, "slim") == t->slim);
}

static const json_t *row_of(const json_t *root, size_t k) {
    return node_at(root, "setups[0].rows[%zu]", k);
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
    char line[512];
    const bool table = strcmp(command, "table") == 0;
    snprintf(line, sizeof line, "%s %s --at %.17g,%.17g,%.17g,%.17g", command, c->line, c->z[0], c->z[1], c->z[2],
             c->z[3]);
    json_t *root = json_printed(0, "%s", line);
    char *csv = output_of(0, line, "--csv");
    check_triangles(root, &c->triangles, c->raster);
    for (int k = 0; k < DEPTHS; k++) {
        const json_t *row = row_of(root, (size_t)k), *causes = node_at(row, "causes");
        const dp_budget facing = budget_of(c, c->z[k], false), slanted = budget_of(c, c->z[k], true);
        assert_true(at(row, "guarantee_facing") == facing.separation);
        assert_true(flag_at(row, "certain") == (c->z[k] + facing.separation <= number_behind(c->line, "-f", 1000)));
        assert_true(at(row, "guarantee_slanted") == slanted.separation);
        assert_true(at(row, table ? "guaranteed" : "separation") == (table ? facing : slanted).separation);
        assert_true(csv_at(csv, "guarantee_facing [scene]", k) == facing.separation);
        assert_true(csv_at(csv, "guarantee_slanted [scene]", k) == slanted.separation);
        for (int i = 0; i < DP_CAUSE_COUNT && !table && isfinite(slanted.separation); i++)
            assert_true(node_at(causes, "%s", dp_cause_name((dp_cause)i)) == NULL /* of logarithmic mappings */
                            ? slanted.cause[i] == 0
                            : at(causes, dp_cause_name((dp_cause)i)) == slanted.cause[i]);
        if (!table && isfinite(slanted.separation))
            assert_true(csv_at(csv, "set-up [scene]", k) == slanted.cause[DP_CAUSE_SETUP] &&
                        csv_at(csv, "snapping [scene]", k) == slanted.cause[DP_CAUSE_SNAPPING]);
    }
    json_decref(root);
    free(csv);
}

TEST(rows) {
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        check_rows(&cases[i], "table");
        check_rows(&cases[i], "budget");
    }
}

/* With world positions: each guarantee has its own composition, and what it adds is that cause. */
TEST(world) {
    static const char *const names[] = {"once", "products", "relative"};
    const dp_setup slanted = setup_of(&cases[0], true, DP_MODEL_EXACT), facing = dp_setup_facing(&slanted);
    for (int i = 0; i < DP_COMPOSITION_COUNT; i++) {
        const dp_budget_terms terms = {.world = 20000, .composition = (dp_composition)i};
        dp_budget of_slanted, of_facing, without;
        json_t *root =
            json_printed(0, "budget %s --at 700 --from-origin 20000 --composition %s", cases[0].line, names[i]);
        const json_t *row = row_of(root, 0);
        const double part = at(row, "causes.composition");
        assert_int_equal(dp_budget_at(&slanted, 700, &terms, &of_slanted), DP_OK);
        assert_int_equal(dp_budget_at(&facing, 700, &terms, &of_facing), DP_OK);
        assert_int_equal(dp_budget_at(&slanted, 700, NULL, &without), DP_OK);
        assert_true(at(row, "guarantee_slanted") == of_slanted.separation);
        assert_true(at(row, "guarantee_facing") == of_facing.separation);
        assert_true(of_slanted.separation > of_facing.separation && of_slanted.separation > without.separation);
        assert_relative(part, of_slanted.separation - without.separation, 1e-9);
        /* At least what positions alone do, edge-on, as the page has them: once more for the nearer plane. */
        if (i != DP_COMPOSITION_RELATIVE)
            assert_true(part >= 3 * sqrt(3) * 0x1p-10);
        json_decref(root);
    }
}

/* The cost of the subpixel grid at the worst slant, per depth, as published for these views; 28.8 mm at 5 km. */
TEST(published) {
    static const struct {
        const char *view;
        double per_depth;
    } published[] = {
        {"--viewport 1920x1080 --hfov 90", 5.75e-6},     {"--viewport 1920x1080 --hfov 90 --subpixel 4", 9.2e-5},
        {"--viewport 1920x1080 --hfov 60", 3.32e-6},     {"--viewport 1920x1080 --hfov 60 --subpixel 4", 5.3e-5},
        {"--viewport 3840x2160 --hfov 90", 5.75e-6 / 2}, {"--viewport 3840x2160 --hfov 60 --subpixel 4", 5.3e-5 / 2}};
    for (size_t i = 0; i < sizeof published / sizeof published[0]; i++) {
        json_t *root = json_printed(0, "budget -n 0.1 -f inf -F fp32 -m reversed --slant 89.999:90 --at 5000 %s",
                                    published[i].view);
        const double got = at(row_of(root, 0), "causes.snapping");
        assert_relative(got / 5000, published[i].per_depth, 0.004);
        assert_true(i > 0 || fabs(got - 0.0288) < 0.0001);
        json_decref(root);
    }
}

/* The last column of a table in text is that at any slant, rounded up. */
TEST(text) {
    static const char *const said[] = {"viewport 1920x1080, fov 40, 8 subpixel bits, slant 0 to 90 degrees, ieee\n",
                                       "triangles from z/2 to 2 z, at most 512 pixels, aspect ratio at most 16:1\n",
                                       "\nFacing the camera, as a wall straight ahead does:"};
    const slant_case *c = &cases[0];
    printed p = print_of("table %s --at 700", c->line);
    const char *head = strstr(p.out, " guaranteed    slanted\n");
    assert_non_null(head);
    const char *line = strchr(head, '\n') + 1, *end = strchr(line, '\n');
    while (end[-1] != ' ')
        end--;
    const double got = strtod(end, NULL), want = separation_of(c, 700, true);
    assert_true(got >= want && got <= want * (1 + 1e-4));
    for (size_t i = 0; i < sizeof said / sizeof said[0]; i++)
        assert_non_null(strstr(p.out, said[i]));
    printed_free(&p);
}

static int times(const char *text, const char *word) {
    int n = 0;
    for (const char *at = text; (at = strstr(at, word)) != NULL; at += strlen(word))
        n++;
    return n;
}

/* Surfaces are called by the slants that were asked about, in every command and form; by any slant where it was all. */
TEST(which_slants) {
    static const struct {
        const char *slant, *words, *column;
    } slants[] = {{"0:90", "any slant", "any slant"},
                  {"87:87", "87 degrees", "that slant"},
                  {"0:0", "0 degrees", "that slant"},
                  {"10:80", "10 to 80 degrees", "that slant"},
                  {"0:45.5", "0 to 45.5 degrees", "that slant"},
                  {"30:90", "30 to 90 degrees", "that slant"}};
    static const struct {
        const char *line, *format; /* the words, or with # what stands above a column */
    } lines[] = {{"table -F d24 -m d3d", "to be resolved at %s:"},
                 {"table -F d24 -m d3d --range 1:100", " at %s "},
                 {"table -F d24,d16 -m d3d", "resolves 0.01 at %s up to"},
                 {"table -F d24,d16 -m d3d", "guaranteed at #, z"},
                 {"solve -F d24 -m d3d --for distance --separation 0.01", "at %s is guaranteed"},
                 {"solve -F d24 -m d3d --for near --at 100 --separation 0.01", "resolve 0.01 at %s"},
                 {"solve -F d24 -m d3d --for near --at 100 --separation 0.01", "ieee, at %s "},
                 {"solve --preset gltf-viewer --separation 1cm --at 40m", "a separation of 1 cm at %s is guaranteed"},
                 {"scene tests/models/house.gltf -F d24 -m d3d --within 60", "Decided in float, at %s; "},
                 {"plot scene tests/models/house.gltf -F d24 -m d3d --json", ", %s at 1920 x 1080"},
                 {"plot interval -F d24 -m d3d --csv", "unorm24 d3d, %s [scene units]"}};
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++)
        for (size_t k = 0; k < sizeof slants / sizeof slants[0]; k++) {
            char said[128];
            const char *hash = strchr(lines[i].format, '#');
            if (hash != NULL)
                snprintf(said, sizeof said, "%.*s%s%s", (int)(hash - lines[i].format), lines[i].format,
                         slants[k].column, hash + 1);
            else
                snprintf(said, sizeof said, lines[i].format, slants[k].words);
            printed p = print_of("%s --viewport 1920x1080 --slant %s", lines[i].line, slants[k].slant);
            printed_unfold(p.out);
            if (p.status > 1 || strstr(p.out, said) == NULL || (k > 0 && strstr(p.out, "any slant") != NULL))
                fail_msg("%s --slant %s: no \"%s\", or any slant:\n%s%s", lines[i].line, slants[k].slant, said, p.out,
                         p.errors);
            printed_free(&p);
        }
}

/* The same of a requirement, which says it of what needs it: not of an error, nor without a viewport. */
TEST(which_slants_are_checked) {
    static const char *const slants[][2] = {
        {"", "any slant"}, {"slant = [10, 80];", "10 to 80 degrees"}, {"slant = [30, 30];", "30 degrees"}};
    for (size_t k = 0; k < sizeof slants / sizeof slants[0]; k++) {
        const char *need = scratch_text("slants.need",
                                        "cameras = { a = { near = 0.1; far = 1000; mapping = \"d3d\"; format = "
                                        "\"d24\"; viewport = [1920, 1080]; fov = 60; subpixel = 8; %s };"
                                        "  b = { near = 0.1; far = 1000; mapping = \"d3d\"; format = \"d24\"; }; };"
                                        "requirements = { s = { camera = \"a\"; at = 10; separation = 1; };"
                                        "  e = { camera = \"a\"; at = 10; error = 1; };"
                                        "  f = { camera = \"b\"; at = 10; separation = 1; }; };",
                                        slants[k][0]);
        printed p = print_of("check %s --full", need);
        printed_unfold(p.out);
        assert_int_equal(times(p.out, slants[k][1]), 1);
        assert_true(times(p.out, "any slant") == (k == 0));
        printed_free(&p);
        json_t *root = json_printed(0, "check %s", need);
        for (int i = 0; i < 3; i++)
            assert_string_equal(text_at(node_at(root, "requirements[%d]", i), "surfaces"),
                                i == 0 ? slants[k][1] : "facing");
        json_decref(root);
        root = json_printed(0, "plot needs %s", need);
        assert_non_null(strstr(text_at(root, "panels[0].title"), slants[k][1]));
        json_decref(root);
    }
    /* A bias is judged at any slant, whichever are asked about, through both doors. */
    const char *need =
        scratch_text("bias.need", "cameras = { a = { near = 0.1; far = 1000; mapping = \"d3d\"; format = \"d24\"; "
                                  "viewport = [1920, 1080]; fov = 60; subpixel = 8; slant = [10, 80]; }; };"
                                  "requirements = { b = { camera = \"a\"; range = [1, 9]; bias = { api = "
                                  "\"d3d11\"; units = -200; factor = -0.1; }; }; };");
    json_t *root = json_printed(0, "check %s", need);
    assert_string_equal(text_at(root, "requirements[0].surfaces"), "any slant");
    json_decref(root);
    check_says(0, "enough from 1 to 9, any slant;", "check %s --full", need);
    static const char line[] = "bias -F d24 -m d3d --range 1:9 --separation 0.01 --viewport 1920x1080 --slant";
    json_t *some = json_printed(0, "%s 10:80", line), *any = json_printed(0, "%s 0:90", line);
    assert_true(number_at(some, "setups[0].range.units_gap") == number_at(any, "setups[0].range.units_gap") &&
                number_at(some, "setups[0].range.units_apart") == number_at(any, "setups[0].range.units_apart"));
    json_decref(some);
    json_decref(any);
    check_says(
        0, "Enough facing the camera and at any slant",
        "bias -F d24 -m d3d --api d3d11 --units=-200 --factor=-0.1 --range 1:9 --viewport 1920x1080 --slant 10:80");
}

/* Who draws, on which grid, and how depth is set up. */
TEST(rasterizer) {
    static const struct {
        const char *options, *line;
    } said[] = {{"--raster llvmpipe", "llvmpipe: depth from unsnapped vertices, anchor origin, arithmetic mesa\n"},
                {"--raster swiftshader", "swiftshader: 4 subpixel bits, anchor vertex, arithmetic mesa\n"},
                {"--raster spec-d3d", "spec-d3d: 8 subpixel bits, any anchor: the worst is counted, arithmetic ieee\n"},
                {"--raster spec-gl --subpixel 5",
                 "spec-gl: at least 5 subpixel bits, any anchor: the worst is counted, arithmetic\n"}};
    for (size_t i = 0; i < sizeof said / sizeof said[0]; i++) {
        const char *line = "budget -F fp32 -m reversed --viewport 640x480 --at 10";
        check_says(0, "viewport 640x480, fov 60, slant 0 to 90 degrees\n", "%s %s", line, said[i].options);
        check_says(0, said[i].line, "%s %s", line, said[i].options);
    }
}

/* A preset's view and rasterizer hold with a viewport, and where they are not given. */
TEST(presets) {
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
        json_t *root = json_printed(0, "table --viewport 1920x1080 --at 10 %s", asked[i].options);
        assert_true(at(root, "triangles.fov") == asked[i].fov && at(root, "triangles.subpixel") == asked[i].bits);
        check_raster(root, asked[i].raster);
        json_decref(root);
    }
    check_says(0, "!triangles", "table --preset godot-forward --at 10 --json");
    /* Each of several cameras has its own. */
    const slant_case bevy = {.line = "-n 0.1 -f inf -F fp32 -m reversed",
                             .triangles = {800, 800, 45, 4, {5, 11, 2, 5}, 0, 90, 2, 512, 16}};
    json_t *root = json_printed(0, "table --preset bevy,three --viewport 800x800 --at 10m");
    assert_null(node_at(root, "triangles"));
    assert_true(at(root, "setups[0].triangles.fov") == 45 && at(root, "setups[1].triangles.fov") == 50);
    check_raster(node_at(root, "setups[0]"), "spec-vulkan");
    check_raster(node_at(root, "setups[1]"), "spec-gl");
    assert_true(at(row_of(root, 0), "guarantee_slanted") == separation_of(&bevy, 10, true));
    json_decref(root);
}

/* An angle upwards in a picture of such a shape, degrees, of the one across. */
static double upwards(double across, double width, double height) {
    const double degree = acos(-1.0) / 180;
    return 2 * atan(tan(across / 2 * degree) * height / width) / degree;
}

/* So does the angle of what has no slanted triangles: of images, constants, code and pictures. */
TEST(preset_angles) {
    static const struct {
        const char *options;
        double across, up; /* 0: not said */
    } asked[] = {{"--preset three", 0, 50},
                 {"--preset three --fov 30", 0, 30},
                 {"--preset three --hfov 100", 100, 0},
                 {"--preset unreal", 90, 0},
                 {"--preset unreal --fov 30", 0, 30},
                 {"--fov 30", 0, 30},
                 {"", 0, 60}};
    for (size_t i = 0; i < sizeof asked / sizeof asked[0]; i++) {
        const double up = asked[i].up > 0 ? asked[i].up : upwards(asked[i].across, 640, 400);
        json_t *image = json_printed(0, "texture --synthetic plane --size 640x400 -F fp32 -m gl %s", asked[i].options);
        json_t *table = json_printed(0, "table --constants --viewport 640x400 -m gl %s", asked[i].options);
        assert_relative(at(image, "fov"), up, 1e-12);
        assert_relative(at(table, "setups[0].fov"), up, 1e-12);
        json_decref(image);
        json_decref(table);
    }
    check_says(0, "field of view 50°", "plot fight --json --preset three");
    json_t *several = json_printed(0, "table --constants --viewport 640x400 --preset three,unreal");
    assert_relative(at(several, "setups[0].fov"), 50, 1e-12);
    assert_relative(at(several, "setups[1].fov"), upwards(90, 640, 400), 1e-12);
    json_decref(several);
}

/* The bias of one plane drawn twice: the least factor, or the one given, and the units with it. */
static void check_bias(const slant_case *c, const char *options, double slope, double given) {
    static const char *const apis[] = {"d3d11", "vulkan-unorm"};
    const dp_setup slanted = setup_of(c, true, DP_MODEL_EXACT);
    const double z = c->z[2], sign = slanted.spec.mapping == DP_MAPPING_REVERSED ? 1 : -1;
    for (size_t a = 0; a < 2; a++) {
        char line[512], one[576];
        snprintf(line, sizeof line, "bias %s %s --at %.17g", c->line, options, z);
        snprintf(one, sizeof one, "%s --api %s", line, apis[a]);
        json_t *root = json_printed(0, "%s", one), *every = json_printed(0, "%s --api all", line);
        char *csv = output_of(0, one, "--csv");
        const json_t *row = row_of(root, 0);
        bias_goal goal = {.slope = slope};
        size_t i = 0;
        while (strcmp(bias_api_get(i)->name, apis[a]) != 0)
            i++;
        goal.api = bias_api_get(i);
        goal.factor = isnan(given) ? bias_factor_least(&slanted) : given;
        const double units = sign * bias_needed(&slanted, &goal, z), factor = sign * goal.factor;
        check_triangles(root, &c->triangles, c->raster);
        check_triangles(every, &c->triangles, c->raster);
        assert_true(isnan(given) ? isinf(at(root, "factor")) : at(root, "factor") == sign * given);
        assert_true(at(root, "setups[0].factor") == factor && at(row, "units_apart") == units);
        assert_true(at(row, "guarantee_facing") == separation_of(c, z, false));
        assert_true(flag_at(row, "certain") == (z + separation_of(c, z, false) <= number_behind(c->line, "-f", 1000)));
        assert_true(at(row, "guarantee_slanted") == separation_of(c, z, true));
        assert_true(csv_at(csv, "units_apart", 0) == units && csv_at(csv, "factor", 0) == factor);
        assert_true(csv_at(csv, "guarantee_slanted [scene]", 0) == separation_of(c, z, true));
        assert_true(at(row_of(every, i), "units") == units && at(row_of(every, i), "factor") == factor);
        json_decref(root);
        json_decref(every);
        free(csv);
    }
}

TEST(bias) {
    const char *line = cases[0].line;
    check_bias(&cases[0], "", 0, NAN);
    check_bias(&cases[0], "--slope 0.5", 0.5, 0);
    check_bias(&cases[1], "", 0, NAN);
    check_bias(&cases[1], "--factor -0.5", 0, 0.5);
    check_bias(&cases[3], "--slope 0.01 --factor 0.25", 0.01, 0.25);
    /* Slopes for which no units are enough. */
    check_says(0, "no bias suffices at z = 3", "bias %s --factor 0.001 --at 3", line);
    check_says(0, "no units suffice with a factor below 0.0", "bias %s --factor 0.001 --at 3", line);
    check_says(0, "gl, factor 0.0", "bias %s --at 3 --api gl", line);
    check_says(0, "viewport 1920x1080, fov 40, 8 subpixel bits, slant 0 to 90 degrees, ieee\n",
               "bias %s --at 3 --api gl", line);
}

/* The figure has both: each point is that of a pixel column, and no less than what is guaranteed there. */
TEST(plot) {
    const slant_case *c = &cases[0];
    json_t *root = json_printed(0, "plot interval --model float %s --range 1:1e4", c->line), *series, *point;
    size_t s, i, points[2] = {0};
    json_array_foreach(node_at(root, "panels[0].series"), s, series) {
        const char *name = text_at(series, "name");
        const bool slanted = strcmp(name, "fp32 reversed, any slant") == 0;
        if (!slanted && strcmp(name, "fp32 reversed") != 0)
            continue;
        json_array_foreach(node_at(series, "points"), i, point) {
            const double z = at(point, "z"), got = at(point, "interval");
            assert_true(got >= separation_of(c, z, slanted) * 0.98);
            assert_true(got <= separation_of(c, fmin(z * 1.05, 1e4), slanted) * (slanted ? 1.02 : 2.05));
            points[slanted]++;
        }
    }
    assert_true(points[0] > 5 && points[1] >= 2);
    assert_non_null(strstr(text_at(root, "subtitle"), ", 1920x1080, fov 40, 8 subpixel bits, slant 0 to 90"));
    json_decref(root);
}

/* A census stays what it is; beside each band stands what holds at any slant all over it. */
TEST(zfight) {
    static const char *const same[] = {"pairs", "ties", "swaps", "longest", "longest_z", "bound", "used"};
    const slant_case *c = &cases[0];
    const dp_setup slanted = setup_of(c, true, DP_MODEL_FLOAT);
    char line[256];
    snprintf(line, sizeof line, "zfight %s --range 5.5:9", c->line);
    json_t *root = json_printed(0, "%s", line);
    json_t *without = json_printed(0, "zfight -n 0.25 -f inf -F fp32 -m reversed --range 5.5:9");
    char *csv = output_of(0, line, "--csv");
    check_triangles(root, &c->triangles, NULL);
    assert_int_equal(json_array_size(node_at(root, "setups[0].bands")), 2);
    for (size_t b = 0; b < 3; b++) { /* the last: all of them */
        const char *place = (const char *const[]){"setups[0].bands[0]", "setups[0].bands[1]", "setups[0]"}[b];
        const json_t *got = node_at(root, "%s", place), *other = node_at(without, "%s", place);
        dp_separation_worst worst;
        assert_int_equal(dp_separation_over(&slanted, b == 1 ? 8 : 5.5, b == 0 ? 8 : 9, 0, &worst), DP_OK);
        assert_true(at(got, "guarantee_slanted") == worst.bound);
        assert_true(at(got, "guarantee_facing") == at(got, "bound"));
        assert_true(b == 2 || csv_at(csv, "guarantee_slanted [scene]", (int)b) == worst.bound);
        for (size_t i = 0; i < sizeof same / sizeof same[0]; i++)
            assert_true(at(got, same[i]) == at(other, same[i]));
    }
    json_decref(root);
    json_decref(without);
    free(csv);
}

/* Over a range, of both. */
TEST(range) {
    json_t *root = json_printed(0, "table %s --at 700 --range 3:5e4", cases[0].line);
    for (int slanted = 0; slanted < 2; slanted++) {
        const json_t *got = node_at(root, "setups[0].worst_separation%s", slanted ? "_slanted" : "");
        const dp_setup full = setup_of(&cases[0], slanted, DP_MODEL_FLOAT);
        dp_separation_worst worst;
        assert_int_equal(dp_separation_over(&full, 3, 5e4, 0, &worst), DP_OK);
        assert_true(at(got, "bound") == worst.bound && at(got, "separation") == worst.separation);
        assert_true(at(got, "z") == worst.z && at(got, "lo") == 3 && at(got, "hi") == 5e4);
    }
    json_decref(root);
}

/* Where nothing is certain, it is what lies in front of the farther surface that is not. */
TEST(hopeless) {
    const slant_case *c = &cases[2];
    assert_true(isfinite(separation_of(c, 30, true)) && isinf(separation_of(c, 1e4, true)));
    check_says(0, "at z = 10000 no separation is guaranteed: everything nearer may share its code\n",
               "budget %s --at 30,1e4,1e5", c->line);
}
