/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The parts that a census is cut into, and what they are asked. */
#ifndef ZFIGHT_PARTS_H
#define ZFIGHT_PARTS_H

#include "zfight/range.h"

typedef struct census_segment {
    uint32_t first, count; /* depths by rank */
    size_t block;          /* its first block, in the list of all */
    int band;
    census_band found; /* pairs and bounds are not filled in */
} census_segment;

typedef struct census_parts {
    const census_request *request;
    const census_level *level;
    census_plan plan;
    census_range range;
    census_segment *segments;
    size_t segment_count, block_count;
    uint32_t *block_first;
    int32_t *least, *greatest;           /* of each block; least becomes the least from there on to the end */
    census_band known[CENSUS_BANDS_MAX]; /* longest and slack so far of each band: a segment need not look for less */
} census_parts;

/* The last of from..end, runs or blocks, whose keys or those behind come down to v: from itself does. */
static inline size_t census_down_to(const int32_t *least, size_t from, size_t end, int32_t v) {
    while (from < end) {
        const size_t middle = end - (end - from) / 2;
        if (least[middle] <= v)
            from = middle;
        else
            end = middle - 1;
    }
    return from;
}

/* Whether the guarantee falls on the way to a farther depth, by more than is worth telling. */
static inline int census_falls(double here, double farther) {
    return farther < 0.9995 * here;
}

/* Intervals from one segment into a later one. Needs `least` to run on to the end. */
void census_bridge(const census_parts *c, census_result *result);

#endif
