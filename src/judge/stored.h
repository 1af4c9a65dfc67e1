/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file stored.h  What values become where they are stored in fewer bits: all that may have come of a span of them. */
#ifndef JUDGE_STORED_H
#define JUDGE_STORED_H

#include <stdbool.h>

/** Ways in which digits are written into bytes and read back, the commonest first: 2 to 4 digits; bytes rounded or cut;
 * digits of 256 or 255, read as of 256 or 255; k stored as k/255 or k/256; read as it is, or times 255/256; the last of
 * them the rest, a whole digit, or the rest less its 256th part. */
enum { STORED_DIGITS = 3 * 2 * 2 * 2 * 2 * 2 * 3 };

/** Quotients, from the bits of what is divided by and so many Newton steps, from 1. */
enum { STORED_STEPS = 2 };

/** Numbers of binary16, rounded to either side; below 2^-14 also flushed to 0. */
void stored_half(double *lo, double *hi);
/** Shares of 255, rounded to nearest, or cut. */
void stored_bytes(bool cut, double *lo, double *hi);
/** Numbers from 0 to 1, both ends of the span and its middle. */
void stored_digits(int way, double *lo, double *hi);
void stored_quotient(int steps, double *lo, double *hi);
/** Whether a value that was not stored that way does not fit it. Ways that lose nothing, or whose bytes are halfway
 * between two throughout, tell nothing. */
bool stored_digits_lose(int way);
/** "digits k/256 in bytes n/255" */
const char *stored_digits_name(int way);

#endif
