/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * solve is tight: its answer passes, everything on its safe side passes, a part in 1e9 beyond it fails; every island
 * is found; and where the answer has a closed form it is that.
 */
#include "api/cost.h"
#include "depthprec/depthprec.h"
#include "requirement/solve.h"
#include "support.h"

static dp_format format_of(const char *name) {
    dp_format f[2];
    assert_int_not_equal(dp_format_parse(name, f), 0);
    return f[0];
}

static solve_problem problem_of(const char *format, dp_mapping mapping, solve_unknown unknown, double given,
                                double limit, double z) {
    solve_problem p = {.spec = dp_spec_default(), .unknown = unknown, .limit = limit, .lo = z, .hi = z};
    p.spec.format = format_of(format);
    p.spec.mapping = mapping;
    *(unknown == SOLVE_NEAR ? &p.spec.zfar : &p.spec.znear) = given;
    return p;
}

/* Whether the dp_separation() of the problem's depths, or half a step, stays within the limit; the inside sampled. */
static int meets(const solve_problem *p, double x, double z) {
    dp_spec spec = p->spec;
    dp_setup setup;
    *(p->unknown == SOLVE_NEAR ? &spec.znear : &spec.zfar) = x;
    if (dp_setup_init(&setup, &spec) != DP_OK)
        return 0;
    if (p->kind == MEASURE_SEPARATION)
        return dp_separation(&setup, z) <= p->limit;
    return measure_at(p->kind, &setup, z) <= p->limit;
}

static int meets_everywhere(const solve_problem *p, double x, rng *r) {
    if (!meets(p, x, p->lo) || !meets(p, x, p->hi))
        return 0;
    for (int i = 0; i < 24 && p->lo < p->hi; i++)
        if (!meets(p, x, fmin(fmax(rng_log(r, p->lo, p->hi), p->lo), p->hi)))
            return 0;
    return 1;
}

static measure_worst worst_of(const solve_problem *p, double x) {
    dp_spec spec = p->spec;
    dp_setup setup;
    *(p->unknown == SOLVE_NEAR ? &spec.znear : &spec.zfar) = x;
    return dp_setup_init(&setup, &spec) == DP_OK ? measure_over(p->kind, &setup, p->lo, p->hi)
                                                 : (measure_worst){INFINITY, p->hi};
}

/* How far beyond an end a failure must show: 1e-9, or more where the measure hardly depends on the unknown. */
static double beyond(const solve_problem *p, double x) {
    const double n = p->unknown == SOLVE_NEAR ? x : p->spec.znear;
    const double f = p->unknown == SOLVE_NEAR ? p->spec.zfar : x;
    const int perspective = dp_mapping_get(p->spec.mapping)->curve == DP_CURVE_PERSPECTIVE && !p->spec.ortho;
    const int weak = p->spec.ortho ? p->unknown == SOLVE_NEAR : perspective && p->unknown == SOLVE_FAR;
    return weak ? fmax(1e-9, 0x1p-46 * (f - n) / n) : 1e-9;
}

static const char *describe(const solve_problem *p, char text[320]) {
    snprintf(text, 320, "%s of %s %s%s near %.17g far %.17g, %s %.17g over %.17g..%.17g",
             p->unknown == SOLVE_NEAR ? "near" : "far", p->spec.format.name, dp_mapping_get(p->spec.mapping)->name,
             p->spec.ortho ? " ortho" : "", p->spec.znear, p->spec.zfar,
             p->kind == MEASURE_ERROR ? "error" : "separation", p->limit, p->lo, p->hi);
    return text;
}

/* A problem made from a camera that can be: its own measure, times something near 1, is what is wanted. */
static int draw(rng *r, solve_problem *p) {
    static const char *const formats[] = {"fp16", "fp32",    "unorm16", "unorm24",  "fp32",
                                          "fp32", "unorm24", "unorm8",  "float4.6", "float5.11b20"};
    *p = (solve_problem){.spec = dp_spec_default()};
    p->spec.format = format_of(formats[rng_below(r, sizeof formats / sizeof formats[0])]);
    p->spec.mapping = (dp_mapping)rng_below(r, DP_MAPPING_COUNT);
    p->spec.ortho = dp_mapping_get(p->spec.mapping)->ortho && rng_below(r, 4) == 0;
    p->spec.rounding = (dp_rounding)rng_below(r, DP_ROUNDING_COUNT);
    p->spec.log_c = rng_log(r, 1e-3, 1e3);
    p->spec.znear = rng_log(r, 1e-3, 1e2);
    p->spec.zfar = p->spec.znear * rng_log(r, 1.5, 1e5);
    if (dp_mapping_get(p->spec.mapping)->far_infinite && !p->spec.ortho && rng_below(r, 5) == 0)
        p->spec.zfar = INFINITY;
    const double far_end = fmin(p->spec.zfar, 1e5 * p->spec.znear);
    p->unknown = (solve_unknown)rng_below(r, 2);
    p->kind = rng_below(r, 4) == 0 ? MEASURE_ERROR : MEASURE_SEPARATION;
    p->hi = fmin(rng_log(r, p->spec.znear, far_end), far_end);
    p->lo = rng_below(r, 3) == 0 ? fmin(fmax(rng_log(r, p->spec.znear, p->hi), p->spec.znear), p->hi) : p->hi;
    dp_setup setup;
    if (dp_setup_init(&setup, &p->spec) != DP_OK)
        return 0;
    p->limit = measure_over(p->kind, &setup, p->lo, p->hi).value * rng_log(r, 0.4, 2.5);
    return p->limit < INFINITY && p->limit > 0.0;
}

/* The island that holds x, or -1; -2 too near an end to ask. */
static int island_of(const solve_problem *p, const solve_result *s, double x) {
    for (int i = 0; i < s->island_count; i++) {
        const solve_island *k = &s->islands[i];
        if (fabs(x - k->lo) <= k->lo * beyond(p, k->lo) ||
            (!isinf(k->hi) && fabs(x - k->hi) <= k->hi * beyond(p, k->hi)))
            return -2;
        if (x >= k->lo && x <= k->hi)
            return i;
    }
    return -1;
}

/* Long: three claims on each answer, judged as it is solved for. */
TEST(test_tight) {
    static solve_result s;
    rng r = rng_make("solve");
    tally answer = {.name = "the answer and each end of an island pass"};
    tally safe = {.name = "all on the safe side passes"};
    tally tight = {.name = "a part in 1e9 beyond an end fails"};
    tally neighbour = {.name = "near of a perspective: the very next double fails"};
    tally islands = {.name = "a value passes exactly when an island holds it"};
    tally impossible = {.name = "impossible: no sampled value passes, none comes nearer"};
    const uint64_t cases = test_cases(400, 3000, 100000);
    uint64_t weak = 0;
    for (uint64_t i = 0; i < cases;) {
        solve_problem p;
        char text[320];
        if (!draw(&r, &p))
            continue;
        i++;
        if (solve(&p, &s) != DP_OK) {
            tally_fail(&answer, "%s: refused", describe(&p, text));
            continue;
        }
        describe(&p, text);
        for (int k = 0; k < s.island_count; k++) {
            const double ends[2] = {s.islands[k].lo, s.islands[k].hi};
            for (int e = 0; e < 2; e++)
                TALLY(&answer, worst_of(&p, ends[e]).value <= p.limit && meets_everywhere(&p, ends[e], &r),
                      "%s: %.17g fails", text, ends[e]);
            if (!isinf(ends[1]))
                for (int n = 0; n < 4; n++) {
                    const double x = fmin(fmax(rng_log(&r, ends[0], ends[1]), ends[0]), ends[1]);
                    TALLY(&safe, meets_everywhere(&p, x, &r), "%s: %.17g in %.17g..%.17g fails", text, x, ends[0],
                          ends[1]);
                }
            for (int e = 0; e < 2; e++) {
                const double x = e == 0 ? ends[0] * (1.0 - beyond(&p, ends[0])) : ends[1] * (1.0 + beyond(&p, ends[1]));
                if (ends[e] == (e == 0 ? s.least : s.most) || x < s.least || x > s.most || island_of(&p, &s, x) >= 0)
                    continue;
                if (p.unknown == SOLVE_NEAR && !p.spec.ortho && p.spec.mapping <= DP_MAPPING_GL_REVERSED)
                    TALLY(&neighbour, worst_of(&p, nextafter(ends[e], e == 0 ? 0.0 : INFINITY)).value > p.limit,
                          "%s: the neighbour of %.17g passes", text, ends[e]);
                const measure_worst w = worst_of(&p, x);
                weak += beyond(&p, ends[e]) > 1e-9;
                TALLY(&tight, w.value > p.limit && !meets(&p, x, w.z), "%s: %.17g beyond %.17g passes", text, x,
                      ends[e]);
            }
        }
        for (int n = 0; n < 12; n++) {
            const double most = fmin(s.most, p.unknown == SOLVE_FAR ? 1e4 * s.least : s.most);
            const double x = fmin(fmax(rng_log(&r, s.least, most), s.least), most);
            const int k = island_of(&p, &s, x);
            const double value = worst_of(&p, x).value;
            if (k != -2)
                TALLY(&islands, (k >= 0) == (value <= p.limit), "%s: %.17g, island %d, measure %.17g", text, x, k,
                      value);
            if (!s.possible)
                TALLY(&impossible, value > p.limit && value >= s.worst.value * (1.0 - 1e-9),
                      "%s: %.17g gives %.17g, nearest %.17g", text, x, value, s.worst.value);
        }
        if (s.possible)
            TALLY(&answer,
                  s.value == (p.unknown == SOLVE_NEAR ? s.islands[s.island_count - 1].lo
                                                      : s.islands[s.island_count - 1].hi) &&
                      s.worst.value <= p.limit,
                  "%s: the answer is not the last island's", text);
    }
    printf("# %llu problems, %llu ends of islands with their outside, of these %llu weaker than 1e-9\n",
           (unsigned long long)cases, (unsigned long long)tight.cases, (unsigned long long)weak);
    tally_end(&answer);
    tally_end(&safe);
    tally_end(&tight);
    tally_end(&neighbour);
    tally_end(&islands);
    tally_end(&impossible);
}

/* n = 1 / (S / (z (z + S) step) + 1/f) and f likewise, in long double: UNORM has one piece. */
TEST(test_closed_form) {
    static solve_result s;
    rng r = rng_make("solve closed form");
    tally close = {.name = "UNORM under a perspective: the closed form"};
    const uint64_t cases = test_cases(300, 1500, 50000);
    for (uint64_t i = 0; i < cases; i++) {
        static const char *const names[] = {"unorm16", "unorm24", "unorm32"};
        const double n = rng_log(&r, 1e-3, 10.0);
        const double f = n * rng_log(&r, 3.0, 1e4);
        const double z = rng_uniform(&r, n * 1.5, f * 0.9);
        dp_mapping mapping = (dp_mapping)rng_below(&r, 4);
        const solve_unknown unknown = (solve_unknown)rng_below(&r, 2);
        solve_problem p = problem_of(names[rng_below(&r, 3)], mapping, unknown, unknown == SOLVE_NEAR ? f : n, 1.0, z);
        const long double step = 1.0L / (long double)p.spec.format.code_max;
        const long double kappa = 1.0L / (long double)n - 1.0L / (long double)f;
        const long double h = (long double)z * kappa * step;
        if (h > 0.9L)
            continue;
        p.limit = (double)((long double)z * h / (1.0L - h));
        const long double wanted =
            (long double)p.limit / ((long double)z + (long double)p.limit) / (long double)z / step;
        const long double want =
            unknown == SOLVE_NEAR ? 1.0L / (wanted + 1.0L / (long double)f) : 1.0L / (1.0L / (long double)n - wanted);
        const double bound = unknown == SOLVE_NEAR ? 1e-13 : 1e-13 + 0x1p-46 * (f - n) / n;
        char text[320];
        const int solved = solve(&p, &s) == DP_OK && s.possible;
        const double off = solved ? (double)(((long double)s.value - want) / want) : INFINITY;
        TALLY(&close, fabs(off) <= bound && (unknown == SOLVE_NEAR ? off > -1e-15 : off < 1e-15 + 0x1p-50 * f / n),
              "%s: %.17g is %.3g off", describe(&p, text), s.value, off);
    }
    tally_end(&close);
}

TEST(test_known) {
    static solve_result s;
    solve_problem p = problem_of("unorm24", DP_MAPPING_D3D, SOLVE_NEAR, 1e4, 0.01, 5000.0);
    assert_int_equal(solve(&p, &s), DP_OK);
    assert_true(s.possible);
    assert_int_equal(s.island_count, 1);
    assert_relative(s.value, 146.8240652736, 1e-12);
    assert_true(s.until == 5000.0 && s.worst.z == 5000.0);
    p.spec.zfar = INFINITY;
    assert_int_equal(solve(&p, &s), DP_OK);
    assert_relative(s.value, 149.0119188435, 1e-12);

    static const double cells[][2] = {{0.01, 147.08}, {0.1, 14.9}, {1.0, 1.49}};
    for (int i = 0; i < 3; i++) {
        dp_spec spec = p.spec;
        dp_setup setup;
        dp_sample sample;
        spec.znear = cells[i][0];
        spec.zfar = 1e4;
        assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
        assert_int_equal(dp_sample_at(&setup, 5000.0, &sample), DP_OK);
        assert_relative(sample.interval, cells[i][1], 5e-3);
    }

    p = problem_of("fp32", DP_MAPPING_REVERSED, SOLVE_NEAR, INFINITY, 1e-3, 5000.0);
    assert_int_equal(solve(&p, &s), DP_OK); /* below a millimetre whatever near is */
    assert_true(s.possible && s.value == 1e-12 && s.until == 5000.0 && s.island_count == 1);
    p.limit = 0.0004; /* between a step and the next binade's: an island in each binade */
    assert_int_equal(solve(&p, &s), DP_OK);
    assert_true(s.possible && s.island_count == 53);
    for (int i = 2; i < s.island_count; i++)
        assert_relative(s.islands[i].lo, 2.0 * s.islands[i - 1].lo, 1e-12);
    p.limit = 0.0002;
    assert_int_equal(solve(&p, &s), DP_OK);
    assert_false(s.possible);
}

TEST(test_door) {
    static solve_result s;
    const solve_problem good = problem_of("unorm24", DP_MAPPING_D3D, SOLVE_NEAR, 100.0, 0.01, 50.0);
    solve_problem p = good;
    assert_int_equal(solve(NULL, &s), DP_ERROR_NULL);
    assert_int_equal(solve(&p, NULL), DP_ERROR_NULL);
    p.limit = 0.0;
    assert_int_equal(solve(&p, &s), DP_ERROR_RANGE);
    p.limit = NAN;
    assert_int_equal(solve(&p, &s), DP_ERROR_RANGE);
    p = good;
    p.hi = 101.0;
    assert_int_equal(solve(&p, &s), DP_ERROR_RANGE);
    p.hi = INFINITY;
    assert_int_equal(solve(&p, &s), DP_ERROR_RANGE);
    p = good;
    p.lo = 60.0;
    assert_int_equal(solve(&p, &s), DP_ERROR_RANGE);
    p = good;
    p.spec.model = DP_MODEL_FLOAT;
    assert_int_equal(solve(&p, &s), DP_ERROR_MODEL);
    p = good;
    p.spec.mapping = DP_MAPPING_LINEAR;
    p.spec.zfar = INFINITY;
    assert_int_equal(solve(&p, &s), DP_ERROR_INFINITE);
    p = good;
    p.unknown = SOLVE_FAR;
    p.spec.znear = 51.0;
    assert_int_equal(solve(&p, &s), DP_ERROR_RANGE);
    p = good;
    p.lo = p.hi = 100.0; /* at far itself near must keep its distance */
    p.limit = 1.0;
    assert_int_equal(solve(&p, &s), DP_OK);
    assert_true(s.possible && s.most < 100.0 && s.until == s.most);
}

/* The measure of an error is one: no stored depth lies farther off, and some nearly as far. */
TEST(test_error) {
    rng r = rng_make("solve error");
    tally held = {.name = "no error is larger than its measure"};
    tally near_by = {.name = "an error near by is nearly as large"};
    const uint64_t cases = test_cases(1000, 6000, 200000);
    for (uint64_t i = 0; i < cases; i++) {
        solve_problem p;
        dp_setup setup;
        dp_worst worst;
        char text[320];
        if (!draw(&r, &p) || dp_setup_init(&setup, &p.spec) != DP_OK)
            continue;
        const double m = measure_at(MEASURE_ERROR, &setup, p.hi);
        if (isinf(m))
            continue;
        TALLY(&held, fabs(dp_error(&setup, dp_code(&setup, p.hi), p.hi)) <= m, "%s: %.17g", describe(&p, text), m);
        const double lo = p.hi - 3.0 * m;
        const double hi = p.hi + 3.0 * m;
        if (p.spec.format.kind == DP_FORMAT_UNORM && m < 1e-3 * p.hi && lo > p.spec.znear && hi < p.spec.zfar &&
            dp_worst_over(&setup, lo, hi, &worst) == DP_OK)
            TALLY(&near_by, worst.error > 0.98 * m, "%s: %.17g of %.17g", describe(&p, text), worst.error, m);
    }
    tally_end(&held);
    tally_end(&near_by);
}

/* Over a range the measure is the largest inside, and is reached where it says. */
TEST(test_range) {
    rng r = rng_make("solve range");
    tally largest = {.name = "no depth of a range has a larger measure"};
    const uint64_t cases = test_cases(500, 1500, 50000);
    for (uint64_t i = 0; i < cases; i++) {
        solve_problem p;
        dp_setup setup;
        char text[320];
        if (!draw(&r, &p) || dp_setup_init(&setup, &p.spec) != DP_OK)
            continue;
        const double lo = fmin(rng_log(&r, p.spec.znear, p.hi), p.hi);
        const measure_worst w = measure_over(p.kind, &setup, lo, p.hi);
        assert_true(measure_at(p.kind, &setup, w.z) == w.value);
        for (int k = 0; k < 40 && lo < p.hi; k++) {
            const double z = fmin(fmax(rng_log(&r, lo, p.hi), lo), p.hi);
            const double m = measure_at(p.kind, &setup, z);
            TALLY(&largest, m <= w.value * (1.0 + 0x1p-44), "%s: from %.17g, at %.17g %.17g above %.17g",
                  describe(&p, text), lo, z, m, w.value);
        }
    }
    tally_end(&largest);
}

TEST(test_cost) {
    static const char *const order[] = {"unorm16", "fp32", "unorm24", "fp16", "float3.3"};
    for (int i = 0; i < 5; i++)
        for (int k = i + 1; k < 4; k++) {
            const dp_format a = format_of(order[i]);
            const dp_format b = format_of(order[k]);
            const cost x = cost_of(&a, DP_MAPPING_D3D);
            const cost y = cost_of(&b, DP_MAPPING_D3D);
            assert_true(cost_compare(&x, &y) < 0 && cost_compare(&y, &x) > 0);
        }
    for (size_t i = 0; i < dp_format_count(); i++) /* every named format has its row */
        assert_null(strstr(cost_of(&dp_format_get(i)->format, DP_MAPPING_GL).available, "study"));
}

/* Where an infinite far plane passes it is the largest far that does; mappings without one end at 1e18. */
TEST(test_infinite) {
    static const char *const formats[] = {"unorm24", "fp32"};
    for (int m = 0; m < DP_MAPPING_COUNT; m++)
        for (int f = 0; f < 2; f++) {
            static solve_result s;
            const solve_problem p = problem_of(formats[f], (dp_mapping)m, SOLVE_FAR, 1.0, 1.9, 2.0);
            const bool infinite = dp_mapping_get((dp_mapping)m)->far_infinite;
            assert_int_equal(solve(&p, &s), DP_OK);
            assert_true(s.possible && s.island_count == 1 && s.until <= 3.0);
            assert_true(isinf(s.value) == infinite && isinf(s.most) == infinite);
            assert_true(s.value == s.islands[0].hi && (infinite || s.value <= 1e18));
            assert_true(worst_of(&p, s.value).value <= p.limit);
        }
}
