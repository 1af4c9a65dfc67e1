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

/* The greater change of eye depth from one pixel to the next, at a place of the window where it is z. */
static double slope_at(const bias_drawing *d, const draw_plane *plane, const double window[2], double z) {
    const double right[2] = {window[0] + 0.5, window[1]}, left[2] = {window[0] - 0.5, window[1]};
    const double above[2] = {window[0], window[1] + 0.5}, below[2] = {window[0], window[1] - 0.5};
    const double across = draw_facing(d->camera, plane, right) - draw_facing(d->camera, plane, left);
    const double up = draw_facing(d->camera, plane, above) - draw_facing(d->camera, plane, below);
    return fmax(fabs(across), fabs(up)) * z * z / plane->distance;
}

bias_pixel bias_pixel_at(const bias_drawing *d, const bias_pair *pair, int x, int y) {
    const draw_area *area = &pair->area;
    const size_t at = (size_t)(y - area->y) * (size_t)area->width + (size_t)(x - area->x);
    const double window[2] = {x + 0.5, y + 0.5},
                 z = pair->plane.distance / draw_facing(d->camera, &pair->plane, window);
    const uint32_t below = d->layer[BELOW].key[at], biased = d->layer[BIASED].key[at];
    bias_pixel p = {.z = z};
    p.covered = d->layer[BELOW].seen[at] != 0 && d->layer[BIASED].seen[at] != 0 && z >= d->lo && z <= d->hi;
    if (p.covered && d->slope > 0.0) /* the centre that was aimed at has it but for rounding */
        p.covered = slope_at(d, &pair->plane, window, z) <= d->slope * (1.0 + 1e-9);
    if (!p.covered)
        return p;
    p.fights = biased >= below;
    p.code = draw_code(d->camera, below);
    p.moved = draw_code(d->camera, biased);
    return p;
}

/* A normal whose plane has that slope at z: steepest along x, y or neither. */
static void normal_of_slope(const bias_drawing *d, const double window[2], double z, uint64_t *state, double n[3]) {
    const draw_camera *c = d->camera;
    const double share = 2.0 * draw_uniform(state) - 1.0, sign = draw_random(state) % 2 == 0 ? 1.0 : -1.0;
    const bool along = draw_random(state) % 2 == 0;
    const double x = d->slope * (along ? sign : share), y = d->slope * (along ? share : sign);
    double ray[3];
    draw_ray(c, window, ray);
    n[0] = -x / z * (0.5 * c->target.width * (double)c->p00);
    n[1] = -y / z * (0.5 * c->target.height * (double)c->p11);
    n[2] = 1.0 - n[0] * ray[0] - n[1] * ray[1]; /* 1 along the ray */
    const double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int i = 0; i < 3; i++)
        n[i] /= length;
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
    if (d->slope > 0.0) {
        normal_of_slope(d, window, z, state, out->plane.normal);
        out->slant = dp_atan2(dp_hypot(out->plane.normal[0], out->plane.normal[1]), out->plane.normal[2]) / DP_DEGREE;
    }
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
