/* SPDX-License-Identifier: MIT */
/*
 * Sums and products of doubles without rounding: the exact decisions of the engine.
 *
 * Building blocks by Dekker and Knuth; expansions as in Shewchuk, Adaptive precision floating-point arithmetic and
 * fast robust geometric predicates, 1997. All need round-to-nearest and no contraction.
 */
#ifndef CORE_EXPANSION_H
#define CORE_EXPANSION_H

#include <math.h>

/* An unevaluated sum hi + lo with |lo| at most half a unit in the last place of hi. */
typedef struct dp_pair {
    double hi;
    double lo;
} dp_pair;

static inline dp_pair dp_two_sum(double a, double b) {
    double s = a + b;
    double t = s - a;
    return (dp_pair){s, (a - (s - t)) + (b - t)};
}

/* |a| >= |b|, or a = 0 */
static inline dp_pair dp_quick_two_sum(double a, double b) {
    double s = a + b;
    return (dp_pair){s, b - (s - a)};
}

static inline dp_pair dp_two_product(double a, double b) {
    double p = a * b;
    return (dp_pair){p, fma(a, b, -p)};
}

/* Arithmetic of pairs, good to 2^-102; a sum relative to its terms' magnitudes. */
static inline dp_pair dp_pair_sum(dp_pair a, dp_pair b) {
    const dp_pair high = dp_two_sum(a.hi, b.hi);
    const dp_pair low = dp_two_sum(a.lo, b.lo);
    const dp_pair once = dp_quick_two_sum(high.hi, high.lo + low.hi);
    return dp_quick_two_sum(once.hi, once.lo + low.lo);
}

static inline dp_pair dp_pair_product(dp_pair a, dp_pair b) {
    const dp_pair p = dp_two_product(a.hi, b.hi);
    return dp_quick_two_sum(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
}

/*
 * p a (x1 - x2) + q b (y1 - y2), evaluated exactly and rounded once at the end: the sign is right, zero means zero,
 * and the value is good to 2^-50 relative. Arguments up to 1e60, and no two of them so small that the last bit of a
 * product falls below 2^-1074: the library's are planes and depths in [1e-12, 1e18] and quotients of at least 2^-278;
 * orthographic depths may be any double, of either sign, as they are multiplied by whole numbers below 2^33 alone.
 */
double dp_exact_residual(double p, double a, double x1, double x2, double q, double b, double y1, double y2);

/* The same of a and b that are each a sum of three terms. */
enum { DP_SUM_TERMS = 3 };
double dp_exact_sums(double p, const double a[DP_SUM_TERMS], double x1, double x2, double q,
                     const double b[DP_SUM_TERMS], double y1, double y2);

#endif
