/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file reach.h  How far one can trust a set-up: the depths up to which each of the common separations is guaranteed.
 */
#ifndef QUANTITY_CMD_TABLE_REACH_H
#define QUANTITY_CMD_TABLE_REACH_H

#include "quantity/cmd/resolved.h"
#include "quantity/cmd_table/in_preset.h"

/** A separation, and the depths up to which it is guaranteed; NaN: not even at near, or nothing is at a slant. */
typedef struct reach {
    double separation, facing, any_slant;
    double from, to; /**< the numbers of the preset that keep it */
} reach;

typedef struct reached {
    reach of[RESOLVED_LIMITS];
    double zfar;
    const unit_row *unit; /**< may be null */
} reached;

/** @param full       dp_setup_guaranteed() of surfaces that face the camera
 *  @param any_slant  of those at any slant; null where nothing is guaranteed to them */
void reach_find(const dp_setup *full, const dp_setup *any_slant, const unit_row *unit, const in_preset *p,
                reached *out);

/** Says it of surfaces that face the camera, or of others, in words `which`; the second of two begins in its own words,
 * else `begin` is null. */
void reach_say(page *p, const reached *r, bool facing, const char *which, const char *begin);

#endif
