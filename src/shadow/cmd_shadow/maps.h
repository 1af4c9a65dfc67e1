/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file maps.h  The shadow maps of a command line: one of a box, or the cascades of a view. */
#ifndef SHADOW_CMD_SHADOW_MAPS_H
#define SHADOW_CMD_SHADOW_MAPS_H

#include <stddef.h>

#include "shadow/cmd_shadow/request.h"
#include "shadow/shadow.h"

typedef struct shadow_maps {
    shadow_split view; /**< count is 0 where there is one box and no view */
    dp_setup camera;   /**< with --camera-depth, of its depth texture */
    size_t count;
    shadow_cascade items[SHADOW_CASCADES_MAX]; /**< of a box the light alone is set */
} shadow_maps;

/**
 * The maps in that format and mapping.
 * @return EXIT_FINE, or EXIT_USAGE after one line on stderr that names the option at fault
 */
int shadow_maps_make(const shadow_request *o, const dp_format *format, dp_mapping mapping, shadow_maps *out);

#endif
