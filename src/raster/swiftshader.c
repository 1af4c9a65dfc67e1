/* SPDX-License-Identifier: GPL-3.0-or-later */
/* SwiftShader 5: clipped for coverage alone; the plane is that of the three vertices as they were given, snapped. */
#include <math.h>

#include "raster/clip.h"
#include "raster/model.h"

enum { SNAP_BITS = 4, SNAP = 1 << SNAP_BITS };

static const int32_t corner_max = 1 << 24; /* of a clipped one, far beyond any target */
static const float least_int = -0x1p31F;
static const float greatest_int = 0x1.fffffep30F; /* the greatest binary32 number that is an int32_t */

static raster_vertex cut(const raster_vertex *inside, const raster_vertex *outside, float d_inside, float d_outside) {
    const float d = 1.0F / (d_outside - d_inside);
    return (raster_vertex){
        (d_outside * inside->x - d_inside * outside->x) * d, (d_outside * inside->y - d_inside * outside->y) * d,
        (d_outside * inside->z - d_inside * outside->z) * d, (d_outside * inside->w - d_inside * outside->w) * d};
}

static const raster_clip_rule rule = {{RASTER_NEAR, RASTER_FAR, RASTER_LEFT, RASTER_RIGHT, RASTER_TOP, RASTER_BOTTOM},
                                      cut};

static float reciprocal(float w) {
    return w != 0.0F ? 1.0F / w : 1.0F;
}

/* A window coordinate in sixteenths of a pixel from the centre of pixel 0. Not a number counts as the greatest. */
static int32_t snapped(float clip, float r, int size) {
    const float half = (float)size / 2.0F;
    const float x = half * SNAP - SNAP / 2 + clip * r * (half * SNAP);
    return (int32_t)rintf(x < greatest_int ? (x > least_int ? x : least_int) : greatest_int);
}

/* Differences wrap, as those of 32 bits do. */
static float pixels(int32_t to, int32_t from) {
    return (float)(int32_t)((uint32_t)to - (uint32_t)from) * (1.0F / SNAP);
}

/* The vertices turned: that of the least clip y comes first, of those that of the largest w. */
static void turn(const raster_vertex v[3], int order[3]) {
    int first = 0;
    const float y = fminf(fminf(v[0].y, v[1].y), v[2].y);
    first += y == v[1].y ? 1 : 0;
    first += y == v[2].y ? 2 : 0;
    const raster_vertex *a = &v[first % 3], *b = &v[(first + 1) % 3], *c = &v[(first + 2) % 3];
    const float w = fmaxf(fmaxf(a->w, b->w), c->w);
    first += w == b->w ? 1 : 0;
    first += w == c->w ? 2 : 0;
    for (int i = 0; i < 3; i++)
        order[i] = (first + i) % 3;
}

static bool set_plane(const raster_target *target, const raster_vertex v[3], raster_plane *plane) {
    int order[3];
    int32_t x[3], y[3];
    float z[3];
    turn(v, order);
    for (int i = 0; i < 3; i++) {
        const raster_vertex *at = &v[order[i]];
        const float r = reciprocal(at->w);
        x[i] = snapped(at->x, r, target->width);
        y[i] = snapped(at->y, r, target->height);
        z[i] = at->z * r;
    }
    const float x1 = pixels(x[1], x[0]), x2 = pixels(x[2], x[0]);
    const float y1 = pixels(y[1], y[0]), y2 = pixels(y[2], y[0]);
    const float z1 = z[1] - z[0], z2 = z[2] - z[0];
    const float area = x1 * y2 - x2 * y1;
    const float d = target->span / area;
    *plane = (raster_plane){(y2 * z1 - y1 * z2) * d, (x1 * z2 - x2 * z1) * d, z[0] * target->span + target->lo,
                            (float)x[0] * (1.0F / SNAP), (float)y[0] * (1.0F / SNAP)};
    return area != 0.0F;
}

raster_status raster_swiftshader_draw(const raster_target *target, const raster_vertex vertex[3],
                                      raster_triangle *drawn) {
    raster_corner corner[RASTER_CORNERS];
    raster_piece *piece = &drawn->piece[0];
    unsigned all;
    const unsigned outside = raster_outside(vertex, &all);
    piece->corners = all != 0 ? 0 : outside == 0 ? 3 : raster_clip(&rule, vertex, outside, corner);
    piece->bits = SNAP_BITS;
    if (piece->corners == 0)
        return RASTER_EMPTY;
    for (int i = 0; i < piece->corners; i++) {
        const raster_vertex *at = outside == 0 ? &vertex[i] : &corner[i].at;
        const float r = reciprocal(at->w);
        piece->x[i] = snapped(at->x, r, target->width);
        piece->y[i] = snapped(at->y, r, target->height);
        if (piece->x[i] < -corner_max || piece->x[i] > corner_max || piece->y[i] < -corner_max ||
            piece->y[i] > corner_max)
            return RASTER_RANGE;
    }
    if (!set_plane(target, vertex, &piece->plane) || !raster_snapped_rows(target, piece))
        return RASTER_EMPTY;
    drawn->count = 1;
    return raster_plane_finite(target, &piece->plane) ? RASTER_OK : RASTER_RANGE;
}
