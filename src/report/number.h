/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file number.h  Numbers in and out, in the C locale whatever the environment says (setlocale is never called). */
#ifndef REPORT_NUMBER_H
#define REPORT_NUMBER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/** The room that number_shortest() needs, with the terminating null. */
enum { NUMBER_SIZE = 32 };

/** The numbers that number_parse() accepts. */
typedef enum number_kind {
    NUMBER_FINITE, /**< a finite decimal (or C99 hexadecimal) number */
    NUMBER_FAR     /**< the same, and inf or infinity in any case */
} number_kind;

/**
 * Reads a number that must be the whole text: no space, no rest, no nan, no overflow (1e400), no underflow to zero.
 * @return true and *out, or false and *out is left as it was
 */
bool number_parse(const char *text, number_kind kind, double *out);

/** The same for the `length` characters at text. */
bool number_parse_part(const char *text, size_t length, number_kind kind, double *out);

/** Reads a whole number of decimal digits, nothing else, at most `max`. */
bool number_parse_count(const char *text, uint64_t max, uint64_t *out);

/** A whole number. @return length */
size_t number_count(uint64_t value, char out[NUMBER_SIZE]);

/** The shortest text that reads back to the same double, by %.15g, %.16g, %.17g; "inf" for INFINITY. @return length */
size_t number_shortest(double value, char out[NUMBER_SIZE]);

/**
 * The same the quick way: a million table rows hold ten million numbers, and printf with strtod takes most of a
 * microsecond for each.
 *
 * @return the length, or 0 when the quick arithmetic cannot tell (about one number in ten, and whatever lies outside
 *         [1e-38, 1e17)): then printf and strtod must
 */
size_t number_quick(double value, char out[NUMBER_SIZE]);

/** A number on its way into a sentence: printf("%s", number_of(z, 6).text). Lives until the statement ends. */
typedef struct number_text {
    char text[NUMBER_SIZE];
} number_text;

/** Significant digits, "inf" for INFINITY, "-" for NaN. */
number_text number_of(double value, int digits);

/** A length: the unit behind the number where both are known, "50 m". */
number_text number_in(number_text number, const char *unit);

/** The same rounded up, or down: what is read back is never below, or above, the value. */
number_text number_up(double value, int digits);
number_text number_down(double value, int digits);

/** The same away from 0: of a bias that suffices, whose sign says which way it moves. */
number_text number_outward(double value, int digits);

/** Two numbers that a sentence compares, rounded up to so many digits or as many more as it takes to see which is
 * greater: "0.009002786" and "0.009002791". */
typedef struct number_two {
    number_text value, limit;
} number_two;
number_two number_compared(double value, double limit, int digits);

/** The same number in fewer characters: 82800 for 8.28e+04, 1.2e-7 for 1.2e-07. */
number_text number_brief(number_text number);

/** The digits that it takes to see that a value near `at` is off by `step`, with two digits of the step. */
int number_digits_within(double at, double step, int least, int most);

/** The text of number_shortest(). */
number_text number_full(double value);

#endif
