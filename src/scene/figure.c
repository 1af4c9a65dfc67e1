/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The surfaces of a model that fight, from above and from the side: the model in grey, the darker the farther from the
 * one who looks, and on it where surfaces overlap, in the colour of the depth from which on they can fight. What lies
 * behind other parts of the model is shown, too.
 */
#include "scene/figure.h"

#include <math.h>
#include <stdio.h>

#include "core/elementary.h"
#include "plot/figure.h"

enum { NUMBERED = 9, EYES_MOST = 256, FIELDS_LEAST = 64, FIELDS_MOST = 2048 };

/* The margin around the model, a share of the width; the extreme shapes of a panel, width over height. */
static const double margin = 0.04, widest = 8.0, narrowest = 0.6;

/* Which coordinates lie across and upwards, and along which one looks: up or down it. */
typedef struct view {
    const char *title;
    int across, up, along;
    bool down, upward; /* `up` grows downwards; one looks the way in which `along` grows */
} view;

static const view views[2][2] = {
    {{"From above: x to the right, z downwards", 0, 2, 1, true, false},
     {"From the front: x to the right, y upwards", 0, 1, 2, false, false}},
    {{"From above: z to the right, x upwards", 2, 0, 1, false, false},
     {"From the side: z to the right, y upwards", 2, 1, 0, false, true}},
};

typedef struct box {
    double lo[3], hi[3];
} box;

/* ---- Fields ------------------------------------------------------------------------------------------------------ */

/* A place in fields from the lower left corner of a map, and a value there. */
typedef struct spot {
    double x, y, value;
} spot;

typedef struct sheet {
    const chart_panel *panel;
    double *field; /* the least value that was put there; NaN: none */
} sheet;

static void put(const sheet *s, double x, double y, double value) {
    const chart_map *m = &s->panel->map;
    if (!(x >= 0.0 && x < m->columns && y >= 0.0 && y < m->rows))
        return;
    double *field = &s->field[(size_t)y * (size_t)m->columns + (size_t)x];
    *field = isnan(*field) || value < *field ? value : *field;
}

/* The fields that a line runs through, so that what is thin or seen from its edge is seen at all. */
static void put_line(const sheet *s, const spot *a, const spot *b) {
    const int steps = (int)ceil(fmax(fabs(b->x - a->x), fabs(b->y - a->y)));
    for (int i = 0; i <= steps; i++) {
        const double t = steps > 0 ? (double)i / steps : 0.0;
        put(s, a->x + t * (b->x - a->x), a->y + t * (b->y - a->y), a->value + t * (b->value - a->value));
    }
}

/* Where the edges of a triangle cross the middle of a row: the leftmost and the rightmost place. */
static bool crossings(const spot corner[3], double y, spot *left, spot *right) {
    *left = (spot){.x = HUGE_VAL};
    *right = (spot){.x = -HUGE_VAL};
    for (int i = 0; i < 3; i++) {
        const spot *a = &corner[i], *b = &corner[(i + 1) % 3];
        if ((a->y < y) == (b->y < y))
            continue;
        const double t = (y - a->y) / (b->y - a->y);
        const spot at = {a->x + t * (b->x - a->x), y, a->value + t * (b->value - a->value)};
        *left = at.x < left->x ? at : *left;
        *right = at.x > right->x ? at : *right;
    }
    return left->x <= right->x;
}

static void put_triangle(const sheet *s, const spot corner[3]) {
    const double lo = fmin(fmin(corner[0].y, corner[1].y), corner[2].y);
    const double hi = fmax(fmax(corner[0].y, corner[1].y), corner[2].y);
    for (int i = 0; i < 3; i++)
        put_line(s, &corner[i], &corner[(i + 1) % 3]);
    for (double y = floor(lo) + 0.5; y < hi; y++) {
        spot left, right;
        if (!crossings(corner, y, &left, &right))
            continue;
        const double steep = right.x > left.x ? (right.value - left.value) / (right.x - left.x) : 0.0;
        for (double x = ceil(left.x - 0.5) + 0.5; x < right.x; x++)
            put(s, x, y, left.value + steep * (x - left.x));
    }
}

/* ---- A view ------------------------------------------------------------------------------------------------------ */

static spot spot_of(const chart_panel *p, const view *v, const double place[3], double value) {
    return (spot){chart_axis_share(&p->x, place[v->across]) * p->map.columns,
                  chart_axis_share(&p->y, place[v->up]) * p->map.rows, value};
}

/* The model, by its distance from the one who looks: 0 where it is nearest, 1 at its far side. */
static void draw_model(const fights_asked *a, const view *v, const box *all, const sheet *s) {
    const double deep = all->hi[v->along] - all->lo[v->along];
    for (size_t t = 0; t < a->m->triangles; t++) {
        spot corner[3];
        for (int i = 0; i < 3; i++) {
            const double *p = a->m->position[a->m->triangle[t][i]];
            const double off = v->upward ? p[v->along] - all->lo[v->along] : all->hi[v->along] - p[v->along];
            corner[i] = spot_of(s->panel, v, p, deep > 0.0 ? off / deep : 0.0);
        }
        put_triangle(s, corner);
    }
}

/* Draws the findings; one that fights at every depth has the lower end of the scale. */
static void draw_overlaps(const fights_asked *a, const view *v, const sheet *s, double lowest) {
    for (size_t i = 0; i < a->count; i++) {
        const finder_finding *f = a->item[i].finding;
        const double from = isnan(a->item[i].from) ? lowest : a->item[i].from;
        for (size_t k = f->first; k < f->first + f->pairs; k++) {
            double corner[FINDER_CORNERS][3];
            const int corners = finder_corners(a->m, a->found->pair[k].triangle, a->gap, corner);
            for (int c = 2; c < corners; c++) {
                const spot fan[3] = {spot_of(s->panel, v, corner[0], from), spot_of(s->panel, v, corner[c - 1], from),
                                     spot_of(s->panel, v, corner[c], from)};
                put_triangle(s, fan);
            }
        }
    }
}

/* Numbered as text does. */
static void add_numbers(const fights_asked *a, const view *v, chart *out, chart_panel *panel) {
    const size_t count = a->count < NUMBERED ? a->count : NUMBERED;
    chart_series *s = count > 0 ? chart_add_series(out, panel, CHART_POINTS, count) : NULL;
    if (s == NULL)
        return;
    s->style = (chart_style){.colour = -1, .stroke = 1, .thin = true};
    snprintf(s->name, sizeof s->name, "%s", count > 1 ? "the nearest pairs, numbered as in scene" : "the pair");
    s->labels = chart_memory(out, count, sizeof *s->labels);
    for (size_t i = 0; i < count && s->labels != NULL; i++) {
        s->x[i] = a->item[i].finding->place[v->across];
        s->y[i] = a->item[i].finding->place[v->up];
        snprintf(s->labels[i], sizeof s->labels[i], "%zu", i + 1);
    }
}

static void add_eyes(const fights_asked *a, const view *v, chart *out, chart_panel *panel) {
    chart_series *s = a->eyes > 0 && a->eyes <= EYES_MOST ? chart_add_series(out, panel, CHART_POINTS, a->eyes) : NULL;
    if (s == NULL)
        return;
    s->style = (chart_style){.colour = 1, .marker = 3};
    snprintf(s->name, sizeof s->name, "%s", a->eyes > 1 ? "the eyes" : "the eye");
    for (size_t i = 0; i < a->eyes; i++) {
        s->x[i] = a->eye[i].place[v->across];
        s->y[i] = a->eye[i].place[v->up];
    }
}

static double *empty_fields(chart *out, const chart_map *m) {
    const size_t count = (size_t)m->columns * (size_t)m->rows;
    double *field = chart_memory(out, count, sizeof *field);
    for (size_t i = 0; field != NULL && i < count; i++)
        field[i] = (double)NAN;
    return field;
}

static chart_axis axis_about(const box *all, int k, double length, const char *key) {
    const double middle = all->lo[k] / 2.0 + all->hi[k] / 2.0;
    return (chart_axis){.lo = middle - length / 2.0, .hi = middle + length / 2.0, .key = key, .unit = "scene units"};
}

static void add_view(const figure_request *r, const view *v, const box *all, double width, double height, chart *out) {
    static const char *const names[] = {"x", "y", "z"};
    const fights_asked *a = r->fights;
    const int columns = (int)fmin(fmax(r->columns, FIELDS_LEAST), FIELDS_MOST);
    chart_panel *panel = chart_add_panel(out);
    panel->x = axis_about(all, v->across, width, "across");
    panel->x.label = names[v->across];
    panel->y = axis_about(all, v->up, height, "up");
    panel->y.label = v->across == 0 ? "z, y" : "x, y";
    panel->y.scale = v->down ? CHART_DOWN : CHART_LINEAR;
    snprintf(panel->title, sizeof panel->title, "%s", v->title);
    if (!chart_add_map(out, panel, columns, (int)fmax(columns * height / width, 1.0)))
        return;
    panel->map.value = empty_fields(out, &panel->map);
    panel->map.under = empty_fields(out, &panel->map);
    if (panel->map.value == NULL || panel->map.under == NULL)
        return;
    draw_model(a, v, all, &(sheet){panel, panel->map.under});
    draw_overlaps(a, v, &(sheet){panel, panel->map.value}, out->value.lo);
    add_numbers(a, v, out, panel);
    add_eyes(a, v, out, panel);
}

/* ---- The chart --------------------------------------------------------------------------------------------------- */

static void reach(box *b, const double place[3]) {
    for (int k = 0; k < 3; k++) {
        b->lo[k] = fmin(b->lo[k], place[k]);
        b->hi[k] = fmax(b->hi[k], place[k]);
    }
}

/* The box of the model and the eyes. */
static box box_of(const fights_asked *a) {
    box b = {{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
    for (size_t i = 0; i < 3 * a->m->triangles; i++)
        reach(&b, a->m->position[a->m->triangle[i / 3][i % 3]]);
    for (size_t i = 0; i < a->eyes && a->eyes <= EYES_MOST; i++)
        reach(&b, a->eye[i].place);
    return b;
}

/* The scale from the nearest fight to the farthest, without the bright end, hard to tell from the model. */
static chart_axis depths_of(const fights_asked *a) {
    chart_axis axis = {.label = "may z-fight from", .key = "fights_from", .unit = "scene units", .scale = CHART_LOG};
    axis.lo = (double)INFINITY;
    bool always = false;
    for (size_t i = 0; i < a->count; i++) {
        always = always || isnan(a->item[i].from);
        axis.lo = fmin(axis.lo, a->item[i].from); /* without NaN */
        axis.hi = fmax(axis.hi, a->item[i].from);
    }
    if (!(axis.lo <= axis.hi)) /* nothing to show, or nothing that is ever certain */
        axis.lo = axis.hi = 1.0;
    axis.hi = fmax(axis.hi, 2.0 * axis.lo);
    const double beyond = dp_pow(axis.hi / axis.lo, 0.2);
    axis.hi *= beyond;
    axis.lo /= always ? beyond : 1.0; /* the darkest is then of nothing that is certain up to some depth */
    return axis;
}

/* The extent given to a direction that has none: enough for an axis. */
static double least_of(const box *all, double extent) {
    double least = 1e-6 * extent;
    for (int k = 0; k < 3; k++)
        least = fmax(least, 1e-9 * fmax(fabs(all->lo[k]), fabs(all->hi[k])));
    return least > 0.0 ? least : 1.0;
}

const char *scene_build(const figure_request *request, chart *out) {
    const fights_asked *a = request->fights;
    const box all = box_of(a);
    double size[3], height[2];
    if (a->m->triangles == 0)
        return "plot scene: the model has no triangles";
    const double least = least_of(&all, a->found->extent);
    for (int k = 0; k < 3; k++)
        size[k] = fmax(all.hi[k] - all.lo[k], least);
    const view *both = views[size[2] > size[0]];
    const double width = fmax(size[both[0].across], narrowest * fmax(size[both[0].up], size[both[1].up]));
    const double around = 2.0 * margin * width;
    for (int i = 0; i < 2; i++)
        height[i] = fmax(size[both[i].up], width / widest) + around;
    out->shape = (width + around) / (height[0] + height[1]);
    out->stacked = true;
    out->bare = true;
    out->value = depths_of(a);
    out->ground = (chart_axis){.lo = -0.15, .hi = 2.2}; /* neither white nor as dark as what is marked */
    for (int i = 0; i < 2; i++)
        add_view(request, &both[i], &all, width + around, height[i], out);
    return NULL;
}
