/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Every value that methods prints. Times are never the same twice, so the measuring is
 * replaced here: this program's bench_run() and stability_run() give numbers that are all different, and what the
 * command makes of them is looked for. test_bench.c and test_stability.c test the ones that are replaced.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "measured.h"
#include "named.h"

static void want_walk(values *v, const method_family_row *family, const stability_result *r, size_t n) {
    const method_claim *c = &r->row->claims[r->which];
    values_under(v, "methods[%zu].stability.", n);
    want_text(v, "case", family->cases[r->which].name);
    want_number(v, "claim", r->claim);
    want_number(v, "claim_to", isnan(c->worst) ? NAN : c->ratio_hi);
    want_number(v, "worst", r->inside);
    want_number(v, "worst_near", r->inside_near);
    want_number(v, "worst_far", r->inside_far);
    want_number(v, "worst_at", r->inside_at);
    want_number(v, "breaks", isinf(r->breaks) ? NAN : r->breaks);
    want_number(v, "infinite", r->infinite);
    want_number(v, "ortho", r->ortho);
    want_text(v, "verdict", stability_verdict_name(r->verdict));
    for (int k = 0; k < r->steps; k++) {
        values_under(v, "methods[%zu].stability.walk[%d].", n, k);
        want_number(v, "ratio", r->ratio[k]);
        want_number(v, "error", r->error[k]);
        want_number(v, "claim", r->ratio[k] <= c->ratio_hi * (1 + 1e-9) ? method_claim_at(c, r->ratio[k]) : NAN);
    }
}

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
    want_number(v, "bound", r->bound);
    want_bool(v, "pareto", r->front);
    want_derived(v, "percent", 100 * r->spread);
    want_derived(v, "preparing", r->setup > 0 ? r->setup : NAN);
    want_derived(v, "at", family->steps ? r->at_ulp : r->at_relative);
    want_derived(v, "chosen", r->row == choice);
}

/* After a run, from what it was given. */
static const method_row *want_methods(values *v, const method_family_row *family, double tolerance,
                                      line_places *lines) {
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
        want_walk(v, family, &walked[n], n);
        place_add(lines, "", "methods[%zu].", n++);
    }
    return choice;
}

/* Where the line of a method begins: the fastest stands first. */
static const char *place_of(const char *text, size_t i, const method_row *choice) {
    char label[64];
    snprintf(label, sizeof label, "\n%c%c%-19s ", timed[i].front ? '*' : ' ', timed[i].row == choice ? '>' : ' ',
             timed[i].row->name);
    const char *at = strstr(text, label);
    assert_non_null(at);
    return at;
}

/* Behind the numbers of its line. */
static void check_verdict(const char *line, size_t i) {
    char verdict[64];
    const size_t length =
        (size_t)snprintf(verdict, sizeof verdict, "  %s\n", stability_verdict_name(walked[i].verdict));
    assert_true(strncmp(strchr(line + 1, '\n') + 1 - length, verdict, length) == 0);
}

static void check_methods_text(const values *v, const method_family_row *family, const method_row *choice,
                               const char *text, size_t count) {
    static const char *const fields[] = {
        "ns", "limits", "percent", "preparing",          "relative",         "absolute",           "ulp",
        "at", "bound",  "claim",   "stability.claim_to", "stability.breaks", "stability.infinite", "stability.ortho"};
    enum { FIELDS = sizeof fields / sizeof fields[0] };
    static const char *const planes[] = {"near", "far", NULL}, *const limit[] = {"limit_ns", NULL};
    char label[64], at[FIELDS][PATH_SIZE];
    check_text_numbers(v, text, family->cases[asked_which].name, 15, planes);
    check_text_numbers(v, text, "ns: per element, the median; x memory: multiple of what moving the same bytes takes,",
                       3, limit);
    for (size_t i = 0; i < count; i++) {
        const char *paths[FIELDS + 1] = {NULL};
        snprintf(label, sizeof label, "%s%s%-19s ", timed[i].front ? "*" : "",
                 timed[i].row == choice ? ">"
                 : timed[i].front       ? " "
                                        : "",
                 timed[i].row->name);
        for (size_t k = 0; k < FIELDS; k++) {
            snprintf(at[k], PATH_SIZE, "methods[%zu].%s", i, fields[k]);
            paths[k] = at[k];
        }
        check_text_numbers(v, text, label, 2, paths);
        check_verdict(place_of(text, i, choice), i);
        for (size_t k = 0; k < i; k++)
            assert_true((place_of(text, i, choice) < place_of(text, k, choice)) == (timed[i].ns < timed[k].ns));
    }
}

static void check_methods(const char *name, const char *line, size_t which, double tolerance, int status) {
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
                                         {"limit [ns]", "/limit_ns"},
                                         {"bound", "bound"},
                                         {"case", "stability.case"},
                                         {"claim_to", "stability.claim_to"},
                                         {"breaks", "stability.breaks"},
                                         {"infinite", "stability.infinite"},
                                         {"ortho", "stability.ortho"},
                                         {"verdict", "stability.verdict"}};
    static const char *const forms[] = {"--json", "--csv", "--full"};
    for (int form = 0; form < 3; form++) {
        char arguments[256];
        const method_family_row *family = method_family_find(name);
        line_places lines = {0};
        values v = values_of("methods");
        snprintf(arguments, sizeof arguments, "methods %s %s %s", name, line, forms[form]);
        char *text = command_output(cmd_methods, status, arguments);
        assert_int_equal(asked_which, which);
        const method_row *choice = want_methods(&v, family, tolerance, &lines);
        if (form == 0)
            check_json_text(&v, text);
        else if (form == 1)
            check_csv_text(&v, text, columns, sizeof columns / sizeof columns[0], &lines);
        else
            check_methods_text(&v, family, choice, text, lines.count);
        free(text);
        values_free(&v);
        places_free(&lines);
    }
}

static void test_methods(void **state) {
    (void)state;
    check_methods("interval", "-n 0.3 -f 900 -F fp32 -m reversed --tolerance 1e-6", 1, 1e-6, 0);
    check_methods("encode", "-n 0.25 -f 1500", 0, NAN, 0);
    check_methods("linearize", "-n 0.2 -f 700 --tolerance 1e-30", 0, 1e-30, 0);
}

/* A claim that does not hold, or that is too modest, is exit status 1; where nothing is claimed nothing is wrong. */
static void test_verdicts(void **state) {
    static const struct {
        stability_verdict odd;
        int status;
    } rows[] = {{STABILITY_HOLDS, 0}, {STABILITY_UNCLAIMED, 0}, {STABILITY_MODEST, 1}, {STABILITY_BROKEN, 1}};
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        verdicts[2] = rows[i].odd;
        check_methods(i % 2 == 0 ? "linearize" : "interval", "-n 0.2 -f 700", 0, NAN, rows[i].status);
    }
    memset(verdicts, 0, sizeof verdicts);
}

/* Text leaves out what another beats everywhere, and says how many; all of them are there with --full. */
static void test_left_out(void **state) {
    static const char *const behind[] = {"table-nearest", "table-linear", "spline", "chebyshev"};
    (void)state;
    char *brief = command_output(cmd_methods, 0, "methods linearize");
    char *full = command_output(cmd_methods, 0, "methods linearize --full");
    for (size_t i = 0; i < sizeof behind / sizeof behind[0]; i++)
        assert_true(strstr(brief, behind[i]) == NULL && strstr(full, behind[i]) != NULL);
    assert_non_null(strstr(brief, "--full: 4 more"));
    assert_null(strstr(full, "more, to each"));
    free(brief);
    free(full);
}

/* What there is, when no family is named. */
static void test_families(void **state) {
    static const csv_column columns[] = {
        {"name", "name"}, {"note", "note"}, {"measure", "measure"}, {"methods", "methods"}};
    (void)state;
    for (int form = 0; form < 2; form++) {
        line_places lines = {0};
        values v = values_of("methods");
        char *text = command_output(cmd_methods, 0, form == 0 ? "methods --json" : "methods --csv");
        for (size_t i = 0; method_family_get(i) != NULL; i++) {
            const method_family_row *f = method_family_get(i);
            size_t count = 0;
            for (size_t k = 0; method_get(k) != NULL; k++)
                count += method_get(k)->family == (method_family)i;
            values_under(&v, "families[%zu].", i);
            want_text(&v, "name", f->name);
            want_text(&v, "note", f->summary);
            want_text(&v, "measure", f->measure);
            want_count(&v, "methods", count);
            place_add(&lines, "", "families[%zu].", i);
        }
        if (form == 0)
            check_json_text(&v, text);
        else
            check_csv_text(&v, text, columns, sizeof columns / sizeof columns[0], &lines);
        free(text);
        values_free(&v);
        places_free(&lines);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_methods),  cmocka_unit_test(test_verdicts), cmocka_unit_test(test_left_out),
        cmocka_unit_test(test_families), cmocka_unit_test(check_apart),
    };
    setenv("SOURCE_DATE_EPOCH", "1577923200", 1);
    return run_tap(tests);
}
