/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file reference.h  The promise of the guaranteed separation s, put to the test.
 *
 *     For all real depths z1 < z2 in [near, far] with z2 - z1 >= s(z1) the codes are strictly in order.
 *
 * What enters the pipeline is each depth rounded to binary32. So a binary32 depth x stands for its *cell*, all reals
 * that round to it, and a pair x1 <= x2 whose codes are not in order breaks the promise if its cells hold z1 and z2
 * that far apart. A *window* is a list of runs of consecutive binary32 depths: every pair of its depths is judged, by
 * a running extreme of the codes from its far end.
 */
#ifndef TESTS_REFERENCE_H
#define TESTS_REFERENCE_H

#include "depthprec/depthprec.h"
#include "reference_pipeline.h"
#include "support.h"

/* ---- Depths ------------------------------------------------------------------------------------------------------ */

/**
 * Binary32 depths of either sign are counted by their *rank*, which is 2^31 at zero and one more at the next depth.
 */
double reference_depth(uint32_t rank);
uint32_t reference_rank(double z); /**< of z rounded to binary32 */

/** The first and the last binary32 depth that a depth of [near, far] rounds to. */
typedef struct reference_range {
    double znear, zfar; /**< zfar: at most the last double that rounds to a finite number */
    uint32_t first, last;
} reference_range;

reference_range reference_range_of(const dp_setup *setup);

/** The ends of a depth's cell: the extreme doubles that round to it, within the range. */
double reference_cell_lo(const reference_range *range, uint32_t rank);
double reference_cell_hi(const reference_range *range, uint32_t rank);

/* ---- Drawing ----------------------------------------------------------------------------------------------------- */

/** A random set-up in the model float, near > 0. */
dp_setup reference_draw(rng *r);

/** The same of an orthographic camera with near <= 0; far may be 0 or less too. */
dp_setup reference_draw_signed(rng *r);

enum { REFERENCE_RUNS = 4 };

/** A window: runs of consecutive depths, in order and apart. */
typedef struct reference_window_plan {
    int count;
    struct {
        uint32_t first, count;
    } run[REFERENCE_RUNS];
    double place; /**< the depth that it was planned about */
} reference_window_plan;

/** A place in the range: about a plane, 0, a power of two of z or of the window depth, or anywhere. */
double reference_place(rng *r, const reference_pipe *p, const reference_range *range);

/**
 * The window about a place: consecutive depths if s spans no more than half of them, else three runs: where the code
 * of the place begins, where it ends, and one s behind its beginning.
 */
reference_window_plan reference_plan(const dp_setup *setup, const reference_pipe *p, double place, uint32_t depths);

/* ---- Judging ----------------------------------------------------------------------------------------------------- */

/** The worst pair of a window, or of many. */
typedef struct reference_pair {
    dp_setup setup;
    bool flush;
    uint32_t x1, x2; /**< the binary32 depths */
    uint32_t code1, code2;
    double z1, z2; /**< the real depths that stand for them */
    double bound;  /**< s(z1) */
    double ratio;  /**< (z2 - z1) / s(z1) */
    bool broken;   /**< z2 - z1 >= s(z1), exactly */
} reference_pair;

typedef struct reference_result {
    uint64_t depths;
    uint64_t broken;              /**< nearer depths with a pair that breaks the promise */
    reference_pair worst;         /**< ratio 0 if no pair is out of order */
    bool present[DP_CAUSE_COUNT]; /**< the cause takes something of a bound that was met */
    bool noticed[DP_CAUSE_COUNT]; /**< had it been half as large, the promise would have been broken */
} reference_result;

/** The guaranteed separation; INFINITY where the library refuses. */
double reference_bound(const dp_setup *setup, double z);

/** Whether z1 + s <= z2, in exact arithmetic. */
bool reference_beyond(double z1, double s, double z2);

/**
 * Judges two depths whose codes are not in order, with the bound at both ends of the nearer one's cell and at the
 * depth itself. *worst becomes the pair if its ratio is greater.
 */
void reference_judge_pair(const dp_setup *setup, const reference_pipe *p, uint32_t x1, uint32_t x2,
                          reference_pair *worst);

/** Judges every pair of a window, and adds to *result. */
void reference_judge(const dp_setup *setup, const reference_pipe *p, const reference_window_plan *plan,
                     reference_result *result);

/** A line that brings the pair back: the command, the pair, the codes, the bound. */
void reference_line(const reference_pair *pair, char *text, size_t size);

/** The kind of the pair, as a few words. */
const char *reference_class(const reference_pair *pair);

/* ---- Tightness --------------------------------------------------------------------------------------------------- */

typedef struct reference_band {
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
    reference_pair worst; /**< of the pairs that were judged */
} reference_band;

/**
 * Sweeps the whole band that z lies in. Of each 4096 depths the longest pair is judged.
 */
reference_band reference_measure_band(const dp_setup *setup, double z);

#endif
