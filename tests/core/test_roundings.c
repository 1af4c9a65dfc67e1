/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The shares by which bounds are made safe: exactly, of all that so many roundings can do, that they outweigh as many
 * as their names say, and not twice as many.
 */

#include <gmp.h>

#include "core/outward.h"
#include "support.h"

static const struct share {
    double share;
    unsigned long roundings;
    int bits; /* of the numbers that are rounded */
} shares[] = {
    {DP_ROUNDINGS_2, 2, 53},       {DP_ROUNDINGS_6, 6, 53},      {DP_ROUNDINGS_14, 14, 53},
    {DP_ROUNDINGS_30, 30, 53},     {DP_ROUNDINGS_126, 126, 53},  {DP_ROUNDINGS_510, 510, 53},
    {DP_ROUNDINGS_8190, 8190, 53}, {DP_ROUNDINGS32_2, 2, 24},    {DP_ROUNDINGS32_14, 14, 24},
    {DP_ROUNDINGS32_254, 254, 24}, {DP_OUTWARD - 1.0, 8190, 53},
};

/* What (1 + off u)^(n + 1) (1 - off s u) is, compared with 1, for off of 1 or -1: its sign less that of 1. */
static int compared(const struct share *s, unsigned long roundings, int off) {
    mpz_t one, product, factor;
    mpz_inits(one, product, factor, NULL);
    mpz_ui_pow_ui(one, 2, (unsigned long)s->bits);
    mpz_set(factor, one);
    off > 0 ? mpz_add_ui(factor, factor, 1) : mpz_sub_ui(factor, factor, 1);
    mpz_pow_ui(product, factor, roundings + 1);
    const unsigned long units = (unsigned long)ldexp(s->share, s->bits);
    off > 0 ? mpz_sub_ui(factor, one, units) : mpz_add_ui(factor, one, units);
    mpz_mul(product, product, factor);
    mpz_pow_ui(one, one, roundings + 2);
    const int sign = mpz_cmp(product, one);
    mpz_clears(one, product, factor, NULL);
    return sign;
}

static void outweigh_as_many_as_they_say(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof shares / sizeof shares[0]; i++) {
        assert_true(compared(&shares[i], shares[i].roundings, -1) >= 0); /* raised: not below */
        assert_true(compared(&shares[i], shares[i].roundings, 1) <= 0);  /* lowered: not above */
        assert_true(compared(&shares[i], 2 * shares[i].roundings + 2, -1) < 0);
    }
}

/* Sums whose every addition loses as much as it can: (1 + 2^-53) is rounded to 1, which is half a unit. */
static void outweigh_the_worst_sums(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof shares / sizeof shares[0]; i++) {
        if (shares[i].bits != 53)
            continue;
        double sum = 1.0;
        for (unsigned long n = 0; n < shares[i].roundings; n++)
            sum += 0x1p-53;
        const double exact_above_one = (double)shares[i].roundings * 0x1p-53;
        assert_true(sum == 1.0);
        assert_true(sum * (1.0 + shares[i].share) - 1.0 >= exact_above_one);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(outweigh_as_many_as_they_say),
        cmocka_unit_test(outweigh_the_worst_sums),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
