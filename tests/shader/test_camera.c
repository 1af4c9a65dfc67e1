/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The camera behind a depth image: what it refuses, where pixels look, and that its axes are what they should be. */
#include "shader/camera.h"
#include "support.h"

static dp_setup setup_of(int ortho) {
    dp_spec spec = dp_spec_default();
    dp_setup setup;
    spec.ortho = ortho;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    return setup;
}

static camera_spec spec_of(uint32_t width, uint32_t height) {
    camera_spec spec = camera_spec_default();
    spec.width = width;
    spec.height = height;
    return spec;
}

static texture_camera camera_of(int ortho, camera_spec spec) {
    const dp_setup setup = setup_of(ortho);
    texture_camera camera;
    assert_null(camera_init(&camera, &setup, &spec));
    return camera;
}

/* Each field beyond its range is named; the ends of the ranges are good. */
TEST(the_door) {
    const dp_setup perspective = setup_of(0), ortho = setup_of(1);
    texture_camera camera;
    static const struct {
        int ortho;
        camera_spec spec;
        const char *word;
    } bad[] = {
        {0, {.width = 0, .height = 9, .fov_y = 60}, "width"},
        {0, {.width = 9, .height = 65537, .fov_y = 60}, "height"},
        {0, {.width = 65536, .height = 65536, .fov_y = 60}, "pixels"},
        {0, {.width = 9, .height = 9, .fov_y = 0.0099}, "field of view"},
        {0, {.width = 9, .height = 9, .fov_y = 179.1}, "field of view"},
        {1, {.width = 9, .height = 9, .half_height = 9e-13}, "half the height"},
        {1, {.width = 9, .height = 9, .half_height = 2e12}, "half the height"},
        {0, {.width = 9, .height = 9, .fov_y = 60, .yaw = 361}, "yaw"},
        {0, {.width = 9, .height = 9, .fov_y = 60, .pitch = -91}, "pitch"},
        {0, {.width = 9, .height = 9, .fov_y = 60, .origin = {0, 0, 2e12}}, "coordinates"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        const char *wrong = camera_init(&camera, bad[i].ortho ? &ortho : &perspective, &bad[i].spec);
        assert_non_null(wrong);
        assert_non_null(strstr(wrong, bad[i].word));
    }
    camera_spec nan = spec_of(9, 9);
    nan.fov_y = NAN;
    assert_non_null(camera_init(&camera, &perspective, &nan));
    /* Fields that the other projection alone reads may be anything. */
    camera_spec odd = spec_of(65536, 4096);
    odd.half_height = -1;
    assert_null(camera_init(&camera, &perspective, &odd));
    odd.half_height = 1e12;
    odd.fov_y = 0;
    assert_null(camera_init(&camera, &ortho, &odd));
}

/* Known views: the corners of a 90 degree square, and a quarter turn. */
TEST(pixels_look_where_they_should) {
    camera_spec spec = spec_of(2, 2);
    spec.fov_y = 90;
    texture_camera camera = camera_of(0, spec);
    double view[3], world[3];
    camera_view(&camera, 0, 0, 10, view); /* top left: centres lie half-way to the edges */
    assert_relative(view[0], -5, 1e-15);
    assert_relative(view[1], 5, 1e-15);
    assert_true(view[2] == 10);
    assert_relative(camera_radial(&camera, 0, 0), sqrt(1.5), 1e-15);
    spec.yaw = 90;
    spec.origin[1] = 7;
    camera = camera_of(0, spec);
    camera_turn(&camera, (double[]){0, 0, 4}, world); /* forward is the world's x axis, to the right of z */
    assert_scene(world[0], 4, 1e-15);
    assert_scene(camera.origin[1] + world[1], 7, 1e-15);
    assert_scene(world[2], 0, 1e-15);
    spec.yaw = 0;
    spec.pitch = 90;
    camera = camera_of(0, spec);
    camera_turn(&camera, (double[]){1, 2, 4}, world); /* looking up, the view's up is the world's -z */
    assert_scene(world[0], 1, 1e-15);
    assert_scene(world[1], 4, 1e-15);
    assert_scene(world[2], -2, 1e-15);
    spec = spec_of(4, 2);
    spec.half_height = 3;
    camera = camera_of(1, spec);
    camera_view(&camera, 3, 1, 10, view);
    assert_scene(view[0], 4.5, 0);
    assert_scene(view[1], -1.5, 0);
    assert_true(camera_radial(&camera, 3, 1) == 1);
}

/* The view axis passes through what the camera looks at, and its right is level, in long double. */
TEST(looks_at) {
    rng r = rng_make("looks");
    tally t = {.name = "looks"};
    for (uint64_t n = test_cases(200, 2000, 20000); n > 0; n--) {
        camera_spec spec = spec_of(4, 3);
        const double far = rng_log(&r, 1e-3, 1e6);
        double at[3];
        long double length = 0;
        for (int k = 0; k < 3; k++) {
            spec.origin[k] = rng_uniform(&r, -1, 1);
            at[k] = spec.origin[k] + rng_uniform(&r, -far, far);
            length = hypotl(length, (long double)at[k] - (long double)spec.origin[k]);
        }
        assert_true(camera_look(&spec, at));
        const texture_camera c = camera_of(0, spec);
        for (int k = 0; k < 3; k++) {
            const double want = (double)(((long double)at[k] - (long double)spec.origin[k]) / length);
            TALLY(&t, fabs(c.axis[2][k] - want) < 1e-15, "ahead %d: %.17g, not %.17g", k, c.axis[2][k], want);
        }
        TALLY(&t, c.axis[0][1] == 0 && c.axis[1][1] >= 0, "leans");
    }
    tally_end(&t);
    camera_spec spec = spec_of(4, 3);
    assert_true(camera_look(&spec, (double[]){0, 0, 1e-300}) && spec.yaw == 0 && spec.pitch == 0);
    assert_true(camera_look(&spec, (double[]){0, 7, 0}) && spec.yaw == 0 && spec.pitch == 90);
    assert_true(camera_look(&spec, (double[]){0, -7, 0}) && spec.yaw == 0 && spec.pitch == -90);
    assert_true(camera_look(&spec, (double[]){-1e12, 0, 0}) && spec.yaw == -90 && spec.pitch == 0);
    assert_false(camera_look(&spec, (double[]){0, 0, 0}));
}

/* Right-angled axes of length 1 and left-handed; slopes to two units in the last place against long double. */
TEST(axes_and_slopes) {
    rng r = rng_make("camera");
    tally t = {.name = "cameras"};
    for (uint64_t n = test_cases(200, 2000, 20000); n > 0; n--) {
        camera_spec spec = spec_of(1 + (uint32_t)rng_below(&r, 4096), 1 + (uint32_t)rng_below(&r, 4096));
        spec.yaw = rng_uniform(&r, -360, 360);
        spec.pitch = rng_uniform(&r, -90, 90);
        spec.fov_y = rng_uniform(&r, 0.01, 179);
        const texture_camera c = camera_of(0, spec);
        for (int i = 0; i < 3; i++)
            for (int k = 0; k < 3; k++) {
                double dot = 0;
                for (int j = 0; j < 3; j++)
                    dot += c.axis[i][j] * c.axis[k][j];
                TALLY(&t, fabs(dot - (i == k)) < 1e-15, "axes %d and %d: %g", i, k, dot);
            }
        for (int j = 0; j < 3; j++) {
            const int k = (j + 1) % 3, l = (j + 2) % 3;
            const double cross = c.axis[0][k] * c.axis[1][l] - c.axis[0][l] * c.axis[1][k];
            TALLY(&t, fabs(cross - c.axis[2][j]) < 1e-15, "right x up is not forward");
        }
        const uint32_t column = (uint32_t)rng_below(&r, spec.width);
        const long double u = (column + 0.5L) / spec.width;
        const double want = (double)((2 * u - 1) * (long double)c.half[0]);
        TALLY(&t, fabs(camera_slope_x(&c, column) - want) <= 0x1p-51 * fabs(want) + 0x1p-63 * c.half[0],
              "column %u of %u: %.17g, not %.17g", column, spec.width, camera_slope_x(&c, column), want);
        TALLY(&t, camera_slope_x(&c, column) == -camera_slope_x(&c, spec.width - 1.0 - column), "not symmetrical");
        TALLY(&t, camera_slope_y(&c, 0) >= 0 && camera_slope_y(&c, 0) == -camera_slope_y(&c, spec.height - 1.0),
              "row 0 is not the top one");
    }
    tally_end(&t);
}
