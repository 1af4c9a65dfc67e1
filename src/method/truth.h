/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file truth.h  What the methods are judged by where the engine itself is a method: the definition, in long double.
 */
#ifndef METHOD_TRUTH_H
#define METHOD_TRUTH_H

#include "method/method.h"

/**
 * The width of a code's cell for perspective and orthographic mappings, from the two rounding boundaries around its
 * value; INFINITY for the last one of an infinite far plane. *cut tells whether a plane cuts the cell.
 */
double truth_width(const dp_setup *setup, uint32_t code, bool *cut);

/** The widest of the codes from first to last: of up to 2^17 each, of more those at the ends of what has one step, for
 *  between these widths of codes in a row only grow, or only shrink. */
double truth_worst(const dp_setup *setup, uint32_t first, uint32_t last);

/**
 * The depths next to z that its interval in the binary32 pipeline is looked for in: eight guaranteed separations to
 * either side, from 2^12 to 2^15 binary32 depths each, within the planes.
 * @return whether they are eight, and not fewer for the 2^15
 */
bool truth_window(const dp_setup *setup, double z, double *lo, double *hi);

/** The longest interval of the pipeline with both ends in [lo, hi], or `least` where none is as long: a plain scan. */
double truth_longest(const dp_setup *setup, double lo, double hi, double least);

/** One step of binary32 at z. */
double truth_step(double z);

/** How far an answer is off: absolute, relative and in steps of its type; all INFINITY if it is NaN. */
method_error truth_off(double got, double want, double step);

/** The same of a width in double; INFINITY on the side of it where the row's domain says that it never is. */
method_error truth_error(const method_row *row, double got, double want);

#endif
