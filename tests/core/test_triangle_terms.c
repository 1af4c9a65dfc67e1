/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Slanted triangles in a set-up: the numbers of depthprec(7), how classes nest, and what is refused. */
#include "depthprec/depthprec.h"
#include "setups.h"
#include "support.h"

static const double pi = 3.14159265358979323846;

/* ---- Numbers ----------------------------------------------------------------------------------------------------- */

/* Reversed, without a far plane: window depth is near/z. */
static dp_budget reversed_at(double znear, const dp_triangles *t, double z) {
    const dp_spec reversed = {.znear = znear,
                              .zfar = INFINITY,
                              .mapping = DP_MAPPING_REVERSED,
                              .format = dp_spec_default().format,
                              .model = DP_MODEL_FLOAT,
                              .triangles = *t};
    dp_setup setup;
    dp_budget b;
    assert_int_equal(dp_setup_init(&setup, &reversed), DP_OK);
    assert_int_equal(dp_budget_at(&setup, z, NULL, &b), DP_OK);
    return b;
}

static double snapping_at(double fov_x, int width, int bits, double z) {
    dp_triangles t = dp_triangles_default();
    t.width = width;
    t.height = width * 9 / 16;
    t.fov_y = dp_fov_vertical(fov_x, t.width, t.height);
    t.subpixel = bits;
    t.slant_lo = 90.0;
    return reversed_at(0.1, &t, z).cause[DP_CAUSE_SNAPPING];
}

/* Numbers of the page, to their last digit. */
TEST(known_numbers) {
    assert_scene(snapping_at(90.0, 1920, 8, 1.0), 5.75e-6, 0.5e-8);
    assert_scene(snapping_at(90.0, 1920, 4, 1.0), 9.2e-5, 0.5e-6);
    assert_scene(snapping_at(60.0, 1920, 8, 1.0), 3.32e-6, 0.5e-8);
    assert_scene(snapping_at(60.0, 1920, 4, 1.0), 5.3e-5, 0.5e-6);
    assert_scene(snapping_at(90.0, 3840, 8, 1.0), 2.877e-6, 0.5e-9);
    assert_scene(snapping_at(90.0, 1920, 8, 5000.0), 28.8e-3, 0.5e-4);
    assert_relative(dp_fov_vertical(90.0, 1920, 1080), 2.0 * atan(0.5625) * 180.0 / pi, 1e-14);
    assert_relative(dp_fov_vertical(60.0, 500, 500), 60.0, 1e-14);
}

/* Constants of the page: c1, c2, that of R alone, c3. */
static const double derived[DP_ANCHOR_COUNT][4] = {{2, 11, 2, 0}, {3, 10, 2, 4}, {3, 10, 2, 5}, {5, 8, 2, 5}};

/* The set-up's part by the formulas of the page, R by the class or by the slope; without terms of second order. */
static double setup_of(const dp_triangles *t, const double c[4], double z, bool by_slope) {
    const double eps = 0x1p-24, tau = 2.0 * tan(t->fov_y * pi / 360.0) / t->height;
    const double sine = sin(t->slant_lo * pi / 180.0), cosine = cos(t->slant_lo * pi / 180.0);
    const double seen = cosine + sine * 0.5 * tau * hypot(t->width, t->height);
    const double far_x = t->width + t->pixels, far_y = t->height + t->pixels;
    const double l = 0.5 * (1.0 + sqrt(t->slim * t->slim + 1.0));
    const double per_range = (c[1] * l + c[2]) * (1.0 + c[3] * eps * (far_x + far_y));
    const double slope = by_slope ? per_range * t->pixels : 0.0;
    const double tx = 3.0 * t->width + 6.0 * t->pixels + c[3] * far_x + slope;
    const double ty = 3.0 * t->height + 6.0 * t->pixels + c[3] * far_y + slope;
    const double range = by_slope ? 0.0 : t->depth - 1.0 / t->depth; /* in units of near/z, as is M */
    return 2.0 * eps * z * (tau * sine * hypot(tx, ty) + seen * (c[0] * t->depth + per_range * range));
}

/* Where each constant in turn takes most of it: never below the page, above it by second order alone. */
TEST(known_setup) {
    static const struct {
        int width, height;
        double fov_y, slant, depth, pixels, slim;
    } views[] = {{1920, 1080, 60, 30, 2, 512, 16},    {64, 48, 0.5, 10, 1.0001, 2, 2},  {640, 32768, 90, 89, 1.5, 4, 2},
                 {300, 200, 40, 60, 4, 1000, 900},    {300, 200, 40, 60, 900, 3, 100},  {32768, 300, 3, 80, 1.01, 1, 4},
                 {100, 80, 120, 90, 1.001, 30000, 2}, {333, 777, 20, 45, 1000, 1, 1000}};
    tally all = {.name = "eye and set-up"};
    for (size_t i = 0; i < sizeof views / sizeof views[0]; i++)
        for (int anchor = 0; anchor < DP_ANCHOR_COUNT; anchor++) {
            const double z = 3.0, slant = views[i].slant * pi / 180.0;
            const dp_triangles t = {.width = views[i].width,
                                    .height = views[i].height,
                                    .fov_y = views[i].fov_y,
                                    .plane = dp_anchor_get((dp_anchor)anchor)->plane,
                                    .slant_lo = views[i].slant,
                                    .slant_hi = views[i].slant,
                                    .depth = views[i].depth,
                                    .pixels = views[i].pixels,
                                    .slim = views[i].slim};
            const dp_budget b = reversed_at(0x1p-20, &t, z);
            const double tau = 2.0 * tan(t.fov_y * pi / 360.0) / t.height;
            const double ray = tau * hypot(0.5 * t.width + t.pixels, 0.5 * t.height + t.pixels);
            const double eye = 2.0 * 0x1p-24 * z * (cos(slant) + sin(slant) * ray);
            const double setup = fmin(setup_of(&t, derived[anchor], z, false), setup_of(&t, derived[anchor], z, true));
            const double is = b.cause[DP_CAUSE_SETUP], eye_is = b.cause[DP_CAUSE_EYE];
            TALLY(&all, eye_is >= eye && eye_is <= 1.001 * eye, "view %zu: the eye takes %.9g, not %.9g", i, eye_is,
                  eye);
            TALLY(&all, is >= setup * (1.0 - 1e-9) && is <= 1.002 * setup,
                  "view %zu, %s: the set-up takes %.9g, not %.9g", i, dp_anchor_get((dp_anchor)anchor)->name, is,
                  setup);
        }
    tally_end(&all);
}

/* Read back reversed and without a far plane a depth is off by 5 eps of itself: the nearer surface may be at z/k. */
TEST(test_read_back) {
    dp_spec spec = dp_spec_default();
    for (double k = 1.5; k < 40.0; k *= 2.0) {
        const double eps = 0x1p-24, z = 3.0, slant = 50.0;
        dp_triangles t = dp_triangles_default();
        dp_setup setup;
        dp_budget b;
        t.slant_lo = t.slant_hi = slant;
        t.depth = k;
        spec.mapping = DP_MAPPING_REVERSED;
        spec.znear = 0x1p-20;
        spec.zfar = INFINITY;
        spec.triangles = t;
        assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
        assert_int_equal(dp_budget_at(&setup, z, &(dp_budget_terms){.linearize = 1}, &b), DP_OK);
        const double ray = tan(t.fov_y * pi / 360.0) / t.height * hypot(t.width, t.height);
        const double seen = cos(slant * pi / 180.0) + sin(slant * pi / 180.0) * ray;
        assert_true(b.cause[DP_CAUSE_LINEARIZATION] >= (1.0 + k) * 5.0 * eps * z * seen);
        assert_true(b.cause[DP_CAUSE_LINEARIZATION] <= 2.0 * k * 5.0 * eps * z * seen * 1.001);
    }
}

/* ---- In a world -------------------------------------------------------------------------------------------------- */

/* The most that rounding a number up to x changes it by. */
static double half_step(double x) {
    return ldexp(1.0, ilogb(x) - 24);
}

/* Infinite far, positions relative to the camera: what the composition takes of triangles, or (null) facing. */
static double composition_of(dp_mapping mapping, double znear, const dp_triangles *t, double z) {
    dp_spec spec = dp_spec_default();
    dp_setup setup;
    dp_budget b;
    const dp_budget_terms terms = {.world = 100.0, .composition = DP_COMPOSITION_RELATIVE};
    spec.znear = znear;
    spec.zfar = INFINITY;
    spec.mapping = mapping;
    if (t != NULL)
        spec.triangles = *t;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    assert_int_equal(dp_budget_at(&setup, z, &terms, &b), DP_OK);
    return b.cause[DP_CAUSE_COMPOSITION];
}

/* By the formulas of the page: positions at most `lean` z long, without a constant two sums, with it three. */
TEST(known_world) {
    static const struct {
        dp_mapping mapping;
        int width, height;
        double fov_y, slant, pixels;
    } views[] = {{DP_MAPPING_REVERSED, 1920, 1080, 60, 30, 512}, {DP_MAPPING_REVERSED, 1920, 1080, 60, 90, 512},
                 {DP_MAPPING_REVERSED, 640, 800, 90, 5, 2000},   {DP_MAPPING_D3D, 1920, 1080, 60, 30, 512},
                 {DP_MAPPING_D3D, 640, 800, 90, 80, 20},         {DP_MAPPING_REVERSED, 3000, 100, 5, 89, 10}};
    const double eps = 0x1p-24, z = 3.0, k = 1.7, znear = 0.0625;
    tally all = {.name = "composition"};
    for (size_t i = 0; i < sizeof views / sizeof views[0]; i++) {
        dp_triangles t = dp_triangles_default();
        t.width = views[i].width;
        t.height = views[i].height;
        t.fov_y = views[i].fov_y;
        t.slant_lo = t.slant_hi = views[i].slant;
        t.pixels = views[i].pixels;
        t.depth = k;
        const double sine = sin(t.slant_lo * pi / 180.0), cosine = cos(t.slant_lo * pi / 180.0);
        const double tau = 2.0 * tan(t.fov_y * pi / 360.0) / t.height, at = k * z;
        const double ray[2] = {tau * (0.5 * t.width + t.pixels), tau * (0.5 * t.height + t.pixels)};
        const double factor[2] = {2.0 / (tau * t.width), 2.0 / (tau * t.height)};
        const double length = fmax(2.0, hypot(1.0, hypot(ray[0], ray[1]))) * at, position = eps * length;
        const double half = 0.5 * (length + at), w = eps * length + half_step(half) + half_step(at);
        double across[2];
        for (int axis = 0; axis < 2; axis++) {
            const double f = factor[axis], x = ray[axis] * at;
            across[axis] = eps * length + (half_step(0.5 * f * (length + x)) + half_step(f * x)) / f;
        }
        double want = (1.0 + k) * (position + sine * hypot(across[0], across[1]) + cosine * w);
        if (views[i].mapping == DP_MAPPING_D3D) /* clip z is off by more than w */
            want += 2.0 * z * (cosine + sine * tau * 0.5 * hypot(t.width, t.height)) / znear *
                    (2.0 * half_step(half + znear) + half_step(at) + half_step(half) + half_step(at));
        const double is = composition_of(views[i].mapping, znear, &t, z);
        TALLY(&all, is >= want * (1.0 - 1e-6) && is <= 1.003 * want, "view %zu: %.9g, not %.9g", i, is, want);
    }
    /* Facing, within 60 degrees of the axis: both depths' own, in place of what rounding them takes. */
    const double own = 4.0 * eps * z + half_step(1.5 * z) + half_step(z), want = 2.0 * own - 2.0 * half_step(z);
    const double is = composition_of(DP_MAPPING_REVERSED, znear, NULL, z);
    TALLY(&all, is >= want && is <= 1.03 * want, "facing: %.9g, not %.9g", is, want);
    tally_end(&all);
}

/*
 * Vertices that are moved by up to `own` on each axis are off their plane: the range of their depths, by the slope of
 * the plane, is more by what two of them are moved in window depth, and the largest depth by one. Of slim triangles
 * with few pixels and vertices near the eye that is a tenth of all that moving them takes.
 */
TEST(known_displaced) {
    static const double shares[] = {0.5, 0.3, 0.05}; /* how far, of the way from the eye to the nearest vertex */
    const double eps = 0x1p-24, z = 3.0, k = 50.0, znear = 0x1p-20;
    tally all = {.name = "displaced"};
    for (size_t i = 0; i < sizeof shares / sizeof shares[0]; i++)
        for (int anchor = 0; anchor < DP_ANCHOR_COUNT; anchor++) {
            const dp_triangles t = {.width = 1920,
                                    .height = 1080,
                                    .fov_y = 60,
                                    .plane = dp_anchor_get((dp_anchor)anchor)->plane,
                                    .slant_lo = 1,
                                    .slant_hi = 1,
                                    .depth = k,
                                    .pixels = 3,
                                    .slim = 1024};
            const dp_setup setup =
                SETUP("fp32", .znear = znear, .zfar = INFINITY, .mapping = DP_MAPPING_REVERSED, .triangles = t);
            const double off = shares[i] * z / k, nearest = z / k - off;
            dp_budget still, moved;
            assert_int_equal(dp_budget_at(&setup, z, NULL, &still), DP_OK);
            assert_int_equal(dp_budget_at(&setup, z, &(dp_budget_terms){.displaced = {.own = off / sqrt(3.0)}}, &moved),
                             DP_OK);
            const double ray = tan(t.fov_y * pi / 360.0) * hypot(1.0, 16.0 / 9.0);
            const double seen = cos(pi / 180.0) + sin(pi / 180.0) * ray;
            const double l = 0.5 * (1.0 + hypot(t.slim, 1.0)), *c = derived[anchor];
            const double per_range = (c[1] * l + c[2]) * (1.0 + c[3] * eps * (t.width + t.height + 2 * t.pixels));
            const double stray = z * z * (1.0 / nearest - k / z); /* in scene units at z, as all of window depth */
            const double setup_more = 2.0 * eps * seen * stray * (c[0] + per_range * 2.0);
            const double want = (1.0 + k) * off + setup_more, is = moved.separation - still.separation;
            TALLY(&all, setup_more > 0.005 * want && is >= want * (1.0 - 1e-9) && is <= 1.002 * want,
                  "%s, %g: %.9g, not %.9g, of which the set-up %.3g", dp_anchor_get((dp_anchor)anchor)->name, shares[i],
                  is, want, setup_more);
        }
    tally_end(&all);
}

/* ---- The class --------------------------------------------------------------------------------------------------- */

static dp_setup random_setup(rng *r) {
    dp_spec spec = dp_spec_default();
    dp_setup setup;
    spec.mapping = (dp_mapping)rng_below(r, DP_MAPPING_LINEAR);
    spec.znear = rng_log(r, 0.01, 10.0);
    spec.zfar = rng_below(r, 3) == 0 ? INFINITY : spec.znear * rng_log(r, 10.0, 1e6);
    spec.format = dp_format_get(rng_below(r, dp_format_count()))->format;
    spec.arith = rng_below(r, dp_arith_count());
    spec.model = DP_MODEL_FLOAT;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    return setup;
}

static dp_triangles random_view(rng *r) {
    dp_triangles t = dp_triangles_default();
    t.width = (int)rng_log(r, 1.5, 32768.5);
    t.height = (int)rng_log(r, 1.5, 32768.5);
    t.fov_y = rng_uniform(r, 0.01, 179.0);
    t.subpixel = (int)rng_below(r, 9);
    t.plane = dp_anchor_get((dp_anchor)rng_below(r, DP_ANCHOR_COUNT))->plane;
    return t;
}

/* In the model float it is also the separation. */
static double separation_of(const dp_setup *facing, double z, const dp_triangles *t, dp_budget *out) {
    dp_spec spec = facing->spec;
    dp_setup setup;
    spec.triangles = *t;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    assert_int_equal(dp_budget_at(&setup, z, NULL, out), DP_OK);
    assert_true(dp_separation(&setup, z) == out->separation);
    const dp_setup again = dp_setup_facing(&setup);
    assert_true(dp_separation(&again, z) == dp_separation(facing, z));
    return out->separation;
}

/* More is never less: of slants, of depths, of pixels, of slimness, of fewer bits; and all parts are the whole. */
TEST(test_order) {
    tally t = {.name = "larger classes"};
    rng r = rng_make("classes");
    for (uint64_t i = test_cases(500, 20000, 200000); i > 0; i--) {
        const dp_setup setup = random_setup(&r);
        dp_triangles class = random_view(&r);
        dp_budget facing, less, greater;
        const double z = rng_log(&r, setup.spec.znear, fmin(setup.spec.zfar, setup.spec.znear * 1e5));
        class.slant_lo = rng_uniform(&r, 0.0, 80.0);
        class.slant_hi = rng_uniform(&r, class.slant_lo, 90.0);
        class.depth = rng_log(&r, 1.001, 8.0);
        class.pixels = rng_log(&r, 1.001, 2000.0);
        class.slim = rng_log(&r, 2.001, 500.0);
        dp_triangles more = class, flat = class;
        switch (rng_below(&r, 5)) {
        case 0:
            more.slant_lo *= rng_unit(&r);
            more.slant_hi = rng_uniform(&r, more.slant_hi, 90.0);
            break;
        case 1:
            more.depth *= rng_log(&r, 1.0, 4.0);
            break;
        case 2:
            more.pixels *= rng_log(&r, 1.0, 4.0);
            break;
        case 3:
            more.slim *= rng_log(&r, 1.0, 2.0);
            break;
        default:
            more.subpixel -= more.subpixel > 1 ? 1 : 0;
        }
        flat.slant_lo = flat.slant_hi = 0.0;
        assert_int_equal(dp_budget_at(&setup, z, NULL, &facing), DP_OK);
        const double one = separation_of(&setup, z, &class, &less);
        const double two = separation_of(&setup, z, &more, &greater);
        double sum = 0.0;
        for (int k = 0; k < DP_CAUSE_COUNT; k++)
            sum += less.cause[k];
        TALLY(&t, one >= facing.separation && two >= one * (1.0 - 1e-12), "%g, %g, %g at %.17g", facing.separation, one,
              two, z);
        TALLY(&t, isinf(one) || fabs(sum - one) <= 1e-12 * one, "parts %.17g of %.17g", sum, one);
        TALLY(&t, separation_of(&setup, z, &flat, &greater) == facing.separation, "facing, %.17g", z);
    }
    tally_end(&t);
}

/* ---- A range ----------------------------------------------------------------------------------------------------- */

/* The least separation at the far end of a range, by the page: snapping at the steepest slant alone. */
static double least_of(const dp_triangles *t, double z) {
    const double tau = 2.0 * tan(t->fov_y * pi / 360.0) / t->height;
    const double grid = t->subpixel > 0 ? ldexp(1.0, -t->subpixel - 1) : 0.0;
    return 2.0 * tau * z * grid * sqrt(2.0) * sin(t->slant_hi * pi / 180.0);
}

/* A depth of a range: anywhere, or some binary32 numbers beside a power of two, where errors jump. */
static double depth_within(rng *r, double lo, double hi) {
    const double z = rng_log(r, lo, hi);
    const double edge = ldexp(1.0, ilogb(z)) * (1.0 + ldexp((double)rng_below(r, 9) - 4.0, -23));
    return rng_below(r, 2) == 0 && edge >= lo && edge <= hi ? edge : z;
}

/* The bound over a range holds at its depths, and is no more than 2^-10 above one that is reached. */
TEST(test_range) {
    tally all = {.name = "range holds at its depths"}, tight = {.name = "range is reached"};
    rng r = rng_make("slanted ranges");
    uint64_t finite = 0;
    for (uint64_t i = test_cases(60, 1000, 20000); i > 0; i--) {
        dp_spec spec = random_setup(&r).spec;
        dp_separation_worst w, limited;
        dp_setup setup;
        spec.triangles = random_view(&r);
        spec.triangles.slant_lo = rng_below(&r, 2) == 0 ? 0.0 : rng_uniform(&r, 0.0, 80.0);
        spec.triangles.slant_hi = rng_uniform(&r, spec.triangles.slant_lo, 90.0);
        spec.triangles.depth = rng_log(&r, 1.001, 100.0);
        assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
        const dp_setup facing = dp_setup_facing(&setup);
        const double last = fmin(spec.zfar, spec.znear * 1e6), lo = rng_log(&r, spec.znear, last);
        const double hi = fmin(lo * rng_log(&r, 1.0, rng_below(&r, 2) == 0 ? 1.01 : 1e4), last);
        assert_int_equal(dp_separation_over(&setup, lo, hi, 0.0, &w), DP_OK);
        TALLY(&tight, w.bound >= w.separation && w.separation == dp_separation(&setup, w.z) && w.z >= lo && w.z <= hi,
              "%.17g of %.17g at %.17g", w.separation, w.bound, w.z);
        TALLY(&tight, isinf(w.bound) ? isinf(w.separation) : w.bound <= w.separation * (1.0 + 0x1.1p-10),
              "%.17g is no bound of %.17g, %.17g to %.17g", w.bound, w.separation, lo, hi);
        TALLY(&all, w.bound >= least_of(&spec.triangles, hi), "%.17g at %.17g", w.bound, hi);
        finite += isfinite(w.bound) ? 1 : 0;
        for (int k = 0; k < 50; k++) {
            const double z = depth_within(&r, lo, hi), s = dp_separation(&setup, z),
                         of_point = dp_separation(&facing, z);
            const double most = s > of_point ? w.bound * (1.0 + 1e-12) : 2.0 * w.bound; /* of points see bounds.h */
            TALLY(&all, s <= most, "%.17g at %.17g, bound %.17g over %.17g to %.17g", s, z, w.bound, lo, hi);
        }
        if (isinf(w.bound) || w.bound == w.separation)
            continue;
        const double limit = w.separation + 0.5 * (w.bound - w.separation);
        assert_int_equal(dp_separation_over(&setup, lo, hi, limit, &limited), DP_OK);
        TALLY(&tight, limited.bound <= limit || limited.separation > limit, "%.17g and %.17g about %.17g",
              limited.separation, limited.bound, limit);
    }
    assert_true(finite > all.cases / 200);
    tally_end(&all);
    tally_end(&tight);
}

static void refused(dp_spec spec, dp_triangles t) {
    dp_setup setup;
    assert_int_equal(dp_triangles_check(&t), DP_ERROR_TRIANGLES);
    assert_non_null(dp_triangles_fault(&t));
    spec.triangles = t;
    assert_int_equal(dp_setup_init(&setup, &spec), t.width == 0 ? DP_OK : DP_ERROR_TRIANGLES); /* 0: they face it */
}

TEST(test_refusals) {
    dp_spec spec = dp_spec_default();
    dp_setup setup;
    dp_budget b;
    const dp_triangles good = dp_triangles_default();
    const dp_budget_terms terms = {.world = 1.0};
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    assert_int_equal(dp_triangles_check(&good), DP_OK);
    assert_int_equal(dp_triangles_check(NULL), DP_ERROR_NULL);
    assert_null(dp_triangles_fault(&good));
    assert_string_equal(dp_triangles_fault(NULL), dp_status_text(DP_ERROR_NULL));
#define REFUSED(field, value)                                                                                          \
    do {                                                                                                               \
        dp_triangles bad = good;                                                                                       \
        bad.field = (value);                                                                                           \
        refused(spec, bad);                                                                                            \
    } while (0)
    REFUSED(width, 0);
    REFUSED(width, -1);
    REFUSED(height, 32769);
    REFUSED(fov_y, 0.0);
    REFUSED(fov_y, 179.95);
    REFUSED(fov_y, NAN);
    REFUSED(subpixel, -1);
    REFUSED(subpixel, 9);
    REFUSED(plane.value, -1.0);
    REFUSED(plane.box, NAN);
    REFUSED(plane.range, INFINITY);
    REFUSED(plane.origin, -1.0);
    REFUSED(slant_lo, 91.0);
    REFUSED(slant_lo, -1.0);
    REFUSED(slant_hi, 90.5);
    REFUSED(slant_hi, NAN);
    REFUSED(depth, 0.5);
    REFUSED(pixels, 0.5);
    REFUSED(slim, 1.5);
    REFUSED(slim, 1025.0);
    assert_int_equal(dp_budget_at(&setup, 1.0, &terms, &b), DP_OK);
    spec.triangles = good;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    assert_int_equal(dp_budget_at(&setup, 1.0, &terms, &b), DP_OK);
    spec.ortho = 1;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_ERROR_TRIANGLES);
    static const char *const names[] = {"vertex", "origin", "origin-unfused", "origin-stepped"};
    assert_null(dp_anchor_get(DP_ANCHOR_COUNT));
    for (int i = 0; i < DP_ANCHOR_COUNT; i++)
        assert_string_equal(dp_anchor_get((dp_anchor)i)->name, names[i]);
}
