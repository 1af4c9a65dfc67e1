/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Whole command lines: lengths with units, options that are given twice, and in what order words may stand. */
#include "bias/cmd_bias/request.h"
#include "cli/cmd_list/request.h"
#include "code/cmd_code/request.h"
#include "judge/cmd_judge/request.h"
#include "method/cmd_methods/request.h"
#include "parsed.h"
#include "plot/cmd_plot/request.h"
#include "probe/cmd_probe/request.h"
#include "quantity/cmd_budget/request.h"
#include "quantity/cmd_table/request.h"
#include "scene/cmd_scene/request.h"
#include "shadow/cmd_shadow/request.h"
#include "solve/cmd_solve/request.h"
#include "support.h"
#include "texture/cmd_texture/request.h"
#include "world/cmd_world/request.h"
#include "zfight/cmd_prepass/request.h"
#include "zfight/cmd_zfight/request.h"

#define AT(command, member) offsetof(command##_request, member)

static double number_at(const asked_line *o, size_t field) {
    double number;
    memcpy(&number, (const char *)o->request + field, sizeof number);
    return number;
}

/* ---- Units of length --------------------------------------------------------------------------------------------- */

enum { WORDS_MAX = 48 };

/* A whole command line, words parted by '|'; `line` as parsed() has it. */
static int parse_line(asked_line *o, const char *words, char line[1024]) {
    static char text[512];
    char *argv[WORDS_MAX + 1] = {(char[]){"depthprec"}};
    int argc = 1;
    snprintf(text, sizeof text, "%s", words);
    for (char *word = strtok(text, "|"); word != NULL && argc < WORDS_MAX; word = strtok(NULL, "|"))
        argv[argc++] = word;
    options_release(o);
    return parsed(o, argc, argv, line);
}

/* The camera of whatever command takes one. */
static const camera_asked *camera_on(const asked_line *o) {
    return option_group(o, option_find(o->command, "near"));
}

/* A field as a line makes it, converted by hand. */
static const struct {
    const char *words;
    size_t field;
    double expected;
    const char *unit; /* null: not known */
} converted[] = {
    {"table|-n|10cm", AT(table, camera.znear), 0.1, "m"},
    {"table|-n|0.25", AT(table, camera.znear), 0.25, NULL},
    {"table|-n|250 mm", AT(table, camera.znear), 0.25, "m"},
    {"table|-n|10cm|--unit|cm", AT(table, camera.znear), 10, "cm"},
    {"table|--unit|cm|-n|10cm", AT(table, camera.znear), 10, "cm"},
    {"table|--unit|mm|-n|0.25", AT(table, camera.znear), 0.25, "mm"},
    {"table|-n|1in", AT(table, camera.znear), 0.0254, "m"},
    {"table|-n|3ft|--unit|in", AT(table, camera.znear), 36, "in"},
    {"table|-n|5e3nm", AT(table, camera.znear), 5e-6, "m"},
    {"table|-n|7um|--unit|nm", AT(table, camera.znear), 7000, "nm"},
    {"table|-n|7\302\265m|--unit|nm", AT(table, camera.znear), 7000, "nm"},
    {"table|-n|0x1p3", AT(table, camera.znear), 8, NULL},
    {"table|-f|1km", AT(table, camera.zfar), 1000, "m"},
    {"table|-f|1km|--unit|ft", AT(table, camera.zfar), 1e12 / 304.8e6, "ft"},
    {"table|--at|5m|--preset|unreal", AT(table, camera.at.lo), 500, "cm"},
    {"table|--at|5km,10m", AT(table, camera.at.hi), 5000, "m"},
    {"table|--at|5km,10m", AT(table, camera.at.lo), 10, "m"},
    {"table|--at|1m:1km:log:5|--unit|cm", AT(table, camera.at.lo), 100, "cm"},
    {"table|--at|1m:1km:log:5|--unit|cm", AT(table, camera.at.hi), 1e5, "cm"},
    {"table|--range|1m:1km|--unit|mm", AT(table, camera.range_lo), 1e3, "mm"},
    {"table|--range|0:1km|--unit|mm", AT(table, camera.range_hi), 1e6, "mm"},
    {"table|--preset|unreal|--unit|m", AT(table, camera.znear), 0.1, "m"},
    {"table|--unit|m|--preset|unreal|-n|5", AT(table, camera.znear), 5, "m"},
    {"table|--preset|unity|--unit|cm", AT(table, camera.znear), 30, "cm"},
    {"table|--preset|unity|--unit|cm", AT(table, camera.zfar), 1e5, "cm"},
    {"table|--preset|unity", AT(table, camera.znear), 0.3, "m"},
    {"table|--preset|cesium|--unit|cm", AT(table, camera.log_c), 0.01, "cm"},
    {"table|--preset|cesium|--unit|cm|--log-c|2", AT(table, camera.log_c), 2, "cm"},
    {"table|--preset|maplibre-globe:zoom=4|--viewport|1280x800", AT(table, camera.znear), 2443.2512746625885, "m"},
    {"table|--preset|maplibre-globe:height=800,zoom=4|--unit|km", AT(table, camera.znear), 2.4432512746625885, "km"},
    {"table|--preset|maplibre-globe:height=800,zoom=4|-n|5", AT(table, camera.znear), 5, "m"},
    {"table|--preset|three|--at|50cm", AT(table, camera.at.lo), 0.5, "m"},
    {"table|--preset|three", AT(table, camera.znear), 0.1, NULL},
    {"table|--preset|mujoco:extent=2|--unit|cm", AT(table, camera.znear), 2, "cm"},
    {"table|--preset|mujoco:extent=2|--at|50cm", AT(table, camera.at.lo), 0.5, "m"},
    {"solve|--separation|1mm", AT(solve, separation), 0.001, "m"},
    {"solve|--error|2 cm|--preset|unreal", AT(solve, error), 2, "cm"},
    {"bias|--separation|3mm|--unit|cm", AT(bias, bias.separation), 0.3, "cm"},
    {"bias|--slope|5cm", AT(bias, bias.slope), 0.05, "m"},
    {"budget|--from-origin|2km", AT(budget, origin.terms.world), 2000, "m"},
    {"texture|x|--ortho=10ft", AT(texture, camera.spec.half_height), 3.048, "m"},
    {"texture|x|--metric|1mm", AT(texture, image.metric), 0.001, "m"},
    {"texture|x|--eye|-1m,0,20cm", AT(texture, image.eye[0]), -1, "m"},
    {"texture|x|--eye|-1m,0,20cm", AT(texture, image.eye[2]), 0.2, "m"},
    {"texture|x|--last-eye|0,0,30cm", AT(texture, image.last_eye[2]), 0.3, "m"},
};

TEST(test_units) {
    tally t = {.name = "units"};
    for (size_t i = 0; i < sizeof converted / sizeof converted[0]; i++) {
        char line[1024];
        asked_line o = {.request = NULL};
        const int status = parse_line(&o, converted[i].words, line);
        TALLY(&t, status == EXIT_FINE, "%s: %s", converted[i].words, line);
        TALLY(&t,
              fabs(number_at(&o, converted[i].field) - converted[i].expected) <= 4e-16 * fabs(converted[i].expected),
              "%s: %.17g", converted[i].words, number_at(&o, converted[i].field));
        TALLY(&t,
              converted[i].unit == NULL
                  ? o.lengths->unit == NULL
                  : o.lengths->unit != NULL && strcmp(o.lengths->unit->name, converted[i].unit) == 0,
              "%s: in %s", converted[i].words, o.lengths->unit != NULL ? o.lengths->unit->name : "nothing");
        options_release(&o);
    }
    tally_end(&t);
}

/* Lengths come back as they were typed; others in the unit of the scene. */
TEST(test_typed) {
    static const struct {
        const char *words;
        double value;            /* in the unit of the scene */
        const char *said, *unit; /* and the unit of what is measured against --separation */
    } typed[] = {
        {"bias|--separation|0.01mm", 1e-5, "0.01 mm", "mm"},
        {"bias|--separation|0.01mm", 1e-4, "0.0001 m", "mm"},
        {"bias|--separation|0.01mm|--unit|cm", 1e-3, "0.01 mm", "mm"},
        {"bias|--separation|1e-5|--unit|m", 1e-5, "1e-05 m", "m"},
        {"bias|--separation|1e-5", 1e-5, "1e-05", NULL},
        {"bias|-n|7 cm|--at|3m,2km", 2000, "2 km", "m"},
        {"bias|-n|7 cm|--at|3m,2km", 0.07, "7 cm", "m"},
        {"bias|--separation|2\302\265m|-f|1km", 1000, "1 km", "um"},
    };
    for (size_t i = 0; i < sizeof typed / sizeof typed[0]; i++) {
        char line[1024];
        asked_line o = {.request = NULL};
        assert_int_equal(parse_line(&o, typed[i].words, line), EXIT_FINE);
        assert_string_equal(lengths_text(o.lengths, typed[i].value, 0).text, typed[i].said);
        const unit_row *unit = option_unit(&o, "separation");
        assert_string_equal(unit != NULL ? unit->name : "", typed[i].unit != NULL ? typed[i].unit : "");
        options_release(&o);
    }
}

TEST(test_no_units) {
    static const char *const words[] = {"table|-n|5 kms",
                                        "table|-n|1m2",
                                        "table|-n|1,5m",
                                        "table|-n|5  m",
                                        "table|-n|5M",
                                        "table|-n|0x5cm",
                                        "table|-n|0X5cm",
                                        "table|-n|0x1m",
                                        "table|-n|0X1m",
                                        "table|-n|5 m ",
                                        "table|-n|5e1000km",
                                        "table|-f|1kmm",
                                        "table|--at|1,5m",
                                        "table|--at|5m,3kms",
                                        "table|--at|1:5m:lin:3",
                                        "table|--at|1y:5m:log:3",
                                        "table|--range|1:5m",
                                        "table|--range|1m:5kms",
                                        "table|--range|1c:5m",
                                        "table|--unit|M",
                                        "table|--unit|parsec",
                                        "solve|--separation|1mmm",
                                        "solve|--error|1e-320nm",
                                        "texture|x|--eye|1m,2m,3",
                                        "texture|x|--eye|1m,2m,3q",
                                        "bias|--slope|1m/s",
                                        "bias|--slope|1e-320nm", /* 0 is fine, but not what was typed */
                                        "texture|x|--eye|0m,1e-320nm,1m",
                                        "texture|x|--eye|0m,0m,-1e308km",
                                        "texture|x|--metric|1 millimetre"};
    tally t = {.name = "no units"};
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        char line[1024];
        asked_line o = {.request = NULL};
        const int status = parse_line(&o, words[i], line);
        TALLY(&t, status == EXIT_USAGE && strstr(line, "nm, um, mm, cm, m, km, in or ft") != NULL, "%s: %s", words[i],
              line);
        options_release(&o);
    }
    char line[1024];
    asked_line o = {.request = NULL};
    assert_int_equal(parse_line(&o, "table|-f|infm", line), EXIT_USAGE);
    assert_int_equal(parse_line(&o, "table|--preset|mujoco|--at|1m", line), EXIT_USAGE);
    assert_string_equal(line, "depthprec: --preset: needs extent: mujoco:extent=2");
    options_release(&o);
    tally_end(&t);
    options_release(&o);
}

/* Numbers that are none, or too large, are not told of units, in which nobody typed them. */
TEST(test_no_hint) {
    static const char *const words[] = {"table|-n|1e400", "table|-n|1E400", "table|-n|0x", "table|-n|0x1p9999",
                                        "table|-n|1,5",   "table|-n|--5",   "table|-n|5e", "table|-n|"};
    tally t = {.name = "no hint"};
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        char line[1024];
        asked_line o = {.request = NULL};
        TALLY(&t, parse_line(&o, words[i], line) == EXIT_USAGE && strstr(line, "mm, cm") == NULL, "%s: %s", words[i],
              line);
        options_release(&o);
    }
    tally_end(&t);
}

/* An option that may be given several times is taken as often as there is room for, and no more often. */
TEST(test_repeated) {
    static const struct {
        const char *line, *word;
        int most;
    } repeated[] = {{"methods|linearize", "|--mine|a.glsl:f", 8}, {"judge|a.glsl:f", "|--define|a=1", 16}};
    tally t = {.name = "repeated options"};
    for (size_t i = 0; i < sizeof repeated / sizeof repeated[0]; i++)
        for (int count = repeated[i].most; count <= repeated[i].most + 1; count++) {
            char words[512], line[1024];
            asked_line o = {.request = NULL};
            snprintf(words, sizeof words, "%s", repeated[i].line);
            for (int k = 0; k < count; k++)
                strcat(words, repeated[i].word);
            const bool fine = parse_line(&o, words, line) == EXIT_FINE;
            TALLY(&t, fine == (count == repeated[i].most) && (fine || strstr(line, "must not be more than") != NULL),
                  "%s, %d times: %s", words, count, line);
            options_release(&o);
        }
    tally_end(&t);
}

/* A browser's format takes the place of a preset's format, not of what is given; what an API brings takes neither's.
 */
TEST(test_platforms) {
    static const struct {
        const char *line, *formats, *mapping, *arith, *api, *raster;
    } rows[] = {
        {"table|--platform|safari", "fp32", "d3d", "ieee", NULL, NULL},
        {"table|--platform|firefox-vulkan", "unorm24 fp32", "d3d", "ieee", NULL, NULL},
        {"bias|--platform|chrome-metal", "fp32", "d3d", "ieee", "webgpu", NULL},
        {"bias|--platform|webgl-d3d", "unorm24", "gl", "ieee-remap", "gl", NULL},
        {"bias|--platform|webgl-d3d|--api|metal", "unorm24", "gl", "ieee-remap", "metal", NULL},
        /* an API brings what its programs have, where nothing else says it; of two what they have in common */
        {"bias|--api|OpenGL", "unorm24", "gl", "ieee", "gl", NULL},
        {"bias|--api|three|-m|reversed", "unorm24", "reversed", "ieee", "three", NULL},
        {"bias|--api|gl|-F|fp32", "fp32", "gl", "ieee", "gl", NULL},
        {"bias|-m|d3d|--api|d3d9", "unorm24", "d3d", "ieee", "d3d9", NULL},
        {"bias|--api|vulkan|-m|d3d", "fp32", "d3d", "ieee", "vulkan", NULL},
        {"bias|--api|gl|--preset|unity", "fp32", "reversed", "ieee", "gl", NULL},
        {"bias|--api|gl,three", "unorm24", "gl", "ieee", NULL, NULL},
        {"bias|--api|gl,vulkan|-m|d3d", "fp32", "d3d", "ieee", NULL, NULL},
        {"shadow|--api|gl", "fp32", "gl", "ieee", NULL, NULL}, /* a shadow map is no window */
        {"scene|x.obj|--api|gl", "unorm24", "gl", "ieee", NULL, NULL},
        {"budget|--platform|webgl-metal|-F|fp16|-m|reversed|--arith|mesa", "fp16", "reversed", "mesa", NULL, NULL},
        {"table|--platform|safari|--preset|three", "fp32", "gl", "ieee", NULL, NULL},
        {"table|--platform|firefox-d3d|--preset|bevy", "unorm24", "reversed", "ieee", NULL, NULL},
        {"table|--platform|webgl-d3d|--viewport|100x100", "unorm24", "gl", "ieee-remap", NULL, "spec-d3d"},
        {"table|--platform|webgl-d3d|--viewport|100x100|--raster|llvmpipe", "unorm24", "gl", "mesa-remap", NULL,
         "llvmpipe"},
        {"table|--platform|webgl-d3d|--preset|bevy|--viewport|100x100", "unorm24", "reversed", "ieee", NULL,
         "spec-d3d"}, /* reversed is no clip space that is remapped */
    };
    tally t = {.name = "platforms"};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char line[1024], formats[64] = "";
        dp_arith arith;
        asked_line o = {.request = NULL};
        dp_arith_parse(rows[i].arith, &arith);
        TALLY(&t, parse_line(&o, rows[i].line, line) == EXIT_FINE, "%s: %s", rows[i].line, line);
        for (size_t f = 0; f < camera_on(&o)->format_count && f < 3; f++)
            snprintf(formats + strlen(formats), sizeof formats - strlen(formats), "%s%s", f > 0 ? " " : "",
                     camera_on(&o)->formats[f].name);
        TALLY(&t, strcmp(formats, rows[i].formats) == 0, "%s: %s", rows[i].line, formats);
        TALLY(&t,
              camera_on(&o)->mapping_count == 1 &&
                  strcmp(dp_mapping_get(camera_on(&o)->mappings[0])->name, rows[i].mapping) == 0,
              "%s: mapping", rows[i].line);
        TALLY(&t, camera_on(&o)->arith == arith, "%s: arithmetic", rows[i].line);
        TALLY(&t, rows[i].api == NULL || strcmp(ASKED(bias, o)->bias.api->name, rows[i].api) == 0, "%s: API",
              rows[i].line);
        TALLY(&t,
              rows[i].raster == NULL ? camera_on(&o)->raster == NULL
                                     : strcmp(camera_on(&o)->raster->name, rows[i].raster) == 0,
              "%s: rasterizer", rows[i].line);
        options_release(&o);
    }
    tally_end(&t);
}

/* ---- The command line as a whole --------------------------------------------------------------------------------- */

/* An option with an argument is given once; which one would count, nobody can see. */
TEST(test_twice) {
    static const char *const examples[][2] = {{"near", "1"},       {"format", "d24"},      {"at", "1"},
                                              {"preset", "unity"}, {"unit", "cm"},         {"output", "x"},
                                              {"seed", "1"},       {"synthetic", "steps"}, {"model", "exact"},
                                              {"far", "1000"},     {"separation", "1m"},   {"mapping", "gl"}};
    tally t = {.name = "twice"};
    const command_row *v;
    for (size_t k = 0; k < sizeof examples / sizeof examples[0]; k++)
        for (size_t i = 0; (v = command_get(i)) != NULL; i++) {
            char words[256], line[1024], expected[128];
            asked_line o = {.request = NULL};
            const char *name = examples[k][0], *value = examples[k][1];
            if (option_used(v, ~0U, option_find(v, name)).row == NULL)
                continue;
            snprintf(words, sizeof words, "%s|--%s|%s|--%s=%s", v->name, name, value, name, value);
            snprintf(expected, sizeof expected, "depthprec: --%s: must not be given twice, got '%s' too", name, value);
            TALLY(&t, parse_line(&o, words, line) == EXIT_USAGE && strcmp(line, expected) == 0, "%s: %s", words, line);
            options_release(&o);
        }
    char line[1024];
    asked_line o = {.request = NULL};
    assert_int_equal(parse_line(&o, "texture|x|--parameter|a=1|--parameter|b=2", line), EXIT_FINE);
    assert_int_equal(ASKED(texture, o)->image.parameter_count, 2);
    assert_int_equal(parse_line(&o, "texture|x|--parameter|a=1|--parameter|a=2", line), EXIT_USAGE);
    assert_int_equal(parse_line(&o, "texture|x|--parameter|a=1,b=2|--parameter|c=-3", line), EXIT_FINE);
    assert_true(ASKED(texture, o)->image.parameter_count == 3 && ASKED(texture, o)->image.parameters[1].value == 2 &&
                strcmp(ASKED(texture, o)->image.parameters[1].name, "b") == 0 &&
                ASKED(texture, o)->image.parameters[2].value == -3);
    assert_int_equal(parse_line(&o, "texture|x|--parameter|a=1,a=2", line), EXIT_USAGE);
    assert_int_equal(parse_line(&o, "texture|x|--parameter|a=1,", line), EXIT_USAGE);
    assert_int_equal(parse_line(&o, "texture|x|--parameter|a=1,,b=2", line), EXIT_USAGE);
    assert_int_equal(parse_line(&o, "table|-q|-q|--json|--json|--ortho|--ortho", line), EXIT_FINE);
    tally_end(&t);
    options_release(&o);
}

/* Options before the command; what is no option's is the command, wherever it stands. */
TEST(test_order) {
    static const struct {
        const char *words, *command, *operand; /* null: none */
    } rows[] = {
        {"-n|5", "table", NULL},
        {"-n|5|table", "table", NULL},
        {"-n|5|plot|error", "plot", "error"},
        {"plot|-n|5|error", "plot", "error"},
        {"-q|plot|error|-n|5", "plot", "error"},
        {"--near=5|-q|check|--|-x", NULL, NULL}, /* check takes no --near */
        {"-q|check|--|-x", "check", "-x"},
        {"-V", "help", NULL},
        {"--help|table", "help", NULL},
        {"-q|help|table", NULL, NULL}, /* help takes no -q */
    };
    tally t = {.name = "order"};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char line[1024];
        asked_line o = {.request = NULL};
        const int status = parse_line(&o, rows[i].words, line);
        TALLY(&t, (status == EXIT_FINE) == (rows[i].command != NULL), "%s: %d, %s", rows[i].words, status, line);
        TALLY(&t, rows[i].command == NULL || strcmp(o.command->name, rows[i].command) == 0, "%s: %s", rows[i].words,
              o.command->name);
        TALLY(&t,
              rows[i].operand == NULL ? status != EXIT_FINE || o.operand_count == 0
                                      : o.operand_count == 1 && strcmp(o.operands[0], rows[i].operand) == 0,
              "%s: operands", rows[i].words);
        TALLY(&t, strstr(rows[i].words, "-n|5") == NULL || camera_on(&o)->znear == 5, "%s: near %g", rows[i].words,
              camera_on(&o)->znear);
    }
    tally_end(&t);
}
