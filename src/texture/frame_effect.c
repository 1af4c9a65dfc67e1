/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Effects over a row of pixels: in binary32 as a shader evaluates them, and how far that can be off. */
#include <math.h>

#include "core/bits.h"
#include "texture/frame_rows.h"

static const double LEVELS = 255;

/* What a row of pixels has in common. */
typedef struct work {
    const frame_row *in;
    const effect_row *row;
    const texture_camera *camera;
    const dp_setup *planes;
    const double *parameters;
    float rounded[TEXTURE_PARAMETERS]; /* the parameters, as uniforms */
    double reference;                  /* NaN where none is given */
    effect_pixel other;                /* the reference, as uniforms */
    decode_constants eye, eye01;
    bool decodes; /* eye01 by a decoding of its own; else eye depth times inverse_far */
    float inverse_far;
    float last[3][4];
} work;

static work work_of(const frame_row *in) {
    const frame_product *product = in->product;
    const texture_camera *c = in->frame->camera, *then = in->frame->last != NULL ? in->frame->last : c;
    const dp_setup *planes = frame_planes(in->frame);
    const double reference = product->effect->given && product->reference > 0 ? product->reference : (double)NAN;
    double m[16];
    work w = {.in = in,
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
    for (int i = 0; i < TEXTURE_PARAMETERS; i++)
        w.rounded[i] = (float)w.parameters[i];
    return w;
}

static effect_view view_at(const work *w, uint32_t x) {
    effect_view view = effect_view_of(w->camera, w->in->frame->last, x, w->in->row);
    view.setup = w->planes;
    return view;
}

static effect_pixel seen_as(const work *w, float d) {
    effect_pixel p = {.last = w->last};
    decode_apply(&w->eye, &d, &p.eye, 1);
    if (w->decodes)
        decode_apply(&w->eye01, &d, &p.eye01, 1);
    else
        p.eye01 = p.eye * w->inverse_far;
    return p;
}

static effect_pixel pixel_at(const work *w, uint32_t x) {
    const position_state *s = w->in->position;
    effect_pixel p = seen_as(w, w->in->depth[x]);
    for (int k = 0; k < 3 && (w->row->needs & EFFECT_POSITION) != 0; k++)
        p.world[k] = w->in->planes[k][x];
    p.ndc[0] = 2.0f * (((float)x + 0.5f) * s->inverse_width) - 1.0f;
    p.ndc[1] = 1.0f - 2.0f * (((float)w->in->row + 0.5f) * s->inverse_height);
    return p;
}

/* World positions as image effects get them. */
static void places(const work *w) {
    const frame_row *in = w->in;
    if ((w->row->needs & EFFECT_POSITION) != 0)
        position_rows[w->camera->ortho ? POSITION_EXTENTS : POSITION_RAYS].run(
            in->position, in->row, 0, in->depth, w->camera->width, in->planes[0], in->planes[1], in->planes[2]);
}

/* ---- Two diagonals ----------------------------------------------------------------------------------------------- */

/* The corners of a square around a pixel, as Roberts' detector takes them: 0 and 3 are opposite, 1 and 2 are. */
enum { CORNERS = 4 };
static const int pairs[2][2] = {{0, 3}, {1, 2}};

typedef struct corner {
    uint32_t column, row, code;
} corner;

/* Beyond the border the outermost pixels go on. @return false at a hole */
static bool corners_of(const work *w, uint32_t x, corner out[CORNERS]) {
    const int64_t step = (int64_t)w->parameters[parameter_find(w->row->parameters, "sample-distance")];
    for (int i = 0; i < CORNERS; i++) {
        const int64_t column = (int64_t)x + (i % 2 == 0 ? -step : step), row = w->in->row + (i < 2 ? -step : step);
        const int64_t width = w->camera->width, height = w->camera->height;
        out[i].column = (uint32_t)(column < 0 ? 0 : column < width ? column : width - 1);
        out[i].row = (uint32_t)(row < 0 ? 0 : row < height ? row : height - 1);
        const int64_t away = (int64_t)out[i].row - w->in->row;
        out[i].code = w->in->codes[away * width + out[i].column];
        if (out[i].code == UINT32_MAX)
            return false;
    }
    return true;
}

static float diagonals(const work *w, uint32_t x) {
    corner at[CORNERS];
    effect_pixel seen[CORNERS];
    float edge = 0;
    if (!corners_of(w, x, at))
        return NAN;
    for (int i = 0; i < CORNERS; i++)
        seen[i] = seen_as(w, (float)dp_format_value(&w->camera->setup.spec.format, at[i].code));
    for (int k = 0; k < 2; k++)
        edge = fmaxf(edge, w->row->shader(&seen[pairs[k][0]], w->rounded, &seen[pairs[k][1]]));
    return edge;
}

/* Sky is as far as the far plane, which the buffer was cleared to. */
static double true_depth(const work *w, const corner *at) {
    scene_hit hit;
    w->in->frame->scene->hit(w->camera, w->in->frame->parameters, at->column, at->row, &hit);
    return fmin(hit.z, w->planes->spec.zfar);
}

/* Between which differences two depths lie. */
static void spread(const grain_range *a, const grain_range *b, double out[2]) {
    out[0] = fmax(fmax(a->lo - b->hi, b->lo - a->hi), 0);
    out[1] = fmax(a->hi - b->lo, b->hi - a->lo);
}

/* Of a scene what is wrong; of an image what could be. */
static double diagonals_error(const work *w, uint32_t x) {
    corner at[CORNERS];
    const effect_view view = {.setup = w->planes};
    const float seen = diagonals(w, x);
    double least = 0, most = 0;
    if (isnan(seen) || !corners_of(w, x, at))
        return NAN;
    for (int k = 0; k < 2; k++) {
        const corner *a = &at[pairs[k][0]], *b = &at[pairs[k][1]];
        double d[2];
        if (w->in->frame->scene != NULL) {
            d[0] = d[1] = fabs(true_depth(w, a) - true_depth(w, b));
        } else {
            const grain_range one = grain_range_of(&w->camera->setup, w->in->frame->grain, a->code);
            const grain_range two = grain_range_of(&w->camera->setup, w->in->frame->grain, b->code);
            spread(&one, &two, d);
        }
        least = fmax(least, w->row->output(&view, w->parameters, d[0], 0));
        most = fmax(most, w->row->output(&view, w->parameters, d[1], 0));
    }
    return LEVELS * fmax(fabs((double)seen - least), fabs((double)seen - most));
}

/* ---- One pixel --------------------------------------------------------------------------------------------------- */

/* Where what it is compared with is not known, it lies where the error is largest. What binary32 adds is then bounded:
 * a few roundings of an output of 1, and one of each depth. */
static double worst_error(const work *w, const effect_view *view, float eye, const grain_range *range) {
    const effect_depths depths = {.seen = (double)eye, .lo = range->lo, .hi = range->hi};
    const double p = w->parameters[w->row->wanted], depth = w->row->apart(view, w->parameters, depths.seen, 0);
    const double scale = w->row->kind == EFFECT_FADE ? depth / p : depth * p;
    return effect_error_within(w->row, view, w->parameters, &depths) + LEVELS * DP_UNIT * (8 + 4 * scale);
}

/* Outputs are monotone on either side of the depth that they compare with. */
static double range_error(const work *w, const effect_view *view, double stored, const grain_range *range) {
    const double at = w->row->output(view, w->parameters, stored, w->reference);
    const double ends[3] = {range->lo, range->hi,
                            w->reference > range->lo && w->reference < range->hi ? w->reference : stored};
    double error = 0;
    const effect_depths depths = {.seen = stored, .lo = range->lo, .hi = range->hi};
    if (!w->row->given && w->row->kind == EFFECT_GAIN)
        return effect_error_within(w->row, view, w->parameters, &depths);
    for (int i = 0; i < 3; i++)
        error = fmax(error, LEVELS * fabs(w->row->output(view, w->parameters, ends[i], w->reference) - at));
    return error;
}

static double error_at(const work *w, frame_ranges *last, uint32_t x) {
    const effect_view view = view_at(w, x);
    const effect_pixel pixel = pixel_at(w, x);
    const bool compared = !w->row->given || !isnan(w->reference);
    if (!compared)
        return worst_error(w, &view, pixel.eye, frame_range_of(w->in, last, x));
    const double seen = (double)w->row->shader(&pixel, w->rounded, &w->other);
    if (w->in->frame->scene != NULL) {
        const double z = frame_truth(w->in, x).z;
        return isnan(z) ? z : LEVELS * fabs(seen - w->row->output(&view, w->parameters, z, w->reference));
    }
    const double stored = dp_stored(&w->camera->setup, w->in->codes[x]);
    const double exact = w->row->output(&view, w->parameters, stored, w->reference);
    return LEVELS * fabs(seen - exact) + range_error(w, &view, stored, frame_range_of(w->in, last, x));
}

/* ---- Rows -------------------------------------------------------------------------------------------------------- */

void frame_effect(const frame_row *in) {
    const work w = work_of(in);
    places(&w);
    for (uint32_t x = 0; x < w.camera->width; x++) {
        float value = NAN;
        if (w.row->kind == EFFECT_STEP)
            value = diagonals(&w, x);
        else if (!isnan(in->eyes[NORMAL_REACH][x])) {
            const effect_pixel pixel = pixel_at(&w, x);
            value = w.row->shader(&pixel, w.rounded, &w.other);
        }
        in->out[x] = value;
    }
}

void frame_effect_error(const frame_row *in) {
    const work w = work_of(in);
    const bool alike = in->frame->scene == NULL && (w.row->needs & EFFECT_POSITION) == 0;
    frame_ranges last = frame_no_range();
    places(&w);
    for (uint32_t x = 0; x < w.camera->width; x++) {
        double error = NAN;
        if (w.row->kind == EFFECT_STEP)
            error = diagonals_error(&w, x);
        else if (isnan(in->eyes[NORMAL_REACH][x]))
            error = NAN;
        else if (alike && x > 0 && in->codes[x] == in->codes[x - 1])
            error = (double)in->out[x - 1];
        else
            error = error_at(&w, &last, x);
        in->out[x] = isnan(error) ? NAN : frame_upwards(fmin(error, LEVELS));
    }
}
