/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What setting up and evaluating a plane adds, beside the constants derived for each anchor: in triangles that are
 * climbed to, from shapes in which one of the terms decides. None may add more; and the hardest ones use most of each
 * constant, so that none of them is slack.
 */
#include "depthprec/triangles.h"
#include "plane_order.h"
#include "support.h"

/* Vertices in the window, which is square, and the pixel in question. */
typedef struct window {
    corner v[3];
    float px, py;
    int size;
} window;

static plane_order *const orders[DP_ANCHOR_COUNT] = {plane_at_vertex, plane_at_origin, plane_unfused, plane_stepped};

/* ---- How much of the bound a triangle uses ----------------------------------------------------------------------- */

typedef struct range {
    double lo, hi;
} range;

static range range_of(float a, float b, float c) {
    return (range){(double)fminf(fminf(a, b), c), (double)fmaxf(fmaxf(a, b), c)};
}

static double width(range r) {
    return r.hi - r.lo;
}

/* The error in one direction as a share of the bound; below -1 where the bound does not speak of the triangle. */
static double used_of(dp_anchor anchor, const window *t, double way) {
    const dp_plane_error *e = &dp_anchor_get(anchor)->plane;
    const corner *v = t->v;
    const long double x1 = (long double)v[1].x - v[0].x, y1 = (long double)v[1].y - v[0].y;
    const long double x2 = (long double)v[2].x - v[0].x, y2 = (long double)v[2].y - v[0].y;
    const long double z1 = (long double)v[1].z - v[0].z, z2 = (long double)v[2].z - v[0].z;
    const long double x = (long double)t->px - v[0].x, y = (long double)t->py - v[0].y, det = x1 * y2 - x2 * y1;
    const long double u = (x * y2 - x2 * y) / det, w = (x1 * y - x * y1) / det;
    const range xs = range_of(v[0].x, v[1].x, v[2].x), ys = range_of(v[0].y, v[1].y, v[2].y);
    const range zs = range_of(v[0].z, v[1].z, v[2].z);
    const double gx = fabs((double)((y2 * z1 - y1 * z2) / det)), gy = fabs((double)((x1 * z2 - x2 * z1) / det));
    const double slim = width(xs) * width(ys) / fabs((double)det);
    const bool inside = u >= 0 && w >= 0 && u + w <= 1;
    if (!inside || !(slim < 1000.0) || xs.lo < 0.0 || ys.lo < 0.0 || xs.hi > t->size || ys.hi > t->size ||
        zs.lo < 0.0 || zs.hi > 1.0 || width(xs) < 1.0 || width(ys) < 1.0)
        return -2.0;
    /* Vertices that are on no grid: the rounding of their differences, which is a displacement. */
    const double differences = anchor == DP_ANCHOR_VERTEX ? 0.0 : gx * width(xs) + gy * width(ys);
    const double bound =
        (e->value * zs.hi + (e->box * slim + e->range) * width(zs) + e->origin * (gx + gy) * t->size + differences) *
        (1.0 + 0x1p-10) * 0x1p-24;
    const long double exact = v[0].z + u * z1 + w * z2;
    return way * (double)((long double)orders[anchor](v, t->px, t->py) - exact) / bound;
}

/* ---- Shapes in which one term decides ---------------------------------------------------------------------------- */

/* Anywhere, almost flat: the largest depth. */
static void draw_flat(rng *r, window *t) {
    const double span = rng_log(r, 4.0, t->size / 2.0), base = rng_log(r, 1e-3, 0.5), rise = rng_log(r, 1e-4, 0.1);
    for (int i = 0; i < 3; i++)
        t->v[i] = (corner){(float)rng_uniform(r, 0.0, span), (float)rng_uniform(r, 0.0, span),
                           (float)(base * (1.0 + rise * rng_unit(r))), 1.0F};
}

/* Two vertices next to one corner of the box, at the other one the anchor; sides just above powers of two. */
static void draw_needle(rng *r, window *t) {
    const double wide = ldexp(1.0 + 0.01 * rng_unit(r), 1 + (int)rng_below(r, 5));
    const double high = ldexp(1.0 + 0.01 * rng_unit(r), 1 + (int)rng_below(r, 5));
    const double slack = rng_log(r, 0.002, 0.3), depth = rng_log(r, 1e-4, 1.0);
    const double x = rng_uniform(r, 0.0, t->size - wide), y = rng_uniform(r, 0.0, t->size - high);
    const double last = rng_below(r, 2) == 0 ? depth : 0.0;
    t->v[0] = (corner){(float)x, (float)y, (float)(rng_below(r, 2) == 0 ? 0.0 : 1e-3 * depth), 1.0F};
    t->v[1] = (corner){(float)(x + wide), (float)(y + high), (float)depth, 1.0F};
    t->v[2] = (corner){(float)(x + wide * (1.0 - slack * rng_unit(r))), (float)(y + high * (1.0 - slack * rng_unit(r))),
                       (float)last, 1.0F};
}

/* Steep, small and far from the target's corner: the distance from it. */
static void draw_steep(rng *r, window *t) {
    const double span = rng_log(r, 2.0, 0.05 * t->size + 2.1), from = t->size * (1.0 - 0.02 * rng_unit(r)) - span;
    for (int i = 0; i < 3; i++)
        t->v[i] =
            (corner){(float)(from + span * rng_unit(r)), (float)(from + span * rng_unit(r)), (float)rng_unit(r), 1.0F};
}

static const struct {
    const char *decides;
    void (*draw)(rng *r, window *t);
    double used; /* the least share of the bound that the hardest triangle has to use */
} shapes[] = {{"value", draw_flat, 0.65}, {"box", draw_needle, 0.42}, {"origin", draw_steep, 0.6}};

/* A pixel in the triangle, more often than not near a vertex that is not the anchor; the triangle moves to meet it. */
static void place_pixel(rng *r, window *t) {
    corner *v = t->v;
    double l[3] = {rng_unit(r), rng_unit(r), rng_unit(r)};
    l[1 + rng_below(r, 2)] += rng_below(r, 2) == 0 ? 40.0 : 0.0;
    const double sum = l[0] + l[1] + l[2];
    const double x = (l[0] * (double)v[0].x + l[1] * (double)v[1].x + l[2] * (double)v[2].x) / sum;
    const double y = (l[0] * (double)v[0].y + l[1] * (double)v[1].y + l[2] * (double)v[2].y) / sum;
    t->px = (float)floor(x) + 0.5F;
    t->py = (float)floor(y) + 0.5F;
    for (int i = 0; i < 3; i++) {
        v[i].x += (float)((double)t->px - x);
        v[i].y += (float)((double)t->py - y);
    }
}

static float on_grid(dp_anchor anchor, double x) {
    return anchor == DP_ANCHOR_VERTEX ? (float)(rint(x * 256.0) / 256.0) : (float)x;
}

/* One vertex at a time by little, and back where that uses less. */
static double climb(rng *r, dp_anchor anchor, window *t) {
    const double way = rng_below(r, 2) == 0 ? 1.0 : -1.0;
    double used = used_of(anchor, t, way);
    for (int i = 0; i < 2000 && used >= -1.0; i++) {
        corner *v = &t->v[rng_below(r, 3)];
        const corner kept = *v;
        const double reach = rng_log(r, 1e-8, 1e-2);
        const uint64_t what = rng_below(r, 3);
        if (what != 1)
            v->x = on_grid(anchor, (double)v->x + 100.0 * reach * rng_uniform(r, -1.0, 1.0));
        if (what != 0)
            v->y = on_grid(anchor, (double)v->y + 100.0 * reach * rng_uniform(r, -1.0, 1.0));
        if (what == 2)
            v->z *= (float)(1.0 + reach * rng_uniform(r, -1.0, 1.0));
        const double moved = used_of(anchor, t, way);
        if (moved >= used)
            used = moved;
        else
            *v = kept;
    }
    return used;
}

TEST(test_constants) {
    tally t = {.name = "set-up of a plane"};
    for (int anchor = 0; anchor < DP_ANCHOR_COUNT; anchor++)
        for (size_t shape = 0; shape < sizeof shapes / sizeof shapes[0]; shape++) {
            const char *name = dp_anchor_get((dp_anchor)anchor)->name;
            rng r = rng_make(name);
            double most = 0.0;
            if (shapes[shape].draw == draw_steep && anchor == DP_ANCHOR_VERTEX)
                continue;
            for (uint64_t i = test_cases(20, 400, 20000); i > 0; i--) {
                window at = {.size = 1 << (6 + rng_below(&r, 7))};
                shapes[shape].draw(&r, &at);
                place_pixel(&r, &at);
                for (int k = 0; k < 3; k++) {
                    at.v[k].x = on_grid((dp_anchor)anchor, (double)at.v[k].x);
                    at.v[k].y = on_grid((dp_anchor)anchor, (double)at.v[k].y);
                }
                most = fmax(most, climb(&r, (dp_anchor)anchor, &at));
                TALLY(&t, most <= 1.0, "%s, %s: %.3f of the bound in a window of %d", name, shapes[shape].decides, most,
                      at.size);
            }
            print_message("# %s, where %s decides: up to %.2f of the derived bound\n", name, shapes[shape].decides,
                          most);
            if (test_effort() != EFFORT_QUICK)
                TALLY(&t, most >= shapes[shape].used, "%s, %s: only %.2f is used", name, shapes[shape].decides, most);
        }
    tally_end(&t);
}
