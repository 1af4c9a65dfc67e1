/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The methods of linearize as their operations: see linearize.c, where they run. */
#include <math.h>

#include "core/bits.h"
#include "method/bound.h"
#include "method/estimate.h"
#include "shader/decode.h"

/* What the reciprocal from the bits of x is off by, at most 0.05051, and its square. */
static const double magic_off = 0.05052, magic_square = 2.552e-3;

static term times(const term *a, const term *b, int bits) {
    return term_rounded(term_product(a, b), bits);
}

/* base + slope q */
static term affine(const term *base, const term *slope, const term *q, range exact, int bits) {
    const term m = times(slope, q, bits);
    return term_rounded(term_sum(base, &m, exact), bits);
}

static term over(const term *a, const term *b, range exact, int bits) {
    return term_rounded(term_quotient(a, b, exact), bits);
}

/* 1 - d */
static term rest_of(const bound_piece *p, int bits) {
    const term one = term_exact(1), minus = term_exact(-1), negative = term_product(&minus, &p->d);
    const range exact = p->reversed ? range_outward(1 - p->d.exact.hi, 1 - p->d.exact.lo) : p->near;
    return term_rounded(term_sum(&one, &negative, exact), bits);
}

static term toward_near(const bound_piece *p, int bits) {
    return p->reversed ? p->d : rest_of(p, bits);
}

/* ---- k/(base + slope d), and of the share towards near ----------------------------------------------------------- */

enum { PRODUCT, BASE, SLOPE, SCALE };

static term divisor(const term *k, const term *q, const bound_piece *p) {
    return affine(&k[BASE], &k[SLOPE], q, range_product(k[PRODUCT].exact, p->inverse), TERM_SINGLE);
}

static term by_d(const term *k, const bound_piece *p) {
    const term x = divisor(k, &p->d, p);
    return over(&k[PRODUCT], &x, p->eye, TERM_SINGLE);
}

static term by_share(const term *k, const bound_piece *p) {
    const term q = toward_near(p, TERM_SINGLE), x = divisor(k, &q, p);
    return over(&k[PRODUCT], &x, p->eye, TERM_SINGLE);
}

static term fused_run(const term *k, const bound_piece *p) {
    const term m = term_product(&k[SLOPE], &p->d);
    const term x = term_rounded(term_sum(&k[BASE], &m, range_product(k[PRODUCT].exact, p->inverse)), TERM_SINGLE);
    return over(&k[PRODUCT], &x, p->eye, TERM_SINGLE);
}

static void textbook_constants(const dp_setup *setup, term *k) {
    const double n = setup->spec.znear, f = setup->spec.zfar;
    k[PRODUCT] = term_constant(n * f, TERM_SINGLE);
    k[BASE] = term_constant(setup->reversed ? n : f, TERM_SINGLE);
    k[SLOPE] = term_constant(setup->reversed ? f - n : n - f, TERM_SINGLE);
}

static void complement_constants(const dp_setup *setup, term *k) {
    const double n = setup->spec.znear, f = setup->spec.zfar;
    k[PRODUCT] = term_constant(n * f, TERM_SINGLE);
    k[BASE] = term_constant(n, TERM_SINGLE);
    k[SLOPE] = term_constant(f - n, TERM_SINGLE);
}

static double excess(const dp_setup *setup) {
    return (setup->spec.zfar - setup->spec.znear) / setup->spec.znear;
}

/* 1/n - 1/f */
static double across(const dp_setup *setup) {
    return isinf(setup->spec.zfar) ? 1 / setup->spec.znear : excess(setup) / setup->spec.zfar;
}

static void unity_constants(const dp_setup *setup, term *k) {
    const double n = setup->spec.znear, f = setup->spec.zfar;
    k[PRODUCT] = term_exact(1);
    k[BASE] = term_constant(setup->reversed ? 1 / f : 1 / n, TERM_SINGLE);
    k[SLOPE] = term_constant(setup->reversed ? across(setup) : -across(setup), TERM_SINGLE);
}

static void complement_unity_constants(const dp_setup *setup, term *k) {
    k[PRODUCT] = term_exact(1);
    k[BASE] = term_constant(1 / setup->spec.zfar, TERM_SINGLE);
    k[SLOPE] = term_constant(across(setup), TERM_SINGLE);
}

/* ---- Shares of far ----------------------------------------------------------------------------------------------- */

/* Of z = 1 the formula has f. */
static void linear_01_constants(const dp_setup *setup, term *k) {
    const double n = setup->spec.znear, f = setup->spec.zfar;
    k[PRODUCT] = term_constant(f, TERM_SINGLE);
    k[BASE] = setup->reversed ? term_exact(1) : term_constant(f / n, TERM_SINGLE);
    k[SLOPE] = term_constant(setup->reversed ? excess(setup) : -excess(setup), TERM_SINGLE);
    k[SCALE] = term_exact(1);
}

static term linear_01_run(const term *k, const bound_piece *p) {
    const term x = divisor(k, &p->d, p);
    const term share = over(&k[SCALE], &x, range_quotient(p->eye, k[PRODUCT].exact), TERM_SINGLE);
    return times(&k[PRODUCT], &share, TERM_SINGLE);
}

enum { NEAR = 0, WIDTH = 3 }; /* where PRODUCT and SCALE are */

static void linear_01_near_constants(const dp_setup *setup, term *k) {
    const double n = setup->spec.znear, f = setup->spec.zfar;
    linear_01_constants(setup, k);
    k[NEAR] = term_constant(n, TERM_SINGLE);
    k[WIDTH] = term_constant(f - n, TERM_SINGLE);
}

static term linear_01_near_run(const term *k, const bound_piece *p) {
    const range f = range_sum(k[NEAR].exact, k[WIDTH].exact), x_exact = range_product(f, p->inverse);
    const term x = affine(&k[BASE], &k[SLOPE], &p->d, x_exact, TERM_SINGLE);
    const term away = p->reversed ? rest_of(p, TERM_SINGLE) : p->d;
    const term share = over(&away, &x, range_quotient(away.exact, x_exact), TERM_SINGLE);
    return affine(&k[NEAR], &k[WIDTH], &share, p->eye, TERM_SINGLE);
}

/* ---- A Newton step ----------------------------------------------------------------------------------------------- */

/* y (2 - x y) for y = (1 + e)/x is (1 - e^2)/x. Of x y and 2 - x y one is below 1 and one above: 1.5 units. */
static term newton_step(const term *x, double off, double square) {
    const term one = term_exact(1);
    const double rounded = 1.5 * DP_UNIT * (1 + off);
    const term exact = term_quotient(&one, x, (range){0, (double)INFINITY});
    return term_rounded(term_scaled(&exact, (range){-square - rounded, rounded}), TERM_SINGLE);
}

static term newton_run(const term *k, const bound_piece *p) {
    const term q = toward_near(p, TERM_SINGLE), x = divisor(k, &q, p);
    const term y = newton_step(&x, ESTIMATE_WORST, ESTIMATE_WORST * ESTIMATE_WORST);
    return times(&k[PRODUCT], &y, TERM_SINGLE);
}

static term magic_run(const term *k, const bound_piece *p) {
    const term x = divisor(k, &p->d, p);
    return newton_step(&x, magic_off, magic_square);
}

/* ---- In double --------------------------------------------------------------------------------------------------- */

/* What a + b leaves of the exact sum (Knuth). */
static double left_of_sum(double a, double b) {
    const double s = a + b, v = s - a;
    return (a - (s - v)) + (b - v);
}

static void double_constants(const dp_setup *setup, term *k) {
    const double n = setup->spec.znear, f = setup->spec.zfar;
    k[PRODUCT] = term_apart(n * f, fma(n, f, -(n * f)));
    k[BASE] = term_exact(setup->reversed ? n : f);
    k[SLOPE] = setup->reversed ? term_apart(f - n, left_of_sum(f, -n)) : term_apart(n - f, left_of_sum(n, -f));
}

static term double_run(const term *k, const bound_piece *p) {
    const term x = affine(&k[BASE], &k[SLOPE], &p->d, range_product(k[PRODUCT].exact, p->inverse), TERM_DOUBLE);
    return term_rounded(over(&k[PRODUCT], &x, p->eye, TERM_DOUBLE), TERM_SINGLE);
}

enum { PHI = SLOPE };

static void phi_constants(const dp_setup *setup, term *k) {
    k[PRODUCT] = term_exact(setup->spec.znear);
    k[PHI] = term_constant(setup->spec.znear / setup->spec.zfar, TERM_DOUBLE);
}

static term phi_run(const term *k, const bound_piece *p) {
    const term q = rest_of(p, TERM_DOUBLE);
    const range exact = range_product(k[PRODUCT].exact, p->inverse);
    const term x =
        p->reversed ? affine(&p->d, &k[PHI], &q, exact, TERM_DOUBLE) : affine(&q, &k[PHI], &p->d, exact, TERM_DOUBLE);
    return term_rounded(over(&k[PRODUCT], &x, p->eye, TERM_DOUBLE), TERM_SINGLE);
}

static void no_constants(const dp_setup *setup, term *k) {
    (void)setup;
    (void)k;
}

/* Pairs leave 70 squares of a unit, see depthprec(7), and one rounding. */
static term pair_run(const term *k, const bound_piece *p) {
    (void)k;
    return term_rounded(term_within(p->eye, (range){-0x1p-41, 0x1p-41}), TERM_SINGLE);
}

const bound_steps bound_unity = {unity_constants, by_d};
const bound_steps bound_complement_unity = {complement_unity_constants, by_share};
const bound_steps bound_linear_01 = {linear_01_constants, linear_01_run};
const bound_steps bound_linear_01_near = {linear_01_near_constants, linear_01_near_run};
const bound_steps bound_textbook = {textbook_constants, by_d};
const bound_steps bound_fused = {textbook_constants, fused_run};
const bound_steps bound_complement = {complement_constants, by_share};
const bound_steps bound_newton = {complement_constants, newton_run};
const bound_steps bound_magic = {unity_constants, magic_run};
const bound_steps bound_double = {double_constants, double_run};
const bound_steps bound_phi = {phi_constants, phi_run};
const bound_steps bound_pair = {no_constants, pair_run};
