/* SPDX-License-Identifier: MIT */
/* A logarithm of about 100 bits for the logarithmic mapping: where a double cannot tell two depths apart. */
#ifndef CORE_LOGARITHM_H
#define CORE_LOGARITHM_H

#include "core/expansion.h"

/*
 * log(c (z - anchor) + 1) for z >= anchor, or, where c is 0, log(z/anchor); good to 2^-92 relative. What the logarithm
 * of 1 and it is taken of is 0 or in [1e-28, 1e30].
 */
dp_pair dp_log1p_excess(double z, double anchor, double c);

/* The double nearest to (num/den) a - b, good to 2^-88 of b. */
double dp_scaled_difference(double num, double den, dp_pair a, dp_pair b);

#endif
