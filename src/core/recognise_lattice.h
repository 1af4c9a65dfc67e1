/* SPDX-License-Identifier: MIT */
/* For the rooms above too: which lattice numbers lie on, what different ones say about it, and steps they were rounded
 * to. */
#ifndef CORE_RECOGNISE_LATTICE_H
#define CORE_RECOGNISE_LATTICE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/** The named lattices from the fewest codes to the most. */
typedef enum dp_lattice {
    DP_LATTICE_FP16 = 0,
    DP_LATTICE_UNORM16,
    DP_LATTICE_UNORM24,
    DP_LATTICE_FP32, /**< every number of binary32 */
    DP_LATTICE_COUNT
} dp_lattice;

/** "fp16", ... as dp_format_parse() has them. */
const char *dp_lattice_name(dp_lattice which);

/** Adds to off[] how many of `count` numbers of [0, 1] do not lie on each lattice; NaN are passed over. A number that
 *  is not binary32 is off all of them here. */
void dp_lattice_single(const double *d, size_t count, size_t off[DP_LATTICE_COUNT]);

/** The same for numbers that are not all binary32: unorm within 1 ulp of binary64. */
void dp_lattice_double(const double *d, size_t count, size_t off[DP_LATTICE_COUNT]);

/** The share of numbers near d that lie on a lattice by chance, see recognise.h. 0 <= d <= 1 */
double dp_lattice_chance(dp_lattice which, bool single, double d);

/** The greatest common divisor; of 0 and b it is b. */
size_t dp_common_divisor(size_t a, size_t b);

/** Different numbers. */
typedef struct dp_distinct {
    uint64_t *slots; /**< null: nothing is counted */
    size_t size;     /**< how many slots are used: a power of two; 0 without any */
    size_t count;    /**< at most DP_RECOGNISE_DISTINCT */
} dp_distinct;

/** For at most `most` numbers. @param slots  DP_RECOGNISE_SLOTS, or null */
void dp_distinct_init(dp_distinct *set, uint64_t *slots, size_t most);
/** @return whether d, not a NaN, is new, and was counted */
bool dp_distinct_add(dp_distinct *set, double d);

/** The kind of samples among which grids are sought. */
typedef struct dp_grid_source {
    int bits;      /**< numbers: significant bits */
    double finest; /**< steps of the lattice itself, INFINITY for none: a grid has fewer */
    double top;    /**< integers: that of 1; 0: numbers */
    bool dyadic;   /**< numbers on a lattice that k/2^N lies on by itself, as fp16: not a grid, but for N = 8 */
} dp_grid_source;

/** Steps of 1/steps that an image was rounded to before it was stored. */
typedef struct dp_grid {
    double steps; /**< 0: none */
    double bits;  /**< -log2 of the chance that the samples lie on it all the same */
} dp_grid;

/** -log2 of the chance that all of the set lie on a grid and no grid is there; negative when one is off. */
double dp_grid_agreement(const dp_distinct *set, const dp_grid_source *source, double steps);

/**
 * The coarsest of k/(2^N - 1), k/2^N and bits that were shifted up, for N = 8 to 16, that all of the set lie on,
 * whether by chance or not: a few values cannot exclude it. 0 and 1 lie on all and say nothing. A set that is full lies
 * on none.
 */
dp_grid dp_grid_find(const dp_distinct *set, const dp_grid_source *source);

#endif
