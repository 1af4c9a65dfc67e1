/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The guaranteed separation of slanted triangles against rasterizers of our own: random cameras, parallel planes, a
 * triangle of each plane about one pixel, their vertices rounded to binary32, transformed, moved to a subpixel grid,
 * set up and evaluated operation by operation, in the orders that were measured of four rasterizers; and against their
 * models of src/raster, on triangles that these do not clip. Nothing at the guarantee or beyond may be out of order;
 * how near wrong pairs come to it is the share of it that is used.
 *
 * Most vertices are placed where the grid moves them the wrong way: random ones hardly use what snapping takes.
 */
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "depthprec/depthprec.h"
#include "raster/raster.h"
#include "support.h"

static const double pi = 3.14159265358979323846;

/* ---- A rasterizer ------------------------------------------------------------------------------------------------ */

/* Window coordinates and window depth of a vertex as the set-up reads them; y runs as the plane's y does. */
typedef struct corner {
    float x, y, z, w;
} corner;

typedef struct camera {
    float p00, p11, a, b;
    int width, height, bits; /* bits < 0: not snapped */
    bool reciprocal;
} camera;

static float window_of(const camera *c, float clip, float w, int size) {
    const float half = 0.5F * (float)size;
    const float inverse = 1.0F / w;
    const float ndc = c->reciprocal ? clip * inverse : clip / w;
    const float scaled = ndc * half;
    return scaled + half;
}

static float snapped(float x, int bits) {
    return bits < 0 ? x : (float)ldexp(rint(ldexp((double)x, bits)), -bits);
}

/* What becomes of a real place: clip coordinates, */
static raster_vertex transformed(const camera *c, const double place[3]) {
    const float x = (float)place[0], y = (float)place[1], z = (float)place[2];
    const float product = c->a * z;
    return (raster_vertex){c->p00 * x, c->p11 * y, product + c->b, z};
}

/* and what is set up of them. */
static corner projected(const camera *c, raster_vertex v) {
    const float inverse = 1.0F / v.w;
    return (corner){snapped(window_of(c, v.x, v.w, c->width), c->bits),
                    snapped(window_of(c, v.y, v.w, c->height), c->bits), c->reciprocal ? v.z * inverse : v.z / v.w,
                    v.w};
}

/* Anchored at the farthest vertex. */
static float at_vertex(const corner v[3], float px, float py) {
    int first = v[1].w > v[0].w ? 1 : 0;
    first = v[2].w > v[first].w ? 2 : first;
    const corner *v0 = &v[first], *v1 = &v[(first + 1) % 3], *v2 = &v[(first + 2) % 3];
    const float x1 = v1->x - v0->x, y1 = v1->y - v0->y, x2 = v2->x - v0->x, y2 = v2->y - v0->y;
    const float z1 = v1->z - v0->z, z2 = v2->z - v0->z;
    const float left = x1 * y2, right = x2 * y1;
    const float d = 1.0F / (left - right);
    const float a1 = y2 * z1, a2 = y1 * z2, b1 = x1 * z2, b2 = x2 * z1;
    const float a = (a1 - a2) * d, b = (b1 - b2) * d;
    const float dx = px - v0->x, dy = py - v0->y;
    const float by = dy * b, ax = dx * a;
    const float row = v0->z + by;
    return row + ax;
}

typedef struct plane {
    float a, b, c;
} plane;

static float corner_value(const corner *v, float a, float b) {
    const float x = v->x - 0.5F, y = v->y - 0.5F;
    const float ax = a * x, by = b * y;
    const float moved = ax + by;
    return v->z - moved;
}

/* Anchored at the centre of the target's first pixel. */
static plane plane_of(const corner v[3]) {
    const float dx01 = v[0].x - v[1].x, dy01 = v[0].y - v[1].y, dx20 = v[2].x - v[0].x, dy20 = v[2].y - v[0].y;
    const float left = dx01 * dy20, right = dy01 * dx20;
    const float o = 1.0F / (left - right);
    const float x01 = dx01 * o, y01 = dy01 * o, x20 = dx20 * o, y20 = dy20 * o;
    const float d01 = v[0].z - v[1].z, d20 = v[2].z - v[0].z;
    const float a1 = d01 * y20, a2 = d20 * y01, b1 = d20 * x01, b2 = d01 * x20;
    const float a = a1 - a2, b = b1 - b2;
    return (plane){a, b, corner_value(&v[0], a, b)};
}

static float at_origin(const corner v[3], float px, float py) {
    const plane p = plane_of(v);
    return fmaf(p.b, py - 0.5F, fmaf(p.a, px - 0.5F, p.c));
}

static float unfused(const corner v[3], float px, float py) {
    const plane p = plane_of(v);
    const float ax = p.a * (px - 0.5F);
    const float by = p.b * (py - 0.5F);
    const float row = p.c + ax;
    return row + by;
}

/* Gradients by one division of each, and a step to pixels of odd places. */
static float stepped(const corner v[3], float px, float py) {
    const float dx1 = v[1].x - v[0].x, dy1 = v[1].y - v[0].y, dx2 = v[2].x - v[0].x, dy2 = v[2].y - v[0].y;
    const float z1 = v[1].z - v[0].z, z2 = v[2].z - v[0].z;
    const float left = dx1 * dy2, right = dx2 * dy1;
    const float o = 1.0F / (left - right);
    const float a1 = dy2 * z1, a2 = dy1 * z2, b1 = dx1 * z2, b2 = dx2 * z1;
    const float a = (a1 - a2) * o, b = (b1 - b2) * o;
    const int x = (int)px, y = (int)py;
    const float ax = a * (float)(x & ~1), by = b * (float)(y & ~1);
    float value = corner_value(&v[0], a, b) + ax;
    value = value + by;
    value = (x & 1) != 0 ? value + a : value;
    return (y & 1) != 0 ? value + b : value;
}

/* In double, rounded once: what is left are the errors of the vertices. */
static float exact(const corner v[3], float px, float py) {
    const double x1 = (double)v[1].x - (double)v[0].x, y1 = (double)v[1].y - (double)v[0].y;
    const double x2 = (double)v[2].x - (double)v[0].x, y2 = (double)v[2].y - (double)v[0].y;
    const double z1 = (double)v[1].z - (double)v[0].z, z2 = (double)v[2].z - (double)v[0].z;
    const double x = (double)px - (double)v[0].x, y = (double)py - (double)v[0].y, det = x1 * y2 - x2 * y1;
    return (float)((double)v[0].z + ((x * y2 - x2 * y) * z1 + (x1 * y - x * y1) * z2) / det);
}

typedef float evaluation(const corner v[3], float px, float py);

static const struct {
    const char *name;
    evaluation *value; /* null: the model of src/raster of that name */
    dp_anchor anchor;  /* none: an error of one rounding */
    int bits[2];
    const char *arith;
    double used; /* the least share that wrong pairs of fp32 come to, with the class of the triangles themselves */
} kinds[] = {{"vertex", at_vertex, DP_ANCHOR_VERTEX, {4, 8}, "mesa", 0.9},
             {"origin", at_origin, DP_ANCHOR_ORIGIN, {-1, -1}, "mesa", 0.15},
             {"origin-unfused", unfused, DP_ANCHOR_ORIGIN_UNFUSED, {-1, -1}, "ieee", 0.15},
             {"origin-stepped", stepped, DP_ANCHOR_ORIGIN_STEPPED, {-1, -1}, "softpipe", 0.1},
             {"exact", exact, DP_ANCHOR_COUNT, {-1, -1}, "ieee", 0.25},
             {"llvmpipe", NULL, DP_ANCHOR_ORIGIN, {-1, -1}, "mesa", 0.1},
             {"lavapipe", NULL, DP_ANCHOR_ORIGIN, {-1, -1}, "mesa", 0.1},
             {"softpipe", NULL, DP_ANCHOR_ORIGIN_STEPPED, {-1, -1}, "softpipe", 0.1},
             {"swiftshader", NULL, DP_ANCHOR_VERTEX, {4, 4}, "mesa", 0.9}};

enum { KINDS = sizeof kinds / sizeof kinds[0] };

/* 24 and 16 bits: the binary32 product to even, or truncated; ties of an exact one go up. */
static double code_of(const dp_setup *setup, float value) {
    const float d = value < 0.0F ? 0.0F : value > 1.0F ? 1.0F : value;
    const dp_conversion conversion = dp_arith_get(setup->spec.arith)->conversion;
    if (setup->spec.format.kind == DP_FORMAT_FLOAT)
        return (double)d;
    const float product = d * (float)setup->spec.format.code_max;
    if (conversion == DP_CONVERT_EXACT)
        return floor((double)d * (double)setup->spec.format.code_max + 0.5);
    return conversion == DP_CONVERT_PRODUCT_ZERO ? trunc((double)product) : rint((double)product);
}

/* ---- A pair of planes -------------------------------------------------------------------------------------------- */

typedef struct scene {
    dp_setup setup;
    camera camera;
    dp_triangles class;
    int kind;
    double n[3], px, py, z; /* z: of the farther plane at the pixel */
    double share;           /* of the guarantee */
    double at[2][3][2];     /* where vertices are seen */
} scene;

/* The ray of a place on the screen, of depth 1. */
static void ray_of(const scene *s, double x, double y, double ray[3]) {
    ray[0] = (2.0 * x / s->camera.width - 1.0) / (double)s->camera.p00;
    ray[1] = (2.0 * y / s->camera.height - 1.0) / (double)s->camera.p11;
    ray[2] = 1.0;
}

static double along(const scene *s, double x, double y) {
    double ray[3];
    ray_of(s, x, y, ray);
    return s->n[0] * ray[0] + s->n[1] * ray[1] + s->n[2];
}

static bool holds(const corner v[3], double px, double py) {
    int positive = 0, negative = 0;
    for (int i = 0; i < 3; i++) {
        const corner *a = &v[i], *b = &v[(i + 1) % 3];
        const double side =
            ((double)b->x - (double)a->x) * (py - (double)a->y) - ((double)b->y - (double)a->y) * (px - (double)a->x);
        positive += side >= 0.0;
        negative += side <= 0.0;
    }
    return positive == 3 || negative == 3;
}

/* A triangle about the pixel: width and height of its box, and how slim it is. */
static void draw_triangle(rng *r, scene *s, int which) {
    const double size = rng_log(r, 2.0, 400.0), turn = rng_uniform(r, 0.0, 2.0 * pi);
    const double thin = rng_unit(r) < 0.5 ? 1.0 : rng_log(r, 0.05, 1.0);
    for (int i = 0; i < 3; i++) {
        const double angle = 2.0 * pi / 3.0 * i + rng_uniform(r, -0.5, 0.5);
        const double u = size * cos(angle), v = size * thin * sin(angle);
        s->at[which][i][0] = s->px + u * cos(turn) - v * sin(turn);
        s->at[which][i][1] = s->py + u * sin(turn) + v * cos(turn);
    }
}

/* Half a step of the grid off, so that the vertex is moved towards the other plane. */
static void place_badly(scene *s, int which) {
    const double step = ldexp(1.0, -s->camera.bits);
    const double rise = which == 0 ? -1.0 : 1.0; /* the nearer plane seems farther */
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 2; k++) {
            const double grid = rint(s->at[which][i][k] / step) * step;
            const double way = s->n[k] > 0.0 ? rise : -rise;
            s->at[which][i][k] = grid + 0.499 * way * step;
        }
}

/* The class is that of these triangles, or as it stands where they lie in it. */
static void fit_class(scene *s, double c[2]) {
    dp_triangles *t = &s->class;
    t->pixels = 1.0;
    t->slim = 2.0;
    t->depth = 1.0;
    for (int k = 0; k < 2; k++) {
        double lo[2] = {INFINITY, INFINITY}, hi[2] = {-INFINITY, -INFINITY}, longest = 0.0;
        const double(*v)[2] = (const double(*)[2])s->at[k];
        const double area = fabs((v[1][0] - v[0][0]) * (v[2][1] - v[0][1]) - (v[2][0] - v[0][0]) * (v[1][1] - v[0][1]));
        for (int i = 0; i < 3; i++) {
            const double *next = v[(i + 1) % 3];
            longest = fmax(longest, hypot(next[0] - v[i][0], next[1] - v[i][1]));
            for (int axis = 0; axis < 2; axis++) {
                lo[axis] = fmin(lo[axis], v[i][axis]);
                hi[axis] = fmax(hi[axis], v[i][axis]);
            }
            const double z = c[k] / along(s, v[i][0], v[i][1]);
            t->depth = fmax(t->depth, z > 0.0 ? fmax(z / s->z, s->z / z) : INFINITY);
        }
        /* a grid step more on each side: what counts is where the vertices are moved to */
        t->pixels = fmax(t->pixels, fmax(hi[0] - lo[0], hi[1] - lo[1]) + 0.25);
        t->slim = fmax(t->slim, longest * longest / area * (1.0 + 0.5 / sqrt(area)));
    }
    t->depth *= 1.0 + 1e-6;
}

/* The code of a model of src/raster; false where it does not draw the pixel, or clips. */
static bool modelled(const scene *s, const raster_vertex v[3], double *code) {
    raster_target target;
    raster_triangle drawn;
    size_t row = 0;
    int from, to;
    const int x = (int)s->px, y = (int)s->py;
    while (strcmp(raster_get(row)->name, kinds[s->kind].name) != 0)
        row++;
    for (int i = 0; i < 3; i++)
        if (fabsf(v[i].x) > v[i].w || fabsf(v[i].y) > v[i].w || v[i].z < 0.0F || v[i].z > v[i].w)
            return false;
    if (raster_target_init(&target, row, s->camera.width, s->camera.height, &s->setup.spec.format, dp_path_best()) !=
            RASTER_OK ||
        raster_set_up(&target, v, &drawn) != RASTER_OK || drawn.count != 1 ||
        !raster_span(&target, &drawn.piece[0], y, &from, &to) || x < from || x >= to)
        return false;
    uint32_t bits;
    float depth;
    raster_codes(&target, &drawn.piece[0], y, x, x + 1, &bits);
    memcpy(&depth, &bits, sizeof depth);
    *code = s->setup.spec.format.kind == DP_FORMAT_FLOAT ? (double)depth : (double)bits;
    return true;
}

/* What is stored of one of the planes; false where that is nothing. */
static bool stored(const scene *s, int which, double c, double *code) {
    raster_vertex clip[3];
    corner v[3];
    for (int i = 0; i < 3; i++) {
        const double *at = s->at[which][i];
        const double z = c / along(s, at[0], at[1]);
        double place[3];
        if (!(z >= s->setup.spec.znear && z <= s->setup.spec.zfar))
            return false;
        ray_of(s, at[0], at[1], place);
        for (int axis = 0; axis < 3; axis++)
            place[axis] *= z;
        clip[i] = transformed(&s->camera, place);
        v[i] = projected(&s->camera, clip[i]);
    }
    if (!holds(v, s->px, s->py))
        return false;
    if (kinds[s->kind].value == NULL)
        return modelled(s, clip, code);
    *code = code_of(&s->setup, kinds[s->kind].value(v, (float)s->px, (float)s->py));
    return true;
}

/* Whether the two are in order; false also where one is not drawn: *judged says it. */
static bool in_order(const scene *s, const double c[2], bool *judged) {
    double code[2];
    *judged = stored(s, 0, c[0], &code[0]) && stored(s, 1, c[1], &code[1]);
    return *judged && (s->setup.reversed ? code[0] > code[1] : code[0] < code[1]);
}

/* ---- Drawing ----------------------------------------------------------------------------------------------------- */

static void draw_camera(rng *r, scene *s, const char *format) {
    dp_spec spec = dp_spec_default();
    dp_format found[2];
    const bool reversed = rng_below(r, 2) == 0, infinite = rng_below(r, 2) == 0;
    assert_int_equal(dp_format_parse(format, found), 1);
    spec.format = found[0];
    spec.mapping = reversed ? DP_MAPPING_REVERSED : DP_MAPPING_D3D;
    spec.znear = rng_log(r, 0.01, 10.0);
    spec.zfar = infinite ? INFINITY : spec.znear * rng_log(r, 10.0, 1e6);
    spec.model = DP_MODEL_FP32;
    assert_int_equal(dp_arith_parse(kinds[s->kind].arith, &spec.arith), DP_OK);
    assert_int_equal(dp_setup_init(&s->setup, &spec), DP_OK);
    const double n = spec.znear, f = spec.zfar;
    s->camera.reciprocal = dp_arith_get(spec.arith)->reciprocal;
    s->camera.a = (float)(reversed ? (infinite ? 0.0 : -n / (f - n)) : (infinite ? 1.0 : f / (f - n)));
    s->camera.b = (float)(reversed ? (infinite ? n : n * f / (f - n)) : (infinite ? -n : -n * f / (f - n)));
    dp_triangles *t = &s->class;
    *t = dp_triangles_default();
    t->width = s->camera.width = (int)rng_log(r, 64.0, 4096.0);
    t->height = s->camera.height = (int)rng_log(r, 64.0, 4096.0);
    t->fov_y = rng_uniform(r, 5.0, 110.0);
    const double y = tan(t->fov_y * pi / 360.0);
    s->camera.p11 = (float)(1.0 / y);
    s->camera.p00 = (float)(t->height / (y * t->width));
    s->camera.bits = kinds[s->kind].bits[rng_below(r, 2)];
    t->subpixel = s->camera.bits < 0 ? 0 : s->camera.bits;
    const dp_anchor_row *anchor = dp_anchor_get(kinds[s->kind].anchor);
    t->plane = anchor != NULL ? anchor->plane : (dp_plane_error){.value = 1.0};
}

static bool draw_planes(rng *r, scene *s) {
    const double slant = (rng_below(r, 3) == 0 ? rng_uniform(r, 80.0, 90.0) : rng_uniform(r, 0.5, 90.0)) * pi / 180.0;
    const double turn = rng_below(r, 2) == 0 ? pi / 4.0 * (double)(2 * rng_below(r, 4) + 1) : rng_uniform(r, 0, 2 * pi);
    const double last = fmin(s->setup.spec.zfar, s->setup.spec.znear * 1e6);
    s->n[0] = sin(slant) * cos(turn);
    s->n[1] = sin(slant) * sin(turn);
    s->n[2] = cos(slant);
    s->z = rng_log(r, s->setup.spec.znear, last);
    s->px = 0.5 + (double)rng_below(r, (uint64_t)s->camera.width);
    s->py = 0.5 + (double)rng_below(r, (uint64_t)s->camera.height);
    s->class.slant_lo = fmax(slant * 180.0 / pi - 1e-6, 0.0);
    s->class.slant_hi = fmin(slant * 180.0 / pi + 1e-6, 90.0);
    for (int k = 0; k < 2; k++) {
        draw_triangle(r, s, k);
        if (s->camera.bits >= 0 && rng_below(r, 4) != 0)
            place_badly(s, k);
    }
    return along(s, s->px, s->py) > 1e-6;
}

static dp_budget budget_of(const scene *s, const dp_triangles *class) {
    dp_spec spec = s->setup.spec;
    dp_setup setup;
    dp_budget b;
    spec.triangles = *class;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    assert_int_equal(dp_budget_at(&setup, s->z, NULL, &b), DP_OK);
    return b;
}

typedef struct outcome {
    bool judged, ordered;
    double class; /* how much longer the separation of the default class is, any slant */
} outcome;

/* The nearer plane lies a share of the guarantee before the farther one; the guarantee that of its own class. */
static outcome judge(scene *s) {
    outcome o = {0};
    const double seen = along(s, s->px, s->py);
    double c[2] = {s->z * seen, s->z * seen};
    fit_class(s, c);
    if (!(s->class.depth < 1e3) || dp_triangles_check(&s->class) != DP_OK)
        return o;
    s->class.depth *= 1.05;
    const dp_budget b = budget_of(s, &s->class);
    c[0] = s->z * seen - s->share * b.separation;
    const double class = s->class.depth;
    if (!(c[0] > 0.0))
        return o;
    fit_class(s, c);
    if (s->class.depth > class)
        return o;
    s->class.depth = class;
    o.ordered = in_order(s, c, &o.judged);
    const dp_triangles standard = dp_triangles_default();
    dp_triangles any = s->class;
    any.slant_lo = 0.0;
    any.slant_hi = 90.0;
    any.depth = fmax(any.depth, standard.depth);
    any.pixels = fmax(any.pixels, standard.pixels);
    any.slim = fmax(any.slim, standard.slim);
    o.class = budget_of(s, &any).separation / b.separation;
    return o;
}

/* SwiftShader has no D24; the 16-bit codes of softpipe are stepped, and promise nothing. */
static bool has_format(int kind, size_t format) {
    return !(format == 1 && strcmp(kinds[kind].name, "swiftshader") == 0) &&
           !(format == 2 && strcmp(kinds[kind].name, "softpipe") == 0);
}

static void test_guarantee(void **state) {
    static const char *const formats[] = {"fp32", "unorm24", "unorm16"};
    tally t = {.name = "at the guarantee and beyond"};
    rng r = rng_make("triangles");
    (void)state;
    for (int kind = 0; kind < KINDS; kind++)
        for (size_t f = 0; f < sizeof formats / sizeof formats[0]; f++) {
            double used = 0.0, class = 0.0;
            uint64_t judged = 0;
            if (!has_format(kind, f))
                continue;
            for (uint64_t i = test_cases(2000, 80000, 15000000); i > 0; i--) {
                scene s = {.kind = kind};
                draw_camera(&r, &s, formats[f]);
                const bool beyond = rng_below(&r, 2) == 0;
                s.share = beyond ? (rng_below(&r, 2) == 0 ? 1.0 : rng_log(&r, 1.0, 10.0)) : rng_log(&r, 0.02, 1.0);
                const outcome o = draw_planes(&r, &s) ? judge(&s) : (outcome){0};
                judged += o.judged;
                if (!o.judged)
                    continue;
                class += isfinite(o.class) ? log(o.class) : 0.0;
                if (!o.ordered && !beyond)
                    used = fmax(used, s.share);
                if (beyond)
                    TALLY(&t, o.ordered, "%s %s: share %.17g at z %.17g, slant %g, %d x %d, fov %g, %d bits",
                          formats[f], kinds[kind].name, s.share, s.z, s.class.slant_hi, s.camera.width, s.camera.height,
                          s.class.fov_y, s.camera.bits);
            }
            print_message(
                "# %s %s: %llu pairs, %.2f of the guarantee used; the default class takes %.1f times as much\n",
                kinds[kind].name, formats[f], (unsigned long long)judged, used, exp(class / (double)judged));
            if (f == 0 && test_effort() != EFFORT_QUICK)
                TALLY(&t, used >= kinds[kind].used, "%s: only %.2f is used", kinds[kind].name, used);
        }
    tally_end(&t);
}

/* ---- Snapping alone ---------------------------------------------------------------------------------------------- */

/* 1/z at the pixel of the plane through vertices that were moved, without rounding. */
static bool moved_inverse(const scene *s, double c, int which, double *inverse) {
    double x[3], y[3], of[3];
    for (int i = 0; i < 3; i++) {
        const double *at = s->at[which][i];
        x[i] = ldexp(rint(ldexp(at[0], s->camera.bits)), -s->camera.bits);
        y[i] = ldexp(rint(ldexp(at[1], s->camera.bits)), -s->camera.bits);
        of[i] = along(s, at[0], at[1]) / c;
    }
    const double area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
    const double u = ((s->px - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (s->py - y[0])) / area;
    const double v = ((x[1] - x[0]) * (s->py - y[0]) - (s->px - x[0]) * (y[1] - y[0])) / area;
    *inverse = (1.0 - u - v) * of[0] + u * of[1] + v * of[2];
    return u >= 0.0 && v >= 0.0 && u + v <= 1.0;
}

static void test_snapping(void **state) {
    tally t = {.name = "snapping alone"};
    rng r = rng_make("snapping");
    double used = 0.0;
    (void)state;
    for (uint64_t i = test_cases(20000, 400000, 20000000); i > 0; i--) {
        scene s = {.kind = 0};
        draw_camera(&r, &s, "fp32");
        s.share = rng_below(&r, 2) == 0 ? 1.0 + 1e-6 : rng_uniform(&r, 0.5, 1.0);
        if (!draw_planes(&r, &s))
            continue;
        s.class.depth = 1.0;
        const dp_budget b = budget_of(&s, &s.class);
        const double c = s.z * along(&s, s.px, s.py), nearer = c - s.share * b.cause[DP_CAUSE_SNAPPING];
        double first, second;
        if (b.cause[DP_CAUSE_SNAPPING] == 0.0 || !(nearer > 0.0) || !moved_inverse(&s, nearer, 0, &first) ||
            !moved_inverse(&s, c, 1, &second))
            continue;
        if (s.share > 1.0)
            TALLY(&t, first > second, "slant %g, %d bits at %.17g", s.class.slant_hi, s.camera.bits, s.z);
        else if (first <= second)
            used = fmax(used, s.share);
    }
    print_message("# %.3f of it used\n", used);
    TALLY(&t, used >= 0.95, "only %.3f of what snapping takes is used", used);
    tally_end(&t);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_snapping),
        cmocka_unit_test(test_guarantee),
    };
    return run_tap(tests);
}
