/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Within the room: a light's map at one depth, where all that is looked at is linear. */
#ifndef SHADOW_GROUND_H
#define SHADOW_GROUND_H

#include "core/elementary.h"
#include "shadow/shadow.h"

#define SHADOW_HALF_TURN 3.14159265358979323846

static inline double shadow_radians(double degrees) {
    return degrees * DP_DEGREE;
}

/* Positions are of scene units, sizes of texels, depths of window depth. */
typedef struct ground {
    double depth;            /* scene units that are a window depth of 1, at this depth */
    double texel_x, texel_y; /* scene units */
    double diagonal;         /* of a texel, scene units */
    double size, reach;      /* of the map, the longer side; and of triangles, texels */
    double box;              /* of a triangle's box over twice its area, at most */
    double most;             /* the greatest window depth of a vertex */
    double turn;             /* how far the rounding of the light's matrix turns the light, radians */
    double vertex, point;    /* a window position of either: its error on each axis, texels */
    double vertex_depth, point_depth;
    double placed, placed_depth; /* what the rounding of a vertex's position is on each axis, texels, and in depth */
    double moved, moved_depth;   /* the same of a vertex, a point and a point moved along the normal together */
    double interpolated;         /* of distances that a fragment shader writes: what the interpolation adds */
    double second;               /* a factor for terms of second order, beside that of all maps */
    double z, pitch;             /* of a light that has a place: the depth; a texel at depth 1. 0 of the sun */
    double corner;               /* the angle of the ray to a corner of the map to the axis, radians */
    double cone;                 /* the same, but a right angle where lookups leave a face of a cube */
} ground;

/* A light that has a place: receivers at z. */
ground shadow_ground_at(const shadow_light *light, double z);

/* The change of depth over a diagonal of a texel at that slant, in diagonals: its tangent, but where depth is z and the
 * light has a place: there rays lean, too. Radians. */
double shadow_lean(const shadow_light *light, const ground *g, double slant);

/* Fills in the parts. Returns the texels on each axis by which a stored depth may belong to another place. */
double shadow_texels(const shadow_light *light, const ground *g, shadow_part part[SHADOW_CAUSE_COUNT]);

/* Where a bias must be largest: the nearest receivers, of distances the farthest. */
double shadow_hardest(const shadow_light *light);

#endif
