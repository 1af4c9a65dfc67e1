/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The near or far plane in every model: the answer passes as `check` judges it, what is said to fail fails, what is
 * said to pass passes, and nothing that the lattice refuses is found. Recomputed from the library, not recorded.
 */
#include "requirement/plane.h"
#include "support.h"

static const char *describe(const solve_problem *p, char text[320]) {
    snprintf(text, 320, "%s of %s %s%s near %.17g far %.17g %s %s, %s %.17g over %.17g..%.17g",
             p->unknown == SOLVE_NEAR ? "near" : "far", p->spec.format.name, dp_mapping_get(p->spec.mapping)->name,
             p->spec.ortho ? " ortho" : "", p->spec.znear, p->spec.zfar, dp_model_name(p->spec.model),
             dp_arith_get(p->spec.arith)->name, p->kind == MEASURE_ERROR ? "error" : "separation", p->limit, p->lo,
             p->hi);
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
    if (p->kind == MEASURE_SEPARATION)
        return p->lo == p->hi
                   ? dp_separation(&setup, p->lo) <= p->limit
                   : dp_separation_over(&setup, p->lo, p->hi, p->limit, &worst) == DP_OK && worst.bound <= p->limit;
    return p->lo == p->hi ? fabs(dp_error(&setup, dp_code(&setup, p->lo), p->lo)) <= p->limit
                          : dp_worst_over(&setup, p->lo, p->hi, &error) == DP_OK && error.error <= p->limit;
}

/* A problem made from a camera that can be: its own value, times something near 1, is what is wanted. */
static int draw(rng *r, dp_model model, measure_kind kind, solve_problem *p) {
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
    const judgement j = judge(kind, &setup, p->lo, p->hi, NAN);
    p->limit = j.value * rng_log(r, 0.5, 2.0);
    return p->limit > 0.0 && p->limit < INFINITY;
}

typedef struct sides {
    tally answer, proof, steady, beyond, until, lattice, nothing;
    uint64_t certain, possible, proven;
} sides;

/* A value between the answer and where it is said to fail. */
static void judge_beyond(const solve_problem *p, const plane_answer *a, const solve_result *lattice, rng *r, sides *s) {
    char text[320];
    if (isnan(a->fails_to)) {
        const double next = nextafter(a->value, p->unknown == SOLVE_NEAR ? 0.0 : INFINITY);
        if (a->certain && isfinite(a->value) && next >= lattice->least && next <= lattice->most && p->lo == p->hi &&
            (p->kind == MEASURE_ERROR || p->spec.model == DP_MODEL_EXACT))
            TALLY(&s->beyond, !meets(p, next) || fabs(a->value - lattice->value) <= 0x1p-44 * a->value,
                  "%s: %.17g next to %.17g passes", describe(p, text), next, a->value);
        return;
    }
    for (int i = 0; i < 64; i++) {
        const double x = (double)(float)rng_uniform(r, fmin(a->value, a->fails_to), fmax(a->value, a->fails_to));
        if (x == a->value || (x < a->value) != (a->fails_to < a->value))
            continue;
        TALLY(&s->beyond, !meets(p, x), "%s: %.17g beyond %.17g passes", describe(p, text), x, a->value);
    }
    const double share = fabs(a->fails_to / a->value - 1.0);
    const double end = lattice->value;
    TALLY(&s->beyond, share >= 0.0009 || fabs(a->fails_to / end - 1.0) < 1e-6 || lattice->island_count > 1,
          "%s: %.17g is said to fail, %.3g from %.17g", describe(p, text), a->fails_to, share, a->value);
}

/* What the lattice refuses no model has: its separation is the least that there can be. */
static void judge_lattice(const solve_problem *p, const plane_answer *a, const solve_result *lattice, rng *r,
                          sides *s) {
    char text[320];
    const int znear = p->unknown == SOLVE_NEAR;
    TALLY(&s->lattice,
          znear ? a->value >= lattice->islands[0].lo : a->value <= lattice->islands[lattice->island_count - 1].hi,
          "%s: %.17g is outside the lattice's %.17g", describe(p, text), a->value, lattice->value);
    if (p->spec.model == DP_MODEL_EXACT || isinf(a->value))
        return;
    for (int i = 0; i < 8; i++) { /* not yet what fp32 promises everywhere, but what its answers rest on */
        const double x = rng_uniform(r, fmin(a->value, a->until), fmax(a->value, fmin(a->until, 1e4 * a->value)));
        dp_spec spec = p->spec;
        dp_setup full, exact;
        *(znear ? &spec.znear : &spec.zfar) = x;
        if (set_up(&spec, &full) != DP_OK)
            continue;
        spec.model = DP_MODEL_EXACT;
        dp_setup_init(&exact, &spec);
        if (p->spec.model == DP_MODEL_STAGED)
            TALLY(&s->lattice, dp_separation(&full, p->hi) >= dp_separation(&exact, p->hi) * (1.0 - 1e-12),
                  "%s: %.17g has less than the lattice", describe(p, text), x);
    }
}

/* From the one to use on all pass for certain: those of few bits, too, which are rounded to even. */
static void judge_chosen(const solve_problem *p, const plane_answer *a, rng *r, sides *s) {
    char text[320];
    const double lo = fmin(a->chosen, a->until), hi = fmax(a->chosen, a->until);
    TALLY(&s->answer,
          meets(p, a->chosen) && a->chosen >= fmin(a->value, a->until) && a->chosen <= fmax(a->value, a->until),
          "%s: %.17g fails", describe(p, text), a->chosen);
    s->proven += a->proven;
    const int ends = (a->tried == 0) == (a->proven && a->chosen == a->value);
    TALLY(&s->proof, p->kind == MEASURE_ERROR || ends, "%s: %d tried", describe(p, text), (int)a->tried);
    for (int i = 0; i < (p->lo < p->hi ? 20 : 100) && a->proven; i++) {
        const double x = rng_log(r, lo, fmin(hi, 1e18)), grid = ldexp(1.0, ilogb(x) - (int)rng_below(r, 24));
        const double coarse = rint(x / grid) * grid,
                     value = i % 2 == 0 || coarse < lo || coarse > fmin(hi, 1e18) ? x : coarse;
        TALLY(&s->proof, meets(p, value), "%s: %.17g fails between %.17g and %.17g", describe(p, text), value,
              a->chosen, a->until);
    }
}

static void judge_answer(const solve_problem *p, const plane_answer *a, const solve_result *lattice, rng *r, sides *s) {
    char text[320];
    s->possible += a->possible;
    s->certain += a->possible && a->certain;
    if (!a->possible) {
        for (int i = 0; i < 24 && a->certain; i++) {
            const double most = p->unknown == SOLVE_FAR ? 1e4 * lattice->least : lattice->most;
            const double x = fmin(fmax(rng_log(r, lattice->least, most), lattice->least), most);
            solve_problem exact = *p;
            exact.spec.model = DP_MODEL_EXACT;
            if (meets(p, x) && !meets(&exact, x)) /* that no model is below the lattice is tested elsewhere */
                s->nothing.skipped++;
            else
                TALLY(&s->nothing, !meets(p, x), "%s: nothing found, but %.17g passes", describe(p, text), x);
        }
        return;
    }
    TALLY(&s->answer, meets(p, a->value) && a->reached.passed && a->reached.value <= p->limit, "%s: %.17g fails",
          describe(p, text), a->value);
    judge_chosen(p, a, r, s);
    TALLY(&s->until, p->spec.model == DP_MODEL_EXACT || meets(p, a->until), "%s: the other end %.17g of %.17g fails",
          describe(p, text), a->until, a->value);
    if (a->tried == 0 && isfinite(a->value))
        for (int i = 0; i < 16; i++) {
            const double lo = fmin(a->value, a->until);
            const double x = fmin(fmax(rng_log(r, lo, fmax(a->value, a->until)), lo), fmax(a->value, a->until));
            TALLY(&s->steady, meets(p, x), "%s: %.17g fails between %.17g and %.17g", describe(p, text), x, a->value,
                  a->until);
        }
    if (!isnan(a->steady))
        TALLY(&s->steady, a->passed <= a->tried && meets(p, a->steady), "%s: steady from %.17g", describe(p, text),
              a->steady);
    judge_beyond(p, a, lattice, r, s);
    if (p->kind == MEASURE_SEPARATION)
        judge_lattice(p, a, lattice, r, s);
}

static void in_model(dp_model model, measure_kind kind, uint64_t cases) {
    static solve_result lattice;
    rng r = rng_make(kind == MEASURE_ERROR ? "plane error" : dp_model_name(model));
    sides s = {.answer = {.name = "the answer passes as check judges"},
               .proof = {.name = "all that is said to pass for certain passes"},
               .steady = {.name = "what is said to pass passes"},
               .beyond = {.name = "what is said to fail beyond the answer fails"},
               .until = {.name = "the other end passes"},
               .lattice = {.name = "no answer but where the lattice has one"},
               .nothing = {.name = "where nothing is found no sampled value passes"}};
    for (uint64_t i = 0; i < cases;) {
        solve_problem p;
        plane_answer a;
        char text[320];
        if (!draw(&r, model, kind, &p))
            continue;
        i++;
        if (plane_solve(&p, i % 8 == 0 ? PLANE_PROVE : PLANE_FIND, &lattice, &a) != DP_OK)
            tally_fail(&s.answer, "%s: refused", describe(&p, text));
        else
            judge_answer(&p, &a, &lattice, &r, &s);
    }
    printf("# %s: %llu problems, %llu with an answer, %llu of these certain, %llu proven\n", dp_model_name(model),
           (unsigned long long)cases, (unsigned long long)s.possible, (unsigned long long)s.certain,
           (unsigned long long)s.proven);
    tally_end(&s.answer);
    tally_end(&s.proof);
    tally_end(&s.until);
    tally_end(&s.steady);
    tally_end(&s.beyond);
    if (kind == MEASURE_SEPARATION)
        tally_end(&s.lattice);
    if (s.nothing.cases > 0)
        tally_end(&s.nothing);
}

TEST(test_fp32) {
    in_model(DP_MODEL_FLOAT, MEASURE_SEPARATION, test_cases(100, 500, 20000));
}

TEST(test_staged) {
    in_model(DP_MODEL_STAGED, MEASURE_SEPARATION, test_cases(100, 250, 10000));
}

TEST(test_exact) {
    in_model(DP_MODEL_EXACT, MEASURE_SEPARATION, test_cases(100, 250, 10000));
}

TEST(test_error) {
    in_model(DP_MODEL_EXACT, MEASURE_ERROR, test_cases(100, 250, 10000));
    in_model(DP_MODEL_STAGED, MEASURE_ERROR, test_cases(50, 100, 3000));
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
    static solve_result lattice;
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
        solve_problem p = {.spec = dp_spec_default(), .kind = MEASURE_ERROR, .unknown = SOLVE_NEAR};
        dp_format_parse(names[k], found);
        p.spec.format = found[0];
        p.spec.mapping = rng_below(&r, 2) == 0 ? DP_MAPPING_D3D : DP_MAPPING_REVERSED;
        p.lo = p.hi = rng_log(&r, 1.0, 1e4);
        p.spec.zfar = rng_below(&r, 2) == 0 ? INFINITY : p.hi * rng_log(&r, 1.1, 100.0);
        p.limit = p.hi * rng_log(&r, 1e-2, 10.0);
        assert_int_equal(plane_solve(&p, PLANE_PROVE, &lattice, &a), DP_OK);
        const int reversed = p.spec.mapping == DP_MAPPING_REVERSED;
        char text[320];
        describe(&p, text);
        TALLY(&least,
              a.possible && (a.value == lattice.least || plain_error(widths[k], reversed, a.value * (1.0 - 1e-9),
                                                                     p.spec.zfar, p.hi) > (long double)p.limit),
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
    static solve_result lattice;
    plane_answer a;
    dp_format found[2];
    solve_problem p = {.spec = dp_spec_default(), .kind = MEASURE_ERROR, .limit = 4000.0, .lo = 1000.0, .hi = 1000.0};
    dp_format_parse("unorm16", found);
    p.spec.format = found[0];
    p.spec.zfar = INFINITY;
    assert_int_equal(plane_solve(&p, PLANE_PROVE, &lattice, &a), DP_OK);
    assert_true(a.possible && a.certain);
    assert_relative(a.value, 1000.0 * 0.5 / 65535.0, 1e-12);                      /* n/z = half a step */
    assert_relative(lattice.value, 0.5 / 65535.0 / (1e-3 - 1.0 / 5000.0), 1e-12); /* however it is aligned */
    p.spec.model = DP_MODEL_FLOAT;
    assert_int_equal(plane_solve(&p, PLANE_PROVE, &lattice, &a), DP_ERROR_MODEL);
    assert_int_equal(plane_solve(NULL, PLANE_PROVE, &lattice, &a), DP_ERROR_NULL);
    p.kind = MEASURE_SEPARATION;
    p.spec.mapping = DP_MAPPING_LINEAR;
    p.spec.zfar = 1e4;
    assert_int_equal(plane_solve(&p, PLANE_PROVE, &lattice, &a), DP_ERROR_MODEL);
}

/* A binary32 sweep of a whole part in a thousand below the answer, and of what lies between it and the lattice's. */
TEST(test_sweep) {
    static solve_result lattice;
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
        assert_int_equal(plane_solve(&p, PLANE_PROVE, &lattice, &a), DP_OK);
        assert_true(a.possible && a.certain && meets(&p, a.value) && a.value >= lattice.value);
        assert_true(a.proven && a.chosen >= a.value && a.until == 5000.0);
        uint64_t failing = 0; /* and next below the one to use some do fail: it is not far too large */
        for (float x = (float)a.chosen; (double)x > a.chosen * 0.998; x = nextafterf(x, 0.0F))
            failing += (uint64_t)!meets(&p, (double)x);
        assert_true(failing > 0);
        uint64_t passing = 0;
        for (float x = (float)(a.value * 0.999025); (double)x < a.value; x = nextafterf(x, 1e9F))
            passing += (uint64_t)meets(&p, (double)x);
        assert_true(passing == 0);
        passing = 0;
        for (double x = lattice.value; x < a.value * 0.999; x *= 1.0001)
            passing += (uint64_t)meets(&p, (double)(float)x);
        assert_true(passing == 0);
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

/* Far 16542.5 has an A and a B of few bits and fails; hundreds of values that are tried round it do not. */
TEST(test_what_samples_miss) {
    static solve_result lattice;
    plane_answer a;
    solve_problem p = camera(SOLVE_FAR, "unorm24", DP_MAPPING_D3D, 1.0);
    p.spec.ortho = 1;
    p.spec.model = DP_MODEL_FLOAT;
    p.limit = 0.002;
    p.lo = p.hi = 5000.0;
    assert_int_equal(plane_solve(&p, PLANE_PROVE, &lattice, &a), DP_OK);
    assert_true(!meets(&p, 16542.5) && a.tried > 500 && a.passed == a.tried && a.value > 26000.0);
    assert_true(a.proven && a.chosen < 16542.5 && a.chosen > 16384.0);
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
    static solve_result lattice;
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
        assert_int_equal(plane_solve(&p, PLANE_FIND, &lattice, &a), DP_OK);
        TALLY(&found, passing >= 1000 && a.possible && meets(&p, a.value), "%s: %d planes do, found: %d",
              describe(&p, text), passing, a.possible);
    }
    tally_end(&found);
}

/*
 * At 5000 binary32 depths lie 2^-11 apart, so no plane reaches 0.0004, though real depths on the lattice would. In
 * these two cameras the plane at the depth itself reaches 2^-11, so none can come nearer; the other end of what the
 * lattice allows is twice as far off at least.
 */
TEST(test_nearest_miss) {
    static const double other[] = {[SOLVE_NEAR] = 1e4, [SOLVE_FAR] = 2500.0};
    static solve_result lattice;
    plane_answer a;
    for (int unknown = SOLVE_NEAR; unknown <= SOLVE_FAR; unknown++) {
        solve_problem p = camera((solve_unknown)unknown, "unorm24", DP_MAPPING_D3D, other[unknown]);
        dp_setup setup;
        p.spec.model = DP_MODEL_FLOAT;
        p.limit = 0.0004;
        p.lo = p.hi = 5000.0;
        assert_int_equal(plane_solve(&p, PLANE_PROVE, &lattice, &a), DP_OK);
        assert_true(lattice.possible && !a.possible && !a.certain);
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
        assert_int_equal(plane_solve(&p, PLANE_PROVE, &lattice, &a), DP_OK);
        assert_true(lattice.possible && !a.possible && a.certain == (i == 0));
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
    static solve_result lattice;
    plane_answer a;
    for (int i = 0; i < 4; i++) {
        solve_problem p = camera(SOLVE_FAR, "unorm8", mappings[i % 2], 1.0);
        p.spec.model = models[i / 2];
        p.kind = MEASURE_ERROR;
        p.limit = 1.342;
        p.lo = p.hi = 25.5;
        assert_int_equal(plane_solve(&p, PLANE_PROVE, &lattice, &a), DP_OK);
        assert_true(lattice.possible && lattice.value < 1e6);
        assert_true(a.possible && a.certain);
        assert_ulp(a.value, INFINITY, 0.0);
        assert_scene(a.reached.value, 0.0, 1e-5);
    }
}
