/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file plan.h  What is drawn to find out: shots whose vertices tell one arithmetic from another. */
#ifndef PROBE_PLAN_H
#define PROBE_PLAN_H

#include "probe/shot.h"

/** The shots, each once per format that it is drawn in. */
typedef enum plan_shot {
    PLAN_STORED = 0, /**< two depths of one code, the second where it is equal */
    PLAN_ROUNDING,   /**< clip w 1, depths around the ties between codes */
    PLAN_DIVISION,
    PLAN_PROJECTION, /**< a z + b in the vertex shader */
    PLAN_PLANE,      /**< tiles: steep triangles, each moved by another part of a pixel */
    PLAN_COVERAGE,   /**< tiles: an edge beside centres of pixels, by another part of a pixel */
    PLAN_UNBIASED,   /**< tiles: flat triangles, and slanted ones */
    PLAN_CONSTANT,   /**< the same with a constant bias */
    PLAN_FRACTION,   /**< and one that is no whole number */
    PLAN_SLOPED,     /**< and with one by slope */
    PLAN_PLANES,     /**< depths at the near and far plane, and subnormal ones */
    PLAN_INVARIANCE, /**< two pipelines of one expression */
    PLAN_LOG2,
    PLAN_QUOTIENT,
    PLAN_SCENE,     /**< random triangles */
    PLAN_PREDICTED, /**< others, of the seed given */
    PLAN_SHOTS
} plan_shot;

enum {
    PLAN_TILE = 16, /**< pixels */
    PLAN_TILES = (SHOT_SIZE / PLAN_TILE) * (SHOT_SIZE / PLAN_TILE),
    PLAN_STEPS = 2048, /**< of a pixel, by which tiles of PLAN_PLANE are moved */
    PLAN_FLAT = 3,     /**< of four tiles without slope */
    PLAN_BIAS = 64     /**< constant of PLAN_CONSTANT; PLAN_FRACTION has 1/2 more */
};

#define PLAN_STEEP      0.05F /**< depth a pixel of PLAN_PLANE */
#define PLAN_LOG2_SCALE 0x1p-6F

/** Every shot in every format that it is for; `seed` is of PLAN_PREDICTED. @return false without memory */
bool plan_make(shot_plan *plan, uint64_t seed);

void plan_free(shot_plan *plan);

/** The shot of that kind and format; null where there is none. */
shot *plan_find(const shot_plan *plan, plan_shot kind, shot_format format);

/** The depth at the middle of a tile of PLAN_UNBIASED, its largest where it slants, and its slopes a pixel. */
typedef struct plan_tile {
    float z, slope_x, slope_y;
} plan_tile;
plan_tile plan_tile_of(shot_format format, int tile);

/** How far the edge of a tile of PLAN_COVERAGE lies beyond the centre, pixels: within 1/16, close to 0 in steps of
 * 1/8192, which clip coordinates still hold exactly. */
double plan_edge(int tile);

/** 1 of UNORM in codes; 0 of fp32. */
double plan_scale(shot_format format);

#endif
