/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Every row of the option table: what it takes and where that goes, by values written down here; what it refuses; its
 * default. The languages of lists, depths and sizes are tried in cli/errors.txt.
 */
#include "cli/option/uses.h"
#include "code/language.h"
#include "parsed.h"
#include "scene/find.h"
#include "support.h"

static bool tried[OPTION_COUNT];

/* One option behind a command, and its operand; `line` is what was said on stderr, without its line feed. */
static int parse(options *o, const char *command, option_id id, const char *value, char line[1024]) {
    char words[32], name[64], given[128], viewport[] = "--viewport=64x48";
    const bool slants = id == OPTION_HFOV || id == OPTION_RASTER || id == OPTION_SUBPIXEL || id == OPTION_SLANT ||
                        id == OPTION_TRIANGLE_CLASS;
    snprintf(words, sizeof words, "%s", command);
    snprintf(name, sizeof name, "--%s", option_name(id));
    snprintf(given, sizeof given, "%s", value != NULL ? value : "");
    char *const operand = strchr(words, ' ');
    char *argv[7] = {(char[]){"depthprec"}, words, name};
    int argc = 3;
    if (value != NULL)
        argv[argc++] = given;
    if (slants)
        argv[argc++] = viewport;
    if (operand != NULL) {
        argv[argc++] = operand + 1;
        *operand = '\0';
    }
    tried[id] = true;
    return parsed(o, argc, argv, line);
}

static void refused(tally *t, const char *command, option_id id, const char *value, const char *said) {
    char line[1024] = "", expected[1024];
    options o;
    const int status = parse(&o, command, id, value, line);
    options_release(&o);
    snprintf(expected, sizeof expected, "depthprec: --%s: must be %s, got '%s'", option_name(id), said, value);
    TALLY(t, status == EXIT_USAGE, "--%s %s: status %d", option_name(id), value, status);
    TALLY(t, strncmp(line, expected, strlen(expected)) == 0, "'%s', not '%s'", line, expected);
}

/* ---- Numbers ----------------------------------------------------------------------------------------------------- */

#define AT(member) offsetof(options, member)

static const struct {
    const char *command;
    option_id id;
    size_t field;
    double standard, least, most;
    const char *least_text, *most_text, *below, *above, *said;
} numbers[] = {
    {"table", OPTION_NEAR, AT(camera.znear), 0.1, 1e-12, 1e12, "1e-12", "1e12", "9.9e-13", "1.0001e12",
     "a number from 1e-12 to 1e12 scene units"},
    {"table", OPTION_LOG_C, AT(camera.log_c), 1, 1e-12, 1e12, "1e-12", "1e12", "0", "2e12",
     "a number from 1e-12 to 1e12"},
    {"budget", OPTION_INTERPOLATION, AT(world.terms.interpolation), 0, 0, 16777216, "0", "16777216", "-1", "16777217",
     "a number from 0 to 16777216 units of 2^-24"},
    {"budget", OPTION_FROM_ORIGIN, AT(world.terms.world), 0, 0, 1e18, "0", "1e18", "-1e-9", "1.1e18",
     "a number from 0 to 1e18 scene units"},
    {"bias", OPTION_UNITS, AT(bias.units), 0, -1e12, 1e12, "-1e12", "1e12", "-2e12", "2e12",
     "a number from -1e12 to 1e12"},
    {"bias", OPTION_FACTOR, AT(bias.factor), 0, -1e12, 1e12, "-1e12", "1e12", "-2e12", "2e12",
     "a number from -1e12 to 1e12"},
    {"bias", OPTION_CLAMP, AT(bias.clamp), 0, -1e12, 1e12, "-1e12", "1e12", "-2e12", "2e12",
     "a number from -1e12 to 1e12"},
    {"bias", OPTION_SLOPE, AT(bias.slope), 0, 0, 1e12, "0", "1e12", "-1", "2e12",
     "a number from 0 to 1e12 scene units per pixel"},
    {"texture", OPTION_FOV, AT(view.spec.fov_y), 60, 0.01, 179, "0.01", "179", "0", "180",
     "a number from 0.01 to 179 degrees"},
    {"budget", OPTION_HFOV, AT(camera.fov_x), 0, 0.01, 179, "0.01", "179", "0", "180",
     "a number from 0.01 to 179 degrees"},
    {"shadow", OPTION_ANGLE, AT(angle), 75, 0, 89.9, "0", "89.9", "-1", "89.91", "a number from 0 to 89.9 degrees"},
    {"shadow", OPTION_CASTERS, AT(shadow.casters), 100, 0, 1e12, "0", "1e12", "-1", "2e12",
     "a number from 0 to 1e12 scene units"},
    {"texture", OPTION_SKY, AT(image.sky), 1e-4, 0, 0.5, "0", "0.5", "-0.1", "0.6", "a number from 0 to 0.5, or none"},
    {"texture", OPTION_METRIC, AT(image.metric), 0, 1e-9, 1e6, "1e-9", "1e6", "0", "1e7",
     "a number from 1e-9 to 1e6 scene units, mm, tum or kitti"},
};

static double number_at(const options *o, size_t field) {
    double number;
    memcpy(&number, (const char *)o + field, sizeof number);
    return number;
}

static void taken(tally *t, const char *command, option_id id, const char *value, size_t field, double expected) {
    char line[1024] = "";
    options o;
    const int status = parse(&o, command, id, value, line);
    TALLY(t, status == EXIT_FINE && option_given(&o, id), "--%s %s: status %d, %s", option_name(id), value, status,
          line);
    TALLY(t, number_at(&o, field) == expected, "--%s %s: %.17g", option_name(id), value, number_at(&o, field));
    options_release(&o);
}

TEST(test_numbers) {
    tally t = {.name = "numbers"};
    options o;
    char line[1024] = "";
    assert_int_equal(parse(&o, "table", OPTION_QUIET, NULL, line), EXIT_FINE);
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        taken(&t, numbers[i].command, numbers[i].id, numbers[i].least_text, numbers[i].field, numbers[i].least);
        taken(&t, numbers[i].command, numbers[i].id, numbers[i].most_text, numbers[i].field, numbers[i].most);
        const char *const wrong[] = {numbers[i].below, numbers[i].above, "x", "", "nan", "1e999", "inf", "5 "};
        for (size_t k = 0; k < sizeof wrong / sizeof wrong[0]; k++)
            if (numbers[i].id != OPTION_UNITS || strcmp(wrong[k], "inf") != 0)
                refused(&t, numbers[i].command, numbers[i].id, wrong[k], numbers[i].said);
        const double standard = number_at(&o, numbers[i].field);
        TALLY(&t, standard == numbers[i].standard || (isnan(standard) && isnan(numbers[i].standard)),
              "--%s: default %g", option_name(numbers[i].id), standard);
    }
    taken(&t, "bias", OPTION_UNITS, "inf", AT(bias.units), INFINITY);
    taken(&t, "bias", OPTION_UNITS, "-Infinity", AT(bias.units), -INFINITY);
    refused(&t, "bias", OPTION_FACTOR, "inf", "a number from -1e12 to 1e12");
    tally_end(&t);
}

/* Lengths: positive, and nothing when not given. */
TEST(test_lengths) {
    static const struct {
        const char *command;
        option_id id;
        size_t field;
    } lengths[] = {{"solve", OPTION_SEPARATION, AT(wanted.separation)},
                   {"solve", OPTION_ERROR, AT(wanted.error)},
                   {"bias", OPTION_SEPARATION, AT(wanted.separation)},
                   {"scene m.obj", OPTION_WITHIN, AT(scene.within)},
                   {"texture", OPTION_OVERLAY, AT(image.overlay)}};
    tally t = {.name = "lengths"};
    for (size_t i = 0; i < sizeof lengths / sizeof lengths[0]; i++) {
        taken(&t, lengths[i].command, lengths[i].id, "5e-324", lengths[i].field, 5e-324);
        taken(&t, lengths[i].command, lengths[i].id, "1e300", lengths[i].field, 1e300);
        refused(&t, lengths[i].command, lengths[i].id, "0", "a positive number of scene units");
        refused(&t, lengths[i].command, lengths[i].id, "-1", "a positive number of scene units");
        refused(&t, lengths[i].command, lengths[i].id, "inf", "a positive number of scene units");
    }
    tally_end(&t);
}

/* ---- Whole numbers ----------------------------------------------------------------------------------------------- */

TEST(test_whole) {
    static const struct {
        const char *command;
        option_id id;
        uint64_t least, most;
        const char *least_text, *most_text, *below, *above, *said;
    } wholes[] = {
        {"zfight", OPTION_SAMPLE, 1, 1000000000000, "1", "1000000000000", "0", "1000000000001",
         "a whole number from 1 to 1000000000000"},
        {"zfight", OPTION_SEED, 0, 9007199254740992, "0", "9007199254740992", "-1", "9007199254740993",
         "a whole number from 0 to 9007199254740992"},
        {"check", OPTION_THREADS, 1, 1024, "1", "1024", "0", "1025", "a whole number from 1 to 1024"},
        {"budget", OPTION_SUBPIXEL, 1, 8, "1", "8", "0", "9", "a whole number from 1 to 8 bits"},
        {"shadow", OPTION_KERNEL, 1, 64, "1", "64", "0", "65", "a whole number from 1 to 64 texels"},
        {"judge", OPTION_PAIRS_FOR, 8, 1000000, "8", "1000000", "7", "1000001", "a whole number from 8 to 1000000"},
    };
    tally t = {.name = "whole"};
    for (size_t i = 0; i < sizeof wholes / sizeof wholes[0]; i++) {
        const char *const wrong[] = {wholes[i].below, wholes[i].above, "", "1e3", "+5", " 5", "5.0", "0x10"};
        for (size_t k = 0; k < sizeof wrong / sizeof wrong[0]; k++)
            refused(&t, wholes[i].command, wholes[i].id, wrong[k], wholes[i].said);
        for (int k = 0; k < 2; k++) {
            char line[1024] = "";
            options o;
            parse(&o, wholes[i].command, wholes[i].id, k == 0 ? wholes[i].least_text : wholes[i].most_text, line);
            const uint64_t fields[] = {[0] = o.census.sample,   o.census.seed,
                                       (uint64_t)o.out.threads, (uint64_t)o.camera.triangles.subpixel,
                                       o.shadow.kernel,         o.judge.depths};
            TALLY(&t, fields[i] == (k == 0 ? wholes[i].least : wholes[i].most), "--%s: %llu, %s",
                  option_name(wholes[i].id), (unsigned long long)fields[i], line);
            options_release(&o);
        }
    }
    tally_end(&t);
}

/* ---- Names ------------------------------------------------------------------------------------------------------- */

#define WORD_AT(member) offsetof(options, member), sizeof(((options *)NULL)->member)

static uint64_t word_at(const options *o, size_t field, size_t size) {
    unsigned narrow;
    uint64_t wide;
    memcpy(size == sizeof narrow ? (void *)&narrow : &wide, (const char *)o + field, size);
    return size == sizeof narrow ? narrow : wide;
}

/* Long: its rows are written out, by hand. */
TEST(test_words) {
    static const struct {
        const char *command;
        option_id id;
        size_t field, size;
        const char *said;
        struct {
            const char *word;
            unsigned value;
        } words[10];
    } rows[] = {
        {"table",
         OPTION_ROUNDING,
         WORD_AT(camera.rounding),
         "nearest, even or zero",
         {{"nearest", DP_ROUND_NEAREST}, {"even", DP_ROUND_EVEN}, {"zero", DP_ROUND_ZERO}}},
        {"table",
         OPTION_MODEL,
         WORD_AT(camera.model),
         "exact, staged, float or auto",
         {{"exact", DP_MODEL_EXACT}, {"staged", DP_MODEL_STAGED}, {"float", DP_MODEL_FLOAT}, {"auto", DP_MODEL_EXACT}}},
        {"budget",
         OPTION_COMPOSITION,
         WORD_AT(world.terms.composition),
         "once, products or relative",
         {{"once", DP_COMPOSITION_ONCE}, {"products", DP_COMPOSITION_PRODUCTS}, {"relative", DP_COMPOSITION_RELATIVE}}},
        {"budget",
         OPTION_LOG2,
         WORD_AT(world.terms.log2),
         "vulkan, d3d or rounded",
         {{"vulkan", 0}, {"spirv", 0}, {"webgl", 0}, {"d3d", 1}, {"hlsl", 1}, {"rounded", 2}}},
        {"table",
         OPTION_ARITH,
         WORD_AT(camera.arith),
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
         OPTION_FOR,
         WORD_AT(wanted.target),
         "near, far, format, mapping, separation, distance or frusta",
         {{"near", SOLVE_FOR_NEAR},
          {"far", SOLVE_FOR_FAR},
          {"format", SOLVE_FOR_FORMAT},
          {"mapping", SOLVE_FOR_MAPPING},
          {"separation", SOLVE_FOR_SEPARATION},
          {"distance", SOLVE_FOR_DISTANCE},
          {"frusta", SOLVE_FOR_FRUSTA}}},
        {"plot error", OPTION_TYPE, WORD_AT(figure.type), "svg, pdf or png", {{"svg", 0}, {"pdf", 1}, {"png", 2}}},
        {"list",
         OPTION_COLOR,
         WORD_AT(out.colour),
         "auto, always or never",
         {{"auto", OUTPUT_COLOUR_AUTO}, {"always", OUTPUT_COLOUR_ALWAYS}, {"never", OUTPUT_COLOUR_NEVER}}},
        {"scene m.obj",
         OPTION_TRANSFORMS,
         WORD_AT(scene.transforms),
         "exact or binary32",
         {{"exact", 0}, {"binary32", 1}}},
        {"code",
         OPTION_WHAT,
         WORD_AT(code.what),
         "linearize, projection, encode, position, pack or normal",
         {{"linearize", 0}, {"projection", 1}, {"encode", 2}, {"position", 3}, {"pack", 4}, {"normal", 5}}},
        {"prepass",
         OPTION_VERTICES,
         WORD_AT(census.vertices),
         "eye-log or box",
         {{"eye-log", VERTEX_EYE_LOG}, {"box", VERTEX_BOX}}},
        {"texture",
         OPTION_NORMAL_FORMAT,
         WORD_AT(image.normal_format),
         "opengl or directx",
         {{"opengl", 0}, {"directx", 1}}},
        {"texture",
         OPTION_THEME,
         WORD_AT(figure.theme),
         "light, dark or print",
         {{"light", 0}, {"dark", 1}, {"print", 2}}},
        {"check x",
         OPTION_REPORT,
         WORD_AT(out.report),
         "text, json or junit",
         {{"text", REPORT_TEXT}, {"json", REPORT_JSON}, {"junit", REPORT_JUNIT}}},
    };
    tally t = {.name = "words"};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char line[1024] = "";
        options o;
        for (size_t k = 0; k < 10 && rows[i].words[k].word != NULL; k++) {
            const char *word = rows[i].words[k].word;
            const int status = parse(&o, rows[i].command, rows[i].id, word, line);
            TALLY(&t, status == EXIT_FINE && word_at(&o, rows[i].field, rows[i].size) == rows[i].words[k].value,
                  "--%s %s: %llu, %s", option_name(rows[i].id), word,
                  (unsigned long long)word_at(&o, rows[i].field, rows[i].size), line);
            TALLY(&t, o.camera.model_auto == (rows[i].id == OPTION_MODEL && strcmp(word, "auto") == 0), "--%s %s: auto",
                  option_name(rows[i].id), word);
        }
        refused(&t, rows[i].command, rows[i].id, "", rows[i].said);
        refused(&t, rows[i].command, rows[i].id, "nosuchword", rows[i].said);
        /* The first is the default, but for what is solved for. */
        parse(&o, rows[i].command, OPTION_QUIET, NULL, line);
        const unsigned standard = rows[i].id == OPTION_FOR ? SOLVE_FOR_ANY : rows[i].words[0].value;
        TALLY(&t, word_at(&o, rows[i].field, rows[i].size) == standard, "--%s: default", option_name(rows[i].id));
    }
    tally_end(&t);
}

/* Rows of tables, by their names in the table of this test; other spellings where there are any. */
TEST(test_rows) {
    static const struct {
        const char *command;
        option_id id;
        size_t field;
        const char *given, *name; /* of the row; null: no row */
        size_t name_at;
        const char *near, *meant;
    } rows[] = {
        {"table", OPTION_PRESET, AT(camera.presets), "unreal", "unreal", offsetof(preset, name), "unrael", "unreal"},
        {"table", OPTION_PLATFORM, AT(camera.platform), "SAFARI", "safari", offsetof(platform, name), "safary",
         "safari"},
        {"bias", OPTION_API, AT(bias.api), "Vulkan", "vulkan", offsetof(bias_api, name), "wegbpu", "webgpu"},
        {"bias", OPTION_API, AT(bias.api), "all", NULL, 0, "metall", "metal"},
        {"bias", OPTION_API, AT(bias.api), "direct3d12", "d3d12", offsetof(bias_api, name), "d3d14", "d3d11"},
        {"bias", OPTION_API, AT(bias.api), "gl,d3d12", NULL, 0, "gl,d3d14", "d3d11"},
        {"prepass", OPTION_PROGRAM, AT(census.program), "FMA", "fma", offsetof(vertex_program, name), "separatr",
         "separate"},
        {"table", OPTION_RASTER, AT(camera.raster), "LLVMpipe", "llvmpipe", offsetof(raster_row, name), "lavapip",
         "lavapipe"},
        {"budget", OPTION_RASTER, AT(camera.raster), "spec-gl", "spec-gl", offsetof(raster_row, name), "spec-d3",
         "spec-d3d"},
        {"texture", OPTION_SYNTHETIC, AT(image.synthetic), "steps", "steps", offsetof(synthetic_row, name), "decal",
         "decals"},
        {"texture", OPTION_PRODUCT, AT(image.product), "Linear01", "linear01", offsetof(product_row, name), "radail",
         "radial"},
        {"texture", OPTION_PRODUCT, AT(image.position), "position:rays", "rays", offsetof(position_row, name),
         "position:matirx", "matrix"},
        {"texture", OPTION_PRODUCT, AT(image.position), "position:exact", NULL, 0, "position:exakt", "exact"},
        {"texture", OPTION_PRODUCT, AT(image.position), "position", NULL, 0, "positoin", "position"},
        {"texture", OPTION_PRODUCT, AT(image.normal), "normal:high-1", "high-1", offsetof(normal_row, name),
         "normal:meduim", "medium"},
        {"texture", OPTION_PRODUCT, AT(image.normal), "normal", "projective", offsetof(normal_row, name), "norml",
         "normal"},
        {"texture", OPTION_PRODUCT, AT(image.effect), "effect:Fog", "fog", offsetof(effect_row, name), "effect:edeg",
         "edge"},
        {"code", OPTION_LANGUAGE, AT(code.language), "HLSL", "hlsl", offsetof(code_language, name), "glsk", "glsl"},
        {"texture", OPTION_PACKING, AT(image.packing), "rgb24", "rgb24", offsetof(packing, name), "rgb42", "rgb24"},
    };
    tally t = {.name = "rows"};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char line[1024] = "", meant[64];
        const char *row, *name = NULL;
        options o;
        TALLY(&t, parse(&o, rows[i].command, rows[i].id, rows[i].given, line) == EXIT_FINE, "%s", line);
        memcpy(&row, (const char *)&o + rows[i].field, sizeof row);
        if (row != NULL)
            memcpy(&name, row + rows[i].name_at, sizeof name);
        TALLY(&t, rows[i].name == NULL ? row == NULL : name != NULL && strcmp(name, rows[i].name) == 0, "--%s %s: %s",
              option_name(rows[i].id), rows[i].given, name != NULL ? name : "no row");
        TALLY(&t, parse(&o, rows[i].command, rows[i].id, rows[i].near, line) == EXIT_USAGE, "%s", rows[i].near);
        snprintf(meant, sizeof meant, "; did you mean '%s'?", rows[i].meant);
        TALLY(&t, strstr(line, meant) != NULL, "%s: %s", meant, line);
        parse(&o, rows[i].command, OPTION_QUIET, NULL, line);
        memcpy(&row, (const char *)&o + rows[i].field, sizeof row);
        const bool standard = rows[i].id == OPTION_API || rows[i].id == OPTION_PROGRAM || rows[i].id == OPTION_LANGUAGE;
        TALLY(&t, (row != NULL) == standard, "--%s: default", option_name(rows[i].id));
    }
    tally_end(&t);
}

/* Numbers separated by commas. */
TEST(test_lists) {
    static const struct {
        const char *command;
        option_id id;
        size_t field;
        const char *given;
        size_t count;
        double first, last;
        const char *wrong[4], *said;
    } rows[] = {
        {"table",
         OPTION_DEPTH,
         AT(wanted.looked_up),
         "0.25,0,-0,1",
         4,
         0.25,
         1,
         {"1.0001", "-1e-9", "", "nan"},
         "D[,D...], numbers from 0 to 1"},
        {"table",
         OPTION_CODE,
         AT(wanted.looked_up),
         "0x10,4294967295",
         2,
         16,
         4294967295,
         {"4294967296", "-1", "1.5", "x"},
         "N[,N...], whole numbers from 0 to 4294967295"},
        {"texture",
         OPTION_PIXEL,
         AT(image.pixels),
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
        options o;
        TALLY(&t, parse(&o, rows[i].command, rows[i].id, rows[i].given, line) == EXIT_FINE, "%s", line);
        memcpy(&d, (const char *)&o + rows[i].field, sizeof d);
        TALLY(&t, d.count == rows[i].count && depths_get(&d, 0) == rows[i].first && d.hi == rows[i].last,
              "--%s: %zu, %g", option_name(rows[i].id), d.count, d.hi);
        for (size_t k = 0; k < d.count; k++)
            TALLY(&t, !signbit(depths_get(&d, k)), "--%s: -0", option_name(rows[i].id));
        options_release(&o);
        for (size_t k = 0; k < 4; k++)
            refused(&t, rows[i].command, rows[i].id, rows[i].wrong[k], rows[i].said);
        parse(&o, rows[i].command, OPTION_QUIET, NULL, line);
        memcpy(&d, (const char *)&o + rows[i].field, sizeof d);
        TALLY(&t, d.count == 0, "--%s: default", option_name(rows[i].id));
    }
    tally_end(&t);
}

/* ---- Flags and texts --------------------------------------------------------------------------------------------- */

TEST(test_flags) {
    static const struct {
        const char *command;
        option_id id;
        size_t field, size;
    } flags[] = {{"table", OPTION_ORTHO, WORD_AT(camera.ortho)},
                 {"budget", OPTION_LINEARIZE, WORD_AT(world.terms.linearize)},
                 {"table", OPTION_CONSTANTS, WORD_AT(wanted.constants)},
                 {"zfight", OPTION_RASTERIZE, WORD_AT(census.drawn)},
                 {"texture", OPTION_ERROR_MAP, WORD_AT(image.error_map)},
                 {"list", OPTION_QUIET, WORD_AT(out.quiet)},
                 {"list", OPTION_FULL, WORD_AT(out.full)},
                 {"code", OPTION_UNIFORMS, WORD_AT(code.uniforms)},
                 {"texture", OPTION_RADIAL, WORD_AT(image.radial)},
                 {"list", OPTION_VERSION, WORD_AT(version)}};
    static const char zeros[8];
    tally t = {.name = "flags"};
    for (size_t i = 0; i < sizeof flags / sizeof flags[0]; i++) {
        char line[1024] = "";
        options o;
        parse(&o, "list", OPTION_JSON, NULL, line);
        TALLY(&t, o.out.form == FORM_JSON && memcmp((const char *)&o + flags[i].field, zeros, flags[i].size) == 0,
              "--%s: default", option_name(flags[i].id));
        TALLY(&t, parse(&o, flags[i].command, flags[i].id, NULL, line) == EXIT_FINE, "%s", line);
        const uint64_t value = flags[i].size == 1 ? *((const unsigned char *)&o + flags[i].field)
                                                  : word_at(&o, flags[i].field, flags[i].size);
        TALLY(&t, value == 1, "--%s: %llu", option_name(flags[i].id), (unsigned long long)value);
    }
    tally_end(&t);
}

TEST(test_texts) {
    static const struct {
        const char *command;
        option_id id;
        size_t field;
        bool file;
    } texts[] = {{"texture", OPTION_TITLE, AT(figure.title), false},
                 {"texture", OPTION_CHANNEL, AT(image.channel), false},
                 {"texture", OPTION_LATTICE, AT(image.lattice), false},
                 {"texture", OPTION_AS, AT(image.as), false},
                 {"table", OPTION_OUTPUT, AT(out.file), true},
                 {"texture", OPTION_MATRIX, AT(image.matrix), true},
                 {"texture", OPTION_PICTURE, AT(image.picture), true},
                 {"texture", OPTION_FIGURE, AT(image.figure), true},
                 {"texture", OPTION_HISTOGRAM, AT(image.histogram), true},
                 {"scene m.obj", OPTION_RENDER, AT(scene.render), true},
                 {"probe", OPTION_KEEP, AT(probe.keep), true},
                 {"judge", OPTION_PAIRS, AT(judge.pairs), true},
                 {"probe", OPTION_DEVICE, AT(probe.device), true},
                 {"scene m.obj", OPTION_PATH, AT(scene.path), true},
                 {"scene m.obj", OPTION_CAMERA, AT(scene.camera), false},
                 {"scene m.obj", OPTION_EMIT_NEED, AT(scene.emit_need), true}};
    tally t = {.name = "texts"};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        char line[1024] = "";
        const char *text;
        options o;
        TALLY(&t, (parse(&o, texts[i].command, texts[i].id, "", line) == EXIT_FINE) != texts[i].file, "%s", line);
        TALLY(&t, parse(&o, texts[i].command, texts[i].id, "-n 5, %s", line) == EXIT_FINE, "%s", line);
        memcpy(&text, (const char *)&o + texts[i].field, sizeof text);
        TALLY(&t, text != NULL && text[0] == '-', "--%s", option_name(texts[i].id));
        parse(&o, texts[i].command, OPTION_QUIET, NULL, line);
        memcpy(&text, (const char *)&o + texts[i].field, sizeof text);
        TALLY(&t, text == NULL, "--%s: default", option_name(texts[i].id));
    }
    tally_end(&t);
}

/* An argument that may be left out is written behind "=". */
TEST(test_optional) {
    char line[1024] = "";
    options o;
    assert_int_equal(parse(&o, "texture", OPTION_ERROR_MAP, NULL, line), EXIT_FINE);
    assert_true(o.image.error_map && o.image.error_file == NULL && option_given(&o, OPTION_ERROR_MAP));
    assert_int_equal(options_parse(&o, 3, (char *[]){"depthprec", "texture", "--error-map=a.npy", NULL}), EXIT_FINE);
    assert_true(!o.image.error_map && option_given(&o, OPTION_ERROR_MAP));
    assert_string_equal(o.image.error_file, "a.npy");
    assert_int_equal(options_parse(&o, 4, (char *[]){"depthprec", "texture", "--error-map", "a.npy", NULL}), EXIT_FINE);
    assert_true(o.image.error_map && o.image.error_file == NULL && o.operand_count == 1);
    assert_int_equal(parse(&o, "table", OPTION_LINK, NULL, line), EXIT_FINE);
    assert_string_equal(o.out.link, "depthprec.html");
    assert_int_equal(options_parse(&o, 3, (char *[]){"depthprec", "bias", "--link=a.html", NULL}), EXIT_FINE);
    assert_string_equal(o.out.link, "a.html");
    assert_int_equal(parse(&o, "table", OPTION_QUIET, NULL, line), EXIT_FINE);
    assert_null(o.out.link);
}

/* ---- Languages of their own, and all rows ------------------------------------------------------------------------ */

static bool near_to(double a, double b) {
    return fabs(a - b) <= 1e-15 * fabs(b);
}

TEST(test_boxes) {
    static const char *const boxes[] = {"", "1", "1x2", "1x2x3x4", "0x1x1", "1x-1x1", "1x1xinf", "2e12x1x1", "x1x1"};
    static const char *const sizes[] = {"", "0", "70000", "8x", "x8", "8x0", "1.5"};
    tally t = {.name = "boxes"};
    for (size_t i = 0; i < sizeof boxes / sizeof boxes[0]; i++)
        refused(&t, "shadow", OPTION_LIGHT_BOX, boxes[i], "WxHxD, each from 1e-12 to 1e12");
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++)
        refused(&t, "shadow", OPTION_SIZE, sizes[i],
                strchr(sizes[i], 'x') != NULL ? "WIDTHxHEIGHT, each from 1 to 65536 pixels"
                                              : "N or WIDTHxHEIGHT, each from 1 to 65536 pixels");
    tally_end(&t);
}

TEST(test_worlds) {
    options o;
    char line[1024] = "";
    assert_int_equal(parse(&o, "world", OPTION_FROM_ORIGIN, "8km,200m", line), EXIT_FINE);
    assert_true(o.world.distances.count == 2 && o.world.distances.lo == 200 && o.world.distances.hi == 8000 &&
                o.camera.at.count == 0);
    options_release(&o);
    assert_int_equal(parse(&o, "world", OPTION_SCHEME, "Split:1024,two-sum,split:1024,tile", line), EXIT_FINE);
    assert_true(o.world.scheme_count == 3 && o.world.schemes[0].size == 1024 && o.world.schemes[2].size == 20971.52);
    assert_string_equal(o.world.schemes[1].row->name, "two-sum");
    assert_int_equal(parse(&o, "world", OPTION_SHARE, NULL, line), EXIT_FINE);
    assert_true(o.world.shared_origin && o.world.scheme_count == WORLD_ROWS && o.camera.triangles.width == 1920);
}

/* Where a camera stands and what it looks at, in a model and in a world. */
TEST(test_places) {
    char line[1024] = "";
    options o;
    assert_int_equal(parse(&o, "scene m.obj", OPTION_EYE, "1,-2,3e4", line), EXIT_FINE);
    assert_true(o.view.eye[0] == 1 && o.view.eye[1] == -2 && o.view.eye[2] == 3e4 && o.view.look[0] == 0 &&
                o.camera.triangles.width == 1920);
    assert_int_equal(parse(&o, "scene m.obj", OPTION_LOOK, "-5m,60cm,7m", line), EXIT_FINE);
    assert_true(o.view.look[0] == -5 && o.view.look[1] == 0.6 && o.view.look[2] == 7 && o.view.eye[0] == 0 &&
                o.camera.triangles.width == 0);
    assert_int_equal(parse(&o, "texture", OPTION_EYE, "1,-2,3e4", line), EXIT_FINE);
    assert_true(o.view.eye[0] == 1 && o.view.eye[1] == -2 && o.view.eye[2] == 3e4 && o.camera.triangles.width == 0);
    assert_true(o.view.spec.width == 640 && o.view.spec.height == 360);
    assert_int_equal(parse(&o, "texture", OPTION_LAST_EYE, "5,6,-7", line), EXIT_FINE);
    assert_true(o.view.last_eye[0] == 5 && o.view.last_eye[2] == -7 && o.view.eye[0] == 0 && o.view.last_look[0] == 0);
    assert_int_equal(parse(&o, "texture", OPTION_LAST_LOOK, "5,6,-7", line), EXIT_FINE);
    assert_true(o.view.last_look[0] == 5 && o.view.last_look[2] == -7 && o.view.look[0] == 0 &&
                o.view.last_eye[0] == 0);
    assert_int_equal(parse(&o, "texture", OPTION_TINT, "0,1,0.25", line), EXIT_FINE);
    assert_true(o.image.tint[0] == 0 && o.image.tint[1] == 1 && o.image.tint[2] == 0.25 && o.image.tint[3] == 1);
    assert_int_equal(parse(&o, "texture", OPTION_TINT, "0,1,0.25,0.5", line), EXIT_FINE);
    assert_true(o.image.tint[3] == 0.5);
    assert_int_equal(parse(&o, "texture", OPTION_SKY, "none", line), EXIT_FINE);
    assert_true(o.image.sky < 0);
    assert_int_equal(parse(&o, "texture", OPTION_INTRINSICS, "1,1e9,-1e6,0.5", line), EXIT_FINE);
    assert_true(o.view.intrinsics[0] == 1 && o.view.intrinsics[1] == 1e9 && o.view.intrinsics[2] == -1e6 &&
                o.view.intrinsics[3] == 0.5 && o.view.spec.fov_y == 60);
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
    options o;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        assert_int_equal(parse(&o, "texture a.npy", OPTION_STEREO, rows[i].words, line), EXIT_FINE);
        assert_true(near_to(o.image.stereo.focal, rows[i].numbers[0]) &&
                    near_to(o.image.stereo.step, rows[i].numbers[3]));
        assert_true(near_to(o.image.stereo.baseline, rows[i].numbers[1]) &&
                    o.image.stereo.offset == rows[i].numbers[2]);
        assert_true(o.image.metric == 1);
        options_release(&o);
    }
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        assert_int_equal(parse(&o, "texture a.npy", OPTION_STEREO, wrong[i], line), EXIT_USAGE);
        assert_non_null(strstr(line, "depthprec: --stereo: "));
        options_release(&o);
    }
}

TEST(test_own) {
    char line[1024] = "";
    options o;
    assert_int_equal(parse(&o, "table", OPTION_FAR, "inf", line), EXIT_FINE);
    assert_true(isinf(o.camera.zfar) && o.camera.format_count == 4 && o.camera.mapping_count == 2 &&
                near_to(o.wanted.tolerance, 0.05));
    assert_int_equal(parse(&o, "table", OPTION_FORMAT, "fp16,D24,depth24plus,unorm7", line), EXIT_FINE);
    assert_true(o.camera.zfar == 1000 && o.camera.format_count == 4); /* the unorm24 of depth24plus is there already */
    assert_string_equal(o.camera.formats[2].name, "fp32");
    assert_int_equal(parse(&o, "table", OPTION_MAPPING, "log,all,gl", line), EXIT_FINE);
    assert_true(o.camera.mapping_count == 4 && o.camera.mappings[0] == DP_MAPPING_LOG &&
                o.camera.mappings[3] == DP_MAPPING_GL);
    assert_int_equal(parse(&o, "prepass", OPTION_AGAINST, "fma,ONCE,fma", line), EXIT_FINE);
    assert_true(o.census.against_count == 2 && strcmp(o.census.against[0]->name, "fma") == 0 &&
                o.census.against[1] == o.census.program);
    assert_int_equal(parse(&o, "prepass", OPTION_AGAINST, "pairs,all", line), EXIT_FINE);
    assert_true(strcmp(o.census.against[0]->name, "pairs") == 0 && o.census.against[1] == vertex_program_get(0));
    assert_true(vertex_program_get(o.census.against_count - 1) != NULL &&
                vertex_program_get(o.census.against_count) == NULL);
    assert_int_equal(parse(&o, "scene m.obj", OPTION_ALSO, "Thin,facing", line), EXIT_FINE);
    assert_int_equal(o.scene.filters_off, 1U << FINDER_THIN | 1U << FINDER_FACING);
    assert_int_equal(parse(&o, "scene m.obj", OPTION_ALSO, "all", line), EXIT_FINE);
    assert_int_equal(o.scene.filters_off, (1U << FINDER_FILTERS) - 1);
    assert_int_equal(parse(&o, "scene m.obj", OPTION_SEPARATION, "0", line), EXIT_FINE);
    assert_true(o.wanted.separation == 0.0 && option_given(&o, OPTION_SEPARATION));
    assert_int_equal(parse(&o, "zfight", OPTION_SEPARATION, "0", line), EXIT_USAGE);
    assert_int_equal(parse(&o, "table", OPTION_TOLERANCE, "3%", line), EXIT_FINE);
    assert_true(near_to(o.wanted.tolerance, 0.03));
    assert_int_equal(parse(&o, "table", OPTION_AT, "3,1,2", line), EXIT_FINE);
    assert_true(o.camera.at.count == 3 && o.camera.at.lo == 1 && o.camera.at.hi == 3);
    options_release(&o);
    assert_int_equal(parse(&o, "table", OPTION_RANGE, "2:5", line), EXIT_FINE);
    assert_true(o.camera.range_lo == 2 && o.camera.range_hi == 5);
    assert_int_equal(parse(&o, "texture", OPTION_SIZE, "65536x1", line), EXIT_FINE);
    assert_true(o.view.spec.width == 65536 && o.view.spec.height == 1 && o.view.eye[0] == 0);
    assert_int_equal(parse(&o, "shadow", OPTION_SIZE, "1024", line), EXIT_FINE);
    assert_true(o.view.spec.width == 1024 && o.view.spec.height == 1024 && o.shadow.light_box[0] == 0);
    assert_int_equal(parse(&o, "shadow", OPTION_SIZE, "512x256", line), EXIT_FINE);
    assert_true(o.view.spec.width == 512 && o.view.spec.height == 256);
    assert_int_equal(parse(&o, "shadow", OPTION_LIGHT_BOX, "10x20.5x1e3", line), EXIT_FINE);
    assert_true(o.shadow.light_box[0] == 10 && o.shadow.light_box[1] == 20.5 && o.shadow.light_box[2] == 1e3);
    assert_int_equal(parse(&o, "shadow", OPTION_LIGHT_BOX, "10mx50cmx1km", line), EXIT_FINE);
    assert_true(o.shadow.light_box[0] == 10 && o.shadow.light_box[1] == 0.5 && o.shadow.light_box[2] == 1000);
    assert_int_equal(parse(&o, "texture", OPTION_PARAMETER, "gap=0.5", line), EXIT_FINE);
    assert_true(o.image.parameter_count == 1 && o.image.parameters[0].value == 0.5);
    assert_int_equal(parse(&o, "plot interval", OPTION_AXES, "1:10,0.5:1e3", line), EXIT_FINE);
    assert_true(o.figure.axes[0] == 1 && o.figure.axes[1] == 10 && o.figure.axes[2] == 0.5 && o.figure.axes[3] == 1e3);
    assert_int_equal(parse(&o, "plot interval", OPTION_BESIDE, "-n 5", line), EXIT_FINE);
    assert_string_equal(o.figure.beside, "-n 5");
    assert_int_equal(parse(&o, "methods linearize", OPTION_MINE, "a.glsl:f", line), EXIT_FINE);
    assert_true(o.judge.mine_count == 1 && strcmp(o.judge.mine[0], "a.glsl:f") == 0);
    assert_int_equal(parse(&o, "table", OPTION_UNIT, "cm", line), EXIT_FINE);
    assert_true(strcmp(o.camera.unit->name, "cm") == 0 && o.camera.znear == 0.1);
    assert_int_equal(parse(&o, "table", OPTION_CSV, NULL, line), EXIT_FINE);
    assert_true(o.out.form == FORM_CSV);
    assert_int_equal(parse(&o, "plot", OPTION_HELP, NULL, line), EXIT_FINE);
    assert_true(strcmp(o.command->name, "help") == 0 &&
                strcmp(((const command_row *)o.operand_row)->name, "plot") == 0);
}

/* View, grid and class, and the vertical angle that follows. */
TEST(test_slanted) {
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
    char line[1024] = "";
    options o;
    assert_int_equal(parse(&o, "table", OPTION_VIEWPORT, "32768x7", line), EXIT_FINE);
    assert_true(o.camera.triangles.width == 32768 && o.camera.triangles.height == 7 &&
                o.camera.triangles.subpixel == 8);
    assert_true(o.camera.triangles.fov_y == 60 && o.camera.triangles.slant_lo == 0 &&
                o.camera.triangles.slant_hi == 90);
    assert_true(o.camera.triangles.depth == 2 && o.camera.triangles.pixels == 512 && o.camera.triangles.slim == 16);
    assert_int_equal(parse(&o, "table", OPTION_SLANT, "0.5:80", line), EXIT_FINE);
    assert_true(o.camera.triangles.slant_lo == 0.5 && o.camera.triangles.slant_hi == 80);
    assert_int_equal(parse(&o, "zfight", OPTION_SLANT, "30.5,-360", line), EXIT_FINE);
    assert_true(o.camera.triangles.slant_lo == 30.5 && o.camera.triangles.slant_hi == 30.5 && o.camera.azimuth == -360);
    assert_int_equal(parse(&o, "zfight", OPTION_RASTERIZE, NULL, line), EXIT_FINE);
    assert_true(isnan(o.camera.azimuth) && o.camera.triangles.width == 1920 && o.camera.triangles.height == 1080 &&
                o.camera.format_count == 1);
    assert_string_equal(o.camera.raster->name, "llvmpipe");
    assert_int_equal(options_parse(&o, 3, (char *[]){"depthprec", "plot", "fight", NULL}), EXIT_FINE);
    assert_int_equal(view_drawn(&o), EXIT_FINE);
    assert_int_equal(o.camera.format_count, 3); /* of all four those that it has */
    assert_int_equal(parse(&o, "table", OPTION_TRIANGLE_CLASS, "slim=4,depth=3,pixels=20", line), EXIT_FINE);
    assert_true(o.camera.triangles.depth == 3 && o.camera.triangles.pixels == 20 && o.camera.triangles.slim == 4);
    assert_int_equal(parse(&o, "table", OPTION_TRIANGLE_CLASS, "pixels=20", line), EXIT_FINE);
    assert_true(o.camera.triangles.depth == 2 && o.camera.triangles.pixels == 20 && o.camera.triangles.slim == 16);
    assert_int_equal(parse(&o, "budget", OPTION_HFOV, "90", line), EXIT_FINE);
    assert_relative(o.camera.triangles.fov_y, 2 * atan(0.75) * 180 / 3.14159265358979323846, 1e-14);
    assert_int_equal(parse(&o, "budget", OPTION_QUIET, NULL, line), EXIT_FINE);
    assert_int_equal(o.camera.triangles.width, 0);
    for (size_t i = 0; i < sizeof viewports / sizeof viewports[0]; i++)
        refused(&t, "table", OPTION_VIEWPORT, viewports[i], "WIDTHxHEIGHT, each from 1 to 32768 pixels");
    for (size_t i = 0; i < sizeof slants / sizeof slants[0]; i++)
        refused(&t, "table", OPTION_SLANT, slants[i], "LO:HI, from 0 to 90 degrees");
    for (size_t i = 0; i < sizeof planes / sizeof planes[0]; i++)
        refused(&t, "zfight", OPTION_SLANT, planes[i], "SLANT,AZIMUTH, from 0 to 90 and from -360 to 360 degrees");
    for (size_t i = 0; i < sizeof classes / sizeof classes[0]; i++)
        refused(&t, "table", OPTION_TRIANGLE_CLASS, classes[i],
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
    options o;
    assert_int_equal(parse(&o, "shadow", OPTION_CASCADES, "8", line), EXIT_FINE);
    assert_true(o.shadow.cascades == 8 && o.shadow.lambda == 0.5);
    assert_int_equal(parse(&o, "shadow", OPTION_CASCADES, "1:0", line), EXIT_FINE);
    assert_true(o.shadow.cascades == 1 && o.shadow.lambda == 0);
    assert_int_equal(parse(&o, "shadow", OPTION_CURVATURE, "1e-12", line), EXIT_FINE);
    assert_true(o.shadow.curvature == 1e-12 && o.shadow.facet == 0);
    assert_int_equal(parse(&o, "shadow", OPTION_CURVATURE, "5m:2cm", line), EXIT_FINE);
    assert_true(o.shadow.curvature == 5 && o.shadow.facet == 0.02);
    assert_int_equal(parse(&o, "shadow", OPTION_QUIET, NULL, line), EXIT_FINE);
    assert_true(o.shadow.cascades == 4 && o.shadow.lambda == 0.5 && isnan(o.shadow.curvature) && o.shadow.facet == 0);
    assert_int_equal(parse(&o, "texture", OPTION_FIGURE_SIZE, "320x8192", line), EXIT_FINE);
    assert_true(o.figure.width == 320 && o.figure.height == 8192);
    assert_int_equal(parse(&o, "texture", OPTION_FIGURE_SIZE, "8192", line), EXIT_FINE);
    assert_true(o.figure.width == 8192 && o.figure.height == 0);
    for (size_t i = 0; i < sizeof figures / sizeof figures[0]; i++)
        refused(&t, "texture", OPTION_FIGURE_SIZE, figures[i],
                "W or WxH, W from 320 to 8192 and H from 200 to 8192 pixels");
    for (size_t i = 0; i < sizeof splits / sizeof splits[0]; i++)
        refused(&t, "shadow", OPTION_CASCADES, splits[i],
                "N or N:LAMBDA, N a whole number from 1 to 8, LAMBDA from 0 to 1");
    for (size_t i = 0; i < sizeof bends / sizeof bends[0]; i++)
        refused(&t, "shadow", OPTION_CURVATURE, bends[i],
                "Z or Z:FACET, Z from 1e-12 and FACET from 0 to 1e18 scene units");
    tally_end(&t);
}

TEST(test_define) {
    static const char *const wrong[] = {"", "a", "a=", "=near", "a=nearer", "a=1x", "a=nan"};
    static const char said[] = "NAME=near, far, z_buffer_params, projection or another word of the help, or a number";
    tally t = {.name = "define"};
    char line[1024] = "";
    options o;
    assert_int_equal(parse(&o, "judge", OPTION_DEFINE, "uNear=near", line), EXIT_FINE);
    assert_true(o.judge.define_count == 1 && strcmp(o.judge.defines[0], "uNear=near") == 0);
    assert_int_equal(parse(&o, "judge", OPTION_DEFINE, "u=-1.5e3", line), EXIT_FINE);
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++)
        refused(&t, "judge", OPTION_DEFINE, wrong[i], said);
    tally_end(&t);
}

TEST(test_behind_colons) {
    static const char *const cameras[] = {"", "d24", "d24:", ":d3d", "all:d3d", "d24:linear", "d24:d3d,gl"};
    static const char *const far[] = {"d24:d3d:x", "d24:d3d:nan", "d24:d3d:1:2"};
    static const char *const levels[] = {"", "x", "17", "-1", "1.5", ":nearest", "2:middle", "2:unorm32", "2:all"};
    tally t = {.name = "behind colons"};
    char line[1024] = "";
    options o;
    assert_int_equal(parse(&o, "shadow", OPTION_CAMERA_DEPTH, "d24:reversed", line), EXIT_FINE);
    assert_string_equal(o.shadow.camera.format.name, "unorm24");
    assert_true(o.shadow.camera.mapping == DP_MAPPING_REVERSED && o.shadow.camera.zfar == 0 && o.camera.zfar == 1000);
    assert_int_equal(parse(&o, "shadow", OPTION_CAMERA_DEPTH, "fp32:gl:2km", line), EXIT_FINE);
    assert_true(o.shadow.camera.mapping == DP_MAPPING_GL && o.shadow.camera.zfar == 2000 && o.camera.zfar == 1000);
    assert_int_equal(parse(&o, "texture", OPTION_HI_Z, "16:d16:nearest", line), EXIT_FINE);
    assert_string_equal(o.image.hi_z_format.name, "unorm16");
    assert_true(o.image.hi_z == 16 && o.image.hi_z_nearest);
    assert_int_equal(parse(&o, "texture", OPTION_HI_Z, "0", line), EXIT_FINE);
    assert_true(o.image.hi_z == 0 && !o.image.hi_z_nearest && o.image.hi_z_format.bits == 0);
    for (size_t i = 0; i < sizeof cameras / sizeof cameras[0]; i++)
        refused(&t, "shadow", OPTION_CAMERA_DEPTH, cameras[i],
                "FORMAT:MAPPING[:FAR], MAPPING one of d3d, gl, reversed, gl-reversed");
    for (size_t i = 0; i < sizeof far / sizeof far[0]; i++)
        TALLY(&t, parse(&o, "shadow", OPTION_CAMERA_DEPTH, far[i], line) == EXIT_USAGE, "%s", far[i]);
    for (size_t i = 0; i < sizeof levels / sizeof levels[0]; i++)
        refused(&t, "texture", OPTION_HI_Z, levels[i],
                "LEVEL, 0 to 16, and may have :nearest and :FORMAT, up to 31 bits, behind it");
    tally_end(&t);
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
        options o;
        char said[1024];
        assert_int_equal(parsed(&o, 4, argv, said), k == 0 ? EXIT_USAGE : EXIT_FINE);
        if (k == 0)
            assert_non_null(strstr(said, "--format: must be at most 64 formats, got 'float6.11' too"));
        assert_true(k == 0 || o.camera.format_count == OPTIONS_FORMATS_MAX);
        *strrchr(all, ',') = '\0';
    }
}

TEST(test_all) {
    tally t = {.name = "all"};
    for (int id = 0; id < OPTION_COUNT; id++) {
        const option_row *row = &option_rows[id];
        TALLY(&t, tried[id], "--%s is not in a table of this test", row->name);
        char takers[OPTION_TEXT_SIZE];
        TALLY(&t, command_takers(id, takers)[0] != '\0' && row->help[0] != '\0', "--%s", row->name);
        for (int other = 0; other < id; other++)
            TALLY(&t,
                  strcmp(row->name, option_rows[other].name) != 0 &&
                      (row->letter == 0 || row->letter != option_rows[other].letter),
                  "--%s twice", row->name);
    }
    tally_end(&t);
}
