/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene/overlap.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "core/outward.h"

/* 1e-9 degrees: normals are good to 2^-42. */
#define SINE_SLACK 1.7e-11
/* An area, relative to the product of both triangles' longest sides: what rounding of their corners may make of 0. */
#define AREA_SLACK DP_ROUNDINGS_126
/* The error of a distance, relative to the coordinates in it: normals again, and a few roundings. */
#define HEIGHT_SLACK 0x1p-38

typedef struct point {
    double u, v;
} point;

/* Keeps value + du (u - at.u) + dv (v - at.v) >= 0. */
typedef struct half_plane {
    point at;
    double value, du, dv;
} half_plane;

typedef struct polygon {
    int corners;
    point corner[OVERLAP_CORNERS];
} polygon;

/*
 * Seen from a's first corner, along the direction n: a point (u, v) stands for the line through it in the plane of two
 * axes; w, the third, is the one nearest to n.
 */
typedef struct frame {
    exact_view view;
    double na[3], nb[3], n[3]; /* length 1 */
    int u, v, w;
    half_plane distance; /* of b above a */
} frame;

static double dot(const double x[3], const double y[3]) {
    return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

static void difference(const double x[3], const double y[3], double out[3]) {
    for (int k = 0; k < 3; k++)
        out[k] = x[k] - y[k];
}

/* Makes a vector's length 1; its length before. */
static double normalize(double x[3]) {
    const double length = sqrt(dot(x, x));
    for (int k = 0; k < 3; k++)
        x[k] /= length;
    return length;
}

/* ---- What tells most pairs apart ----------------------------------------------------------------------------------
 */

/* All corners of b are farther than gap from a's plane, on one side: along any direction they are no nearer. */
static bool beyond(exact_triangle a, const double na[3], exact_triangle b, double gap) {
    double lo = INFINITY;
    double hi = -INFINITY;
    double size = 0.0;
    for (int i = 0; i < 3; i++) {
        double d[3];
        difference(b[i], a[0], d);
        const double h = dot(na, d);
        lo = fmin(lo, h);
        hi = fmax(hi, h);
        size = fmax(size, fabs(d[0]) + fabs(d[1]) + fabs(d[2]));
    }
    const double limit = gap + size * HEIGHT_SLACK;
    return lo > limit || hi < -limit;
}

/* The normals, their angle and the view; false: the angle is too large. */
static bool set_view(frame *f, exact_triangle a, exact_triangle b, double sine) {
    exact_normal(a, f->na);
    exact_normal(b, f->nb);
    double la = normalize(f->na);
    double lb = normalize(f->nb);
    const double longer = fmax(la, lb);
    double cross = 0.0;
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3;
        const int j = (k + 2) % 3;
        const double c = f->na[i] * f->nb[j] - f->na[j] * f->nb[i];
        cross += c * c;
    }
    if (sqrt(cross) > sine + SINE_SLACK)
        return false;
    exact_look(&f->view, a, b, dot(f->na, f->nb) < 0.0 ? -1.0 : 1.0);
    la /= longer;
    lb /= longer;
    for (int k = 0; k < 3; k++)
        f->n[k] = la * f->na[k] + lb * f->view.sign * f->nb[k];
    normalize(f->n);
    return true;
}

/* Some edge has all of the other triangle on its outer side, or on itself. */
static bool separated(const exact_view *view,
                      int (*turn)(const exact_view *, const double *, const double *, const double *)) {
    for (int which = 0; which < 2; which++) {
        const double *const *of = which == 0 ? view->a : view->b;
        const double *const *other = which == 0 ? view->b : view->a;
        const int side = which == 0 || view->sign > 0.0 ? 1 : -1;
        for (int i = 0; i < 3; i++) {
            int outside = 0;
            while (outside < 3) {
                const int t = turn(view, of[i], of[(i + 1) % 3], other[outside]);
                if (t == EXACT_UNSURE || t * side > 0)
                    break;
                outside++;
            }
            if (outside == 3)
                return true;
        }
    }
    return false;
}

static bool in_one_plane(exact_triangle a, exact_triangle b) {
    return exact_above(a, b[0]) == 0 && exact_above(a, b[1]) == 0 && exact_above(a, b[2]) == 0;
}

/* ---- The polygon --------------------------------------------------------------------------------------------------
 */

static double value_at(const half_plane *h, point p) {
    return h->value + h->du * (p.u - h->at.u) + h->dv * (p.v - h->at.v);
}

static void clip(polygon *p, const half_plane *h) {
    polygon kept = {0};
    for (int i = 0; i < p->corners; i++) {
        const point from = p->corner[i];
        const point to = p->corner[(i + 1) % p->corners];
        const double here = value_at(h, from);
        const double there = value_at(h, to);
        if (here >= 0.0 && kept.corners < OVERLAP_CORNERS)
            kept.corner[kept.corners++] = from;
        if (((here < 0.0 && there > 0.0) || (here > 0.0 && there < 0.0)) && kept.corners < OVERLAP_CORNERS) {
            const double t = here / (here - there);
            kept.corner[kept.corners++] = (point){from.u + t * (to.u - from.u), from.v + t * (to.v - from.v)};
        }
    }
    *p = kept;
}

static point projected(const frame *f, const double x[3]) {
    double d[3];
    difference(x, f->view.a[0], d);
    const double along = d[f->w] / f->n[f->w];
    return (point){d[f->u] - along * f->n[f->u], d[f->v] - along * f->n[f->v]};
}

static void set_axes(frame *f) {
    const double *n = f->n;
    f->w = fabs(n[1]) > fabs(n[0]) ? 1 : 0;
    f->w = fabs(n[2]) > fabs(n[f->w]) ? 2 : f->w;
    f->u = (f->w + 1) % 3;
    f->v = (f->w + 2) % 3;
}

/* The planes na x = 0 and nb (x - b0) = 0, along n. */
static void set_distance(frame *f) {
    double b0[3];
    difference(f->view.b[0], f->view.a[0], b0);
    const double a = dot(f->na, f->n);
    const double b = dot(f->nb, f->n);
    f->distance = (half_plane){
        .value = dot(f->nb, b0) / b, .du = f->na[f->u] / a - f->nb[f->u] / b, .dv = f->na[f->v] / a - f->nb[f->v] / b};
}

static polygon intersection(const frame *f) {
    /* A triangle's corners go round counter-clockwise, seen along w, when n has a positive w and it faces n. */
    const double turn = f->n[f->w] > 0.0 ? 1.0 : -1.0;
    polygon p = {.corners = 3};
    point b[3];
    for (int i = 0; i < 3; i++) {
        p.corner[i] = projected(f, f->view.a[i]);
        b[i] = projected(f, f->view.b[i]);
    }
    for (int i = 0; i < 3; i++) {
        const point to = b[(i + 1) % 3];
        const double side = turn * f->view.sign;
        clip(&p, &(half_plane){b[i], 0.0, -side * (to.v - b[i].v), side * (to.u - b[i].u)});
    }
    return p;
}

/* Twice the area, in the plane of u and v, and the centroid. */
static double area_of(const polygon *p, point *centroid) {
    const point o = p->corner[0];
    double area = 0.0;
    double u = 0.0;
    double v = 0.0;
    for (int i = 1; i + 1 < p->corners; i++) {
        const point x = {p->corner[i].u - o.u, p->corner[i].v - o.v};
        const point y = {p->corner[i + 1].u - o.u, p->corner[i + 1].v - o.v};
        const double part = fabs(x.u * y.v - x.v * y.u);
        area += part;
        u += part * (x.u + y.u);
        v += part * (x.v + y.v);
    }
    *centroid = area > 0.0 ? (point){o.u + u / (3.0 * area), o.v + v / (3.0 * area)} : o;
    return area;
}

/* The point of a's plane that (u, v) stands for. */
static void lift(const frame *f, point p, double out[3]) {
    const double t = -(f->na[f->u] * p.u + f->na[f->v] * p.v) / dot(f->na, f->n);
    out[f->u] = f->view.a[0][f->u] + p.u + t * f->n[f->u];
    out[f->v] = f->view.a[0][f->v] + p.v + t * f->n[f->v];
    out[f->w] = f->view.a[0][f->w] + t * f->n[f->w];
}

static double longest_side(exact_triangle t) {
    double longest = 0.0;
    for (int i = 0; i < 3; i++) {
        double d[3];
        difference(t[(i + 1) % 3], t[i], d);
        longest = fmax(longest, dot(d, d));
    }
    return sqrt(longest);
}

static void set_corners(const frame *f, const polygon *p, overlap *out) {
    double longest = 0.0;
    out->lo = INFINITY;
    out->hi = -INFINITY;
    out->corners = p->corners;
    for (int i = 0; i < p->corners; i++) {
        const double h = f->view.plane ? 0.0 : value_at(&f->distance, p->corner[i]);
        out->lo = fmin(out->lo, h);
        out->hi = fmax(out->hi, h);
        lift(f, p->corner[i], out->corner[i]);
        for (int j = 0; j < i; j++) {
            double d[3];
            difference(out->corner[i], out->corner[j], d);
            longest = fmax(longest, dot(d, d));
        }
    }
    out->width = longest > 0.0 ? out->area / sqrt(longest) : 0.0;
}

bool overlap_find(exact_triangle a, exact_triangle b, double gap, double sine, overlap *out) {
    frame f;
    if (!set_view(&f, a, b, sine) || beyond(a, f.na, b, gap) || beyond(b, f.nb, a, gap) ||
        separated(&f.view, exact_turn_quick))
        return false;
    f.view.plane = in_one_plane(a, b);
    if ((gap == 0.0 && !f.view.plane) || separated(&f.view, exact_turn))
        return false;
    set_axes(&f);
    set_distance(&f);
    polygon p = intersection(&f);
    if (!f.view.plane) {
        const half_plane *d = &f.distance;
        const bool flat = p.corners < 3;
        clip(&p, &(half_plane){{0.0, 0.0}, gap - d->value, -d->du, -d->dv});
        clip(&p, &(half_plane){{0.0, 0.0}, gap + d->value, d->du, d->dv});
        if (!flat && p.corners < 3)
            return false;
    }
    point centroid = {0.0, 0.0};
    *out = (overlap){.opposite = f.view.sign < 0.0};
    out->area = p.corners < 3 ? 0.0 : 0.5 * area_of(&p, &centroid) * fabs(f.n[f.w]);
    memcpy(out->normal, f.na, sizeof out->normal);
    memcpy(out->along, f.n, sizeof out->along);
    if (out->area <= AREA_SLACK * longest_side(a) * longest_side(b))
        out->area = 0.0;
    lift(&f, centroid, out->place);
    set_corners(&f, &p, out);
    return true;
}
