/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The guaranteed separation against the census: never violated, and not much too large. With DEPTHPREC_FULL every
 * depth of every camera and the slack of every band; otherwise one binade of each set-up, another for another seed.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "depthprec/depthprec.h"
#include "method/census.h"
#include "support.h"

static const struct {
    double znear, zfar;
    int ortho;
} cameras[] = {
    {0.1, 100.0, 0},   {0.1, 1000.0, 0},   {0.01, 1e4, 0}, {0.3, 1000.0, 0}, {1.0, 10.0, 0},
    {0.05, 4000.0, 0}, {1.0, 1e6, 0},      {10.0, 1e5, 0}, {1e-3, 10.0, 0},  {1e3, 1e7, 0},
    {0.25, 256.0, 0},  {0.1, HUGE_VAL, 0}, {1.0, 1.01, 0}, {0.1, 100.0, 1},  {1.0, 1e4, 1},
};
static const char *const formats[] = {"fp32", "unorm24", "unorm16", "fp16"};
enum { CAMERAS = sizeof cameras / sizeof cameras[0], FORMATS = 4, MAPPINGS = 4 };

static dp_setup setup_of(size_t camera, int format, int mapping, dp_arith arith) {
    dp_spec spec = dp_spec_default();
    dp_format found[2];
    dp_setup setup;
    dp_format_parse(formats[format], found);
    spec.znear = cameras[camera].znear;
    spec.zfar = cameras[camera].zfar;
    spec.ortho = cameras[camera].ortho;
    spec.mapping = (dp_mapping)mapping;
    spec.format = found[0];
    spec.model = DP_MODEL_FP32;
    spec.arith = arith;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    return setup;
}

static void describe(char out[160], const dp_setup *setup) {
    const dp_spec *s = &setup->spec;
    snprintf(out, 160, "near %g far %g%s %s %s %s", s->znear, s->zfar, s->ortho ? " ortho" : "", s->format.name,
             dp_mapping_get(s->mapping)->name, dp_arith_get(s->arith)->name);
}

typedef struct seen {
    tally held, tight;
    double worst_factor;
    uint64_t depths;
} seen;

/* Where a band is at least four separations wide, the guarantee is at most 4 times what was found, or one step. */
static void judge(seen *t, const dp_setup *setup, const census_result *r) {
    char text[160];
    describe(text, setup);
    for (int i = 0; i < r->band_count; i++) {
        const census_band *b = &r->bands[i];
        if (b->pairs == 0)
            continue;
        t->depths += b->pairs;
        TALLY(&t->held, b->slack < 1.0, "%s, band %g to %g: longest %.17g at %.17g, used %.17g", text, b->lo, b->hi,
              b->longest, b->longest_z, b->slack);
        const double step = ldexp(1.0, ilogb(b->lo) - 23);
        const double factor = b->bound / fmax(b->longest, step);
        if (test_effort() == EFFORT_FULL)
            printf("# %s, %g to %g: longest %.6g, bound %.6g, used %.4f\n", text, b->lo, b->hi, b->longest, b->bound,
                   b->slack);
        if (b->hi < 2.0 * b->lo || b->hi - b->lo < 4.0 * b->bound)
            continue;
        t->worst_factor = fmax(t->worst_factor, factor);
        TALLY(&t->tight, factor <= 4.0, "%s, band %g to %g: bound %.17g, longest %.17g", text, b->lo, b->hi, b->bound,
              b->longest);
    }
}

static void one(seen *t, rng *r, const dp_setup *setup) {
    static census_result result;
    census_request q = {.setup = setup, .lo = setup->spec.znear, .bound = dp_separation};
    q.hi = isinf(setup->spec.zfar) ? 1e6 * q.lo : setup->spec.zfar;
    if (test_effort() != EFFORT_FULL) { /* one whole binade where there is one, and what follows it */
        const int lowest = ilogb(q.lo) + 1;
        const int binades = ilogb(q.hi) - lowest;
        if (binades > 0) {
            q.lo = ldexp(1.0, lowest + (int)rng_below(r, (uint64_t)binades));
            q.hi = fmin(q.hi, 2.01 * q.lo);
        }
    }
    assert_int_equal(census_run(&q, &result), CENSUS_DONE);
    judge(t, setup, &result);
}

static void guarantee(void **state) {
    (void)state;
    seen t = {.held = {.name = "guarantee held"}, .tight = {.name = "guarantee is tight"}};
    rng r = rng_make("guarantee");
    const uint64_t share = test_cases(16, 1, 1); /* every 16th set-up only, under the sanitizers */
    uint64_t n = 0;
    for (size_t camera = 0; camera < CAMERAS; camera++)
        for (int format = 0; format < FORMATS; format++)
            for (int mapping = 0; mapping < MAPPINGS; mapping++, n++) {
                if (n % share != 0)
                    continue;
                const dp_arith arith = test_effort() == EFFORT_FULL ? 0 : rng_below(&r, dp_arith_count());
                const dp_setup setup = setup_of(camera, format, mapping, arith);
                one(&t, &r, &setup);
            }
    printf("# %llu depths; the bound is at most %.3f x the longest\n", (unsigned long long)t.depths, t.worst_factor);
    tally_end(&t.held);
    tally_end(&t.tight);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(guarantee)};
    return run_tap(tests);
}
