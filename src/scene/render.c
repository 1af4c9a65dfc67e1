/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Twice over all triangles: first who is seen in each pixel, then who of the others should be. Between the two stands
 * the depth of what is seen, in double.
 */
#include "scene/render.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/outward.h"

enum { TOLD_EVERY = 1 << 14 };

/* The share of places and depths that rounding loses; the largest share of a depth that counts as no difference. */
static const double rounding = DP_ROUNDINGS_126, same_most = 0x1p-30;

typedef double vector[3];

static double dot(const vector a, const vector b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const vector a, const vector b, vector out) {
    const vector v = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    memcpy(out, v, sizeof v);
}

static const double *corner_of(const model *m, size_t i) {
    return m->position[m->triangle[i / 3][i % 3]];
}

/* ---- Triangles --------------------------------------------------------------------------------------------------- */

/* A triangle in eye space, and what a ray (x, y, 1) meets of it. */
typedef struct seen {
    vector place[3];
    vector inverse; /* its product with a ray: 1 over the depth there */
    vector edge[3]; /* all three products are above 0 inside */
    double length;  /* of `inverse` */
} seen;

typedef struct rendering {
    const render_asked *asked;
    render_picture *out;
    double reach;     /* the largest coordinate */
    uint32_t *stored; /* what the depth test compares */
    double *depth;    /* 1 over that of what is shown; infinite: nothing is nearer */
    uint32_t who;     /* is being drawn, */
    seen what;
} rendering;

/* False where it is not drawn: it shows its back, or its edge. */
static bool look_at(const rendering *r, uint32_t t, seen *out) {
    const model *m = r->asked->m;
    const model_surface *surface = &m->surface[m->of[t]];
    vector side[2], normal;
    for (int i = 0; i < 3; i++)
        scene_eye_sees(&r->asked->eye, m->position[m->triangle[t][i]], out->place[i]);
    for (int k = 0; k < 3; k++) {
        side[0][k] = out->place[1][k] - out->place[0][k];
        side[1][k] = out->place[2][k] - out->place[0][k];
    }
    cross(side[0], side[1], normal);
    const double volume = dot(normal, out->place[0]); /* eye space is left-handed: above 0 from the front */
    if (!(fabs(volume) > 0.0) || (volume < 0.0 && !surface->two_sided && !r->asked->any_side) ||
        (surface->blended && !r->asked->blended))
        return false;
    for (int i = 0; i < 3; i++) {
        cross(out->place[i], out->place[(i + 1) % 3], out->edge[i]);
        for (int k = 0; k < 3; k++)
            out->edge[i][k] = volume > 0.0 ? out->edge[i][k] : -out->edge[i][k];
        out->inverse[i] = normal[i] / volume;
    }
    out->length = sqrt(dot(out->inverse, out->inverse));
    return true;
}

static bool meets(const seen *s, const vector ray) {
    return dot(s->edge[0], ray) > 0.0 && dot(s->edge[1], ray) > 0.0 && dot(s->edge[2], ray) > 0.0;
}

/* The share of a depth that its rounding may be. */
static double unsure(const rendering *r, const seen *s, const vector ray, double inverse) {
    const double slant = fabs(inverse) / (s->length * sqrt(dot(ray, ray)));
    return fmin(rounding * r->reach * fabs(inverse) / slant, same_most);
}

static void ray_of(const rendering *r, int x, int y, vector ray) {
    const double window[2] = {x + 0.5, y + 0.5};
    draw_ray(r->asked->camera, window, ray);
}

/* ---- The two passes ---------------------------------------------------------------------------------------------- */

static void show(void *context, int x, int y, int count, const uint32_t *key) {
    const rendering *r = context;
    const size_t at = (size_t)y * (size_t)r->out->width + (size_t)x;
    for (int i = 0; i < count; i++)
        if (key[i] < r->stored[at + (size_t)i]) {
            r->stored[at + (size_t)i] = key[i];
            r->out->shown[at + (size_t)i] = r->who;
        }
}

/* Whether the planes of what is drawn and of what is shown cross within the pixel: each is in front in a part of it. */
static bool crosses(const rendering *r, int x, int y, uint32_t shown) {
    seen other;
    if (!look_at(r, shown, &other))
        return false;
    for (int k = 0; k < 4; k++) {
        const double window[2] = {x + k % 2, y + k / 2};
        vector ray;
        draw_ray(r->asked->camera, window, ray);
        const double inverse = dot(r->what.inverse, ray), shows = dot(other.inverse, ray);
        const double share = fmax(unsure(r, &r->what, ray, inverse), unsure(r, &other, ray, shows));
        if (shows > inverse + share * fabs(inverse)) /* both are below 0 at a corner beyond the plane's horizon */
            return true;
    }
    return false;
}

/* Who would be seen, so far: the depth is then that one's. */
static void compare(void *context, int x, int y, int count, const uint32_t *key) {
    const rendering *r = context;
    const size_t row = (size_t)y * (size_t)r->out->width;
    (void)key;
    for (int i = x; i < x + count; i++) {
        const size_t at = row + (size_t)i;
        vector ray;
        ray_of(r, i, y, ray);
        const double inverse = dot(r->what.inverse, ray), shown = r->depth[at];
        if (inverse < shown * (1.0 - same_most) || r->out->shown[at] == r->who || !meets(&r->what, ray))
            continue;
        const bool first = r->out->nearer[at] == RENDER_NOTHING;
        if (!(first ? inverse >= shown * (1.0 - unsure(r, &r->what, ray, inverse)) : inverse > shown) ||
            crosses(r, i, y, r->out->shown[at]))
            continue;
        r->out->wrong += first;
        r->out->nearer[at] = r->who;
        r->depth[at] = inverse;
    }
}

static render_status pass(rendering *r, draw_take *take, double done) {
    const model *m = r->asked->m;
    const draw_area all = {0, 0, r->out->width, r->out->height};
    for (uint32_t t = 0; t < m->triangles; t++) {
        r->who = t;
        if (look_at(r, t, &r->what))
            draw_keys(r->asked->camera, &all, (const double(*)[3])r->what.place, take, r);
        if (t % TOLD_EVERY == 0 && r->asked->progress != NULL &&
            r->asked->progress(r->asked->context, done + 0.5 * t / (double)m->triangles) != 0)
            return RENDER_STOPPED;
    }
    return RENDER_DONE;
}

/* The depths of the triangles shown; where a ray passes its triangle by, no depth is nearer. */
static void take_depths(rendering *r) {
    const render_picture *p = r->out;
    uint32_t last = RENDER_NOTHING;
    seen what = {0};
    for (size_t i = 0; i < (size_t)p->width * (size_t)p->height; i++) {
        vector ray;
        r->depth[i] = (double)INFINITY;
        if (p->shown[i] == RENDER_NOTHING)
            continue;
        if (p->shown[i] != last)
            look_at(r, last = p->shown[i], &what);
        ray_of(r, (int)(i % (size_t)p->width), (int)(i / (size_t)p->width), ray);
        if (meets(&what, ray))
            r->depth[i] = dot(what.inverse, ray);
    }
}

static double resolved_up_to(const render_asked *asked) {
    double most = 0.0;
    for (size_t i = 0; i < 3 * asked->m->triangles; i++)
        for (int k = 0; k < 3; k++)
            most = fmax(most, fabs(corner_of(asked->m, i)[k]));
    for (int k = 0; k < 3; k++)
        most = fmax(most, fabs(asked->eye.place[k]));
    return most;
}

static render_status draw_all(rendering *r, size_t count) {
    r->stored = malloc(count * sizeof *r->stored);
    r->depth = malloc(count * sizeof *r->depth);
    if (r->stored == NULL || r->depth == NULL || r->out->shown == NULL || r->out->nearer == NULL)
        return RENDER_NO_MEMORY;
    memset(r->stored, 0xFF, count * sizeof *r->stored);
    memset(r->out->shown, 0xFF, count * sizeof *r->out->shown);
    memset(r->out->nearer, 0xFF, count * sizeof *r->out->nearer);
    const render_status status = pass(r, show, 0.0);
    if (status != RENDER_DONE)
        return status;
    take_depths(r);
    return pass(r, compare, 0.5);
}

render_status render_draw(const render_asked *asked, render_picture *out) {
    const raster_target *target = &asked->camera->target;
    const size_t count = (size_t)target->width * (size_t)target->height;
    rendering r = {.asked = asked, .out = out, .reach = resolved_up_to(asked)};
    if (count > RENDER_PIXELS_MAX || !(r.reach <= RENDER_REACH))
        return RENDER_RANGE;
    *out = (render_picture){.width = target->width,
                            .height = target->height,
                            .shown = malloc(count * sizeof *out->shown),
                            .nearer = malloc(count * sizeof *out->nearer)};
    const render_status status = draw_all(&r, count);
    free(r.stored);
    free(r.depth);
    if (status != RENDER_DONE)
        render_free(out);
    return status;
}

void render_free(render_picture *p) {
    free(p->shown);
    free(p->nearer);
    *p = (render_picture){0};
}

/* ---- Colours ----------------------------------------------------------------------------------------------------- */

static uint32_t grey(double share) {
    const uint32_t v = (uint32_t)lrint(255.0 * fmin(fmax(share, 0.0), 1.0));
    return 0xFF000000U | v << 16 | v << 8 | v;
}

/* The grey of a triangle that was drawn. */
static uint32_t shade(const rendering *r, uint32_t t) {
    static const vector light = {0.25, 0.5, -0.8}; /* in eye space: above the camera, to its right */
    static const double levels[] = {1.0, 0.84, 0.92, 0.76};
    seen what;
    if (!look_at(r, t, &what))
        return grey(0.0);
    const double facing = -dot(what.inverse, light) / (what.length * sqrt(dot(light, light)));
    return grey((0.4 + 0.55 * fmax(facing, 0.0)) * levels[r->asked->m->of[t] % 4]);
}

void render_colours(const render_asked *asked, const render_picture *p, uint32_t *pixel) {
    static const uint32_t red = 0xFFFF0000U, sky = 0xFFE9EFF6U;
    rendering r = {.asked = asked};
    uint32_t last = RENDER_NOTHING, colour = sky;
    for (int row = 0; row < p->height; row++)
        for (int x = 0; x < p->width; x++) {
            const size_t at = (size_t)(p->height - 1 - row) * (size_t)p->width + (size_t)x;
            if (p->shown[at] != last) {
                last = p->shown[at];
                colour = last == RENDER_NOTHING ? sky : shade(&r, last);
            }
            *pixel++ = p->nearer[at] != RENDER_NOTHING ? red : colour;
        }
}

/* ---- A view of all ----------------------------------------------------------------------------------------------- */

static void middle_of(const model *m, vector middle) {
    for (int k = 0; k < 3; k++) {
        double lo = HUGE_VAL, hi = -HUGE_VAL;
        for (size_t i = 0; i < 3 * m->triangles; i++) {
            lo = fmin(lo, corner_of(m, i)[k]);
            hi = fmax(hi, corner_of(m, i)[k]);
        }
        middle[k] = lo <= hi ? lo / 2.0 + hi / 2.0 : 0.0;
    }
}

/* How far from the middle, where it stands now, the eye must be for the whole model to be in sight. */
static double distance_for(const model *m, const draw_camera *camera, const scene_eye *eye) {
    double most = 0.0;
    for (size_t i = 0; i < 3 * m->triangles; i++) {
        vector from;
        scene_eye_sees(eye, corner_of(m, i), from);
        const double beside = fmax(fabs(from[0]) * (double)camera->p00, fabs(from[1]) * (double)camera->p11);
        most = fmax(most, beside - from[2]);
    }
    return fmax(1.05 * most, 1e-6);
}

/* The corner from which the most of the wanted directions is seen. */
static const double *best_corner(size_t count, const double (*towards)[3]) {
    static const vector corners[] = {{1, 0.7, 1}, {-1, 0.7, 1}, {1, 0.7, -1}, {-1, 0.7, -1}};
    const double *best = corners[0];
    double most = 0.0;
    for (int c = 0; c < 4; c++) {
        double sum = 0.0;
        for (size_t i = 0; i < count; i++)
            sum += fmax(dot(towards[i], corners[c]), 0.0);
        if (sum > most) {
            most = sum;
            best = corners[c];
        }
    }
    return best;
}

scene_eye render_overview(const model *m, const draw_camera *camera, size_t count, const double (*towards)[3]) {
    static const vector up = {0, 1, 0}, origin = {0};
    const double *from = best_corner(count, towards);
    const vector ahead = {-from[0], -from[1], -from[2]};
    scene_eye eye;
    scene_eye_look(origin, ahead, up, &eye);
    middle_of(m, eye.place);
    const double away = distance_for(m, camera, &eye);
    for (int k = 0; k < 3; k++)
        eye.place[k] -= away * eye.ahead[k];
    return eye;
}
