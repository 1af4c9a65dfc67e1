/* SPDX-License-Identifier: GPL-3.0-or-later */
/* CSV and text against the values that are wanted: printed.h. */
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

/* Is a value wanted under a prefix? Mostly behind the last one. */
static bool any_under(const values *v, const char *prefix) {
    static size_t last;
    for (size_t i = 0; i < v->count; i++) {
        const size_t at = (last + i) % v->count;
        if (strncmp(v->items[at].path, prefix, strlen(prefix)) == 0) {
            last = at;
            return true;
        }
    }
    return false;
}

/* Counts in "a[].b[]" the places of a, and for each of them those of b. */
line_places places_of(const values *v, const char *pattern) {
    const char *inner = strchr(pattern, '.');
    const bool sum = pattern[strlen(pattern) - 1] == '+';
    const int outer_name = (int)strcspn(pattern, "["), inner_name = inner != NULL ? (int)strcspn(inner + 1, "[") : 0;
    line_places l = {0};
    char outer[PATH_SIZE], line[PATH_SIZE];
    for (size_t i = 0;; i++) {
        snprintf(outer, sizeof outer, "%.*s[%zu].", outer_name, pattern, i);
        if (!any_under(v, outer))
            return l;
        if (inner == NULL) {
            place_add(&l, outer, "%s", "");
            continue;
        }
        for (size_t k = 0;; k++) {
            snprintf(line, sizeof line, "%.50s%.*s[%zu].", outer, inner_name, inner + 1, k);
            if (!any_under(v, line))
                break;
            place_add(&l, line + strlen(outer), "%s", outer);
        }
        if (sum)
            place_add(&l, "", "%s", outer);
    }
}

/* The next of "a, b, c"; false at the end. */
static bool next_column(const char **at, char column[WORD_SIZE]) {
    const char *end = strstr(*at, ", ");
    const size_t length = end != NULL ? (size_t)(end - *at) : strlen(*at);
    snprintf(column, WORD_SIZE, "%.*s", (int)length, *at);
    *at += length + (end != NULL ? 2 : 0);
    return length > 0;
}

static const wanted *resolve(const values *v, const line_place *p, const char *path) {
    char full[2 * PATH_SIZE];
    const char *before = *path == '^' ? p->outer : *path == '/' ? "" : p->inner;
    snprintf(full, sizeof full, "%s%s", before, path + (*path == '^' || *path == '/'));
    return value_find(v, full);
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

enum { COLUMNS_MAX = 64 };

typedef struct csv_column {
    bool optional, may_lack; /* the column; its value in some lines */
    char head[WORD_SIZE], path[PATH_SIZE];
} csv_column;

/* "z_stored [scene]" and "case = stability.case". */
static csv_column column_of(const char *text) {
    const char *path = strstr(text, " = ");
    csv_column c = {.optional = *text == '?', .may_lack = *text == '?' || (path != NULL && path[3] == '?')};
    text += c.optional;
    const size_t head = path != NULL ? (size_t)(path - text) : strlen(text);
    snprintf(c.head, sizeof c.head, "%.*s", (int)head, text);
    if (path != NULL)
        snprintf(c.path, sizeof c.path, "%s", path + 3 + (path[3] == '?'));
    else
        snprintf(c.path, sizeof c.path, "%.*s", (int)strcspn(c.head, " ["), c.head);
    return c;
}

/* Those that are there. */
static size_t columns_of(const values *v, const char *text, const line_places *lines, csv_column out[COLUMNS_MAX]) {
    char word[WORD_SIZE];
    size_t count = 0;
    while (next_column(&text, word)) {
        assert_true(count < COLUMNS_MAX);
        out[count] = column_of(word);
        bool there = !out[count].optional;
        for (size_t i = 0; i < lines->count && !there; i++)
            there = resolve(v, &lines->items[i], out[count].path) != NULL;
        count += there;
    }
    return count;
}

void check_csv_text(const values *v, const char *text, const char *columns, const line_places *lines) {
    static csv_column all[COLUMNS_MAX];
    const size_t count = columns_of(v, columns, lines, all);
    tally t = {.name = v->command};
    char cell[WORD_SIZE];
    const char *at = text;
    for (size_t i = 0; i < count; i++) {
        read_cell(&at, cell);
        TALLY(&t, strcmp(cell, all[i].head) == 0, "column %zu is '%s', not '%s'", i, cell, all[i].head);
        assert_true(ends_line(&at) == (i + 1 == count));
    }
    for (size_t line = 0; line < lines->count; line++)
        for (size_t i = 0; i < count; i++) {
            const wanted *want = resolve(v, &lines->items[line], all[i].path);
            if (*at == '\0')
                fail_msg("%s: %zu lines of CSV, not %zu", v->command, line, lines->count);
            if (want == NULL && !all[i].may_lack)
                fail_msg("%s: the test wants no value for %s of line %zu", v->command, all[i].path, line);
            read_cell(&at, cell);
            TALLY(&t, cell_is(cell, want), "line %zu, %s: printed '%s', computed %.17g '%s'", line, all[i].head, cell,
                  want != NULL ? want->number : NAN, want != NULL ? want->text : "");
            assert_true(ends_line(&at) == (i + 1 == count));
        }
    TALLY(&t, *at == '\0', "more lines than %zu: %.80s", lines->count, at);
    tally_end(&t);
}

void check_csv(const values *v, int status, const char *arguments, const char *columns, const line_places *lines) {
    char *text = output_of(status, arguments, "--csv");
    check_csv_text(v, text, columns, lines);
    free(text);
}

void check_forms(values *v, int status, const char *arguments, const char *pattern, const char *columns) {
    line_places lines = places_of(v, pattern);
    check_json(v, status, arguments);
    check_csv(v, status, arguments, columns, &lines);
    places_free(&lines);
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

/* "z:9" and "share:-3". */
static int path_of(const char *column, char path[PATH_SIZE]) {
    const char *digits = strchr(column, ':');
    assert_non_null(digits);
    snprintf(path, PATH_SIZE, "%.*s", (int)(digits - column), column);
    return atoi(digits + 1);
}

void check_table(const values *v, const char *text, const char *pattern, const char *columns) {
    tally t = {.name = v->command};
    line_places lines = places_of(v, pattern);
    char word[WORD_SIZE], column[WORD_SIZE], path[PATH_SIZE];
    size_t line = 0;
    for (const char *at = text; *at != '\0';) {
        const char *end = line_end(at), *rest = columns;
        if (is_table_line(at, (size_t)(end - at))) {
            if (line == lines.count)
                fail_msg("%s: more lines than %zu: %.*s", v->command, lines.count, (int)(end - at), at);
            for (size_t i = 0; next_column(&rest, column); i++) {
                const int digits = path_of(column, path);
                const wanted *want = resolve(v, &lines.items[line], path);
                if (want == NULL)
                    fail_msg("%s: the test wants no value for %s of line %zu", v->command, path, line);
                TALLY(&t, next_word(&at, end, word) && (is_sum(word, i) || shows(word, want, digits)),
                      "line %zu, column %zu, %s: printed '%s', computed %.17g", line, i, path, word, want->number);
            }
            TALLY(&t, !next_word(&at, end, word), "line %zu: '%s' is one word more", line, word);
            line++;
        }
        at = *end != '\0' ? end + 1 : end;
    }
    TALLY(&t, line == lines.count, "%zu lines of text, not %zu", line, lines.count);
    places_free(&lines);
    tally_end(&t);
}

void check_line(const values *v, const char *text, const char *label, const char *columns) {
    char word[WORD_SIZE], column[WORD_SIZE], path[PATH_SIZE];
    const char *at = text;
    while (*at != '\0' && strncmp(at + strspn(at, " "), label, strlen(label)) != 0)
        at = *line_end(at) != '\0' ? line_end(at) + 1 : line_end(at);
    if (*at == '\0')
        fail_msg("%s: no line begins with '%s'", v->command, label);
    const char *end = line_end(at);
    at += strspn(at, " ") + strlen(label);
    while (next_column(&columns, column)) {
        const int digits = path_of(column, path);
        char full[2 * PATH_SIZE], *rest = word;
        snprintf(full, sizeof full, "%s%s", v->prefix, path);
        while (next_word(&at, end, word) && strcmp(word, "-") != 0 &&
               (strtod(word, &rest), rest == word || *rest != '\0'))
            continue;
        if (!shows(word, value_at(v, full), digits))
            fail_msg("%s: '%s': %s: printed '%s', computed %.17g", v->command, label, full, word,
                     value_at(v, full)->number);
    }
}
