/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "shader/projection.h"

#include <math.h>
#include <stdio.h>

/* Slopes of the picture's edges: 89.9 degrees off the axis; and half the width of a tile of a large picture. */
static const double EDGE_MOST = 1000, HALF_LEAST = 1e-9;
static const double ORTHO_MOST = 1e12;

enum { X = 0, Y = 4, Z = 8, W = 12 };

static bool refuse(char why[PROJECTION_WHY], const char *rule, const double given[4]) {
    snprintf(why, PROJECTION_WHY, "%s, got %.9g %.9g %.9g %.9g", rule, given[0], given[1], given[2], given[3]);
    return false;
}

/* Zeros where no perspective and no orthographic matrix has anything else, and none where neither has one. */
static bool check_form(const double m[16], char why[PROJECTION_WHY]) {
    const bool ortho = m[W + 2] == 0 && m[W + 3] == 1;
    for (int i = 0; i < 16; i++)
        if (!isfinite(m[i]))
            return refuse(why, "entries must be finite numbers", m + i / 4 * 4);
    if (m[W] != 0 || m[W + 1] != 0 || !(ortho || (fabs(m[W + 2]) == 1 && m[W + 3] == 0)))
        return refuse(why,
                      m[X + 3] == 0 && m[Y + 3] == 0 && fabs(m[Z + 3]) + fabs(m[W + 3]) == 1
                          ? "the fourth row must be 0 0 1 0, 0 0 -1 0 or 0 0 0 1, as the fourth column is: transpose it"
                          : "the fourth row must be 0 0 1 0, 0 0 -1 0 or, orthographic, 0 0 0 1",
                      m + W);
    const struct {
        int row, column;
        const char *wrong;
    } entries[] = {{X, 0, "is singular: x of the first row must not be 0"},
                   {Y, 1, "is singular: y of the second row must not be 0"},
                   {Z, 2, "is singular: z of the third row must not be 0, or depth is constant"},
                   {Z, 3, "is singular: the last of the third row must not be 0, or depth does not depend on z"}};
    for (int i = 0; i < 4; i++)
        if (m[entries[i].row + entries[i].column] == 0 && entries[i].column != (ortho ? 3 : 2))
            return refuse(why, entries[i].wrong, m + entries[i].row);
    if (m[X] < 0)
        return refuse(why, "x of the first row must be positive: a mirrored picture has another handedness", m + X);
    if (m[X + 1] != 0 || m[X + (ortho ? 2 : 3)] != 0)
        return refuse(why, ortho ? "the first row must be x 0 0 t" : "the first row must be x 0 z 0", m + X);
    if (m[Y] != 0 || m[Y + (ortho ? 2 : 3)] != 0)
        return refuse(why, ortho ? "the second row must be 0 y 0 t" : "the second row must be 0 y z 0", m + Y);
    if (ortho && (m[Z] != 0 || m[Z + 1] != 0))
        return refuse(why, "an orthographic third row must be 0 0 z t: oblique planes need a perspective", m + Z);
    return true;
}

/* How wide the picture is, and where its axis lies. */
static bool take_frustum(projection *p, const double m[16], char why[PROJECTION_WHY]) {
    const double sides[2] = {m[X], m[Y + 1]}, most = p->ortho ? ORTHO_MOST : EDGE_MOST;
    for (int k = 0; k < 2; k++) {
        const double *row = m + 4 * k, moved = p->ortho ? row[3] : p->backwards ? -row[2] : row[2];
        p->scale[k] = fabs(sides[k]);
        p->half[k] = 1 / p->scale[k];
        p->centre[k] = sides[k] < 0 ? -moved : moved;
        if (!(p->half[k] * (1 + fabs(p->centre[k])) <= most && p->half[k] >= (p->ortho ? 1e-12 : HALF_LEAST)))
            return refuse(why,
                          p->ortho ? "half a side must be from 1e-12 to 1e12 scene units, its edges within 1e12"
                                   : "the picture's edges must lie within slopes of 1000, half of it from 1e-9 on",
                          row);
    }
    return true;
}

/* ---- Depth ------------------------------------------------------------------------------------------------------- */

/* Eye depth where window depth ends, at 0 or at 1; `least` is NDC depth there at 0. */
static double end_of(double c, double e, double end) {
    const double apart = end - c;
    return apart == 0 ? (double)INFINITY : e / apart;
}

static bool take_ortho(projection *p, const double row[4], double least, bool reversed, char why[PROJECTION_WHY]) {
    p->reversed = reversed;
    p->backwards = (row[2] > 0) == reversed;
    const double c = p->backwards ? -row[2] : row[2], at_0 = (least - row[3]) / c, at_1 = (1 - row[3]) / c;
    p->znear = reversed ? at_1 : at_0;
    p->zfar = reversed ? at_0 : at_1;
    return isfinite(p->znear) && isfinite(p->zfar) ? true : refuse(why, "the planes must be finite", row);
}

/* The planes of one ray, whose third row is c and e: nearest and farthest so far; beyond infinity is infinite. */
static bool add_ray(projection *p, double c, double e, double least, bool *beyond) {
    const double at_0 = end_of(c, e, least), at_1 = end_of(c, e, 1);
    const double near = p->reversed ? at_1 : at_0, far = p->reversed ? at_0 : at_1;
    const bool seen = near > 0 && near < (double)INFINITY;
    *beyond = *beyond || far < 0;
    if (seen)
        p->znear = fmin(p->znear, near);
    p->zfar = far < 0 ? (double)INFINITY : fmax(p->zfar, far);
    return seen;
}

/* What is linear over the picture has its extremes in the corners. */
static bool take_perspective(projection *p, const double row[4], double least, char why[PROJECTION_WHY]) {
    const double c = p->backwards ? -row[2] : row[2], share = (1 - least) == 2 ? 0.5 : 1;
    const dp_pair moved = dp_two_sum(c, -least);
    bool seen = false, beyond = false;
    p->reversed = row[3] > 0;
    p->tilt[0] = row[0] * share;
    p->tilt[1] = row[1] * share;
    p->base = (dp_pair){moved.hi * share, moved.lo * share};
    p->pull = row[3] * share;
    p->znear = (double)INFINITY;
    p->zfar = 0;
    for (int i = 0; i < 4; i++) {
        const double u = ((i & 1 ? 1 : -1) - p->centre[0]) * p->half[0];
        const double v = ((i & 2 ? 1 : -1) - p->centre[1]) * p->half[1];
        seen = add_ray(p, c + (row[0] * u + row[1] * v), row[3], least, &beyond) || seen;
    }
    p->oblique = row[0] != 0 || row[1] != 0 || beyond;
    return seen ? true : refuse(why, "nothing ahead of the camera has a window depth in [0, 1] by the third row", row);
}

bool projection_init(projection *out, const double m[16], bool ndc_signed, bool reversed, char why[PROJECTION_WHY]) {
    const double least = ndc_signed ? -1 : 0;
    *out = (projection){.ortho = m[W + 2] == 0, .backwards = m[W + 2] < 0};
    if (!check_form(m, why) || !take_frustum(out, m, why))
        return false;
    return out->ortho ? take_ortho(out, m + Z, least, reversed, why) : take_perspective(out, m + Z, least, why);
}
