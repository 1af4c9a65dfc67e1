/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Spans of what is stored in fewer bits: every number of binary16 by its own fields, bytes by counting, and quotients
 * of the shader compilers' estimate from its bits in integers and long double. */
#include "judge/stored.h"
#include "support.h"

/* A number of binary16 by its exponent and its ten bits. */
static double half_of(unsigned code) {
    const unsigned exponent = code >> 10, fraction = code & 1023;
    return exponent == 0 ? ldexp(fraction, -24) : ldexp(1024 + fraction, (int)exponent - 25);
}

TEST(halves) {
    tally t = {.name = "halves"};
    rng r = rng_make("stored halves");
    for (unsigned code = 0; code < 0x7bff; code++) {
        const double below = half_of(code), above = half_of(code + 1), v = rng_uniform(&r, below, above);
        double lo = below, hi = below;
        stored_half(&lo, &hi);
        const double least = below < 0x1p-14 ? 0 : below;
        TALLY(&t, lo == least && hi == below, "%a: %a to %a", below, lo, hi);
        lo = hi = v;
        stored_half(&lo, &hi);
        TALLY(&t,
              lo == (v < 0x1p-14  ? 0
                     : v == above ? above
                                  : below) &&
                  (hi == above || hi == v),
              "%a: %a to %a", v, lo, hi);
        lo = hi = -v;
        stored_half(&lo, &hi);
        TALLY(&t,
              hi == (v < 0x1p-14  ? 0
                     : v == above ? -above
                                  : -below) &&
                  (lo == -above || lo == -v),
              "%a: %a to %a", -v, lo, hi);
    }
    double lo = 65505, hi = 70000;
    stored_half(&lo, &hi);
    assert_true(lo == 65504 && isinf(hi));
    tally_end(&t);
}

TEST(bytes) {
    tally t = {.name = "bytes"};
    rng r = rng_make("stored bytes");
    for (int i = 0; i < 100000; i++) {
        const double v = rng_uniform(&r, 0, 1), cut = floor(v * 255) / 255, nearest = round(v * 255) / 255;
        double lo = v, hi = v;
        stored_bytes(true, &lo, &hi);
        TALLY(&t, lo <= cut && cut <= hi && hi - lo <= 1.01 / 255, "%a cut: %a to %a", v, lo, hi);
        lo = hi = v;
        stored_bytes(false, &lo, &hi);
        TALLY(&t, lo <= nearest && nearest <= hi && hi - lo <= 1.03 / 255, "%a: %a to %a", v, lo, hi);
    }
    tally_end(&t);
}

/* The estimate's bits are 0x7ef311c7 less those of what is divided by; each step doubles the digits. */
TEST(quotients) {
    static const double worst[] = {0.125, 0.0156, 0.00025}; /* of 1: 1/8, and its squares, rounded up */
    tally t = {.name = "quotients"};
    rng r = rng_make("stored quotients");
    for (int i = 0; i < 100000; i++)
        for (int steps = 0; steps <= STORED_STEPS; steps++) {
            const double v = rng_log(&r, 1e-6, 1e6) * (i % 2 ? 1 : -1);
            const float x = (float)(1 / fabs(v));
            uint32_t bits;
            memcpy(&bits, &x, sizeof bits);
            bits = UINT32_C(2129859015) - bits;
            float estimate;
            memcpy(&estimate, &bits, sizeof estimate);
            long double y = (long double)estimate;
            for (int k = 0; k < steps; k++)
                y *= 2 - y / fabsl((long double)v);
            double lo = v, hi = v;
            stored_quotient(steps, &lo, &hi);
            const double all = v < 0 ? -(double)y : (double)y;
            TALLY(&t, lo <= all && all <= hi && hi - lo <= 0x1p-20 * fabs(v), "%a, %d steps: %a to %a, not %a", v,
                  steps, lo, hi, all);
            TALLY(&t, fabs(all / v - 1) <= worst[steps], "%a, %d steps: %a", v, steps, all);
        }
    tally_end(&t);
}
