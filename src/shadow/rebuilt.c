/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A receiver whose position a shader rebuilds from the camera's depth texture; depthprec(7), "Shadow maps", derives it.
 */
#include <math.h>

#include "core/elementary.h"
#include "core/outward.h"
#include "shader/decode.h"
#include "shadow/shadow.h"

static const double eps = 0x1p-24;
static const double outward = 1.0 + DP_ROUNDINGS32_14;

/* The error of the window depth at z before the format rounds it: matrix, product, sum, the eye depth, quotient,
 * viewport; and the plane of a triangle, beside what moves it in the picture. */
static double window_off(const dp_setup *camera, double z) {
    const dp_triangles *t = &camera->spec.triangles;
    const bool half = dp_mapping_get(camera->spec.mapping)->ndc_signed != 0;
    const double scale = half ? 0.5 : 1.0;
    const double a = fabs((double)camera->matrix[0]), b = fabs((double)camera->matrix[1]);
    const double nearest = fmax(z / t->depth, camera->spec.znear);
    const double most = camera->reversed ? fmin(dp_window(camera, nearest), 1.0) : 1.0;
    const double ndc = half ? 1.0 : most;
    return eps * (scale * (2.0 * a + 3.0 * b / z + 2.0 * ndc) + (half ? 2.0 : 1.0) * most + t->plane.value * most);
}

double shadow_rebuilt(const dp_setup *camera, double lo, double hi, double world) {
    const dp_triangles *t = &camera->spec.triangles;
    const double hy = dp_half_tangent(t->fov_y), hx = hy * t->width / t->height;
    const double corner = sqrt(1.0 + hx * hx + hy * hy), q = sqrt(3.0) * world;
    const double per = dp_mapping_get(camera->spec.mapping)->ndc_signed != 0 ? 0.5 : 1.0;
    const double y = window_off(camera, hi) * hi / (per * fabs((double)camera->matrix[1]));
    dp_worst cell;
    if (!(y < 0.5) || dp_worst_over(camera, fmax(lo * (1.0 - y), camera->spec.znear),
                                    fmin(hi / (1.0 - y), camera->spec.zfar), &cell) != DP_OK)
        return (double)INFINITY;
    const double end = hi / (1.0 - y) + cell.error;
    const double read =
        decode_bound(decode_usual(camera), camera, (double)(float)dp_window(camera, fmin(end, camera->spec.zfar)));
    const double along = hi * y / (1.0 - y) + cell.error + end * read;
    /* Pixels by which vertices and planes are moved, on each axis. */
    const double box = t->plane.box * 0.5 * (1.0 + dp_hypot(t->slim, 1.0)) + t->plane.range;
    const double far_off = fmax(t->width, t->height) + t->pixels;
    const double moved =
        t->depth * (t->subpixel > 0 ? ldexp(1.0, -t->subpixel - 1) : 0.0) +
        eps * (t->plane.origin * far_off + box * t->pixels + t->depth * (2.0 * far_off + 4.0 * t->pixels));
    const double across = end * moved * 2.0 * dp_hypot(hx / t->width, hy / t->height);
    const double rays = eps * end * (5.0 * hy + 8.0 * hx + 6.0 * corner);
    return (corner * along + across + rays + eps * (q + 4.0 * sqrt(3.0) * (2.0 * q + corner * end))) * outward;
}
