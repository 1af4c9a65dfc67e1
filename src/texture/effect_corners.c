/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "texture/effect_corners.h"

#include <math.h>
#include <string.h>

#include "core/elementary.h"
#include "shader/packing.h"

effect_pixel effect_seen_as(const effect_work *w, uint32_t column, uint32_t row, uint32_t code, float d) {
    effect_pixel p = {.last = w->last};
    if (camera_is_shared(w->camera))
        decode_apply(&w->eye, &d, &p.eye, 1);
    else
        p.eye = (float)pixel_stored(w->camera, column, row, code);
    if (w->decodes)
        decode_apply(&w->eye01, &d, &p.eye01, 1);
    else
        p.eye01 = p.eye * w->inverse_far;
    return p;
}

/* A pixel and the corners of a square around it: 0 and 3 are opposite, and 1 and 2. */
enum { CORNERS = 4, MIDDLE = CORNERS, TAPS };

/* The pairs of taps that are compared, and how many outputs make one. */
static const struct {
    int count, first[CORNERS], second[CORNERS];
} compared[] = {
    [EFFECT_DIAGONALS] = {2, {0, 1}, {3, 2}},
    [EFFECT_AROUND] = {4, {MIDDLE, MIDDLE, MIDDLE, MIDDLE}, {0, 1, 2, 3}},
};

typedef struct tap {
    uint32_t column, row, code;
} tap;

/* Beyond the border the outermost pixels go on. @return false at a hole */
static bool taps_of(const effect_work *w, uint32_t x, tap out[TAPS]) {
    const int64_t step = (int64_t)w->parameters[parameter_find(w->row->parameters, "sample-distance")];
    const int64_t width = w->camera->width, height = w->camera->height;
    for (int i = 0; i < TAPS; i++) {
        const int64_t away = i == MIDDLE ? 0 : step;
        const int64_t column = (int64_t)x + (i % 2 == 0 ? -away : away), row = w->in->row + (i < 2 ? -away : away);
        out[i].column = (uint32_t)(column < 0 ? 0 : column < width ? column : width - 1);
        out[i].row = (uint32_t)(row < 0 ? 0 : row < height ? row : height - 1);
        out[i].code = w->in->codes[((int64_t)out[i].row - w->in->row) * width + out[i].column];
        if (out[i].code == UINT32_MAX)
            return false;
    }
    return true;
}

/* Sky is as far as the far plane, which the buffer was cleared to, and faces the camera. */
static synthetic_hit hit_of(const effect_work *w, const tap *at) {
    synthetic_hit hit;
    w->in->frame->synthetic->hit(w->camera, w->in->frame->parameters, at->column, at->row, &hit);
    if (isinf(hit.z))
        hit = (synthetic_hit){.z = w->planes->spec.zfar, .normal = {0, 0, -1}};
    return hit;
}

static size_t pixel_of(const effect_work *w, const tap *at) {
    return (size_t)at->row * w->camera->width + at->column;
}

/* The normal that the texture of depths and normals holds: z towards the camera, in two channels of 8 bits. */
static void packed_normal(const effect_work *w, const tap *at, double out[3]) {
    uint8_t texel[2];
    const uint8_t *packed = texel;
    if (w->in->frame->normals != NULL) {
        packed = w->in->frame->normals->texels + 2 * pixel_of(w, at);
    } else {
        const synthetic_hit hit = hit_of(w, at);
        packing_normal_texel((const double[]){hit.normal[0], hit.normal[1], fmax(-hit.normal[2], 0)}, texel);
    }
    packing_normal(packed, out);
}

float effect_corners(const effect_work *w, uint32_t x) {
    tap at[TAPS];
    effect_pixel seen[TAPS];
    const bool around = w->row->taps == EFFECT_AROUND;
    float all = 0;
    if (!taps_of(w, x, at))
        return NAN;
    for (int i = 0; i < TAPS; i++) {
        seen[i] = effect_seen_as(w, at[i].column, at[i].row, at[i].code,
                                 (float)dp_format_value(&w->camera->setup.spec.format, at[i].code));
        double normal[3] = {0, 0, 0};
        if ((w->row->needs & EFFECT_NORMALS) != 0)
            packed_normal(w, &at[i], normal);
        for (int k = 0; k < 3; k++)
            seen[i].normal[k] = (float)normal[k];
    }
    for (int k = 0; k < compared[w->row->taps].count; k++) {
        const effect_pixel *first = &seen[compared[w->row->taps].first[k]];
        const float one = w->row->shader(first, w->rounded, &seen[compared[w->row->taps].second[k]]);
        all = around ? all + one / CORNERS : fmaxf(all, one);
    }
    return all;
}

/* The same, exact for what is stored. */
double effect_corners_exact(const effect_work *w, uint32_t x) {
    const bool around = w->row->taps == EFFECT_AROUND, normals = (w->row->needs & EFFECT_NORMALS) != 0;
    tap at[TAPS];
    double all = 0;
    if (!taps_of(w, x, at))
        return (double)NAN;
    for (int k = 0; k < compared[w->row->taps].count; k++) {
        const tap *two[2] = {&at[compared[w->row->taps].first[k]], &at[compared[w->row->taps].second[k]]};
        effect_view view = {.setup = w->planes};
        double z[2];
        for (int i = 0; i < 2; i++) {
            z[i] = pixel_stored(w->camera, two[i]->column, two[i]->row, two[i]->code);
            if (normals && w->in->frame->normals != NULL)
                packed_normal(w, two[i], view.normals[i]);
            else if (normals)
                memcpy(view.normals[i], hit_of(w, two[i]).normal, sizeof view.normals[i]);
        }
        const double one = w->row->output(&view, w->parameters, z[0], z[1]);
        all = around ? all + one / CORNERS : fmax(all, one);
    }
    return all;
}

/* How far |x| + |y| of a normal may be off: what packing it lost, and what it was off before. */
static double normal_reach(const effect_work *w, const tap *at) {
    const frame_normals *normals = w->in->frame->normals;
    const size_t pixel = pixel_of(w, at);
    const double off = normals->off != NULL ? normals->off[pixel] * DP_DEGREE / FRAME_NORMAL_DEGREE : 0;
    return packing_normal_reach(normals->texels + 2 * pixel, normals->truncated) + M_SQRT2 * 2 * dp_sin(off / 2);
}

/* The span of |x| + |y| between two normals that an image leaves open: views whose normals differ least and most. */
static void views_between(const effect_work *w, const tap *a, const tap *b, effect_view views[2]) {
    double one[3], two[3];
    views[0] = views[1] = (effect_view){.setup = w->planes};
    if ((w->row->needs & EFFECT_NORMALS) == 0)
        return;
    packed_normal(w, a, one);
    packed_normal(w, b, two);
    const double turned = fabs(one[0] - two[0]) + fabs(one[1] - two[1]);
    const double reach = normal_reach(w, a) + normal_reach(w, b);
    views[0].normals[0][0] = fmax(turned - reach, 0);
    views[1].normals[0][0] = turned + reach;
}

/* Whether an output can be, and must be, 1 when two depths lie where their samples allow: it depends on how far apart
 * they are, which is decided at the ends, or where they are the same. */
static void outputs_between(const effect_work *w, const tap *a, const tap *b, double out[2]) {
    const grain_range one = pixel_range_of(w->camera, w->in->frame->grain, a->column, a->row, a->code);
    const grain_range two = pixel_range_of(w->camera, w->in->frame->grain, b->column, b->row, b->code);
    const bool around = w->row->taps == EFFECT_AROUND;
    const double same = fmax(one.lo, two.lo), wanted = w->parameters[w->row->wanted];
    const double pairs[3][2] = {{one.lo, two.hi}, {one.hi, two.lo}, {same, same}};
    const int count = same <= fmin(one.hi, two.hi) ? 3 : 2;
    effect_view views[2];
    views_between(w, a, b, views);
    out[0] = 1;
    out[1] = around && one.lo - two.hi <= wanted && one.hi - two.lo > wanted; /* it is 1 right above */
    for (int k = 0; k < count; k++)
        for (int i = 0; i < 2; i++) {
            const double output = w->row->output(&views[i], w->parameters, pairs[k][0], pairs[k][1]);
            out[0] = fmin(out[0], output);
            out[1] = fmax(out[1], output);
        }
}

static void outputs_of(const effect_work *w, const tap *a, const tap *b, double out[2]) {
    if (w->in->frame->synthetic == NULL) {
        outputs_between(w, a, b, out);
        return;
    }
    const synthetic_hit hits[2] = {hit_of(w, a), hit_of(w, b)};
    effect_view view = {.setup = w->planes};
    for (int i = 0; i < 2; i++)
        memcpy(view.normals[i], hits[i].normal, sizeof view.normals[i]);
    out[0] = out[1] = w->row->output(&view, w->parameters, hits[0].z, hits[1].z);
}

/* The error of an effect of corners: in a synthetic image the true one, in an image the largest possible. */
double effect_corners_error(const effect_work *w, uint32_t x) {
    tap at[TAPS];
    const bool around = w->row->taps == EFFECT_AROUND;
    const float seen = effect_corners(w, x);
    double all[2] = {0, 0};
    if (isnan(seen) || !taps_of(w, x, at))
        return NAN;
    for (int k = 0; k < compared[w->row->taps].count; k++) {
        double one[2];
        outputs_of(w, &at[compared[w->row->taps].first[k]], &at[compared[w->row->taps].second[k]], one);
        for (int i = 0; i < 2; i++)
            all[i] = around ? all[i] + one[i] / CORNERS : fmax(all[i], one[i]);
    }
    return EFFECT_LEVELS * fmax(fabs((double)seen - all[0]), fabs((double)seen - all[1]));
}
