/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "draw/draw.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/append.h"
#include "core/elementary.h"
#include "draw/area.h"
#include "draw/heat.h"
#include "draw/legend.h"
#include "draw/notes.h"
#include "draw/series.h"
#include "draw/words.h"

/* All in px at scale 1. */
#define PAGE_WIDTH  800.0
#define PAGE_HEIGHT 500.0
#define MARGIN      16.0
#define SPACE       8.0
#define TICK_ROOM   11.0 /* from the frame to the tick labels */
#define PANEL_GAP   20.0
#define BAR_WIDTH   16.0
#define BALL_WIDTH  72.0
#define HEADING_GAP 2.0
#define PANEL_SHAPE 1.5 /* the width of a panel over its height that looks best */

/* The panels in rows and columns. */
typedef struct grid {
    int columns, rows;
    canvas_rect area; /* of all frames and the headings above them */
    double heading;   /* height above each frame; 0: there are none */
    double gap_x, gap_y;
    double share[CHART_PANELS]; /* of each row in the height of all frames */
} grid;

static int columns_for(size_t count, canvas_rect area) {
    int best = 1;
    double best_score = INFINITY;
    for (int columns = 1; columns <= (int)count; columns++) {
        int rows = ((int)count + columns - 1) / columns;
        double empty = columns * rows - (double)count;
        double score = fabs(dp_log(area.w / columns / (area.h / rows) / PANEL_SHAPE)) + 0.25 * empty;
        if (score < best_score) {
            best_score = score;
            best = columns;
        }
    }
    return best;
}

/* Rows are alike, but for panels that share x: these have one scale. */
static void share_height(grid *g, const chart *c) {
    double sum = 0;
    for (int row = 0; row < g->rows; row++) {
        const chart_axis *y = &c->panels[row].y;
        g->share[row] = c->stacked ? y->hi - y->lo : 1;
        sum += g->share[row];
    }
    for (int row = 0; row < g->rows; row++)
        g->share[row] /= sum;
}

/* The height of the frames of all rows together. */
static double frames_height(const grid *g) {
    return g->area.h - g->gap_y * (g->rows - 1) - g->heading * g->rows;
}

static canvas_rect panel_frame(const grid *g, int index) {
    const int row = index / g->columns;
    const double w = (g->area.w - g->gap_x * (g->columns - 1)) / g->columns, h = frames_height(g);
    canvas_rect frame = {g->area.x + index % g->columns * (w + g->gap_x), g->area.y + g->heading, w, h * g->share[row]};
    for (int above = 0; above < row; above++)
        frame.y += h * g->share[above] + g->gap_y + g->heading;
    return frame;
}

/* Title, subtitle, legend. Returns the y below them. */
static double draw_head(const pencil *p, const chart *c, double width) {
    double x = MARGIN * p->scale, y = 0.75 * MARGIN * p->scale, room = width - 2 * x;
    words title = words_break(p, c->title, &p->title, room, 2);
    y = words_draw(p, &title, &p->title, x, y) + 1 * p->scale;
    words subtitle = words_break(p, c->subtitle, &p->small, room, 3);
    y = words_draw(p, &subtitle, &p->small, x, y) + 0.75 * SPACE * p->scale;
    legend l = legend_make(p, c, room);
    if (l.count > 0)
        y = legend_draw(p, &l, x, y) + 0.75 * SPACE * p->scale;
    return y;
}

/* Panels of a given shape: as large as the area lets them be, in its middle. */
static void keep_shape(grid *g, const chart *c, double left) {
    const double rows = c->stacked ? 1 : g->rows, width = g->area.w, all = frames_height(g);
    const double w = fmin(panel_frame(g, 0).w, all / rows * c->shape);
    g->area.w = w * g->columns + g->gap_x * (g->columns - 1);
    g->area.h += w / c->shape * rows - all;
    g->area.x += fmax(0, (width - g->area.w) / 2 - left / 4);
}

static void draw_caption(const pencil *p, const chart *c, const chart_axis *axis, canvas_align align, double x,
                         double y, double room) {
    char text[CHART_TEXT], named[CHART_TEXT];
    const char *unit = chart_unit(c, axis, named);
    snprintf(text, sizeof text, "%.90s%s%.90s%s", axis->label, *unit ? " (" : "", unit, *unit ? ")" : "");
    words w = words_break(p, text, &p->text, room, 1);
    if (w.count > 0)
        canvas_text(p->c, x, y, w.lines[0], &p->text, align);
}

/* Points may stand on the frame; they are not cut by it. */
static void draw_points(const pencil *p, const axes *a, const chart_panel *panel, bool behind) {
    for (size_t s = 0; s < panel->series_count; s++)
        if (panel->series[s].kind == CHART_POINTS && panel->series[s].behind == behind)
            series_draw(p, a, panel, s);
}

static bool is_ground(chart_kind kind) {
    return kind == CHART_AREA || kind == CHART_LEVELS;
}

/* Bands, the topmost first; lines and drops on them, and the names of the bands where these leave room. */
static void draw_curves(const pencil *p, const axes *a, const axes *right, const chart_panel *panel) {
    const chart_series *all = panel->series;
    canvas_clip(p->c, (canvas_rect){a->frame.x, a->frame.y, a->frame.w + 1, a->frame.h + 1});
    for (size_t s = panel->series_count; s-- > 0;)
        if (is_ground(all[s].kind))
            series_draw(p, a, panel, s);
    for (size_t s = 0; s < panel->series_count; s++)
        if (all[s].kind != CHART_POINTS && !is_ground(all[s].kind))
            series_draw(p, all[s].second ? right : a, panel, s);
    for (size_t s = 0; s < panel->series_count; s++)
        if (all[s].kind == CHART_AREA)
            area_label(p, a, right, panel, s);
    canvas_unclip(p->c);
}

static words heading_of(const pencil *p, const chart_panel *panel, double width) {
    enum { LINES = 3 };
    return words_break(p, panel->title, &p->heading, width, LINES);
}

static double heading_height(const pencil *p, size_t lines) {
    return (double)lines * words_height(&p->heading) + HEADING_GAP * p->scale;
}

/* All frames begin as far down as the longest heading needs. */
static double common_heading(const pencil *p, const chart *c, const grid *g) {
    size_t lines = 0;
    for (size_t i = 0; i < c->panel_count; i++) {
        const size_t own = heading_of(p, &c->panels[i], panel_frame(g, 0).w).count;
        lines = own > lines ? own : lines;
    }
    return heading_height(p, lines);
}

/* Does a panel show what is on its x axis? Not where the one below has the same. */
static bool shows_x(const chart *c, int columns, size_t index) {
    const size_t below = index + (size_t)columns;
    return c->apart || below >= c->panel_count || c->panels[below].x.names != c->panels[index].x.names;
}

/* Are there labels between two rows of panels? */
static bool labels_between(const chart *c, int columns) {
    bool found = c->apart;
    for (size_t i = 0; i + (size_t)columns < c->panel_count; i++)
        found = found || shows_x(c, columns, i);
    return found;
}

static bool draw_panel(const pencil *p, const chart *c, const grid *g, int index) {
    const chart_panel *panel = &c->panels[index];
    axes a = {&panel->x, &panel->y, panel_frame(g, index)}, right = {&panel->x, &panel->second, a.frame};
    bool lowest = shows_x(c, g->columns, (size_t)index);
    bool leftmost = c->apart || index % g->columns == 0;
    bool rightmost = (index + 1) % g->columns == 0 || (size_t)index + 1 == c->panel_count;
    if (g->heading > 0) {
        const words w = heading_of(p, panel, a.frame.w);
        words_draw(p, &w, &p->heading, a.frame.x, a.frame.y - heading_height(p, w.count));
    }
    if (panel->map.columns > 0) {
        canvas_clip(p->c, a.frame);
        bool good = heat_draw(p, &a, panel, c);
        canvas_unclip(p->c);
        if (!good)
            return false;
    } else {
        axes_draw_grid(p, &a);
    }
    draw_points(p, &a, panel, true);
    draw_curves(p, &a, &right, panel);
    axes_draw_frame(p, &a, lowest, leftmost);
    if (panel->second.label != NULL)
        axes_draw_right(p, &right, rightmost);
    draw_points(p, &a, panel, false);
    labels_draw(p, &a, panel);
    return true;
}

/* The width of the widest tick label on the left of all panels. */
static double widest_y(const pencil *p, const chart *c, int labels) {
    double widest = 0;
    for (size_t i = 0; i < c->panel_count; i++)
        widest = fmax(widest, axes_widest_label(p, &c->panels[i].y, labels));
    return widest;
}

static bool draw_page(const pencil *p, const chart *c, double width, double height) {
    const chart_axis *x = &c->panels[0].x, *y = &c->panels[0].y, *second = &c->panels[0].second;
    double s = p->scale, caption = words_height(&p->text), label = words_height(&p->small);
    canvas_fill(p->c, (canvas_rect){0, 0, width, height}, p->theme->background);
    double top = draw_head(p, c, width) + caption;
    double bottom = height - 0.75 * MARGIN * s - caption - label - TICK_ROOM * s;
    grid g = {1, 1, {MARGIN * s, top, width - 2 * MARGIN * s, fmax(bottom - top, 40 * s)}, 0, 0, 0, {1}};
    g.columns = c->stacked ? 1 : columns_for(c->panel_count, g.area);
    g.rows = ((int)c->panel_count + g.columns - 1) / g.columns;
    share_height(&g, c);
    g.heading = c->panel_count > 1 ? heading_height(p, 1) : 0; /* so far */
    /* The topmost tick label rises half its height above the frame; the caption stays clear of it. */
    double clear = g.heading > 0 ? 0.75 * SPACE * s : 0.5 * p->small.size + 0.75 * SPACE * s;
    g.area.y += clear;
    g.area.h -= clear;

    /* Tick labels stand to the left of the panels, and half of the last one to their right. */
    const int labels = axes_room_y(p, g.area.h / g.rows - g.heading);
    double left = widest_y(p, c, labels) + TICK_ROOM * s;
    double x_label = axes_widest_label(p, x, axes_room_x(p, g.area.w / g.columns)), right = x_label / 2;
    g.gap_x = fmax(PANEL_GAP * s, x_label + SPACE * s) + (c->apart ? left : 0); /* two neighbours' end labels meet */
    g.gap_y = PANEL_GAP * s + (labels_between(c, g.columns) ? label + TICK_ROOM * s - HEADING_GAP * s : 0);
    double bar = c->classes ? 0
                 : c->value.label != NULL
                     ? SPACE * 2 * s + BAR_WIDTH * s + TICK_ROOM * s + axes_widest_label(p, &c->value, labels)
                 : c->colours ? SPACE * 2 * s + BALL_WIDTH * s
                              : 0;
    double scale = second->label != NULL ? TICK_ROOM * s + axes_widest_label(p, second, labels) : 0;
    g.area.x += left;
    g.area.w -= left + fmax(fmax(bar, scale), right - 0.75 * MARGIN * s);

    if (g.heading > 0)
        g.heading = common_heading(p, c, &g);
    const double end = g.area.x + g.area.w;
    if (c->shape > 0)
        keep_shape(&g, c, left);
    const double shift = end - g.area.x - g.area.w, side = c->shape > 0 ? g.area.x - left : MARGIN * s;
    const double foot =
        c->shape > 0 ? g.area.y + g.area.h + label + TICK_ROOM * s + caption : height - 0.75 * MARGIN * s;

    double above = g.area.y - clear, room = width - 2 * MARGIN * s;
    draw_caption(p, c, y, CANVAS_LEFT, side, above, bar + scale > 0 ? room * 0.46 : room);
    if (scale > 0)
        draw_caption(p, c, second, CANVAS_RIGHT, width - MARGIN * s, above, room * 0.5);
    draw_caption(p, c, x, CANVAS_MIDDLE, g.area.x + g.area.w / 2, foot - 0.25 * caption,
                 fmin(g.area.w + left, 2 * (width - MARGIN * s - g.area.x - g.area.w / 2)));
    if (bar > 0) {
        canvas_rect strip = {width - MARGIN * s - bar + 2 * SPACE * s - shift, g.area.y + g.heading,
                             (c->colours ? BALL_WIDTH : BAR_WIDTH) * s, g.area.h - g.heading};
        if (c->colours) {
            heat_draw_ball(p, strip);
        } else {
            draw_caption(p, c, &c->value, CANVAS_RIGHT, width - MARGIN * s - shift, above, room * 0.5);
            heat_draw_bar(p, strip, c);
        }
    }
    for (int i = 0; i < (int)c->panel_count; i++)
        if (!draw_panel(p, c, &g, i))
            return false;
    return true;
}

/* One paragraph: title, what holds for all, then what is shown. */
static void describe(const chart *c, char *out, size_t size) {
    snprintf(out, size, "%s. %s.", c->title, c->subtitle);
    for (size_t p = 0; p < c->panel_count; p++) {
        const chart_panel *panel = &c->panels[p];
        if (panel->title[0] != '\0')
            append(out, size, " %s.", panel->title);
        for (size_t s = 0; s < panel->series_count; s++)
            append(out, size, "%s %s%s", s == 0 ? " Shown:" : ";", panel->series[s].name,
                   s + 1 == panel->series_count ? "." : "");
    }
}

/* "z log 0.1 1000, interval log 6e-09 1.2\n" of a single panel: the ends of its frame. */
static void tell_axes(const chart *c, char *out, size_t size) {
    const chart_axis *both[] = {&c->panels[0].x, &c->panels[0].y};
    out[0] = '\0';
    for (size_t i = 0; i < 2 && c->panel_count == 1 && c->panels[0].map.columns == 0; i++)
        append(out, size, "%s %s %.9g %.9g%s", both[i]->key, both[i]->scale == CHART_LOG ? "log" : "linear",
               both[i]->lo, both[i]->hi, i == 0 ? ", " : "\n");
}

bool draw_chart(const chart *c, const theme *t, canvas_format format, int width, int height, const char *command,
                canvas_bytes *out) {
    char digest[17], ends[CHART_TEXT], description[CHART_TEXT * 32], clean_description[sizeof description],
        clean_command[4096];
    describe(c, description, sizeof description);
    chart_digest(c, digest);
    tell_axes(c, ends, sizeof ends);
    const notes noted = {c->title, notes_clean(clean_description, sizeof clean_description, description),
                         notes_clean(clean_command, sizeof clean_command, command), digest, ends};
    *out = (canvas_bytes){NULL, 0};
    canvas *surface = canvas_new(format, width, height, &noted);
    if (surface == NULL)
        return false;
    double scale = fmax(fmin(width / PAGE_WIDTH, height / PAGE_HEIGHT), 0.75);
    pencil p = pencil_make(surface, t, scale);
    bool good = draw_page(&p, c, width, height);
    if (!canvas_finish(surface, out) || !good) {
        free(out->at);
        *out = (canvas_bytes){NULL, 0};
        return false;
    }
    return true;
}
