/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file again.h  Depths that a pass draws again, against what a prepass stored of them in another format: whether EQUAL
 * and LEQUAL hold, of every window depth.
 *
 * Both passes have the same window depth, a binary32 number. The prepass stores a code of its format, the copy reads
 * that as a number and stores the number in the format of the pass, and the pass stores its own: three roundings, all
 * of one kind. depthprec(7), "A prepass that stores something else", derives what is walked.
 */
#ifndef CONVERT_AGAIN_H
#define CONVERT_AGAIN_H

#include <stdbool.h>
#include <stdint.h>

#include "depthprec/format.h"

typedef struct again_request {
    dp_format stored; /**< of the prepass: see again_fits() */
    dp_format drawn;  /**< of the pass */
    dp_rounding rounding;
    float lo, hi;  /**< the window depths that are drawn, 0 <= lo <= hi <= 1 */
    bool reversed; /**< the test is GEQUAL, not LEQUAL */
    int threads;   /**< 0: as many as there are cores */
} again_request;

/** A bias that is needed, in window depth, and the window depth that needs it. */
typedef struct again_gap {
    double bias, depth;
} again_gap;

typedef struct again_found {
    uint64_t codes;   /**< of the prepass that depths from lo to hi are stored as */
    uint64_t unequal; /**< those of which some depth is drawn as another code than its copy: there EQUAL fails */
    uint64_t fails;   /**< those of which some depth fails the test */
    uint32_t most;    /**< codes of the pass from a depth to its copy, at most */
    double most_at;   /**< a window depth that differs so; NaN where none does */
    /** The pass must be moved towards the camera by so much that the test holds of all: the sum of a depth and that
     * bias is a binary32 number. 0 where it holds. */
    again_gap widest;
    again_gap steepest; /**< that with the greatest bias in units of 2^e, e the exponent of its depth in the format */
} again_found;

/** The more needed of two in either sense becomes that of *found. */
void again_take(const dp_format *drawn, again_gap gap, again_found *found);

/** The copy of a code of the prepass: its number, rounded once. code <= stored.code_max */
uint32_t again_copy(const again_request *request, uint32_t code);

/** Whether all codes of a prepass in that format can be looked at: fp32, and formats of at most 2^24 codes. */
bool again_fits(const dp_format *stored);

/** Looks at every code of the prepass; of fp32, which holds every window depth as it is, at none. */
again_found again_all(const again_request *request);

#endif
