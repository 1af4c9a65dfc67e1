/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The near or far plane in every model: the answer passes as `check` judges it, and so does all that is said to pass
 * with it; beyond it, where that is certain, nothing does; and where the answer has a closed form it is that.
 */
#include "solve/plane.h"
#include "support.h"

static const char *describe(const solve_problem *p, char text[320]) {
    snprintf(text, 320, "%s of %s %s%s near %.17g far %.17g %s %s, %s %.17g over %.17g..%.17g",
             p->unknown == SOLVE_NEAR ? "near" : "far", p->spec.format.name, dp_mapping_get(p->spec.mapping)->name,
             p->spec.ortho ? " ortho" : "", p->spec.znear, p->spec.zfar, dp_model_name(p->spec.model),
             dp_arith_get(p->spec.arith)->name, quantity_get(p->kind)->name, p->limit, p->lo, p->hi);
    return text;
}

/* In the model float a logarithmic depth has the guarantee of its shader, and the codes of the model staged. */
static dp_status set_up(const dp_spec *of, dp_setup *out) {
    dp_spec spec = *of;
    const int shader = spec.model == DP_MODEL_FLOAT && dp_mapping_get(spec.mapping)->curve == DP_CURVE_LOG;
    if (shader)
        spec.model = DP_MODEL_STAGED;
    const dp_status status = dp_setup_init(out, &spec);
    if (shader && status == DP_OK)
        *out = dp_setup_guaranteed(out);
    return status;
}

/* As check.h says it of one depth and of a range, written once more. */
static int meets(const solve_problem *p, double value) {
    dp_spec spec = p->spec;
    dp_setup setup;
    dp_separation_worst worst;
    dp_worst error;
    *(p->unknown == SOLVE_NEAR ? &spec.znear : &spec.zfar) = value;
    if (set_up(&spec, &setup) != DP_OK)
        return 0;
    if (p->kind == QUANTITY_SEPARATION)
        return p->lo == p->hi
                   ? dp_separation(&setup, p->lo) <= p->limit
                   : dp_separation_over(&setup, p->lo, p->hi, p->limit, &worst) == DP_OK && worst.bound <= p->limit;
    return p->lo == p->hi ? fabs(dp_error(&setup, dp_code(&setup, p->lo), p->lo)) <= p->limit
                          : dp_worst_over(&setup, p->lo, p->hi, &error) == DP_OK && error.error <= p->limit;
}

/* A problem made from a camera that can be: its own value, times something near 1, is what is wanted. */
static int draw(rng *r, dp_model model, quantity_kind kind, solve_problem *p) {
    static const char *const formats[] = {"fp16", "fp32", "unorm16", "unorm24", "unorm24", "unorm8", "float4.6"};
    dp_format found[2];
    dp_setup setup;
    *p = (solve_problem){.spec = dp_spec_default(), .kind = kind, .unknown = (solve_unknown)rng_below(r, 2)};
    dp_format_parse(formats[rng_below(r, sizeof formats / sizeof formats[0])], found);
    p->spec.format = found[0];
    p->spec.model = model;
    do
        p->spec.mapping = (dp_mapping)rng_below(r, DP_MAPPING_COUNT);
    while (model == DP_MODEL_FLOAT && dp_mapping_get(p->spec.mapping)->curve == DP_CURVE_LINEAR);
    p->spec.ortho = dp_mapping_get(p->spec.mapping)->ortho && rng_below(r, 5) == 0;
    p->spec.rounding = (dp_rounding)rng_below(r, DP_ROUNDING_COUNT);
    p->spec.arith = (dp_arith)rng_below(r, dp_arith_count());
    p->spec.znear = rng_log(r, 1e-2, 1e2);
    p->spec.zfar = p->spec.znear * rng_log(r, 1.5, 1e5);
    if (dp_mapping_get(p->spec.mapping)->far_infinite && !p->spec.ortho && rng_below(r, 4) == 0)
        p->spec.zfar = INFINITY;
    const double far_end = fmin(p->spec.zfar, 1e5 * p->spec.znear);
    p->hi = fmin(rng_log(r, p->spec.znear, far_end), far_end);
    p->lo = rng_below(r, 4) == 0 ? fmin(fmax(rng_log(r, p->spec.znear, p->hi), p->spec.znear), p->hi) : p->hi;
    if (set_up(&p->spec, &setup) != DP_OK)
        return 0;
    const quantity_worst j = quantity_over(kind, &setup, p->lo, p->hi, NAN);
    p->limit = j.value * rng_log(r, 0.5, 2.0);
    return p->limit > 0.0 && p->limit < INFINITY;
}

typedef struct sides {
    tally answer, proof, beyond, nothing;
    uint64_t certain, possible;
} sides;

/* From the answer to the other end: planes of few bits, too, which are rounded to even. */
static void judge_between(const solve_problem *p, const plane_answer *a, rng *r, sides *s) {
    char text[320];
    const double lo = fmin(a->value, a->until), hi = fmin(fmax(a->value, a->until), 1e18);
    for (int i = 0; i < (p->lo < p->hi ? 20 : 100); i++) {
        const double x = fmin(fmax(rng_log(r, lo, hi), lo), hi), grid = ldexp(1.0, ilogb(x) - (int)rng_below(r, 24));
        const double coarse = rint(x / grid) * grid, value = i % 2 == 0 || coarse < lo || coarse > hi ? x : coarse;
        TALLY(&s->proof, meets(p, value), "%s: %.17g fails between %.17g and %.17g", describe(p, text), value, a->value,
              a->until);
    }
}

/* How far beyond an answer a failure must show: more where the measure hardly depends on the plane. */
static double share_beyond(const solve_problem *p, double x) {
    const double n = p->unknown == SOLVE_NEAR ? x : p->spec.znear;
    const double f = p->unknown == SOLVE_NEAR ? p->spec.zfar : x;
    const int perspective = dp_mapping_get(p->spec.mapping)->curve == DP_CURVE_PERSPECTIVE && !p->spec.ortho;
    const int weak = p->spec.ortho ? p->unknown == SOLVE_NEAR : perspective && p->unknown == SOLVE_FAR;
    return weak ? fmax(1e-9, 0x1p-44 * (f - n) / n) : 1e-9;
}

/* In the lattice an answer is tight: next beyond it there is nothing, and it says so. */
static void judge_beyond(const solve_problem *p, const plane_answer *a, sides *s) {
    char text[320];
    const double share = 2.0 * share_beyond(p, a->value),
                 x = a->value * (p->unknown == SOLVE_NEAR ? 1 - share : 1 + share);
    if (isinf(a->value) || x < a->least || x > a->most || p->spec.model != DP_MODEL_EXACT || p->kind == QUANTITY_ERROR)
        return;
    TALLY(&s->beyond, !meets(p, x) && (a->certain || share > 2e-9), "%s: %.17g beyond %.17g passes", describe(p, text),
          x, a->value);
}

static void judge_answer(const solve_problem *p, const plane_answer *a, rng *r, sides *s) {
    char text[320];
    s->possible += a->possible;
    s->certain += a->possible && a->certain;
    if (a->possible) {
        TALLY(&s->answer, meets(p, a->value) && meets(p, a->until) && a->reached.passed && a->reached.value <= p->limit,
              "%s: %.17g or %.17g fails", describe(p, text), a->value, a->until);
        judge_between(p, a, r, s);
        judge_beyond(p, a, s);
        return;
    }
    for (int i = 0; i < 24; i++) {
        const double most = p->unknown == SOLVE_FAR ? 1e4 * a->least : a->most;
        const double x = fmin(fmax(rng_log(r, a->least, most), a->least), most);
        if (a->certain)
            TALLY(&s->nothing, !meets(p, x), "%s: nothing is said to pass, but %.17g does", describe(p, text), x);
        else if (p->spec.model == DP_MODEL_EXACT && p->kind == QUANTITY_SEPARATION)
            TALLY(&s->nothing, !meets(p, x), "%s: nothing was found, but %.17g passes", describe(p, text), x);
    }
}

static void in_model(dp_model model, quantity_kind kind, uint64_t cases) {
    rng r = rng_make(kind == QUANTITY_ERROR ? "plane error" : dp_model_name(model));
    sides s = {.answer = {.name = "the answer passes as check judges"},
               .proof = {.name = "all that is said to pass passes"},
               .beyond = {.name = "next beyond an answer of the lattice nothing passes"},
               .nothing = {.name = "where nothing is said to pass no sampled value does"}};
    for (uint64_t i = 0; i < cases;) {
        solve_problem p;
        plane_answer a;
        char text[320];
        if (!draw(&r, model, kind, &p))
            continue;
        i++;
        if (plane_solve(&p, &a) != DP_OK)
            tally_fail(&s.answer, "%s: refused", describe(&p, text));
        else
            judge_answer(&p, &a, &r, &s);
    }
    printf("# %s: %llu problems, %llu with an answer, %llu of these certain\n", dp_model_name(model),
           (unsigned long long)cases, (unsigned long long)s.possible, (unsigned long long)s.certain);
    assert_true(s.possible * 2 > cases);
    tally_end(&s.answer);
    tally_end(&s.proof);
    if (s.beyond.cases > 0)
        tally_end(&s.beyond);
    if (s.nothing.cases > 0)
        tally_end(&s.nothing);
}

TEST(test_fp32) {
    in_model(DP_MODEL_FLOAT, QUANTITY_SEPARATION, test_cases(60, 250, 20000));
}

TEST(test_staged) {
    in_model(DP_MODEL_STAGED, QUANTITY_SEPARATION, test_cases(100, 250, 10000));
}

TEST(test_exact) {
    in_model(DP_MODEL_EXACT, QUANTITY_SEPARATION, test_cases(100, 250, 10000));
}

TEST(test_error) {
    in_model(DP_MODEL_EXACT, QUANTITY_ERROR, test_cases(50, 120, 10000));
    in_model(DP_MODEL_STAGED, QUANTITY_ERROR, test_cases(30, 60, 3000));
}

/* |stored - z| of UNORM under an infinite or finite perspective, in long double, without the library. */
static long double plain_error(int bits, int reversed, double n, double f, double z) {
    const long double levels = ldexpl(1.0L, bits) - 1.0L;
    const long double kappa = 1.0L / n - (isinf(f) ? 0.0L : 1.0L / f);
    const long double t = (1.0L / n - 1.0L / z) / kappa; /* share of the far end */
    const long double code = floorl((reversed ? 1.0L - t : t) * levels + 0.5L);
    const long double share = reversed ? 1.0L - code / levels : code / levels;
    const long double inverse = 1.0L / n - share * kappa;
    return inverse <= 0.0L ? HUGE_VALL : fabsl(1.0L / inverse - z);
}

/*
 * The least near against a sweep of its own: every near from the answer on keeps the error, and the next one below
 * does not, with 1e-9 for the long double's own rounding next to a boundary.
 */
TEST(test_error_by_hand) {
    rng r = rng_make("plane error by hand");
    tally least = {.name = "least near of an error: just below it fails"};
    tally all = {.name = "least near of an error: all from it on pass"};
    const uint64_t cases = test_cases(20, 100, 2000);
    for (uint64_t i = 0; i < cases; i++) {
        static const char *const names[] = {"unorm8", "unorm12", "unorm16"};
        static const int widths[] = {8, 12, 16};
        const int k = (int)rng_below(&r, 3);
        dp_format found[2];
        plane_answer a;
        solve_problem p = {.spec = dp_spec_default(), .kind = QUANTITY_ERROR, .unknown = SOLVE_NEAR};
        dp_format_parse(names[k], found);
        p.spec.format = found[0];
        p.spec.mapping = rng_below(&r, 2) == 0 ? DP_MAPPING_D3D : DP_MAPPING_REVERSED;
        p.lo = p.hi = rng_log(&r, 1.0, 1e4);
        p.spec.zfar = rng_below(&r, 2) == 0 ? INFINITY : p.hi * rng_log(&r, 1.1, 100.0);
        p.limit = p.hi * rng_log(&r, 1e-2, 10.0);
        assert_int_equal(plane_solve(&p, &a), DP_OK);
        const int reversed = p.spec.mapping == DP_MAPPING_REVERSED;
        char text[320];
        describe(&p, text);
        TALLY(&least,
              a.possible && (a.value == a.least || plain_error(widths[k], reversed, a.value * (1.0 - 1e-9), p.spec.zfar,
                                                               p.hi) > (long double)p.limit),
              "%s: below %.17g passes", text, a.value);
        for (int s = 0; s < 400; s++) {
            const double share = s < 200 ? 1e-9 + s * 1e-3 : 0.2 + (s - 200) * 0.05;
            const double x = fmin(a.value * (1.0 + share), p.hi);
            TALLY(&all, plain_error(widths[k], reversed, x, p.spec.zfar, p.hi) <= (long double)p.limit * (1.0L + 1e-9L),
                  "%s: %.17g above %.17g fails", text, x, a.value);
        }
    }
    tally_end(&least);
    tally_end(&all);
}

/* Half a code: the depth 1000 keeps an error of 4000 as long as its code is not that of the infinite far plane. */
TEST(test_half_code) {
    plane_answer a;
    dp_format found[2];
    solve_problem p = {.spec = dp_spec_default(), .kind = QUANTITY_ERROR, .limit = 4000.0, .lo = 1000.0, .hi = 1000.0};
    dp_format_parse("unorm16", found);
    p.spec.format = found[0];
    p.spec.zfar = INFINITY;
    assert_int_equal(plane_solve(&p, &a), DP_OK);
    assert_true(a.possible && a.certain);
    assert_relative(a.value, 1000.0 * 0.5 / 65535.0, 1e-9); /* n/z = half a step */
    p.spec.model = DP_MODEL_FLOAT;
    assert_int_equal(plane_solve(&p, &a), DP_ERROR_MODEL);
    assert_int_equal(plane_solve(NULL, &a), DP_ERROR_NULL);
    p.kind = QUANTITY_SEPARATION;
    p.spec.mapping = DP_MAPPING_LINEAR;
    p.spec.zfar = 1e4;
    assert_int_equal(plane_solve(&p, &a), DP_ERROR_MODEL);
}

/* Next beyond the answer some binary32 planes do fail: it is not far too large. */
TEST(test_sweep) {
    plane_answer a;
    dp_format found[2];
    static const dp_mapping mappings[] = {DP_MAPPING_D3D, DP_MAPPING_REVERSED, DP_MAPPING_GL};
    for (int k = 0; k < 3; k++) {
        solve_problem p = {.spec = dp_spec_default(), .limit = 0.01, .lo = 5000.0, .hi = 5000.0};
        dp_format_parse("unorm24", found);
        p.spec.format = found[0];
        p.spec.mapping = mappings[k];
        p.spec.zfar = 1e4;
        p.spec.model = DP_MODEL_FLOAT;
        assert_int_equal(plane_solve(&p, &a), DP_OK);
        assert_true(a.possible && !a.certain && meets(&p, a.value) && a.until == 5000.0);
        uint64_t failing = 0;
        for (float x = (float)a.value; (double)x > a.value * 0.9998; x = nextafterf(x, 0.0F))
            failing += (uint64_t)!meets(&p, (double)x);
        assert_true(failing > 0);
    }
}

/* A camera that leaves one plane open: the other one is `plane`. */
static solve_problem camera(solve_unknown unknown, const char *format, dp_mapping mapping, double plane) {
    dp_format found[2];
    solve_problem p = {.spec = dp_spec_default(), .unknown = unknown};
    assert_int_equal(dp_format_parse(format, found), 1);
    p.spec.format = found[0];
    p.spec.mapping = mapping;
    *(unknown == SOLVE_NEAR ? &p.spec.zfar : &p.spec.znear) = plane;
    return p;
}

/* n = 1 / (S / (z (z + S) step) + 1/f) and f likewise, in long double: UNORM has one piece. */
TEST(test_closed_form) {
    rng r = rng_make("solve closed form");
    tally close = {.name = "UNORM under a perspective: the closed form"};
    const uint64_t cases = test_cases(300, 1500, 50000);
    for (uint64_t i = 0; i < cases; i++) {
        static const char *const names[] = {"unorm16", "unorm24", "unorm32"};
        const double n = rng_log(&r, 1e-3, 10.0), f = n * rng_log(&r, 3.0, 1e4);
        const double z = rng_uniform(&r, n * 1.5, f * 0.9);
        const solve_unknown unknown = (solve_unknown)rng_below(&r, 2);
        solve_problem p =
            camera(unknown, names[rng_below(&r, 3)], (dp_mapping)rng_below(&r, 4), unknown == SOLVE_NEAR ? f : n);
        plane_answer a;
        const long double step = 1.0L / (long double)p.spec.format.code_max;
        const long double kappa = 1.0L / (long double)n - 1.0L / (long double)f, h = (long double)z * kappa * step;
        if (h > 0.9L)
            continue;
        p.lo = p.hi = z;
        p.limit = (double)((long double)z * h / (1.0L - h));
        const long double wanted =
            (long double)p.limit / ((long double)z + (long double)p.limit) / (long double)z / step;
        const long double want =
            unknown == SOLVE_NEAR ? 1.0L / (wanted + 1.0L / (long double)f) : 1.0L / (1.0L / (long double)n - wanted);
        const double bound = 1e-9 + 0x1p-44 * (f - n) / n;
        char text[320];
        const int solved = plane_solve(&p, &a) == DP_OK && a.possible;
        const double off = solved ? (double)(((long double)a.value - want) / want) : INFINITY;
        TALLY(&close, fabs(off) <= bound && (unknown == SOLVE_NEAR ? off > -1e-15 : off < 1e-15 + 0x1p-50 * f / n),
              "%s: %.17g is %.3g off", describe(&p, text), a.value, off);
    }
    tally_end(&close);
}

TEST(test_known) {
    plane_answer a;
    solve_problem p = camera(SOLVE_NEAR, "unorm24", DP_MAPPING_D3D, 1e4);
    p.limit = 0.01;
    p.lo = p.hi = 5000.0;
    assert_int_equal(plane_solve(&p, &a), DP_OK);
    assert_true(a.possible && a.certain && a.until == 5000.0 && a.reached.z == 5000.0);
    assert_relative(a.value, 146.8240652736, 1e-9);
    p.spec.zfar = INFINITY;
    assert_int_equal(plane_solve(&p, &a), DP_OK);
    assert_relative(a.value, 149.0119188435, 1e-9);

    p = camera(SOLVE_NEAR, "fp32", DP_MAPPING_REVERSED, INFINITY);
    p.limit = 1e-3;
    p.lo = p.hi = 5000.0;
    assert_int_equal(plane_solve(&p, &a), DP_OK); /* below a millimetre whatever near is */
    assert_true(a.possible && a.value == 1e-12 && a.until == 5000.0);
    p.limit = 0.0004; /* between a step and the next binade's: an interval in each, and this is the uppermost */
    assert_int_equal(plane_solve(&p, &a), DP_OK);
    assert_true(a.possible && a.certain && a.until < 5000.0);
    assert_relative(a.until, 5000.0, 1e-6);
    assert_relative(a.value, 5000.0 * 0x1p-24 * 5000.0 / 0.0004 * (1 + 0.0004 / 5000.0), 1e-6);
    p.limit = 0.0002;
    assert_int_equal(plane_solve(&p, &a), DP_OK);
    assert_true(!a.possible && a.certain);
}

TEST(test_door) {
    plane_answer a;
    solve_problem good = camera(SOLVE_NEAR, "unorm24", DP_MAPPING_D3D, 100.0);
    good.limit = 0.01;
    good.lo = good.hi = 50.0;
    solve_problem p = good;
    assert_int_equal(plane_solve(NULL, &a), DP_ERROR_NULL);
    assert_int_equal(plane_solve(&p, NULL), DP_ERROR_NULL);
    p.limit = 0.0;
    assert_int_equal(plane_solve(&p, &a), DP_ERROR_RANGE);
    p.limit = NAN;
    assert_int_equal(plane_solve(&p, &a), DP_ERROR_RANGE);
    p = good;
    p.hi = 101.0;
    assert_int_equal(plane_solve(&p, &a), DP_ERROR_RANGE);
    p.hi = INFINITY;
    assert_int_equal(plane_solve(&p, &a), DP_ERROR_RANGE);
    p = good;
    p.lo = 60.0;
    assert_int_equal(plane_solve(&p, &a), DP_ERROR_RANGE);
    p = good;
    p.spec.mapping = DP_MAPPING_LINEAR;
    p.spec.zfar = INFINITY;
    assert_int_equal(plane_solve(&p, &a), DP_ERROR_INFINITE);
    p = good;
    p.unknown = SOLVE_FAR;
    p.spec.znear = 51.0;
    assert_int_equal(plane_solve(&p, &a), DP_ERROR_RANGE);
    p = good;
    p.lo = p.hi = 100.0; /* at far itself near must keep its distance */
    p.limit = 1.0;
    assert_int_equal(plane_solve(&p, &a), DP_OK);
    assert_true(a.possible && a.most < 100.0 && a.until == a.most);
}

/* Where an infinite far plane passes it is the largest far that does; mappings without one end at 1e18. */
TEST(test_infinite) {
    static const char *const formats[] = {"unorm24", "fp32"};
    for (int m = 0; m < DP_MAPPING_COUNT; m++)
        for (int f = 0; f < 2; f++) {
            plane_answer a;
            solve_problem p = camera(SOLVE_FAR, formats[f], (dp_mapping)m, 1.0);
            const bool infinite = dp_mapping_get((dp_mapping)m)->far_infinite;
            p.limit = 1.9;
            p.lo = p.hi = 2.0;
            assert_int_equal(plane_solve(&p, &a), DP_OK);
            assert_true(a.possible && a.until <= 3.0 && meets(&p, a.value));
            assert_true(isinf(a.value) == infinite && isinf(a.most) == infinite && (infinite || a.value <= 1e18));
        }
}

/* Far 16542.5 has an A and a B of few bits and fails; hundreds of values round it do not. */
TEST(test_what_samples_miss) {
    plane_answer a;
    solve_problem p = camera(SOLVE_FAR, "unorm24", DP_MAPPING_D3D, 1.0);
    p.spec.ortho = 1;
    p.spec.model = DP_MODEL_FLOAT;
    p.limit = 0.002;
    p.lo = p.hi = 5000.0;
    assert_int_equal(plane_solve(&p, &a), DP_OK);
    assert_true(!meets(&p, 16542.5) && a.possible && a.value > 16384.0 && (a.value < 16542.5 || a.until > 16542.5));
}

/* Planes that do by the thousand, though neither the lattice's own ends nor the places next to its outer one do. */
TEST(test_far_from_the_lattice) {
    static const struct row {
        dp_model model;
        solve_unknown unknown;
        const char *format;
        dp_mapping mapping;
        bool ortho;
        double plane, limit, z;
    } rows[] = {
        {DP_MODEL_FLOAT, SOLVE_FAR, "unorm24", DP_MAPPING_D3D, false, 1.2, 4.2e-6, 7.5},
        {DP_MODEL_FLOAT, SOLVE_FAR, "fp32", DP_MAPPING_GL_REVERSED, false, 28, 2e-5, 110},
        {DP_MODEL_FLOAT, SOLVE_NEAR, "unorm24", DP_MAPPING_REVERSED, true, 540000, 0.048, 250000},
        {DP_MODEL_STAGED, SOLVE_FAR, "fp32", DP_MAPPING_D3D, false, 27, 2.4e-5, 87},
        {DP_MODEL_STAGED, SOLVE_NEAR, "unorm24", DP_MAPPING_REVERSED, true, 0.19, 2.6e-8, 0.051},
    };
    plane_answer a;
    char text[320];
    tally found = {.name = "planes that do far from the lattice's answer are found"};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const struct row *w = &rows[i];
        solve_problem p = camera(w->unknown, w->format, w->mapping, w->plane);
        p.spec.model = w->model;
        p.spec.ortho = w->ortho;
        p.limit = w->limit;
        p.lo = p.hi = w->z;
        int passing = 0; /* of 6900, up to 1000 times nearer or farther than the depth */
        for (double ratio = 1.0; ratio < 1000.0; ratio *= 1.001)
            passing += meets(&p, w->unknown == SOLVE_NEAR ? w->z / ratio : w->z * ratio);
        assert_int_equal(plane_solve(&p, &a), DP_OK);
        TALLY(&found, passing >= 1000 && a.possible && meets(&p, a.value), "%s: %d planes do, found: %d",
              describe(&p, text), passing, a.possible);
    }
    tally_end(&found);
}

/*
 * At 5000 binary32 depths lie 2^-11 apart, so no plane reaches 0.0004, though real depths on the lattice would. In
 * these two cameras the plane at the depth itself reaches 2^-11, so none can come nearer.
 */
TEST(test_nearest_miss) {
    static const double other[] = {[SOLVE_NEAR] = 1e4, [SOLVE_FAR] = 2500.0};
    plane_answer a;
    for (int unknown = SOLVE_NEAR; unknown <= SOLVE_FAR; unknown++) {
        solve_problem p = camera((solve_unknown)unknown, "unorm24", DP_MAPPING_D3D, other[unknown]);
        dp_setup setup;
        p.spec.model = DP_MODEL_FLOAT;
        p.limit = 0.0004;
        p.lo = p.hi = 5000.0;
        assert_int_equal(plane_solve(&p, &a), DP_OK);
        assert_true(!a.possible && !a.certain);
        *(unknown == SOLVE_NEAR ? &p.spec.znear : &p.spec.zfar) = a.value;
        assert_int_equal(dp_setup_init(&setup, &p.spec), DP_OK);
        assert_relative(dp_separation(&setup, 5000.0), 0x1p-11, 1e-11);
        assert_relative(a.reached.value, 0x1p-11, 1e-11);
    }
    /* Near has no influence on log, so that none will do is certain; three-webgpu begins at it. */
    for (int i = 0; i < 2; i++) {
        solve_problem p = camera(SOLVE_NEAR, "unorm24", i == 0 ? DP_MAPPING_LOG : DP_MAPPING_THREE_WEBGPU, 1e4);
        p.spec.model = DP_MODEL_FLOAT;
        p.limit = i == 0 ? 0.0008 : 0.0004;
        p.lo = p.hi = 1000.0;
        assert_int_equal(plane_solve(&p, &a), DP_OK);
        assert_true(!a.possible && a.certain == (i == 0));
    }
}

/*
 * 25.5 = 255/10 is a stored depth of UNORM8 with near 1 and far inf. However it were aligned its error would be up to
 * 255/9.5 - 25.5 = 1.3421, more than the limit; as it is aligned the error is 0 there, and next to 0 where far is
 * large.
 */
TEST(test_infinite_far) {
    static const dp_model models[] = {DP_MODEL_EXACT, DP_MODEL_STAGED};
    static const dp_mapping mappings[] = {DP_MAPPING_D3D, DP_MAPPING_REVERSED};
    plane_answer a;
    for (int i = 0; i < 4; i++) {
        solve_problem p = camera(SOLVE_FAR, "unorm8", mappings[i % 2], 1.0);
        p.spec.model = models[i / 2];
        p.kind = QUANTITY_ERROR;
        p.limit = 1.342;
        p.lo = p.hi = 25.5;
        assert_int_equal(plane_solve(&p, &a), DP_OK);
        assert_true(a.possible && a.certain);
        assert_ulp(a.value, INFINITY, 0.0);
        assert_scene(a.reached.value, 0.0, 1e-5);
    }
}
