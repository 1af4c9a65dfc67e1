/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file remedy.h  What to do about a cause of lost precision, a row each, and what it would gain: each remedy is a
 * change of the set-up that dp_budget_at() judges, so none is recommended that does not help at that depth.
 */
#ifndef QUANTITY_CMD_BUDGET_REMEDY_H
#define QUANTITY_CMD_BUDGET_REMEDY_H

#include "depthprec/depthprec.h"

typedef struct remedy_result {
    const char *text;  /**< "reversed depth in fp32"; null when nothing here helps */
    double separation; /**< what would be left; the separation as it is where nothing helps */
} remedy_result;

/** The distance of the binary32 depths at z: no two surfaces that a shader knows are nearer to each other. */
double remedy_step(double z);

/**
 * The best remedy against a cause at z; of two that do about as well, the simpler. What lies below the step of binary32
 * depths is no gain.
 */
remedy_result remedy_find(const dp_setup *setup, const dp_budget_terms *terms, double z, dp_cause cause);

#endif
