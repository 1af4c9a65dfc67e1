/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file trace.h  Thins a curve on its way to the canvas without a visible change.
 *
 * First to the first, least, greatest and last point of each pixel column, so that a million points cost no more than
 * the picture is wide; then to the corners of a polyline that stays within TRACE_TOLERANCE of every point left.
 * x must not decrease.
 */
#ifndef DRAW_TRACE_H
#define DRAW_TRACE_H

#include "draw/canvas.h"

#define TRACE_TOLERANCE 0.1 /* px */

/** Begins as {.c = canvas}; the rest is private to trace.c. */
typedef struct trace {
    canvas *c;
    bool column_open; /* the pixel column being gathered */
    canvas_point first, least, greatest, last;
    bool anchored; /* the segment being stretched */
    canvas_point begin, anchor, end;
    double slope_lo, slope_hi;
} trace;

void trace_point(trace *t, double x, double y);
void trace_break(trace *t);

/** Fills between what was traced, in one piece, and the horizontal at y = bottom. */
void trace_fill(trace *t, double bottom, canvas_colour colour);

/** Draws what was traced. */
void trace_finish(trace *t, const canvas_pen *pen);

#endif
