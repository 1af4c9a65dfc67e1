/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file ways.h  The cheapest way to the z-fighting interval that is good enough for a set-up: method_choose() among the
 * methods of the family interval, in the words of set-ups.
 */
#ifndef METHOD_WAYS_H
#define METHOD_WAYS_H

#include "method/method.h"

typedef struct way {
    const method_row *row; /**< null: no method is claimed to be good enough, and the engine's own answer stands: the
                                exact cell, or in the model float none */
    const char *name;      /**< of the method; "cell" or null without */
    double claim;          /**< worst relative error; 0 for the exact cell without a row */
} way;

/**
 * @param tolerance  worst relative error of an interval, at least 0
 * @param cut_cells  whether depths count whose cell a plane cuts
 */
way way_choose(const dp_setup *setup, double tolerance, bool cut_cells);

/** The interval at z in [near, far] by a way with a row, scene units; NaN where its claim does not reach: in the model
 *  fp32 within a separation of the far plane, behind which nothing is in view. */
double way_interval(const way *w, const dp_setup *setup, double z);

#endif
