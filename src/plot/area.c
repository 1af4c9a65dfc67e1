/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "plot/area.h"

#include <math.h>

#include "plot/trace.h"

canvas_colour area_tint(const theme *t, int colour) {
    const double strength = 0.55;
    const canvas_colour c = theme_colour(t, colour), b = t->background;
    return (canvas_colour){b.r + strength * (c.r - b.r), b.g + strength * (c.g - b.g), b.b + strength * (c.b - b.b), 1};
}

/* The height to which the bands up to this one reach at point i, `count` of them; NaN in a gap. */
static double reached(const chart_series *first, size_t count, size_t i) {
    double sum = 0;
    for (size_t k = 0; k < count; k++)
        if (first[k].kind == CHART_AREA)
            sum += first[k].y[i];
    return sum;
}

void area_draw(const pencil *p, const axes *a, const chart_series *s, size_t index) {
    const chart_series *first = s - index;
    const canvas_colour tint = area_tint(p->theme, s->style.colour);
    trace t = trace_start(p->c);
    bool open = false;
    for (size_t i = 0; i <= s->count; i++) {
        double top = i < s->count ? reached(first, index + 1, i) : (double)NAN;
        if (isnan(top) && open) {
            trace_fill(&t, a->frame.y + a->frame.h, tint);
            t = trace_start(p->c);
        }
        open = !isnan(top);
        if (open)
            trace_point(&t, axes_x(a, s->x[i]), axes_y(a, top));
    }
}

/* The span of heights, px, that the band has everywhere from point i to point j. */
static void common_span(const axes *a, const chart_series *s, size_t index, size_t i, size_t j, double *upper,
                        double *lower) {
    const chart_series *first = s - index;
    *upper = a->frame.y;
    *lower = a->frame.y + a->frame.h;
    for (; i <= j; i++) {
        double top = reached(first, index + 1, i), base = reached(first, index, i);
        *upper = isnan(top) ? INFINITY : fmax(*upper, axes_y(a, top));
        *lower = fmin(*lower, axes_y(a, base));
    }
}

void area_label(const pencil *p, const axes *a, const chart_series *s, size_t index) {
    enum { PLACES = 100 };
    canvas_font font = p->small;
    font.colour = p->theme->text;
    double width = canvas_text_width(p->c, s->name, &font) + 8 * p->scale, best = 1.3 * font.size, x = 0, y = 0;
    size_t step = s->count / PLACES + 1;
    bool found = false;
    for (size_t i = 0; i < s->count; i += step) {
        double left = axes_x(a, s->x[i]), upper, lower;
        size_t j = i;
        while (j + 1 < s->count && axes_x(a, s->x[j]) < left + width)
            j++;
        if (left < a->frame.x || axes_x(a, s->x[j]) < left + width)
            continue;
        common_span(a, s, index, i, j, &upper, &lower);
        if (lower - upper > best) {
            best = lower - upper;
            x = left + width / 2;
            y = (upper + lower) / 2;
            found = true;
        }
    }
    if (found)
        canvas_text(p->c, x, y + 0.36 * font.size, s->name, &font, CANVAS_MIDDLE, 0);
}
