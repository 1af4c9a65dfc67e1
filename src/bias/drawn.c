/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bias/drawn.h"

#include <math.h>

#include "core/elementary.h"

enum { BELOW = 0, BIASED };

/* Planes nearer to edge-on than that have no depth. */
static const double least_facing = 1e-9;

bool bias_drawing_open(bias_drawing *d) {
    const bool below = draw_buffer_open(&d->layer[BELOW], DRAW_MESH_ROOM);
    return draw_buffer_open(&d->layer[BIASED], DRAW_MESH_ROOM) && below;
}

void bias_drawing_close(bias_drawing *d) {
    draw_buffer_close(&d->layer[BELOW]);
    draw_buffer_close(&d->layer[BIASED]);
}

static float offset_of(const void *of, float most, float slope) {
    const bias_drawing *d = of;
    const double r = bias_unit_at(d->state->api, &d->setup->spec.format, (double)most).least;
    return (float)bias_offset(d->state, r, (double)slope);
}

void bias_draw_pair(bias_drawing *d, const bias_pair *pair) {
    draw_camera camera = *d->camera;
    for (int k = BELOW; k <= BIASED; k++) {
        camera.bias = k == BIASED ? offset_of : NULL;
        camera.bias_of = d;
        draw_buffer_clear(&d->layer[k], pair->area);
        draw_mesh_plane(&d->layer[k], &camera, &pair->plane, &pair->mesh[k], &d->setup->spec.triangles, 1);
    }
}

bias_pixel bias_pixel_at(const bias_drawing *d, const bias_pair *pair, int x, int y) {
    const draw_area *area = &pair->area;
    const size_t at = (size_t)(y - area->y) * (size_t)area->width + (size_t)(x - area->x);
    const double window[2] = {x + 0.5, y + 0.5},
                 z = pair->plane.distance / draw_facing(d->camera, &pair->plane, window);
    const uint32_t below = d->layer[BELOW].key[at], biased = d->layer[BIASED].key[at];
    bias_pixel p = {.z = z};
    p.covered = d->layer[BELOW].seen[at] != 0 && d->layer[BIASED].seen[at] != 0 && z >= d->lo && z <= d->hi;
    if (!p.covered)
        return p;
    p.fights = biased >= below;
    p.code = draw_code(d->camera, below);
    p.moved = draw_code(d->camera, biased);
    return p;
}

/* False where the plane is not seen at the pixel. */
static bool random_pair(const bias_drawing *d, uint64_t *state, bias_pair *out) {
    const dp_triangles *t = &d->setup->spec.triangles;
    const int x = (int)(draw_random(state) % (uint64_t)d->camera->target.width);
    const int y = (int)(draw_random(state) % (uint64_t)d->camera->target.height);
    const double window[2] = {x + 0.5, y + 0.5}, azimuth = 2.0 * M_PI * draw_uniform(state);
    out->slant = 90.0 * draw_uniform(state);
    const double angle = out->slant * DP_DEGREE, z = draw_log_uniform(state, d->lo, d->hi);
    out->plane =
        (draw_plane){.normal = {dp_sin(angle) * dp_cos(azimuth), dp_sin(angle) * dp_sin(azimuth), dp_cos(angle)}};
    for (int k = BELOW; k <= BIASED; k++) {
        out->mesh[k] = draw_mesh_random(t, window, state);
        out->mesh[k].lowest = BIAS_DRAWN_LOWEST;
    }
    out->area = draw_mesh_area(d->camera, x, y, out->mesh);
    const double facing = draw_facing(d->camera, &out->plane, window);
    out->plane.distance = z * facing;
    return facing > least_facing;
}

/* Counts the pixels of a pair, and keeps one that fights where no pair before had more of them. */
static void count_pair(const bias_drawing *d, const bias_pair *pair, bias_drawn *out) {
    bias_pixel found = {0};
    uint64_t fights = 0;
    int at_x = 0, at_y = 0;
    for (int y = pair->area.y; y < pair->area.y + pair->area.height; y++)
        for (int x = pair->area.x; x < pair->area.x + pair->area.width; x++) {
            const bias_pixel p = bias_pixel_at(d, pair, x, y);
            out->pixels += p.covered;
            if (!p.fights)
                continue;
            if (fights++ == 0) {
                found = p;
                at_x = x;
                at_y = y;
            }
        }
    out->fights += fights;
    if (fights <= out->most)
        return;
    out->most = fights;
    out->pair = *pair;
    out->pixel = found;
    out->x = at_x;
    out->y = at_y;
}

bias_drawn bias_draw(bias_drawing *d, uint64_t count, uint64_t seed) {
    bias_drawn out = {.pixels = 0};
    bool any = false;
    for (uint64_t i = 0; i < count; i++) {
        uint64_t state = seed ^ (i << 20);
        bias_pair pair;
        state = draw_random(&state);
        if (!random_pair(d, &state, &pair))
            continue;
        bias_draw_pair(d, &pair);
        out.pair = any ? out.pair : pair;
        any = true;
        count_pair(d, &pair, &out);
    }
    return out;
}
