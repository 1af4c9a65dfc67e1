/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Each default that help spells out: with it given, a command prints what it prints without. */
#include <ctype.h>

#include "cli/option/option.h"
#include "printed.h"

#define NUMBERED(name) NUMBER_##name,
enum { COMMANDS(NUMBERED) };
#define BIT(name) (1U << NUMBER_##name)

static unsigned bit_of(const command_row *v) {
    unsigned bit = 1;
    for (size_t i = 0; command_get(i) != v; i++)
        bit <<= 1;
    return bit;
}

/* A line of each command that has defaults, small where the work depends on it. */
static const struct {
    unsigned verb;
    const char *line;
} lines[] = {
    {BIT(table), "table"},
    {BIT(plot), "plot error --csv"},
    {BIT(zfight), "zfight --range 1:1.01"},
    {BIT(prepass), "prepass --sample 1000"},
    {BIT(budget), "budget"},
    {BIT(texture), "texture --synthetic steps --size 64x36"},
    {BIT(methods), "methods position --json"},
    {BIT(check), "check tests/needs/village.need"},
    {BIT(solve), "solve -F d24 -m d3d --separation 0.01 --at 50"},
    {BIT(bias), "bias --units -1"},
    {BIT(shadow), "shadow"},
    {BIT(world), "world --from-origin 1e5"},
    {BIT(scene), "scene tests/models/street.obj --separation 0.02"},
    {BIT(list), "list synthetic"},
    {BIT(judge), "judge --pairs tests/pairs/reversed.csv --csv"},
    {BIT(code), "code"},
    {BIT(convert), "convert unorm10 fp32 unorm10"},
};

#define ALL (~0U)

/* Where options matter only beside another, or in another line. */
#define IDS(...)                                                                                                       \
    (const char *const[]) {                                                                                            \
        __VA_ARGS__, NULL                                                                                              \
    }
static const struct {
    unsigned verbs;
    const char *const *ids;
    const char *line; /* in place of the command's; null: that */
    const char *more;
} besides[] = {
    {BIT(plot), IDS("interpolation", "from-origin"), "plot budget -F d24 -m d3d --csv", ""},
    {BIT(code), IDS("fov", "viewport"), "code --what projection", ""},
    {BIT(code), IDS("rounding"), "code --what encode -F d24", ""},
    {BIT(code), IDS("format"), "code --what encode", ""},
    {BIT(plot), IDS("composition"), "plot budget -F d24 -m d3d --csv", "--from-origin 100"},
    {BIT(plot), IDS("log2"), "plot budget -F d24 -m log --csv", ""},
    {BIT(budget), IDS("log2"), "budget -F d24 -m log", ""},
    {BIT(plot), IDS("slant"), "plot budget -F d24 -m d3d --csv", "--viewport 640x480"},
    {BIT(plot), IDS("fov", "subpixel", "triangle-class", "cascades", "casters", "kernel", "size"), "plot shadow --csv",
     ""},
    {BIT(plot), IDS("transforms", "angle"), "plot scene tests/models/street.obj --separation 0.02 --csv", ""},
    {BIT(plot), IDS("model"), "plot map -F d24 -m d3d --csv", ""},
    {BIT(budget), IDS("composition"), NULL, "--from-origin 100"},
    {BIT(table) | BIT(budget) | BIT(solve) | BIT(zfight) | BIT(scene),
     IDS("fov", "subpixel", "slant", "triangle-class"), NULL, "--viewport 640x480"},
    {BIT(zfight), IDS("fov", "slant", "triangle-class"), "zfight -F fp32 -m d3d --rasterize --sample 20", ""},
    {BIT(zfight), IDS("seed"), NULL, "--sample 1000"},
    {BIT(prepass), IDS("sample"), "prepass -F d24 -m d3d --against fma", ""},
    {BIT(bias), IDS("arith", "fov", "subpixel", "slant", "triangle-class"), "bias --at 10", "--viewport 640x480"},
    {BIT(bias), IDS("clamp"), NULL, "--api vulkan"},
    {BIT(bias), IDS("api"), "bias -F fp32", ""},
    {BIT(texture), IDS("size"), "texture --synthetic plane --csv", ""},
    {BIT(table), IDS("model"), "table -F d24 -m d3d", ""},
    {BIT(table), IDS("arith"), NULL, "--model float"},
    {ALL & ~BIT(solve), IDS("log-c"), NULL, "-m log"},
    {BIT(solve), IDS("log-c"), "solve -f 1000 -F d24 -m log --separation 0.01 --at 50", ""},
};

/* Defaults that help tells in words: the value that they mean, in a line where it holds; null where no value means the
 * same (what is left undone, or depends on what is found). */
static const struct {
    unsigned verbs;
    const char *const *ids;
    const char *value, *line, *more; /* line null: the command's */
} meant[] = {
    {ALL & ~BIT(texture), IDS("output"), "-", NULL, ""},
    {BIT(texture), IDS("output"), "-", NULL, "--csv"},
    {ALL & ~BIT(plot), IDS("threads"), "1", NULL, ""},
    {BIT(plot), IDS("threads"), "1", "plot scene tests/models/street.obj --separation 0.02 --csv", ""},
    {BIT(table), IDS("at"), "0.1:1000:log:9", "table -F d24 -m d3d", ""},
    {BIT(table), IDS("at"), "0.1:1e5:log:9", "table -F d24 -m d3d -f inf", ""},
    {BIT(table), IDS("at"), "-3:7:lin:9", "table -F d24 -m d3d --ortho -n -3 -f 7", ""},
    {BIT(table), IDS("at"), "0.1,1,10,100,1000", NULL, ""},
    {BIT(table), IDS("at"), "-400,-200,0", "table -F d16,d24 -m d3d --ortho -n -500 -f 0", ""},
    {BIT(budget) | BIT(bias), IDS("at"), "0.1:1000:log:9", NULL, ""},
    {BIT(texture), IDS("at"), "0.1:1000:log:9", "texture --product effect:edge -F d16 -m d3d", ""},
    {BIT(shadow), IDS("at"), "0.1:1000:log:5", "shadow --spot 60 -F d24", ""},
    {BIT(world), IDS("at"), "10", NULL, ""},
    {BIT(world), IDS("at"), "10m", NULL, "--unit cm"},
    {BIT(world), IDS("separation"), "0.01", NULL, ""},
    {BIT(world), IDS("separation"), "1cm", NULL, "--unit m"},
    {BIT(solve), IDS("far"), "inf", NULL, "--csv"},
    {BIT(solve), IDS("for"), "near", NULL, ""},
    {BIT(solve), IDS("for"), "far", "solve -n 0.1 --separation 0.01 --at 50 -F d24 -m d3d", ""},
    {BIT(solve), IDS("for"), "format", "solve -n 0.1 -f 1000 --separation 0.01 --at 50 -m d3d", ""},
    {BIT(solve), IDS("for"), "mapping", "solve -n 0.1 -f 1000 --separation 0.01 --at 50 -F d24", ""},
    {BIT(solve), IDS("near"), "0.1", "solve --for far -F d24 -m d3d --separation 0.01 --at 50 --csv", ""},
    {BIT(solve), IDS("format"), "all", "solve -m d3d --separation 0.01 --at 50", ""},
    {BIT(solve), IDS("mapping"), "d3d,reversed", "solve -F d24 --separation 0.01 --at 50", ""},
    {BIT(solve), IDS("range"), "0.1:1000", "solve --for distance -n 0.1 -f 1000 -F d24 -m d3d --separation 0.01", ""},
    {BIT(solve), IDS("model"), "float", NULL, ""},
    {BIT(bias), IDS("raster"), "llvmpipe", "bias -F fp32 -m d3d --units -1 --range 1:9 --rasterize", ""},
    {BIT(bias), IDS("viewport"), "1920x1080", "bias -F fp32 -m d3d --units -1 --range 1:9 --rasterize", ""},
    {BIT(shadow), IDS("raster"), "llvmpipe", "shadow --light-box 9x9x9 --size 256 --rasterize", ""},
    {BIT(zfight), IDS("raster"), "llvmpipe", "zfight -F fp32 -m d3d --rasterize --sample 20", ""},
    {BIT(methods), IDS("format"), "unorm24", "methods interval --json", ""},
    {BIT(methods), IDS("mapping"), "d3d", "methods interval --json", ""},
    {BIT(texture), IDS("format"), "unorm24", NULL, "--pixel 9,9 --csv"},
    {BIT(texture), IDS("format"), "all", "texture --product effect:fog", ""},
    {BIT(texture), IDS("mapping"), "d3d,reversed", "texture --product effect:fog", ""},
    {BIT(texture), IDS("mapping"), "d3d", NULL, "--pixel 9,9 --csv"},
    {BIT(plot), IDS("range"), "0.1:1000", NULL, ""},
    {BIT(plot), IDS("range"), "0.1:1e5", NULL, "-f inf"},
    {BIT(prepass), IDS("range"), "0.1:1000", NULL, ""},
    {BIT(judge), IDS("near"), "0.1", NULL, "-f 1000"},
    {BIT(judge), IDS("far"), "1000", NULL, "-n 0.1"},
    {BIT(zfight), IDS("range"), "1:1.0078125", "zfight -n 1 -f 1.0078125 -F d24 -m d3d --csv", ""},
    {BIT(budget), IDS("scheme"), "absolute", NULL, "--from-origin 100"},
    {BIT(plot), IDS("viewport"), "1920x1080", "plot fight --csv", ""},
    {BIT(plot), IDS("viewport"), "1920x1080", "plot shadow --csv", ""},
    {BIT(scene), IDS("viewport"), "1920x1080", "scene tests/models/house.gltf --eye 0,2,30 --look 0,2,0", ""},
    {BIT(zfight), IDS("viewport"), "1920x1080", "zfight -F fp32 -m d3d --rasterize --sample 20", ""},
    {ALL & ~BIT(solve), IDS("unit"), "m", NULL, "-n 10cm"},
    {BIT(solve), IDS("unit"), "m", "solve --for far -n 10cm -F d24 -m d3d --separation 0.01 --at 50", ""},
    {BIT(world) | BIT(table) | BIT(budget), IDS("unit"), "cm", NULL, "--preset unreal"},
    /* what no value means */
    {ALL, IDS("ortho", "share", "hfov", "matrix", "light-box", "curvature", "spot", "engine", "bias", "normal-bias"),
     NULL, NULL, ""},
    {ALL, IDS("figure-size", "raster", "channel", "device", "define", "axes"), NULL, NULL, ""},
    {ALL, IDS("lattice", "as", "intrinsics"), NULL, NULL, ""},
    {ALL, IDS("eye", "look", "last-eye", "last-look", "sample"), NULL, NULL, ""},
    {ALL, IDS("tolerance", "within", "units", "remedy", "filter"), NULL, NULL, ""},
    {BIT(zfight) | BIT(bias) | BIT(plot) | BIT(scene), IDS("separation"), NULL, NULL, ""},
    {BIT(texture), IDS("range", "tint"), NULL, NULL, ""},                 /* test_png_out and test_compose have them */
    {BIT(table) | BIT(bias) | BIT(shadow), IDS("range"), NULL, NULL, ""}, /* given, more is said of it */
    {BIT(table) | BIT(budget) | BIT(bias) | BIT(solve), IDS("viewport"), NULL, NULL, ""},
    {BIT(world), IDS("from-origin"), NULL, NULL, ""},
    {BIT(prepass), IDS("prepass-format", "resolve", "half"), NULL, NULL, ""},
};

/* The default that a command takes where help spells it out; of two rows the first holds. */
static const struct {
    const char *id;
    unsigned verbs;
    const char *value;
} spelled[] = {
    {"near", ALL, "0.1"},
    {"far", BIT(world), "inf"},
    {"far", ALL, "1000"},
    {"format", BIT(table) | BIT(plot) | BIT(solve), "all"},
    {"format", BIT(code), "unorm24"},
    {"format", ALL, "fp32"},
    {"mapping", BIT(shadow), "d3d"},
    {"mapping", BIT(budget) | BIT(zfight) | BIT(prepass) | BIT(code) | BIT(world) | BIT(scene), "reversed"},
    {"mapping", ALL, "d3d,reversed"},
    {"log-c", ALL, "1"},
    {"depth-range", ALL, "0:1"},
    {"rounding", ALL, "nearest"},
    {"model", BIT(solve), "float"},
    {"model", ALL, "exact"},
    {"arith", ALL, "ieee"},
    {"tolerance", ALL, "5%"},
    {"interpolation", ALL, "0"},
    {"from-origin", BIT(prepass), "100"},
    {"from-origin", ALL, "0"},
    {"composition", ALL, "once"},
    {"scheme", ALL, "all"},
    {"log2", ALL, "vulkan"},
    {"fov", ALL, "60"},
    {"viewport", ALL, "1920x1080"},
    {"raster", ALL, "llvmpipe"},
    {"subpixel", ALL, "8"},
    {"slant", ALL, "0:90"},
    {"triangle-class", ALL, "depth=2,pixels=512,slim=16"},
    {"cascades", ALL, "4:0.5"},
    {"casters", ALL, "100"},
    {"kernel", ALL, "3"},
    {"angle", BIT(scene) | BIT(plot), "1"},
    {"angle", ALL, "75"},
    {"api", ALL, "d3d11"},
    {"factor", ALL, "0"},
    {"clamp", ALL, "0"},
    {"slope", ALL, "0"},
    {"sample", ALL, "1000000"},
    {"seed", ALL, "0"},
    {"against", ALL, "all"},
    {"program", ALL, "once"},
    {"vertices", ALL, "eye-log"},
    {"transforms", ALL, "exact"},
    {"eye", ALL, "0,0,0"},
    {"size", BIT(texture), "640x360"},
    {"size", ALL, "2048x2048"},
    {"sky", ALL, "0.0001"},
    {"language", ALL, "glsl"},
    {"what", ALL, "linearize"},
    {"read", ALL, "exact"},
    {"write", ALL, "nearest"},
    {"report", ALL, "text"},
    {"color", ALL, "auto"},
};

static const char *spelled_of(const char *id, const command_row *v) {
    for (size_t i = 0; i < sizeof spelled / sizeof spelled[0]; i++)
        if (strcmp(spelled[i].id, id) == 0 && (spelled[i].verbs & bit_of(v)) != 0)
            return spelled[i].value;
    fail_msg("%s --%s has a default that this test does not know", v->name, id);
    return NULL;
}

static bool among(const char *const *ids, const char *id) {
    while (*ids != NULL && strcmp(*ids, id) != 0)
        ids++;
    return *ids != NULL;
}

static const char *line_of_verb(const command_row *v) {
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++)
        if (lines[i].verb == bit_of(v))
            return lines[i].line;
    fail_msg("%s has no line in this test", v->name);
    return NULL;
}

static void line_of(const command_row *v, const char *id, char out[256]) {
    const char *line = line_of_verb(v), *more = "";
    for (size_t i = 0; i < sizeof besides / sizeof besides[0]; i++)
        if ((besides[i].verbs & bit_of(v)) != 0 && among(besides[i].ids, id)) {
            line = besides[i].line != NULL ? besides[i].line : line;
            more = besides[i].more;
        }
    snprintf(out, 256, "%s %s", line, more);
}

/* Times differ: what was measured is compared. */
static void keep_setup(char *text) {
    static const char *const keys[] = {"near", "far", "format", "mapping", "tolerance", "choice", "chosen"};
    json_t *root = json_of(text), *kept = json_object();
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++)
        json_object_set(kept, keys[i], json_object_get(root, keys[i]));
    assert_true(json_object_size(kept) >= 4);
    char *written = json_dumps(kept, JSON_SORT_KEYS);
    assert_true(strlen(written) <= strlen(text));
    strcpy(text, written);
    free(written);
    json_decref(kept);
    json_decref(root);
}

/* A default that is told, in the line where it holds. */
typedef struct trial {
    const command_row *v;
    const option_row *row;
    const char *value;
    char line[256];
    bool grouped;
} trial;

enum { TRIALS_MAX = 1024, GROUP_MAX = 64 };
static trial trials[TRIALS_MAX];
static size_t trial_count;

static void try_in(const command_row *v, const char *line, const option_row *row, const char *value) {
    assert_true(trial_count < TRIALS_MAX);
    trial *t = &trials[trial_count++];
    *t = (trial){.v = v, .row = row, .value = value};
    snprintf(t->line, sizeof t->line, "%s", line);
}

/* With all of a group given at once a command prints what it prints without; if not, half of them may tell more. Some
 * may not stand beside each other, but every one of them beside what the line has. */
static void same_with(tally *t, const trial *const *group, size_t count, const printed *without) {
    char line[4096];
    const trial *first = group[0];
    size_t used = (size_t)snprintf(line, sizeof line, "%s", first->line);
    for (size_t i = 0; i < count; i++)
        used += (size_t)snprintf(line + used, sizeof line - used, " --%s %s", group[i]->row->name, group[i]->value);
    assert_true(used < sizeof line);
    printed with = print_of("%s", line);
    if (bit_of(first->v) == BIT(methods) && with.status == 0)
        keep_setup(with.out);
    const bool same = with.status == without->status && strcmp(with.out, without->out) == 0;
    if (count > 1 && !same) {
        same_with(t, group, count / 2, without);
        same_with(t, group + count / 2, count - count / 2, without);
    } else {
        t->cases += count - 1;
        TALLY(t, same, "%s: exit status %d, not as without the option: %s%s", line, with.status, without->errors,
              with.errors);
    }
    printed_free(&with);
}

/* Those of one line and of different options, a group at a time. */
static void try_all(tally *t) {
    for (size_t i = 0; i < trial_count; i++) {
        const trial *group[GROUP_MAX];
        size_t count = 0;
        for (size_t k = i; k < trial_count; k++) {
            bool fits = count < GROUP_MAX && !trials[k].grouped && trials[k].v == trials[i].v &&
                        strcmp(trials[k].line, trials[i].line) == 0;
            for (size_t g = 0; g < count; g++)
                fits = fits && group[g]->row != trials[k].row;
            if (!fits)
                continue;
            trials[k].grouped = true;
            group[count++] = &trials[k];
        }
        if (count == 0)
            continue;
        printed without = print_of("%s", trials[i].line);
        TALLY(t, without.status <= 1 && without.out[0] != '\0', "%s: %s", trials[i].line, without.errors);
        if (bit_of(trials[i].v) == BIT(methods))
            keep_setup(without.out);
        same_with(t, group, count, &without);
        printed_free(&without);
    }
    trial_count = 0;
}

/* As its help shows it, or as one of its parts has it. */
static option_taken use_of(const command_row *v, const option_row *row) {
    const option_taken shown = option_used(v, v->shown, row);
    return shown.row != NULL ? shown : option_used(v, ~0U, row);
}

TEST(test_spelled_out) {
    tally t = {.name = "defaults"};
    int tried = 0;
    const option_row *all[OPTIONS_MAX + 1];
    const command_row *v;
    options_all(all);
    for (size_t i = 0; (v = command_get(i)) != NULL; i++)
        for (size_t o = 0; all[o] != NULL; o++) {
            const option_row *row = all[o];
            const option_taken use = use_of(v, row);
            const char *standard = NULL, *without = NULL;
            if (use.row != NULL)
                option_default(&use, &standard, &without);
            if (standard == NULL || strcmp(row->name, "theme") == 0 || strcmp(row->name, "type") == 0 ||
                strcmp(row->name, "normal-format") == 0 || bit_of(v) == BIT(probe))
                /* test_png_out, cli/web.txt and probe.sh have these */
                continue;
            char line[256];
            const char *value = spelled_of(row->name, v);
            line_of(v, row->name, line);
            TALLY(&t, strcmp(standard, value) == 0, "%s --%s: help says %s, not %s", v->name, row->name, standard,
                  value);
            try_in(v, line, row, value);
            tried++;
        }
    assert_true(tried >= 60);
    try_all(&t);
    tally_end(&t);
}

/* What the help of a command says, on one line. */
static void help_of(const command_row *v, char *out, size_t size) {
    printed p = print_of("help %s", v->name);
    size_t used = 0;
    for (const char *at = p.out; *at != '\0' && used + 1 < size; at++)
        if (!isspace((unsigned char)*at))
            out[used++] = *at;
        else if (used > 0 && out[used - 1] != ' ')
            out[used++] = ' ';
    out[used] = '\0';
    printed_free(&p);
}

/* Each default, in words or not, stands in the help of each command that takes the option. */
TEST(test_told_in_help) {
    tally t = {.name = "defaults in help"};
    static char help[1 << 16];
    const option_row *all[OPTIONS_MAX + 1];
    const command_row *v;
    options_all(all);
    for (size_t i = 0; (v = command_get(i)) != NULL; i++) {
        if (bit_of(v) == BIT(plot)) /* has the options of figures by figure */
            continue;
        help_of(v, help, sizeof help);
        for (size_t o = 0; all[o] != NULL; o++) {
            const option_taken use = use_of(v, all[o]);
            const char *standard = NULL, *without = NULL;
            char want[512];
            if (use.row != NULL)
                option_default(&use, &standard, &without);
            if (standard == NULL && without == NULL)
                continue;
            snprintf(want, sizeof want, "default%s%s%s%s)", standard != NULL ? " " : "",
                     standard != NULL ? standard : "", without != NULL ? ": " : "", without != NULL ? without : "");
            TALLY(&t, strstr(help, want) != NULL, "%s --%s: '%s' is not in its help", v->name, all[o]->name, want);
        }
    }
    tally_end(&t);
}

/* Each default in words is one of `meant`, and each of `meant` is told of an option. */
TEST(test_in_words) {
    tally t = {.name = "defaults in words"};
    const option_row *all[OPTIONS_MAX + 1];
    const command_row *v;
    options_all(all);
    for (size_t i = 0; (v = command_get(i)) != NULL; i++)
        for (size_t o = 0; all[o] != NULL; o++) {
            const option_row *row = all[o];
            const option_taken use = use_of(v, row);
            const char *standard = NULL, *without = NULL;
            if (use.row != NULL)
                option_default(&use, &standard, &without);
            const bool told = standard == NULL && without != NULL;
            size_t found = 0;
            for (size_t k = 0; k < sizeof meant / sizeof meant[0] && told; k++) {
                char line[256];
                if ((meant[k].verbs & bit_of(v)) == 0 || !among(meant[k].ids, row->name))
                    continue;
                found++;
                if (meant[k].value == NULL || bit_of(v) == BIT(probe))
                    continue;
                snprintf(line, sizeof line, "%s %s", meant[k].line != NULL ? meant[k].line : line_of_verb(v),
                         meant[k].more);
                try_in(v, line, row, meant[k].value);
            }
            TALLY(&t, found > 0 || !told, "%s --%s: '%s' is not tried here", v->name, row->name, without);
        }
    try_all(&t);
    TALLY(&t, t.cases > 300, "few cases");
    tally_end(&t);
}

/* Type and colours of a figure, whose metadata hold the command line. */
TEST(test_theme) {
    static const char *const themes[] = {"", "--theme light", "--type svg", "--theme dark"};
    char *text[4];
    for (int i = 0; i < 4; i++) {
        char file[512];
        snprintf(file, sizeof file, "%s", scratch_file("theme.svg"));
        printed p = print_of("plot error -F d24 -m d3d %s -o %s", themes[i], file);
        assert_int_equal(p.status, 0);
        printed_free(&p);
        char *whole = text_of_file(file), *command = strstr(whole, "depthprec plot error");
        assert_non_null(command);
        memset(command, ' ', strcspn(command, "<"));
        text[i] = malloc(strlen(whole) + 1);
        size_t used = 0;
        for (const char *c = whole; *c != '\0'; c++)
            if (*c != ' ')
                text[i][used++] = *c;
        text[i][used] = '\0';
        free(whole);
    }
    assert_string_equal(text[0], text[1]);
    assert_string_equal(text[0], text[2]);
    assert_string_not_equal(text[0], text[3]);
    for (int i = 0; i < 4; i++)
        free(text[i]);
}
