/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file raster.h  Triangles as software rasterizers draw them: the depth of each pixel, bit for bit.
 *
 *     raster_target t;
 *     raster_triangle drawn;
 *     if (raster_target_init(&t, row, 1920, 1080, &format, dp_path_best()) == RASTER_OK &&
 *         raster_set_up(&t, vertices, &drawn) == RASTER_OK)
 *         for (int i = 0; i < drawn.count; i++)
 *             for (int y = drawn.piece[i].y0, x0, x1; y < drawn.piece[i].y1; y++)
 *                 if (raster_span(&t, &drawn.piece[i], y, &x0, &x1))
 *                     raster_codes(&t, &drawn.piece[i], y, x0, x1, code);
 *
 * Vertices are clip coordinates, clip z from 0 to w, viewport = target, its depth range 0 to 1 until
 * raster_target_range() says another, one sample a pixel, no culling, no bias. Window y grows with clip y; pixel (px,
 * py) has its centre at (px + 0.5, py + 0.5).
 *
 * Claim: all 52,655 pixels recorded of llvmpipe, lavapipe, softpipe and SwiftShader at 512 x 512, clipped ones
 * included, in each format that they have, are reproduced. Targets of 2048 x 2048 were measured in D32F.
 * Not modelled: subnormal numbers (hardware may flush them), and SwiftShader's 32-bit edges of targets above 2896.
 */
#ifndef RASTER_RASTER_H
#define RASTER_RASTER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "core/named.h"
#include "depthprec/arith.h"
#include "depthprec/batch.h"
#include "depthprec/format.h"
#include "depthprec/triangles.h"

enum {
    RASTER_SIZE_MAX = 16384, /**< largest width and height of a target, pixels */
    RASTER_CORNERS = 9,      /**< of a clipped triangle, at most: each of six planes may add one */
    RASTER_PIECES = RASTER_CORNERS - 2
};

typedef enum raster_status {
    RASTER_OK = 0,
    RASTER_EMPTY,  /**< no error: the triangle has no area, or clipping leaves nothing of it */
    RASTER_MODEL,  /**< the row is a specification, which says too little to draw with, or there is no such row */
    RASTER_TARGET, /**< width or height is not from 1 to RASTER_SIZE_MAX, or the path is not available */
    RASTER_FORMAT, /**< the rasterizer was not measured with this format: fp32, unorm24 and unorm16 were */
    RASTER_VERTEX, /**< a coordinate is infinite or not a number */
    RASTER_RANGE,  /**< the arithmetic leaves binary32, or a clipped vertex its fixed point: what is drawn is undefined
                    */
    RASTER_STATUS_COUNT
} raster_status;

/** One sentence without a full stop; any value is accepted. */
const char *raster_status_text(raster_status status);

/** The plane of depth of a triangle that is clipped. */
typedef enum raster_clipping {
    RASTER_CLIP_ANY = 0, /**< the implementation's choice */
    RASTER_CLIP_PIECES,  /**< new vertices; each piece of the fan has its own plane */
    RASTER_CLIP_KEEPS    /**< the plane of the unclipped vertices, even of those behind the eye */
} raster_clipping;

/** One rasterizer, or what a specification asks of all. */
typedef struct raster_row {
    NAMED_FIELDS;
    int subpixel_bits; /**< of coverage, as reported; of a specification: the least that it allows */
    bool at_least;     /**< the implementation may have more */
    int plane_bits;    /**< subpixel bits of the plane of depth; 0: its vertices are not snapped */
    dp_anchor anchor;  /**< and with it the most that the set-up adds; of a specification DP_ANCHOR_COUNT, free */
    raster_clipping clipping;
    const char *operations;           /**< of the depth of a pixel */
    const struct raster_model *model; /**< null of a specification */
    /** The arithmetic of its vertices and conversions, for dp_arith_parse(), and the same with [-1, 1] remapped in the
     *  vertex shader; null where none is known. */
    const char *arith, *remapped;
} raster_row;

NAMED_ROWS(raster_row, raster);

/**
 * Fills in `subpixel` and `plane`, what is known of a rasterizer: of a row whose anchor is free each term is that of
 * the anchor where it is largest, and of one that says "at least" the grid is the coarsest that it allows.
 */
void raster_describe(const raster_row *row, dp_triangles *triangles);

/** Its arithmetic, or that with [-1, 1] remapped in the vertex shader; false where none is known, *out is as it was. */
bool raster_arith(const raster_row *row, bool remapped, dp_arith *out);

/** Whether it draws into the format, with codes within the bound of triangles.h; false of specifications. */
bool raster_draws(const raster_row *row, const dp_format *format);

/** Whether codes of the format are within the bound of triangles.h: those that softpipe steps, unorm16, are not. */
bool raster_bounded(const raster_row *row, const dp_format *format);

/** Clip coordinates. */
typedef struct raster_vertex {
    float x, y, z, w;
} raster_vertex;

/** A target to draw into. Made by raster_target_init(); may be used by many threads at once. */
typedef struct raster_target {
    const raster_row *row;
    int width, height; /**< pixels */
    dp_format format;
    dp_path path;   /**< which instructions; all give the same bits */
    float scale;    /**< codes of d = 1; 0 of fp32 */
    float span, lo; /**< of the viewport: window depth is span times clip z / w, and lo */
} raster_target;

/** Depth over the target: a and b per pixel, and c at (x, y) where the row anchors it at a vertex, else at pixel 0. */
typedef struct raster_plane {
    float a, b, c, x, y;
} raster_plane;

/** A convex part of a triangle that has one plane. Rows y0 to y1 - 1 may have pixels. The rest is private. */
typedef struct raster_piece {
    raster_plane plane;
    int y0, y1;
    int corners, bits; /**< snapped corners, in 2^-bits pixels from the centre of pixel (0, 0) */
    int32_t x[RASTER_CORNERS], y[RASTER_CORNERS];
    float edge_x[3], edge_slope[3]; /**< unsnapped: the long edge, the lower and the upper one */
    int edge_y[3];
    bool long_left;
} raster_piece;

typedef struct raster_triangle {
    int count;
    raster_piece piece[RASTER_PIECES]; /**< in the order in which they are drawn */
} raster_triangle;

/**
 * Checks what is drawn into.
 *
 * @param row     index of the rasterizer
 * @param width   pixels, 1 to RASTER_SIZE_MAX; height likewise
 * @param format  fp32, unorm24 or unorm16; SwiftShader has no unorm24
 * @param path    one that dp_path_available()
 * @return RASTER_OK; RASTER_MODEL, RASTER_TARGET or RASTER_FORMAT and *target as it was
 */
raster_status raster_target_init(raster_target *target, size_t row, int width, int height, const dp_format *format,
                                 dp_path path);

/**
 * Sets the viewport's depth range: window depths of clip z = 0 and clip z = w, from 0 to 1, of either order; `span` is
 * their difference in binary32. Triangles are set up for it, and drawn, afterwards.
 */
void raster_target_range(raster_target *target, float lo, float hi);

/**
 * Clips a triangle and sets up the plane and the edges of each piece.
 *
 * SwiftShader has 32-bit positions in 1/16 pixel, from binary32 numbers: beyond 2^20 pixels they are coarser, and two
 * vertices 2^27 pixels apart, one 6.7e7 to the left and one as far to the right, differ by what wraps: the depths have
 * nothing to do with the triangle then. Both are reproduced as they are.
 *
 * @return RASTER_OK with *drawn filled in; RASTER_EMPTY, RASTER_VERTEX or RASTER_RANGE and drawn->count 0
 */
raster_status raster_set_up(const raster_target *target, const raster_vertex vertex[3], raster_triangle *drawn);

/** Whether a piece covers pixels of row y, any number: those from *from to *to - 1, inside the target. */
bool raster_span(const raster_target *target, const raster_piece *piece, int y, int *from, int *to);

/** Depths of the pixels `from` to `to` - 1 of row y, all inside the target, before the format rounds them. */
void raster_depths(const raster_target *target, const raster_piece *piece, int y, int from, int to, float *depth);

/** The samples that are stored of such depths, each converted by itself. */
void raster_convert(const raster_target *target, const float *depth, int count, uint32_t *code);

/**
 * The stored codes of the same pixels; of fp32 the bits of the depth. softpipe steps 16-bit codes from the first quad
 * of two rows that is drawn: outside what raster_span() covers there are no such codes, and those given mean nothing.
 */
void raster_codes(const raster_target *target, const raster_piece *piece, int y, int from, int to, uint32_t *code);

#endif
