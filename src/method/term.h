/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file term.h  What is known of a number that a few floating-point operations give: between which bounds the exact one
 * lies, how far from it the computed one may be, both absolutely and as a share, and of which power of two it is a
 * multiple. Each operation takes terms to a term; all ends are rounded outward.
 *
 * The two ways to count an error are two bounds of one quantity. Neither follows from the other: a sum that cancels
 * keeps what is absolute, a quotient what is relative; after each operation either is cut by the other.
 */
#ifndef METHOD_TERM_H
#define METHOD_TERM_H

#include <stdbool.h>

typedef struct range {
    double lo, hi;
} range;

typedef struct term {
    range exact; /**< what real arithmetic has in this place */
    range off;   /**< the computed number less that */
    range share; /**< the same, divided by the exact number; without end where that may be 0 */
    int grid;    /**< the computed number is a multiple of 2^grid */
} term;

/** Significant bits of the formats that are computed in. */
enum { TERM_SINGLE = 24, TERM_DOUBLE = 53 };

/** A constant that is formed in double, off by that share of itself at most, and then rounded to `bits`. */
term term_constant(double value, double share, int bits);
/** A number that is there exactly; and one in double that stands for value + rest. */
term term_exact(double value);
term term_apart(double value, double rest);
/** One that is off by at most that share of what it stands for. */
term term_within(range exact, range share);
/** Any of binary32's numbers from lo to hi, each as it is. */
term term_any(float lo, float hi);

/** The operations, before they are rounded; `exact` is what the exact result is known to be, and never wider than what
 *  the operands alone say. */
term term_sum(const term *a, const term *b, range exact);
term term_product(const term *a, const term *b);
term term_quotient(const term *a, const term *b, range exact);
/** Multiplied by 1 + s, for an s in `by`. */
term term_scaled(const term *a, range by);
/** Rounded to binary32 or binary64: off by at most `halves` half units in the last place, 1 for to nearest. Up to 2
 * what fits is not rounded. A result below 2^-126 may become 0 where that `flushes`. */
term term_rounded(const term *a, int bits, double halves, bool flushes);

/** Arithmetic of ranges, rounded outward. */
range range_outward(double lo, double hi);
range range_sum(range a, range b);
range range_product(range a, range b);
range range_quotient(range a, range b); /**< b without 0 */

#endif
