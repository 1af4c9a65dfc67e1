/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "plane_order.h"

#include <math.h>

/* Anchored at the farthest vertex. */
float plane_at_vertex(const corner v[3], float px, float py) {
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

float plane_at_origin(const corner v[3], float px, float py) {
    const plane p = plane_of(v);
    return fmaf(p.b, py - 0.5F, fmaf(p.a, px - 0.5F, p.c));
}

float plane_unfused(const corner v[3], float px, float py) {
    const plane p = plane_of(v);
    const float ax = p.a * (px - 0.5F);
    const float by = p.b * (py - 0.5F);
    const float row = p.c + ax;
    return row + by;
}

/* Gradients by one division of each, and a step to pixels of odd places. */
float plane_stepped(const corner v[3], float px, float py) {
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
float plane_exact(const corner v[3], float px, float py) {
    const double x1 = (double)v[1].x - (double)v[0].x, y1 = (double)v[1].y - (double)v[0].y;
    const double x2 = (double)v[2].x - (double)v[0].x, y2 = (double)v[2].y - (double)v[0].y;
    const double z1 = (double)v[1].z - (double)v[0].z, z2 = (double)v[2].z - (double)v[0].z;
    const double x = (double)px - (double)v[0].x, y = (double)py - (double)v[0].y, det = x1 * y2 - x2 * y1;
    return (float)((double)v[0].z + ((x * y2 - x2 * y) * z1 + (x1 * y - x * y1) * z2) / det);
}
