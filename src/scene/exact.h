/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Decisions about triangles without rounding: in double with a bound on its error where that settles it, else in pairs
 * of doubles, else in expansions (see core/expansion.h). A triangle is three pointers to coordinates; every coordinate
 * is 0 or between 1e-50 and 1e50 in magnitude, so that nothing overflows and no bit falls below 2^-1074.
 */
#ifndef SCENE_EXACT_H
#define SCENE_EXACT_H

#include <stdbool.h>

typedef const double *const exact_triangle[3];

/* The answer of a quick evaluation that cannot tell a sign. */
enum { EXACT_UNSURE = 2 };

/* (t1 - t0) x (t2 - t0), each component good to 2^-42 of the vector's length; false: it is exactly 0. */
bool exact_normal(exact_triangle t, double normal[3]);

/* The side of t's plane on which p lies: 1 in front, 0 exactly on it, -1 behind. */
int exact_above(exact_triangle t, const double p[3]);

/* Two triangles and the direction along which they are looked at: normal of a + sign normal of b, which is not 0. */
typedef struct exact_view {
    const double *a[3], *b[3];
    double sign;               /* 1 or -1 */
    bool plane;                /* both lie in one plane, exactly */
    double along[3], sizes[3]; /* the direction in double, and what bounds its error */
} exact_view;

/* `plane` is false, to be set by the caller. */
void exact_look(exact_view *view, exact_triangle a, exact_triangle b, double sign);

/*
 * Whether p, q, r turn counter-clockwise, seen with the direction towards the eye: 1; 0: they are in line; -1. The
 * quick one may be EXACT_UNSURE.
 */
int exact_turn(const exact_view *view, const double p[3], const double q[3], const double r[3]);
int exact_turn_quick(const exact_view *view, const double p[3], const double q[3], const double r[3]);

#endif
