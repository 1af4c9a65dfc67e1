/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Every row of the option table: what it takes and where that goes, by values written down here; what it refuses; its
 * default. The languages of lists, depths and sizes are tried in cli/errors.txt.
 */
#include "bias/cmd_bias/request.h"
#include "cli/cmd_list/request.h"
#include "code/cmd_code/request.h"
#include "code/language.h"
#include "convert/cmd_convert/request.h"
#include "judge/cmd_judge/request.h"
#include "method/cmd_methods/request.h"
#include "parsed.h"
#include "plot/cmd_plot/request.h"
#include "probe/cmd_probe/request.h"
#include "quantity/cmd_budget/request.h"
#include "quantity/cmd_table/request.h"
#include "scene/cmd_scene/request.h"
#include "scene/find.h"
#include "shadow/cmd_shadow/request.h"
#include "shadow/engine.h"
#include "solve/cmd_check/request.h"
#include "solve/cmd_solve/request.h"
#include "support.h"
#include "texture/cmd_texture/request.h"
#include "world/cmd_world/request.h"
#include "zfight/cmd_prepass/request.h"
#include "zfight/cmd_zfight/request.h"

static const char *tried[OPTIONS_MAX]; /* names, each once */

/* Some are refused alone. */
static const struct {
    const char *command, *names, *beside;
} needing[] = {{"", " hfov raster subpixel slant triangle-class ", "--viewport=64x48"},
               {"texture", " radial lattice ", "--metric=1m"},
               {"texture", " tint ", "--picture=a.png"},
               {"scene", " look ", "--eye=0,0,0"},
               {"bias", " check ", "--units=1"},
               {"scene", " eye ", "--look=0,0,0"}};

static const char *needed(const char *command, const char *name) {
    char spaced[64];
    snprintf(spaced, sizeof spaced, " %s ", name);
    for (size_t i = 0; i < sizeof needing / sizeof needing[0]; i++)
        if (strncmp(command, needing[i].command, strlen(needing[i].command)) == 0 &&
            strstr(needing[i].names, spaced) != NULL)
            return needing[i].beside;
    return NULL;
}

/* One option behind a command, and its operands; `line` is what was said on stderr, without its line feed. */
static int parse(asked_line *o, const char *command, const char *id, const char *value, char line[1024]) {
    char words[32], name[64], given[128], beside[32];
    snprintf(words, sizeof words, "%s", command);
    snprintf(name, sizeof name, "--%s", id);
    snprintf(given, sizeof given, "%s", value != NULL ? value : "");
    snprintf(beside, sizeof beside, "%s", needed(command, id) != NULL ? needed(command, id) : "");
    char *operand = strchr(words, ' ');
    char *argv[10] = {(char[]){"depthprec"}, words, name};
    int argc = 3;
    if (value != NULL)
        argv[argc++] = given;
    if (*beside != '\0')
        argv[argc++] = beside;
    for (; operand != NULL; operand = strchr(operand, ' ')) {
        *operand++ = '\0';
        argv[argc++] = operand;
    }
    size_t i = 0;
    while (tried[i] != NULL && strcmp(tried[i], id) != 0)
        i++;
    tried[i] = id;
    options_release(o);
    return parsed(o, argc, argv, line);
}

static void refused(tally *t, const char *command, const char *id, const char *value, const char *said) {
    char line[1024] = "", expected[1024];
    asked_line o = {.request = NULL};
    const int status = parse(&o, command, id, value, line);
    options_release(&o);
    snprintf(expected, sizeof expected, "depthprec: --%s: must be %s, got '%s'", id, said, value);
    TALLY(t, status == EXIT_USAGE, "--%s %s: status %d", id, value, status);
    TALLY(t, strncmp(line, expected, strlen(expected)) == 0, "'%s', not '%s'", line, expected);
    options_release(&o);
}

/* ---- Numbers ----------------------------------------------------------------------------------------------------- */

#define AT(command, member) offsetof(command##_request, member)

static const struct {
    const char *command;
    const char *id;
    size_t field;
    double standard, least, most;
    const char *least_text, *most_text, *below, *above, *said;
} numbers[] = {
    {"table", "near", AT(table, camera.znear), 0.1, 1e-12, 1e12, "1e-12", "1e12", "9.9e-13", "1.0001e12",
     "a number from 1e-12 to 1e12 scene units"},
    {"table", "log-c", AT(table, camera.log_c), 1, 1e-12, 1e12, "1e-12", "1e12", "0", "2e12",
     "a number from 1e-12 to 1e12"},
    {"budget", "interpolation", AT(budget, origin.terms.interpolation), 0, 0, 16777216, "0", "16777216", "-1",
     "16777217", "a number from 0 to 16777216 units of 2^-24"},
    {"budget", "from-origin", AT(budget, origin.terms.world), 0, 0, 1e18, "0", "1e18", "-1e-9", "1.1e18",
     "a number from 0 to 1e18 scene units"},
    {"bias", "units", AT(bias, bias.units), 0, -1e12, 1e12, "-1e12", "1e12", "-2e12", "2e12",
     "a number from -1e12 to 1e12"},
    {"bias", "factor", AT(bias, bias.factor), 0, -1e12, 1e12, "-1e12", "1e12", "-2e12", "2e12",
     "a number from -1e12 to 1e12"},
    {"bias", "clamp", AT(bias, bias.clamp), 0, -1e12, 1e12, "-1e12", "1e12", "-2e12", "2e12",
     "a number from -1e12 to 1e12"},
    {"bias", "slope", AT(bias, bias.slope), 0, 0, 1e12, "0", "1e12", "-1", "2e12",
     "a number from 0 to 1e12 scene units per pixel"},
    {"texture", "fov", AT(texture, camera.spec.fov_y), 60, 0.01, 179, "0.01", "179", "0", "180",
     "a number from 0.01 to 179 degrees"},
    {"budget", "hfov", AT(budget, camera.fov_x), 0, 0.01, 179, "0.01", "179", "0", "180",
     "a number from 0.01 to 179 degrees"},
    {"shadow", "angle", AT(shadow, shadow.angle), 75, 0, 89.9, "0", "89.9", "-1", "89.91",
     "a number from 0 to 89.9 degrees"},
    {"shadow", "spot", AT(shadow, shadow.spot), 0, 0.001, 170, "0.001", "170", "0", "170.1",
     "a number from 0.001 to 170 degrees"},
    {"shadow", "casters", AT(shadow, shadow.casters), 100, 0, 1e12, "0", "1e12", "-1", "2e12",
     "a number from 0 to 1e12 scene units"},
    {"texture", "sky", AT(texture, image.sky), 1e-4, 0, 0.5, "0", "0.5", "-0.1", "0.6",
     "a number from 0 to 0.5, or none"},
    {"texture", "metric", AT(texture, image.metric), 0, 1e-9, 1e6, "1e-9", "1e6", "0", "1e7",
     "a number from 1e-9 to 1e6 scene units, mm, tum, kitti, sun3d or nyu-raw"},
};

static double number_at(const asked_line *o, size_t field) {
    double number;
    memcpy(&number, (const char *)o->request + field, sizeof number);
    return number;
}

static void taken(tally *t, const char *command, const char *id, const char *value, size_t field, double expected) {
    char line[1024] = "";
    asked_line o = {.request = NULL};
    const int status = parse(&o, command, id, value, line);
    TALLY(t, status == EXIT_FINE && option_given(&o, id), "--%s %s: status %d, %s", id, value, status, line);
    TALLY(t, number_at(&o, field) == expected, "--%s %s: %.17g", id, value, number_at(&o, field));
    options_release(&o);
}

TEST(test_numbers) {
    tally t = {.name = "numbers"};
    asked_line o = {.request = NULL};
    char line[1024] = "";
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        taken(&t, numbers[i].command, numbers[i].id, numbers[i].least_text, numbers[i].field, numbers[i].least);
        taken(&t, numbers[i].command, numbers[i].id, numbers[i].most_text, numbers[i].field, numbers[i].most);
        const char *const wrong[] = {numbers[i].below, numbers[i].above, "x", "", "nan", "1e999", "inf", "5 "};
        for (size_t k = 0; k < sizeof wrong / sizeof wrong[0]; k++)
            if (strcmp(numbers[i].id, "units") != 0 || strcmp(wrong[k], "inf") != 0)
                refused(&t, numbers[i].command, numbers[i].id, wrong[k], numbers[i].said);
        parse(&o, numbers[i].command, "quiet", NULL, line);
        const double standard = number_at(&o, numbers[i].field);
        TALLY(&t, standard == numbers[i].standard || (isnan(standard) && isnan(numbers[i].standard)),
              "--%s: default %g", numbers[i].id, standard);
    }
    taken(&t, "bias", "units", "inf", AT(bias, bias.units), INFINITY);
    taken(&t, "bias", "units", "-Infinity", AT(bias, bias.units), -INFINITY);
    refused(&t, "bias", "factor", "inf", "a number from -1e12 to 1e12");
    tally_end(&t);
    options_release(&o);
}

/* Lengths: positive, and nothing when not given. */
TEST(test_lengths) {
    static const struct {
        const char *command;
        const char *id;
        size_t field;
    } rows[] = {{"solve", "separation", AT(solve, separation)},
                {"solve", "error", AT(solve, error)},
                {"bias", "separation", AT(bias, bias.separation)},
                {"scene m.obj", "within", AT(scene, scene.within)},
                {"texture", "overlay", AT(texture, image.overlay)}};
    tally t = {.name = "lengths"};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        taken(&t, rows[i].command, rows[i].id, "5e-324", rows[i].field, 5e-324);
        taken(&t, rows[i].command, rows[i].id, "1e300", rows[i].field, 1e300);
        refused(&t, rows[i].command, rows[i].id, "0", "a positive number of scene units");
        refused(&t, rows[i].command, rows[i].id, "-1", "a positive number of scene units");
        refused(&t, rows[i].command, rows[i].id, "inf", "a positive number of scene units");
    }
    tally_end(&t);
}

#define WORD_AT(command, member) offsetof(command##_request, member), sizeof(((command##_request *)NULL)->member)

static uint64_t word_at(const asked_line *o, size_t field, size_t size) {
    unsigned narrow;
    uint64_t wide;
    memcpy(size == sizeof narrow ? (void *)&narrow : &wide, (const char *)o->request + field, size);
    return size == sizeof narrow ? narrow : wide;
}

/* ---- Whole numbers ----------------------------------------------------------------------------------------------- */

TEST(test_whole) {
    static const struct {
        const char *command;
        const char *id;
        size_t field, size;
        uint64_t least, most;
        const char *least_text, *most_text, *below, *above, *said;
    } wholes[] = {
        {"zfight", "sample", WORD_AT(zfight, sample), 1, 1000000000000, "1", "1000000000000", "0", "1000000000001",
         "a whole number from 1 to 1000000000000"},
        {"zfight", "seed", WORD_AT(zfight, seed), 0, 9007199254740992, "0", "9007199254740992", "-1",
         "9007199254740993", "a whole number from 0 to 9007199254740992"},
        {"check", "threads", WORD_AT(checks, out.threads), 1, 1024, "1", "1024", "0", "1025",
         "a whole number from 1 to 1024"},
        {"budget", "subpixel", WORD_AT(budget, camera.triangles.subpixel), 1, 8, "1", "8", "0", "9",
         "a whole number from 1 to 8 bits"},
        {"shadow", "kernel", WORD_AT(shadow, shadow.kernel), 1, 64, "1", "64", "0", "65",
         "a whole number from 1 to 64 texels"},
        {"judge", "pairs-for", WORD_AT(judge, judge.depths), 8, 1000000, "8", "1000000", "7", "1000001",
         "a whole number from 8 to 1000000"},
    };
    tally t = {.name = "whole"};
    for (size_t i = 0; i < sizeof wholes / sizeof wholes[0]; i++) {
        const char *const wrong[] = {wholes[i].below, wholes[i].above, "", "1e3", "+5", " 5", "5.0", "0x10"};
        for (size_t k = 0; k < sizeof wrong / sizeof wrong[0]; k++)
            refused(&t, wholes[i].command, wholes[i].id, wrong[k], wholes[i].said);
        for (int k = 0; k < 2; k++) {
            char line[1024] = "";
            asked_line o = {.request = NULL};
            parse(&o, wholes[i].command, wholes[i].id, k == 0 ? wholes[i].least_text : wholes[i].most_text, line);
            const uint64_t field = word_at(&o, wholes[i].field, wholes[i].size);
            TALLY(&t, field == (k == 0 ? wholes[i].least : wholes[i].most), "--%s: %llu, %s", wholes[i].id,
                  (unsigned long long)field, line);
            options_release(&o);
        }
    }
    tally_end(&t);
}

/* ---- Names ------------------------------------------------------------------------------------------------------- */

/* Long: its rows are written out, by hand. */
TEST(test_words) {
    static const struct {
        const char *command;
        const char *id;
        size_t field, size;
        const char *said;
        struct {
            const char *word;
            unsigned value;
        } words[10];
    } rows[] = {
        {"table",
         "rounding",
         WORD_AT(table, camera.rounding),
         "nearest, even or zero",
         {{"nearest", DP_ROUND_NEAREST}, {"even", DP_ROUND_EVEN}, {"zero", DP_ROUND_ZERO}}},
        {"table",
         "model",
         WORD_AT(table, camera.model),
         "exact, staged, float or auto",
         {{"exact", DP_MODEL_EXACT}, {"staged", DP_MODEL_STAGED}, {"float", DP_MODEL_FLOAT}, {"auto", DP_MODEL_EXACT}}},
        {"budget",
         "composition",
         WORD_AT(budget, origin.terms.composition),
         "once, products or relative",
         {{"once", DP_COMPOSITION_ONCE}, {"products", DP_COMPOSITION_PRODUCTS}, {"relative", DP_COMPOSITION_RELATIVE}}},
        {"budget",
         "log2",
         WORD_AT(budget, origin.terms.log2),
         "vulkan, d3d or rounded",
         {{"vulkan", 0}, {"spirv", 0}, {"webgl", 0}, {"d3d", 1}, {"hlsl", 1}, {"rounded", 2}}},
        {"table",
         "arith",
         WORD_AT(table, camera.arith),
         "ieee, fused, reciprocal, fused-reciprocal, product, mesa, softpipe, nvidia, ieee-remap or mesa-remap",
         {{"ieee", 0},
          {"fused", 1},
          {"reciprocal", 2},
          {"fused-reciprocal", 3},
          {"product", 4},
          {"mesa", 5},
          {"softpipe", 6},
          {"nvidia", 7},
          {"ieee-remap", 8},
          {"mesa-remap", 9}}},
        {"solve",
         "for",
         WORD_AT(solve, target),
         "near, far, format, mapping, separation, distance or frusta",
         {{"near", SOLVE_FOR_NEAR},
          {"far", SOLVE_FOR_FAR},
          {"format", SOLVE_FOR_FORMAT},
          {"mapping", SOLVE_FOR_MAPPING},
          {"separation", SOLVE_FOR_SEPARATION},
          {"distance", SOLVE_FOR_DISTANCE},
          {"frusta", SOLVE_FOR_FRUSTA}}},
        {"plot error", "type", WORD_AT(plot, figure.type), "svg, pdf or png", {{"svg", 0}, {"pdf", 1}, {"png", 2}}},
        {"list",
         "color",
         WORD_AT(list, out.colour),
         "auto, always or never",
         {{"auto", OUTPUT_COLOUR_AUTO}, {"always", OUTPUT_COLOUR_ALWAYS}, {"never", OUTPUT_COLOUR_NEVER}}},
        {"scene m.obj",
         "transforms",
         WORD_AT(scene, scene.transforms),
         "exact or binary32",
         {{"exact", 0}, {"binary32", 1}}},
        {"code",
         "what",
         WORD_AT(code, what),
         "linearize, projection, encode, position, pack or normal",
         {{"linearize", 0}, {"projection", 1}, {"encode", 2}, {"position", 3}, {"pack", 4}, {"normal", 5}}},
        {"prepass",
         "vertices",
         WORD_AT(prepass, vertices),
         "eye-log or box",
         {{"eye-log", VERTEX_EYE_LOG}, {"box", VERTEX_BOX}}},
        {"texture",
         "normal-format",
         WORD_AT(texture, image.normal_format),
         "opengl or directx",
         {{"opengl", 0}, {"directx", 1}}},
        {"texture",
         "theme",
         WORD_AT(texture, figure.theme),
         "light, dark or print",
         {{"light", 0}, {"dark", 1}, {"print", 2}}},
        {"check x",
         "report",
         WORD_AT(checks, out.report),
         "text, json or junit",
         {{"text", REPORT_TEXT}, {"json", REPORT_JSON}, {"junit", REPORT_JUNIT}}},
    };
    tally t = {.name = "words"};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char line[1024] = "";
        asked_line o = {.request = NULL};
        for (size_t k = 0; k < 10 && rows[i].words[k].word != NULL; k++) {
            const char *word = rows[i].words[k].word;
            const int status = parse(&o, rows[i].command, rows[i].id, word, line);
            TALLY(&t, status == EXIT_FINE && word_at(&o, rows[i].field, rows[i].size) == rows[i].words[k].value,
                  "--%s %s: %llu, %s", rows[i].id, word, (unsigned long long)word_at(&o, rows[i].field, rows[i].size),
                  line);
            TALLY(&t,
                  strcmp(rows[i].id, "model") != 0 || ASKED(table, o)->camera.model_auto == (strcmp(word, "auto") == 0),
                  "--%s %s: auto", rows[i].id, word);
        }
        refused(&t, rows[i].command, rows[i].id, "", rows[i].said);
        refused(&t, rows[i].command, rows[i].id, "nosuchword", rows[i].said);
        /* The first is the default, but for what is solved for. */
        parse(&o, rows[i].command, "quiet", NULL, line);
        const unsigned standard = strcmp(rows[i].id, "for") == 0 ? SOLVE_FOR_ANY : rows[i].words[0].value;
        TALLY(&t, word_at(&o, rows[i].field, rows[i].size) == standard, "--%s: default", rows[i].id);
    }
    tally_end(&t);
}

/* Rows of tables, by their names in the table of this test; other spellings where there are any. */
TEST(test_rows) {
    static const struct {
        const char *command;
        const char *id;
        size_t field;
        const char *given, *name; /* of the row; null: no row */
        size_t name_at;
        const char *near, *meant;
    } rows[] = {
        {"table", "preset", AT(table, camera.presets), "unreal", "unreal", offsetof(preset, name), "unrael", "unreal"},
        {"table", "platform", AT(table, camera.platform), "SAFARI", "safari", offsetof(platform, name), "safary",
         "safari"},
        {"bias", "api", AT(bias, bias.api), "Vulkan", "vulkan", offsetof(bias_api, name), "wegbpu", "webgpu"},
        {"bias", "api", AT(bias, bias.api), "all", NULL, 0, "metall", "metal"},
        {"bias", "api", AT(bias, bias.api), "direct3d12", "d3d12", offsetof(bias_api, name), "d3d14",
         "d3d11' or 'd3d12"},
        {"bias", "api", AT(bias, bias.api), "gl,d3d12", NULL, 0, "gl,d3d14", "d3d11"},
        {"prepass", "program", AT(prepass, program), "FMA", "fma", offsetof(vertex_program, name), "separatr",
         "separate"},
        {"table", "raster", AT(table, camera.raster), "LLVMpipe", "llvmpipe", offsetof(raster_row, name), "lavapip",
         "lavapipe"},
        {"budget", "raster", AT(budget, camera.raster), "spec-gl", "spec-gl", offsetof(raster_row, name), "spec-d3",
         "spec-d3d"},
        {"texture", "synthetic", AT(texture, image.synthetic), "steps", "steps", offsetof(synthetic_row, name), "decal",
         "decals"},
        {"texture", "product", AT(texture, image.product), "Linear01", "linear01", offsetof(product_row, name),
         "radail", "radial"},
        {"texture", "product", AT(texture, image.position), "position:rays", "rays", offsetof(position_row, name),
         "position:matirx", "matrix"},
        {"texture", "product", AT(texture, image.position), "position:exact", NULL, 0, "position:exakt", "exact"},
        {"texture", "product", AT(texture, image.position), "position", NULL, 0, "positoin", "position"},
        {"texture", "product", AT(texture, image.normal), "normal:high-1", "high-1", offsetof(normal_row, name),
         "normal:meduim", "medium"},
        {"texture", "product", AT(texture, image.normal), "normal", "projective", offsetof(normal_row, name), "norml",
         "normal"},
        {"texture", "product", AT(texture, image.effect), "effect:Fog", "fog", offsetof(effect_row, name),
         "effect:edeg", "edge"},
        {"code", "language", AT(code, language), "HLSL", "hlsl", offsetof(code_language, name), "glsk", "glsl"},
        {"texture", "packing", AT(texture, image.packing), "rgb24", "rgb24", offsetof(packing, name), "rgb42", "rgb24"},
    };
    tally t = {.name = "rows"};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char line[1024] = "", meant[64];
        const char *row, *name = NULL;
        asked_line o = {.request = NULL};
        TALLY(&t, parse(&o, rows[i].command, rows[i].id, rows[i].given, line) == EXIT_FINE, "%s", line);
        memcpy(&row, (const char *)o.request + rows[i].field, sizeof row);
        if (row != NULL)
            memcpy(&name, row + rows[i].name_at, sizeof name);
        TALLY(&t, rows[i].name == NULL ? row == NULL : name != NULL && strcmp(name, rows[i].name) == 0, "--%s %s: %s",
              rows[i].id, rows[i].given, name != NULL ? name : "no row");
        TALLY(&t, parse(&o, rows[i].command, rows[i].id, rows[i].near, line) == EXIT_USAGE, "%s", rows[i].near);
        snprintf(meant, sizeof meant, "; did you mean '%s'", rows[i].meant);
        TALLY(&t, strstr(line, meant) != NULL, "%s: %s", meant, line);
        parse(&o, rows[i].command, "quiet", NULL, line);
        memcpy(&row, (const char *)o.request + rows[i].field, sizeof row);
        const bool standard =
            strcmp(rows[i].id, "api") == 0 || strcmp(rows[i].id, "program") == 0 || strcmp(rows[i].id, "language") == 0;
        TALLY(&t, (row != NULL) == standard, "--%s: default", rows[i].id);
    }
    tally_end(&t);
}

/* Numbers separated by commas. */
TEST(test_lists) {
    static const struct {
        const char *command;
        const char *id;
        size_t field;
        const char *given;
        size_t count;
        double first, last;
        const char *wrong[4], *said;
    } rows[] = {
        {"table",
         "depth",
         AT(table, looked_up),
         "0.25,0,-0,1",
         4,
         0.25,
         1,
         {"1.0001", "-1e-9", "", "nan"},
         "D[,D...]|LO:HI:log|lin:COUNT, numbers from 0 to 1"},
        {"table",
         "code",
         AT(table, looked_up),
         "0x10,4294967295",
         2,
         16,
         4294967295,
         {"4294967296", "-1", "1.5", "x"},
         "N[,N...]|LO:HI[:log|lin:COUNT], whole numbers from 0 to 4294967295"},
        {"texture",
         "pixel",
         AT(texture, image.pixels),
         "3,0;2,65535",
         4,
         3,
         65535,
         {"65536", "1.5", "x", "-1"},
         "X,Y[;X,Y...], whole numbers from 0 to 65535"},
    };
    tally t = {.name = "lists"};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char line[1024] = "";
        depths d;
        asked_line o = {.request = NULL};
        TALLY(&t, parse(&o, rows[i].command, rows[i].id, rows[i].given, line) == EXIT_FINE, "%s", line);
        memcpy(&d, (const char *)o.request + rows[i].field, sizeof d);
        TALLY(&t, d.count == rows[i].count && depths_get(&d, 0) == rows[i].first && d.hi == rows[i].last,
              "--%s: %zu, %g", rows[i].id, d.count, d.hi);
        for (size_t k = 0; k < d.count; k++)
            TALLY(&t, !signbit(depths_get(&d, k)), "--%s: -0", rows[i].id);
        options_release(&o);
        for (size_t k = 0; k < 4; k++)
            refused(&t, rows[i].command, rows[i].id, rows[i].wrong[k], rows[i].said);
        parse(&o, rows[i].command, "quiet", NULL, line);
        memcpy(&d, (const char *)o.request + rows[i].field, sizeof d);
        TALLY(&t, d.count == 0, "--%s: default", rows[i].id);
    }
    tally_end(&t);
}

/* ---- Flags and texts --------------------------------------------------------------------------------------------- */

TEST(test_flags) {
    static const struct {
        const char *command;
        const char *id;
        size_t field, size;
    } flags[] = {{"convert d24 d24", "saturate", WORD_AT(convert, saturate)},
                 {"convert d24 fp16", "flush", WORD_AT(convert, flush)},
                 {"table", "ortho", WORD_AT(table, camera.ortho)},
                 {"budget", "linearize", WORD_AT(budget, origin.terms.linearize)},
                 {"table", "constants", WORD_AT(table, constants)},
                 {"zfight", "rasterize", WORD_AT(zfight, drawn)},
                 {"bias", "check", WORD_AT(bias, checked)},
                 {"texture", "error-map", WORD_AT(texture, image.error_map)},
                 {"shadow", "point", WORD_AT(shadow, shadow.point)},
                 {"list", "quiet", WORD_AT(list, out.quiet)},
                 {"list", "full", WORD_AT(list, out.full)},
                 {"code", "uniforms", WORD_AT(code, uniforms)},
                 {"texture", "radial", WORD_AT(texture, image.radial)}};
    static const char zeros[8];
    tally t = {.name = "flags"};
    for (size_t i = 0; i < sizeof flags / sizeof flags[0]; i++) {
        char line[1024] = "";
        asked_line o = {.request = NULL};
        parse(&o, flags[i].command, "quiet", NULL, line);
        const bool quiet = strcmp(flags[i].id, "quiet") == 0;
        TALLY(&t, quiet || memcmp((const char *)o.request + flags[i].field, zeros, flags[i].size) == 0, "--%s: default",
              flags[i].id);
        TALLY(&t, parse(&o, flags[i].command, flags[i].id, NULL, line) == EXIT_FINE, "%s", line);
        const uint64_t value = flags[i].size == 1 ? *((const unsigned char *)o.request + flags[i].field)
                                                  : word_at(&o, flags[i].field, flags[i].size);
        TALLY(&t, value == 1, "--%s: %llu", flags[i].id, (unsigned long long)value);
    }
    char line[1024] = "";
    asked_line o = {.request = NULL};
    TALLY(&t, parse(&o, "shadow", "distance", NULL, line) == EXIT_USAGE, "of cascades");
    TALLY(&t, parse(&o, "shadow", "engine", "bevy,three", line) == EXIT_FINE, "engines");
    TALLY(&t, strcmp(ASKED(shadow, o)->shadow.engine->name, "bevy") == 0 && ASKED(shadow, o)->shadow.engines == 5,
          "the first, and all");
    TALLY(&t, parse(&o, "shadow", "bias", "1", line) == EXIT_USAGE, "needs an engine");
    TALLY(&t, parse(&o, "shadow", "normal-bias", "1", line) == EXIT_USAGE, "needs an engine");
    TALLY(&t, parse(&o, "shadow", "filter", "poisson-2x2:2.2", line) == EXIT_FINE, "%s", line);
    TALLY(&t, ASKED(shadow, o)->shadow.kernel == 7, "twice 3.2, and rounded up");
    TALLY(&t, parse(&o, "bias", "remedy", "near:1.5", line) == EXIT_FINE, "%s", line);
    TALLY(&t, strcmp(ASKED(bias, o)->remedy->name, "near") == 0 && ASKED(bias, o)->amount == 1.5, "name and number");
    TALLY(&t, parse(&o, "bias", "remedy", "near:0.5", line) == EXIT_USAGE, "below the least");
    options_release(&o);
    tally_end(&t);
}

TEST(test_texts) {
    static const struct {
        const char *command;
        const char *id;
        size_t field;
        bool file;
    } texts[] = {{"texture", "title", AT(texture, figure.title), false},
                 {"texture", "channel", AT(texture, image.channel), false},
                 {"texture", "lattice", AT(texture, image.lattice), false},
                 {"texture", "as", AT(texture, image.as), false},
                 {"table", "output", AT(table, out.file), true},
                 {"texture", "picture", AT(texture, image.picture), true},
                 {"texture", "figure", AT(texture, image.figure), true},
                 {"texture", "histogram", AT(texture, image.histogram), true},
                 {"scene m.obj", "render", AT(scene, scene.render), true},
                 {"probe", "keep", AT(probe, keep), true},
                 {"judge", "pairs", AT(judge, judge.pairs), true},
                 {"probe", "device", AT(probe, device), true},
                 {"scene m.obj", "path", AT(scene, scene.path), true},
                 {"scene m.obj", "camera", AT(scene, scene.camera), false},
                 {"scene m.obj", "emit-need", AT(scene, scene.emit_need), true}};
    tally t = {.name = "texts"};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        char line[1024] = "";
        const char *text;
        asked_line o = {.request = NULL};
        TALLY(&t, (parse(&o, texts[i].command, texts[i].id, "", line) == EXIT_FINE) != texts[i].file, "%s", line);
        TALLY(&t, parse(&o, texts[i].command, texts[i].id, "-n 5, %s", line) == EXIT_FINE, "%s", line);
        memcpy(&text, (const char *)o.request + texts[i].field, sizeof text);
        TALLY(&t, text != NULL && text[0] == '-', "--%s", texts[i].id);
        parse(&o, texts[i].command, "quiet", NULL, line);
        memcpy(&text, (const char *)o.request + texts[i].field, sizeof text);
        TALLY(&t, text == NULL, "--%s: default", texts[i].id);
    }
    tally_end(&t);
}

/* An argument that may be left out is written behind "=". */
TEST(test_optional) {
    char line[1024] = "";
    asked_line o = {.request = NULL};
    assert_int_equal(parse(&o, "texture", "error-map", NULL, line), EXIT_FINE);
    assert_true(ASKED(texture, o)->image.error_map && ASKED(texture, o)->image.error_file == NULL &&
                option_given(&o, "error-map"));
    options_release(&o);
    assert_int_equal(options_parse(&o, 3, (char *[]){"depthprec", "texture", "--error-map=a.npy", NULL}), EXIT_FINE);
    assert_true(!ASKED(texture, o)->image.error_map && option_given(&o, "error-map"));
    assert_string_equal(ASKED(texture, o)->image.error_file, "a.npy");
    options_release(&o);
    assert_int_equal(options_parse(&o, 4, (char *[]){"depthprec", "texture", "--error-map", "a.npy", NULL}), EXIT_FINE);
    assert_true(ASKED(texture, o)->image.error_map && ASKED(texture, o)->image.error_file == NULL &&
                o.operand_count == 1);
    options_release(&o);
    assert_int_equal(parse(&o, "table", "link", NULL, line), EXIT_FINE);
    assert_string_equal(ASKED(table, o)->out.link, "depthprec.html");
    options_release(&o);
    assert_int_equal(options_parse(&o, 3, (char *[]){"depthprec", "bias", "--link=a.html", NULL}), EXIT_FINE);
    assert_string_equal(ASKED(table, o)->out.link, "a.html");
    options_release(&o);
    assert_int_equal(parse(&o, "table", "quiet", NULL, line), EXIT_FINE);
    assert_null(ASKED(table, o)->out.link);
    options_release(&o);
}

/* ---- Languages of their own, and all rows ------------------------------------------------------------------------ */

static bool near_to(double a, double b) {
    return fabs(a - b) <= 1e-15 * fabs(b);
}

/* A way and its factor. */
TEST(test_copies) {
    static const struct {
        const char *id, *given, *way;
        double factor;
    } rows[] = {{"read", "Exact", "exact", 0},
                {"read", "divide:2^24", "divide", 0x1p24},
                {"read", "product:3", "product", 3},
                {"write", "NEAREST", "nearest", 0},
                {"write", "floor", "cut", 0},
                {"write", "trunc:0xFFFFFF", "cut", 16777215},
                {"write", "half:2^0", "half", 1},
                {"write", "rint:2^32", "round", 0x1p32},
                {"write", "round:16777216", "round", 0x1p24},
                {"write", "shift", "shift", 0}};
    static const char *const wrong[][2] = {
        {"read", "cut"},        {"read", "exact:2"},    {"write", "divide"},         {"write", "cut:"},
        {"write", "cut:0"},     {"write", "cut:0.5"},   {"write", "cut:16777217"},   {"write", "cut:2^33"},
        {"write", "cut:2^-1"},  {"write", "cut:2^1.5"}, {"write", "cut:8589934592"}, {"write", ":2"},
        {"write", "nearest:4"}, {"write", "cut:4:4"}};
    tally t = {.name = "copies"};
    char line[1024] = "";
    asked_line o = {.request = NULL};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        TALLY(&t, parse(&o, "convert d24 d16 d24", rows[i].id, rows[i].given, line) == EXIT_FINE, "%s", line);
        const convert_rule rule = *rows[i].id == 'r' ? ASKED(convert, o)->read : ASKED(convert, o)->write;
        TALLY(&t, strcmp(rule.way->name, rows[i].way) == 0 && near_to(rule.factor, rows[i].factor), "%s: %s:%g",
              rows[i].given, rule.way->name, rule.factor);
    }
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++)
        TALLY(&t, parse(&o, "convert d24 d16 d24", wrong[i][0], wrong[i][1], line) == EXIT_USAGE, "%s", wrong[i][1]);
    tally_end(&t);
}

TEST(test_boxes) {
    static const char *const boxes[] = {"", "1", "1x2", "1x2x3x4", "0x1x1", "1x-1x1", "1x1xinf", "2e12x1x1", "x1x1"};
    static const char *const sizes[] = {"", "0", "70000", "8x", "x8", "8x0", "1.5"};
    tally t = {.name = "boxes"};
    for (size_t i = 0; i < sizeof boxes / sizeof boxes[0]; i++)
        refused(&t, "shadow", "light-box", boxes[i], "WxHxD, each from 1e-12 to 1e12");
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++)
        refused(&t, "shadow", "size", sizes[i],
                strchr(sizes[i], 'x') != NULL ? "WIDTHxHEIGHT, each from 1 to 65536 pixels"
                                              : "N or WIDTHxHEIGHT, each from 1 to 65536 pixels");
    tally_end(&t);
}

TEST(test_worlds) {
    asked_line o = {.request = NULL};
    char line[1024] = "";
    assert_int_equal(parse(&o, "world", "from-origin", "8km,200m", line), EXIT_FINE);
    assert_true(ASKED(world, o)->distances.count == 2 && ASKED(world, o)->distances.lo == 200 &&
                ASKED(world, o)->distances.hi == 8000 && ASKED(world, o)->camera.at.count == 0);
    options_release(&o);
    assert_int_equal(parse(&o, "world", "scheme", "Split:1024,two-sum,split:1024,tile", line), EXIT_FINE);
    assert_true(ASKED(world, o)->origin.scheme_count == 3 && ASKED(world, o)->origin.schemes[0].size == 1024 &&
                ASKED(world, o)->origin.schemes[2].size == 20971.52);
    assert_string_equal(ASKED(world, o)->origin.schemes[1].row->name, "two-sum");
    assert_int_equal(parse(&o, "world", "share", NULL, line), EXIT_FINE);
    assert_true(ASKED(world, o)->origin.shared_origin && ASKED(world, o)->origin.scheme_count == WORLD_ROWS &&
                ASKED(world, o)->camera.triangles.width == 1920);
    options_release(&o);
}

/* Where a camera stands and what it looks at, in a model and in a world. */
TEST(test_places) {
    char line[1024] = "";
    asked_line o = {.request = NULL};
    assert_int_equal(parse(&o, "scene m.obj", "eye", "1,-2,3e4", line), EXIT_FINE);
    assert_true(ASKED(scene, o)->scene.eye[0] == 1 && ASKED(scene, o)->scene.eye[1] == -2 &&
                ASKED(scene, o)->scene.eye[2] == 3e4 && ASKED(scene, o)->scene.look[0] == 0 &&
                ASKED(scene, o)->camera.triangles.width == 1920);
    assert_int_equal(parse(&o, "scene m.obj", "look", "-5m,60cm,7m", line), EXIT_FINE);
    assert_true(ASKED(scene, o)->scene.look[0] == -5 && ASKED(scene, o)->scene.look[1] == 0.6 &&
                ASKED(scene, o)->scene.look[2] == 7 && ASKED(scene, o)->scene.eye[0] == 0 &&
                ASKED(scene, o)->camera.triangles.width == 1920);
    assert_int_equal(parse(&o, "texture", "eye", "1,-2,3e4", line), EXIT_FINE);
    assert_true(ASKED(texture, o)->image.eye[0] == 1 && ASKED(texture, o)->image.eye[1] == -2 &&
                ASKED(texture, o)->image.eye[2] == 3e4 && ASKED(texture, o)->camera.triangles.width == 0);
    assert_true(ASKED(texture, o)->image.size[0] == 640 && ASKED(texture, o)->image.size[1] == 360);
    assert_int_equal(parse(&o, "texture", "last-eye", "5,6,-7", line), EXIT_FINE);
    assert_true(ASKED(texture, o)->image.last_eye[0] == 5 && ASKED(texture, o)->image.last_eye[2] == -7 &&
                ASKED(texture, o)->image.eye[0] == 0 && ASKED(texture, o)->image.last_look[0] == 0);
    assert_int_equal(parse(&o, "texture", "last-look", "5,6,-7", line), EXIT_FINE);
    assert_true(ASKED(texture, o)->image.last_look[0] == 5 && ASKED(texture, o)->image.last_look[2] == -7 &&
                ASKED(texture, o)->image.look[0] == 0 && ASKED(texture, o)->image.last_eye[0] == 0);
    assert_int_equal(parse(&o, "texture", "tint", "0,1,0.25", line), EXIT_FINE);
    assert_true(ASKED(texture, o)->image.tint[0] == 0 && ASKED(texture, o)->image.tint[1] == 1 &&
                ASKED(texture, o)->image.tint[2] == 0.25 && ASKED(texture, o)->image.tint[3] == 1);
    assert_int_equal(parse(&o, "texture", "tint", "0,1,0.25,0.5", line), EXIT_FINE);
    assert_true(ASKED(texture, o)->image.tint[3] == 0.5);
    assert_int_equal(parse(&o, "texture", "sky", "none", line), EXIT_FINE);
    assert_true(ASKED(texture, o)->image.sky < 0);
    assert_int_equal(parse(&o, "table", "matrix", "[[2, 0, 0, 0], [0, 2, 0, 0], [0, 0, 0, .5], [0, 0, 1, 0]]", line),
                     EXIT_FINE);
    assert_true(ASKED(table, o)->camera.znear == 0.5 && isinf(ASKED(table, o)->camera.zfar) &&
                ASKED(table, o)->camera.mapping_count == 1 &&
                ASKED(table, o)->camera.mappings[0] == DP_MAPPING_REVERSED && !ASKED(table, o)->camera.ortho);
    assert_int_equal(parse(&o, "texture", "intrinsics", "1,1e9,-1e6,0.5", line), EXIT_FINE);
    assert_true(ASKED(texture, o)->camera.intrinsics[0] == 1 && ASKED(texture, o)->camera.intrinsics[1] == 1e9 &&
                ASKED(texture, o)->camera.intrinsics[2] == -1e6 && ASKED(texture, o)->camera.intrinsics[3] == 0.5 &&
                ASKED(texture, o)->camera.spec.fov_y == 60);
    options_release(&o);
}

/* By place, by name in any order, by a data sheet and what it does not say. */
TEST(test_disparity) {
    static const struct {
        const char *words;
        double numbers[4]; /* focal, baseline, offset, step */
    } rows[] = {{"700,0.12", {700, 0.12, 0, 1}},
                {"700,12cm,-1.5,1/16", {700, 0.12, -1.5, 0.0625}},
                {"step=-1/8,baseline=75mm,focal=580", {580, 0.075, 0, -0.125}},
                {"700,0.12,step=4/3", {700, 0.12, 0, 4.0 / 3}},
                {"oak-d", {882.5, 0.075, 0, 1}},
                {"OAK-D,step=1/8,focal=800", {800, 0.075, 0, 0.125}}};
    static const char *const wrong[] = {
        "",       "700",      "700,",        "zed2",        "700,0.1,0,1,2", "700,0.1,0,1/0",
        "0,0.1",  "700,-0.1", "700,0.1,inf", "focal=,1",    "700,0.1,step=", "baseline=1",
        "700,1q", "700,1,,1", "700,oak-d",   "oak-d,oak-d", "700,0.1,1e7",   "700,0.1,0,1e-9"};
    char line[1024] = "";
    asked_line o = {.request = NULL};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        assert_int_equal(parse(&o, "texture a.npy", "stereo", rows[i].words, line), EXIT_FINE);
        assert_true(near_to(ASKED(texture, o)->image.stereo.focal, rows[i].numbers[0]) &&
                    near_to(ASKED(texture, o)->image.stereo.step, rows[i].numbers[3]));
        assert_true(near_to(ASKED(texture, o)->image.stereo.baseline, rows[i].numbers[1]) &&
                    ASKED(texture, o)->image.stereo.offset == rows[i].numbers[2]);
        assert_true(ASKED(texture, o)->image.metric == 1);
        options_release(&o);
    }
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        assert_int_equal(parse(&o, "texture a.npy", "stereo", wrong[i], line), EXIT_USAGE);
        assert_non_null(strstr(line, "depthprec: --stereo: "));
        options_release(&o);
    }
}

TEST(test_own) {
    char line[1024] = "";
    asked_line o = {.request = NULL};
    assert_int_equal(parse(&o, "table", "far", "inf", line), EXIT_FINE);
    assert_true(isinf(ASKED(table, o)->camera.zfar) && ASKED(table, o)->camera.format_count == 4 &&
                ASKED(table, o)->camera.mapping_count == 2 && near_to(ASKED(table, o)->camera.tolerance, 0.05));
    assert_int_equal(parse(&o, "table", "format", "fp16,D24,depth24plus,unorm7", line), EXIT_FINE);
    assert_true(ASKED(table, o)->camera.zfar == 1000 &&
                ASKED(table, o)->camera.format_count == 4); /* the unorm24 of depth24plus is there already */
    assert_string_equal(ASKED(table, o)->camera.formats[2].name, "fp32");
    assert_int_equal(parse(&o, "table", "mapping", "log,d3d,reversed,gl", line), EXIT_FINE);
    assert_true(ASKED(table, o)->camera.mapping_count == 4 && ASKED(table, o)->camera.mappings[0] == DP_MAPPING_LOG &&
                ASKED(table, o)->camera.mappings[3] == DP_MAPPING_GL);
    assert_int_equal(parse(&o, "prepass", "against", "fma,ONCE,fma", line), EXIT_FINE);
    assert_true(ASKED(prepass, o)->against_count == 2 && strcmp(ASKED(prepass, o)->against[0]->name, "fma") == 0 &&
                ASKED(prepass, o)->against[1] == ASKED(prepass, o)->program);
    assert_int_equal(parse(&o, "prepass", "against", "pairs,all", line), EXIT_FINE);
    assert_true(strcmp(ASKED(prepass, o)->against[0]->name, "pairs") == 0 &&
                ASKED(prepass, o)->against[1] == vertex_program_get(0));
    assert_true(vertex_program_get(ASKED(prepass, o)->against_count - 1) != NULL &&
                vertex_program_get(ASKED(prepass, o)->against_count) == NULL);
    const stored_asked *stored;
    assert_int_equal(parse(&o, "prepass", "prepass-format", "D16,unorm16,depth24plus", line), EXIT_FINE);
    stored = &ASKED(prepass, o)->stored;
    assert_true(stored->count == 3 && stored->cases[0].format.bits == 16 && stored->cases[2].way == NULL);
    assert_string_equal(stored->cases[1].name, "unorm24");
    assert_int_equal(parse(&o, "prepass", "resolve", "max:16,all", line), EXIT_FINE);
    stored = &ASKED(prepass, o)->stored;
    assert_true(stored->count == 5 && stored->cases[0].samples == 16 && stored->cases[1].samples == 4 &&
                stored->cases[4].way == resolve_sampled_find("sample0"));
    assert_int_equal(parse(&o, "prepass", "half", "Corner,one", line), EXIT_FINE);
    stored = &ASKED(prepass, o)->stored;
    assert_true(stored->count == 1 && stored->cases[0].way == resolve_halved_find("one"));
    assert_int_equal(parse(&o, "scene m.obj", "also", "Thin,facing", line), EXIT_FINE);
    assert_int_equal(ASKED(scene, o)->scene.filters_off, 1U << FINDER_THIN | 1U << FINDER_FACING);
    assert_int_equal(parse(&o, "scene m.obj", "also", "all", line), EXIT_FINE);
    assert_int_equal(ASKED(scene, o)->scene.filters_off, (1U << FINDER_FILTERS) - 1);
    assert_int_equal(parse(&o, "scene m.obj", "separation", "0", line), EXIT_FINE);
    assert_true(ASKED(scene, o)->scene.separation == 0.0 && option_given(&o, "separation"));
    assert_int_equal(parse(&o, "zfight", "separation", "0", line), EXIT_USAGE);
    assert_int_equal(parse(&o, "table", "tolerance", "3%", line), EXIT_FINE);
    assert_true(near_to(ASKED(table, o)->camera.tolerance, 0.03));
    assert_int_equal(parse(&o, "table", "at", "3,1,2", line), EXIT_FINE);
    assert_true(ASKED(table, o)->camera.at.count == 3 && ASKED(table, o)->camera.at.lo == 1 &&
                ASKED(table, o)->camera.at.hi == 3);
    options_release(&o);
    assert_int_equal(parse(&o, "table", "range", "2:5", line), EXIT_FINE);
    assert_true(ASKED(table, o)->camera.range_lo == 2 && ASKED(table, o)->camera.range_hi == 5);
    options_release(&o);
}

TEST(test_own_of_images) {
    char line[1024] = "";
    asked_line o = {.request = NULL};
    assert_int_equal(parse(&o, "texture", "size", "65536x1", line), EXIT_FINE);
    assert_true(ASKED(texture, o)->image.size[0] == 65536 && ASKED(texture, o)->image.size[1] == 1 &&
                ASKED(texture, o)->image.eye[0] == 0);
    assert_int_equal(parse(&o, "shadow", "size", "1024", line), EXIT_FINE);
    assert_true(ASKED(shadow, o)->shadow.size[0] == 1024 && ASKED(shadow, o)->shadow.size[1] == 1024 &&
                ASKED(shadow, o)->shadow.light_box[0] == 0);
    assert_int_equal(parse(&o, "shadow", "size", "512x256", line), EXIT_FINE);
    assert_true(ASKED(shadow, o)->shadow.size[0] == 512 && ASKED(shadow, o)->shadow.size[1] == 256);
    assert_int_equal(parse(&o, "shadow", "light-box", "10x20.5x1e3", line), EXIT_FINE);
    assert_true(ASKED(shadow, o)->shadow.light_box[0] == 10 && ASKED(shadow, o)->shadow.light_box[1] == 20.5 &&
                ASKED(shadow, o)->shadow.light_box[2] == 1e3);
    assert_int_equal(parse(&o, "shadow", "light-box", "10mx50cmx1km", line), EXIT_FINE);
    assert_true(ASKED(shadow, o)->shadow.light_box[0] == 10 && ASKED(shadow, o)->shadow.light_box[1] == 0.5 &&
                ASKED(shadow, o)->shadow.light_box[2] == 1000);
    assert_int_equal(parse(&o, "texture", "parameter", "gap=0.5", line), EXIT_FINE);
    assert_true(ASKED(texture, o)->image.parameter_count == 1 && ASKED(texture, o)->image.parameters[0].value == 0.5);
    assert_int_equal(parse(&o, "plot interval", "axes", "1:10,0.5:1e3", line), EXIT_FINE);
    assert_true(ASKED(plot, o)->figure.axes[0] == 1 && ASKED(plot, o)->figure.axes[1] == 10 &&
                ASKED(plot, o)->figure.axes[2] == 0.5 && ASKED(plot, o)->figure.axes[3] == 1e3);
    assert_int_equal(parse(&o, "plot interval", "beside", "-n 5", line), EXIT_FINE);
    assert_string_equal(ASKED(plot, o)->figure.beside, "-n 5");
    assert_int_equal(parse(&o, "methods linearize", "mine", "a.glsl:f", line), EXIT_FINE);
    assert_true(ASKED(methods, o)->judge.mine_count == 1 && strcmp(ASKED(methods, o)->judge.mine[0], "a.glsl:f") == 0);
    assert_int_equal(parse(&o, "table", "unit", "cm", line), EXIT_FINE);
    assert_true(strcmp(ASKED(table, o)->camera.lengths.unit->name, "cm") == 0 && ASKED(table, o)->camera.znear == 0.1);
    assert_int_equal(parse(&o, "table", "csv", NULL, line), EXIT_FINE);
    assert_true(ASKED(table, o)->out.form == FORM_CSV);
    assert_int_equal(parse(&o, "list", "json", NULL, line), EXIT_FINE);
    assert_true(ASKED(list, o)->out.form == FORM_JSON);
    assert_int_equal(parse(&o, "list", "version", NULL, line), EXIT_FINE);
    assert_true(o.version);
    assert_int_equal(parse(&o, "plot", "help", NULL, line), EXIT_FINE);
    assert_true(strcmp(o.command->name, "help") == 0 &&
                strcmp(((const command_row *)o.operand_row)->name, "plot") == 0);
    options_release(&o);
}

/* View, grid and class, and the vertical angle that follows. */
TEST(test_slanted) {
    char line[1024] = "";
    asked_line o = {.request = NULL};
    assert_int_equal(parse(&o, "table", "viewport", "32768x7", line), EXIT_FINE);
    assert_true(ASKED(table, o)->camera.triangles.width == 32768 && ASKED(table, o)->camera.triangles.height == 7 &&
                ASKED(table, o)->camera.triangles.subpixel == 8);
    assert_true(ASKED(table, o)->camera.triangles.fov_y == 60 && ASKED(table, o)->camera.triangles.slant_lo == 0 &&
                ASKED(table, o)->camera.triangles.slant_hi == 90);
    assert_true(ASKED(table, o)->camera.triangles.depth == 2 && ASKED(table, o)->camera.triangles.pixels == 512 &&
                ASKED(table, o)->camera.triangles.slim == 16);
    assert_int_equal(parse(&o, "table", "slant", "0.5:80", line), EXIT_FINE);
    assert_true(ASKED(table, o)->camera.triangles.slant_lo == 0.5 && ASKED(table, o)->camera.triangles.slant_hi == 80);
    assert_int_equal(parse(&o, "zfight", "slant", "30.5,-360", line), EXIT_FINE);
    assert_true(ASKED(zfight, o)->camera.triangles.slant_lo == 30.5 &&
                ASKED(zfight, o)->camera.triangles.slant_hi == 30.5 && ASKED(zfight, o)->camera.azimuth == -360);
    assert_int_equal(parse(&o, "zfight", "rasterize", NULL, line), EXIT_FINE);
    assert_true(isnan(ASKED(zfight, o)->camera.azimuth) && ASKED(zfight, o)->camera.triangles.width == 1920 &&
                ASKED(zfight, o)->camera.triangles.height == 1080 && ASKED(zfight, o)->camera.format_count == 1);
    assert_string_equal(ASKED(zfight, o)->camera.raster->name, "llvmpipe");
    options_release(&o);
    assert_int_equal(options_parse(&o, 3, (char *[]){"depthprec", "plot", "fight", NULL}), EXIT_FINE);
    assert_int_equal(view_drawn(&((plot_request *)o.request)->camera), EXIT_FINE);
    assert_int_equal(ASKED(plot, o)->camera.format_count, 3); /* of all four those that it has */
    assert_int_equal(parse(&o, "table", "triangle-class", "slim=4,depth=3,pixels=20", line), EXIT_FINE);
    assert_true(ASKED(table, o)->camera.triangles.depth == 3 && ASKED(table, o)->camera.triangles.pixels == 20 &&
                ASKED(table, o)->camera.triangles.slim == 4);
    assert_int_equal(parse(&o, "table", "triangle-class", "pixels=20", line), EXIT_FINE);
    assert_true(ASKED(table, o)->camera.triangles.depth == 2 && ASKED(table, o)->camera.triangles.pixels == 20 &&
                ASKED(table, o)->camera.triangles.slim == 16);
    assert_int_equal(parse(&o, "budget", "hfov", "90", line), EXIT_FINE);
    assert_relative(ASKED(budget, o)->camera.triangles.fov_y, 2 * atan(0.75) * 180 / 3.14159265358979323846, 1e-14);
    assert_int_equal(parse(&o, "budget", "quiet", NULL, line), EXIT_FINE);
    assert_int_equal(ASKED(budget, o)->camera.triangles.width, 0);
    options_release(&o);
}

TEST(test_no_slants) {
    static const char *const viewports[] = {"0x5", "5x0", "32769x1", "1x32769", "5", "5x", "x5", "5x5x5", "-1x5", ""};
    static const char *const slants[] = {"5", "5:4", "-1:5", "0:91", ":", "x:5", "5:x", ""};
    static const char *const planes[] = {"91,0", "-1,0", "5,361", "5,-361", "x,0", "5,"};
    static const char *const classes[] = {"",
                                          "depth",
                                          "depth=0.5",
                                          "depth=1e7",
                                          "pixels=0",
                                          "slim=1.9",
                                          "slim=1025",
                                          "width=5",
                                          "depth=2,",
                                          "depth=nan",
                                          "pixels=1e6",
                                          "depth=2;slim=4",
                                          "depth=2,slim=4,depth=3"};
    tally t = {.name = "slanted"};
    for (size_t i = 0; i < sizeof viewports / sizeof viewports[0]; i++)
        refused(&t, "table", "viewport", viewports[i], "WIDTHxHEIGHT, each from 1 to 32768 pixels");
    for (size_t i = 0; i < sizeof slants / sizeof slants[0]; i++)
        refused(&t, "table", "slant", slants[i], "LO:HI, from 0 to 90 degrees");
    for (size_t i = 0; i < 2; i++)
        refused(&t, "table", "depth-range", i == 0 ? "0.5" : "0:x", "LO:HI, two window depths from 0 to 1");
    for (size_t i = 0; i < sizeof planes / sizeof planes[0]; i++)
        refused(&t, "zfight", "slant", planes[i], "SLANT,AZIMUTH, from 0 to 90 and from -360 to 360 degrees");
    for (size_t i = 0; i < sizeof classes / sizeof classes[0]; i++)
        refused(&t, "table", "triangle-class", classes[i],
                "depth=K from 1 to 1e6, pixels=P from 1 to 65536 and slim=Q from 2 to 1024, each at most once, "
                "separated by "
                "commas");
    tally_end(&t);
}

TEST(test_pairs) {
    static const char *const splits[] = {"0", "9", "x", "", "4:", "4:-0.1", "4:1.1", "4:x", ":0.5", "4.5", "1e1", "-1"};
    static const char *const figures[] = {"319", "8193", "320x", "320x199", "320x8193", "x200", "", "320x200x2", "-5"};
    static const char *const bends[] = {"0", "2e18", "x", "", "5:", "5:-1", "5:2e18", "5:x", ":1", "inf", "nan"};
    tally t = {.name = "pairs"};
    char line[1024] = "";
    asked_line o = {.request = NULL};
    assert_int_equal(parse(&o, "shadow", "cascades", "8", line), EXIT_FINE);
    assert_true(ASKED(shadow, o)->shadow.cascades == 8 && ASKED(shadow, o)->shadow.lambda == 0.5);
    assert_int_equal(parse(&o, "shadow", "cascades", "1:0", line), EXIT_FINE);
    assert_true(ASKED(shadow, o)->shadow.cascades == 1 && ASKED(shadow, o)->shadow.lambda == 0);
    assert_int_equal(parse(&o, "shadow", "curvature", "1e-12", line), EXIT_FINE);
    assert_true(ASKED(shadow, o)->shadow.curvature == 1e-12 && ASKED(shadow, o)->shadow.facet == 0);
    assert_int_equal(parse(&o, "shadow", "curvature", "5m:2cm", line), EXIT_FINE);
    assert_true(ASKED(shadow, o)->shadow.curvature == 5 && ASKED(shadow, o)->shadow.facet == 0.02);
    assert_int_equal(parse(&o, "shadow", "quiet", NULL, line), EXIT_FINE);
    assert_true(ASKED(shadow, o)->shadow.cascades == 4 && ASKED(shadow, o)->shadow.lambda == 0.5 &&
                isnan(ASKED(shadow, o)->shadow.curvature) && ASKED(shadow, o)->shadow.facet == 0);
    assert_int_equal(parse(&o, "texture", "figure-size", "320x8192", line), EXIT_FINE);
    assert_true(ASKED(texture, o)->figure.width == 320 && ASKED(texture, o)->figure.height == 8192);
    assert_int_equal(parse(&o, "texture", "figure-size", "8192", line), EXIT_FINE);
    assert_true(ASKED(texture, o)->figure.width == 8192 && ASKED(texture, o)->figure.height == 0);
    for (size_t i = 0; i < sizeof figures / sizeof figures[0]; i++)
        refused(&t, "texture", "figure-size", figures[i], "W or WxH, W from 320 to 8192 and H from 200 to 8192 pixels");
    for (size_t i = 0; i < sizeof splits / sizeof splits[0]; i++)
        refused(&t, "shadow", "cascades", splits[i], "N or N:LAMBDA, N a whole number from 1 to 8, LAMBDA from 0 to 1");
    for (size_t i = 0; i < sizeof bends / sizeof bends[0]; i++)
        refused(&t, "shadow", "curvature", bends[i], "Z or Z:FACET, Z from 1e-12 and FACET from 0 to 1e18 scene units");
    tally_end(&t);
    options_release(&o);
}

TEST(test_define) {
    static const char *const wrong[] = {"", "a", "a=", "=near", "a=nearer", "a=1x", "a=nan"};
    static const char said[] = "NAME=near, far, z_buffer_params, projection or another word of the help, or a number";
    tally t = {.name = "define"};
    char line[1024] = "";
    asked_line o = {.request = NULL};
    assert_int_equal(parse(&o, "judge", "define", "uNear=near", line), EXIT_FINE);
    assert_true(ASKED(judge, o)->judge.define_count == 1 &&
                strcmp(ASKED(judge, o)->judge.defines[0], "uNear=near") == 0);
    assert_int_equal(parse(&o, "judge", "define", "u=-1.5e3", line), EXIT_FINE);
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++)
        refused(&t, "judge", "define", wrong[i], said);
    tally_end(&t);
    options_release(&o);
}

TEST(test_behind_colons) {
    static const char *const cameras[] = {"", "d24", "d24:", ":d3d", "all:d3d", "d24:linear", "d24:d3d,gl"};
    static const char *const far[] = {"d24:d3d:x", "d24:d3d:nan", "d24:d3d:1:2"};
    static const char *const levels[] = {"", "x", "17", "-1", "1.5", ":nearest", "2:middle", "2:unorm32", "2:all"};
    tally t = {.name = "behind colons"};
    char line[1024] = "";
    asked_line o = {.request = NULL};
    assert_int_equal(parse(&o, "shadow", "camera-depth", "d24:reversed", line), EXIT_FINE);
    assert_string_equal(ASKED(shadow, o)->shadow.camera.format.name, "unorm24");
    assert_true(ASKED(shadow, o)->shadow.camera.mapping == DP_MAPPING_REVERSED &&
                ASKED(shadow, o)->shadow.camera.zfar == 0 && ASKED(shadow, o)->camera.zfar == 1000);
    assert_int_equal(parse(&o, "shadow", "camera-depth", "fp32:gl:2km", line), EXIT_FINE);
    assert_true(ASKED(shadow, o)->shadow.camera.mapping == DP_MAPPING_GL &&
                ASKED(shadow, o)->shadow.camera.zfar == 2000 && ASKED(shadow, o)->camera.zfar == 1000);
    assert_int_equal(parse(&o, "texture", "hi-z", "16:d16:nearest", line), EXIT_FINE);
    assert_string_equal(ASKED(texture, o)->image.hi_z_format.name, "unorm16");
    assert_true(ASKED(texture, o)->image.hi_z == 16 && ASKED(texture, o)->image.hi_z_nearest);
    assert_int_equal(parse(&o, "texture", "hi-z", "0", line), EXIT_FINE);
    assert_true(ASKED(texture, o)->image.hi_z == 0 && !ASKED(texture, o)->image.hi_z_nearest &&
                ASKED(texture, o)->image.hi_z_format.bits == 0);
    for (size_t i = 0; i < sizeof cameras / sizeof cameras[0]; i++)
        refused(&t, "shadow", "camera-depth", cameras[i],
                "FORMAT:MAPPING[:FAR], MAPPING one of d3d, gl, reversed, gl-reversed");
    for (size_t i = 0; i < sizeof far / sizeof far[0]; i++)
        TALLY(&t, parse(&o, "shadow", "camera-depth", far[i], line) == EXIT_USAGE, "%s", far[i]);
    for (size_t i = 0; i < sizeof levels / sizeof levels[0]; i++)
        refused(&t, "texture", "hi-z", levels[i],
                "LEVEL, 0 to 16, and may have :nearest and :FORMAT, up to 31 bits, behind it");
    tally_end(&t);
    options_release(&o);
}

/* 65 formats are refused: nothing that was asked for is left out. */
TEST(test_formats) {
    char all[2048] = "unorm1";
    for (int bits = 2; bits <= 32; bits++)
        snprintf(all + strlen(all), sizeof all - strlen(all), ",unorm%d", bits);
    for (int bits = 1; bits <= 33; bits++)
        snprintf(all + strlen(all), sizeof all - strlen(all), ",float%d.%d", bits <= 22 ? 5 : 6, (bits - 1) % 22 + 1);
    for (int k = 0; k < 2; k++) {
        char *argv[] = {(char[]){"depthprec"}, (char[]){"table"}, (char[]){"-F"}, all, NULL};
        asked_line o = {.request = NULL};
        char said[1024];
        assert_int_equal(parsed(&o, 4, argv, said), k == 0 ? EXIT_USAGE : EXIT_FINE);
        if (k == 0)
            assert_non_null(strstr(said, "--format: must be at most 64 formats, got 'float6.11' too"));
        assert_true(k == 0 || ASKED(shadow, o)->camera.format_count == CAMERA_FORMATS_MAX);
        *strrchr(all, ',') = '\0';
    }
}

/* Rows of one name stand side by side, and are one option to who types it. */
TEST(test_all) {
    tally t = {.name = "all"};
    const option_row *all[OPTIONS_MAX + 1];
    options_all(all);
    for (size_t i = 0; all[i] != NULL; i++) {
        const option_row *row = all[i];
        size_t k = 0;
        while (tried[k] != NULL && strcmp(tried[k], row->name) != 0)
            k++;
        TALLY(&t, tried[k] != NULL, "--%s is not in a table of this test", row->name);
        char takers[OPTION_TEXT_SIZE];
        TALLY(&t, option_takers(row->name, takers)[0] != '\0' && row->help[0] != '\0', "--%s", row->name);
        for (size_t other = 0; other < i; other++) {
            const bool same = strcmp(row->name, all[other]->name) == 0;
            TALLY(&t, !same || strcmp(row->name, all[i - 1]->name) == 0, "--%s is parted", row->name);
            TALLY(&t, same ? row->letter == all[other]->letter : row->letter == 0 || row->letter != all[other]->letter,
                  "--%s: letter", row->name);
        }
    }
    TALLY(&t, t.cases > 1000, "few rows");
    tally_end(&t);
}

/* An option that a rule names has a row, and is refused beside the other, or without one. */
static void check_rules(tally *t, const command_row *v, const option_rule *rule) {
    for (; rule != NULL && rule->option != NULL; rule++) {
        asked_line o = {.command = v, .parts = ~0U};
        char first[64], expected[256], said[1024] = "";
        snprintf(first, sizeof first, "%.*s", (int)strcspn(rule->others, " "), rule->others);
        const bool needs = rule->relation == RULE_NEEDS;
        TALLY(t, option_find(v, rule->option) != NULL && option_find(v, first) != NULL, "%s: --%s beside --%s", v->name,
              rule->option, first);
        option_give(&o, rule->option, "");
        if (!needs)
            option_give(&o, first, "");
        snprintf(expected, sizeof expected, "depthprec: --%s: %s --%s%s\n", rule->option,
                 needs ? "needs" : "conflicts with", first, rule->more != NULL ? rule->more : "");
        FILE *const terminal = stderr;
        stderr = fmemopen(said, sizeof said, "w");
        const int status = option_check_rules(&o);
        fclose(stderr);
        stderr = terminal;
        TALLY(t, status == EXIT_USAGE && strcmp(said, expected) == 0, "%s: '%s', not '%s'", v->name, said, expected);
    }
}

/* The options that a command takes are in its tables; a name is in one of them, or the first is meant; there is room
 * for all. */
TEST(test_tables) {
    tally t = {.name = "tables"};
    const command_row *v;
    for (size_t i = 0; (v = command_get(i)) != NULL; i++) {
        size_t count = 0;
        TALLY(&t, v->request >= sizeof(asked_line *), "%s: no request", v->name);
        for (const option_place *p = v->places; p->table != NULL; p++)
            for (const option_row *row = p->table->rows; row->name != NULL; row++, count++)
                TALLY(&t, p->at + row->place + row->size <= v->request && option_find(v, row->name) != NULL, "%s: --%s",
                      v->name, row->name);
        TALLY(&t, count < OPTIONS_GIVEN_MAX, "%s: %zu rows", v->name, count);
        for (const option_use *use = v->uses; use->name != NULL || use->rows != NULL || use->group != NULL; use++)
            TALLY(&t, use->name == NULL || option_find(v, use->name) != NULL, "%s: --%s has no row", v->name,
                  use->name);
        check_rules(&t, v, v->rules);
        for (const option_place *p = v->places; p->table != NULL; p++)
            check_rules(&t, v, p->table->rules);
    }
    tally_end(&t);
}

/* Who chose what is refused is told of this line alone, however many were read before it. */
TEST(choosers_are_forgotten) {
    static const char *const presets[] = {"--preset=unity", NULL, "--preset=bevy", "--near=0.1", "--preset=three"};
    for (size_t i = 0; i < sizeof presets / sizeof presets[0]; i++) {
        asked_line o = {.request = NULL};
        char line[1024] = "", said[1024] = "", word[32] = "", want[64];
        char *argv[4] = {(char[]){"depthprec"}, (char[]){"table"}, word};
        snprintf(word, sizeof word, "%s", presets[i] != NULL ? presets[i] : "");
        assert_int_equal(parsed(&o, presets[i] != NULL ? 3 : 2, argv, line), EXIT_FINE);
        FILE *terminal = stderr;
        stderr = fmemopen(said, sizeof said, "w");
        option_error("far", "must be another");
        fclose(stderr);
        stderr = terminal;
        options_release(&o);
        const char *name = strncmp(word, "--preset=", 9) == 0 ? word + 9 : NULL;
        snprintf(want, sizeof want, name != NULL ? "must be another; --preset %s chose it\n" : "must be another\n",
                 name);
        if (strstr(said, want) == NULL)
            fail_msg("line %zu: '%s', not '%s'", i, said, want);
    }
}
