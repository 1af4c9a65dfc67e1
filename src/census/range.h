/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the census and the sample share: the depths of a range, its bands, and how findings are put together. */
#ifndef CENSUS_RANGE_H
#define CENSUS_RANGE_H

#include "census/census.h"

/* Checks a request and sets the bands up. *first and *last are the bit patterns of the range's ends. */
census_status census_open(const census_request *request, census_plan *plan, census_result *result, uint32_t *first,
                          uint32_t *last);

/* How many threads a request wants, at least 1. */
int census_threads(const census_request *request);

/* The index of a depth's band. */
static inline int census_band_of(uint32_t first, uint32_t bits) {
    return (int)(bits >> 23) - (int)(first >> 23);
}

/* The binary32 step in a depth's band. */
static inline double census_step(uint32_t bits) {
    return (double)dp_float32(bits + 1) - (double)dp_float32(bits);
}

/* Takes an interval into account. Where several are as long, the nearest is kept, so the order does not matter. */
void census_note(const census_request *request, census_band *band, float z1, float z2);

/* Adds up what was counted. Of intervals as long the nearest is kept, so the order does not matter. */
void census_add(census_band *to, const census_band *from);

/* `all`, the effective planes and the holes, from the finished bands. */
void census_close(const census_request *request, const census_plan *plan, uint32_t first, uint32_t last,
                  census_result *result);

#endif
