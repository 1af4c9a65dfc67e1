/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file timing.h  What benchmarks measure with. What is compared takes turns, and of each the least counts: whatever
 * else a machine does only adds.
 */
#ifndef TESTS_TIMING_H
#define TESTS_TIMING_H

enum { TIMING_MAX = 256 };

typedef struct timing {
    double sample[TIMING_MAX];
    int count;
} timing;

/** Seconds, of the clock on the wall; of this process, on all cores; of this thread, which no other process adds to. */
double timing_now(void);
double timing_cpu(void);
double timing_thread(void);

/** Takes a sample; what is more than TIMING_MAX is dropped. */
void timing_add(timing *t, double seconds);

/** NaN without samples. */
double timing_least(const timing *t);

/** Largest over smallest of the middle nine tenths. */
double timing_spread(const timing *t);

#endif
