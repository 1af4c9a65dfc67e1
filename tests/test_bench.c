/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What bench says of timings: median and quartiles by hand, and that a method's time is the median of its turns. */
#include <time.h>

#include "method/bench.h"
#include "support.h"

static void statistics_by_hand(void **state) {
    (void)state;
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

/* Two methods, one of which waits: 40 us an input, in one turn of five 2 us. The waits are long against the clock. */
static size_t turns;

static void wait_ns(double ns) {
    struct timespec start, now;
    clock_gettime(CLOCK_MONOTONIC, &start);
    do
        clock_gettime(CLOCK_MONOTONIC, &now);
    while (1e9 * (double)(now.tv_sec - start.tv_sec) + (double)(now.tv_nsec - start.tv_nsec) < ns);
}

static void slow(const dp_setup *setup, const void *memory, const method_inputs *in, const method_outputs *out) {
    (void)setup, (void)memory;
    wait_ns((double)in->count * (turns++ % 5 == 4 ? 2e3 : 40e3));
    for (size_t i = 0; i < in->count; i++)
        out->eye[i] = 1;
}

static void quick(const dp_setup *setup, const void *memory, const method_inputs *in, const method_outputs *out) {
    (void)setup, (void)memory;
    for (size_t i = 0; i < in->count; i++)
        out->eye[i] = 1;
}

static bool judge(const method_row *row, const dp_setup *setup, const method_inputs *in, const method_outputs *out,
                  size_t i, method_error *error) {
    (void)setup, (void)in, (void)out, (void)i;
    *error = (method_error){row->run == slow ? 1 : 2, row->run == slow ? 0.1 : 0.2, row->run == slow ? 10 : 20};
    return true;
}

static void times_are_medians_of_turns(void **state) {
    (void)state;
    static const method_row rows[] = {
        {.family = METHOD_INTERVAL, .name = "slow", .claims = {FULL(1)}, .run = slow},
        {.family = METHOD_INTERVAL, .name = "quick", .claims = {FULL(1)}, .run = quick},
    };
    static const size_t row_count = 2;
    method_family_row family = *method_family_find("linearize");
    bench_result r[BENCH_METHODS_MAX];
    dp_setup setup;
    family.methods = rows;
    family.method_count = &row_count;
    family.inputs = 200; /* 200 x 40 us: longer than a turn is meant to last, so a turn is one run */
    family.judge = judge;
    family.limit = quick;
    assert_int_equal(method_setup(&family, 0, 0.1, 1000, false, &setup), DP_OK);
    turns = 0;
    assert_int_equal(bench_run(&family, 0, &setup, 25, r), 2);
    assert_true(turns >= 27);
    /* The least is 2 us, the mean 32.4 us, the median 40 us; a busy machine only adds. */
    assert_true(r[0].ns >= 40e3 && r[1].ns < 1e3 && r[1].ns > 0);
    assert_true(r[0].limit == r[1].limit && r[0].limit > 0 && r[0].limit < 1e3);
    assert_true(r[0].front && r[1].front); /* slower, but more exact; quicker, but worse */
    assert_true(r[0].measured.worst.absolute == 1 && r[1].measured.worst.absolute == 2);
    assert_true(r[0].measured.worst.relative == 0.1 && r[0].measured.worst.ulp == 10);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(statistics_by_hand),
        cmocka_unit_test(times_are_medians_of_turns),
    };
    return run_tap(tests);
}
