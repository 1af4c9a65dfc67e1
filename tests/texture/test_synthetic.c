/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Synthetic images: what a pixel sees satisfies the surfaces' equations, written here in long double, and what is
 * stored of it is what the rational oracle stores.
 */
#include "named.h"
#include "oracle.h"
#include "support.h"
#include "texture/synthetic.h"

static texture_camera camera_of(const char *format, const char *mapping, bool ortho, uint32_t width, uint32_t height) {
    dp_format formats[2];
    dp_spec spec = dp_spec_default();
    dp_setup setup;
    texture_camera camera;
    camera_spec view = camera_spec_default();
    assert_true(dp_format_parse(format, formats) >= 1);
    spec.format = formats[0];
    spec.ortho = ortho;
    assert_int_equal(dp_mapping_parse(mapping, &spec.mapping), DP_OK);
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    view.width = width;
    view.height = height;
    view.fov_y = 75;
    assert_null(camera_init(&camera, &setup, &view));
    return camera;
}

TEST(every_row_is_whole) {
    size_t count = 0;
    for (; synthetic_get(count) != NULL; count++) {
        const synthetic_row *row = synthetic_get(count);
        double p[PARAMETERS_MAX];
        assert_ptr_equal(synthetic_find(row->name), row);
        parameter_defaults(row->parameters, p);
        for (size_t i = 0; i < PARAMETERS_MAX && row->parameters[i].name != NULL; i++) {
            assert_true(p[i] == row->parameters[i].value);
            assert_true(p[i] >= row->parameters[i].lo && p[i] <= row->parameters[i].hi);
            assert_true(row->parameters[i].note != NULL && row->parameters[i].unit != NULL);
        }
    }
    assert_int_equal(count, 4);
    assert_null(synthetic_find("teapot"));
}

/* The place of a hit in long double. */
static void place(const texture_camera *c, double column, double row, double z, long double p[3]) {
    const long double scale = c->ortho ? 1 : z;
    p[0] = ((2 * (long double)column + 1) / c->width - 1) * (long double)c->half[0] * scale;
    p[1] = (1 - (2 * (long double)row + 1) / c->height) * (long double)c->half[1] * scale;
    p[2] = z;
}

/* Unit, and on the camera's side of the surface. */
static bool faces(const texture_camera *c, const synthetic_hit *h, const long double p[3]) {
    const long double n[3] = {h->normal[0], h->normal[1], h->normal[2]};
    const long double length = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
    const long double towards = c->ortho ? n[2] : n[0] * p[0] + n[1] * p[1] + n[2] * p[2];
    return fabsl(length - 1) < 1e-12L && towards < 0;
}

TEST(planes_lie_in_their_plane) {
    rng r = rng_make("scene plane");
    tally t = {.name = "plane"};
    uint64_t seen = 0;
    for (uint64_t i = test_cases(2000, 40000, 400000); i > 0; i--) {
        const texture_camera c = camera_of("fp32", "reversed", rng_below(&r, 2), 640, 360);
        const double p[PARAMETERS_MAX] = {rng_log(&r, 0.2, 500), rng_uniform(&r, -89, 89), rng_uniform(&r, -89, 89)};
        const double column = rng_uniform(&r, 0, 639), row = rng_uniform(&r, 0, 359);
        synthetic_hit h;
        synthetic_find("plane")->hit(&c, p, column, row, &h);
        if (isinf(h.z)) {
            TALLY(&t, h.surface == 0, "sky with a surface");
            continue;
        }
        long double at[3];
        place(&c, column, row, h.z, at);
        const long double a = acosl(-1) / 180, tilt = p[0 + 1] * a, turn = p[2] * a;
        const long double n[3] = {cosl(tilt) * sinl(turn), sinl(tilt), -cosl(tilt) * cosl(turn)};
        const long double off = n[0] * at[0] + n[1] * at[1] + n[2] * (at[2] - p[0]);
        const long double size = fabsl(at[0]) + fabsl(at[1]) + fabsl(at[2]) + p[0];
        seen++;
        TALLY(&t, fabsl(off) < 1e-15L * size && faces(&c, &h, at) && h.z >= 0.1 && h.z <= 1000,
              "distance %g tilt %g turn %g at %g, %g: z %.17g is %Lg off", p[0], p[1], p[2], column, row, h.z, off);
        TALLY(&t, fabsl(n[0] - h.normal[0]) + fabsl(n[1] - h.normal[1]) + fabsl(n[2] - h.normal[2]) < 1e-15L, "normal");
    }
    assert_true(seen > t.cases / 10);
    tally_end(&t);
}

TEST(spheres_are_round_and_before_their_wall) {
    rng r = rng_make("scene sphere");
    tally t = {.name = "sphere"};
    uint64_t round = 0, walls = 0, sky = 0;
    for (uint64_t i = test_cases(2000, 40000, 400000); i > 0; i--) {
        const texture_camera c = camera_of("fp32", "reversed", rng_below(&r, 2), 360, 360);
        const double radius = rng_log(&r, 0.5, 3), wall = rng_below(&r, 2) ? rng_uniform(&r, 5, 12) : 0;
        const double p[PARAMETERS_MAX] = {radius + rng_uniform(&r, 0.2, 8), radius, wall};
        const double column = rng_uniform(&r, 0, 359), row = rng_uniform(&r, 0, 359);
        synthetic_hit h;
        long double at[3], ray[3];
        synthetic_find("sphere")->hit(&c, p, column, row, &h);
        place(&c, column, row, 1, ray);
        /* Is the sphere on the pixel's ray at all? */
        const long double across = ray[0] * ray[0] + ray[1] * ray[1], d = p[0];
        const long double miss = c.ortho ? sqrtl(across) : d * sqrtl(across / (1 + across));
        place(&c, column, row, h.z, at);
        if (h.surface == 1) {
            const long double off = sqrtl(at[0] * at[0] + at[1] * at[1] + (at[2] - d) * (at[2] - d)) - radius;
            round++;

            TALLY(&t, fabsl(off) < 1e-14L * d && faces(&c, &h, at) && (wall == 0 || h.z <= wall),
                  "%g %g %g at %g, %g: z %.17g is %Lg off", p[0], p[1], p[2], column, row, h.z, off);
        } else if (h.surface == 2) {
            walls++;
            TALLY(&t, h.z == wall && h.normal[2] == -1 && (miss > radius * (1 - 1e-12L) || wall < d), "wall");
        } else {
            sky++;
            TALLY(&t, isinf(h.z) && wall == 0 && miss > radius * (1 - 1e-12L), "sky");
        }
    }
    assert_true(round > 100 && walls > 100 && sky > 100);
    tally_end(&t);
}

/* Element i of n from lo to hi in equal ratios. */
static long double ratio(double lo, double hi, int i, int n) {
    return lo * powl((long double)hi / lo, (long double)i / (n - 1));
}

TEST(stairs_have_their_depths) {
    const texture_camera c = camera_of("fp32", "reversed", false, 700, 20);
    const double p[PARAMETERS_MAX] = {0.7, 400, 7};
    const synthetic_row *steps = synthetic_find("steps");
    synthetic_hit h;
    for (uint32_t x = 0; x < 700; x++) {
        steps->hit(&c, p, x, 3, &h);
        assert_int_equal(h.surface, 1 + x / 100);
        assert_relative(h.z, (double)ratio(0.7, 400, (int)(x / 100), 7), 1e-15);
        assert_true(h.normal[2] == -1);
    }
    steps->hit(&c, p, 0, 0, &h);
    assert_true(h.z == 0.7);
    steps->hit(&c, p, 699, 19, &h);
    assert_true(h.z == 400);
    synthetic_pair pair;
    for (size_t i = 0; i < 6; i++) { /* they meet where the columns of one end */
        assert_true(steps->pair(p, i, &pair));
        assert_relative(pair.front, (double)ratio(0.7, 400, (int)i, 7), 1e-15);
        assert_relative(pair.back, (double)ratio(0.7, 400, (int)i + 1, 7), 1e-15);
        assert_true(fabs(pair.at[0] * 700 - 100 * ((double)i + 1)) < 1e-9 && pair.at[1] == 0.5);
    }
    assert_false(steps->pair(p, 6, &pair));
    const double even[PARAMETERS_MAX] = {0.7, 400, 7, 1};
    for (uint32_t i = 0; i < 7; i++) {
        steps->hit(&c, even, 100 * i + 50, 3, &h);
        assert_relative(h.z, (double)(0.7L + (400 - 0.7L) * i / 6), 1e-15);
        assert_true((i > 0 || h.z == 0.7) && (i < 6 || h.z == 400));
    }
}

TEST(decals_stand_before_their_tiles) {
    const texture_camera c = camera_of("fp32", "reversed", false, 300, 240);
    const double p[PARAMETERS_MAX] = {0.125, 1, 300, 3};
    const synthetic_row *decals = synthetic_find("decals");
    uint64_t before = 0;
    for (uint32_t y = 0; y < 240; y++)
        for (uint32_t x = 0; x < 300; x++) {
            synthetic_hit h;
            const int tile = (int)(y / 80 * 3 + x / 100);
            const bool decal = x % 100 >= 25 && x % 100 < 75 && y % 80 >= 20 && y % 80 < 60;
            synthetic_pair pair;
            decals->hit(&c, p, x, y, &h);
            assert_true(decals->pair(p, (size_t)tile, &pair));
            assert_relative(pair.back, (double)ratio(1, 300, tile, 9), 1e-15);
            assert_true(pair.front == pair.back - 0.125);
            assert_true(h.z == (decal ? pair.front : pair.back));
            assert_true(fabs(pair.at[0] * 300 - (x / 100 * 100 + 50)) < 1e-9);
            assert_true(fabs(pair.at[1] * 240 - (y / 80 * 80 + 40)) < 1e-9);
            assert_int_equal(h.surface, 1 + 2 * tile + decal);
            before += decal;
        }
    assert_int_equal(before, 9 * 50 * 40);
    assert_false(decals->pair(p, 9, &(synthetic_pair){0}));
}

TEST(nothing_is_drawn_outside_the_planes) {
    const texture_camera c = camera_of("fp32", "reversed", false, 64, 64);
    const synthetic_row *steps = synthetic_find("steps");
    synthetic_hit h;
    steps->hit(&c, (double[]){0.09, 1001, 2, 0}, 0, 0, &h);
    assert_true(isinf(h.z) && h.surface == 0);
    steps->hit(&c, (double[]){0.09, 1001, 2, 0}, 63, 0, &h);
    assert_true(isinf(h.z));
    /* A decal before the near plane leaves the wall. */
    synthetic_find("decals")->hit(&c, (double[]){1, 1.05, 10, 2}, 16, 16, &h);
    assert_true(h.z == 1.05 && h.surface == 1);
    /* A sphere whose front is cut by the near plane is not drawn at all; the wall is. */
    synthetic_find("sphere")->hit(&c, (double[]){3.05, 3, 20}, 31.5, 31.5, &h);
    assert_true(h.z == 20);
}

TEST(what_is_stored_is_what_the_oracle_stores) {
    static const char *const formats[] = {"unorm16", "unorm24", "fp16", "fp32"};
    static const char *const mappings[] = {"d3d", "gl", "reversed", "linear", "log"};
    tally t = {.name = "codes"};
    rng r = rng_make("scene codes");
    for (size_t f = 0; f < 4; f++)
        for (size_t m = 0; m < 5; m++)
            for (size_t s = 0; synthetic_get(s) != NULL; s++) {
                const texture_camera c = camera_of(formats[f], mappings[m], false, 1100, 40);
                double p[PARAMETERS_MAX];
                uint32_t codes[1100];
                oracle o;
                oracle_init(&o, &c.setup.spec);
                parameter_defaults(synthetic_get(s)->parameters, p);
                if (s == 0)
                    p[1] = 70;
                for (int k = 0; k < 3; k++) {
                    const uint32_t row = (uint32_t)rng_below(&r, 40);
                    synthetic_codes(synthetic_get(s), &c, p, row, codes);
                    for (uint32_t x = 0; x < 1100; x += 1 + (uint32_t)rng_below(&r, m == 4 ? 200 : 20)) {
                        synthetic_hit h;
                        synthetic_get(s)->hit(&c, p, x, row, &h);
                        const uint32_t want = oracle_code(&o, isinf(h.z) ? 1000 : h.z);
                        TALLY(&t, codes[x] == want, "%s %s %s at %u, %u: z %.17g is %u, not %u", synthetic_get(s)->name,
                              formats[f], mappings[m], x, row, h.z, codes[x], want);
                    }
                }
                oracle_clear(&o);
            }
    tally_end(&t);
}
