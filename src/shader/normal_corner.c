/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "shader/normal_corner.h"

#include <math.h>

#include "core/elementary.h"
#include "core/outward.h"

typedef struct vector {
    double x, y, z;
} vector;

static vector difference(vector a, vector b) {
    return (vector){a.x - b.x, a.y - b.y, a.z - b.z};
}

static double length(vector a) {
    return sqrt(a.x * a.x + a.y * a.y + a.z * a.z);
}

static double area(vector a, vector b) {
    return length((vector){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x});
}

static const double HALF = 0x1p-11, HALF_LEAST = 0x1p-25, HALF_MOST = 65504;

/* From a number to the nearest one of binary16; beside a tie both are as far. */
static double to_half(double x) {
    const double step = ldexp(1, (x < 0x1p-14 ? -14 : ilogb(x)) - 10);
    return fabs(x - rint(x / step) * step);
}

/* The error of a neighbour's place whose share of the picture and depth were in binary16 before. */
static double uv_off(const texture_camera *camera, const normal_tap *tap, double ray, double reading) {
    const double u = (tap->column + 0.5) / camera->width, v = (camera->height - tap->row - 0.5) / camera->height;
    const double z = tap->stored, depth = to_half(z) + 2 * reading * z;
    const double across =
        dp_hypot(2 * camera->half[0] * (to_half(u) + 4 * DP_UNIT), 2 * camera->half[1] * (to_half(v) + 4 * DP_UNIT));
    return ray * depth + across * (camera->ortho ? 1 : z + depth);
}

/* The error of a place in the shader: `before` that of the eye depth as read, slopes and products in binary32,
 * then binary16. */
static double place_off(const normal_row *method, vector place, double reading, double before) {
    const double size = length(place) + before, single = before + size * (reading + 4 * DP_UNIT);
    if (!method->half)
        return single;
    return size + single < HALF_MOST ? single + (size + single) * HALF + sqrt(3) * HALF_LEAST : (double)INFINITY;
}

static double angle_of(double off, double whole) {
    return off < whole ? dp_asin(off / whole) : M_PI;
}

double normal_corner_bound(const texture_camera *camera, const normal_row *method, const normal_tap taps[3],
                           double reading) {
    vector ray[3], place[3];
    double off[3];
    for (int i = 0; i < 3; i++) {
        double view[3];
        camera_view(camera, taps[i].column, taps[i].row, taps[i].stored, view);
        place[i] = (vector){view[0], view[1], view[2]};
        camera_view(camera, taps[i].column, taps[i].row, 1, view);
        ray[i] = camera->ortho ? (vector){0, 0, 1} : (vector){view[0], view[1], 1};
        off[i] = place_off(method, place[i], reading,
                           i > 0 && method->half_uv ? uv_off(camera, &taps[i], length(ray[i]), reading) : 0);
    }
    const vector a = difference(place[1], place[0]), b = difference(place[2], place[0]), c = difference(a, b);
    const double e0 = taps[0].reach, e1 = taps[1].reach, e2 = taps[2].reach, whole = area(a, b);
    /* the true triangle from the stored one: along the rays */
    const double truly = area(a, ray[2]) * e2 + area(ray[1], b) * e1 + area(ray[0], c) * e0 +
                         area(ray[1], ray[2]) * e1 * e2 + area(ray[0], ray[1]) * e0 * e1 +
                         area(ray[0], ray[2]) * e0 * e2;
    /* the one found: differences, and six roundings of products and sums */
    const double size_a = length(a), size_b = length(b);
    const double off_a = off[0] + off[1] + DP_UNIT * size_a, off_b = off[0] + off[2] + DP_UNIT * size_b;
    const double found =
        size_a * off_b + size_b * off_a + off_a * off_b + 6 * DP_UNIT * (size_a + off_a) * (size_b + off_b);
    /* the unit vector's own: half a step in each component, and before that four roundings */
    const double kept = (method->half ? sqrt(3) * (HALF / 2) * (1 + 0x1p-8) : 0) + 8 * DP_UNIT;
    const double all = angle_of(truly * DP_OUTWARD, whole) + angle_of(found * DP_OUTWARD, whole) + kept;
    return all < M_PI ? all : M_PI; /* NaN, too */
}
