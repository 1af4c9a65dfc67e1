/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file heat.h  Draws a map: colours, the hatch where there is no value, contour lines with labels, the colour bar. */
#ifndef DRAW_HEAT_H
#define DRAW_HEAT_H

#include "draw/axes.h"

/** The map of a panel within its frame; contour labels keep clear of its points. @return false when out of memory */
bool heat_draw(const pencil *p, const axes *a, const chart_panel *panel, const chart *c);

/** Has a map a field without a value, which is hatched? */
bool heat_has_holes(const chart_map *m);

/** 0xRRGGBB of a direction, a unit vector of view space: x red, y green, towards the camera blue. */
uint32_t heat_direction(double x, double y, double z);

/** Those colours on a ball seen from the camera, and what they mean, from the top of an area downwards. */
void heat_draw_ball(const pencil *p, canvas_rect area);

/** The colour bar of a chart in a strip. */
void heat_draw_bar(const pencil *p, canvas_rect strip, const chart *c);

#endif
