/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file compared.h  Set-ups beside each other as they were measured, and the sentences that follow from it. */
#ifndef QUANTITY_CMD_TABLE_COMPARED_H
#define QUANTITY_CMD_TABLE_COMPARED_H

#include "camera/cmd/each_setup.h"
#include "camera/cost.h"
#include "quantity/cmd/resolved.h"
#include "quantity/cmd_table/request.h"

enum { COMPARED_DEPTHS = 5 };

/* Lengths are in the unit of the comparison; the set-up has its own, see camera_of(). */
typedef struct compared {
    const dp_setup *setup;
    size_t camera;
    const unit_row *unit; /* of the set-up; null where nothing says it */
    double znear, zfar, fov_y;
    char raster[32];
    bool unbounded; /* slanted surfaces, under a mapping that promises those that face the camera alone */
    cost cost;
    char name[SETUP_LABEL_SIZE];
    double separation[COMPARED_DEPTHS]; /* NaN where the depth is not in the range of the set-up */
    double uncertain;                   /* the first of these, before far, behind which nothing is certain; NaN: none */
    double up_to[RESOLVED_LIMITS];      /* NaN: not even at near */
    dp_setup assumed;                   /* at any slant, see each_setup.h */
    double slanted_to; /* how far the middle limit goes there; NaN: not even at near, or nothing is known */
    uint64_t bytes;
    double codes, percent; /* that a depth range keeps, and of all */
} compared;

typedef struct comparison {
    const table_request *o;
    each_setup *each;
    compared *rows;
    size_t bounded; /* rows that have what is asked for; the others stand behind them, and below the table */
    double depths[COMPARED_DEPTHS];
    size_t depth_count;
    char titles[COMPARED_DEPTHS + RESOLVED_LIMITS][NUMBER_SIZE];
    int name_width, limit_begin, limit_end; /* limits that are shown */
} comparison;

/** Says which set-up reaches farthest, and what else is to be known of them; the item is the comparison. */
void compared_say(page *p, void *item);

#endif
