/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file platform.h  Which depth buffer a web page gets: what it asks for against what is stored, by browser and
 * graphics API, one row each. Adding a platform is adding a row to platform.c.
 *
 * WebGPU's depth24plus leaves the choice to the browser, and WebGL's 24 bits are stored as what the API below has.
 */
#ifndef CAMERA_PLATFORM_H
#define CAMERA_PLATFORM_H

#include <stdbool.h>
#include <stddef.h>

#include "bias/bias.h"
#include "core/named.h"

/** The change that a browser makes to clip z at the end of a vertex shader. */
typedef enum platform_remap {
    PLATFORM_REMAPS_NOT = 0,
    PLATFORM_REMAPS,    /**< from [-1, 1] to [0, 1], by (z + w)/2 */
    PLATFORM_MAY_REMAP, /**< the same on some devices */
    PLATFORM_SPREADS    /**< from [0, 1] to [-1, 1], by 2 z - w: a small z loses its digits to w. No arithmetic of
                             depthprec/arith.h knows this, so there is no guarantee */
} platform_remap;

typedef struct platform {
    NAMED_FIELDS;
    const char *asks;       /**< what the page asks for */
    const char *stored;     /**< for dp_format_parse(): depth24plus where the device decides between two formats */
    const char *stencil;    /**< likewise, where a stencil of 8 bits is asked for too */
    platform_remap remap;   /**< unless the page asks for zero to one, where it can */
    const char *api;        /**< a name of `list apis`: what the program writes its bias for, */
    const char *below;      /**< and whose r is added in the end */
    const char *raster;     /**< a name of `list rasterizers`: what the API below promises at least; Metal: as Vulkan */
    bias_exponent exponent; /**< of a float buffer's bias */
    double scale_least, scale_most; /**< what the browser multiplies a bias by; 0, 0: nothing */
    bool cuts;                      /**< fractions of a constant bias are cut: 0.5 becomes 0 */
    bool drops_clamp;
    const char *bias;   /**< one line on these; "" where the API is followed */
    const char *newest; /**< year and month of the newest source, ISO 8601, and whether it was old when it was read */
} platform;

NAMED_ROWS(platform, platform);

/** Its format for a name that leaves the choice to the browser, depth24plus or depth24plus-stencil8; null of others. */
const char *platform_stores(const platform *p, const char *given);

/** A bias of that API as it arrives there: its own API's row as the platform has it; any other, and null, unchanged. */
bias_api platform_bias(const platform *p, const bias_api *api);

#endif
