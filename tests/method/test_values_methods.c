/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Every value that methods prints. Times are never the same twice, so the measuring is
 * replaced here: this program's bench_run() and stability_run() give numbers that are all different, and what the
 * command makes of them is looked for. test_bench.c and test_stability.c test the ones that are replaced.
 */
#include "measured.h"
#include "named.h"

static void want_walk(values *v, const method_family_row *family, const stability_result *r, size_t n) {
    const method_claim *c = &r->row->claims[r->which];
    values_under(v, "methods[%zu].stability.", n);
    want(v, "case=%s claim=%f", family->cases[r->which].name, r->claim);
    want(v, "claim_to=%f worst=%f", r->claim_to, r->inside);
    want(v, "worst_near=%f worst_far=%f worst_at=%f", r->inside_near, r->inside_far, r->inside_at);
    want(v, "breaks=%f infinite=%f ortho=%f", isinf(r->breaks) ? NAN : r->breaks, r->infinite, r->ortho);
    want(v, "lost=%f oblique=%f log=%f", isinf(r->lost) ? NAN : r->lost, r->oblique, r->log);
    want(v, "subnormal=%f", r->subnormal);
    want_text(v, "cause", r->cause);
    want(v, "verdict=%s", stability_verdict_name(r->verdict));
    for (int k = 0; k < r->steps; k++) {
        values_under(v, "methods[%zu].stability.walk[%d].", n, k);
        want(v, "ratio=%f error=%f", r->ratio[k], r->error[k]);
        want(v, "claim=%f", r->ratio[k] <= c->ratio_hi * (1 + 1e-9) ? method_claim_at(c, r->ratio[k]) : NAN);
    }
}

static void want_method(values *v, const method_family_row *family, const bench_result *r, const method_row *choice) {
    const method_error *worst = &r->measured.worst;
    want(v, "name=%s ns=%f limits=%f spread=%f", r->row->name, r->ns, r->ns / r->limit, r->spread);
    want(v, "setup_ns=%f inputs=%zu error=%f", r->setup, r->inputs, family->steps ? worst->ulp : worst->relative);
    want(v, "relative=%f relative_at=%f absolute=%f", worst->relative, r->at_relative, worst->absolute);
    want(v, "absolute_at=%f ulp=%f ulp_at=%f", r->at_absolute, worst->ulp, r->at_ulp);
    want(v, "claim=%f bound=%f pareto=%d", r->claim, r->bound, r->front);
    want(v, "~percent=%f ~preparing=%f", rint(1000 * r->spread) / 10, r->setup > 0 ? r->setup : NAN);
    want(v, "~at=%f ~chosen=%d", family->steps ? r->at_ulp : r->at_relative, r->row == choice);
}

/* Leaves those of the projection that was asked for: the others are walked, too. */
static void drop_others(void) {
    size_t kept = 0;
    for (size_t i = 0; i < walked_count; i++)
        if (method_suits(walked[i].row, &asked))
            walked[kept++] = walked[i];
    walked_count = kept;
}

/* Those that are not measured, and why. */
static void want_absent(values *v, const method_family_row *family) {
    for (size_t i = 0, n = 0; i < *family->method_count; i++) {
        const method_row *row = &family->methods[i];
        const bool speaks = row->claims[asked_which].ratio_hi > 0, flat = asked.spec.ortho;
        if (speaks && ((row->domain & METHOD_ORTHO) != 0 || !flat) && ((row->domain & METHOD_FLAT) == 0 || flat))
            continue;
        values_under(v, "absent[%zu].", n++);
        want(v, "name=%s because=%s", row->name,
             !speaks ? "of other formats or mappings"
             : flat  ? "of perspective cameras"
                     : "of orthographic cameras");
    }
}

/* After a run, from what it was given. */
static const method_row *want_methods(values *v, const method_family_row *family, double tolerance) {
    char machine[192];
    const double ratio = asked.spec.zfar / asked.spec.znear;
    const method_wish wish = {.tolerance = tolerance, .ratio_lo = fmin(ratio, METHOD_RATIO_HI), .ratio_hi = ratio};
    const method_row *choice = isnan(tolerance) ? NULL : method_choose(family, asked_which, &wish);
    drop_others();
    methods_machine(machine, sizeof machine);
    assert_non_null(strstr(machine, ", 2020-01-02"));
    want(v, "family=%s measure=%s machine=%s", family->name, family->measure, machine);
    want_setup(v, &asked);
    want_number(v, "tolerance", tolerance);
    want_text(v, "choice", choice != NULL ? choice->name : NULL);
    want_number(v, "limit_ns", timed[0].limit);
    for (size_t i = 0, n = 0; i < *family->method_count; i++) {
        if (!method_speaks(&family->methods[i], asked_which) || !method_suits(&family->methods[i], &asked))
            continue;
        values_under(v, "methods[%zu].", n);
        want_method(v, family, &timed[n], choice);
        want_walk(v, family, &walked[n], n);
        n++;
    }
    want_absent(v, family);
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

/* Behind the numbers of its line, and then what takes its digits. */
static void check_verdict(const char *line, size_t i) {
    const char *cause = walked[i].cause != NULL ? walked[i].cause : "-",
               *verdict = stability_verdict_name(walked[i].verdict);
    const char *at = strchr(line + 1, '\n') - strlen(cause);
    assert_true(strncmp(at, cause, strlen(cause)) == 0 && strncmp(at - 2, "  ", 2) == 0);
    while (at[-1] == ' ')
        at--;
    at -= strlen(verdict);
    assert_true(strncmp(at, verdict, strlen(verdict)) == 0 && strncmp(at - 2, "  ", 2) == 0);
}

static void check_text(values *v, const method_family_row *family, const method_row *choice, const char *text) {
    char label[64], numbers[512];
    values_under(v, "%s", "");
    check_line(v, text, family->cases[asked_which].name, "near:15, far:15");
    check_line(v, text,
               "ns: per element, the least of 25 turns; +- %: of which a quarter took at most so much more; x memory: "
               "multiple of the time to move the same bytes,",
               "limit_ns:3");
    for (size_t i = 0; i < walked_count; i++) {
        snprintf(label, sizeof label, "%s%s%-19s ", timed[i].front ? "*" : "",
                 timed[i].row == choice ? ">"
                 : timed[i].front       ? " "
                                        : "",
                 timed[i].row->name);
        values_under(v, "methods[%zu].", i);
        snprintf(numbers, sizeof numbers,
                 "ns:2, limits:2, percent:2, preparing:2, relative:2, absolute:2, ulp:2, at:2, bound:2, claim:2, "
                 "%sstability.breaks:2, stability.lost:2, %s%s",
                 family->magnitudes ? "" : "stability.claim_to:2, ",
                 family->magnitudes ? "stability.subnormal:2" : "stability.infinite:2, stability.ortho:2",
                 family == &linearize_family ? ", stability.oblique:2, stability.log:2" : "");
        check_line(v, text, label, numbers);
        check_verdict(place_of(text, i, choice), i);
        for (size_t k = 0; k < i; k++)
            assert_true((place_of(text, i, choice) < place_of(text, k, choice)) == (timed[i].ns < timed[k].ns));
    }
}

static void check_csv_lines(const values *v, const char *text, const char *pattern, const char *columns) {
    line_places lines = places_of(v, pattern);
    check_csv_text(v, text, columns, &lines);
    places_free(&lines);
}

static void check_methods(const char *name, const char *line, size_t which, double tolerance, int status) {
    static const char *const forms[] = {"--json", "--csv", "--full"};
    for (int form = 0; form < 3; form++) {
        char arguments[256];
        const method_family_row *family = method_family_find(name);
        values v = values_of("methods");
        snprintf(arguments, sizeof arguments, "methods %s %s %s", name, line, forms[form]);
        char *text = command_output(cmd_methods, status, arguments);
        assert_int_equal(asked_which, which);
        const method_row *choice = want_methods(&v, family, tolerance);
        if (form == 0)
            check_json_text(&v, text);
        else if (form == 1)
            check_csv_lines(&v, text, "methods[]",
                            "family = /family, method = name, ns, spread, setup [ns] = setup_ns, inputs, error, "
                            "relative, relative_at, absolute, absolute_at, ulp, ulp_at, claim, pareto, chosen, "
                            "limit [ns] = /limit_ns, bound, case = stability.case, claim_to = stability.claim_to, "
                            "breaks = stability.breaks, lost = stability.lost, infinite = stability.infinite, "
                            "ortho = stability.ortho, oblique = stability.oblique, log = stability.log, "
                            "subnormal = stability.subnormal, verdict = stability.verdict, cause = stability.cause");
        else
            check_text(&v, family, choice, text);
        free(text);
        values_free(&v);
    }
}

TEST(each_number) {
    check_methods("interval", "-n 0.3 -f 900 -F fp32 -m reversed --tolerance 1e-6", 1, 1e-6, 0);
    check_methods("encode", "-n 0.25 -f 1500", 0, NAN, 0);
    check_methods("linearize", "-n 0.2 -f 700 --tolerance 1e-30", 0, 1e-30, 0);
    check_methods("linearize", "-n 0.2 -f 700 --ortho", 0, NAN, 0);
    check_methods("linearize", "-n 0.2 -f 700 -m gl-reversed", 1, NAN, 0);
    check_methods("encode", "-F fp32 -m log", 3, NAN, 0); /* a code does not depend on the mapping */
}

/* A claim that does not hold, or that is too modest, is exit status 1; where nothing is claimed nothing is wrong. */
TEST(verdicts_decide) {
    static const struct {
        stability_verdict odd;
        int status;
    } rows[] = {{STABILITY_HOLDS, 0}, {STABILITY_UNCLAIMED, 0}, {STABILITY_MODEST, 1}, {STABILITY_BROKEN, 1}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        verdicts[2] = rows[i].odd;
        check_methods(i % 2 == 0 ? "linearize" : "interval", "-n 0.2 -f 700", 0, NAN, rows[i].status);
    }
    memset(verdicts, 0, sizeof verdicts);
}

/* Text leaves out what another beats everywhere, and says how many; all of them are there with --full. */
TEST(left_out) {
    static const char *const behind[] = {"table-nearest", "table-linear", "spline", "chebyshev"};
    char *brief = command_output(cmd_methods, 0, "methods linearize");
    char *full = command_output(cmd_methods, 0, "methods linearize --full");
    for (size_t i = 0; i < sizeof behind / sizeof behind[0]; i++)
        assert_true(strstr(brief, behind[i]) == NULL && strstr(full, behind[i]) != NULL);
    assert_non_null(strstr(brief, "--full: 4 more"));
    assert_null(strstr(full, "more, to each"));
    free(brief);
    free(full);
}

/* A note of a column stands below a table that has the column, and below no other; angles are no share. */
TEST(notes_are_of_columns) {
    static const char *const words[] = {"x memory", "bound", "claim", "fails from"};
    static const char *const commands[] = {"methods linearize", "methods linearize --full", "methods normal",
                                           "methods encode"};
    for (size_t k = 0; k < sizeof commands / sizeof commands[0]; k++) {
        char *text = command_output(cmd_methods, 0, commands[k]), *head = strstr(text, "\n  method ") + 1,
             *notes = strstr(text, "\n  ns: ");
        *strchr(head, '\n') = *notes = '\0';
        for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
            char note[32];
            snprintf(note, sizeof note, " %s: ", words[i]);
            if ((strstr(head, words[i]) != NULL) != (strstr(notes + 1, note) != NULL))
                fail_msg("%s: column or note of %s, not both: %s\n%s", commands[k], words[i], head, notes + 1);
        }
        assert_true((strstr(head, " radians ") != NULL) == (k == 2) && (strstr(head, " relative ") != NULL) == (k < 2));
        free(text);
    }
}

/* The least time of those on the front that answer the question of the lattice and are off by at most that much. */
static const bench_result *fastest(size_t f, double most) {
    const bench_result *best = NULL;
    for (size_t i = 0; i < all_timed[f].count; i++) {
        const bench_result *r = &all_timed[f].timed[i];
        const double error = method_family_get(f)->steps ? r->measured.worst.ulp : r->measured.worst.relative;
        if (r->front && (r->row->domain & METHOD_PIPELINE) == 0 && error <= most && (best == NULL || r->ns < best->ns))
            best = r;
    }
    return best;
}

static double error_in(size_t f, const bench_result *r) {
    return method_family_get(f)->steps ? r->measured.worst.ulp : r->measured.worst.relative;
}

static void want_family(values *v, size_t f) {
    const method_family_row *family = method_family_get(f);
    const bench_result *use = fastest(f, family->steps ? 1 : 1e-4);
    for (size_t i = 0; use == NULL && i < all_timed[f].count; i++) { /* else the most exact */
        const bench_result *r = &all_timed[f].timed[i];
        if (r->front && (r->row->domain & METHOD_PIPELINE) == 0 && fastest(f, error_in(f, r) * (1 - 1e-12)) == NULL)
            use = r;
    }
    const bench_result *next = use != NULL ? fastest(f, error_in(f, use) / 2) : NULL;
    values_under(v, "families[%zu].", f);
    want(v, "name=%s note=%s measure=%s methods=%zu", family->name, family->summary, family->measure,
         *family->method_count);
    want(v, "case=%s ns=%f error=%f", family->cases[all_timed[f].which].name, use != NULL ? use->ns : NAN,
         use != NULL ? error_in(f, use) : NAN);
    want_text(v, "use", use != NULL ? use->row->name : NULL);
    want_text(v, "next", next != NULL ? next->row->name : NULL);
    want(v, "slower=%f gain=%f", next != NULL ? next->ns / use->ns : NAN,
         next != NULL ? error_in(f, use) / error_in(f, next) : NAN);
}

/* A line for each family, when none is named: in the first case that has a front. */
TEST(families) {
    char machine[192];
    for (int form = 0; form < 6; form++) {
        values v = values_of("methods");
        none_on_front = form % 3 == 2;
        char *text = command_output(cmd_methods, 0, form % 2 == 0 ? "methods --json -n 0.2" : "methods --csv -f 700");
        methods_machine(machine, sizeof machine);
        if (form % 2 == 0)
            want(&v, "machine=%s", machine);
        for (size_t i = 0; method_family_get(i) != NULL; i++) {
            want_family(&v, i);
            assert_int_equal(all_timed[i].which, none_on_front);
        }
        assert_true(asked.spec.znear == (form % 2 == 0 ? 0.2 : 0.1) && asked.spec.zfar == (form % 2 == 0 ? 1000 : 700));
        if (form % 2 == 0)
            check_json_text(&v, text);
        else
            check_csv_lines(&v, text, "families[]",
                            "name, note, measure, methods, case, use, ns, error, next, slower, gain");
        free(text);
        values_free(&v);
    }
    none_on_front = false;
}

LIST_TEST(check_apart)

int main(void) {
    setenv("SOURCE_DATE_EPOCH", "1577923200", 1);
    return run_listed(NULL, NULL);
}
