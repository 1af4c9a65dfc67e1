/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file units.h  What 1 in a sample may be, where nobody says it: the units of data sheets whose depths the samples
 * would be, each with the depths that it makes of them. There are always two at least, because a range alone proves
 * none.
 */
#ifndef TEXTURE_UNITS_H
#define TEXTURE_UNITS_H

#include "image/image.h"

enum { UNITS_MAX = 3, UNITS_TEXT_SIZE = 200 };

typedef struct unit_reading {
    const char *option; /**< "--metric mm" */
    double lo, hi;      /**< metres */
} unit_reading;

/**
 * Whether samples can be nothing but metric depth of one unit, where nobody says what they are: numbers above 1 and
 * none below 0 of a channel that is called depth, or that all are multiples of a part of a metre; and whole numbers of
 * 16 bits with holes that lie on the levels of a sensor that is known in one unit, and in no other.
 * @param why  what shows it
 * @return the unit of 1 in a sample, as --metric takes it; null: not so
 */
const char *units_guess(const image *img, const char **why);

/** Reads the samples above 0 in each unit. @return how many readings, 0 where there is no sample */
size_t units_find(const image *img, unit_reading out[UNITS_MAX]);

/** "--metric mm reads 0.41 m to 9.8 m, --metric tum ..."; "" of none. @return out */
const char *units_say(const image *img, char out[UNITS_TEXT_SIZE]);

#endif
