/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file picture.h  The fight that people know, in motion: a street whose decals flicker while the camera moves.
 *
 *     draw_picture p;
 *     const char *wrong = draw_picture_open(&p, &spec, raster_find("llvmpipe"), NAN);
 *     for (unsigned frame = 0; wrong == NULL; frame++)
 *         show(pixel, draw_picture_frame(&p, 0.5 * p.guaranteed, frame, false, pixel).wrong);
 *     draw_picture_close(&p);
 *
 * Three planes, each with something upon it: a wall at 45 degrees with an octagonal sign, a wall at 30 degrees with a
 * poster, and the ground with a road and its marks; sign, poster and marks lie one gap in front, along the normal. They
 * are few large triangles, drawn as draw.h has it: the farther surface first, depth test LESS. The camera sways back
 * and forth and a little sideways, so that slants stay, in a loop of DRAW_PICTURE_FRAMES frames.
 *
 * Every triangle of every frame lies within the view and in the class of dp_triangles_default(), gaps up to
 * DRAW_PICTURE_GAP included, so what triangles.h promises holds here: with a gap of `guaranteed` or more no pixel is
 * wrong. Places are computed in double: gaps are as asked to some 2^-51 of the scene's depth.
 */
#ifndef RASTER_PICTURE_H
#define RASTER_PICTURE_H

#include "raster/draw.h"

enum { DRAW_PICTURE_WIDTH = 640, DRAW_PICTURE_HEIGHT = 360, DRAW_PICTURE_FRAMES = 600 /* 10 s at 60 a second */ };

#define DRAW_PICTURE_FOV  45.0 /**< vertical field of view, degrees */
#define DRAW_PICTURE_GAP  0.1  /**< the largest gap, of the scene's depth */
#define DRAW_PICTURE_MARK 0.75 /**< where on the slider the guarantee is */

typedef struct draw_picture {
    dp_setup setup; /**< as it is drawn: model float, the rasterizer's arithmetic, any slant */
    draw_camera camera;
    draw_buffer buffer;
    double z;          /**< depth of the scene, scene units: things lie from 0.54 to 1.61 of it */
    double guaranteed; /**< the gap from which on no pixel is wrong, scene units; INFINITY where there is none */
} draw_picture;

/** Counts of a frame, in pixels. */
typedef struct draw_picture_count {
    size_t covered; /**< by something that lies upon a surface, and by that surface */
    size_t wrong; /**< of those: the surface itself is shown; at a gap of 0 none of the two is nearer, but they fight */
} draw_picture_count;

/**
 * Makes a picture of DRAW_PICTURE_WIDTH x DRAW_PICTURE_HEIGHT pixels.
 *
 * @param spec  planes, mapping, format and rounding; model, arithmetic and triangles are the picture's own
 * @param row   the rasterizer
 * @param z     depth of the scene; NaN: the geometric mean of the planes, or as near to that as the scene fits between
 *              them, far counted as 10^6 near at most
 * @return null, or one sentence without a full stop that says what does not do; *p then holds nothing
 */
const char *draw_picture_open(draw_picture *p, const dp_spec *spec, const raster_row *row, double z);
void draw_picture_close(draw_picture *p);

/**
 * The gap at a place of a slider: 0 at 0; `guaranteed` at DRAW_PICTURE_MARK, a thousandth of it just above 0, and ten
 * times as much at 1, or the largest gap where that is less. Where the guarantee is beyond the largest gap, which is at
 * 1 then, it is nowhere on the slider. Anything else than 0 to 1 counts as the nearer end, NaN as 0.
 */
double draw_picture_gap(const draw_picture *p, double place);

/** Whether the guarantee is on the slider. */
bool draw_picture_marked(const draw_picture *p);

/**
 * Draws a frame, any number: the same one every DRAW_PICTURE_FRAMES.
 *
 * @param gap    scene units, 0 to DRAW_PICTURE_GAP z
 * @param marks  wrong pixels are shown in a colour of their own, else as what they show
 * @param pixel  red, green, blue and alpha, a byte each, row by row from the top; null: pixels are counted only
 * Cost: no allocation; measured by test_picture.c.
 */
draw_picture_count draw_picture_frame(draw_picture *p, double gap, unsigned frame, bool marks, uint32_t *pixel);

/** The same of what is in `buffer`: of a frame whose winners were found elsewhere. */
draw_picture_count draw_picture_show(const draw_picture *p, bool marks, uint32_t *pixel);

/** Told of each triangle of a frame in the order of drawing, in eye space, and who draws it. */
typedef void draw_picture_take(void *context, const double place[3][3], unsigned who);
void draw_picture_triangles(const draw_picture *p, double gap, unsigned frame, draw_picture_take *take, void *context);

#endif
