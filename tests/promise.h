/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file promise.h  The promise of the guaranteed separation s, put to the test.
 *
 *     For all real depths z1 < z2 in [near, far] with z2 - z1 >= s(z1) the codes are strictly in order.
 *
 * What enters the pipeline is each depth rounded to binary32. So a binary32 depth x stands for its *cell*, all reals
 * that round to it, and a pair x1 <= x2 whose codes are not in order breaks the promise if its cells hold z1 and z2
 * that far apart. A *window* is a list of runs of consecutive binary32 depths: every pair of its depths is judged, by
 * a running extreme of the codes from its far end.
 */
#ifndef TESTS_PROMISE_H
#define TESTS_PROMISE_H

#include "depthprec/depthprec.h"
#include "promise_pipeline.h"
#include "support.h"

/* ---- Depths ------------------------------------------------------------------------------------------------------ */

/**
 * Binary32 depths of either sign are counted by their *rank*, which is 2^31 at zero and one more at the next depth.
 */
double promise_depth(uint32_t rank);
uint32_t promise_rank(double z); /**< of z rounded to binary32 */

/** The first and the last binary32 depth that a depth of [near, far] rounds to. */
typedef struct promise_range {
    double znear, zfar; /**< zfar: at most the last double that rounds to a finite number */
    uint32_t first, last;
} promise_range;

promise_range promise_range_of(const dp_setup *setup);

/** The ends of a depth's cell: the extreme doubles that round to it, within the range. */
double promise_cell_lo(const promise_range *range, uint32_t rank);
double promise_cell_hi(const promise_range *range, uint32_t rank);

/* ---- Drawing ----------------------------------------------------------------------------------------------------- */

/** A random set-up in the model float, near > 0. */
dp_setup promise_draw(rng *r);

/** The same of an orthographic camera with near <= 0; far may be 0 or less too. */
dp_setup promise_draw_signed(rng *r);

enum { PROMISE_RUNS = 4 };

/** A window: runs of consecutive depths, in order and apart. */
typedef struct promise_window_plan {
    int count;
    struct {
        uint32_t first, count;
    } run[PROMISE_RUNS];
    double place; /**< the depth that it was planned about */
} promise_window_plan;

/** A place in the range: about a plane, 0, a power of two of z or of the window depth, or anywhere. */
double promise_place(rng *r, const promise_pipe *p, const promise_range *range);

/**
 * The window about a place: consecutive depths if s spans no more than half of them, else three runs: where the code
 * of the place begins, where it ends, and one s behind its beginning.
 */
promise_window_plan promise_plan(const dp_setup *setup, const promise_pipe *p, double place, uint32_t depths);

/* ---- Judging ----------------------------------------------------------------------------------------------------- */

/** The worst pair of a window, or of many. */
typedef struct promise_pair {
    dp_setup setup;
    bool flush;
    uint32_t x1, x2; /**< the binary32 depths */
    uint32_t code1, code2;
    double z1, z2; /**< the real depths that stand for them */
    double bound;  /**< s(z1) */
    double ratio;  /**< (z2 - z1) / s(z1) */
    bool broken;   /**< z2 - z1 >= s(z1), exactly */
} promise_pair;

typedef struct promise_result {
    uint64_t depths;
    uint64_t broken;              /**< nearer depths with a pair that breaks the promise */
    promise_pair worst;           /**< ratio 0 if no pair is out of order */
    bool present[DP_CAUSE_COUNT]; /**< the cause takes something of a bound that was met */
    bool noticed[DP_CAUSE_COUNT]; /**< had it been half as large, the promise would have been broken */
} promise_result;

/** The guaranteed separation; INFINITY where the library refuses. */
double promise_bound(const dp_setup *setup, double z);

/** Whether z1 + s <= z2, in exact arithmetic. */
bool promise_beyond(double z1, double s, double z2);

/**
 * Judges two depths whose codes are not in order, with the bound at both ends of the nearer one's cell and at the
 * depth itself. *worst becomes the pair if its ratio is greater.
 */
void promise_judge_pair(const dp_setup *setup, const promise_pipe *p, uint32_t x1, uint32_t x2, promise_pair *worst);

/** Judges every pair of a window, and adds to *result. */
void promise_judge(const dp_setup *setup, const promise_pipe *p, const promise_window_plan *plan,
                   promise_result *result);

/** A line that brings the pair back: the command, the pair, the codes, the bound. */
void promise_line(const promise_pair *pair, char *text, size_t size);

/** What kind of pair it is, as a few words. */
const char *promise_class(const promise_pair *pair);

/* ---- Tightness --------------------------------------------------------------------------------------------------- */

typedef struct promise_band {
    dp_setup setup;
    double lo, hi; /**< a binade of z, cut by the planes */
    bool cut;      /**< by far */
    double bound;  /**< the largest s at 257 depths of it */
    double bound_z;
    double longest; /**< between binary32 depths, the nearer one in the band */
    double longest_z;
    double slack;         /**< bound / (longest + one step of z); NaN if not measured */
    double slack_held;    /**< the same with no s longer than what is left up to far */
    double slack_lattice; /**< the same against the lattice's own separation, where that is longer than `longest` */
    promise_pair worst;   /**< of the pairs that were judged */
} promise_band;

/**
 * Sweeps the whole band that z lies in. Of each 4096 depths the longest pair is judged.
 */
promise_band promise_measure_band(const dp_setup *setup, double z);

#endif
