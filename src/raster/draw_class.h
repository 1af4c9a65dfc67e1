/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file draw_class.h  Triangles as the class of a set-up describes them, whatever it stores: vertices on its grid,
 * their depths by its pipeline, and a plane of binary32 that is anchored at the first of them.
 *
 * A depth that a vertex shader writes is interpolated. Another linear or logarithmic one is written by the fragment:
 * near/z is interpolated in that plane, and the depth of what it gives is the set-up's code of that z, correctly
 * rounded. The same of what no rasterizer of raster.h stores.
 */
#ifndef RASTER_DRAW_CLASS_H
#define RASTER_DRAW_CLASS_H

#include "raster/draw.h"

/** As draw_camera_init() without a rasterizer. @return RASTER_OK, RASTER_TARGET or RASTER_MODEL */
raster_status draw_class_init(draw_camera *camera, const dp_setup *setup);

/** Whether the camera was made by that. */
bool draw_is_class(const draw_camera *camera);

/** The one piece of a triangle inside the view. @return RASTER_OK, RASTER_EMPTY or RASTER_VERTEX */
raster_status draw_class_set_up(const draw_camera *camera, const double place[3][3], raster_triangle *drawn);

/** As raster_codes(), in the format of the set-up, any that there is. */
void draw_class_codes(const draw_camera *camera, const raster_piece *piece, int y, int from, int to, uint32_t *code);

/** The codes of depths that a rasterizer interpolated. */
void draw_class_convert(const draw_camera *camera, const float *depth, int count, uint32_t *code);

#endif
