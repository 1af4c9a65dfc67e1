/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The guaranteed separation of the binary32 pipeline: never violated by any pair of binary32 depths, and tight; and
 * each of its parts alone, against arithmetic in which only that part is binary32.
 */
#include <float.h>

#include "census/census.h"
#include "depthprec/depthprec.h"
#include "support.h"

static const double cameras[][2] = {{0.1, 100}, {0.1, 1000},  {0.3, 1000}, {0.01, 10000}, {1, 10},  {0.1, HUGE_VAL},
                                    {5, 5000},  {0.05, 4000}, {10, 1e5},   {0.25, 256},   {1, 1e4}, {0.02, 50}};
static const char *const format_names[] = {"fp16", "unorm16", "unorm24", "fp32"};
enum { CAMERAS = sizeof cameras / sizeof cameras[0], FORMATS = 4, MAPPINGS = 4 };

static int make(dp_setup *setup, int camera, int mapping, int format, dp_arith arith, int ortho) {
    dp_format f[2];
    dp_format_parse(format_names[format], f);
    dp_spec spec = dp_spec_default();
    spec.znear = cameras[camera][0];
    spec.zfar = cameras[camera][1];
    spec.mapping = (dp_mapping)mapping;
    spec.format = f[0];
    spec.arith = arith;
    spec.ortho = ortho;
    spec.model = DP_MODEL_FLOAT;
    return dp_setup_init(setup, &spec) == DP_OK;
}

static double range_end(const dp_setup *setup) {
    return isinf(setup->spec.zfar) ? 1e4 * setup->spec.znear : setup->spec.zfar;
}

/*
 * The largest separation that a band is judged by: over its depths, but for those whose interval reaches into the next
 * binade, where the arithmetic is coarser; they are judged with that band.
 */
static double band_separation(const dp_setup *setup, double lo, double hi) {
    double most = 0.0;
    for (int i = 0; i <= 64; i++) {
        const double z = (double)(float)(lo + (hi - lo) * i / 64.0);
        const double s = z >= lo && z < hi ? dp_separation(setup, z) : 0.0;
        if (z + s < hi && s > most)
            most = s;
    }
    return most;
}

typedef struct slack_report {
    double most, sum;
    uint64_t bands;
    char worst[192];
} slack_report;

static void check_setup(const dp_setup *setup, double lo, double hi, tally *violated, tally *loose,
                        slack_report *slack) {
    census_result result;
    const census_request request = {.setup = setup, .lo = lo, .hi = hi, .bound = dp_separation};
    if (census_run(&request, &result) != CENSUS_DONE)
        return;
    const char *arith = dp_arith_get(setup->spec.arith)->name;
    for (int i = 0; i < result.band_count; i++) {
        const census_band *band = &result.bands[i];
        char text[192];
        snprintf(text, sizeof text, "%s %s %s%s near %g far %g, band %g..%g", arith, setup->spec.format.name,
                 dp_mapping_get(setup->spec.mapping)->name, setup->spec.ortho ? " ortho" : "", setup->spec.znear,
                 setup->spec.zfar, band->lo, band->hi);
        TALLY(violated, !(band->slack > 1.0), "%s: violated, %.6g of the bound", text, band->slack);
        const double s = band_separation(setup, band->lo, band->hi);
        if (s == 0.0 || band->hi - band->lo < 4.0 * s)
            continue;
        const double step = (double)nextafterf((float)band->lo, HUGE_VALF) - (double)(float)band->lo;
        const double ratio = s / fmax(band->longest, step);
        TALLY(loose, ratio <= 4.0 * (1.0 + 1e-9), "%s: %.6g is %.2f x %.6g", text, s, ratio, fmax(band->longest, step));
        slack->bands++;
        slack->sum += ratio;
        if (ratio > slack->most) {
            slack->most = ratio;
            snprintf(slack->worst, sizeof slack->worst, "%s", text);
        }
    }
}

static void report(const char *what, const slack_report *slack) {
    printf("# %s: %llu bands, bound / longest at most %.2f, mean %.2f; %s\n", what, (unsigned long long)slack->bands,
           slack->most, slack->sum / (double)slack->bands, slack->worst);
}

/*
 * Every pair of a census, for 12 cameras x 4 mappings x 4 formats, in every row of arithmetic; by default in `ieee`,
 * and of each mapping and format three cameras, each camera with a format of every mapping.
 */
TEST(never_violated_and_tight) {
    const dp_arith rows = test_cases(1, 1, dp_arith_count());
    const int count = (int)test_cases(1, CAMERAS, CAMERAS);
    for (dp_arith a = 0; a < rows; a++) {
        tally violated = {.name = "guarantee"};
        tally loose = {.name = "tightness"};
        slack_report slack = {0};
        for (int c = 0; c < count; c++)
            for (int m = 0; m < MAPPINGS; m++)
                for (int f = 0; f < FORMATS; f++) {
                    dp_setup setup;
                    if (test_effort() == EFFORT_CHECK && (c + m + f) % FORMATS != 0)
                        continue;
                    assert_true(make(&setup, c, m, f, a, 0));
                    const double reach = test_effort() == EFFORT_QUICK ? 4.0 * setup.spec.znear : HUGE_VAL;
                    check_setup(&setup, setup.spec.znear, fmin(reach, range_end(&setup)), &violated, &loose, &slack);
                }
        report(dp_arith_get(a)->name, &slack);
        tally_end(&violated);
        tally_end(&loose);
    }
}

/* Every row, perspective and orthographic, in random stretches of some hundred thousand depths. */
TEST(every_arithmetic) {
    rng r = rng_make("every arithmetic");
    for (dp_arith a = 0; a < dp_arith_count(); a++) {
        tally violated = {.name = "guarantee"};
        tally loose = {.name = "tightness in stretches is not judged"};
        slack_report slack = {0};
        for (uint64_t i = test_cases(20, 100, 4000); i > 0; i--) {
            dp_setup setup;
            if (!make(&setup, (int)rng_below(&r, CAMERAS), (int)rng_below(&r, MAPPINGS), (int)rng_below(&r, FORMATS), a,
                      rng_below(&r, 3) == 0))
                continue;
            const double end = range_end(&setup);
            const double lo = fmin(rng_log(&r, setup.spec.znear, end), 0.999 * end);
            const double stretch = fmin(lo * 0x1p-23 * 300000.0, end - lo);
            check_setup(&setup, fmax(lo, setup.spec.znear), fmax(lo, setup.spec.znear) + stretch, &violated, &loose,
                        &slack);
        }
        tally_end(&violated);
    }
}

/* Reading back: 1/(zb d + wb) in binary32, constants rounded once, against the exact inverse. */
TEST(linearization_alone) {
    rng r = rng_make("linearization");
    tally within = {.name = "linearization"};
    double most = 0.0;
    for (uint64_t i = test_cases(20000, 400000, 20000000); i > 0; i--) {
        dp_setup setup;
        if (!make(&setup, (int)rng_below(&r, CAMERAS), rng_below(&r, 2) ? 0 : 2, 3, 0, 0))
            continue;
        const double n = setup.spec.znear;
        const double f = setup.spec.zfar;
        const double z = (double)(float)rng_log(&r, n * 1.001, range_end(&setup) * 0.999);
        const double d = dp_window(&setup, z);
        const float zb = (float)(setup.reversed ? 1.0 / n - 1.0 / f : 1.0 / f - 1.0 / n);
        const float wb = (float)(setup.reversed ? 1.0 / f : 1.0 / n);
        const float product = zb * (float)d;
        const float sum = product + wb;
        const double back = (double)(1.0F / sum);
        const dp_budget_terms terms = {.linearize = 1};
        dp_budget budget;
        assert_int_equal(dp_budget_at(&setup, z, &terms, &budget), DP_OK);
        if (isinf(budget.separation))
            continue;
        /* The part as window depth, and what the depth read back is off by as window depth. */
        const double part = 0.5 * budget.window * budget.cause[DP_CAUSE_LINEARIZATION] / budget.separation;
        const double off = fabs(back - z) / back * (n / z) / (1.0 - n / f);
        TALLY(&within, off <= part, "z = %a: off %.6g, part %.6g", z, off, part);
        most = fmax(most, off / part);
    }
    printf("# linearization: off by at most %.3f of its part\n", most);
    tally_end(&within);
    assert_true(most > 0.3);
}

TEST(parts_add_up) {
    rng r = rng_make("sum of parts");
    for (int i = 0; i < 20000; i++) {
        dp_setup setup;
        if (!make(&setup, (int)rng_below(&r, CAMERAS), (int)rng_below(&r, MAPPINGS), (int)rng_below(&r, FORMATS),
                  rng_below(&r, dp_arith_count()), (int)rng_below(&r, 2)))
            continue;
        const dp_budget_terms terms = {
            .interpolation = rng_unit(&r) * 4.0, .world = rng_log(&r, 0.1, 10.0), .linearize = (int)rng_below(&r, 2)};
        dp_budget budget;
        const double z = rng_log(&r, setup.spec.znear, range_end(&setup));
        if (dp_budget_at(&setup, fmin(z, range_end(&setup)), &terms, &budget) != DP_OK || isinf(budget.separation))
            continue;
        double sum = 0.0;
        for (int k = 0; k < DP_CAUSE_COUNT; k++) {
            assert_true(budget.cause[k] >= 0.0);
            sum += budget.cause[k];
        }
        assert_relative(sum, budget.separation, 1e-12);
    }
}
