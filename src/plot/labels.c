/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Names of points that stand close together: each goes where it hides least of the points and of the names before it.
 */
#include <math.h>

#include "plot/series.h"

enum { LABELS_MAX = 64, LABELS_LINES = 4 };

static double overlap(canvas_rect a, canvas_rect b) {
    double w = fmin(a.x + a.w, b.x + b.w) - fmax(a.x, b.x), h = fmin(a.y + a.h, b.y + b.h) - fmax(a.y, b.y);
    return w > 0 && h > 0 ? w * h : 0;
}

typedef struct place {
    canvas_rect box;
    double cost;
} place;

/* What a box hides: other things, and above all itself beyond the frame. */
static double cost_of(canvas_rect box, canvas_rect frame, const canvas_rect *taken, size_t count) {
    double cost = 10 * (box.w * box.h - overlap(box, frame));
    for (size_t i = 0; i < count; i++)
        cost += overlap(box, taken[i]);
    return cost;
}

static place best_place(const pencil *p, const axes *a, double x, double y, double width, const canvas_rect *taken,
                        size_t count) {
    const double high = 1.25 * p->small.size, gap = 8 * p->scale;
    place best = {.cost = (double)INFINITY};
    for (int line = 0; line <= 2 * LABELS_LINES; line++) {
        double lift = (line + 1) / 2 * (line % 2 == 0 ? 1 : -1) * 0.75 * high;
        for (int side = 0; side < 2; side++) {
            canvas_rect box = {side == 0 ? x + gap : x - gap - width, y - high / 2 + lift, width, high};
            double cost = cost_of(box, a->frame, taken, count) + 0.3 * (fabs(lift) + side);
            if (cost < best.cost)
                best = (place){box, cost};
        }
    }
    return best;
}

void labels_draw(const pencil *p, const axes *a, const chart_panel *panel, size_t index) {
    const chart_series *s = &panel->series[index];
    canvas_rect taken[2 * LABELS_MAX];
    size_t used = 0, shown = s->count < LABELS_MAX && s->labels != NULL ? s->count : 0;
    const double half = 6 * p->scale;
    for (size_t i = 0; i < shown; i++)
        taken[used++] = (canvas_rect){axes_x(a, s->x[i]) - half, axes_y(a, s->y[i]) - half, 2 * half, 2 * half};
    for (size_t i = 0; i < shown; i++) {
        canvas_font font = p->small;
        font.colour = p->theme->text;
        font.halo = p->theme->background;
        double x = axes_x(a, s->x[i]), y = axes_y(a, s->y[i]);
        place spot = best_place(p, a, x, y, canvas_text_width(p->c, s->labels[i], &font), taken, used);
        bool left = spot.box.x + spot.box.w < x;
        double middle = spot.box.y + spot.box.h / 2, end = left ? spot.box.x + spot.box.w : spot.box.x;
        taken[used++] = spot.box;
        if (fabs(middle - y) > spot.box.h / 2) {
            canvas_pen thin = {.colour = p->theme->faint, .width = 0.7 * p->scale};
            canvas_segment(p->c, x, y, end, middle, &thin);
        }
        canvas_text(p->c, end, middle + 0.36 * font.size, s->labels[i], &font, left ? CANVAS_RIGHT : CANVAS_LEFT);
    }
}
