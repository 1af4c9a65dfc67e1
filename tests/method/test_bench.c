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
static double worse = 1;

/* The worst of each kind at an input of its own; what lies outside of the domain is worse and does not count. */
static bool judge(const method_call *call, size_t i, method_error *e) {
    const double scale = worse * (strcmp(call->row->name, "exact") == 0 ? 1e-3 : 1);
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
                                         .cases = {{"unorm24 d3d", "unorm24", DP_MAPPING_D3D, false}},
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

static size_t run_samples(double far, bench_result results[BENCH_METHODS_MAX]) {
    dp_setup setup;
    memset(runs, 0, sizeof runs);
    clock_ns = 1e9;
    assert_int_equal(method_setup(&family, 0, 0.1, far, false, &setup), DP_OK);
    return bench_run(&family, 0, &setup, repetitions, results);
}

static size_t run_bench(int count, bench_result results[BENCH_METHODS_MAX]) {
    rng r = rng_make("bench");
    repetitions = count;
    for (int c = 0; c < CONTESTANTS; c++)
        for (int i = 0; i < count; i++)
            samples[c][i] = floor(rng_log(&r, 5e5, 3e6) * (c == 1 ? 3 : c == 2 ? 2 : 1));
    return run_samples(1000, results);
}

TEST(leasts_and_quartiles) {
    static const int counts[] = {25, 8, 1};
    static bench_result results[BENCH_METHODS_MAX];
    for (size_t k = 0; k < sizeof counts / sizeof counts[0]; k++) {
        assert_int_equal(run_bench(counts[k], results), 3);
        for (int i = 0; i < 3; i++) {
            const double inputs = i == 2 ? 6 : INPUTS, least = sorted_at(i, 0);
            assert_int_equal(results[i].inputs, (size_t)inputs);
            assert_relative(results[i].ns, least / inputs, 1e-12);
            assert_scene(results[i].spread, (sorted_at(i, 1) - least) / least, 1e-12);
            assert_relative(results[i].limit, sorted_at(LIMIT, 0) / INPUTS, 1e-12);
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

/* Beyond far/near of 100 the second claims nothing. Errors are 8, .008 and 8 times `worse`, the claims 10, 4 and 12;
 * the third has 6 inputs, the others 10. Every turn but the first takes `more`. */
TEST(front_by_hand) {
    static const struct {
        double far, worse, more, ns[3];
        bool front[3];
    } known[] = {
        {5, 1, 1, {5e5, 9e5, 6e5}, {true, true, false}},       /* the third is slower, and no better */
        {5, 1, 1, {5e5, 5.4e5, 6e5}, {false, true, false}},    /* 8 % are as fast */
        {5, 1, 1, {5e5, 5.6e5, 6e5}, {true, true, false}},     /* 12 % are not, */
        {5, 1, 1.2, {5e5, 5.6e5, 6e5}, {false, true, false}},  /* unless turns differ as much, */
        {5, 1, 1.2, {5e5, 6.1e5, 9e5}, {true, true, false}},   /* but not more, */
        {5, 1, 1.9, {5e5, 6.4e5, 9e5}, {true, true, false}},   /* and never of 28 % */
        {5, 1, 1, {8.4e5, 2e6, 5e5}, {true, true, true}},      /* as fast and as exact */
        {1000, 1, 1, {5e5, 9e5, 6e5}, {true, false, false}},   /* without a claim, */
        {1000, 1, 1, {5e5, 5.4e5, 6e5}, {true, false, false}}, /* which beats none, either */
        {5, 10, 1, {5e5, 9e5, 6e5}, {false, true, false}},     /* claims that are broken */
        {1000, 1.4, 1, {5e5, 9e5, 9e5}, {false, false, true}}, /* a broken one beats none */
    };
    static bench_result results[BENCH_METHODS_MAX];
    for (size_t k = 0; k < sizeof known / sizeof known[0]; k++) {
        repetitions = REPETITIONS;
        worse = known[k].worse;
        for (int c = 0; c < CONTESTANTS; c++)
            for (int i = 0; i < REPETITIONS; i++)
                samples[c][i] = (c < 3 ? known[k].ns[c] : 5e5) * (i > 0 ? known[k].more : 1);
        assert_int_equal(run_samples(known[k].far, results), 3);
        worse = 1;
        for (int i = 0; i < 3; i++)
            if (results[i].front != known[k].front[i])
                fail_msg("row %zu: method %d is %son the front", k, i, results[i].front ? "" : "not ");
    }
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
        double times[9], least, spread;
    } known[] = {
        {1, {7}, 7, 0},
        {2, {30, 10}, 10, 0.5},                    /* the quartile is 15 */
        {3, {9, 1, 4}, 1, 1.5},                    /* 2.5 */
        {4, {8, 2, 16, 4}, 2, 0.75},               /* 3.5 */
        {5, {50, 10, 40, 20, 100}, 10, 1},         /* 20 */
        {9, {1, 2, 3, 4, 5, 6, 7, 8, 1000}, 1, 2}, /* 3: an outlier changes nothing */
        {6, {3, 3, 3, 3, 3, 3}, 3, 0},
    };
    tally t = {.name = "statistics"};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        double times[9];
        for (size_t k = 0; k < known[i].count; k++)
            times[k] = known[i].times[k];
        const bench_times got = bench_statistics(times, known[i].count);
        TALLY(&t, fabs(got.least - known[i].least) <= 1e-12 && fabs(got.spread - known[i].spread) <= 1e-12,
              "row %zu: least %g, spread %g", i, got.least, got.spread);
    }
    tally_end(&t);
}
