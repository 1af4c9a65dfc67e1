/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene/sight.h"

#include <math.h>
#include <string.h>

#include "core/elementary.h"
#include "core/outward.h"
#include "depthprec/bounds.h"
#include "raster/mesh.h"
#include "scene/exact.h"
#include "scene/pairs.h"
#include "solve/distance.h"

enum { DIGITS = 6, SIDES = 6, POLYGON = FINDER_CORNERS + SIDES, ROUNDS = 12 };

/* The relative error of coordinates and depths in double; the sine of the most that a triangle may be turned away. */
static const double outward = DP_ROUNDINGS_8190;
static const double turned = 0x1p-8;

/* A lift grows beyond what it lacks by this share of it. */
static const double spare = 0x1p-7;

/* ---- The view ---------------------------------------------------------------------------------------------------- */

/* Tangents of half the view, to the right and upwards. */
typedef struct view {
    double across, up;
} view;

static view view_of(const dp_triangles *t) {
    const double up = dp_half_tangent(t->fov_y);
    return (view){up * t->width / t->height, up};
}

typedef struct polygon {
    double at[POLYGON][3];
    int corners;
} polygon;

static void keep(polygon *p, const double at[3]) {
    if (p->corners < POLYGON) /* a side adds one at most, but for rounding */
        memcpy(p->at[p->corners++], at, sizeof p->at[0]);
}

/* Keeps the part of a polygon where n . p >= c. */
static void cut(polygon *p, const double n[3], double c) {
    const polygon from = *p;
    double side[POLYGON] = {0};
    for (int i = 0; i < from.corners; i++)
        side[i] = n[0] * from.at[i][0] + n[1] * from.at[i][1] + n[2] * from.at[i][2] - c;
    p->corners = 0;
    for (int i = 0; i < from.corners; i++) {
        const int next = (i + 1) % from.corners;
        if (side[i] >= 0.0)
            keep(p, from.at[i]);
        if ((side[i] >= 0.0) == (side[next] >= 0.0))
            continue;
        const double t = side[i] / (side[i] - side[next]);
        double at[3];
        for (int k = 0; k < 3; k++)
            at[k] = from.at[i][k] + t * (from.at[next][k] - from.at[i][k]);
        keep(p, at);
    }
}

/* Cuts it to the view, and widens the depths that are seen by those that are left. */
static void see_polygon(polygon *p, const dp_setup *setup, scene_sight *out) {
    const view v = view_of(&setup->spec.triangles);
    const double sides[SIDES][3] = {{0, 0, 1},         {0, 0, -1},   {1, 0, v.across},
                                    {-1, 0, v.across}, {0, 1, v.up}, {0, -1, v.up}};
    const double least[SIDES] = {setup->spec.znear, -setup->spec.zfar};
    for (int i = 0; i < SIDES; i++)
        if (isfinite(least[i]))
            cut(p, sides[i], least[i]);
    for (int i = 0; i < p->corners; i++) {
        out->seen_from = fmin(out->seen_from, p->at[i][2]);
        out->seen_to = fmax(out->seen_to, p->at[i][2]);
    }
}

/* ---- Two triangles ----------------------------------------------------------------------------------------------- */

/* A pair as all eyes have it: its overlap on the first triangle, and both normals, of length 1. */
typedef struct pair {
    double along[3];       /* their common normal */
    double gap_lo, gap_hi; /* along it */
    double upright;        /* which share of that the distance from a plane is at least, along either normal */
    double corner[FINDER_CORNERS][3];
    int corners;
    double vertex[2][3][3];
    double normal[2][3];
    bool two_sided[2];
} pair;

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void unit_normal(const model *m, uint32_t triangle, double out[3]) {
    const uint32_t *of = m->triangle[triangle];
    exact_normal((const double *[]){m->position[of[0]], m->position[of[1]], m->position[of[2]]}, out);
    const double length = dp_hypot(dp_hypot(out[0], out[1]), out[2]);
    for (int k = 0; k < 3; k++)
        out[k] /= length;
}

/* Two triangles with their overlap where they are at most `gap` apart. */
static pair pair_of(const sight_asked *asked, const finder_pair *of, double gap) {
    const model *m = asked->m;
    overlap o = {0};
    pairs_overlap(m, of->triangle, gap, &o);
    pair p = {.gap_lo = o.lo, .gap_hi = o.hi, .upright = 1.0, .corners = o.corners};
    memcpy(p.along, o.along, sizeof p.along);
    memcpy(p.corner, o.corner, sizeof p.corner);
    for (int i = 0; i < 2; i++) {
        for (int k = 0; k < 3; k++)
            memcpy(p.vertex[i][k], m->position[m->triangle[of->triangle[i]][k]], sizeof p.vertex[i][k]);
        unit_normal(m, of->triangle[i], p.normal[i]);
        p.upright = fmin(p.upright, fabs(dot(p.along, p.normal[i])));
        p.two_sided[i] = asked->any_side || m->surface[m->of[of->triangle[i]]].two_sided;
    }
    return p;
}

static bool is_drawn(const pair *p, int i, const scene_eye *eye) {
    if (p->two_sided[i])
        return true;
    for (int c = 0; c < p->corners; c++) {
        double from[3], above[3];
        for (int k = 0; k < 3; k++) {
            from[k] = eye->place[k] - p->corner[c][k];
            above[k] = eye->place[k] - p->vertex[i][0][k];
        }
        const double height = dot(above, p->normal[i]);
        if (height >= 0.0 || height * height <= turned * turned * dot(from, from))
            return true;
    }
    return false;
}

/* The depths of the overlap in view, on both surfaces. */
static bool see_pair(const pair *p, const dp_setup *setup, const scene_eye *eye, scene_sight *out) {
    const double off[3] = {0.0, p->gap_lo, p->gap_hi};
    *out = (scene_sight){.seen_from = HUGE_VAL, .seen_to = -HUGE_VAL, .fights_from = (double)NAN, .covered = true};
    if (!is_drawn(p, 0, eye) || !is_drawn(p, 1, eye))
        return false;
    for (int s = 0; s < 3; s++) {
        polygon seen = {.corners = p->corners};
        for (int c = 0; c < p->corners; c++) {
            double at[3];
            for (int k = 0; k < 3; k++)
                at[k] = p->corner[c][k] + off[s] * p->along[k];
            scene_eye_sees(eye, at, seen.at[c]);
        }
        see_polygon(&seen, setup, out);
    }
    if (!(out->seen_from <= out->seen_to))
        return false;
    out->seen_from = fmax(out->seen_from * (1.0 - outward), setup->spec.znear);
    out->seen_to = fmin(out->seen_to * (1.0 + outward), setup->spec.zfar);
    return true;
}

/* ---- What is guaranteed of them ---------------------------------------------------------------------------------- */

/* Widens a class by one of the triangles; false where it cannot hold it. */
static bool include(const pair *p, int i, const dp_setup *setup, const scene_eye *eye, const scene_sight *seen,
                    dp_triangles *t) {
    const view v = view_of(t);
    double window[3][2];
    for (int k = 0; k < 3; k++) {
        double at[3];
        scene_eye_sees(eye, p->vertex[i][k], at);
        if (!(at[2] >= setup->spec.znear && at[2] <= setup->spec.zfar))
            return false;
        window[k][0] = 0.5 * t->width * at[0] / (v.across * at[2]);
        window[k][1] = 0.5 * t->height * at[1] / (v.up * at[2]);
        if (t->plane.origin > 0.0 && !(fabs(window[k][0]) < 0.5 * t->width && fabs(window[k][1]) < 0.5 * t->height))
            return false;
        t->depth = fmax(t->depth, (1.0 + outward) * fmax(at[2] / seen->seen_from, seen->seen_to / at[2]));
    }
    const draw_shape shape = draw_shape_of(window, t->subpixel);
    const double upright = fmin(fabs(dot(p->normal[i], eye->ahead)), 1.0);
    const double slant = dp_atan2(sqrt(1.0 - upright * upright), upright) / DP_DEGREE;
    t->pixels = fmax(t->pixels, shape.pixels);
    t->slim = fmax(t->slim, shape.slim);
    t->slant_lo = fmin(t->slant_lo, fmax(slant - 0.001, 0.0));
    t->slant_hi = fmax(t->slant_hi, fmin(slant + 0.001, 90.0));
    return true;
}

/* The set-up of the very triangles; false: there is none. */
static bool setup_of(const pair *p, const dp_setup *setup, const scene_eye *eye, const scene_sight *seen,
                     dp_setup *out) {
    dp_spec spec = setup->spec;
    dp_triangles *t = &spec.triangles;
    t->slant_lo = 90.0;
    t->slant_hi = 0.0;
    t->depth = t->pixels = 1.0;
    t->slim = 2.0;
    return spec.model == DP_MODEL_FLOAT && include(p, 0, setup, eye, seen, t) && include(p, 1, setup, eye, seen, t) &&
           dp_setup_init(out, &spec) == DP_OK;
}

/* The distance that is enough at these depths. */
static double enough(const dp_setup *setup, double from, double to, double limit) {
    dp_separation_worst worst = {.bound = HUGE_VAL};
    if (to < from)
        return 0.0;
    dp_separation_over(setup, from, to, limit, &worst);
    return worst.bound;
}

/* The set-up that judges a pair from an eye, and its distance. */
typedef struct standard {
    dp_setup own;
    bool covered; /* else by the class of the set-up */
    double least; /* its distance */
} standard;

static const dp_setup *standard_of(const pair *p, const sight_asked *asked, const scene_eye *eye,
                                   const scene_sight *seen, standard *out) {
    out->covered = setup_of(p, asked->setup, eye, seen, &out->own);
    const double apart = fmin(fabs(p->gap_lo), fabs(p->gap_hi));
    out->least = p->gap_lo <= 0.0 && p->gap_hi >= 0.0 ? 0.0 : apart * p->upright;
    return out->covered ? &out->own : asked->setup;
}

/* The distance that a pair lacks where it is seen, up to the depth asked for. */
static double lack_of(const sight_asked *asked, const dp_setup *by, const scene_sight *seen, double least) {
    const bool farther = asked->within > 0.0 && asked->within < seen->seen_to;
    return fmax(enough(by, seen->seen_from, farther ? asked->within : seen->seen_to, least) - least, 0.0);
}

/* Finds the depths at which a pair is seen and not guaranteed, and the distance that it lacks. */
static void judge_pair(const pair *p, const sight_asked *asked, const scene_eye *eye, scene_sight *seen) {
    standard of;
    const dp_setup *by = standard_of(p, asked, eye, seen, &of);
    seen->triangles = by->spec.triangles;
    seen->lift = lack_of(asked, by, seen, of.least);
    if (of.least == 0.0) {
        seen->fights_from = seen->seen_from;
        return;
    }
    seen->covered = of.covered;
    if (enough(by, seen->seen_from, seen->seen_to, of.least) <= of.least)
        return;
    const double to = distance_about(by, seen->seen_from, seen->seen_to, of.least, DIGITS);
    if (isnan(to))
        seen->fights_from = seen->seen_from;
    else if (to < seen->seen_to)
        seen->fights_from = to;
}

/* ---- A finding --------------------------------------------------------------------------------------------------- */

static double or_far(double depth) {
    return isnan(depth) ? HUGE_VAL : depth;
}

/* The class of both; of one without a view it is the other. */
static void widen(dp_triangles *to, const dp_triangles *by) {
    if (to->width == 0) {
        *to = *by;
    } else if (by->width > 0) {
        to->slant_lo = fmin(to->slant_lo, by->slant_lo);
        to->slant_hi = fmax(to->slant_hi, by->slant_hi);
        to->depth = fmax(to->depth, by->depth);
        to->pixels = fmax(to->pixels, by->pixels);
        to->slim = fmax(to->slim, by->slim);
    }
}

static void merge_sights(scene_sight *to, const scene_sight *from) {
    to->seen_from = fmin(to->seen_from, from->seen_from);
    to->seen_to = fmax(to->seen_to, from->seen_to);
    to->fights_from = fmin(to->fights_from, from->fights_from);
    to->lift = fmax(to->lift, from->lift);
    widen(&to->triangles, &from->triangles);
    to->covered = to->covered && from->covered;
}

static bool is_worse(const scene_sight *a, const scene_sight *b) {
    if (or_far(a->fights_from) != or_far(b->fights_from))
        return or_far(a->fights_from) < or_far(b->fights_from);
    if (a->covered != b->covered)
        return b->covered;
    return or_far(a->seen_from) < or_far(b->seen_from);
}

/* All eyes, or what of them tells which is the worst. */
static void judge_eyes(const sight_asked *asked, const finder_finding *f, scene_sight *sight) {
    const double nan = (double)NAN;
    double nearest = HUGE_VAL; /* that any fights */
    for (size_t e = 0; e < asked->eyes; e++)
        sight[e] = (scene_sight){.seen_from = nan, .seen_to = nan, .fights_from = nan, .covered = true, .eye = e};
    for (size_t i = 0; i < f->pairs && !(asked->stop != NULL && asked->stop()); i++) {
        const pair p = pair_of(asked, &asked->found->pair[f->first + i], asked->gap);
        for (size_t e = 0; e < asked->eyes; e++) {
            scene_sight seen;
            if (!see_pair(&p, asked->setup, &asked->eye[e], &seen))
                continue;
            if (asked->eyes == 1 || seen.seen_from <= nearest) /* else it is not what is worst */
                judge_pair(&p, asked, &asked->eye[e], &seen);
            else if (asked->classes)
                seen.triangles = standard_of(&p, asked, &asked->eye[e], &seen, &(standard){0})->spec.triangles;
            nearest = fmin(nearest, seen.fights_from);
            merge_sights(&sight[e], &seen);
        }
    }
}

/* ---- What mends it ----------------------------------------------------------------------------------------------- */

/* The share by which a distance along one normal grows where it is added along the other. */
static double parallel(const double a[3], const double b[3]) {
    double sine = 0.0;
    for (int k = 0; k < 3; k++) {
        const double c = a[k] * b[(k + 1) % 3] - a[(k + 1) % 3] * b[k];
        sine += c * c;
    }
    return sqrt(1.0 - sine);
}

/* One of the triangles moved by `by` along the first one's normal, away from the other where that is above 0. */
static pair moved_apart(const pair *p, int which, double by) {
    const double grown = by * parallel(p->normal[0], p->normal[1]);
    pair to = *p;
    const double step = which == 0 ? -by : by;
    for (int c = 0; c < 3; c++)
        for (int k = 0; k < 3; k++)
            to.vertex[which][c][k] += step * p->normal[0][k];
    for (int c = 0; which == 0 && c < p->corners; c++)
        for (int k = 0; k < 3; k++)
            to.corner[c][k] += step * p->normal[0][k];
    to.gap_lo += grown;
    to.gap_hi += grown;
    return to;
}

/* The distance that a pair still lacks once it is moved. */
static double lack_moved(const sight_asked *asked, const pair *p, double by) {
    double lack = 0.0;
    for (int which = 0; which < 2; which++) {
        const pair to = moved_apart(p, which, by);
        scene_sight seen;
        standard of;
        if (!see_pair(&to, asked->setup, asked->eye, &seen))
            continue;
        const dp_setup *used = standard_of(&to, asked, asked->eye, &seen, &of);
        lack = fmax(lack, lack_of(asked, used, &seen, of.least) / (p->upright * parallel(p->normal[0], p->normal[1])));
    }
    return lack;
}

/*
 * Whether the triangles of a pair meet in some places and part in others: they cross, or fold apart along a line. Where
 * they meet they fight however far they are moved, and what lies beside them comes nearer.
 */
static bool is_crossing(const finder_found *found, const finder_finding *f) {
    const double none = SCENE_NO_GAP * found->extent;
    for (size_t i = 0; i < f->pairs; i++) {
        const finder_pair *p = &found->pair[f->first + i];
        if (p->gap_lo <= none && p->gap_hi >= -none && p->gap_hi - p->gap_lo > none)
            return true;
    }
    return false;
}

double scene_lift(const model *m, const finder_found *found, const finder_finding *f, double lift) {
    double share = 1.0;
    if (lift > 0.0 && is_crossing(found, f))
        return HUGE_VAL;
    for (size_t i = 0; i < f->pairs && lift > 0.0; i++) {
        double n[2][3];
        for (int k = 0; k < 2; k++)
            unit_normal(m, found->pair[f->first + i].triangle[k], n[k]);
        share = fmin(share, parallel(n[0], n[1]));
    }
    return lift > 0.0 ? lift / share : lift;
}

/* The most that any pair still lacks. Pairs that touch may be moved to either side. */
static double lack_of_all(const sight_asked *asked, const finder_finding *f, double lift) {
    const double none = SCENE_NO_GAP * asked->found->extent;
    double lack = 0.0;
    for (size_t i = 0; i < f->pairs && !(asked->stop != NULL && asked->stop()); i++) {
        const pair p = pair_of(asked, &asked->found->pair[f->first + i], FINDER_COORDINATE_MAX);
        if (p.gap_hi >= -none)
            lack = fmax(lack, lack_moved(asked, &p, lift));
        if (p.gap_lo <= none)
            lack = fmax(lack, lack_moved(asked, &p, -lift));
    }
    return lack;
}

/* Moved, triangles are seen elsewhere, and are of another class: what is proposed is judged again until it is enough.
 */
static double enough_lift(const sight_asked *asked, const finder_finding *f, double lift) {
    if (!(lift > 0.0))
        return lift;
    if (is_crossing(asked->found, f))
        return HUGE_VAL;
    for (int round = 0; round < ROUNDS && isfinite(lift); round++) {
        const double lack = lack_of_all(asked, f, lift);
        if (lack == 0.0)
            return lift;
        lift += (1.0 + spare) * lack;
    }
    return HUGE_VAL;
}

/* ---- The worst eye ----------------------------------------------------------------------------------------------- */

scene_sight scene_sight_worst(const sight_asked *asked, const finder_finding *f, scene_sight *sight) {
    size_t worst = 0;
    dp_triangles all = {0};
    sight_asked alone = *asked;
    judge_eyes(asked, f, sight);
    for (size_t e = 0; e < asked->eyes; e++) {
        worst = is_worse(&sight[e], &sight[worst]) ? e : worst;
        widen(&all, &sight[e].triangles);
    }
    alone.eye += worst;
    alone.eyes = 1;
    if (asked->eyes > 1)
        judge_eyes(&alone, f, sight);
    sight[0].lift = enough_lift(&alone, f, sight[0].lift);
    sight[0].triangles = asked->classes ? all : sight[0].triangles;
    sight[0].eye = worst;
    sight[0].covered = sight[0].covered || !isnan(sight[0].fights_from);
    return sight[0];
}
