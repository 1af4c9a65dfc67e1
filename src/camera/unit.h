/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file unit.h  Units of length: what a number with one behind it is in scene units. */
#ifndef CAMERA_UNIT_H
#define CAMERA_UNIT_H

#include <stddef.h>

#include "core/named.h"

typedef struct unit_row {
    NAMED_FIELDS;
    double nanometres; /**< in one; a whole number */
} unit_row;

/** The names, for messages. */
#define UNIT_NAMES "nm, um, mm, cm, m, km, in or ft"

/** The rows, the shortest first; null beyond the last. */
extern const named_table unit_table;
static inline const unit_row *unit_get(size_t index) {
    return named_at(&unit_table, index);
}

/** The row of that name, letter by letter: m is never milli, nor is M a metre. @return null when there is none */
const unit_row *unit_find(const char *name);

/**
 * A length in another unit: one rounding wherever one unit is a whole number of the other, else two. As it is where a
 * unit is null: not known.
 */
double unit_convert(double value, const unit_row *from, const unit_row *to);

#endif
