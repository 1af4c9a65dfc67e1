/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "texture/frame_rows.h"

#include <math.h>
#include <string.h>

#include "texture/clones.h"

static const double TO_DEGREES = 180 / M_PI;

static const texture_camera *camera_of(const frame_row *in) {
    return in->frame->camera;
}

static const float *eyes_of(const frame_row *in) {
    return in->eyes[NORMAL_REACH];
}

/* Length along the pixel's ray of one scene unit of eye depth. */
static double stretch(const frame_row *in, uint32_t x) {
    return camera_radial(camera_of(in), x, in->row);
}

TEXTURE_CLONES static void interleave_planes(const float *restrict x, const float *restrict y, const float *restrict z,
                                             float *restrict out, size_t count) {
    for (size_t i = 0; i < count; i++) {
        out[3 * i] = x[i];
        out[3 * i + 1] = y[i];
        out[3 * i + 2] = z[i];
    }
}

static void interleave(const frame_row *in) {
    interleave_planes(in->planes[0], in->planes[1], in->planes[2], in->out, camera_of(in)->width);
}

/* NaN where there is no eye depth. */
TEXTURE_CLONES static void hide(const float *restrict eyes, float *restrict plane, size_t count) {
    for (size_t i = 0; i < count; i++)
        plane[i] = eyes[i] == eyes[i] ? plane[i] : (float)NAN;
}

static void make_eye(const frame_row *in) {
    const uint32_t width = camera_of(in)->width;
    memcpy(in->out, eyes_of(in), width * sizeof *in->out);
    for (uint32_t x = 0; x < width && in->product->radial; x++)
        in->out[x] = (float)((double)in->out[x] * stretch(in, x));
}

/* What the product has lost in binary32, and how far what is stored is off: of a scene the latter alone, exactly. */
static void make_eye_error(const frame_row *in) {
    const dp_setup *setup = &camera_of(in)->setup;
    frame_ranges last = frame_no_range();
    for (uint32_t x = 0; x < camera_of(in)->width; x++) {
        const double along = in->product->radial ? stretch(in, x) : 1;
        double error = NAN;
        if (in->frame->scene != NULL) {
            const double z = frame_truth(in, x).z;
            error = isnan(z) ? (double)NAN : fabs(dp_error(setup, in->codes[x], z)) * along;
        } else if (!isnan(eyes_of(in)[x])) {
            const float eye = eyes_of(in)[x], product = in->product->radial ? (float)((double)eye * along) : eye;
            error = fabs((double)product - dp_stored(setup, in->codes[x]) * along) +
                    frame_range_of(in, &last, x)->reach * along;
        }
        in->out[x] = frame_upwards(error);
    }
}

/* From the camera, along the world's axes. */
static void exact_place(const frame_row *in, uint32_t x, double z, double relative[3]) {
    double view[3];
    camera_view(camera_of(in), x, in->row, z, view);
    camera_turn(camera_of(in), view, relative);
}

static void places(const frame_row *in) {
    const texture_camera *c = camera_of(in);
    if (in->product->position != NULL) {
        in->product->position->run(in->position, in->row, 0, in->depth, c->width, in->planes[0], in->planes[1],
                                   in->planes[2]);
        for (int k = 0; k < 3; k++)
            hide(eyes_of(in), in->planes[k], c->width);
        return;
    }
    for (uint32_t x = 0; x < c->width; x++) {
        double relative[3] = {NAN, NAN, NAN};
        if (!isnan(eyes_of(in)[x]))
            exact_place(in, x, dp_stored(&c->setup, in->codes[x]), relative);
        for (int k = 0; k < 3; k++)
            in->planes[k][x] = (float)(c->origin[k] + relative[k]);
    }
}

static void make_position(const frame_row *in) {
    places(in);
    interleave(in);
}

static void make_position_error(const frame_row *in) {
    const bool known = in->frame->scene != NULL;
    frame_ranges last = frame_no_range();
    places(in);
    for (uint32_t x = 0; x < camera_of(in)->width; x++) {
        const float world[3] = {in->planes[0][x], in->planes[1][x], in->planes[2][x]};
        double z = NAN, relative[3];
        if (!isnan(eyes_of(in)[x]))
            z = known ? frame_truth(in, x).z : dp_stored(&camera_of(in)->setup, in->codes[x]);
        if (isnan(z)) { /* a hole, not an error without bound */
            in->out[x] = NAN;
            continue;
        }
        exact_place(in, x, z, relative);
        in->out[x] = frame_upwards(position_off(camera_of(in), relative, world) +
                                   (known ? 0 : frame_range_of(in, &last, x)->reach * stretch(in, x)));
    }
}

static void normals(const frame_row *in) {
    normal_rows rows = {.camera = camera_of(in), .row = in->row, .count = camera_of(in)->width, .slope_x = in->slope_x};
    memcpy(rows.rows, in->eyes, sizeof rows.rows);
    in->product->normal->run(&rows, in->planes[0], in->planes[1], in->planes[2]);
}

static void make_normal(const frame_row *in) {
    normals(in);
    interleave(in);
}

/* The bound for a plane through the pixel's place with the normal that was found. */
static double plane_bound(const frame_row *in, uint32_t x, const double found[3]) {
    const texture_camera *c = camera_of(in);
    const normal_plane plane = normal_plane_at(c, x, in->row, dp_stored(&c->setup, in->codes[x]), found);
    const double error = in->frame->scene != NULL
                             ? normal_plane_error(c, x, in->row, &plane, DP_BATCH_EYE_ERROR)
                             : normal_plane_error_of(c, in->frame->grain, x, in->row, &plane, DP_BATCH_EYE_ERROR);
    return isinf(error) ? (double)NAN : normal_plane_bound(c, x, in->row, &plane, error);
}

static void make_normal_error(const frame_row *in) {
    normals(in);
    for (uint32_t x = 0; x < camera_of(in)->width; x++) {
        const double found[3] = {in->planes[0][x], in->planes[1][x], in->planes[2][x]};
        double angle = NAN;
        if (!isnan(found[0]) && in->frame->scene != NULL) {
            const scene_hit hit = frame_truth(in, x);
            angle = isnan(hit.z) ? (double)NAN : normal_angle(found, hit.normal);
        } else if (!isnan(found[0])) {
            angle = plane_bound(in, x, found);
        }
        in->out[x] = frame_upwards(angle * TO_DEGREES);
    }
}

frame_make *const frame_makers[FRAME_KINDS][2] = {
    [FRAME_EYE] = {make_eye, make_eye_error},
    [FRAME_POSITION] = {make_position, make_position_error},
    [FRAME_NORMAL] = {make_normal, make_normal_error},
    [FRAME_EFFECT] = {frame_effect, frame_effect_error},
};
