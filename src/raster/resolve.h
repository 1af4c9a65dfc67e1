/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file resolve.h  What a pass meets where a prepass stored depths beside its pixels: samples of a pixel, resolved, or
 * a picture of half the width and height. How far beside, and the bias that makes LEQUAL (GEQUAL) hold on a plane.
 *
 * On a plane window depth is affine in the pixel, with slope (gx, gy). A depth that was stored at (x, y) from where it
 * is drawn again is off by gx x + gy y, at most m (|x| + |y|), m = max(|gx|, |gy|): the factor of a slope-scaled bias.
 * What is rounded costs a constant besides. depthprec(7), "A prepass that stores something else", derives both.
 */
#ifndef RASTER_RESOLVE_H
#define RASTER_RESOLVE_H

#include "core/named.h"
#include "depthprec/format.h"

/** Which of the depths is kept. */
typedef enum resolve_kept {
    RESOLVE_FIRST = 0, /**< that of the first place */
    RESOLVE_ANY,       /**< that of one place, whichever */
    RESOLVE_LEAST,
    RESOLVE_GREATEST,
    RESOLVE_MEAN /**< the numbers summed in binary32, in any order, and divided by how many there are */
} resolve_kept;

/** A way to make one depth of several. */
typedef struct resolve_way {
    NAMED_FIELDS;
    resolve_kept kept;
    int places; /**< of a picture of half the size 1 or 4, as resolve_at() has them; 0: as many as there are samples */
} resolve_way;

NAMED_ROWS(resolve_way, resolve_sampled); /**< of the samples of a pixel */
NAMED_ROWS(resolve_way, resolve_halved);  /**< of a picture of half the width and height */

enum { RESOLVE_SAMPLES_MOST = 16 };

/** A place beside a pixel, in sixteenths of one, from where the pixel is drawn again. */
typedef struct resolve_place {
    signed char x, y;
} resolve_place;

/**
 * Place `index` of `count`: the samples of a pixel, 2, 4, 8 or 16, from its centre; 0 for other counts. Of `halved` 1:
 * the middle of two pixels by two, from one of them; or 4: these pixels.
 */
resolve_place resolve_at(int count, bool halved, int index);

/** The bias that a case asks for. */
typedef struct resolve_need {
    double pixels; /**< F: a bias of F m is needed for the slope, m the slope of the API; 0 where it costs nothing */
    double window; /**< and this besides, of window depth */
} resolve_need;

/**
 * The bias towards the camera that makes the test hold on every plane, its sum with a window depth rounded to binary32.
 * @param samples   2, 4, 8 or 16; not read where way->places is not 0
 * @param reversed  the test is GEQUAL
 * @param depth     the greatest window depth of the primitive, samples included, [0, 1]
 */
resolve_need resolve_needs(const resolve_way *way, int samples, const dp_format *format, dp_rounding rounding,
                           bool reversed, double depth);

#endif
