/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * No option is taken and ignored: of each command each option, with a value off its default, changes what is printed in
 * one of the command's lines, or is refused there.
 */
#include <unistd.h>

#include "cli/option/uses.h"
#include "printed.h"

enum { LINES_MOST = 96, PER_COMMAND = 8 };

/* Lines of each command, in which an option is tried in turn until it is seen to do something. */
static const struct {
    command_id verb;
    const char *lines[PER_COMMAND];
} commands[] = {
    {CMD_TABLE,
     {"table -F d24 -m d3d", "table -F d24 -m log", "table -F fp32 -m reversed --model float", "table --constants",
      "table -F d24 -m d3d --viewport 640x480", "table -F d24 -m d3d --depth .5", "table"}},
    {CMD_BUDGET,
     {"budget -F d24 -m d3d", "budget -F d24 -m log", "budget --viewport 640x480", "budget --from-origin 100",
      "budget --from-origin 100 --scheme tile"}},
    {CMD_SOLVE,
     {"solve -f 1000 -F d24 -m d3d --separation 0.01 --at 50", "solve -f 1000 -F d24 -m d3d --error 0.01 --at 50",
      "solve --for distance -n .1 -f 1000 -F d24 -m d3d --separation 0.01", "solve -f 1000 --separation 0.01 --at 50",
      "solve -F d24 -m d3d --separation 0.01 --at 50", "solve -f 1000 -F d24 -m log --separation 0.01 --at 50",
      "solve -f 1000 -F d24 -m d3d --separation 0.01 --at 50 --viewport 640x480"}},
    {CMD_CHECK, {"check tests/needs/village.need"}},
    {CMD_ZFIGHT,
     {"zfight -F d24 -m d3d --range 1:1.001", "zfight -F d24 -m d3d --range 1:2 --sample 100",
      "zfight -F d24 -m d3d --range 1:1.001 --viewport 640x480", "zfight --range 1:1.001",
      "zfight -F fp32 -m d3d --rasterize --sample 20"}},
    {CMD_PREPASS, {"prepass --sample 1000", "prepass -F d24 -m d3d --against fma"}},
    {CMD_BIAS,
     {"bias -F d24 -m d3d", "bias -F d24 -m d3d --units -1", "bias -F d24 -m d3d --viewport 640x480 --at 10",
      "bias -F d24 -m log", "bias", "bias -F d24 -m d3d --units -1 --api vulkan"}},
    {CMD_WORLD, {"world", "world --from-origin 1e5", "world --from-origin 1e5 --scheme split"}},
    {CMD_SCENE,
     {"scene tests/models/street.obj --separation 0.02", "scene tests/models/street.obj -m log",
      "scene tests/models/street.obj --separation 0.02 --viewport 640x480",
      "scene tests/models/house.gltf --eye 0,2,30 --look 0,2,0", "scene tests/models/house.gltf"}},
    {CMD_SHADOW, {"shadow", "shadow --light-box 10x10x10", "shadow --curvature 5:1"}},
    {CMD_CODE,
     {"code", "code --what encode -F d16", "code --what projection", "code -m log", "code --what pack",
      "code --ortho -m d3d", "code -n 10cm"}},
    {CMD_JUDGE,
     {"judge --pairs tests/pairs/reversed.csv", "judge --pairs tests/pairs/reversed.csv -n .1 -f 100 -m log",
      "judge --pairs tests/pairs/reversed.csv -n .1 -f 100 -m reversed"}},
    {CMD_LIST, {"list synthetic", "list methods"}},
    {CMD_TEXTURE,
     {"texture --synthetic plane --size 64x36", "texture --product effect:edge -F d16 -m d3d",
      "texture --synthetic plane --size 64x36 --pixel 3,4", "texture --synthetic plane --size 64x36 -m log",
      "texture --synthetic steps --size 64x36 --figure -",
      "texture --synthetic plane --size 64x36 --product effect:motion-vector --pixel 3,4"}},
    {CMD_PLOT,
     {"plot error -F d24 -m d3d -o -", "plot budget -F d24 -m d3d -o -", "plot scene tests/models/street.obj -o -",
      "plot shadow -o -", "plot fight -o -", "plot error -F d24 -m log -o -",
      "plot budget -F d24 -m d3d --viewport 640x480 -o -", "plot budget -F d24 -m log -o -"}},
};

/* A value of each that no command has by default; of a flag the empty one. */
static const struct {
    option_id id;
    const char *value;
} tried[] = {
    {OPTION_NEAR, "0.3"},
    {OPTION_FAR, "700"},
    {OPTION_FORMAT, "d16"},
    {OPTION_MAPPING, "gl"},
    {OPTION_UNIT, "ft"},
    {OPTION_PRESET, "unity"},
    {OPTION_PLATFORM, "webgpu"},
    {OPTION_ROUNDING, "zero"},
    {OPTION_MODEL, "staged"},
    {OPTION_ARITH, "mesa"},
    {OPTION_LOG_C, "0.02"},
    {OPTION_TOLERANCE, "33%"},
    {OPTION_AT, "7"},
    {OPTION_RANGE, "2:9"},
    {OPTION_DEPTH, "0.5"},
    {OPTION_CODE, "77"},
    {OPTION_FOV, "33"},
    {OPTION_HFOV, "44"},
    {OPTION_RASTER, "spec-d3d"},
    {OPTION_SUBPIXEL, "5"},
    {OPTION_TRIANGLE_CLASS, "depth=3,slim=4"},
    {OPTION_SLANT, "0:30"},
    {OPTION_VIEWPORT, "640x470"},
    {OPTION_INTERPOLATION, "3"},
    {OPTION_FROM_ORIGIN, "1e4"},
    {OPTION_COMPOSITION, "double"},
    {OPTION_LOG2, "half-ulp"},
    {OPTION_SCHEME, "camera-double"},
    {OPTION_SEPARATION, "0.3"},
    {OPTION_ERROR, "0.3"},
    {OPTION_FOR, "separation"},
    {OPTION_REPORT, "json"},
    {OPTION_SAMPLE, "77"},
    {OPTION_SEED, "5"},
    {OPTION_AGAINST, "fma"},
    {OPTION_PROGRAM, "fma"},
    {OPTION_VERTICES, "box"},
    {OPTION_API, "vulkan"},
    {OPTION_UNITS, "-3"},
    {OPTION_FACTOR, "-2"},
    {OPTION_CLAMP, "-1e-7"},
    {OPTION_SLOPE, "0.1"},
    {OPTION_SIZE, "512x512"},
    {OPTION_LIGHT_BOX, "20x20x20"},
    {OPTION_KERNEL, "5"},
    {OPTION_ANGLE, "80"},
    {OPTION_CASCADES, "3"},
    {OPTION_CASTERS, "7"},
    {OPTION_CAMERA_DEPTH, "unorm16:d3d"},
    {OPTION_CURVATURE, "5"},
    {OPTION_EYE, "0,1,9"},
    {OPTION_LOOK, "1,0,9"},
    {OPTION_LAST_EYE, "0,0,-1"},
    {OPTION_LAST_LOOK, "1,0,9"},
    {OPTION_WITHIN, "9"},
    {OPTION_ALSO, "all"},
    {OPTION_TRANSFORMS, "rounded"},
    {OPTION_LANGUAGE, "hlsl"},
    {OPTION_WHAT, "projection"},
    {OPTION_PAIRS_FOR, "9"},
    {OPTION_METRIC, "2"},
    {OPTION_LATTICE, "even:0.1"},
    {OPTION_INTRINSICS, "50,50,32,18"},
    {OPTION_AS, "binary16"},
    {OPTION_SKY, "0.3"},
    {OPTION_PRODUCT, "position"},
    {OPTION_PIXEL, "3,4"},
    {OPTION_HI_Z, "1"},
    {OPTION_THEME, "dark"},

    {OPTION_FIGURE_SIZE, "700x500"},
    {OPTION_TITLE, "seven"},
    {OPTION_BESIDE, "'-F d16 -m d3d'"},
    {OPTION_AXES, "1:10,1e-6:1"},
    {OPTION_CHANNEL, "Z"},
    {OPTION_TINT, "1,0,0"},
    {OPTION_OVERLAY, "0.1"},
    {OPTION_SYNTHETIC, "steps"},
    {OPTION_PARAMETER, "distance=7"},
    {OPTION_PACKING, "unity"},
    {OPTION_DEFINE, "a=3"},
};

/* What changes nothing by its purpose: where it is written and how fast, and what has files of its own, which the tests
 * of those are for. */
static const option_id apart[] = {
    OPTION_HELP,   OPTION_VERSION,   OPTION_OUTPUT, OPTION_QUIET,         OPTION_THREADS, OPTION_DEVICE, OPTION_KEEP,
    OPTION_RENDER, OPTION_EMIT_NEED, OPTION_FIGURE, OPTION_HISTOGRAM,     OPTION_PATH,    OPTION_CAMERA, OPTION_PICTURE,
    OPTION_MATRIX, OPTION_MINE,      OPTION_TYPE,   OPTION_NORMAL_FORMAT, OPTION_PAIRS,   OPTION_COLOR};

static bool is_apart(option_id id) {
    for (size_t i = 0; i < sizeof apart / sizeof apart[0]; i++)
        if (apart[i] == id)
            return true;
    return false;
}

static const char *value_of(option_id id) {
    for (size_t i = 0; i < sizeof tried / sizeof tried[0]; i++)
        if (tried[i].id == id)
            return tried[i].value;
    return NULL;
}

/* What the lines print as they are. */
static struct {
    const char *line;
    printed p;
} known[LINES_MOST];
static size_t known_count;

static const printed *plain(const char *line) {
    for (size_t i = 0; i < known_count; i++)
        if (known[i].line == line)
            return &known[i].p;
    assert_true(known_count < LINES_MOST);
    known[known_count].line = line;
    known[known_count].p = print_of("%s", line);
    if (known[known_count].p.status > 1)
        fail_msg("%s: %s", line, known[known_count].p.errors);
    return &known[known_count++].p;
}

/* A line that has the option already tells nothing of it, but of what it is refused beside. */
static bool does_something(const char *line, const option_row *row, const char *value) {
    char brief[16], word[64];
    snprintf(brief, sizeof brief, " -%c ", row->letter);
    snprintf(word, sizeof word, " --%s", row->name);
    if ((row->letter != 0 && strstr(line, brief) != NULL) || strstr(line, word) != NULL)
        return false;
    const printed *without = plain(line);
    printed with = print_of("%s --%s %s", line, row->name, value);
    const bool same = with.status == without->status && strcmp(with.out, without->out) == 0;
    const bool refused = with.status == 2 && with.out[0] == '\0' && with.errors[0] != '\0';
    printed_free(&with);
    return refused || !same;
}

TEST(has_an_effect_or_is_refused) {
    tally t = {.name = "options"};
    for (size_t i = 0; i < sizeof commands / sizeof commands[0]; i++)
        for (int id = 0; id < OPTION_COUNT; id++) {
            const command_row *v = &command_rows[0];
            while (v->id != commands[i].verb)
                v++;
            const option_row *row = &option_rows[id];
            if (option_used(v, ~0U, (option_id)id) == NULL || is_apart((option_id)id) ||
                (v->id == CMD_JUDGE && id == OPTION_FULL)) /* its lines are longer than a page's where a file's are */
                continue;
            const char *value = value_of((option_id)id);
            bool done = false;
            for (size_t k = 0; k < PER_COMMAND && commands[i].lines[k] != NULL && !done; k++)
                done = does_something(commands[i].lines[k], row, value != NULL ? value : "");
            TALLY(&t, done, "%s --%s %s is taken and does nothing", v->name, row->name, value != NULL ? value : "");
        }
    TALLY(&t, t.cases > 250, "few options");
    tally_end(&t);
}

/* Code is of one thing, and takes what that depends on; see depthprec-code(1). */
TEST(parts_of_code) {
    static const char *const parts[] = {"linearize -F fp32", "projection",    "encode -F d16",
                                        "position",          "pack",          "normal",
                                        "linearize -m log",  "encode -m log", "encode -m linear"};
    static const option_id ids[] = {OPTION_ROUNDING, OPTION_LOG_C,    OPTION_FOV,
                                    OPTION_HFOV,     OPTION_VIEWPORT, OPTION_ORTHO};
    tally t = {.name = "parts of code"};
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++)
        for (size_t k = 0; k < sizeof ids / sizeof ids[0]; k++) {
            const option_row *row = &option_rows[ids[k]];
            const char *value = value_of(ids[k]);
            printed without = print_of("code --what %s", parts[i]),
                    with = print_of("code --what %s --%s %s", parts[i], row->name, value != NULL ? value : "");
            const bool codes = strncmp(parts[i], "encode -F", 9) == 0 && ids[k] == OPTION_ORTHO; /* of a window depth */
            TALLY(&t, without.status == 0 && (codes || with.status == 2 || strcmp(with.out, without.out) != 0),
                  "code --what %s --%s does nothing", parts[i], row->name);
            printed_free(&without);
            printed_free(&with);
        }
    tally_end(&t);
}
