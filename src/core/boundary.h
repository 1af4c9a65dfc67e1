/* SPDX-License-Identifier: MIT */
/*
 * Rounding boundaries of a set-up: where, along d, one code gives way to the next in the model asked for.
 *
 * exact    the boundary of the format itself.
 * staged   d is first rounded to binary32 as NDC depth x (d, or 2d - 1), then as window depth w (x, or x/2 + 1/2), and
 *          w is rounded into the format. Each step is monotone, so the codes from `code` up are stored from some
 *          smallest w upwards, hence from some smallest x upwards: the boundary is the midpoint below that x. Codes
 *          that no w or x reaches have no cell of their own, so `below` and `above` may be further apart than one.
 *          Into rg goes 255 w, rounded to binary32 as well.
 */
#ifndef CORE_BOUNDARY_H
#define CORE_BOUNDARY_H

#include "core/lattice.h"
#include "depthprec/setup.h"

typedef struct dp_boundary {
    dp_point point;
    int ties_up;    /* a depth exactly on the boundary is stored as `above` */
    uint32_t below; /* the codes that are stored on either side */
    uint32_t above;
} dp_boundary;

/* The boundary below `code`, 1 <= code <= code_max. */
dp_boundary dp_boundary_below(const dp_setup *setup, uint32_t code);

/* The code that the stages make of a window depth d in real arithmetic; the format's own rounding for `exact`. */
uint32_t dp_staged_code(const dp_setup *setup, double d);

/* The smallest window and NDC depth in binary32 that are stored as `code` or above; 1 <= code <= code_max. */
float dp_staged_window(const dp_setup *setup, uint32_t code);
float dp_staged_ndc(const dp_setup *setup, float window);

/* Whether a step of the window depth counts beside one of the NDC depth: another rounding comes between. */
int dp_staged_twice(const dp_setup *setup);

/* The steps that binary32 takes at d, in units of d: of the window depth, or 255 times that, and of the NDC depth. */
double dp_staged_window_step(const dp_setup *setup, double d);
double dp_staged_ndc_step(const dp_setup *setup, double d);

/* Whether the stages change nothing: the format is binary32 itself and NDC depth is d. */
int dp_staged_is_exact(const dp_setup *setup);

#endif
