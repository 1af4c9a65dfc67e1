/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The binary32 pipeline: against MPFR at 24 bits, against published counts, at the clip planes, behind a view. */
#include <float.h>
#include <mpfr.h>

#include "depthprec/depthprec.h"
#include "nvidia.h"
#include "setups.h"
#include "support.h"
#include "transform.h"

static float depth_of(uint32_t bits) {
    float z;
    memcpy(&z, &bits, sizeof z);
    return z;
}

static uint32_t bits_of(float z) {
    uint32_t bits;
    memcpy(&bits, &z, sizeof bits);
    return bits;
}

static dp_setup setup_of(double znear, double zfar, dp_mapping mapping, const char *format) {
    return SETUP(format, .znear = znear, .zfar = zfar, .mapping = mapping);
}

static dp_pipeline pipeline_of(const dp_setup *setup) {
    dp_pipeline p;
    assert_int_equal(dp_pipeline_init(&p, setup), DP_OK);
    return p;
}

static dp_setup random_setup(rng *r) {
    for (;;) {
        static const char *const formats[] = {"fp32", "fp16", "unorm16", "unorm24", "unorm32", "unorm5"};
        dp_spec spec = dp_spec_default();
        dp_format format[2];
        dp_setup setup;
        dp_format_parse(formats[rng_below(r, 6)], format);
        spec.format = format[0];
        spec.znear = rng_log(r, 1e-3, 1e3);
        spec.zfar = rng_below(r, 8) == 0 ? (double)INFINITY : spec.znear * (1.0 + rng_log(r, 1e-5, 1e8));
        if (rng_below(r, 4) == 0) { /* where A is barely above 1 the far plane is lost in the most ways */
            spec.znear = (double)(float)spec.znear;
            spec.zfar = (double)(float)(spec.znear * exp2(rng_uniform(r, 18.0, 27.0)));
        }
        spec.mapping = (dp_mapping)rng_below(r, 4);
        spec.ortho = rng_below(r, 3) == 0;
        if (spec.ortho && rng_below(r, 2))
            rng_planes(r, &spec.znear, &spec.zfar);
        spec.rounding = (dp_rounding)rng_below(r, DP_ROUNDING_COUNT);
        spec.arith = rng_below(r, dp_arith_count());
        if (dp_setup_init(&setup, &spec) == DP_OK)
            return setup;
    }
}

/* A depth of the camera, next to one of its planes now and then. */
static float random_depth(rng *r, const dp_pipeline *p) {
    if (p->znear <= 0.0f) {
        const float z = (float)rng_depth(r, (double)p->znear, (double)p->zfar);
        return fabsf(z) < FLT_MIN ? 0.0f : z; /* MPFR as used here has no subnormals */
    }
    const uint32_t lo = bits_of(p->znear);
    const uint32_t hi = isinf(p->zfar) ? lo + (30U << 23) : bits_of(p->zfar);
    const uint64_t count = (uint64_t)hi - lo + 1;
    const uint64_t part = rng_below(r, 4) == 0 && count > 64 ? 64 : count;
    const uint64_t offset = rng_below(r, part);
    return depth_of(rng_below(r, 2) ? lo + (uint32_t)offset : hi - (uint32_t)offset);
}

/* ---- Bit for bit: each operation again in MPFR, with 24 bits ----------------------------------------------------- */

typedef struct exact {
    mpfr_t value, other, wide;
} exact;

static float oracle_clip(exact *e, const dp_pipeline *p, float z) {
    const float w = p->ortho ? 1.0f : z;
    mpfr_set_flt(e->value, p->a, MPFR_RNDN);
    mpfr_set_flt(e->other, p->b, MPFR_RNDN);
    mpfr_set_flt(e->wide, z, MPFR_RNDN);
    if (p->arith->fused) {
        mpfr_fma(e->value, e->value, e->wide, e->other, MPFR_RNDN);
    } else {
        mpfr_mul(e->value, e->value, e->wide, MPFR_RNDN);
        mpfr_add(e->value, e->value, e->other, MPFR_RNDN);
    }
    if (p->arith->remap && p->ndc_signed) {
        mpfr_set_flt(e->other, w, MPFR_RNDN);
        mpfr_add(e->value, e->value, e->other, MPFR_RNDN);
        mpfr_div_ui(e->value, e->value, 2, MPFR_RNDN);
    }
    return mpfr_get_flt(e->value, MPFR_RNDN);
}

static float oracle_window(exact *e, const dp_pipeline *p, float z) {
    oracle_clip(e, p, z);
    mpfr_set_flt(e->other, p->ortho ? 1.0f : z, MPFR_RNDN);
    if (p->arith->reciprocal) {
        mpfr_ui_div(e->other, 1, e->other, MPFR_RNDN);
        if (p->arith->reciprocal == DP_RECIPROCAL_UNIT)
            mpfr_set_flt(e->other, dp_reciprocal_unit(p->ortho ? 1.0f : z), MPFR_RNDN);
        mpfr_mul(e->value, e->value, e->other, MPFR_RNDN);
    } else {
        mpfr_div(e->value, e->value, e->other, MPFR_RNDN);
    }
    if (p->ndc_signed && !p->arith->remap) {
        mpfr_div_ui(e->value, e->value, 2, MPFR_RNDN);
        mpfr_set_d(e->other, 0.5, MPFR_RNDN);
        mpfr_add(e->value, e->value, e->other, MPFR_RNDN);
    }
    return mpfr_get_flt(e->value, MPFR_RNDN);
}

/* UNORM only: floats are dp_format_encode()'s own business. */
static uint32_t oracle_code(exact *e, const dp_pipeline *p, float window) {
    const float d = fminf(fmaxf(window, 0.0f), 1.0f);
    if (p->arith->conversion == DP_CONVERT_SIXTEENTHS)
        return (uint32_t)nvidia_code(p->format.bits, d);
    mpfr_set_ui(e->other, p->format.code_max, MPFR_RNDN); /* rounded to 24 bits, as a binary32 factor is */
    mpfr_set_flt(e->value, d, MPFR_RNDN);
    mpfr_mul(e->value, e->value, e->other, MPFR_RNDN);
    if (p->arith->conversion == DP_CONVERT_EXACT) {
        mpfr_set_ui(e->wide, p->format.code_max, MPFR_RNDN); /* 64 bits: the product is exact */
        mpfr_mul_d(e->wide, e->wide, (double)d, MPFR_RNDN);
        if (p->rounding == DP_ROUND_EVEN)
            mpfr_rint(e->wide, e->wide, MPFR_RNDN);
        else if (p->rounding == DP_ROUND_ZERO)
            mpfr_trunc(e->wide, e->wide);
        else
            mpfr_round(e->wide, e->wide); /* halves away from zero: up */
    } else if (p->arith->conversion == DP_CONVERT_PRODUCT_ZERO) {
        mpfr_trunc(e->wide, e->value);
    } else {
        mpfr_rint(e->wide, e->value, MPFR_RNDN);
    }
    return mpfr_cmp_ui(e->wide, p->format.code_max) > 0 ? p->format.code_max
                                                        : (uint32_t)mpfr_get_ui(e->wide, MPFR_RNDN);
}

TEST(matches_mpfr) {
    tally t = {.name = "pipeline against MPFR at 24 bits"};
    rng r = rng_make("pipeline");
    exact e;
    mpfr_inits2(24, e.value, e.other, (mpfr_ptr)0);
    mpfr_init2(e.wide, 64);
    const uint64_t cases = test_cases(200, 2000, 40000);
    for (uint64_t n = 0; n < cases; n++) {
        const dp_setup setup = random_setup(&r);
        const dp_pipeline p = pipeline_of(&setup);
        for (int i = 0; i < 50; i++) {
            const float z = random_depth(&r, &p);
            const float clip = dp_pipeline_clip(&p, z);
            const float window = dp_pipeline_window(&p, z);
            if ((fabsf(window) < FLT_MIN && window != 0.0f) || (fabsf(clip) < FLT_MIN && clip != 0.0f)) {
                t.skipped++; /* MPFR as used here has no subnormals */
                continue;
            }
            TALLY(&t, clip == oracle_clip(&e, &p, z), "clip of z %a: near %a far %a %s %s", (double)z, setup.spec.znear,
                  setup.spec.zfar, dp_mapping_get(setup.spec.mapping)->name, p.arith->name);
            TALLY(&t, window == oracle_window(&e, &p, z), "window of z %a: near %a far %a %s %s", (double)z,
                  setup.spec.znear, setup.spec.zfar, dp_mapping_get(setup.spec.mapping)->name, p.arith->name);
            if (p.format.kind == DP_FORMAT_UNORM)
                TALLY(&t, dp_pipeline_code(&p, z) == oracle_code(&e, &p, window), "code of window %a in %s, %s, %s",
                      (double)window, p.format.name, dp_rounding_name(p.rounding), p.arith->name);
        }
    }
    mpfr_clears(e.value, e.other, e.wide, (mpfr_ptr)0);
    tally_end(&t);
}

/* ---- Reed 2015: neighbours among 10001 depths, equal and swapped; no clamping there ------------------------------ */

/* A code or window depth as a number that grows with distance. */
static int64_t unclamped(const dp_pipeline *p, int unorm, float z) {
    const double window = (double)dp_pipeline_window(p, z);
    const int64_t code = (int64_t)(unorm ? floor(window * 16777215.0 + 0.5) : window * 0x1p60);
    return p->reversed ? -code : code;
}

TEST(reed) {
    static const struct {
        dp_mapping mapping;
        int infinite;
        int equal[4], swapped; /* linear fp32, unorm24, log fp32, unorm24; swapped in all four */
    } rows[] = {
        {DP_MAPPING_D3D, 0, {7720, 7720, 880, 880}, 1}, {DP_MAPPING_D3D, 1, {7575, 7575, 727, 727}, 1},
        {DP_MAPPING_REVERSED, 0, {0, 7577, 0, 727}, 0}, {DP_MAPPING_REVERSED, 1, {0, 7578, 0, 728}, 0},
        {DP_MAPPING_GL, 0, {7734, 7734, 902, 902}, 0},  {DP_MAPPING_GL, 1, {7663, 7663, 839, 839}, 0},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        for (int cell = 0; cell < 4; cell++) {
            const int unorm = cell % 2;
            const double zfar = rows[i].infinite ? (double)INFINITY : 1e4;
            const dp_setup setup = setup_of(0.1, zfar, rows[i].mapping, unorm ? "unorm24" : "fp32");
            const dp_pipeline p = pipeline_of(&setup);
            int equal = 0, swapped = 0;
            int64_t before = 0;
            for (int k = 0; k <= 10000; k++) {
                const double z = cell < 2 ? 0.1 + (1e4 - 0.1) * k / 1e4 : 0.1 * pow(1e5, k / 1e4);
                const int64_t code = unclamped(&p, unorm, (float)z);
                equal += k > 0 && code == before;
                swapped += k > 0 && code < before;
                before = code;
            }
            assert_int_equal(equal, rows[i].equal[cell]);
            /* The log spacing swaps one pair where the linear one does; infinite far none. */
            assert_int_equal(swapped, cell >= 2 && rows[i].infinite ? 0 : rows[i].swapped);
        }
}

/* ---- A view in front --------------------------------------------------------------------------------------------- */

/* Counts of 10000 neighbours behind a view: equal and swapped, for one order of the dot products. */
static void count_view(const dp_setup *setup, const view_row *view, int precomposed, unsigned order, int *equal,
                       int *swapped) {
    transform t;
    rng r = rng_make(view->name);
    uint32_t before = 0;
    double depth_before = 0.0;
    assert_int_equal(transform_init(&t, setup, view, precomposed, order), DP_OK);
    *equal = *swapped = 0;
    for (int k = 0; k <= 10000; k++) {
        const double z = 0.1 + (1e4 - 0.1) * k / 1e4;
        float world[3];
        double depth;
        view_point(view, z * rng_uniform(&r, -1.0, 1.0), z * rng_uniform(&r, -1.0, 1.0), z, world, &depth);
        assert_true(depth > depth_before); /* rounding the point does not change the order */
        const uint32_t code = transform_code(&t, world);
        const uint32_t key = setup->reversed ? ~code : code;
        *equal += k > 0 && key == before;
        *swapped += k > 0 && key < before;
        before = key;
        depth_before = depth;
    }
}

TEST(views) {
    const dp_setup standard = setup_of(0.1, 1e4, DP_MAPPING_D3D, "fp32");
    const dp_setup reversed = setup_of(0.1, 1e4, DP_MAPPING_REVERSED, "fp32");
    const dp_setup infinite = setup_of(0.1, (double)INFINITY, DP_MAPPING_REVERSED, "fp32");
    for (size_t v = 0; v < view_count(); v++)
        for (int precomposed = 0; precomposed < 2; precomposed++) {
            const view_row *view = view_get(v);
            int least[2] = {10000, 10000}, most[2] = {0, 0};
            for (unsigned order = 0; order < ORDER_COUNT; order++) {
                int count[2];
                count_view(&reversed, view, precomposed, order, &count[0], &count[1]);
                assert_true(count[0] == 0 && count[1] == 0);
                count_view(&infinite, view, precomposed, order, &count[0], &count[1]);
                assert_true(count[0] == 0 && count[1] == 0);
                count_view(&standard, view, precomposed, order, &count[0], &count[1]);
                for (int i = 0; i < 2; i++) {
                    least[i] = count[i] < least[i] ? count[i] : least[i];
                    most[i] = count[i] > most[i] ? count[i] : most[i];
                }
            }
            printf("# %s, %s: standard %.1f-%.1f %% equal, %.1f-%.1f %% swapped; reversed 0 / 0 in %d orders\n",
                   view->name, precomposed ? "precomposed" : "separate", least[0] / 100.0, most[0] / 100.0,
                   least[1] / 100.0, most[1] / 100.0, ORDER_COUNT);
            const int alone = !precomposed || v == 0; /* as the projection alone */
            assert_in_range(least[0], alone ? 7700 : 3000, 10000);
            assert_in_range(most[0], 0, alone ? 7740 : 6000);
            assert_in_range(least[1], alone ? 0 : 1000, 10000);
            assert_in_range(most[1], 0, alone ? 5 : 2700);
        }
}

/* Behind the identity the separate transform is the pipeline itself. */
TEST(identity_view) {
    tally t = {.name = "identity view"};
    rng r = rng_make("identity");
    for (int n = 0; n < 2000; n++) {
        const dp_setup setup = random_setup(&r);
        transform plain;
        if (setup.spec.ortho) {
            assert_int_equal(transform_init(&plain, &setup, view_get(0), 0, 0), DP_ERROR_MODEL);
            continue;
        }
        assert_int_equal(transform_init(&plain, &setup, view_get(0), n % 2, (unsigned)n % ORDER_COUNT), DP_OK);
        const float world[3] = {3.0f, -2.0f, random_depth(&r, &plain.pipeline)};
        if (n % 2 == 0)
            TALLY(&t, transform_code(&plain, world) == dp_pipeline_code(&plain.pipeline, world[2]), "z %a",
                  (double)world[2]);
    }
    tally_end(&t);
    transform plain;
    const dp_setup setup = setup_of(0.1, 100.0, DP_MAPPING_D3D, "fp32");
    assert_int_equal(transform_init(&plain, &setup, view_get(1), 0, ORDER_COUNT), DP_ERROR_MODEL);
    assert_int_equal(transform_init(&plain, NULL, view_get(1), 0, 0), DP_ERROR_NULL);
    assert_null(view_get(view_count()));
}

/* ---- Planes ------------------------------------------------------------------------------------------------------ */

TEST(known_planes) {
    static const struct {
        double znear, zfar;
        dp_mapping mapping;
        double effective;
    } rows[] = {
        {0.01, 1e4, DP_MAPPING_GL, 9878.58789},
        {0.3, 1000.0, DP_MAPPING_GL, 999.950745},
        {0.3, 1000.0, DP_MAPPING_REVERSED, 999.999939},
        {1.0, 10.0, DP_MAPPING_D3D, 10.0},
        {0.1, (double)INFINITY, DP_MAPPING_D3D, (double)INFINITY},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const dp_setup setup = setup_of(rows[i].znear, rows[i].zfar, rows[i].mapping, "fp32");
        const dp_pipeline p = pipeline_of(&setup);
        float znear, zfar;
        dp_pipeline_planes(&p, &znear, &zfar);
        assert_true(znear == p.znear);
        if (isinf(rows[i].effective))
            assert_true(isinf(zfar));
        else
            assert_relative((double)zfar, rows[i].effective, 1e-9);
    }
    const dp_setup setup = setup_of(1.0, 10.0, DP_MAPPING_D3D, "fp32");
    const dp_pipeline p = pipeline_of(&setup);
    assert_true(dp_pipeline_drawn(&p, 10.0f));
    assert_false(dp_pipeline_drawn(&p, nextafterf(10.0f, 0.0f))); /* being drawn is not monotone */
}

/* The binary32 depth nearest to a plane, on the side to which `step` leads. */
static float beside(double plane, float step) {
    float z = (float)plane;
    while ((double)step * ((double)z - plane) < 0.0)
        z = nextafterf(z, step * HUGE_VALF);
    return z;
}

/* The planes by looking at every depth from either end, between the ones asked for. */
TEST(planes) {
    tally t = {.name = "effective planes"};
    rng r = rng_make("planes");
    const uint64_t cases = test_cases(300, 5000, 100000);
    for (uint64_t n = 0; n < cases; n++) {
        const dp_setup setup = random_setup(&r);
        const dp_pipeline p = pipeline_of(&setup);
        const bool infinite = isinf(setup.spec.zfar);
        float first = beside(setup.spec.znear, 1.0f), last = infinite ? FLT_MAX : beside(setup.spec.zfar, -1.0f);
        const float end = last;
        float znear, zfar;
        dp_pipeline_planes(&p, &znear, &zfar);
        while (first <= last && !dp_pipeline_drawn(&p, first))
            first = nextafterf(first, HUGE_VALF);
        while (first <= last && !dp_pipeline_drawn(&p, last))
            last = nextafterf(last, -HUGE_VALF);
        const int none = first > last;
        TALLY(&t, none ? isnan(znear) && isnan(zfar) : znear == first, "near: %a %a %s %s%s", setup.spec.znear,
              setup.spec.zfar, dp_mapping_get(setup.spec.mapping)->name, p.arith->name, p.ortho ? " ortho" : "");
        TALLY(&t, none || zfar == (last == end && infinite ? HUGE_VALF : last), "far: %a %a %s %s%s", setup.spec.znear,
              setup.spec.zfar, dp_mapping_get(setup.spec.mapping)->name, p.arith->name, p.ortho ? " ortho" : "");
    }
    tally_end(&t);
}

TEST(refuses) {
    dp_pipeline p;
    const dp_setup linear = setup_of(0.1, 100.0, DP_MAPPING_LINEAR, "fp32");
    assert_int_equal(dp_pipeline_init(&p, &linear), DP_ERROR_MODEL);
    assert_int_equal(dp_pipeline_init(&p, NULL), DP_ERROR_NULL);
    assert_int_equal(dp_pipeline_init(NULL, &linear), DP_ERROR_NULL);
    const dp_setup setup = setup_of(0.1, 100.0, DP_MAPPING_D3D, "unorm24");
    p = pipeline_of(&setup);
    assert_int_equal(dp_pipeline_convert(&p, -1.0f), 0);
    assert_int_equal(dp_pipeline_convert(&p, NAN), 0);
    assert_int_equal(dp_pipeline_convert(&p, 2.0f), 16777215);
}
