/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Every value that bench and stability print. Times are never the same twice, so the measuring is
 * replaced here: this program's bench_run() and stability_run() give numbers that are all different, and what the
 * commands make of them is looked for. test_bench.c and test_stability.c test the ones that are replaced.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "measured.h"
#include "named.h"

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
    want_number(v, "bound", r->bound);
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

/* Where the line of a method begins: the fastest stands first. */
static const char *place_of(const char *text, size_t i, const method_row *choice) {
    char label[64];
    snprintf(label, sizeof label, "\n%c%c%-19s ", timed[i].front ? '*' : ' ', timed[i].row == choice ? '>' : ' ',
             timed[i].row->name);
    const char *at = strstr(text, label);
    assert_non_null(at);
    return at;
}

static void check_bench_text(const values *v, const method_family_row *family, const method_row *choice,
                             const char *text, size_t count) {
    static const char *const fields[] = {"ns",       "limits", "percent", "preparing", "relative",
                                         "absolute", "ulp",    "at",      "bound",     "claim"};
    static const char *const planes[] = {"near", "far", NULL}, *const limit[] = {"limit_ns", NULL};
    char label[64], at[10][PATH_SIZE];
    check_text_numbers(v, text, family->cases[asked_which].name, 15, planes);
    check_text_numbers(v, text, "ns: per element, the median; x memory: multiple of the", 3, limit);
    for (size_t i = 0; i < count; i++) {
        const char *paths[11] = {NULL};
        snprintf(label, sizeof label, "%s%s%-19s ", timed[i].front ? "*" : "",
                 timed[i].row == choice ? ">"
                 : timed[i].front       ? " "
                                        : "",
                 timed[i].row->name);
        for (size_t k = 0; k < 10; k++) {
            snprintf(at[k], PATH_SIZE, "methods[%zu].%s", i, fields[k]);
            paths[k] = at[k];
        }
        check_text_numbers(v, text, label, 2, paths);
        for (size_t k = 0; k < i; k++)
            assert_true((place_of(text, i, choice) < place_of(text, k, choice)) == (timed[i].ns < timed[k].ns));
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
                                         {"limit [ns]", "/limit_ns"},
                                         {"bound", "bound"}};
    static const char *const forms[] = {"--json", "--csv", "--full"};
    for (int form = 0; form < 3; form++) {
        char arguments[256];
        const method_family_row *family = method_family_find(name);
        line_places lines = {0};
        values v = values_of("bench");
        snprintf(arguments, sizeof arguments, "bench %s %s %s", name, line, forms[form]);
        char *text = command_output(cmd_bench, 0, arguments);
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
    static const csv_column columns[] = {{"family", "/family"}, {"method", "^name"},       {"case", "^case"},
                                         {"claim", "claim"},    {"claim_to", "^claim_to"}, {"verdict", "^verdict"},
                                         {"ratio", "ratio"},    {"error", "error"}};
    static const char *const forms[] = {"--json", "--csv", "--full"};
    static const char *const fields[] = {"claim", "claim_to", "worst", "breaks_at", "infinite", "ortho"};
    for (int form = 0; form < 3; form++) {
        char arguments[128], label[96], at[6][PATH_SIZE];
        const char *paths[7] = {at[0], at[1], at[2], at[3], at[4], at[5], NULL};
        const method_family_row *family = method_family_find(name);
        line_places lines = {0};
        values v = values_of("stability");
        snprintf(arguments, sizeof arguments, "stability %s %s", name, forms[form]);
        char *text = command_output(cmd_stability, status, arguments);
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
            snprintf(label, sizeof label, "%-18s %-13s", r->row->name, family->cases[r->which].name);
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

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bench),
        cmocka_unit_test(test_stability),
        cmocka_unit_test(check_apart),
    };
    setenv("SOURCE_DATE_EPOCH", "1577923200", 1);
    return run_tap(tests);
}
