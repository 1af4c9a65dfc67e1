/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file trial.h  bias --rasterize: a bias on trial, drawn. */
#ifndef BIAS_CMD_BIAS_TRIAL_H
#define BIAS_CMD_BIAS_TRIAL_H

#include "bias/cmd_bias/judged.h"
#include "camera/cmd/setups.h"

/** How a bias did. */
typedef struct bias_trial {
    const char *raster;
    double pixels, fights; /**< that both layers covered, and that show the one below */
    double x, y;           /**< a pixel that does, from the lower left; NaN without one, as the rest */
    double slant, z, code, moved;
    const char *file; /**< of the picture; null without one */
} bias_trial;

/**
 * Draws a bias from lo to hi in a set-up of the model float, in the arithmetic of a rasterizer; a verdict that is open
 * becomes "not enough" where a pixel fights.
 * @param slope   as bias_drawing has it
 * @param render  the picture's file; null: none
 * @return an exit status, after one line on stderr
 */
int bias_try(const raster_row *row, const dp_setup *setup, const bias_state *state, double slope, double lo, double hi,
             const char *render, bias_judged *judged, bias_trial *out);

extern const column bias_trial_columns[];
void bias_say_trial(page *p, bias_trial *trial);

#endif
