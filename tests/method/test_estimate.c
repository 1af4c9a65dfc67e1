/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The reciprocal estimate: the model and this processor's, each mantissa against the guarantee; the method that is
 * timed with the instruction keeps the claim that is measured with the model.
 */
#include <float.h>
#if defined(__SSE__)
#include <xmmintrin.h>
#endif

#include "method/bench.h"
#include "method/estimate.h"
#include "support.h"

/* |1 - x y|, exact but for one rounding: the product of two floats is a double. */
static double off_by(float x, float y) {
    return fabs(1 - (double)x * (double)y);
}

/* All mantissas of one binade; the exponent of every binade whose reciprocal is normal. */
static double worst_of(tally *t, const char *whose, float (*estimate)(float)) {
    double worst = 0;
    for (uint32_t k = 0; k < 1U << 23; k++) {
        const float x = 1 + (float)k * 0x1p-23f;
        worst = fmax(worst, off_by(x, estimate(x)));
    }
    for (int e = -126; e <= 125; e++) {
        const float x = ldexpf(1.2345678f, e), y = estimate(x);
        TALLY(t, y == ldexpf(estimate(1.2345678f), -e), "%s: 1/%g is %g", whose, (double)x, (double)y);
    }
    TALLY(t, worst <= ESTIMATE_WORST, "%s is off by %g, guaranteed %g", whose, worst, ESTIMATE_WORST);
    print_message("# %s: off by %.3g 2^-12 at worst\n", whose, worst * 0x1p12);
    return worst;
}

/* The model has the error that is promised, not less: what holds with it holds with every processor's. */
TEST(the_model_is_as_bad_as_allowed) {
    tally t = {.name = "model"};
    const double worst = worst_of(&t, "the model", estimate_reciprocal);
    TALLY(&t, worst >= 0.95 * ESTIMATE_WORST, "the model is off by %g only", worst);
    /* By hand: 2^24/4097 is 4095.0002, the first entry; the last, 2^24/8191, 2048.2. */
    TALLY(&t, estimate_reciprocal(1) == 4095 * 0x1p-12f, "the first entry");
    TALLY(&t, estimate_reciprocal(-nextafterf(2, 0)) == -0.5f, "the last entry, of a negative number");
    TALLY(&t, estimate_reciprocal(0) == (float)INFINITY && estimate_reciprocal(-0x1p-149f) == (float)-INFINITY,
          "0 and what counts as 0");
    TALLY(&t, estimate_reciprocal((float)INFINITY) == 0 && estimate_reciprocal(FLT_MAX) == 0, "what becomes 0");
    TALLY(&t, isnan(estimate_reciprocal((float)NAN)), "NaN");
    tally_end(&t);
}

#if defined(__SSE__)
static float own(float x) {
    return _mm_cvtss_f32(_mm_rcp_ss(_mm_set_ss(x)));
}
#endif

TEST(this_processor_keeps_the_guarantee) {
#if defined(__SSE__)
    tally t = {.name = "processor"};
    worst_of(&t, "this processor", own);
    tally_end(&t);
#else
    skip();
#endif
}

/* Bench times and judges two ways: two ways to one claim, the instruction nowhere beyond it. */
TEST(the_timed_method_keeps_the_claim) {
    tally t = {.name = "timed"};
    method_inputs in;
    method_outputs out;
    assert_true(method_arrays(4096, &in, &out));
    for (size_t i = 0; method_get(i) != NULL; i++) {
        method_row row = *method_get(i);
        const method_family_row *family = method_family_get(row.family);
        if (row.timed == NULL)
            continue;
        row.run = row.timed;
        for (size_t which = 0; which < family->case_count; which++)
            for (double ratio = METHOD_RATIO_LO; ratio <= METHOD_RATIO_HI; ratio *= 10) {
                dp_setup setup;
                measured m;
                assert_int_equal(method_setup(family, which, 0.1, 0.1 * ratio, false, &setup), DP_OK);
                family->fill(&setup, &in);
                assert_true(method_measure(family, &row, &setup, &in, &out, &m));
                const double error = measured_error(family, &m), claim = method_claimed(&row, which, &setup);
                if (!isnan(claim)) /* it speaks of the case */
                    TALLY(&t, error <= claim && error > claim / 8, "%s, %s, far/near %g: %g of %g", row.name,
                          family->cases[which].name, ratio, error, claim);
            }
    }
    method_arrays_free(&in, &out);
#if defined(__SSE__)
    tally_end(&t);
#endif
}
