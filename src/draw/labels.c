/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Names of points that stand close together: each goes where it hides least of the points and of the names before it.
 */
#include <math.h>

#include "draw/series.h"

enum { TAKEN_MAX = 256, LIFTS = 4 };

/* Where no label should be. */
typedef struct ground {
    const pencil *p;
    const axes *a;
    const chart_panel *panel;
    size_t count;
    canvas_rect taken[TAKEN_MAX]; /* points, and labels so far */
} ground;

static void occupy(ground *g, canvas_rect box) {
    if (g->count < TAKEN_MAX)
        g->taken[g->count++] = box;
}

static double overlap(canvas_rect a, canvas_rect b) {
    double w = fmin(a.x + a.w, b.x + b.w) - fmax(a.x, b.x), h = fmin(a.y + a.h, b.y + b.h) - fmax(a.y, b.y);
    return w > 0 && h > 0 ? w * h : 0;
}

/* The part of a box that a straight line crosses, along x and along y, px. */
static double crossed_by(canvas_rect box, double x0, double y0, double x1, double y1) {
    const double from = fmax(x0, box.x), to = fmin(x1, box.x + box.w), slope = x1 > x0 ? (y1 - y0) / (x1 - x0) : 0;
    const double a = y0 + slope * (from - x0), b = x1 > x0 ? y0 + slope * (to - x0) : y1;
    const double upper = fmax(fmin(a, b), box.y), lower = fmin(fmax(a, b), box.y + box.h);
    return from > to || upper > lower
               ? 0
               : fmin(to - from, slope != 0 ? (lower - upper) / fabs(slope) : to - from) + lower - upper;
}

static double crossed(const ground *g, canvas_rect box) {
    double length = 0;
    for (size_t s = 0; s < g->panel->series_count; s++) {
        const chart_series *line = &g->panel->series[s];
        const bool pairs = line->kind == CHART_LEVELS || line->kind == CHART_BARS;
        for (size_t i = 1; i < line->count && (pairs || line->kind == CHART_LINE); i += 1 + pairs)
            length += crossed_by(box, axes_x(g->a, line->x[i - 1]), axes_y(g->a, line->y[i - 1]),
                                 axes_x(g->a, line->x[i]), axes_y(g->a, line->y[i]));
    }
    return length;
}

/* The cost of a box: the points, labels and lines that it hides, and above all its own part beyond the frame. */
static double cost_of(const ground *g, canvas_rect box) {
    double cost = 10 * (box.w * box.h - overlap(box, g->a->frame)) + box.h / 2 * crossed(g, box);
    for (size_t i = 0; i < g->count; i++)
        cost += overlap(box, g->taken[i]);
    return cost;
}

static canvas_rect best_place(const ground *g, double x, double y, double width) {
    const canvas_rect frame = g->a->frame;
    const double high = 1.25 * g->p->small.size, gap = 8 * g->p->scale, inset = 4 * g->p->scale;
    canvas_rect best = {0, 0, 0, 0};
    double least = INFINITY;
    for (int line = 0; line <= 2 * LIFTS; line++) {
        double lift = (line + 1) / 2 * (line % 2 == 0 ? 1 : -1) * 0.75 * high;
        for (int side = 0; side < 2; side++) {
            const double left =
                side == 0 ? fmin(x + gap, frame.x + frame.w - inset - width) : fmax(x - gap - width, frame.x + inset);
            canvas_rect box = {left, y - high / 2 + lift, width, high};
            double cost = cost_of(g, box) + 0.3 * (fabs(lift) + side);
            if (cost < least) {
                best = box;
                least = cost;
            }
        }
    }
    return best;
}

static void draw_label(ground *g, double x, double y, const char *text) {
    const pencil *p = g->p;
    canvas_font font = p->small;
    font.colour = p->theme->text;
    font.halo = p->theme->background;
    const canvas_rect box = best_place(g, x, y, canvas_text_width(p->c, text, &font));
    const double middle = box.y + box.h / 2, end = box.x + box.w;
    const bool beside = end < x - 4 * p->scale || box.x > x + 4 * p->scale;
    occupy(g, box);
    if (fabs(middle - y) > box.h / 2) {
        canvas_pen thin = {.colour = p->theme->faint, .width = 0.7 * p->scale};
        canvas_segment(p->c, x, y, fmin(fmax(x, box.x), end),
                       beside       ? middle
                       : middle < y ? box.y + box.h
                                    : box.y,
                       &thin);
    }
    canvas_text(p->c, end < x ? end : box.x, middle + 0.36 * font.size, text, &font,
                end < x ? CANVAS_RIGHT : CANVAS_LEFT);
}

void labels_draw(const pencil *p, const axes *a, const chart_panel *panel) {
    ground g = {.p = p, .a = a, .panel = panel};
    const double half = 6 * p->scale;
    for (int pass = 0; pass < 2; pass++) /* first all points, then their labels */
        for (size_t s = 0; s < panel->series_count; s++) {
            const chart_series *points = &panel->series[s];
            for (size_t i = 0; i < points->count && points->kind == CHART_POINTS; i++) {
                const double x = axes_x(a, points->x[i]), y = axes_y(a, points->y[i]);
                if (!axes_holds(a, points->x[i], points->y[i]))
                    continue;
                if (pass == 0)
                    occupy(&g, (canvas_rect){x - half, y - half, 2 * half, 2 * half});
                else if (points->labels != NULL && !points->unwritten)
                    draw_label(&g, x, y, points->labels[i]);
            }
        }
}
