/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file area.h  Bands that stand on each other, and their names written into them: a second cue beside the colour. */
#ifndef DRAW_AREA_H
#define DRAW_AREA_H

#include "draw/axes.h"

/** The tint of a band: its colour, softened so that text and lines on it can be read. */
canvas_colour area_tint(const theme *t, int colour);

/**
 * Fills from the top edge of band `index` down to the axis. The bands below it are painted over that, so draw the
 * topmost first. A point that is NaN leaves a gap.
 */
void area_draw(const pencil *p, const axes *a, const chart_panel *panel, size_t index);

/**
 * Writes the name of band `index` where it is thickest, clear of the lines; nothing where it is too thin everywhere.
 * @param right  the axes of the lines
 */
void area_label(const pencil *p, const axes *a, const axes *right, const chart_panel *panel, size_t index);

#endif
