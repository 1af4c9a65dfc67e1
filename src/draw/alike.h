/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file alike.h  Curves, or points, that lie on each other, so that the legend can say what no eye sees. */
#ifndef DRAW_ALIKE_H
#define DRAW_ALIKE_H

#include "draw/chart.h"

/** Another curve, which hides this one. */
typedef struct alike {
    const chart_series *other; /**< null: none does */
    double from, to;           /**< where along x; NaN for the end of the curve, one at least */
} alike;

/**
 * The listed line behind line `index` of a panel with fitted axes, so drawn over it, that lies within half a stroke of
 * it: everywhere, or along half of the axis at least, the longest first. Of points likewise, but only where all are
 * alike.
 */
alike alike_find(const chart_panel *panel, size_t index);

#endif
