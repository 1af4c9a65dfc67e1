/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "shader/camera.h"

#include <math.h>
#include <stddef.h>

#include "core/elementary.h"

camera_spec camera_spec_default(void) {
    return (camera_spec){.fov_y = 60, .half_height = 5};
}

bool camera_look(camera_spec *spec, const double at[3]) {
    double ahead[3];
    for (int i = 0; i < 3; i++)
        ahead[i] = at[i] - spec->origin[i];
    const double across = dp_hypot(ahead[0], ahead[2]);
    spec->yaw = dp_atan2(ahead[0], ahead[2]) / DP_DEGREE;
    spec->pitch = dp_atan2(ahead[1], across) / DP_DEGREE;
    return across > 0 || ahead[1] != 0;
}

static bool within(double x, double lo, double hi) {
    return x >= lo && x <= hi; /* false for NaN */
}

static const char *wrong(const camera_spec *s, bool ortho) {
    if (s->width < 1 || s->height < 1 || s->width > IMAGE_SIDE_MAX || s->height > IMAGE_SIDE_MAX)
        return "width and height must be from 1 to 65536 pixels";
    if ((uint64_t)s->width * s->height > IMAGE_PIXELS_MAX)
        return "an image must have at most 268435456 pixels";
    if (s->matrix == NULL && !ortho && !within(s->fov_y, 0.01, 179))
        return "the vertical field of view must be from 0.01 to 179 degrees";
    if (s->matrix == NULL && ortho && !within(s->half_height, 1e-12, 1e12))
        return "half the height of an orthographic view must be from 1e-12 to 1e12";
    if (!within(s->yaw, -360, 360) || !within(s->pitch, -90, 90))
        return "yaw must be from -360 to 360 degrees, pitch from -90 to 90";
    for (int i = 0; i < 3; i++)
        if (!within(s->origin[i], -1e12, 1e12))
            return "the camera's coordinates must be from -1e12 to 1e12";
    return NULL;
}

/* ---- Planes of each pixel, in twice the digits ------------------------------------------------------------------- */

static dp_pair quotient(dp_pair a, double b) {
    const double hi = a.hi / b;
    return dp_quick_two_sum(hi, (fma(-hi, b, a.hi) + a.lo) / b);
}

static dp_pair product(dp_pair a, double b) {
    const dp_pair hi = dp_two_product(a.hi, b);
    return dp_quick_two_sum(hi.hi, hi.lo + a.lo * b);
}

/* With the slopes put in: a half (NDC - centre), NDC = (2i + 1 - width)/width. The viewport takes the window depths
 * from 0 to 1 into its depth range. */
static camera_oblique oblique_of(const dp_projection *p, const dp_setup *setup, uint32_t width, uint32_t height) {
    const double from = (double)(float)setup->spec.depth_range[0],
                 by = (double)(float)setup->spec.depth_range[1] - from;
    const dp_pair x = quotient((dp_pair){p->tilt[0], 0}, p->scale[0]),
                  y = quotient((dp_pair){p->tilt[1], 0}, p->scale[1]);
    const dp_pair moved = dp_pair_sum(product(x, -p->centre[0]), product(y, -p->centre[1]));
    const dp_pair base = dp_pair_sum((dp_pair){p->base[0], p->base[1]}, moved);
    return (camera_oblique){p->oblique, p->pull * by, product(quotient(x, width), by), product(quotient(y, height), by),
                            dp_pair_sum((dp_pair){from, 0}, product(base, by))};
}

/* ---- The camera -------------------------------------------------------------------------------------------------- */

const char *camera_init(texture_camera *camera, const dp_setup *setup, const camera_spec *spec) {
    const bool ortho = setup->spec.ortho != 0;
    const char *error = wrong(spec, ortho);
    if (error != NULL)
        return error;
    if (setup->spec.zfar > 1e18 && !isinf(setup->spec.zfar))
        return "far must be at most 1e18, or inf: shaders multiply places with each other, and binary32 ends at 3.4e38";
    const double half_height = ortho ? spec->half_height : dp_half_tangent(spec->fov_y);
    const double sy = dp_sin(spec->yaw * DP_DEGREE), cy = dp_cos(spec->yaw * DP_DEGREE);
    const double sp = dp_sin(spec->pitch * DP_DEGREE), cp = dp_cos(spec->pitch * DP_DEGREE);
    *camera = (texture_camera){
        .setup = *setup,
        .width = spec->width,
        .height = spec->height,
        .ortho = ortho,
        .half = {half_height * spec->width / spec->height, half_height},
        .axis = {{cy, 0, -sy}, {-sp * sy, cp, -sp * cy}, {cp * sy, sp, cp * cy}},
        .origin = {spec->origin[0], spec->origin[1], spec->origin[2]},
        .radial = spec->radial,
    };
    if (spec->matrix != NULL) {
        const dp_projection *p = spec->matrix;
        for (int k = 0; k < 2; k++) {
            camera->half[k] = p->half[k];
            camera->centre[k] = p->centre[k];
        }
        camera->oblique = oblique_of(p, setup, spec->width, spec->height);
    }
    return NULL;
}
