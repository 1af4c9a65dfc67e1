/* SPDX-License-Identifier: MIT */
#include "core/expansion.h"

enum { PRODUCT_SIZE = 8, SUM_SIZE = 2 * PRODUCT_SIZE, SUMS_SIZE = DP_SUM_TERMS * SUM_SIZE };

/* out[0 .. 2n-1] = e[0 .. n-1] factor, components in increasing magnitude */
static void scale(const double *e, int n, double factor, double *out) {
    dp_pair q = dp_two_product(e[0], factor);
    out[0] = q.lo;
    for (int i = 1; i < n; i++) {
        dp_pair t = dp_two_product(e[i], factor);
        dp_pair s = dp_two_sum(q.hi, t.lo);
        out[2 * i - 1] = s.lo;
        q = dp_quick_two_sum(t.hi, s.hi);
        out[2 * i] = q.lo;
    }
    out[2 * n - 1] = q.hi;
}

/* out = p a (x - y) */
static void product(double p, double a, double x, double y, double out[PRODUCT_SIZE]) {
    dp_pair d = dp_two_sum(x, -y);
    const double difference[2] = {d.lo, d.hi};
    double once[4];
    scale(difference, 2, a, once);
    scale(once, 4, p, out);
}

/* Adds a product to an expansion of `size` components, which so many more make longer. */
static void gather(double *sum, int size, const double added[PRODUCT_SIZE]) {
    for (int i = 0; i < PRODUCT_SIZE; i++) {
        double carry = added[i];
        for (int j = 0; j < size + i; j++) {
            dp_pair s = dp_two_sum(carry, sum[j]);
            carry = s.hi;
            sum[j] = s.lo;
        }
        sum[size + i] = carry;
    }
}

static double total_of(const double *sum, int size) {
    double total = 0.0;
    for (int i = 0; i < size; i++)
        total += sum[i];
    return total;
}

double dp_exact_residual(double p, double a, double x1, double x2, double q, double b, double y1, double y2) {
    double sum[SUM_SIZE];
    double other[PRODUCT_SIZE];
    product(p, a, x1, x2, sum);
    product(q, b, y1, y2, other);
    gather(sum, PRODUCT_SIZE, other);
    return total_of(sum, SUM_SIZE);
}

double dp_exact_sums(double p, const double a[DP_SUM_TERMS], double x1, double x2, double q,
                     const double b[DP_SUM_TERMS], double y1, double y2) {
    double sum[SUMS_SIZE];
    double other[PRODUCT_SIZE];
    for (int i = 0; i < DP_SUM_TERMS; i++) {
        product(p, a[i], x1, x2, other);
        gather(sum, 2 * i * PRODUCT_SIZE, other);
        product(q, b[i], y1, y2, other);
        gather(sum, (2 * i + 1) * PRODUCT_SIZE, other);
    }
    return total_of(sum, SUMS_SIZE);
}
