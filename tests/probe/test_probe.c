/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The hypotheses of the probe: codes made here by each of them, with MPFR or closed forms, are found to be its, and
 * nothing is when one pixel in them is otherwise.
 */
#include <mpfr.h>

#include "core/bits.h"
#include "depthprec/arith.h"
#include "nvidia.h"
#include "predicted.h"
#include "probe/judge.h"
#include "support.h"

enum { ACROSS = SHOT_SIZE / PLAN_TILE };

/* Faults of a made-up device. */
typedef struct device {
    int conversion; /* 0 exact, ties up; 1 product to even; 2 product truncated; 3 exact truncated; 4 NVIDIA's */
    bool reciprocal, unit, fused, finer, flushes;
    int plane_bits, coverage_bits; /* 0: not snapped */
    double float_step, code_step;  /* of a bias, in units of 2^(n - 23) and codes */
    bool of_pixel;                 /* the exponent of a bias */
    bool cuts;                     /* fractions of a constant */
    int slope;                     /* 0 the larger one, 1 the root, 2 the sum */
    bool differs;                  /* two pipelines do */
} device;

/* ---- Arithmetic: double rounds twice as once, 53 >= 2 x 24 + 2; a fused operation by MPFR of 24 bits
 * ------------------ */

static float fused(float x, float y, float z) {
    mpfr_t a, b, c;
    mpfr_inits2(24, a, b, c, (mpfr_ptr)0);
    mpfr_set_flt(a, x, MPFR_RNDN);
    mpfr_set_flt(b, y, MPFR_RNDN);
    mpfr_set_flt(c, z, MPFR_RNDN);
    mpfr_fma(a, a, b, c, MPFR_RNDN);
    const float out = mpfr_get_flt(a, MPFR_RNDN);
    mpfr_clears(a, b, c, (mpfr_ptr)0);
    return out;
}

static float product_of(float x, float y) {
    return (float)((double)x * (double)y);
}

static float quotient_of(float x, float y) {
    return (float)((double)x / (double)y);
}

static float divided(const device *d, float z, float w) {
    if (d->unit)
        return product_of(z, dp_reciprocal_unit(w));
    return d->reciprocal ? product_of(z, quotient_of(1.0F, w)) : quotient_of(z, w);
}

static uint32_t code_of(const device *d, shot_format format, float depth) {
    const double scale = format == SHOT_D16 ? 65535.0 : 16777215.0;
    const double exact = (double)depth * scale; /* 48 bits */
    const double product = (double)product_of(depth, (float)scale);
    if (format == SHOT_D32F)
        return dp_bits32(depth);
    if (d->conversion == 4)
        return (uint32_t)nvidia_code(format == SHOT_D16 ? 16 : 24, depth);
    return (uint32_t)(d->conversion == 0   ? floor(exact + 0.5)
                      : d->conversion == 1 ? rint(product)
                      : d->conversion == 2 ? floor(product)
                                           : floor(exact));
}

/* ---- Shots ------------------------------------------------------------------------------------------------------- */

static float point_depth(const device *d, const shot *s, const float *v) {
    const float product = product_of(s->a, v[2]);
    const float sum = d->fused ? fused(s->a, v[2], s->b) : (float)((double)product + (double)s->b);
    return s->program == SHOT_PROJECT ? divided(d, sum, v[3]) : divided(d, v[2], v[3]);
}

static bool is_inside(const float *v) {
    return 0.0F <= v[2] && v[2] <= v[3];
}

static void make_points(const device *d, shot *s) {
    for (int i = 0; i < SHOT_PIXELS; i++) {
        const float *v = s->vertex[i];
        const bool tiny = d->flushes && fabsf(v[2]) < 0x1p-126F;
        const float depth = tiny ? 0.0F : s->program >= SHOT_LOG2 ? SHOT_CLEAR : point_depth(d, s, v);
        s->code[i] = is_inside(v) ? code_of(d, s->format, fabsf(depth)) : dp_bits32(SHOT_CLEAR);
    }
}

static double snapped(double x, int bits) {
    return bits == 0 ? x : rint(ldexp(x, bits)) / ldexp(1.0, bits);
}

static double larger_slope(const device *d, const plan_tile *t) {
    const double x = fabs((double)t->slope_x), y = fabs((double)t->slope_y);
    return d->slope == 0 ? fmax(x, y) : d->slope == 1 ? sqrt(x * x + y * y) : x + y;
}

/* The offset that a bias adds at a pixel of that depth. */
static double bias_of(const device *d, const shot *s, const plan_tile *t, double depth) {
    const double side = 6.0 * (fabs((double)t->slope_x) - (double)t->slope_y), up = 6.0 * (double)t->slope_y;
    const double largest = (double)t->z + fmax(side, up);
    const double constant = d->cuts ? floor((double)s->constant) : (double)s->constant;
    const double step = s->format == SHOT_D32F ? ldexp(d->float_step, ilogb(d->of_pixel ? depth : largest) - 23)
                                               : d->code_step / (s->format == SHOT_D16 ? 65535.0 : 16777215.0);
    return constant * step + (double)s->slope * larger_slope(d, t);
}

/* The pixels of a tile that a triangle of the plan surely covers, by its plane. */
static void make_tile(const device *d, shot *s, int tile) {
    const bool plane = strcmp(s->name, "plane") == 0, coverage = strcmp(s->name, "coverage") == 0;
    const plan_tile own = plan_tile_of(s->format, tile);
    for (int y = -2; y <= 0; y++)
        for (int x = -1; x <= 1; x++) {
            const int at = (tile / ACROSS * PLAN_TILE + 8 + y) * SHOT_SIZE + tile % ACROSS * PLAN_TILE + 8 + x;
            const double moved = snapped(tile / 2048.0, d->plane_bits), edge = plan_edge(tile);
            const double flat = (double)own.z + (double)own.slope_x * x + (double)own.slope_y * y;
            const float before = (float)(plane ? 0.5 + 0.05 * (x - moved) : flat);
            const float after = plane ? before : (float)((double)before + bias_of(d, s, &own, (double)before));
            if (!coverage)
                s->code[at] = code_of(d, s->format, after);
            else if (snapped(edge, d->coverage_bits) > 0.0)
                s->code[at] = dp_bits32(0.5F);
        }
}

static void make(probe_result *r, const device *d) {
    *r = (probe_result){.machine = {.count = 1, .counts = true}};
    assert_true(plan_make(&r->plan, 0));
    for (size_t i = 0; i < r->plan.count; i++) {
        shot *s = &r->plan.shot[i];
        s->drawn = strcmp(s->name, "scene") != 0 && strcmp(s->name, "predicted") != 0;
        s->passed = s->program == SHOT_PROJECT           ? s->count - d->differs
                    : d->finer || s->format == SHOT_D32F ? 0
                                                         : s->count;
        for (int k = 0; k < SHOT_PIXELS; k++)
            s->code[k] = code_of(d, s->format, SHOT_CLEAR);
        if (s->triangles)
            for (int tile = 0; tile < PLAN_TILES && s->drawn; tile++)
                make_tile(d, s, tile);
        else
            make_points(d, s);
    }
}

/* ---- What is found ----------------------------------------------------------------------------------------------- */

static const probe_finding *find(const probe_result *r, const char *key, const char *format) {
    for (size_t i = 0; i < r->count; i++) {
        const char *of = r->finding[i].format; /* null: of all, found in fp32 */
        if (strcmp(r->finding[i].key, key) == 0 && (format == NULL || of == NULL || strcmp(of, format) == 0))
            return &r->finding[i];
    }
    fail_msg("nothing is found of %s", key);
    return NULL;
}

static void says(const probe_result *r, const char *key, const char *format, const char *words) {
    const probe_finding *f = find(r, key, format);
    if (f->sure != PROBE_SURE || strstr(f->words, words) == NULL || f->hits != f->cases)
        fail_msg("%s: %s, %s, %lu of %lu, not %s", key, probe_certainty_name(f->sure), f->words, (unsigned long)f->hits,
                 (unsigned long)f->cases, words);
}

static const struct {
    device is;
    const char *rounding, *division, *projection, *subnormal, *plane, *coverage, *bias, *code, *fraction, *slope;
    const char *arith;
} devices[] = {
    {{0, .float_step = 1, .code_step = 1},
     "exact d (2^N - 1), to nearest",
     "z / w",
     "each rounded",
     "kept",
     "unsnapped",
     "unsnapped",
     "r = 2^(n-23), 2^n the power of two at or below the largest",
     "one code",
     "count",
     "max(",
     "ieee"},
    {{1, .reciprocal = true, .flushes = true, .plane_bits = 4, .coverage_bits = 4, .float_step = 2, .code_step = 2,
      .slope = 1},
     "product d (2^N - 1), to nearest even",
     "1 / w",
     "each rounded",
     "flushed",
     "1/16 pixel",
     "1/16 pixel",
     "r = 2^(n-22), 2^n the power of two at or below the largest",
     "two codes",
     "count",
     "sqrt(",
     "mesa"},
    {{2, .reciprocal = true, .plane_bits = 8, .coverage_bits = 8, .float_step = 0.5, .code_step = 0.5, .slope = 2},
     "product d (2^N - 1), truncated",
     "1 / w",
     "each rounded",
     "kept",
     "1/256 pixel",
     "1/256 pixel",
     "r = 2^(n-24), 2^n the power of two at or below the largest",
     "half a code",
     NULL,
     "|dz/dx| + |dz/dy|",
     "softpipe"},
    {{4, .unit = true, .fused = true, .flushes = true, .plane_bits = 8, .coverage_bits = 8, .float_step = 1,
      .code_step = 2},
     "cut to sixteenths",
     "NVIDIA's 1 / w",
     "fused",
     "flushed",
     "1/256 pixel",
     "1/256 pixel",
     "r = 2^(n-23), 2^n the power of two at or below the largest",
     "two codes",
     "count",
     "max(",
     "nvidia"},
    {{0, .fused = true, .plane_bits = 6, .coverage_bits = 9, .float_step = 1, .code_step = 1, .of_pixel = true,
      .cuts = true},
     "exact d (2^N - 1), to nearest",
     "z / w",
     "fused",
     "kept",
     "1/64 pixel",
     "1/512 pixel",
     "r = 2^(n-23), 2^n the power of two at or below the depth of the pixel",
     "one code",
     "cut",
     "max(",
     "fused"},
    {{3, .fused = true, .reciprocal = true, .float_step = 1, .code_step = 1},
     "exact d (2^N - 1), truncated",
     "1 / w",
     "fused",
     "kept",
     "unsnapped",
     "unsnapped",
     "largest",
     "one code",
     NULL,
     "max(",
     NULL},
};

TEST(test_found) {
    for (size_t i = 0; i < sizeof devices / sizeof devices[0]; i++) {
        static probe_result r;
        make(&r, &devices[i].is);
        probe_judge(&r);
        says(&r, "stored", "d24", "codes");
        says(&r, "stored", "d32f", "every bit");
        says(&r, "rounding", "d16", devices[i].rounding);
        if (devices[i].is.conversion < 2 || devices[i].is.conversion == 4)
            says(&r, "rounding", "d24", devices[i].rounding);
        else /* two ways of one function */
            assert_int_equal(find(&r, "rounding", "d24")->sure, PROBE_OPEN);
        says(&r, "division", NULL, devices[i].division);
        says(&r, "projection", NULL, devices[i].projection);
        says(&r, "clipping", NULL, "0 <= z <= w");
        says(&r, "subnormal", NULL, devices[i].subnormal);
        says(&r, "plane", NULL, devices[i].plane);
        says(&r, "coverage", NULL, devices[i].coverage);
        says(&r, "bias", "d32f", devices[i].bias);
        says(&r, "bias", "d16", devices[i].code);
        says(&r, "slope", NULL, devices[i].slope);
        says(&r, "invariance", NULL, "same");
        if (devices[i].fraction != NULL)
            says(&r, "fraction", NULL, devices[i].fraction);
        if (devices[i].arith == NULL)
            assert_null(r.arith);
        else
            assert_string_equal(r.arith, devices[i].arith);
        assert_null(r.raster);
        probe_free(&r);
    }
}

/* In 24 bits truncation is one function of two names: without 16 bits no row is claimed. */
TEST(test_two_names) {
    static probe_result r;
    const device is = {2, .reciprocal = true, .float_step = 1, .code_step = 1};
    make(&r, &is);
    plan_find(&r.plan, PLAN_ROUNDING, SHOT_D16)->drawn = false;
    probe_judge(&r);
    assert_null(r.arith);
    probe_free(&r);
}

/* One pixel that is otherwise, or one depth that is told apart, and no row is claimed. */
TEST(test_not_found) {
    static const struct {
        plan_shot shot;
        shot_format format;
        const char *key;
        bool row; /* of arithmetic */
    } all[] = {{PLAN_ROUNDING, SHOT_D16, "rounding", true},  {PLAN_ROUNDING, SHOT_D24, "rounding", true},
               {PLAN_DIVISION, SHOT_D32F, "division", true}, {PLAN_PROJECTION, SHOT_D32F, "projection", true},
               {PLAN_PLANE, SHOT_D32F, "plane", false},      {PLAN_CONSTANT, SHOT_D32F, "bias", false},
               {PLAN_SLOPED, SHOT_D32F, "slope", false},     {PLAN_PLANES, SHOT_D32F, "clipping", false}};
    static probe_result r;
    const device is = {1, .reciprocal = true, .float_step = 1, .code_step = 1};
    make(&r, &is);
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        shot *s = plan_find(&r.plan, all[i].shot, all[i].format);
        const int last = PLAN_TILES - 1; /* which slants */
        const int middle = (last / ACROSS * PLAN_TILE + 8) * SHOT_SIZE + last % ACROSS * PLAN_TILE + 8;
        uint32_t *code = &s->code[s->triangles ? middle : 40016];
        const uint32_t kept = *code;
        *code = all[i].shot == PLAN_PLANES ? dp_bits32(SHOT_CLEAR) : kept ^ 0x2000;
        r.count = 0;
        probe_judge(&r);
        const probe_finding *f = find(&r, all[i].key, probe_format_name(all[i].format));
        if (f->sure != PROBE_NO_ROW || f->hits >= f->cases)
            fail_msg("%s is found all the same: %s", all[i].key, f->words);
        if (all[i].row)
            assert_null(r.arith);
        else
            assert_string_equal(r.arith, "mesa");
        *code = kept;
    }
    probe_free(&r);
}

/* A scene in each format, and another one in two, as rasterizers draw them: one is named where it draws all of them, to
 * the last pixel. */
TEST(test_rasterizer) {
    static const struct {
        const char *scene[SHOT_FORMATS], *predicted[SHOT_FORMATS]; /* null: not drawn */
        int off; /* a pixel of the scene of that format is otherwise; of the other scene, behind those */
        const char *named;
    } rows[] = {
        {{"llvmpipe", "llvmpipe", "llvmpipe"}, {"llvmpipe", "llvmpipe", NULL}, -1, "llvmpipe"},
        {{NULL, "softpipe", NULL}, {NULL, "softpipe", NULL}, -1, "softpipe"},
        {{"swiftshader", NULL, "swiftshader"}, {NULL, NULL, "swiftshader"}, -1, "swiftshader"},
        {{"llvmpipe", "softpipe", "softpipe"}, {NULL, "softpipe", "softpipe"}, -1, NULL},
        {{"softpipe", "softpipe", "llvmpipe"}, {NULL, "llvmpipe", "llvmpipe"}, -1, NULL},
        {{"swiftshader", "llvmpipe", "llvmpipe"}, {NULL, NULL, NULL}, -1, NULL},
        {{"llvmpipe", "llvmpipe", "llvmpipe"}, {NULL, NULL, NULL}, 0, NULL},
        {{"llvmpipe", "llvmpipe", "llvmpipe"}, {NULL, NULL, NULL}, 2, NULL},
        {{"llvmpipe", "llvmpipe", "llvmpipe"}, {"llvmpipe", "llvmpipe", NULL}, 3, NULL},
        {{"llvmpipe", "llvmpipe", "llvmpipe"}, {"swiftshader", "llvmpipe", NULL}, -1, NULL},
        {{NULL, NULL, NULL}, {NULL, NULL, NULL}, -1, NULL},
    };
    static probe_result r;
    const device is = {1, .reciprocal = true, .float_step = 1, .code_step = 1};
    make(&r, &is);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        for (int k = 0; k < 2 * SHOT_FORMATS; k++) {
            shot *s =
                plan_find(&r.plan, k < SHOT_FORMATS ? PLAN_SCENE : PLAN_PREDICTED, (shot_format)(k % SHOT_FORMATS));
            const char *by = k < SHOT_FORMATS ? rows[i].scene[k] : rows[i].predicted[k - SHOT_FORMATS];
            s->drawn = by != NULL;
            if (by != NULL)
                predict(by, s, s->code);
            s->code[SHOT_PIXELS - 1] ^= k == rows[i].off;
        }
        r.count = 0;
        judge_triangles(&r);
        if ((r.raster == NULL) != (rows[i].named == NULL) || (r.raster != NULL && strcmp(r.raster, rows[i].named) != 0))
            fail_msg("row %zu: %s", i, r.raster != NULL ? r.raster : "none");
        for (int k = 0; k < 2 * SHOT_FORMATS; k++) {
            const bool first = k < SHOT_FORMATS;
            const char *by = first ? rows[i].scene[k] : rows[i].predicted[k - SHOT_FORMATS];
            if (by == NULL || (!first && rows[i].named == NULL))
                continue;
            const probe_finding *f =
                find(&r, first ? "rasterizer" : "prediction", probe_format_name((shot_format)(k % SHOT_FORMATS)));
            assert_non_null(strstr(f->words, by));
            assert_true(f->cases == SHOT_PIXELS && f->cases - f->hits == (k == rows[i].off));
            assert_true((f->sure == PROBE_SURE) == (k != rows[i].off));
        }
    }
    probe_free(&r);
}

/* One bit of binary32 in one pixel of a flat tile, where nothing is rounded, up or down. */
TEST(test_one_bit) {
    static probe_result r;
    const device is = {1, .reciprocal = true, .float_step = 1, .code_step = 1};
    make(&r, &is);
    shot *s = plan_find(&r.plan, PLAN_CONSTANT, SHOT_D32F);
    int flat = 0;
    for (int tile = 0; tile < PLAN_TILES; tile++) {
        const plan_tile own = plan_tile_of(SHOT_D32F, tile);
        uint32_t *code = &s->code[(tile / ACROSS * PLAN_TILE + 8) * SHOT_SIZE + tile % ACROSS * PLAN_TILE + 8];
        if (own.slope_x != 0 || own.slope_y != 0)
            continue;
        for (int way = -1; way <= 1; way++) {
            *code += (uint32_t)way;
            r.count = 0;
            probe_judge(&r);
            const probe_finding *f = find(&r, "bias", "d32f");
            if ((f->sure == PROBE_NO_ROW) != (way != 0) || f->cases - f->hits != (way != 0))
                fail_msg("tile %d, %d bits off: %s", tile, way, f->words);
            *code -= (uint32_t)way;
        }
        flat++;
        tile += 16; /* some of them */
    }
    assert_true(flat > 5);
    probe_free(&r);
}

TEST(test_other_states) {
    static probe_result r;
    const device finer = {0, .finer = true, .differs = true, .float_step = 1, .code_step = 1};
    make(&r, &finer);
    probe_judge(&r);
    assert_int_equal(find(&r, "stored", "d24")->sure, PROBE_NO_ROW);
    assert_non_null(strstr(find(&r, "stored", "d24")->words, "finer"));
    assert_int_equal(find(&r, "invariance", NULL)->sure, PROBE_NO_ROW);
    probe_free(&r);
}

/* Clip z from -w to w, moved to [0, 1] before the division, as translators do, or after it; and 24 bits that hold
 * binary32 instead of codes. */
TEST(test_signed) {
    static probe_result r;
    const device is = {1, .reciprocal = true, .float_step = 1, .code_step = 1};
    for (int after = 0; after < 2; after++) {
        make(&r, &is);
        for (size_t i = 0; i < r.plan.count; i++) {
            shot *s = &r.plan.shot[i];
            const bool stored = strcmp(s->name, "stored") == 0, projects = s->program == SHOT_PROJECT;
            s->ndc_signed = true;
            s->drawn = stored || (strcmp(s->name, "rounding") == 0 && s->format == SHOT_D16) ||
                       strcmp(s->name, "division") == 0 || strcmp(s->name, "projection") == 0;
            for (int k = 0; k < SHOT_PIXELS && s->drawn; k++) { /* double rounds twice as once: 53 >= 2 x 24 + 2 */
                const double a = (double)s->a, b = (double)s->b, w = (double)s->vertex[k][3];
                const double given = (double)s->vertex[k][2],
                             z = projects ? (double)(float)((double)(float)(a * given) + b) : given;
                const double per_w = (double)(float)(1.0 / w), sum = (double)(float)(z + w);
                const float d = after ? (float)(0.5 * (double)(float)(z * per_w) + 0.5) : (float)(0.5 * sum * per_w);
                s->code[k] = code_of(&is, s->format == SHOT_D24 ? SHOT_D32F : s->format, d);
            }
        }
        probe_judge(&r);
        says(&r, "stored", "d16", "codes");
        for (size_t i = 0; i < r.count; i++)
            assert_true(r.finding[i].format == NULL || strcmp(r.finding[i].format, "d24") != 0);
        says(&r, "division", NULL, after ? "1 / w, then times 1/2" : "(clip z + w)/2 times the rounded 1 / w");
        says(&r, "projection", NULL, "each rounded");
        assert_string_equal(r.arith, after ? "mesa" : "mesa-remap");
        probe_free(&r);
    }
}

/* Functions as the test stores them: exact but for one, whose error is what is said. */
TEST(test_functions) {
    static probe_result r;
    const device is = {0, .float_step = 1, .code_step = 1};
    make(&r, &is);
    shot *log2s = plan_find(&r.plan, PLAN_LOG2, SHOT_D32F), *quotients = plan_find(&r.plan, PLAN_QUOTIENT, SHOT_D32F);
    for (int i = 0; i < SHOT_PIXELS; i++) {
        mpfr_t x;
        mpfr_init2(x, 24);
        mpfr_set_flt(x, log2s->vertex[i][2], MPFR_RNDN);
        mpfr_log2(x, x, MPFR_RNDN);
        log2s->code[i] = dp_bits32(mpfr_get_flt(x, MPFR_RNDN) * 0x1p-6F);
        mpfr_clear(x);
        quotients->code[i] = dp_bits32(quotient_of(quotients->vertex[i][2], quotients->vertex[i][3]));
    }
    quotients->code[777] += 3;
    log2s->code[777] += 5; /* of x above 2: odd pixels */
    probe_judge(&r);
    double small = (double)NAN, large = (double)NAN;
    for (size_t i = 0; i < r.count; i++)
        if (strcmp(r.finding[i].key, "log2") == 0)
            *(r.finding[i].unit[0] == '\0' ? &small : &large) = r.finding[i].value;
    assert_true(small <= 0x1p-25 && small > 0x1p-27); /* half of 2^-24 below 1 */
    assert_true(large >= 4.5 && large <= 5.5);
    assert_true(find(&r, "quotient", NULL)->value >= 2.5 && find(&r, "quotient", NULL)->value <= 3.5);
    probe_free(&r);
}

/* Tiles that tell one bias from another: without slope the first numbers of a binade, the second ones and others, of
 * which the largest depth and that of the pixel have one exponent; slanted ones of either sign, steeper in x and in y.
 * In 16 bits all flat ones lie a quarter above a code. */
TEST(test_tiles) {
    for (int f = 0; f < SHOT_FORMATS; f++) {
        unsigned whole[3] = {0}, slanted[2][2][2] = {{{0}}}, flat = 0;
        for (int i = 0; i < PLAN_TILES; i++) {
            const plan_tile t = plan_tile_of((shot_format)f, i);
            int exponent;
            const double part = 2.0 * frexp((double)t.z, &exponent);
            if (t.slope_x != 0.0F && t.slope_y != 0.0F) {
                slanted[fabsf(t.slope_x) > fabsf(t.slope_y)][t.slope_x > 0.0F][t.slope_y > 0.0F]++;
                continue;
            }
            assert_true(t.slope_x == 0.0F && t.slope_y == 0.0F && t.z > 0.0F && t.z < 1.0F);
            flat++;
            whole[part == 1.0 ? 0 : part == 1.0 + 0x1p-23 ? 1 : 2]++;
            if (f == SHOT_D16)
                assert_true(fabs(fmod((double)t.z * 65535.0, 1.0) - 0.25) <= 0x1p-8);
        }
        assert_int_equal(flat, PLAN_TILES / 4 * 3);
        for (int i = 0; i < 8; i++)
            assert_true((&slanted[0][0][0])[i] > 0);
        for (int i = 0; i < 3 && f == SHOT_D32F; i++)
            assert_int_equal(whole[i], PLAN_TILES / 4);
    }
}

/* The hits of hypotheses are given: which is found, what is said of it, and which comes next. */
TEST(test_guesses) {
    static const struct {
        uint64_t hits[3], cases;
        probe_certainty sure;
        const char *words, *next;
        uint64_t best, second;
        int found;
    } rows[] = {
        {{64, 10, 63}, 64, PROBE_SURE, "one", "three", 64, 63, 0},
        {{10, 63, 64}, 64, PROBE_SURE, "three", "two", 64, 63, 2},
        {{64, 64, 3}, 64, PROBE_OPEN, "one; or two", "two", 64, 64, JUDGE_NONE},
        {{3, 64, 64}, 64, PROBE_OPEN, "two; or three", "three", 64, 64, JUDGE_NONE},
        {{64, 5, 64}, 64, PROBE_OPEN, "one; or three", "three", 64, 64, JUDGE_NONE},
        {{64, 64, 64}, 64, PROBE_OPEN, "one; or two; or three", "two", 64, 64, JUDGE_NONE},
        {{7, 62, 9}, 64, PROBE_NO_ROW, "nothing known; nearest: two", "three", 62, 9, JUDGE_NONE},
        {{0, 0, 0}, 0, PROBE_NO_ROW, "nothing known; nearest: one", "two", 0, 0, JUDGE_NONE},
    };
    static probe_result r;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const guess all[] = {{"one", rows[i].hits[0]}, {"two", rows[i].hits[1]}, {"three", rows[i].hits[2]}};
        r.count = 0;
        assert_int_equal(judge_guesses(&r, KEY_ROUNDING, "d16", all, 3, rows[i].cases), rows[i].found);
        const probe_finding *f = find(&r, "rounding", "d16");
        assert_int_equal(f->sure, rows[i].sure);
        assert_string_equal(f->words, rows[i].words);
        assert_string_equal(f->next, rows[i].next);
        assert_true(f->cases == rows[i].cases && f->hits == rows[i].best && f->next_hits == rows[i].second);
    }
}
