/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The steps that the rows of raster.c choose from: what makes one rasterizer differ from another. */
#ifndef RASTER_MODEL_H
#define RASTER_MODEL_H

#include "core/bits.h"
#include "raster/raster.h"

/* A vertex in window coordinates, pixels. */
typedef struct raster_point {
    float x, y, z;
} raster_point;

/* Depths of the pixels `from` to `to` - 1 of a row. */
typedef void raster_depth_loop(const raster_plane *plane, int y, int from, int to, float *depth);

typedef struct raster_model {
    /* Clips, and makes the pieces. */
    raster_status (*draw)(const raster_target *target, const raster_vertex vertex[3], raster_triangle *drawn);
    /* Mesa: the plane and the edges of one piece. */
    raster_status (*piece)(const raster_target *target, const raster_point point[3], raster_piece *piece);
    bool fused;      /* Mesa: window positions of the vertices given are scaled and moved by one fma */
    bool last_leads; /* Mesa: a triangle takes its flat colours from its last vertex, as in OpenGL */
    bool (*span)(const raster_target *target, const raster_piece *piece, int y, int *from, int *to);
    raster_depth_loop *const *depths; /* by path */
    void (*unorm)(const float *depth, int count, float scale, uint32_t *code);
    /* 16-bit codes stepped along a run; null where each is converted. */
    void (*stepped)(const raster_target *target, const raster_piece *piece, int y, int from, int to, uint32_t *code);
    bool no_unorm24;
} raster_model;

/* ---- mesa.c, swiftshader.c ---- */

raster_status raster_mesa_draw(const raster_target *target, const raster_vertex vertex[3], raster_triangle *drawn);
raster_status raster_llvmpipe_piece(const raster_target *target, const raster_point point[3], raster_piece *piece);
raster_status raster_softpipe_piece(const raster_target *target, const raster_point point[3], raster_piece *piece);
bool raster_softpipe_span(const raster_target *target, const raster_piece *piece, int y, int *from, int *to);
void raster_softpipe_stepped(const raster_target *target, const raster_piece *piece, int y, int from, int to,
                             uint32_t *code);
raster_status raster_swiftshader_draw(const raster_target *target, const raster_vertex vertex[3],
                                      raster_triangle *drawn);

/* ---- snapped.c: convex polygons on a grid ---- */

/* The rows of a piece, from its snapped corners; false when there are none. */
bool raster_snapped_rows(const raster_target *target, raster_piece *piece);
bool raster_snapped_span(const raster_target *target, const raster_piece *piece, int y, int *from, int *to);

/* ---- pixels.c ---- */

extern raster_depth_loop *const raster_llvmpipe_depths[DP_PATH_COUNT];
extern raster_depth_loop *const raster_softpipe_depths[DP_PATH_COUNT];
extern raster_depth_loop *const raster_swiftshader_depths[DP_PATH_COUNT];
void raster_unorm_even(const float *depth, int count, float scale, uint32_t *code);
void raster_unorm_zero(const float *depth, int count, float scale, uint32_t *code);

/* Whether no pixel of the target, nor of the quads that reach beyond it, overflows. */
bool raster_plane_finite(const raster_target *target, const raster_plane *plane);

/* a b + c, rounded once, without the instruction for it: the sum is rounded to odd in double, then to binary32. */
DP_INLINE float raster_fma(float a, float b, float c) {
#if defined(__FP_FAST_FMAF)
    return __builtin_fmaf(a, b, c);
#else
    const double product = (double)a * (double)b;
    const double sum = product + (double)c;
    const double moved = sum - product;
    const double lost = (product - (sum - moved)) + ((double)c - moved);
    const uint64_t bits = dp_bits64(sum);
    if (lost == 0.0 || (bits & 1U) != 0)
        return (float)sum;
    return (float)dp_float64((lost > 0.0) == (sum > 0.0) ? bits + 1U : bits - 1U);
#endif
}

#endif
