/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Triangles cut at the planes of the frustum, in clip coordinates. */
#ifndef RASTER_CLIP_H
#define RASTER_CLIP_H

#include "raster/raster.h"

enum { RASTER_PLANES = 6 };

/* A corner of the polygon: one of the vertices given, or a new one. */
typedef struct raster_corner {
    raster_vertex at;
    int given; /* its index, or -1 */
} raster_corner;

/* How a rasterizer clips: the planes in its order, and where an edge meets one. Distances are positive inside. */
typedef struct raster_clip_rule {
    float (*distance[RASTER_PLANES])(const raster_vertex *v);
    raster_vertex (*cut)(const raster_vertex *inside, const raster_vertex *outside, float d_inside, float d_outside);
    bool touching; /* an edge that comes from outside and ends on the plane makes a new vertex there */
} raster_clip_rule;

float raster_right(const raster_vertex *v);
float raster_left(const raster_vertex *v);
float raster_top(const raster_vertex *v);
float raster_bottom(const raster_vertex *v);
float raster_near(const raster_vertex *v);
float raster_far(const raster_vertex *v);

/* The planes that vertices are outside of, a bit each: of any vertex, and in *all those that all are outside of. */
unsigned raster_outside(const raster_clip_rule *rule, const raster_vertex vertex[3], unsigned *all);

/* Cuts a triangle at the planes of `outside`. Returns the number of corners; 0 when less than a triangle is left. */
int raster_clip(const raster_clip_rule *rule, const raster_vertex vertex[3], unsigned outside,
                raster_corner corner[RASTER_CORNERS]);

#endif
