/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene/eye.h"

#include <math.h>

#include "core/elementary.h"

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double out[3]) {
    for (int k = 0; k < 3; k++)
        out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

/* False: there is no length to speak of. */
static bool make_unit(double v[3]) {
    const double length = dp_hypot(dp_hypot(v[0], v[1]), v[2]);
    for (int k = 0; k < 3; k++)
        v[k] /= length;
    return isfinite(length) && length > 0.0;
}

/* The axis that a direction is farthest from. */
static void farthest_axis(const double from[3], double out[3]) {
    int least = 0;
    for (int k = 0; k < 3; k++) {
        out[k] = 0.0;
        if (fabs(from[k]) < fabs(from[least]))
            least = k;
    }
    out[least] = 1.0;
}

/* `ahead` has length 1. */
static void stand(const double place[3], const double ahead[3], const double up[3], scene_eye *out) {
    double upward[3] = {up[0], up[1], up[2]};
    scene_eye eye = {.line = 0};
    make_unit(upward);
    cross(ahead, upward, eye.right);
    if (!(dp_hypot(dp_hypot(eye.right[0], eye.right[1]), eye.right[2]) > 1e-6)) {
        farthest_axis(ahead, upward);
        cross(ahead, upward, eye.right);
    }
    make_unit(eye.right);
    cross(eye.right, ahead, eye.up);
    make_unit(eye.up);
    for (int k = 0; k < 3; k++) {
        eye.place[k] = place[k];
        eye.ahead[k] = ahead[k];
    }
    *out = eye;
}

bool scene_eye_look(const double from[3], const double at[3], const double up[3], scene_eye *out) {
    double ahead[3];
    for (int k = 0; k < 3; k++)
        ahead[k] = at[k] - from[k];
    if (!make_unit(ahead))
        return false;
    stand(from, ahead, up, out);
    return true;
}

bool scene_eye_of(const model_camera *camera, scene_eye *out) {
    double ahead[3] = {camera->ahead[0], camera->ahead[1], camera->ahead[2]};
    if (!make_unit(ahead))
        return false;
    stand(camera->eye, ahead, camera->up, out);
    return true;
}

void scene_eye_sees(const scene_eye *eye, const double place[3], double seen[3]) {
    double from[3];
    for (int k = 0; k < 3; k++)
        from[k] = place[k] - eye->place[k];
    seen[0] = dot(from, eye->right);
    seen[1] = dot(from, eye->up);
    seen[2] = dot(from, eye->ahead);
}
