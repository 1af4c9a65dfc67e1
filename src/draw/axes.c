/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "draw/axes.h"

#include <math.h>

#define TICK_LENGTH  5.0
#define MINOR_LENGTH 3.0
#define LABEL_GAP    4.0

pencil pencil_make(canvas *c, const theme *t, double scale) {
    const canvas_colour none = {0, 0, 0, 0};
    return (pencil){
        .c = c,
        .theme = t,
        .scale = scale,
        .title = {17 * scale, true, t->text, none},
        .heading = {13 * scale, true, t->text, none},
        .text = {13 * scale, false, t->text, none},
        .small = {12 * scale, false, t->faint, none},
    };
}

static double within(double share) {
    return fmin(fmax(share, -20), 20);
}

double axes_x(const axes *a, double value) {
    return a->frame.x + within(chart_axis_share(a->x, value)) * a->frame.w;
}

double axes_y(const axes *a, double value) {
    return a->frame.y + (1 - within(chart_axis_share(a->y, value))) * a->frame.h;
}

static bool on_axis(const chart_axis *axis, double value) {
    const double share = chart_axis_share(axis, value);
    return share > -1e-6 && share < 1 + 1e-6;
}

bool axes_holds(const axes *a, double x, double y) {
    return on_axis(a->x, x) && on_axis(a->y, y);
}

int axes_room_x(const pencil *p, double width) {
    return (int)fmax(2, width / (58 * p->scale));
}

int axes_room_y(const pencil *p, double height) {
    return (int)fmax(2, height / (25 * p->scale));
}

double axes_widest_label(const pencil *p, const chart_axis *axis, int room) {
    ticks t;
    ticks_make(axis, room, &t);
    double width = 0;
    for (size_t i = 0; i < t.count; i++)
        width = fmax(width, canvas_text_width(p->c, t.items[i].text, &p->small));
    return width;
}

/* Lines of one px lie on pixel centres: sharp at the natural size. */
static double snap(double v) {
    return floor(v) + 0.5;
}

/* Whether the labels stand apart; with `drop`, those that do not lose their text. */
static bool labels_apart(const pencil *p, const axes *a, ticks *t, bool drop) {
    double end = -INFINITY;
    bool apart = true;
    for (size_t i = 0; i < t->count; i++) {
        if (t->items[i].text[0] == '\0')
            continue;
        double half = canvas_text_width(p->c, t->items[i].text, &p->small) / 2, at = axes_x(a, t->items[i].at);
        if (at - half > end + 6 * p->scale) {
            end = at + half;
        } else {
            apart = false;
            if (drop)
                t->items[i].text[0] = '\0';
        }
    }
    return apart;
}

/* Names that stand too close for one line are on two in turn. */
static bool is_staggered(const pencil *p, const axes *a) {
    ticks t;
    ticks_make(a->x, 0, &t);
    return a->x->names != NULL && !labels_apart(p, a, &t, false);
}

/* The labels of a horizontal axis may be wider than thought: fewer of them until they stand apart. */
static void ticks_that_fit(const pencil *p, const axes *a, ticks *out) {
    int room = axes_room_x(p, a->frame.w);
    ticks_make(a->x, room, out);
    if (a->x->names != NULL)
        return;
    while (!labels_apart(p, a, out, room <= 2) && room > 2)
        ticks_make(a->x, --room, out);
}

/* Lines at the ticks of an axis, from one side on, shorter ones at minor ticks; none of length 0. All lines of one pen
 * are one path: an SVG spends two hundred bytes on each path's style. */
static void add_lines(const pencil *p, const axes *a, bool across, const ticks *t, double from, double major,
                      double minor) {
    for (size_t i = 0; i < t->count; i++) {
        const double to = from + (t->items[i].text[0] != '\0' ? major : minor);
        const double at = snap(across ? axes_y(a, t->items[i].at) : axes_x(a, t->items[i].at));
        if (to != from && across)
            canvas_path_segment(p->c, from, at, to, at);
        else if (to != from)
            canvas_path_segment(p->c, at, from, at, to);
    }
}

void axes_draw_grid(const pencil *p, const axes *a) {
    ticks t;
    canvas_pen pen = {.colour = p->theme->grid, .width = p->scale};
    ticks_that_fit(p, a, &t);
    add_lines(p, a, false, &t, a->frame.y, a->frame.h, 0);
    ticks_make(a->y, axes_room_y(p, a->frame.h), &t);
    add_lines(p, a, true, &t, a->frame.x, a->frame.w, 0);
    canvas_path_end(p->c, &pen);
}

static void draw_x_ticks(const pencil *p, const axes *a, const canvas_pen *pen, bool labels) {
    ticks t;
    double bottom = snap(a->frame.y + a->frame.h);
    const double lower = is_staggered(p, a) ? 1.25 * p->small.size : 0;
    ticks_that_fit(p, a, &t);
    add_lines(p, a, false, &t, bottom, TICK_LENGTH * p->scale, MINOR_LENGTH * p->scale);
    canvas_path_end(p->c, pen);
    for (size_t i = 0; i < t.count && labels; i++)
        canvas_text(p->c, snap(axes_x(a, t.items[i].at)),
                    bottom + (TICK_LENGTH + LABEL_GAP) * p->scale + 0.73 * p->small.size + (i % 2 == 1 ? lower : 0),
                    t.items[i].text, &p->small, CANVAS_MIDDLE);
}

/* side -1: ticks and labels to the left of x; +1: to the right. */
static void draw_y_ticks(const pencil *p, const axes *a, double x, int side, const canvas_pen *pen, bool labels) {
    ticks t;
    ticks_make(a->y, axes_room_y(p, a->frame.h), &t);
    add_lines(p, a, true, &t, x, side * TICK_LENGTH * p->scale, side * MINOR_LENGTH * p->scale);
    canvas_path_end(p->c, pen);
    for (size_t i = 0; i < t.count && labels; i++)
        canvas_text(p->c, x + side * (TICK_LENGTH + LABEL_GAP) * p->scale,
                    snap(axes_y(a, t.items[i].at)) + 0.36 * p->small.size, t.items[i].text, &p->small,
                    side < 0 ? CANVAS_RIGHT : CANVAS_LEFT);
}

static void draw_box(const pencil *p, canvas_rect f, const canvas_pen *pen) {
    double x0 = snap(f.x), y0 = snap(f.y), x1 = snap(f.x + f.w), y1 = snap(f.y + f.h);
    canvas_line(p->c, (canvas_point[]){{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}, {x0, y0}}, 5, pen);
}

void axes_draw_frame(const pencil *p, const axes *a, bool x_labels, bool y_labels) {
    canvas_pen pen = {.colour = p->theme->frame, .width = p->scale};
    draw_box(p, a->frame, &pen);
    draw_x_ticks(p, a, &pen, x_labels);
    draw_y_ticks(p, a, snap(a->frame.x), -1, &pen, y_labels);
}

void axes_draw_right(const pencil *p, const axes *a, bool labels) {
    canvas_pen pen = {.colour = p->theme->frame, .width = p->scale};
    draw_y_ticks(p, a, snap(a->frame.x + a->frame.w), 1, &pen, labels);
}

void axes_draw_scale(const pencil *p, const axes *a) {
    canvas_pen pen = {.colour = p->theme->frame, .width = p->scale};
    draw_box(p, a->frame, &pen);
    axes_draw_right(p, a, true);
}
