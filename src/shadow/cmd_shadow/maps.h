/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file maps.h  The shadow maps of a command line: one of a box, the cascades of a view, or those of a light that has
 * a place. */
#ifndef SHADOW_CMD_SHADOW_MAPS_H
#define SHADOW_CMD_SHADOW_MAPS_H

#include <stddef.h>

#include "shadow/cmd_shadow/request.h"
#include "shadow/shadow.h"

typedef struct shadow_maps {
    shadow_split view;  /**< count is 0 where there is no view */
    shadow_light whole; /**< of a spot or point light the map, all of its receivers; else its kind is SHADOW_SUN */
    dp_setup camera;    /**< with --camera-depth, of its depth texture */
    size_t count;
    shadow_cascade items[SHADOW_CASCADES_MAX]; /**< of a box the light alone is set; of a spot or point light each is
                                                    what is shown of one depth, `from`, and the light of that alone */
} shadow_maps;

/**
 * The maps in that format and mapping.
 * @return EXIT_FINE, or EXIT_USAGE after one line on stderr that names the option at fault
 */
int shadow_maps_make(const shadow_request *o, const dp_format *format, dp_mapping mapping, shadow_maps *out);

/** The light of each map, all of its receivers. */
static inline const shadow_light *shadow_map_of(const shadow_maps *maps, size_t i) {
    return maps->whole.kind != SHADOW_SUN ? &maps->whole : &maps->items[i].light;
}

static inline size_t shadow_map_count(const shadow_maps *maps) {
    return maps->whole.kind != SHADOW_SUN ? 1 : maps->count;
}

/** The API in which biases are counted: of distances, which no API biases, that of window depths. */
const bias_api *shadow_asked_api(const shadow_request *o, size_t index);

#endif
