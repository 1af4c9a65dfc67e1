/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file cost.h  What a format and a mapping cost: bytes per pixel, where they can be had, what they ask of a renderer.
 */
#ifndef CAMERA_COST_H
#define CAMERA_COST_H

#include <stdbool.h>

#include "depthprec/depthprec.h"

/** How many surfaces lie behind each other where shading is counted. */
enum { COST_SURFACES = 4 };

typedef struct cost {
    int buffer;            /**< some API has the format as a depth buffer */
    int bytes;             /**< per pixel, with the padding that the format is stored with */
    bool early;            /**< the depth test, and that of whole tiles, comes before the fragment shader */
    double shaded;         /**< how often that runs at a pixel of COST_SURFACES opaque surfaces in random order */
    int rank;              /**< orders equal bytes: 0 is to be had everywhere without a change to the renderer */
    const char *available; /**< which APIs have the format */
    const char *caution;   /**< what is easily overlooked about that, one line; "" when nothing */
    const char *effort;    /**< what the mapping asks for; "" when nothing */
} cost;

cost cost_of(const dp_format *format, dp_mapping mapping);

/** Negative when a is cheaper than b. A format that no API has as a depth buffer is dearer than any that one has. */
int cost_compare(const cost *a, const cost *b);

#endif
