/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file drawn.h  A bias on trial: planes drawn twice by a rasterizer of src/raster, once with the bias.
 *
 * Each plane has a random slant and depth and is drawn about a random pixel, as two meshes of random triangles of the
 * set-up's class, none lower than BIAS_DRAWN_LOWEST. A pixel that both cover fights where the biased one is stored no
 * nearer. The bias is added to the depth of a pixel as the API's row says, with its least r and, as slope, the greater
 * change from a pixel to the next that the rasterizer's own plane has.
 */
#ifndef BIAS_DRAWN_H
#define BIAS_DRAWN_H

#include "bias/bias.h"
#include "raster/mesh.h"

#define BIAS_DRAWN_LOWEST 1.25 /**< pixels: on the finest grid and off it at least one */

/** A plane, and the triangles of the layer below and of the biased one. */
typedef struct bias_pair {
    draw_plane plane;
    draw_mesh mesh[2];
    draw_area area;
    double slant; /**< the normal's angle to the view axis, degrees */
} bias_pair;

/** The drawing: buffers of one layer each. */
typedef struct bias_drawing {
    const draw_camera *camera;
    const dp_setup *setup; /**< that of the camera, with its class */
    const bias_state *state;
    double lo, hi; /**< eye depths that count, 0 < lo <= hi, hi finite */
    double slope;  /**< pixels count where the greater change of eye depth from one to the next is at most that, and
                        each plane has a pixel of just that; 0: planes at any slant */
    draw_buffer layer[2];
} bias_drawing;

/** A pixel of a pair. */
typedef struct bias_pixel {
    bool covered, fights;
    double z;             /**< eye depth of the plane */
    uint32_t code, moved; /**< of the layer below, and of the biased one */
} bias_pixel;

/** The outcome. */
typedef struct bias_drawn {
    uint64_t pixels, fights; /**< that both layers covered; of these those that fight */
    bias_pair pair;          /**< the one with the most fights; without any the first */
    uint64_t most;           /**< fights of that */
    int x, y;                /**< a pixel of it that fights, from the lower left; read where `fights` is not 0 */
    bias_pixel pixel;        /**< that */
} bias_drawn;

/** Makes room. @return false when out of memory; to be closed in any case */
bool bias_drawing_open(bias_drawing *d);
void bias_drawing_close(bias_drawing *d);

/** Draws a pair into both buffers. */
void bias_draw_pair(bias_drawing *d, const bias_pair *pair);

/** Pixel (x, y) of the pair that was drawn, inside its area. */
bias_pixel bias_pixel_at(const bias_drawing *d, const bias_pair *pair, int x, int y);

/** Draws so many pairs: the same on every machine. */
bias_drawn bias_draw(bias_drawing *d, uint64_t count, uint64_t seed);

#endif
