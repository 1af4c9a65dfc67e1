/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "texture/normal_errors.h"

#include <math.h>
#include <stdlib.h>

#include <gsl/gsl_sort_float.h>

enum { RING = 2 * NORMAL_REACH + 1 };

/* ---- A whole image: the rows that a method looks at go round in a ring, so any height takes the same room ---------
 */

typedef struct ring {
    size_t stride;
    float *empty;       /* stands for the rows beyond the border */
    float *slope;       /* with margins */
    float *lines[RING]; /* row r is in lines[r % RING]; margins are NaN */
    float *normal[3];
    float *block;
} ring;

static bool ring_open(ring *r, const texture_camera *camera) {
    r->stride = (size_t)camera->width + 2 * NORMAL_REACH;
    const size_t blocks = RING + 5;
    r->block = malloc(blocks * r->stride * sizeof *r->block);
    if (r->block == NULL)
        return false;
    for (size_t i = 0; i < (RING + 1) * r->stride; i++)
        r->block[i] = NAN;
    for (int i = 0; i < RING; i++)
        r->lines[i] = r->block + (size_t)i * r->stride + NORMAL_REACH;
    r->empty = r->block + RING * r->stride + NORMAL_REACH;
    for (int i = 0; i < 3; i++)
        r->normal[i] = r->block + (size_t)(RING + 1 + i) * r->stride;
    r->slope = r->block + (RING + 4) * r->stride + NORMAL_REACH;
    for (int i = -NORMAL_REACH; i < (int)camera->width + NORMAL_REACH; i++)
        r->slope[i] = (float)camera_slope_x(camera, i);
    return true;
}

bool normal_run(const normal_row *method, const texture_camera *camera, uint32_t first, uint32_t count,
                normal_source source, normal_sink sink, void *context) {
    ring r;
    if (!ring_open(&r, camera))
        return false;
    const int64_t reach = method->reach, height = camera->height;
    int64_t filled = (int64_t)first - reach > 0 ? (int64_t)first - reach : 0;
    for (int64_t row = first; row < (int64_t)first + count && row < height; row++) {
        for (; filled <= row + reach && filled < height; filled++)
            source(context, (uint32_t)filled, r.lines[filled % RING]);
        normal_rows in = {.camera = camera, .row = (uint32_t)row, .count = camera->width, .slope_x = r.slope};
        for (int64_t k = -NORMAL_REACH; k <= NORMAL_REACH; k++) {
            const int64_t at = row + k;
            const bool there = at >= 0 && at < height && k >= -reach && k <= reach;
            in.rows[NORMAL_REACH + k] = there ? r.lines[at % RING] : r.empty;
        }
        method->run(&in, r.normal[0], r.normal[1], r.normal[2]);
        sink(context, &in, (const float *const *)r.normal);
    }
    free(r.block);
    return true;
}

/* ---- A synthetic image's own normals ----------------------------------------------------------------------------- */

typedef struct measuring {
    const normal_row *method;
    const texture_camera *camera;
    const synthetic_row *synthetic;
    const double *parameters;
    size_t width;
    synthetic_hit *hits; /* rows in a ring, as normal_run() keeps the depths */
    uint8_t *sides;
    float *angles; /* inside from the front, edges from the back */
    size_t room;
    normal_measured *out;
} measuring;

static void store(void *context, uint32_t row, float *eye) {
    measuring *m = context;
    synthetic_hit *hits = m->hits + row % RING * m->width;
    const dp_setup *setup = &m->camera->setup;
    for (uint32_t i = 0; i < m->width; i++) {
        m->synthetic->hit(m->camera, m->parameters, i, row, &hits[i]);
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

static void add_angle(normal_spread *s, double angle, uint32_t column, uint32_t row) {
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
        const synthetic_hit *hit = &m->hits[in->row % RING * m->width + i];
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
        add_angle(s, angle, i, in->row);
        m->angles[inside ? s->count - 1 : m->room - s->count] = (float)angle;
    }
}

static void finish(normal_spread *s, float *angles) {
    if (s->count == 0) {
        s->mean = s->p99 = s->max = (double)NAN;
        return;
    }
    gsl_sort_float(angles, 1, s->count);
    s->mean /= (double)s->count;
    s->p99 = fmin((double)angles[(s->count * 99 + 99) / 100 - 1], s->max);
}

bool normal_measure(const normal_row *method, const texture_camera *camera, const synthetic_row *synthetic,
                    const double *parameters, uint32_t first, uint32_t count, normal_measured *out) {
    *out = (normal_measured){0};
    measuring m = {.method = method,
                   .camera = camera,
                   .synthetic = synthetic,
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
