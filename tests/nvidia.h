/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * NVIDIA's arithmetic, for oracles: codes in whole numbers; the reciprocal is the program's own, all of which
 * test_nvidia compares with what the hardware gave.
 */
#ifndef NVIDIA_H
#define NVIDIA_H

#include <math.h>
#include <stdint.h>

#include "core/reciprocal.h"

/* Takes a window depth from 0 to 1. */
static inline double nvidia_code(int bits, float d) {
    if (bits <= 16) {
        const int64_t sixteenths = (int64_t)ldexp((double)d, bits + 4) - (int64_t)ldexp((double)d, 4) + 7;
        return (double)(sixteenths >> 4);
    }
    const long double all = ldexpl((long double)d, bits);
    return (double)floorl((d < 0x1p-4F ? all : all - (long double)d) + 0.5L);
}

static inline float nvidia_inverse(dp_reciprocal kind, float w) {
    return kind == DP_RECIPROCAL_UNIT ? dp_reciprocal_unit(w) : 1.0F / w;
}

#endif
