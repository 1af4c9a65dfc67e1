/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file axes.h  The frame of one panel: grid, ticks, labels, and the way from values to px. */
#ifndef DRAW_AXES_H
#define DRAW_AXES_H

#include "draw/canvas.h"
#include "draw/chart.h"
#include "draw/theme.h"
#include "draw/ticks.h"

/** The canvas, theme and fonts that every part of the drawing needs. */
typedef struct pencil {
    canvas *c;
    const theme *theme;
    double scale; /**< 1 at the size that figures are designed for, 800 x 500 px */
    canvas_font title, heading, text, small;
} pencil;

/** A panel in its place. */
typedef struct axes {
    const chart_axis *x, *y;
    canvas_rect frame; /**< px; the area between the axes */
} axes;

pencil pencil_make(canvas *c, const theme *t, double scale);

/** Where a value lies, px; far outside the frame for values off the axis, never infinite. */
double axes_x(const axes *a, double value);
double axes_y(const axes *a, double value);

/** Does a point lie in the frame, or on it? */
bool axes_holds(const axes *a, double x, double y);

/** How many tick labels fit along an axis. */
int axes_room_x(const pencil *p, double width);
int axes_room_y(const pencil *p, double height);

/** The widest label of an axis with room for so many, px. */
double axes_widest_label(const pencil *p, const chart_axis *axis, int room);

/** Grid lines: drawn below the data. */
void axes_draw_grid(const pencil *p, const axes *a);

/** Frame, ticks and their labels, drawn above the data; the labels of an axis only where asked for. */
void axes_draw_frame(const pencil *p, const axes *a, bool x_labels, bool y_labels);

/** A second vertical axis at the right side of a panel whose frame is drawn: ticks, and labels where asked for. */
void axes_draw_right(const pencil *p, const axes *a, bool labels);

/** A vertical axis at the right side of a strip (a colour bar): frame, ticks and labels to the right of it. */
void axes_draw_scale(const pencil *p, const axes *a);

#endif
