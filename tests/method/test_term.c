/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What is known of a rounded number, against each number of binary32 about it: how far rounding moves a real number of
 * a range is found at the ends of the range and half way between neighbours, where it is largest.
 */
#include "method/term.h"

#include <math.h>

#include "support.h"

/* The most that rounding to nearest moves a number from lo to hi, of which each is a binary64 number. */
static double most_moved(double lo, double hi) {
    double most = fmax(fabs((double)(float)lo - lo), fabs((double)(float)hi - hi));
    for (float f = nextafterf((float)lo, -INFINITY); (double)f < hi; f = nextafterf(f, INFINITY)) {
        const double middle = ((double)f + (double)nextafterf(f, INFINITY)) / 2;
        if (middle >= lo && middle <= hi)
            most = fmax(most, fabs((double)(float)middle - middle));
    }
    return most;
}

/* Up to just beyond a power of two, where the step doubles: the last few of the numbers above are nearer to it than
 * half a step. */
TEST(rounded_about_a_power_of_two) {
    rng r = rng_make("rounded");
    tally t[] = {{.name = "never less than it is moved"}, {.name = "and no more"}, {.name = "multiples of the grid"}};
    for (uint64_t n = test_cases(300, 3000, 100000); n > 0; n--) {
        const double power = ldexp(1, (int)rng_below(&r, 250) - 124), step = ldexp(power, -23);
        const double lo = power - 4 * step * rng_unit(&r), hi = power + step * rng_uniform(&r, 0, n % 2 ? 0.6 : 4);
        const bool turned = rng_below(&r, 2);
        const term exact = {turned ? (range){-hi, -lo} : (range){lo, hi}, {0, 0}, {0, 0}, -1100};
        const term got = term_rounded(&exact, TERM_SINGLE, 1, false);
        const double most = most_moved(lo, hi), ends = fmax(-got.off.lo, got.off.hi);
        TALLY(&t[0], -got.off.lo >= most && got.off.hi >= most, "%a to %a: %a, not %a", lo, hi, ends, most);
        if (lo <= power - 0.75 * step) /* half a step below the power is in it */
            TALLY(&t[1], ends <= most * (1 + 1e-6), "%a to %a: %a, not %a", lo, hi, ends, most);
        const double rounded = (double)(float)rng_uniform(&r, lo, hi), count = ldexp(rounded, -got.grid);
        TALLY(&t[2], count == nearbyint(count), "%a in 2^%d", rounded, got.grid);
    }
    for (size_t i = 0; i < sizeof t / sizeof t[0]; i++)
        tally_end(&t[i]);
}

/* To either neighbour it may move a whole step; what fits is not moved; what is not finite is not known. */
TEST(rounded_otherwise) {
    const term some = {{1.25, 1.5}, {0, 0}, {0, 0}, -60};
    const term either = term_rounded(&some, TERM_SINGLE, 2, false), finer = term_rounded(&some, TERM_DOUBLE, 1, false);
    assert_relative(either.off.hi, 0x1p-23, 1e-12);
    const term above = {{1 - 0x1p-20, 1 + 0x1p-40}, {0, 0}, {0, 0}, -60}; /* the neighbour above 1 is as far as any */
    assert_relative(term_rounded(&above, TERM_SINGLE, 2, false).off.hi, 0x1p-23, 1e-6);
    assert_relative(finer.off.hi, 0x1p-53, 1e-12);
    const term whole = {{3, 1 << 20}, {0, 0}, {0, 0}, 0}, kept = term_rounded(&whole, TERM_SINGLE, 1, false);
    assert_true(kept.off.lo == 0 && kept.off.hi == 0 && kept.grid == 0);
    const term large = {{1, 0x1p128}, {0, 0}, {0, 0}, -1100};
    assert_true(isinf(term_rounded(&large, TERM_SINGLE, 1, false).off.hi));
    const term small = {{0x1p-140, 0x1p-127}, {0, 0}, {0, 0}, -1100};
    assert_relative(term_rounded(&small, TERM_SINGLE, 1, false).off.hi, 0x1p-150, 1e-12);
    const term flushed = term_rounded(&small, TERM_SINGLE, 1, true);
    assert_true(flushed.off.lo <= -0x1p-127); /* it may become 0 */
}
