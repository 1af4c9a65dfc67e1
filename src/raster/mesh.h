/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file mesh.h  A plane drawn as a mesh of random triangles: a grid on the screen whose vertices are moved. */
#ifndef RASTER_MESH_H
#define RASTER_MESH_H

#include "raster/draw.h"

/** The next of splitmix64's numbers, and one of [0, 1): the same on every machine. */
uint64_t draw_random(uint64_t *state);
double draw_uniform(uint64_t *state);

/** Between two positive numbers, each ratio with equal chance. */
double draw_log_uniform(uint64_t *state, double lo, double hi);

/** In window coordinates, pixels: vertex (i, k) lies about corner + i side[0] + k side[1], up to a quarter off. */
typedef struct draw_mesh {
    double corner[2], side[2][2];
    int cells[2];  /**< along each side; each is parted into two triangles, by either diagonal */
    uint64_t seed; /**< of the vertices' moves and of the diagonals */
    double lowest; /**< triangles of a smaller height are not drawn, pixels */
} draw_mesh;

/**
 * A random one about a place of the window, which lies anywhere in the middle of its 4 x 4 cells. These are from two
 * pixels to half the widest triangle wide, up to half as slim as the class lets them be, and turned.
 */
draw_mesh draw_mesh_random(const dp_triangles *class, const double window[2], uint64_t *state);

enum { DRAW_MESH_REACH = 64, DRAW_MESH_ROOM = (2 * DRAW_MESH_REACH + 1) * (2 * DRAW_MESH_REACH + 1) };

/** The area about a pixel as far as the larger of two such meshes reaches, and no farther than DRAW_MESH_REACH. */
draw_area draw_mesh_area(const draw_camera *camera, int x, int y, const draw_mesh mesh[2]);

/** The window coordinates of one of the two triangles of a cell: half 0 or 1. */
void draw_mesh_corners(const draw_mesh *mesh, int i, int k, int half, double window[3][2]);

/** The shape of a triangle at most, wherever its vertices lie within half a step of the grid, as dp_triangles has it.
 */
typedef struct draw_shape {
    double pixels, slim; /**< infinite where it may have no area */
} draw_shape;

/**
 * For the window coordinates of its vertices, pixels, and bits of the grid. Each vertex moves by m at most on either
 * axis, half a step of the grid and 2^-8 pixel for what binary32 rounds before; without bits 1/16 and that. A side
 * becomes 2 sqrt(2) m longer at most, and twice the area smaller by m times the sides' extents on both axes and 4 m^2.
 */
draw_shape draw_shape_of(const double v[3][2], int subpixel);

/**
 * Draws a plane as the mesh's triangles, but for those that lie outside a class of triangles, have a vertex outside
 * the view, or are too near edge-on to have a depth.
 * @param class  null: any triangle. Its `depth` is, of a perspective, taken of all pixels inside a triangle, up to
 * `across` pixels beyond its edges, and its pixels and shape with what the subpixel grid may move; see dp_triangles
 * @return how many were drawn
 */
int draw_mesh_plane(draw_buffer *buffer, const draw_camera *camera, const draw_plane *plane, const draw_mesh *mesh,
                    const dp_triangles *class, unsigned who);

#endif
