/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file support.h  What every test program shares: comparisons with units, seeded numbers, effort, text vectors.
 *
 * Environment:
 *     DEPTHPREC_SEED   seed of the random tests, decimal or 0x..., or "time"; else SEED; a fixed one if neither is set
 *     DEPTHPREC_QUICK  nonempty: far fewer cases (for sanitizers)
 *     DEPTHPREC_FULL   nonempty: all cases, minutes
 *     DEPTHPREC_VECTORS  folder of the vector files, tests/vectors if not set
 *     DEPTHPREC_RECORDING  folder of what rasterizers stored, tests/recording if not set
 */
#ifndef TESTS_SUPPORT_H
#define TESTS_SUPPORT_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "depthprec/depthprec.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* The macros of math.h are floats; clang warns wherever they become doubles. */
#undef INFINITY
#undef NAN
#define INFINITY ((double)__builtin_inff())
#define NAN      ((double)__builtin_nanf(""))

/** Numbers of a test: splitmix64, one independent stream per name. */
typedef struct rng {
    uint64_t state;
} rng;

/** The stream of a name under the seed of this run; the first call prints "# seed ...". */
rng rng_make(const char *name);
uint64_t rng_next(rng *r);
uint64_t rng_below(rng *r, uint64_t count); /**< 0 .. count-1 */
double rng_unit(rng *r);                    /**< [0, 1) */
double rng_uniform(rng *r, double lo, double hi);
double rng_log(rng *r, double lo, double hi); /**< log-uniform in [lo, hi], both positive */

/** A depth range of a viewport: round numbers, slices next to 0, 1 or powers of two, of either order. */
void rng_range(rng *r, double range[2]);

/** The largest far plane of such a near plane, mapping and constant. */
double most_far(const dp_spec *spec);

/** Planes of an orthographic camera, near <= 0: near 0, far 0, both behind the camera, and 0 between them. */
void rng_planes(rng *r, double *znear, double *zfar);
/** A depth of such planes: next to either, next to 0, or anywhere. */
double rng_depth(rng *r, double znear, double zfar);

typedef enum effort { EFFORT_QUICK = 0, EFFORT_CHECK, EFFORT_FULL } effort;
effort test_effort(void);
/** One of three numbers of cases, by effort. `full` is at most 4 times `check`, so that a whole run ends; or
 * DEPTHPREC_FULL times it where that is more than 1. */
uint64_t test_cases(uint64_t quick, uint64_t check, uint64_t full);

/**
 * Counts cases and keeps the first failure: a test of a million cases prints one reproducer, not a million.
 * Make one with {"name"}; tally_end() fails the test when any case failed, or when there was none.
 */
typedef struct tally {
    const char *name;
    uint64_t cases, failures, skipped;
    char first[1024];
} tally;

#define TALLY(t, ok, ...)                                                                                              \
    do {                                                                                                               \
        (t)->cases++;                                                                                                  \
        if (!(ok))                                                                                                     \
            tally_fail((t), __VA_ARGS__);                                                                              \
    } while (0)

void tally_fail(tally *t, const char *format, ...) __attribute__((format(printf, 2, 3)));
#define tally_end(t) tally_end_at((t), __FILE__, __LINE__)
void tally_end_at(const tally *t, const char *file, int line);

/* Comparisons, each named after its unit. */
#define assert_codes(got, want)           assert_codes_at((got), (want), #got, __FILE__, __LINE__)
#define assert_ulp(got, want, ulps)       assert_ulp_at((got), (want), (ulps), #got, __FILE__, __LINE__)
#define assert_relative(got, want, bound) assert_relative_at((got), (want), (bound), #got, __FILE__, __LINE__)
#define assert_scene(got, want, bound)    assert_scene_at((got), (want), (bound), #got, __FILE__, __LINE__)
void assert_codes_at(uint32_t got, uint32_t want, const char *what, const char *file, int line);
void assert_ulp_at(double got, double want, double ulps, const char *what, const char *file, int line);
void assert_relative_at(double got, double want, double bound, const char *what, const char *file, int line);
/** |got - want| <= bound, all three in scene units (or any other unit that the three share). */
void assert_scene_at(double got, double want, double bound, const char *what, const char *file, int line);

/** The distance of two doubles in units of the last place of the larger; 0 when equal, INFINITY when only one is
 * finite. */
double ulp_distance(double a, double b);

enum { VECTOR_FIELDS = 20 };

/** One row of a vector file: fields separated by blanks. */
typedef struct vector_row {
    const char *file;
    int line;
    int count;
    char *field[VECTOR_FIELDS];
} vector_row;

/**
 * Calls visit for every row of a vector file; '#' begins a comment, empty lines are skipped.
 * Fails the test when the file cannot be read or has no row.
 */
void vectors_read(const char *file, void (*visit)(const vector_row *row, void *context), void *context);
/** A field as a number; fails the test, naming file and line, when it is not one. */
double vector_number(const vector_row *row, int index);
const char *vector_text(const vector_row *row, int index);

/**
 * A test: TEST(name) { ... }. Those of a program run in the order in which they are written, and print TAP; LIST_TEST()
 * adds a function that stands elsewhere. A program that has more to do has a main(), which calls run_listed().
 */
#define TEST(name)                                                                                                     \
    static void name(void **state);                                                                                    \
    LIST_TEST(name)                                                                                                    \
    static void name(void **state __attribute__((unused)))
#define LIST_TEST(name)                                                                                                \
    static void __attribute__((constructor)) name##_listed(void) {                                                     \
        list_test((struct CMUnitTest)cmocka_unit_test(name));                                                          \
    }
void list_test(struct CMUnitTest test);

/** Runs them between two functions of cmocka's, or none. @return the exit status */
int run_listed(CMFixtureFunction before, CMFixtureFunction after);

#endif
