/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers of few digits that stand for a bound are rounded to the side on which they hold: those of texts beside those
 * of JSON, which are exact. */
#include "printed.h"

typedef enum side { DOWN = -1, EITHER = 0, UP = 1 } side;

/* One of six digits is no nearer than that, on its side, and no farther off than its last digit. */
static void check_side(tally *t, const char *line, const char *what, const char *text, double exact, side to) {
    char *end;
    const double shown = strtod(text, &end);
    if (isnan(exact) && strncmp(text, "inf", 3) == 0) /* null in JSON */
        return;
    const bool close = fabs(shown - exact) <= 1.0001e-5 * fabs(exact);
    TALLY(t, end != text && close && (to == EITHER || (shown - exact) * (double)(int)to >= 0),
          "%s: %s is %.12s, of %.17g", line, what, text, exact);
}

/* The word in a column of a line. */
static const char *column_of(const char *line, int column) {
    for (;; column--) {
        line += strspn(line, " ");
        if (column == 0)
            return line;
        line += strcspn(line, " \n");
    }
}

/* The table of alternatives, row by row. */
static void check_solve(tally *t, const char *target, side plane, const char *line) {
    char *text = output_of(0, line, "");
    json_t *root = json_printed(0, "%s", line);
    const char *row = strstr(text, "Alternatives");
    assert_non_null(row);
    row = strchr(strchr(row, '\n') + 1, '\n') + 1;
    for (size_t i = 0; i < json_array_size(node_at(root, "alternatives")); i++) {
        const json_t *one = node_at(root, "alternatives[%zu]", i);
        char path[64];
        assert_string_equal(strncmp(column_of(row, 0), text_at(one, "format"), 4) == 0 ? "" : row, "");
        snprintf(path, sizeof path, "any_slant.%s", target);
        if (node_at(one, "any_slant") != NULL && flag_at(one, "any_slant.possible"))
            check_side(t, line, path, column_of(row, 3), number_at(one, "%s", path), plane);
        snprintf(path, sizeof path, "lattice.%s", target);
        if (flag_at(one, "possible")) {
            check_side(t, line, target, column_of(row, 2), number_at(one, "%s", target), plane);
            check_side(t, line, "separation", column_of(row, 5), number_at(one, "separation"), UP);
        }
        if (flag_at(one, "lattice.possible"))
            check_side(t, line, path, column_of(row, 4), number_at(one, "%s", path), plane);
        row = strchr(row, '\n') + 1;
    }
    json_decref(root);
    free(text);
}

TEST(solve) {
    tally t = {.name = "solve"};
    rng r = rng_make("outward solve");
    for (uint64_t i = test_cases(6, 12, 100); i > 0; i--) {
        char line[256];
        snprintf(line, sizeof line,
                 "solve --for near -f 1000 -F unorm16,d24,fp32 -m d3d,reversed --separation %.5g --at %.4g",
                 rng_log(&r, 0.003, 0.1), rng_uniform(&r, 20, 90));
        check_solve(&t, "near", UP, line);
        snprintf(line, sizeof line, "solve --for far -n %.4g -F d24,fp32 -m d3d,reversed --separation %.5g --at %.4g",
                 rng_log(&r, 0.01, 0.1), rng_log(&r, 0.01, 0.1), rng_uniform(&r, 20, 30));
        check_solve(&t, "far", DOWN, line);
    }
    TALLY(&t, t.cases > 100, "few numbers");
    tally_end(&t);
}

/* "guaranteed from z = A up to z = B; at any slant up to z = C; first found to z-fight at z = D". */
TEST(solve_for_distance) {
    static const struct {
        const char *phrase, *path;
        side to;
    } said[] = {{"is guaranteed from z = 0.1 up to z = ", "answer.distance", DOWN},
                {"; at any slant up to z = ", "answer.any_slant.distance", DOWN},
                {"in the lattice up to ", "answer.lattice.distance", DOWN}};
    tally t = {.name = "distances"};
    rng r = rng_make("outward distances");
    for (uint64_t i = test_cases(8, 20, 200); i > 0; i--) {
        char line[256];
        snprintf(line, sizeof line, "solve --for distance -n 0.1 -f 1000 -F %s -m d3d --separation %.5g",
                 rng_below(&r, 2) ? "d24" : "fp32", rng_log(&r, 0.003, 0.1));
        char *text = output_of(0, line, "");
        json_t *root = json_printed(0, "%s", line);
        printed_unfold(text);
        for (size_t k = 0; k < sizeof said / sizeof said[0]; k++) {
            const char *at = strstr(text, said[k].phrase);
            TALLY(&t, at != NULL, "%s: no '%s'", line, said[k].phrase);
            if (at != NULL)
                check_side(&t, line, said[k].path, at + strlen(said[k].phrase), number_at(root, "%s", said[k].path),
                           said[k].to);
        }
        json_decref(root);
        free(text);
    }
    tally_end(&t);
}

/* "... first z-fight at z = F, and always from z = A on", wherever the line is broken. */
TEST(zfight) {
    tally t = {.name = "zfight"};
    rng r = rng_make("outward zfight");
    int both = 0;
    for (uint64_t i = test_cases(6, 12, 100); i > 0; i--) {
        char line[256];
        snprintf(line, sizeof line, "zfight -n 1 -f 30 -F unorm16 -m d3d --sample 20000 --separation %.5g",
                 rng_log(&r, 0.0005, 0.003));
        char *text = output_of(0, line, "");
        json_t *root = json_printed(0, "%s", line);
        printed_unfold(text);
        const char *first = strstr(text, "first z-fight at z = "), *always = strstr(text, "always from z = ");
        if (first != NULL)
            check_side(&t, line, "first", first + 21, number_at(root, "setups[0].first"), DOWN);
        if (always != NULL)
            check_side(&t, line, "always", always + 16, number_at(root, "setups[0].always_from"), UP);
        both += first != NULL && always != NULL;
        json_decref(root);
        free(text);
    }
    TALLY(&t, both >= 3, "few sentences");
    tally_end(&t);
}

/* "2 frusta, separation S at z = Z": of those of a fixed ratio. */
TEST(frusta) {
    static const char word[] = " frusta, separation ";
    tally t = {.name = "frusta"};
    rng r = rng_make("outward frusta");
    for (uint64_t i = test_cases(10, 20, 100); i > 0; i--) {
        char line[256];
        snprintf(line, sizeof line, "solve --for frusta -n %.4g -f %.4g -F d24 -m d3d --separation 0.1",
                 rng_log(&r, 0.05, 0.2), rng_log(&r, 5000, 20000));
        printed p = print_of("%s", line);
        json_t *root = json_printed(-1, "%s", line);
        const char *at = strstr(p.out, "ratio 1000");
        at = at != NULL ? strstr(at, word) : NULL;
        if (at != NULL)
            check_side(&t, line, "ratio 1000", at + sizeof word - 1, number_at(root, "fixed.separation"), UP);
        json_decref(root);
        printed_free(&p);
    }
    TALLY(&t, t.cases >= 8, "few sentences");
    tally_end(&t);
}

/* ---- Every command, random cameras ------------------------------------------------------------------------------- */

/* Where the text shows a number of JSON: so many words behind a phrase, or with -1 the word before it. */
typedef struct shown_bound {
    const char *phrase;
    int word;
    const char *path;
    int digits;
    side to;
    double scale; /* of JSON's number in the text; 0: 1 */
    double plus;  /* added then */
} shown_bound;

static const char *word_at(const char *flat, const shown_bound *b) {
    const char *at = strstr(flat, b->phrase);
    if (at == NULL)
        return NULL;
    if (b->word >= 0)
        return column_of(at + strlen(b->phrase), b->word);
    while (at > flat && at[-1] != ' ')
        at--;
    return at;
}

/* On its side, and within a unit of the last of so many digits; what is unbounded has no number. */
static void check_shown(tally *t, const char *line, const char *path, const char *text, double exact, int digits,
                        side to) {
    char *end;
    const double shown = strtod(text, &end);
    if (isnan(exact) && (end == text || isinf(shown)))
        return;
    const double unit = pow(10, floor(log10(fabs(exact))) - digits + 1) * (1 + 1e-9);
    TALLY(t, end != text && fabs(shown - exact) <= unit && (shown - exact) * (double)(int)to >= 0,
          "%s: %s is %.18s, of %.17g", line, path, text, exact);
}

static void check_bounds(tally *t, const char *line, const shown_bound *rows) {
    printed p = print_of("%s", line);
    json_t *root = p.status == 0 ? json_printed(0, "%s", line) : NULL;
    printed_unfold(p.out);
    for (const shown_bound *b = rows; root != NULL && b->phrase != NULL; b++) {
        const char *at = word_at(p.out, b);
        if (at != NULL)
            check_shown(t, line, b->path, at, number_at(root, "%s", b->path) * (b->scale > 0 ? b->scale : 1) + b->plus,
                        b->digits, b->to);
    }
    json_decref(root);
    printed_free(&p);
}

#define WORST    "setups[0].worst."
#define ROW      "setups[0].rows[0]."
#define SCHEMES  "setups[0].distances[0].schemes[0]."
#define CELL     "lattice guaranteed cell from to "
#define OF_DEPTH "code eye depth cell from to interval "
static const shown_bound of_table[] = {{"worst error ", 0, WORST "error", 6, UP, 0, 0},
                                       {"worst interval ", 0, WORST "interval", 6, UP, 0, 0},
                                       {"worst interval ", 2, WORST "interval_lo", 9, DOWN, 0, 0},
                                       {"worst interval ", 4, WORST "interval_hi", 9, UP, 0, 0},
                                       {"blind from z = ", 0, WORST "blind_from", 9, DOWN, 0, 0},
                                       {"effectively ", 0, "setups[0].near_effective", 9, UP, 0, 0},
                                       {"effectively ", 2, "setups[0].far_effective", 9, DOWN, 0, 0},
                                       {"worst separation ", 0, "setups[0].worst_separation.bound", 6, UP, 0, 0},
                                       {CELL, 6, ROW "lattice", 5, UP, 0, 0},
                                       {CELL, 7, ROW "guaranteed", 5, UP, 0, 0},
                                       {CELL, 8, ROW "cell_lo", 9, DOWN, 0, 0},
                                       {CELL, 9, ROW "cell_hi", 9, UP, 0, 0},
                                       {NULL, 0, NULL, 0, EITHER, 0, 0}};
#define SHARE "setups[0].auto.neglected.exact.share"
static const shown_bound of_choice[] = {{" % more than the lattice", -1, SHARE, 3, UP, 100, 0},
                                        {" times the lattice", -1, SHARE, 3, UP, 1, 1},
                                        {NULL, 0, NULL, 0, EITHER, 0, 0}};
static const shown_bound of_method[] = {{" of it: bound ", 0, "setups[0].claim", 3, UP, 0, 0},
                                        {NULL, 0, NULL, 0, EITHER, 0, 0}};
static const shown_bound of_lookup[] = {{OF_DEPTH, 3, ROW "cell_lo", 9, DOWN, 0, 0},
                                        {OF_DEPTH, 4, ROW "cell_hi", 9, UP, 0, 0},
                                        {NULL, 0, NULL, 0, EITHER, 0, 0}};
static const shown_bound of_budget[] = {{"would need ", 0, WORST "remedy_separation", 4, UP, 0, 0},
                                        {"in place of ", 0, WORST "separation", 4, UP, 0, 0},
                                        {NULL, 0, NULL, 0, EITHER, 0, 0}};
static const shown_bound of_zfight[] = {{"within --range: ", 0, "setups[0].near_effective", 9, UP, 0, 0},
                                        {"within --range: ", 2, "setups[0].far_effective", 9, DOWN, 0, 0},
                                        {NULL, 0, NULL, 0, EITHER, 0, 0}};
static const shown_bound of_world[] = {{"absolute ", 0, SCHEMES "safe_to", 3, DOWN, 0, 0},
                                       {"absolute ", 1, SCHEMES "still_to", 3, DOWN, 0, 0},
                                       {NULL, 0, NULL, 0, EITHER, 0, 0}};
static const shown_bound of_effect[] = {{"interval levels half-width from ", 4, ROW "levels", 6, UP, 0, 0},
                                        {"interval levels half-width from ", 5, ROW "usable", 6, UP, 0, 0},
                                        {NULL, 0, NULL, 0, EITHER, 0, 0}};

/* A bias that is a window depth, as it is to be written: away from 0, which is downward where depth grows. */
#define OF_BIAS "one unit resolved separated "
static const shown_bound of_bias[] = {{"D3DRS_DEPTHBIAS = ", 0, "setups[0].range.units_gap", 9, DOWN, 0, 0},
                                      {OF_BIAS, 3, ROW "units_apart", 9, DOWN, 0, 0},
                                      {OF_BIAS, 4, ROW "units_gap", 9, DOWN, 0, 0},
                                      {NULL, 0, NULL, 0, EITHER, 0, 0}};
static const shown_bound of_reversed[] = {{"D3DRS_DEPTHBIAS = ", 0, "setups[0].range.units_gap", 9, UP, 0, 0},
                                          {OF_BIAS, 3, ROW "units_apart", 9, UP, 0, 0},
                                          {OF_BIAS, 4, ROW "units_gap", 9, UP, 0, 0},
                                          {NULL, 0, NULL, 0, EITHER, 0, 0}};

TEST(commands) {
    tally t = {.name = "table, budget, zfight, world, texture, bias"};
    rng r = rng_make("outward commands");
    uint64_t numbers[10] = {0};
    for (uint64_t i = test_cases(20, 60, 1000); i > 0; i--) {
        const double n = rng_log(&r, 0.01, 10), f = n * rng_log(&r, 100, 1e6), z = n * rng_log(&r, 1, f / n);
        const dp_format_row *format = dp_format_get((size_t)rng_below(&r, dp_format_count()));
        const dp_mapping_row *row = dp_mapping_get((dp_mapping)rng_below(&r, DP_MAPPING_COUNT));
        const char *model = rng_below(&r, 3) == 0 ? " --model float" : "";
        char camera[160], line[320];
        snprintf(camera, sizeof camera, "-n %.9g -f %.9g -F %s -m %s", n, f, format->format.name, row->name);
#define TRY(k, rows, ...)                                                                                              \
    do {                                                                                                               \
        const uint64_t before = t.cases;                                                                               \
        snprintf(line, sizeof line, __VA_ARGS__);                                                                      \
        check_bounds(&t, line, rows);                                                                                  \
        numbers[k] += t.cases - before;                                                                                \
    } while (0)
        TRY(0, of_table, "table -q --full --at %.9g --range %.9g:%.9g %s%s", z, n, z, camera, model);
        if (row->curve != DP_CURVE_LOG)
            TRY(1, of_choice, "table -q --at %.9g %s", z, camera);
        TRY(2, of_lookup, "table -q --depth %.9g %s", rng_uniform(&r, 0.01, 0.99), camera);
        TRY(3, of_budget, "budget -q --at %.9g %s", z, camera);
        TRY(4, of_zfight, "zfight -q --sample 500 --range %.9g:%.9g %s", n, z, camera);
        TRY(5, of_world, "world -q --at %.9g %s", z, camera);
        TRY(7, of_bias, "bias -q --api d3d9 --separation %.9g --at %.9g -n %.9g -f %.9g -F %s -m d3d", 1e-3 * z, z, n,
            f, format->format.name);
        TRY(8, of_reversed, "bias -q --api d3d9 --separation %.9g --at %.9g -n %.9g -f %.9g -F %s -m reversed",
            1e-3 * z, z, n, f, format->format.name);
        TRY(9, of_method, "table -q --tolerance %.3g --at %.9g -n %.9g -f %.9g -F unorm24 -m d3d",
            rng_log(&r, 1e-3, 0.5), z, n, f);
        TRY(6, of_effect, "texture -q --product effect:intersection --at %.9g %s", z, camera);
    }
    for (int k = 0; k < 10; k++)
        TALLY(&t, numbers[k] >= 8, "few numbers of line %d: %llu", k, (unsigned long long)numbers[k]);
    tally_end(&t);
}
