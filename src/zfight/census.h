/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file census.h  Every binary32 eye depth of a range through the binary32 pipeline: ties, swaps, longest intervals.
 *
 * The depths are all binary32 values in [lo, hi]. *Pairs* are neighbours among them; *ties* store equal codes, *swaps*
 * codes in the wrong order; an *interval* is any two depths z1 < z2, neighbours or not, whose codes are not strictly
 * in the right order, and *longest* is the greatest z2 - z1 of all. Nothing is sampled: a result is a fact about the
 * set-up. A band is a binade of z, of either sign; of a range that reaches 0 or below, what is nearer to 0 than about
 * 2^-10 of its farther end is one band. A pair and an interval belong to the band of their nearer depth, the lesser
 * one.
 *
 * Depths outside the clip volume are clamped as a depth clamp does, and counted apart.
 *
 * Cost: about a nanosecond a depth and core; 12 bytes per 1024 depths. The result does not depend on the number of
 * threads or on the processor.
 */
#ifndef ZFIGHT_CENSUS_H
#define ZFIGHT_CENSUS_H

#include <stdbool.h>

#include "depthprec/setup.h"
#include "zfight/kernel.h"

enum { CENSUS_BANDS_MAX = 256 };
#define CENSUS_CALM 0x1p-7

/** One band, or all of them together. */
typedef struct census_band {
    double lo, hi;        /**< of z, cut to the range; hi is the next band's lo */
    uint64_t pairs;       /**< neighbours whose nearer one is in the band */
    uint64_t ties, swaps; /**< of those pairs */
    uint64_t clipped;     /**< depths of the band that clipping would lose */
    double longest;       /**< scene units; 0 when every pair is in order */
    double longest_z;     /**< its nearer depth, the nearest where several intervals are as long; NaN when none */
    double first;         /**< census_sample(): the nearest depth whose pair ties or swaps; NaN: none does */
    double last_apart;    /**< census_sample(): the farthest whose pair is in order; NaN: none is */
    double bound;         /**< the greatest guaranteed separation at 1025 depths of the band, none longer than what is
                               left up to far; NaN without a bound */
    double slack;         /**< used: greatest share of bound(z1) that two surfaces may be apart which are stored as the
                               ends of an interval: z2 - z1 and half a step of either; above 1 it is broken; 0 where
                               every pair is in order */
    double slack_z;       /**< a depth where it is reached */
} census_band;

typedef struct census_result {
    int band_count;
    census_band bands[CENSUS_BANDS_MAX]; /**< nearest first */
    census_band all;                     /**< bound: the greatest of the bands */
    double near_effective;               /**< nearest and farthest depth in the range that clipping keeps; NaN: none */
    double far_effective;
    uint64_t holes; /**< depths between these two that clipping loses all the same */
} census_result;

typedef enum census_status {
    CENSUS_DONE = 0,
    CENSUS_STOPPED, /**< progress asked for it */
    CENSUS_RANGE,   /**< no binary32 depth in the range, or an infinite one */
    CENSUS_MODEL,   /**< the mapping has no pipeline */
    CENSUS_NO_MEMORY
} census_status;

typedef struct census_request {
    const dp_setup *setup; /**< with spec.arith; spec.model is not read */
    double lo, hi;         /**< scene units, within [near, far], hi finite */
    int threads;           /**< 0: as many as OpenMP would take */
    /** The guaranteed separation, or null. Taken to be monotone over 1024 neighbouring depths, but where it may fall:
     */
    double (*bound)(const dp_setup *setup, double z);
    bool falls; /**< by as much as z rises, at any depth, and leap up behind */
    /** How many neighbouring depths, a multiple of 1024, the bound is calm over, so that the census asks for it only
     * where it may decide. In a binade of depths above 0, but for so many at its beginning, it is nowhere below what it
     * is at both ends of so many by more than two steps of binary32 and CENSUS_CALM of it, and, where it falls, by
     * their width. 0: nothing is known. */
    uint32_t calm;
    /** Told now and then, by one thread at a time, how many depths are done; nonzero stops the census. May be null. */
    int (*progress)(void *context, uint64_t done);
    void *context;
    const census_level *level; /**< null: the fastest */
    uint32_t segment; /**< depths swept as one, at most 2^18; 0: that many. Tests take fewer, to have more borders */
} census_request;

/** The request of zfight: the guaranteed separation of a set-up, which is calm. */
census_request census_of_guarantee(const dp_setup *setup, double lo, double hi);

/** How many depths the census will visit. */
uint64_t census_count(double lo, double hi);

/** Runs it. On anything but CENSUS_DONE *result holds nothing of use. */
census_status census_run(const census_request *request, census_result *result);

typedef struct census_sample_request {
    census_request common;
    uint64_t count; /**< pairs to draw; 0: every depth of the range, which needs a gap */
    uint64_t most;  /**< of every depth: so many at most, from the nearest on; 0: all */
    uint64_t seed;
    double gap; /**< scene units; 0: the pairs are neighbours */
} census_sample_request;

/**
 * Pairs (z, z + gap rounded to binary32), or neighbours where gap is 0, at depths drawn with equal chance from all
 * binary32 depths of the range by a counter-based generator: draw i depends on the seed and i alone. Pairs that leave
 * the range are not counted. Without a gap `longest` is the longest interval found by stepping away from each depth
 * drawn in doubling steps: a lower bound of the census's. With a gap it is 0, and `clipped` is 0 always.
 */
census_status census_sample(const census_sample_request *request, census_result *result);

#endif
