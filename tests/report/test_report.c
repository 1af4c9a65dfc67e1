/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Columns as data: every kind in every form. JSON is read by jansson; CSV and text are written out by hand. */

#define _XOPEN_SOURCE 700 /* terminals */
#include <fcntl.h>
#include <iconv.h>
#include <jansson.h>
#include <unistd.h>

#include "report/number.h"
#include "report/report.h"
#include "support.h"

enum { DEAR = 1, CHEAP = 2 };

typedef struct price {
    double value;
} price;

typedef struct fruit {
    double mass, guarantee, share;
    uint64_t count;
    uint32_t code;
    int bytes, digits;
    bool ripe;
    const char *word, *names;
    char letters[16];
    const price *price; /* null where there is none */
} fruit;

typedef struct basket {
    const char *owner, *seal;
    fruit *items;
    size_t count;
    size_t baskets; /* as many times the same */
    fruit at_hand;
} basket;

static void *next_fruit(void *of, size_t i) {
    basket *b = of;
    if (i == b->count)
        return NULL;
    b->at_hand = b->items[i];
    return &b->at_hand;
}

static void *next_basket(void *of, size_t i) {
    return i < ((basket *)of)->baskets ? of : NULL;
}

static const column price_columns[] = {{FIELD(price, value, "value", "cent")}, {.kind = COLUMN_END}};
static const column share_columns[] = {{FIELD(fruit, share, "share", "")}, {.kind = COLUMN_END}};

static const column fruit_columns[] = {
    {FIELD(fruit, word, "word", ""), SHOWN("word", -6, 0)},
    {FIELD(fruit, mass, "mass", "kg"), SHOWN("mass", 9, 3)},
    {FIELD(fruit, guarantee, "guarantee", ""), SHOWN("bound", 9, 3), .upward = true},
    {TEXT_FIELD(fruit, share, "share", 7, 2), .fixed = true},
    {TEXT_FIELD(fruit, mass, "more", 12, 0), .digits_at = offsetof(fruit, digits)},
    {GROUP("group", share_columns)},
    {FIELD(fruit, count, "count", ""), SHOWN("count", 22, 0)},
    {FIELD(fruit, code, "code", ""), .only = AS_CSV},
    {FIELD(fruit, bytes, "bytes", ""), .only = AS_JSON},
    {FIELD(fruit, ripe, "ripe", ""), SHOWN("ripe", -6, 0)},
    {FIELD(fruit, names, "names", ""), .names = true},
    {FIELD(fruit, letters, "letters", ""), .optional = true},
    {TEXT_FIELD(fruit, bytes, "left", -1, 0)},
    {FIELD(fruit, bytes, "dear", ""), .when = DEAR},
    {FIELD(fruit, bytes, "both", ""), .when = DEAR | CHEAP},
    {PART(fruit, price, "price", price_columns), .pointed = true},
    {PART(fruit, price, "known", price_columns), .only = AS_JSON, .pointed = true, .optional = true},
    {PART(fruit, price, NULL, price_columns), .only = AS_JSON, .pointed = true},
    {.kind = COLUMN_END}};

static void say_owner(page *p, void *item) {
    page_title(p, "of %s", ((basket *)item)->owner);
}

static void say_count(page *p, void *item) {
    page_note(p, "fruits", "%d", (int)((basket *)item)->count);
    page_note(p, "a label too long", "still apart");
    page_wrapped(p, "", "");
    page_line(p, "done");
}

static const column basket_columns[] = {{FIELD(basket, owner, "owner", "")},
                                        {LIST("fruits", fruit_columns, next_fruit)},
                                        {FIELD(basket, seal, "seal", ""), .only = AS_CSV},
                                        {.kind = COLUMN_END}};

static const column root[] = {{FIELD(basket, owner, "root", ""), .only = AS_JSON},
                              {LIST("baskets", basket_columns, next_basket), .head = say_owner, .notes = say_count},
                              {.kind = COLUMN_END}};

static fruit apple = {.mass = 0.1,
                      .guarantee = 1.2301,
                      .share = 0.1,
                      .count = 9007199254740993, /* no double */
                      .code = UINT32_MAX,
                      .bytes = 7,
                      .digits = 17,
                      .ripe = true,
                      .word = "ap\"ple",
                      .names = "red round",
                      .letters = "a,b\n\x01",
                      .price = &(price){-12.5}};
static fruit nothing = {.mass = NAN, .guarantee = NAN, .share = NAN, .digits = 3};
static fruit endless = {
    .mass = INFINITY, .guarantee = INFINITY, .share = -INFINITY, .digits = 3, .word = "", .names = ""};

/* The text that a report writes; lost with the next call. */
static const char *written_by(const report_spec *spec, output_form form) {
    static char text[4096];
    char path[] = "/tmp/depthprec-report-XXXXXX";
    static output out;
    const int fd = mkstemp(path);
    assert_true(fd >= 0);
    fclose(fdopen(fd, "w"));
    assert_int_equal(output_open(&out, path), EXIT_FINE);
    report_write(spec, &out, form);
    assert_int_equal(output_close(&out), EXIT_FINE);
    FILE *file = fopen(path, "r");
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    fclose(file);
    remove(path);
    return text;
}

static const char *written(output_form form, unsigned when, size_t count) {
    fruit items[3] = {apple, nothing, endless};
    basket b = {.owner = "Eve, A", .seal = "wax", .items = items, .count = count, .baskets = form == FORM_TEXT ? 2 : 1};
    return written_by(&(report_spec){"test", root, &b, .when = when, .label = 8}, form);
}

static json_t *fruit_of(json_t *all, size_t i) {
    json_t *baskets = json_object_get(all, "baskets");
    assert_int_equal(json_array_size(baskets), 1);
    return json_array_get(json_object_get(json_array_get(baskets, 0), "fruits"), i);
}

static json_t *json_of(unsigned when, size_t count) {
    json_error_t error;
    json_t *all = json_loads(written(FORM_JSON, when, count), JSON_REJECT_DUPLICATES, &error);
    if (all == NULL)
        fail_msg("%s at %d", error.text, error.position);
    return all;
}

TEST(kinds_in_json) {
    const char *word, *first, *second, *letters, *command;
    double mass, guarantee, share, price_value, known, value;
    json_int_t count;
    int bytes, ripe;
    json_t *all = json_of(0, 1);
    assert_int_equal(json_unpack(all, "{s:s}", "command", &command), 0);
    assert_string_equal(command, "test");
    assert_int_equal(json_unpack(fruit_of(all, 0),
                                 "{s:s, s:F, s:F, s:{s:F!}, s:I, s:i, s:b, s:[ss!], s:s, s:{s:F!}, s:{s:F!}, s:F}",
                                 "word", &word, "mass", &mass, "guarantee", &guarantee, "group", "share", &share,
                                 "count", &count, "bytes", &bytes, "ripe", &ripe, "names", &first, &second, "letters",
                                 &letters, "price", "value", &price_value, "known", "value", &known, "value", &value),
                     0);
    assert_string_equal(word, "ap\"ple");
    assert_true(mass == 0.1 && guarantee == 1.2301 && share == 0.1 && count == 9007199254740993 && bytes == 7 &&
                ripe == 1);
    assert_string_equal(first, "red");
    assert_string_equal(second, "round");
    assert_string_equal(letters, "a,b\n\x01");
    assert_true(price_value == -12.5 && known == -12.5 && value == -12.5);
    assert_null(json_object_get(fruit_of(all, 0), "code"));
    json_decref(all);
}

/* Every byte that a name may hold, and what is more than a byte, comes back. */
TEST(any_text_in_json) {
    const char *const before = apple.word;
    char text[160];
    for (int c = 1; c < 128; c++)
        text[c - 1] = (char)c;
    strcpy(text + 127, "\u00e9\u2014\U0001f34f");
    apple.word = text;
    json_t *all = json_of(0, 1);
    assert_string_equal(json_string_value(json_object_get(fruit_of(all, 0), "word")), text);
    json_decref(all);
    apple.word = before;
}

/* RFC 4180: quotes stand where a comma, a quote or either end of a line is in the word, and nowhere else. */
TEST(any_byte_in_csv) {
    const char *const before = apple.word;
    for (int c = 1; c < 128; c++) {
        const bool quoted = strchr(",\"\r\n", c) != NULL;
        const char text[] = {'a', (char)c, 'b', '\0'};
        char cell[16];
        apple.word = text;
        snprintf(cell, sizeof cell, quoted ? ",\"a%s%cb\"," : ",a%s%cb,", c == '"' ? "\"" : "", c);
        if (strstr(written(FORM_CSV, 0, 1), cell) == NULL)
            fail_msg("byte %d", c);
    }
    apple.word = before;
}

/* Length of what begins the text and is UTF-8 by iconv, 0 where nothing does. */
static size_t iconv_utf8(const char *text) {
    for (size_t length = 1; length <= 4 && length <= strlen(text); length++) {
        char in[4], out[8], *from = in, *to = out;
        size_t left = length, room = sizeof out;
        memcpy(in, text, length);
        iconv_t of = iconv_open("UTF-16LE", "UTF-8");
        assert_true(of != (iconv_t)-1);
        const bool whole = iconv(of, &from, &left, &to, &room) != (size_t)-1 && left == 0;
        iconv_close(of);
        if (whole)
            return length;
    }
    return 0;
}

/* Random bytes, often the first of several: JSON is what jansson reads, and U+FFFD stands for each byte that is no
 * UTF-8; so it does in CSV. */
TEST(bytes_that_are_no_text) {
    static const unsigned char seams[] = {0x7F, 0x80, 0x8F, 0x90, 0x9F, 0xA0, 0xBF, 0xC0, 0xC1, 0xC2, 0xDF,
                                          0xE0, 0xED, 0xEF, 0xF0, 0xF4, 0xF5, 0xF8, 0xFF, 'a',  '"'};
    const char *const before = apple.word;
    rng random = rng_make("bytes");
    for (int n = 0; n < 500; n++) {
        char text[16] = "", expected[64] = "";
        const size_t length = 1 + rng_below(&random, sizeof text - 1);
        for (size_t i = 0; i < length; i++)
            text[i] = (char)(rng_below(&random, 4) > 0 ? seams[rng_below(&random, sizeof seams)]
                                                       : 1 + rng_below(&random, 255));
        text[length] = '\0';
        for (size_t at = 0, size; text[at] != '\0'; at += size > 0 ? size : 1) {
            size = iconv_utf8(text + at);
            snprintf(expected + strlen(expected), 5, "%.*s", size > 0 ? (int)size : 3,
                     size > 0 ? text + at : "\xEF\xBF\xBD");
        }
        apple.word = text;
        json_t *all = json_of(0, 1);
        assert_string_equal(json_string_value(json_object_get(fruit_of(all, 0), "word")), expected);
        json_decref(all);
        const char *csv = written(FORM_CSV, 0, 1);
        for (size_t size; *csv != '\0'; csv += size)
            assert_true((size = iconv_utf8(csv)) > 0);
    }
    apple.word = before;
}

TEST(nothing_in_json) {
    json_t *all = json_of(0, 3);
    for (size_t i = 1; i < 3; i++) {
        json_t *f = fruit_of(all, i);
        assert_true(json_is_null(json_object_get(f, "mass")));
        assert_true(json_is_null(json_object_get(f, "guarantee")));
        assert_true(json_is_null(json_object_get(json_object_get(f, "group"), "share")));
        assert_true(json_is_null(json_object_get(f, "price")));
        assert_true(json_is_false(json_object_get(f, "ripe")));
        assert_int_equal(json_array_size(json_object_get(f, "names")), 0);
        assert_null(json_object_get(f, "letters"));
        assert_null(json_object_get(f, "known"));
        assert_null(json_object_get(f, "value"));
    }
    assert_true(json_is_null(json_object_get(fruit_of(all, 1), "word")));
    assert_string_equal(json_string_value(json_object_get(fruit_of(all, 2), "word")), "");
    json_decref(all);
    all = json_of(0, 0);
    assert_null(fruit_of(all, 0));
    json_decref(all);
}

TEST(conditions) {
    static const struct {
        unsigned when;
        bool dear, both;
    } cases[] = {{0, false, false}, {DEAR, true, false}, {CHEAP, false, false}, {DEAR | CHEAP, true, true}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        json_t *all = json_of(cases[i].when, 1);
        assert_int_equal(json_object_get(fruit_of(all, 0), "dear") != NULL, cases[i].dear);
        assert_int_equal(json_object_get(fruit_of(all, 0), "both") != NULL, cases[i].both);
        json_decref(all);
        const char *csv = written(FORM_CSV, cases[i].when, 1);
        assert_int_equal(strstr(csv, ",dear") != NULL, cases[i].dear);
        assert_int_equal(strstr(csv, ",both") != NULL, cases[i].both);
    }
}

#define HEAD "owner,word,mass [kg],guarantee,share,count,code,ripe,names,letters,value [cent],seal\r\n"

TEST(kinds_in_csv) {
    assert_string_equal(written(FORM_CSV, 0, 0), HEAD);
    assert_string_equal(written(FORM_CSV, 0, 3),
                        HEAD "\"Eve, A\",\"ap\"\"ple\",0.1,1.2301,0.1,9007199254740993,4294967295,true,red round,"
                             "\"a,b\n\x01\",-12.5,wax\r\n"
                             "\"Eve, A\",,,,,0,0,false,,,,wax\r\n"
                             "\"Eve, A\",,inf,inf,-inf,0,0,false,,,,wax\r\n");
}

TEST(kinds_in_text) {
    static const char section[] =
        "of Eve, A\n"
        "word       mass    bound  share        more                 count  ripe   left\n"
        "ap\"ple      0.1     1.24   0.10 0.10000000000000001      9007199254740993  true   7\n"
        "-             -        -      -           -                     0  false  0\n"
        "            inf      inf   -inf         inf                     0  false  0\n"
        "  fruits  3\n"
        "  a label too long\n"
        "          still apart\n"
        "  done\n";
    char want[2 * sizeof section];
    snprintf(want, sizeof want, "%s\n%s", section, section);
    assert_string_equal(written(FORM_TEXT, 0, 3), want);
}

/* ---- Values that are pointed to, and tables with words around them ------------------------------------------------
 */

typedef struct sight {
    const double *seen;
    const bool *certain;
} sight;

typedef struct sights {
    const sight *items;
    size_t count;
    sight at_hand;
} sights;

static void *next_sight(void *of, size_t i) {
    sights *s = of;
    if (i == s->count)
        return NULL;
    s->at_hand = s->items[i];
    return &s->at_hand;
}

static void say_begin(page *p, void *item) {
    page_line(p, "%d seen", (int)((sights *)item)->count);
}

static void say_end(page *p, void *item) {
    page_line(p, "no more than %d", (int)((sights *)item)->count);
}

static const column sight_columns[] = {{FIELD(sight, seen, "seen", ""), SHOWN("seen", -4, 3)},
                                       {FIELD(sight, certain, "certain", ""), SHOWN("certain", 8, 0)},
                                       {FIELD(sight, seen, "if_seen", ""), .optional = true},
                                       {FIELD(sight, certain, "if_certain", ""), .optional = true},
                                       {.kind = COLUMN_END}};

static const column sights_columns[] = {
    {LIST("sights", sight_columns, next_sight), .indent = 3, .head = say_begin, .notes = say_end},
    {.kind = COLUMN_END}};

/* Null does not exist, NaN behind a pointer has no value: JSON leaves out the one alone. */
TEST(pointed) {
    static const double numbers[] = {2.5, NAN};
    static const bool answers[] = {false, true};
    const sight items[] = {{&numbers[0], &answers[1]}, {&numbers[1], &answers[0]}, {NULL, NULL}};
    sights all = {.items = items, .count = 3};
    report_spec spec = {.command = "test", .columns = sights_columns, .item = &all};
    const char *json = strchr(written_by(&spec, FORM_JSON), '[');
    assert_non_null(json);
    assert_string_equal(json, "[\n{\"seen\":2.5,\"certain\":true,\"if_seen\":2.5,\"if_certain\":true},\n"
                              "{\"seen\":null,\"certain\":false,\"if_seen\":null,\"if_certain\":false},\n"
                              "{\"seen\":null,\"certain\":null}]}\n");
    assert_string_equal(written_by(&spec, FORM_CSV), "seen,certain,if_seen,if_certain\r\n"
                                                     "2.5,true,2.5,true\r\n,false,,false\r\n,,,\r\n");
    assert_string_equal(written_by(&spec, FORM_TEXT), "  3 seen\n"
                                                      "   seen certain\n"
                                                      "   2.5     true\n"
                                                      "   -      false\n"
                                                      "   -          -\n"
                                                      "  no more than 3\n");
    all.count = 0;
    assert_string_equal(written_by(&spec, FORM_TEXT), "  0 seen\n  no more than 0\n");
}

/* Notes break between words: the last that fits ends in column 96. */
/* A page of that width with a label, of words, and of the columns of a table; 0: as wide as nothing says. */
static void check_page(int width, void (*write)(page *p), const char *want) {
    static output out;
    char text[1024] = "", path[] = "/tmp/depthprec-report-XXXXXX";
    fclose(fdopen(mkstemp(path), "w"));
    assert_int_equal(output_open(&out, path), EXIT_FINE);
    out.width = width;
    page p = page_start(&out, 6);
    write(&p);
    assert_int_equal(output_close(&out), EXIT_FINE);
    FILE *file = fopen(path, "r");
    assert_true(fread(text, 1, sizeof text - 1, file) > 0);
    fclose(file);
    remove(path);
    assert_string_equal(text, want);
}

#define EIGHT "abcdefg abcdefg abcdefg abcdefg abcdefg abcdefg abcdefg abcdefg " /* 64 characters */

static void write_label(page *p) {
    page_wrapped(p, "label", EIGHT "abcdefgh x");
}

static void write_sentences(page *p) {
    page_text(p, "%s", EIGHT "abcdefgh abcdef x");
    page_line(p, "%s", EIGHT "abcdefgh abcd x");
    page_line(p, "%s", EIGHT "abcdef z = 5000, 12 % more");
    p->unit = "m";
    page_line(p, "%s", EIGHT "abcdefghi 5000 m more");
    page_line(p, "%s", EIGHT "abcdefghi 5000 more");
    page_wrapped(p, "nothing", "");
}

TEST(wrapped) {
    check_page(0, write_label, "  label " EIGHT "abcdefgh\n        x\n");
    check_page(81, write_label, "  label " EIGHT "abcdefgh\n        x\n");
    check_page(82, write_label, "  label " EIGHT "abcdefgh x\n");
    check_page(OUTPUT_UNLIMITED, write_label, "  label " EIGHT "abcdefgh x\n");
    check_page(0, write_sentences,
               EIGHT "abcdefgh abcdef\n  x\n  " EIGHT "abcdefgh abcd\n  x\n  " EIGHT
                     "abcdef\n  z = 5000, 12 % more\n  " EIGHT "abcdefghi\n  5000 m more\n  " EIGHT
                     "abcdefghi 5000\n  more\n");
}

static void *next_once(void *of, size_t i) {
    return i == 0 ? of : NULL;
}

typedef struct four {
    double one, two, three, four;
} four;

static void write_four(page *p) {
    static const column inner[] = {{FIELD(four, three, "three", ""), SHOWN("three", 9, 3), .spare = 2},
                                   {FIELD(four, four, "four", ""), SHOWN("four", 9, 3)},
                                   {.kind = COLUMN_END}};
    static const column rows[] = {{FIELD(four, one, "one", ""), SHOWN("one", 6, 3)},
                                  {FIELD(four, two, "two", ""), SHOWN("two", 9, 3), .spare = 1},
                                  {GROUP("inner", inner)},
                                  {.kind = COLUMN_END}};
    static const column columns[] = {{LIST("rows", rows, next_once)}, {.kind = COLUMN_END}};
    report_write(&(report_spec){.command = "test", .columns = columns, .item = &(four){1, 2, 3, 4}}, p->out, FORM_TEXT);
}

/* Columns that are spared, the highest first, until the rest fits. */
TEST(spared) {
    static const struct {
        int width;
        const char *want;
    } cases[] = {{OUTPUT_UNLIMITED, "   one      two    three     four\n     1        2        3        4\n"},
                 {33, "   one      two    three     four\n     1        2        3        4\n"},
                 {32, "   one      two     four\n     1        2        4\n"},
                 {24, "   one      two     four\n     1        2        4\n"},
                 {23, "   one     four\n     1        4\n"},
                 {5, "   one     four\n     1        4\n"}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
        check_page(cases[i].width, write_four, cases[i].want);
}

TEST(brief) {
    static const struct {
        const char *number, *want;
    } cases[] = {{"8.28e+04", "82800"},
                 {"1.2e-07", "1.2e-7"},
                 {"0.00062", "6.2e-4"},
                 {"0.0062", "0.0062"},
                 {"6.63e+05", "663000"},
                 {"6.6e+06", "6.6e6"},
                 {"1e+18", "1e18"},
                 {"1000", "1000"},
                 {"0.0001", "1e-4"},
                 {"0.000123", "1.23e-4"},
                 {"inf", "inf"},
                 {"-", "-"},
                 {"0", "0"},
                 {"12.5", "12.5"}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        number_text number;
        snprintf(number.text, sizeof number.text, "%s", cases[i].number);
        assert_string_equal(number_brief(number).text, cases[i].want);
    }
}

/* Colour where it is a terminal, of a kind that has colours, and nobody said no; or as was asked. */
TEST(colour) {
    static const struct {
        const char *term, *no_color;
        bool terminal;
        output_colour asked;
        bool want;
    } cases[] = {{"xterm", NULL, true, OUTPUT_COLOUR_AUTO, true},   {"xterm", "", true, OUTPUT_COLOUR_AUTO, false},
                 {"xterm", "1", true, OUTPUT_COLOUR_AUTO, false},   {"dumb", NULL, true, OUTPUT_COLOUR_AUTO, false},
                 {NULL, NULL, true, OUTPUT_COLOUR_AUTO, false},     {"xterm", NULL, false, OUTPUT_COLOUR_AUTO, false},
                 {"xterm", "1", false, OUTPUT_COLOUR_ALWAYS, true}, {"dumb", NULL, true, OUTPUT_COLOUR_ALWAYS, true},
                 {"xterm", NULL, true, OUTPUT_COLOUR_NEVER, false}};
    const int host = posix_openpt(O_RDWR | O_NOCTTY);
    if (host < 0 || grantpt(host) != 0 || unlockpt(host) != 0)
        skip();
    const int terminal = open(ptsname(host), O_RDWR | O_NOCTTY), file = open("/dev/null", O_WRONLY);
    const char *term = getenv("TERM"), *before = term != NULL ? strdup(term) : NULL;
    static output out;
    assert_true(terminal >= 0 && file >= 0);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        cases[i].term != NULL ? setenv("TERM", cases[i].term, 1) : unsetenv("TERM");
        cases[i].no_color != NULL ? setenv("NO_COLOR", cases[i].no_color, 1) : unsetenv("NO_COLOR");
        out.fd = cases[i].terminal ? terminal : file;
        out.colour = cases[i].asked;
        const page p = page_start(&out, 0);
        if ((p.good[0] != '\0') != cases[i].want)
            fail_msg("case %zu: %s", i, cases[i].want ? "no colour" : "colour");
        assert_true((strcmp(p.good, p.bad) != 0) == cases[i].want);
    }
    setenv("NO_COLOR", "1", 1);
    before != NULL ? setenv("TERM", before, 1) : unsetenv("TERM");
    free((char *)before);
    close(terminal), close(file), close(host);
}

int main(void) {
    setenv("NO_COLOR", "1", 1);
    return run_listed(NULL, NULL);
}
