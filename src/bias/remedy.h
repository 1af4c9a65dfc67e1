/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file remedy.h  What is written in place of a bias: means that give a layer another depth, judged as biases are.
 *
 * A means has a number. It gives the layer at z the window depth that t towards the camera from its own is; t is
 * exact, and the sum is rounded to binary32 and to a code. Layers that face the camera are asked about, or such as have
 * a slope and are sampled up to a pixel apart; dp_separation() tells of planes that a means leaves parallel.
 */
#ifndef BIAS_REMEDY_H
#define BIAS_REMEDY_H

#include "bias/verdict.h"

typedef struct remedy {
    NAMED_FIELDS;       /**< note: what is written */
    const char *amount; /**< what its number is; "" where it has none */
    const char *worth;  /**< by how much the layer is brought nearer at z */
    const char *turned; /**< what is otherwise in reversed mappings */
    const char *cost;
    double least, most; /**< of the number */
    bool grows;         /**< the larger the number, the more: else the smaller */
    bool of_matrix;     /**< it has no effect on a depth that a shader writes */
    bool of_eye;        /**< it needs a perspective */
    bool parallel;      /**< the layer stays parallel to its wall: how far it moves along a ray depends on the ray */
    double (*window)(const dp_setup *setup, double amount, double z); /**< t; null: no depth is compared */
} remedy;

NAMED_ROWS(remedy, remedy);

/** Whether it is one for that set-up. */
bool remedy_suits(const remedy *row, const dp_setup *setup);

/** The remedy's work at z; `r` is NaN. A layer that is brought before the near plane is clipped: `limited`. */
bias_effect remedy_at(const dp_setup *setup, const remedy *row, double amount, double z);

/**
 * Judges it from lo to hi, as bias_judge(); `units` is the least number that is enough, NaN where none is.
 * @param setup  without triangles
 * @param goal   of it the slope, scene units per pixel, and the gap are read; no slope where the layer stays parallel
 */
bias_verdict remedy_judge(const dp_setup *setup, const remedy *row, double amount, const bias_goal *goal, double lo,
                          double hi);

/** The greatest slope at which it is enough from lo to hi, within 2^-20 below, 0 where that is less than 2^-60 hi; NaN
 * where it is not enough facing the camera, stays parallel, or compares no depth. */
double remedy_steepest(const dp_setup *setup, const remedy *row, double amount, double gap, double lo, double hi);

/** The most that it brings a layer nearer. */
bias_push remedy_push(const dp_setup *setup, const remedy *row, double amount, double lo, double hi);

#endif
