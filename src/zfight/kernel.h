/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file kernel.h  The inner loops of the census: the codes of many binary32 depths, and what is seen in them.
 *
 * The arithmetic is dp_pipeline_code()'s, one array pass per operation, so that each is one rounded binary32
 * operation on every processor. A level is the same C compiled for another instruction set: all give the same bits.
 *
 * A *key* is a code turned so that a correct buffer has strictly increasing keys with distance: reversed codes are
 * complemented, and the sign bit is flipped so that keys compare as signed numbers, which every instruction set can.
 * Binary32 depths are counted by their ranks, see dp_rank32().
 *
 * A *block* is 1024 neighbouring depths seen as 16 runs of 64. It lies in memory by rows: row r holds the r-th depth,
 * counted from the far end, of all 16 runs, the farthest run first. So neighbours in depth are 16 apart in memory, a
 * vector holds one depth of each run, and a scan along the depths needs no shuffles.
 */
#ifndef ZFIGHT_KERNEL_H
#define ZFIGHT_KERNEL_H

#include "core/bits.h"
#include "depthprec/batch.h"
#include "depthprec/pipeline.h"

enum { CENSUS_RUNS = 16, CENSUS_RUN = 64, CENSUS_BLOCK = CENSUS_RUNS * CENSUS_RUN };

/** How window depths become codes. PLAIN asks dp_pipeline_convert() for each: formats that no hardware has. */
typedef enum census_conversion {
    CENSUS_BITS,
    CENSUS_UP,
    CENSUS_EVEN,
    CENSUS_ZERO,
    CENSUS_PRODUCT_EVEN,
    CENSUS_PRODUCT_ZERO,
    CENSUS_FLOAT_EVEN,
    CENSUS_FLOAT_ZERO,
    CENSUS_PLAIN
} census_conversion;

typedef struct census_plan {
    dp_pipeline pipeline;
    census_conversion conversion;
    uint32_t flip; /**< key = code ^ flip */
} census_plan;

census_plan census_plan_make(const dp_pipeline *pipeline);

/** The key of one depth, the slow way. */
static inline int32_t census_key(const census_plan *plan, float z) {
    return (int32_t)(dp_pipeline_code(&plan->pipeline, z) ^ plan->flip);
}

/** Findings in a block. Runs are counted from the far end. */
typedef struct census_sight {
    uint32_t ties, swaps; /**< among neighbours inside the block */
    uint32_t clipped;     /**< depths that clipping would lose */
    int32_t least[CENSUS_RUNS], greatest[CENSUS_RUNS];
} census_sight;

typedef struct census_level {
    const char *name;
    dp_path path; /**< whose instructions it takes */
    /** The keys of `count` depths, at most CENSUS_BLOCK. */
    void (*keys)(const census_plan *plan, const float *z, size_t count, int32_t *key);
    /** Keys of the block that begins at rank `first`, by rows; depths behind `last` are taken as `last`. */
    void (*block)(const census_plan *plan, uint32_t first, uint32_t last, int32_t *key, census_sight *sight);
    /** reach[p] = the least key among the depths of p's run from p on to the far end, and beyond[run]. */
    void (*reach)(const int32_t *key, const int32_t *beyond, int32_t *reach);
    /**
     * Bit i is set when run i holds a depth whose key is not below that of some depth at least `delay` (1..63) steps
     * farther; `before` is the column of reach of the run behind run 0.
     */
    uint32_t (*far_disorder)(const int32_t *key, const int32_t *reach, const int32_t *before, unsigned delay);
} census_level;

/** The levels, slowest first; index below census_level_count. The first is always supported. */
extern const census_level census_levels[];
extern const size_t census_level_count;

/** The fastest level that this processor supports. */
const census_level *census_level_best(void);

#endif
