/* SPDX-License-Identifier: MIT */
/*
 * Each function reduces its argument by a table or a multiple until a Taylor series is short, and keeps as unevaluated
 * sums of two doubles what the series begins with. What is left to plain doubles is 2^-7 of the result or less, and so
 * its roundings are that of a unit. depthprec(7) counts them.
 */
#include "core/elementary.h"

#include <math.h>
#include <stdlib.h>

#include "core/expansion.h"
#include "core/lattice.h"

#define SIZE(array) ((int)(sizeof(array) / sizeof((array)[0])))

/* a b exactly, as dp_two_product(): faster where fma is a function. |a|, |b| < 2^500, or 2^996 where b is 1 */
static inline dp_pair product(double a, double b) {
    const double p = a * b;
    const double in_a = 134217729.0 * a; /* 2^27 + 1: halves of 26 bits, Veltkamp's */
    const double in_b = 134217729.0 * b;
    const double a1 = in_a - (in_a - a);
    const double b1 = in_b - (in_b - b);
    const double a2 = a - a1;
    const double b2 = b - b1;
    return (dp_pair){p, ((a1 * b1 - p) + a1 * b2 + a2 * b1) + a2 * b2};
}

static inline dp_pair pair_product(dp_pair a, dp_pair b) {
    const dp_pair p = product(a.hi, b.hi);
    return dp_quick_two_sum(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
}

static inline dp_pair pair_quotient(dp_pair a, dp_pair b) {
    const double q = a.hi / b.hi;
    const dp_pair p = product(q, b.hi);
    return dp_quick_two_sum(q, (((a.hi - p.hi) - p.lo) + (a.lo - q * b.lo)) / b.hi);
}

/* The nearest whole number, |x| < 2^51 */
static inline double whole(double x) {
    return (x + 0x1.8p52) - 0x1.8p52;
}

/* x 2^e, rounded once, and the e of x in [2^(e-1), 2^e), which are calls in general */
static inline double scaled(double x, int e) {
    return e >= -1022 && e <= 1023 ? x * dp_power2(e) : ldexp(x, e);
}

static inline int exponent_above(double x) {
    int e;
    if (x >= 0x1p-1022)
        return dp_exponent(x) + 1;
    frexp(x, &e);
    return e;
}

/* The sum of c[i] x^i: even and odd powers apart, for processors that do both at once */
static inline double series(const double *c, int count, double x) {
    const double square = x * x;
    double part[2] = {0.0, 0.0};
    for (int i = count - 1; i >= 0; i--)
        part[i % 2] = part[i % 2] * square + c[i];
    return part[0] + x * part[1];
}

/* ---- Logarithms ------------------------------------------------------------------------------------------------ */

/* log(2) in 40 bits, so that multiples are exact, and the rest */
static const dp_pair log_two = {0x1.62e42fefa4p-1, -0x1.8432a1b0e2634p-43};

/* A number near 1/x for the x of a piece of [11/16, 11/8), and minus its logarithm. Next to 1 it is 1. */
static const struct {
    double inverse;
    dp_pair log;
} pieces[32] = {
    {0x1.7p0, {-0x1.739d7f6bbd007p-2, 0x1.8c76ceb014b04p-56}},
    {0x1.68p0, {-0x1.5d1bdbf5809cap-2, -0x1.4236383dc7fe1p-56}},
    {0x1.6p0, {-0x1.4618bc21c5ec2p-2, -0x1.f42decdeccf1dp-56}},
    {0x1.59p0, {-0x1.31871c9544185p-2, 0x1.51acc4c09b379p-60}},
    {0x1.52p0, {-0x1.1c898c16999fbp-2, 0x1.0e5c62aff1c44p-60}},
    {0x1.4bp0, {-0x1.071b85fcd590dp-2, -0x1.d1707f97bde8p-58}},
    {0x1.44p0, {-0x1.e27076e2af2e6p-3, 0x1.61578001e0162p-59}},
    {0x1.3ep0, {-0x1.bc286742d8cd6p-3, -0x1.4fce744870f55p-58}},
    {0x1.38p0, {-0x1.9525a9cf456b4p-3, -0x1.d904c1d4e2e26p-57}},
    {0x1.32p0, {-0x1.6d60fe719d21dp-3, 0x1.caae268ecd179p-57}},
    {0x1.2dp0, {-0x1.4ba36f39a55e5p-3, -0x1.68981bcc36756p-57}},
    {0x1.27p0, {-0x1.2266f190a5acbp-3, -0x1.f547bf1809e88p-57}},
    {0x1.22p0, {-0x1.fec9131dbeabbp-4, 0x1.5746b9981b36cp-58}},
    {0x1.1dp0, {-0x1.b78c82bb0eda1p-4, -0x1.0878cf0327e21p-61}},
    {0x1.18p0, {-0x1.6f0d28ae56b4cp-4, 0x1.906d99184b992p-58}},
    {0x1.13p0, {-0x1.253f62f0a1417p-4, 0x1.c125963fc4cfdp-62}},
    {0x1.0fp0, {-0x1.d276b8adb0b52p-5, -0x1.1e3c53257fd47p-61}},
    {0x1.0ap0, {-0x1.39e87b9febd6p-5, 0x1.5bfa937f551bbp-59}},
    {0x1.06p0, {-0x1.7b91b07d5b11bp-6, 0x1.5b602ace3a51p-60}},
    {0x1p0, {0.0, 0.0}},
    {0x1p0, {0.0, 0.0}},
    {0x1.eap-1, {0x1.67c94f2d4bb58p-5, 0x1.0413e6505e603p-59}},
    {0x1.dap-1, {0x1.3bdf5a7d1ee64p-4, 0x1.7a976d3b5b45fp-59}},
    {0x1.cep-1, {0x1.a4e7640b1bc38p-4, -0x1.5b5ca203e4259p-58}},
    {0x1.cp-1, {0x1.1178e8227e47cp-3, -0x1.0e63a5f01c691p-58}},
    {0x1.b4p-1, {0x1.4913d8333b561p-3, -0x1.0d5604930f135p-58}},
    {0x1.aap-1, {0x1.7898d85444c73p-3, 0x1.ef8f6ebcfb201p-58}},
    {0x1.9ep-1, {0x1.b31d8575bce3dp-3, -0x1.6353ab386a94dp-57}},
    {0x1.94p-1, {0x1.e530effe71012p-3, 0x1.2276041f43042p-59}},
    {0x1.8ap-1, {0x1.0c42d676162e3p-2, 0x1.162c79d5d11eep-58}},
    {0x1.82p-1, {0x1.214456d0eb8d4p-2, 0x1.f7ae91aeba60ap-57}},
    {0x1.78p-1, {0x1.3c25277333184p-2, -0x1.2ad27e50a8ec6p-56}},
};

/* log(x 2^more); x.hi positive, finite and not below 2^-1022. Good to 2^-61. */
static dp_pair log_of(dp_pair x, int more) {
    static const uint64_t first = 0x3fe6000000000000; /* 11/16 */
    static const double c[] = {1.0 / 3.0, -1.0 / 4.0,  1.0 / 5.0,  -1.0 / 6.0,  1.0 / 7.0, -1.0 / 8.0,
                               1.0 / 9.0, -1.0 / 10.0, 1.0 / 11.0, -1.0 / 12.0, 1.0 / 13.0};
    const uint64_t place = dp_bits64(x.hi) - first;
    const int piece = (int)(place >> 47 & 31);
    const int k = (int)(place >> 52) - (place >> 63 ? 4096 : 0);
    const double z = dp_float64(dp_bits64(x.hi) - (place & 0xfff0000000000000));
    const double lo = k > 1000 ? 0.0 : x.lo * dp_power2(-k);
    const dp_pair p = product(z, pieces[piece].inverse);
    const dp_pair f = dp_two_sum(p.hi - 1.0, p.lo + pieces[piece].inverse * lo); /* |f| <= 1/32 */
    /* log(1 + f) = f - f^2/2 + f^3/3 - ... */
    const dp_pair square = product(f.hi, f.hi);
    const dp_pair s = dp_quick_two_sum(f.hi, -0.5 * square.hi);
    const double rest = square.hi * f.hi * series(c, SIZE(c), f.hi) - 0.5 * square.lo + (f.lo - f.hi * f.lo);
    const double times = k + more;
    const dp_pair a = dp_two_sum(times * log_two.hi, pieces[piece].log.hi);
    const dp_pair b = dp_two_sum(a.hi, s.hi);
    return dp_quick_two_sum(b.hi, b.lo + (a.lo + (s.lo + (rest + (times * log_two.lo + pieces[piece].log.lo)))));
}

/* log(x); that of 0, of what is infinite and of what has none as hi alone */
static inline dp_pair log_any(double x) {
    if (x >= 0x1p-1022 && x < HUGE_VAL)
        return log_of((dp_pair){x, 0.0}, 0);
    if (x > 0.0 && x < 1.0)
        return log_of((dp_pair){x * 0x1p54, 0.0}, -54);
    return (dp_pair){x == 0.0 ? -HUGE_VAL : x > 0.0 ? x : (double)NAN, 0.0};
}

double dp_log(double x) {
    const dp_pair l = log_any(x);
    return l.hi + l.lo;
}

static double log_times(double x, dp_pair factor) {
    const dp_pair l = log_any(x);
    const dp_pair p = pair_product(l, factor);
    return isinf(l.hi) ? l.hi : p.hi + p.lo;
}

double dp_log2(double x) {
    return log_times(x, (dp_pair){0x1.71547652b82fep0, 0x1.777d0ffda0d24p-56});
}

double dp_log10(double x) {
    return log_times(x, (dp_pair){0x1.bcb7b1526e50ep-2, 0x1.95355baaafad3p-57});
}

double dp_log1p(double x) {
    if (!(x > -1.0 && x < HUGE_VAL))
        return dp_log(1.0 + x);
    if (fabs(x) < 0x1p-54)
        return x;
    const dp_pair l = log_of(dp_two_sum(1.0, x), 0);
    return l.hi + l.lo;
}

/* ---- Exponentials ---------------------------------------------------------------------------------------------- */

/* 2^(j/16) */
static const dp_pair roots[16] = {
    {0x1p0, 0.0},
    {0x1.0b5586cf9890fp0, 0x1.8a62e4adc610bp-54},
    {0x1.172b83c7d517bp0, -0x1.19041b9d78a76p-55},
    {0x1.2387a6e756238p0, 0x1.9b07eb6c70573p-54},
    {0x1.306fe0a31b715p0, 0x1.6f46ad23182e4p-55},
    {0x1.3dea64c123422p0, 0x1.ada0911f09ebcp-55},
    {0x1.4bfdad5362a27p0, 0x1.d4397afec42e2p-56},
    {0x1.5ab07dd485429p0, 0x1.6324c054647adp-54},
    {0x1.6a09e667f3bcdp0, -0x1.bdd3413b26456p-54},
    {0x1.7a11473eb0187p0, -0x1.41577ee04992fp-55},
    {0x1.8ace5422aa0dbp0, 0x1.6e9f156864b27p-54},
    {0x1.9c49182a3f09p0, 0x1.c7c46b071f2bep-56},
    {0x1.ae89f995ad3adp0, 0x1.7a1cd345dcc81p-54},
    {0x1.c199bdd85529cp0, 0x1.11065895048ddp-55},
    {0x1.d5818dcfba487p0, 0x1.2ed02d75b3707p-55},
    {0x1.ea4afa2a490dap0, -0x1.e9c23179c2893p-54},
};

/* e^r - 1 for |r| <= log(2)/32. Good to 2^-63. */
static dp_pair less_one(dp_pair r) {
    static const double c[] = {1.0 / 6.0,    1.0 / 24.0,    1.0 / 120.0,   1.0 / 720.0,
                               1.0 / 5040.0, 1.0 / 40320.0, 1.0 / 362880.0};
    const dp_pair square = product(r.hi, r.hi);
    const dp_pair s = dp_quick_two_sum(r.hi, 0.5 * square.hi);
    const double rest = square.hi * r.hi * series(c, SIZE(c), r.hi) + 0.5 * square.lo + (r.lo + r.lo * s.hi);
    return dp_quick_two_sum(s.hi, s.lo + rest);
}

/* e^x = 2^k (1 + result), where k is 0 and so is the rest of 1 next to x = 0; |x| < 800 */
static dp_pair exp_of(dp_pair x, int *k) {
    static const dp_pair step = {0x1.62e42fefap-5, 0x1.cf79abc9e3b3ap-44}; /* log(2)/16; hi has 37 bits */
    const double n = whole(x.hi * 0x1.71547652b82fep4);
    const dp_pair near = dp_two_sum(x.hi, -n * step.hi);
    const dp_pair p = less_one(dp_two_sum(near.hi, near.lo + (x.lo - n * step.lo)));
    const int part = (int)n & 15;
    *k = ((int)n - part) / 16;
    if (part == 0)
        return p;
    return dp_pair_sum((dp_pair){roots[part].hi - 1.0, roots[part].lo}, pair_product(roots[part], p));
}

/* e^x for |x| < 800 */
static double exp_pair(dp_pair x) {
    int k;
    const dp_pair p = exp_of(x, &k);
    const dp_pair one = dp_quick_two_sum(1.0, p.hi);
    const double sum = one.hi + (one.lo + p.lo);
    return abs(k) < 1000 ? sum * dp_power2(k) : ldexp(sum, k);
}

double dp_exp(double x) {
    return fabs(x) < 800.0 ? exp_pair((dp_pair){x, 0.0}) : x < 0.0 ? 0.0 : x + HUGE_VAL;
}

double dp_expm1(double x) {
    if (!(x > -50.0 && x < 50.0))
        return x < 0.0 ? -1.0 : dp_exp(x);
    if (fabs(x) < 0x1p-54)
        return x;
    int k;
    const dp_pair p = exp_of((dp_pair){x, 0.0}, &k);
    if (k == 0)
        return p.hi + p.lo;
    const double power = dp_power2(k);
    const dp_pair rest = dp_two_sum(power, -1.0);
    const dp_pair s = dp_two_sum(rest.hi, power * p.hi);
    return s.hi + (s.lo + (rest.lo + power * p.lo));
}

double dp_exp2(double x) {
    if (!(fabs(x) < 1100.0))
        return x < 0.0 ? 0.0 : x + HUGE_VAL;
    return exp_pair(pair_product((dp_pair){x, 0.0}, (dp_pair){0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56}));
}

double dp_pow(double x, double y) {
    if (y == 0.0 || x == 1.0)
        return 1.0;
    if (!(x > 0.0 && x < HUGE_VAL) || isnan(y))
        return x >= 0.0 && !isnan(y) ? ((x > 0.0) == (y > 0.0) ? HUGE_VAL : 0.0) : (double)NAN;
    const dp_pair l = log_any(x);
    const double size = l.hi * y;
    return fabs(size) < 780.0 ? exp_pair(pair_product(l, (dp_pair){y, 0.0})) : size < 0.0 ? 0.0 : HUGE_VAL;
}

/* e^r - 1 for |r| <= log(2)/2, good to 2^-45 */
static inline double less_one_quick(double r) {
    static const double c[] = {1.0 / 2.0,    1.0 / 6.0,     1.0 / 24.0,     1.0 / 120.0,     1.0 / 720.0,
                               1.0 / 5040.0, 1.0 / 40320.0, 1.0 / 362880.0, 1.0 / 3628800.0, 1.0 / 39916800.0};
    return r + r * r * series(c, SIZE(c), r);
}

float dp_exp2f(float x) {
    if (!(x > -200.0F && x < 128.0F))
        return x < 0.0F ? 0.0F : x + HUGE_VALF;
    const double k = whole((double)x);
    const double power = dp_power2((int)k);
    return (float)(power + power * less_one_quick(((double)x - k) * 0x1.62e42fefa39efp-1));
}

/* e^x = 2^k (1 + result) */
static inline double exp_quick(double x, double *power) {
    const double k = whole(x * 0x1.71547652b82fep0);
    *power = dp_power2((int)k);
    return less_one_quick(x - k * 0x1.62e42fefa39efp-1);
}

float dp_expf(float x) {
    if (!(x > -130.0F && x < 89.0F))
        return x < 0.0F ? 0.0F : x + HUGE_VALF;
    double power;
    const double p = exp_quick((double)x, &power);
    return (float)(power + power * p);
}

float dp_expm1f(float x) {
    if (!(x > -20.0F && x < 89.0F))
        return x < 0.0F ? -1.0F : x + HUGE_VALF;
    double power;
    const double p = exp_quick((double)x, &power);
    return x == 0.0F ? x : (float)((power - 1.0) + power * p);
}

/* ---- Angles ---------------------------------------------------------------------------------------------------- */

static const dp_pair half_pi = {0x1.921fb54442d18p0, 0x1.1a62633145c07p-54};

/* x - k pi/2, within pi/4 of 0, and k; |x| <= 1e6 */
static dp_pair quarter(double x, unsigned *k) {
    /* pi/2 in three parts of 33 bits, whose multiples are exact, and the rest: it may come within 2^-60 of x / k */
    static const double part[] = {0x1.921fb544p0, 0x1.0b4611a6p-34, 0x1.3198a2ep-69, 0x1.b839a252049c1p-104};
    const double n = whole(x * 0x1.45f306dc9c883p-1);
    *k = (unsigned)(int)n & 3U;
    if (n == 0.0)
        return (dp_pair){x, 0.0};
    const dp_pair a = dp_two_sum(x, -n * part[0]);
    const dp_pair b = dp_two_sum(a.hi, -n * part[1]);
    const dp_pair c = dp_two_sum(b.hi, -n * part[2]);
    return dp_two_sum(c.hi, a.lo + b.lo + c.lo - n * part[3]);
}

/* sin(r) = r - r^3/6 + r^5/120 - ..., |r| <= pi/4. Good to 2^-58. */
static dp_pair sine(dp_pair r) {
    static const double c[] = {
        1.0 / 120.0,        -1.0 / 5040.0,          1.0 / 362880.0,          -1.0 / 39916800.0,
        1.0 / 6227020800.0, -1.0 / 1307674368000.0, 1.0 / 355687428096000.0, -1.0 / 121645100408832000.0};
    const dp_pair square = product(r.hi, r.hi);
    const dp_pair cube = pair_product(square, (dp_pair){r.hi, 0.0});
    const dp_pair sixth = pair_product(cube, (dp_pair){-0x1.5555555555555p-3, -0x1.5555555555555p-57});
    const dp_pair s = dp_quick_two_sum(r.hi, sixth.hi);
    const double rest = cube.hi * square.hi * series(c, SIZE(c), square.hi) + sixth.lo;
    return dp_quick_two_sum(s.hi, s.lo + (rest + r.lo * (1.0 - 0.5 * square.hi)));
}

/* cos(r) = 1 - r^2/2 + r^4/24 - ..., |r| <= pi/4. Good to 2^-60. */
static dp_pair cosine(dp_pair r) {
    static const double c[] = {
        -1.0 / 720.0,         1.0 / 40320.0,          -1.0 / 3628800.0,         1.0 / 479001600.0,
        -1.0 / 87178291200.0, 1.0 / 20922789888000.0, -1.0 / 6402373705728000.0};
    const dp_pair square = product(r.hi, r.hi);
    const dp_pair fourth = pair_product(square, square);
    const dp_pair part = pair_product(fourth, (dp_pair){0x1.5555555555555p-5, 0x1.5555555555555p-59});
    const dp_pair s = dp_quick_two_sum(1.0, -0.5 * square.hi);
    const dp_pair t = dp_quick_two_sum(s.hi, part.hi);
    const double rest = fourth.hi * square.hi * series(c, SIZE(c), square.hi) + part.lo - 0.5 * square.lo;
    const double moved = r.lo * r.hi * (1.0 - square.hi * (1.0 / 6.0));
    return dp_quick_two_sum(t.hi, t.lo + (s.lo + (rest - moved)));
}

/* sin(x + turns pi/2) */
static double sine_turned(double x, unsigned turns) {
    if (!(fabs(x) <= 1e6))
        return (double)NAN;
    unsigned k;
    const dp_pair r = quarter(x, &k);
    k += turns;
    const dp_pair s = k & 1U ? cosine(r) : sine(r);
    return k & 2U ? -(s.hi + s.lo) : s.hi + s.lo;
}

double dp_sin(double x) {
    return fabs(x) < 0x1p-27 ? x : sine_turned(x, 0);
}

double dp_cos(double x) {
    return sine_turned(x, 1);
}

double dp_tan(double x) {
    if (fabs(x) < 0x1p-27)
        return x;
    if (!(fabs(x) <= 1e6))
        return (double)NAN;
    unsigned k;
    const dp_pair r = quarter(x, &k);
    const dp_pair s = sine(r);
    const dp_pair c = cosine(r);
    const dp_pair t = k & 1U ? pair_quotient((dp_pair){-c.hi, -c.lo}, s) : pair_quotient(s, c);
    return t.hi + t.lo;
}

double dp_half_tangent(double fov) {
    return dp_tan(0.5 * fov * DP_DEGREE);
}

/* atan(y/x), 0 <= y <= x, x > 0: from the nearest of 0, 1/4, ..., 1. Good to 2^-57. */
static dp_pair slope_angle(double y, double x) {
    static const dp_pair known[] = {{0.0, 0.0},
                                    {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
                                    {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
                                    {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
                                    {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55}};
    static const double c[] = {-1.0 / 3.0, 1.0 / 5.0,   -1.0 / 7.0, 1.0 / 9.0,  -1.0 / 11.0,
                               1.0 / 13.0, -1.0 / 15.0, 1.0 / 17.0, -1.0 / 19.0};
    if (y < 0x1p-30 * x)
        return (dp_pair){y / x, 0.0};
    const int e = exponent_above(x);
    x = scaled(x, -e);
    y = scaled(y, -e);
    const int nearest = (int)(4.0 * y / x + 0.5);
    const dp_pair to_x = product(-0.25 * nearest, x);
    const dp_pair to_y = product(0.25 * nearest, y);
    const dp_pair t = pair_quotient(dp_pair_sum((dp_pair){y, 0.0}, to_x), dp_pair_sum((dp_pair){x, 0.0}, to_y));
    const double square = t.hi * t.hi;
    const dp_pair s = dp_two_sum(known[nearest].hi, t.hi);
    const double rest = t.hi * square * series(c, SIZE(c), square) + t.lo * (1.0 - square);
    return dp_quick_two_sum(s.hi, s.lo + (rest + known[nearest].lo));
}

double dp_atan2(double y, double x) {
    double up = fabs(y);
    double along = fabs(x);
    if (isnan(up) || isnan(along))
        return (double)NAN;
    if (isinf(up) || isinf(along)) {
        up = isinf(up) ? 1.0 : 0.0;
        along = isinf(along) ? 1.0 : 0.0;
    }
    dp_pair a = up <= along ? along > 0.0 ? slope_angle(up, along) : (dp_pair){0.0, 0.0} : slope_angle(along, up);
    if (up > along)
        a = dp_pair_sum(half_pi, (dp_pair){-a.hi, -a.lo});
    if (signbit(x))
        a = dp_pair_sum((dp_pair){2.0 * half_pi.hi, 2.0 * half_pi.lo}, (dp_pair){-a.hi, -a.lo});
    return copysign(a.hi + a.lo, y);
}

double dp_atan(double x) {
    return dp_atan2(x, 1.0);
}

double dp_asin(double x) {
    return dp_atan2(x, sqrt((1.0 - x) * (1.0 + x)));
}

/* ---- Lengths --------------------------------------------------------------------------------------------------- */

double dp_hypot(double x, double y) {
    const double longer = fabs(x) > fabs(y) ? fabs(x) : fabs(y);
    if (isinf(x) || isinf(y))
        return HUGE_VAL;
    if (isnan(x) || isnan(y))
        return x + y;
    if (longer == 0.0)
        return 0.0;
    const int e = exponent_above(longer);
    x = scaled(x, -e);
    y = scaled(y, -e);
    const dp_pair a = product(x, x);
    const dp_pair b = product(y, y);
    const dp_pair sum = dp_two_sum(a.hi, b.hi);
    const double root = sqrt(sum.hi);
    const dp_pair back = product(root, root);
    return scaled(root + 0.5 * (((sum.hi - back.hi) - back.lo) + (sum.lo + (a.lo + b.lo))) / root, e);
}
