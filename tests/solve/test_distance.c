/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * How far a requirement holds: at every depth up to the answer, by dense scans with dp_separation() and by
 * dp_separation_over(); not at the depth that is said to fail; and where there is a closed form it is that.
 */
#include <fenv.h>

#include "solve/distance.h"
#include "support.h"

typedef struct question {
    dp_setup setup;
    quantity_kind kind;
    double lo, hi, limit;
} question;

static const char *describe(const question *q, char text[320]) {
    const dp_spec *s = &q->setup.spec;
    snprintf(text, 320, "%s %s%s near %.17g far %.17g %s %s, %s %.17g from %.17g to %.17g", s->format.name,
             dp_mapping_get(s->mapping)->name, s->ortho ? " ortho" : "", s->znear, s->zfar, dp_model_name(s->model),
             dp_arith_get(s->arith)->name, quantity_get(q->kind)->name, q->limit, q->lo, q->hi);
    return text;
}

static int draw(rng *r, dp_model model, quantity_kind kind, question *q) {
    static const char *const formats[] = {"fp16", "fp32", "unorm16", "unorm24", "unorm24", "unorm8", "float4.6"};
    dp_format found[2];
    dp_spec spec = dp_spec_default();
    dp_format_parse(formats[rng_below(r, sizeof formats / sizeof formats[0])], found);
    spec.format = found[0];
    spec.model = model;
    spec.mapping = (dp_mapping)rng_below(r, model == DP_MODEL_FLOAT ? 4 : DP_MAPPING_COUNT);
    spec.ortho = dp_mapping_get(spec.mapping)->ortho && rng_below(r, 5) == 0;
    spec.rounding = (dp_rounding)rng_below(r, DP_ROUNDING_COUNT);
    spec.arith = (dp_arith)rng_below(r, dp_arith_count());
    spec.znear = rng_log(r, 1e-2, 1e2);
    spec.zfar = spec.znear * rng_log(r, 1.5, 1e5);
    if (dp_mapping_get(spec.mapping)->far_infinite && !spec.ortho && rng_below(r, 3) == 0)
        spec.zfar = INFINITY;
    const int either_sign = spec.ortho && rng_below(r, 2);
    if (either_sign)
        rng_planes(r, &spec.znear, &spec.zfar);
    if (dp_setup_init(&q->setup, &spec) != DP_OK)
        return 0;
    q->kind = kind;
    q->hi = spec.zfar;
    if (either_sign) {
        q->lo = rng_below(r, 2) == 0 ? spec.znear : rng_depth(r, spec.znear, spec.zfar);
    } else {
        q->lo = rng_below(r, 2) == 0 ? spec.znear : spec.znear * rng_log(r, 1.0, 1.4);
    }
    const double end = either_sign ? q->hi : fmin(q->hi, 1e5 * q->lo);
    const double z = either_sign ? rng_depth(r, q->lo, end) : fmin(fmax(rng_log(r, q->lo, end), q->lo), end);
    q->limit = quantity_over(kind, &q->setup, z, z, NAN).value * rng_log(r, 0.7, 1.5);
    return q->limit > 0.0 && q->limit < INFINITY;
}

/* At a depth neither is above the bound over a range that holds it (bounds.h). */
static double at(const question *q, double z) {
    return q->kind == QUANTITY_ERROR ? fabs(dp_error(&q->setup, dp_code(&q->setup, z), z))
                                     : dp_separation(&q->setup, z);
}

/* By the C library, which rounds what it prints as it is told to. */
static void round_down(double value, int digits, char out[32]) {
    fesetround(FE_DOWNWARD);
    snprintf(out, 32, "%.*e", digits - 1, value);
    fesetround(FE_TONEAREST);
}

static void check_about(const question *q, const distance_answer *a, tally *about) {
    enum { DIGITS = 3 };
    const double cheap = distance_about(&q->setup, q->lo, q->hi, q->limit, DIGITS);
    char printed[32], wanted[32], text[320];
    round_down(cheap, DIGITS, printed);
    round_down(a->value, DIGITS, wanted);
    TALLY(about,
          !a->possible ? isnan(cheap)
                       : (a->throughout ? cheap <= a->value : cheap < a->fails) && strcmp(printed, wanted) == 0,
          "%s: %.17g, not %.17g", describe(q, text), cheap, a->value);
}

static void check_densely(const question *q, const distance_answer *a, tally *dense) {
    char text[320];
    describe(q, text);
    for (int k = 0; k <= 256; k++) {
        const double share = k / 256.0;
        const double probe =
            q->setup.spec.znear > 0 ? q->lo * pow(a->value / q->lo, share) : q->lo + (a->value - q->lo) * share;
        const double z = k == 256 ? a->value : fmin(fmax(probe, q->lo), a->value);
        TALLY(dense, at(q, z) <= q->limit, "%s: %.17g at %.17g, up to %.17g", text, at(q, z), z, a->value);
    }
}

static void in_model(dp_model model, quantity_kind kind, uint64_t cases) {
    rng r = rng_make(kind == QUANTITY_ERROR ? "distance error" : dp_model_name(model));
    tally whole = {.name = "the range up to the answer passes as check judges"};
    tally dense = {.name = "no depth up to the answer fails"};
    tally beyond = {.name = "beyond the answer it fails, next to it"};
    tally none = {.name = "impossible: it fails at the first depth"};
    tally about = {.name = "the cheaper answer has the same digits"};
    uint64_t throughout = 0;
    for (uint64_t i = 0; i < cases;) {
        question q;
        distance_answer a;
        char text[320];
        if (!draw(&r, model, kind, &q))
            continue;
        i++;
        describe(&q, text);
        if (distance_solve(kind, &q.setup, q.lo, q.hi, q.limit, &a) != DP_OK) {
            tally_fail(&whole, "%s: refused", text);
            continue;
        }
        if (kind == QUANTITY_SEPARATION)
            check_about(&q, &a, &about);
        if (!a.possible) {
            TALLY(&none, at(&q, q.lo) > q.limit, "%s: %.17g there", text, at(&q, q.lo));
            continue;
        }
        dp_separation_worst worst = {.bound = 0.0};
        dp_worst error = {.error = 0.0};
        if (kind == QUANTITY_ERROR && q.lo < a.value)
            dp_worst_over(&q.setup, q.lo, a.value, &error);
        else if (q.lo < a.value)
            dp_separation_over(&q.setup, q.lo, a.value, q.limit, &worst);
        TALLY(&whole, worst.bound <= q.limit && error.error <= q.limit && a.reached.passed, "%s: up to %.17g", text,
              a.value);
        check_densely(&q, &a, &dense);
        throughout += (uint64_t)a.throughout;
        if (a.throughout) {
            TALLY(&beyond, a.value == fmin(q.hi, 1e18) && isnan(a.fails), "%s: up to %.17g", text, a.value);
            continue;
        }
        /* Next to it: the next binary32 depth; staged and near 0, where it is certain not to, 2^-40 of the camera. */
        const double next = model == DP_MODEL_FLOAT ? (double)nextafterf((float)a.value, INFINITY) : a.value;
        const double most = fmax(fabs(q.setup.spec.znear), fmin(fabs(q.setup.spec.zfar), a.fails));
        const bool about_zero = model == DP_MODEL_STAGED && q.setup.spec.znear <= 0;
        const double behind = about_zero ? fmin(a.fails + most * 0x1p-40, q.hi) : a.fails;
        dp_separation_over(&q.setup, a.value, behind, q.limit, &worst);
        dp_worst_over(&q.setup, q.lo, a.fails, &error);
        TALLY(&beyond,
              a.fails > a.value && a.fails <= fmax(next, (double)nextafterf((float)next, INFINITY)) &&
                  (kind == QUANTITY_ERROR ? error.error > q.limit : worst.bound > q.limit),
              "%s: %.17g passes, said to fail after %.17g", text, a.fails, a.value);
    }
    printf("# %s: %llu questions, %llu hold throughout, %llu not at all\n", dp_model_name(model),
           (unsigned long long)cases, (unsigned long long)throughout, (unsigned long long)none.cases);
    tally_end(&whole);
    tally_end(&dense);
    tally_end(&beyond);
    if (kind == QUANTITY_SEPARATION)
        tally_end(&about);
    if (none.cases > 0)
        tally_end(&none);
}

TEST(test_fp32) {
    in_model(DP_MODEL_FLOAT, QUANTITY_SEPARATION, test_cases(50, 500, 10000));
}

TEST(test_staged) {
    in_model(DP_MODEL_STAGED, QUANTITY_SEPARATION, test_cases(50, 500, 10000));
}

TEST(test_exact) {
    in_model(DP_MODEL_EXACT, QUANTITY_SEPARATION, test_cases(100, 1000, 20000));
}

TEST(test_error) {
    in_model(DP_MODEL_EXACT, QUANTITY_ERROR, test_cases(20, 200, 2000));
    in_model(DP_MODEL_STAGED, QUANTITY_ERROR, test_cases(10, 100, 1000));
}

/* UNORM under a perspective: s = z g/(1 - g) with g = z kappa h, so z^2 kappa h + z S kappa h - S = 0. */
TEST(test_closed_form) {
    rng r = rng_make("distance closed form");
    tally close = {.name = "UNORM in the lattice: the root of a quadratic"};
    const uint64_t cases = test_cases(100, 2000, 20000);
    for (uint64_t i = 0; i < cases; i++) {
        static const char *const names[] = {"unorm8", "unorm16", "unorm24", "unorm32"};
        dp_format found[2];
        question q = {.kind = QUANTITY_SEPARATION};
        distance_answer a;
        char text[320];
        dp_spec spec = dp_spec_default();
        dp_format_parse(names[rng_below(&r, 4)], found);
        spec.format = found[0];
        spec.mapping = (dp_mapping)rng_below(&r, 4);
        spec.znear = q.lo = rng_log(&r, 1e-3, 10.0);
        spec.zfar = q.hi = rng_below(&r, 3) == 0 ? INFINITY : spec.znear * rng_log(&r, 2.0, 1e6);
        const long double kappa = 1.0L / spec.znear - (isinf(spec.zfar) ? 0.0L : 1.0L / spec.zfar);
        const long double kh = kappa / (long double)spec.format.code_max;
        const double z = rng_log(&r, spec.znear, fmin(spec.zfar, 1e6 * spec.znear));
        const long double g = (long double)z * kh;
        if (g > 0.9L || dp_setup_init(&q.setup, &spec) != DP_OK)
            continue;
        q.limit = (double)((long double)z * g / (1.0L - g));
        const long double s = (long double)q.limit;
        const long double root = 2.0L * s / (s * kh + sqrtl(s * kh * s * kh + 4.0L * kh * s));
        const long double want = root < (long double)q.lo ? (long double)q.lo : root;
        const int solved = distance_solve(q.kind, &q.setup, q.lo, q.hi, q.limit, &a) == DP_OK;
        TALLY(&close,
              solved && (!a.possible ? root < (long double)q.lo * (1.0L + 1e-12L)
                                     : fabsl((long double)fmin(a.value, spec.zfar) / want - 1.0L) < 1e-12L),
              "%s: %.17g, not %.17Lg", describe(&q, text), a.value, want);
    }
    tally_end(&close);
}

enum { SPANS = 32 };

/* Within a span it holds, and next to its ends it does not; of the depths drawn elsewhere hardly any passes. */
static void check_spans(const question *q, const distance_answer *a, rng *r, tally *inside, tally *outside) {
    distance_span span[SPANS];
    char text[320];
    const double after = a->possible ? a->value : q->lo, end = fmin(fmin(q->hi, 1e18), 64 * after);
    const bool whole = q->setup.spec.model == DP_MODEL_FLOAT;
    const size_t count = distance_again(&q->setup, after, q->hi, q->limit, span, SPANS);
    describe(q, text);
    for (size_t i = 0; i < count; i++) {
        const double before = whole ? (double)nextafterf((float)span[i].lo, 0) : span[i].lo * (1 - 0x1p-44);
        const double behind = whole ? (double)nextafterf((float)span[i].hi, INFINITY) : span[i].hi * (1 + 0x1p-40);
        TALLY(inside, span[i].lo > (i > 0 ? span[i - 1].hi : after) && span[i].hi > span[i].lo && span[i].hi <= q->hi,
              "%s: %.17g to %.17g", text, span[i].lo, span[i].hi);
        for (int k = 0; k <= 64; k++) {
            const double z = fmin(span[i].lo * pow(span[i].hi / span[i].lo, k / 64.0), span[i].hi);
            TALLY(inside, at(q, z) <= q->limit, "%s: %.17g at %.17g of %.17g to %.17g", text, at(q, z), z, span[i].lo,
                  span[i].hi);
        }
        /* staged goes up and down with each rounding: there a bisection ends at one of many ends */
        TALLY(inside, q->setup.spec.model == DP_MODEL_STAGED || at(q, before) > q->limit, "%s: passes before %.17g",
              text, span[i].lo);
        TALLY(inside, q->setup.spec.model == DP_MODEL_STAGED || behind > q->hi || at(q, behind) > q->limit,
              "%s: passes behind %.17g", text, span[i].hi);
    }
    for (int k = 0; k < 200 && after < end; k++) {
        const double z = fmin(rng_log(r, after, end), end);
        const double it = whole ? (double)(float)z : z;
        bool known = it <= after * (1 + 0x1p-20) || it > end || at(q, it) > q->limit * 0.999;
        for (size_t i = 0; i < count; i++)
            known = known || (it >= span[i].lo && it <= span[i].hi);
        outside->cases++;
        outside->skipped += !known;
    }
}

TEST(test_again) {
    static const dp_model models[] = {DP_MODEL_EXACT, DP_MODEL_STAGED, DP_MODEL_FLOAT};
    rng r = rng_make("distance again");
    tally inside = {.name = "spans hold, and end"}, outside = {.name = "elsewhere"};
    const uint64_t cases = test_cases(60, 600, 6000);
    for (uint64_t i = 0; i < cases;) {
        question q;
        distance_answer a;
        if (!draw(&r, models[i % 3], QUANTITY_SEPARATION, &q) ||
            distance_solve(q.kind, &q.setup, q.lo, q.hi, q.limit, &a) != DP_OK || a.throughout)
            continue;
        i++;
        check_spans(&q, &a, &r, &inside, &outside);
    }
    assert_true(inside.cases > 0);
    tally_end(&inside);
    /* A span so short that no depth of it was tried: a depth in five thousand. */
    assert_true(outside.cases > 0 && outside.skipped * 5000 <= outside.cases);
}

/* No depth so near 0 that rounding hides how they differ is certain: little is asked of them. Else it takes
 * hours. */
TEST(test_next_to_zero) {
    distance_span span[8];
    distance_answer a;
    dp_separation_worst worst;
    dp_setup setup;
    dp_format format[2];
    dp_spec spec = dp_spec_default();
    spec.znear = 0.0;
    spec.zfar = 0x1.53b510c69f821p+1;
    spec.ortho = 1;
    spec.mapping = DP_MAPPING_REVERSED;
    spec.rounding = DP_ROUND_ZERO;
    spec.model = DP_MODEL_STAGED;
    assert_int_equal(dp_format_parse("fp32", format), 1);
    spec.format = format[0];
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    const double limit = 0x1.86aa77b50d68fp-22, lo = 0x1.ab87b087e0227p-339;
    assert_int_equal(distance_solve(QUANTITY_SEPARATION, &setup, lo, spec.zfar, limit, &a), DP_OK);
    assert_false(a.possible);
    const size_t count = distance_again(&setup, lo, spec.zfar, limit, span, 8);
    for (size_t i = 0; i < count; i++) {
        assert_int_equal(dp_separation_over(&setup, span[i].lo, span[i].hi, limit, &worst), DP_OK);
        assert_true(worst.bound <= limit);
    }
}

TEST(test_door) {
    distance_answer a;
    dp_setup setup;
    dp_spec spec = dp_spec_default();
    spec.model = DP_MODEL_FLOAT;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    assert_int_equal(distance_solve(QUANTITY_SEPARATION, NULL, 1.0, 2.0, 0.1, &a), DP_ERROR_NULL);
    assert_int_equal(distance_solve(QUANTITY_SEPARATION, &setup, 1.0, 2.0, 0.1, NULL), DP_ERROR_NULL);
    assert_int_equal(distance_solve(QUANTITY_ERROR, &setup, 1.0, 2.0, 0.1, &a), DP_ERROR_MODEL);
    assert_int_equal(distance_solve(QUANTITY_SEPARATION, &setup, 0.01, 2.0, 0.1, &a), DP_ERROR_RANGE);
    assert_int_equal(distance_solve(QUANTITY_SEPARATION, &setup, 1.0, 2000.0, 0.1, &a), DP_ERROR_RANGE);
    assert_int_equal(distance_solve(QUANTITY_SEPARATION, &setup, 1.0, 2.0, 0.0, &a), DP_ERROR_RANGE);
    assert_int_equal(distance_solve(QUANTITY_SEPARATION, &setup, 1.0, 1.0, 10.0, &a), DP_OK);
    assert_true(a.possible && a.throughout && a.value == 1.0);
}
