/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Slanted triangles as terms of a budget: the numbers of depthprec(7), how classes nest, and what is refused. */
#include <math.h>
#include <stdbool.h>

#include "depthprec/depthprec.h"
#include "support.h"

static const double pi = 3.14159265358979323846;

/* ---- Numbers ----------------------------------------------------------------------------------------------------- */

static double snapping_at(double fov_x, int width, int bits, double z) {
    const dp_spec reversed = {.znear = 0.1,
                              .zfar = INFINITY,
                              .mapping = DP_MAPPING_REVERSED,
                              .format = dp_spec_default().format,
                              .model = DP_MODEL_FP32};
    dp_setup setup;
    dp_triangles t = dp_triangles_default();
    dp_budget b;
    t.width = width;
    t.height = width * 9 / 16;
    t.fov_y = dp_fov_vertical(fov_x, t.width, t.height);
    t.subpixel = bits;
    t.slant_lo = 90.0;
    const dp_budget_terms terms = {.triangles = &t};
    assert_int_equal(dp_setup_init(&setup, &reversed), DP_OK);
    assert_int_equal(dp_budget_at(&setup, z, &terms, &b), DP_OK);
    return b.cause[DP_CAUSE_SNAPPING];
}

/* Numbers of the page, to their last digit. */
static void known_numbers(void **state) {
    (void)state;
    assert_scene(snapping_at(90.0, 1920, 8, 1.0), 5.75e-6, 0.5e-8);
    assert_scene(snapping_at(90.0, 1920, 4, 1.0), 9.2e-5, 0.5e-6);
    assert_scene(snapping_at(60.0, 1920, 8, 1.0), 3.32e-6, 0.5e-8);
    assert_scene(snapping_at(60.0, 1920, 4, 1.0), 5.3e-5, 0.5e-6);
    assert_scene(snapping_at(90.0, 3840, 8, 1.0), 2.877e-6, 0.5e-9);
    assert_scene(snapping_at(90.0, 1920, 8, 5000.0), 28.8e-3, 0.5e-4);
    assert_relative(dp_fov_vertical(90.0, 1920, 1080), 2.0 * atan(0.5625) * 180.0 / pi, 1e-14);
    assert_relative(dp_fov_vertical(60.0, 500, 500), 60.0, 1e-14);
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

static double separation_of(const dp_setup *setup, double z, const dp_triangles *t, dp_budget *out) {
    const dp_budget_terms terms = {.triangles = t};
    assert_int_equal(dp_budget_at(setup, z, &terms, out), DP_OK);
    return out->separation;
}

/* More is never less: of slants, of depths, of pixels, of slimness, of fewer bits; and all parts are the whole. */
static void test_order(void **state) {
    tally t = {.name = "larger classes"};
    rng r = rng_make("classes");
    (void)state;
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

static void refused(const dp_setup *setup, dp_triangles t) {
    const dp_budget_terms terms = {.triangles = &t};
    dp_budget b;
    assert_int_equal(dp_triangles_check(&t), DP_ERROR_TRIANGLES);
    assert_int_equal(dp_budget_at(setup, 1.0, &terms, &b), DP_ERROR_TRIANGLES);
}

static void test_refusals(void **state) {
    dp_spec spec = dp_spec_default();
    dp_setup setup;
    dp_budget b;
    const dp_triangles good = dp_triangles_default();
    dp_budget_terms terms = {.triangles = &good, .world = 1.0};
    (void)state;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    assert_int_equal(dp_triangles_check(&good), DP_OK);
    assert_int_equal(dp_triangles_check(NULL), DP_ERROR_NULL);
#define REFUSED(field, value)                                                                                          \
    do {                                                                                                               \
        dp_triangles bad = good;                                                                                       \
        bad.field = (value);                                                                                           \
        refused(&setup, bad);                                                                                          \
    } while (0)
    REFUSED(width, 0);
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
    assert_int_equal(dp_budget_at(&setup, 1.0, &terms, &b), DP_ERROR_TRIANGLES);
    spec.ortho = 1;
    terms.world = 0.0;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    assert_int_equal(dp_budget_at(&setup, 1.0, &terms, &b), DP_ERROR_TRIANGLES);
    static const char *const names[] = {"vertex", "origin", "origin-unfused", "origin-stepped"};
    assert_null(dp_anchor_get(DP_ANCHOR_COUNT));
    for (int i = 0; i < DP_ANCHOR_COUNT; i++)
        assert_string_equal(dp_anchor_get((dp_anchor)i)->name, names[i]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(known_numbers),
        cmocka_unit_test(test_order),
        cmocka_unit_test(test_refusals),
    };
    return run_tap(tests);
}
