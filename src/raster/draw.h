/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file draw.h  A depth buffer that remembers who won: surfaces in eye space, drawn as a rasterizer of src/raster does.
 *
 *     draw_camera camera;
 *     draw_buffer buffer;
 *     if (draw_camera_init(&camera, raster_find("llvmpipe"), &setup) != RASTER_OK || !draw_buffer_open(&buffer, 64000))
 *         return false;
 *     draw_buffer_clear(&buffer, (draw_area){800, 440, 320, 200});
 *     draw_triangle(&buffer, &camera, wall, 1);
 *     draw_triangle(&buffer, &camera, decal, 2);
 *     ... buffer.winner[i], buffer.seen[i] ...
 *     draw_buffer_close(&buffer);
 *
 * Eye space: x to the right, y up, z along the view axis, in scene units; each coordinate is rounded to binary32, then
 * transformed by a matrix of binary32 entries. Window y runs upwards too; pixel (x, y) has its centre half a pixel on.
 *
 * The depth test is LESS, of reversed mappings GREATER: of equal codes the one drawn first stays. So a pixel where two
 * surfaces are not strictly in order shows the farther one if that is drawn first.
 */
#ifndef RASTER_DRAW_H
#define RASTER_DRAW_H

#include <stdbool.h>
#include <stdint.h>

#include "depthprec/depthprec.h"
#include "raster/raster.h"

/** Who may draw: 1 to DRAW_SURFACES. */
enum { DRAW_NOBODY = 0, DRAW_SURFACES = 8, DRAW_ROW = 256 };

/** The bias of a triangle, of its greatest window depth and of the greater change of depth from a pixel to the next. */
typedef float draw_bias(const void *of, float most, float slope);

typedef struct draw_camera {
    raster_target target;
    dp_pipeline pipeline;
    float p00, p11; /**< of the matrix: clip x and y of eye x and y */
    dp_setup setup; /**< where no rasterizer is named: see draw_class.h */
    /** Added in binary32 to each depth, which is then held from 0 to 1, before it is stored; null: nothing is. No
     *  fragment shader's depth has one. */
    draw_bias *bias;
    const void *bias_of;
} draw_camera;

/** n . X = distance, |n| = 1. */
typedef struct draw_plane {
    double normal[3], distance;
} draw_plane;

/** A part of the target: pixels x to x + width - 1, and so on. */
typedef struct draw_area {
    int x, y, width, height;
} draw_area;

typedef struct draw_buffer {
    draw_area area;
    uint32_t *key;   /**< what the depth test compares: the nearer, the less; row by row from the lowest */
    uint8_t *winner; /**< who is seen */
    uint8_t *seen;   /**< bit k - 1: k covers the pixel */
    size_t room;     /**< pixels, at most */
} draw_buffer;

/**
 * A camera of square pixels.
 * @param row    one of raster_get(); null: triangles are drawn as the class of the set-up has them, see draw_class.h
 * @param setup  in the arithmetic of raster_arith(), of GL's [-1, 1] with the remap in the vertex shader, for the
 * models take clip z from 0 to w; its triangles say the viewport and the field of view. An orthographic view is as high
 * as the perspective is at the depth 1. Without a row any
 * @return RASTER_OK, or as raster_target_init(); RASTER_MODEL also where the set-up is no such one
 */
raster_status draw_camera_init(draw_camera *camera, const raster_row *row, const dp_setup *setup);

/** The clip coordinates that the vertex shader gives a place in eye space, z from 0 to w. */
raster_vertex draw_clip(const draw_camera *camera, const double place[3]);

/** The ray through a place of the window: its eye coordinates at depth 1. */
void draw_ray(const draw_camera *camera, const double window[2], double ray[3]);

/** Whether its view is orthographic. */
bool draw_is_ortho(const draw_camera *camera);

/** The place in eye space that is seen there at a depth. */
void draw_at(const draw_camera *camera, const double window[2], double z, double place[3]);

/** The eye depth of a plane at a place of the window; NaN where its back is seen, or its edge. */
double draw_depth(const draw_camera *camera, const draw_plane *plane, const double window[2]);

/** n . r of a place of the window, of a perspective: eye depth there is distance over this, where it is positive. */
double draw_facing(const draw_camera *camera, const draw_plane *plane, const double window[2]);

/** Room for so many pixels. @return false when out of memory */
bool draw_buffer_open(draw_buffer *buffer, size_t room);
void draw_buffer_close(draw_buffer *buffer);

/** Empties it, to stand for an area inside the target of no more pixels than there is room for. */
void draw_buffer_clear(draw_buffer *buffer, draw_area area);

/**
 * Draws a triangle where it meets the buffer's area.
 * @param who  1 to DRAW_SURFACES
 * @return false where the rasterizer draws nothing of it
 */
bool draw_triangle(draw_buffer *buffer, const draw_camera *camera, const double place[3][3], unsigned who);

/**
 * Told of the pixels x to x + count - 1 of row y, at most DRAW_ROW, that a triangle covers, and what the depth test
 * compares there: the nearer, the less, and below UINT32_MAX.
 */
typedef void draw_take(void *context, int x, int y, int count, const uint32_t *key);

/** The stored code that has a key. */
uint32_t draw_code(const draw_camera *camera, uint32_t key);

/** Gives the pixels of an area inside the target to a depth test of the caller's own, as draw_triangle() does. */
bool draw_keys(const draw_camera *camera, const draw_area *area, const double place[3][3], draw_take *take,
               void *context);

#endif
