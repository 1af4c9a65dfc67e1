/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "raster/draw_class.h"

#include <math.h>
#include <string.h>

#include "core/elementary.h"
#include "core/engine.h"
#include "raster/model.h"

enum { FINEST = 8 };

static const raster_model model = {.span = raster_snapped_span, .depths = raster_swiftshader_depths};

static const raster_row by_class = {"the rules of the guarantee",
                                    NULL,
                                    "vertices on the grid of the class, the plane of a vertex",
                                    "depthprec(7)",
                                    FINEST,
                                    false,
                                    FINEST,
                                    DP_ANCHOR_VERTEX,
                                    RASTER_CLIP_ANY,
                                    "d = (Z0 + (y - Y0) B) + (x - X0) A",
                                    &model,
                                    NULL,
                                    NULL};

bool draw_is_class(const draw_camera *camera) {
    return camera->target.row == &by_class;
}

/* Whether the pipeline makes the depth of vertices from a matrix, and interpolates it. */
static bool is_affine(const draw_camera *camera) {
    return camera->setup.spec.ortho || camera->setup.curve == DP_CURVE_PERSPECTIVE;
}

static bool is_per_vertex(const draw_camera *camera) {
    return dp_mapping_get(camera->setup.spec.mapping)->written == DP_WRITTEN_BY_VERTEX;
}

raster_status draw_class_init(draw_camera *camera, const dp_setup *setup) {
    const dp_triangles *view = &setup->spec.triangles;
    if (view->width < 1 || view->width > RASTER_SIZE_MAX || view->height < 1 || view->height > RASTER_SIZE_MAX)
        return RASTER_TARGET;
    camera->setup = *setup;
    camera->target =
        (raster_target){&by_class, view->width, view->height, setup->spec.format, dp_path_best(), 0.0F, 1.0F, 0.0F};
    return !is_affine(camera) || dp_pipeline_init(&camera->pipeline, setup) == DP_OK ? RASTER_OK : RASTER_MODEL;
}

/* Window depth as a vertex has it, or what stands for the depth that a fragment writes. */
static float value_at(const draw_camera *camera, float z) {
    return is_affine(camera)       ? dp_pipeline_window(&camera->pipeline, z)
           : is_per_vertex(camera) ? (float)dp_window(&camera->setup, (double)z)
                                   : (float)camera->setup.spec.znear / z;
}

/* The code of what was interpolated. */
static uint32_t code_of(const draw_camera *camera, float value) {
    const dp_setup *setup = &camera->setup;
    const float znear = (float)setup->spec.znear, depth = fminf(fmaxf(value, 0.0F), 1.0F);
    return is_affine(camera)       ? dp_pipeline_convert(&camera->pipeline, value)
           : is_per_vertex(camera) ? dp_format_encode(&setup->spec.format, setup->spec.rounding, (double)depth)
                                   : dp_code(setup, (double)(znear / value));
}

/* A coordinate on the grid, from the centre of pixel 0. */
static int32_t on_grid(double clip, double w, int size, int bits) {
    return (int32_t)rint(ldexp(0.5 * size * (1.0 + clip / w) - 0.5, bits));
}

raster_status draw_class_set_up(const draw_camera *camera, const double place[3][3], raster_triangle *drawn) {
    const raster_target *target = &camera->target;
    raster_piece *piece = &drawn->piece[0];
    float value[3];
    *piece = (raster_piece){.corners = 3, .bits = camera->setup.spec.triangles.subpixel};
    if (piece->bits == 0)
        piece->bits = FINEST;
    for (int i = 0; i < 3; i++) {
        const float z = (float)place[i][2], w = camera->setup.spec.ortho ? 1.0F : z;
        if (!isfinite(z) || !(w > 0.0F))
            return RASTER_VERTEX;
        piece->x[i] = on_grid((double)(camera->p00 * (float)place[i][0]), (double)w, target->width, piece->bits);
        piece->y[i] = on_grid((double)(camera->p11 * (float)place[i][1]), (double)w, target->height, piece->bits);
        value[i] = value_at(camera, z);
    }
    const float pixel = (float)ldexp(1.0, -piece->bits);
    const float x1 = (float)(piece->x[1] - piece->x[0]) * pixel, x2 = (float)(piece->x[2] - piece->x[0]) * pixel;
    const float y1 = (float)(piece->y[1] - piece->y[0]) * pixel, y2 = (float)(piece->y[2] - piece->y[0]) * pixel;
    const float z1 = value[1] - value[0], z2 = value[2] - value[0];
    const float area = x1 * y2 - x2 * y1, d = 1.0F / area;
    piece->plane = (raster_plane){(y2 * z1 - y1 * z2) * d, (x1 * z2 - x2 * z1) * d, value[0],
                                  (float)piece->x[0] * pixel, (float)piece->y[0] * pixel};
    drawn->count = area != 0.0F && raster_snapped_rows(target, piece) ? 1 : 0;
    return drawn->count > 0 ? RASTER_OK : RASTER_EMPTY;
}

void draw_class_convert(const draw_camera *camera, const float *depth, int count, uint32_t *code) {
    const dp_format *format = &camera->setup.spec.format;
    const bool as_it_is = is_affine(camera) && dp_format_is_fp32(format);
    for (int i = 0; i < count && !as_it_is; i++)
        code[i] = code_of(camera, depth[i]);
    if (as_it_is)
        memcpy(code, depth, (size_t)count * sizeof *code);
}

void draw_class_codes(const draw_camera *camera, const raster_piece *piece, int y, int from, int to, uint32_t *code) {
    float depth[DRAW_ROW];
    for (int x = from, count; x < to; x += count) {
        count = to - x < DRAW_ROW ? to - x : DRAW_ROW;
        raster_depths(&camera->target, piece, y, x, x + count, depth);
        draw_class_convert(camera, depth, count, code + (x - from));
    }
}
