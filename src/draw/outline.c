/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The shapes of a canvas that are paths, whatever draws them: cairo, or SVG written by src/web. */
#include "draw/canvas.h"

void canvas_path_segment(canvas *c, double x0, double y0, double x1, double y1) {
    canvas_path_break(c);
    canvas_path_to(c, x0, y0);
    canvas_path_to(c, x1, y1);
}

static void outline(canvas *c, const canvas_point *points, size_t count) {
    for (size_t i = 0; i < count; i++)
        canvas_path_to(c, points[i].x, points[i].y);
}

void canvas_polygon(canvas *c, const canvas_point *points, size_t count, canvas_colour colour) {
    outline(c, points, count);
    canvas_path_fill(c, colour);
}

void canvas_line(canvas *c, const canvas_point *points, size_t count, const canvas_pen *pen) {
    outline(c, points, count);
    canvas_path_end(c, pen);
}

void canvas_segment(canvas *c, double x0, double y0, double x1, double y1, const canvas_pen *pen) {
    canvas_line(c, (canvas_point[]){{x0, y0}, {x1, y1}}, 2, pen);
}
