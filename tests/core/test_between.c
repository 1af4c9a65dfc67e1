/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A bound over all cameras whose near or far lies between two: where it says that all of them tell surfaces apart, or
 * keep an error, no camera that is looked at fails, those among them whose planes have few bits and are rounded to
 * even; and where all that are looked at do, it mostly says so. Of the models exact and staged the codes are an
 * oracle's.
 */
#include "core/engine.h"
#include "core/guarantee.h"
#include "depthprec/bounds.h"
#include "oracle.h"
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
    const int shader = model == DP_MODEL_FLOAT && dp_mapping_get(spec.mapping)->curve == DP_CURVE_LOG;
    spec.model = shader ? DP_MODEL_STAGED : model;
    *(c->far_moves ? &spec.zfar : &spec.znear) = plane;
    const dp_status status = dp_setup_init(out, &spec);
    if (status == DP_OK && shader)
        *out = dp_setup_guaranteed(out);
    return status;
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

/* Cameras of a curve; where near is that of a shader, its camera begins at it more often than not. */
static int draw(rng *r, cameras *c, int logarithm) {
    static const char *const formats[] = {"fp32", "unorm24", "unorm16", "fp16"};
    dp_format found[2];
    dp_setup setup;
    dp_separation_worst worst = {0};
    *c = (cameras){.spec = dp_spec_default(), .far_moves = (int)rng_below(r, 2)};
    dp_format_parse(formats[rng_below(r, 4)], found);
    c->spec.format = found[0];
    do
        c->spec.mapping = (dp_mapping)rng_below(r, DP_MAPPING_COUNT);
    while (dp_mapping_get(c->spec.mapping)->curve != (logarithm ? DP_CURVE_LOG : DP_CURVE_PERSPECTIVE));
    c->spec.log_c = rng_log(r, 1e-2, 1e2);
    c->spec.arith = (dp_arith)rng_below(r, dp_arith_count());
    c->spec.ortho = !logarithm && rng_below(r, 5) == 0;
    c->spec.znear = rng_log(r, 1e-2, 1e2);
    c->spec.zfar = c->spec.znear * rng_log(r, 1.5, 1e5);
    if (!logarithm && !c->spec.ortho && rng_below(r, 4) == 0)
        c->spec.zfar = INFINITY;
    if (!logarithm && !c->spec.ortho && rng_below(r, 4) == 0) {
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

static void in_curve(int logarithm) {
    rng r = rng_make(logarithm ? "shaders between two" : "cameras between two");
    tally all = {.name = "of cameras that are said to tell apart what lies `limit` apart none fails"};
    uint64_t said = 0, could = 0, narrow = 0, narrow_said = 0;
    const uint64_t count = test_cases(1500, 6000, 100000);
    for (uint64_t i = 0; i < count;) {
        cameras c;
        dp_setup one, other;
        if (!draw(&r, &c, logarithm) || make(&c, c.from, DP_MODEL_FLOAT, &one) != DP_OK ||
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

TEST(test_all) {
    in_curve(0);
}

TEST(test_shaders) {
    in_curve(1);
}

/* The error of a shader's stored depth, in each camera of a run. */
TEST(test_shader_errors) {
    rng r = rng_make("errors of shaders between two");
    tally all = {.name = "no shader's error is above that of its run"};
    tally tight = {.name = "the error of a narrow run is nearly that of its ends"};
    const uint64_t count = test_cases(500, 3000, 50000);
    for (uint64_t i = 0; i < count;) {
        cameras c;
        dp_setup one, other, here;
        double z;
        if (!draw(&r, &c, 1) || make(&c, c.from, DP_MODEL_FLOAT, &one) != DP_OK ||
            make(&c, c.to, DP_MODEL_FLOAT, &other) != DP_OK)
            continue;
        i++;
        const double bound =
            dp_shader_error_between(c.far_moves ? &other : &one, c.far_moves ? &one : &other, c.lo, c.hi);
        for (int k = 0; k < 20; k++)
            if (make(&c, k == 0 ? c.from : k == 1 ? c.to : between(&r, &c), DP_MODEL_FLOAT, &here) == DP_OK)
                TALLY(&all, dp_computed_error_over(&here, c.lo, c.hi, &z) <= bound, "%s near %.17g far %.17g",
                      dp_mapping_get(c.spec.mapping)->name, here.spec.znear, here.spec.zfar);
        const double ends =
            fmax(dp_computed_error_over(&one, c.lo, c.hi, &z), dp_computed_error_over(&other, c.lo, c.hi, &z));
        if (c.to < c.from * (1.0 + 1e-5) && c.hi < 0.9 * fmin(one.spec.zfar, other.spec.zfar))
            TALLY(&tight, bound <= 1.3 * ends, "%s near %.17g far %.17g: %.17g above %.17g",
                  dp_mapping_get(c.spec.mapping)->name, one.spec.znear, one.spec.zfar, bound, ends);
    }
    tally_end(&all);
    tally_end(&tight);
}

/* ---- The models exact and staged, by an oracle ------------------------------------------------------------------- */

/* The code of a depth as the models are defined: rounded once, or as NDC depth, window depth and code. */
static uint32_t code_by_oracle(oracle *o, double z) {
    const dp_spec *spec = &o->spec;
    mpq_t d;
    if (spec->model == DP_MODEL_EXACT)
        return oracle_code(o, z);
    mpq_init(d);
    oracle_window(o, d, z);
    const int is_signed = dp_mapping_get(spec->mapping)->ndc_signed;
    if (is_signed) {
        mpz_mul_2exp(mpq_numref(d), mpq_numref(d), 1);
        mpz_sub(mpq_numref(d), mpq_numref(d), mpq_denref(d));
    }
    const float x = (float)oracle_double(d), w = is_signed ? 0.5F * x + 0.5F : x;
    mpq_clear(d);
    return oracle_encode(&spec->format, spec->rounding, (double)w);
}

/* |stored - z|; INFINITY where no finite depth is stored so. */
static double error_by_oracle(oracle *o, uint32_t code, double z) {
    mpq_t value, stored;
    mpq_inits(value, stored, NULL);
    oracle_value(value, &o->spec.format, code);
    const double error = oracle_eye(o, stored, value) ? oracle_distance(z, stored) : INFINITY;
    mpq_clears(value, stored, NULL);
    return error;
}

static int draw_lattice(rng *r, cameras *c) {
    static const char *const formats[] = {"fp32", "fp16", "unorm8", "unorm16", "unorm24", "float4.6"};
    dp_format found[2];
    *c = (cameras){.spec = dp_spec_default(), .far_moves = (int)rng_below(r, 2)};
    dp_format_parse(formats[rng_below(r, 6)], found);
    c->spec.format = found[0];
    c->spec.mapping = (dp_mapping)rng_below(r, DP_MAPPING_COUNT);
    c->spec.ortho = dp_mapping_get(c->spec.mapping)->ortho && rng_below(r, 4) == 0;
    c->spec.model = (dp_model)rng_below(r, 2);
    c->spec.rounding = (dp_rounding)rng_below(r, DP_ROUNDING_COUNT);
    c->spec.znear = rng_log(r, 1e-2, 1e2);
    c->spec.zfar = c->spec.znear * rng_log(r, 3.0, 1e4);
    if (dp_mapping_get(c->spec.mapping)->far_infinite && !c->spec.ortho && !c->far_moves && rng_below(r, 4) == 0)
        c->spec.zfar = INFINITY;
    c->from = c->far_moves ? c->spec.zfar : c->spec.znear;
    c->to = c->from * (1.0 + rng_log(r, 1e-8, 1.0));
    const double first = c->far_moves ? c->spec.znear : c->to;
    const double last = c->far_moves ? c->from : fmin(c->spec.zfar, 1e4 * c->spec.znear);
    if (first * 1.1 >= last)
        return 0;
    c->hi = rng_log(r, first, last);
    c->lo = rng_below(r, 2) == 0 ? rng_log(r, first, c->hi) : c->hi;
    return 1;
}

static int within(const cameras *c, int of_errors, double limit) {
    dp_setup one, other;
    if (make(c, c->from, c->spec.model, &one) != DP_OK || make(c, c->to, c->spec.model, &other) != DP_OK)
        return 0;
    const dp_setup *outer = c->far_moves ? &other : &one, *inner = c->far_moves ? &one : &other;
    return (of_errors ? dp_error_within : dp_separation_within)(outer, inner, c->lo, c->hi, limit);
}

/* The least limit that a run is said to keep, to 2^-20. */
static double kept_by(const cameras *c, int of_errors) {
    double fails = 1e-12 * c->hi, holds = 1e3 * c->hi;
    if (!within(c, of_errors, holds))
        return INFINITY;
    while (holds > fails * (1.0 + 0x1p-20)) {
        const double middle = sqrt(fails) * sqrt(holds);
        *(within(c, of_errors, middle) ? &holds : &fails) = middle;
    }
    return holds;
}

/* Nothing is looked at but the codes of an oracle: of surfaces that far apart, and of what a code is read back as. */
TEST(test_lattice) {
    rng r = rng_make("lattices between two");
    tally apart = {.name = "surfaces that far apart have two codes in every camera of a run, by GMP"};
    tally errors = {.name = "no code of a camera of a run is read back farther off, by GMP"};
    uint64_t singles = 0, shared = 0, met = 0; /* of one camera: what shows that a bound is not slack */
    const uint64_t count = test_cases(150, 800, 10000);
    for (uint64_t i = 0; i < count;) {
        cameras c;
        oracle o;
        char text[256];
        if (!draw_lattice(&r, &c))
            continue;
        const int single = rng_below(&r, 3) == 0;
        if (single)
            c.to = c.from;
        const double separation = kept_by(&c, 0), error = kept_by(&c, 1);
        if (isinf(separation) || isinf(error))
            continue;
        i++;
        double worst = 0.0, closest = 0.0;
        for (int k = 0; k < 24; k++) {
            dp_setup setup;
            if (make(&c, k == 0 ? c.from : k == 1 ? c.to : between(&r, &c), c.spec.model, &setup) != DP_OK)
                continue;
            oracle_init(&o, &setup.spec);
            for (int n = 0; n < 12; n++) {
                const double z = n == 0 ? c.hi : n == 1 ? c.lo : rng_uniform(&r, c.lo, c.hi), behind = z + separation;
                const uint32_t code = code_by_oracle(&o, z);
                const double off = error_by_oracle(&o, code, z);
                worst = fmax(worst, off);
                TALLY(&errors, off <= error, "%s: %.17g at %.17g above %.17g",
                      oracle_describe(&setup.spec, text, sizeof text), off, z, error);
                if (behind <= setup.spec.zfar)
                    TALLY(&apart, code_by_oracle(&o, behind) != code, "%s: %.17g and %.17g behind",
                          oracle_describe(&setup.spec, text, sizeof text), z, separation);
                const double nearer = z + 0.45 * separation;
                if (nearer <= setup.spec.zfar && code_by_oracle(&o, nearer) == code)
                    closest = 0.45 * separation;
            }
            oracle_clear(&o);
        }
        if (single && c.lo < c.hi && c.spec.model == DP_MODEL_EXACT && c.spec.format.kind == DP_FORMAT_UNORM) {
            singles++;
            shared += closest > 0.0;
            met += worst > 0.5 * error;
        }
    }
    tally_end(&apart);
    tally_end(&errors);
    printf("# of %llu single cameras %llu have surfaces 0.45 of that apart with one code, %llu half of the error\n",
           (unsigned long long)singles, (unsigned long long)shared, (unsigned long long)met);
    assert_true(shared * 10 > singles * 8 && met * 10 > singles * 8);
}

/* A run of depths of one binade: what is guaranteed of all of them is at least what is guaranteed of each. */
TEST(test_depths) {
    rng r = rng_make("depths of one binade");
    tally each = {.name = "what is guaranteed over a run of depths is at least the separation at each of them"};
    const uint64_t count = test_cases(4000, 20000, 400000);
    for (uint64_t i = 0; i < count;) {
        cameras c;
        dp_setup setup;
        if (!draw(&r, &c, 0) || make(&c, c.to, DP_MODEL_FLOAT, &setup) != DP_OK)
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

/* A depth whose distance gains little by being refined, and a run whose distance gains more. */
TEST(test_refined_alike) {
    dp_spec spec = dp_spec_default();
    dp_setup setup;
    spec.model = DP_MODEL_FLOAT;
    spec.znear = 0.010426754016938983;
    spec.zfar = INFINITY;
    spec.mapping = DP_MAPPING_GL;
    assert_int_equal(dp_arith_parse("softpipe", &spec.arith), DP_OK);
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    const dp_guarantee g = dp_guarantee_make(&setup);
    assert_true(dp_guarantee_at(&g, 4972.6494140625) <= dp_guarantee_bound(&g, 4234.49609375, 4972.6494140625));
}

/* What has no entry of one sign, and an error in float: nothing is said. */
TEST(test_nothing) {
    dp_spec spec = dp_spec_default();
    dp_setup one, other;
    spec.model = DP_MODEL_FLOAT;
    assert_int_equal(dp_setup_init(&one, &spec), DP_OK);
    assert_int_equal(dp_separation_within(&one, &one, 10.0, 10.0, 5.0), 1);
    assert_int_equal(dp_error_within(&one, &one, 10.0, 10.0, 5.0), 0);
    spec.ortho = 1;
    spec.znear = -1.0;
    assert_int_equal(dp_setup_init(&one, &spec), DP_OK);
    spec.znear = 1.0;
    assert_int_equal(dp_setup_init(&other, &spec), DP_OK);
    assert_int_equal(dp_separation_within(&one, &other, 10.0, 10.0, 5.0), 0);
}
