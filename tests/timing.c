/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "timing.h"

#include <math.h>
#include <stdlib.h>
#include <time.h>

static double of_clock(clockid_t clock) {
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

double timing_now(void) {
    return of_clock(CLOCK_MONOTONIC);
}

double timing_cpu(void) {
    return of_clock(CLOCK_PROCESS_CPUTIME_ID);
}

double timing_thread(void) {
    return of_clock(CLOCK_THREAD_CPUTIME_ID);
}

void timing_add(timing *t, double seconds) {
    if (t->count < TIMING_MAX)
        t->sample[t->count++] = seconds;
}

double timing_least(const timing *t) {
    double least = (double)NAN;
    for (int i = 0; i < t->count; i++)
        least = fmin(least, t->sample[i]);
    return least;
}

static int ascending(const void *a, const void *b) {
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

double timing_spread(const timing *t) {
    timing sorted = *t;
    const int cut = t->count / 20;
    if (t->count == 0)
        return (double)NAN;
    qsort(sorted.sample, (size_t)t->count, sizeof sorted.sample[0], ascending);
    return sorted.sample[t->count - 1 - cut] / sorted.sample[cut];
}
