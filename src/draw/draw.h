/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file draw.h  A chart laid out on a page and drawn. */
#ifndef DRAW_DRAW_H
#define DRAW_DRAW_H

#include "draw/canvas.h"
#include "draw/chart.h"
#include "draw/theme.h"

/** Least and greatest size of a figure, px: below it the words do not fit, above it cairo's numbers do not. */
enum { DRAW_WIDTH_MIN = 320, DRAW_HEIGHT_MIN = 200, DRAW_SIZE_MAX = 8192 };

/**
 * Draws a chart. From 800 x 500 px upwards everything grows with the size; below, letters shrink to three quarters
 * and no further, and the frame gives way.
 *
 * @param command  the command line that draws it, for the metadata
 * @return false when memory ran out
 */
bool draw_chart(const chart *c, const theme *t, canvas_format format, int width, int height, const char *command,
                canvas_bytes *out);

#endif
