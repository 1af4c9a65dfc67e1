/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file pyramid.h  Hi-Z: the levels of a conservative depth pyramid, of the farthest or the nearest depths.
 *
 * Level 0 is the image; each further one is half as wide and high, rounded down, at least 1. A texel holds the farthest
 * (or nearest) of those that its place in the picture touches in the level below: two on each axis, three where their
 * number is odd. So no texel is nearer (farther) than any pixel that it touches, whatever the size.
 */
#ifndef TEXTURE_PYRAMID_H
#define TEXTURE_PYRAMID_H

#include "texture/frame.h"

typedef struct pyramid {
    uint32_t level;   /**< asked for */
    bool nearest;     /**< else the farthest */
    dp_format format; /**< of the level: rounded away from the camera, or towards it for the nearest depth */
    uint32_t levels;  /**< the last one, of 1 x 1 */
    uint32_t width, height;
    uint32_t *codes;    /**< malloc'ed */
    uint64_t holes;     /**< pixels without a depth, which count as the far plane, or as the near one */
    double off, off_z;  /**< scene units: the most that rounding to `format` moved a texel, and from which depth */
    uint64_t codes_off; /**< the most in codes of the image's format */
} pyramid;

/** How many levels there are above the image. */
uint32_t pyramid_levels(uint32_t width, uint32_t height);

/** Fills in what follows `format`. The planes of the frame are those of all pixels. @return false without memory */
bool pyramid_make(const frame *f, pyramid *p);

#endif
