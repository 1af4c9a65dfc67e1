/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Every value that solve prints. The planes that it found are taken from its JSON and put to the test: there the
 * measure is what is printed beside them, they pass, and beyond them nothing does. Text and CSV say the same.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "need/cost.h"
#include "need/measure.h"
#include "printed.h"

typedef struct solve_case {
    const char *arguments, *target;
    measure_kind kind;
    double limit; /* NaN: what is reached is asked */
    double lo, hi;
    bool possible;
    double znear, zfar; /* as given; NaN where they are asked for */
} solve_case;

static const solve_case cases[] = {
    {"-F unorm24,fp32 -m d3d,reversed -f 10000 --separation 0.01 --at 5000", "near", MEASURE_SEPARATION, 0.01, 5000,
     5000, true, NAN, 10000},
    {"-n 0.1 -F unorm16 -m d3d --for far --error 0.024 --at 17.77", "far", MEASURE_ERROR, 0.024, 17.77, 17.77, true,
     0.1, NAN},
    {"--for far -n 0.1 -F fp16 -m log --log-c 2.5 --error 0.0036 --range 2:5", "far", MEASURE_ERROR, 0.0036, 2, 5, true,
     0.1, NAN},
    {"-F fp16 -m reversed -f 1000 --error 0.01 --range 1:100", "near", MEASURE_ERROR, 0.01, 1, 100, false, NAN, 1000},
    {"-F fp16 -m reversed -f 4000 --rounding even --separation 0.5 --range 10:700", "near", MEASURE_SEPARATION, 0.5, 10,
     700, true, NAN, 4000},
    {"-n 0.1 -f 4000 -F unorm16 --separation 0.001 --at 100", "mapping", MEASURE_SEPARATION, 0.001, 100, 100, false,
     0.1, 4000},
    {"-n 0.1 -f 4000 --separation 0.001 --range 0.1:100", "format", MEASURE_SEPARATION, 0.001, 0.1, 100, true, 0.1,
     4000},
    {"-n 0.1 -f 1000 -F unorm24,fp32 -m d3d,reversed --rounding zero --range 3:50", "separation", MEASURE_SEPARATION,
     NAN, 3, 50, true, 0.1, 1000},
};

/* ---- What is said of a candidate --------------------------------------------------------------------------------- */

static double number_in(const json_t *o, const char *key) {
    const json_t *j = json_object_get(o, key);
    return json_is_number(j) ? json_number_value(j) : NAN;
}

static const char *text_in(const json_t *o, const char *key) {
    const char *text = json_string_value(json_object_get(o, key));
    assert_non_null(text);
    return text;
}

static dp_setup setup_in(const json_t *o) {
    dp_spec spec = dp_spec_default();
    dp_format format[2];
    dp_setup setup;
    spec.znear = number_in(o, "near");
    spec.zfar = json_is_null(json_object_get(o, "far")) ? INFINITY : number_in(o, "far");
    assert_int_equal(dp_format_parse(text_in(o, "format"), format), 1);
    spec.format = format[0];
    assert_int_equal(dp_mapping_parse(text_in(o, "mapping"), &spec.mapping), DP_OK);
    for (int r = 0; dp_rounding_name((dp_rounding)r) != NULL; r++)
        if (strcmp(dp_rounding_name((dp_rounding)r), text_in(o, "rounding")) == 0)
            spec.rounding = (dp_rounding)r;
    spec.log_c = spec.mapping == DP_MAPPING_LOG ? number_in(o, "log_c") : 1;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    return setup;
}

/* The measure with another plane in place of the one that was solved for; INFINITY where that cannot be. */
static double with_plane(const solve_case *c, const dp_setup *setup, bool near_asked, double plane) {
    dp_spec spec = setup->spec;
    dp_setup other;
    *(near_asked ? &spec.znear : &spec.zfar) = plane;
    if (spec.znear > c->lo || spec.zfar < c->hi || dp_setup_init(&other, &spec) != DP_OK)
        return INFINITY;
    return measure_over(c->kind, &other, c->lo, c->hi).value;
}

/* Both ends pass; outward of each nothing does, unless it is as far as a plane can go. */
static void check_island(const solve_case *c, const dp_setup *setup, bool near_asked, double lo, double hi) {
    const double outward = 1e-7;
    assert_true(lo <= hi);
    assert_true(with_plane(c, setup, near_asked, lo) <= c->limit && with_plane(c, setup, near_asked, hi) <= c->limit);
    if (lo > 1e-12 && (near_asked || lo > c->hi))
        assert_true(with_plane(c, setup, near_asked, lo * (1 - outward)) > c->limit);
    if (near_asked ? hi < c->lo : hi < 1e18)
        assert_true(with_plane(c, setup, near_asked, hi * (1 + outward)) > c->limit);
}

static double in_binary32(const solve_case *c, const dp_setup *setup, double z) {
    dp_budget b;
    return c->kind == MEASURE_SEPARATION && dp_budget_at(setup, z, NULL, &b) == DP_OK ? b.separation : NAN;
}

/* Was a plane solved for? By default it is the target; among alternatives it may be another near plane. */
static bool is_solved(const solve_case *c, const dp_setup *setup) {
    return isnan(c->znear) || isnan(c->zfar) || setup->spec.znear != c->znear;
}

static void want_candidate(values *v, const solve_case *c, const json_t *o, const char *under) {
    const dp_setup setup = setup_in(o);
    const measure_worst worst = measure_over(c->kind, &setup, c->lo, c->hi);
    const cost price = cost_of(&setup.spec.format, setup.spec.mapping);
    const bool passes = isnan(c->limit) || worst.value <= c->limit, solved = is_solved(c, &setup) && passes;
    const bool near_asked = strcmp(c->target, "far") != 0;
    const double plane = near_asked ? setup.spec.znear : setup.spec.zfar, until = number_in(o, "until");
    values_under(v, "%s", under);
    want_setup(v, &setup);
    want_bool(v, "possible", passes);
    want_number(v, c->kind == MEASURE_ERROR ? "error" : "separation", worst.value);
    want_number(v, "z", worst.z);
    want_number(v, "separation_fp32", in_binary32(c, &setup, worst.z));
    (solved ? want_number : want_derived)(v, "until", solved ? until : NAN);
    want_count(v, "bytes", (uint64_t)price.bytes);
    want_text(v, "available", price.available);
    want_text(v, "caution", price.caution);
    want_text(v, "effort", price.effort);
    want_derived(v, "value", worst.value);
    want_derived(v, "plane", passes ? plane : NAN);
    want_derived(v, "from", solved ? fmin(plane, until) : NAN);
    want_derived(v, "to", solved ? fmax(plane, until) : NAN);
    if (solved)
        check_island(c, &setup, near_asked, fmin(plane, until), fmax(plane, until));
}

/* Cheapest first: what passes as it is, what passes with another near, the rest. */
static int class_of(const solve_case *c, const json_t *o) {
    const dp_setup setup = setup_in(o);
    const bool asked = isnan(c->znear) || isnan(c->zfar);
    return !json_is_true(json_object_get(o, "possible")) ? 2 : !asked && is_solved(c, &setup) ? 1 : 0;
}

static void check_order(const solve_case *c, const json_t *alternatives) {
    for (size_t i = 1; i < json_array_size(alternatives); i++) {
        const json_t *a = json_array_get(alternatives, i - 1), *b = json_array_get(alternatives, i);
        const dp_setup x = setup_in(a), y = setup_in(b);
        const cost p = cost_of(&x.spec.format, x.spec.mapping), q = cost_of(&y.spec.format, y.spec.mapping);
        assert_true(class_of(c, a) <= class_of(c, b));
        if (class_of(c, a) == class_of(c, b) && class_of(c, a) < 2)
            assert_true(cost_compare(&p, &q) <= 0);
    }
}

static void want_solve(values *v, const solve_case *c, const json_t *root, line_places *lines) {
    const json_t *answer = json_object_get(root, "answer"), *islands = json_object_get(root, "islands");
    const json_t *others = json_object_get(root, "alternatives");
    const dp_setup setup = setup_in(answer);
    char under[PATH_SIZE];
    want_text(v, "for", c->target);
    want_text(v, "measure", c->kind == MEASURE_ERROR ? "error" : "separation");
    want_number(v, "limit", c->limit);
    want_number(v, "lo", c->lo);
    want_number(v, "hi", c->hi);
    want_bool(v, "possible", c->possible);
    want_candidate(v, c, answer, "answer.");
    place_add(lines, "", "answer.");
    for (size_t i = 0; i < json_array_size(islands); i++) {
        const double lo = number_in(json_array_get(islands, i), "lo"), hi = number_in(json_array_get(islands, i), "hi");
        values_under(v, "islands[%zu].", i);
        want_number(v, "lo", lo);
        want_number(v, "hi", isnan(hi) ? INFINITY : hi);
        check_island(c, &setup, strcmp(c->target, "far") != 0, lo, isnan(hi) ? INFINITY : hi);
        if (i + 1 < json_array_size(islands))
            place_add(lines, "", "islands[%zu].", i);
        else if (c->possible) /* the last is the answer's own */
            assert_true(value_at(v, "answer.from")->number == lo &&
                        value_at(v, "answer.to")->number == (isnan(hi) ? INFINITY : hi));
    }
    for (size_t i = 0; i < json_array_size(others); i++) {
        snprintf(under, sizeof under, "alternatives[%zu].", i);
        want_candidate(v, c, json_array_get(others, i), under);
        place_add(lines, "", "%s", under);
    }
    check_order(c, others);
}

/* ---- CSV and text ------------------------------------------------------------------------------------------------ */

/* An island's line is the answer's with the island's ends. */
static void check_lines(values *v, const char *arguments, line_places *lines, size_t islands) {
    static const csv_column columns[] = {{"role", "role"},
                                         SETUP_COLUMNS,
                                         {"for", "/for"},
                                         {"possible", "^possible"},
                                         {"measure", "/measure"},
                                         {"limit [scene]", "/limit"},
                                         {"value [scene]", "^value"},
                                         {"z [scene]", "^z"},
                                         {"from [scene]", "from"},
                                         {"to [scene]", "to"},
                                         {"bytes", "^bytes"},
                                         {"available", "^available"}};
    for (size_t i = 0; i < lines->count; i++) {
        line_place *p = &lines->items[i];
        const bool island = i > 0 && i <= islands;
        values_under(v, "%s", p->inner);
        wanted role = {.kind = VALUE_TEXT, .derived = true};
        want_derived(v, "role", 0);
        role = v->items[v->count - 1];
        role.kind = VALUE_TEXT;
        snprintf(role.text, sizeof role.text, "%s", i == 0 ? "answer" : island ? "island" : "alternative");
        v->items[v->count - 1] = role;
        if (island) {
            want_derived(v, "from",
                         value_at(v, (snprintf(p->outer, PATH_SIZE, "%.60slo", p->inner), p->outer))->number);
            want_derived(v, "to", value_at(v, (snprintf(p->outer, PATH_SIZE, "%.60shi", p->inner), p->outer))->number);
            snprintf(p->outer, PATH_SIZE, "answer.");
        }
    }
    check_csv(v, strstr(arguments, "fp16 -m reversed -f 1000") != NULL || strstr(arguments, "unorm16 --sep") != NULL,
              arguments, columns, sizeof columns / sizeof columns[0], lines);
}

static void check_text(const values *v, const solve_case *c, const char *arguments, const line_places *lines) {
    const char *const worst[] = {"answer.value", "answer.z", isnan(c->limit) ? NULL : "limit", NULL};
    static const char *const plane[] = {"answer.plane", NULL};
    static const char *const passes[] = {"answer.from", "answer.to", NULL};
    static const char *const certain[] = {"answer.separation_fp32", NULL};
    char label[128], at[3][PATH_SIZE];
    const char *of_other[] = {at[0], at[1], at[2], NULL};
    printed p = print_of("%s", arguments);
    assert_int_equal(p.status, !c->possible);
    snprintf(label, sizeof label, "%-14s ", c->kind == MEASURE_ERROR ? "error" : "separation");
    check_text_numbers(v, p.out, label, 6, worst);
    if (isfinite(value_at(v, "answer.separation_fp32")->number))
        check_text_numbers(v, p.out, "in binary32", 6, certain);
    if (isnan(c->znear) || isnan(c->zfar)) {
        snprintf(label, sizeof label, "%-14s ", c->target);
        if (c->possible) {
            check_text_numbers(v, p.out, label, 15, plane);
            check_text_numbers(v, p.out, "passes ", 6, passes);
        }
    }
    for (size_t i = 0; i < lines->count; i++) {
        const char *under = lines->items[i].inner;
        if (strncmp(under, "alternatives", 12) != 0)
            continue;
        snprintf(at[0], PATH_SIZE, "%.60sformat", under);
        snprintf(at[1], PATH_SIZE, "%.60smapping", under);
        snprintf(label, sizeof label, "%-10.40s %-11.40s ", value_at(v, at[0])->text, value_at(v, at[1])->text);
        snprintf(at[0], PATH_SIZE, "%.60s%s", under, isnan(c->limit) ? "value" : "plane");
        snprintf(at[1], PATH_SIZE, "%.60svalue", under);
        snprintf(at[2], PATH_SIZE, "%.60sbytes", under);
        const bool none = isnan(value_at(v, at[0])->number); /* "none" is no number */
        of_other[2] = isnan(c->limit) ? NULL : at[2];
        check_text_numbers(v, p.out, label, 6, none || isnan(c->limit) ? of_other + 1 : of_other);
    }
    printed_free(&p);
}

static void test_solve(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const solve_case *c = &cases[i];
        char arguments[512];
        line_places lines = {0};
        values v = values_of("solve");
        snprintf(arguments, sizeof arguments, "solve --model exact %s", c->arguments);
        printed p = print_of("%s --json", arguments);
        assert_int_equal(p.status, !c->possible);
        json_t *root = json_of(p.out);
        const size_t islands = json_array_size(json_object_get(root, "islands"));
        want_solve(&v, c, root, &lines);
        check_json_text(&v, p.out);
        check_lines(&v, arguments, &lines, islands > 0 ? islands - 1 : 0);
        check_text(&v, c, arguments, &lines);
        json_decref(root);
        printed_free(&p);
        values_free(&v);
        places_free(&lines);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_solve), cmocka_unit_test(check_apart)};
    return run_tap(tests);
}
