/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file stability.h  Where methods lose what they claim: every method over far/near from 10 to 1e12, in tiny, common
 * and huge units, at the stress inputs of its family, then with cameras that have no far/near, or another depth. A
 * code does not depend on planes: encoders walk over window depths, a binade a step.
 */
#ifndef METHOD_STABILITY_H
#define METHOD_STABILITY_H

#include "method/bench.h"

enum { STABILITY_STEPS_MAX = 23, STABILITY_MAX = BENCH_METHODS_MAX * METHOD_CASES };

/** How far beyond its claimed span a claim may still hold before the span is too modest. */
#define STABILITY_SLACK 4.0

/** The far/near of cameras besides those of the walk. */
#define STABILITY_BESIDE 1e4

/** The error from which on a method has lost its fourth digit, in relative measures; and in steps of a code. */
#define STABILITY_LOST       1e-4
#define STABILITY_LOST_STEPS 1.0

/** All cases, which have up to STABILITY_MAX results; one has up to BENCH_METHODS_MAX. */
#define STABILITY_ALL (~0U)

typedef enum stability_verdict {
    STABILITY_HOLDS = 0, /**< within the claim where claimed, and not far below; breaks where the row says so */
    STABILITY_BROKEN,    /**< an error above the claim where it should hold */
    STABILITY_MODEST,    /**< the claim is more than 4 times the worst error, or its span ends far too early */
    STABILITY_UNCLAIMED, /**< nothing is claimed, and rightly: the error passes 1/2 somewhere */
    STABILITY_VERDICTS
} stability_verdict;

typedef struct stability_result {
    const method_row *row;
    size_t which; /**< the family's case */
    int steps;
    double ratio[STABILITY_STEPS_MAX]; /**< far/near; of encoders the middle of a binade of window depths */
    double error[STABILITY_STEPS_MAX]; /**< worst over units and inputs, in the family's measure; may be infinite */
    double inside;                  /**< within the claimed span, the error that takes the largest share of its claim */
    double claim;                   /**< what is claimed there; NaN: nothing */
    double inside_near, inside_far; /**< the planes where it is reached */
    double inside_at;               /**< and the input */
    double claim_to; /**< the far/near up to which a digit is claimed, an error of 1/10; NaN: none is, or of encoders */
    double breaks;   /**< the far/near, or window depth, from which on the error exceeds the claim; INFINITY: never */
    double lost;     /**< from which on it exceeds STABILITY_LOST; INFINITY: never */
    const char
        *cause; /**< a word for what takes the fourth digit there: "cancellation", or the row's own; null: none */
    /* Errors of other cameras; NaN where the family or the mapping has none. */
    double infinite;  /**< an infinite far plane */
    double ortho;     /**< an orthographic projection, also of functions that were written for perspective, */
    double oblique;   /**< an oblique near plane, */
    double log;       /**< and logarithmic depth, of C = 1 a scene unit: standard mappings */
    double subnormal; /**< of encoders: 0 and the subnormal numbers of binary32 */
    stability_verdict verdict;
} stability_result;

/** Is a claim expected to break soon behind its span? Not one that holds everywhere, nor one that has grown to 1. */
bool stability_must_break(const method_claim *claim);

/** "holds", "broken", "too modest", "no claim". */
const char *stability_verdict_name(stability_verdict verdict);

/**
 * Walks every method in those of the cases, 1 << index or-ed, that it speaks of. The result does not depend on the
 * number of threads.
 * @return how many results, in the order of rows, cases within a row; 0 when out of memory
 */
size_t stability_run(const method_family_row *family, unsigned cases, stability_result *results);

#endif
