/* SPDX-License-Identifier: GPL-3.0-or-later */
#define _GNU_SOURCE /* nftw() */
#include "printed.h"

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

char *output_of(int status, const char *arguments, const char *form) {
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
    if (spec->model == DP_MODEL_FLOAT)
        want_text(v, "arith", dp_arith_get(spec->arith)->name);
    if (spec->mapping == DP_MAPPING_LOG || spec->mapping == DP_MAPPING_THREE_WEBGL ||
        spec->mapping == DP_MAPPING_CESIUM || spec->mapping == DP_MAPPING_OSGEARTH)
        want_number(v, "log_c", spec->log_c);
    want_text(v, "unit", v->unit);
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
        want_number(v, "share", c.share[model]);
        want_number(v, "z", c.share[model] > 0 ? c.share_z[model] : NAN);
    }
    if (dp_mapping_get(setup->spec.mapping)->curve == DP_CURVE_LOG) {
        double share = 0, there = NAN;
        dp_spec spec = setup->spec;
        dp_setup exact;
        spec.model = DP_MODEL_EXACT;
        assert_int_equal(dp_setup_init(&exact, &spec), DP_OK);
        for (size_t i = 0; i < count; i++) {
            dp_budget b;
            assert_int_equal(dp_budget_at(&exact, z[i], NULL, &b), DP_OK);
            if (b.separation / dp_separation(&exact, z[i]) - 1 > share) {
                share = b.separation / dp_separation(&exact, z[i]) - 1;
                there = z[i];
            }
        }
        values_under(v, "%.60sshader.", under);
        want_number(v, "share", share);
        want_number(v, "z", there);
    }
    values_under(v, "%s", under);
    want_text(v, "model", dp_model_name(c.model));
    want_number(v, "tolerance", tolerance);
}

/* Values are mostly looked for in the order in which they were wanted: begins behind the last that was found. */
wanted *value_find(const values *v, const char *path) {
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

static void leaf(values *v, tally *t, const char *path, const json_t *j) {
    wanted *want = value_find(v, path);
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
        snprintf(out + strlen(out), 512 - strlen(out), c->half > 0 ? " --ortho=%g" : " --ortho", c->half);
    if (c->rounding != DP_ROUND_NEAREST)
        snprintf(out + strlen(out), 512 - strlen(out), " --rounding %s", dp_rounding_name(c->rounding));
    if (c->model != DP_MODEL_EXACT && !c->implied)
        snprintf(out + strlen(out), 512 - strlen(out), " --model %s", dp_model_name(c->model));
    if (c->arith != NULL)
        snprintf(out + strlen(out), 512 - strlen(out), " --arith %s", c->arith);
    if (c->log_c != 0)
        snprintf(out + strlen(out), 512 - strlen(out), " --log-c %.17g", c->log_c);
    if (c->unit != NULL)
        snprintf(out + strlen(out), 512 - strlen(out), " --unit %s", c->unit);
    return out;
}
