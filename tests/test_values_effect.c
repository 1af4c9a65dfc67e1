/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every value in the table of an effect, texture --product effect:NAME without an image. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "named.h"
#include "printed.h"
#include "shader/effect.h"

enum { DEPTHS = 5 };

static const double AHEAD[DEPTHS] = {0.4, 30, 2, 500, 7}, AROUND[DEPTHS] = {-9, -0.5, 0, 3, 40};

#define PERSPECTIVE(mapping, ...)                                                                                      \
    { 0.3, 900, {__VA_ARGS__}, {mapping}, .ortho = 0 }
#define BEHIND(mapping, ...)                                                                                           \
    { -10, 50, {__VA_ARGS__}, {mapping}, .ortho = 1 }

/* clang-format off */
static const struct {
    const char *effect;
    camera_case camera;
    const double *z;
    const char *view; /* options of the cameras, which are those below; null: the effect needs none */
    uint32_t column, row;
    camera_spec now, last; /* of no width: as now */
} effects[] = {
    {.effect = "intersection", .z = AHEAD,
     .camera = {0.3, 900, {"unorm16", "fp32"}, {"d3d", "reversed"}, .unit = "cm"}},
    {.effect = "depth-of-field", .camera = PERSPECTIVE("d3d", "unorm16"), .z = AHEAD},
    {.effect = "fog", .camera = PERSPECTIVE("d3d", "unorm24", "fp16"), .z = AHEAD},
    {.effect = "scan-line", .camera = PERSPECTIVE("gl", "unorm16"), .z = AHEAD},
    {.effect = "edge", .camera = PERSPECTIVE("d3d", "unorm16"), .z = AHEAD},
    {.effect = "height-fog", .camera = PERSPECTIVE("d3d", "unorm16"), .z = AHEAD,
     .view = "--fov 40 --eye 7,9,-2 --look 38.337342473601,4.1981760147099,84.098640831935", .column = 320, .row = 359,
     .now = {640, 360, 40, 5, 20, -3, {7, 9, -2}, NULL}},
    {.effect = "water-line", .camera = {0.3, 900, {"unorm16"}, {"reversed"}, .ortho = 1, .half = 3}, .z = AHEAD,
     .view = "--look 0,857.027955712,6098.07076731 --size 90x60 --pixel 70,12", .column = 70, .row = 12,
     .now = {90, 60, 60, 3, 0, 8, {0, 0, 0}, NULL}},
    {.effect = "ambient-occlusion", .camera = PERSPECTIVE("linear", "unorm16"), .z = AHEAD},
    {.effect = "shadow", .camera = PERSPECTIVE("d3d", "unorm16", "fp32"), .z = AHEAD},
    {.effect = "outline", .camera = PERSPECTIVE("reversed", "unorm16"), .z = AHEAD},
    {.effect = "contact-shadow", .camera = PERSPECTIVE("reversed", "unorm16"), .z = AHEAD},
    {.effect = "soft-particles", .camera = PERSPECTIVE("d3d", "unorm16"), .z = AHEAD},
    {.effect = "water-depth", .camera = PERSPECTIVE("d3d", "unorm16"), .z = AHEAD,
     /* 2 atan(9/16) */
     .view = "--hfov 90 --pixel 0,0", .now = {640, 360, 58.71550708558254, 5, 0, 0, {0, 0, 0}, NULL}},
    {.effect = "decal", .camera = PERSPECTIVE("d3d", "unorm16"), .z = AHEAD,
     .view = "--look 1,0,1.7320508075688772", .column = 320, .row = 359,
     .now = {640, 360, 60, 5, 30.000000000000004, 0, {0, 0, 0}, NULL}},
    {.effect = "motion-blur", .camera = PERSPECTIVE("d3d", "unorm16"), .z = AHEAD,
     .view = "--look 677.141068812,0,3840.25783287 --last-eye 0.1,0.05,0 "
             "--last-look 5529.568023671,617.0318354725,34911.6871098", .column = 320, .row = 359,
     .now = {640, 360, 60, 5, 10, 0, {0, 0, 0}, NULL}, .last = {640, 360, 60, 5, 9, 1, {0.1, 0.05, 0}, NULL}},
    {.effect = "intersection", .camera = BEHIND("d3d", "unorm16", "fp32"), .z = AROUND},
    {.effect = "height-fog", .camera = BEHIND("reversed", "unorm16"), .z = AROUND,
     .view = "--look 0,-16833.119889,46248.616794", .column = 320, .row = 359,
     .now = {640, 360, 60, 5, 0, -20, {0, 0, 0}, NULL}},
};
/* clang-format on */

/* The axis of a camera at the origin where the effect needs none. */
static void want_effect_rows(values *v, size_t effect, const double *parameters, const dp_setup *setup, size_t i,
                             line_places *lines) {
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
        char inner[32];
        const uint32_t code = dp_code(setup, z[k]);
        const double usable = effect_usable(row, &view, parameters, z[k], 1);
        values_under(v, "setups[%zu].rows[%d].", i, k);
        want_number(v, "z", z[k]);
        want_count(v, "code", code);
        want_number(v, "z_stored", dp_stored(setup, code));
        want_number(v, "interval", dp_cell_of(setup, code).width);
        want_number(v, "levels", effect_error(row, &view, parameters, z[k]));
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
        snprintf(inner, sizeof inner, "rows[%d].", k);
        place_add(lines, inner, "setups[%zu].", i);
    }
    values_under(v, "setups[%zu].all.", i);
    want_number(v, "usable", decides);
    want_number(v, "z", at);
    if (row->ceiling > 0) {
        want_number(v, "usable_radius", least);
        want_number(v, "radius_z", least_at);
    }
}

static void check_effect(values *v, const char *arguments, const effect_row *row, const line_places *lines) {
    const texture_parameter *wanted_one = &row->parameters[row->wanted];
    const char *direction = row->smallest ? "from" : "up to";
    char head[128], label[128];
    const text_column plain[] = {{"z", 9},        {"code", 10},  {"z_stored", 9},
                                 {"interval", 6}, {"levels", 6}, {"usable", 6}};
    const text_column shared[] = {{"z", 9},      {"code", 10}, {"z_stored", 9}, {"interval", 6},
                                  {"levels", 6}, {"share", 6}, {"usable", 6}};
    const text_column ranged[] = {{"z", 9},      {"code", 10},  {"z_stored", 9},     {"interval", 6},
                                  {"levels", 6}, {"usable", 6}, {"usable_radius", 6}};
    const size_t shown = row->alone || row->ceiling > 0 ? 7 : 6;
    static const char *const decides[] = {"setups[0].all.usable", "setups[0].all.z", NULL};
    snprintf(head, sizeof head, "%s %s [%s]", wanted_one->name, direction, wanted_one->unit);
    const csv_column columns[] = {
        SETUP_COLUMNS,
        {"effect", "/effect"},
        {"z [scene]", "z"},
        {"code", "code"},
        {"z_stored [scene]", "z_stored"},
        {"interval [scene]", "interval"},
        {"levels [1/255]", "levels"},
        {row->alone ? "share" : head, row->alone ? "share" : "usable"},
        {row->ceiling > 0 ? "usable_radius [scene]" : head, row->ceiling > 0 ? "usable_radius" : "usable"}};
    const size_t count = sizeof columns / sizeof columns[0] - (!row->alone && row->ceiling == 0);
    check_json(v, 0, arguments);
    check_csv(v, 0, arguments, columns, count, lines);
    printed p = print_of("%s --full", arguments);
    check_text_table(v, p.out, row->alone ? shared : row->ceiling > 0 ? ranged : plain, shown, lines);
    const bool none = isnan(value_at(v, decides[0])->number);
    snprintf(label, sizeof label, none ? "no %s is usable" : "%s %s ", wanted_one->name, direction);
    if (none)
        check_text_numbers(v, p.out, label, 6, decides + 1);
    else { /* usable as it is printed; at the end of the range no depth decides */
        static const char *const alone[] = {"setups[0].all.usable", NULL};
        const double usable = value_at(v, alone[0])->number;
        const bool all = usable == (row->smallest ? wanted_one->lo : wanted_one->hi);
        check_text_numbers(v, p.out, label, 6, all ? alone : decides);
        char line[sizeof label + 3];
        snprintf(line, sizeof line, "\n  %s", label);
        const char *at = strstr(p.out, line) + 3, *word = strstr(at, " decides");
        const double said = strtod(at + strlen(label), NULL);
        assert_true(all == (word == NULL || word > at + strcspn(at, "\n")));
        assert_true(row->smallest ? said >= usable : said <= usable);
    }
    if (row->ceiling > 0) {
        static const char *const radius[] = {"parameters[0].value", "setups[0].all.usable_radius",
                                             "setups[0].all.radius_z", NULL};
        check_text_numbers(v, p.out, "with bias ", 6, radius);
        assert_true(strtod(strstr(p.out, " a radius up to ") + 16, NULL) <= value_at(v, radius[1])->number);
    }
    printed_free(&p);
}

static void test_effects(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof effects / sizeof effects[0]; i++) {
        const effect_row *row = effect_find(effects[i].effect);
        double parameters[PARAMETERS_MAX];
        char options[512], arguments[1024];
        dp_setup setups[CAMERA_SETUPS];
        line_places lines = {0};
        values v = values_of("texture");
        v.unit = effects[i].camera.unit;
        assert_non_null(row);
        parameter_defaults(row->parameters, parameters);
        size_t used = (size_t)snprintf(arguments, sizeof arguments, "texture --product effect:%s %s %s --at ",
                                       row->name, effects[i].view != NULL ? effects[i].view : "",
                                       camera_options(&effects[i].camera, options));
        for (int k = 0; k < DEPTHS; k++)
            used += (size_t)snprintf(arguments + used, sizeof arguments - used, "%s%.17g", k > 0 ? "," : "",
                                     effects[i].z[k]);
        for (int k = 0, used_ones = 0; row->parameters[k].name != NULL; k++) {
            const texture_parameter *q = &row->parameters[k];
            if (q->use == PARAMETER_IMAGE)
                continue;
            parameters[k] = fmin(q->hi, q->value * 1.25 + (q->value == 0 ? 0.5 : 0)); /* not the default */
            snprintf(arguments + strlen(arguments), sizeof arguments - strlen(arguments), " --parameter %s=%.17g",
                     q->name, parameters[k]);
            values_under(&v, "parameters[%d].", used_ones++);
            want_text(&v, "name", q->name);
            want_text(&v, "unit", q->unit);
            want_number(&v, "value", parameters[k]);
        }
        values_under(&v, "%s", "");
        want_text(&v, "effect", row->name);
        want_text(&v, "wanted", row->parameters[row->wanted].name);
        want_text(&v, "direction", row->smallest ? "from" : "up to");
        const size_t n = camera_setups(&effects[i].camera, setups);
        for (size_t k = 0; k < n; k++)
            want_effect_rows(&v, i, parameters, &setups[k], k, &lines);
        check_effect(&v, arguments, row, &lines);
        values_free(&v);
        places_free(&lines);
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

static void test_pixels(void **state) {
    static const struct {
        const char *name, *parameters;
    } shown[] = {{"intersection", "--parameter half-width=4 --parameter reference=29"},
                 {"height-fog", "--parameter density=0.5 --parameter start=9 --parameter end=-50 --eye 5,2,-3"},
                 {"fog", "--parameter density=3"}};
    static const uint32_t rows[] = {3, 17, 30};
    int inside = 0;
    dp_format formats[2];
    dp_spec spec = dp_spec_default();
    dp_setup setup;
    (void)state;
    assert_true(dp_format_parse("unorm16", formats) >= 1);
    spec.format = formats[0];
    spec.mapping = DP_MAPPING_D3D;
    spec.znear = 0.3;
    spec.zfar = 900;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    for (size_t i = 0; i < sizeof shown / sizeof shown[0]; i++) {
        const char *name = shown[i].name;
        printed p =
            print_of("texture --synthetic plane --parameter distance=30 --parameter tilt=40 --size 64x36 --fov 50 "
                     "-n 0.3 -f 900 -F unorm16 -m d3d --product effect:%s %s --pixel '20,3;20,17;20,30' --json",
                     name, shown[i].parameters);
        json_t *root = json_of(p.out), *pixels = json_object_get(root, "pixels");
        assert_string_equal(json_string_value(json_object_get(root, "effect")), name);
        assert_int_equal(json_array_size(pixels), 3);
        for (size_t k = 0; k < 3; k++) {
            const json_t *o = json_array_get(pixels, k);
            const double z = plane_at(rows[k]), stored = dp_stored(&setup, dp_code(&setup, z));
            const double output = json_number_value(json_object_get(o, "output"));
            const double exact = by_hand(name, stored, rows[k]);
            assert_scene(json_number_value(json_object_get(o, "exact")), exact, 1e-11);
            assert_scene(output, exact, 1e-3);
            assert_scene(json_number_value(json_object_get(o, "levels")),
                         255 * fabs(output - by_hand(name, z, rows[k])), 1e-5);
            assert_true(output == (double)(float)output);
            inside += output > 0 && output < 1;
        }
        json_decref(root);
        printed_free(&p);
    }
    assert_true(inside >= 6);
    /* A silhouette: the corners of this pixel lie on either side of it. */
    printed p = print_of(
        "texture --synthetic sphere --size 64x36 -F unorm16 -m d3d --product effect:edge --pixel '36,18;41,18;60,3' "
        "--json");
    json_t *root = json_of(p.out), *pixels = json_object_get(root, "pixels");
    int edges = 0;
    for (size_t k = 0; k < json_array_size(pixels); k++) {
        const json_t *o = json_array_get(pixels, k);
        const double output = json_number_value(json_object_get(o, "output"));
        assert_true(output == json_number_value(json_object_get(o, "exact")));
        edges += output == 1;
    }
    assert_int_equal(edges, 1);
    json_decref(root);
    printed_free(&p);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_effects), cmocka_unit_test(test_pixels),
                                       cmocka_unit_test(check_apart)};
    return run_tap(tests);
}
