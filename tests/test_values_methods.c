/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Every value that bench and stability print, and their figures. Times are never the same twice, so the measuring is
 * replaced here: this program's bench_run() and stability_run() give numbers that are all different, and what the
 * commands make of them is looked for. test_bench.c and test_stability.c test the ones that are replaced.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/methods.h"
#include "method/choose.h"
#include "printed.h"

int cmd_bench(const options *o);
int cmd_stability(const options *o);
int cmd_plot(const options *o);

/* ---- In place of the measuring ----------------------------------------------------------------------------------- */

static bench_result timed[BENCH_METHODS_MAX];
static stability_result walked[STABILITY_MAX];
static stability_verdict verdicts[STABILITY_MAX]; /* for the results in turn */
static size_t walked_count;
static dp_setup asked; /* of the last bench */
static size_t asked_which;

/* A new number each time, over some decades. */
static double next_number(void) {
    static int count;
    count = (count + 1) % 997;
    return pow(10, -4 + 7 * fmod(count * 0.6180339887498949, 1));
}

double measured_error(const method_family_row *family, const measured *m) {
    return family->steps ? m->worst.ulp : m->worst.relative;
}

double method_claimed(const method_row *row, size_t which, const dp_setup *setup) {
    (void)row, (void)which, (void)setup;
    return NAN;
}

bool method_measure(const method_family_row *family, const method_row *row, const dp_setup *setup,
                    const method_inputs *in, const method_outputs *out, measured *m) {
    (void)family, (void)row, (void)setup, (void)in, (void)out, (void)m;
    return false;
}

size_t bench_run(const method_family_row *family, size_t which, const dp_setup *setup, int repetitions,
                 bench_result results[BENCH_METHODS_MAX]) {
    size_t count = 0;
    const double limit = next_number();
    assert_int_equal(repetitions, METHODS_REPETITIONS);
    asked = *setup;
    asked_which = which;
    for (size_t i = 0; i < *family->method_count; i++) {
        if (!method_speaks(&family->methods[i], which))
            continue;
        results[count] = (bench_result){.row = &family->methods[i],
                                        .inputs = 100 + 7 * count,
                                        .ns = next_number(),
                                        .spread = next_number(),
                                        .limit = limit,
                                        .setup = count % 3 == 1 ? 0 : next_number(),
                                        .measured = {.worst = {next_number(), next_number(), next_number()}},
                                        .at_absolute = next_number(),
                                        .at_relative = next_number(),
                                        .at_ulp = next_number(),
                                        .claim = count % 4 == 2 ? NAN : next_number(),
                                        .front = count % 2 == 0};
        timed[count] = results[count];
        count++;
    }
    return count;
}

bool stability_must_break(const method_claim *c) {
    return c->ratio_hi < METHOD_RATIO_HI;
}

const char *stability_verdict_name(stability_verdict verdict) {
    static const char *const names[STABILITY_VERDICTS] = {"fine", "not so", "too little", "none"};
    return names[verdict];
}

size_t stability_run(const method_family_row *family, stability_result results[STABILITY_MAX]) {
    size_t count = 0;
    for (size_t i = 0; i < *family->method_count; i++)
        for (size_t k = 0; k < family->case_count; k++) {
            if (!method_speaks(&family->methods[i], k))
                continue;
            stability_result *r = &results[count];
            *r = (stability_result){.row = &family->methods[i],
                                    .which = k,
                                    .steps = 4,
                                    .inside = next_number(),
                                    .claim = count % 5 == 3 ? NAN : next_number(),
                                    .inside_near = next_number(),
                                    .inside_far = next_number(),
                                    .inside_at = next_number(),
                                    .breaks = count % 3 == 0 ? INFINITY : next_number(),
                                    .infinite = count % 3 == 1 ? NAN : next_number(),
                                    .ortho = count % 3 == 2 ? NAN : next_number(),
                                    .verdict = verdicts[count]};
            for (int s = 0; s < r->steps; s++) {
                r->ratio[s] = 10 * pow(1000, s);
                r->error[s] = s == 2 && count == 1 ? INFINITY : next_number();
            }
            walked[count++] = *r;
        }
    return walked_count = count;
}

/* A command of this program, its output from the file that it writes. */
static char *output_of(int (*command)(const options *), int status, const char *line) {
    static char words[256], file[512];
    char *argv[24];
    int argc = 0;
    options o;
    snprintf(words, sizeof words, "depthprec %s", line);
    snprintf(file, sizeof file, "%s", scratch_file("output"));
    for (char *word = strtok(words, " "); word != NULL; word = strtok(NULL, " "))
        argv[argc++] = word;
    argv[argc++] = "-o";
    argv[argc++] = file;
    argv[argc] = NULL;
    remove(file);
    assert_int_equal(options_parse(&o, argc, argv), -1);
    assert_int_equal(command(&o), status);
    options_release(&o);
    return text_of_file(file);
}

/* ---- bench ------------------------------------------------------------------------------------------------------- */

static void want_method(values *v, const method_family_row *family, const bench_result *r, const method_row *choice) {
    want_text(v, "name", r->row->name);
    want_number(v, "ns", r->ns);
    want_number(v, "limits", r->ns / r->limit);
    want_number(v, "spread", r->spread);
    want_number(v, "setup_ns", r->setup);
    want_count(v, "inputs", r->inputs);
    want_number(v, "error", family->steps ? r->measured.worst.ulp : r->measured.worst.relative);
    want_number(v, "relative", r->measured.worst.relative);
    want_number(v, "relative_at", r->at_relative);
    want_number(v, "absolute", r->measured.worst.absolute);
    want_number(v, "absolute_at", r->at_absolute);
    want_number(v, "ulp", r->measured.worst.ulp);
    want_number(v, "ulp_at", r->at_ulp);
    want_number(v, "claim", r->claim);
    want_bool(v, "pareto", r->front);
    want_derived(v, "percent", 100 * r->spread);
    want_derived(v, "preparing", r->setup > 0 ? r->setup : NAN);
    want_derived(v, "at", family->steps ? r->at_ulp : r->at_relative);
    want_derived(v, "chosen", r->row == choice);
}

/* After a run, from what it was given. */
static const method_row *want_bench(values *v, const method_family_row *family, double tolerance, line_places *lines) {
    char machine[192];
    const double ratio = asked.spec.zfar / asked.spec.znear;
    const method_wish wish = {.tolerance = tolerance, .ratio_lo = fmin(ratio, METHOD_RATIO_HI), .ratio_hi = ratio};
    const method_row *choice = isnan(tolerance) ? NULL : method_choose(family, asked_which, &wish);
    methods_machine(machine, sizeof machine);
    assert_non_null(strstr(machine, ", 2020-01-02"));
    want_text(v, "family", family->name);
    want_text(v, "measure", family->measure);
    want_text(v, "machine", machine);
    want_setup(v, &asked);
    want_number(v, "tolerance", tolerance);
    want_text(v, "choice", choice != NULL ? choice->name : NULL);
    want_number(v, "limit_ns", timed[0].limit);
    for (size_t i = 0, n = 0; i < *family->method_count; i++) {
        if (!method_speaks(&family->methods[i], asked_which))
            continue;
        values_under(v, "methods[%zu].", n);
        want_method(v, family, &timed[n], choice);
        place_add(lines, "", "methods[%zu].", n++);
    }
    return choice;
}

static void check_bench_text(const values *v, const method_family_row *family, const method_row *choice,
                             const char *text, size_t count) {
    static const char *const fields[] = {"ns", "limits", "percent", "preparing", "relative", "absolute", "ulp", "at",
                                         "claim"};
    static const char *const planes[] = {"near", "far", NULL}, *const limit[] = {"limit_ns", NULL};
    char label[64], at[9][PATH_SIZE];
    check_text_numbers(v, text, family->cases[asked_which].name, 15, planes);
    check_text_numbers(v, text, "a limit is", 3, limit);
    for (size_t i = 0; i < count; i++) {
        const char *paths[10] = {NULL};
        snprintf(label, sizeof label, "%s%s%-20s ", timed[i].front ? "*" : "",
                 timed[i].row == choice ? ">" : timed[i].front ? " " : "", timed[i].row->name);
        for (size_t k = 0; k < 9; k++) {
            snprintf(at[k], PATH_SIZE, "methods[%zu].%s", i, fields[k]);
            paths[k] = at[k];
        }
        check_text_numbers(v, text, label, 2, paths);
    }
}

static void check_bench(const char *name, const char *line, size_t which, double tolerance) {
    static const csv_column columns[] = {{"family", "/family"},
                                     {"method", "name"},
                                     {"ns", "ns"},
                                     {"spread", "spread"},
                                     {"setup [ns]", "setup_ns"},
                                     {"inputs", "inputs"},
                                     {"error", "error"},
                                     {"relative", "relative"},
                                     {"relative_at", "relative_at"},
                                     {"absolute", "absolute"},
                                     {"absolute_at", "absolute_at"},
                                     {"ulp", "ulp"},
                                     {"ulp_at", "ulp_at"},
                                     {"claim", "claim"},
                                     {"pareto", "pareto"},
                                     {"chosen", "chosen"},
                                     {"limit [ns]", "/limit_ns"}};
    static const char *const forms[] = {"--json", "--csv", ""};
    for (int form = 0; form < 3; form++) {
        char arguments[256];
        const method_family_row *family = method_family_find(name);
        line_places lines = {0};
        values v = values_of("bench");
        snprintf(arguments, sizeof arguments, "bench %s %s %s", name, line, forms[form]);
        char *text = output_of(cmd_bench, 0, arguments);
        assert_int_equal(asked_which, which);
        const method_row *choice = want_bench(&v, family, tolerance, &lines);
        if (form == 0)
            check_json_text(&v, text);
        else if (form == 1)
            check_csv_text(&v, text, columns, sizeof columns / sizeof columns[0], &lines);
        else
            check_bench_text(&v, family, choice, text, lines.count);
        free(text);
        values_free(&v);
        places_free(&lines);
    }
}

static void test_bench(void **state) {
    (void)state;
    check_bench("interval", "-n 0.3 -f 900 -F fp32 -m reversed --tolerance 1e-6", 1, 1e-6);
    check_bench("encode", "-n 0.25 -f 1500", 0, NAN);
    check_bench("linearize", "-n 0.2 -f 700 --tolerance 1e-30", 0, 1e-30);
}

/* ---- stability --------------------------------------------------------------------------------------------------- */

static void want_walk(values *v, const method_family_row *family, size_t i, line_places *lines) {
    const stability_result *r = &walked[i];
    const method_claim *c = &r->row->claims[r->which];
    values_under(v, "methods[%zu].", i);
    want_text(v, "name", r->row->name);
    want_text(v, "case", family->cases[r->which].name);
    want_number(v, "claim", r->claim);
    want_number(v, "claim_to", isnan(c->worst) ? NAN : c->ratio_hi);
    want_number(v, "worst", r->inside);
    want_number(v, "worst_near", r->inside_near);
    want_number(v, "worst_far", r->inside_far);
    want_number(v, "worst_at", r->inside_at);
    want_number(v, "breaks", r->breaks);
    want_number(v, "infinite", r->infinite);
    want_number(v, "ortho", r->ortho);
    want_text(v, "verdict", stability_verdict_name(r->verdict));
    want_derived(v, "breaks_at", isinf(r->breaks) ? NAN : r->breaks);
    for (int k = 0; k < r->steps; k++) {
        char inner[32];
        values_under(v, "methods[%zu].walk[%d].", i, k);
        want_number(v, "ratio", r->ratio[k]);
        want_number(v, "error", r->error[k]);
        want_number(v, "claim", r->ratio[k] <= c->ratio_hi * (1 + 1e-9) ? method_claim_at(c, r->ratio[k]) : NAN);
        snprintf(inner, sizeof inner, "walk[%d].", k);
        place_add(lines, inner, "methods[%zu].", i);
    }
}

static void check_stability(const char *name, int status) {
    static const csv_column columns[] = {{"family", "/family"},     {"method", "^name"},     {"case", "^case"},
                                     {"claim", "claim"},        {"claim_to", "^claim_to"}, {"verdict", "^verdict"},
                                     {"ratio", "ratio"},        {"error", "error"}};
    static const char *const forms[] = {"--json", "--csv", ""};
    static const char *const fields[] = {"claim", "claim_to", "worst", "breaks_at", "infinite", "ortho"};
    for (int form = 0; form < 3; form++) {
        char arguments[128], label[96], at[6][PATH_SIZE];
        const char *paths[7] = {at[0], at[1], at[2], at[3], at[4], at[5], NULL};
        const method_family_row *family = method_family_find(name);
        line_places lines = {0};
        values v = values_of("stability");
        snprintf(arguments, sizeof arguments, "stability %s %s", name, forms[form]);
        char *text = output_of(cmd_stability, status, arguments);
        want_text(&v, "family", family->name);
        want_text(&v, "measure", family->measure);
        for (size_t i = 0; i < walked_count; i++)
            want_walk(&v, family, i, &lines);
        if (form == 0)
            check_json_text(&v, text);
        else if (form == 1)
            check_csv_text(&v, text, columns, sizeof columns / sizeof columns[0], &lines);
        for (size_t i = 0; i < walked_count && form == 2; i++) {
            const stability_result *r = &walked[i];
            snprintf(label, sizeof label, "%-20s %-14s", r->row->name, family->cases[r->which].name);
            for (size_t k = 0; k < 6; k++)
                snprintf(at[k], PATH_SIZE, "methods[%zu].%s", i, fields[k]);
            check_text_numbers(&v, text, label, 3, paths);
            const char *line = strstr(text, label);
            snprintf(label, sizeof label, "  %s", stability_verdict_name(r->verdict));
            assert_true(strncmp(line + strcspn(line, "\n") - strlen(label), label, strlen(label)) == 0);
        }
        free(text);
        values_free(&v);
        places_free(&lines);
    }
}

/* A claim that does not hold, or that is too modest, is exit status 1; where nothing is claimed nothing is wrong. */
static void test_stability(void **state) {
    static const struct {
        stability_verdict odd;
        int status;
    } rows[] = {{STABILITY_HOLDS, 0}, {STABILITY_UNCLAIMED, 0}, {STABILITY_MODEST, 1}, {STABILITY_BROKEN, 1}};
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        memset(verdicts, 0, sizeof verdicts);
        verdicts[2] = rows[i].odd;
        check_stability(i % 2 == 0 ? "linearize" : "interval", rows[i].status);
    }
}

/* ---- Their figures ----------------------------------------------------------------------------------------------- */

static void want_axis(values *v, const char *axis, const char *key, const char *label, const char *unit,
                      const char *scale) {
    values_under(v, "%s.", axis);
    want_text(v, "key", key);
    want_text(v, "label", label);
    want_text(v, "unit", unit);
    want_text(v, "scale", scale);
}

/* The digest and the subtitle are what they are; the first is tested with the drawing, the second is read here. */
static void want_head(values *v, const json_t *root, const char *figure, const char *title) {
    values_under(v, "%s", "");
    want_text(v, "figure", figure);
    want_text(v, "title", title);
    want_text(v, "data", json_string_value(json_object_get(root, "data")));
    want_text(v, "subtitle", json_string_value(json_object_get(root, "subtitle")));
    values_under(v, "panels[0].");
    want_text(v, "title", "");
}

static void want_point(values *v, size_t series, size_t point, const char *x, double at, const char *y, double is) {
    values_under(v, "panels[0].series[%zu].points[%zu].", series, point);
    want_number(v, x, at);
    want_number(v, y, is);
}

static size_t want_times(values *v, size_t series, const char *name, int front, const size_t *order, size_t count) {
    size_t n = 0;
    for (size_t i = 0; i < count; i++) {
        const bench_result *r = &timed[order != NULL ? order[i] : i];
        if (front >= 0 && r->front != (front == 1))
            continue;
        want_point(v, series, n++, "time", r->ns, "error", fmax(r->measured.worst.relative, 1e-17));
    }
    values_under(v, "panels[0].series[%zu].", series);
    want_text(v, "name", name);
    return series + 1;
}

static int by_time(const void *a, const void *b) {
    const double x = timed[*(const size_t *)a].ns, y = timed[*(const size_t *)b].ns;
    return (x > y) - (x < y);
}

static void test_pareto(void **state) {
    (void)state;
    const method_family_row *family = method_family_find("worst"); /* relative errors, no pipeline */
    values v = values_of("plot");
    char *text = output_of(cmd_plot, 0, "plot pareto worst --json -n 0.2 -f 800 --title a\\\\b\"c\"d");
    json_t *root = json_of(text);
    size_t order[BENCH_METHODS_MAX], count = 0, fronts = 0;
    for (size_t i = 0; i < *family->method_count; i++)
        count += method_speaks(&family->methods[i], asked_which);
    for (size_t i = 0; i < count; i++)
        if (timed[i].front)
            order[fronts++] = i;
    qsort(order, fronts, sizeof order[0], by_time);
    want_head(&v, root, "pareto", "a\\\\b\"c\"d");
    assert_non_null(strstr(json_string_value(json_object_get(root, "subtitle")), "near 0.2, far 800"));
    want_axis(&v, "x", "time", "time an element", "ns", "log");
    want_axis(&v, "y", "error", "worst error", family->measure, "log");
    size_t series = want_times(&v, 0, "front", -1, order, fronts);
    series = want_times(&v, series, "behind it", 0, NULL, count);
    series = want_times(&v, series, "on the Pareto front", 1, NULL, count);
    want_times(&v, series, "methods", -1, NULL, count);
    check_json_text(&v, text);
    json_decref(root);
    free(text);
    values_free(&v);
}

/* Decimal digits that an error leaves. */
static double digits(double error) {
    return isinf(error) ? 0 : fmin(fmax(-log10(error), 0), 16);
}

/* Where a column of the map is drawn: at its far/near, but for the rounding of the logarithms. */
static double column_of(const json_t *root, size_t point, size_t k) {
    double ratio;
    const json_t *map = json_array_get(
        json_object_get(json_array_get(json_object_get(root, "panels"), 0), "series"), 2);
    assert_int_equal(json_unpack(json_array_get(json_object_get(map, "points"), point), "{s:F}", "ratio", &ratio), 0);
    assert_relative(ratio, 10 * pow(1000, (double)k), 1e-12);
    return ratio;
}

/* The rows of the figure from the bottom: the cases from the last, the methods of each from the last. */
static void test_walk(void **state) {
    (void)state;
    const method_family_row *family = method_family_find("worst");
    values v = values_of("plot");
    memset(verdicts, 0, sizeof verdicts);
    char *text = output_of(cmd_plot, 0, "plot stability worst --json");
    json_t *root = json_of(text);
    const stability_result *rows[STABILITY_MAX];
    size_t count = 0, claims = 0, breaks = 0;
    for (size_t which = 0; which < family->case_count; which++)
        for (size_t i = 0; i < walked_count; i++)
            if (walked[i].which == which)
                rows[count++] = &walked[i];
    want_head(&v, root, "stability", figure_find("stability")->title);
    want_axis(&v, "x", "ratio", "far/near", "", "log");
    want_axis(&v, "y", "method", "method", "", "linear");
    want_axis(&v, "value", "digits", "digits left", "", "linear");
    for (size_t i = 0; i < count; i++) {
        const method_claim *c = &rows[i]->row->claims[rows[i]->which];
        const double height = (double)(count - 1 - i) + 0.5;
        if (!isnan(c->worst))
            want_point(&v, 0, claims++, "ratio", c->ratio_hi, "method", height);
        if (isfinite(rows[i]->breaks))
            want_point(&v, 1, breaks++, "ratio", rows[i]->breaks, "method", height);
        for (size_t k = 0; k < 4; k++) {
            const size_t point = (count - 1 - i) * 4 + k;
            want_point(&v, 2, point, "ratio", column_of(root, point, k), "method", height);
            want_number(&v, "digits", digits(rows[i]->error[k]));
        }
    }
    values_under(&v, "panels[0].series[%d].", 0);
    want_text(&v, "name", "claimed up to here");
    values_under(&v, "panels[0].series[%d].", 1);
    want_text(&v, "name", "the claim breaks here");
    values_under(&v, "panels[0].series[%d].", 2);
    want_text(&v, "name", "map");
    check_json_text(&v, text);
    json_decref(root);
    free(text);
    values_free(&v);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bench), cmocka_unit_test(test_stability), cmocka_unit_test(test_pareto),
        cmocka_unit_test(test_walk),  cmocka_unit_test(check_apart),
    };
    setenv("SOURCE_DATE_EPOCH", "1577923200", 1);
    return run_tap(tests);
}
