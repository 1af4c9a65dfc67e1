/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The rows, and their bounds: depthprec(7), "Large worlds", derives every line. */
#include "world/world.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/outward.h"
#include "world/arithmetic.h"

static const double unit = 0x1p-24;
static const double root3 = 1.73205081;
static const double turn = WORLD_TURN;

/* Terms of second order, and what is formed in double on the way to a binary32 number; and numbers that are flushed. */
static const double outward = 1.0 + DP_ROUNDINGS32_254, flushed = 0x1p-120;

/* Half a unit of a double in the world, and of the second of two binary32 numbers. */
static const double in_double = 0x1p-53, low_part = 0x1p-49;

/* Half a unit in the last place of the largest binary32 number that is not above x. */
static double half_ulp(double x) {
    int exponent;
    frexp(x, &exponent);
    return ldexp(unit, exponent - 1);
}

/* Half a unit in the last place just below x, which may be a power of two. */
static double half_ulp_below(double x) {
    return half_ulp(x * (1.0 - 0x1p-30));
}

/* A vector of `length` through three entries, to a coordinate of `result`: products, one sum on the way, the last. */
static double turned(const world_where *at) {
    return unit * (2.0 * at->length + at->result);
}

/* Four products up to `length`, of which the sum is `result`: with two sums on the way, in any order. */
static double summed(double length, double result) {
    return unit * (length + 2.0 * (length + result) + result);
}

static world_error of_world(const world_scheme *s, const world_where *at) {
    (void)s;
    const double far_off = at->distance + at->length;
    return (world_error){.vertex = unit * far_off + summed(far_off, at->result),
                         .camera = turn * far_off + unit * at->distance};
}

/* The place as it seems once mesh and camera are off by so much: later steps are rounded there. */
static world_where seen(const world_where *at, double mesh, double camera) {
    const double off = mesh + camera;
    return (world_where){at->distance, at->length + off, at->result + off};
}

static world_error of_local(const world_scheme *s, const world_where *at) {
    (void)s;
    const double origin = at->distance + 2.0 * at->length;
    world_error e = {.mesh = unit * origin + summed(origin, 2.0 * at->length),
                     .camera = turn * (at->distance + at->length) + unit * at->distance};
    e.vertex = unit * at->length + summed(at->length, seen(at, e.mesh, e.camera).result);
    return e;
}

static world_error of_camera_float(const world_scheme *s, const world_where *at) {
    (void)s;
    return (world_error){.vertex = unit * (at->distance + 2.0 * at->length) + turned(at),
                         .camera = unit * at->distance + turn * at->length};
}

static world_error of_camera_double(const world_scheme *s, const world_where *at) {
    (void)s;
    return (world_error){.vertex = in_double * (at->distance + at->length) + unit * at->length + turned(at),
                         .camera = turn * at->length};
}

/* The error of multiples of the size, up to x: 2^24 of them are binary32 numbers. */
static double multiple(const world_scheme *s, double x) {
    return x > 0x1p24 * s->size ? unit * x : 0.0;
}

static world_error of_split(const world_scheme *s, const world_where *at) {
    const double far_off = at->distance + at->length;
    const double low = root3 * half_ulp_below(s->size);
    return (world_error){.vertex = (far_off < s->size ? unit * far_off : 2.0 * low) + multiple(s, far_off) +
                                   in_double * far_off + unit * 3.0 * at->length + turned(at),
                         .camera = (at->distance < s->size ? unit * at->distance : low) + multiple(s, at->distance) +
                                   turn * at->length};
}

static world_error of_tile(const world_scheme *s, const world_where *at) {
    const double half = 0.5 * s->size, away = 2.0 * at->length, origin = at->distance + away;
    const double off = root3 * unit * 0.5 * half; /* a tile is a power of two there */
    world_error e = {.mesh = (origin < half ? unit * origin : 3.0 * off) + multiple(s, origin) + 2.0 * unit * away,
                     .camera = (at->distance < half ? unit * at->distance : off) + multiple(s, at->distance) +
                               turn * at->length};
    const world_where there = seen(at, e.mesh, e.camera);
    e.vertex = unit * (at->length + there.length) + turned(&there);
    return e;
}

static world_error of_two_sum(const world_scheme *s, const world_where *at) {
    (void)s;
    const double away = 2.0 * at->length;
    world_error e = {.mesh = unit * away + low_part * (at->distance + away),
                     .camera = low_part * at->distance + turn * at->length};
    const world_where there = seen(at, e.mesh, e.camera);
    e.vertex = unit * (at->length + there.length) + turned(&there);
    return e;
}

static world_error of_cell(const world_scheme *s, const world_where *at) {
    const double most = WORLD_CELL_MOST * s->size;
    const double eye = fmin(at->distance, root3 * most), away = 2.0 * at->length, origin = at->distance + away;
    const double off = root3 * half_ulp(most), far_off = eye + at->length;
    world_error e = {.mesh = fmin(unit * origin, off) + unit * (eye + away),
                     .camera = fmin(unit * at->distance, off) + turn * far_off + unit * eye};
    const world_where there = seen(at, e.mesh, e.camera);
    e.vertex = unit * (there.length + eye + at->length) + summed(there.length + eye, there.result);
    return e;
}

/* clang-format off */
static const world_row rows[WORLD_ROWS] = {
    {"absolute", NULL,
     "vertices in the world through a view matrix; of a reversed infinite projection through one of both, too",
     "common", NULL, 0.0, false, false, false, arithmetic_world, of_world},
    {"local", NULL, "vertices about an origin, whose matrix and the view's are multiplied in binary32", "common",
     NULL, 0.0, false, false, true, arithmetic_local, of_local},
    {"camera-float", NULL, "vertices less the camera, both in binary32, then a view without translation",
     "deck.gl before 64-bit shaders; Filament, issue 913", NULL, 0.0, false, false, false, arithmetic_camera_float,
     of_camera_float},
    {"split", NULL, "each coordinate a multiple of the size and a rest, subtracted part by part",
     "Cesium, EncodedCartesian3.js and translateRelativeToEye.glsl", "the multiples", 65536.0, true, false, false,
     arithmetic_split, of_split},
    {"tile", NULL, "tile and offset of each mesh's origin, subtracted part by part",
     "Unreal Engine 5.0 manual, Large World Coordinates: 2097152 units of 1 cm", "the edge of a tile", 20971.52,
     false, true, true, arithmetic_tile, of_tile},
    {"cell", NULL, "cell and offset of each mesh's origin, about the camera's cell; there as absolute",
     "big_space, src/grid/cell.rs: edge 2000, threshold 100", "the edge of a cell", 2000.0, false, false, true,
     arithmetic_cell, of_cell},
    {"two-sum", NULL, "origins of meshes and camera as two binary32 numbers each, added without loss",
     "Godot with double precision, scene_forward_clustered.glsl, PR 66178", NULL, 0.0, false, false, true,
     arithmetic_two_sum, of_two_sum},
    {"camera-double", NULL, "vertices less the camera in double, then rounded", "common; Filament, issue 913", NULL,
     0.0, false, false, false, arithmetic_camera_double, of_camera_double},
};
/* clang-format on */

NAMED_TABLE(world, rows);

bool world_size_fits(const world_row *row, double size) {
    int exponent;
    return row->size != NULL && size >= 1e-3 && size <= 1e12 && (!row->power2 || frexp(size, &exponent) == 0.5);
}

bool world_parse(const char *text, world_scheme *out) {
    const size_t length = strcspn(text, ":");
    for (size_t i = 0; i < WORLD_ROWS; i++) {
        char *end;
        if (strlen(rows[i].name) != length || strncmp(rows[i].name, text, length) != 0)
            continue;
        const double size = text[length] == '\0' ? rows[i].standard : strtod(text + length + 1, &end);
        if (text[length] != '\0' && (*end != '\0' || !world_size_fits(&rows[i], size)))
            return false;
        *out = (world_scheme){&rows[i], size};
        return true;
    }
    return false;
}

void world_view(const world_scheme *s, const world_camera *camera, const world_place *place, float out[3]) {
    s->row->view(s, camera, place, out);
}

world_error world_bound(const world_scheme *s, const world_where *at) {
    world_error e = s->row->bound(s, at);
    e.vertex = e.vertex * outward + flushed;
    e.mesh *= outward;
    e.camera *= outward;
    return e;
}

double world_gap(const world_scheme *s, double distance, double z, double ray_ratio, bool shared_origin) {
    const double settled = 1.0 + 0x1p-30;
    double gap = 0.0;
    for (double before = -1.0; gap > before * settled && gap < 1e18;) {
        const double end = z + gap;
        const world_where near_one = {distance, ray_ratio * z, z}, far_one = {distance, ray_ratio * end, end};
        const world_error a = world_bound(s, &near_one), b = world_bound(s, &far_one);
        before = gap;
        gap = (world_own(&a, shared_origin) + world_own(&b, shared_origin)) / (1.0 - turn * ray_ratio) * outward;
    }
    return gap < 1e18 ? gap * outward : (double)INFINITY;
}
