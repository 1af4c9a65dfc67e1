/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file sensor_fit.h  For sensor_sample.c and sensor_choice.c: the lattice offset + k step that values lie on, whose
 * own rounding is known.
 *
 * A comb is tried at every frequency on a few windows of neighbouring values; what stands out is extended, window by
 * window, to all of them. depthprec(7) has what a fit proves.
 */
#ifndef TEXTURE_SENSOR_FIT_H
#define TEXTURE_SENSOR_FIT_H

#include <stdbool.h>
#include <stddef.h>

/** A lattice counts as found when fewer than 2^-FIT_BITS random sets of values fit as well, fewer than 2^-FIT_WHOLE
 * were its step half as large, and so many levels. */
enum { FIT_BITS = 32, FIT_WHOLE = 20, FIT_LEVELS = 24 };

/** A value whose true one lies within `off` of it, and how many pixels have it. */
typedef struct fit_value {
    double at, off, pixels;
} fit_value;

typedef struct fit {
    double step, offset;         /**< of k = 0; within half a step of 0 */
    double step_off, offset_off; /**< every lattice that explains the same values is within so much */
    size_t levels;               /**< different k of values that can tell: off by less than a sixth */
    double pixels;               /**< of the values on it */
    double whole;                /**< -log2 of the chance that so many of them are on it, if half its step is true */
    double bits;                 /**< -log2 of the chance that some lattice as coarse or coarser fits values at random
                                      as well */
} fit;

bool fit_explains(const fit *f);

/** Whether the value is on the lattice, as far as its rounding tells. */
bool fit_holds(const fit *f, const fit_value *value);

/**
 * -log2 of a bound of the chance that `on` or more of `count` independent events of these probabilities happen:
 * Chernoff's. Those of 1 or more count as certain.
 */
double fit_chance(const double *probabilities, size_t count, size_t on);

/** The lattice that says most. @param values  by `at`, upwards, all different @return false when none extends to all */
bool fit_find(const fit_value *values, size_t count, fit *out);

/** Sets step_off and offset_off: a bound over every lattice that explains the same values by the same levels. */
void fit_bound(const fit_value *values, size_t count, fit *f);

#endif
