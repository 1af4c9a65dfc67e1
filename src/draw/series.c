/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "draw/series.h"

#include <math.h>

#include "draw/area.h"
#include "draw/trace.h"

/* px at scale 1 */
#define MARKER_SPACING 120.0 /* along x */
#define LEVEL_WIDTH    6.0
#define LEVEL_LENGTH   22.0 /* at least */
#define BAR_END        9.0  /* to either side */
#define LINE_END       6.0  /* up and down */

static canvas_pen pen_of(const pencil *p, const chart_series *s) {
    return theme_pen(p->theme, s->style.colour, s->style.stroke, s->style.thin ? 0.5 * p->scale : p->scale);
}

void series_arrow(const pencil *p, double x, double y, canvas_colour colour) {
    double half = 4.5 * p->scale, length = 9 * p->scale;
    canvas_polygon(p->c, (canvas_point[]){{x, y}, {x + half, y + length}, {x - half, y + length}}, 3, colour);
}

void series_end(const pencil *p, double x, double y, canvas_colour colour) {
    const canvas_pen pen = {.colour = colour, .width = 1.25 * p->theme->line_width * p->scale};
    canvas_segment(p->c, x, y - LINE_END * p->scale, x, y + LINE_END * p->scale, &pen);
}

/* Every second stroke has hollow markers: two curves of one colour that lie on each other still show. */
static void draw_marker(const pencil *p, const chart_series *s, double x, double y, double size) {
    int marker = s->style.marker < 0 ? 0 : s->style.marker;
    theme_marker(p->c, p->theme, x, y, marker, s->style.colour, s->style.stroke % 2 == 1, size * p->scale);
}

/* Draws markers at even distances along the line, which need not have a point there. */
static void draw_markers(const pencil *p, const axes *a, const chart_panel *panel, size_t index) {
    const chart_series *s = &panel->series[index];
    double spacing = fmin(MARKER_SPACING * p->scale, a->frame.w / 3), before = 0, all = 0;
    for (size_t k = 0; k < panel->series_count; k++)
        if (panel->series[k].kind == CHART_LINE && panel->series[k].style.marker >= 0) {
            before += k < index;
            all++;
        }
    double next = a->frame.x + spacing * (before + 0.5) / all;
    for (size_t i = 1; i < s->count; i++) {
        double x0 = axes_x(a, s->x[i - 1]), y0 = axes_y(a, s->y[i - 1]);
        double x1 = axes_x(a, s->x[i]), y1 = axes_y(a, s->y[i]);
        for (; next <= x1; next += spacing)
            if (next >= x0 && isfinite(s->y[i - 1]) && isfinite(s->y[i]))
                draw_marker(p, s, next, x1 > x0 ? y0 + (y1 - y0) * (next - x0) / (x1 - x0) : y1, 1);
    }
}

/* Strokes the line; returns where it leaves the frame upwards for ever, or NaN. */
static double stroke_line(const pencil *p, const axes *a, const chart_series *s, const canvas_pen *pen) {
    trace t = {.c = p->c};
    double end = NAN;
    for (size_t i = 0; i < s->count; i++) {
        if (isinf(s->y[i])) {
            end = axes_x(a, s->x[i]);
            trace_point(&t, end, a->frame.y);
            break;
        }
        if (isnan(s->y[i]))
            trace_break(&t);
        else
            trace_point(&t, axes_x(a, s->x[i]), axes_y(a, s->y[i]));
    }
    trace_finish(&t, pen);
    return end;
}

/* At the last point that a curve has. */
static void draw_end(const pencil *p, const axes *a, const chart_series *s, canvas_colour colour) {
    size_t k = s->count;
    while (k > 0 && !isfinite(s->y[k - 1]))
        k--;
    if (k > 0 && !isnan(s->certain_to))
        series_end(p, axes_x(a, s->x[k - 1]), axes_y(a, s->y[k - 1]), colour);
}

static void draw_line(const pencil *p, const axes *a, const chart_panel *panel, size_t index) {
    const chart_series *s = &panel->series[index];
    canvas_pen pen = pen_of(p, s);
    if (s->second) { /* it runs over the bands of the first axis */
        canvas_pen rim = {.colour = p->theme->background, .width = 2.5 * pen.width};
        stroke_line(p, a, s, &rim);
    }
    double end = stroke_line(p, a, s, &pen);
    if (!isnan(end))
        series_arrow(p, end, a->frame.y, pen.colour);
    draw_end(p, a, s, pen.colour);
    if (s->style.marker >= 0)
        draw_markers(p, a, panel, index);
}

/* From the height of a code on the left axis to the curve, and down to the bottom axis: the staircase. */
static void draw_drops(const pencil *p, const axes *a, const chart_panel *panel, size_t index) {
    const chart_series *s = &panel->series[index];
    double bottom = a->frame.y + a->frame.h, rug = 7 * p->scale;
    double crowd = fmax(1, (double)s->count / (a->frame.h / (7 * p->scale)));
    canvas_pen thin = {.colour = p->theme->curves[s->style.colour % THEME_COLOURS]};
    canvas_pen thick = thin;
    thin.width = 1.1 * p->scale / sqrt(crowd);
    thin.colour.a = 0.6;
    thick.width = 1.6 * p->scale / sqrt(crowd);
    for (size_t i = 0; i < s->count; i++) {
        double x = axes_x(a, s->x[i]), y = axes_y(a, s->y[i]);
        canvas_path_segment(p->c, a->frame.x, y, x, y);
        canvas_path_to(p->c, x, bottom);
    }
    canvas_path_end(p->c, &thin);
    for (size_t i = 0; i < s->count; i++) {
        double x = axes_x(a, s->x[i]), y = axes_y(a, s->y[i]);
        canvas_path_segment(p->c, a->frame.x, y, a->frame.x + rug, y);
        canvas_path_segment(p->c, x, bottom, x, bottom - rug);
    }
    canvas_path_end(p->c, &thick);
}

static double point_size(const chart_series *s) {
    return s->style.thin ? 1 : 1.5;
}

/* Those within the frame. */
static void draw_points(const pencil *p, const axes *a, const chart_panel *panel, size_t index) {
    const chart_series *s = &panel->series[index];
    for (size_t i = 0; i < s->count; i++)
        if (axes_holds(a, s->x[i], s->y[i]))
            draw_marker(p, s, axes_x(a, s->x[i]), axes_y(a, s->y[i]), point_size(s));
}

static void draw_level(const pencil *p, const chart_series *s, double x0, double x1, double y) {
    const canvas_pen pen = {.colour = area_tint(p->theme, s->style.colour), .width = LEVEL_WIDTH * p->scale};
    canvas_segment(p->c, x0, y, x1, y, &pen);
}

/* Those of a single depth are long enough to be seen. */
static void draw_levels(const pencil *p, const axes *a, const chart_panel *panel, size_t index) {
    const chart_series *s = &panel->series[index];
    for (size_t i = 0; i + 1 < s->count; i += 2) {
        const double x0 = axes_x(a, s->x[i]), x1 = axes_x(a, s->x[i + 1]);
        const double more = fmax(LEVEL_LENGTH * p->scale - (x1 - x0), 0) / 2;
        draw_level(p, s, x0 - more, x1 + more, axes_y(a, s->y[i]));
    }
}

static void draw_spans(const pencil *p, const axes *a, const chart_panel *panel, size_t index) {
    const chart_series *s = &panel->series[index];
    const canvas_pen pen = pen_of(p, s);
    for (size_t i = 0; i + 1 < s->count; i += 2)
        canvas_path_segment(p->c, axes_x(a, s->x[i]), axes_y(a, s->y[i]), axes_x(a, s->x[i + 1]), axes_y(a, s->y[i]));
    canvas_path_end(p->c, &pen);
}

static void draw_bars(const pencil *p, const axes *a, const chart_panel *panel, size_t index) {
    const chart_series *s = &panel->series[index];
    const canvas_pen pen = pen_of(p, s);
    const double half = BAR_END * p->scale;
    for (size_t i = 0; i + 1 < s->count; i += 2) {
        const double x = axes_x(a, s->x[i]), y = axes_y(a, s->y[i + 1]);
        canvas_path_segment(p->c, x, axes_y(a, s->y[i]), x, y);
        canvas_path_segment(p->c, x - half, y, x + half, y);
    }
    canvas_path_end(p->c, &pen);
}

static void swatch_line(const pencil *p, const chart_series *s, double x, double y, double width) {
    canvas_pen pen = pen_of(p, s);
    canvas_segment(p->c, x, y, x + width, y, &pen);
    if (s->style.marker >= 0)
        draw_marker(p, s, x + width / 2, y, 1);
}

static void swatch_bars(const pencil *p, const chart_series *s, double x, double y, double width) {
    const canvas_pen pen = pen_of(p, s);
    const double middle = x + width / 2, half = BAR_END * p->scale, top = y - 5 * p->scale;
    canvas_path_segment(p->c, middle, y + 5 * p->scale, middle, top);
    canvas_path_segment(p->c, middle - half, top, middle + half, top);
    canvas_path_end(p->c, &pen);
}

static void swatch_drops(const pencil *p, const chart_series *s, double x, double y, double width) {
    canvas_pen pen = {.colour = p->theme->curves[s->style.colour % THEME_COLOURS], .width = 1.1 * p->scale};
    double half = 5 * p->scale;
    for (int i = 1; i < 4; i++)
        canvas_segment(p->c, x + width * i / 4, y - half, x + width * i / 4, y + half, &pen);
}

static void swatch_points(const pencil *p, const chart_series *s, double x, double y, double width) {
    draw_marker(p, s, x + width / 2, y, point_size(s));
}

static void swatch_levels(const pencil *p, const chart_series *s, double x, double y, double width) {
    draw_level(p, s, x, x + width, y);
}

static void swatch_area(const pencil *p, const chart_series *s, double x, double y, double width) {
    double half = 5 * p->scale;
    canvas_fill(p->c, (canvas_rect){x, y - half, width, 2 * half}, area_tint(p->theme, s->style.colour));
}

static const struct {
    void (*draw)(const pencil *, const axes *, const chart_panel *, size_t index);
    void (*swatch)(const pencil *, const chart_series *, double x, double y, double width);
} kinds[CHART_KIND_COUNT] = {
    [CHART_LINE] = {draw_line, swatch_line},       [CHART_DROPS] = {draw_drops, swatch_drops},
    [CHART_POINTS] = {draw_points, swatch_points}, [CHART_LEVELS] = {draw_levels, swatch_levels},
    [CHART_AREA] = {area_draw, swatch_area},       [CHART_BARS] = {draw_bars, swatch_bars},
    [CHART_SPANS] = {draw_spans, swatch_line},
};

void series_draw(const pencil *p, const axes *a, const chart_panel *panel, size_t index) {
    kinds[panel->series[index].kind].draw(p, a, panel, index);
}

void series_swatch(const pencil *p, const chart_series *s, double x, double y, double width) {
    kinds[s->kind].swatch(p, s, x, y, width);
}
