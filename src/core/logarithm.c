/* SPDX-License-Identifier: MIT */
#include "core/logarithm.h"

#include "core/elementary.h"

/* log(2) to 107 bits */
static const dp_pair log_two = {0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56};

static dp_pair pair_scale(dp_pair a, double b) {
    dp_pair p = dp_two_product(a.hi, b);
    return dp_quick_two_sum(p.hi, fma(a.lo, b, p.lo));
}

static dp_pair pair_divide(dp_pair a, double b) {
    double q = a.hi / b;
    dp_pair p = dp_two_product(q, b);
    return dp_quick_two_sum(q, ((a.hi - p.hi) - p.lo + a.lo) / b);
}

/* exp(x) 2^-k - 1 with k = round(x / log 2): Taylor for x/512, then nine doublings of e^x - 1, which lose nothing. */
static dp_pair exp_reduced(double x, int *k) {
    *k = (int)rint(x / log_two.hi);
    dp_pair r = dp_pair_sum((dp_pair){x, 0.0}, pair_scale(log_two, -*k));
    r = pair_scale(r, 0x1p-9);
    dp_pair sum = {1.0 / 10.0, 0.0}; /* the eleventh term is below 2^-120 of the first */
    for (int n = 9; n >= 1; n--) {
        sum = dp_pair_product(r, sum);
        sum = dp_pair_sum(sum, (dp_pair){1.0, 0.0});
        sum = n > 1 ? pair_divide(sum, n) : sum;
    }
    sum = dp_pair_product(r, sum);
    for (int i = 0; i < 9; i++)
        sum = dp_pair_sum(pair_scale(sum, 2.0), dp_pair_product(sum, sum));
    return sum;
}

/* log(1 + u) for u < 2^-10 by its series; the thirteenth term is below 2^-120 of the first. */
static dp_pair log1p_series(dp_pair u) {
    dp_pair sum = {0.0, 0.0};
    for (int n = 12; n >= 1; n--) {
        sum = dp_pair_product(sum, u);
        dp_pair term = pair_divide((dp_pair){n % 2 ? 1.0 : -1.0, 0.0}, n);
        sum = dp_pair_sum(sum, term);
    }
    return dp_pair_product(sum, u);
}

static dp_pair log1p_pair(dp_pair u) {
    if (u.hi < 0x1p-10)
        return log1p_series(u);
    /* One Newton step from the double y: log(x) = y + log(x e^-y), and x e^-y is within 2^-50 of 1. */
    dp_pair x = dp_pair_sum(u, (dp_pair){1.0, 0.0});
    double y = dp_log(x.hi);
    int k;
    dp_pair e = exp_reduced(-y, &k);
    e = dp_pair_sum(e, (dp_pair){1.0, 0.0});
    dp_pair ratio = dp_pair_product(x, e);
    ratio = (dp_pair){ldexp(ratio.hi, k), ldexp(ratio.lo, k)};
    dp_pair t = dp_pair_sum(ratio, (dp_pair){-1.0, 0.0});
    t = dp_pair_sum(t, (dp_pair){-0.5 * t.hi * t.hi, 0.0});
    return dp_pair_sum((dp_pair){y, 0.0}, t);
}

dp_pair dp_log1p_excess(double z, double anchor, double c) {
    const dp_pair beyond = dp_two_sum(z, -anchor);
    return log1p_pair(c > 0.0 ? pair_scale(beyond, c) : pair_divide(beyond, anchor));
}

double dp_scaled_difference(double num, double den, dp_pair a, dp_pair b) {
    dp_pair d = num == den ? a : pair_divide(pair_scale(a, num), den); /* at an end nothing is rounded */
    d = dp_pair_sum(d, (dp_pair){-b.hi, -b.lo});
    return d.hi + d.lo;
}
