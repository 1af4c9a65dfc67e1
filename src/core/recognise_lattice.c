/* SPDX-License-Identifier: MIT */
#include "core/recognise_lattice.h"

#include <math.h>

#include "core/bits.h"
#include "core/clones.h"
#include "core/elementary.h"
#include "depthprec/recognise.h"

enum { BLOCK = 4096, BITS_LEAST = 8, BITS_MOST = 16 };

static const double unorm16_max = 65535, unorm24_max = 16777215;

const char *dp_lattice_name(dp_lattice which) {
    static const char *const names[DP_LATTICE_COUNT] = {"fp16", "unorm16", "unorm24", "fp32"};
    return names[which];
}

/* ---- Lattices ---------------------------------------------------------------------------------------------------- */

/* 0 <= x < 2^31 to the nearest whole number. */
static inline double whole(double x) {
    return (x + 0x1p52) - 0x1p52;
}

/*
 * Is x the binary32 number nearest to a code's quotient, or a neighbour of it? The product with the reciprocal is off
 * by less than 2^-52 relatively, and no quotient lies nearer than 2^-49 to where binary32 rounds: so it is rounded as
 * the quotient is.
 */
static inline int32_t off_unorm(float x, double code_max, double reciprocal) {
    const float code = (float)(whole((double)x * code_max) * reciprocal);
    const int32_t distance = (int32_t)(dp_bits32(x) - dp_bits32(code));
    return distance > 1 || distance < -1;
}

/* Subnormals are multiples of 2^-24; the others have 10 bits behind the first. */
static inline int32_t off_half(float x) {
    const double t = (double)x * 0x1p24;
    const int32_t small = whole(t) != t, normal = (dp_bits32(x) & 0x1FFF) != 0;
    return x < 0x1p-14F ? small : normal;
}

CLONES static void single_block(const double *d, size_t count, int32_t sums[DP_LATTICE_COUNT]) {
    const double reciprocal16 = 1 / unorm16_max, reciprocal24 = 1 / unorm24_max;
    int32_t half = 0, unorm16 = 0, unorm24 = 0, single = 0;
    for (size_t i = 0; i < count; i++) {
        const int32_t valid = d[i] == d[i];
        const double number = valid ? d[i] : 0;
        const float x = (float)number;
        const int32_t wide = (double)x != number;
        half += off_half(x) | wide;
        unorm16 += off_unorm(x, unorm16_max, reciprocal16) | wide;
        unorm24 += off_unorm(x, unorm24_max, reciprocal24) | wide;
        single += wide;
    }
    sums[DP_LATTICE_FP16] = half;
    sums[DP_LATTICE_UNORM16] = unorm16;
    sums[DP_LATTICE_UNORM24] = unorm24;
    sums[DP_LATTICE_FP32] = single;
}

void dp_lattice_single(const double *d, size_t count, size_t off[DP_LATTICE_COUNT]) {
    for (size_t i = 0; i < count; i += BLOCK) {
        int32_t sums[DP_LATTICE_COUNT];
        single_block(d + i, count - i < BLOCK ? count - i : BLOCK, sums);
        for (int k = 0; k < DP_LATTICE_COUNT; k++)
            off[k] += (size_t)sums[k];
    }
}

static bool off_unorm_double(double x, double code_max) {
    const int64_t distance = (int64_t)(dp_bits64(x) - dp_bits64(whole(x * code_max) / code_max));
    return distance > 1 || distance < -1;
}

void dp_lattice_double(const double *d, size_t count, size_t off[DP_LATTICE_COUNT]) {
    for (size_t i = 0; i < count; i++) {
        if (isnan(d[i]))
            continue;
        const bool wide = (double)(float)d[i] != d[i];
        off[DP_LATTICE_FP16] += wide || off_half((float)d[i]);
        off[DP_LATTICE_UNORM16] += off_unorm_double(d[i], unorm16_max);
        off[DP_LATTICE_UNORM24] += off_unorm_double(d[i], unorm24_max);
        off[DP_LATTICE_FP32] += wide;
    }
}

double dp_lattice_chance(dp_lattice which, bool single, double d) {
    if (d == 0 || d == 1 || which == DP_LATTICE_FP32)
        return 1;
    if (which == DP_LATTICE_FP16)
        return 0x1p-13;
    int exponent;
    frexp(d, &exponent);
    const double ulp = ldexp(1, exponent - (single ? 24 : 53));
    return fmin(1, 3 * ulp * (which == DP_LATTICE_UNORM16 ? unorm16_max : unorm24_max));
}

size_t dp_common_divisor(size_t a, size_t b) {
    while (b != 0) {
        const size_t rest = a % b;
        a = b;
        b = rest;
    }
    return a;
}

/* ---- Different numbers --------------------------------------------------------------------------------------------*/

void dp_distinct_init(dp_distinct *set, uint64_t *slots, size_t most) {
    size_t size = 64;
    while (size / 2 < most && size < DP_RECOGNISE_SLOTS)
        size *= 2;
    *set = (dp_distinct){.slots = slots, .size = slots != NULL ? size : 0};
    for (size_t i = 0; i < set->size; i++)
        slots[i] = UINT64_MAX; /* a NaN */
}

bool dp_distinct_add(dp_distinct *set, double d) {
    if (set->slots == NULL || set->count >= DP_RECOGNISE_DISTINCT)
        return false;
    const uint64_t bits = dp_bits64(d);
    uint64_t slot = (bits * UINT64_C(0x9E3779B97F4A7C15)) >> 40 & (set->size - 1);
    for (; set->slots[slot] != UINT64_MAX; slot = (slot + 1) & (set->size - 1))
        if (set->slots[slot] == bits)
            return false;
    set->slots[slot] = bits;
    set->count++;
    return true;
}

/* ---- Grids ------------------------------------------------------------------------------------------------------- */

/* Images that hold less than their samples could: 8 bits repeated in 16, ten bits scaled to 16, k/255 as numbers, bits
 * shifted up. */

/* How far a sample near d may lie beside the grid, in steps of it: integers half a code, numbers 1.5 units. */
static double tolerance(const dp_grid_source *s, double d, double steps) {
    int exponent;
    if (s->top > 0)
        return 0.5 * (1 + 0x1p-20) * steps / s->top;
    frexp(d, &exponent);
    return 1.5 * ldexp(1, exponent - s->bits) * steps;
}

/* -log2 of the chance; negative when one is off. */
static double agreement(const dp_distinct *set, const dp_grid_source *s, double steps, bool shifted) {
    double bits = 0;
    for (size_t i = 0; i < set->size; i++) {
        const double d = dp_float64(set->slots[i]); /* empty slots are NaN */
        if (!(d > 0 && d < 1))
            continue;
        const double k = d * steps, most = shifted ? 0x1p-20 : tolerance(s, d, steps);
        if (fabs(k - rint(k)) > most)
            return -1;
        bits -= fmin(dp_log2(s->top > 0 ? steps / s->top : 2 * most), 0);
    }
    return bits;
}

double dp_grid_agreement(const dp_distinct *set, const dp_grid_source *s, double steps) {
    return agreement(set, s, steps, false);
}

static bool better(dp_grid *best, const dp_distinct *set, const dp_grid_source *s, double steps, bool shifted) {
    if (!(steps < s->finest))
        return false;
    const double bits = agreement(set, s, steps, shifted);
    if (!(bits > 0))
        return false;
    *best = (dp_grid){steps, bits};
    return true;
}

dp_grid dp_grid_find(const dp_distinct *set, const dp_grid_source *s) {
    dp_grid best = {0};
    if (set->count == 0 || set->count >= DP_RECOGNISE_DISTINCT)
        return best;
    if (agreement(set, s, 1, false) >= 0) /* nothing but 0 and 1: any number of bits */
        return (dp_grid){ldexp(1, BITS_LEAST) - 1, 0};
    for (int n = BITS_LEAST; n <= BITS_MOST; n++) {
        const double power = ldexp(1, n);
        /* Where k/2^N and k/(2^N - 1) are the same integers as bits shifted up, these stand for all three. */
        if (s->top > power && better(&best, set, s, s->top / dp_exp2(ceil(dp_log2(s->top + 1)) - n), true))
            break;
        if (better(&best, set, s, power - 1, false))
            break;
        if ((!s->dyadic || n == BITS_LEAST) && better(&best, set, s, power, false))
            break;
    }
    return best;
}
