/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "raster/draw.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/bits.h"
#include "core/elementary.h"
#include "raster/draw_class.h"

/* ---- The camera -------------------------------------------------------------------------------------------------- */

raster_status draw_camera_init(draw_camera *camera, const raster_row *row, const dp_setup *setup) {
    const dp_triangles *view = &setup->spec.triangles;
    const double half = dp_half_tangent(view->fov_y);
    size_t index = 0;
    camera->bias = NULL;
    camera->bias_of = NULL;
    camera->p11 = (float)(1.0 / half);
    camera->p00 = (float)(view->height / (half * view->width));
    if (row == NULL)
        return draw_class_init(camera, setup);
    while (raster_get(index) != NULL && raster_get(index) != row)
        index++;
    const raster_status status =
        raster_target_init(&camera->target, index, view->width, view->height, &setup->spec.format, dp_path_best());
    if (status != RASTER_OK)
        return status;
    if (dp_pipeline_init(&camera->pipeline, setup) != DP_OK ||
        (camera->pipeline.ndc_signed && !camera->pipeline.arith->remap))
        return RASTER_MODEL;
    raster_target_range(&camera->target, (float)setup->spec.depth_range[0], (float)setup->spec.depth_range[1]);
    return RASTER_OK;
}

void draw_ray(const draw_camera *camera, const double window[2], double ray[3]) {
    ray[0] = (2.0 * window[0] / camera->target.width - 1.0) / (double)camera->p00;
    ray[1] = (2.0 * window[1] / camera->target.height - 1.0) / (double)camera->p11;
    ray[2] = 1.0;
}

bool draw_is_ortho(const draw_camera *camera) {
    return draw_is_class(camera) ? camera->setup.spec.ortho != 0 : camera->pipeline.ortho != 0;
}

void draw_at(const draw_camera *camera, const double window[2], double z, double place[3]) {
    const double along = draw_is_ortho(camera) ? 1.0 : z;
    draw_ray(camera, window, place);
    place[0] *= along;
    place[1] *= along;
    place[2] = z;
}

double draw_depth(const draw_camera *camera, const draw_plane *plane, const double window[2]) {
    const double *n = plane->normal;
    double place[3];
    draw_at(camera, window, draw_is_ortho(camera) ? 0.0 : 1.0, place);
    const double across = n[0] * place[0] + n[1] * place[1];
    const double facing = draw_is_ortho(camera) ? n[2] : across + n[2];
    return !(facing > 0.0)         ? (double)NAN
           : draw_is_ortho(camera) ? (plane->distance - across) / facing
                                   : plane->distance / facing;
}

double draw_facing(const draw_camera *camera, const draw_plane *plane, const double window[2]) {
    double ray[3];
    draw_ray(camera, window, ray);
    return plane->normal[0] * ray[0] + plane->normal[1] * ray[1] + plane->normal[2] * ray[2];
}

raster_vertex draw_clip(const draw_camera *camera, const double place[3]) {
    const float x = (float)place[0], y = (float)place[1], z = (float)place[2];
    return (raster_vertex){camera->p00 * x, camera->p11 * y, dp_pipeline_clip(&camera->pipeline, z),
                           camera->pipeline.ortho ? 1.0F : z};
}

/* ---- The buffer -------------------------------------------------------------------------------------------------- */

bool draw_buffer_open(draw_buffer *buffer, size_t room) {
    *buffer = (draw_buffer){
        .key = malloc(room * sizeof *buffer->key), .winner = malloc(room), .seen = malloc(room), .room = room};
    if (buffer->key != NULL && buffer->winner != NULL && buffer->seen != NULL)
        return true;
    draw_buffer_close(buffer);
    return false;
}

void draw_buffer_close(draw_buffer *buffer) {
    free(buffer->key);
    free(buffer->winner);
    free(buffer->seen);
    *buffer = (draw_buffer){0};
}

void draw_buffer_clear(draw_buffer *buffer, draw_area area) {
    const size_t count = (size_t)area.width * (size_t)area.height;
    buffer->area = area;
    memset(buffer->key, 0xFF, count * sizeof *buffer->key);
    memset(buffer->winner, DRAW_NOBODY, count);
    memset(buffer->seen, 0, count);
}

/* Who draws into what. */
typedef struct drawing {
    draw_buffer *buffer;
    unsigned who;
} drawing;

/* Turns the codes of a span into keys for the test, never that of an empty pixel. Depths may be below 0. */
static void keys_of(const draw_camera *camera, int count, uint32_t *code) {
    const bool by_class = draw_is_class(camera);
    const uint32_t most = camera->target.format.code_max;
    const bool is_float = camera->target.format.kind == DP_FORMAT_FLOAT && !by_class;
    const bool reversed = by_class ? camera->setup.reversed != 0 : camera->pipeline.reversed != 0;
    for (int i = 0; i < count && is_float; i++)
        code[i] = reversed ? ~dp_rank32(dp_float32(code[i])) : dp_rank32(dp_float32(code[i]));
    for (int i = 0; i < count && !is_float && reversed; i++)
        code[i] = most - code[i];
}

uint32_t draw_code(const draw_camera *camera, uint32_t key) {
    const bool by_class = draw_is_class(camera);
    const bool reversed = by_class ? camera->setup.reversed != 0 : camera->pipeline.reversed != 0;
    if (by_class || camera->target.format.kind == DP_FORMAT_UNORM)
        return reversed ? camera->target.format.code_max - key : key;
    return dp_bits32(dp_ranked32(reversed ? ~key : key));
}

static void test_depths(void *context, int x, int y, int count, const uint32_t *key) {
    const drawing *d = context;
    const draw_area *area = &d->buffer->area;
    const size_t at = (size_t)(y - area->y) * (size_t)area->width + (size_t)(x - area->x);
    uint32_t *stored = d->buffer->key + at;
    uint8_t *winner = d->buffer->winner + at, *seen = d->buffer->seen + at;
    const unsigned who = d->who;
    for (int i = 0; i < count; i++) {
        const bool nearer = key[i] < stored[i];
        stored[i] = nearer ? key[i] : stored[i];
        winner[i] = nearer ? (uint8_t)who : winner[i];
        seen[i] = (uint8_t)(seen[i] | 1U << (who - 1));
    }
}

bool draw_triangle(draw_buffer *buffer, const draw_camera *camera, const double place[3][3], unsigned who) {
    drawing d = {buffer, who};
    return draw_keys(camera, &buffer->area, place, test_depths, &d);
}

/* ---- Rows of pixels ---------------------------------------------------------------------------------------------- */

/* The bias is added as a fragment's depth leaves the rasterizer. */
static void biased_codes(const draw_camera *camera, const raster_piece *piece, int y, int from, int to, float bias,
                         uint32_t *code) {
    float depth[DRAW_ROW];
    raster_depths(&camera->target, piece, y, from, to, depth);
    for (int i = 0; i < to - from; i++)
        depth[i] = fminf(fmaxf(depth[i] + bias, 0.0F), 1.0F);
    if (draw_is_class(camera))
        draw_class_convert(camera, depth, to - from, code);
    else
        raster_convert(&camera->target, depth, to - from, code);
}

static void draw_row(const draw_camera *camera, const draw_area *area, const raster_piece *piece, int y, float bias,
                     draw_take *take, void *context) {
    uint32_t key[DRAW_ROW];
    int from, to;
    if (!raster_span(&camera->target, piece, y, &from, &to))
        return;
    from = from > area->x ? from : area->x;
    to = to < area->x + area->width ? to : area->x + area->width;
    for (int x = from, count; x < to; x += count) {
        count = to - x < DRAW_ROW ? to - x : DRAW_ROW;
        if (camera->bias != NULL)
            biased_codes(camera, piece, y, x, x + count, bias, key);
        else if (draw_is_class(camera))
            draw_class_codes(camera, piece, y, x, x + count, key);
        else
            raster_codes(&camera->target, piece, y, x, x + count, key);
        keys_of(camera, count, key);
        take(context, x, y, count, key);
    }
}

/* Each piece has the slope that it was set up with. */
static float bias_of(const draw_camera *camera, const raster_piece *piece, const double place[3][3]) {
    const float slope = fmaxf(fabsf(piece->plane.a), fabsf(piece->plane.b));
    float most = 0.0F;
    for (int i = 0; i < 3 && camera->bias != NULL; i++)
        most = fmaxf(most, dp_pipeline_window(&camera->pipeline, (float)place[i][2]));
    return camera->bias != NULL ? camera->bias(camera->bias_of, fminf(most, 1.0F), slope) : 0.0F;
}

bool draw_keys(const draw_camera *camera, const draw_area *area, const double place[3][3], draw_take *take,
               void *context) {
    raster_triangle drawn;
    raster_vertex clip[3];
    for (int i = 0; i < 3 && !draw_is_class(camera); i++)
        clip[i] = draw_clip(camera, place[i]);
    if ((draw_is_class(camera) ? draw_class_set_up(camera, place, &drawn)
                               : raster_set_up(&camera->target, clip, &drawn)) != RASTER_OK)
        return false;
    for (int i = 0; i < drawn.count; i++) {
        const raster_piece *piece = &drawn.piece[i];
        const int first = piece->y0 > area->y ? piece->y0 : area->y;
        const int end = piece->y1 < area->y + area->height ? piece->y1 : area->y + area->height;
        const float bias = bias_of(camera, piece, place);
        for (int y = first; y < end; y++)
            draw_row(camera, area, piece, y, bias, take, context);
    }
    return true;
}
