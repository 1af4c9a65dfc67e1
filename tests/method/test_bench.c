/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The statistics of the bench, by known samples: a clock of its own, which goes on only where this program says so. */
#include <time.h>

#include "method/bench.h"
#include "support.h"

enum { INPUTS = 10, REPETITIONS = 25, CONTESTANTS = 4, LIMIT = 3 };

/* ---- The clock --------------------------------------------------------------------------------------------------- */

static double clock_ns;

int clock_gettime(clockid_t which, struct timespec *out) {
    (void)which;
    out->tv_sec = (time_t)(clock_ns / 1e9);
    out->tv_nsec = (long)(clock_ns - 1e9 * (double)out->tv_sec);
    return 0;
}

/* ---- A family of three, and the limit ---------------------------------------------------------------------------- */

static double samples[CONTESTANTS][REPETITIONS]; /* ns of each run, in the order of the repetitions */
static int runs[CONTESTANTS];                    /* so far; the first judges, the second warms up */
static int repetitions;

/* A run lasts as long as its sample, and longer than the bench wants a timing to last: one run is one timing. */
static void run_as(int contestant) {
    const int run = runs[contestant]++ - (contestant == LIMIT ? 1 : 2);
    clock_ns += run < 0 ? 5e5 : samples[contestant][run];
}

static void run_0(const method_call *call) {
    (void)call;
    run_as(0);
}

static void run_1(const method_call *call) {
    (void)call;
    run_as(1);
}

static void run_2(const method_call *call) {
    (void)call;
    run_as(2);
}

static void run_limit(const method_call *call) {
    (void)call;
    run_as(LIMIT);
}

static void *open_1(const dp_setup *setup) {
    (void)setup;
    clock_ns += 77777;
    return &clock_ns;
}

static void close_1(void *state) {
    assert_ptr_equal(state, &clock_ns);
}

static void fill(const dp_setup *setup, method_inputs *in) {
    (void)setup;
    for (size_t i = 0; i < in->count; i++)
        in->z[i] = 100 + (double)i;
}

static bool loses_one; /* the answer to input 6 is no number */

/* The worst of each kind at an input of its own; what lies outside of the domain is worse and does not count. */
static bool judge(const method_call *call, size_t i, method_error *e) {
    const double scale = strcmp(call->row->name, "exact") == 0 ? 1e-3 : 1;
    *e = (method_error){i == 3 ? 9 : 1, scale * (i == 5 ? 8 : 2), i == 7 ? 7 : 3};
    if (i == 4)
        *e = (method_error){1e9, 1e9, 1e9};
    if (i == 6 && loses_one)
        *e = (method_error){(double)NAN, (double)NAN, (double)NAN};
    return i != 4;
}

static const method_row rows[] = {
    {.name = "fast", .claims = {FULL(10)}, .run = run_0},
    {.name = "exact",
     .claims = {{4, METHOD_RATIO_LO, 100, NULL, 0, 0}},
     .run = run_1,
     .open = open_1,
     .close = close_1},
    {.name = "neither", .claims = {FULL(12)}, .run = run_2, .limit = 6},
};
static const size_t row_count = sizeof rows / sizeof rows[0];
static const method_family_row family = {.name = "known",
                                         .cases = {{"unorm24 d3d", "unorm24", DP_MAPPING_D3D}},
                                         .case_count = 1,
                                         .inputs = INPUTS,
                                         .method_count = &row_count,
                                         .methods = rows,
                                         .fill = fill,
                                         .judge = judge,
                                         .limit = run_limit};

/* ---- Statistics -------------------------------------------------------------------------------------------------- */

static int ascending(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Sample number `share` of the way up, counted from 0 and rounded down. */
static double sorted_at(int contestant, int quarters) {
    double sorted[REPETITIONS];
    memcpy(sorted, samples[contestant], sizeof sorted);
    qsort(sorted, (size_t)repetitions, sizeof sorted[0], ascending);
    const double at = 0.25 * quarters * (repetitions - 1);
    const int below = (int)at;
    return below + 1 < repetitions ? sorted[below] + (at - below) * (sorted[below + 1] - sorted[below]) : sorted[below];
}

static size_t run_bench(int count, bench_result results[BENCH_METHODS_MAX]) {
    dp_setup setup;
    rng r = rng_make("bench");
    repetitions = count;
    memset(runs, 0, sizeof runs);
    clock_ns = 1e9;
    for (int c = 0; c < CONTESTANTS; c++)
        for (int i = 0; i < count; i++)
            samples[c][i] = floor(rng_log(&r, 5e5, 3e6) * (c == 1 ? 3 : c == 2 ? 2 : 1));
    assert_int_equal(method_setup(&family, 0, 0.1, 1000, false, &setup), DP_OK);
    return bench_run(&family, 0, &setup, count, results);
}

TEST(medians_and_quartiles) {
    static const int counts[] = {25, 8, 1};
    static bench_result results[BENCH_METHODS_MAX];
    for (size_t k = 0; k < sizeof counts / sizeof counts[0]; k++) {
        assert_int_equal(run_bench(counts[k], results), 3);
        for (int i = 0; i < 3; i++) {
            const double inputs = i == 2 ? 6 : INPUTS, median = sorted_at(i, 2);
            assert_int_equal(results[i].inputs, (size_t)inputs);
            assert_relative(results[i].ns, median / inputs, 1e-12);
            assert_scene(results[i].spread, (sorted_at(i, 3) - sorted_at(i, 1)) / 2 / median, 1e-12);
            assert_relative(results[i].limit, sorted_at(LIMIT, 2) / INPUTS, 1e-12);
            assert_scene(results[i].setup, i == 1 ? 77777 : 0, 1e-6);
            assert_true(runs[i] == counts[k] + 2);
        }
    }
}

TEST(worst_errors_and_places) {
    static bench_result results[BENCH_METHODS_MAX];
    assert_int_equal(run_bench(REPETITIONS, results), 3);
    for (int i = 0; i < 3; i++) {
        const bench_result *r = &results[i];
        assert_true(r->measured.count == (i == 2 ? 5 : 9));
        assert_true(r->measured.worst.absolute == 9 && r->at_absolute == 103);
        assert_relative(r->measured.worst.relative, i == 1 ? 8e-3 : 8, 1e-15);
        assert_true(r->at_relative == 105);
        assert_true(r->measured.worst.ulp == (i == 2 ? 3 : 7) && r->at_ulp == (i == 2 ? 100 : 107));
    }
    /* far/near is 10000: beyond what the second claims. */
    assert_true(results[0].claim == 10 && isnan(results[1].claim) && results[2].claim == 12);
}

/* No error is worse than to have no answer, and such a method is on no front. */
TEST(no_number_is_the_worst) {
    static bench_result results[BENCH_METHODS_MAX];
    loses_one = true;
    assert_int_equal(run_bench(REPETITIONS, results), 3);
    loses_one = false;
    for (int i = 0; i < 2; i++) {
        const bench_result *r = &results[i];
        const method_error *worst = &r->measured.worst;
        assert_true(isnan(worst->absolute) && isnan(worst->relative) && isnan(worst->ulp) && !r->front);
        assert_true(r->at_absolute == 106 && r->at_relative == 106 && r->at_ulp == 106);
    }
    assert_true(results[2].measured.worst.relative == 8); /* it stops before */
}

/* On the front are the fastest and the most exact; the third is slower an element than the first, and no better. */
TEST(front) {
    static bench_result results[BENCH_METHODS_MAX];
    assert_int_equal(run_bench(REPETITIONS, results), 3);
    assert_true(results[0].ns < results[1].ns && results[0].ns < results[2].ns);
    assert_true(results[0].front && results[1].front && !results[2].front);
}

TEST(untimed) {
    static bench_result results[BENCH_METHODS_MAX];
    assert_int_equal(run_bench(0, results), 3);
    for (int i = 0; i < 3; i++)
        assert_true(isnan(results[i].ns) && isnan(results[i].spread) && isnan(results[i].limit) && !results[i].front);
}

TEST(statistics_by_hand) {
    static const struct {
        size_t count;
        double times[9], median, spread;
    } known[] = {
        {1, {7}, 7, 0},
        {2, {30, 10}, 20, 0.25},                         /* quartiles 15 and 25 */
        {3, {9, 1, 4}, 4, 0.5},                          /* 2.5 and 6.5 */
        {4, {8, 2, 16, 4}, 6, 6.5 / 2 / 6},              /* between 4 and 8; 3.5 and 10 */
        {5, {50, 10, 40, 20, 100}, 40, 0.375},           /* 20 and 50; the mean is 44 */
        {9, {1, 2, 3, 4, 5, 6, 7, 8, 1000}, 5, 0.4},     /* 3 and 7: an outlier changes nothing */
        {9, {1000, 9, 8, 7, 6, 5, 4, 3, 2}, 6, 1.0 / 3}, /* 4 and 8 */
        {6, {3, 3, 3, 3, 3, 3}, 3, 0},
    };
    tally t = {.name = "statistics"};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        double times[9];
        for (size_t k = 0; k < known[i].count; k++)
            times[k] = known[i].times[k];
        const bench_times got = bench_statistics(times, known[i].count);
        TALLY(&t, fabs(got.median - known[i].median) <= 1e-12 && fabs(got.spread - known[i].spread) <= 1e-12,
              "row %zu: median %g, spread %g", i, got.median, got.spread);
    }
    tally_end(&t);
}
