/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "draw/heat.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/elementary.h"
#include "draw/area.h"
#include "draw/ticks.h"
#include "system/pages.h"

enum { BAR_STEPS = 256 };

/* A row of fields. */
typedef struct fields {
    const double *value, *under; /* under: null where nothing is */
} fields;

/* Room for two rows, of values and of what is under them. */
static fields fields_of(const chart_map *m, int row, double *room) {
    return (fields){chart_value_row(m, row, room), chart_under_row(m, row, room + m->columns)};
}

static double *room_of(const chart_map *m) {
    return malloc(2 * (size_t)m->columns * sizeof(double));
}

/* Neither a value nor anything under it. */
static bool is_hole(const fields *f, int column) {
    return isnan(f->value[column]) && (f->under == NULL || isnan(f->under[column]));
}

bool heat_has_holes(const chart_map *m) {
    bool found = false;
    double *room = room_of(m);
    for (int row = 0; row < m->rows && !found && room != NULL; row++) {
        const fields f = fields_of(m, row, room);
        for (int column = 0; column < m->columns && !found; column++)
            found = is_hole(&f, column);
    }
    free(room);
    return found;
}

static void draw_hatch(const pencil *p, canvas_rect f) {
    canvas_pen pen = {.colour = p->theme->frame, .width = p->scale};
    double step = 9 * p->scale;
    pen.colour.a = 0.35;
    canvas_fill(p->c, f, p->theme->empty);
    for (double x = f.x - f.h; x < f.x + f.w; x += step)
        canvas_path_segment(p->c, x, f.y + f.h, x + f.h, f.y);
    canvas_path_end(p->c, &pen);
}

/* From light to a dark that no colour of the scale is. */
static canvas_colour grey_of(const chart_axis *ground, double v) {
    const double level = 0.95 - 0.6 * fmin(fmax(chart_axis_share(ground, v), 0), 1);
    return (canvas_colour){level, level, level, 1};
}

static canvas_colour scale_colour(const chart *c, double share) {
    const double level = share > 0 ? share < 1 ? share : 1 : 0;
    return c->grey ? (canvas_colour){level, level, level, 1} : theme_viridis(share);
}

/* The colour of a field that is no hole. */
static canvas_colour colour_of(const pencil *p, const chart *c, const chart_panel *panel, const fields *f, int column) {
    const double v = f->value[column];
    if (c->classes)
        return area_tint(p->theme, panel->series[(size_t)v].style.colour);
    if (isnan(v))
        return grey_of(&c->ground, f->under[column]);
    const uint32_t rgb = c->colours ? (uint32_t)v : 0;
    return c->colours ? (canvas_colour){(rgb >> 16 & 255) / 255.0, (rgb >> 8 & 255) / 255.0, (rgb & 255) / 255.0, 1}
                      : scale_colour(c, chart_axis_share(&c->value, v));
}

/* Few fields: each a rectangle, for an image as small as that is blurred by those who show it. */
static bool draw_fields(const pencil *p, canvas_rect f, const chart *c, const chart_panel *panel) {
    const chart_map *m = &panel->map;
    const double w = f.w / m->columns, h = f.h / m->rows, seam = 0.5;
    double *room = room_of(m);
    for (int row = m->rows - 1; row >= 0 && room != NULL; row--) {
        const fields of = fields_of(m, row, room);
        for (int column = 0; column < m->columns; column++)
            if (!is_hole(&of, column))
                canvas_fill(p->c, (canvas_rect){f.x + column * w, f.y + f.h - (row + 1) * h, w + seam, h + seam},
                            colour_of(p, c, panel, &of, column));
    }
    free(room);
    return room != NULL;
}

/* A row of fields as `each` rows of pixels, from `to` on. */
static void colour_row(const pencil *p, const chart *c, const chart_panel *panel, const fields *of, int each,
                       uint32_t *to) {
    const int columns = panel->map.columns * each;
    for (int column = 0; column < columns; column++)
        if (!is_hole(of, column / each))
            to[column] = theme_pixel(colour_of(p, c, panel, of, column / each));
    for (int copy = 1; copy < each; copy++)
        memcpy(to + (size_t)copy * (size_t)columns, to, (size_t)columns * sizeof *to);
}

/* Fields that stand for pixels of a screen are several pixels of the image each, and so stay sharp. */
static bool draw_pixels(const pencil *p, canvas_rect f, const chart *c, const chart_panel *panel) {
    enum { FEW = 4096, SHARP = 4 };
    const chart_map *m = &panel->map;
    const int each = c->classes ? SHARP : 1, columns = m->columns * each, rows = m->rows * each;
    if (m->columns * m->rows < FEW)
        return draw_fields(p, f, c, panel);
    uint32_t *pixels = calloc((size_t)columns * (size_t)rows, sizeof *pixels);
    pages_large(pixels, (size_t)columns * (size_t)rows * sizeof *pixels);
    bool good = pixels != NULL;
#pragma omp parallel reduction(&& : good)
    {
        double *room = room_of(m);
        good = good && room != NULL;
#pragma omp for schedule(static)
        for (int row = 0; row < m->rows; row++) {
            if (!good)
                continue;
            const fields of = fields_of(m, row, room);
            colour_row(p, c, panel, &of, each, pixels + (size_t)(m->rows - 1 - row) * (size_t)each * (size_t)columns);
        }
        free(room);
    }
    if (good)
        canvas_image(p->c, f, columns, rows, pixels);
    free(pixels);
    return good;
}

/* Where the value crosses the level between two grid points, as a share of the way; NaN when it does not. */
static double crossing(double from, double to, double level, chart_scale scale) {
    if (scale == CHART_LOG) {
        from = dp_log(from);
        to = dp_log(to);
        level = dp_log(level);
    }
    return (from < level) != (to < level) && isfinite(from) && isfinite(to) ? (level - from) / (to - from)
                                                                            : (double)NAN;
}

/* Marching squares on every CONTOUR_STRIDE-th point: lines as smooth to the eye, at a third of the size. The four edges
 * of a square, from corner to corner; corners: 0 1 below, 2 3 above. */
enum { CONTOUR_STRIDE = 3 };
static const int edges[4][2] = {{0, 1}, {1, 3}, {2, 3}, {0, 2}};

static void square_contour(const pencil *p, canvas_rect f, const chart_map *m, int column, int row, double level,
                           chart_scale scale) {
    double dx = f.w / m->columns, dy = f.h / m->rows, corner[4];
    int at[4][2], found = 0;
    for (int i = 0; i < 4; i++) {
        at[i][0] = (int)fmin(column + CONTOUR_STRIDE * (i & 1), m->columns - 1);
        at[i][1] = (int)fmin(row + CONTOUR_STRIDE * (i >> 1), m->rows - 1);
        corner[i] = *chart_field(m, at[i][1], at[i][0]);
        if (isnan(corner[i]))
            return;
    }
    for (int e = 0; e < 4; e++) {
        const int *from = at[edges[e][0]], *to = at[edges[e][1]];
        double t = crossing(corner[edges[e][0]], corner[edges[e][1]], level, scale);
        if (isnan(t))
            continue;
        if (found++ % 2 == 0)
            canvas_path_break(p->c);
        canvas_path_to(p->c, f.x + (from[0] + 0.5 + t * (to[0] - from[0])) * dx,
                       f.y + f.h - (from[1] + 0.5 + t * (to[1] - from[1])) * dy);
    }
}

static void draw_contour(const pencil *p, canvas_rect f, const chart_map *m, double level, chart_scale scale,
                         const canvas_pen *pen) {
    for (int row = 0; row + 1 < m->rows; row += CONTOUR_STRIDE)
        for (int column = 0; column + 1 < m->columns; column += CONTOUR_STRIDE)
            square_contour(p, f, m, column, row, level, scale);
    canvas_path_end(p->c, pen);
}

static double map_at(const chart_map *m, double x, double y) {
    int column = (int)fmin(x * m->columns, m->columns - 1), row = (int)fmin(y * m->rows, m->rows - 1);
    return *chart_field(m, row, column);
}

/* Where labels may not go: what is there already. */
typedef struct boxes {
    size_t count;
    canvas_rect at[TICKS_MAX];
} boxes;

static bool free_place(const boxes *taken, canvas_rect frame, canvas_rect r) {
    if (r.x < frame.x || r.y < frame.y || r.x + r.w > frame.x + frame.w || r.y + r.h > frame.y + frame.h)
        return false;
    for (size_t i = 0; i < taken->count; i++) {
        const canvas_rect *t = &taken->at[i];
        if (r.x < t->x + t->w && t->x < r.x + r.w && r.y < t->y + t->h && t->y < r.y + r.h)
            return false;
    }
    return taken->count < TICKS_MAX;
}

static bool draw_label(const pencil *p, canvas_rect f, boxes *taken, canvas_point at, const char *text) {
    canvas_font font = p->small;
    double half = canvas_text_width(p->c, text, &font) / 2, gap = 3 * p->scale;
    canvas_rect box = {at.x - half - gap, at.y - font.size / 2 - gap, 2 * (half + gap), font.size + 2 * gap};
    if (!free_place(taken, f, box))
        return false;
    taken->at[taken->count++] = box;
    font.colour = (canvas_colour){0, 0, 0, 1};
    font.halo = (canvas_colour){1, 1, 1, 0.8};
    canvas_text(p->c, at.x, at.y + 0.36 * font.size, text, &font, CANVAS_MIDDLE);
    return true;
}

/* One label a contour, where it meets a falling line: first the diagonal, the way on which such maps change most,
 * then its neighbours to both sides. */
static void draw_labels(const pencil *p, canvas_rect f, const chart_map *m, const ticks *levels, chart_scale scale,
                        boxes *taken) {
    enum { STEPS = 500 };
    static const double shifts[] = {0, 0.15, -0.15, 0.3, -0.3, 0.45, -0.45, 0.6, -0.6};
    for (size_t k = 0; k < levels->count; k++) {
        const tick *level = &levels->items[k];
        bool done = level->text[0] == '\0';
        for (size_t shift = 0; shift < sizeof shifts / sizeof *shifts && !done; shift++) {
            double before = (double)NAN;
            for (int i = 0; i < STEPS && !done; i++) {
                double x = (i + 0.5) / STEPS, y = 1 - x + shifts[shift];
                double value = y >= 0 && y < 1 ? map_at(m, x, y) : (double)NAN;
                if (!isnan(crossing(before, value, level->at, scale)))
                    done = draw_label(p, f, taken, (canvas_point){f.x + x * f.w, f.y + (1 - y) * f.h}, level->text);
                before = value;
            }
        }
    }
}

bool heat_draw(const pencil *p, const axes *a, const chart_panel *panel, const chart *c) {
    const chart_axis *value = &c->value;
    ticks levels;
    boxes taken = {0};
    const double half = 8 * p->scale;
    const chart_map *m = &panel->map;
    if (!c->bare && heat_has_holes(m))
        draw_hatch(p, a->frame);
    if (!draw_pixels(p, a->frame, c, panel))
        return false;
    if (!c->contours)
        return true;
    ticks_make(value, (int)fmax(7, axes_room_y(p, a->frame.h)), &levels); /* lines need less room than labels */
    for (size_t i = 0; i < levels.count; i++) {
        if (levels.items[i].text[0] == '\0')
            continue;
        bool dark = chart_axis_share(value, levels.items[i].at) < 0.6;
        canvas_pen pen = {.colour = {dark, dark, dark, dark ? 0.75 : 0.6}, .width = p->scale};
        draw_contour(p, a->frame, m, levels.items[i].at, value->scale, &pen);
    }
    for (size_t s = 0; s < panel->series_count; s++)
        for (size_t i = 0; panel->series[s].kind == CHART_POINTS && i < panel->series[s].count; i++)
            if (taken.count < TICKS_MAX)
                taken.at[taken.count++] = (canvas_rect){axes_x(a, panel->series[s].x[i]) - half,
                                                        axes_y(a, panel->series[s].y[i]) - half, 2 * half, 2 * half};
    draw_labels(p, a->frame, m, &levels, value->scale, &taken);
    return true;
}

uint32_t heat_direction(double x, double y, double z) {
    return (uint32_t)lrint(127.5 * (x + 1)) << 16 | (uint32_t)lrint(127.5 * (y + 1)) << 8 |
           (uint32_t)lrint(127.5 * (1 - z));
}

void heat_draw_ball(const pencil *p, canvas_rect area) {
    enum { SIDE = 128 };
    static const char *const meanings[] = {"red: right", "green: up", "blue: towards", "the camera"};
    uint32_t pixels[SIDE * SIDE];
    for (int i = 0; i < SIDE * SIDE; i++) {
        const double x = (i % SIDE + 0.5) * 2 / SIDE - 1, y = 1 - (i / SIDE + 0.5) * 2 / SIDE, rest = 1 - x * x - y * y;
        pixels[i] = rest < 0 ? 0 : 0xFF000000u | heat_direction(x, y, -sqrt(rest));
    }
    canvas_image(p->c, (canvas_rect){area.x, area.y, area.w, area.w}, SIDE, SIDE, pixels);
    for (size_t i = 0; i < sizeof meanings / sizeof meanings[0]; i++)
        canvas_text(p->c, area.x, area.y + area.w + (1.4 + 1.35 * (double)i) * p->small.size, meanings[i], &p->small,
                    CANVAS_LEFT);
}

void heat_draw_bar(const pencil *p, canvas_rect strip, const chart *c) {
    uint32_t pixels[BAR_STEPS];
    for (int i = 0; i < BAR_STEPS; i++)
        pixels[i] = theme_pixel(scale_colour(c, 1 - (i + 0.5) / BAR_STEPS));
    canvas_image(p->c, strip, 1, BAR_STEPS, pixels);
    axes a = {&c->value, &c->value, strip};
    axes_draw_scale(p, &a);
}
