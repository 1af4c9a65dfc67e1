/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Effects over a row of pixels: in binary32 as a shader evaluates them, and how far that can be off. */
#include <math.h>
#include <string.h>

#include "core/bits.h"
#include "core/elementary.h"
#include "shader/packing.h"
#include "texture/effect_corners.h"

static effect_work work_of(const frame_row *in) {
    const frame_product *product = in->product;
    const texture_camera *c = in->frame->camera, *then = in->frame->last != NULL ? in->frame->last : c;
    const dp_setup *planes = frame_planes(in->frame);
    const double reference = effect_reference(product->effect, product->effect_settings, planes->spec.zfar);
    double m[16];
    effect_work w = {.in = in,
                     .row = product->effect,
                     .camera = c,
                     .planes = planes,
                     .parameters = product->effect_settings,
                     .reference = reference,
                     .other = {.eye = (float)reference, .eye01 = (float)(reference / planes->spec.zfar)},
                     .eye = decode_usual(&c->setup)->constants(&c->setup),
                     .eye01 = decode_rows[DECODE_LINEAR_01].constants(&c->setup),
                     .decodes = !in->frame->metric && decode_applies(&decode_rows[DECODE_LINEAR_01], &c->setup),
                     .inverse_far = (float)(1 / planes->spec.zfar)};
    position_matrix(then, m);
    for (int i = 0; i < 12; i++)
        w.last[i / 4][i % 4] = (float)m[i < 8 ? i : i + 4];
    for (int i = 0; i < PARAMETERS_MAX; i++)
        w.rounded[i] = (float)w.parameters[i];
    return w;
}

static effect_view view_at(const effect_work *w, uint32_t x) {
    effect_view view = effect_view_of(w->camera, w->in->frame->last, x, w->in->row);
    view.setup = w->planes;
    return view;
}

static effect_pixel seen_at(const effect_work *w, uint32_t x) {
    return effect_seen_as(w, x, w->in->row, w->in->codes[x], w->in->depth[x]);
}

static effect_pixel pixel_at(const effect_work *w, uint32_t x) {
    const position_state *s = w->in->position;
    effect_pixel p = seen_at(w, x);
    for (int k = 0; k < 3 && (w->row->needs & EFFECT_POSITION) != 0; k++)
        p.world[k] = w->in->planes[k][x];
    p.stretch = (float)camera_radial(w->camera, x, w->in->row);
    p.ndc[0] = 2.0f * (((float)x + 0.5f) * s->inverse_width) - 1.0f;
    p.ndc[1] = 1.0f - 2.0f * (((float)w->in->row + 0.5f) * s->inverse_height);
    return p;
}

/* World positions as image effects get them. */
static void places(const effect_work *w) {
    const frame_row *in = w->in;
    const position_row *by = &position_rows[w->camera->ortho ? POSITION_EXTENTS : POSITION_RAYS];
    if (!position_applies(by, w->camera)) /* a far plane at 0, by which nothing can be divided */
        by = &position_rows[POSITION_VIEW];
    if ((w->row->needs & EFFECT_POSITION) == 0)
        return;
    if (camera_is_shared(w->camera))
        by->run(in->position, in->row, 0, in->depth, w->camera->width, in->planes[0], in->planes[1], in->planes[2]);
    else
        frame_exact_places(in);
}

/* ---- One pixel --------------------------------------------------------------------------------------------------- */

/*
 * The most that binary32 adds where the output is at most 1: a few roundings of that, and one of the depth that it
 * compares with, which lies no farther off than the output tells; what is seen is read as it is.
 */
static double rounding_error(const effect_work *w, const effect_view *view, double seen) {
    const double p = w->parameters[w->row->wanted], depth = w->row->apart(view, w->parameters, seen, 0);
    return EFFECT_LEVELS * DP_UNIT * (8 + (w->row->kind == EFFECT_FADE ? depth / p : depth * p));
}

/* Where what it is compared with is not known, it lies where the error is largest. */
static double worst_error(const effect_work *w, const effect_view *view, const effect_pixel *pixel,
                          const grain_range *range) {
    const double seen = w->row->eye01 ? (double)pixel->eye01 * w->planes->spec.zfar : (double)pixel->eye;
    const effect_depths depths = {.seen = seen, .lo = range->lo, .hi = range->hi};
    const double error = effect_error_within(w->row, view, w->parameters, &depths);
    if (w->row->apart == NULL)
        return isnan(error) ? EFFECT_LEVELS : error;
    return error + rounding_error(w, view, depths.seen);
}

/* A ramp of a concave quantity, which is least at an end of the range. */
static double ramp_error(const effect_work *w, const effect_view *view, double stored, const grain_range *range) {
    const double p = w->parameters[w->row->wanted];
    const double ends[3] = {
        fmin(w->row->quantity(view, w->parameters, range->lo), w->row->quantity(view, w->parameters, range->hi)),
        w->row->quantity(view, w->parameters, stored), w->row->most(view, w->parameters, range->lo, range->hi)};
    double outputs[3];
    for (int i = 0; i < 3; i++)
        outputs[i] = p > 0 ? fmin(fmax(ends[i] / p, 0), 1) : ends[i] >= 0;
    return EFFECT_LEVELS * fmax(fmax(outputs[1] - outputs[0], outputs[2] - outputs[1]), 0);
}

/* Outputs are monotone on either side of the depth that they compare with, and doubles. */
static double range_error(const effect_work *w, const effect_view *view, double stored, const grain_range *range) {
    const double at = w->row->output(view, w->parameters, stored, w->reference);
    const double ends[3] = {range->lo, range->hi,
                            w->reference > range->lo && w->reference < range->hi ? w->reference : stored};
    const effect_depths depths = {.seen = stored, .lo = range->lo, .hi = range->hi};
    double error = 0;
    if (!w->row->given && w->row->kind == EFFECT_GAIN)
        return effect_error_within(w->row, view, w->parameters, &depths) + EFFECT_LEVELS * 0x1p-48;
    if (!w->row->given && w->row->kind == EFFECT_FADE && w->row->quantity != NULL)
        return ramp_error(w, view, stored, range);
    for (int i = 0; i < 3; i++)
        error = fmax(error, EFFECT_LEVELS * fabs(w->row->output(view, w->parameters, ends[i], w->reference) - at));
    return error;
}

/* The pixel that `refraction` names, as far as the picture goes. */
static uint32_t aside_of(const effect_work *w, uint32_t x) {
    const int index = parameter_find(w->row->parameters, "refraction");
    const int64_t at = x + (index >= 0 ? (int64_t)w->parameters[index] : 0), width = w->camera->width;
    return (uint32_t)(at < 0 ? 0 : at < width ? at : width - 1);
}

/* Where the effect looks: beside the pixel if it refracts, unless what is there lies before the surface, or is none. */
static uint32_t looks_at(const effect_work *w, uint32_t x) {
    const uint32_t at = aside_of(w, x);
    if (at == x || isnan(w->in->eyes[NORMAL_REACH][at]))
        return x;
    return seen_at(w, at).eye >= w->other.eye ? at : x;
}

static float output_at(const effect_work *w, uint32_t x) {
    const uint32_t at = looks_at(w, x);
    effect_pixel pixel = pixel_at(w, x);
    if (at != x) {
        const effect_pixel beside = seen_at(w, at);
        pixel.eye = beside.eye;
        pixel.eye01 = beside.eye01;
    }
    return w->row->shader(&pixel, w->rounded, &w->other);
}

/* Exact for what is stored. */
static double exact_at(const effect_work *w, const effect_view *view, uint32_t x) {
    const uint32_t at = looks_at(w, x);
    return w->row->output(view, w->parameters, pixel_stored(w->camera, at, w->in->row, w->in->codes[at]), w->reference);
}

/* In a synthetic image the truth decides where the effect should have looked. */
static double true_output(const effect_work *w, const effect_view *view, uint32_t x) {
    const uint32_t at = aside_of(w, x);
    const double own = frame_truth(w->in, x).z, beside = at == x ? own : frame_truth(w->in, at).z;
    return w->row->output(view, w->parameters, beside >= w->reference ? beside : own, w->reference);
}

/* The largest error of a refracted pixel: it looks beside itself if the depth there is no nearer than the surface. */
static double refracted_error(const effect_work *w, const effect_view *view, double seen, double surface,
                              const grain_range ranges[2]) {
    const grain_range *own = &ranges[0], *beside = &ranges[1];
    const double ends[4] = {own->lo, own->hi, fmax(beside->lo, surface), beside->hi};
    double error = 0;
    for (int i = beside->lo < surface ? 0 : 2; i < (beside->hi >= surface ? 4 : 2); i++)
        error = fmax(error, EFFECT_LEVELS * fabs(w->row->output(view, w->parameters, ends[i], surface) - seen));
    return error;
}

/* The error of a pixel that looks through the one beside it. An unknown surface may lie where the choice between the
 * two turns, or where the error of one is largest: at an end of what either may be, at what is seen, or next to it. */
static double through_error(const effect_work *w, const effect_view *view, uint32_t x, uint32_t beside) {
    frame_ranges last = frame_no_range();
    grain_range ranges[2];
    ranges[0] = *frame_range_of(w->in, &last, x);
    ranges[1] = *frame_range_of(w->in, &last, beside);
    if (!isnan(w->reference))
        return refracted_error(w, view, (double)output_at(w, x), w->reference, ranges);
    const double seen[2] = {(double)seen_at(w, x).eye, (double)seen_at(w, beside).eye};
    double error = 0;
    for (int i = 0; i < 12; i++) {
        const grain_range *range = &ranges[i / 6];
        const double at = i / 2 % 3 == 0 ? range->lo : i / 2 % 3 == 1 ? range->hi : seen[i / 6];
        const double surface = i % 2 == 0 ? at : nextafter(at, HUGE_VAL);
        const double output = w->row->output(view, w->parameters, seen[seen[1] >= surface], surface);
        error = fmax(error, refracted_error(w, view, output, surface, ranges));
    }
    return error + rounding_error(w, view, fmax(seen[0], seen[1]));
}

/* The error of a vector: by components, as it may turn without growing. */
static double vector_off(const effect_work *w, const effect_view *view, uint32_t x, double z) {
    const effect_pixel pixel = pixel_at(w, x);
    float seen[2];
    double exact[2];
    w->row->vector(&pixel, w->rounded, seen);
    w->row->exact_vector(view, w->parameters, z, exact);
    return EFFECT_LEVELS * dp_hypot((double)seen[0] - exact[0], (double)seen[1] - exact[1]);
}

static double error_at(const effect_work *w, frame_ranges *last, uint32_t x) {
    const effect_view view = view_at(w, x);
    const uint32_t beside = aside_of(w, x);
    const bool anywhere = w->row->given && isnan(w->reference);
    if (beside != x && !isnan(w->in->eyes[NORMAL_REACH][beside]) && (anywhere || w->in->frame->synthetic == NULL))
        return through_error(w, &view, x, beside);
    if (anywhere) {
        const effect_pixel pixel = pixel_at(w, x);
        return worst_error(w, &view, &pixel, frame_range_of(w->in, last, x));
    }
    const bool scene = w->in->frame->synthetic != NULL;
    const double seen = (double)output_at(w, x), stored = pixel_stored(w->camera, x, w->in->row, w->in->codes[x]);
    const double z = scene ? frame_truth(w->in, x).z : stored;
    const double alone = EFFECT_LEVELS * fabs(seen - (scene ? true_output : exact_at)(w, &view, x)),
                 off = isnan(z)       ? (double)NAN
                       : w->row->wide ? fmax(vector_off(w, &view, x, z), alone) /* a length has roundings of its own */
                                      : alone;
    return scene ? off : off + range_error(w, &view, stored, frame_range_of(w->in, last, x));
}

/* ---- Rows -------------------------------------------------------------------------------------------------------- */

static bool is_hidden(const effect_work *w, uint32_t x) {
    return w->in->product->hides && seen_at(w, x).eye < w->other.eye;
}

void frame_effect(const frame_row *in) {
    const effect_work w = work_of(in);
    places(&w);
    for (uint32_t x = 0; x < w.camera->width; x++) {
        const bool alone = w.row->taps == EFFECT_ALONE,
                   none = alone && (isnan(in->eyes[NORMAL_REACH][x]) || is_hidden(&w, x));
        const float value = none ? NAN : alone ? output_at(&w, x) : effect_corners(&w, x);
        if (in->product->vector) {
            float *out = in->out + 3 * (size_t)x;
            const effect_pixel pixel = pixel_at(&w, x);
            w.row->vector(&pixel, w.rounded, out);
            out[0] = none ? NAN : out[0];
            out[1] = none ? NAN : out[1];
            out[2] = value;
            continue;
        }
        in->out[x] = value;
        if (in->product->lost && !none) {
            const effect_view view = view_at(&w, x);
            in->out[x] = (float)((double)value - (alone ? exact_at(&w, &view, x) : effect_corners_exact(&w, x)));
        }
    }
}

void frame_effect_error(const frame_row *in) {
    const effect_work w = work_of(in);
    const bool alike = in->frame->synthetic == NULL && camera_is_shared(w.camera) &&
                       (w.row->needs & EFFECT_POSITION) == 0; /* as far as codes are; what looks aside needs it */
    frame_ranges last = frame_no_range();
    places(&w);
    for (uint32_t x = 0; x < w.camera->width; x++) {
        double error = NAN;
        if (w.row->taps != EFFECT_ALONE)
            error = effect_corners_error(&w, x);
        else if (isnan(in->eyes[NORMAL_REACH][x]))
            error = NAN;
        else if (alike && x > 0 && in->codes[x] == in->codes[x - 1])
            error = (double)in->out[x - 1];
        else
            error = error_at(&w, &last, x);
        const bool exact = w.row->taps != EFFECT_ALONE; /* so many quarters */
        in->out[x] = isnan(error) ? NAN : exact ? (float)error : fminf(frame_upwards(error), (float)EFFECT_LEVELS);
    }
}
