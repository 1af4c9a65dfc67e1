/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The largest separation over a range: never below that of any depth in it, and no more above than is promised. */
#include "core/engine.h"
#include "depthprec/depthprec.h"
#include "setups.h"
#include "support.h"
#include "zfight/census.h"

static const char *const format_names[] = {"fp32", "unorm24", "unorm16", "fp16", "float3.3b5", "unorm5"};

/* Near planes: all above 0, or none. */
typedef enum planes { POSITIVE, EITHER_SIGN } planes;

/* A random set-up with the given model; 0 when there is no such. */
static int random_setup(rng *r, planes which, dp_model model, dp_setup *setup) {
    dp_spec spec = dp_spec_default();
    dp_format found[2];
    dp_format_parse(format_names[rng_below(r, 6)], found);
    spec.format = found[0];
    spec.znear = rng_log(r, 1e-3, 1e2);
    spec.zfar = rng_below(r, 5) == 0 ? INFINITY : spec.znear * (1.0 + rng_log(r, 1e-2, 1e7));
    spec.mapping = (dp_mapping)rng_below(r, DP_MAPPING_COUNT);
    spec.ortho = rng_below(r, 6) == 0 || which == EITHER_SIGN;
    if (which == EITHER_SIGN)
        rng_planes(r, &spec.znear, &spec.zfar);
    spec.rounding = (dp_rounding)rng_below(r, 3);
    spec.model = model;
    spec.arith = rng_below(r, dp_arith_count());
    return dp_setup_init(setup, &spec) == DP_OK;
}

static const char *name_of(const dp_setup *s) {
    static char text[200];
    snprintf(text, sizeof text, "%s %s near %a far %a%s %s %s %s", s->spec.format.name,
             dp_mapping_get(s->spec.mapping)->name, s->spec.znear, s->spec.zfar, s->spec.ortho ? " ortho" : "",
             dp_rounding_name(s->spec.rounding), dp_model_name(s->spec.model), dp_arith_get(s->spec.arith)->name);
    return text;
}

/* A range inside the planes: often wide, sometimes a few steps, sometimes one depth. */
static void random_range(rng *r, const dp_setup *s, double *lo, double *hi) {
    const double far_end = isinf(s->spec.zfar) ? 1e7 * s->spec.znear : s->spec.zfar;
    if (s->spec.znear > 0.0) {
        *lo = fmin(rng_log(r, s->spec.znear, far_end), far_end);
        *lo = fmax(*lo, s->spec.znear);
        *hi = rng_below(r, 3) == 0 ? *lo * (1.0 + rng_log(r, 1e-9, 1e-2)) : rng_log(r, *lo, far_end);
    } else {
        const double z[2] = {rng_depth(r, s->spec.znear, far_end), rng_depth(r, s->spec.znear, far_end)};
        *lo = fmin(z[0], z[1]);
        if (*lo - s->spec.znear < 1e-12 * (far_end - s->spec.znear)) /* d as good as 1, but in another binade */
            *lo = s->spec.znear;
        *hi = rng_below(r, 3) == 0 ? *lo + (far_end - *lo) * rng_log(r, 1e-9, 1e-2) : fmax(z[0], z[1]);
    }
    if (rng_below(r, 8) == 0)
        *hi = far_end;
    if (rng_below(r, 8) == 0)
        *lo = s->spec.znear;
    if (rng_below(r, 16) == 0)
        *hi = *lo;
    *hi = fmin(fmax(*hi, *lo), far_end);
}

/* Depths of the range: spread evenly, and close round the places where the steps of formats change. */
static double probe(rng *r, const dp_setup *s, double lo, double hi) {
    double z =
        rng_below(r, 2) == 0 ? s->spec.znear > 0.0 ? rng_log(r, lo, hi) : rng_depth(r, lo, hi) : rng_uniform(r, lo, hi);
    if (rng_below(r, 3) == 0) {
        const double d = ldexp(1.0, -(int)rng_below(r, 30));
        const double w = rng_below(r, 2) == 0 ? d : rng_below(r, 2) == 0 ? 0.5 + 0.5 * d : 0.5 - 0.5 * d;
        z = dp_eye(s, w, 1.0 - w) * (1.0 + ldexp(rng_unit(r) - 0.5, -(int)rng_below(r, 53)));
    }
    if (rng_below(r, 4) == 0)
        z = ldexp(1.0, (int)rng_below(r, 30) - 10) * (1.0 + ldexp(rng_unit(r) - 0.5, -(int)rng_below(r, 53)));
    return z >= lo && z <= hi ? z : rng_uniform(r, lo, hi);
}

/* So near 0 that d cannot be told from 1/2, where planes are as far on either side: the step may be twice it. */
static int is_hazy(const dp_setup *s, double lo, double hi) {
    return s->spec.znear <= 0.0 && fmin(fabs(lo), fabs(hi)) < 1e-12 * (s->spec.zfar - s->spec.znear);
}

static void sweep(planes which, dp_model model, const char *name, double excess) {
    tally never_below = {.name = "never below the separation of a depth"};
    tally near = {.name = "not far above"};
    rng r = rng_make(name);
    const uint64_t cases = test_cases(60, 1500, 20000);
    for (uint64_t i = 0; i < cases; i++) {
        dp_setup s;
        dp_separation_worst w;
        double lo;
        double hi;
        if (!random_setup(&r, which, model, &s))
            continue;
        random_range(&r, &s, &lo, &hi);
        assert_int_equal(dp_separation_over(&s, lo, hi, 0.0, &w), DP_OK);
        assert_true(w.z >= lo && w.z <= hi);
        assert_true(dp_separation(&s, w.z) == w.separation);
        for (int k = 0; k < 400; k++) {
            const double z = fmin(fmax(probe(&r, &s, lo, hi), lo), hi);
            const double found = dp_separation(&s, z);
            TALLY(&never_below, found <= w.bound, "%s: over %a %a: bound %a, but %a at %a", name_of(&s), lo, hi,
                  w.bound, found, z);
        }
        TALLY(&near, w.bound <= w.separation * (is_hazy(&s, lo, hi) ? 2.01 : excess),
              "%s: over %a %a: bound %g, separation %g at %g", name_of(&s), lo, hi, w.bound, w.separation, w.z);
    }
    tally_end(&never_below);
    tally_end(&near);
}

TEST(exact) {
    sweep(POSITIVE, DP_MODEL_EXACT, "separation exact", 1.0 + 1e-9);
    sweep(EITHER_SIGN, DP_MODEL_EXACT, "separation exact, either sign", 1.0 + 1e-9);
}

TEST(staged) {
    sweep(POSITIVE, DP_MODEL_STAGED, "separation staged", 1.0 + 0x1p-9);
    sweep(EITHER_SIGN, DP_MODEL_STAGED, "separation staged, either sign", 1.0 + 0x1p-9);
}

TEST(binary32) {
    sweep(POSITIVE, DP_MODEL_FLOAT, "separation fp32", 1.0 + 0x1p-9);
    sweep(EITHER_SIGN, DP_MODEL_FLOAT, "separation fp32, either sign", 1.0 + 0x1p-9);
}

/* A limit just above or below the worst is decided, whichever side it is on. */
static void limits(planes which, const char *name) {
    tally decided = {.name = name};
    uint64_t undecided = 0;
    rng r = rng_make(name);
    for (uint64_t i = 0; i < test_cases(50, 600, 6000); i++) {
        dp_setup s;
        dp_separation_worst w;
        double lo;
        double hi;
        if (!random_setup(&r, which, (dp_model)rng_below(&r, DP_MODEL_COUNT), &s))
            continue;
        random_range(&r, &s, &lo, &hi);
        assert_int_equal(dp_separation_over(&s, lo, hi, 0.0, &w), DP_OK);
        if (isinf(w.separation))
            continue;
        const double limit = w.separation * (1.0 + ldexp(rng_unit(&r) - 0.25, -(int)rng_below(&r, 40)));
        const double bound = w.bound;
        assert_int_equal(dp_separation_over(&s, lo, hi, limit, &w), DP_OK);
        assert_true(w.bound <= bound);
        const int is_decided = w.bound <= limit * (1.0 + 1e-12) || w.separation > limit;
        undecided += !is_decided;
        TALLY(&decided, is_decided || (which == EITHER_SIGN && w.bound <= (is_hazy(&s, lo, hi) ? 2.01 : 1.5) * limit),
              "%s: over %a %a: limit %.17g: %g to %g", name_of(&s), lo, hi, limit, w.separation, w.bound);
    }
    tally_end(&decided);
    /* About 0 there are depths in so many binades that the search may be given up. */
    assert_true(50 * undecided <= decided.cases);
}

TEST(limits_are_decided) {
    limits(POSITIVE, "separation limits");
    limits(EITHER_SIGN, "separation limits, either sign");
}

/* Every binary32 depth of some ranges through the pipeline: no pair so far apart is stored in the wrong order. */
TEST(census_keeps_the_bound) {
    tally kept = {.name = "no interval in the census is longer than the bound"};
    rng r = rng_make("separation census");
    for (uint64_t i = 0; i < test_cases(2, 60, 600); i++) {
        dp_setup s;
        dp_separation_worst w;
        if (!random_setup(&r, POSITIVE, DP_MODEL_FLOAT, &s))
            continue;
        const double lo = rng_log(&r, s.spec.znear, fmin(s.spec.zfar, s.spec.znear * 1e4));
        const double hi = fmin(s.spec.zfar, lo * (1.0 + rng_log(&r, 1e-4, 2e-2)));
        if (census_count(lo, hi) < 16)
            continue;
        census_request request = {.setup = &s, .lo = lo, .hi = hi, .threads = 1};
        census_result result;
        assert_int_equal(census_run(&request, &result), CENSUS_DONE);
        assert_int_equal(dp_separation_over(&s, lo, hi, 0.0, &w), DP_OK);
        TALLY(&kept, result.all.longest <= w.bound, "%s: over %a %a: longest %g, bound %g", name_of(&s), lo, hi,
              result.all.longest, w.bound);
    }
    tally_end(&kept);
}

/* Where d passes 1/2 two binary32 depths are the worst, half as bad again as all about them: the search finds them, and
 * no pair of a census is longer. */
TEST(the_worst_inside) {
    dp_spec spec = dp_spec_default();
    dp_setup s;
    dp_separation_worst w;
    census_result result;
    dp_format found[2];
    dp_format_parse("unorm24", found);
    spec.format = found[0];
    spec.znear = 7.2787258901482721;
    spec.zfar = 137.34604482931945;
    spec.mapping = DP_MAPPING_D3D;
    spec.ortho = 1;
    spec.rounding = DP_ROUND_EVEN;
    spec.model = DP_MODEL_FLOAT;
    assert_int_equal(dp_arith_parse("fused", &spec.arith), DP_OK);
    assert_int_equal(dp_setup_init(&s, &spec), DP_OK);
    const double lo = 72.2, hi = 72.4;
    double most = 0.0, second = 0.0;
    int count = 0;
    for (float z = 72.2F; (double)z <= hi; z = nextafterf(z, HUGE_VALF)) {
        const double here = dp_separation(&s, (double)z);
        if (here > most)
            second = most, most = here, count = 0;
        count += here == most;
        second = here < most ? fmax(second, here) : second;
    }
    const census_request request = {.setup = &s, .lo = lo, .hi = hi, .threads = 1};
    assert_int_equal(census_run(&request, &result), CENSUS_DONE);
    assert_int_equal(dp_separation_over(&s, lo, hi, 0.0, &w), DP_OK);
    assert_true(count == 2 && most >= 1.5 * second);
    assert_true(w.separation == most && w.bound == most && fabs(w.z - 0.5 * (spec.znear + spec.zfar)) < 0x1p-16);
    assert_true(result.all.longest > 0.0 && result.all.longest + 0x1p-17 <= w.bound);
}

/* So near 0 that d is 1 in double and below it in truth: steps of the binade below 1 alone, whatever the depth. */
TEST(a_binade_end_at_zero) {
    dp_spec spec = dp_spec_default();
    dp_format found[2];
    dp_setup s;
    dp_separation_worst w;
    dp_format_parse("float4.6", found);
    spec.format = found[0];
    spec.znear = 0.0;
    spec.zfar = 1.0;
    spec.ortho = 1;
    spec.model = DP_MODEL_FLOAT;
    spec.mapping = DP_MAPPING_REVERSED;
    assert_int_equal(dp_setup_init(&s, &spec), DP_OK);
    assert_int_equal(dp_separation_over(&s, 0x1p-140, 0x1p-100, 0.0, &w), DP_OK);
    assert_true(w.bound >= 0x1p-7 && w.bound <= 0x1p-7 * (1.0 + 0x1p-9));
    spec.mapping = DP_MAPPING_D3D; /* likewise one step before 1, where the next one is twice as long */
    spec.znear = -127.0;
    spec.zfar = 1.0;
    assert_int_equal(dp_setup_init(&s, &spec), DP_OK);
    assert_int_equal(dp_separation_over(&s, -0.5, -0x1p-100, 0.0, &w), DP_OK);
    assert_true(w.bound >= 1.0 && w.bound <= 1.0 + 0x1p-9);
}

/* Over part of what an orthographic camera sees, all of which is given. */
static dp_separation_worst worst_over(const char *format, dp_mapping mapping, dp_model model, const double camera[2],
                                      double lo, double hi) {
    dp_spec spec = dp_spec_default();
    dp_format found[2];
    dp_setup s;
    dp_separation_worst w;
    dp_format_parse(format, found);
    spec.format = found[0];
    spec.znear = camera[0];
    spec.zfar = camera[1];
    spec.mapping = mapping;
    spec.ortho = 1;
    spec.model = model;
    assert_int_equal(dp_setup_init(&s, &spec), DP_OK);
    assert_int_equal(dp_separation_over(&s, lo, hi, 0.0, &w), DP_OK);
    return w;
}

static void assert_worst(dp_separation_worst w, double at_least, double excess) {
    assert_true(w.separation >= at_least && w.bound <= at_least * (1.0 + excess));
}

/*
 * From -1 to 0 the worst is next to -1/2, where steps grow to 2^-24: with signed NDC two stages have one, and depths
 * are rounded by 2^-25 twice; the bound next to -1/4 stays above every depth, down to single ones. Without there is one
 * step, and the surface ahead is nearer to 0 and rounded by 2^-26. Next to 0 a depth is the worst that is as good as 0.
 */
TEST(about_zero) {
    static const double behind[2] = {-1.0, 0.0}, ahead[2] = {0.0, 1.0};
    assert_worst(worst_over("fp32", DP_MAPPING_GL, DP_MODEL_STAGED, behind, -1.0, -0x1.f377bbcb335cp-3), 12.0 * 0x1p-26,
                 1e-6);
    assert_worst(worst_over("fp32", DP_MAPPING_D3D, DP_MODEL_STAGED, behind, -0.8, -0.2), 7.0 * 0x1p-26, 1e-6);
    const dp_separation_worst w = worst_over("unorm5", DP_MAPPING_D3D, DP_MODEL_FLOAT, ahead, 0.0, 1e-9);
    assert_worst(w, 1.0 / 31.0, 1e-5);
    assert_worst(w, w.separation, 1e-11);
    static const double far[2] = {-0x1.27c01144a4a4bp+8, 0x1.0ecf33618a039p+11}; /* one depth, 56 units before far */
    const dp_separation_worst one =
        worst_over("fp32", DP_MAPPING_REVERSED, DP_MODEL_EXACT, far, 0x1.0ecf33618a001p+11, 0x1.0ecf33618a001p+11);
    assert_worst(one, one.separation, 1e-11);
    static const double small[2] = {0.0, 0x1p-12}; /* flushed to 0, depths are off by 2^-126 each, and so is d */
    const double flushed[2] = {
        worst_over("fp32", DP_MAPPING_D3D, DP_MODEL_STAGED, small, 0.0, 0x1p-120).bound,
        worst_over("fp32", DP_MAPPING_D3D, DP_MODEL_FLOAT, small, 0.0, 0x1p-120).bound,
    };
    assert_true(flushed[0] >= 0x1p-125 + 0x1p-150 && flushed[1] >= 0x1p-125 + 2.0 * 0x1p-126 * 0x1p-12);
}

/* Runs as tables have them, pieces of binades; over a whole binade or more nothing is promised but that it holds. */
static void runs(planes which, dp_model model, const char *name) {
    enum { DEPTHS = 20 };
    tally never_below = {.name = "runs: never below the separation of a depth"};
    tally near = {.name = "runs: half of them not above twice the piece's width"};
    rng r = rng_make(name);
    uint64_t close = 0, finite = 0;
    for (uint64_t i = 0; i < test_cases(400, 8000, 80000); i++) {
        dp_setup s;
        if (!random_setup(&r, which, model, &s))
            continue;
        const double lo = probe(&r, &s, s.spec.znear, fmin(s.spec.zfar, 1e18));
        const double width = ldexp(fabs(lo), -(int)rng_below(&r, 30));
        const double hi = fmin(lo + width, fmin(s.spec.zfar, 1e18));
        double bound, worst = 0.0;
        assert_int_equal(dp_separation_runs(&s, &lo, &hi, &bound, 1), DP_OK);
        for (int k = 0; k < DEPTHS; k++) {
            const double z = k == 0 ? lo : k == 1 ? hi : fmin(fmax(probe(&r, &s, lo, hi), lo), hi);
            const double found = dp_separation(&s, z);
            worst = fmax(worst, found);
            TALLY(&never_below, found <= bound, "%s: over %a %a: bound %a, but %a at %a", name_of(&s), lo, hi, bound,
                  found, z);
        }
        finite += !isinf(worst) && width <= 0x1p-8 * fabs(lo);
        close += !isinf(worst) && width <= 0x1p-8 * fabs(lo) && bound <= worst * (1.0 + 4.0 * width / fabs(lo) + 1e-9);
    }
    TALLY(&near, 2 * close > finite && finite > 50, "%s: %g of %g", name, (double)close, (double)finite);
    tally_end(&never_below);
    tally_end(&near);
}

TEST(short_runs) {
    runs(POSITIVE, DP_MODEL_EXACT, "runs exact");
    runs(POSITIVE, DP_MODEL_STAGED, "runs staged");
    runs(POSITIVE, DP_MODEL_FLOAT, "runs fp32");
    runs(EITHER_SIGN, DP_MODEL_EXACT, "runs exact, either sign");
    runs(EITHER_SIGN, DP_MODEL_FLOAT, "runs fp32, either sign");
}

TEST(known_answers) {
    dp_spec spec = dp_spec_default();
    dp_format found[2];
    dp_setup s;
    dp_separation_worst w;
    dp_format_parse("unorm24", found);
    spec.format = found[0];
    spec.znear = 0.01;
    spec.zfar = 1e4;
    assert_int_equal(dp_setup_init(&s, &spec), DP_OK);
    assert_int_equal(dp_separation_over(&s, 1.0, 5000.0, 0.0, &w), DP_OK);
    assert_true(w.z == 5000.0);
    assert_relative(w.separation, 153.588769, 1e-8);
    assert_int_equal(dp_separation_over(&s, 0.001, 5000.0, 0.0, &w), DP_ERROR_RANGE);
    assert_int_equal(dp_separation_over(&s, 1.0, INFINITY, 0.0, &w), DP_ERROR_RANGE);
    assert_int_equal(dp_separation_over(&s, 5.0, 1.0, 0.0, &w), DP_ERROR_RANGE);
    assert_int_equal(dp_separation_over(&s, NAN, 1.0, 0.0, &w), DP_ERROR_RANGE);
    assert_int_equal(dp_separation_over(NULL, 1.0, 2.0, 0.0, &w), DP_ERROR_NULL);
    const double lo[] = {1.0, 0.001, 5.0, 5000.0}, hi[] = {1.0, 1.0, 1.0, INFINITY};
    double bound[4] = {7.0, 7.0, 7.0, 7.0};
    assert_int_equal(dp_separation_runs(&s, lo, hi, bound, 0), DP_OK);
    for (int i = 1; i < 4; i++)
        assert_int_equal(dp_separation_runs(&s, lo + i, hi + i, bound + i, 1), DP_ERROR_RANGE);
    assert_int_equal(dp_separation_runs(&s, lo, hi, bound, 2), DP_ERROR_RANGE); /* before the first is written */
    assert_int_equal(dp_separation_runs(NULL, lo, hi, bound, 1), DP_ERROR_NULL);
    assert_int_equal(dp_separation_runs(&s, lo, NULL, bound, 1), DP_ERROR_NULL);
    for (int i = 0; i < 4; i++)
        assert_true(bound[i] == 7.0);
    spec.zfar = INFINITY;
    assert_int_equal(dp_setup_init(&s, &spec), DP_OK);
    assert_int_equal(dp_separation_over(&s, 1.0, INFINITY, 0.0, &w), DP_OK);
    assert_true(isinf(w.bound) && isinf(w.separation));
}

/* What decides whether the lattice has to be asked exactly: never below it, and not so far above that it always is. */
TEST(what_the_lattice_is_not_above) {
    tally above = {.name = "the quick estimate is never below the separation of the lattice"};
    tally near = {.name = "nor above it by more than two steps where one is little of the depth"};
    tally between = {.name = "nor is its rate above that of both ends of a range"};
    rng r = rng_make("lattice above");
    const uint64_t cases = test_cases(1000, 20000, 500000);
    for (uint64_t i = 0; i < cases; i++) {
        dp_setup s;
        double lo, hi;
        if (!random_setup(&r, POSITIVE, DP_MODEL_EXACT, &s))
            continue;
        random_range(&r, &s, &lo, &hi);
        for (int k = 0; k < 20; k++) {
            const double z = fmin(fmax(probe(&r, &s, lo, hi), lo), hi);
            const double rate = dp_lattice_rate(&s, z), exactly = dp_separation(&s, z);
            TALLY(&above, !dp_lattice_is_within(rate, z, nextafter(exactly, 0)), "%s: at %a: %a, rate %a", name_of(&s),
                  z, exactly, rate);
            if (s.curve == DP_CURVE_PERSPECTIVE && exactly < 1e-3 * z)
                TALLY(&near, dp_lattice_is_within(rate, z, 2.01 * exactly), "%s: at %a: %a, rate %a", name_of(&s), z,
                      exactly, rate);
            if (lo <= z && z <= hi)
                TALLY(&between, rate <= fmax(dp_lattice_rate(&s, lo), dp_lattice_rate(&s, hi)), "%s: at %a: rate %a",
                      name_of(&s), z, rate);
        }
    }
    tally_end(&above);
    tally_end(&near);
    tally_end(&between);
}

/* Whether a limit holds is found sooner than the worst depth, and is the same answer: what it promises holds at depths
 * one by one. */
TEST(soon_is_the_same) {
    static const char *const formats[] = {"fp32", "unorm24", "unorm16"};
    tally same = {.name = "soon: what the search for the worst says, where that is asked with the limit"};
    tally holds = {.name = "soon: what is within holds at each depth tried"};
    rng r = rng_make("separation soon");
    int yes = 0, no = 0;
    for (uint64_t i = 0; i < test_cases(100, 1500, 20000); i++) {
        const double near = rng_log(&r, 0.01, 10), far = near * rng_log(&r, 2, 1e6);
        const double lo = fmin(fmax(rng_log(&r, near, far), near), far);
        const double hi = fmin(fmax(rng_log(&r, lo, far), lo), far);
        dp_separation_worst worst;
        dp_setup s = SETUP(formats[rng_below(&r, 3)], .znear = near, .zfar = far, .model = DP_MODEL_FLOAT,
                           .mapping = (dp_mapping)rng_below(&r, 4));
        if (rng_below(&r, 3) == 0) {
            s.spec.triangles = dp_triangles_default();
            dp_spec spec = s.spec;
            assert_int_equal(dp_setup_init(&s, &spec), DP_OK);
        }
        const double limit = dp_separation(&s, hi) * rng_log(&r, 0.9, 1.5);
        if (!isfinite(limit) || lo == hi || dp_separation_over(&s, lo, hi, limit, &worst) != DP_OK)
            continue;
        const bool within = dp_separation_soon(&s, lo, hi, limit);
        TALLY(&same, within == (worst.bound <= limit), "%s: from %a to %a within %a", name_of(&s), lo, hi, limit);
        for (int k = 0; k < 20 && within; k++) {
            const double z = fmin(fmax(rng_log(&r, lo, hi), lo), hi);
            TALLY(&holds, dp_separation(&s, z) <= limit, "%s: at %a within %a", name_of(&s), z, limit);
        }
        yes += within;
        no += !within;
    }
    assert_true(yes > 10 && no > 10);
    tally_end(&same);
    tally_end(&holds);
}
