/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "texture/frame_rows.h"

#include <math.h>
#include <string.h>

#include "core/bits.h"
#include "texture/clones.h"

static const double TO_DEGREES = 180 / M_PI;
static const double LEVELS = 255, ROUNDED = 255 * DP_UNIT; /* an output of 1 in binary32 */

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

/* What a code says of the depth. Neighbours often share one. */
typedef struct one_range {
    uint32_t code;
    grain_range range;
} one_range;

static const grain_range *range_of(const frame_row *in, one_range *last, uint32_t x) {
    const uint32_t code = in->codes[x];
    if (code != last->code)
        *last = (one_range){code, grain_range_of(&camera_of(in)->setup, in->frame->grain, code)};
    return &last->range;
}

static one_range nothing_yet(void) {
    return (one_range){.code = UINT32_MAX};
}

/* An error map must not be below the error: the nearest binary32 number that is not. A few roundings to double came
   before. */
DP_INLINE float upwards(double error) {
    return dp_float_up(error * (1 + 0x1p-48));
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

/* What the codes of a row stand for, in the room for numbers; the rest of that is free. */
static grain_rows ranges_in(const frame_row *in) {
    const size_t width = camera_of(in)->width;
    const grain_rows out = {in->numbers, in->numbers + width, in->numbers + 2 * width, in->numbers + 3 * width};
    grain_ranges_of(&camera_of(in)->setup, in->frame->grain, in->codes, width, &out);
    return out;
}

static const double *along_in(const frame_row *in) {
    const uint32_t width = camera_of(in)->width;
    double *along = in->numbers + 4 * (size_t)width;
    for (uint32_t x = 0; x < width; x++)
        along[x] = stretch(in, x);
    return along;
}

TEXTURE_CLONES static void eye_errors(const float *restrict eyes, const grain_rows *ranges, const double *along,
                                      float *restrict out, size_t count) {
    const double *stored = ranges->stored, *reach = ranges->reach;
#pragma omp simd
    for (size_t i = 0; i < count; i++) {
        const float product = along != NULL ? (float)((double)eyes[i] * along[i]) : eyes[i];
        const double by = along != NULL ? along[i] : 1;
        const float error = upwards(fabs((double)product - stored[i] * by) + reach[i] * by);
        out[i] = eyes[i] == eyes[i] ? error : (float)NAN;
    }
}

/* What the product has lost in binary32, and how far what is stored is off: of a scene the latter alone, exactly. */
static void make_eye_error(const frame_row *in) {
    const texture_camera *c = camera_of(in);
    if (in->frame->scene == NULL) {
        const grain_rows ranges = ranges_in(in);
        eye_errors(eyes_of(in), &ranges, in->product->radial ? along_in(in) : NULL, in->out, c->width);
        return;
    }
    for (uint32_t x = 0; x < c->width; x++) {
        const double along = in->product->radial ? stretch(in, x) : 1, z = truth(in, x).z;
        in->out[x] = upwards(isnan(z) ? (double)NAN : fabs(dp_error(&c->setup, in->codes[x], z)) * along);
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

/* Of what is stored; the depth's own error lies along the ray. */
DP_INLINE void position_loop(const texture_camera *camera, bool ortho, uint32_t row, const float *restrict x,
                             const float *restrict y, const float *restrict z, const double *restrict stored,
                             const double *restrict reach, double *restrict error) {
    texture_camera c = *camera;
    c.ortho = ortho;
    for (int column = 0; column < (int)camera->width; column++) {
        const float world[3] = {x[column], y[column], z[column]};
        double view[3], relative[3];
        camera_view(&c, column, row, stored[column], view);
        camera_turn(&c, view, relative);
        error[column] = position_off(&c, relative, world) + reach[column] * camera_radial(&c, column, row);
    }
}

TEXTURE_CLONES static void position_perspective(const texture_camera *c, uint32_t row, float *const at[3],
                                                const grain_rows *r, double *error) {
    position_loop(c, false, row, at[0], at[1], at[2], r->stored, r->reach, error);
}

TEXTURE_CLONES static void position_ortho(const texture_camera *c, uint32_t row, float *const at[3],
                                          const grain_rows *r, double *error) {
    position_loop(c, true, row, at[0], at[1], at[2], r->stored, r->reach, error);
}

/* Rounded up to binary32, times a unit; NaN where there is no product. */
TEXTURE_CLONES static void round_up(const float *restrict found, const double *restrict error, double unit,
                                    float *restrict out, size_t count) {
#pragma omp simd
    for (size_t i = 0; i < count; i++) {
        const float rounded = upwards(error[i] * unit);
        out[i] = found[i] == found[i] ? rounded : (float)NAN;
    }
}

static void make_position_error(const frame_row *in) {
    places(in);
    if (in->frame->scene == NULL) {
        const grain_rows ranges = ranges_in(in);
        double *const errors = in->numbers + 4 * (size_t)camera_of(in)->width;
        (camera_of(in)->ortho ? position_ortho : position_perspective)(camera_of(in), in->row, in->planes, &ranges,
                                                                       errors);
        round_up(eyes_of(in), errors, 1, in->out, camera_of(in)->width);
        return;
    }
    for (uint32_t x = 0; x < camera_of(in)->width; x++) {
        const float world[3] = {in->planes[0][x], in->planes[1][x], in->planes[2][x]};
        const double z = truth(in, x).z;
        double relative[3];
        exact_place(in, x, z, relative);
        /* a hole, not an error without bound */
        in->out[x] = isnan(z) ? NAN : upwards(position_off(camera_of(in), relative, world));
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

/* Of an image the bound for a plane through the pixel's place with the normal that was found. */
static void normal_bounds(const frame_row *in) {
    const texture_camera *c = camera_of(in);
    const grain_rows ranges = ranges_in(in);
    double *bounds = in->numbers + 4 * (size_t)c->width;
    const normal_planes planes = {c, in->row, {in->planes[0], in->planes[1], in->planes[2]}, ranges.stored, in->memo};
    normal_planes_bounds(&planes, in->frame->grain, DP_BATCH_EYE_ERROR, bounds);
    round_up(in->planes[0], bounds, TO_DEGREES, in->out, c->width);
}

static void make_normal_error(const frame_row *in) {
    normals(in);
    if (in->frame->scene == NULL) {
        normal_bounds(in);
        return;
    }
    for (uint32_t x = 0; x < camera_of(in)->width; x++) {
        const double found[3] = {in->planes[0][x], in->planes[1][x], in->planes[2][x]};
        const scene_hit hit = truth(in, x);
        const bool known = !isnan(found[0]) && !isnan(hit.z);
        in->out[x] = upwards(known ? normal_angle(found, hit.normal) * TO_DEGREES : (double)NAN);
    }
}

/* The settings of a row: world height per unit of eye depth is that of its rays. No camera rolls: all rise alike. */
static void settings_of(const frame_row *in, double at[TEXTURE_PARAMETERS]) {
    const texture_camera *c = camera_of(in);
    const int rise = parameter_find(in->product->effect->parameters, "rise");
    const double ray[3] = {0, c->ortho ? 0 : camera_slope_y(c, in->row), 1};
    double world[3];
    memcpy(at, in->product->effect_settings, TEXTURE_PARAMETERS * sizeof *at);
    camera_turn(c, ray, world);
    if (rise >= 0)
        at[rise] = world[1];
}

/* Two pixels that are compared, as Roberts' edge detector does along both diagonals of a quad. */
static double step(const frame_row *in, const double *at, uint32_t x) {
    const float *here = eyes_of(in), *below = in->eyes[NORMAL_REACH + 1];
    const effect_row *row = in->product->effect;
    const dp_setup *setup = frame_planes(in->frame);
    const double a = row->output(setup, at, here[x], below[x + 1]);
    const double b = row->output(setup, at, here[x + 1], below[x]);
    return isnan(a) || isnan(b) ? (double)NAN : fmax(a, b);
}

static void make_effect(const frame_row *in) {
    const effect_row *row = in->product->effect;
    double at[TEXTURE_PARAMETERS];
    settings_of(in, at);
    for (uint32_t x = 0; x < camera_of(in)->width; x++) {
        const double z = eyes_of(in)[x];
        double value = NAN;
        if (!isnan(z) && row->kind == EFFECT_STEP)
            value = step(in, at, x);
        else if (!isnan(z))
            value = row->output(frame_planes(in->frame), at, z, in->product->reference);
        in->out[x] = (float)value;
    }
}

/* Of an image the depths that it leaves open; of a scene those of the cell. */
static double effect_error_at(const frame_row *in, one_range *last, const double *at, uint32_t x) {
    const dp_setup *setup = &camera_of(in)->setup;
    const effect_row *row = in->product->effect;
    if (in->frame->scene != NULL)
        return effect_error(row, setup, at,
                            fmin(fmax(dp_stored(setup, in->codes[x]), setup->spec.znear), setup->spec.zfar));
    const grain_range *range = range_of(in, last, x);
    effect_depths depths = {.seen = (double)eyes_of(in)[x], .lo = range->lo, .hi = range->hi};
    if (row->kind == EFFECT_STEP) {
        const double slope = at[parameter_find(row->parameters, "slope")];
        const double ends[2] = {range->lo + slope, fmin(range->hi + slope, setup->spec.zfar)};
        for (int i = 0; i < 2; i++)
            depths.beside = fmax(depths.beside, grain_range_of(setup, in->frame->grain, dp_code(setup, ends[i])).reach);
    }
    const double output = row->output(frame_planes(in->frame), at, depths.seen, depths.seen);
    return effect_error_within(row, frame_planes(in->frame), at, &depths) + ROUNDED * fmax(1, fabs(output));
}

static void make_effect_error(const frame_row *in) {
    double at[TEXTURE_PARAMETERS];
    one_range last = nothing_yet();
    settings_of(in, at);
    for (uint32_t x = 0; x < camera_of(in)->width; x++) {
        if (isnan(eyes_of(in)[x]))
            in->out[x] = NAN;
        else if (x > 0 && in->codes[x] == in->codes[x - 1])
            in->out[x] = in->out[x - 1];
        else
            in->out[x] = upwards(fmin(effect_error_at(in, &last, at, x), LEVELS));
    }
}

frame_make *const frame_makers[FRAME_KINDS][2] = {
    [FRAME_EYE] = {make_eye, make_eye_error},
    [FRAME_POSITION] = {make_position, make_position_error},
    [FRAME_NORMAL] = {make_normal, make_normal_error},
    [FRAME_EFFECT] = {make_effect, make_effect_error},
};
