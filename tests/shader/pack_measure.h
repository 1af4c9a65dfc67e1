/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file pack_measure.h  What the claims of packings speak of, measured: see shader/pack.h. */
#ifndef PACK_MEASURE_H
#define PACK_MEASURE_H

#include "shader/pack.h"

/** The error over the whole domain. */
typedef struct pack_error {
    pack_bound depth, normal; /**< as the claims */
    double depth_bias;        /**< mean of decoded - given */
    double depth_at;          /**< an input that reaches depth.max, to 1e-6 of it */
    double normal_at[3];      /**< an input that reaches normal.max, to 1e-6 of it */
    double normal_spread;     /**< standard error of normal.mean, degrees */
    uint64_t codes;           /**< combinations of channel codes that inputs are stored as, those of the depth apart */
    uint64_t depth_codes;
} pack_error;

/**
 * Measures a row; at most about half a second.
 *
 * Maxima of normals are those of the continuous domain: each code is visited, and the angle is largest at a corner of
 * the region that is stored as it (depthprec(7)). Means of normals are over 2^20 evenly spread vectors. Depths in exact
 * arithmetic: every code with its own interval. In binary32: every binary32 number in [2^-9, 1), every 61st below.
 */
pack_error pack_measure(const pack_row *row);

/** How many rows there are; what pack_measure() makes of one by its name, measured once. */
size_t pack_count(void);
const pack_error *pack_error_of(const char *name);

#endif
