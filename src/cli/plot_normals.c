/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/plot_normals.h"

#include <math.h>

#include "texture/normal_measure.h"

/* The middle of an image of 1080 lines with a field of view of 60 degrees (orthographic: 10 units high). */
enum { SIDE = 48, LINES = 1080, RADIUS = 16, PLANE = 0, SPHERE };

static const double PI = 3.14159265358979323846;
static const double READING = 0x1p-24; /* one rounding to binary32 */

static const char *const surfaces[] = {"plane at 60\u00b0", "outline of a sphere"};
static const char *const methods[] = {"low", "medium", "high", "projective"};

const char *plot_normals_view(bool ortho) {
    return ortho ? "1080 lines, 10 units high; plane: 99 % of the pixels, outline: mean"
                 : "1080 lines, field of view 60\u00b0; plane: 99 % of the pixels, outline: mean";
}

static bool middle(const dp_setup *setup, texture_camera *camera) {
    camera_spec spec = camera_spec_default();
    const double share = (double)SIDE / LINES;
    spec.width = spec.height = SIDE;
    spec.fov_y = 2 * atan(tan(spec.fov_y / 2 * PI / 180) * share) * 180 / PI;
    spec.half_height *= share;
    return camera_init(camera, setup, &spec) == NULL;
}

/* The largest over the image; it changes slowly, so some pixels stand for all. */
static double bound_of(const texture_camera *camera, const double *parameters) {
    enum { APART = 8 };
    const scene_row *scene = scene_find("plane");
    scene_hit hit;
    double worst = 0;
    scene->hit(camera, parameters, SIDE / 2, SIDE / 2, &hit);
    if (hit.surface == 0)
        return NAN;
    const normal_plane plane = normal_plane_at(camera, SIDE / 2, SIDE / 2, hit.z, hit.normal);
    for (uint32_t i = 0; i < SIDE; i += APART)
        for (uint32_t j = 0; j < SIDE; j += APART) {
            const double error = normal_plane_error(camera, i, j, &plane, READING);
            if (isfinite(error))
                worst = fmax(worst, normal_plane_bound(camera, i, j, &plane, error));
        }
    return worst * 180 / PI;
}

/* A plane slanted askew: cos 33 cos 53.4 = 1/2. A sphere as large in the image at every depth, and a wall behind it as
 * far as it is large. */
static double measure(const dp_setup *setup, size_t surface, size_t method, double z) {
    texture_camera camera;
    normal_measured m;
    if (!middle(setup, &camera))
        return NAN;
    const double radius = RADIUS * 2 * camera.half[1] / SIDE * (camera.ortho ? 1 : z);
    const double plane[] = {z, 33, 53.4, 0}, sphere[] = {z, radius, z + 2 * radius, 0};
    if (method == sizeof methods / sizeof methods[0])
        return bound_of(&camera, plane);
    if (!normal_measure(normal_find(methods[method]), &camera, scene_find(surface == PLANE ? "plane" : "sphere"),
                        surface == PLANE ? plane : sphere, 0, SIDE, &m))
        return NAN;
    const bool whole = z - radius >= setup->spec.znear && m.sky == 0; /* neither sphere nor wall leaves the view */
    return (surface == PLANE ? m.inside.p99 : whole ? m.edges.mean : (double)NAN) * 180 / PI;
}

const figure_normals plot_normals = {.surface_count = sizeof surfaces / sizeof surfaces[0],
                                     .method_count = sizeof methods / sizeof methods[0],
                                     .surfaces = surfaces,
                                     .methods = methods,
                                     .bound = "bound of projective",
                                     .error = measure};
