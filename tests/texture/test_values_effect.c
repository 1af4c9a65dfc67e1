/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every value in the table of an effect, texture --product effect:NAME without an image. */
#include "named.h"
#include "printed.h"
#include "shader/effect.h"

enum { DEPTHS = 5 };

static const double AHEAD[DEPTHS] = {0.4, 30, 2, 500, 7}, AROUND[DEPTHS] = {-9, -0.5, 0, 3, 40};

#define PERSPECTIVE "-n 0.3 -f 900"
#define BEHIND      "--ortho -n -10 -f 50"

/* clang-format off */
static const struct {
    const char *effect, *camera;
    const double *z;
    const char *view; /* options of the cameras, which are those below; null: the effect needs none */
    uint32_t column, row;
    camera_spec now, last; /* of no width: as now */
} effects[] = {
    {.effect = "intersection", .z = AHEAD, .camera = PERSPECTIVE " -F unorm16,fp32 -m d3d,reversed --unit cm"},
    {.effect = "depth-of-field", .z = AHEAD, .camera = PERSPECTIVE " -m d3d -F unorm16"},
    {.effect = "fog", .z = AHEAD, .camera = PERSPECTIVE " -m d3d -F unorm24,fp16"},
    {.effect = "scan-line", .z = AHEAD, .camera = PERSPECTIVE " -m gl -F unorm16"},
    {.effect = "edge", .z = AHEAD, .camera = PERSPECTIVE " -m d3d -F unorm16"},
    {.effect = "height-fog", .z = AHEAD, .camera = PERSPECTIVE " -m d3d -F unorm16",
     .view = "--fov 40 --eye 7,9,-2 --look 38.337342473601,4.1981760147099,84.098640831935", .column = 320, .row = 359,
     .now = {640, 360, 40, 5, 20, -3, {7, 9, -2}, NULL, false}},
    {.effect = "water-line", .z = AHEAD, .camera = "--ortho=3 " PERSPECTIVE " -m reversed -F unorm16",
     .view = "--look 0,857.027955712,6098.07076731 --size 90x60 --pixel 70,12", .column = 70, .row = 12,
     .now = {90, 60, 60, 3, 0, 8, {0, 0, 0}, NULL, false}},
    {.effect = "ambient-occlusion", .z = AHEAD, .camera = PERSPECTIVE " -m linear -F unorm16"},
    {.effect = "shadow", .z = AHEAD, .camera = PERSPECTIVE " -m d3d -F unorm16,fp32"},
    {.effect = "outline", .z = AHEAD, .camera = PERSPECTIVE " -m reversed -F unorm16"},
    {.effect = "contact-shadow", .z = AHEAD, .camera = PERSPECTIVE " -m reversed -F unorm16"},
    {.effect = "soft-particles", .z = AHEAD, .camera = PERSPECTIVE " -m d3d -F unorm16"},
    {.effect = "water-depth", .z = AHEAD, .camera = PERSPECTIVE " -m d3d -F unorm16",
     /* 2 atan(9/16) */
     .view = "--hfov 90 --pixel 0,0", .now = {640, 360, 58.71550708558254, 5, 0, 0, {0, 0, 0}, NULL, false}},
    {.effect = "radial-fog", .z = AHEAD, .camera = PERSPECTIVE " -m d3d -F unorm16",
     .view = "--hfov 90 --pixel 0,0", .now = {640, 360, 58.71550708558254, 5, 0, 0, {0, 0, 0}, NULL, false}},
    {.effect = "decal", .z = AHEAD, .camera = PERSPECTIVE " -m d3d -F unorm16",
     .view = "--look 1,0,1.7320508075688772", .column = 320, .row = 359,
     .now = {640, 360, 60, 5, 30.000000000000004, 0, {0, 0, 0}, NULL, false}},
    {.effect = "motion-blur", .z = AHEAD, .camera = PERSPECTIVE " -m d3d -F unorm16",
     .view = "--look 677.141068812,0,3840.25783287 --last-eye 0.1,0.05,0 "
             "--last-look 5529.568023671,617.0318354725,34911.6871098", .column = 320, .row = 359,
     .now = {640, 360, 60, 5, 10, 0, {0, 0, 0}, NULL, false},
     .last = {640, 360, 60, 5, 9, 1, {0.1, 0.05, 0}, NULL, false}},
    {.effect = "intersection", .z = AROUND, .camera = BEHIND " -m d3d -F unorm16,fp32"},
    {.effect = "height-fog", .z = AROUND, .camera = BEHIND " -m reversed -F unorm16",
     .view = "--look 0,-16833.119889,46248.616794", .column = 320, .row = 359,
     .now = {640, 360, 60, 5, 0, -20, {0, 0, 0}, NULL, false}},
};
/* clang-format on */

/* The axis of a camera at the origin where the effect needs none. */
static void want_effect_rows(values *v, size_t effect, const double *parameters, const dp_setup *setup, size_t i) {
    const effect_row *row = effect_find(effects[effect].effect);
    const double *z = effects[effect].z;
    double decides = NAN, at = NAN, least = NAN, least_at = NAN;
    texture_camera now, last;
    effect_view view = {.setup = setup};
    if (effects[effect].view != NULL) {
        assert_null(camera_init(&now, setup, &effects[effect].now));
        const bool moved = effects[effect].last.width > 0;
        assert_null(camera_init(&last, setup, moved ? &effects[effect].last : &effects[effect].now));
        view = effect_view_of(&now, &last, effects[effect].column, effects[effect].row);
    }
    values_under(v, "setups[%zu].", i);
    want_setup(v, setup);
    for (int k = 0; k < DEPTHS; k++) {
        const uint32_t code = dp_code(setup, z[k]);
        const double usable = effect_usable(row, &view, parameters, z[k], 1);
        values_under(v, "setups[%zu].rows[%d].", i, k);
        want(v, "z=%f code=%u z_stored=%f", z[k], code, dp_stored(setup, code));
        want(v, "interval=%f levels=%f", dp_cell_of(setup, code).width, effect_error(row, &view, parameters, z[k]));
        if (row->alone)
            want_number(v, "share", effect_share(row, &view, parameters, z[k]));
        want_number(v, "usable", usable);
        if (row->ceiling > 0) {
            const double radius = effect_ceiling(row, &view, parameters, z[k]);
            want_number(v, "usable_radius", radius);
            least_at = k == 0 || radius < least ? z[k] : least_at;
            least = k == 0 ? radius : fmin(least, radius);
        }
        const bool first = isnan(usable) ? !isnan(decides) : row->smallest ? usable > decides : usable < decides;
        if (k == 0 || (first && !isnan(decides))) {
            decides = usable;
            at = z[k];
        }
    }
    values_under(v, "setups[%zu].all.", i);
    want(v, "usable=%f z=%f", decides, at);
    if (row->ceiling > 0)
        want(v, "usable_radius=%f radius_z=%f", least, least_at);
}

static void check_text(values *v, const char *line, const effect_row *row) {
    const texture_parameter *wanted_one = &row->parameters[row->wanted];
    const char *direction = row->smallest ? "from" : "up to";
    const double usable = value_at(v, "setups[0].all.usable")->number;
    char label[128], said[sizeof label + 3];
    char *text = output_of(0, line, "--full");
    check_table(v, text, "setups[].rows[]",
                row->alone         ? "z:9, code:10, z_stored:9, interval:6, levels:6, share:6, usable:6"
                : row->ceiling > 0 ? "z:9, code:10, z_stored:9, interval:6, levels:6, usable:6, usable_radius:6"
                                   : "z:9, code:10, z_stored:9, interval:6, levels:6, usable:6");
    values_under(v, "setups[0].all.");
    snprintf(label, sizeof label, isnan(usable) ? "no %s is usable" : "%s %s ", wanted_one->name, direction);
    if (isnan(usable))
        check_line(v, text, label, "z:6");
    else { /* usable as it is printed; at the end of the range no depth decides */
        const bool all = usable == (row->smallest ? wanted_one->lo : wanted_one->hi);
        check_line(v, text, label, all ? "usable:6" : "usable:6, z:6");
        snprintf(said, sizeof said, "\n  %s", label);
        const char *at = strstr(text, said) + 3, *word = strstr(at, " decides");
        const double shown = strtod(at + strlen(label), NULL);
        assert_true(all == (word == NULL || word > at + strcspn(at, "\n")));
        assert_true(row->smallest ? shown >= usable : shown <= usable);
    }
    if (row->ceiling > 0) {
        want(v, "~bias=%f", value_at(v, "parameters[0].value")->number);
        check_line(v, text, "with bias ", "bias:6, usable_radius:6, radius_z:6");
        assert_true(strtod(strstr(text, " a radius up to ") + 16, NULL) <=
                    value_at(v, "setups[0].all.usable_radius")->number);
    }
    free(text);
}

TEST(each_number) {
    for (size_t i = 0; i < sizeof effects / sizeof effects[0]; i++) {
        const effect_row *row = effect_find(effects[i].effect);
        const texture_parameter *asked = &row->parameters[row->wanted];
        const double *z = effects[i].z;
        double parameters[PARAMETERS_MAX];
        char line[1024], columns[512];
        dp_setup setups[SETUPS_MAX];
        parameter_defaults(row->parameters, parameters);
        size_t used = (size_t)snprintf(
            line, sizeof line, "texture --product effect:%s %s %s --at %.17g,%.17g,%.17g,%.17g,%.17g", row->name,
            effects[i].view != NULL ? effects[i].view : "", effects[i].camera, z[0], z[1], z[2], z[3], z[4]);
        values v = values_of(line);
        for (int k = 0, used_ones = 0; row->parameters[k].name != NULL; k++) {
            const texture_parameter *q = &row->parameters[k];
            if (q->use == PARAMETER_IMAGE)
                continue;
            parameters[k] = fmin(q->hi, q->value * 1.25 + (q->value == 0 ? 0.5 : 0)); /* not the default */
            used += (size_t)snprintf(line + used, sizeof line - used, " --parameter %s=%.17g", q->name, parameters[k]);
            values_under(&v, "parameters[%d].", used_ones++);
            want(&v, "name=%s unit=%s value=%f", q->name, q->unit, parameters[k]);
        }
        values_under(&v, "%s", "");
        want(&v, "effect=%s wanted=%s direction=%s", row->name, asked->name, row->smallest ? "from" : "up to");
        const size_t n = setups_of(line, DP_MODEL_EXACT, setups);
        for (size_t k = 0; k < n; k++)
            want_effect_rows(&v, i, parameters, &setups[k], k);
        snprintf(columns, sizeof columns,
                 SETUP_CSV "effect = /effect, z [scene], code, z_stored [scene], interval [scene], levels [1/255], "
                           "?share, %s %s [%s] = usable, ?usable_radius [scene]",
                 asked->name, row->smallest ? "from" : "up to", asked->unit);
        check_forms(&v, 0, line, "setups[].rows[]", columns);
        check_text(&v, line, row);
        values_free(&v);
    }
}

/* ---- Beside --pixel ---------------------------------------------------------------------------------------------- */

/* A plane that leans back by 40 degrees, 30 away: its depth in a pixel of an image of 64 x 36, seen through 50 degrees.
 */
static double plane_at(uint32_t row) {
    const double degree = 3.14159265358979323846 / 180, up = (1 - 2 * (row + 0.5) / 36) * tan(25 * degree);
    return 30 / (1 - up * tan(40 * degree));
}

/* In binary32 and exactly, for what is stored and for the truth. The formulas: at a reference of 29, by height from 9
 * down, against threshold and neighbours; the camera looks along z from a height of 2. */
static double by_hand(const char *effect, double z, uint32_t row) {
    const double degree = 3.14159265358979323846 / 180, up = (1 - 2 * (row + 0.5) / 36) * tan(25 * degree);
    if (strcmp(effect, "intersection") == 0)
        return fmin(fabs(29 - z) / 4, 1);
    if (strcmp(effect, "height-fog") == 0)
        return fmin(fmax((2 + up * z - 9) / (-50 - 9) * 0.5, 0), 1);
    return fmin(z / 900 * 3, 1);
}

TEST(pixels) {
    static const struct {
        const char *name, *parameters;
    } shown[] = {{"intersection", "--parameter half-width=4 --parameter reference=29"},
                 {"height-fog", "--parameter density=0.5 --parameter start=9 --parameter end=-50 --eye 5,2,-3"},
                 {"fog", "--parameter density=3"}};
    static const uint32_t rows[] = {3, 17, 30};
    const dp_setup setup = SETUP("unorm16", .mapping = DP_MAPPING_D3D, .znear = 0.3, .zfar = 900);
    int inside = 0, edges = 0;
    for (size_t i = 0; i < sizeof shown / sizeof shown[0]; i++) {
        const char *name = shown[i].name;
        json_t *root =
            json_printed(0,
                         "texture --synthetic plane --parameter distance=30 --parameter tilt=40 --size 64x36 --fov 50 "
                         "-n 0.3 -f 900 -F unorm16 -m d3d --product effect:%s %s --pixel '20,3;20,17;20,30'",
                         name, shown[i].parameters);
        assert_string_equal(text_at(root, "effect"), name);
        assert_int_equal(json_array_size(node_at(root, "pixels")), 3);
        for (size_t k = 0; k < 3; k++) {
            const double z = plane_at(rows[k]), stored = dp_stored(&setup, dp_code(&setup, z));
            const double output = number_at(root, "pixels[%zu].output", k), exact = by_hand(name, stored, rows[k]);
            assert_scene(number_at(root, "pixels[%zu].exact", k), exact, 1e-11);
            assert_scene(output, exact, 1e-3);
            assert_scene(number_at(root, "pixels[%zu].levels", k), 255 * fabs(output - by_hand(name, z, rows[k])),
                         1e-5);
            assert_true(output == (double)(float)output);
            inside += output > 0 && output < 1;
        }
        json_decref(root);
    }
    assert_true(inside >= 6);
    /* A silhouette: the corners of this pixel lie on either side of it. */
    json_t *root = json_printed(0, "texture --synthetic sphere --size 64x36 -F unorm16 -m d3d --product effect:edge "
                                   "--pixel '36,18;41,18;60,3'");
    for (size_t k = 0; k < json_array_size(node_at(root, "pixels")); k++) {
        const double output = number_at(root, "pixels[%zu].output", k);
        assert_true(output == number_at(root, "pixels[%zu].exact", k));
        edges += output == 1;
    }
    assert_int_equal(edges, 1);
    json_decref(root);
}

LIST_TEST(check_apart)

/* A wall is an edge where its slope is more than threshold x far; one code of unorm16 at 1000 is more than that. */
TEST(slope_of_a_wall) {
    static const char line[] = "texture --product effect:edge -m d3d -n 0.1";
    check_says(0, "from a slope of 0.1 on;", "%s -F d24 -f 100", line);
    check_says(0, "a slope of 0.1 lies between", "%s -F d24 -f 100", line);
    check_says(0, "!lies between", "%s -F d24 -f 100 --parameter slope=0.2", line);
    check_says(0, "!lies between", "%s -F d24 -f 100 --parameter slope=0.05", line);
    check_says(0, "from a slope of 2.5 on;", "%s -F d24 -f 1000 --parameter threshold=0.0025", line);
    check_says(0, "pixels from 0 on", "%s -F d16 -f 1000", line);
    check_says(0, "!a flat wall", "texture --product effect:outline -m d3d -n 0.1 -f 100 -F d24");
}
