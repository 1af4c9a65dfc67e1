/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "shader/normal_corner.h"

#include <math.h>

#include "core/elementary.h"

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

/* What a place is off by in the shader: the eye depth as it is read, slopes and products in binary32, then binary16. */
static double place_off(const normal_row *method, vector place, double reading) {
    const double size = length(place), single = size * (reading + 4 * DP_UNIT);
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
        off[i] = place_off(method, place[i], reading);
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
    const double all = angle_of(truly * (1 + 0x1p-40), whole) + angle_of(found * (1 + 0x1p-40), whole) + kept;
    return all < M_PI ? all : M_PI; /* NaN, too */
}
