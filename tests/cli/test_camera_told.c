/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The camera that a text names is the one that was asked about, in every command and each form of its report. */
#include "printed.h"

typedef struct told_case {
    const char *line;
    bool only_perspective; /* --ortho is refused */
    bool named;            /* a perspective one is called so */
} told_case;

static const told_case cases[] = {
    {"table -F d24 -m d3d", false, true},
    {"table -F d24 -m d3d --full", false, true},
    {"table -F d24 -m d3d --depth .5", false, true},
    {"table -F d24 -m d3d --code 5", false, true},
    {"table -F d24,fp32,d16 -m d3d,gl", false, true},
    {"table -F d24,fp32 -m d3d,gl --csv", false, true},
    {"table -F d24,fp32 -m d3d,gl --json", false, true},
    {"bias -F d24 -m d3d --at 5", false, true},
    {"bias -F d24,d16 -m d3d,gl --api all --at 5", false, true},
    {"bias -F d24,d16 -m d3d,gl --api all --range 1:9 --separation 0.1", false, true},
    {"bias -F d24 -m d3d --units=-3 --at 5", false, true},
    {"bias -F d24 -m d3d --units=-3 --range 1:9", false, true},
    {"bias -F d24 -m d3d --range 1:9 --json", false, true},
    {"bias -F d24 -m d3d --remedy ray:1e-5 --range 1:9", true, true},
    {"budget -F d24 -m d3d --at 5", false, true},
    {"budget -F d24,fp32 -m d3d,reversed --at 5 --csv", false, true},
    {"zfight -F d16 -m d3d,gl --range 1:1.1", false, true},
    {"zfight -F d16 -m d3d --range 1:1.1 --json", false, true},
    {"prepass -F d24 -m d3d", false, true},
    {"scene tests/models/street.obj -F d24 -m d3d", true, true},
    {"world -F d24 -m d3d --at 5", true, true},
    {"code -m d3d", false, false},
    {"texture --synthetic plane --size 32x18 -F d24 -m d3d", false, true},
    {"texture --synthetic plane --size 32x18 -F d24 -m d3d --json", false, true},
    {"plot error -F d24 -m d3d --json", false, true},
    {"plot error -F d24,fp32 -m d3d,gl --json", false, true},
    {"plot interval -F d24 -m d3d --json", false, true},
    {"plot share -F d24 -m d3d --json", false, true},
    {"plot distribution -F d24 -m d3d --json", false, true},
    {"plot staircase -F d24 -m d3d --json", false, true},
    {"plot map -F d24 -m d3d --json", false, true},
    {"plot budget -F d24 -m d3d --json", false, true},
};

/* Every number of a text that stands behind a word. */
static bool has_number(const char *text, const char *word, double value) {
    for (const char *at = text; (at = strstr(at, word)) != NULL; at += strlen(word)) {
        char *end;
        const char *number = at + strlen(word) + strspn(at + strlen(word), " \":,\r\n");
        if (strtod(number, &end) == value && end != number)
            return true;
    }
    return false;
}

TEST(cameras_are_told) {
    static const struct {
        const char *options;
        double znear, zfar;
    } planes[] = {{"-n 0.37 -f 4321", 0.37, 4321}, {"-n 0.0625 -f 77.5", 0.0625, 77.5}};
    tally t = {.name = "cameras"};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
        for (int k = 0; k < (cases[i].only_perspective ? 1 : 2) * 2; k++) {
            const told_case *c = &cases[i];
            const bool ortho = k / 2 == 1, csv = strstr(c->line, "--csv") != NULL;
            printed p = print_of("%s %s%s", c->line, planes[k % 2].options, ortho ? " --ortho" : "");
            assert_true(p.status == 0 || p.status == 1);
            TALLY(&t, (strstr(p.out, "orthographic") != NULL) == ortho, "%s: orthographic", c->line);
            TALLY(&t, (strstr(p.out, "perspective") != NULL) == (c->named && !ortho), "%s: perspective", c->line);
            TALLY(&t, csv || has_number(p.out, "near", planes[k % 2].znear), "%s: no near %g", c->line,
                  planes[k % 2].znear);
            TALLY(&t, csv || has_number(p.out, "far", planes[k % 2].zfar), "%s: no far %g", c->line,
                  planes[k % 2].zfar);
            printed_free(&p);
        }
    tally_end(&t);
}

/* A format, a mapping, a rounding or a unit that was asked about is named, and none of the others. */
TEST(words_are_told) {
    static const char *const formats[] = {"unorm24", "fp32", "unorm16"}, *const maps[] = {"d3d", "gl-reversed",
                                                                                          "reversed"};
    static const char *const commands[] = {"table",
                                           "table --full",
                                           "table --depth .5",
                                           "bias --at 5 --api gl",
                                           "budget --at 5",
                                           "plot error --json",
                                           "plot interval --json",
                                           "texture --synthetic plane --size 32x18",
                                           "zfight --range 1:1.01 --sample 1000"};
    tally t = {.name = "words"};
    for (size_t i = 0; i < sizeof commands / sizeof commands[0]; i++)
        for (int k = 0; k < 3; k++) {
            char word[64];
            printed p = print_of("%s -n 1 -f 100 -F %s -m %s", commands[i], formats[k], maps[k]);
            snprintf(word, sizeof word, "%s %s", formats[k], maps[k]);
            TALLY(&t, p.status == 0 && strstr(p.out, word) != NULL, "%s: no %s in\n%s%s", commands[i], word, p.out,
                  p.errors);
            for (int other = 0; other < 3; other++) {
                snprintf(word, sizeof word, "%s %s", formats[other], maps[other]);
                TALLY(&t, other == k || strstr(p.out, word) == NULL, "%s: %s", commands[i], word);
            }
            printed_free(&p);
        }
    tally_end(&t);
}
