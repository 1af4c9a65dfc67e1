/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "texture/rows.h"

#include <math.h>
#include <string.h>

#include "core/clones.h"
#include "core/elementary.h"
#include "shader/normal_corner.h"

static const double TO_DEGREES = 1 / DP_DEGREE;

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

CLONES static void interleave_planes(const float *restrict x, const float *restrict y, const float *restrict z,
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
CLONES static void hide(const float *restrict eyes, float *restrict plane, size_t count) {
    for (size_t i = 0; i < count; i++)
        plane[i] = eyes[i] == eyes[i] ? plane[i] : (float)NAN;
}

static void make_eye(const frame_row *in) {
    const uint32_t width = camera_of(in)->width;
    memcpy(in->out, eyes_of(in), width * sizeof *in->out);
    for (uint32_t x = 0; x < width && in->product->radial; x++)
        in->out[x] = (float)((double)in->out[x] * stretch(in, x));
    for (uint32_t x = 0; x < width && in->product->as != NULL; x++)
        in->out[x] = (float)sensor_round(in->product->as, (double)in->out[x]);
}

static double far_of(const frame_row *in) {
    return frame_planes(in->frame)->spec.zfar;
}

static void make_linear01(const frame_row *in) {
    const double far = far_of(in);
    for (uint32_t x = 0; x < camera_of(in)->width; x++)
        in->out[x] = (float)((double)eyes_of(in)[x] / far);
}

static void make_raw(const frame_row *in) {
    for (uint32_t x = 0; x < camera_of(in)->width; x++)
        in->out[x] = in->codes[x] == UINT32_MAX ? NAN : in->depth[x];
}

/* The ranges of the codes of a row, in the room for numbers; the rest of that is free. */
static grain_rows ranges_in(const frame_row *in) {
    const size_t width = camera_of(in)->width;
    const grain_rows out = {in->numbers, in->numbers + width, in->numbers + 2 * width, in->numbers + 3 * width};
    pixel_ranges_of(camera_of(in), in->frame->grain, 0, in->row, in->codes, width, &out);
    return out;
}

static const double *along_in(const frame_row *in) {
    const uint32_t width = camera_of(in)->width;
    double *along = in->numbers + 4 * (size_t)width;
    for (uint32_t x = 0; x < width; x++)
        along[x] = stretch(in, x);
    return along;
}

/* The error of doubles in the place at an eye depth, 27 units of 2^-53: 8 of the stored depth, 7 of slopes, 12 of
 * turning them and of the difference from the place. */
DP_INLINE double places_lose(const texture_camera *c, double z) {
    const double most = c->half[0] * (1 + fabs(c->centre[0])) + c->half[1] * (1 + fabs(c->centre[1]));
    return DP_ROUNDINGS_30 * (fabs(z) + most * (c->ortho ? 1 : fabs(z)));
}

CLONES static void eye_errors(const float *eyes, const grain_rows *ranges, const double *along, double lost, float *out,
                              size_t count) {
    const double *stored = ranges->stored, *reach = ranges->reach;
#pragma omp simd
    for (size_t i = 0; i < count; i++) {
        const float product = along != NULL ? (float)((double)eyes[i] * along[i]) : eyes[i];
        const double by = along != NULL ? along[i] : 1;
        const float error =
            frame_upwards(fabs((double)product - stored[i] * by) + reach[i] * by + lost * fabs(stored[i]));
        out[i] = eyes[i] == eyes[i] ? error : (float)NAN;
    }
}

CLONES static void linear01_errors(const float *restrict eyes, const grain_rows *ranges, double far,
                                   float *restrict out, size_t count) {
    const double *stored = ranges->stored, *reach = ranges->reach;
#pragma omp simd
    for (size_t i = 0; i < count; i++) {
        const double product = (double)(float)((double)eyes[i] / far), roundings = DP_ROUNDINGS_6 * fabs(stored[i]);
        const float error = frame_upwards((fabs(product * far - stored[i]) + roundings + reach[i]) / far);
        out[i] = eyes[i] == eyes[i] ? error : (float)NAN;
    }
}

/* Replaces the row of a product by its error: a synthetic image knows the true depths, which count `factor` times. */
static void replace_by_errors(const frame_row *in, double factor) {
    for (uint32_t x = 0; x < camera_of(in)->width; x++) {
        const double along = in->product->radial ? stretch(in, x) : factor, truth = frame_truth(in, x).z * along;
        in->out[x] = frame_upwards(fabs((double)in->out[x] - truth) + DP_ROUNDINGS_6 * fabs(truth));
    }
}

/* The product's error in binary32 together with that of the stored depth. */
static void make_eye_error(const frame_row *in) {
    if (in->frame->synthetic != NULL) {
        make_eye(in);
        replace_by_errors(in, 1);
        return;
    }
    const grain_rows ranges = ranges_in(in);
    if (in->product->as != NULL)
        make_eye(in);
    eye_errors(in->product->as != NULL ? in->out : eyes_of(in), &ranges, in->product->radial ? along_in(in) : NULL,
               in->product->radial ? places_lose(camera_of(in), 1) : DP_ROUNDINGS_6, in->out, camera_of(in)->width);
}

static void make_linear01_error(const frame_row *in) {
    if (in->frame->synthetic != NULL) {
        make_linear01(in);
        replace_by_errors(in, 1 / far_of(in));
        return;
    }
    const grain_rows ranges = ranges_in(in);
    linear01_errors(eyes_of(in), &ranges, far_of(in), in->out, camera_of(in)->width);
}

/* The window depth of what a synthetic image shows; depths are clamped, as in the buffer. */
static double true_window(const frame_row *in, uint32_t x) {
    const dp_setup *setup = &camera_of(in)->setup;
    synthetic_hit hit;
    in->frame->synthetic->hit(camera_of(in), in->frame->parameters, x, in->row, &hit);
    if (!(hit.z < setup->spec.zfar))
        return setup->ends[1];
    return dp_window(setup, fmax(hit.z, setup->spec.znear));
}

/* dp_window() is good to 2^-50. */
static void make_raw_error(const frame_row *in) {
    const dp_setup *setup = &camera_of(in)->setup;
    for (uint32_t x = 0; x < camera_of(in)->width; x++) {
        const uint32_t code = in->codes[x];
        double error = NAN;
        if (code != UINT32_MAX && in->frame->synthetic != NULL) {
            const double d = true_window(in, x), slack = d < 1 ? d * DP_ROUNDINGS_6 : 0;
            error = fabs((double)in->depth[x] - d) + slack;
        } else if (code != UINT32_MAX) {
            const double stored = dp_format_value(&setup->spec.format, code);
            error = fabs((double)in->depth[x] - stored) + grain_window_reach(setup, in->frame->grain, code);
        }
        in->out[x] = frame_upwards(error);
    }
}

static void places(const frame_row *in) {
    const texture_camera *c = camera_of(in);
    if (in->found)
        return;
    if (in->product->position != NULL) {
        in->product->position->run(in->position, in->row, 0, in->depth, c->width, in->planes[0], in->planes[1],
                                   in->planes[2]);
        for (int k = 0; k < 3; k++)
            hide(eyes_of(in), in->planes[k], c->width);
        return;
    }
    frame_exact_places(in);
}

static void make_position(const frame_row *in) {
    places(in);
    interleave(in);
}

/* The error of places from stored depths; the depth's own error lies along the ray. */
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
        error[column] = position_off(&c, relative, world) + places_lose(&c, stored[column]) +
                        reach[column] * camera_radial(&c, column, row);
    }
}

CLONES static void position_perspective(const texture_camera *c, uint32_t row, float *const at[3], const grain_rows *r,
                                        double *error) {
    position_loop(c, false, row, at[0], at[1], at[2], r->stored, r->reach, error);
}

CLONES static void position_ortho(const texture_camera *c, uint32_t row, float *const at[3], const grain_rows *r,
                                  double *error) {
    position_loop(c, true, row, at[0], at[1], at[2], r->stored, r->reach, error);
}

/* Rounded up to binary32, times a unit; NaN where there is no product. */
CLONES static void round_up(const float *restrict found, const double *restrict error, double unit, float *restrict out,
                            size_t count) {
#pragma omp simd
    for (size_t i = 0; i < count; i++) {
        const float rounded = frame_upwards(error[i] * unit);
        out[i] = found[i] == found[i] ? rounded : (float)NAN;
    }
}

static void make_position_error(const frame_row *in) {
    places(in);
    if (in->frame->synthetic == NULL) {
        const grain_rows ranges = ranges_in(in);
        double *const errors = in->numbers + 4 * (size_t)camera_of(in)->width;
        (camera_of(in)->ortho ? position_ortho : position_perspective)(camera_of(in), in->row, in->planes, &ranges,
                                                                       errors);
        round_up(eyes_of(in), errors, 1, in->out, camera_of(in)->width);
        return;
    }
    for (uint32_t x = 0; x < camera_of(in)->width; x++) {
        const float world[3] = {in->planes[0][x], in->planes[1][x], in->planes[2][x]};
        const double z = frame_truth(in, x).z;
        double relative[3];
        frame_exact_place(in, x, z, relative);
        /* a hole, not an error without bound */
        in->out[x] = isnan(z)
                         ? NAN
                         : frame_upwards(position_off(camera_of(in), relative, world) + places_lose(camera_of(in), z));
    }
}

/* The rows of depths that the method reads. */
static normal_rows rows_around(const frame_row *in) {
    normal_rows rows = {.camera = camera_of(in), .row = in->row, .count = camera_of(in)->width, .slope_x = in->slope_x};
    memcpy(rows.rows, in->product->normal->sees_sky ? in->seen : in->eyes, sizeof rows.rows);
    return rows;
}

static void normals(const frame_row *in) {
    if (in->found)
        return;
    const normal_rows rows = rows_around(in);
    in->product->normal->run(&rows, in->planes[0], in->planes[1], in->planes[2]);
    for (int k = 0; k < 3 && in->product->normal->sees_sky; k++)
        hide(eyes_of(in), in->planes[k], rows.count);
}

static void make_normal(const frame_row *in) {
    normals(in);
    interleave(in);
}

/* The ranges of the codes of the row and of those a step above and below: all that taps need. lo and hi are used up. */
static void ranges_around(const frame_row *in, int step, grain_rows out[3]) {
    const texture_camera *c = camera_of(in);
    const size_t width = c->width;
    for (int k = 0; k < 3; k++) {
        const int64_t row = (int64_t)in->row + (k - 1) * step;
        double *const own = in->numbers + (2 + 2 * (size_t)k) * width;
        out[k] = (grain_rows){own, in->numbers, in->numbers + width, own + width};
        if (row >= 0 && row < c->height)
            pixel_ranges_of(c, in->frame->grain, 0, (uint32_t)row, in->codes + (k - 1) * step * (int64_t)width, width,
                            &out[k]);
    }
}

/* In an image: the error bound for a plane through the three pixels that were taken. */
static void corner_bounds(const frame_row *in) {
    const texture_camera *c = camera_of(in);
    const normal_row *method = in->product->normal;
    const int step = method->step;
    grain_rows around[3];
    ranges_around(in, step, around);
    uint8_t *const sides = (uint8_t *)in->numbers;
    const normal_rows rows = rows_around(in);
    method->sides(&rows, sides);
    for (uint32_t x = 0; x < c->width; x++) {
        in->out[x] = NAN;
        if (isnan(in->planes[0][x]))
            continue;
        const int64_t beside = (sides[x] & NORMAL_LEFT) != 0 ? (int64_t)x - step : (int64_t)x + step;
        const bool below = (sides[x] & NORMAL_BELOW) != 0;
        const grain_rows *own = &around[1], *other = &around[below ? 2 : 0];
        const normal_tap taps[3] = {
            {x, in->row, own->stored[x], own->reach[x]},
            {(double)beside, in->row, own->stored[beside], own->reach[beside]},
            {x, (double)in->row + (below ? step : -step), other->stored[x], other->reach[x]},
        };
        in->out[x] = frame_upwards(normal_corner_bound(c, method, taps, DP_BATCH_EYE_ERROR) * TO_DEGREES);
    }
}

/* In an image: the error bound for a plane through the pixel's place with the normal that was found. */
static void normal_bounds(const frame_row *in) {
    const texture_camera *c = camera_of(in);
    double *const z = in->numbers, *const bounds = z + c->width;
    const normal_planes planes = {c, in->row, {in->planes[0], in->planes[1], in->planes[2]}, z, in->memo};
    dp_batch_run(in->stored, in->codes, z, c->width);
    normal_planes_bounds(&planes, in->frame->grain, DP_BATCH_EYE_ERROR, bounds);
    round_up(in->planes[0], bounds, TO_DEGREES, in->out, c->width);
}

static void make_normal_error(const frame_row *in) {
    normals(in);
    if (in->frame->synthetic == NULL) {
        (in->product->normal == normal_get(NORMAL_PROJECTIVE) ? normal_bounds : corner_bounds)(in);
        return;
    }
    for (uint32_t x = 0; x < camera_of(in)->width; x++) {
        const double found[3] = {in->planes[0][x], in->planes[1][x], in->planes[2][x]};
        const synthetic_hit hit = frame_truth(in, x);
        const bool known = !isnan(found[0]) && !isnan(hit.z);
        in->out[x] = frame_upwards(known ? normal_angle(found, hit.normal) * TO_DEGREES : (double)NAN);
    }
}

frame_make *const frame_makers[FRAME_KINDS][2] = {
    [FRAME_EYE] = {make_eye, make_eye_error},          [FRAME_LINEAR01] = {make_linear01, make_linear01_error},
    [FRAME_RAW] = {make_raw, make_raw_error},          [FRAME_POSITION] = {make_position, make_position_error},
    [FRAME_NORMAL] = {make_normal, make_normal_error}, [FRAME_EFFECT] = {frame_effect, frame_effect_error},
};
