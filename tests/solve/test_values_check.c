/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every value that check prints, in all its forms: the verdicts against the analysis of the same file, the share of
 * ties against a count of the depths. */
#include "printed.h"
#include "solve/check.h"
#include "zfight/census.h"

/* A name with a quote and a backslash, in the file as the grammar wants it. */
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
    if (n->kind != QUANTITY_ERROR)
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
    want(v, "width=%u height=%u fov=%f", 640U, 360U, dp_fov_vertical(75.5, 640, 360));
    want(v, "raster=%s arith=%s subpixel=%u", "spec-vulkan", "ieee", 7U);
    want(v, "slant_lo=%f slant_hi=%f depth=%f pixels=%f slim=%f", 5.0, 65.0, 1.5, 99.0, 6.0);
}

static void want_verdict(values *v, const char *path, const char *text, const check_verdict *verdict, size_t i) {
    const need *n = verdict->asked;
    char key[256];
    snprintf(key, sizeof key, "{ name = \"%s\"", strcmp(n->name, name) == 0 ? name_in_file : n->name);
    assert_non_null(strstr(text, key));
    values_under(v, "requirements[%zu].setup.", i);
    want_setup(v, &verdict->setup);
    values_under(v, "requirements[%zu].", i);
    want(v, "file=%s line=%u name=%s", path, (unsigned)line_of(text, strstr(text, key)), n->name);
    want(v, "camera=%s kind=%s unit=%s", verdict->camera->name, quantity_get(n->kind)->name, "m");
    want(v, "lo=%f hi=%f limit=%f value=%f", n->lo, n->hi, n->limit, verdict->value);
    want(v, "z=%f code=%f method=%s", verdict->z, code_of(verdict), check_method_name(verdict->method));
    want(v, "passed=%d surfaces=%s", verdict->value <= n->limit, is_slope(verdict) ? "5 to 65 degrees" : "facing");
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
static void check_text(values *v, const char *text, const need_file *file, const check_verdict *verdicts, long failed) {
    char label[1024], setup[64];
    for (size_t i = 0; i < check_count(file); i++) {
        const check_verdict *d = &verdicts[i];
        char said_of[64];
        label_of(&d->setup, setup);
        const quantity_row *kind = quantity_get(d->asked->kind);
        snprintf(label, sizeof label, "%s  %s:%d: %s: camera %s, %s (%s): %s ", d->passed ? "pass" : "FAIL", file->path,
                 d->asked->line, d->asked->name, d->camera->name, setup, dp_model_name(d->setup.spec.model),
                 kind->note);
        /* A share is of a range, anything else of a depth, if there is one. */
        values_under(v, "requirements[%zu].", i);
        check_line(v, text, label,
                   kind->unit == NULL ? "value:6, lo:6, hi:6, limit:6"
                   : isnan(d->z)      ? "value:6, limit:6"
                   : is_slope(d)      ? "value:6, z:6, code:6, triangles.slant_lo:4, triangles.slant_hi:4, limit:6"
                                      : "value:6, z:6, code:6, limit:6");
        snprintf(said_of, sizeof said_of, ", %s, allowed ", is_slope(d) ? "5 to 65 degrees" : "facing");
        const char *said = strstr(strstr(text, label), said_of), *end = strchr(strstr(text, label), '\n');
        assert_true((said != NULL && said < end) == (d->asked->kind == QUANTITY_SEPARATION));
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
                                       is_slope(d) ? ", 5 to 65 degrees" : "", path, d->asked->line);
        if (d->passed)
            snprintf(expected + used, sizeof expected - used, "/>\n");
        else
            snprintf(expected + used, sizeof expected - used, ">\n      <failure type=\"%s\" message=\"%s\">",
                     quantity_get(d->asked->kind)->name, escaped(line, message));
        if (strstr(p.out, expected) == NULL)
            fail_msg("not in the report: %s", expected);
    }
    printed_free(&p);
}

TEST(each_number) {
    char arguments[640], text[4096];
    need_file file;
    check_verdict *verdicts;
    values v = values_of("check");
    strcpy(v.unit, "m");
    snprintf(text, sizeof text, needs, name_in_file);
    const char *path = scratch_text("file.need", "%s", text);
    snprintf(arguments, sizeof arguments, "check '%s'", path);
    const long failed = judge(&v, path, text, &file, &verdicts);
    check_forms(&v, 1, arguments, "requirements[]",
                "file, line, name, camera, " SETUP_CSV_IN("setup.") "kind, unit, lo [scene], hi [scene], limit, value, "
                                                                    "z [scene], code, method, passed, surfaces");
    char *shown = output_of(1, arguments, "--full");
    check_text(&v, shown, &file, verdicts, failed);
    check_junit(path, shown, &file, verdicts, failed);
    free(shown);
    shown = output_of(1, arguments, "--report json");
    values_tell(&v, 1, arguments);
    check_json_text(&v, shown);
    free(shown);
    free(verdicts);
    need_release(&file);
    values_free(&v);
}

/* Two files, in each order: one that fails decides the exit status and the first line of the JSON. */
TEST(status) {
    const char *of[] = {scratch_text("good.need", "%s", passing), scratch_text("file.need", needs, name_in_file)};
    for (int i = 0; i < 4; i++) {
        json_t *root = json_printed(i > 0, "check '%s' '%s'", of[i & 1], of[i >> 1]);
        assert_true(flag_at(root, "passed") == (i == 0));
        json_decref(root);
        check_says(i > 0, "!pass ", "check -q '%s' '%s'", of[i & 1], of[i >> 1]);
        check_says(i > 0, i == 0 ? "!FAIL " : "FAIL ", "check -q '%s' '%s'", of[i & 1], of[i >> 1]);
    }
}

/* A bias is said to be judged where it was: for its slope, beyond surfaces that face the camera. */
TEST(at_the_slope) {
    static const char *const units[] = {"-2", "0"}, *const said[] = {"at the slope", "facing"};
    for (int i = 0; i < 4; i++) {
        const char *view = i < 2 ? "viewport = [640, 480]; fov = 60.0; subpixel = 8;" : "";
        const char *path = scratch_text(
            "slope.need",
            "cameras = { c = { near = 0.1; far = 1000.0; mapping = \"gl\"; format = \"unorm24\"; %s }; };\n"
            "requirements = { r = { camera = \"c\"; at = 10.0; bias = { api = \"gl\"; units = %s; slope = 0.001; }; }; "
            "};",
            view, units[i % 2]);
        check_says(1, said[i % 2], "check '%s'", path);
        check_says(1, "!degrees", "check '%s'", path);
        check_says(1, said[i % 2], "check --report junit '%s'", path);
        check_says(1, strstr(said[i % 2], "at the slope") != NULL ? ", at the slope)\"" : "!at the slope",
                   "check --report junit '%s'", path);
        json_t *root = json_printed(1, "check '%s'", path);
        assert_string_equal(text_at(root, "requirements[0].surfaces"), said[i % 2]);
        json_decref(root);
    }
}

LIST_TEST(check_apart)
