/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Functions of somebody's in the chart: worst errors and where they fail against the definition in long double, of
 * values computed by this test in binary32 at the same depths and cameras; on Mesa's llvmpipe, whose operations are
 * those of IEEE 754, fused or not.
 */
#include "method/method.h"
#include "printed.h"

enum { INPUTS = 65536, WALKED = 1024, FORMS = 4 };

static const char glsl[] = "uniform float n, f;\n"
                           "float complement(float d) { return n * f / (n + (1.0 - d) * (f - n)); }\n"
                           "float book(float d) { return 2.0 * n * f / (f + n - (2.0 * d - 1.0) * (f - n)); }\n"
                           "float view_z(float d) { return n * f / ((f - n) * d - f); }\n"
                           "float share(float d) { return n / (f - d * (f - n)); }\n"
                           "float way(float d) { return d * n / (f - d * (f - n)); }\n"
                           "float swapped(float d) { return n * f / (n - d * (n - f)); }\n"
                           "float inverted(float d) { return f / ((1.0 - n / f) * d + f / n); }\n"
                           "float square(float d) { return d * d + n; }\n"
                           "float literal(float d) { return 100.0 / (1000.0 - d * 999.9); }\n"
                           "float stored(float z) { return f * (z - n) / (z * (f - n)); }\n"
                           "float slow(float d) {\n"
                           "    float x = d + n;\n"
                           "    for (int i = 0; i < 100; i++)\n"
                           "        x = 1.0 / (x + d);\n"
                           "    return x;\n"
                           "}\n";

/* A form fuses a product into the sum behind it, or not; divides, or multiplies by a reciprocal. */
static float over(int form, float a, float b) {
    return form / 2 ? a * (1.0F / b) : a / b;
}

static float plus(int form, float a, float b, float c) {
    return form % 2 ? fmaf(a, b, c) : a * b + c;
}

static float complement(int k, float n, float f, float d) {
    return over(k, n * f, plus(k, 1.0F - d, f - n, n));
}

static float book(int k, float n, float f, float d) {
    return over(k, 2.0F * n * f, plus(k, -plus(k, 2.0F, d, -1.0F), f - n, f + n));
}

static float view_z(int k, float n, float f, float d) {
    return over(k, n * f, plus(k, f - n, d, -f));
}

static float part(int k, float n, float f, float d) {
    return over(k, n, plus(k, -d, f - n, f));
}

static float way(int k, float n, float f, float d) {
    return over(k, d * n, plus(k, -d, f - n, f));
}

static float swapped(int k, float n, float f, float d) {
    return over(k, n * f, plus(k, -d, n - f, n));
}

static float inverted(int k, float n, float f, float d) {
    return over(k, f, plus(k, 1.0F - over(k, n, f), d, over(k, f, n)));
}

static float square(int k, float n, float f, float d) {
    (void)f;
    return plus(k, d, d, n);
}

static float literal(int k, float n, float f, float d) {
    (void)n, (void)f;
    return over(k, 100.0F, plus(k, -d, 999.9F, 1000.0F));
}

/* The function of eye depth that a value is. */
enum { EYE, BEHIND, OF_FAR, FROM_NEAR };
static const struct function {
    const char *name, *verdict, *computes;
    float (*of)(int form, float n, float f, float d);
    int as;
    bool walks;
} functions[] = {{"complement", "right", "eye depth", complement, EYE, true},
                 {"book", "right", "eye depth", book, EYE, true},
                 {"view_z", "right", "minus eye depth", view_z, BEHIND, true},
                 {"share", "right", "eye depth over far", part, OF_FAR, true},
                 {"way", "right", "the way from near to far", way, FROM_NEAR, true},
                 {"swapped", "another set-up", "eye depth", swapped, EYE, true},
                 {"inverted", "wrong", "eye depth", inverted, EYE, true},
                 {"square", "unknown", "-", square, EYE, true},
                 {"literal", "right", "eye depth", literal, EYE, false}};
enum { FUNCTIONS = sizeof functions / sizeof functions[0] };

static double worst_of(const struct function *w, int form, double n, double f, size_t count) {
    static float d[INPUTS];
    dp_setup setup;
    double worst = 0;
    assert_int_equal(method_setup(&linearize_family, 0, n, f, false, &setup), DP_OK);
    method_windows(&setup, &(method_inputs){.count = count, .d = d});
    for (size_t i = 0; i < count; i++) {
        const long double z = n * (long double)f / (n + ((long double)f - n) * (1 - (long double)d[i]));
        const long double v = w->of(form, (float)n, (float)f, d[i]);
        const long double got = w->as == EYE      ? v
                                : w->as == BEHIND ? -v
                                : w->as == OF_FAR ? v * f
                                                  : n + v * ((long double)f - n);
        const double error = (double)(fabsl(got - z) / z);
        worst = isnan(error) ? INFINITY : fmax(worst, error);
    }
    return worst;
}

/* Over the near planes of the walk. */
static double walked(const struct function *w, int form, double ratio) {
    static const double near[] = {1e-12, 0.1, 1e6, 0.74408};
    double worst = 0;
    for (int i = 0; i < 4; i++)
        worst = fmax(worst, worst_of(w, form, near[i], near[i] * ratio, WALKED));
    return worst;
}

static bool same(double a, double b) {
    return a == b || fabs(a - b) <= 1e-7 * fabs(b);
}

static bool is_number_or(const json_t *at, double want) {
    return json_is_number(at) ? same(json_number_value(at), want) : isinf(want);
}

static const char *file(void) {
    return scratch_text("mine.glsl", "%s", glsl);
}

/* " --mine FILE:NAME" of some. */
static const char *some(int from, int to) {
    static char line[4096];
    line[0] = '\0';
    for (int i = from; i < to; i++)
        snprintf(line + strlen(line), sizeof line - strlen(line), " --mine %s:%s", file(), functions[i].name);
    return line;
}

static void need_device(bool known) {
    printed p = print_of("judge %s:book --json -F d16", file());
    const bool lacks = strstr(p.errors, "Debian's package") != NULL || strstr(p.errors, "device") != NULL;
    const bool there = p.status == 0, other = there && strstr(p.out, "\"device\":\"llvmpipe") == NULL;
    if (!there)
        printf("# %s", p.errors);
    assert_true(there || lacks);
    printed_free(&p);
    if (!there || (known && other))
        skip();
}

/* Looks among the test's functions, or else ours. */
static json_t *row_of(json_t *root, const char *name) {
    json_t *row, *rows = json_object_get(root, "methods");
    for (size_t i = json_array_size(rows); (row = json_array_get(rows, --i)) != NULL;) {
        const char *function = text_at(row, "function");
        if (strcmp(function != NULL ? strrchr(function, ':') + 1 : text_at(row, "name"), name) == 0)
            return row;
    }
    fail_msg("no row %s", name);
    return NULL;
}

/* The form in which this driver computes it, by its worst error. */
static int form_of(const struct function *w, double relative) {
    int form = 0;
    while (form < FORMS && !same(relative, worst_of(w, form, 0.1, 1000, INPUTS)))
        form++;
    return form;
}

static void check_walk(tally *t, const struct function *w, int form, json_t *row, double asked) {
    size_t k;
    json_t *step;
    json_array_foreach(node_at(row, "stability.walk"), k, step) {
        const double ratio = number_at(step, "ratio"), want = walked(w, form, ratio);
        TALLY(t, is_number_or(json_object_get(step, "error"), want), "%s at %g: want %g", w->name, ratio, want);
    }
    const json_t *breaks = node_at(row, "stability.breaks");
    const double at = json_is_number(breaks) ? json_number_value(breaks) : 1e12;
    TALLY(t, at <= 10 || walked(w, form, at / 1.02) <= asked, "%s fails before %g", w->name, at);
    TALLY(t, at >= 1e12 || walked(w, form, at * 1.02) > asked, "%s does not fail at %g", w->name, at);
}

static void check_functions(int from, int to, const char *options, double asked) {
    tally t = {.name = functions[from].name};
    json_t *root = json_printed(0, "methods linearize %s%s", options, some(from, to));
    for (int i = from; i < to; i++) {
        const struct function *w = &functions[i];
        json_t *row = row_of(root, w->name);
        const double relative = number_at(row, "relative");
        const int form = form_of(w, relative);
        const char *computes = text_at(row, "computes");
        /* Another has that name. */
        TALLY(&t, strcmp(text_at(row, i == 0 ? "function" : "name"), i == 0 ? text_at(row, "name") : w->name) == 0,
              "%s: is called %s", w->name, text_at(row, "name"));
        TALLY(&t, form < FORMS, "%s: off by %g, want %g", w->name, relative, worst_of(w, 0, 0.1, 1000, INPUTS));
        TALLY(&t, strcmp(text_at(row, "stability.verdict"), w->verdict) == 0, "%s: verdict", w->name);
        TALLY(&t, strcmp(computes != NULL ? computes : "-", w->computes) == 0, "%s: %s", w->name, computes);
        TALLY(&t,
              json_is_null(json_object_get(row, "bound")) && json_is_null(json_object_get(row, "claim")) &&
                  json_is_null(node_at(row, "stability.claim")),
              "%s: nothing is proven of it", w->name);
        if (w->walks)
            check_walk(&t, w, form % FORMS, row, asked);
        else
            TALLY(&t, json_is_null(node_at(row, "stability.breaks")), "%s: walks", w->name);
    }
    json_decref(root);
    tally_end(&t);
}

TEST(test_errors_and_where_they_fail) {
    need_device(true);
    check_functions(1, 2, "--tolerance 0.001", 0.001);
    if (test_effort() == EFFORT_QUICK)
        return;
    check_functions(0, 4, "", 0.5);
    check_functions(4, FUNCTIONS, "", 0.5);
}

/* 100 divisions in a chain take longer than one, which takes longer than none. */
TEST(test_times) {
    need_device(false);
    json_t *root = json_printed(0, "methods linearize --mine %s:slow --mine %s:book", file(), file());
    const double loop = number_at(root, "loop_ns"), one = number_at(row_of(root, "book"), "device_ns");
    const double slow = number_at(row_of(root, "slow"), "device_ns");
    assert_true(loop > 0 && slow > 10 * one && slow < 1e5 * one);
    assert_true(number_at(row_of(root, "textbook"), "device_ns") > 0);
    assert_true(json_is_null(json_object_get(row_of(root, "chebyshev"), "device_ns")));
    assert_true(json_is_null(json_object_get(row_of(root, "book"), "ns")));
    json_decref(root);
}

/* Without functions of anybody's: ours that GLSL has, on that device, of which the processor's memory is no limit; and
 * it is said where it is no GPU. */
TEST(ours_on_a_device) {
    need_device(false);
    json_t *root = json_printed(0, "plot pareto --json --device 0");
    const char *where = text_at(root, "subtitle");
    const json_t *series, *point;
    size_t s, i, names = 0, spreads = 0;
    assert_true((strstr(where, "llvmpipe") != NULL) == (strstr(where, "; in software") != NULL));
    json_array_foreach(node_at(root, "panels[0].series"), s, series) {
        assert_string_not_equal(text_at(series, "name"), "moving the same bytes");
        json_array_foreach(json_object_get(series, "points"), i, point) {
            const char *label = json_string_value(json_object_get(point, "label"));
            names += label != NULL && (strcmp(label, "unity") == 0 || strcmp(label, "complement") == 0);
            spreads += strcmp(text_at(series, "name"), "spread of the times") == 0;
            assert_true(number_at(point, "time") > 0 && (label == NULL || strcmp(label, "chebyshev") != 0));
        }
    }
    assert_true(names == 2 && spreads > 2);
    json_decref(root);
    root = json_printed(0, "methods linearize --device 0");
    assert_true(number_at(row_of(root, "unity"), "device_ns") > 0 && number_at(row_of(root, "unity"), "ns") > 0);
    json_decref(root);
}

/* Of codes: the worst steps that the device's methods are off by are those of binary32 here, rounded once and again. */
TEST(codes_on_a_device) {
    static const struct {
        const char *format;
        double most;
    } formats[] = {{"unorm16", 65535}, {"unorm24", 16777215}};
    static float d[INPUTS];
    dp_setup setup;
    need_device(true);
    for (size_t k = 0; k < 2; k++) {
        json_t *root = json_printed(0, "plot pareto encode -F %s --json --device 0", formats[k].format);
        const json_t *series, *point;
        size_t s, i, found = 0, spreads = 0;
        double rint_off = 0, floor_off = 0;
        assert_int_equal(method_setup(&encode_family, 1 + k, 0.1, 1000, false, &setup), DP_OK);
        method_windows(&setup, &(method_inputs){.count = INPUTS, .d = d});
        for (i = 0; i < INPUTS; i++) {
            const float product = d[i] * (float)formats[k].most;
            const double exact = (double)d[i] * formats[k].most, up = floor((double)(product + 0.5F));
            rint_off = fmax(rint_off, fabs(exact - nearbyint((double)product)));
            floor_off = up > formats[k].most ? (double)INFINITY : fmax(floor_off, fabs(exact - up));
        }
        assert_non_null(strstr(text_at(root, "subtitle"), "; in software"));
        json_array_foreach(node_at(root, "panels[0].series"), s, series)
            json_array_foreach(json_object_get(series, "points"), i, point) {
            const char *label = json_string_value(json_object_get(point, "label"));
            const double want = label == NULL ? (double)NAN : strcmp(label, "rint") == 0 ? rint_off : floor_off;
            spreads += strcmp(text_at(series, "name"), "spread of the times") == 0;
            if (label == NULL || (strcmp(label, "rint") != 0 && strcmp(label, "floor") != 0))
                continue;
            found++;
            assert_true(number_at(point, "time") > 0);
            if (isfinite(want))
                assert_true(same(number_at(point, "error"), want));
        }
        assert_true(found == 2 && spreads > 1);
        json_decref(root);
    }
    json_t *root = json_printed(0, "methods encode -F unorm24 --device 0");
    assert_true(number_at(row_of(root, "rint"), "device_ns") > 0 && number_at(row_of(root, "rint"), "ns") > 0);
    json_decref(root);
}

TEST(test_shown) {
    need_device(false);
    json_t *root = json_printed(0, "methods linearize --mine %s:stored --define n=near --define f=far", file());
    json_t *row = row_of(root, "stored");
    assert_string_equal(text_at(row, "stability.verdict"), "right"); /* and is not measured as what it is not */
    assert_string_equal(text_at(row, "computes"), "window depth");
    assert_string_equal(text_at(row, "defines"), "f = far, n = near");
    assert_true(isnan(number_at(row, "relative")) && isnan(number_at(row, "stability.breaks")));
    json_decref(root);
    check_says(0, "\"yours\"", "plot pareto --json --mine %s:book", file());
    check_says(0, "yours is off by more than a half", "plot stability --json --mine %s:book", file());
}

TEST(test_refused) {
    const char *path = file();
    check_says(2, "--mine: is for the family linearize, got interval", "methods interval --mine %s:book", path);
    check_says(2, "--mine: is for the family linearize, got encode", "plot pareto encode --csv --mine %s:book", path);
    check_says(2, "--mine: needs FAMILY", "methods --mine %s:book", path);
    check_says(2, "--define: needs --mine", "methods linearize --define a=1");
    check_says(2, "--device: needs one family", "plot pareto all --csv --device 0");
    check_says(2, "--device: is for the families linearize and encode, whose methods GLSL has, got position",
               "plot pareto position --csv --device 0");
    check_says(2, "--device: is for unorm16 and unorm24 of the family encode",
               "plot pareto encode -F fp16 --csv --device 0");
    check_says(2, "--device: is for unorm16 and unorm24 of the family encode", "methods encode -F fp32 --device 0");
    check_says(2, "--device: needs --mine in the figure stability", "plot stability --csv --device 0");
    check_says(2, "--device: needs FAMILY", "methods --device 0");
    check_says(2, "--mine: does not apply to the figure error", "plot error --csv --mine %s:book", path);
    check_says(2, "--mine: must be FILE, FILE:FUNCTION or FILE.spv", "methods linearize --mine %s:", path);
    check_says(2, "name its function, FILE:FUNCTION; it has complement, book,", "methods linearize --mine %s", path);
    check_says(2, "absent is no function of the file", "methods linearize --mine %s:absent", path);
    check_says(3, "No such file", "methods linearize --mine absent.glsl:f");
    check_says(2, "--mine: must not be more than 8", "methods linearize%s", some(0, FUNCTIONS));
}
