/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The quotients that the AVX-512 kernels take without the divider: rounded as the divider rounds, whatever estimate of
 * 2^-14 the processor starts from. The steps are computed here once more, in fused operations of the C library.
 */
#include "core/batch_plan.h"
#include "depthprec/depthprec.h"
#include "support.h"

/* The reciprocal after Newton's step on an estimate whose error is e: the exact 1/b - e^2/b, rounded. */
static float reciprocal(float b, double e) {
    return (float)((1.0 - e * e) / (double)b);
}

static float quotient(float a, float b, float y) {
    const float q = a * y;
    return fmaf(fmaf(-b, q, a), y, q);
}

/* All y that an estimate within 2^-14 and its rounded residue, 2^-38 more, can lead to. */
static void all_estimates(tally *t, float a, float b) {
    const float low = nextafterf(reciprocal(b, 0x1.01p-14), 0.0F);
    const float high = nextafterf(reciprocal(b, 0.0), 4.0F);
    for (float y = low; y <= high; y = nextafterf(y, 4.0F)) {
        const double least = (1.0 - 0x1.01p-28) / (double)b;
        const double most = (1.0 + 0x1p-37) / (double)b;
        const double step = (double)nextafterf(y, 4.0F) - (double)y;
        if ((double)y + step / 2 < least || (double)y - step / 2 > most)
            continue;
        const float got = quotient(a, b, y);
        TALLY(t, got == a / b, "%a/%a by %a gives %a", (double)a, (double)b, (double)y, (double)got);
    }
}

static uint64_t power_modulo(uint64_t base, unsigned exponent, uint64_t m) {
    uint64_t r = 1;
    for (; exponent > 0; exponent--)
        r = r * base % m;
    return r;
}

/*
 * A quotient can only be rounded wrongly when it is next to a middle between two floats, a 2^25 = m b +- 1 with
 * integers a and b of 24 bits, and b is in the last 32nd of its range: there is one such numerator a = L 2^9 for each b
 * and sign, or none, and each of them is tried with every estimate.
 */
TEST(test_hardest) {
    tally t = {.name = "hardest"};
    for (uint64_t b = (1U << 24) - (1U << 19) + 1; b < 1U << 24; b += 2) {
        /* 1/2 is (b + 1)/2 modulo b */
        const uint64_t inverse = power_modulo((b + 1) / 2, 34, b);
        const uint64_t side[] = {inverse, b - inverse};
        for (int k = 0; k < 2; k++)
            if (side[k] >= DP_BATCH_TOP_FIRST && side[k] < DP_BATCH_TOP_FIRST + DP_BATCH_TOPS)
                all_estimates(&t, (float)dp_batch_top((int)side[k] - DP_BATCH_TOP_FIRST), (float)b * 0x1p-24F);
    }
    assert_true(t.cases > 50);
    tally_end(&t);
}

/* Any numerator of the list and any divisor. */
TEST(test_estimates) {
    tally t = {.name = "estimates"};
    rng r = rng_make("estimates");
    for (uint64_t i = 0; i < test_cases(100000, 1000000, 10000000); i++)
        all_estimates(&t, (float)dp_batch_top((int)rng_below(&r, DP_BATCH_TOPS)),
                      (float)(1U << 23 | rng_below(&r, 1U << 23)) * 0x1p-24F);
    tally_end(&t);
}

static dp_batch eye_batch(dp_real real, dp_path path) {
    dp_format format[2];
    dp_spec spec = dp_spec_default();
    dp_setup setup;
    dp_batch b;
    assert_true(dp_format_parse("unorm24", format) > 0);
    spec.format = format[0];
    spec.znear = 0.1;
    spec.zfar = 1000.0;
    spec.mapping = DP_MAPPING_REVERSED;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    assert_int_equal(dp_batch_init(&b, &setup, DP_TASK_EYE, real, DP_WORD_32, path), DP_OK);
    return b;
}

/* This processor: every mantissa of a divisor, for a few numerators or with DEPTHPREC_FULL for each. */
TEST(test_every_divisor) {
    enum { CHUNK = 1 << 12 };
    static uint32_t code[CHUNK];
    static float want[CHUNK], got[CHUNK];
    tally t = {.name = "every divisor"};
    rng r = rng_make("every divisor");
    const uint64_t tops = test_cases(1, 4, DP_BATCH_TOPS);
    if (!dp_path_available(DP_PATH_AVX512))
        skip();
    dp_batch plain = eye_batch(DP_REAL_FLOAT, DP_PATH_BASELINE);
    dp_batch fast = eye_batch(DP_REAL_FLOAT, DP_PATH_AVX512);
    for (uint32_t first = 0; first < 1U << 23; first += CHUNK) {
        for (uint32_t i = 0; i < CHUNK; i++)
            code[i] = first + i;
        for (uint64_t k = 0; k < tops; k++) {
            const uint64_t which = tops == DP_BATCH_TOPS ? k : rng_below(&r, DP_BATCH_TOPS);
            dp_batch_write(&fast)->numbers.eye_top = (float)dp_batch_top((int)which);
            dp_batch_write(&fast)->numbers.eye_slope = 1.0F;
            dp_batch_write(&fast)->numbers.eye_base = 0x1p23F;
            dp_batch_write(&plain)->numbers = dp_batch_write(&fast)->numbers;
            dp_batch_run(&plain, code, want, CHUNK);
            for (int half = 0; half < 2; half++) { /* either half of a pair goes without the divider */
                const size_t from = half == 0 ? 0 : 16;
                dp_batch_run(&fast, code + from, got + from, CHUNK - from);
                t.cases += CHUNK - from;
                if (memcmp(want + from, got + from, (CHUNK - from) * sizeof *got) != 0)
                    tally_fail(&t, "numerator %a, codes from %u", (double)dp_batch_write(&fast)->numbers.eye_top,
                               first);
            }
        }
    }
    tally_end(&t);
}

/* The inverse of an odd b modulo 2^53 gives the numerators whose quotients by b lie next to a middle. */
static double next_to_middle(uint64_t b, int sign) {
    uint64_t inverse = b; /* right to 3 bits, then to twice as many with each step */
    for (int k = 0; k < 5; k++)
        inverse *= 2 - b * inverse;
    /* m b = +-1 modulo 2^54 with m odd, so that a = (m b -+ 1) 2^-54 */
    const uint64_t m = (sign > 0 ? inverse : -inverse) & (((uint64_t)1 << 54) - 1);
    const __uint128_t product = (__uint128_t)m * b + (sign > 0 ? 0 : 2);
    const uint64_t a = (uint64_t)((product - 1) >> 54);
    return (double)a;
}

/* Quotients next to a middle between two doubles, by the divisors that are the hardest and by any. */
TEST(test_doubles) {
    static uint32_t code[16];
    double want[16], got[16];
    tally t = {.name = "doubles"};
    rng r = rng_make("doubles");
    if (!dp_path_available(DP_PATH_AVX512))
        skip();
    dp_batch b = eye_batch(DP_REAL_DOUBLE, DP_PATH_AVX512);
    for (int i = 0; i < 16; i++)
        code[i] = 1;
    for (uint64_t n = 0; n < test_cases(20000, 300000, 10000000); n++) {
        const uint64_t ones = (((uint64_t)1 << 53) - 1);
        const uint64_t kind = rng_below(&r, 4);
        const uint64_t any = (uint64_t)1 << 52 | rng_below(&r, (uint64_t)1 << 52);
        const uint64_t divisor = kind == 0 ? ones - 2 * (n % 4096) : any | 1;
        double top = kind == 3 ? (double)((uint64_t)1 << 52 | rng_below(&r, (uint64_t)1 << 52))
                               : next_to_middle(divisor, n & 1U ? 1 : -1);
        if (n % 1000 == 0)
            top = 1.0; /* a power of two by ones */
        if (top == 0.0)
            continue;
        dp_batch_write(&b)->numbers.top = top;
        dp_batch_write(&b)->numbers.to_near = (double)divisor / 2; /* of code 1: 2 to_near + (den - 2) to_far */
        dp_batch_write(&b)->numbers.to_far = 0x1p-1000;
        dp_batch_run(&b, code, got, 16);
        for (int i = 0; i < 16; i++)
            want[i] = top / (double)divisor;
        TALLY(&t, memcmp(want, got, sizeof got) == 0, "%a / %a: %a is not %a", top, (double)divisor, got[15], want[15]);
    }
    tally_end(&t);
}
