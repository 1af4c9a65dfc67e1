/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Where a condition turns: found to the last number, between ends of any sign and size, in either order; where it turns
 * is known beforehand, or found by walking. Every number asked about lies between the ends, and none is asked twice.
 */

#include <float.h>

#include "core/search.h"
#include "support.h"

enum { STEPS_POSITIVE = 70, STEPS_MOST = 2200 };

/* It holds up to `last`, seen from the end where it holds. */
static dp_edge searched(dp_edge e, double last, int *steps) {
    const bool up = e.holds < e.fails;
    *steps = 0;
    for (double x; dp_edge_between(&e, &x); ++*steps) {
        assert_true(x > fmin(e.holds, e.fails) && x < fmax(e.holds, e.fails));
        assert_true(*steps < STEPS_MOST);
        *((up ? x <= last : x >= last) ? &e.holds : &e.fails) = x;
    }
    return e;
}

static void expect_edge(double holds, double fails, double last, int most) {
    int steps;
    const dp_edge e = searched((dp_edge){.holds = holds, .fails = fails}, last, &steps);
    assert_true(e.holds == last && e.fails == nextafter(last, fails));
    assert_true(steps <= most);
}

static void finds_the_last_number(void **state) {
    (void)state;
    static const struct {
        double holds, fails, last;
        int most;
    } rows[] = {
        {1.0, 2.0, 1.5, STEPS_POSITIVE},
        {2.0, 1.0, 1.5, STEPS_POSITIVE},
        {1.0, 2.0, 1.0, STEPS_POSITIVE},                 /* never beyond the first */
        {1.0, 2.0, 0x1.fffffffffffffp0, STEPS_POSITIVE}, /* always but at the end */
        {DBL_TRUE_MIN, DBL_MAX, 1.0, STEPS_POSITIVE},
        {DBL_MAX, DBL_TRUE_MIN, 0x1p-1022, STEPS_POSITIVE},
        {DBL_TRUE_MIN, DBL_MIN, 7 * DBL_TRUE_MIN, STEPS_POSITIVE},
        {0.0, 1.0, DBL_TRUE_MIN, STEPS_MOST},
        {0.0, 1.0, 0.0, STEPS_MOST},
        {1.0, 0.0, DBL_TRUE_MIN, STEPS_MOST},
        {-1.0, 0.0, -5 * DBL_TRUE_MIN, STEPS_MOST},
        {-2.0, -1.0, -1.25, STEPS_POSITIVE},
        {-1.0, -2.0, -1.25, STEPS_POSITIVE},
        {-DBL_MAX, DBL_MAX, 3.0, STEPS_MOST},
        {DBL_MAX, -DBL_MAX, -DBL_MIN, STEPS_MOST},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        expect_edge(rows[i].holds, rows[i].fails, rows[i].last, rows[i].most);
}

static void finds_any_turn(void **state) {
    (void)state;
    rng r = rng_make("search");
    for (uint64_t i = 0; i < test_cases(200, 2000, 8000); i++) {
        const double a = rng_log(&r, 1e-300, 1e300), b = rng_log(&r, 1e-300, 1e300), last = rng_log(&r, 1e-300, 1e300);
        if (last >= fmin(a, b) && last <= fmax(a, b) && last != b)
            expect_edge(a, b, last, STEPS_POSITIVE);
        const double near = rng_log(&r, 0.5, 1.0);
        expect_edge(-near, 2.0, rng_uniform(&r, -near, 1.0), 1100);
        expect_edge(near, near * (1.0 + 0x1p-40), near * (1.0 + 0x1p-41), STEPS_POSITIVE);
    }
}

static void has_nothing_between(void **state) {
    (void)state;
    const dp_edge none[] = {{.holds = 1.0, .fails = 1.0},
                            {.holds = 1.0, .fails = 1.0 + DBL_EPSILON},
                            {.holds = 0.0, .fails = DBL_TRUE_MIN},
                            {.holds = -DBL_TRUE_MIN, .fails = 0.0},
                            {.holds = 1.0, .fails = 1.0 - DBL_EPSILON / 2},
                            {.holds = NAN, .fails = 1.0},
                            {.holds = 1.0, .fails = NAN},
                            {.holds = 1.0, .fails = 1.0 + 0x1p-23, .single = 1},
                            {.holds = 1.0 + 0.25 * 0x1p-23, .fails = 1.0 + 0.75 * 0x1p-23, .single = 1},
                            {.holds = (double)FLT_MAX, .fails = 1e300, .single = 1},
                            {.holds = 1.0, .fails = 1.0 + 0x1p-20, .apart = 0x1p-20}};
    for (size_t i = 0; i < sizeof none / sizeof none[0]; i++) {
        double x;
        assert_false(dp_edge_between(&none[i], &x));
    }
}

/* All binary32 numbers that matter are asked about, also where the ends are none. */
static void keeps_to_binary32(void **state) {
    (void)state;
    static const double ends[][3] = {{1.0, 2.0, 1.5},
                                     {1e-30, 1e30, 3.0},
                                     {0.0, 1.0, 0x1p-149},
                                     {1.0, 1.0 + 0x1p-23 + 0x1p-49, 1.0 + 0x1p-23}, /* the root is nearest to the end */
                                     {1.0 + 0x1p-40, 1.0 + 3 * 0x1p-23, 1.0 + 0x1p-23},
                                     {3.0 * 0x1p-149, 9.0 * 0x1p-149, 0x1p-147},
                                     {-1.0, 1.0, -0x1p-130}};
    for (size_t i = 0; i < sizeof ends / sizeof ends[0]; i++) {
        const float last = (float)ends[i][2];
        int steps;
        dp_edge e = searched((dp_edge){.holds = ends[i][0], .fails = ends[i][1], .single = 1}, ends[i][2], &steps);
        assert_true(e.holds == (double)last && e.fails == fmin((double)nextafterf(last, HUGE_VALF), ends[i][1]));
        e = searched((dp_edge){.holds = ends[i][1], .fails = ends[i][0], .single = 1}, ends[i][2], &steps);
        assert_true(e.holds == (double)last);
        assert_true(e.fails == fmax((double)nextafterf(last, -HUGE_VALF), ends[i][0]));
    }
}

/* The part that may stay between is a share of the larger magnitude; more than half of it is left where halving
 * ends. */
static void ends_as_near_as_was_asked(void **state) {
    (void)state;
    for (int k = 10; k < 50; k += 7) {
        const double apart = ldexp(1.0, -k);
        int steps;
        const dp_edge e = searched((dp_edge){.holds = 1e-3, .fails = 1e5, .apart = apart}, M_PI, &steps);
        assert_true(e.holds <= M_PI && e.fails > M_PI);
        assert_true(e.fails - e.holds <= apart * e.fails && e.fails - e.holds > 0.4 * apart * e.fails);
    }
}

/* Positive ends whose ratio is at most that are halved on a straight scale, others on a logarithmic one. */
static void halves_on_either_scale(void **state) {
    (void)state;
    double x;
    assert_true(dp_edge_between(&(dp_edge){.holds = 4.0, .fails = 9.0}, &x) && x == 6.0);
    assert_true(dp_edge_between(&(dp_edge){.holds = 4.0, .fails = 9.0, .straight = 2.25}, &x) && x == 6.5);
    assert_true(dp_edge_between(&(dp_edge){.holds = 9.0, .fails = 4.0, .straight = 2.0}, &x) && x == 6.0);
    assert_true(dp_edge_between(&(dp_edge){.holds = -4.0, .fails = 8.0}, &x) && x == 2.0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(finds_the_last_number),     cmocka_unit_test(finds_any_turn),
        cmocka_unit_test(has_nothing_between),       cmocka_unit_test(keeps_to_binary32),
        cmocka_unit_test(ends_as_near_as_was_asked), cmocka_unit_test(halves_on_either_scale),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
