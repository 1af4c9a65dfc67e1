/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file series.h  Draws one series of a panel, and its swatch in the legend: a row of functions per kind. */
#ifndef DRAW_SERIES_H
#define DRAW_SERIES_H

#include "draw/axes.h"

/** Draws series `index` of a panel: their markers are staggered, so that equal curves show. */
void series_draw(const pencil *p, const axes *a, const chart_panel *panel, size_t index);

/** A sample `width` px wide, centred at height y. */
void series_swatch(const pencil *p, const chart_series *s, double x, double y, double width);

/** Draws the labels of all points of a panel: beside them, or a little away with a line to the point. labels.c */
void labels_draw(const pencil *p, const axes *a, const chart_panel *panel);

/** The arrow that ends a curve where its value grows without bound; its tip is at (x, y). */
void series_arrow(const pencil *p, double x, double y, canvas_colour colour);

/** The bar across (x, y) at which a curve ends: see chart_series.certain_to. */
void series_end(const pencil *p, double x, double y, canvas_colour colour);

#endif
