/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file canvas.h  A drawing surface in px, the origin at the top left, that ends as the bytes of an SVG, PDF or PNG.
 *
 * canvas.c is the only file that includes cairo, which it opens for the first figure. Coordinates are clamped to
 * CANVAS_REACH: cairo's fixed point holds 24.8 bits and turns what lies beyond it, and infinities, into nonsense
 * without a word. Clip to the frame first; the clamp is only the last guard. The bytes depend on nothing but what was
 * drawn and noted (and on SOURCE_DATE_EPOCH).
 */
#ifndef DRAW_CANVAS_H
#define DRAW_CANVAS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "draw/notes.h"

typedef struct canvas canvas;

typedef enum canvas_format { CANVAS_SVG = 0, CANVAS_PDF, CANVAS_PNG, CANVAS_FORMAT_COUNT } canvas_format;

/** Farthest coordinate, px, that reaches cairo. */
#define CANVAS_REACH 100000.0

/** sRGB and opacity, each in [0, 1]. */
typedef struct canvas_colour {
    double r, g, b, a;
} canvas_colour;

typedef struct canvas_point {
    double x, y;
} canvas_point;

typedef struct canvas_rect {
    double x, y, w, h;
} canvas_rect;

enum { CANVAS_DASHES = 6 };

typedef struct canvas_pen {
    canvas_colour colour;
    double width;               /**< px */
    double dash[CANVAS_DASHES]; /**< on, off, ... in px; dash_count is 0 for a solid line */
    int dash_count;
} canvas_pen;

typedef struct canvas_font {
    double size; /**< px */
    bool bold;
    canvas_colour colour;
    canvas_colour halo; /**< drawn round the letters, to stand out on a picture; a = 0 for none */
} canvas_font;

/** Which part of a text lies at the given point: the baseline is the lower edge, a capital's height the upper. */
typedef enum canvas_align { CANVAS_LEFT = 0, CANVAS_MIDDLE, CANVAS_RIGHT } canvas_align;

typedef struct canvas_bytes {
    char *at; /**< free() it */
    size_t size;
} canvas_bytes;

/** The format that a file name's ending names (letter case ignored); CANVAS_FORMAT_COUNT when none does. */
canvas_format canvas_format_of(const char *path);

/** Null where this program draws a format, or why not: one that was built without cairo draws SVG alone. */
const char *canvas_lacks(canvas_format format);

/** A surface of whole px in each direction, 1 to 16384. @return null when out of memory, or canvas_lacks() it */
canvas *canvas_new(canvas_format format, int width, int height, const notes *words);

/** Frees everything but the bytes. @return false when cairo failed or memory ran out, whatever the bytes are then */
bool canvas_finish(canvas *c, canvas_bytes *out);

void canvas_fill(canvas *c, canvas_rect area, canvas_colour colour);
void canvas_polygon(canvas *c, const canvas_point *points, size_t count, canvas_colour colour);
void canvas_line(canvas *c, const canvas_point *points, size_t count, const canvas_pen *pen);
void canvas_segment(canvas *c, double x0, double y0, double x1, double y1, const canvas_pen *pen);

/** A line point by point, for those too long for an array: to, to, ..., end. */
void canvas_path_to(canvas *c, double x, double y);
void canvas_path_break(canvas *c); /**< the next point begins a new piece */
void canvas_path_segment(canvas *c, double x0, double y0, double x1, double y1); /**< a piece of its own */
void canvas_path_end(canvas *c, const canvas_pen *pen);
void canvas_path_fill(canvas *c, canvas_colour colour); /**< instead of the end: closes it and fills the inside */

/** A filled circle with a rim. */
void canvas_disc(canvas *c, double x, double y, double radius, canvas_colour fill, const canvas_pen *rim);

/** One line of text with its baseline at y. */
void canvas_text(canvas *c, double x, double y, const char *text, const canvas_font *font, canvas_align align);

/** How far the text reaches, px. */
double canvas_text_width(canvas *c, const char *text, const canvas_font *font);

/** Pixels 0xFFRRGGBB, or 0 where there is nothing, row by row from the top, stretched over the area; they stay. */
void canvas_image(canvas *c, canvas_rect area, int columns, int rows, uint32_t *at);

/** Everything until canvas_unclip() is cut at the area. Clips do not nest. */
void canvas_clip(canvas *c, canvas_rect area);
void canvas_unclip(canvas *c);

#endif
