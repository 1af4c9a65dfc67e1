/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file drawn_map.h  Coloured grids of a drawn figure, and the bar that says what their colours mean. */
#ifndef TESTS_DRAWN_MAP_H
#define TESTS_DRAWN_MAP_H

#include "drawn.h"

/** The image that fills a panel; fails the test when there is none. */
const svg_mark *drawn_map_image(const drawn *d, const drawn_panel *p);

/** Where on the page the middle of a pixel lies; rows from the top. */
svg_point drawn_map_place(const svg_mark *image, int column, int row);

/** The pixel 0xAARRGGBB of an image that shows at a place of the page. */
uint32_t drawn_map_pixel(const svg_mark *image, svg_point place);

/** The colour at a place of a panel: the image, or the last field painted over it. @return 0xAARRGGBB, 0 of nothing */
uint32_t drawn_map_shown(const drawn *d, const drawn_panel *p, svg_point place);

/** The height, px, of the place on the bar that has this colour; fails the test when none has. */
double drawn_bar_px(const drawn *d, uint32_t pixel);

/** Fails unless the bar goes from dark violet below to yellow above, lighter all the way. */
void drawn_bar_is_viridis(const drawn *d);
void drawn_bar_is_grey(const drawn *d); /* white above, black below */

/** Fails unless the maps use both ends of the bar. */
void drawn_bar_is_used(const drawn *d);

#endif
