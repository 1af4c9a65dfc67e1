/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sentences as rows over columns: which are said, and what stands in the braces; all written out by hand. */
#include "report/sentence.h"
#include "support.h"

enum { SWEET = 1, DEAR = 2 };

typedef struct pip {
    double size, share;
} pip;

typedef struct fruit {
    double mass, least, most;
    int digits;
    uint32_t code;
    const char *word;
    pip pip;
    const pip *seed; /* null where there is none */
} fruit;

static const column pip_columns[] = {
    {FIELD(pip, size, "size", "scene"), .digits = 3}, {FIELD(pip, share, "share", "")}, {.kind = COLUMN_END}};
static const column few_columns[] = {{FIELD(fruit, code, "code", "")}, {.kind = COLUMN_END}};
static const column columns[] = {{FIELD(fruit, mass, "mass", "kg"), .digits_at = offsetof(fruit, digits)},
                                 {FIELD(fruit, least, "least", "scene"), .digits = 3, .upward = true},
                                 {FIELD(fruit, most, "most", "scene"), .digits = 3, .downward = true},
                                 {FIELD(fruit, most, "asked", "scene"), .digits = 3, .given = true},
                                 {FIELD(fruit, word, "word", "")},
                                 {GROUP(NULL, few_columns)},
                                 {PART(fruit, pip, "pip", pip_columns)},
                                 {PART(fruit, seed, "seed", pip_columns), .pointed = true},
                                 {.kind = COLUMN_END}};

static fruit apple(void) {
    return (fruit){.mass = 0.123456789,
                   .least = 1.0001,
                   .most = 1.2399,
                   .digits = 5,
                   .code = 16777215,
                   .word = "apple",
                   .pip = {2.0 / 3.0, 0.25}};
}

static number_text as_given(const void *lengths, double value, int digits) {
    number_text out;
    snprintf(out.text, sizeof out.text, "%s of %d at %.2f", (const char *)lengths, digits, value);
    return out;
}

/* The text of a page 40 wide that says the rows. */
static const char *said(const sentence *rows, fruit f, unsigned when, const char *unit, const char *given) {
    static char text[1024];
    static output out;
    out = (output){.fd = -1, .width = 40};
    page p = page_start(&out, 6);
    p.unit = unit;
    p.as_given = given != NULL ? as_given : NULL;
    p.lengths = given;
    page_say(&p, rows, columns, &f, when);
    snprintf(text, sizeof text, "%.*s", (int)out.used, out.buffer);
    return text;
}

static const char *line_of(const char *words, fruit f, const char *unit) {
    return said((const sentence[]){LINE(words, 0), SENTENCE_END}, f, 0, unit, NULL);
}

TEST(values_are_as_columns_show_them) {
    fruit f = apple();
    assert_string_equal(line_of("{mass}, {mass:2}, {mass:0}", f, "m"), "  0.12346, 0.12, 0.123456789\n");
    assert_string_equal(line_of("{least} to {most}", f, NULL), "  1.01 to 1.23\n");
    assert_string_equal(line_of("{least:5}", f, "m"), "  1.0001 m\n");
    assert_string_equal(line_of("{code} of {word}", f, "m"), "  16777215 of apple\n");
    assert_string_equal(line_of("{pip.size} {pip.share}", f, "cm"), "  0.667 cm 0.25\n");
    f.most = INFINITY; /* has no unit */
    assert_string_equal(line_of("up to {most}", f, "m"), "  up to inf\n");
    assert_string_equal(line_of("", f, "m"), "  \n");
}

TEST(lengths_as_they_were_asked_for) {
    const sentence rows[] = {LINE("{asked}; {most}", 0), SENTENCE_END};
    assert_string_equal(said(rows, apple(), 0, "m", "124 cm"), "  124 cm of 3 at 1.24; 1.23 m\n");
    assert_string_equal(said(rows, apple(), 0, "m", NULL), "  1.24 m; 1.23 m\n");
}

/* Each combination of two conditions and two values: which of three alternatives is said, and what stands behind them.
 */
TEST(one_of_alternatives) {
    static const sentence rows[] = {NOTE("{word}", "sweet, {mass:1}", SWEET),
                                    ELSE("seed {seed.size}", 0),
                                    ELSE("sweet and dear", SWEET | DEAR),
                                    LINE("of {seed.share}", DEAR),
                                    PROSE("ripe", SWEET),
                                    SENTENCE_END};
    const pip seed = {4.0, 0.5};
    for (int i = 0; i < 16; i++) {
        const bool sweet = i & 1, dear = i & 2, massive = i & 4, seeded = i & 8;
        fruit f = apple();
        f.mass = massive ? 0.5 : (double)NAN;
        f.seed = seeded ? &seed : NULL;
        char want[256] = "";
        snprintf(want, sizeof want, "%s%s%s",
                 sweet && massive ? "  apple sweet, 0.5\n"
                 : seeded         ? "  apple seed 4\n"
                 : sweet && dear  ? "  apple sweet and dear\n"
                                  : "",
                 dear && seeded ? "  of 0.5\n" : "", sweet ? "ripe\n" : "");
        assert_string_equal(said(rows, f, (sweet ? SWEET : 0) | (dear ? DEAR : 0), NULL, NULL), want);
        char first[SENTENCE_SIZE];
        sentence_first(NULL, rows, columns, &f, (sweet ? SWEET : 0) | (dear ? DEAR : 0), first);
        assert_string_equal(first, sweet && massive ? "sweet, 0.5"
                                   : seeded         ? "seed 4"
                                   : sweet && dear  ? "sweet and dear"
                                   : sweet          ? "ripe"
                                                    : "");
    }
}

TEST(unknown_names_stay) {
    assert_string_equal(line_of("{mas} {seed.shape} {pip}", apple(), NULL), "  {mas} {seed.shape} {pip}\n");
}

int main(void) {
    setenv("NO_COLOR", "1", 1);
    return run_listed(NULL, NULL);
}
