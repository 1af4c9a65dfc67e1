/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "world/arithmetic.h"

#include <math.h>

/* ---- Sums of products -------------------------------------------------------------------------------------------- */

/* The places of `count` terms in a sum: permutation number `order` of them. */
static void permute(unsigned order, int count, int out[4]) {
    int left[4] = {0, 1, 2, 3};
    for (int i = 0; i < count; i++) {
        const int rest = count - i, taken = (int)(order % (unsigned)rest);
        order /= (unsigned)rest;
        out[i] = left[taken];
        for (int k = taken; k + 1 < rest; k++)
            left[k] = left[k + 1];
    }
}

static float multiply_add(bool fused, float x, float y, float sum) {
    const float product = x * y;
    return fused ? fmaf(x, y, sum) : product + sum;
}

/* A row of a matrix times a place; with its constant, or without. */
static float dot(const world_camera *c, const float *row, const float *p, int count) {
    int o[4];
    permute(c->order, count, o);
    const float first = multiply_add(c->fused, row[o[1]], p[o[1]], row[o[0]] * p[o[0]]);
    if (count == 3)
        return multiply_add(c->fused, row[o[2]], p[o[2]], first);
    if (c->order >= WORLD_ORDERS / 2)
        return first + multiply_add(c->fused, row[o[3]], p[o[3]], row[o[2]] * p[o[2]]);
    return multiply_add(c->fused, row[o[3]], p[o[3]], multiply_add(c->fused, row[o[2]], p[o[2]], first));
}

/* ---- Cameras ----------------------------------------------------------------------------------------------------- */

/* A row of the view matrix of a camera that stands at `eye`: formed in double, each entry rounded once. */
static void view_row(const world_camera *c, const double eye[3], int k, float out[4]) {
    const double *a = c->axis[k];
    for (int i = 0; i < 3; i++)
        out[i] = (float)a[i];
    out[3] = (float)-(a[0] * eye[0] + a[1] * eye[1] + a[2] * eye[2]);
}

static void transform(const world_camera *c, const double eye[3], const float p[4], float out[3]) {
    for (int k = 0; k < 3; k++) {
        float row[4];
        view_row(c, eye, k, row);
        out[k] = dot(c, row, p, 4);
    }
}

/* A place that is seen from the camera already. */
static void turn_round(const world_camera *c, const float seen[3], float out[3]) {
    static const double here[3];
    for (int k = 0; k < 3; k++) {
        float row[4];
        view_row(c, here, k, row);
        out[k] = dot(c, row, seen, 3);
    }
}

/* ---- The rows ---------------------------------------------------------------------------------------------------- */

static void vertex_of(const world_place *place, float out[4]) {
    for (int i = 0; i < 3; i++)
        out[i] = (float)(place->origin[i] + place->local[i]);
    out[3] = 1.0F;
}

void arithmetic_world(const world_scheme *s, const world_camera *c, const world_place *place, float out[3]) {
    (void)s;
    float p[4];
    vertex_of(place, p);
    transform(c, c->eye, p, out);
}

void arithmetic_local(const world_scheme *s, const world_camera *c, const world_place *place, float out[3]) {
    (void)s;
    float origin[4] = {0, 0, 0, 1}, p[4] = {0, 0, 0, 1};
    for (int i = 0; i < 3; i++) {
        origin[i] = (float)place->origin[i];
        p[i] = (float)place->local[i];
    }
    for (int k = 0; k < 3; k++) {
        float row[4];
        view_row(c, c->eye, k, row);
        row[3] = dot(c, row, origin, 4);
        out[k] = dot(c, row, p, 4);
    }
}

void arithmetic_camera_float(const world_scheme *s, const world_camera *c, const world_place *place, float out[3]) {
    (void)s;
    float p[4];
    vertex_of(place, p);
    for (int i = 0; i < 3; i++)
        p[i] -= (float)c->eye[i];
    turn_round(c, p, out);
}

void arithmetic_camera_double(const world_scheme *s, const world_camera *c, const world_place *place, float out[3]) {
    (void)s;
    float seen[3];
    for (int i = 0; i < 3; i++)
        seen[i] = (float)(place->origin[i] + place->local[i] - c->eye[i]);
    turn_round(c, seen, out);
}

/* high: the multiple of the size towards 0. */
static void split(double size, double v, float *high, float *low) {
    const double multiple = copysign(floor(fabs(v) / size) * size, v);
    *high = (float)multiple;
    *low = (float)(v - multiple);
}

void arithmetic_split(const world_scheme *s, const world_camera *c, const world_place *place, float out[3]) {
    float seen[3];
    for (int i = 0; i < 3; i++) {
        float high, low, camera_high, camera_low;
        split(s->size, place->origin[i] + place->local[i], &high, &low);
        split(s->size, c->eye[i], &camera_high, &camera_low);
        const float high_part = high - camera_high, low_part = low - camera_low;
        seen[i] = high_part + low_part;
    }
    turn_round(c, seen, out);
}

/* The whole number of sizes next to v, or almost so, and what is left, as so many parts of a size. */
static double nearest(double size, double v, double lag, double parts, float *offset) {
    const double index = rint(v / size + lag);
    *offset = (float)(fma(-index, size, v) * (parts / size));
    return index;
}

/*
 * In a unit in which a tile is a power of two: in metres Unreal's has no binary32 number. The number of a tile has one
 * up to 2^24 (TLargeWorldRenderScalar::MakeTile).
 */
void arithmetic_tile(const world_scheme *s, const world_camera *c, const world_place *place, float out[3]) {
    static const double parts = 0x1p21;
    float seen[3];
    for (int i = 0; i < 3; i++) {
        float offset, camera_offset;
        const float tile = (float)nearest(s->size, place->origin[i], 0.0, parts, &offset);
        const float camera_tile = (float)nearest(s->size, c->eye[i], 0.0, parts, &camera_offset);
        const float tiles = (tile - camera_tile) * (float)parts, offsets = offset - camera_offset;
        const float origin = tiles + offsets;
        seen[i] = origin + (float)(place->local[i] * (parts / s->size));
    }
    turn_round(c, seen, out);
    for (int k = 0; k < 3; k++)
        out[k] = (float)((double)out[k] * (s->size / parts));
}

/* A number as the sum of two of binary32. */
typedef struct pair {
    float high, low;
} pair;

static pair pair_of(double v) {
    const float high = (float)v;
    return (pair){high, (float)(v - (double)high)};
}

/* The sum of two numbers, and what its rounding left; the first is the larger one. */
static pair quick_two_sum(float first, float second) {
    const float sum = first + second, added = sum - first;
    return (pair){sum, second - added};
}

/* The same sum of any two numbers. */
static pair two_sum(float first, float second) {
    const float sum = first + second, added = sum - first, kept = sum - added;
    const float first_rest = first - kept, second_rest = second - added;
    return (pair){sum, first_rest + second_rest};
}

/* Not inlined: gcc 12.2 at -O3 makes vectors of the three coordinates that lose the lower parts. */
static __attribute__((noinline)) float pair_sum(pair a, pair b) {
    const pair high = two_sum(a.high, b.high), low = two_sum(a.low, b.low);
    const pair once = quick_two_sum(high.high, high.low + low.high);
    return quick_two_sum(once.high, once.low + low.low).high;
}

void arithmetic_two_sum(const world_scheme *s, const world_camera *c, const world_place *place, float out[3]) {
    (void)s;
    float seen[3];
    for (int i = 0; i < 3; i++)
        seen[i] = (float)place->local[i] + pair_sum(pair_of(place->origin[i]), pair_of(-c->eye[i]));
    turn_round(c, seen, out);
}

void arithmetic_cell(const world_scheme *s, const world_camera *c, const world_place *place, float out[3]) {
    float p[4] = {0, 0, 0, 1};
    double eye[3];
    const double lag = (WORLD_CELL_MOST - 0.5) * c->lag;
    for (int i = 0; i < 3; i++) {
        float offset, camera_offset;
        const double cell = nearest(s->size, place->origin[i], lag, s->size, &offset);
        const double camera_cell = nearest(s->size, c->eye[i], lag, s->size, &camera_offset);
        const float origin = (float)((cell - camera_cell) * s->size + (double)offset);
        p[i] = (float)place->local[i] + origin;
        eye[i] = (double)camera_offset;
    }
    transform(c, eye, p, out);
}

void world_exact(const world_camera *c, const world_place *place, long double out[3]) {
    for (int k = 0; k < 3; k++) {
        out[k] = 0.0L;
        for (int i = 0; i < 3; i++) {
            const long double seen =
                ((long double)place->origin[i] - (long double)c->eye[i]) + (long double)place->local[i];
            out[k] += (long double)c->axis[k][i] * seen;
        }
    }
}
