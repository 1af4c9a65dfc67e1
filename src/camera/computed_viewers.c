/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The planes of viewers, which fit them to what is seen, of simulators and of modellers. */
#include <math.h>

#include "camera/computed.h"
#include "core/elementary.h"

#define NEEDED (double)NAN
#define LARGE  1e9 /* of a size, in scene units */

/* ---- From a sphere around the scene ------------------------------------------------------------------------------ */

#define RADIUS                                                                                                         \
    { "radius", "scene units", 1e-6, LARGE, NEEDED, 5.0 }

/* From the corners of the bounds, at the worst the sphere through them, widened; near never below a share of far. */
static void compute_vtk(const double *given, preset_camera *out) {
    enum { SPHERE, DISTANCE, TOLERANCE, EXPANSION, FOV };
    double near = (given[DISTANCE] - 1.0) * given[SPHERE], far = (given[DISTANCE] + 1.0) * given[SPHERE];
    const double missing = 0.2 * dp_half_tangent(given[FOV]) * far - (far - near);
    far += 0.5 * fmax(missing, 0.0);
    near -= 0.5 * fmax(missing, 0.0);
    near = fmax(near, 0.0);
    near = 0.99 * near - (far - near) * given[EXPANSION];
    far = 1.01 * far + (far - near) * given[EXPANSION]; /* of the near that was moved already */
    out->znear = fmax(near < far ? near : 0.01 * far, given[TOLERANCE] * far);
    out->zfar = far;
    out->fov = given[FOV];
    out->focus = given[DISTANCE] * given[SPHERE];
}

/* Where the sphere fills an angle of 30 degrees. */
#define VTK(tolerance)                                                                                                 \
    {                                                                                                                  \
        {RADIUS,                                                                                                       \
         {"distance", "radii", 0.0, 1e6, 3.8637033051562732, 4.0},                                                     \
         {"tolerance", "", 1e-9, 0.5, tolerance, 1e-4},                                                                \
         {"expansion", "", 0.0, 0.99, 0.5, 0.1},                                                                       \
         {"fov", "degrees", 0.1, 170.0, 30.0, 40.0}},                                                                  \
            compute_vtk                                                                                                \
    }

const preset_function computed_vtk = VTK(0.001), computed_vtkjs = VTK(0.01);

static void compute_model_viewer(const double *given, preset_camera *out) {
    const double orbit = given[0] / dp_sin(0.5 * given[2] * DP_DEGREE) * given[1] / 100.0;
    out->zfar = 2.0 * fmax(given[0], orbit);
    out->znear = out->zfar / 1000.0;
    out->fov = given[2];
    out->focus = orbit;
}

const preset_function computed_model_viewer = {
    {RADIUS, {"orbit", "percent", 1.0, 1e4, 105.0, 105.0}, {"fov", "degrees", 1.0, 170.0, 30.0, 40.0}},
    compute_model_viewer};

static void compute_x3dom(const double *given, preset_camera *out) {
    const double radius = given[0], distance = given[1] * given[0];
    out->zfar = 1.2 * (distance + radius);
    out->znear = fmax(0.8 * fmax(distance - radius, 0.0), fmax(1e-6, out->zfar / 1e4));
    out->focus = distance;
}

const preset_function computed_x3dom = {{RADIUS, {"distance", "radii", 0.0, 1e6, NEEDED, 3.0}}, compute_x3dom};

/* ---- From a box around it ---------------------------------------------------------------------------------------- */

#define SIZE(name)                                                                                                     \
    { name, "scene units", 1e-6, LARGE, NEEDED, 10.0 }

static void compute_gltf_viewer(const double *given, preset_camera *out) {
    out->znear = given[0] / 100.0;
    out->zfar = given[0] * 100.0;
    out->focus = sqrt(0.54) * given[0]; /* 1/2, 1/5, 1/2 from the middle */
}

const preset_function computed_gltf_viewer = {{SIZE("diagonal")}, compute_gltf_viewer};

static void compute_babylon(const double *given, preset_camera *out) {
    out->focus = 1.5 * given[0];
    out->znear = out->focus * 0.01;
    out->zfar = out->focus * 1000.0;
}

const preset_function computed_babylon = {{SIZE("diagonal")}, compute_babylon};

static void compute_open3d(const double *given, preset_camera *out) {
    const double distance = given[1] * given[0] / dp_half_tangent(given[2]);
    out->znear = fmax(0.01 * given[0], distance - 3.0 * given[0]);
    out->zfar = distance + 3.0 * given[0];
    out->fov = given[2];
    out->focus = distance;
}

const preset_function computed_open3d = {
    {SIZE("extent"), {"zoom", "", 0.02, 2.0, 0.7, 0.5}, {"fov", "degrees", 5.0, 90.0, 60.0, 45.0}}, compute_open3d};

static void compute_pyrender(const double *given, preset_camera *out) {
    out->znear = fmin(given[0] / 10.0, 0.05);
    out->zfar = fmax(given[0] * 10.0, 100.0);
}

const preset_function computed_pyrender = {{SIZE("scale")}, compute_pyrender};

/* ---- From numbers of their own ----------------------------------------------------------------------------------- */

static void compute_mujoco(const double *given, preset_camera *out) {
    out->znear = given[1] * given[0];
    out->zfar = given[2] * given[0];
}

const preset_function computed_mujoco = {{{"extent", "m", 1e-6, LARGE, NEEDED, 2.0},
                                          {"znear", "extents", 1e-6, 1e3, 0.01, 0.02},
                                          {"zfar", "extents", 1e-3, 1e6, 50.0, 20.0}},
                                         compute_mujoco};

static void compute_cesium(const double *given, preset_camera *out) {
    enum { NEAREST, FARTHEST, RATIO, FRUSTUM };
    out->znear = fmax(given[NEAREST], dp_pow(given[RATIO], given[FRUSTUM]) * given[NEAREST]);
    out->zfar = fmin(1.01 * given[FARTHEST], given[RATIO] * out->znear);
}

const preset_function computed_cesium = {{{"near", "m", 0.01, 1e8, 1.0, 1.0},
                                          {"far", "m", 1.0, 1e10, NEEDED, 1e7},
                                          {"ratio", "", 2.0, 1e9, 1000.0, 100.0},
                                          {"frustum", "", 0.0, 30.0, 0.0, 1.0}},
                                         compute_cesium};

static void compute_blender(const double *given, preset_camera *out) {
    out->znear = given[0];
    out->zfar = given[1];
    out->fov = 2.0 * dp_atan(0.5 * given[3] / given[2]) / DP_DEGREE;
}

#define BLENDER(near, sensor)                                                                                          \
    {                                                                                                                  \
        {{"near", "m", 1e-6, 1e6, near, 0.05},                                                                         \
         {"far", "m", 1e-5, 1e9, 1000.0, 100.0},                                                                       \
         {"lens", "mm", 1.0, 5000.0, 50.0, 35.0},                                                                      \
         {"sensor", "mm", 1.0, 200.0, sensor, 36.0}},                                                                  \
            compute_blender                                                                                            \
    }

const preset_function computed_blender = BLENDER(0.1, 36.0), computed_blender_viewport = BLENDER(0.01, 72.0);
