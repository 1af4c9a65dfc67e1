/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file judge.h  What a function of somebody's computes, told from what it returns: pairs of what went in and what came
 * out. How it is spelled is never looked at.
 *
 * A candidate is a set-up, what went in and what comes out. It fits where every value is the candidate's, up to what
 * binary32 may lose in any order of operations, what the values were stored as, and the digits that they were printed
 * with. A function that is right for the planes at hand, in any mapping or with a factor, is never called wrong; where
 * a right and another candidate fit alike, nothing is told.
 */
#ifndef JUDGE_JUDGE_H
#define JUDGE_JUDGE_H

#include "judge/pairs.h"
#include "judge/stored.h"
#include "shader/constants.h"

/** A depth that went in, each number of it without what another would have lost. */
typedef struct judge_depth {
    double z;         /**< eye depth: INFINITY, or below 0, at and beyond the far end of 1/z; NaN: none */
    double num, comp; /**< window depth, and what is left to 1, */
    double den, ndc;  /**< as shares of `den`, and NDC depth; den 0: all that is known is z */
} judge_depth;

/** An input of a function. */
typedef struct judge_input {
    const char *name;
    judge_depth (*depth)(const dp_setup *setup, double x);
    double (*window)(double x); /**< the window depth that it is; null: none */
    double metric;              /**< 1 of an eye depth, -1 of a view z that is negative; else 0 */
} judge_input;

/** The planes that can be told from values: see `line`. */
typedef enum judge_planes { JUDGE_PLANES_NONE, JUDGE_PLANES_BOTH, JUDGE_PLANES_RATIO } judge_planes;

/** Projections by what people call functions of their depths: perspective, orthographic, what a shader writes. */
enum { JUDGE_PERSPECTIVE, JUDGE_ORTHO, JUDGE_SHADER_DEPTH, JUDGE_PROJECTIONS };

/** An output of a function. */
typedef struct judge_output {
    const char *name, *formula;
    const char *called[JUDGE_PROJECTIONS]; /**< what people call it, and where; null: as of a perspective */
    const char *source;                    /**< where it is defined */
    double (*of)(const dp_setup *setup, const judge_depth *depth);
    bool unbounded;                                 /**< infinite where depth is */
    double (*window)(double v);                     /**< the window depth that a value is; null: it is none */
    double (*eye)(const dp_setup *setup, double v); /**< the eye depth that a value stands for; null: it is none */
    bool of_windows; /**< made of window depths alone: of others it is the one of the other direction */
    bool whole;      /**< a code: whole numbers, of window and eye depths */
    judge_planes planes;
    /** From a value v at a share of the way from near to far in 1/z, orthographic in z, a number affine in the share:
     * that of near and far themselves, or far/near at 0 and 1 at 1, orthographic near/far. NaN: none */
    double (*line)(double v, double share, bool ortho);
} judge_output;

/** Null beyond the last. */
enum { JUDGE_WINDOW, JUDGE_NDC, JUDGE_CODES, JUDGE_EYE, JUDGE_VIEW };
const judge_input *judge_input_get(size_t index);
const judge_output *judge_output_get(size_t index);

/** The depth that an eye depth is. */
judge_depth judge_depth_of(const dp_setup *setup, double z);

/** z - near and far - z, with no digit lost where the window depth is known; far - z is INFINITY where far is. */
double judge_behind(const dp_setup *setup, const judge_depth *at);
double judge_left(const dp_setup *setup, const judge_depth *at);

typedef enum judge_verdict {
    JUDGE_RIGHT,  /**< for a set-up that was asked about, */
    JUDGE_OTHER,  /**< for another one alone */
    JUDGE_WRONG,  /**< a formula that is known to be wrong */
    JUDGE_UNKNOWN /**< cannot tell */
} judge_verdict;

/** "right", "another set-up", "wrong", "unknown" */
const char *judge_verdict_name(judge_verdict verdict);

/** Something that the pairs may be of. */
typedef struct judge_candidate {
    dp_setup setup;
    const judge_input *input;
    const judge_output *output;
    const trap_row *trap; /**< of a wrong formula; else null */
    double factor;        /**< by which the output is multiplied: 1 */
} judge_candidate;

/** The value of a candidate at x; NaN where it has none. */
double judge_value(const judge_candidate *c, double x);

/** The precision lost by the values, the least loss that explains them: see judge_precision_name(). */
typedef enum judge_precision {
    JUDGE_BINARY32,   /**< roundings of binary32 */
    JUDGE_DIFFERENCE, /**< the same after a difference from 1, or from a plane: what lay near 0 lost its precision */
    JUDGE_BINARY16,   /**< values stored in binary16, rounded or cut */
    JUDGE_BYTES,      /**< or in 8 bits, */
    JUDGE_CUT_BYTES,  /**< which are cut */
    JUDGE_DIGITS,     /**< or as digits in several bytes: one for each of STORED_DIGITS ways */
    JUDGE_QUICK = JUDGE_DIGITS + STORED_DIGITS, /**< or come of a quick reciprocal: one for each number of steps */
    JUDGE_PRINTED = JUDGE_QUICK + STORED_STEPS  /**< roundings of binary32, and of the digits that are printed */
} judge_precision;

const char *judge_precision_name(judge_precision precision);

enum { JUDGE_SAME = 3 };

typedef struct judgement {
    judge_verdict verdict;
    bool named;            /**< `found` is there */
    judge_candidate found; /**< what it computes; of UNKNOWN what it may */
    bool also;
    judge_candidate other; /**< where `also`: what fits as well */
    double decides;        /**< what to put in, so that one of both is left; NaN: nothing would */
    judge_candidate
        same[JUDGE_SAME]; /**< by another name the same for the planes at hand; of a multiple, a trap, too */
    size_t same_count;
    judge_precision precision;
    double error, at;    /**< the largest relative error of a value, and what went in there; 0, NaN: none */
    double off;          /**< the largest error of a value, not relative */
    double intervals, z; /**< the largest error in z-fighting intervals, and the eye depth there; NaN: it has none */
    const char *because; /**< of UNKNOWN: why, a phrase; else null */
    uint64_t strays;     /**< of judge_more(): pairs that do not fit what was found of fewer, */
    double stray;        /**< the first */
} judgement;

/** Planes that nobody gave: a set of bits. */
typedef enum judge_open {
    JUDGE_OPEN_NONE = 0,
    JUDGE_OPEN_NEAR = 1,
    JUDGE_OPEN_FAR = 2,
    JUDGE_OPEN = JUDGE_OPEN_NEAR | JUDGE_OPEN_FAR
} judge_open;

enum { JUDGE_LEAST = 3, JUDGE_FITTED_LEAST = 5 }; /* different pairs, without and with planes that are to be found */

/**
 * @param setups      those that are asked about, at least one, of the same planes
 * @param open  which planes are not known: those that fit are right then; of one, what fits that of the set-ups first
 */
void judge_function(const judge_pairs *pairs, const dp_setup *setups, size_t count, judge_open open, judgement *out);

/** Looks at more pairs of a function that is named: what it loses is the most of both, and what does not fit counts. */
void judge_more(const judge_pairs *pairs, judgement *out);

#endif
