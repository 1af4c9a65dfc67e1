/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "requirement/root.h"

#include <math.h>

enum { STEPS = 200 };

typedef struct point {
    double x, f;
} point;

/* The share of the way from `now` to `other` at which to look next. `last` is the point that was given up. */
static double share_of(point now, point other, point last) {
    const double along = (now.x - other.x) / (last.x - other.x);
    const double up = (now.f - other.f) / (last.f - other.f);
    if (!(up * up < along && (1.0 - up) * (1.0 - up) < 1.0 - along)) /* else the parabola is monotone between them */
        return 0.5;
    return now.f / (other.f - now.f) * (last.f / (other.f - last.f)) +
           (last.x - now.x) / (other.x - now.x) * (now.f / (last.f - now.f)) * (other.f / (last.f - other.f));
}

double root_find(root_function *f, void *context, double a, double b, double apart) {
    point now = {b, f(b, context)}, other = {a, f(a, context)};
    if (now.f == 0.0 || other.f == 0.0)
        return now.f == 0.0 ? b : a;
    if ((now.f > 0.0) == (other.f > 0.0))
        return a;
    double share = 0.5;
    for (int i = 0; i < STEPS; i++) {
        const double x = now.x + share * (other.x - now.x);
        if (x == now.x || x == other.x)
            break;
        const point next = {x, f(x, context)};
        point last = now;
        if ((next.f > 0.0) != (now.f > 0.0)) {
            last = other;
            other = now;
        }
        now = next;
        const double width = fabs(other.x - now.x);
        if (now.f == 0.0 || width <= apart)
            break;
        const double least = 0.5 * apart / width; /* not closer to an end than half of what is asked */
        share = fmin(fmax(share_of(now, other, last), least), 1.0 - least);
    }
    return fabs(now.f) < fabs(other.f) ? now.x : other.x;
}
