/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file slanted.h  Random cameras and pairs of parallel planes, a triangle of each, drawn about the same pixel. */
#ifndef TESTS_SLANTED_H
#define TESTS_SLANTED_H

#include <stdbool.h>

#include "depthprec/depthprec.h"
#include "raster/raster.h"
#include "support.h"
#include "world/world.h"

/** The rasterizer that draws them. */
typedef struct slanted_kind {
    const char *name;
    dp_anchor anchor; /**< none: an error of one rounding */
    int bits[2];      /**< of the grid, one or the other; negative: vertices are not snapped */
    const char *arith;
} slanted_kind;

typedef struct slanted_camera {
    float p00, p11, a, b;
    int width, height, bits;
    bool reciprocal;
} slanted_camera;

/** View and projection as they reach the vertices: rows of clip x, y, z and w, rounded; where there is no world,
 * unused.
 */
typedef struct slanted_world {
    dp_budget_terms terms; /**< world 0: eye space is given */
    float row[4][4];
    double eye[3];
    int order[4];
    bool paired, fused;
    const world_scheme *scheme; /* in place of the rows: how places come before `seen_by`; null: not at all */
    world_camera seen_by;
    double distance;     /* of the camera from the origin, at most */
    double origin[2][3]; /* of the meshes that the triangles are of */
    bool shared_origin;
    double shift[3];  /* where the pixel's place of the farther plane is seen, less where it is */
    double ray_ratio; /* no vertex is farther away than this times its depth */
} slanted_world;

typedef struct slanted {
    const slanted_kind *kind;
    slanted_world world;
    dp_setup setup;
    slanted_camera camera;
    dp_triangles class;  /**< of the two triangles themselves */
    double n[3], px, py; /**< normal and pixel */
    double c, z;         /**< of the farther plane: distance along the normal, and depth where the order is asked */
    double at[2][3][2];  /**< where vertices are seen: of the nearer plane, of the farther one */
    raster_clipping cut; /**< what becomes of triangles that sides of the screen cut; any: there are none */
} slanted;

/** Draws camera, format and viewport; false when the format's name is none. */
bool slanted_draw_camera(rng *r, slanted *s, const slanted_kind *kind, const char *format);
/** Draws the depth range of its viewport, after the camera. */
void slanted_draw_range(rng *r, slanted *s);
/** Draws normal, pixel, depth and the places of vertices; false when the farther plane is not seen there. */
bool slanted_draw_planes(rng *r, slanted *s);

/**
 * Draws a camera in a world about the planes. Depths and planes are then those that the rounded matrix makes of places.
 */
void slanted_draw_world(rng *r, slanted *s);

/**
 * Draws a camera in a world about the planes, and meshes. Depths and planes are where they are seen; the guarantee is
 * that of where they are. False when that is not between the planes of the camera.
 */
bool slanted_draw_scheme(rng *r, slanted *s, const world_scheme *scheme);

/** Whether they come from a world, so that vertices are not drawn exactly where they were put. */
bool slanted_is_moved(const slanted *s);

/** Depth times this is the plane's distance along its normal: the normal along the ray of a place on the screen. */
double slanted_along(const slanted *s, double x, double y);

/**
 * Makes the class that of the triangles, the planes being c[0] and c[1] away along the normal.
 *
 * @return false when they are in no class
 */
bool slanted_fit(slanted *s, const double c[2]);
/** The height of a triangle on the screen upon its longest edge, pixels. */
double slanted_height(const double v[3][2]);
/** Whether a triangle on the screen is no wider, higher and slimmer than the class says. */
bool slanted_in_class(const slanted *s, const double at[3][2]);
/** The guarantee at depth z for triangles of a class, in its world. */
bool slanted_budget(const slanted *s, const dp_triangles *class, dp_budget *out);

/** The class of planes a share of the guarantee at z apart; that, and the distance of the nearer plane. */
bool slanted_apart(slanted *s, double share, dp_budget *guarantee, double *nearer);

/** Clip coordinates of a triangle whose plane is c away; false when a vertex is not from near to far. */
bool slanted_clip(const slanted *s, int which, double c, raster_vertex clip[3]);
/** Whether all vertices are in the frustum, so that no rasterizer clips; or only from near to far. */
bool slanted_inside(const raster_vertex v[3]);
bool slanted_in_depth(const raster_vertex v[3]);

#endif
