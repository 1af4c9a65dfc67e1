/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "shadow/filter.h"

#include <stddef.h>

#define COVERED "", 0.0, 0.0

/*
 * Moments: x and x^2 of one surface, each rounded by the relative u, leave a variance of up to 3 u x^2, so deviations
 * below sqrt(3 u) are noise. Exponentials: e^(c x) rounded by u is that of a depth u/c off, c at most the logarithm of
 * the largest number.
 */
/* clang-format off */
static const shadow_filter rows[] = {
    {"nearest", NULL, "the texel of the point", NULL, "", 0.0, 0.0, false, 0.5, 0.0, COVERED},
    {"bilinear", "2x2 hardware-2x2 linear", "a comparison sampler: the four texels about the point", NULL,
     "", 0.0, 0.0, false, 1.0, 0.0, COVERED},
    {"pcf", NULL, "N x N texels", NULL, "N", 1.0, 64.0, true, 0.0, 0.5, COVERED},
    {"pcf-2x2", NULL, "N x N taps, a texel apart, each of a comparison sampler", NULL,
     "N", 1.0, 63.0, true, 0.5, 0.5, COVERED},
    {"poisson", NULL, "taps within R texels, each of one texel", NULL, "R", 0.0, 31.5, false, 0.5, 1.0, COVERED},
    {"poisson-2x2", "vogel", "taps within R texels, each of a comparison sampler", NULL,
     "R", 0.0, 31.0, false, 1.0, 1.0, COVERED},
    {"pcss", NULL, "R the largest radius of its penumbra and of its search for blockers, texels",
     "Fernando, Percentage-closer soft shadows, SIGGRAPH 2005 sketches",
     "R", 0.0, 31.5, false, 0.5, 1.0, COVERED},
    {"vsm", "variance evsm", "moments of depth, filtered", "Donnelly and Lauritzen, Variance shadow maps, I3D 2006",
     "", 0.0, 0.0, false, 0.0, 0.0,
     "it compares a variance, of which no bias follows: deviations of window depth below 0.0383 in 16 bits and "
     "0.000423 in 32 are lost in its rounding", 0.038273277230987154, 0.0004228639666916204},
    {"esm", "exponential", "e^(c d), filtered", "Annen et al., Exponential shadow maps, Graphics Interface 2008",
     "", 0.0, 0.0, false, 0.0, 0.0,
     "it compares a factor, of which no bias follows: window depths closer than 4.41e-05 in 16 bits, with c = 11.08, "
     "and 6.72e-10 in 32, with c = 88.7, are lost in its rounding", 4.406870487364621e-05, 6.719802116729495e-10},
};
/* clang-format on */

NAMED_TABLE(shadow_filter, rows);
