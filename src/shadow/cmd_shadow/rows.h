/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file rows.h  What shadow maps need, as an API takes it: the rows of the command shadow. */
#ifndef SHADOW_CMD_SHADOW_ROWS_H
#define SHADOW_CMD_SHADOW_ROWS_H

#include "bias/cmd_bias/call.h"
#include "report/number.h"
#include "shadow/cmd_shadow/maps.h"

enum { UNITS_SIZE = NUMBER_SIZE + 2 };

/** One of the three biases of a map, as an API takes it. */
typedef struct shadow_set {
    double window;                      /**< as shadow_bias has it */
    double units, factor;               /**< with their sign; NaN: no such number is enough, nor has it a gap then */
    double offset, texels;              /**< in scene units, and in texels of its map */
    double gap, gap_normal, gap_facing; /**< as shadow_state has them, scene units */
    double share;                       /**< as shadow_bias has it */
    char units_text[UNITS_SIZE], factor_text[UNITS_SIZE]; /**< on the safe side */
    char call[BIAS_CALL_SIZE];                            /**< what a program writes; "" where no bias is enough */
} shadow_set;

/** The bias that a map needs, for one API. */
typedef struct shadow_row {
    int cascade;             /**< from 1 */
    double from, to, radius; /**< of a cascade; NaN of a box */
    double width, height, depth, texel;
    double z;                /**< of a spot or point light the receiver's depth, or its distance; else NaN */
    double axis, axis_codes; /**< window depth that the filter alone needs of a plane at the greatest angle there, on
                                  the axis, steepest along a row of texels; the same in codes, NaN of float formats */
    double cause[SHADOW_CAUSE_COUNT]; /**< scene units along the light, at the greatest slant */
    shadow_set way[SHADOW_WAY_COUNT];
    bool limited; /**< a gap reaches beyond the far plane */
    const char *api;
} shadow_row;

/** The bias that is enough in all maps of a set-up, for one API. */
typedef struct shadow_whole {
    const char *api;
    bool hidden, limited; /**< in a map a gap is as deep as the box, or reaches beyond the far plane */
    shadow_set way[SHADOW_WAY_COUNT];
} shadow_whole;

/** The row of map i; of a spot or point light units are those that are needed at that depth, and gaps those there of
 * the units that are enough at all. */
shadow_row shadow_row_of(const shadow_maps *maps, size_t i, const bias_api *api);

shadow_whole shadow_whole_of(const shadow_maps *maps, const bias_api *api);

#endif
