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
        snprintf(path, sizeof path, "lattice.%s", target);
        if (flag_at(one, "possible")) {
            check_side(t, line, target, column_of(row, 3), number_at(one, "%s", target), plane);
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
        for (char *c = text; *c != '\0'; c++)
            *c = *c == '\n' ? ' ' : *c;
        char flat[8192] = "";
        for (size_t k = 0, used = 0; text[k] != '\0' && used + 1 < sizeof flat; k++)
            if (text[k] != ' ' || k == 0 || text[k - 1] != ' ')
                flat[used++] = text[k];
        const char *first = strstr(flat, "first z-fight at z = "), *always = strstr(flat, "always from z = ");
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
