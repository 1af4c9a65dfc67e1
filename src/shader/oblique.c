/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "shader/oblique.h"

#include <math.h>

#include "core/engine.h"

/* The relative error of an eye depth in double: cells may be finer than that. */
static const double LOST = DP_ROUNDINGS_6, LOST_ALONG = DP_ROUNDINGS_30;

/* The constant of a pixel. */
static dp_pair constant_of(const texture_camera *camera, double column, double row) {
    const camera_oblique *o = &camera->oblique;
    const double i = 2 * column + 1 - camera->width, j = camera->height - 1 - 2 * row;
    const dp_pair x = dp_two_product(o->column.hi, i), y = dp_two_product(o->row.hi, j);
    const dp_pair first = dp_two_sum(x.hi, y.hi), all = dp_two_sum(first.hi, o->base.hi);
    const double rest = ((x.lo + o->column.lo * i) + (y.lo + o->row.lo * j)) + (o->base.lo + first.lo);
    return dp_two_sum(all.hi, all.lo + rest);
}

static double eye_of(const camera_oblique *o, dp_pair k, dp_point point) {
    const dp_pair scaled = dp_two_product(k.hi, point.den);
    const double apart = (point.num - scaled.hi) - (scaled.lo + k.lo * point.den), z = o->pull * point.den / apart;
    return z > 0 ? z : (double)INFINITY;
}

/* The distance from z to z' is z z' |d' - d|/|e|: nothing cancels. */
static double span_of(const camera_oblique *o, dp_point a, dp_point b, double z_a, double z_b) {
    const double step = a.den == b.den ? (b.num - a.num) / a.den : b.num / b.den - a.num / a.den;
    return step == 0 ? 0 : z_a * z_b * fabs(step / o->pull);
}

static grain_range oblique_range(const texture_camera *camera, const grain *g, uint32_t column, uint32_t row,
                                 uint32_t code, double *stored) {
    const camera_oblique *o = &camera->oblique;
    const dp_pair k = constant_of(camera, column, row);
    const grain_points p = grain_points_of(&camera->setup, g, code);
    const double own = eye_of(o, k, p.own), near = eye_of(o, k, p.to_near), far = eye_of(o, k, p.to_far);
    *stored = own;
    const double reach = fmax(span_of(o, p.to_near, p.own, near, own), span_of(o, p.own, p.to_far, own, far));
    return (grain_range){near, far, reach * GRAIN_OUTWARD + own * LOST};
}

static grain_range radial_range(const texture_camera *camera, const grain *g, uint32_t column, uint32_t row,
                                uint32_t code, double *stored) {
    const double along = camera_radial(camera, column, row);
    const double lost = LOST_ALONG * (1 + camera->half[0] + camera->half[1]);
    const grain_range r = grain_range_of(&camera->setup, g, code);
    *stored = dp_stored(&camera->setup, code) / along;
    return (grain_range){r.lo / along, r.hi / along, r.reach / along * GRAIN_OUTWARD + *stored * lost};
}

static grain_range range_of(const texture_camera *camera, const grain *g, uint32_t column, uint32_t row, uint32_t code,
                            double *stored) {
    return (camera->radial ? radial_range : oblique_range)(camera, g, column, row, code, stored);
}

grain_range pixel_range_of(const texture_camera *camera, const grain *g, uint32_t column, uint32_t row, uint32_t code) {
    double stored;
    return camera_is_shared(camera) ? grain_range_of(&camera->setup, g, code)
                                    : range_of(camera, g, column, row, code, &stored);
}

double pixel_stored(const texture_camera *camera, uint32_t column, uint32_t row, uint32_t code) {
    if (!camera->oblique.on)
        return dp_stored(&camera->setup, code) / (camera->radial ? camera_radial(camera, column, row) : 1);
    return eye_of(&camera->oblique, constant_of(camera, column, row),
                  dp_point_of_code(&camera->setup.spec.format, code));
}

void pixel_ranges_of(const texture_camera *camera, const grain *g, uint32_t column, uint32_t row, const uint32_t *codes,
                     size_t count, const grain_rows *out) {
    const uint32_t most = camera->setup.spec.format.code_max;
    if (camera_is_shared(camera)) {
        grain_ranges_of(&camera->setup, g, codes, count, out);
        return;
    }
    for (size_t i = 0; i < count; i++) {
        const grain_range r =
            range_of(camera, g, column + (uint32_t)i, row, codes[i] <= most ? codes[i] : 0, &out->stored[i]);
        out->lo[i] = r.lo;
        out->hi[i] = r.hi;
        out->reach[i] = r.reach;
    }
}

void pixel_eyes(const texture_camera *camera, uint32_t row, const uint32_t *codes, float *eyes) {
    for (uint32_t x = 0; x < camera->width; x++)
        if (codes[x] <= camera->setup.spec.format.code_max) {
            const double z = pixel_stored(camera, x, row, codes[x]);
            eyes[x] = isinf(z) ? NAN : (float)z;
        }
}
