/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Each default that help spells out: with it given, a command prints what it prints without. */
#include "cli/option/uses.h"
#include "printed.h"

#define BIT(id) (1U << (id))

/* A line of each command that has defaults, small where the work depends on it. */
static const struct {
    unsigned verb;
    const char *line;
} lines[] = {
    {BIT(CMD_TABLE), "table"},
    {BIT(CMD_PLOT), "plot error --csv"},
    {BIT(CMD_ZFIGHT), "zfight --range 1:1.01"},
    {BIT(CMD_PREPASS), "prepass --sample 1000"},
    {BIT(CMD_BUDGET), "budget"},
    {BIT(CMD_TEXTURE), "texture --synthetic steps --size 64x36"},
    {BIT(CMD_METHODS), "methods interval --json"},
    {BIT(CMD_CHECK), "check tests/needs/village.need"},
    {BIT(CMD_SOLVE), "solve -F d24 -m d3d --separation 0.01 --at 50"},
    {BIT(CMD_BIAS), "bias --units -1"},
    {BIT(CMD_SHADOW), "shadow"},
    {BIT(CMD_WORLD), "world --from-origin 1e5"},
    {BIT(CMD_SCENE), "scene tests/models/street.obj --separation 0.02"},
    {BIT(CMD_LIST), "list synthetic"},
    {BIT(CMD_JUDGE), "judge --pairs tests/pairs/reversed.csv --csv"},
    {BIT(CMD_CODE), "code"},
};

#define ALL (~0U)

/* Where options matter only beside another, or in another line. */
#define IDS(...)                                                                                                       \
    (const option_id[]) {                                                                                              \
        __VA_ARGS__, OPTION_COUNT                                                                                      \
    }
static const struct {
    unsigned verbs;
    const option_id *ids;
    const char *line; /* in place of the command's; null: that */
    const char *more;
} besides[] = {
    {BIT(CMD_PLOT), IDS(OPTION_INTERPOLATION, OPTION_FROM_ORIGIN), "plot budget -F d24 -m d3d --csv", ""},
    {BIT(CMD_CODE), IDS(OPTION_FOV, OPTION_VIEWPORT), "code --what projection", ""},
    {BIT(CMD_PLOT), IDS(OPTION_COMPOSITION), "plot budget -F d24 -m d3d --csv", "--from-origin 100"},
    {BIT(CMD_PLOT), IDS(OPTION_LOG2), "plot budget -F d24 -m log --csv", ""},
    {BIT(CMD_BUDGET), IDS(OPTION_LOG2), "budget -F d24 -m log", ""},
    {BIT(CMD_PLOT), IDS(OPTION_SLANT), "plot budget -F d24 -m d3d --csv", "--viewport 640x480"},
    {BIT(CMD_PLOT),
     IDS(OPTION_FOV, OPTION_SUBPIXEL, OPTION_TRIANGLE_CLASS, OPTION_CASCADES, OPTION_CASTERS, OPTION_KERNEL,
         OPTION_SIZE),
     "plot shadow --csv", ""},
    {BIT(CMD_PLOT), IDS(OPTION_TRANSFORMS, OPTION_ANGLE), "plot scene tests/models/street.obj --separation 0.02 --csv",
     ""},
    {BIT(CMD_PLOT), IDS(OPTION_MODEL), "plot map -F d24 -m d3d --csv", ""},
    {BIT(CMD_BUDGET), IDS(OPTION_COMPOSITION), NULL, "--from-origin 100"},
    {BIT(CMD_TABLE) | BIT(CMD_BUDGET) | BIT(CMD_SOLVE) | BIT(CMD_ZFIGHT) | BIT(CMD_SCENE),
     IDS(OPTION_FOV, OPTION_SUBPIXEL, OPTION_SLANT, OPTION_TRIANGLE_CLASS), NULL, "--viewport 640x480"},
    {BIT(CMD_ZFIGHT), IDS(OPTION_FOV, OPTION_SLANT, OPTION_TRIANGLE_CLASS),
     "zfight -F fp32 -m d3d --rasterize --sample 20", ""},
    {BIT(CMD_ZFIGHT), IDS(OPTION_SEED), NULL, "--sample 1000"},
    {BIT(CMD_PREPASS), IDS(OPTION_SAMPLE), "prepass -F d24 -m d3d --against fma", ""},
    {BIT(CMD_BIAS), IDS(OPTION_FOV, OPTION_SUBPIXEL, OPTION_SLANT, OPTION_TRIANGLE_CLASS), "bias --at 10",
     "--viewport 640x480"},
    {BIT(CMD_BIAS), IDS(OPTION_CLAMP), NULL, "--api vulkan"},
    {BIT(CMD_BIAS), IDS(OPTION_API), "bias -F fp32", ""},
    {BIT(CMD_TEXTURE), IDS(OPTION_SIZE), "texture --synthetic plane", ""},
    {BIT(CMD_TABLE), IDS(OPTION_MODEL), "table -F d24 -m d3d", ""},
    {BIT(CMD_TABLE), IDS(OPTION_ARITH), NULL, "--model float"},
    {BIT(CMD_TABLE) | BIT(CMD_PLOT) | BIT(CMD_TEXTURE) | BIT(CMD_BIAS) | BIT(CMD_SCENE), IDS(OPTION_LOG_C), NULL,
     "-m log"},
    {BIT(CMD_SOLVE), IDS(OPTION_LOG_C), "solve -f 1000 -F d24 -m log --separation 0.01 --at 50", ""},
};

/* Defaults that help tells in words: the value that they mean, in a line where it holds; null where no value means the
 * same (what is left undone, or depends on what is found). */
static const struct {
    unsigned verbs;
    const option_id *ids;
    const char *value, *line, *more; /* line null: the command's */
} meant[] = {
    {ALL & ~BIT(CMD_TEXTURE), IDS(OPTION_OUTPUT), "-", NULL, ""},
    {BIT(CMD_TEXTURE), IDS(OPTION_OUTPUT), "-", NULL, "--csv"},
    {ALL & ~BIT(CMD_PLOT), IDS(OPTION_THREADS), "1", NULL, ""},
    {BIT(CMD_PLOT), IDS(OPTION_THREADS), "1", "plot scene tests/models/street.obj --separation 0.02 --csv", ""},
    {BIT(CMD_TABLE), IDS(OPTION_AT), "0.1:1000:log:9", "table -F d24 -m d3d", ""},
    {BIT(CMD_TABLE), IDS(OPTION_AT), "0.1:1e5:log:9", "table -F d24 -m d3d -f inf", ""},
    {BIT(CMD_TABLE), IDS(OPTION_AT), "-3:7:lin:9", "table -F d24 -m d3d --ortho -n -3 -f 7", ""},
    {BIT(CMD_TABLE), IDS(OPTION_AT), "0.1,1,10,100,1000", NULL, ""},
    {BIT(CMD_TABLE), IDS(OPTION_AT), "-400,-200,0", "table -F d16,d24 -m d3d --ortho -n -500 -f 0", ""},
    {BIT(CMD_BUDGET) | BIT(CMD_BIAS), IDS(OPTION_AT), "0.1:1000:log:9", NULL, ""},
    {BIT(CMD_TEXTURE), IDS(OPTION_AT), "0.1:1000:log:9", "texture --product effect:edge -F d16 -m d3d", ""},
    {BIT(CMD_WORLD), IDS(OPTION_AT), "10", NULL, ""},
    {BIT(CMD_WORLD), IDS(OPTION_AT), "10m", NULL, "--unit cm"},
    {BIT(CMD_WORLD), IDS(OPTION_SEPARATION), "0.01", NULL, ""},
    {BIT(CMD_WORLD), IDS(OPTION_SEPARATION), "1cm", NULL, "--unit m"},
    {BIT(CMD_SOLVE), IDS(OPTION_FAR), "inf", NULL, "--csv"},
    {BIT(CMD_SOLVE), IDS(OPTION_FOR), "near", NULL, ""},
    {BIT(CMD_SOLVE), IDS(OPTION_FOR), "far", "solve -n 0.1 --separation 0.01 --at 50 -F d24 -m d3d", ""},
    {BIT(CMD_SOLVE), IDS(OPTION_FOR), "format", "solve -n 0.1 -f 1000 --separation 0.01 --at 50 -m d3d", ""},
    {BIT(CMD_SOLVE), IDS(OPTION_FOR), "mapping", "solve -n 0.1 -f 1000 --separation 0.01 --at 50 -F d24", ""},
    {BIT(CMD_SOLVE), IDS(OPTION_NEAR), "0.1", "solve --for far -F d24 -m d3d --separation 0.01 --at 50 --csv", ""},
    {BIT(CMD_SOLVE), IDS(OPTION_FORMAT), "all", "solve -m d3d --separation 0.01 --at 50", ""},
    {BIT(CMD_SOLVE), IDS(OPTION_MAPPING), "all", "solve -F d24 --separation 0.01 --at 50", ""},
    {BIT(CMD_SOLVE), IDS(OPTION_RANGE), "0.1:1000",
     "solve --for distance -n 0.1 -f 1000 -F d24 -m d3d --separation 0.01", ""},
    {BIT(CMD_SOLVE), IDS(OPTION_MODEL), "float", NULL, ""},
    {BIT(CMD_ZFIGHT), IDS(OPTION_RASTER), "llvmpipe", "zfight -F fp32 -m d3d --rasterize --sample 20", ""},
    {BIT(CMD_METHODS), IDS(OPTION_FORMAT), "unorm24", NULL, ""},
    {BIT(CMD_METHODS), IDS(OPTION_MAPPING), "d3d", NULL, ""},
    {BIT(CMD_TEXTURE), IDS(OPTION_FORMAT), "unorm24", NULL, "--pixel 9,9 --csv"},
    {BIT(CMD_TEXTURE), IDS(OPTION_FORMAT, OPTION_MAPPING), "all", "texture --product effect:fog", ""},
    {BIT(CMD_TEXTURE), IDS(OPTION_MAPPING), "d3d", NULL, "--pixel 9,9 --csv"},
    {BIT(CMD_PLOT), IDS(OPTION_RANGE), "0.1:1000", NULL, ""},
    {BIT(CMD_PLOT), IDS(OPTION_RANGE), "0.1:1e5", NULL, "-f inf"},
    {BIT(CMD_PREPASS), IDS(OPTION_RANGE), "0.1:1000", NULL, ""},
    {BIT(CMD_JUDGE), IDS(OPTION_NEAR), "0.1", NULL, "-f 1000"},
    {BIT(CMD_JUDGE), IDS(OPTION_FAR), "1000", NULL, "-n 0.1"},
    {BIT(CMD_ZFIGHT), IDS(OPTION_RANGE), "1:1.0078125", "zfight -n 1 -f 1.0078125 -F d24 -m d3d --csv", ""},
    {BIT(CMD_BUDGET), IDS(OPTION_SCHEME), "absolute", NULL, "--from-origin 100"},
    {BIT(CMD_PLOT), IDS(OPTION_VIEWPORT), "1920x1080", "plot fight --csv", ""},
    {BIT(CMD_PLOT), IDS(OPTION_VIEWPORT), "1920x1080", "plot shadow --csv", ""},
    {BIT(CMD_SCENE), IDS(OPTION_VIEWPORT), "1920x1080", "scene tests/models/house.gltf --eye 0,2,30 --look 0,2,0", ""},
    {BIT(CMD_ZFIGHT), IDS(OPTION_VIEWPORT), "1920x1080", "zfight -F fp32 -m d3d --rasterize --sample 20", ""},
    {ALL & ~BIT(CMD_SOLVE), IDS(OPTION_UNIT), "m", NULL, "-n 10cm"},
    {BIT(CMD_SOLVE), IDS(OPTION_UNIT), "m", "solve --for far -n 10cm -F d24 -m d3d --separation 0.01 --at 50", ""},
    {BIT(CMD_WORLD) | BIT(CMD_TABLE) | BIT(CMD_BUDGET), IDS(OPTION_UNIT), "cm", NULL, "--preset unreal"},
    /* what no value means */
    {ALL, IDS(OPTION_ORTHO, OPTION_SHARE, OPTION_HFOV, OPTION_MATRIX, OPTION_LIGHT_BOX, OPTION_CURVATURE), NULL, NULL,
     ""},
    {ALL, IDS(OPTION_FIGURE_SIZE, OPTION_RASTER, OPTION_CHANNEL, OPTION_DEVICE, OPTION_DEFINE, OPTION_AXES), NULL, NULL,
     ""},
    {ALL, IDS(OPTION_LATTICE, OPTION_AS, OPTION_INTRINSICS), NULL, NULL, ""},
    {ALL, IDS(OPTION_EYE, OPTION_LOOK, OPTION_LAST_EYE, OPTION_LAST_LOOK, OPTION_SAMPLE), NULL, NULL, ""},
    {ALL, IDS(OPTION_TOLERANCE, OPTION_WITHIN, OPTION_UNITS), NULL, NULL, ""},
    {BIT(CMD_ZFIGHT) | BIT(CMD_BIAS) | BIT(CMD_PLOT) | BIT(CMD_SCENE), IDS(OPTION_SEPARATION), NULL, NULL, ""},
    {BIT(CMD_TEXTURE), IDS(OPTION_RANGE, OPTION_TINT), NULL, NULL, ""}, /* test_png_out and test_compose have them */
    {BIT(CMD_TABLE) | BIT(CMD_BIAS) | BIT(CMD_SHADOW), IDS(OPTION_RANGE), NULL, NULL,
     ""}, /* given, more is said of it */
    {BIT(CMD_TABLE) | BIT(CMD_BUDGET) | BIT(CMD_BIAS) | BIT(CMD_SOLVE), IDS(OPTION_VIEWPORT), NULL, NULL, ""},
    {BIT(CMD_WORLD), IDS(OPTION_FROM_ORIGIN), NULL, NULL, ""},
};

/* What a command takes where nothing was said and help spells it out; of two rows the first holds. */
static const struct {
    option_id id;
    unsigned verbs;
    const char *value;
} spelled[] = {
    {OPTION_NEAR, ALL, "0.1"},
    {OPTION_FAR, BIT(CMD_WORLD), "inf"},
    {OPTION_FAR, ALL, "1000"},
    {OPTION_FORMAT, BIT(CMD_TABLE) | BIT(CMD_PLOT) | BIT(CMD_SOLVE), "all"},
    {OPTION_FORMAT, ALL, "fp32"},
    {OPTION_MAPPING, BIT(CMD_SHADOW), "d3d"},
    {OPTION_MAPPING,
     BIT(CMD_BUDGET) | BIT(CMD_ZFIGHT) | BIT(CMD_PREPASS) | BIT(CMD_CODE) | BIT(CMD_WORLD) | BIT(CMD_SCENE),
     "reversed"},
    {OPTION_MAPPING, ALL, "all"},
    {OPTION_LOG_C, ALL, "1"},
    {OPTION_ROUNDING, ALL, "nearest"},
    {OPTION_MODEL, BIT(CMD_SOLVE), "float"},
    {OPTION_MODEL, ALL, "exact"},
    {OPTION_ARITH, ALL, "ieee"},
    {OPTION_TOLERANCE, ALL, "5%"},
    {OPTION_INTERPOLATION, ALL, "0"},
    {OPTION_FROM_ORIGIN, BIT(CMD_PREPASS), "100"},
    {OPTION_FROM_ORIGIN, ALL, "0"},
    {OPTION_COMPOSITION, ALL, "once"},
    {OPTION_SCHEME, ALL, "all"},
    {OPTION_LOG2, ALL, "vulkan"},
    {OPTION_FOV, ALL, "60"},
    {OPTION_VIEWPORT, ALL, "1920x1080"},
    {OPTION_RASTER, ALL, "llvmpipe"},
    {OPTION_SUBPIXEL, ALL, "8"},
    {OPTION_SLANT, ALL, "0:90"},
    {OPTION_TRIANGLE_CLASS, ALL, "depth=2,pixels=512,slim=16"},
    {OPTION_CASCADES, ALL, "4:0.5"},
    {OPTION_CASTERS, ALL, "100"},
    {OPTION_KERNEL, ALL, "3"},
    {OPTION_ANGLE, BIT(CMD_SCENE) | BIT(CMD_PLOT), "1"},
    {OPTION_ANGLE, ALL, "75"},
    {OPTION_API, ALL, "d3d11"},
    {OPTION_FACTOR, ALL, "0"},
    {OPTION_CLAMP, ALL, "0"},
    {OPTION_SLOPE, ALL, "0"},
    {OPTION_SAMPLE, ALL, "1000000"},
    {OPTION_SEED, ALL, "0"},
    {OPTION_AGAINST, ALL, "all"},
    {OPTION_PROGRAM, ALL, "once"},
    {OPTION_VERTICES, ALL, "eye-log"},
    {OPTION_TRANSFORMS, ALL, "exact"},
    {OPTION_EYE, ALL, "0,0,0"},
    {OPTION_SIZE, BIT(CMD_TEXTURE), "640x360"},
    {OPTION_SIZE, ALL, "2048x2048"},
    {OPTION_SKY, ALL, "0.0001"},
    {OPTION_LANGUAGE, ALL, "glsl"},
    {OPTION_WHAT, ALL, "linearize"},
    {OPTION_REPORT, ALL, "text"},
    {OPTION_COLOR, ALL, "auto"},
};

static const char *spelled_of(option_id id, const command_row *v) {
    for (size_t i = 0; i < sizeof spelled / sizeof spelled[0]; i++)
        if (spelled[i].id == id && (spelled[i].verbs & BIT(v->id)) != 0)
            return spelled[i].value;
    fail_msg("%s --%s has a default that this test does not know", v->name, option_rows[id].name);
    return NULL;
}

static bool among(const option_id *ids, option_id id) {
    while (*ids != OPTION_COUNT && *ids != id)
        ids++;
    return *ids == id;
}

static const char *line_of_verb(const command_row *v) {
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++)
        if (lines[i].verb == BIT(v->id))
            return lines[i].line;
    fail_msg("%s has no line in this test", v->name);
    return NULL;
}

static void line_of(const command_row *v, option_id id, char out[256]) {
    const char *line = line_of_verb(v), *more = "";
    for (size_t i = 0; i < sizeof besides / sizeof besides[0]; i++)
        if ((besides[i].verbs & BIT(v->id)) != 0 && among(besides[i].ids, id)) {
            line = besides[i].line != NULL ? besides[i].line : line;
            more = besides[i].more;
        }
    snprintf(out, 256, "%s %s", line, more);
}

/* Of what is timed, what was measured. */
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

static void same_with(tally *t, const command_row *v, const char *line, const option_row *row, const char *value) {
    printed without = print_of("%s", line), with = print_of("%s --%s %s", line, row->name, value);
    if (BIT(v->id) == BIT(CMD_METHODS)) {
        keep_setup(without.out);
        keep_setup(with.out);
    }
    TALLY(t, without.status <= 1 && with.status == without.status && without.out[0] != '\0', "%s --%s %s: %s%s", line,
          row->name, value, without.errors, with.errors);
    TALLY(t, strcmp(with.out, without.out) == 0, "%s: --%s %s is not the default", line, row->name, value);
    printed_free(&without);
    printed_free(&with);
}

/* As its help shows it, or as one of its parts has it. */
static const option_use *use_of(const command_row *v, option_id id) {
    const option_use *shown = option_used(v, v->shown, id);
    return shown != NULL ? shown : option_used(v, ~0U, id);
}

TEST(test_spelled_out) {
    tally t = {.name = "defaults"};
    int tried = 0;
    for (size_t i = 0; i < command_count; i++)
        for (int id = 0; id < OPTION_COUNT; id++) {
            const command_row *v = &command_rows[i];
            const option_row *row = &option_rows[id];
            const option_use *use = use_of(v, (option_id)id);
            const char *standard = NULL, *without = NULL;
            if (use != NULL)
                option_default(use, &standard, &without);
            if (standard == NULL || id == OPTION_THEME || id == OPTION_TYPE || id == OPTION_NORMAL_FORMAT ||
                BIT(v->id) == BIT(CMD_PROBE))
                /* test_png_out, cli/web.txt and probe.sh have these */
                continue;
            char line[256];
            const char *value = spelled_of((option_id)id, v);
            line_of(v, (option_id)id, line);
            TALLY(&t, strcmp(standard, value) == 0, "%s --%s: help says %s, not %s", v->name, row->name, standard,
                  value);
            same_with(&t, v, line, row, value);
            tried++;
        }
    assert_true(tried >= 60);
    tally_end(&t);
}

/* Each default in words is one of `meant`, and each of `meant` is told of an option. */
TEST(test_in_words) {
    tally t = {.name = "defaults in words"};
    for (size_t i = 0; i < command_count; i++)
        for (int id = 0; id < OPTION_COUNT; id++) {
            const command_row *v = &command_rows[i];
            const option_row *row = &option_rows[id];
            const option_use *use = use_of(v, (option_id)id);
            const char *standard = NULL, *without = NULL;
            if (use != NULL)
                option_default(use, &standard, &without);
            const bool told = standard == NULL && without != NULL;
            size_t found = 0;
            for (size_t k = 0; k < sizeof meant / sizeof meant[0] && told; k++) {
                char line[256];
                if ((meant[k].verbs & BIT(v->id)) == 0 || !among(meant[k].ids, (option_id)id))
                    continue;
                found++;
                if (meant[k].value == NULL || BIT(v->id) == BIT(CMD_PROBE))
                    continue;
                snprintf(line, sizeof line, "%s %s", meant[k].line != NULL ? meant[k].line : line_of_verb(v),
                         meant[k].more);
                same_with(&t, v, line, row, meant[k].value);
            }
            TALLY(&t, found > 0 || !told, "%s --%s: '%s' is not tried here", v->name, row->name, without);
        }
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
