/* SPDX-License-Identifier: MIT */
/*
 * Numbers of loops that become vectors: choices without jumps. Each gives the bits that the same choice by a jump
 * gives.
 */
#ifndef CORE_LANES_H
#define CORE_LANES_H

#include "core/bits.h"

DP_INLINE double size(double x) {
    return dp_float64(dp_bits64(x) & 0x7FFFFFFFFFFFFFFFULL);
}

/* Conditions are words of ones or zeros: compilers fold those of the language's into choices that no vector has. */
typedef uint64_t choice;

DP_INLINE choice is_less(double a, double b) {
    return -(uint64_t)(a < b);
}

DP_INLINE choice is_at_most(double a, double b) {
    return -(uint64_t)(a <= b);
}

DP_INLINE choice is_same(double a, double b) {
    return -(uint64_t)(a == b);
}

DP_INLINE double choose(choice c, double a, double b) {
    return dp_float64((dp_bits64(a) & c) | (dp_bits64(b) & ~c));
}

/* The number where the condition holds, else 0. */
DP_INLINE double where(choice c, double a) {
    return dp_float64(dp_bits64(a) & c);
}

/* 2^floor(log2 x) of a positive normal number. */
DP_INLINE double power(double x) {
    return dp_float64(dp_bits64(x) & 0x7FF0000000000000ULL);
}

/* dp_half_ulp() of a normal number of binary32, and of any. */
DP_INLINE double half_ulp_of(double x) {
    return power(x) * DP_UNIT;
}

DP_INLINE double half_ulp(double x) {
    return choose(is_less(x, 0x1p-126), 0x1p-150, half_ulp_of(x));
}

/* Whether two numbers have one sign. */
DP_INLINE choice are_alike(double a, double b) {
    return ((dp_bits64(a) ^ dp_bits64(b)) >> 63) - 1;
}

/* 1/x of a power of two, whose product with a number is the quotient. */
DP_INLINE double inverse(double x) {
    return dp_float64((UINT64_C(2046) << 52) - dp_bits64(x));
}

/* Binary32 numbers stand in double, where their last place is worth 2^29 units: numbers of half the size would double
 * what a vector of them needs. All are normal, or so small beside others that they decide nothing. */
DP_INLINE double narrowed(double x) {
    const uint64_t bits = dp_bits64(x);
    return dp_float64((bits + 0xFFFFFFFULL + (bits >> 29 & 1U)) & ~0x1FFFFFFFULL);
}

/* nextafterf() of a number that is not negative. */
DP_INLINE double below(double x) {
    return where(is_less(0.0, x), dp_float64(dp_bits64(x) - (UINT64_C(1) << 29)));
}

DP_INLINE double above(double x) {
    return dp_float64(dp_bits64(x) + (UINT64_C(1) << 29));
}

#endif
