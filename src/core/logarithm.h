/* SPDX-License-Identifier: MIT */
/* A logarithm of about 100 bits for the logarithmic mapping: where a double cannot tell two depths apart. */
#ifndef CORE_LOGARITHM_H
#define CORE_LOGARITHM_H

#include "core/expansion.h"

/* log(c z + 1) for c z in [1e-24, 1e30], good to 2^-92 relative. */
dp_pair dp_log1p_product(double c, double z);

/* The double nearest to (num/den) a - b, good to 2^-88 of b. */
double dp_scaled_difference(double num, double den, dp_pair a, dp_pair b);

#endif
