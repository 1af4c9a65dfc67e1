/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file words.h  Text that must fit: broken into lines, and cut with an ellipsis where even that is too little. */
#ifndef DRAW_WORDS_H
#define DRAW_WORDS_H

#include "draw/axes.h"

enum { WORDS_LINES = 4, WORDS_TEXT = 3 * CHART_TEXT };

typedef struct words {
    size_t count;
    char lines[WORDS_LINES][WORDS_TEXT];
} words;

/** Breaks text at its spaces into at most max_lines (<= WORDS_LINES) lines no wider than width px. */
words words_break(const pencil *p, const char *text, const canvas_font *font, double width, size_t max_lines);

/** Draws the lines downwards from y, the top of the first. @return the y below the last */
double words_draw(const pencil *p, const words *w, const canvas_font *font, double x, double y);

/** The height of one line of a font, px. */
double words_height(const canvas_font *font);

#endif
