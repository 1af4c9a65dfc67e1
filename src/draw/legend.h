/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file legend.h  The legend: every listed series once, in columns, filled downwards. */
#ifndef DRAW_LEGEND_H
#define DRAW_LEGEND_H

#include "draw/axes.h"

enum { LEGEND_MAX = CHART_SERIES, LEGEND_TEXT = 2 * CHART_TEXT };

typedef struct legend {
    size_t count, columns, rows;
    const chart_series *entries[LEGEND_MAX];
    char text[LEGEND_MAX][LEGEND_TEXT];
    double column_width[LEGEND_MAX], width;
    bool arrows, ends; /**< last lines say what the arrows mean, and bars at the ends of curves */
} legend;

/** Arranges the legend in the given width. A series that comes in several panels under one name is listed once. */
legend legend_make(const pencil *p, const chart *c, double width);

/** Draws it from (x, y), its top left corner. @return the y below it */
double legend_draw(const pencil *p, const legend *l, double x, double y);

#endif
