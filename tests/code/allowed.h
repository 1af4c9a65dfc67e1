/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file allowed.h  What languages allow their operations to give, written down apart from src/code/language.c; and
 * functions that are printed, read back from their text and computed that way.
 */
#ifndef TESTS_ALLOWED_H
#define TESTS_ALLOWED_H

#include "support.h"

/** The numbers that a language may make of an exact one: a binary32 number within so many units in the last place. */
typedef struct device {
    rng *r;
    double sums, quotients; /**< ulp; 0.5: to nearest */
    bool fuses, flushes;
    int bias; /**< -1, 1: always down, or up, as far as that goes; 0: any; 2: as far as that goes, either way */
} device;

float flushed(const device *v, float x);
float rounded(const device *v, long double x, double ulps);
/** Within an absolute error. */
float within(const device *v, long double x, long double most);

/** The promises of each language. */
typedef struct promise {
    const char *name;
    double sums, quotients;
    bool fuses, flushes;
} promise;
enum { PROMISES = 6 };
extern const promise promises[PROMISES];

/** The errors of exp2 and log2 that a language allows: relative, that for each unit of |x|, and absolute from 0.5 to 2;
 * of those that say something. */
typedef struct promised_powers {
    double exp2, each, log2, inside;
} promised_powers;
enum { POWERS = 4 };
extern const promised_powers powers[POWERS];

/** Which fuses and rounds in turn as language p lets it. */
device device_of(rng *r, size_t p, int i);

/** The function of that name in a printed text of language p. Fails the test where the text is not understood.
 * @param given  its parameters, in order; uniforms are none
 * @return how many numbers it gave */
int printed_compute(const char *text, const char *name, size_t p, const device *v, const float *given, double out[4]);

#endif
