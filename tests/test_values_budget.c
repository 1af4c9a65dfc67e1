/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every value that budget prints, against the library. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/remedy.h"
#include "printed.h"

enum { DEPTHS = 6 };

typedef struct budget_case {
    camera_case camera;
    double z[DEPTHS];
    dp_budget_terms terms;
    const char *options;
    bool shader, matrix, divided; /* some mapping is logarithmic; and beside it one is not; or is written as clip z */
} budget_case;

static const budget_case budgets[] = {
    {{0.3, 1000, {"unorm24", "fp16"}, {"d3d", "gl-reversed"}, .implied = true, .model = DP_MODEL_FLOAT, .unit = "in"},
     {0.3, 1.7, 55, 321.5, 900, 990},
     {.world = 0},
     .options = ""},
    {{0.1,
      INFINITY,
      {"fp32", "unorm16"},
      {"reversed", "gl"},
      .implied = true,
      .model = DP_MODEL_FLOAT,
      .arith = "mesa"},
     {0.1, 3, 4e2, 1e4, 1e6, 3e9},
     {.interpolation = 1.5, .world = 700, .linearize = 1},
     .options = " --interpolation 1.5 --from-origin 700 --linearize"},
    {{0.5, 400, {"fp32", "unorm24"}, {"reversed"}, .implied = true, .model = DP_MODEL_FLOAT},
     {0.5, 2, 9, 33, 150, 390},
     {.interpolation = 2, .world = 30, .composition = DP_COMPOSITION_RELATIVE},
     .options = " --interpolation 2 --from-origin 30 --composition relative"},
    {{0.5, 400, {"unorm24"}, {"gl-reversed", "d3d"}, .implied = true, .model = DP_MODEL_FLOAT},
     {0.6, 2, 9, 33, 150, 390},
     {.world = 5000, .composition = DP_COMPOSITION_PRODUCTS},
     .options = " --from-origin 5000 --composition products"},
    {{2,
      90,
      {"unorm24"},
      {"reversed", "gl"},
      .implied = true,
      .ortho = 1,
      .model = DP_MODEL_FLOAT,
      .rounding = DP_ROUND_ZERO},
     {2, 3, 5, 7, 60, 90},
     {.interpolation = 0.25, .linearize = 1},
     .options = " --interpolation 0.25 --linearize --tolerance 3%"},
    {{0.2, 5e6, {"unorm24", "fp16"}, {"three-webgpu", "cesium"}, .implied = true, .unit = "m"},
     {0.2, 0.9, 16, 3e3, 7e5, 4e6},
     {.world = 0},
     .options = "",
     .shader = true},
    {{0.3, 1e9, {"fp32"}, {"log", "osgearth"}, .implied = true, .log_c = 0.03, .arith = "mesa-remap"},
     {0.3, 3, 4e2, 1e4, 1e6, 8e8},
     {.interpolation = 1.5, .log2 = 1},
     .options = " --interpolation 1.5 --log2 d3d",
     .shader = true,
     .divided = true},
    {{0.1, 1000, {"unorm24"}, {"reversed", "three-webgl"}, .implied = true},
     {0.3, 1.7, 55, 321.5, 900, 990},
     {.log2 = 2},
     .options = " --log2 rounded",
     .shader = true,
     .matrix = true,
     .divided = true},
};

static const char *log2_of(const budget_case *c) {
    static const char *const names[] = {"vulkan", "d3d", "rounded"};
    return names[c->terms.log2];
}

/* As the options spell it; none where eye depth is given. */
static const char *composition_of(const budget_case *c) {
    static const char *const names[] = {
        [DP_COMPOSITION_ONCE] = "once", [DP_COMPOSITION_PRODUCTS] = "products", [DP_COMPOSITION_RELATIVE] = "relative"};
    return c->terms.world > 0 ? names[c->terms.composition] : NULL;
}

/* Those of triangles are there only where these are asked for: see test_values_slant. */
static bool has_cause(const budget_case *c, int cause) {
    const bool shader = cause == DP_CAUSE_ARGUMENT || cause == DP_CAUSE_LOG2 || cause == DP_CAUSE_SCALE;
    return cause != DP_CAUSE_SNAPPING && cause != DP_CAUSE_SETUP && (!shader || c->shader);
}

static const char *cause_path(int cause) {
    static char path[64];
    snprintf(path, sizeof path, "causes.%s", dp_cause_name((dp_cause)cause));
    return path;
}

static void want_budget_row(values *v, const budget_case *c, const dp_budget *b, double z) {
    const bool some = isfinite(b->separation);
    want_number(v, "z", z);
    want_number(v, "separation", b->separation);
    want_number(v, "window", b->window);
    for (int i = 0; i < DP_CAUSE_COUNT; i++) {
        char derived[96];
        if (!has_cause(c, i))
            continue;
        want_number(v, cause_path(i), b->cause[i]);
        snprintf(derived, sizeof derived, "part.%s", dp_cause_name((dp_cause)i));
        want_derived(v, derived, some ? b->cause[i] : NAN);
        snprintf(derived, sizeof derived, "share.%s", dp_cause_name((dp_cause)i));
        want_derived(v, derived, some ? 100 * b->cause[i] / b->separation : NAN);
    }
}

static void want_budget_worst(values *v, const dp_setup *setup, const budget_case *c) {
    dp_budget worst = {.separation = -1}, b;
    double z = NAN;
    int largest = 0;
    for (int k = 0; k < DEPTHS; k++) {
        assert_int_equal(dp_budget_at(setup, c->z[k], &c->terms, &b), DP_OK);
        if (isfinite(b.separation) && b.separation > worst.separation) {
            worst = b;
            z = c->z[k];
        }
    }
    if (isnan(z)) {
        want_text(v, "worst", NULL);
        return;
    }
    for (int i = 1; i < DP_CAUSE_COUNT; i++)
        largest = worst.cause[i] > worst.cause[largest] ? i : largest;
    const remedy_result remedy = remedy_find(setup, &c->terms, z, (dp_cause)largest);
    values_under(v, "%sworst.", v->prefix);
    want_number(v, "z", z);
    want_number(v, "separation", worst.separation);
    want_text(v, "cause", dp_cause_name((dp_cause)largest));
    want_number(v, "share", worst.cause[largest] / worst.separation);
    want_text(v, "remedy", remedy.text);
    want_number(v, "remedy_separation", remedy.text != NULL ? remedy.separation : NAN);
}

static void want_budget(values *v, const budget_case *c, const dp_setup *setup, size_t i, line_places *lines) {
    char inner[32], under[PATH_SIZE];
    values_under(v, "setups[%zu].", i);
    dp_setup in_binary32 = *setup; /* as it is said of logarithmic mappings, too */
    in_binary32.spec.model = DP_MODEL_FLOAT;
    want_setup(v, &in_binary32);
    for (int k = 0; k < DEPTHS; k++) {
        dp_budget b;
        assert_int_equal(dp_budget_at(setup, c->z[k], &c->terms, &b), DP_OK);
        values_under(v, "setups[%zu].rows[%d].", i, k);
        want_budget_row(v, c, &b, c->z[k]);
        snprintf(inner, sizeof inner, "rows[%d].", k);
        place_add(lines, inner, "setups[%zu].", i);
    }
    values_under(v, "setups[%zu].", i);
    want_budget_worst(v, setup, c);
    values_under(v, "setups[%zu].", i);
    snprintf(under, sizeof under, "setups[%zu].auto.", i);
    if (setup->curve == DP_CURVE_LOG)
        want_text(v, "auto", NULL);
    else
        want_choice(v, under, setup, c->z, DEPTHS, strstr(c->options, "3%") != NULL ? 0.03 : 0.05);
}

/* The causes that the text leaves out are those of terms that were not given. */
static size_t budget_text_columns(const budget_case *c, char text[2 * DP_CAUSE_COUNT][64], text_column *out) {
    size_t count = 0;
    out[count++] = (text_column){"z", 9};
    out[count++] = (text_column){"separation", 6};
    for (int i = 0; i < DP_CAUSE_COUNT; i++) {
        if (!has_cause(c, i) || (i == DP_CAUSE_PROJECTION && c->shader && !c->matrix) ||
            (i == DP_CAUSE_NDC && c->shader && !c->divided) || (i == DP_CAUSE_COMPOSITION && c->terms.world == 0) ||
            (i == DP_CAUSE_LINEARIZATION && !c->terms.linearize) ||
            (i == DP_CAUSE_INTERPOLATION && c->terms.interpolation == 0))
            continue;
        snprintf(text[2 * i], 64, "part.%s", dp_cause_name((dp_cause)i));
        snprintf(text[2 * i + 1], 64, "share.%s", dp_cause_name((dp_cause)i));
        out[count++] = (text_column){text[2 * i], 2};
        out[count++] = (text_column){text[2 * i + 1], 0};
    }
    return count;
}

static size_t budget_columns(const budget_case *c, char text[2 * DP_CAUSE_COUNT][64], csv_column *out) {
    static const csv_column before[] = {SETUP_COLUMNS,
                                        {"arith", "^arith"},
                                        {"z [scene]", "z"},
                                        {"separation [scene]", "separation"},
                                        {"window", "window"}};
    size_t count = sizeof before / sizeof before[0];
    memcpy(out, before, sizeof before);
    for (int i = 0; i < DP_CAUSE_COUNT; i++) {
        if (!has_cause(c, i))
            continue;
        snprintf(text[2 * i], 64, "%s [scene]", dp_cause_name((dp_cause)i));
        snprintf(text[2 * i + 1], 64, "%s", cause_path(i));
        out[count++] = (csv_column){text[2 * i], text[2 * i + 1]};
    }
    out[count++] = (csv_column){"composition", "/terms.composition"};
    if (c->shader)
        out[count++] = (csv_column){"log2", "/terms.log2"};
    return count;
}

/* ---- Sentences --------------------------------------------------------------------------------------------------- */

/* A number at the place of a text, with so many digits; `upward`: it is promised, so never below. Behind it. */
static const char *number_in(const char *at, double want, int digits, bool upward) {
    char *end;
    const double got = strtod(at, &end), unit = pow(10, floor(log10(fabs(want))) - digits + 1);
    if (end == at || !(fabs(got - want) <= (upward ? 1 : 0.5) * unit * (1 + 1e-9)) || (upward && got < want))
        fail_msg("%.60s: should be %.17g", at, want);
    return end;
}

static const char *words_in(const char *at, const char *words) {
    if (strncmp(at, words, strlen(words)) != 0)
        fail_msg("'%.60s' should begin with '%s'", at, words);
    return at + strlen(words);
}

/* The same of a length, with the unit behind it. */
static const char *length_in(const char *at, const budget_case *c, double want, int digits, bool upward) {
    at = number_in(at, want, digits, upward);
    return c->camera.unit != NULL ? words_in(words_in(at, " "), c->camera.unit) : at;
}

/* "  at z = 990 format takes 52 %: reversed depth would need 0.1 in place of 0.3": 6 and 4 digits. */
static const char *advice_in(const char *at, const dp_setup *setup, const budget_case *c) {
    dp_budget worst = {.separation = -1}, b;
    double z = NAN, hopeless = NAN;
    int largest = 0;
    for (int k = 0; k < DEPTHS; k++) {
        assert_int_equal(dp_budget_at(setup, c->z[k], &c->terms, &b), DP_OK);
        if (isinf(b.separation) && isnan(hopeless))
            hopeless = c->z[k];
        if (isfinite(b.separation) && b.separation > worst.separation) {
            worst = b;
            z = c->z[k];
        }
    }
    if (!isnan(hopeless)) {
        at = length_in(words_in(at, "  at z = "), c, hopeless, 6, false);
        at = words_in(at, " no separation is guaranteed: everything farther may share its code\n");
    }
    if (isnan(z))
        return at;
    for (int i = 1; i < DP_CAUSE_COUNT; i++)
        largest = worst.cause[i] > worst.cause[largest] ? i : largest;
    const remedy_result remedy = remedy_find(setup, &c->terms, z, (dp_cause)largest);
    const double step = (double)nextafterf((float)z, HUGE_VALF) - (double)(float)z;
    at = words_in(length_in(words_in(at, "  at z = "), c, z, 6, false), " ");
    at = words_in(words_in(at, dp_cause_name((dp_cause)largest)), " takes ");
    const double share = strtod(at, (char **)&at);
    assert_true(fabs(share - 100 * worst.cause[largest] / worst.separation) <= 0.5 + 1e-9);
    at = words_in(at, " %: ");
    if (remedy.text != NULL) {
        at = length_in(words_in(words_in(at, remedy.text), " would need "), c, remedy.separation, 4, true);
        at = length_in(words_in(at, " in place of "), c, worst.separation, 4, true);
    } else if (worst.separation < 2 * step) {
        at = length_in(words_in(at, "nothing to gain: binary32 depths are themselves "), c, step, 4, false);
        at = words_in(at, " apart there");
    } else {
        at = words_in(at, "no other format or mapping helps");
    }
    return words_in(at, "\n");
}

/* "  float arithmetic (mesa) makes this 2.71 times worse at z = 316.228: model float is needed": 3 digits and 6. */
static void choice_in(const char *at, const dp_setup *setup, const budget_case *c) {
    dp_choice choice;
    char arith[64] = "";
    const double tolerance = strstr(c->options, "3%") != NULL ? 0.03 : 0.05;
    assert_int_equal(dp_model_choose(setup, c->z, DEPTHS, tolerance, &choice), DP_OK);
    const double share = choice.share[DP_MODEL_EXACT], z = choice.share_z[DP_MODEL_EXACT];
    const bool enough = choice.model == DP_MODEL_EXACT;
    if (setup->spec.arith != 0)
        snprintf(arith, sizeof arith, " (%s)", dp_arith_get(setup->spec.arith)->name);
    const bool added = c->terms.world != 0 || c->terms.linearize || c->terms.interpolation != 0;
    at = words_in(words_in(at, added ? "  without the added terms float arithmetic" : "  float arithmetic"), arith);
    if (share == 0)
        at = words_in(at, " adds nothing");
    else if (isinf(share))
        at = words_in(at, " leaves nothing certain");
    else {
        at = words_in(at, enough ? " makes this at most " : " makes this ");
        at = number_in(at, share >= 1 ? share + 1 : 100 * share, 3, false);
        at = words_in(at, share >= 1 ? " times worse" : " % worse");
    }
    if (share != 0)
        at = length_in(words_in(at, " at z = "), c, z, 6, false);
    words_in(at, enough                            ? ": the lattice is enough\n"
                 : choice.model == DP_MODEL_STAGED ? ": model staged is enough\n"
                                                   : ": model float is needed\n");
}

/* "  model staged leaves the shader out: with it this is 3.06 times worse at z = 1000" */
static void staged_in(const char *at, const dp_setup *setup, const budget_case *c) {
    double worst = 0, z = 0;
    dp_setup staged;
    dp_spec spec = setup->spec;
    dp_budget b;
    spec.model = DP_MODEL_STAGED;
    assert_int_equal(dp_setup_init(&staged, &spec), DP_OK);
    for (int k = 0; k < DEPTHS; k++) {
        assert_int_equal(dp_budget_at(setup, c->z[k], &c->terms, &b), DP_OK);
        if (b.separation / dp_separation(&staged, c->z[k]) > worst) {
            worst = b.separation / dp_separation(&staged, c->z[k]);
            z = c->z[k];
        }
    }
    at = words_in(at, "  model staged leaves the shader out: with it this is ");
    at = words_in(number_in(at, worst, 3, false), " times worse at z = ");
    words_in(length_in(at, c, z, 6, false), "\n");
}

/* They stand below each table, the only lines that begin with two blanks and a word. */
static void check_sentences(const char *text, const budget_case *c, const dp_setup *setups, size_t count) {
    for (size_t i = 0; i < count; i++) {
        while (*text != '\0' && !(strncmp(text, "  ", 2) == 0 && text[2] >= 'a' && text[2] <= 'z'))
            text += strcspn(text, "\n") + 1;
        text = advice_in(text, &setups[i], c);
        (setups[i].curve == DP_CURVE_LOG ? staged_in : choice_in)(text, &setups[i], c);
        text += strcspn(text, "\n") + 1;
    }
}

static void test_budget(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof budgets / sizeof budgets[0]; i++) {
        const budget_case *c = &budgets[i];
        values v = values_of("budget");
        v.unit = c->camera.unit;
        line_places lines = {0};
        dp_setup setups[CAMERA_SETUPS];
        char options[512], arguments[1024], heads[2 * DP_CAUSE_COUNT][64], texts[2 * DP_CAUSE_COUNT][64];
        csv_column columns[17 + DP_CAUSE_COUNT];
        text_column shown[2 + 2 * DP_CAUSE_COUNT];
        size_t used =
            (size_t)snprintf(arguments, 1024, "budget %s%s --at ", camera_options(&c->camera, options), c->options);
        for (int k = 0; k < DEPTHS; k++)
            used += (size_t)snprintf(arguments + used, 1024 - used, "%s%.17g", k > 0 ? "," : "", c->z[k]);
        values_under(&v, "terms.");
        want_number(&v, "interpolation", c->terms.interpolation);
        want_number(&v, "from_origin", c->terms.world);
        want_bool(&v, "linearize", c->terms.linearize);
        want_text(&v, "composition", composition_of(c));
        if (c->shader)
            want_text(&v, "log2", log2_of(c));
        const size_t n = camera_setups(&c->camera, setups);
        for (size_t k = 0; k < n; k++)
            want_budget(&v, c, &setups[k], k, &lines);
        check_json(&v, 0, arguments);
        check_csv(&v, 0, arguments, columns, budget_columns(c, heads, columns), &lines);
        printed p = print_of("%s --full", arguments);
        check_text_table(&v, p.out, shown, budget_text_columns(c, texts, shown), &lines);
        check_sentences(p.out, c, setups, n);
        printed_free(&p);
        values_free(&v);
        places_free(&lines);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_budget), cmocka_unit_test(check_apart)};
    return run_tap(tests);
}
