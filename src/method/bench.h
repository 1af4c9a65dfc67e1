/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file bench.h  All methods of a family on the same inputs: how fast, and how wrong at worst.
 *
 * The errors depend on the set-up alone, also those of a model of an instruction (`timed`); only the times vary.
 */
#ifndef METHOD_BENCH_H
#define METHOD_BENCH_H

#include "method/method.h"

enum { BENCH_METHODS_MAX = 32, BENCH_REPETITIONS = 25 };

/** The worst of each kind over all inputs, and the index of an input that reaches it. */
typedef struct measured {
    size_t count; /**< inputs inside the method's domain */
    method_error worst;
    size_t absolute_at, relative_at, ulp_at;
} measured;

/** The error in the family's measure. */
double measured_error(const method_family_row *family, const measured *m);

/** Runs a method once over inputs and judges every answer. @return false when out of memory */
bool method_measure(const method_family_row *family, const method_row *row, const dp_setup *setup,
                    const method_inputs *in, const method_outputs *out, measured *m);

typedef struct bench_result {
    const method_row *row;
    size_t inputs; /**< how many of the shared inputs it was given: the first of them */
    double ns;     /**< the least of the repetitions, an element; NaN when not timed */
    double spread; /**< of the repetitions: bench_times */
    double limit;  /**< ns of a loop that moves the same bytes, in turns with the methods: what none can beat */
    double setup;  /**< ns to prepare a set-up, once; 0 where there is nothing to prepare */
    measured measured;
    double at_absolute, at_relative, at_ulp; /**< the inputs that reach the worst: eye or window depths */
    double claim;                            /**< for this set-up; NaN where the row claims nothing of it */
    double bound;                            /**< for this set-up; NaN where nothing is proven of it */
    /** It keeps its claim, and no other that does, with the same reference, is both faster and more exact. Two are as
     *  fast within 10 %, or within their spread where that is more, up to 25 %; of these the more exact one is. */
    bool front;
} bench_result;

/** The statistics of timings. */
typedef struct bench_times {
    double least; /**< what the machine takes when nothing disturbs it; the timings' unit */
    double
        spread; /**< how far the lower quartile lies above it, as a share of it: a quarter of the timings are nearer */
} bench_times;

/** Sorts `count` >= 1 timings above 0; a quartile lies between two by its share of the distance. */
bench_times bench_statistics(double *times, size_t count);

/** The claim of a row for a set-up of a case; NaN where it makes none. */
double method_claimed(const method_row *row, size_t which, const dp_setup *setup);

/** The error proven of a row for this very set-up, in the family's measure (bound.h); NaN where nothing is. */
double method_bound(const method_row *row, const dp_setup *setup);

/**
 * @param repetitions  of the timing, interleaved; 0 leaves the times NaN and marks no front
 * @return how many methods this processor has, or 0 when out of memory
 */
size_t bench_run(const method_family_row *family, size_t which, const dp_setup *setup, int repetitions,
                 bench_result results[BENCH_METHODS_MAX]);

#endif
