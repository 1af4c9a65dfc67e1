/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file verdict.h  Whether a bias that somebody has is enough, with a proof either way or none.
 *
 *     const bias_state state = {bias_api_find("gl"), -2, -1, 0};
 *     const bias_verdict v = bias_judge(&setup, &state, &(bias_goal){.api = state.api}, 0.1, 1000);
 *     if (v.answer == BIAS_NOT_ENOUGH) ... at v.z both layers are stored as v.code ...
 *
 * "Enough" is what bias_enough_over() proves of the whole range. "Not enough" has a witness: a binary32 depth of that
 * range at which the hardware, adding the bias as the API's row says, stores the layer no nearer than the one below.
 * What neither is found of is not proven.
 */
#ifndef BIAS_VERDICT_H
#define BIAS_VERDICT_H

#include "bias/bias.h"

typedef enum bias_answer { BIAS_NOT_PROVEN = 0, BIAS_ENOUGH, BIAS_NOT_ENOUGH } bias_answer;

/** "not proven", "enough", "not enough". */
const char *bias_answer_name(bias_answer answer);

typedef struct bias_verdict {
    bias_answer answer;
    double lo, hi;        /**< the part of the range that is judged: where some bias is enough; NaN where none is */
    double from, to;      /**< the part of that where this one is enough for certain; NaN where there is none */
    double factor, units; /**< the least that are enough from lo to hi, as the API takes them: at any slant the least
                             factor, facing none, for a slope the one given; NaN where none are */
    double z;             /**< of the witness, scene units; this and its codes are NaN without one */
    double code, moved;   /**< what is stored there of the layer below, and of the biased one */
    bool short_of_gap;    /**< the witness is told apart, but by less than the gap */
    bool clipped;         /**< the witness is brought before the near plane (remedy.h) */
    bool next;            /**< it is enough where drivers take the exponent n + 1, as some may and not all do */
    bool turned;          /**< with the other sign it is enough */
    bool clamped;         /**< without its clamp it is enough */
} bias_verdict;

/**
 * Judges a bias from lo to hi, in [near, far], lo <= hi, hi finite.
 * @param goal  of it the slope and the gap are read: what is asked of the bias, as bias_needed() says, at any slant
 *              where the set-up has triangles and the slope is 0. Its witness then faces the camera
 */
bias_verdict bias_judge(const dp_setup *setup, const bias_state *state, const bias_goal *goal, double lo, double hi);

/** How far a bias brings a layer that faces the camera nearer. */
typedef struct bias_push {
    double shift; /**< the most in a range, scene units; negative: away from the camera. The smaller r counts */
    double z;     /**< where */
} bias_push;

bias_push bias_push_over(const dp_setup *setup, const bias_state *state, double lo, double hi);

#endif
