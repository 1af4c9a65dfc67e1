/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "texture/frame_rows.h"

#include <math.h>
#include <string.h>

#include "texture/clones.h"

static const double TO_DEGREES = 180 / 3.14159265358979323846;

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

/* What the pixel of a scene truly sees; NaN where it is sky, or counts as such. */
static scene_hit truth(const frame_row *in, uint32_t x) {
    scene_hit hit;
    in->frame->scene->hit(camera_of(in), in->frame->parameters, x, in->row, &hit);
    if (isinf(hit.z) || isnan(eyes_of(in)[x]))
        hit.z = NAN;
    return hit;
}

/* How far the depth that was stored as a code can be from what the code gives back. A cell narrower than the spacing of
   doubles is all that is known of it. */
static double reach(const dp_setup *setup, uint32_t code) {
    const dp_cell cell = dp_cell_of(setup, code);
    return fmin(cell.width, fmax(dp_error(setup, code, cell.lo), -dp_error(setup, code, cell.hi)));
}

/* Neighbours often share a code. */
typedef struct reaches {
    uint32_t code;
    double value;
} reaches;

static double reach_of(const frame_row *in, reaches *last, uint32_t x) {
    const uint32_t code = in->codes[x];
    if (code != last->code)
        *last = (reaches){code, reach(&camera_of(in)->setup, code)};
    return last->value;
}

static reaches nothing_yet(void) {
    return (reaches){UINT32_MAX, NAN};
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

static void make_eye_error(const frame_row *in) {
    reaches last = nothing_yet();
    for (uint32_t x = 0; x < camera_of(in)->width; x++) {
        const double z = in->frame->scene != NULL ? truth(in, x).z : (double)eyes_of(in)[x];
        double error = NAN;
        if (!isnan(z))
            error = in->frame->scene != NULL ? fabs(dp_error(&camera_of(in)->setup, in->codes[x], z))
                                             : reach_of(in, &last, x);
        in->out[x] = (float)(in->product->radial ? error * stretch(in, x) : error);
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
    reaches last = nothing_yet();
    places(in);
    for (uint32_t x = 0; x < camera_of(in)->width; x++) {
        const bool known = in->frame->scene != NULL;
        const double z = isnan(eyes_of(in)[x]) ? (double)NAN
                         : known               ? truth(in, x).z
                                               : dp_stored(&camera_of(in)->setup, in->codes[x]);
        const float world[3] = {in->planes[0][x], in->planes[1][x], in->planes[2][x]};
        double relative[3];
        exact_place(in, x, z, relative);
        in->out[x] = (float)(position_off(camera_of(in), relative, world) +
                             (known || isnan(z) ? 0 : reach_of(in, &last, x) * stretch(in, x)));
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
    const double error = normal_plane_error(c, x, in->row, &plane, DP_BATCH_EYE_ERROR);
    return isinf(error) ? (double)NAN : normal_plane_bound(c, x, in->row, &plane, error);
}

static void make_normal_error(const frame_row *in) {
    normals(in);
    for (uint32_t x = 0; x < camera_of(in)->width; x++) {
        const double found[3] = {in->planes[0][x], in->planes[1][x], in->planes[2][x]};
        double angle = NAN;
        if (!isnan(found[0]) && in->frame->scene != NULL) {
            const scene_hit hit = truth(in, x);
            angle = isnan(hit.z) ? (double)NAN : normal_angle(found, hit.normal);
        } else if (!isnan(found[0])) {
            angle = plane_bound(in, x, found);
        }
        in->out[x] = (float)(angle * TO_DEGREES);
    }
}

/* The settings of a pixel: world height per unit of eye depth is that of its ray. */
typedef struct settings {
    double at[EFFECT_PARAMETERS_MAX];
    int rise;
} settings;

static settings settings_of(const frame_row *in) {
    settings s = {.rise = effect_parameter_find(in->product->effect, "rise")};
    memcpy(s.at, in->product->effect_settings, sizeof s.at);
    return s;
}

static const double *settings_at(const frame_row *in, settings *s, uint32_t x) {
    const texture_camera *c = camera_of(in);
    const double ray[3] = {c->ortho ? 0 : camera_slope_x(c, x), c->ortho ? 0 : camera_slope_y(c, in->row), 1};
    double world[3];
    if (s->rise >= 0) {
        camera_turn(c, ray, world);
        s->at[s->rise] = world[1];
    }
    return s->at;
}

/* Two pixels that are compared, as Roberts' edge detector does along both diagonals of a quad. */
static double step(const frame_row *in, const double *at, uint32_t x) {
    const float *here = eyes_of(in), *below = in->eyes[NORMAL_REACH + 1];
    const effect_row *row = in->product->effect;
    const dp_setup *setup = &camera_of(in)->setup;
    const double a = row->output(setup, at, here[x], below[x + 1]);
    const double b = row->output(setup, at, here[x + 1], below[x]);
    return isnan(a) || isnan(b) ? (double)NAN : fmax(a, b);
}

static void make_effect(const frame_row *in) {
    const effect_row *row = in->product->effect;
    settings s = settings_of(in);
    for (uint32_t x = 0; x < camera_of(in)->width; x++) {
        const double z = eyes_of(in)[x], *at = settings_at(in, &s, x);
        double value = NAN;
        if (!isnan(z) && row->kind == EFFECT_STEP)
            value = step(in, at, x);
        else if (!isnan(z))
            value = row->output(&camera_of(in)->setup, at, z, in->product->reference);
        in->out[x] = (float)value;
    }
}

static void make_effect_error(const frame_row *in) {
    const dp_setup *setup = &camera_of(in)->setup;
    settings s = settings_of(in);
    double last = NAN;
    for (uint32_t x = 0; x < camera_of(in)->width; x++) {
        const double *at = settings_at(in, &s, x);
        const double z = fmin(fmax(dp_stored(setup, in->codes[x]), setup->spec.znear), setup->spec.zfar);
        if (isnan(eyes_of(in)[x]))
            in->out[x] = NAN;
        else if (x > 0 && z == last && s.rise < 0)
            in->out[x] = in->out[x - 1];
        else
            in->out[x] = (float)effect_error(in->product->effect, setup, at, z);
        last = isnan(in->out[x]) ? (double)NAN : z;
    }
}

frame_make *const frame_makers[FRAME_KINDS][2] = {
    [FRAME_EYE] = {make_eye, make_eye_error},
    [FRAME_POSITION] = {make_position, make_position_error},
    [FRAME_NORMAL] = {make_normal, make_normal_error},
    [FRAME_EFFECT] = {make_effect, make_effect_error},
};
