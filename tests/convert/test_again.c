/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A prepass in another format: each copy of a code by rationals; all codes of 16 bits by a walk over boundaries that
 * are rationals too; and every window depth of random ranges, one by one, with the bias and without.
 */
#include "convert/again.h"
#include "oracle.h"
#include "support.h"

static uint32_t bits_of(float x) {
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static float number_of(uint32_t bits) {
    float x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

static dp_format named(const char *name) {
    dp_format f[2];
    assert_int_equal(dp_format_parse(name, f), 1);
    return f[0];
}

/* A number of one format, rounded to another. */
static uint32_t copy_of(const again_request *q, uint32_t code) {
    mpq_t value;
    mpq_init(value);
    oracle_value(value, &q->stored, code);
    const uint32_t to = mpq_cmp_ui(value, 1, 1) >= 0
                            ? q->drawn.code_max
                            : oracle_round(&q->drawn, q->rounding, mpq_numref(value), mpq_denref(value));
    mpq_clear(value);
    return to;
}

static uint32_t code_at(const again_request *q, const dp_format *f, uint32_t bits) {
    return oracle_encode(f, q->rounding, (double)number_of(bits));
}

static dp_format some_format(rng *r, bool stored) {
    static const char *const names[] = {"fp16", "unorm16", "unorm24", "float4.20b15", "unorm8", "fp32", "unorm32"};
    const uint64_t i = rng_below(r, stored ? 9 : 10);
    if (i < (stored ? 5 : 7))
        return named(names[i]);
    if (rng_below(r, 2) == 0)
        return oracle_unorm(1 + (int)rng_below(r, stored ? 24 : 32));
    const int e = 2 + (int)rng_below(r, 7);
    return oracle_float(e, 1 + (int)rng_below(r, stored ? 15 : 23),
                        1 + (int)rng_below(r, e == 8 ? 140 : (1U << e) - 1));
}

TEST(copies) {
    rng r = rng_make("copies");
    tally t = {.name = "copies"};
    for (uint64_t i = test_cases(20000, 200000, 1000000); i > 0; i--) {
        const again_request q = {.stored = some_format(&r, false),
                                 .drawn = some_format(&r, false),
                                 .rounding = (dp_rounding)rng_below(&r, DP_ROUNDING_COUNT)};
        const uint32_t code = (uint32_t)rng_below(&r, (uint64_t)q.stored.code_max + 1);
        TALLY(&t, again_copy(&q, code) == copy_of(&q, code), "%s to %s, %s, code %u: %u, not %u", q.stored.name,
              q.drawn.name, dp_rounding_name(q.rounding), code, again_copy(&q, code), copy_of(&q, code));
    }
    tally_end(&t);
}

/* ---- Every window depth of a range ------------------------------------------------------------------------------- */

static bool fails(const again_request *q, uint32_t code, uint32_t copy) {
    return q->reversed ? code < copy : code > copy;
}

/* The bits of the depth next to these whose code passes: codes rise with depths. */
static uint32_t passing(const again_request *q, uint32_t bits, uint32_t copy) {
    uint32_t bad = bits, good = q->reversed ? bits_of(1) : 0;
    while ((good > bad ? good - bad : bad - good) > 1) {
        const uint32_t middle = good > bad ? bad + (good - bad) / 2 : bad - (bad - good) / 2;
        if (fails(q, code_at(q, &q->drawn, middle), copy))
            bad = middle;
        else
            good = middle;
    }
    return good;
}

static double in_exponents(const dp_format *f, double bias, double depth) {
    const double least = ldexp(1, f->kind == DP_FORMAT_FLOAT ? 1 - f->bias : -126);
    return bias / exp2(floor(log2(fmax(depth, least))));
}

static again_found walked(const again_request *q) {
    again_found all = {.most_at = NAN};
    uint32_t before = 0, copy = 0;
    bool unequal = false, failing = false;
    double steepest = 0;
    for (uint32_t bits = bits_of(q->lo); bits <= bits_of(q->hi); bits++) {
        const uint32_t stored = code_at(q, &q->stored, bits), drawn = code_at(q, &q->drawn, bits);
        if (all.codes == 0 || stored != before) {
            copy = copy_of(q, stored);
            before = stored;
            unequal = failing = false;
            all.codes++;
        }
        all.unequal += drawn != copy && !unequal;
        unequal = unequal || drawn != copy;
        const uint32_t by = drawn > copy ? drawn - copy : copy - drawn;
        if (by > all.most)
            all.most = by, all.most_at = (double)number_of(bits);
        if (!fails(q, drawn, copy))
            continue;
        all.fails += !failing;
        failing = true;
        const double depth = (double)number_of(bits);
        const double bias = fabs((double)number_of(passing(q, bits, copy)) - depth);
        if (bias > all.widest.bias)
            all.widest = (again_gap){bias, depth};
        if (in_exponents(&q->drawn, bias, depth) > steepest) {
            steepest = in_exponents(&q->drawn, bias, depth);
            all.steepest = (again_gap){bias, depth};
        }
    }
    return all;
}

/* Next to where codes change, anywhere, or at an end. */
static void some_range(rng *r, again_request *q) {
    const uint32_t one = bits_of(1);
    const dp_format *f = rng_below(r, 2) == 0 ? &q->stored : &q->drawn;
    const uint32_t code = (uint32_t)rng_below(r, f->code_max);
    const double middle = 0.5 * (dp_format_value(f, code) + dp_format_value(f, code + 1));
    uint32_t from = bits_of((float)middle);
    const uint64_t kind = rng_below(r, 8);
    if (kind == 0)
        from = (uint32_t)rng_below(r, one);
    else if (kind == 1)
        from = (uint32_t)rng_below(r, 2) * one;
    else if (kind == 2)
        from = bits_of((float)exp2(-(double)rng_below(r, 30)));
    const uint32_t before = (uint32_t)rng_below(r, 600), behind = (uint32_t)rng_below(r, 600);
    q->lo = number_of(from > before ? from - before : 0);
    q->hi = number_of(from + behind < one ? from + behind : one);
}

/* How far a depth is from its copy. */
static uint32_t apart_at(const again_request *q, double depth) {
    const uint32_t bits = bits_of((float)depth);
    const uint32_t drawn = code_at(q, &q->drawn, bits), copy = copy_of(q, code_at(q, &q->stored, bits));
    return drawn > copy ? drawn - copy : copy - drawn;
}

static bool same_gap(const again_request *q, again_gap a, again_gap b, bool in_units) {
    return in_units ? in_exponents(&q->drawn, a.bias, a.depth) == in_exponents(&q->drawn, b.bias, b.depth)
                    : a.bias == b.bias;
}

TEST(every_depth_of_ranges) {
    rng r = rng_make("again");
    tally t = {.name = "ranges"};
    uint64_t failing = 0, holding = 0;
    for (uint64_t i = test_cases(100, 800, 8000); i > 0; i--) {
        again_request q = {.stored = some_format(&r, true),
                           .drawn = some_format(&r, false),
                           .rounding = (dp_rounding)rng_below(&r, DP_ROUNDING_COUNT),
                           .reversed = rng_below(&r, 2) == 0,
                           .threads = 1 + (int)rng_below(&r, 2)};
        if (rng_below(&r, 20) == 0)
            q.stored = named("fp32");
        some_range(&r, &q);
        const again_found got = again_all(&q), want = walked(&q);
        TALLY(
            &t,
            got.codes == want.codes && got.unequal == want.unequal && got.fails == want.fails &&
                got.most == want.most && (got.most == 0 || apart_at(&q, got.most_at) == got.most) &&
                same_gap(&q, got.widest, want.widest, false) && same_gap(&q, got.steepest, want.steepest, true),
            "%s to %s, %s, reversed %d, %.9g to %.9g: codes %llu %llu, unequal %llu %llu, fails %llu %llu, most %u %u "
            "at %.9g %.9g, bias %.9g %.9g, steepest %.9g at %.9g, not %.9g at %.9g",
            q.stored.name, q.drawn.name, dp_rounding_name(q.rounding), q.reversed, (double)q.lo, (double)q.hi,
            (unsigned long long)got.codes, (unsigned long long)want.codes, (unsigned long long)got.unequal,
            (unsigned long long)want.unequal, (unsigned long long)got.fails, (unsigned long long)want.fails, got.most,
            want.most, got.most_at, want.most_at, got.widest.bias, want.widest.bias, got.steepest.bias,
            got.steepest.depth, want.steepest.bias, want.steepest.depth);
        failing += want.fails > 0;
        holding += want.unequal == 0;
    }
    assert_true(failing > 0 && holding > 0);
    tally_end(&t);
}

/* ---- All codes of 16 bits ---------------------------------------------------------------------------------------- */

/* The bits of the greatest binary32 number that is stored as a code or one below: its boundary, rounded down. */
static uint32_t last_at(const again_request *q, const dp_format *f, uint32_t code, mpq_t boundary) {
    if (code == f->code_max)
        return bits_of(1);
    oracle_boundary(boundary, f, q->rounding, code + 1);
    uint32_t bits = bits_of((float)mpq_get_d(boundary)) + 2;
    while (code_at(q, f, bits) > code)
        bits--;
    return bits;
}

static void check_all(tally *t, const char *stored, const char *drawn, bool reversed, dp_rounding rounding) {
    const again_request q = {
        .stored = named(stored), .drawn = named(drawn), .rounding = rounding, .lo = 0, .hi = 1, .reversed = reversed};
    again_found want = {.codes = 0};
    mpq_t boundary;
    mpq_init(boundary);
    uint32_t lo = 0;
    for (uint32_t code = 0; code <= q.stored.code_max; code++) {
        const uint32_t hi = last_at(&q, &q.stored, code, boundary), copy = copy_of(&q, code);
        const uint32_t first = code_at(&q, &q.drawn, lo), last = code_at(&q, &q.drawn, hi);
        const uint32_t at = reversed ? lo : hi;
        want.codes++;
        want.unequal += first != copy || last != copy;
        if (fails(&q, reversed ? first : last, copy)) {
            const uint32_t limit =
                reversed ? last_at(&q, &q.drawn, copy - 1, boundary) + 1 : last_at(&q, &q.drawn, copy, boundary);
            want.fails++;
            want.widest.bias = fmax(want.widest.bias, fabs((double)number_of(at) - (double)number_of(limit)));
        }
        lo = hi + 1;
    }
    mpq_clear(boundary);
    const again_found got = again_all(&q);
    TALLY(t,
          got.codes == want.codes && got.unequal == want.unequal && got.fails == want.fails &&
              got.widest.bias == want.widest.bias,
          "%s to %s, reversed %d: codes %llu %llu, unequal %llu %llu, fails %llu %llu, bias %.17g %.17g", stored, drawn,
          reversed, (unsigned long long)got.codes, (unsigned long long)want.codes, (unsigned long long)got.unequal,
          (unsigned long long)want.unequal, (unsigned long long)got.fails, (unsigned long long)want.fails,
          got.widest.bias, want.widest.bias);
}

TEST(all_codes) {
    static const char *const drawn[] = {"unorm16", "unorm24", "fp16", "fp32", "float4.20b15"};
    tally t = {.name = "all codes"};
    for (size_t i = 0; i < sizeof drawn / sizeof drawn[0]; i++)
        for (int k = 0; k < 4; k++)
            check_all(&t, k / 2 == 0 ? "unorm16" : "fp16", drawn[i], k % 2 == 1,
                      i == 1 ? DP_ROUND_ZERO : DP_ROUND_NEAREST);
    tally_end(&t);
}

/* ---- By hand ----------------------------------------------------------------------------------------------------- */

static again_found found(const char *stored, const char *drawn, bool reversed) {
    const again_request q = {.stored = named(stored), .drawn = named(drawn), .lo = 0, .hi = 1, .reversed = reversed};
    return again_all(&q);
}

/*
 * fp32 holds each window depth, and a format its own codes. A code of D16 stands for depths up to half a code beside
 * it: LEQUAL needs 1/131070 of window depth and, where a binary32 number is no code, up to a step of it more. Of D24
 * only a half of the codes holds two numbers from .5 to 1.
 */
TEST(by_hand) {
    assert_int_equal(found("fp32", "unorm16", false).unequal, 0);
    assert_int_equal(found("fp32", "unorm24", true).codes, 0x3F800001);
    assert_int_equal(found("unorm24", "unorm24", true).unequal, 0);
    const again_found f = found("unorm16", "fp32", false), g = found("unorm24", "fp32", false);
    assert_int_equal(f.codes, 65536);
    assert_int_equal(f.fails, 65535); /* not the last: no window depth is above 1 */
    assert_true(f.widest.bias > 1 / 131070.0 - 0x1p-24 && f.widest.bias <= 1 / 131070.0 + 0x1p-24);
    assert_int_equal(g.codes, 1 << 24);
    assert_true(g.widest.bias >= 0x1p-25 && g.widest.bias <= 0x1p-24);
    assert_true(again_fits(&(dp_format){.kind = DP_FORMAT_UNORM, .bits = 24, .code_max = 0xFFFFFF}));
    const dp_format large = named("unorm25"), fp32 = named("fp32");
    assert_true(!again_fits(&large) && again_fits(&fp32));
}
