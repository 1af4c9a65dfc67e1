/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The elementary functions: within their bounds of MPFR's, at random arguments, at the seams of tables and reductions
 * and where angles come nearest to multiples of pi/2; and what they do at zeros, infinities and NaN, as math.h does.
 */

#include <mpfr.h>

#include "core/elementary.h"
#include "support.h"

typedef int one(mpfr_t, const mpfr_t, mpfr_rnd_t);
typedef int two(mpfr_t, const mpfr_t, const mpfr_t, mpfr_rnd_t);

enum { BITS = 160 };

/* The distance of `got` from the exact value in units of its last place, of `bits` bits down to 2^least. */
static double units(double got, const mpfr_t exact, int bits, int least) {
    if (isinf(got) || mpfr_zero_p(exact)) {
        mpfr_t nearest;
        mpfr_init2(nearest, 53);
        mpfr_set(nearest, exact, MPFR_RNDN);
        const double want = bits == 24 ? (double)(float)mpfr_get_d(nearest, MPFR_RNDN) : mpfr_get_d(nearest, MPFR_RNDN);
        mpfr_clear(nearest);
        return got == want ? 0.0 : INFINITY;
    }
    mpfr_t off;
    mpfr_init2(off, BITS);
    mpfr_sub_d(off, exact, got, MPFR_RNDN);
    const long exponent = mpfr_get_exp(exact) - bits;
    mpfr_mul_2si(off, off, exponent > least ? -exponent : -least, MPFR_RNDN);
    const double result = fabs(mpfr_get_d(off, MPFR_RNDN));
    mpfr_clear(off);
    return result;
}

/* ---- Of one argument ------------------------------------------------------------------------------------------- */

static double of_expf(double x) {
    return (double)dp_expf((float)x);
}

static double of_expm1f(double x) {
    return (double)dp_expm1f((float)x);
}

static double of_exp2f(double x) {
    return (double)dp_exp2f((float)x);
}

typedef struct row {
    const char *name;
    double (*function)(double);
    one *exact;
    double least, most; /* magnitudes */
    int either;         /* of either sign */
    double bound;       /* units in the last place */
    double seam;        /* multiples of it are hard */
    int bits;
} row;

#define HALF_PI 0x1.921fb54442d18p0

static const row rows[] = {
    {"log", dp_log, mpfr_log, 0x1p-1074, 0x1.fffffffffffffp1023, 0, 0.51, 0x1p-6, 53},
    {"log2", dp_log2, mpfr_log2, 0x1p-1074, 0x1.fffffffffffffp1023, 0, 0.51, 0x1p-6, 53},
    {"log10", dp_log10, mpfr_log10, 0x1p-1074, 0x1.fffffffffffffp1023, 0, 0.51, 0x1p-6, 53},
    {"log1p", dp_log1p, mpfr_log1p, 0x1p-1074, 0x1.fffffffffffffp1023, 0, 0.51, 0x1p-6, 53},
    {"log1p below 0", dp_log1p, mpfr_log1p, 0x1p-60, 0x1.fffffffffffffp-1, 1, 0.51, 0x1p-6, 53},
    {"exp", dp_exp, mpfr_exp, 0x1p-70, 708.0, 1, 0.51, 0x1.62e42fefa39efp-6, 53},
    {"exp, subnormal", dp_exp, mpfr_exp, 707.0, 746.0, 1, 1.01, 0x1.62e42fefa39efp-6, 53},
    {"expm1", dp_expm1, mpfr_expm1, 0x1p-1074, 710.0, 1, 0.51, 0x1.62e42fefa39efp-6, 53},
    {"exp2", dp_exp2, mpfr_exp2, 0x1p-70, 1022.0, 1, 0.51, 0x1p-5, 53},
    {"exp2, subnormal", dp_exp2, mpfr_exp2, 1021.0, 1100.0, 1, 1.01, 0x1p-5, 53},
    {"sin", dp_sin, mpfr_sin, 0x1p-1074, 1e6, 1, 0.54, HALF_PI, 53},
    {"cos", dp_cos, mpfr_cos, 0x1p-70, 1e6, 1, 0.54, HALF_PI, 53},
    {"tan", dp_tan, mpfr_tan, 0x1p-1074, 1e6, 1, 0.54, HALF_PI, 53},
    {"sin of small angles", dp_sin, mpfr_sin, 1e-3, 10.0, 1, 0.54, HALF_PI / 2.0, 53},
    {"cos of small angles", dp_cos, mpfr_cos, 1e-3, 10.0, 1, 0.54, HALF_PI / 2.0, 53},
    {"tan of small angles", dp_tan, mpfr_tan, 1e-3, 10.0, 1, 0.54, HALF_PI / 2.0, 53},
    {"atan", dp_atan, mpfr_atan, 0x1p-1074, 0x1.fffffffffffffp1023, 1, 0.54, 0x1p-3, 53},
    {"asin", dp_asin, mpfr_asin, 0x1p-60, 1.0, 1, 3.1, 0x1p-3, 53},
    {"expf", of_expf, mpfr_exp, 0x1p-40, 103.0, 1, 0.501, 0x1.62e43p-1, 24},
    {"expm1f", of_expm1f, mpfr_expm1, 0x1p-149, 89.0, 1, 0.501, 0x1.62e43p-1, 24},
    {"exp2f", of_exp2f, mpfr_exp2, 0x1p-40, 149.0, 1, 0.501, 0.5, 24},
};

static double argument(rng *r, const row *f, uint64_t i) {
    double x = 0.0;
    switch (i % 4) {
    case 0: /* of any size */
        x = f->least * exp2(rng_unit(r) * (log2(f->most) - log2(f->least)));
        break;
    case 1:
        x = rng_uniform(r, f->least, fmin(f->most, 100.0 * fmax(f->least, 1.0)));
        break;
    default: /* at a seam, or a few doubles beside it */
        x = f->seam * (double)(1 + rng_below(r, i % 4 == 2 ? 200 : 1 + (uint64_t)fmin(f->most / f->seam, 1e9)));
        for (uint64_t steps = rng_below(r, 4); steps > 0; steps--)
            x = nextafter(x, i % 8 < 4 ? 0.0 : INFINITY);
    }
    x = fmin(fmax(x, f->least), f->most);
    x = f->bits == 24 ? (double)(float)x : x;
    return f->either && rng_below(r, 2) ? -x : x;
}

TEST(test_one) {
    mpfr_t x, exact;
    mpfr_init2(x, 53);
    mpfr_init2(exact, BITS);
    for (size_t k = 0; k < sizeof rows / sizeof rows[0]; k++) {
        const row *f = &rows[k];
        tally t = {.name = f->name};
        rng r = rng_make(f->name);
        double worst = 0.0, where = 0.0;
        for (uint64_t i = 0; i < test_cases(1000, 10000, 4000000); i++) {
            const double at = argument(&r, f, i);
            mpfr_set_d(x, at, MPFR_RNDN);
            f->exact(exact, x, MPFR_RNDN);
            const double got = f->function(at);
            const double off = units(got, exact, f->bits, f->bits == 24 ? -149 : -1074);
            if (off > worst) {
                worst = off;
                where = at;
            }
            TALLY(&t, off <= f->bound, "%s(%a) = %a is %.4f units off", f->name, at, got, off);
        }
        print_message("# %-20s %.4f units at %a\n", f->name, worst, where);
        tally_end(&t);
    }
    mpfr_clears(x, exact, (mpfr_ptr)NULL);
}

/* ---- Of two ---------------------------------------------------------------------------------------------------- */

static void pair_near(tally *t, two *exact_of, double (*function)(double, double), double x, double y, double bound) {
    mpfr_t a, b, exact;
    mpfr_inits2(53, a, b, (mpfr_ptr)NULL);
    mpfr_init2(exact, BITS);
    mpfr_set_d(a, x, MPFR_RNDN);
    mpfr_set_d(b, y, MPFR_RNDN);
    exact_of(exact, a, b, MPFR_RNDN);
    const double got = function(x, y);
    const double off = units(got, exact, 53, -1074);
    TALLY(t, off <= bound + (fabs(got) < 0x1p-1022 ? 0.5 : 0.0), "(%a, %a) = %a is %.4f units off", x, y, got, off);
    mpfr_clears(a, b, exact, (mpfr_ptr)NULL);
}

/* Numbers of sizes far apart, next to each other, and such that a seam of atan2 lies between them */
TEST(test_two) {
    tally angle = {.name = "atan2"}, length = {.name = "hypot"}, power = {.name = "pow"};
    rng r = rng_make("two");
    for (uint64_t i = 0; i < test_cases(1000, 20000, 4000000); i++) {
        const int wide = i % 4 == 0;
        const double x = exp2(rng_uniform(&r, wide ? -1074.0 : -9.0, wide ? 1023.9 : 9.0));
        double y = exp2(rng_uniform(&r, wide ? -1074.0 : -9.0, wide ? 1023.9 : 9.0));
        if (i % 4 == 1)
            y = fmin(x * (0.125 * (double)rng_below(&r, 64)) * (1.0 + 0x1p-52 * (double)rng_below(&r, 3)), 0x1p1023);
        const double sx = rng_below(&r, 2) ? -x : x, sy = rng_below(&r, 2) ? -y : y;
        pair_near(&angle, mpfr_atan2, dp_atan2, sy, sx, 0.54);
        pair_near(&length, mpfr_hypot, dp_hypot, sx, sy, 0.51);
        const double lesser = exp2(rng_uniform(&r, -100.0, 100.0));
        const double exponent = rng_uniform(&r, -1.0, 1.0) * (wide ? 790.0 / fabs(log(lesser)) : 1.0);
        pair_near(&power, mpfr_pow, dp_pow, lesser, exponent, 0.51 + fabs(exponent * log(lesser)) / 256.0);
    }
    tally_end(&angle);
    tally_end(&length);
    tally_end(&power);
}

/* Printed digits and ticks of axes rest on these. */
TEST(test_tens) {
    tally t = {.name = "tens"};
    for (int k = -300; k <= 300; k++) {
        char text[8];
        snprintf(text, sizeof text, "1e%d", k);
        const double ten = strtod(text, NULL);
        TALLY(&t, dp_log10(ten) == k, "log10(%s) is %a", text, dp_log10(ten));
        TALLY(&t, abs(k) > 22 || dp_pow(10.0, k) == ten, "pow(10, %d) is %a, not %a", k, dp_pow(10.0, k), ten);
        TALLY(&t, dp_exp2(k) == ldexp(1.0, k), "exp2(%d) is %a", k, dp_exp2(k));
        TALLY(&t, dp_log2(ldexp(1.0, k)) == k, "log2 of 2^%d is %a", k, dp_log2(ldexp(1.0, k)));
        TALLY(&t, k == 0 || dp_pow(ten, 1.0) == ten, "pow(%s, 1) is %a", text, dp_pow(ten, 1.0));
        TALLY(&t, dp_hypot(3.0 * ten, 0.0) == 3.0 * ten, "hypot(%a, 0)", 3.0 * ten);
    }
    tally_end(&t);
}

/* ---- The ends -------------------------------------------------------------------------------------------------- */

static int alike(double a, double b) {
    return isnan(a) ? isnan(b) : a == b && signbit(a) == signbit(b);
}

TEST(test_ends) {
    static const struct {
        const char *name;
        double (*ours)(double), (*theirs)(double);
        int infinite; /* an infinite argument has an answer */
    } functions[] = {
        {"log", dp_log, log, 1},       {"log1p", dp_log1p, log1p, 1}, {"log2", dp_log2, log2, 1},
        {"log10", dp_log10, log10, 1}, {"exp", dp_exp, exp, 1},       {"expm1", dp_expm1, expm1, 1},
        {"exp2", dp_exp2, exp2, 1},    {"sin", dp_sin, sin, 1},       {"cos", dp_cos, cos, 1},
        {"tan", dp_tan, tan, 1},       {"atan", dp_atan, atan, 1},    {"asin", dp_asin, asin, 1},
    };
    const double ends[] = {0.0, 1.0, INFINITY, NAN, 0x1p-1074};
    tally t = {.name = "ends"};
    for (size_t i = 0; i < sizeof functions / sizeof functions[0]; i++)
        for (size_t k = 0; k < 2 * sizeof ends / sizeof ends[0]; k++) {
            const double x = k % 2 ? -ends[k / 2] : ends[k / 2];
            const double got = functions[i].ours(x), want = functions[i].theirs(x);
            const int plain = fabs(x) == 1.0 && isfinite(want) && want != 0.0;
            TALLY(&t, plain ? fabs(got / want - 1.0) < 0x1p-51 : alike(got, want), "%s(%g) is %g, not %g",
                  functions[i].name, x, got, want);
        }
    const double both[] = {0.0, -0.0, 1.0, -1.0, INFINITY, -INFINITY};
    for (size_t i = 0; i < 6; i++)
        for (size_t k = 0; k < 6; k++) {
            const double x = both[i], y = both[k];
            TALLY(&t, ulp_distance(dp_atan2(x, y), atan2(x, y)) <= 1.0 && signbit(dp_atan2(x, y)) == signbit(x),
                  "atan2(%g, %g) is %a, not %a", x, y, dp_atan2(x, y), atan2(x, y));
            TALLY(&t, ulp_distance(dp_hypot(x, y), hypot(x, y)) <= 1.0, "hypot(%g, %g) is %a", x, y, dp_hypot(x, y));
            TALLY(&t, signbit(x) || alike(dp_pow(x, y), pow(x, y)), "pow(%g, %g) is %g", x, y, dp_pow(x, y));
        }
    TALLY(&t,
          isnan(dp_atan2(NAN, 1.0)) && isnan(dp_hypot(NAN, 1.0)) && isnan(dp_pow(NAN, 2.0)) && isnan(dp_pow(2.0, NAN)),
          "NaN of two arguments");
    TALLY(&t, isnan(dp_pow(-2.0, 0.5)) && isnan(dp_sin(1e7)) && isnan(dp_tan(-1e7)) && isnan(dp_cos(1e7)), "beyond");
    TALLY(&t,
          dp_exp(710.0) == INFINITY && dp_exp(-800.0) == 0.0 && dp_expm1(-60.0) == -1.0 && dp_exp2(1024.0) == INFINITY,
          "overflow");
    tally_end(&t);
}
