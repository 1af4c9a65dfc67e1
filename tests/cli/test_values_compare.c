/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The comparison of several set-ups, and what is said of one: each number against the library. A distance is right when
 * the separation is guaranteed over all depths up to it, and not over those up to one unit of its last digit farther.
 */
#include <ctype.h>

#include "printed.h"

enum { LIMITS = 3, DEPTHS_MAX = 5, COLUMNS = 24, WORD = 48 };

static const double limits[LIMITS] = {0.001, 0.01, 0.1};

typedef struct camera {
    const char *options;
    double znear, zfar;
    int ortho;
    int depths; /* columns */
    double z[DEPTHS_MAX];
    size_t rows;
    const dp_triangles *triangles; /* null: surfaces face the camera */
} camera;

static const dp_triangles hd = {1920, 1080, 60, 8, {2, 11, 2, 0}, 0, 90, 2, 512, 16};
static const dp_triangles mesa = {640, 480, 40, 0, {3, 10, 2, 4}, 10, 80, 2, 512, 16};

static const camera cameras[] = {
    {"", 0.1, 1000, 0, 5, {0.1, 1, 10, 100, 1000}, 8, NULL},
    {"-n 0.3 -f 5000 -F d24,fp32,d16 -m gl,gl-reversed,log", 0.3, 5000, 0, 4, {1, 10, 100, 1000}, 9, NULL},
    {"-n 0.01 -f inf -F all -m reversed,d3d --at 0.5,7,900", 0.01, INFINITY, 0, 3, {0.5, 7, 900}, 8, NULL},
    {"-n 0.5 -f inf -F d24,fp32 -m reversed", 0.5, INFINITY, 0, 3, {10, 1000, 1e5}, 2, NULL},
    {"--ortho -n 2 -f 700 -F unorm16,fp32 -m d3d", 2, 700, 1, 2, {10, 100}, 2, NULL},
    {"--ortho -n -500 -f -5 -F d16,d24 -m d3d", -500, -5, 1, 5, {-500, -400, -300, -200, -100}, 2, NULL},
    {"--ortho -n 0 -f 5 -F d16,fp32 -m d3d,reversed", 0, 5, 1, 3, {0, 2, 4}, 4, NULL},
    {"--ortho -n -3 -f 7 -F d16,fp32 -m gl", -3, 7, 1, 5, {-2, 0, 2, 4, 6}, 2, NULL},
    {"--ortho -n -0.3 -f 0.1 -F d24,fp32 -m d3d", -0.3, 0.1, 1, 4, {-0.2, -0.1, 0, 0.1}, 2, NULL},
    {"-n 0.05 -f 2e7 -F d24,fp32 -m reversed", 0.05, 2e7, 0, 5, {0.1, 10, 1000, 1e5, 1e7}, 2, NULL},
    {"-n 3 -f 5 -F d24,fp32 -m reversed", 3, 5, 0, 1, {5}, 2, NULL},
    {"-F d16,d24 -m d3d --at 400,900,999", 0.1, 1000, 0, 3, {400, 900, 999}, 2, NULL}, /* two of them too near to far */
    {"--viewport 1920x1080", 0.1, 1000, 0, 5, {0.1, 1, 10, 100, 1000}, 8, &hd},
    {"-m d3d,log -F d24 --viewport 1920x1080", 0.1, 1000, 0, 5, {0.1, 1, 10, 100, 1000}, 1, &hd},
    {"-n 0.2 -f 7e4 -F d24,fp32 -m reversed,d3d --viewport 640x480 --fov 40 --raster llvmpipe --slant 10:80 "
     "--at 2,900,70000",
     0.2,
     7e4,
     0,
     3,
     {2, 900, 7e4},
     4,
     &mesa},
};

typedef struct words {
    int count;
    char word[COLUMNS][WORD];
} words;

static words split(const char *line) {
    words w = {0};
    const size_t length = strcspn(line, "\n");
    for (size_t at = 0; at < length && w.count < COLUMNS;) {
        at += strspn(line + at, " ");
        const size_t size = strcspn(line + at, " \n");
        if (size > 0 && at < length)
            snprintf(w.word[w.count++], WORD, "%.*s", (int)size, line + at);
        at += size;
    }
    return w;
}

static const char *next_line(const char *text) {
    text += strcspn(text, "\n");
    return text + (*text == '\n');
}

/* A unit of the last of so many significant digits. */
static double unit_of(double value, int digits) {
    return pow(10.0, floor(log10(fabs(value)) + 1e-12) - digits + 1);
}

static dp_setup full_setup(const camera *c, const char *format, const char *mapping) {
    dp_spec spec = {.znear = c->znear, .zfar = c->zfar, .ortho = c->ortho};
    if (c->triangles != NULL)
        spec.triangles = *c->triangles;
    if (c->triangles == &mesa)
        assert_int_equal(dp_arith_parse("mesa", &spec.arith), DP_OK); /* its rasterizer brings it */
    assert_int_equal(dp_mapping_parse(mapping, &spec.mapping), DP_OK);
    const dp_setup setup = setup_with(format, spec);
    return dp_setup_guaranteed(&setup);
}

/* Rounded up in the second digit: not below, and less than a unit above. */
static void check_separation(tally *t, const dp_setup *setup, double z, const char *word) {
    const double want = dp_separation(setup, z), got = strtod(word, NULL);
    TALLY(t, isinf(want) ? strcmp(word, "inf") == 0 : got >= want && got <= want + unit_of(want, 2) * 1.001,
          "%s at %g: printed %s, computed %.17g", setup->spec.format.name, z, word, want);
}

/* Is `limit` guaranteed at every depth up to z? */
static bool holds(const dp_setup *setup, double z, double limit) {
    dp_separation_worst w;
    assert_int_equal(dp_separation_over(setup, setup->spec.znear, z, limit, &w), DP_OK);
    return w.bound <= limit;
}

static void check_reach(tally *t, const dp_setup *setup, double limit, const char *word) {
    const double z = strcmp(word, "far") == 0 ? setup->spec.zfar : strtod(word, NULL);
    const double more = isfinite(z) ? z + 2.0 * unit_of(z, 3) : z;
    if (strcmp(word, "-") == 0) {
        TALLY(t, dp_separation(setup, setup->spec.znear) > limit, "%s: %g holds at near", setup->spec.format.name,
              limit);
        return;
    }
    TALLY(t, z >= setup->spec.znear - 0.01 * fabs(setup->spec.znear) && holds(setup, fmax(z, setup->spec.znear), limit),
          "%s %d: %g does not hold up to %s", setup->spec.format.name, setup->spec.mapping, limit, word);
    TALLY(t,
          z >= setup->spec.zfar - 0.01 * fabs(setup->spec.zfar) || !holds(setup, fmin(more, setup->spec.zfar), limit),
          "%s %d: %g holds beyond %s", setup->spec.format.name, setup->spec.mapping, limit, word);
}

static void check_row(tally *t, const camera *c, const words *w, double before) {
    const dp_setup setup = full_setup(c, w->word[0], w->word[1]);
    const int first = w->count - 1 - LIMITS - c->depths;
    TALLY(t, first == 2, "%s %s: %d words", w->word[0], w->word[1], w->count);
    if (first != 2)
        return;
    TALLY(t, c->triangles == NULL || setup.spec.model == DP_MODEL_FLOAT, "%s %s: a row without a guarantee", w->word[0],
          w->word[1]);
    for (int i = 0; i < c->depths; i++)
        check_separation(t, &setup, c->z[i], w->word[first + i]);
    for (int i = 0; i < LIMITS; i++)
        check_reach(t, &setup, limits[i], w->word[first + c->depths + i]);
    TALLY(t, strtod(w->word[first + c->depths + 1], NULL) <= before, "%s %s stands behind a worse one", w->word[0],
          w->word[1]);
    TALLY(t, atoi(w->word[w->count - 1]) == (setup.spec.format.bits > 16 ? 4 : 2), "%s: bytes", w->word[0]);
}

static void check_titles(tally *t, const camera *c, const words *w) {
    for (int i = 0; i < c->depths; i++)
        TALLY(t, strtod(w->word[i], NULL) == c->z[i], "title %s is not %g", w->word[i], c->z[i]);
    for (int i = 0; i < LIMITS; i++)
        TALLY(t, strtod(w->word[c->depths + i], NULL) == limits[i], "title %s", w->word[c->depths + i]);
}

/* Sentences without their line breaks. */
static void flatten(const char *text, char *flat, size_t size) {
    size_t used = 0;
    for (const char *at = text; *at != '\0' && used + 1 < size; at++)
        if (*at != '\n' || at[1] != ' ')
            flat[used++] = *at == '\n' ? '|' : *at;
        else {
            flat[used++] = ' ';
            at += 2;
        }
    flat[used] = '\0';
}

/* "fp32 d3d from 121 to 1000" and the like say again what the rows say: the words are in the table. */
static void check_verdicts(tally *t, const camera *c, const char *text, const char *rows) {
    const words best = split(rows);
    const char *slant = c->triangles == NULL           ? " facing the camera"
                        : c->triangles->slant_lo == 10 ? " at 10 to 80 degrees"
                                                       : " at any slant";
    const char *reach = best.word[2 + c->depths + 1];
    const bool to_far = strtod(reach, NULL) >= c->zfar - 0.01 * fabs(c->zfar);
    char want[128];
    snprintf(want, sizeof want, "%s %s", best.word[0], best.word[1]);
    TALLY(t, strncmp(text, want, strlen(want)) == 0 || strstr(text, want) != NULL, "the best is %s: %s", want, text);
    if (to_far)
        snprintf(want, sizeof want, "%s all the way to the far plane.", slant);
    else
        snprintf(want, sizeof want, " 0.01%s up to z = %s.", slant, reach);
    char flat[2048];
    flatten(text, flat, sizeof flat);
    TALLY(t, strstr(flat, want) != NULL, "'%s' is not said: %s", want, flat);
}

/* Up to where 0.01 is resolved, as sentences have it. */
static const char *limit_of(const camera *c, const words *row) {
    const char *word = row->word[row->count - 3];
    return strtod(word, NULL) >= c->zfar - 0.01 * fabs(c->zfar) ? "the far plane" : word;
}

/* Of each row the first depth shown before far from which on less is left up to far than what is guaranteed; and what
 * reversing gains is what both rows say. @return sentences' parts that were judged */
static int check_more(tally *t, const camera *c, const char *text, const words *rows, size_t count) {
    char flat[4096], want[160];
    int parts = 0;
    flatten(text, flat, sizeof flat);
    for (size_t i = 0; i < count; i++) {
        const words *w = &rows[i];
        const dp_setup setup = full_setup(c, w->word[0], w->word[1]);
        int k = 0;
        while (k < c->depths && (c->z[k] >= c->zfar || dp_separation(&setup, c->z[k]) <= c->zfar - c->z[k]))
            k++;
        snprintf(want, sizeof want, " %s %s from z = ", w->word[0], w->word[1]);
        const char *at = strstr(flat, "Nothing behind is certain, up to far:");
        at = at != NULL ? strstr(at, want) : NULL;
        const double z = at != NULL ? strtod(at + strlen(want), NULL) : NAN;
        TALLY(t, k < c->depths ? z == c->z[k] : isnan(z), "%s:%sis %g, not %g", c->options, want, z,
              k < c->depths ? c->z[k] : NAN);
        parts += k < c->depths;
        for (size_t j = 0; j < count; j++) {
            const char *before = limit_of(c, w), *after = limit_of(c, &rows[j]);
            snprintf(want, sizeof want, "%sreversed", strcmp(w->word[1], "gl") == 0 ? "gl-" : "");
            if ((strcmp(w->word[1], "gl") != 0 && strcmp(w->word[1], "d3d") != 0) ||
                strcmp(rows[j].word[1], want) != 0 || strcmp(rows[j].word[0], w->word[0]) != 0 ||
                strncmp(w->word[0], "fp16", 4) == 0 || *before == '-')
                continue;
            snprintf(want, sizeof want, strcmp(before, after) == 0 ? " %s %s not at all" : " %s %s from %s to %s",
                     w->word[0], w->word[1], before, after);
            at = strstr(flat, "Reversing moves the limit for 0.01:");
            TALLY(t, at != NULL && strstr(at, want) != NULL, "%s:%s is not said: %s", c->options, want, flat);
            parts++;
        }
    }
    return parts;
}

TEST(test_comparison) {
    tally t = {.name = "comparison"};
    int parts = 0;
    for (size_t i = 0; i < sizeof cameras / sizeof cameras[0]; i++) {
        const camera *c = &cameras[i];
        printed p = print_of("table %s", c->options);
        assert_int_equal(p.status, 0);
        const char *line = strstr(p.out, " resolved up to z");
        assert_non_null(line);
        line = next_line(line);
        const words titles = split(line);
        check_titles(&t, c, &titles);
        const char *rows = line = next_line(line);
        double before = HUGE_VAL;
        words all[16];
        size_t count = 0;
        for (; *line != '\n' && *line != '\0'; line = next_line(line), count++) {
            const words w = all[count] = split(line);
            check_row(&t, c, &w, before);
            before = fmin(before, strtod(w.word[2 + c->depths + 1], NULL));
        }
        TALLY(&t, count == c->rows, "%s: %zu rows, not %zu", c->options, count, c->rows);
        check_verdicts(&t, c, next_line(line), rows);
        parts += check_more(&t, c, next_line(line), all, count);
        int lines = 0;
        for (line = p.out; *line != '\0'; line = next_line(line), lines++)
            TALLY(&t, strcspn(line, "\n") <= 80, "wider than 80: %.*s", (int)strcspn(line, "\n"), line);
        TALLY(&t, lines <= 40, "%d lines", lines);
        printed_free(&p);
    }
    assert_true(parts > 10);
    tally_end(&t);
}

/* Below the table stand the mappings that promise only surfaces that face the camera, with how far, and what each costs
 * that a shader writes; those that the hardware computes cost nothing. */
TEST(test_facing) {
    static const camera c = {"", 0.1, 5000, 0, 0, {0}, 0, NULL};
    tally t = {.name = "facing"};
    printed p = print_of("table -f 5000 -F d24 -m log,d3d,linear --viewport 1920x1080");
    char flat[4096];
    static const char before[] =
        "unorm24 log guarantees nothing at a slant; facing the camera it resolves 0.01 up to z = ";
    flatten(p.out, flat, sizeof flat);
    const char *at = strstr(flat, before);
    assert_non_null(at);
    const dp_setup setup = full_setup(&c, "unorm24", "log");
    char word[WORD];
    snprintf(word, sizeof word, "%.*s", (int)strspn(at + strlen(before), "0123456789"), at + strlen(before));
    check_reach(&t, &setup, 0.01, word);
    assert_non_null(strstr(flat, "|Cost of log: the fragment shader writes depth, so no early z."));
    assert_non_null(strstr(flat, "|Cost of linear: "));
    assert_null(strstr(flat, "Cost of d3d"));
    assert_null(strstr(flat, " - "));
    assert_non_null(strstr(flat, "|B: bytes a pixel."));
    printed_free(&p);
    tally_end(&t);
}

/* three.js' own words: of WebGLRenderer's logarithm, of WebGPURenderer's, and reversed. */
TEST(test_three) {
    static const char *const said[][2] = {{"--preset three -m logarithmicDepthBuffer", "three-webgl"},
                                          {"--preset three-webgpu -F d24 -m LOGARITHMICdepthbuffer", "three-webgpu"},
                                          {"--preset three-webgpu -F d24 -m three-webgl", "three-webgl"},
                                          {"--preset three -m reversedDepthBuffer", "reversed"}};
    for (size_t i = 0; i < sizeof said / sizeof said[0]; i++) {
        printed p = print_of("table %s", said[i][0]);
        const words heading = split(p.out);
        const size_t length = strlen(said[i][1]);
        if (strcmp(heading.word[0], "unorm24") != 0 || strncmp(heading.word[1], said[i][1], length) != 0 ||
            strcspn(heading.word[1], ",") != length)
            fail_msg("%s: %s", said[i][0], p.out);
        printed_free(&p);
    }
}

/* Clipping is told once, of however many depth ranges, which come behind it. */
TEST(clipping_is_told_once) {
    static const char *const ranges[] = {"", "--depth-range 0:0.5", "--depth-range 0:1,0:0.5,0.5:1"};
    for (size_t i = 0; i < sizeof ranges / sizeof ranges[0]; i++) {
        printed p = print_of("table --model float -F fp32 -m gl -n 0.1 -f 1e6 --at 1 %s", ranges[i]);
        const char *told = strstr(p.errors, "fp32 gl: clipping in binary32 keeps only");
        if (p.status != 0 || told == NULL || strstr(strchr(told, ':') + 3, "clipping") != NULL)
            fail_msg("%s: %s", ranges[i], p.errors);
        printed_free(&p);
    }
}

/* Several set-ups are a line each, but where more is asked than a line holds: then each is told as it is alone. */
TEST(what_a_line_does_not_hold) {
    static const struct {
        const char *options;
        bool alone;
    } rows[] = {{"", false},
                {"--at 1,2,3,4,5", false},
                {"--at 1,2,3,4,5,6", true},
                {"--full", true},
                {"--model float", true},
                {"--range 1:2", true},
                {"--tolerance 1%", true}};
    static const char *const formats[] = {"unorm16", "unorm24"};
    tally t = {.name = "blocks"};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        printed both = print_of("table -m d3d -F unorm16,unorm24 %s", rows[i].options);
        for (int k = 0; k < 2; k++) {
            printed one = print_of("table -m d3d -F %s %s", formats[k], rows[i].options);
            const size_t heading = strcspn(one.out, "\n");
            one.out[heading] = '\0';
            const char *at = strstr(both.out, one.out);
            TALLY(&t, both.status == 0 && one.status == 0 && heading > 10, "%s: %s%s", rows[i].options, both.errors,
                  one.errors);
            TALLY(&t, (at != NULL && at[heading] == '\n') == rows[i].alone, "%s: '%s' is in\n%s", rows[i].options,
                  one.out, both.out);
            printed_free(&one);
        }
        printed_free(&both);
    }
    tally_end(&t);
}

/* Where the unit is known, the same separations are named in units of their own. */
TEST(test_units) {
    static const char *const bare[] = {"0.001", "0.01", "0.1"}, *const named[] = {"1 mm", "1 cm", "10 cm"};
    static const char *const options[] = {"", "--unit m"};
    for (int k = 0; k < LIMITS; k++) {
        double up_to[2];
        for (size_t i = 0; i < 2; i++) {
            char begin[64];
            printed p = print_of("table --full -n 0.1 -f 1000 -F unorm24 -m d3d %s", options[i]);
            snprintf(begin, sizeof begin, "%s up to z = ", i == 0 ? bare[k] : named[k]);
            const char *at = strstr(p.out, begin);
            assert_non_null(at);
            up_to[i] = strtod(at + strlen(begin), NULL);
            printed_free(&p);
        }
        assert_true(up_to[1] == up_to[0]);
    }
}

/* "Guaranteed to be resolved: 0.001 up to z = 31.9, ...": of one set-up. */
TEST(test_one) {
    static const camera one[] = {{"-F unorm24 -m d3d", 0.1, 1000, 0, 0, {0}, 1, NULL},
                                 {"-F fp32 -m reversed -f inf", 0.1, INFINITY, 0, 0, {0}, 1, NULL},
                                 {"-F unorm16 -m d3d -n 10 -f 1e5", 10, 1e5, 0, 0, {0}, 1, NULL},
                                 {"-F fp32 -m reversed", 0.1, 1000, 0, 0, {0}, 1, NULL},
                                 {"-F unorm24 -m d3d --viewport 1920x1080", 0.1, 1000, 0, 0, {0}, 1, &hd},
                                 {"-F fp32 -m reversed -f inf --viewport 640x480 --fov 40 --raster llvmpipe "
                                  "--slant 10:80",
                                  0.1,
                                  INFINITY,
                                  0,
                                  0,
                                  {0},
                                  1,
                                  &mesa}};
    tally t = {.name = "one"};
    for (size_t i = 0; i < sizeof one / sizeof one[0]; i++) {
        printed p = print_of("table --full %s", one[i].options);
        words heading = split(p.out);
        const dp_setup setup = full_setup(&one[i], heading.word[0], strtok(heading.word[1], ","));
        const char *line =
            strstr(p.out, one[i].triangles != NULL ? one[i].triangles->slant_lo == 10 ? "resolved at 10 to 80 degrees:"
                                                                                      : "resolved at any slant:"
                                                   : "Facing the camera, ");
        assert_non_null(line);
        bool everywhere = false; /* a separation is: then wider ones are not said */
        for (int k = 0; k < LIMITS && !everywhere; k++) {
            char begin[64], word[WORD] = "-";
            snprintf(begin, sizeof begin, " %g up to ", limits[k]);
            const char *at = strstr(line, begin);
            if (at != NULL && at < next_line(line)) {
                at += strlen(begin);
                at += strncmp(at, "z = ", 4) == 0 ? 4 : 0;
                snprintf(word, sizeof word, "%.*s", (int)strcspn(at, ",\n"), at);
                if (word[0] != 't' && word[strlen(word) - 1] == '.')
                    word[strlen(word) - 1] = '\0';
            }
            everywhere = strncmp(word, "the far plane", 13) == 0;
            check_reach(&t, &setup, limits[k], everywhere ? "far" : word);
        }
        printed_free(&p);
    }
    tally_end(&t);
}

enum { SAID = 1024 };

/* The sentence about reversing, on one line; empty where nothing is. */
static void reversing_of(const char *mappings, char out[SAID]) {
    printed p = print_of("table -F unorm16,fp32,unorm24,fp16 --at 1 -m %s", mappings); /* no API has the last */
    const char *at = strstr(p.out, "the limit for 0.01:");
    size_t used = 0;
    assert_int_equal(p.status, 0);
    if (at != NULL)
        for (at = strchr(at, ':') + 1; *at != '\0' && strncmp(at, ".\n", 2) != 0 && used < SAID - 1; at++)
            if (!isspace((unsigned char)*at) || (used > 0 && out[used - 1] != ' '))
                out[used++] = *at == '\n' ? ' ' : *at;
    out[used] = '\0';
    printed_free(&p);
}

/* A mapping is reversed within its own NDC, in whatever order the others stand. */
TEST(reversed_within_its_own_ndc) {
    static const char *const orders[] = {"gl,d3d,reversed,gl-reversed", "gl-reversed,reversed,gl,d3d",
                                         "d3d,gl-reversed,gl,reversed"};
    char pairs[2][SAID], all[SAID];
    reversing_of("gl,gl-reversed", pairs[0]);
    reversing_of("d3d,reversed", pairs[1]);
    for (size_t i = 0; i < 3; i++) {
        int parts = 0;
        reversing_of(orders[i], all);
        for (int k = 0; k < 2; k++) {
            char copy[SAID];
            memcpy(copy, pairs[k], sizeof copy);
            for (char *part = strtok(copy, ","); part != NULL; part = strtok(NULL, ",")) {
                part += strspn(part, " ");
                parts++;
                if (strstr(all, part) == NULL)
                    fail_msg("%s: '%s' is not in '%s'", orders[i], part, all);
            }
        }
        assert_int_equal(parts, 6);
    }
    reversing_of("gl,reversed", all);
    assert_string_equal(all, "");
}

/* Each format that no API has is named once, in the order of the table, the first three. */
TEST(targets_named) {
    check_says(0, "No API has fp16 as a depth buffer.", "table -F fp16,d24 -m d3d,reversed");
    check_says(0, "No API has fp16 or unorm10 as a depth buffer.", "table -F unorm10,d24,fp16 -m d3d,reversed");
    check_says(0, "No API has fp16, unorm10 or unorm9 as a depth buffer.", "table -F fp16,unorm10,unorm9,d24 -m d3d");
    check_says(0, "No API has fp16, unorm10, unorm9 or others as a depth buffer.",
               "table -F fp16,unorm10,unorm9,unorm8,unorm7,d24 -m d3d");
    check_says(0, "!No API has", "table -F d16,d24,fp32 -m d3d");
}
