/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file recognise_lattice.h  For the recognition alone: which lattice numbers lie on, and what they say about it.
 */
#ifndef FRAME_RECOGNISE_LATTICE_H
#define FRAME_RECOGNISE_LATTICE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/** The named lattices from the fewest codes to the most. */
typedef enum lattice {
    LATTICE_FP16 = 0,
    LATTICE_UNORM16,
    LATTICE_UNORM24,
    LATTICE_FP32, /**< every number of binary32 */
    LATTICE_COUNT
} lattice;

/** "fp16", ... as dp_format_parse() has them. */
const char *lattice_name(lattice which);

/** Adds to off[] how many of `count` numbers of [0, 1] do not lie on each lattice; NaN are passed over. A number that
 *  is not binary32 is off all of them here. */
void lattice_single(const double *d, size_t count, size_t off[LATTICE_COUNT]);

/** The same for numbers that are not all binary32: unorm within 1 ulp of binary64. */
void lattice_double(const double *d, size_t count, size_t off[LATTICE_COUNT]);

/** The share of numbers near d that lie on a lattice by chance, see recognise.h. 0 <= d <= 1 */
double lattice_chance(lattice which, bool single, double d);

/** The greatest common divisor; of 0 and b it is b. */
uint32_t common_divisor(uint32_t a, uint32_t b);

/** Different numbers. */
typedef struct distinct_set {
    uint64_t *slots; /**< null when there was no memory: nothing is counted */
    size_t size;     /**< how many slots: a power of two */
    size_t count;    /**< at most RECOGNISE_DISTINCT_MAX */
} distinct_set;

/** For at most `most` numbers. */
void distinct_init(distinct_set *set, size_t most);
void distinct_free(distinct_set *set);
/** @return whether d, not a NaN, is new, and was counted */
bool distinct_add(distinct_set *set, double d);

/** What grids are looked for among. */
typedef struct grid_source {
    int bits;      /**< numbers: significant bits */
    double finest; /**< steps of the lattice itself, INFINITY for none: a grid has fewer */
    double top;    /**< integers: that of 1; 0: numbers */
    bool dyadic;   /**< numbers on a lattice that k/2^N lies on by itself, as fp16: not a grid, but for N = 8 */
} grid_source;

/** Steps of 1/steps that an image was rounded to before it was stored. */
typedef struct grid {
    double steps; /**< 0: none */
    double bits;  /**< -log2 of the chance that the samples lie on it all the same */
} grid;

/** -log2 of the chance that all of the set lie on a grid and no grid is there; negative when one is off. */
double grid_agreement(const distinct_set *set, const grid_source *source, double steps);

/**
 * The coarsest of k/(2^N - 1), k/2^N and bits that were shifted up, for N = 8 to 16, that all of the set lie on,
 * whether by chance or not: a few values cannot exclude it. 0 and 1 lie on all and say nothing. A set that is full lies
 * on none.
 */
grid grid_find(const distinct_set *set, const grid_source *source);

#endif
