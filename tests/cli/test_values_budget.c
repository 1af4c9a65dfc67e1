/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every value that budget prints, against the library. */
#include "printed.h"
#include "quantity/cmd_budget/remedy.h"

enum { DEPTHS = 6 };

typedef struct budget_case {
    const char *line;
    dp_budget_terms terms;
    bool shader, matrix, divided; /* some mapping is logarithmic; and beside it one is not; or is written as clip z */
} budget_case;

static const budget_case budgets[] = {
    {"budget -n 0.3 -f 1000 -F unorm24,fp16 -m d3d,gl-reversed --unit in --at 0.3,1.7,55,321.5,900,990",
     {.world = 0},
     false,
     false,
     false},
    {"budget -n 0.1 -f inf -F fp32,unorm16 -m reversed,gl --arith mesa --interpolation 1.5 --from-origin 700 "
     "--linearize --at 0.1,3,4e2,1e4,1e6,3e9",
     {.interpolation = 1.5, .world = 700, .linearize = 1},
     false,
     false,
     false},
    {"budget -n 0.5 -f 400 -F fp32,unorm24 -m reversed --interpolation 2 --from-origin 30 --composition relative "
     "--at 0.5,2,9,33,150,390",
     {.interpolation = 2, .world = 30, .composition = DP_COMPOSITION_RELATIVE},
     false,
     false,
     false},
    {"budget -n 0.5 -f 400 -F unorm24 -m gl-reversed,d3d --from-origin 5000 --composition products "
     "--at 0.6,2,9,33,150,390",
     {.world = 5000, .composition = DP_COMPOSITION_PRODUCTS},
     false,
     false,
     false},
    {"budget -n 2 -f 90 -F unorm24 -m reversed,gl --ortho --rounding zero --interpolation 0.25 --linearize "
     "--tolerance 3% --at 2,3,5,7,60,90",
     {.interpolation = 0.25, .linearize = 1},
     false,
     false,
     false},
    {"budget -n 0.2 -f 5e6 -F unorm24,fp16 -m three-webgpu,cesium --unit m --at 0.2,0.9,16,3e3,7e5,4e6",
     {.world = 0},
     true,
     false,
     false},
    {"budget -n 0.3 -f 1e9 -F fp32 -m log,osgearth --log-c 0.03 --arith mesa-remap --interpolation 1.5 --log2 d3d "
     "--at 0.3,3,4e2,1e4,1e6,8e8",
     {.interpolation = 1.5, .log2 = 1},
     true,
     false,
     true},
    {"budget -n 0.1 -f 1000 -F unorm24 -m reversed,three-webgl --log2 rounded --at 0.3,1.7,55,321.5,900,990",
     {.log2 = 2},
     true,
     true,
     true},
};

static void depths_of(const budget_case *c, double z[DEPTHS]) {
    assert_int_equal(numbers_behind(c->line, "--at", z, DEPTHS), DEPTHS);
}

static double tolerance_of(const budget_case *c) {
    return is_given(c->line, "--tolerance") ? 0.03 : 0.05;
}

/* Those of triangles are there only where these are asked for: see test_values_slant. */
static bool has_cause(const budget_case *c, int cause) {
    const bool shader = cause == DP_CAUSE_ARGUMENT || cause == DP_CAUSE_LOG2 || cause == DP_CAUSE_SCALE;
    return cause != DP_CAUSE_SNAPPING && cause != DP_CAUSE_SETUP && (!shader || c->shader);
}

static void want_budget_row(values *v, const budget_case *c, const dp_budget *b, double z, double zfar) {
    const bool some = isfinite(b->separation);
    want(v, "z=%f separation=%f window=%f", z, b->separation, b->window);
    want_bool(v, "certain", some && (long double)z + b->separation <= zfar);
    for (int i = 0; i < DP_CAUSE_COUNT; i++) {
        static const char *const kinds[] = {"causes", "part", "share"};
        const double numbers[] = {b->cause[i], some ? b->cause[i] : NAN,
                                  some ? 100 * b->cause[i] / b->separation : NAN};
        for (int k = 0; k < 3 && has_cause(c, i); k++) {
            char field[64];
            snprintf(field, sizeof field, "%s.%s", kinds[k], dp_cause_name((dp_cause)i));
            (k == 0 ? want_number : want_derived)(v, field, numbers[k]);
        }
    }
}

/* The separation that is largest, where it is, its largest cause, what mends it, and where none is guaranteed. */
typedef struct largest {
    dp_budget budget;
    double z, hopeless;
    dp_cause cause;
    remedy_result remedy;
} largest;

static largest largest_of(const dp_setup *setup, const budget_case *c) {
    largest l = {.budget = {.separation = -1}, .z = NAN, .hopeless = NAN};
    double z[DEPTHS];
    depths_of(c, z);
    for (int k = 0; k < DEPTHS; k++) {
        dp_budget b;
        assert_int_equal(dp_budget_at(setup, z[k], &c->terms, &b), DP_OK);
        if (isinf(b.separation) && isnan(l.hopeless))
            l.hopeless = z[k];
        if (isfinite(b.separation) && b.separation > l.budget.separation) {
            l.budget = b;
            l.z = z[k];
        }
    }
    for (int i = 1; i < DP_CAUSE_COUNT && !isnan(l.z); i++)
        l.cause = l.budget.cause[i] > l.budget.cause[l.cause] ? (dp_cause)i : l.cause;
    if (!isnan(l.z))
        l.remedy = remedy_find(setup, &c->terms, l.z, l.cause);
    return l;
}

static void want_budget_worst(values *v, const dp_setup *setup, const budget_case *c) {
    const largest l = largest_of(setup, c);
    if (isnan(l.z)) {
        want_text(v, "worst", NULL);
        return;
    }
    values_under(v, "%sworst.", v->prefix);
    want(v, "z=%f separation=%f cause=%s", l.z, l.budget.separation, dp_cause_name(l.cause));
    want(v, "share=%f remedy=%s", l.budget.cause[l.cause] / l.budget.separation, l.remedy.text);
    want(v, "remedy_separation=%f", l.remedy.text != NULL ? l.remedy.separation : NAN);
}

static void want_budget(values *v, const budget_case *c, const dp_setup *setup, size_t i) {
    double z[DEPTHS];
    char under[PATH_SIZE];
    depths_of(c, z);
    snprintf(under, sizeof under, "setups[%zu].", i);
    values_under(v, "%s", under);
    dp_setup in_binary32 = *setup; /* as it is said of logarithmic mappings, too */
    in_binary32.spec.model = DP_MODEL_FLOAT;
    want_setup(v, &in_binary32);
    for (int k = 0; k < DEPTHS; k++) {
        dp_budget b;
        assert_int_equal(dp_budget_at(setup, z[k], &c->terms, &b), DP_OK);
        values_under(v, "%srows[%d].", under, k);
        want_budget_row(v, c, &b, z[k], setup->spec.zfar);
    }
    values_under(v, "%s", under);
    want_budget_worst(v, setup, c);
    values_under(v, "%s", under);
    strcat(under, "auto.");
    if (setup->curve == DP_CURVE_LOG)
        want_text(v, "auto", NULL);
    else
        want_choice(v, under, setup, z, DEPTHS, tolerance_of(c));
}

/* The causes that the text leaves out are those of terms that were not given. */
static void text_columns(const budget_case *c, char out[1024]) {
    strcpy(out, "z:9, separation:6");
    for (int i = 0; i < DP_CAUSE_COUNT; i++) {
        const char *name = dp_cause_name((dp_cause)i);
        if (!has_cause(c, i) || (i == DP_CAUSE_PROJECTION && c->shader && !c->matrix) ||
            (i == DP_CAUSE_NDC && c->shader && !c->divided) || (i == DP_CAUSE_COMPOSITION && c->terms.world == 0) ||
            (i == DP_CAUSE_LINEARIZATION && !c->terms.linearize) ||
            (i == DP_CAUSE_INTERPOLATION && c->terms.interpolation == 0))
            continue;
        snprintf(out + strlen(out), 1024 - strlen(out), ", part.%s:2, share.%s:0", name, name);
    }
}

static void csv_columns(const budget_case *c, char out[1024]) {
    strcpy(out, SETUP_CSV "arith = ^arith, z [scene], separation [scene], window");
    for (int i = 0; i < DP_CAUSE_COUNT; i++) {
        const char *name = dp_cause_name((dp_cause)i);
        if (has_cause(c, i))
            snprintf(out + strlen(out), 1024 - strlen(out), ", %s [scene] = causes.%s", name, name);
    }
    strcat(out, ", certain, composition = /terms.composition, ?log2 = /terms.log2");
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
    const char *unit = word_behind(c->line, "--unit");
    return unit != NULL ? words_in(words_in(at, " "), unit) : at;
}

/* "  at z = 990 format takes 52 %: reversed depth would need 0.1 in place of 0.3": 6 and 4 digits. */
static const char *advice_in(const char *at, const dp_setup *setup, const budget_case *c) {
    const largest l = largest_of(setup, c);
    const dp_budget worst = l.budget;
    if (!isnan(l.hopeless)) {
        at = length_in(words_in(at, "  at z = "), c, l.hopeless, 6, false);
        at = words_in(at, " no separation is guaranteed: everything farther may share its code\n");
    }
    if (isnan(l.z))
        return at;
    const double step = (double)nextafterf((float)l.z, HUGE_VALF) - (double)(float)l.z;
    at = words_in(length_in(words_in(at, "  at z = "), c, l.z, 6, false), " ");
    at = words_in(words_in(at, dp_cause_name(l.cause)), " takes ");
    const double share = strtod(at, (char **)&at);
    assert_true(fabs(share - 100 * worst.cause[l.cause] / worst.separation) <= 0.5 + 1e-9);
    at = words_in(at, " %: ");
    if (l.remedy.text != NULL) {
        at = length_in(words_in(words_in(at, l.remedy.text), " would need "), c, l.remedy.separation, 4, true);
        at = length_in(words_in(at, " in place of "), c, worst.separation, 4, true);
    } else if (worst.separation < 2 * step) {
        at = length_in(words_in(at, "nothing to gain: binary32 depths are themselves "), c, step, 4, false);
        at = words_in(at, " apart there");
    } else {
        at = words_in(at, "no other format or mapping helps");
    }
    return words_in(at, "\n");
}

/* "  float arithmetic (mesa) makes the guarantee 2.71 times the lattice at z = 316.228: model float is needed": 3
 * digits and 6. */
static void choice_in(const char *at, const dp_setup *setup, const budget_case *c) {
    dp_choice choice;
    char arith[64] = "";
    double depths[DEPTHS];
    depths_of(c, depths);
    assert_int_equal(dp_model_choose(setup, depths, DEPTHS, tolerance_of(c), &choice), DP_OK);
    const double share = choice.share[DP_MODEL_EXACT], z = choice.share_z[DP_MODEL_EXACT];
    const bool enough = choice.model == DP_MODEL_EXACT;
    if (setup->spec.arith != 0)
        snprintf(arith, sizeof arith, " (%s)", dp_arith_get(setup->spec.arith)->name);
    const bool added = c->terms.world != 0 || c->terms.linearize || c->terms.interpolation != 0;
    at = words_in(words_in(at, added ? "  without the added terms float arithmetic" : "  float arithmetic"), arith);
    if (share == 0)
        at = words_in(at, " adds nothing");
    else if (isinf(share))
        at = words_in(at, " leaves nothing resolved");
    else {
        at = words_in(at, enough ? " makes the guarantee at most " : " makes the guarantee ");
        at = number_in(at, share >= 0.01 ? share + 1 : 100 * share, 3, true);
        at = words_in(at, share >= 0.01 ? " times the lattice" : " % more than the lattice");
    }
    if (share != 0)
        at = length_in(words_in(at, " at z = "), c, z, 6, false);
    words_in(at, enough                            ? ": the lattice suffices\n"
                 : choice.model == DP_MODEL_STAGED ? ": --model staged captures this\n"
                                                   : ": --model float is needed\n");
}

/* "  model staged leaves the shader out: with it the guarantee is 3.06 times as large at z = 1000" */
static void staged_in(const char *at, const dp_setup *setup, const budget_case *c) {
    double worst = 0, z = 0, depths[DEPTHS];
    const dp_setup staged = setup_in(setup, DP_MODEL_STAGED);
    depths_of(c, depths);
    for (int k = 0; k < DEPTHS; k++) {
        dp_budget b;
        assert_int_equal(dp_budget_at(setup, depths[k], &c->terms, &b), DP_OK);
        if (b.separation / dp_separation(&staged, depths[k]) > worst) {
            worst = b.separation / dp_separation(&staged, depths[k]);
            z = depths[k];
        }
    }
    at = words_in(at, "  model staged leaves the shader out: with it the guarantee is ");
    at = words_in(number_in(at, worst, 3, true), " times as large at z = ");
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

TEST(each_number) {
    static const char *const compositions[] = {
        [DP_COMPOSITION_ONCE] = "once", [DP_COMPOSITION_PRODUCTS] = "products", [DP_COMPOSITION_RELATIVE] = "relative"};
    static const char *const log2s[] = {"vulkan", "d3d", "rounded"};
    for (size_t i = 0; i < sizeof budgets / sizeof budgets[0]; i++) {
        const budget_case *c = &budgets[i];
        const dp_budget_terms *t = &c->terms;
        values v = values_of(c->line);
        dp_setup setups[SETUPS_MAX];
        char columns[1024];
        values_under(&v, "terms.");
        want(&v, "interpolation=%f from_origin=%f linearize=%d", t->interpolation, t->world, t->linearize);
        want(&v, "composition=%s", t->world > 0 ? compositions[t->composition] : NULL); /* not of eye depths */
        if (c->shader)
            want(&v, "log2=%s", log2s[t->log2]);
        const size_t n = setups_of(c->line, c->shader ? DP_MODEL_EXACT : DP_MODEL_FLOAT, setups);
        for (size_t k = 0; k < n; k++)
            want_budget(&v, c, &setups[k], k);
        csv_columns(c, columns);
        check_forms(&v, 0, c->line, "setups[].rows[]", columns);
        char *text = output_of(0, c->line, "--full");
        text_columns(c, columns);
        check_table(&v, text, "setups[].rows[]", columns);
        check_sentences(text, c, setups, n);
        free(text);
        values_free(&v);
    }
}

/* What NDC from 0 to 1 would need is what the mapping of the same direction does. */
TEST(ndc_from_0) {
    json_t *with = json_printed(0, "budget -F fp32 --at 1000 -m gl-reversed");
    json_t *without = json_printed(0, "budget -F fp32 --at 1000 -m reversed");
    assert_string_equal(text_at(with, "setups[0].worst.remedy"), "NDC from 0 to 1");
    assert_relative(number_at(with, "setups[0].worst.remedy_separation"),
                    number_at(without, "setups[0].worst.separation"), 1e-12);
    json_decref(with);
    json_decref(without);
}

LIST_TEST(check_apart)
