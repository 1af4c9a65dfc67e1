/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file theme.h  Colours and strokes. Curves take the colour-blind safe palette of Okabe and Ito with dashes and
 * markers as second cue; maps take viridis. A theme orders the palette so that its weakest colours come last.
 */
#ifndef DRAW_THEME_H
#define DRAW_THEME_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>

#include "draw/canvas.h"

enum { THEME_COLOURS = 8, THEME_STROKES = 6, THEME_MARKERS = 6 };

/** Strokes. Dashes mean reversed depth, in every figure; what else is told apart by the stroke is solid or dotted, and
 * so is a limit. So odd ones are dashed in one way or another, and even ones are not. */
enum { THEME_SOLID = 0, THEME_REVERSED = 1, THEME_DOTTED = 2, THEME_SPARSE = 4 };

typedef struct theme {
    const char *name;
    canvas_colour background;
    canvas_colour text;
    canvas_colour faint; /**< subtitles, tick labels */
    canvas_colour frame; /**< axes and ticks */
    canvas_colour grid;  /**< major grid lines */
    canvas_colour empty; /**< where a map has no value */
    double line_width;   /**< px at the default size */
    canvas_colour curves[THEME_COLOURS];
} theme;

/** Themes by index: light, dark, print; null beyond. The order is that of the option --theme. */
const theme *theme_get(size_t index);

/** Colour `colour` of the palette, taken modulo what there is; -1 is that of the text. */
canvas_colour theme_colour(const theme *t, int colour);

/** A pen for curve `colour` with stroke style `stroke` (0 is solid), taken modulo what there is. */
canvas_pen theme_pen(const theme *t, int colour, int stroke, double scale);

/**
 * Draws marker `marker` (disc, square, diamond, triangle, ...) at a point.
 * @param colour  of the palette; -1 is that of the text
 * @param hollow  only the rim has the colour
 */
void theme_marker(canvas *c, const theme *t, double x, double y, int marker, int colour, bool hollow, double scale);

enum { THEME_VIRIDIS_STEPS = 11 };
extern const canvas_colour theme_viridis_steps[THEME_VIRIDIS_STEPS];

/* A picture asks for both in each of millions of pixels, so they stand here. */

/** viridis: 0 is dark violet, 1 yellow; outside it is clamped. */
static inline canvas_colour theme_viridis(double t) {
    enum { LAST = THEME_VIRIDIS_STEPS - 1 };
    const double at = t > 0 ? t < 1 ? t * LAST : LAST : 0;
    const int i = at < LAST - 1 ? (int)at : LAST - 1;
    const double f = at - i;
    const canvas_colour *const p = &theme_viridis_steps[i];
    return (canvas_colour){p[0].r + f * (p[1].r - p[0].r), p[0].g + f * (p[1].g - p[0].g),
                           p[0].b + f * (p[1].b - p[0].b), 1};
}

/** 0xAARRGGBB of an opaque colour. */
static inline uint32_t theme_pixel(canvas_colour colour) {
    return 0xFF000000u | (uint32_t)lrint(colour.r * 255) << 16 | (uint32_t)lrint(colour.g * 255) << 8 |
           (uint32_t)lrint(colour.b * 255);
}

#endif
