/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file ticks.h  Where an axis has ticks, and what they say. Knows nothing of pixels but the room it is given. */
#ifndef DRAW_TICKS_H
#define DRAW_TICKS_H

#include <stdbool.h>
#include <stddef.h>

#include "draw/chart.h"

enum { TICKS_MAX = 128, TICKS_TEXT = 48 };

typedef struct tick {
    double at;
    char text[TICKS_TEXT]; /**< "" for a minor tick */
} tick;

typedef struct ticks {
    size_t count;
    tick items[TICKS_MAX];
} ticks;

/**
 * Ticks in [lo, hi], in growing order.
 *
 * @param room  about this many labelled ticks, 2 or more; at most two above it
 *
 * A log axis has labels at every decade, or at every second, third, ... when there are too many, and minor ticks in
 * between; where it spans less than two decades also at 2 and 5, or at even steps when it spans less than that.
 * A linear axis has steps of 1, 2 or 5 times a power of ten. Powers of ten are written plainly from 0.001 to 10000
 * and as 10 with a superscript when the axis leaves that range.
 */
void ticks_make(const chart_axis *axis, int room, ticks *out);

/** Writes a value as tick labels are written, to three digits. */
void ticks_label(double value, bool powers, char out[TICKS_TEXT]);

/** Writes a place on an axis, rounded to three digits. */
void ticks_about(double value, char out[TICKS_TEXT]);

#endif
