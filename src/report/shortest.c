/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The value is scaled by a power of ten to x in [1e16, 1e17), in fixed point with seven bits behind the point: its
 * 17 digits and a little more. The error of x is bounded (SLACK), so a decision is either certain or left to printf.
 * All errors are truncations: x lies in [scaled, scaled + SLACK].
 */
#include "report/shortest.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

__extension__ typedef unsigned __int128 wide;

enum { POINT_BITS = 7, EXACT_POWERS = 28, MOST_POWER = 54, SLACK = 4 };

/* A number p 2^e with p in [2^63, 2^64). */
typedef struct big {
    uint64_t p;
    int e;
} big;

static big normal(uint64_t p, int e) {
    int shift = __builtin_clzll(p);
    return (big){p << shift, e - shift};
}

static big product(big a, big b) {
    wide w = (wide)a.p * b.p;
    int shift = (w >> 127) == 0 ? 63 : 64;
    return (big){(uint64_t)(w >> shift), a.e + b.e + shift};
}

/* 10^k: exact up to 10^27, as 5^27 < 2^64; above it a product of two such, truncated: less than 2^-63 relative. */
static big power_of_ten(int k) {
    uint64_t five = 1;
    int first = k < EXACT_POWERS ? k : EXACT_POWERS - 1;
    for (int i = 0; i < first; i++)
        five *= 5;
    big power = normal(five, first);
    return first == k ? power : product(power, power_of_ten(k - first));
}

/* value 10^k in fixed point; less than 3 below the truth: 1 for this truncation and 2^64 2^-63 for that of 10^k. */
static uint64_t scale(big value, int k) {
    static big powers[MOST_POWER + 1]; /* filled in as needed: a table is printed with few of them */
    if (powers[k].p == 0)
        powers[k] = power_of_ten(k);
    int shift = -(value.e + powers[k].e + POINT_BITS);
    return shift > 63 && shift < 128 ? (uint64_t)(((wide)value.p * powers[k].p) >> shift) : 0;
}

/* Like %g: n has `digits` digits, the first of them stands for 10^exponent. */
static size_t write_general(uint64_t n, int digits, int exponent, bool negative, char *out) {
    char text[24] = "";
    char *start = out;
    int kept = digits;
    for (int i = digits - 1; i >= 0; i--, n /= 10)
        text[i] = (char)('0' + n % 10);
    while (kept > 1 && text[kept - 1] == '0')
        kept--;
    if (negative)
        *out++ = '-';
    if (exponent < -4 || exponent >= digits) {
        *out++ = text[0];
        if (kept > 1)
            *out++ = '.';
        memcpy(out, text + 1, (size_t)kept - 1);
        out += kept - 1;
        int size = exponent < 0 ? -exponent : exponent;
        *out++ = 'e';
        *out++ = exponent < 0 ? '-' : '+';
        *out++ = (char)('0' + size / 10);
        *out++ = (char)('0' + size % 10);
    } else {
        /* Places left of the point first, from 10^exponent or from the 0 before it; a point only when more follow. */
        for (int place = exponent < 0 ? 0 : exponent, i = exponent - place; place >= 0 || i < kept; place--, i++) {
            if (place == -1)
                *out++ = '.';
            *out++ = i < 0 || i >= kept ? '0' : text[i];
        }
    }
    *out = '\0';
    return (size_t)(out - start);
}

size_t shortest_quick(double value, char out[SHORTEST_SIZE]) {
    static const uint64_t least = 10000000000000000U; /* 1e16 */
    double magnitude = fabs(value);
    if (!(magnitude >= 1e-38 && magnitude < 1e17))
        return 0;
    int exponent2;
    uint64_t m = (uint64_t)ldexp(frexp(magnitude, &exponent2), 53);
    if ((m & (m - 1)) == 0) /* a power of two: its neighbour below is nearer, which the test below does not know */
        return 0;
    big v = normal(m, exponent2 - 53);
    /* floor(log10), at most one too small; the first guess that scales into [1e16, 1e17) is it. */
    int exponent = (int)floor((exponent2 - 1) * 0.30102999566398120);
    uint64_t scaled = 0;
    for (int tries = 0; tries < 2; tries++) {
        if (16 - exponent < 0 || 16 - exponent > MOST_POWER)
            return 0;
        scaled = scale(v, 16 - exponent);
        if (scaled == 0 || scaled + SLACK < (least * 10) << POINT_BITS)
            break;
        exponent++;
    }
    if (scaled < least << POINT_BITS || scaled + SLACK >= (least * 10) << POINT_BITS)
        return 0;
    uint64_t half_ulp = scaled / (2 * m);
    uint64_t unit = (uint64_t)100 << POINT_BITS;
    for (int digits = 15; digits <= 17; digits++, unit /= 10) {
        uint64_t rest = scaled % unit;
        uint64_t half = unit / 2;
        if (rest + SLACK >= half && rest <= half + SLACK)
            return 0; /* which way it rounds is not certain */
        uint64_t n = scaled / unit + (rest > half);
        uint64_t off = rest > half ? unit - rest : rest;
        if (digits < 17 && off + SLACK >= half_ulp) {
            if (off <= half_ulp + 1 + SLACK)
                return 0; /* whether it reads back is not certain */
            continue;
        }
        uint64_t limit = 1;
        for (int i = 0; i < digits; i++)
            limit *= 10;
        if (n < limit)
            return write_general(n, digits, exponent, value < 0.0, out);
        return write_general(n / 10, digits, exponent + 1, value < 0.0, out); /* 9.99... became 10 */
    }
    return 0;
}
