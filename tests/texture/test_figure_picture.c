/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The colour scale of a picture of numbers, from its words in figure_picture.h: from the least to the greatest finite
 * field, of errors from the least above 0 and at most four decades down, logarithmic beyond a factor of 50; what is
 * missing or infinite has no part in it, wherever it lies.
 */
#include "support.h"

#include "texture/figure_picture.h"

enum { SIDE = 41 };

static float field_of(rng *r, double decades, bool signs) {
    const uint64_t kind = rng_below(r, 40);
    const double number = pow(10, rng_uniform(r, -decades, 0));
    const bool below = signs && rng_below(r, 2) == 0;
    const double special[] = {(double)NAN, (double)INFINITY, -(double)INFINITY};
    return (float)(kind < 3 ? special[kind] : below ? -number : number);
}

TEST(scales) {
    rng r = rng_make("scales of pictures");
    tally t = {.name = "scales"};
    for (uint64_t n = test_cases(200, 1000, 10000); n > 0; n--) {
        static float values[SIDE * SIDE];
        chart *c = chart_new();
        picture p = {.width = SIDE, .height = SIDE, .channels = 1, .label = "x", .unit = "m"};
        p.magnitudes = rng_below(&r, 2) == 0;
        assert_true(picture_open(&p, SIDE, c));
        const double decades = rng_uniform(&r, 0.1, 6);
        const bool signs = !p.magnitudes && rng_below(&r, 2) == 0;
        double lo = INFINITY, hi = -INFINITY;
        for (int i = 0; i < SIDE * SIDE; i++) {
            values[i] = field_of(&r, decades, signs);
            if (p.magnitudes)
                values[i] = rng_below(&r, 20) == 0 ? 0 : fabsf(values[i]);
            if (isfinite(values[i]) && !(p.magnitudes && values[i] == 0)) {
                lo = fmin(lo, (double)values[i]);
                hi = fmax(hi, (double)values[i]);
            }
        }
        picture_take(&p, 0, SIDE, values);
        picture_build(&p, c);
        if (p.magnitudes && lo < hi / 1e4)
            lo = hi / 1e4;
        const bool log = lo > 0 && hi > 50 * lo;
        if (p.magnitudes && !log)
            lo = 0;
        TALLY(&t,
              c->value.scale == (log ? CHART_LOG : CHART_LINEAR) && fabs(c->value.lo - lo) <= 1e-12 * fabs(lo) &&
                  c->value.hi == hi,
              "magnitudes %d, %g to %g: scale %d from %g to %g", p.magnitudes, lo, hi, (int)c->value.scale, c->value.lo,
              c->value.hi);
        chart_free(c);
    }
    tally_end(&t);
}

int main(void) {
    return run_listed(NULL, NULL);
}
