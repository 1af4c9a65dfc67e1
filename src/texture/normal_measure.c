/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "texture/normal_measure.h"

#include <math.h>
#include <stdlib.h>

enum { RING = 2 * NORMAL_REACH + 1 };

typedef struct measuring {
    const normal_row *method;
    const texture_camera *camera;
    const scene_row *scene;
    const double *parameters;
    size_t width;
    scene_hit *hits; /* rows in a ring, as normal_run() keeps the depths */
    uint8_t *sides;
    float *angles; /* inside from the front, edges from the back */
    size_t room;
    normal_measured *out;
} measuring;

static void store(void *context, uint32_t row, float *eye) {
    measuring *m = context;
    scene_hit *hits = m->hits + row % RING * m->width;
    const dp_setup *setup = &m->camera->setup;
    for (uint32_t i = 0; i < m->width; i++) {
        m->scene->hit(m->camera, m->parameters, i, row, &hits[i]);
        eye[i] = hits[i].surface == 0 ? NAN : (float)dp_stored(setup, dp_code(setup, hits[i].z));
    }
}

enum { BEYOND = -1 }; /* the border */

static int surface(const measuring *m, int64_t column, int64_t row) {
    if (column < 0 || row < 0 || column >= (int64_t)m->width || row >= m->camera->height)
        return BEYOND;
    return m->hits[(size_t)(row % RING) * m->width + (size_t)column].surface;
}

static bool alone(const measuring *m, int64_t column, int64_t row, int own) {
    for (int k = m->method->step; k <= m->method->reach; k += m->method->step) {
        const int around[4] = {surface(m, column - k, row), surface(m, column + k, row), surface(m, column, row - k),
                               surface(m, column, row + k)};
        for (int i = 0; i < 4; i++)
            if (around[i] != own && around[i] != BEYOND)
                return false;
    }
    return true;
}

static bool wrong_side(const measuring *m, int64_t column, int64_t row, int own, uint8_t sides) {
    const int x = sides & NORMAL_LEFT ? -m->method->step : m->method->step;
    const int y = sides & NORMAL_BELOW ? m->method->step : -m->method->step;
    return (surface(m, column + x, row) != own && surface(m, column - x, row) == own) ||
           (surface(m, column, row + y) != own && surface(m, column, row - y) == own);
}

static void add(normal_spread *s, double angle, uint32_t column, uint32_t row) {
    if (s->count++ == 0 || angle > s->max) {
        s->max = angle;
        s->column = column;
        s->row = row;
    }
    s->mean += angle;
}

static void compare(void *context, const normal_rows *in, const float *const normal[3]) {
    measuring *m = context;
    m->method->sides(in, m->sides);
    for (uint32_t i = 0; i < m->width; i++) {
        const scene_hit *hit = &m->hits[in->row % RING * m->width + i];
        const double found[3] = {(double)normal[0][i], (double)normal[1][i], (double)normal[2][i]};
        if (hit->surface == 0) {
            m->out->sky++;
            continue;
        }
        m->out->drawn++;
        const double angle = normal_angle(hit->normal, found);
        if (isnan(angle)) {
            m->out->missing++;
            continue;
        }
        m->out->wrong += wrong_side(m, i, in->row, hit->surface, m->sides[i]);
        const bool inside = alone(m, i, in->row, hit->surface);
        normal_spread *s = inside ? &m->out->inside : &m->out->edges;
        add(s, angle, i, in->row);
        m->angles[inside ? s->count - 1 : m->room - s->count] = (float)angle;
    }
}

static int ascending(const void *a, const void *b) {
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

static void finish(normal_spread *s, float *angles) {
    if (s->count == 0) {
        s->mean = s->p99 = s->max = (double)NAN;
        return;
    }
    qsort(angles, s->count, sizeof *angles, ascending);
    s->mean /= (double)s->count;
    s->p99 = fmin((double)angles[(s->count * 99 + 99) / 100 - 1], s->max);
}

bool normal_measure(const normal_row *method, const texture_camera *camera, const scene_row *scene,
                    const double *parameters, uint32_t first, uint32_t count, normal_measured *out) {
    *out = (normal_measured){0};
    measuring m = {.method = method,
                   .camera = camera,
                   .scene = scene,
                   .parameters = parameters,
                   .width = camera->width,
                   .room = (size_t)camera->width * count,
                   .out = out};
    m.hits = malloc(RING * m.width * sizeof *m.hits);
    m.sides = malloc(m.width);
    m.angles = malloc(m.room * sizeof *m.angles);
    const bool good = m.hits != NULL && m.sides != NULL && m.angles != NULL &&
                      normal_run(method, camera, first, count, store, compare, &m);
    if (good) {
        finish(&out->inside, m.angles);
        finish(&out->edges, m.angles + m.room - out->edges.count);
    }
    free(m.hits);
    free(m.sides);
    free(m.angles);
    return good;
}
