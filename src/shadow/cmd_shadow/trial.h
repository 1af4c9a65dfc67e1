/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file trial.h  shadow --rasterize: the biases of a set-up on trial, drawn. */
#ifndef SHADOW_CMD_SHADOW_TRIAL_H
#define SHADOW_CMD_SHADOW_TRIAL_H

#include "report/report.h"
#include "shadow/cmd_shadow/rows.h"

enum { SHADOW_TRIALS = 1 + SHADOW_WAY_COUNT };

/** One bias: that of the engine or none, then those that are enough. */
typedef struct shadow_trial {
    const char *bias, *raster, *file;
    double planes, points, acne; /**< points of the planes that nothing stands before; of these those with acne */
    double behind, lit;          /**< points behind a caster beyond the gap; of these those that are lit */
    double within, lost;         /**< the same of a caster half as far off as the constant bias reaches */
} shadow_trial;

/** Whether that may be asked for. @return EXIT_FINE, or EXIT_USAGE after one line on stderr */
int shadow_check_trial(const shadow_request *o);

/** Draws all of a set-up. @param count  how many there are
 * @return an exit status, after one line on stderr where it is not EXIT_FINE */
int shadow_try(const shadow_request *o, const shadow_maps *maps, shadow_trial out[SHADOW_TRIALS], size_t *count);

extern const column shadow_trial_columns[];

void shadow_say_trial(page *p, const shadow_trial *first);

#endif
