/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file drawn_parts.h  What the files of drawn.h share among themselves. */
#ifndef TESTS_DRAWN_PARTS_H
#define TESTS_DRAWN_PARTS_H

#include "drawn.h"

/** Ticks, labels and scales of all panels and of the colour bar. */
void drawn_read_axes(drawn *d);

/** The marker whose inside mark i is; DRAWN_NONE when it is none. */
drawn_marker drawn_marker_of(const drawn *d, size_t i);

/** Words of the size of labels in a colour. */
bool drawn_is_small(const drawn *d, const svg_mark *m, uint32_t colour);

#endif
