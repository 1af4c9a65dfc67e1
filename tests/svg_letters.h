/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file svg_letters.h  For svg.c: the outlines of letters, and the pixels of images within an SVG. */
#ifndef TESTS_SVG_LETTERS_H
#define TESTS_SVG_LETTERS_H

#include "svg.h"

enum { SVG_LETTERS = 1024 };

typedef struct svg_letter {
    char text[8]; /**< UTF-8 */
    svg_font font;
    char *outline; /**< the path that draws it */
} svg_letter;

typedef struct svg_letters {
    size_t count;
    svg_letter letters[SVG_LETTERS];
} svg_letters;

/** The letters of some fonts; they stay until the next call. */
const svg_letters *svg_letters_of(const svg_font *fonts, size_t count);

/** The letter with an outline; null when there is none. */
const svg_letter *svg_letter_find(const svg_letters *l, const char *outline);

/** The pixels 0xAARRGGBB of "data:image/png;base64,...". free() them. */
uint32_t *svg_pixels(const char *data, int *columns, int *rows);

#endif
