/* SPDX-License-Identifier: GPL-3.0-or-later */
#define _GNU_SOURCE /* nftw() */
#include "printed.h"

#include <ctype.h>
#include <ftw.h>
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

/* Each name has its string, to the end of the program. */
const char *scratch_file(const char *name) {
    enum { FILES_MAX = 256 };
    static char *paths[FILES_MAX];
    char path[512];
    size_t i = 0;
    if (scratch[0] == '\0') {
        strcpy(scratch, "/tmp/depthprec-test-XXXXXX");
        assert_non_null(mkdtemp(scratch));
        atexit(remove_scratch);
    }
    snprintf(path, sizeof path, "%s/%s", scratch, name);
    while (i < FILES_MAX && paths[i] != NULL && strcmp(paths[i], path) != 0)
        i++;
    assert_true(i < FILES_MAX);
    paths[i] = paths[i] != NULL ? paths[i] : strdup(path);
    return paths[i];
}

const char *scratch_text(const char *name, const char *format, ...) {
    const char *path = scratch_file(name);
    va_list list;
    FILE *out = fopen(path, "w");
    assert_non_null(out);
    va_start(list, format);
    vfprintf(out, format, list);
    va_end(list);
    assert_int_equal(fclose(out), 0);
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

static printed run(const char *arguments) {
    char line[9216];
    const char *errors = scratch_file("errors");
    snprintf(line, sizeof line, "exec ${EMULATOR-} '%s' %s 2>'%s' </dev/null", program(), arguments, errors);
    FILE *in = popen(line, "r");
    assert_non_null(in);
    printed p = {.out = text_of_stream(in)};
    const int status = pclose(in);
    p.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    p.errors = text_of_file(errors);
    return p;
}

/* The arguments of a format and those behind it, for functions that have them. */
#define FORMATTED(out, format)                                                                                         \
    do {                                                                                                               \
        va_list list;                                                                                                  \
        va_start(list, format);                                                                                        \
        const int length = vsnprintf(out, sizeof out, format, list);                                                   \
        va_end(list);                                                                                                  \
        assert_true(length >= 0 && (size_t)length < sizeof out);                                                       \
    } while (0)

printed print_of(const char *format, ...) {
    char arguments[4096];
    FORMATTED(arguments, format);
    return run(arguments);
}

void printed_free(printed *p) {
    free(p->out);
    free(p->errors);
    *p = (printed){0};
}

void printed_unfold(char *text) {
    char *to = text;
    for (char *from = text; *from != '\0'; from++)
        if (!isspace((unsigned char)*from))
            *to++ = *from;
        else if (to > text && to[-1] != ' ')
            *to++ = ' ';
    *to = '\0';
}

char *output_of(int status, const char *arguments, const char *form) {
    printed p = print_of("%s %s", arguments, form);
    if (p.status != status)
        fail_msg("depthprec %s %s: exit status %d, not %d: %s", arguments, form, p.status, status, p.errors);
    free(p.errors);
    return p.out;
}

void check_says_all(int status, const char *line, const char *const *said) {
    printed p = run(line);
    for (; *said != NULL; said++) {
        const bool asked = **said != '!', found = strstr(status < 2 ? p.out : p.errors, *said + !asked) != NULL;
        if ((status >= 0 && p.status != status) || found != asked)
            fail_msg("depthprec %s: exit status %d, and '%s' is in: %s%s", line, p.status, *said, p.out, p.errors);
    }
    printed_free(&p);
}

void check_says(int status, const char *said, const char *format, ...) {
    char arguments[4096];
    FORMATTED(arguments, format);
    check_says_all(status, arguments, SAID(said));
}

void check_refused(const char *line, const refused_row *rows, size_t count) {
    for (size_t i = 0; i < count; i++) {
        printed p = print_of("%s %s", line, rows[i].words);
        const bool said =
            *p.out == '\0' || (strstr(p.out, "{\"schema\"") == p.out && strstr(p.out, "\"error\":{") != NULL);
        if (p.status != (rows[i].status > 0 ? rows[i].status : 2) || strstr(p.errors, rows[i].said) == NULL || !said)
            fail_msg("depthprec %s %s: exit status %d, not '%s': %s%s", line, rows[i].words, p.status, rows[i].said,
                     p.errors, p.out);
        printed_free(&p);
    }
}

/* ---- What is wanted ---------------------------------------------------------------------------------------------- */

values values_of(const char *line) {
    const char *unit = word_behind(line, "--unit");
    values v = {0};
    snprintf(v.unit, sizeof v.unit, "%s", unit != NULL ? unit : "");
    snprintf(v.command, sizeof v.command, "%.*s", (int)strcspn(line, " "), line);
    want(&v, "schema=%s command=%s version=%s", "depthprec/1", v.command, DP_VERSION);
    return v;
}

void values_free(values *v) {
    free(v->items);
    free(v->table);
    free(v->told);
    *v = (values){0};
}

void values_tell(values *v, int status, const char *arguments) {
    char *const text = output_of(status, arguments, ""), *to = text;
    for (const char *at = text; *at != '\0'; at++)
        if (!isspace((unsigned char)*at) || (to > text && to[-1] != ' '))
            *to++ = isspace((unsigned char)*at) ? ' ' : *at;
    *to = '\0';
    free(v->told);
    v->told = text;
}

void values_under(values *v, const char *format, ...) {
    va_list list;
    char prefix[PATH_SIZE]; /* an argument may be the old one */
    va_start(list, format);
    vsnprintf(prefix, sizeof prefix, format, list);
    va_end(list);
    memcpy(v->prefix, prefix, sizeof prefix);
}

static size_t hash_of(const char *path) {
    size_t hash = 5381;
    for (; *path != '\0'; path++)
        hash = 33 * hash ^ (unsigned char)*path;
    return hash ^ hash >> 15;
}

/* The entry of a path, or the free one where it would stand. */
static size_t *entry_of(const values *v, const char *path) {
    const size_t mask = 2 * v->room - 1;
    size_t at = hash_of(path) & mask;
    while (v->table[at] != 0 && strcmp(v->items[v->table[at] - 1].path, path) != 0)
        at = (at + 1) & mask;
    return &v->table[at];
}

/* A value wanted twice is found as it was at first. */
static void enter(values *v, size_t i) {
    size_t *entry = entry_of(v, v->items[i].path);
    *entry = *entry != 0 ? *entry : i + 1;
}

static wanted *add(values *v, const char *field, value_kind kind) {
    if (v->count == v->room) {
        v->room = v->room > 0 ? 2 * v->room : 64;
        v->items = realloc(v->items, v->room * sizeof *v->items);
        free(v->table);
        v->table = calloc(2 * v->room, sizeof *v->table);
        assert_true(v->items != NULL && v->table != NULL);
        for (size_t i = 0; i < v->count; i++)
            enter(v, i);
    }
    wanted *item = &v->items[v->count++];
    *item = (wanted){.kind = kind};
    const int length = snprintf(item->path, sizeof item->path, "%s%s", v->prefix, field);
    assert_true(length > 0 && (size_t)length < sizeof item->path);
    enter(v, v->count - 1);
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

void want(values *v, const char *format, ...) {
    va_list list;
    va_start(list, format);
    for (const char *at = format; *at != '\0';) {
        char field[PATH_SIZE];
        at += strspn(at, " ");
        const bool derived = *at == '~';
        at += derived;
        const size_t length = strcspn(at, "=");
        assert_true(at[length] == '=' && at[length + 1] == '%' && length < sizeof field);
        snprintf(field, sizeof field, "%.*s", (int)length, at);
        at += length + 2;
        const size_t kind = strcspn(at, " ");
        if (*at == 'f')
            want_number(v, field, va_arg(list, double));
        else if (*at == 'd')
            want_bool(v, field, va_arg(list, int) != 0);
        else if (*at == 's')
            want_text(v, field, va_arg(list, const char *));
        else if (*at == 'u')
            want_count(v, field, va_arg(list, unsigned));
        else if (*at == 'z')
            want_count(v, field, va_arg(list, size_t));
        else
            want_count(v, field, va_arg(list, uint64_t)); /* "lu" */
        v->items[v->count - 1].derived = derived;
        at += kind;
    }
    va_end(list);
}

void want_setup(values *v, const dp_setup *setup) {
    const dp_spec *spec = &setup->spec;
    want(v, "near=%f far=%f projection=%s", spec->znear, spec->zfar, spec->ortho ? "orthographic" : "perspective");
    want(v, "mapping=%s format=%s", dp_mapping_get(spec->mapping)->name, spec->format.name);
    want(v, "rounding=%s model=%s unit=%s", dp_rounding_name(spec->rounding), dp_model_name(spec->model),
         *v->unit != '\0' ? v->unit : NULL);
    if (spec->model == DP_MODEL_FLOAT)
        want_text(v, "arith", dp_arith_get(spec->arith)->name);
    if (spec->mapping == DP_MAPPING_LOG || spec->mapping == DP_MAPPING_THREE_WEBGL ||
        spec->mapping == DP_MAPPING_CESIUM || spec->mapping == DP_MAPPING_OSGEARTH)
        want_number(v, "log_c", spec->log_c);
}

/* "--model auto", and what share of the separation each simpler model leaves out. */
void want_choice(values *v, const char *under, const dp_setup *setup, const double *z, size_t count, double tolerance) {
    dp_choice c;
    char place[PATH_SIZE];
    assert_int_equal(dp_model_choose(setup, z, count, tolerance, &c), DP_OK);
    const dp_model fullest = isnan(c.share[DP_MODEL_FLOAT]) ? DP_MODEL_STAGED : DP_MODEL_FLOAT;
    for (int m = -1; m < (int)fullest; m++) {
        const dp_model model = m < 0 ? c.model : (dp_model)m;
        snprintf(place, sizeof place, "%.60s%s%s%s", under, m < 0 ? "" : "neglected.",
                 m < 0 ? "" : dp_model_name(model), m < 0 ? "" : ".");
        values_under(v, "%s", place);
        want(v, "share=%f z=%f", c.share[model], c.share[model] > 0 ? c.share_z[model] : NAN);
    }
    if (dp_mapping_get(setup->spec.mapping)->curve == DP_CURVE_LOG) {
        double share = 0, there = NAN;
        const dp_setup exact = setup_in(setup, DP_MODEL_EXACT);
        for (size_t i = 0; i < count; i++) {
            dp_budget b;
            assert_int_equal(dp_budget_at(&exact, z[i], NULL, &b), DP_OK);
            if (b.separation / dp_separation(&exact, z[i]) - 1 > share) {
                share = b.separation / dp_separation(&exact, z[i]) - 1;
                there = z[i];
            }
        }
        values_under(v, "%.60sshader.", under);
        want(v, "share=%f z=%f", share, there);
    }
    values_under(v, "%s", under);
    want(v, "model=%s tolerance=%f", dp_model_name(c.model), tolerance);
}

wanted *value_find(const values *v, const char *path) {
    const size_t found = *entry_of(v, path);
    return found != 0 ? &v->items[found - 1] : NULL;
}

const wanted *value_at(const values *v, const char *path) {
    const wanted *found = value_find(v, path);
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

json_t *json_printed(int status, const char *format, ...) {
    char arguments[4096];
    FORMATTED(arguments, format);
    printed p = print_of("%s --json", arguments);
    if (status >= 0 && p.status != status)
        fail_msg("depthprec %s: exit status %d, not %d: %s", arguments, p.status, status, p.errors);
    json_t *root = json_of(p.out);
    printed_free(&p);
    return root;
}

static json_t *node_of(const json_t *root, const char *path) {
    json_t *node = (json_t *)(uintptr_t)root;
    for (size_t length; *path != '\0' && node != NULL; path += length) {
        char key[PATH_SIZE];
        path += *path == '.';
        length = *path == '[' ? strcspn(path, "]") + 1 : strcspn(path, ".[");
        snprintf(key, sizeof key, "%.*s", (int)length, path);
        node = *path == '[' ? json_array_get(node, strtoul(key + 1, NULL, 10)) : json_object_get(node, key);
    }
    return node;
}

json_t *node_at(const json_t *root, const char *format, ...) {
    char path[PATH_SIZE];
    FORMATTED(path, format);
    return node_of(root, path);
}

double number_at(const json_t *root, const char *format, ...) {
    char path[PATH_SIZE];
    FORMATTED(path, format);
    const json_t *node = node_of(root, path);
    if (!json_is_number(node) && !json_is_null(node))
        fail_msg("%s is no number", path);
    return json_is_number(node) ? json_number_value(node) : NAN;
}

const char *text_at(const json_t *root, const char *format, ...) {
    char path[PATH_SIZE];
    FORMATTED(path, format);
    const json_t *node = node_of(root, path);
    if (!json_is_string(node) && !json_is_null(node))
        fail_msg("%s is no text", path);
    return json_string_value(node);
}

bool flag_at(const json_t *root, const char *format, ...) {
    char path[PATH_SIZE];
    FORMATTED(path, format);
    const json_t *node = node_of(root, path);
    if (!json_is_boolean(node))
        fail_msg("%s is neither true nor false", path);
    return json_is_true(node);
}

static void leaf(values *v, tally *t, const char *path, const json_t *j) {
    wanted *want = value_find(v, path);
    const char *const key = strrchr(path, '.');
    if (want == NULL && v->told != NULL && strcmp(key != NULL ? key + 1 : path, "verdict") == 0) {
        const char *const verdict = json_string_value(j);
        TALLY(t, verdict != NULL && *verdict != '\0' && strstr(v->told, verdict) != NULL, "%s: text does not say '%s'",
              path, verdict);
        return;
    }
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
    if (strstr(text, "\"verdict\":") != NULL)
        values_tell(v, status, arguments);
    check_json_text(v, text);
    free(text);
}

/* ---- Command lines, as the test reads them ----------------------------------------------------------------------- */

/* Behind an option, "--at 3" or "--at=3", or behind its name, where it has no word; null where it is not there. */
static const char *behind(const char *line, const char *option) {
    const size_t length = strlen(option);
    for (const char *at = line; (at = strstr(at, option)) != NULL; at += length)
        if ((at == line || at[-1] == ' ') && strchr(" =", at[length]) != NULL)
            return at + length + (at[length] != '\0');
    return NULL;
}

bool is_given(const char *line, const char *option) {
    return behind(line, option) != NULL;
}

const char *word_behind(const char *line, const char *option) {
    const char *at = behind(line, option);
    if (at == NULL)
        return NULL;
    static char words[16][512];
    static int next;
    char *word = words[next++ % 16];
    snprintf(word, sizeof words[0], "%.*s", (int)strcspn(at, " "), at);
    return word;
}

size_t numbers_behind(const char *line, const char *option, double *out, size_t room) {
    size_t count = 0;
    for (const char *at = behind(line, option); at != NULL; at += strspn(at, ",:x")) {
        char *end;
        const double number = strtod(at, &end);
        if (end == at)
            break;
        assert_true(count < room);
        out[count++] = number;
        at = end;
        if (strchr(",:x", *at) == NULL || *at == '\0')
            break;
    }
    return count;
}

double number_behind(const char *line, const char *option, double missing) {
    double number = missing;
    numbers_behind(line, option, &number, 1);
    return number;
}

/* The next of the words of a list, "a,b"; false at its end. */
static bool next_of(const char **list, char word[64]) {
    const size_t length = strcspn(*list, ",");
    snprintf(word, 64, "%.*s", (int)length, *list);
    *list += length + ((*list)[length] == ',');
    return length > 0;
}

static int named(const char *(*name)(int), const char *word) {
    int i = 0;
    while (name(i) != NULL && strcmp(name(i), word) != 0)
        i++;
    assert_non_null(name(i));
    return i;
}

static const char *rounding_name(int i) {
    return dp_rounding_name((dp_rounding)i);
}

static const char *model_name(int i) {
    return i < DP_MODEL_COUNT ? dp_model_name((dp_model)i) : NULL;
}

size_t setups_of(const char *line, dp_model model, dp_setup out[SETUPS_MAX]) {
    const char *formats = word_behind(line, "-F"), *word;
    char format[64], mapping[64];
    size_t count = 0;
    dp_spec spec = {.znear = number_behind(line, "-n", 0), .zfar = number_behind(line, "-f", 0), .model = model};
    spec.ortho = is_given(line, "--ortho");
    spec.log_c = number_behind(line, "--log-c", 0);
    if ((word = word_behind(line, "--rounding")) != NULL)
        spec.rounding = (dp_rounding)named(rounding_name, word);
    if ((word = word_behind(line, "--model")) != NULL && strcmp(word, "auto") != 0)
        spec.model = (dp_model)named(model_name, word);
    if ((word = word_behind(line, "--arith")) != NULL)
        assert_int_equal(dp_arith_parse(word, &spec.arith), DP_OK);
    while (next_of(&formats, format))
        for (const char *mappings = word_behind(line, "-m"); next_of(&mappings, mapping);) {
            assert_int_equal(dp_mapping_parse(mapping, &spec.mapping), DP_OK);
            assert_true(count < SETUPS_MAX);
            out[count++] = setup_with(format, spec);
        }
    return count;
}
