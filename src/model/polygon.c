/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "model/polygon.h"

#include <math.h>
#include <string.h>

/* Seen along the axis to which the polygon is turned most. */
typedef struct view {
    const double (*position)[3];
    int x, y;
    double sign;
} view;

/* The normal by Newell: the sum over the edges holds for polygons that are neither flat nor convex, too. */
static view view_of(const model *m, const uint32_t *corner, size_t corners) {
    double normal[3] = {0};
    for (size_t i = 0; i < corners; i++) {
        const double *p = m->position[corner[i]], *q = m->position[corner[(i + 1) % corners]];
        for (int k = 0; k < 3; k++) {
            const int a = (k + 1) % 3, b = (k + 2) % 3;
            normal[k] += (p[a] - q[a]) * (p[b] + q[b]);
        }
    }
    int k = fabs(normal[1]) > fabs(normal[0]) ? 1 : 0;
    k = fabs(normal[2]) > fabs(normal[k]) ? 2 : k;
    return (view){(const double(*)[3])m->position, (k + 1) % 3, (k + 2) % 3, normal[k] < 0.0 ? -1.0 : 1.0};
}

/* Twice the area, positive where a b c turn as the polygon does. */
static double turn(const view *v, uint32_t a, uint32_t b, uint32_t c) {
    const double *p = v->position[a], *q = v->position[b], *r = v->position[c];
    return v->sign * ((q[v->x] - p[v->x]) * (r[v->y] - p[v->y]) - (q[v->y] - p[v->y]) * (r[v->x] - p[v->x]));
}

static bool holds(const view *v, const uint32_t t[3], uint32_t p) {
    return turn(v, t[0], t[1], p) >= 0.0 && turn(v, t[1], t[2], p) >= 0.0 && turn(v, t[2], t[0], p) >= 0.0;
}

/* Whether the corner at i can be cut off: it points outwards and no other corner lies in the triangle. */
static bool is_ear(const view *v, const uint32_t *corner, size_t corners, size_t i) {
    const uint32_t t[3] = {corner[(i + corners - 1) % corners], corner[i], corner[(i + 1) % corners]};
    if (!(turn(v, t[0], t[1], t[2]) > 0.0))
        return false;
    for (size_t j = 0; j < corners; j++)
        if (corner[j] != t[0] && corner[j] != t[1] && corner[j] != t[2] && holds(v, t, corner[j]))
            return false;
    return true;
}

/* So a fan covers it. Corners in line would lie on triangles of the fan, a crack beside the next face, and are cut off
 * as ears; a face too large for that may have them. */
static bool is_convex(const view *v, const uint32_t *corner, size_t corners) {
    for (size_t i = 0; i < corners; i++) {
        const double turned = turn(v, corner[i], corner[(i + 1) % corners], corner[(i + 2) % corners]);
        if (!(turned > 0.0 || (corners > POLYGON_MAX && turned == 0.0)))
            return false;
    }
    return true;
}

static bool fan(model_source *s, const uint32_t *corner, size_t corners, uint32_t surface) {
    for (size_t i = 2; i < corners; i++) {
        const uint32_t t[3] = {corner[0], corner[i - 1], corner[i]};
        if (!model_add_triangle(s, t, surface))
            return false;
    }
    return true;
}

bool polygon_cut(model_source *s, uint32_t *corner, size_t corners, uint32_t surface) {
    const view v = view_of(s->out, corner, corners);
    if (corners == 3 || is_convex(&v, corner, corners))
        return fan(s, corner, corners, surface);
    if (corners > POLYGON_MAX)
        return model_fail(s, "has a face that is not convex with %zu corners: at most %d are cut into triangles",
                          corners, POLYGON_MAX);
    size_t i = 0;
    for (size_t misses = 0; corners > 3 && misses < corners;) {
        if (!is_ear(&v, corner, corners, i)) {
            misses++;
            i = (i + 1) % corners;
            continue;
        }
        const uint32_t t[3] = {corner[(i + corners - 1) % corners], corner[i], corner[(i + 1) % corners]};
        if (!model_add_triangle(s, t, surface))
            return false;
        memmove(corner + i, corner + i + 1, (corners - i - 1) * sizeof *corner);
        corners--;
        i %= corners;
        misses = 0;
    }
    return fan(s, corner, corners, surface);
}
