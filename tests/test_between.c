/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A bound over all cameras whose near or far lies between two: where it says that all of them tell surfaces apart, no
 * camera that is looked at fails, those among them whose planes have few bits and are rounded to even; and where all
 * that are looked at do, it mostly says so.
 */
#include "core/engine.h"
#include "core/guarantee.h"
#include "depthprec/bounds.h"
#include "support.h"

typedef struct cameras {
    dp_spec spec;
    int far_moves;
    double from, to; /* of the plane that moves */
    double lo, hi;   /* depths */
    double limit;
} cameras;

static dp_status make(const cameras *c, double plane, dp_model model, dp_setup *out) {
    dp_spec spec = c->spec;
    spec.model = model;
    *(c->far_moves ? &spec.zfar : &spec.znear) = plane;
    return dp_setup_init(out, &spec);
}

static int passes(const cameras *c, double plane, dp_model model) {
    dp_setup setup;
    dp_separation_worst worst;
    if (make(c, plane, model, &setup) != DP_OK)
        return 0;
    if (c->lo == c->hi)
        return dp_separation(&setup, c->lo) <= c->limit;
    return dp_separation_over(&setup, c->lo, c->hi, c->limit, &worst) == DP_OK && worst.bound <= c->limit;
}

static int draw(rng *r, cameras *c) {
    static const char *const formats[] = {"fp32", "unorm24", "unorm16", "fp16"};
    dp_format found[2];
    dp_setup setup;
    dp_separation_worst worst = {0};
    *c = (cameras){.spec = dp_spec_default(), .far_moves = (int)rng_below(r, 2)};
    dp_format_parse(formats[rng_below(r, 4)], found);
    c->spec.format = found[0];
    do
        c->spec.mapping = (dp_mapping)rng_below(r, DP_MAPPING_COUNT);
    while (dp_mapping_get(c->spec.mapping)->curve != DP_CURVE_PERSPECTIVE);
    c->spec.arith = (dp_arith)rng_below(r, dp_arith_count());
    c->spec.ortho = rng_below(r, 5) == 0;
    c->spec.znear = rng_log(r, 1e-2, 1e2);
    c->spec.zfar = c->spec.znear * rng_log(r, 1.5, 1e5);
    if (!c->spec.ortho && rng_below(r, 4) == 0)
        c->spec.zfar = INFINITY;
    if (!c->spec.ortho && rng_below(r, 4) == 0) {
        c->spec.triangles = dp_triangles_default();
        c->spec.triangles.slant_lo = rng_uniform(r, 0.0, 80.0);
    }
    const double width = 1.0 + rng_log(r, 1e-7, 10.0);
    c->from = c->far_moves ? c->spec.zfar : c->spec.znear;
    if (isinf(c->from))
        c->from = c->spec.znear * rng_log(r, 1e2, 1e9);
    c->to = c->far_moves && isinf(c->spec.zfar) ? INFINITY : c->from * width;
    const double first = c->far_moves ? c->spec.znear : c->to, last = c->far_moves ? c->from : c->spec.zfar;
    if (first >= last)
        return 0;
    c->hi = rng_log(r, first, fmin(last, first * 1e6));
    c->lo = rng_below(r, 6) == 0 ? rng_log(r, first, c->hi) : c->hi;
    if (make(c, c->from, DP_MODEL_FLOAT, &setup) != DP_OK ||
        dp_separation_over(&setup, c->lo, c->hi, 0.0, &worst) != DP_OK)
        return 0;
    c->limit = worst.bound * rng_log(r, 0.7, 1.6);
    return isfinite(c->limit) && passes(c, c->from, DP_MODEL_EXACT) && passes(c, c->to, DP_MODEL_EXACT);
}

/* A plane between the two; every other one has few bits, so that what is rounded lies in the middle more often. */
static double between(rng *r, const cameras *c) {
    const double end = isinf(c->to) ? fmin(1e18, c->from * 1e9) : c->to;
    const double x = rng_below(r, 2) == 0 ? rng_log(r, c->from, end) : rng_uniform(r, c->from, end);
    const double grid = exp2(floor(log2(c->to - c->from < INFINITY ? c->to - c->from : x)) - (double)rng_below(r, 12));
    const double coarse = rint(x / grid) * grid;
    return rng_below(r, 2) == 0 && coarse >= c->from && coarse <= end ? coarse : x;
}

TEST(test_all) {
    rng r = rng_make("cameras between two");
    tally all = {.name = "of cameras that are said to tell apart what lies `limit` apart none fails"};
    uint64_t said = 0, could = 0, narrow = 0, narrow_said = 0;
    const uint64_t count = test_cases(1500, 6000, 100000);
    for (uint64_t i = 0; i < count;) {
        cameras c;
        dp_setup one, other;
        if (!draw(&r, &c) || make(&c, c.from, DP_MODEL_FLOAT, &one) != DP_OK ||
            make(&c, c.to, DP_MODEL_FLOAT, &other) != DP_OK)
            continue;
        i++;
        const int far_first = c.far_moves; /* the first of the two is that with less of the lattice */
        const int within =
            dp_separation_within(far_first ? &other : &one, far_first ? &one : &other, c.lo, c.hi, c.limit);
        int good = passes(&c, c.from, DP_MODEL_FLOAT) && passes(&c, c.to, DP_MODEL_FLOAT);
        double failed = c.from;
        for (int k = 0; k < (c.lo < c.hi ? 12 : 120) && good; k++) {
            failed = between(&r, &c);
            good = passes(&c, failed, DP_MODEL_FLOAT);
        }
        if (within)
            TALLY(&all, good, "%s %s%s near %.17g far %.17g, the %s one to %.17g: %.17g fails at %.17g..%.17g by %.17g",
                  c.spec.format.name, dp_mapping_get(c.spec.mapping)->name, c.spec.ortho ? " ortho" : "", c.spec.znear,
                  c.spec.zfar, c.far_moves ? "latter" : "former", c.to, failed, c.lo, c.hi, c.limit);
        const int is_narrow = c.to < c.from * 1.0005;
        said += (uint64_t)within;
        could += (uint64_t)good;
        narrow += (uint64_t)(good && is_narrow);
        narrow_said += (uint64_t)(good && is_narrow && within);
    }
    printf("# said of %llu of %llu where no camera was found to fail, of %llu of %llu narrow ones\n",
           (unsigned long long)said, (unsigned long long)could, (unsigned long long)narrow_said,
           (unsigned long long)narrow);
    tally_end(&all);
    assert_true(narrow_said * 10 > narrow * 9);
}

/* A run of depths of one binade: what is guaranteed of all of them is at least what is guaranteed of each. */
TEST(test_depths) {
    rng r = rng_make("depths of one binade");
    tally each = {.name = "what is guaranteed over a run of depths is at least the separation at each of them"};
    const uint64_t count = test_cases(4000, 20000, 400000);
    for (uint64_t i = 0; i < count;) {
        cameras c;
        dp_setup setup;
        if (!draw(&r, &c) || make(&c, c.to, DP_MODEL_FLOAT, &setup) != DP_OK)
            continue;
        i++;
        const dp_guarantee g = dp_guarantee_make(&setup);
        const double binade = exp2(floor(log2(c.lo)));
        const double end = fmin(nextafter(2.0 * binade, 0.0), fmin(setup.spec.zfar, 1e30));
        const float lo = (float)fmax(c.lo - (c.lo - binade) * rng_unit(&r), setup.spec.znear);
        const float hi =
            (float)fmin(rng_below(&r, 2) == 0 ? end : c.lo + (end - c.lo) * rng_unit(&r), end * (1 - 1e-7));
        if (!((double)lo >= setup.spec.znear && lo <= hi))
            continue;
        const double bound = dp_guarantee_bound(&g, lo, hi);
        for (int k = 0; k < 60; k++) {
            const double z = k == 0 ? (double)lo : k == 1 ? (double)hi : (double)(float)rng_uniform(&r, lo, hi);
            const double want = dp_guarantee_at(&g, z);
            dp_setup exact;
            make(&c, c.to, DP_MODEL_EXACT, &exact);
            TALLY(&each, want <= bound || want <= dp_separation(&exact, z) * (1 + 1e-12),
                  "%s %s%s near %.17g far %.17g %s: %.17g at %.17g, %.17g from %.9g to %.9g", c.spec.format.name,
                  dp_mapping_get(c.spec.mapping)->name, c.spec.ortho ? " ortho" : "", setup.spec.znear, setup.spec.zfar,
                  dp_arith_get(c.spec.arith)->name, want, z, bound, (double)lo, (double)hi);
        }
    }
    tally_end(&each);
}

/* What has no matrix, no entry of one sign, or another model: nothing is said. */
TEST(test_nothing) {
    dp_spec spec = dp_spec_default();
    dp_setup one, other;
    spec.model = DP_MODEL_STAGED;
    assert_int_equal(dp_setup_init(&one, &spec), DP_OK);
    assert_int_equal(dp_separation_within(&one, &one, 10.0, 10.0, 5.0), 0);
    spec.model = DP_MODEL_FLOAT;
    assert_int_equal(dp_setup_init(&one, &spec), DP_OK);
    assert_int_equal(dp_separation_within(&one, &one, 10.0, 10.0, 5.0), 1);
    spec.ortho = 1;
    spec.znear = -1.0;
    assert_int_equal(dp_setup_init(&one, &spec), DP_OK);
    spec.znear = 1.0;
    assert_int_equal(dp_setup_init(&other, &spec), DP_OK);
    assert_int_equal(dp_separation_within(&one, &other, 10.0, 10.0, 5.0), 0);
}
