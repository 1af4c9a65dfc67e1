/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by census and sample: the depths of a range, its bands, and how findings are put together. */
#ifndef ZFIGHT_RANGE_H
#define ZFIGHT_RANGE_H

#include "zfight/census.h"

/* Depths by rank, see dp_rank32(); a binade and a sign for every 2^23 ranks. */
typedef struct census_range {
    uint32_t first, last;
    uint32_t folded; /* binades on either side of 0 that are one band together; 0 in a range of depths above 0 */
} census_range;

/* Checks a request and sets the bands up. */
census_status census_open(const census_request *request, census_plan *plan, census_result *result, census_range *range);

/* How many threads a request wants, at least 1. */
int census_threads(const census_request *request);

/* Binades counted from the least, where those next to 0 are one. */
static inline uint32_t census_folded(const census_range *range, uint32_t rank) {
    const uint32_t binade = rank >> 23, zero = 256, n = range->folded;
    return binade + n < zero ? binade : binade < zero + n ? zero - n : binade - 2 * n + (n > 0);
}

/* The index of a depth's band. */
static inline int census_band_of(const census_range *range, uint32_t rank) {
    return (int)(census_folded(range, rank) - census_folded(range, range->first));
}

/* The distance from a depth to the next one. */
static inline double census_step(uint32_t rank) {
    return (double)dp_ranked32(rank + 1) - (double)dp_ranked32(rank);
}

/* The greater of the steps to either side. */
static inline double census_ulp(float z) {
    return census_step(dp_rank32(z < 0.0f ? -z : z));
}

/* Takes an interval into account. Where several are as long, the nearest is kept, so the order does not matter. */
void census_note(const census_request *request, census_band *band, float z1, float z2);

/* Adds up what was counted. Of intervals as long the nearest is kept, so the order does not matter. */
void census_add(census_band *to, const census_band *from);

/* `all`, the effective planes and the holes, from the finished bands. */
void census_close(const census_request *request, const census_plan *plan, const census_range *range,
                  census_result *result);

#endif
