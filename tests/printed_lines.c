/* SPDX-License-Identifier: GPL-3.0-or-later */
/* CSV and text against the values that are wanted: printed.h. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "printed.h"

/* ---- Lines ------------------------------------------------------------------------------------------------------- */

void place_add(line_places *l, const char *inner, const char *outer_format, ...) {
    va_list list;
    if ((l->count & (l->count - 1)) == 0) /* room doubles at the powers of two */
        l->items = realloc(l->items, (l->count == 0 ? 1 : 2 * l->count) * sizeof *l->items);
    assert_non_null(l->items);
    line_place *p = &l->items[l->count++];
    va_start(list, outer_format);
    vsnprintf(p->outer, sizeof p->outer, outer_format, list);
    va_end(list);
    snprintf(p->inner, sizeof p->inner, "%.60s%.60s", p->outer, inner);
}

void places_free(line_places *l) {
    free(l->items);
    *l = (line_places){0};
}

/* Null where a path with ? has no value. */
static const wanted *resolve(const values *v, const line_place *p, const char *path) {
    static wanted constant;
    char full[2 * PATH_SIZE];
    if (*path == '=') {
        constant = (wanted){.kind = VALUE_TEXT};
        snprintf(constant.text, sizeof constant.text, "%s", path + 1);
        return &constant;
    }
    const bool optional = *path == '?';
    path += optional;
    const char *before = *path == '^' ? p->outer : *path == '/' ? "" : p->inner;
    snprintf(full, sizeof full, "%s%s", before, path + (*path == '^' || *path == '/'));
    return optional ? value_find(v, full) : value_at(v, full);
}

/* ---- CSV --------------------------------------------------------------------------------------------------------- */

/* One field of RFC 4180 into `cell`; *at moves to the separator behind it. Lines end with CR LF. */
static void read_cell(const char **at, char cell[WORD_SIZE]) {
    size_t used = 0;
    const bool quoted = **at == '"';
    *at += quoted;
    for (;; (*at)++) {
        assert_true(**at != '\0' && used + 1 < WORD_SIZE);
        if (quoted && **at == '"' && *++*at != '"')
            break;
        if (!quoted && (**at == ',' || **at == '\r'))
            break;
        assert_true(quoted || (**at != '"' && **at != '\n'));
        cell[used++] = **at;
    }
    cell[used] = '\0';
    assert_true(**at == ',' || strncmp(*at, "\r\n", 2) == 0);
}

static bool ends_line(const char **at) {
    const bool end = **at == '\r';
    *at += end ? 2 : 1;
    return end;
}

static bool cell_is(const char *cell, const wanted *want) {
    char *end;
    if (want == NULL || (want->kind == VALUE_TEXT && want->is_null) ||
        (want->kind == VALUE_NUMBER && isnan(want->number)))
        return *cell == '\0';
    if (want->kind == VALUE_TEXT)
        return strcmp(cell, want->text) == 0;
    if (want->kind == VALUE_BOOL)
        return strcmp(cell, want->number != 0 ? "true" : "false") == 0 ||
               strcmp(cell, want->number != 0 ? "1" : "0") == 0;
    const double got = strtod(cell, &end);
    return *cell != '\0' && *end == '\0' && got == want->number;
}

void check_csv_text(const values *v, const char *text, const csv_column *columns, size_t count,
                    const line_places *lines) {
    tally t = {.name = v->command};
    char cell[WORD_SIZE];
    const char *at = text;
    for (size_t i = 0; i < count; i++) {
        read_cell(&at, cell);
        TALLY(&t, strcmp(cell, columns[i].head) == 0, "column %zu is '%s', not '%s'", i, cell, columns[i].head);
        assert_true(ends_line(&at) == (i + 1 == count));
    }
    for (size_t line = 0; line < lines->count; line++)
        for (size_t i = 0; i < count; i++) {
            const wanted *want = resolve(v, &lines->items[line], columns[i].path);
            if (*at == '\0')
                fail_msg("%s: %zu lines of CSV, not %zu", v->command, line, lines->count);
            read_cell(&at, cell);
            TALLY(&t, cell_is(cell, want), "line %zu, %s: printed '%s', computed %.17g '%s'", line, columns[i].head,
                  cell, want != NULL ? want->number : NAN, want != NULL ? want->text : "");
            assert_true(ends_line(&at) == (i + 1 == count));
        }
    TALLY(&t, *at == '\0', "more lines than %zu: %.80s", lines->count, at);
    tally_end(&t);
}

void check_csv(const values *v, int status, const char *arguments, const csv_column *columns, size_t count,
               const line_places *lines) {
    char *text = output_of(status, arguments, "--csv");
    check_csv_text(v, text, columns, count, lines);
    free(text);
}

/* ---- Text -------------------------------------------------------------------------------------------------------- */

/* Within one unit of the last digit that is shown; "<1" is less. */
static bool shows(const char *word, const wanted *want, int digits) {
    char *end;
    const double value = want->number;
    if (want->kind == VALUE_TEXT)
        return strcmp(word, want->text) == 0;
    if (isnan(value))
        return strcmp(word, "-") == 0;
    if (word[0] == '<')
        return value < strtod(word + 1, NULL);
    const double got = strtod(word, &end);
    if (*end != '\0' || end == word)
        return false;
    if (got == value)
        return true;
    const double unit = pow(10, digits > 0 ? floor(log10(fabs(value))) - digits + 1 : digits);
    return isfinite(value) && fabs(got - value) <= unit * (1 + 1e-9);
}

/* A line of a table: at least two words, and the first two are numbers, or "all" and a number, or none. */
static bool is_table_line(const char *line, size_t length) {
    const char *at = line, *end = line + length;
    for (int i = 0; i < 2; i++) {
        char *rest;
        at += strspn(at, " ");
        strtod(at, &rest);
        rest += i == 0 && strncmp(at, "all ", 4) == 0 ? 3 : 0;
        if (i == 1 && rest == at)
            rest += *at == '-';
        if (at >= end || rest == at || (*rest != ' ' && *rest != '\n'))
            return false;
        at = rest;
    }
    return true;
}

/* The next word of a line, without what punctuates it. */
static bool next_word(const char **at, const char *end, char word[WORD_SIZE]) {
    while (*at < end && strchr(" ,;:()%", **at) != NULL)
        (*at)++;
    size_t used = 0;
    while (*at < end && strchr(" ,;:()%", **at) == NULL && used + 1 < WORD_SIZE)
        word[used++] = *(*at)++;
    word[used] = '\0';
    return used > 0;
}

/* The sum of a table is labelled in place of its first number. */
static bool is_sum(const char *word, size_t column) {
    return column == 0 && strcmp(word, "all") == 0;
}

static const char *line_end(const char *line) {
    return line + strcspn(line, "\n");
}

void check_text_table(const values *v, const char *text, const text_column *columns, size_t count,
                      const line_places *lines) {
    tally t = {.name = v->command};
    char word[WORD_SIZE];
    size_t line = 0;
    for (const char *at = text; *at != '\0';) {
        const char *end = line_end(at);
        if (is_table_line(at, (size_t)(end - at))) {
            if (line == lines->count)
                fail_msg("%s: more lines than %zu: %.*s", v->command, lines->count, (int)(end - at), at);
            for (size_t i = 0; i < count; i++) {
                const wanted *want = resolve(v, &lines->items[line], columns[i].path);
                TALLY(&t, next_word(&at, end, word) && (is_sum(word, i) || shows(word, want, columns[i].digits)),
                      "line %zu, column %zu, %s: printed '%s', computed %.17g", line, i, columns[i].path, word,
                      want->number);
            }
            TALLY(&t, !next_word(&at, end, word), "line %zu: '%s' is one word more", line, word);
            line++;
        }
        at = *end != '\0' ? end + 1 : end;
    }
    TALLY(&t, line == lines->count, "%zu lines of text, not %zu", line, lines->count);
    tally_end(&t);
}

void check_text_numbers(const values *v, const char *text, const char *label, int digits, const char *const *paths) {
    char word[WORD_SIZE];
    const char *at = text;
    while (*at != '\0' && strncmp(at + strspn(at, " "), label, strlen(label)) != 0)
        at = *line_end(at) != '\0' ? line_end(at) + 1 : line_end(at);
    if (*at == '\0')
        fail_msg("%s: no line begins with '%s'", v->command, label);
    const char *end = line_end(at);
    at += strspn(at, " ") + strlen(label);
    for (; *paths != NULL; paths++) {
        char *rest = word;
        while (next_word(&at, end, word) && strcmp(word, "-") != 0 &&
               (strtod(word, &rest), rest == word || *rest != '\0'))
            continue;
        if (!shows(word, value_at(v, *paths), digits))
            fail_msg("%s: '%s': %s: printed '%s', computed %.17g", v->command, label, *paths, word,
                     value_at(v, *paths)->number);
    }
}
