/* SPDX-License-Identifier: MIT */
/* The larger and the smaller of two numbers, neither NaN: fmax() and fmin() are calls for the sake of NaN. */
#ifndef CORE_EXTREMES_H
#define CORE_EXTREMES_H

static inline double larger(double a, double b) {
    return a > b ? a : b;
}

static inline double smaller(double a, double b) {
    return a < b ? a : b;
}

#endif
