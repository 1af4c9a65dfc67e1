/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file shadow_stage.h  A shadow map that a model of src/raster draws, texel by texel, and a point that is looked up in
 * it: every step in binary32, as shaders and APIs take it. Shares the answers of src/shadow alone, not how they are
 * found.
 */
#ifndef TESTS_SHADOW_STAGE_H
#define TESTS_SHADOW_STAGE_H

#include <stdbool.h>

#include "raster/raster.h"
#include "shadow/shadow.h"
#include "support.h"

typedef struct shadow_stage {
    shadow_light light;
    shadow_need need;
    raster_target target;
    const char *name;
    double axis[3][3], middle[3]; /* the light's right, up and forward; the box's middle in the world */
    float matrix[3][4];           /* clip x, y, z of a place */
    bool fused, in_shader;        /* products and sums; the bias taken off the point's depth */
    double n, f;                  /* planes */
    int px, py;                   /* the texel */
    double caster[3][3];          /* the triangle about it, in the light's space: x, y, depth */
    double raised;                /* how far before it the triangle stands, along the light: then it casts a shadow */
} shadow_stage;

/* A place where the surface is looked at, and the surface there: unit normal towards the light. */
typedef struct shadow_spot {
    double at[3], normal[3];
} shadow_spot;

/** A random orthonormal basis. */
void shadow_stage_turn(rng *r, double axis[3][3]);

/** The light's matrix, of axes, box and middle. */
void shadow_stage_matrix(shadow_stage *s);

/** Where a place of the map, in texels, lies in the light's space. */
void shadow_stage_place(const shadow_stage *s, double u, double v, double *x, double *y);

/** Depth and slope of the texel before any bias; false where the triangle does not cover it, or is clipped. */
bool shadow_stage_draw(const shadow_stage *s, float *depth, float *slope);

/**
 * Whether a point is lit with a share of a bias or, where an API is given, with the whole of it as that API adds it;
 * *judged where its lookup reads the texel.
 */
bool shadow_stage_lit(const shadow_stage *s, shadow_way way, double share, const bias_api *api,
                      const shadow_spot *point, float depth, float slope, bool *judged);

#endif
