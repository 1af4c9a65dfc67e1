/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "draw/trace.h"

#include <math.h>

static void emit(trace *t, canvas_point p) {
    canvas_path_to(t->c, p.x, p.y);
}

static void anchor_at(trace *t, canvas_point p) {
    emit(t, p);
    t->anchored = true;
    t->anchor = t->end = p;
    t->slope_lo = -INFINITY;
    t->slope_hi = INFINITY;
}

/* The slopes from the anchor that pass all points so far within the tolerance form an interval. A point whose own
 * slope lies in it can be the new end; else the old end becomes a corner. */
static void stretch(trace *t, canvas_point p) {
    if (!t->anchored) {
        t->begin = p;
        anchor_at(t, p);
        return;
    }
    double dx = p.x - t->anchor.x, slope = (p.y - t->anchor.y) / dx;
    if (!(dx > 0) || !(slope >= t->slope_lo && slope <= t->slope_hi)) {
        if (t->end.x != t->anchor.x || t->end.y != t->anchor.y)
            anchor_at(t, t->end);
        dx = p.x - t->anchor.x;
        if (!(dx > 0)) {
            anchor_at(t, p);
            return;
        }
    }
    t->end = p;
    t->slope_lo = fmax(t->slope_lo, (p.y - TRACE_TOLERANCE - t->anchor.y) / dx);
    t->slope_hi = fmin(t->slope_hi, (p.y + TRACE_TOLERANCE - t->anchor.y) / dx);
}

static void close_column(trace *t) {
    if (!t->column_open)
        return;
    t->column_open = false;
    stretch(t, t->first);
    bool least_first = t->least.x <= t->greatest.x;
    canvas_point between[2] = {least_first ? t->least : t->greatest, least_first ? t->greatest : t->least};
    for (int i = 0; i < 2; i++)
        if (between[i].x > t->first.x && between[i].x < t->last.x)
            stretch(t, between[i]);
    if (t->last.x > t->first.x || t->last.y != t->first.y)
        stretch(t, t->last);
}

void trace_point(trace *t, double x, double y) {
    canvas_point p = {x, y};
    if (t->column_open && floor(x) != floor(t->first.x))
        close_column(t);
    if (!t->column_open) {
        t->column_open = true;
        t->first = t->least = t->greatest = p;
    }
    if (y < t->least.y)
        t->least = p;
    if (y > t->greatest.y)
        t->greatest = p;
    t->last = p;
}

void trace_break(trace *t) {
    close_column(t);
    if (t->anchored)
        emit(t, t->end);
    t->anchored = false;
    canvas_path_break(t->c);
}

void trace_fill(trace *t, double bottom, canvas_colour colour) {
    close_column(t);
    if (t->anchored) {
        emit(t, t->end);
        emit(t, (canvas_point){t->end.x, bottom});
        emit(t, (canvas_point){t->begin.x, bottom});
    }
    canvas_path_fill(t->c, colour);
}

void trace_finish(trace *t, const canvas_pen *pen) {
    trace_break(t);
    canvas_path_end(t->c, pen);
}
