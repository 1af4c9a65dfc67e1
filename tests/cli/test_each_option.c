/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * No option is taken and ignored: of each command each option, with a value off its default, changes what is printed in
 * one of the command's lines, or is refused there.
 */
#include <unistd.h>

#include "cli/option/option.h"
#include "printed.h"

enum { LINES_MOST = 128, PER_COMMAND = 10 };

/* Lines of each command, in which an option is tried in turn until it is seen to do something. */
static const struct {
    const char *verb;
    const char *lines[PER_COMMAND];
} commands[] = {
    {"table",
     {"table -F d24 -m d3d", "table -F d24 -m log", "table -F fp32 -m reversed --model float", "table --constants",
      "table -F d24 -m d3d --viewport 640x480", "table -F d24 -m d3d --depth .5", "table"}},
    {"budget",
     {"budget -F d24 -m d3d", "budget -F d24 -m log", "budget --viewport 640x480", "budget --from-origin 100",
      "budget --from-origin 100 --scheme tile"}},
    {"solve",
     {"solve -f 1000 -F d24 -m d3d --separation 0.01 --at 50", "solve -f 1000 -F d24 -m d3d --error 0.01 --at 50",
      "solve --for distance -n .1 -f 1000 -F d24 -m d3d --separation 0.01", "solve -f 1000 --separation 0.01 --at 50",
      "solve -F d24 -m d3d --separation 0.01 --at 50", "solve -f 1000 -F d24 -m log --separation 0.01 --at 50",
      "solve -f 1000 -F d24 -m d3d --separation 0.01 --at 50 --viewport 640x480"}},
    {"check", {"check tests/needs/village.need"}},
    {"zfight",
     {"zfight -F d24 -m d3d --range 1:1.001", "zfight -F d24 -m d3d --range 1:2 --sample 100",
      "zfight -F d24 -m d3d --range 1:1.001 --viewport 640x480", "zfight --range 1:1.001",
      "zfight -F fp32 -m d3d --rasterize --sample 20"}},
    {"convert", {"convert unorm10 fp32 unorm10 --write cut:2^10", "convert float4.6 fp32 float4.6"}},
    {"prepass",
     {"prepass --sample 1000", "prepass -F d24 -m d3d --against fma", "prepass -F d16 -m d3d --resolve average:2",
      "prepass -F d16"}},
    {"bias",
     {"bias -F d24 -m d3d", "bias -F d24 -m d3d --units -1", "bias -F d24 -m d3d --viewport 640x480 --at 10",
      "bias -F d24 -m log", "bias", "bias -F d24 -m d3d --units -1 --api vulkan",
      "bias -F d24 -m d3d --units -1 --rasterize --range 1:9"}},
    {"world", {"world", "world --from-origin 1e5", "world --from-origin 1e5 --scheme split"}},
    {"scene",
     {"scene tests/models/street.obj --separation 0.02", "scene tests/models/street.obj -m log",
      "scene tests/models/street.obj --separation 0.02 --viewport 640x480",
      "scene tests/models/house.gltf --eye 0,2,30 --look 0,2,0", "scene tests/models/house.gltf"}},
    {"shadow",
     {"shadow", "shadow --light-box 10x10x10", "shadow --curvature 5:1", "shadow --spot 60 -F d24",
      "shadow --point -F d24", "shadow --engine three", "shadow --light-box 9x9x9 --size 256 --rasterize"}},
    {"code",
     {"code", "code --what encode -F d16", "code --what projection", "code -m log", "code --what pack",
      "code --ortho -m d3d", "code -n 10cm"}},
    {"judge",
     {"judge --pairs tests/pairs/reversed.csv", "judge --pairs tests/pairs/reversed.csv -n .1 -f 100 -m log",
      "judge --pairs tests/pairs/reversed.csv -n .1 -f 100 -m reversed"}},
    {"list", {"list synthetic", "list methods"}},
    {"texture",
     {"texture --synthetic plane --size 64x36", "texture --product effect:edge -F d16 -m d3d",
      "texture --synthetic plane --size 64x36 --pixel 3,4", "texture --synthetic plane --size 64x36 -m log",
      "texture --synthetic steps --size 64x36 --figure -",
      "texture --synthetic plane --size 64x36 --product effect:motion-vector --pixel 3,4"}},
    {"plot",
     {"plot error -F d24 -m d3d -o -", "plot budget -F d24 -m d3d -o -", "plot scene tests/models/street.obj -o -",
      "plot shadow -o -", "plot shadow --spot 60 -F d24 -o -", "plot shadow --engine three -o -", "plot fight -o -",
      "plot error -F d24 -m log -o -", "plot budget -F d24 -m d3d --viewport 640x480 -o -",
      "plot budget -F d24 -m log -o -"}},
};

/* A value of each that no command has by default; of a flag the empty one. */
static const struct {
    const char *id;
    const char *value;
} tried[] = {
    {"near", "0.3"},
    {"far", "700"},
    {"format", "d16"},
    {"mapping", "gl"},
    {"unit", "ft"},
    {"preset", "unity"},
    {"platform", "webgpu"},
    {"rounding", "zero"},
    {"model", "staged"},
    {"arith", "mesa"},
    {"log-c", "0.02"},
    {"depth-range", "0.1:1"},
    {"tolerance", "33%"},
    {"at", "7"},
    {"range", "2:9"},
    {"depth", "0.5"},
    {"code", "77"},
    {"fov", "33"},
    {"hfov", "44"},
    {"raster", "spec-d3d"},
    {"subpixel", "5"},
    {"triangle-class", "depth=3,slim=4"},
    {"slant", "0:30"},
    {"viewport", "640x470"},
    {"interpolation", "3"},
    {"from-origin", "1e4"},
    {"composition", "double"},
    {"log2", "half-ulp"},
    {"scheme", "camera-double"},
    {"separation", "0.3"},
    {"error", "0.3"},
    {"for", "separation"},
    {"report", "json"},
    {"sample", "77"},
    {"seed", "5"},
    {"against", "fma"},
    {"program", "fma"},
    {"vertices", "box"},
    {"prepass-format", "fp16"},
    {"resolve", "max:8"},
    {"half", "one"},
    {"api", "vulkan"},
    {"units", "-3"},
    {"remedy", "ndc:1e-5"},
    {"factor", "-2"},
    {"clamp", "-1e-7"},
    {"slope", "0.1"},
    {"size", "512x512"},
    {"light-box", "20x20x20"},
    {"spot", "50"},
    {"engine", "bevy"},
    {"filter", "pcf:7"},
    {"bias", "-0.03"},
    {"normal-bias", "0.5"},
    {"point", ""},
    {"distance", ""},
    {"kernel", "5"},
    {"angle", "80"},
    {"cascades", "3"},
    {"casters", "7"},
    {"camera-depth", "unorm16:d3d"},
    {"curvature", "5"},
    {"eye", "0,1,9"},
    {"look", "1,0,9"},
    {"last-eye", "0,0,-1"},
    {"last-look", "1,0,9"},
    {"within", "9"},
    {"also", "all"},
    {"transforms", "rounded"},
    {"language", "hlsl"},
    {"what", "projection"},
    {"pairs-for", "9"},
    {"metric", "2"},
    {"lattice", "even:0.1"},
    {"intrinsics", "50,50,32,18"},
    {"as", "binary16"},
    {"sky", "0.3"},
    {"product", "position"},
    {"pixel", "3,4"},
    {"hi-z", "1"},
    {"theme", "dark"},

    {"figure-size", "700x500"},
    {"title", "seven"},
    {"beside", "'-F d16 -m d3d'"},
    {"axes", "1:10,1e-6:1"},
    {"channel", "Z"},
    {"tint", "1,0,0"},
    {"overlay", "0.1"},
    {"synthetic", "steps"},
    {"parameter", "distance=7"},
    {"packing", "unity"},
    {"read", "product:7"},
    {"write", "half:7"},
    {"define", "a=3"},
    {"matrix", "2 0 0 0 0 2 0 0 0 0 0 .2 0 0 1 0"},
    {"stereo", "focal=500,baseline=0.1"},
};

/* Options that change nothing by their purpose: where it is written and how fast, and what has files of its own, which
 * the tests of those are for. */
static const char *const apart[] = {"help",   "version",   "output",        "quiet",     "threads", "device", "keep",
                                    "render", "emit-need", "figure",        "histogram", "path",    "camera", "picture",
                                    "mine",   "type",      "normal-format", "pairs",     "color"};

static bool is_apart(const char *id) {
    for (size_t i = 0; i < sizeof apart / sizeof apart[0]; i++)
        if (strcmp(apart[i], id) == 0)
            return true;
    return false;
}

static const char *value_of(const char *id) {
    for (size_t i = 0; i < sizeof tried / sizeof tried[0]; i++)
        if (strcmp(tried[i].id, id) == 0)
            return tried[i].value;
    return NULL;
}

static bool is_flag(const command_row *v, const option_row *row) {
    const option_taken use = option_used(v, ~0U, row);
    char argument[OPTION_TEXT_SIZE];
    return option_use_argument(&use, argument)[0] == '\0' || option_use_optional(&use) != NULL;
}

/* The output of the lines as they are. */
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

static bool has_option(const char *line, const option_row *row) {
    char brief[16], word[64];
    snprintf(brief, sizeof brief, " -%c ", row->letter);
    snprintf(word, sizeof word, " --%s", row->name);
    return (row->letter != 0 && strstr(line, brief) != NULL) || strstr(line, word) != NULL;
}

/* A line that has the option already tells nothing of it, but of what it is refused beside. */
/* A figure says by which command it was drawn, and that line always differs. */
static bool same_but_command(const char *a, const char *b) {
    while (*a != '\0' || *b != '\0') {
        const size_t i = strcspn(a, "\n"), k = strcspn(b, "\n");
        if (!(strncmp(a, "command: ", 9) == 0 && strncmp(b, "command: ", 9) == 0) && !(i == k && strncmp(a, b, i) == 0))
            return false;
        a += i + (a[i] != '\0');
        b += k + (b[k] != '\0');
    }
    return true;
}

static bool does_something(const char *line, const option_row *row, const char *value) {
    if (has_option(line, row))
        return false;
    const printed *without = plain(line);
    printed with = print_of("%s --%s %s", line, row->name, value);
    const bool same = with.status == without->status && strcmp(with.errors, without->errors) == 0 &&
                      same_but_command(with.out, without->out);
    const bool refused = with.status == 2 && with.out[0] == '\0' && with.errors[0] != '\0';
    printed_free(&with);
    return refused || !same;
}

/* Times, and what a GPU does, differ from run to run; the others take no options. */
static const char *const untried[] = {"methods", "probe", "help", "completions"};

TEST(each_command_is_tried) {
    for (size_t i = 0; command_get(i) != NULL; i++) {
        bool tried_here = false;
        for (size_t k = 0; k < sizeof commands / sizeof commands[0]; k++)
            tried_here |= command_find(commands[k].verb) == command_get(i);
        for (size_t k = 0; k < sizeof untried / sizeof untried[0]; k++)
            tried_here |= command_find(untried[k]) == command_get(i);
        if (!tried_here)
            fail_msg("%s has no line in this test", command_get(i)->name);
    }
}

TEST(has_an_effect_or_is_refused) {
    tally t = {.name = "options"};
    const option_row *all[OPTIONS_MAX + 1];
    options_all(all);
    for (size_t i = 0; i < sizeof commands / sizeof commands[0]; i++)
        for (size_t o = 0; all[o] != NULL; o++) {
            const command_row *v = command_find(commands[i].verb);
            const option_row *row = all[o];
            if (option_used(v, ~0U, row).row == NULL || is_apart(row->name) ||
                (strcmp(v->name, "judge") == 0 &&
                 strcmp(row->name, "full") == 0)) /* its lines are longer than a page's where a file's are */
                continue;
            const char *value = value_of(row->name);
            TALLY(&t, value != NULL || is_flag(v, row), "no value of --%s is tried", row->name);
            bool done = false;
            for (size_t k = 0; k < PER_COMMAND && commands[i].lines[k] != NULL && !done; k++)
                done = does_something(commands[i].lines[k], row, value != NULL ? value : "");
            TALLY(&t, done, "%s --%s %s is taken and does nothing", v->name, row->name, value != NULL ? value : "");
        }
    TALLY(&t, t.cases > 250, "few options");
    tally_end(&t);
}

/* Parts of commands, in each of which every option does something or is refused. */
static const char *const parts_of_commands[] = {
    "table -F d24,fp32 -m d3d",
    "table -F d24 -m d3d",
    "table -F d24 -m linear",
    "table -F d24 -m d3d --preset unity,unreal",
    "table -F d24 -m d3d --depth .5",
    "table -F d24 -m log --code 77",
    "table --lattice even:.1",
    "table --constants --ortho",
    "budget -F d24 -m d3d",
    "budget -F d24 -m d3d --from-origin 100 --scheme split",
    "budget -F d24 -m d3d --from-origin 100 --scheme tile",
    "solve -f 1000 -F d24 -m d3d --separation 0.01 --at 50",
    "solve --for separation -n .1 -f 1000 -F d24 -m d3d --at 50",
    "solve -f 1000 -F d24 -m d3d --separation 0.01 --at 50 --viewport 640x480",
    "bias -F d24 -m d3d",
    "bias -F d24 -m d3d --units -1",
    "bias -F d24 -m d3d --api all",
    "bias -F d24 -m linear --range 2:50",
    "world --from-origin 1e5 --scheme camera-double",
    "code",
    "code -m log",
    "code --what encode -F d16",
    "code --what encode -m log",
    "code --what projection --ortho",
    "code --what position --ortho",
    "code --what pack",
    "code --what normal",
    "code --language gappa",
    "plot share -F d24 -m d3d -o -",
    "plot distribution -F d24 -m d3d -o -",
    "plot map -F d24 -m d3d -o -",
    "plot linear01 -o -",
    "plot normals -F d24 -m reversed -o -",
    "plot stability linearize -o -",
    "plot error -F d24 -m d3d --model exact -o -",
};

TEST(in_each_part) {
    const size_t apart_by = test_cases(3, 1, 1); /* a third of the options in each part, quickly */
    tally t = {.name = "parts"};
    const option_row *all[OPTIONS_MAX + 1];
    options_all(all);
    for (size_t i = 0; i < sizeof parts_of_commands / sizeof parts_of_commands[0]; i++) {
        const char *line = parts_of_commands[i];
        char verb[16];
        snprintf(verb, sizeof verb, "%.*s", (int)strcspn(line, " "), line);
        for (size_t o = 0; all[o] != NULL; o++) {
            const char *value = value_of(all[o]->name);
            if ((o + i) % apart_by != 0)
                continue;
            const bool shows = strcmp(all[o]->name, "full") == 0; /* what there was no room for, if there is any */
            if (option_used(command_find(verb), ~0U, all[o]).row != NULL && !is_apart(all[o]->name) && !shows &&
                !has_option(line, all[o]))
                TALLY(&t, does_something(line, all[o], value != NULL ? value : ""), "%s --%s %s does nothing", line,
                      all[o]->name, value != NULL ? value : "");
        }
    }
    TALLY(&t, t.cases > 500 / apart_by, "few options");
    tally_end(&t);
}

/* Code is of one thing, and takes what that depends on; see depthprec-code(1). */
TEST(parts_of_code) {
    static const char *const parts[] = {"linearize", "projection",       "encode -F d16", "position",        "pack",
                                        "normal",    "linearize -m log", "encode -m log", "encode -m linear"};
    static const char *const ids[] = {"rounding", "log-c", "fov", "hfov", "viewport", "ortho"};
    tally t = {.name = "parts of code"};
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++)
        for (size_t k = 0; k < sizeof ids / sizeof ids[0]; k++) {
            const char *value = value_of(ids[k]);
            printed without = print_of("code --what %s", parts[i]),
                    with = print_of("code --what %s --%s %s", parts[i], ids[k], value != NULL ? value : "");
            TALLY(&t, without.status == 0 && (with.status == 2 || strcmp(with.out, without.out) != 0),
                  "code --what %s --%s does nothing", parts[i], ids[k]);
            printed_free(&without);
            printed_free(&with);
        }
    tally_end(&t);
}
