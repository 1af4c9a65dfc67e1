/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file recognise.h  The content of a depth image, in words. */
#ifndef TEXTURE_RECOGNISE_H
#define TEXTURE_RECOGNISE_H

#include "depthprec/recognise.h"
#include "image/image.h"

enum { RECOGNISE_WHY_SIZE = 480 };

/** Looks at channel 0 of every pixel. Never fails: an image that cannot be window depth has depth == false.
 *  @param why  one sentence: how it was told, or why it is no window depth, and recognise_towards() */
void recognise(const image *image, dp_recognised *out, char why[RECOGNISE_WHY_SIZE]);

/** The evidence for the direction, or that there is none; null without depth. */
const char *recognise_towards(const dp_recognised *found);

#endif
