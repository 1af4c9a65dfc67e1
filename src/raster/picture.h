/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file picture.h  The fight that people know, in motion: a street whose decals flicker while the camera moves.
 *
 *     draw_picture p;
 *     const char *wrong = draw_picture_open(&p, &spec, NULL, 100.0);
 *     for (unsigned frame = 0; wrong == NULL; frame++)
 *         show(pixel, draw_picture_frame(&p, 0.5 * p.guaranteed, frame, false, pixel).wrong);
 *     draw_picture_close(&p);
 *
 * Three planes, each with something upon it: a wall at 45 degrees with an octagonal sign, a wall at 30 degrees with a
 * poster, and the ground with a road and its marks; sign, poster and marks lie one gap in front, along the normal. They
 * are few large triangles, drawn as draw.h has it: the farther surface first, depth test LESS. The camera sways back
 * and forth and a little sideways, so that slants stay, in a loop of DRAW_PICTURE_FRAMES frames.
 *
 * The picture is the middle of the set-up's viewport, pixel for pixel; without one of dp_triangles_default()'s. The
 * scene is as large as fills it, so that every triangle of every frame lies within it and in the class of
 * dp_triangles_default(), gaps up to draw_picture_widest() included. So what triangles.h promises holds here: with a
 * gap of `guaranteed` or more no pixel is wrong. Places are computed in double: gaps are as asked to some 2^-51 of the
 * scene's depth.
 */
#ifndef RASTER_PICTURE_H
#define RASTER_PICTURE_H

#include "raster/draw.h"

enum { DRAW_PICTURE_WIDTH = 640, DRAW_PICTURE_HEIGHT = 360, DRAW_PICTURE_FRAMES = 600 /* 10 s at 60 a second */ };

#define DRAW_PICTURE_GAP 0.1 /**< the largest gap, of the scene's size */

typedef struct draw_picture {
    dp_setup asked; /**< in the model float at any slant; of a mapping that is not affine on the screen in exact */
    dp_setup setup; /**< as it is drawn: with the arithmetic of a rasterizer that was named, else as asked */
    const raster_row *row; /**< null: drawn as the class of the set-up has it */
    draw_camera camera;
    draw_buffer buffer;
    double reach;      /**< depth of the farthest thing, scene units */
    double z, scale;   /**< depth of the scene: things lie from 0.54 to 1.61 of it; its size beside that */
    double guaranteed; /**< the gap from which on no pixel is wrong, from near to the farthest thing, at any slant, in
                            scene units; INFINITY where there is none, as of what is not affine on the screen */
} draw_picture;

/** Counts of a frame, in pixels. */
typedef struct draw_picture_count {
    size_t covered; /**< by something that lies upon a surface, and by that surface */
    size_t wrong; /**< of those: the surface itself is shown; at a gap of 0 none of the two is nearer, but they fight */
} draw_picture_count;

/**
 * Makes a picture of DRAW_PICTURE_WIDTH x DRAW_PICTURE_HEIGHT pixels.
 *
 * @param spec   planes, mapping, format, rounding, arithmetic and triangles; the model is the picture's own, and so is
 *               the class where that of `spec` is narrower
 * @param row    the rasterizer, with its own arithmetic; null, or one that is a specification: as the class has it
 * @param reach  depth of the farthest thing, scene units
 * @return null, or one sentence without a full stop that says what does not do; *p then holds nothing
 */
const char *draw_picture_open(draw_picture *p, const dp_spec *spec, const raster_row *row, double reach);
void draw_picture_close(draw_picture *p);

/** The widest gap that it draws, scene units. */
double draw_picture_widest(const draw_picture *p);

/**
 * Draws a frame, any number: the same one every DRAW_PICTURE_FRAMES.
 *
 * @param gap    scene units, 0 to draw_picture_widest()
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
