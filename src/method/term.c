/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "method/term.h"

#include <float.h>
#include <math.h>

#include "core/bits.h"

/* No multiple of a number of either format is as coarse, or as fine. */
enum { COARSEST = 1 << 14, FINEST = -(1 << 14) };

static const range without_end = {-(double)INFINITY, (double)INFINITY};

static double lesser(double a, double b) {
    return a < b ? a : b;
}

static double greater(double a, double b) {
    return a > b ? a : b;
}

static bool has_end(range r) {
    return r.lo > -(double)INFINITY && r.hi < (double)INFINITY;
}

/* ---- Ranges ------------------------------------------------------------------------------------------------------ */

/* Each end has been rounded once: four times as much is taken off. */
range range_outward(double lo, double hi) {
    return (range){lo - fabs(lo) * DP_ROUNDINGS_2, hi + fabs(hi) * DP_ROUNDINGS_2};
}

range range_sum(range a, range b) {
    return range_outward(a.lo + b.lo, a.hi + b.hi);
}

range range_product(range a, range b) {
    const double p = a.lo * b.lo, q = a.lo * b.hi, r = a.hi * b.lo, s = a.hi * b.hi;
    return range_outward(lesser(lesser(p, q), lesser(r, s)), greater(greater(p, q), greater(r, s)));
}

range range_quotient(range a, range b) {
    if (b.hi < 0)
        return range_quotient((range){-a.hi, -a.lo}, (range){-b.hi, -b.lo});
    return range_outward(a.lo / (a.lo < 0 ? b.lo : b.hi), a.hi / (a.hi < 0 ? b.hi : b.lo));
}

static range within(range a, range b) {
    return (range){greater(a.lo, b.lo), lesser(a.hi, b.hi)};
}

static range around(range a, range b) {
    return (range){lesser(a.lo, b.lo), greater(a.hi, b.hi)};
}

static bool has_zero(range r) {
    return r.lo <= 0 && r.hi >= 0;
}

static bool is_nothing(range r) {
    return r.lo == 0 && r.hi == 0;
}

/* Either error is cut by the other. */
static void cut(term *t) {
    if (is_nothing(t->off))
        t->share = t->off;
    else if (!has_zero(t->exact))
        t->share = within(t->share, range_quotient(t->off, t->exact));
    if (has_end(t->share))
        t->off = within(t->off, range_product(t->share, t->exact));
}

/* ---- Numbers ----------------------------------------------------------------------------------------------------- */

/* The exponent of the last bit of x that is set. */
static int last_bit(double x) {
    int exponent;
    if (x == 0)
        return COARSEST;
    const double part = frexp(x, &exponent);
    return exponent - TERM_DOUBLE + __builtin_ctzll((unsigned long long)(fabs(part) * 0x1p53));
}

static term stands_for(double computed, range exact, range off) {
    term t = {exact, off, is_nothing(off) ? off : without_end, last_bit(computed)};
    cut(&t);
    return t;
}

term term_constant(double value, double share, int bits) {
    const double computed = bits == TERM_SINGLE ? (double)(float)value : value, formed = share * fabs(value);
    return stands_for(computed, (range){value - formed, value + formed},
                      (range){computed - value - formed, computed - value + formed});
}

term term_exact(double value) {
    return stands_for(value, (range){value, value}, (range){0, 0});
}

term term_apart(double value, double rest) {
    return stands_for(value, range_outward(value + rest, value + rest), (range){-rest, -rest});
}

term term_within(range exact, range share) {
    return (term){exact, range_product(share, exact), share, FINEST};
}

term term_any(float lo, float hi) {
    int exponent;
    frexp((double)lo, &exponent);
    const int step = lo > 0 && exponent - TERM_SINGLE > -149 ? exponent - TERM_SINGLE : -149;
    return (term){{(double)lo, (double)hi}, {0, 0}, {0, 0}, lo < hi ? step : last_bit((double)lo)};
}

/* ---- Operations -------------------------------------------------------------------------------------------------- */

term term_sum(const term *a, const term *b, range exact) {
    const bool alike = (a->exact.lo >= 0 && b->exact.lo >= 0) || (a->exact.hi <= 0 && b->exact.hi <= 0);
    term t = {within(exact, range_sum(a->exact, b->exact)), range_sum(a->off, b->off), without_end,
              a->grid < b->grid ? a->grid : b->grid};
    if (alike) /* the sum's share is a mean of theirs */
        t.share = around(a->share, b->share);
    cut(&t);
    return t;
}

/* (1 + a)(1 + b) - 1 */
static range both(range a, range b) {
    if (!has_end(a) || !has_end(b) || a.lo <= -1 || b.lo <= -1)
        return without_end;
    const double lo = a.lo * b.lo, hi = a.hi * b.hi;
    return range_outward(a.lo + b.lo + lo - DP_ROUNDINGS_6 * (fabs(a.lo) + fabs(b.lo) + fabs(lo)),
                         a.hi + b.hi + hi + DP_ROUNDINGS_6 * (fabs(a.hi) + fabs(b.hi) + fabs(hi)));
}

/* (1 + a)/(1 + b) - 1 */
static range either(range a, range b) {
    if (!has_end(a) || !has_end(b) || a.lo <= -1 || b.lo <= -1)
        return without_end;
    const double lo = a.lo - b.hi, hi = a.hi - b.lo;
    return range_outward((lo - fabs(lo) * DP_ROUNDINGS_6) / (1 + b.hi), (hi + fabs(hi) * DP_ROUNDINGS_6) / (1 + b.lo));
}

term term_product(const term *a, const term *b) {
    const range computed = range_sum(b->exact, b->off);
    term t = {range_product(a->exact, b->exact),
              range_sum(range_product(a->off, computed), range_product(a->exact, b->off)), both(a->share, b->share),
              a->grid + b->grid};
    cut(&t);
    return t;
}

term term_quotient(const term *a, const term *b, range exact) {
    term t = {exact, without_end, either(a->share, b->share), FINEST};
    const range computed = range_sum(b->exact, b->off);
    if (!has_zero(b->exact))
        t.exact = within(exact, range_quotient(a->exact, b->exact));
    if (!has_zero(computed) &&
        has_end(b->share)) /* a.off/(b + b.off), and what the divisor's share makes of the rest */
        t.off = range_sum(range_quotient(a->off, computed), range_product(t.exact, either((range){0, 0}, b->share)));
    cut(&t);
    return t;
}

term term_scaled(const term *a, range by) {
    term t = {a->exact, without_end, both(a->share, by), FINEST};
    cut(&t);
    return t;
}

/* The exponent e of 2^e <= x < 2^(e + 1), for a normal x > 0; of others one that is low enough. */
static int binade(double x) {
    return (int)(dp_bits64(x) >> 52) - 1023;
}

/* 2^e, and the least or the greatest normal number instead of what lies beyond. */
static double power_of_two(int e) {
    const int exponent = e < -1022 ? -1022 : e > 1023 ? 1023 : e;
    return dp_float64((uint64_t)(exponent + 1023) << 52);
}

/* The most that rounding moves a number of at most x: half a step below the power of two under x; above it half a step
 * there, but not more than the way back, unless to `either` neighbour. */
static double half_step(double x, int bits, int least, bool either) {
    const int top = binade(x), step = top - bits > least - 1 ? top - bits : least - 1;
    const double power = power_of_two(top), full = power_of_two(step), below = step > least - 1 ? full / 2 : full;
    return either ? full : greater(below, lesser(full, x - power));
}

term term_rounded(const term *a, int bits, double halves, bool flushes) {
    const int least = bits == TERM_SINGLE ? -149 : -1074;
    const double most_finite = bits == TERM_SINGLE ? (double)FLT_MAX : DBL_MAX;
    term t = *a;
    const range before = range_sum(t.exact, t.off);
    const double most = greater(fabs(before.lo), fabs(before.hi));
    const double fewest = has_zero(before) ? 0 : lesser(fabs(before.lo), fabs(before.hi));
    if (!(most < most_finite))
        return (term){t.exact, without_end, without_end, FINEST};
    const int step = fewest > 0 && binade(fewest) - bits + 1 > least ? binade(fewest) - bits + 1 : least;
    const bool fits = halves <= 2 && t.grid >= least && most <= power_of_two(bits + t.grid);
    const bool lost = flushes && fewest < (double)FLT_MIN;
    if (!lost && (fits || most == 0)) /* nothing is lost */
        return t;
    const double half = half_step(most, bits, least, halves > 1), unit = halves * power_of_two(-bits);
    const double e = halves * half + (lost ? (double)FLT_MIN : 0);
    const double by_step = fewest > 0 ? e / fewest * (1 + DP_ROUNDINGS_6) : (double)INFINITY;
    const double relative =
        step > least && !lost ? lesser(unit / (halves > 1 ? 1 : 1 + unit) * (1 + DP_ROUNDINGS_6), by_step) : by_step;
    t.off = range_sum(t.off, (range){-e, e});
    t.share = both(t.share, (range){-relative, relative});
    t.grid = halves > 2 ? FINEST : t.grid > step ? t.grid : step;
    cut(&t);
    return t;
}
