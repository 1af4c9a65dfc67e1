/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "draw/area.h"

#include <math.h>

#include "draw/trace.h"

canvas_colour area_tint(const theme *t, int colour) {
    const double strength = 0.45;
    const canvas_colour c = theme_colour(t, colour), b = t->background;
    return (canvas_colour){b.r + strength * (c.r - b.r), b.g + strength * (c.g - b.g), b.b + strength * (c.b - b.b), 1};
}

/* The height to which the first `count` series reach at point i, as far as they are bands; NaN in a gap. */
static double reached(const chart_panel *panel, size_t count, size_t i) {
    double sum = 0;
    for (size_t k = 0; k < count; k++)
        if (panel->series[k].kind == CHART_AREA)
            sum += panel->series[k].y[i];
    return sum;
}

void area_draw(const pencil *p, const axes *a, const chart_panel *panel, size_t index) {
    const chart_series *s = &panel->series[index];
    const canvas_colour tint = area_tint(p->theme, s->style.colour);
    trace t = {.c = p->c};
    bool open = false;
    for (size_t i = 0; i <= s->count; i++) {
        double top = i < s->count ? reached(panel, index + 1, i) : (double)NAN;
        if (isnan(top) && open) {
            trace_fill(&t, a->frame.y + a->frame.h, tint);
            t = (trace){.c = p->c};
        }
        open = !isnan(top);
        if (open)
            trace_point(&t, axes_x(a, s->x[i]), axes_y(a, top));
    }
}

/* A range of heights, px, downwards. */
typedef struct heights {
    double upper, lower;
} heights;

static double height(heights h) {
    return h.lower - h.upper;
}

/* The heights that the band covers everywhere from point i to point j. */
static heights common_span(const axes *a, const chart_panel *panel, size_t index, size_t i, size_t j) {
    heights h = {a->frame.y, a->frame.y + a->frame.h};
    for (; i <= j; i++) {
        double top = reached(panel, index + 1, i), base = reached(panel, index, i);
        if (isnan(top))
            return (heights){0, 0};
        h.upper = fmax(h.upper, axes_y(a, top));
        h.lower = fmin(h.lower, axes_y(a, base));
    }
    return h;
}

/* The larger part that the lines between two x leave free; the ends of the parts that reach there count whole. */
static heights clear_of_lines(const axes *right, const chart_panel *panel, heights h, double from, double to,
                              double gap) {
    for (size_t s = 0; s < panel->series_count; s++) {
        const chart_series *line = &panel->series[s];
        heights taken = {INFINITY, -INFINITY};
        for (size_t i = 0; i < line->count && line->kind == CHART_LINE; i++)
            if ((i + 1 == line->count || axes_x(right, line->x[i + 1]) >= from) &&
                (i == 0 || axes_x(right, line->x[i - 1]) <= to) && !isnan(line->y[i])) {
                taken.upper = fmin(taken.upper, axes_y(right, line->y[i]) - gap);
                taken.lower = fmax(taken.lower, axes_y(right, line->y[i]) + gap);
            }
        if (taken.upper > taken.lower || taken.upper >= h.lower || taken.lower <= h.upper)
            continue;
        heights above = {h.upper, taken.upper}, below = {taken.lower, h.lower};
        h = height(above) > height(below) ? above : below;
    }
    return h;
}

void area_label(const pencil *p, const axes *a, const axes *right, const chart_panel *panel, size_t index) {
    enum { PLACES = 100 };
    const chart_series *s = &panel->series[index];
    canvas_font font = p->small;
    font.colour = p->theme->text;
    double width = canvas_text_width(p->c, s->name, &font) + 8 * p->scale, best = 1.3 * font.size, x = 0, y = 0;
    size_t step = s->count / PLACES + 1;
    bool found = false;
    for (size_t i = 0; i < s->count; i += step) {
        double left = axes_x(a, s->x[i]);
        size_t j = i;
        while (j + 1 < s->count && axes_x(a, s->x[j]) < left + width)
            j++;
        if (left < a->frame.x || axes_x(a, s->x[j]) < left + width)
            continue;
        heights h = clear_of_lines(right, panel, common_span(a, panel, index, i, j), left, left + width, 3 * p->scale);
        if (height(h) > best) {
            best = height(h);
            x = left + width / 2;
            y = (h.upper + h.lower) / 2;
            found = true;
        }
    }
    if (found)
        canvas_text(p->c, x, y + 0.36 * font.size, s->name, &font, CANVAS_MIDDLE);
}
