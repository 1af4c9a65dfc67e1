/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every value that check prints, in all its forms: the verdicts against the analysis of the same file, the share of
 * ties against a count of the depths. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "census/census.h"
#include "printed.h"
#include "requirement/check.h"

/* A name with a quote and a backslash, in the file as libconfig wants it. */
static const char *const name_in_file = "a\\\"quoted\\\"na\\\\me,<more>&less";
static const char *const name = "a\"quoted\"na\\me,<more>&less";

static const char *const needs =
    "unit = \"m\";\n"
    "cameras = {\n"
    "  plain = { near = 0.1; far = \"2 km\"; mapping = \"d3d\"; format = \"unorm24\"; rounding = \"zero\"; };\n"
    "  shader = { near = 0.1; far = 1000; mapping = \"gl-reversed\"; format = \"fp32\"; model = \"float\"; };\n"
    "  both = { near = 0.5; far = 900; mapping = \"reversed\"; format = \"depth24plus\"; model = \"auto\"; };\n"
    "  flat = { near = 1; far = 200; mapping = \"gl\"; format = \"unorm16\"; ortho = true; model = \"staged\"; };\n"
    "  view = { near = 0.25; far = 900; mapping = \"d3d\"; format = \"fp32\"; viewport = [640, 360]; hfov = 75.5; "
    "raster = \"spec-vulkan\"; subpixel = 7; slant = [5, 65]; triangle = { depth = 1.5; pixels = 99; slim = 6; }; };\n"
    "  sun = { near = -8; far = 9; mapping = \"d3d\"; format = \"unorm24\"; ortho = true; model = \"float\"; };\n"
    "};\n"
    "requirements = (\n"
    "  { name = \"%s\"; camera = \"plain\"; range = (0.5, 321.5); separation = \"50 mm\"; },\n"
    "  { name = \"depth\"; camera = \"plain\"; range = (\"2 m\", 50); error = 0.0125; },\n"
    "  { name = \"ties\"; camera = \"shader\"; range = (0.4925, 0.5075); ties = \"20 %%\"; },\n"
    "  { name = \"many\"; camera = \"shader\"; range = (1.5, 1.52); ties = 0.99; },\n"
    "  { name = \"point\"; camera = \"both\"; at = 77.5; separation = 0.25; },\n"
    "  { name = \"slope\"; camera = \"view\"; range = (2, 60.5); separation = 0.75; },\n"
    "  { name = \"smooth\"; camera = \"view\"; at = 60.5; error = 0.75; },\n"
    "  { name = \"wall\"; camera = \"flat\"; range = (1, 150.5); error = \"3 mm\"; },\n"
    "  { name = \"shadow\"; camera = \"sun\"; range = (-4.01, -3.99); ties = 0.9; },\n"
    "  { name = \"none\"; camera = \"both\"; range = (3, 4); ties = 0.5; }\n"
    ");\n";

static const char *const passing =
    "cameras = { a = { near = 0.1; far = 100; mapping = \"reversed\"; format = \"fp32\"; "
    "}; };\nrequirements = { b = { camera = \"a\"; at = 9.5; separation = 0.1; }; };\n";

static const char *write_file(const char *file, const char *format, const char *argument) {
    const char *path = scratch_file(file);
    FILE *out = fopen(path, "w");
    assert_non_null(out);
    fprintf(out, format, argument);
    fclose(out);
    return path;
}

/* Depth by depth: the share of neighbours whose codes are equal or in the wrong order, and the start of the binade of z
 * where it is greatest. */
static bool count_ties(void *context, const dp_setup *setup, double lo, double hi, bool sample, double *share,
                       double *z) {
    dp_pipeline p;
    double worst = -1, all = 0, wrong = 0, of_all = 0, of_wrong = 0, from = lo;
    const int sign = setup->reversed ? -1 : 1;
    (void)context;
    assert_false(sample);
    assert_int_equal(dp_pipeline_init(&p, setup), DP_OK);
    float a = (double)(float)lo < lo ? nextafterf((float)lo, HUGE_VALF) : (float)lo;
    for (; (double)nextafterf(a, HUGE_VALF) <= hi; a = nextafterf(a, HUGE_VALF)) {
        const float b = nextafterf(a, HUGE_VALF);
        wrong += sign * (double)dp_pipeline_code(&p, b) <= sign * (double)dp_pipeline_code(&p, a);
        all++;
        const double next = a < 0 ? -exp2(ceil(log2(-(double)a)) - 1) : exp2(floor(log2((double)a)) + 1);
        if ((double)b < next && (double)nextafterf(b, HUGE_VALF) <= hi)
            continue;
        if (wrong / all > worst) {
            worst = wrong / all;
            *z = from;
        }
        of_wrong += wrong;
        of_all += all;
        wrong = all = 0;
        from = next;
    }
    *share = of_wrong / of_all;
    return true;
}

static int line_of(const char *text, const char *found) {
    int line = 1;
    for (const char *at = text; at < found; at++)
        line += *at == '\n';
    return line;
}

/* The code at the depth named; of an error, on the side of the cell that has it. */
static double code_of(const check_verdict *verdict) {
    const need *n = verdict->asked;
    dp_worst worst;
    if (n->kind != NEED_ERROR)
        return isfinite(verdict->z) ? (double)dp_code(&verdict->setup, verdict->z) : NAN;
    assert_int_equal(dp_worst_over(&verdict->setup, n->lo, n->hi, &worst), DP_OK);
    return worst.error_code;
}

/* The one requirement of slanted surfaces. */
static bool is_slope(const check_verdict *v) {
    return strcmp(v->asked->name, "slope") == 0;
}

/* As the file has it. */
static void want_view(values *v, size_t i) {
    values_under(v, "requirements[%zu].triangles.", i);
    want_count(v, "width", 640);
    want_count(v, "height", 360);
    want_number(v, "fov", dp_fov_vertical(75.5, 640, 360));
    want_text(v, "raster", "spec-vulkan");
    want_text(v, "arith", "ieee");
    want_count(v, "subpixel", 7);
    want_number(v, "slant_lo", 5);
    want_number(v, "slant_hi", 65);
    want_number(v, "depth", 1.5);
    want_number(v, "pixels", 99);
    want_number(v, "slim", 6);
}

static void want_verdict(values *v, const char *path, const char *text, const check_verdict *verdict, size_t i) {
    char key[256];
    const bool named = strcmp(verdict->asked->name, name) == 0;
    snprintf(key, sizeof key, "{ name = \"%s\"", named ? name_in_file : verdict->asked->name);
    assert_non_null(strstr(text, key));
    values_under(v, "requirements[%zu].setup.", i);
    want_setup(v, &verdict->setup);
    values_under(v, "requirements[%zu].", i);
    want_text(v, "file", path);
    want_count(v, "line", (uint64_t)line_of(text, strstr(text, key)));
    want_text(v, "name", verdict->asked->name);
    want_text(v, "camera", verdict->camera->name);
    want_text(v, "kind", need_kind_get(verdict->asked->kind)->name);
    want_text(v, "unit", "m");
    want_number(v, "lo", verdict->asked->lo);
    want_number(v, "hi", verdict->asked->hi);
    want_number(v, "limit", verdict->asked->limit);
    want_number(v, "value", verdict->value);
    want_number(v, "z", verdict->z);
    want_number(v, "code", code_of(verdict));
    want_text(v, "method", check_method_name(verdict->method));
    want_bool(v, "passed", verdict->value <= verdict->asked->limit);
    want_text(v, "surfaces", is_slope(verdict) ? "any slant" : "facing");
    want_derived(v, "count", 1);
    if (is_slope(verdict))
        want_view(v, i);
}

/* Judged here; @return how many failed */
static long judge(values *v, const char *path, const char *text, need_file *file, check_verdict **verdicts) {
    need_error error;
    const check_request request = {.file = file, .count = count_ties};
    if (!need_read(path, file, &error))
        fail_msg("%d: %s", error.line, error.text);
    *verdicts = calloc(check_count(file), sizeof **verdicts);
    const long failed = check_all(&request, *verdicts);
    assert_true(failed > 0 && failed < (long)check_count(file));
    values_under(v, "%s", "");
    want_bool(v, "passed", false);
    for (size_t i = 0; i < check_count(file); i++)
        want_verdict(v, path, text, &(*verdicts)[i], i);
    return failed;
}

static void label_of(const dp_setup *setup, char out[64]) {
    snprintf(out, 64, "%s %s", setup->spec.format.name, dp_mapping_get(setup->spec.mapping)->name);
}

/* "FAIL  FILE:LINE: NAME: camera CAMERA, SET-UP (MODEL): separation 0.1 m at 5 m (code 1), facing, allowed 0.05 m" */
static void check_text(const values *v, const char *text, const need_file *file, const check_verdict *verdicts,
                       long failed) {
    char label[1024], setup[64];
    for (size_t i = 0; i < check_count(file); i++) {
        const check_verdict *d = &verdicts[i];
        char at[4][PATH_SIZE];
        const char *paths[5] = {at[0], at[1], at[2], at[3], NULL};
        label_of(&d->setup, setup);
        const need_kind_row *kind = need_kind_get(d->asked->kind);
        snprintf(label, sizeof label, "%s  %s:%d: %s: camera %s, %s (%s): %s ", d->passed ? "pass" : "FAIL", file->path,
                 d->asked->line, d->asked->name, d->camera->name, setup, dp_model_name(d->setup.spec.model),
                 kind->phrase);
        /* A share is of a range, anything else of a depth, if there is one. */
        const char *const of_depth[] = {"value", "z", "code", "limit"};
        const char *const of_range[] = {"value", "lo", "hi", "limit"};
        const bool two = kind->is_length && isnan(d->z);
        for (int k = 0, n = 0; k < 4; k++)
            if (k == 0 || k == 3 || !two)
                snprintf(at[n++], PATH_SIZE, "requirements[%zu].%s", i, (kind->is_length ? of_depth : of_range)[k]);
        paths[two ? 2 : 4] = NULL;
        check_text_numbers(v, text, label, 6, paths);
        snprintf(at[0], PATH_SIZE, ", %s, allowed ", is_slope(d) ? "any slant" : "facing");
        const char *said = strstr(strstr(text, label), at[0]), *end = strchr(strstr(text, label), '\n');
        assert_true((said != NULL && said < end) == (d->asked->kind == NEED_SEPARATION));
    }
    snprintf(label, sizeof label, "%s: %ld passed, %ld failed\n", file->path, (long)check_count(file) - failed, failed);
    assert_non_null(strstr(text, label));
}

static const char *escaped(const char *text, char out[1024]) {
    static const char marks[] = "&<>\"";
    static const char *const names[] = {"&amp;", "&lt;", "&gt;", "&quot;"};
    size_t used = 0;
    for (; *text != '\0'; text++) {
        const char *special = strchr(marks, *text);
        const char itself[2] = {*text, '\0'};
        const char *written = special != NULL ? names[special - marks] : itself;
        used += (size_t)snprintf(out + used, 1024 - used, "%s", written);
    }
    out[used] = '\0';
    return out;
}

/* The report of a test runner says the sentences of the text. */
static void check_junit(const char *path, const char *text, const need_file *file, const check_verdict *verdicts,
                        long failed) {
    char name_there[1024], message[1024], setup[64], expected[4096], line[2048];
    printed p = print_of("check --report junit '%s'", path);
    assert_int_equal(p.status, 1);
    snprintf(expected, sizeof expected, "<testsuite name=\"%s\" tests=\"%zu\" failures=\"%ld\" errors=\"0\">", path,
             check_count(file), failed);
    assert_non_null(strstr(p.out, expected));
    for (size_t i = 0; i < check_count(file); i++) {
        const check_verdict *d = &verdicts[i];
        label_of(&d->setup, setup);
        snprintf(line, sizeof line, "%s:%d: %s: camera %s, %s (%s): ", path, d->asked->line, d->asked->name,
                 d->camera->name, setup, dp_model_name(d->setup.spec.model));
        const char *sentence = strstr(text, line);
        assert_non_null(sentence);
        snprintf(line, sizeof line, "%.*s", (int)strcspn(sentence + strlen(line), "\n"), sentence + strlen(line));
        size_t used = (size_t)snprintf(expected, sizeof expected,
                                       "    <testcase classname=\"%s\" name=\"%s (%s%s)\" file=\"%s\" line=\"%d\"",
                                       d->camera->name, escaped(d->asked->name, name_there), setup,
                                       is_slope(d) ? ", any slant" : "", path, d->asked->line);
        if (d->passed)
            snprintf(expected + used, sizeof expected - used, "/>\n");
        else
            snprintf(expected + used, sizeof expected - used, ">\n      <failure type=\"%s\" message=\"%s\">",
                     need_kind_get(d->asked->kind)->name, escaped(line, message));
        if (strstr(p.out, expected) == NULL)
            fail_msg("not in the report: %s", expected);
    }
    printed_free(&p);
}

static void test_check(void **state) {
    static const csv_column columns[] = {
        {"file", "file"},     {"line", "line"},     {"name", "name"},     {"camera", "camera"},
        SETUP_COLUMNS,        {"kind", "kind"},     {"unit", "unit"},     {"lo [scene]", "lo"},
        {"hi [scene]", "hi"}, {"limit", "limit"},   {"value", "value"},   {"z [scene]", "z"},
        {"code", "code"},     {"method", "method"}, {"passed", "passed"}, {"surfaces", "surfaces"}};
    char path[512], arguments[640], text[4096];
    need_file file;
    check_verdict *verdicts;
    values v = values_of("check");
    v.unit = "m";
    line_places lines = {0};
    (void)state;
    snprintf(text, sizeof text, needs, name_in_file);
    snprintf(path, sizeof path, "%s", write_file("file.need", needs, name_in_file));
    snprintf(arguments, sizeof arguments, "check '%s'", path);
    const long failed = judge(&v, path, text, &file, &verdicts);
    for (size_t i = 0; i < check_count(&file); i++) {
        place_add(&lines, "", "requirements[%zu].", i);
        snprintf(lines.items[i].outer, PATH_SIZE, "requirements[%zu].setup.", i);
    }
    check_json(&v, 1, arguments);
    check_csv(&v, 1, arguments, columns, sizeof columns / sizeof columns[0], &lines);
    printed p = print_of("%s --full", arguments);
    assert_int_equal(p.status, 1);
    check_text(&v, p.out, &file, verdicts, failed);
    check_junit(path, p.out, &file, verdicts, failed);
    printed_free(&p);
    p = print_of("check --report json '%s'", path);
    check_json_text(&v, p.out);
    printed_free(&p);
    free(verdicts);
    need_release(&file);
    values_free(&v);
    places_free(&lines);
}

/* Two files, one of which passes: the other one decides the exit status and the first line of the JSON. */
static void test_status(void **state) {
    char good[512], bad[512];
    (void)state;
    snprintf(good, sizeof good, "%s", write_file("good.need", "%s", passing));
    snprintf(bad, sizeof bad, "%s", write_file("file.need", needs, name_in_file));
    for (int i = 0; i < 2; i++) {
        printed p = print_of("check --json '%s' '%s'", good, i == 0 ? good : bad);
        json_t *root = json_of(p.out);
        assert_int_equal(p.status, i);
        assert_true(json_is_true(json_object_get(root, "passed")) == (i == 0));
        json_decref(root);
        printed_free(&p);
        p = print_of("check -q '%s'", i == 0 ? good : bad);
        assert_true(p.status == i && strstr(p.out, "pass ") == NULL && (strstr(p.out, "FAIL ") != NULL) == (i == 1));
        printed_free(&p);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_check),
        cmocka_unit_test(test_status),
        cmocka_unit_test(check_apart),
    };
    return run_tap(tests);
}
