/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The rasterizers, a row each, and the way into them. */
#include "raster/raster.h"

#include <math.h>
#include <string.h>
#include <strings.h>

#include "raster/model.h"

static const raster_model llvmpipe = {
    .draw = raster_mesa_draw,
    .piece = raster_llvmpipe_piece,
    .fused = true,
    .last_leads = true,
    .span = raster_snapped_span,
    .depths = raster_llvmpipe_depths,
    .unorm = raster_unorm_even,
};

static const raster_model lavapipe = {
    .draw = raster_mesa_draw,
    .piece = raster_llvmpipe_piece,
    .fused = true,
    .span = raster_snapped_span,
    .depths = raster_llvmpipe_depths,
    .unorm = raster_unorm_even,
};

static const raster_model softpipe = {
    .draw = raster_mesa_draw,
    .piece = raster_softpipe_piece,
    .last_leads = true,
    .span = raster_softpipe_span,
    .depths = raster_softpipe_depths,
    .unorm = raster_unorm_zero,
    .stepped = raster_softpipe_stepped,
};

static const raster_model swiftshader = {
    .draw = raster_swiftshader_draw,
    .span = raster_snapped_span,
    .depths = raster_swiftshader_depths,
    .unorm = raster_unorm_even,
    .no_unorm24 = true,
};

#define MESA_SOURCE "stored codes of Mesa 22.3.6, slanted triangles, CPU with FMA; in fp32 25.0.7 stores the same"

/* clang-format off */
static const raster_row rows[] = {
    {"llvmpipe", NULL, "Mesa's OpenGL in software: coverage on 1/256 pixel, the plane of the unsnapped vertices",
     MESA_SOURCE, 8, false, 0, DP_ANCHOR_ORIGIN, RASTER_CLIP_PIECES,
     "d = fma(B, y, fma(A, x, C)), clamped; unorm to nearest even", &llvmpipe, "mesa", "mesa-remap"},
    {"lavapipe", NULL, "Mesa's Vulkan in software", MESA_SOURCE, 8, false, 0, DP_ANCHOR_ORIGIN, RASTER_CLIP_PIECES,
     "as llvmpipe; clockwise triangles and pieces in another order of vertices", &lavapipe, "mesa", "mesa-remap"},
    {"softpipe", NULL, "Mesa's reference rasterizer: nothing is snapped, whatever it reports", MESA_SOURCE, 4, false,
     0, DP_ANCHOR_ORIGIN_STEPPED, RASTER_CLIP_PIECES,
     "d = C + A x + B y of a quad's corner, + A, + B, not clamped; unorm truncated; unorm16 in steps of trunc(65535 A)",
     &softpipe, "softpipe", NULL},
    {"swiftshader", NULL,
     "Vulkan in software, as Chromium has it: coverage and plane on 1/16 pixel, from the vertex of "
     "the largest w; beyond 6.7e7 pixels its 32-bit positions wrap",
     "stored codes of SwiftShader 5.0.0 (Chromium 156), slanted triangles", 4, false, 4, DP_ANCHOR_VERTEX,
     RASTER_CLIP_KEEPS, "d = (Z0 + (y - Y0) B) + (x - X0) A, clamped; unorm to nearest even", &swiftshader, "mesa",
     "mesa-remap"},
    {"spec-d3d", NULL, "what Direct3D asks for: vertices on exactly 1/256 pixel",
     "D3D 11.3 functional specification 3.4.1", 8, false, 8, DP_ANCHOR_COUNT, RASTER_CLIP_ANY, "", NULL, NULL, NULL},
    {"spec-vulkan", NULL, "what Vulkan asks for: at least 4 bits, see subPixelPrecisionBits",
     "Vulkan specification, Required Limits", 4, true, 4, DP_ANCHOR_COUNT, RASTER_CLIP_ANY, "", NULL, NULL, NULL},
    {"spec-gl", NULL, "what OpenGL asks for: at least 4 bits, see GL_SUBPIXEL_BITS",
     "OpenGL 4.6 core profile, table of implementation dependent values", 4, true, 4, DP_ANCHOR_COUNT,
     RASTER_CLIP_ANY, "", NULL, NULL, NULL},
};
/* clang-format on */

NAMED_TABLE(raster, rows);

bool raster_arith(const raster_row *row, bool remapped, dp_arith *out) {
    return dp_arith_parse(remapped ? row->remapped : row->arith, out) == DP_OK;
}

void raster_describe(const raster_row *row, dp_triangles *triangles) {
    dp_plane_error worst = {0};
    for (int i = 0; i < DP_ANCHOR_COUNT; i++) {
        const dp_plane_error *here = &dp_anchor_get((dp_anchor)i)->plane;
        if (row->anchor != DP_ANCHOR_COUNT && row->anchor != (dp_anchor)i)
            continue;
        worst = (dp_plane_error){fmax(worst.value, here->value), fmax(worst.box, here->box),
                                 fmax(worst.range, here->range), fmax(worst.origin, here->origin)};
    }
    triangles->subpixel = row->plane_bits;
    triangles->plane = worst;
}

bool raster_bounded(const raster_row *row, const dp_format *format) {
    return row->model == NULL || row->model->stepped == NULL || format->kind == DP_FORMAT_FLOAT || format->bits != 16;
}

const char *raster_status_text(raster_status status) {
    static const char *const texts[RASTER_STATUS_COUNT] = {
        [RASTER_OK] = "drawn",
        [RASTER_EMPTY] = "nothing of the triangle is drawn",
        [RASTER_MODEL] = "not a rasterizer whose arithmetic is known",
        [RASTER_TARGET] = "width and height must be from 1 to 16384, and the path one that this processor has",
        [RASTER_FORMAT] = "the rasterizer's format must be fp32, unorm24 or unorm16; swiftshader has no unorm24",
        [RASTER_VERTEX] = "vertices must be finite",
        [RASTER_RANGE] = "the triangle leaves the range of binary32",
    };
    return (unsigned)status < RASTER_STATUS_COUNT ? texts[status] : "not a status";
}

static bool has_format(const raster_model *model, const dp_format *format) {
    if (format == NULL)
        return false;
    if (format->kind == DP_FORMAT_FLOAT)
        return strcmp(format->name, "fp32") == 0;
    return format->bits == 16 || (format->bits == 24 && !model->no_unorm24);
}

bool raster_draws(const raster_row *row, const dp_format *format) {
    return row->model != NULL && has_format(row->model, format) && raster_bounded(row, format);
}

raster_status raster_target_init(raster_target *target, size_t row, int width, int height, const dp_format *format,
                                 dp_path path) {
    const raster_row *found = raster_get(row);
    if (found == NULL || found->model == NULL)
        return RASTER_MODEL;
    if (width < 1 || width > RASTER_SIZE_MAX || height < 1 || height > RASTER_SIZE_MAX || !dp_path_available(path))
        return RASTER_TARGET;
    if (!has_format(found->model, format))
        return RASTER_FORMAT;
    const float scale = format->kind == DP_FORMAT_FLOAT ? 0.0F : (float)format->code_max;
    *target = (raster_target){found, width, height, *format, path, scale, 1.0F, 0.0F};
    return RASTER_OK;
}

void raster_target_range(raster_target *target, float lo, float hi) {
    target->span = hi - lo;
    target->lo = lo;
}

raster_status raster_set_up(const raster_target *target, const raster_vertex vertex[3], raster_triangle *drawn) {
    drawn->count = 0;
    for (int i = 0; i < 3; i++)
        if (!isfinite(vertex[i].x) || !isfinite(vertex[i].y) || !isfinite(vertex[i].z) || !isfinite(vertex[i].w))
            return RASTER_VERTEX;
    const raster_status status = target->row->model->draw(target, vertex, drawn);
    if (status != RASTER_OK)
        drawn->count = 0;
    return status;
}

bool raster_span(const raster_target *target, const raster_piece *piece, int y, int *from, int *to) {
    return target->row->model->span(target, piece, y, from, to);
}

void raster_depths(const raster_target *target, const raster_piece *piece, int y, int from, int to, float *depth) {
    target->row->model->depths[target->path](&piece->plane, y, from, to, depth);
}

void raster_convert(const raster_target *target, const float *depth, int count, uint32_t *code) {
    if (target->format.kind == DP_FORMAT_FLOAT)
        memcpy(code, depth, (size_t)count * sizeof *code);
    else
        target->row->model->unorm(depth, count, target->scale, code);
}

void raster_codes(const raster_target *target, const raster_piece *piece, int y, int from, int to, uint32_t *code) {
    enum { SOME = 256 };
    const raster_model *model = target->row->model;
    float depth[SOME];
    if (!raster_bounded(target->row, &target->format)) {
        model->stepped(target, piece, y, from, to, code);
        return;
    }
    for (int x = from, count; x < to; x += count, code += count) {
        count = to - x < SOME ? to - x : SOME;
        raster_depths(target, piece, y, x, x + count, depth);
        raster_convert(target, depth, count, code);
    }
}
