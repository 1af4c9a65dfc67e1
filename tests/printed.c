/* SPDX-License-Identifier: GPL-3.0-or-later */
#define _GNU_SOURCE /* nftw() */
#include "printed.h"

#include <ctype.h>
#include <ftw.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

/* ---- Running ----------------------------------------------------------------------------------------------------- */

static const char *program(void) {
    static char path[4096 + 32];
    const char *given = getenv("DEPTHPREC");
    if (given != NULL && *given != '\0')
        return given;
    const ssize_t length = readlink("/proc/self/exe", path, 4096); /* build/tests/test_x: build/depthprec */
    assert_true(length > 0);
    path[length] = '\0';
    for (int i = 0; i < 2 && strrchr(path, '/') != NULL; i++)
        *strrchr(path, '/') = '\0';
    strcat(path, "/depthprec");
    return path;
}

static char scratch[64];

static int remove_one(const char *path, const struct stat *status, int type, struct FTW *at) {
    (void)status, (void)type, (void)at;
    return remove(path);
}

static void remove_scratch(void) {
    nftw(scratch, remove_one, 8, FTW_DEPTH | FTW_PHYS);
}

const char *scratch_file(const char *name) {
    static char path[512];
    if (scratch[0] == '\0') {
        strcpy(scratch, "/tmp/depthprec-test-XXXXXX");
        assert_non_null(mkdtemp(scratch));
        atexit(remove_scratch);
    }
    snprintf(path, sizeof path, "%s/%s", scratch, name);
    return path;
}

static char *text_of_stream(FILE *in) {
    size_t size = 0, room = 1 << 16;
    char *text = malloc(room);
    assert_non_null(text);
    for (size_t got; (got = fread(text + size, 1, room - size - 1, in)) > 0;) {
        size += got;
        if (size + 1 == room)
            text = realloc(text, room *= 2);
        assert_non_null(text);
    }
    text[size] = '\0';
    assert_int_equal(strlen(text), size);
    return text;
}

char *text_of_file(const char *path) {
    FILE *in = fopen(path, "r");
    if (in == NULL)
        fail_msg("%s cannot be read", path);
    char *text = text_of_stream(in);
    fclose(in);
    return text;
}

printed print_of(const char *format, ...) {
    char arguments[4096], line[9216];
    va_list list;
    va_start(list, format);
    const int length = vsnprintf(arguments, sizeof arguments, format, list);
    va_end(list);
    assert_true(length >= 0 && (size_t)length < sizeof arguments);
    snprintf(line, sizeof line, "exec '%s' %s 2>'%s' </dev/null", program(), arguments, scratch_file("errors"));
    FILE *in = popen(line, "r");
    assert_non_null(in);
    printed p = {.out = text_of_stream(in)};
    const int status = pclose(in);
    p.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    p.errors = text_of_file(scratch_file("errors"));
    return p;
}

void printed_free(printed *p) {
    free(p->out);
    free(p->errors);
    *p = (printed){0};
}

/* Runs it and fails when the exit status is another. */
static char *output_of(int status, const char *arguments, const char *form) {
    printed p = print_of("%s %s", arguments, form);
    if (p.status != status)
        fail_msg("depthprec %s %s: exit status %d, not %d: %s", arguments, form, p.status, status, p.errors);
    free(p.errors);
    return p.out;
}

/* ---- What is wanted ---------------------------------------------------------------------------------------------- */

values values_of(const char *command) {
    values v = {.command = command};
    want_text(&v, "schema", "depthprec/1");
    want_text(&v, "command", command);
    want_text(&v, "version", DP_VERSION);
    return v;
}

void values_free(values *v) {
    free(v->items);
    *v = (values){0};
}

void values_under(values *v, const char *format, ...) {
    va_list list;
    char prefix[PATH_SIZE]; /* an argument may be the old one */
    va_start(list, format);
    vsnprintf(prefix, sizeof prefix, format, list);
    va_end(list);
    memcpy(v->prefix, prefix, sizeof prefix);
}

static wanted *add(values *v, const char *field, value_kind kind) {
    if (v->count == v->room) {
        v->room = v->room > 0 ? 2 * v->room : 64;
        v->items = realloc(v->items, v->room * sizeof *v->items);
        assert_non_null(v->items);
    }
    wanted *item = &v->items[v->count++];
    *item = (wanted){.kind = kind};
    const int length = snprintf(item->path, sizeof item->path, "%s%s", v->prefix, field);
    assert_true(length > 0 && (size_t)length < sizeof item->path);
    return item;
}

void want_number(values *v, const char *field, double number) {
    add(v, field, VALUE_NUMBER)->number = number;
}

void want_derived(values *v, const char *field, double number) {
    wanted *item = add(v, field, VALUE_NUMBER);
    item->number = number;
    item->derived = true;
}

void want_count(values *v, const char *field, uint64_t count) {
    assert_true(count < UINT64_C(1) << 53);
    want_number(v, field, (double)count);
}

void want_text(values *v, const char *field, const char *text) {
    wanted *item = add(v, field, VALUE_TEXT);
    item->is_null = text == NULL;
    const int length = snprintf(item->text, sizeof item->text, "%s", text != NULL ? text : "");
    assert_true((size_t)length < sizeof item->text);
}

void want_bool(values *v, const char *field, bool flag) {
    add(v, field, VALUE_BOOL)->number = flag;
}

void want_setup(values *v, const dp_setup *setup) {
    const dp_spec *spec = &setup->spec;
    want_number(v, "near", spec->znear);
    want_number(v, "far", spec->zfar);
    want_text(v, "projection", spec->ortho ? "orthographic" : "perspective");
    want_text(v, "mapping", dp_mapping_get(spec->mapping)->name);
    want_text(v, "format", spec->format.name);
    want_text(v, "rounding", dp_rounding_name(spec->rounding));
    want_text(v, "model", dp_model_name(spec->model));
    if (spec->model == DP_MODEL_FP32)
        want_text(v, "arith", dp_arith_get(spec->arith)->name);
    if (spec->mapping == DP_MAPPING_LOG)
        want_number(v, "log_c", spec->log_c);
}

/* Values are mostly looked for in the order in which they were wanted: begins behind the last that was found. */
static wanted *find(const values *v, const char *path) {
    static size_t next;
    for (size_t i = 0; i < v->count; i++) {
        wanted *item = &v->items[(next + i) % v->count];
        if (strcmp(item->path, path) == 0) {
            next = (next + i + 1) % v->count;
            return item;
        }
    }
    return NULL;
}

const wanted *value_at(const values *v, const char *path) {
    const wanted *found = find(v, path);
    if (found == NULL)
        fail_msg("%s: the test wants no value for %s", v->command, path);
    return found;
}

/* ---- JSON -------------------------------------------------------------------------------------------------------- */

json_t *json_of(const char *text) {
    json_error_t error;
    json_t *root = json_loads(text, JSON_REJECT_DUPLICATES, &error);
    if (root == NULL)
        fail_msg("no JSON: line %d, column %d: %s", error.line, error.column, error.text);
    return root;
}

static void leaf(values *v, tally *t, const char *path, const json_t *j) {
    wanted *want = find(v, path);
    if (want == NULL || want->derived) {
        TALLY(t, false, "%s: no test computes this field", path);
        return;
    }
    TALLY(t, !want->met, "%s: twice", path);
    want->met = true;
    const bool null = want->kind == VALUE_NUMBER ? !isfinite(want->number) : want->kind == VALUE_TEXT && want->is_null;
    if (null)
        TALLY(t, json_is_null(j), "%s: not null", path);
    else if (want->kind == VALUE_NUMBER)
        TALLY(t, json_is_number(j) && json_number_value(j) == want->number, "%s: printed %.17g, computed %.17g", path,
              json_number_value(j), want->number);
    else if (want->kind == VALUE_TEXT)
        TALLY(t, json_is_string(j) && strcmp(json_string_value(j), want->text) == 0, "%s: printed '%s', computed '%s'",
              path, json_is_string(j) ? json_string_value(j) : "(no text)", want->text);
    else
        TALLY(t, json_is_boolean(j) && json_is_true(j) == (want->number != 0), "%s: not %s", path,
              want->number != 0 ? "true" : "false");
}

static void walk(values *v, tally *t, const char *path, json_t *j) {
    char inner[PATH_SIZE];
    const char *key;
    json_t *item;
    size_t i;
    if (json_is_object(j)) {
        apart_note(v->command, path, j);
        json_object_foreach(j, key, item) {
            snprintf(inner, sizeof inner, "%s%s%s", path, *path != '\0' ? "." : "", key);
            walk(v, t, inner, item);
        }
    } else if (json_is_array(j)) {
        json_array_foreach(j, i, item) {
            snprintf(inner, sizeof inner, "%s[%zu]", path, i);
            walk(v, t, inner, item);
        }
    } else {
        leaf(v, t, path, j);
    }
}

void check_json_text(values *v, const char *text) {
    tally t = {.name = v->command};
    json_t *root = json_of(text);
    for (size_t i = 0; i < v->count; i++)
        v->items[i].met = false;
    walk(v, &t, "", root);
    for (size_t i = 0; i < v->count; i++)
        TALLY(&t, v->items[i].met || v->items[i].derived, "%s is missing", v->items[i].path);
    json_decref(root);
    tally_end(&t);
}

void check_json(values *v, int status, const char *arguments) {
    char *text = output_of(status, arguments, "--json");
    check_json_text(v, text);
    free(text);
}

/* ---- Lines ------------------------------------------------------------------------------------------------------- */

void place_add(line_places *l, const char *inner, const char *outer_format, ...) {
    va_list list;
    l->items = realloc(l->items, (l->count + 1) * sizeof *l->items);
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
    return optional ? find(v, full) : value_at(v, full);
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

void check_csv_text(const values *v, const char *text, const csv_column *columns, size_t count, const line_places *lines) {
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

/* A line of a table: at least two words, and the first two are numbers, or none. */
static bool is_table_line(const char *line, size_t length) {
    const char *at = line, *end = line + length;
    for (int i = 0; i < 2; i++) {
        char *rest;
        at += strspn(at, " ");
        strtod(at, &rest);
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
                TALLY(&t,
                      next_word(&at, end, word) && shows(word, want, columns[i].digits),
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

/* ---- Cameras ----------------------------------------------------------------------------------------------------- */

size_t camera_setups(const camera_case *c, dp_setup out[CAMERA_SETUPS]) {
    size_t count = 0;
    dp_spec spec = dp_spec_default();
    spec.znear = c->znear;
    spec.zfar = c->zfar;
    spec.ortho = c->ortho;
    spec.rounding = c->rounding;
    spec.model = c->model;
    spec.log_c = c->log_c != 0 ? c->log_c : 1;
    if (c->arith != NULL)
        assert_int_equal(dp_arith_parse(c->arith, &spec.arith), DP_OK);
    for (size_t f = 0; c->formats[f] != NULL; f++)
        for (size_t m = 0; c->mappings[m] != NULL; m++) {
            dp_format format[2];
            assert_int_equal(dp_format_parse(c->formats[f], format), 1);
            spec.format = format[0];
            assert_int_equal(dp_mapping_parse(c->mappings[m], &spec.mapping), DP_OK);
            assert_true(count < CAMERA_SETUPS);
            assert_int_equal(dp_setup_init(&out[count++], &spec), DP_OK);
        }
    return count;
}

static void list(char *out, size_t size, const char *before, const char *const *names) {
    for (size_t i = 0; names[i] != NULL; i++)
        snprintf(out + strlen(out), size - strlen(out), "%s%s", i == 0 ? before : ",", names[i]);
}

const char *camera_options(const camera_case *c, char out[512]) {
    snprintf(out, 512, "-n %.17g -f %.17g", c->znear, c->zfar);
    list(out, 512, " -F ", c->formats);
    list(out, 512, " -m ", c->mappings);
    if (c->ortho)
        strcat(out, " --ortho");
    if (c->rounding != DP_ROUND_NEAREST)
        snprintf(out + strlen(out), 512 - strlen(out), " --rounding %s", dp_rounding_name(c->rounding));
    if (c->model != DP_MODEL_EXACT && !c->implied)
        snprintf(out + strlen(out), 512 - strlen(out), " --model %s", dp_model_name(c->model));
    if (c->arith != NULL)
        snprintf(out + strlen(out), 512 - strlen(out), " --arith %s", c->arith);
    if (c->log_c != 0)
        snprintf(out + strlen(out), 512 - strlen(out), " --log-c %.17g", c->log_c);
    return out;
}
