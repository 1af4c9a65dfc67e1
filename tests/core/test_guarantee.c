/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The guaranteed separation of the binary32 pipeline: never violated by any pair of binary32 depths, and tight; and
 * each of its parts alone, against arithmetic in which only that part is binary32.
 */
#include <float.h>
#include <gmp.h>

#include "core/engine.h"
#include "depthprec/depthprec.h"
#include "support.h"
#include "zfight/census.h"

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
 * and of each mapping and format one or two cameras, each camera with formats of two mappings.
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
                    if (test_effort() == EFFORT_CHECK && ((c + m + f) % FORMATS != 0 || (c / FORMATS + m) % 2 != 0))
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

/* The length left up to far decides what is certain, in fractions, where binary64 rounds the difference, too. */
TEST(certain_up_to_far) {
    tally t = {.name = "certain"};
    rng r = rng_make("certain");
    dp_spec spec = dp_spec_default();
    dp_setup setup;
    mpq_t left, apart;
    mpq_inits(left, apart, NULL);
    for (int i = 0; i < 20000; i++) {
        spec.znear = rng_log(&r, 1e-12, 1e3);
        spec.zfar = spec.znear * rng_log(&r, 1.1, 1e24);
        assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
        const double z = rng_log(&r, spec.znear, spec.zfar), at = spec.zfar - z;
        const double s = i % 4 == 0   ? nextafter(at, 0)
                         : i % 4 == 1 ? nextafter(at, HUGE_VAL)
                         : i % 4 == 2 ? at
                                      : z * rng_unit(&r);
        mpq_set_d(left, spec.zfar);
        mpq_set_d(apart, z);
        mpq_sub(left, left, apart);
        mpq_set_d(apart, s);
        TALLY(&t, dp_is_certain(&setup, z, s) == (mpq_cmp(apart, left) <= 0), "far %.17g, z %.17g, %.17g", spec.zfar, z,
              s);
    }
    mpq_clears(left, apart, NULL);
    assert_false(dp_is_certain(&setup, 1.0, HUGE_VAL));
    spec.zfar = HUGE_VAL;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    assert_true(dp_is_certain(&setup, 1.0, 1e300) && !dp_is_certain(&setup, 1.0, HUGE_VAL));
    tally_end(&t);
}

/* Every row, perspective and orthographic, in random stretches of some hundred thousand depths. */
TEST(every_arithmetic) {
    rng r = rng_make("every arithmetic");
    for (dp_arith a = 0; a < dp_arith_count(); a++) {
        tally violated = {.name = "guarantee"};
        tally loose = {.name = "tightness in stretches is not judged"};
        slack_report slack = {0};
        for (uint64_t i = test_cases(20, 50, 2000); i > 0; i--) {
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

/* A number just above a power of two, where its rounding weighs most, or any. */
static double awkward(rng *r, double x) {
    const double power = ldexp(1, ilogb(x));
    return rng_below(r, 2) ? power * (1 + rng_log(r, 0x1p-24, 0.5)) : x;
}

/* A window depth read back in binary32: 1/(zb d + wb), or the start and so much of the way; a depth range is undone by
 * the constants. */
static double read_back(const dp_setup *setup, double d) {
    const double n = setup->spec.znear, f = setup->spec.zfar, *range = setup->spec.depth_range;
    const double from = setup->reversed ? f : n, to = setup->reversed ? n : f;
    const double slope = (setup->spec.ortho ? to - from : 1 / to - 1 / from) / (range[1] - range[0]);
    const float product = (float)slope * (float)d;
    const float sum = product + (float)((setup->spec.ortho ? from : 1 / from) - slope * range[0]);
    return (double)(setup->spec.ortho ? sum : 1 / sum);
}

/* Cameras that read depths back, and how they are drawn: perspective; orthographic, whose span leads the error, or near
 * and far by themselves. */
enum { PERSPECTIVE = 0, SPAN, START, KINDS };
static const char *const kinds[] = {"perspective", "orthographic, from 0 on", "orthographic, far from 0"};

typedef struct reading {
    int kind;
    bool reversed;
    double n, width, share; /* of the way from near to far */
    double range[2];        /* of the viewport's depths */
    double used;            /* of the bound */
} reading;

static reading any_reading(rng *r, int kind, bool reversed, bool ranged) {
    const double width = awkward(r, rng_log(r, 1, 1e4)), sign = rng_below(r, 2) ? 1 : -1;
    const double tiny = ldexp(width, -24 - (int)rng_below(r, 4)) * rng_unit(r);
    reading out = {kind, reversed, 0, width, awkward(r, rng_unit(r)), {0, 1}, 0};
    if (ranged) {
        out.range[0] = (double)(float)(0.9 * rng_unit(r)); /* as viewports have them */
        out.range[1] = (double)(float)rng_uniform(r, out.range[0] + 0.1, 1);
    }
    out.n = kind == SPAN ? sign * tiny : sign * awkward(r, width * rng_log(r, 1, 100));
    if (kind == PERSPECTIVE) {
        const double *camera = cameras[rng_below(r, CAMERAS)];
        out.n = camera[0];
        out.width = camera[1] - camera[0];
        out.share = rng_log(r, 1e-3, isinf(camera[1]) ? 1e4 : 1);
    }
    return out;
}

/* One of its numbers a little otherwise. */
static reading beside(rng *r, const reading *of) {
    reading out = *of;
    double *const part[] = {&out.n, &out.width, &out.share};
    *part[rng_below(r, 3)] *= 1 + (rng_below(r, 2) ? 1 : -1) * rng_log(r, 0x1p-26, 0x1p-10);
    return out;
}

/* How much of the bound one reading takes; 0 where there is none. */
static double used_by(const reading *of) {
    dp_setup setup;
    dp_spec spec = dp_spec_default();
    spec.model = DP_MODEL_FLOAT;
    spec.ortho = of->kind != PERSPECTIVE;
    spec.mapping = of->reversed ? DP_MAPPING_REVERSED : DP_MAPPING_D3D;
    spec.znear = of->n;
    spec.zfar = of->n + of->width;
    spec.depth_range[0] = of->range[0];
    spec.depth_range[1] = of->range[1];
    if (dp_setup_init(&setup, &spec) != DP_OK)
        return 0;
    const double n = spec.znear, f = spec.zfar, way = isinf(f) ? n : f - n;
    const double z = (double)(float)(of->reversed && !isinf(f) ? f - way * of->share : n + way * of->share);
    const dp_budget_terms terms = {.linearize = 1};
    dp_budget budget;
    if (!(z > n && z < f) || dp_budget_at(&setup, z, &terms, &budget) != DP_OK || isinf(budget.separation))
        return 0;
    /* Its share of the window depth that both surfaces together need, but for what eye depths are rounded by; and what
     * the depth read back is off by, as window depth. */
    const double shared = budget.separation - budget.cause[DP_CAUSE_EYE];
    const double part = 0.5 * budget.window * budget.cause[DP_CAUSE_LINEARIZATION] / shared;
    const double back = read_back(&setup, dp_window(&setup, z));
    const double span = of->range[1] - of->range[0];
    return span * fabs(back - z) / part * (spec.ortho ? 1 / (f - n) : n / z / back / (1 - n / f));
}

/* Its part alone, constants rounded once, against the exact inverse: never exceeded, and climbed to. In perspective
 * terms of one sign are added to one of the other, so that not all can be just above a power of two at once; and of a
 * span three roundings must be at their worst together. */
TEST(linearization_alone) {
    enum { CLIMB = 10000 };
    static const double least[2][2 * KINDS] = {{0.6, 0.65, 0.78, 0.8, 0.9, 0.9}, {0.7, 0.75, 0.7, 0.65, 0.85, 0.85}};
    rng r = rng_make("linearization");
    tally within = {.name = "linearization"};
    for (int k = 0; k < 4 * KINDS; k++) {
        const int kind = k / 4, reversed = k / 2 % 2, ranged = k % 2;
        reading best = {0};
        double most = 0;
        for (uint64_t i = test_cases(12, 16, 400) * CLIMB; i > 0; i--) {
            const bool from_here = i % CLIMB < CLIMB / 2 && best.used > 0, first = i % CLIMB == 0;
            reading one = from_here ? beside(&r, &best) : any_reading(&r, kind, reversed != 0, ranged != 0);
            one.used = used_by(&one);
            TALLY(&within, one.used <= 1, "%s, %.17g and %.17g, %.17g, range %.17g to %.17g: %g", kinds[kind], one.n,
                  one.width, one.share, one.range[0], one.range[1], one.used);
            best = first || one.used > best.used ? one : best;
            most = fmax(most, one.used);
        }
        printf("# linearization, %s%s%s: %.3f of the bound reached\n", kinds[kind], reversed ? ", reversed" : "",
               ranged ? ", in a depth range" : "", most);
        TALLY(&within, most > least[ranged][2 * kind + reversed], "%s: %g reached", kinds[kind], most);
    }
    tally_end(&within);
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
