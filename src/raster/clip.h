/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Triangles cut at the planes of the frustum, in clip coordinates. */
#ifndef RASTER_CLIP_H
#define RASTER_CLIP_H

#include "raster/raster.h"

/* The planes of the frustum. */
enum { RASTER_RIGHT, RASTER_LEFT, RASTER_TOP, RASTER_BOTTOM, RASTER_NEAR, RASTER_FAR, RASTER_PLANES };

/* A corner of the polygon: one of the vertices given, or a new one. */
typedef struct raster_corner {
    raster_vertex at;
    int given; /* its index, or -1 */
} raster_corner;

/* How a rasterizer clips: its order of the planes, and where an edge meets one. Distances are positive inside. */
typedef struct raster_clip_rule {
    unsigned char order[RASTER_PLANES];
    raster_vertex (*cut)(const raster_vertex *inside, const raster_vertex *outside, float d_inside, float d_outside);
} raster_clip_rule;

/* The planes that vertices are outside of, a bit each: any of the vertices, and in *all those that all are outside of.
 */
unsigned raster_outside(const raster_vertex vertex[3], unsigned *all);

/* Cuts a triangle at the planes of `outside`. Returns the number of corners; 0 when less than a triangle is left. */
int raster_clip(const raster_clip_rule *rule, const raster_vertex vertex[3], unsigned outside,
                raster_corner corner[RASTER_CORNERS]);

#endif
