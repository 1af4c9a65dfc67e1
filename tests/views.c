/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "views.h"

#include "texture/normal_errors.h"

texture_camera view_camera(const char *format, dp_mapping mapping, double znear, double zfar, bool ortho,
                           uint32_t width, uint32_t height, double extent) {
    const dp_setup setup = SETUP(format, .mapping = mapping, .znear = znear, .zfar = zfar, .ortho = ortho);
    texture_camera camera;
    camera_spec view = camera_spec_default();
    view.width = width;
    view.height = height;
    view.fov_y = view.half_height = extent;
    assert_null(camera_init(&camera, &setup, &view));
    return camera;
}

texture_camera view_placed(const char *line, uint32_t width, uint32_t height, double yaw, double pitch) {
    dp_setup setup[SETUPS_MAX];
    texture_camera camera;
    camera_spec spec = camera_spec_default();
    assert_int_equal(setups_of(line, DP_MODEL_EXACT, setup), 1);
    spec.width = width;
    spec.height = height;
    spec.fov_y = number_behind(line, "--fov", spec.fov_y);
    spec.half_height = number_behind(line, "--ortho", spec.half_height);
    spec.yaw = yaw;
    spec.pitch = pitch;
    numbers_behind(line, "--eye", spec.origin, 3);
    assert_null(camera_init(&camera, setup, &spec));
    return camera;
}

void view_slopes(const texture_camera *c, double column, double row, double *sx, double *sy) {
    *sx = (2 * ((column + 0.5) / c->width) - 1) * c->half[0];
    *sy = (2 * (1 - (row + 0.5) / c->height) - 1) * c->half[1];
}

void view_unit(double v[3]) {
    const double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int i = 0; i < 3; i++)
        v[i] /= length;
}

double view_plane(const texture_camera *c, const double n[3], double d, double column, double row) {
    double sx, sy;
    view_slopes(c, column, row, &sx, &sy);
    return c->ortho ? (d - n[0] * sx - n[1] * sy) / n[2] : d / (n[0] * sx + n[1] * sy + n[2]);
}

double view_tilted(rng *r, const texture_camera *c, double column, double row, double z, double tilt, double n[3]) {
    double sx, sy, ray[3] = {0, 0, -1};
    view_slopes(c, column, row, &sx, &sy);
    if (!c->ortho) {
        ray[0] = -sx;
        ray[1] = -sy;
    }
    view_unit(ray);
    double across[3] = {rng_uniform(r, -1, 1), rng_uniform(r, -1, 1), rng_uniform(r, -1, 1)};
    const double along = across[0] * ray[0] + across[1] * ray[1] + across[2] * ray[2];
    for (int i = 0; i < 3; i++)
        across[i] -= along * ray[i];
    view_unit(across);
    for (int i = 0; i < 3; i++)
        n[i] = cos(tilt) * ray[i] + sin(tilt) * across[i];
    const double scale = c->ortho ? 1 : z;
    return n[0] * sx * scale + n[1] * sy * scale + n[2] * z;
}

view_picture view_picture_of(const texture_camera *c) {
    view_picture p = {c->width, c->height, NULL, {NULL}};
    p.eye = test_calloc((size_t)c->width * c->height, sizeof *p.eye);
    for (int i = 0; i < 3; i++)
        p.normal[i] = test_calloc((size_t)c->width * c->height, sizeof *p.eye);
    return p;
}

void view_picture_free(view_picture *p) {
    test_free(p->eye);
    for (int i = 0; i < 3; i++)
        test_free(p->normal[i]);
}

static void give(void *context, uint32_t row, float *eye) {
    const view_picture *p = context;
    assert_true(row < p->height);
    memcpy(eye, p->eye + (size_t)row * p->width, p->width * sizeof *eye);
}

static void take(void *context, const normal_rows *in, const float *const normal[3]) {
    view_picture *p = context;
    for (int i = 0; i < 3; i++)
        memcpy(p->normal[i] + (size_t)in->row * p->width, normal[i], p->width * sizeof *normal[i]);
}

void view_run_rows(const normal_row *m, const texture_camera *c, view_picture *p, uint32_t first, uint32_t count) {
    assert_true(normal_run(m, c, first, count, give, take, p));
}

void view_run(const normal_row *m, const texture_camera *c, view_picture *p) {
    view_run_rows(m, c, p, 0, c->height);
}

void view_normal(const view_picture *p, uint32_t column, uint32_t row, double out[3]) {
    for (int i = 0; i < 3; i++)
        out[i] = (double)p->normal[i][(size_t)row * p->width + column];
}

float view_eye(const view_picture *p, int64_t column, int64_t row) {
    if (column < 0 || row < 0 || column >= p->width || row >= p->height)
        return (float)NAN;
    return p->eye[row * p->width + column];
}
