/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The rows of every method family, what is measured at one camera, and the choice by claims. */
#include "method/choose.h"
#include "method/stability.h"
#include "method/truth.h"
#include "named.h"
#include "support.h"

TEST(every_row_is_whole) {
    size_t rows = 0;
    for (; method_get(rows) != NULL; rows++) {
        const method_row *row = method_get(rows);
        const method_family_row *family = method_family_get(row->family);
        bool speaks = false;
        assert_true(row->name[0] != '\0' && row->note[0] != '\0' && row->cost_class[0] != '\0' && row->source != NULL);
        assert_true(row->cost > 0 && row->run != NULL && (row->open == NULL) == (row->close == NULL));
        for (size_t i = 0; i < METHOD_CASES; i++) {
            const method_claim *c = &row->claims[i];
            if (!method_speaks(row, i))
                continue;
            assert_true(i < family->case_count);
            assert_true(isnan(c->worst) || c->worst > 0);
            assert_true(c->ratio_lo >= METHOD_RATIO_LO && c->ratio_lo < c->ratio_hi && c->ratio_hi <= METHOD_RATIO_HI);
            speaks = true;
        }
        assert_true(speaks);
        for (size_t k = 0; k < rows; k++)
            assert_true(method_get(k)->family != row->family || strcmp(method_get(k)->name, row->name) != 0);
    }
    assert_true(rows > 30);
    /* The worst of a formula over a span is at an end of it, as method.h says. */
    for (size_t r = 0; r < rows; r++)
        for (size_t i = 0; i < METHOD_CASES; i++) {
            const method_claim *c = &method_get(r)->claims[i];
            double least = (double)INFINITY, last = least;
            for (int k = 0; k <= 440 && c->formula != NULL; k++) {
                double claim = method_claim_at(c, METHOD_RATIO_LO * pow(10, k / 40.0));
                assert_true(claim > 0 && (claim >= last || last <= least));
                least = fmin(least, claim);
                last = claim;
            }
        }
    for (size_t i = 0; method_family_get(i) != NULL; i++)
        assert_ptr_equal(method_family_find(method_family_get(i)->name), method_family_get(i));
    assert_null(method_family_find("areas"));
}

/* Ranges to be searched lie in the view. In each four one is the whole view and one ends at far alone; the others are
 * between two depths, at no plane, and no two are alike. */
TEST(ranges_of_worst) {
    const method_family_row *family = method_family_find("worst");
    for (size_t which = 0; which < family->case_count; which++)
        for (int k = 0; k < 3; k++) {
            dp_spec spec = {.mapping = family->cases[which].mapping, .znear = 0.1};
            spec.zfar = k == 0 ? 1000.0 : k == 1 ? 0.4 : INFINITY;
            dp_format format[2];
            assert_int_equal(dp_format_parse(family->cases[which].format, format), 1);
            spec.format = format[0];
            method_inputs in;
            method_outputs out;
            dp_setup setup;
            if (dp_setup_init(&setup, &spec) != DP_OK)
                continue;
            assert_true(method_arrays(family->inputs, &in, &out));
            family->fill(&setup, &in);
            const double f = k == 2 ? 0.1 * METHOD_INFINITE_FAR : spec.zfar;
            for (size_t i = 0; i < in.count; i++) {
                const bool near = in.z[i] == 0.1, far = in.hi[i] == f;
                assert_true(in.z[i] >= 0.1 && in.hi[i] <= f && in.z[i] < in.hi[i]);
                assert_true(near == (i % 4 == 0) && far == (i % 4 <= 1));
                for (size_t j = 0; j < i && !near; j++)
                    assert_true(in.z[j] != in.z[i]);
            }
            method_arrays_free(&in, &out);
        }
}

/* A method that only --full shows is beaten in each case by one that costs less and claims no more, at any far/near. */
TEST(those_behind_are_beaten) {
    int behind = 0;
    for (size_t i = 0; method_get(i) != NULL; i++)
        for (size_t which = 0; method_get(i)->behind && which < METHOD_CASES; which++) {
            const method_row *row = method_get(i);
            bool beaten = !method_speaks(row, which);
            behind += !beaten;
            for (size_t k = 0; method_get(k) != NULL && !beaten; k++) {
                const method_row *other = method_get(k);
                beaten = other->family == row->family && other->cost < row->cost && method_speaks(other, which) &&
                         other->available == NULL;
                for (double ratio = METHOD_RATIO_LO; ratio <= METHOD_RATIO_HI; ratio *= 10)
                    beaten = beaten && method_claim_at(&other->claims[which], ratio) <=
                                           method_claim_at(&row->claims[which], ratio);
            }
            if (!beaten)
                fail_msg("%s is on the front of a case", row->name);
        }
    assert_int_equal(behind, 9);
}

/* Errors, twice: the same numbers; within the claim where one is made; families as wide as promised. */
TEST(errors_are_within_claims_and_repeat) {
    static bench_result first[BENCH_METHODS_MAX], second[BENCH_METHODS_MAX];
    tally t = {.name = "bench"};
    for (size_t f = 0; f < METHOD_FAMILY_COUNT; f++) {
        const method_family_row *family = method_family_get(f);
        for (size_t which = 0; which < family->case_count; which++) {
            dp_setup setup;
            assert_int_equal(method_setup(family, which, 0.1, 1000, false, &setup), DP_OK);
            size_t count = bench_run(family, which, &setup, 0, first);
            assert_int_equal(bench_run(family, which, &setup, 0, second), count);
            for (size_t i = 0; i < count; i++) {
                double error = measured_error(family, &first[i].measured);
                TALLY(&t, error == measured_error(family, &second[i].measured), "%s: not the same error twice",
                      first[i].row->name);
                TALLY(&t, isnan(first[i].claim) || error <= first[i].claim, "%s, %s: error %g above the claim %g",
                      first[i].row->name, family->cases[which].name, error, first[i].claim);
                TALLY(&t, isnan(first[i].ns) && first[i].measured.count > 0, "%s: timed or not measured",
                      first[i].row->name);
                const method_error *worst = &first[i].measured.worst; /* of normals, an angle in three units */
                const double degrees = worst->relative * 180 / 3.14159265358979323846;
                TALLY(&t,
                      f != METHOD_NORMAL || (fabs(worst->absolute - degrees) <= 1e-12 * degrees &&
                                             fabs(worst->ulp * 0x1p-24 - worst->relative) <= 1e-12 * worst->relative),
                      "%s: %g degrees, %g radians", first[i].row->name, worst->absolute, worst->relative);
            }
        }
    }
    tally_end(&t);
}

/* Ways to a place that are for orthographic cameras are measured with one. */
TEST(orthographic_places) {
    static bench_result results[BENCH_METHODS_MAX];
    const method_family_row *family = method_family_find("position");
    size_t ways = 0;
    dp_setup setup;
    assert_int_equal(method_setup(family, 0, 0.1, 1000, true, &setup), DP_OK);
    const size_t count = bench_run(family, 0, &setup, 0, results);
    for (size_t i = 0; i < count; i++) {
        const bool is_for = results[i].row->position->ortho;
        if ((results[i].measured.count > 0) != is_for || (is_for && !(results[i].measured.worst.relative < 0.1)))
            fail_msg("%s: %g of %zu places", results[i].row->name, results[i].measured.worst.relative,
                     (size_t)results[i].measured.count);
        ways += is_for;
    }
    assert_true(ways > 0);
}

/* Relative errors of linearization at 0.1 to 1000, measured elsewhere against 128-bit arithmetic. */
TEST(linearize_errors_are_the_published_ones) {
    static const struct {
        const char *name;
        double lo, hi;
    } known[] = {
        {"unity", 4.0e-4, 7.7e-4},  {"textbook", 4.5e-4, 5.5e-4},      {"complement", 1.5e-7, 2.4e-7},
        {"double", 5.9e-8, 6.0e-8}, {"table-nearest", 7.5e-2, 7.7e-2}, {"table-linear", 5.0e-3, 5.2e-3},
        {"spline", 0.31, 0.33},     {"chebyshev", 0.73, 0.75},         {"pair", 5.9e-8, 6.0e-8},
    };
    const method_family_row *family = method_family_find("linearize");
    bench_result results[BENCH_METHODS_MAX];
    dp_setup setup;
    tally t = {.name = "published"};
    assert_int_equal(method_setup(family, 0, 0.1, 1000, false, &setup), DP_OK);
    size_t count = bench_run(family, 0, &setup, 0, results);
    for (size_t k = 0; k < sizeof known / sizeof known[0]; k++)
        for (size_t i = 0; i < count; i++) {
            double error = results[i].measured.worst.relative;
            if (strcmp(results[i].row->name, known[k].name) == 0)
                TALLY(&t, error >= known[k].lo && error <= known[k].hi, "%s: %g", known[k].name, error);
        }
    assert_int_equal(t.cases, sizeof known / sizeof known[0]);
    tally_end(&t);
}

TEST(the_front_holds_no_beaten_method) {
    const method_family_row *family = method_family_find("linearize");
    bench_result r[BENCH_METHODS_MAX];
    dp_setup setup;
    size_t front = 0;
    assert_int_equal(method_setup(family, 0, 0.1, 1000, false, &setup), DP_OK);
    size_t count = bench_run(family, 0, &setup, 3, r);
    double least = (double)INFINITY, most = 0;
    for (size_t i = 0; i < count; i++) {
        assert_true(r[i].ns > 0);
        least = fmin(least, r[i].measured.worst.relative);
        most = fmax(most, r[i].measured.worst.relative);
        front += r[i].front;
        for (size_t k = 0; k < count && r[i].front; k++)
            assert_false(r[k].ns < r[i].ns && r[k].measured.worst.relative < r[i].measured.worst.relative);
    }
    assert_true(front >= 2 && count >= 8);
    assert_true(most / least > 1e6);
}

/* The widest of many codes is at an end of those with one step: as among all of them. */
TEST(widest_of_many_codes) {
    static const char *const formats[] = {"unorm24", "fp32"};
    tally t = {.name = "widest"};
    for (int i = 0; i < 40; i++) {
        const method_family_row *family = method_family_find("worst");
        const size_t which = (size_t)i % 2;
        size_t of = 0;
        while (strcmp(family->cases[of].format, formats[which]) != 0)
            of++;
        dp_setup setup;
        assert_int_equal(method_setup(family, of, 0.1, 0.1 * pow(10, 1 + i % 9), i % 5 == 4, &setup), DP_OK);
        const uint32_t most = setup.spec.format.code_max;
        const uint32_t count = (1u << 17) + (uint32_t)(method_unit(61, (uint64_t)i) * (1 << 17));
        const uint32_t first = (uint32_t)(method_unit(62, (uint64_t)i) * (most - count)), last = first + count;
        double want = 0;
        bool cut;
        for (uint32_t code = first; code <= last; code++)
            want = fmax(want, truth_width(&setup, code, &cut));
        TALLY(&t, truth_worst(&setup, first, last) == want, "%s, codes %u to %u: %g, not %g", formats[which], first,
              last, truth_worst(&setup, first, last), want);
    }
    tally_end(&t);
}

static const char *chosen(const char *family, size_t which, method_wish wish) {
    const method_row *row = method_choose(method_family_find(family), which, &wish);
    return row != NULL ? row->name : "";
}

TEST(the_choice_is_the_cheapest_that_covers) {
    method_wish w = {.tolerance = 1e-2, .ratio_lo = 10, .ratio_hi = 1e4};
    assert_string_equal(chosen("linearize", 0, w), "magic");
    w.tolerance = 1e-6;
    w.ratio_hi = 1e12;
    assert_true(strncmp(chosen("linearize", 0, w), "complement", 10) == 0);
    w.ratio_hi = (double)INFINITY;
    assert_string_equal(chosen("linearize", 0, w), "complement-unity");
    w.tolerance = 1e-7;
    assert_string_equal(chosen("linearize", 0, w), "phi-double");
    w.tolerance = 1e-9;
    assert_string_equal(chosen("linearize", 0, w), "");
    w = (method_wish){.tolerance = 0.2, .ratio_lo = 100, .ratio_hi = 1e5};
    assert_string_equal(chosen("interval", 0, w), "rule-of-thumb");
    w.cut_cells = true;
    assert_string_equal(chosen("interval", 0, w), "cell");
    w.pipeline = true;
    assert_string_equal(chosen("interval", 0, w), "census");
}

/* Whether a row is proven good enough for a wish, by what each field of either says. */
static bool is_covering(const method_row *row, size_t which, const method_wish *w) {
    const method_claim *c = &row->claims[which];
    const bool infinite = isinf(w->ratio_hi), whole = (row->domain & METHOD_WHOLE) != 0;
    const bool flat = (row->domain & METHOD_FLAT) != 0, ortho = (row->domain & METHOD_ORTHO) != 0;
    if (!method_available(row) || !(c->worst > 0) || c->ratio_lo > w->ratio_lo)
        return false;
    if (c->ratio_hi < (infinite ? METHOD_RATIO_HI : w->ratio_hi))
        return false;
    if (infinite && (row->domain & METHOD_INFINITE) == 0)
        return false;
    if ((w->ortho && !ortho) || (!w->ortho && flat) || (w->cut_cells && whole))
        return false;
    return w->pipeline == ((row->domain & METHOD_PIPELINE) != 0) &&
           method_claim_over(c, w->ratio_lo, w->ratio_hi) <= w->tolerance;
}

/* The choice covers, and no cheaper row that covers is passed over. */
TEST(no_choice_is_beyond_its_row) {
    tally t = {.name = "choice"};
    rng r = rng_make("wishes");
    size_t infinite = 0, ortho = 0, cut = 0, pipeline = 0;
    for (int k = 0; k < 4000; k++) {
        const method_family_row *family = method_family_get((size_t)k % METHOD_FAMILY_COUNT);
        const size_t which = (size_t)rng_below(&r, family->case_count);
        const method_wish wish = {.tolerance = rng_log(&r, 1e-8, 10),
                                  .ratio_lo = rng_log(&r, 1.001, 1e4),
                                  .ratio_hi = rng_below(&r, 3) == 0 ? (double)INFINITY : rng_log(&r, 1e4, 1e12),
                                  .ortho = rng_below(&r, 3) == 0,
                                  .cut_cells = rng_below(&r, 3) == 0,
                                  .pipeline = rng_below(&r, 4) == 0};
        const method_row *row = method_choose(family, which, &wish);
        TALLY(&t, row == NULL || is_covering(row, which, &wish), "%s does not cover", row->name);
        for (size_t i = 0; i < *family->method_count; i++) {
            const method_row *other = &family->methods[i];
            TALLY(&t, !is_covering(other, which, &wish) || (row != NULL && row->cost <= other->cost), "%s passed over",
                  other->name);
        }
        infinite += row != NULL && isinf(wish.ratio_hi);
        ortho += row != NULL && wish.ortho;
        cut += row != NULL && wish.cut_cells;
        pipeline += row != NULL && wish.pipeline;
    }
    assert_true(infinite > 50 && ortho > 50 && cut > 50 && pipeline > 5);
    tally_end(&t);
}

/* A code beyond the last is no answer, however near its value would be. */
TEST(test_codes_that_there_are_not) {
    const method_family_row *family = method_family_find("encode");
    dp_spec spec = {.znear = 0.1, .zfar = 1000, .log_c = 1};
    dp_format formats[2];
    dp_setup setup;
    float d = 1.0f;
    assert_int_equal(dp_format_parse("unorm16", formats), 1);
    spec.format = formats[0];
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    for (uint32_t code = 65535; code < 65538; code++) {
        uint32_t given = code;
        method_error error;
        const method_inputs in = {.count = 1, .d = &d};
        method_outputs out = {.code = &given};
        assert_true(family->judge(&(method_call){NULL, &setup, NULL, &in, &out}, 0, &error));
        assert_true(code > 65535 ? isinf(error.ulp) : error.ulp == 0);
    }
}
