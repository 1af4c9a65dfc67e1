/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file filter.h  Filters of shadow maps: how far from the point they read, which is all that a bias has to know. */
#ifndef SHADOW_FILTER_H
#define SHADOW_FILTER_H

#include <stdbool.h>

#include "core/named.h"

typedef struct shadow_filter {
    NAMED_FIELDS;
    const char *amount; /**< what its number is; "" where it has none */
    double least, most; /**< of the number; taps are whole */
    bool whole;
    double base, per;    /**< texel centres are read up to base + per times the number beside the point on each axis */
    const char *instead; /**< why no bias follows; "" where one does */
    double lost16, lost32; /**< of these: window depths that are closer are lost in its numbers of 16 and of 32 bits */
} shadow_filter;

NAMED_ROWS(shadow_filter, shadow_filter);

/** Texels on each axis; the filter is one of those of which a bias follows. */
static inline double shadow_filter_radius(const shadow_filter *filter, double number) {
    return filter->base + filter->per * number;
}

#endif
