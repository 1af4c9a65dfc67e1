/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file svg.h  Reads a drawn SVG back: what stands where, in which colour, and what its letters say.
 *
 * cairo writes text as outlines. The reader draws every letter it knows with the same font and size through cairo,
 * and so finds which letter an outline is. Coordinates are px of the page, transforms applied, y downwards.
 */
#ifndef TESTS_SVG_H
#define TESTS_SVG_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { SVG_DASHES = 8, SVG_TEXT = 512, SVG_NOTE = 8192 };

/** a == 0: nothing is painted. */
typedef struct svg_colour {
    double r, g, b, a;
} svg_colour;

typedef struct svg_point {
    double x, y;
    bool starts; /**< it begins a new piece of the path */
} svg_point;

typedef struct svg_box {
    double x0, y0, x1, y1;
} svg_box;

typedef enum svg_kind { SVG_PATH, SVG_WORDS, SVG_IMAGE } svg_kind;

/** One thing on the page. */
typedef struct svg_mark {
    svg_kind kind;
    svg_box box;  /**< of its points or its ink */
    svg_box clip; /**< where it shows */
    svg_colour fill, stroke;
    double width, dash[SVG_DASHES]; /**< of the stroke, px */
    int dash_count;
    size_t count; /**< SVG_PATH: its points; of a curve both ends */
    svg_point *points;
    bool curved;
    char text[SVG_TEXT]; /**< SVG_WORDS: UTF-8; its colour is the fill */
    double size;         /**< of the letters, px */
    bool bold;
    svg_point at;      /**< where the baseline begins */
    int columns, rows; /**< SVG_IMAGE: its pixels 0xAARRGGBB, row by row from the top of the box */
    uint32_t *pixels;
    int used; /**< for the tests: what it was recognised as; 0 for not yet */
} svg_mark;

typedef struct svg {
    double width, height;
    char title[SVG_NOTE], description[SVG_NOTE], metadata[SVG_NOTE];
    size_t count;
    svg_mark *marks; /**< in the order in which they are painted */
} svg;

/** A size of letters that a page may have. */
typedef struct svg_font {
    double size;
    bool bold;
} svg_font;

/** Reads a page whose letters are of the given fonts. Fails the test when it cannot. svg_free() it. */
svg *svg_read(const void *bytes, size_t size, const svg_font *fonts, size_t font_count);
void svg_free(svg *s);

double svg_middle_x(svg_box b);
double svg_middle_y(svg_box b);

/** Is a within b, give or take `slack` px? */
bool svg_inside(svg_box a, svg_box b, double slack);

/** 0xRRGGBB of a colour. */
uint32_t svg_rgb(svg_colour c);

#endif
