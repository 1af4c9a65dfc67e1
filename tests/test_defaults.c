/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Each default that help spells out: with it given, a command prints what it prints without. */
#include <stdlib.h>
#include <string.h>

#include "cli/option_rows.h"
#include "printed.h"

/* A line of each command that has defaults, small where the work depends on it. */
static const struct {
    unsigned verb;
    const char *line;
} lines[] = {
    {VERB_TABLE, "table"},
    {VERB_PLOT, "plot error --csv"},
    {VERB_ZFIGHT, "zfight --range 1:1.01"},
    {VERB_BUDGET, "budget"},
    {VERB_TEXTURE, "texture --scene steps --size 64x36"},
    {VERB_BENCH, "bench interval --json"},
    {VERB_CHECK, "check tests/needs/village.need"},
    {VERB_SOLVE, "solve -F d24 -m d3d --separation 0.01 --at 50"},
    {VERB_BIAS, "bias --units -1"},
    {VERB_STABILITY, "stability encode"},
    {VERB_SHADOW, "shadow"},
    {VERB_DISOCCLUSION, "disocclusion"},
    {VERB_WORLD, "world --distance 1e5"},
    {VERB_SCENE, "scene tests/models/street.obj --gap 0.02"},
    {VERB_LIST, "list scenes"},
};

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
    {VERB_PLOT, IDS(OPTION_PLANE), "plot fight --csv", ""},
    {VERB_PLOT, IDS(OPTION_INTERPOLATION, OPTION_WORLD), "plot budget -F d24 -m d3d --csv", ""},
    {VERB_PLOT, IDS(OPTION_COMPOSITION), "plot budget -F d24 -m d3d --csv", "--world 100"},
    {VERB_PLOT, IDS(OPTION_LOG2), "plot budget -F d24 -m log --csv", ""},
    {VERB_BUDGET, IDS(OPTION_LOG2), "budget -F d24 -m log", ""},
    {VERB_PLOT, IDS(OPTION_SLANT), "plot budget -F d24 -m d3d --csv", "--viewport 640x480"},
    {VERB_PLOT,
     IDS(OPTION_FOV, OPTION_SUBPIXEL, OPTION_TRIANGLE, OPTION_CASCADES, OPTION_LAMBDA, OPTION_CASTERS, OPTION_KERNEL,
         OPTION_ANGLE, OPTION_SIZE),
     "plot shadow --csv", ""},
    {VERB_PLOT, IDS(OPTION_TRANSFORMS), "plot scene-fights tests/models/street.obj --gap 0.02 --csv", ""},
    {VERB_PLOT, IDS(OPTION_ARITH), "plot interval -F d24 -m d3d --csv", "--model float"},
    {VERB_BUDGET, IDS(OPTION_COMPOSITION), NULL, "--world 100"},
    {VERB_TABLE | VERB_BUDGET | VERB_SOLVE | VERB_ZFIGHT | VERB_SCENE,
     IDS(OPTION_FOV, OPTION_SUBPIXEL, OPTION_SLANT, OPTION_TRIANGLE), NULL, "--viewport 640x480"},
    {VERB_ZFIGHT, IDS(OPTION_FOV, OPTION_RASTER, OPTION_SLANT, OPTION_TRIANGLE),
     "zfight -F fp32 -m d3d --triangles --sample 20", ""},
    {VERB_ZFIGHT, IDS(OPTION_WORLD, OPTION_PROGRAM, OPTION_VERTICES), "zfight -F d24 -m d3d",
     "--against fma --sample 1000"},
    {VERB_ZFIGHT, IDS(OPTION_SEED), NULL, "--sample 1000"},
    {VERB_BIAS, IDS(OPTION_FOV, OPTION_SUBPIXEL, OPTION_SLANT, OPTION_TRIANGLE), "bias --at 10", "--viewport 640x480"},
    {VERB_BIAS, IDS(OPTION_CLAMP), NULL, "--api vulkan"},
    {VERB_BIAS, IDS(OPTION_API), "bias -F fp32", ""},
    {VERB_SHADOW, IDS(OPTION_FACET), NULL, "--curvature 5"},
    {VERB_TEXTURE, IDS(OPTION_HALF_HEIGHT), NULL, "--ortho"},
    {VERB_TEXTURE, IDS(OPTION_SIZE), "texture --scene plane", ""},
    {VERB_TABLE, IDS(OPTION_MODEL), "table -F d24 -m d3d", ""},
    {VERB_TABLE, IDS(OPTION_ARITH), NULL, "--model float"},
    {VERB_TABLE | VERB_PLOT | VERB_TEXTURE | VERB_BIAS | VERB_SCENE, IDS(OPTION_LOG_C), NULL, "-m log"},
    {VERB_SOLVE, IDS(OPTION_SCHEME), "solve --for world", ""},
    {VERB_SOLVE, IDS(OPTION_LOG_C), "solve -f 1000 -F d24 -m log --separation 0.01 --at 50", ""},
};

static bool among(const option_id *ids, option_id id) {
    while (*ids != OPTION_COUNT && *ids != id)
        ids++;
    return *ids == id;
}

static void line_of(const verb *v, option_id id, char out[256]) {
    const char *line = NULL, *more = "";
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++)
        if (lines[i].verb == v->bit)
            line = lines[i].line;
    for (size_t i = 0; i < sizeof besides / sizeof besides[0]; i++)
        if ((besides[i].verbs & v->bit) != 0 && among(besides[i].ids, id)) {
            line = besides[i].line != NULL ? besides[i].line : line;
            more = besides[i].more;
        }
    if (line == NULL)
        fail_msg("%s has no line in this test", v->name);
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

static void test_spelled_out(void **state) {
    tally t = {.name = "defaults"};
    int tried = 0;
    (void)state;
    for (size_t i = 0; i < verb_count; i++)
        for (int id = 0; id < OPTION_COUNT; id++) {
            const verb *v = &verb_rows[i];
            const option_row *row = &option_rows[id];
            const struct option_exception *e = option_exception_of(row, v);
            const char *standard = e != NULL ? e->standard : row->standard;
            if ((row->commands & v->bit) == 0 || standard == NULL || id == OPTION_THEME || id == OPTION_TYPE ||
                id == OPTION_NORMAL_FORMAT || id == OPTION_PAGE || v->bit == VERB_PROBE)
                /* test_png_out, cli/web.txt and probe.sh have these */
                continue;
            char line[256];
            line_of(v, (option_id)id, line);
            printed without = print_of("%s", line), with = print_of("%s --%s %s", line, row->name, standard);
            if (v->bit == VERB_BENCH) {
                keep_setup(without.out);
                keep_setup(with.out);
            }
            TALLY(&t, without.status <= 1 && with.status == without.status && without.out[0] != '\0',
                  "%s --%s %s: %s%s", line, row->name, standard, without.errors, with.errors);
            TALLY(&t, strcmp(with.out, without.out) == 0, "%s: --%s %s is not the default", line, row->name, standard);
            printed_free(&without);
            printed_free(&with);
            tried++;
        }
    assert_true(tried >= 60);
    tally_end(&t);
}

/* Type and colours of a figure, whose metadata hold the command line. */
static void test_theme(void **state) {
    static const char *const themes[] = {"", "--theme light", "--type svg", "--theme dark"};
    char *text[4];
    (void)state;
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

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_spelled_out), cmocka_unit_test(test_theme)};
    return run_tap(tests);
}
