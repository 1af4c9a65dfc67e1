/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Places of pixels: the exact one against rationals, the rows against their bounds and against known answers. */
#include <float.h>

#include <gmp.h>

#include "named.h"
#include "shader/half.h"
#include "shader/position.h"
#include "support.h"

static texture_camera camera_of(const dp_spec *spec, const camera_spec *where) {
    dp_setup setup;
    texture_camera camera;
    assert_int_equal(dp_setup_init(&setup, spec), DP_OK);
    assert_null(camera_init(&camera, &setup, where));
    return camera;
}

/* A camera of any kind; `origin` is how far from 0 it may stand, in units of near, or 0. */
static texture_camera random_camera(rng *r, double ratio, double origin) {
    dp_spec spec = dp_spec_default();
    camera_spec where = camera_spec_default();
    do
        spec.mapping = (dp_mapping)rng_below(r, DP_MAPPING_COUNT);
    while (dp_mapping_get(spec.mapping)->log_from_near); /* of which no images are read */
    const dp_mapping_row *row = dp_mapping_get(spec.mapping);
    spec.ortho = row->ortho && rng_below(r, 3) == 0;
    spec.znear = rng_log(r, 1e-6, 1e5);
    spec.zfar = spec.znear * (1 + rng_log(r, 0.1, ratio));
    if (row->far_infinite && !spec.ortho && rng_below(r, 6) == 0)
        spec.zfar = INFINITY;
    where.width = 1 + (uint32_t)rng_below(r, 5000);
    where.height = 1 + (uint32_t)rng_below(r, 5000);
    where.fov_y = rng_uniform(r, 1, 150);
    where.half_height = spec.znear * rng_log(r, 0.1, 1e3);
    where.yaw = rng_uniform(r, -180, 180);
    where.pitch = rng_uniform(r, -90, 90);
    for (int k = 0; k < 3 && origin > 0; k++)
        where.origin[k] = fmin(rng_log(r, 1e-2, origin) * spec.znear, 1e12) * rng_uniform(r, -1, 1);
    return camera_of(&spec, &where);
}

static float random_window(rng *r) {
    const double away = rng_log(r, 1e-7, 1);
    return rng_below(r, 2) == 0 ? (float)away : 1 - (float)away;
}

static double length(const double v[3]) {
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/* How far a row is off at one pixel; INFINITY when it gives no number. */
static double error_of(const position_row *row, const position_state *s, uint32_t i, uint32_t j, float d) {
    double relative[3];
    float place[3];
    row->run(s, j, i, &d, 1, &place[0], &place[1], &place[2]);
    position_exact(s->camera, j, i, (double)d, relative, NULL);
    return position_off(s->camera, relative, place);
}

/* ---- Exactly ----------------------------------------------------------------------------------------------------- */

/* The eye depth and the two slopes as fractions, then the camera's doubles as they are. */
static void rational_place(const texture_camera *c, uint32_t row, uint32_t column, double d, mpq_t relative[3]) {
    const dp_spec *s = &c->setup.spec;
    mpq_t n, f, t, q, z, slope[2], x;
    mpq_inits(n, f, t, q, z, slope[0], slope[1], x, NULL);
    mpq_set_d(n, s->znear);
    mpq_set_d(t, d);
    mpq_set_ui(x, 1, 1);
    mpq_sub(q, x, t);
    if (c->setup.reversed)
        mpq_swap(t, q);
    if (isinf(s->zfar)) {
        mpq_div(z, n, q);
    } else if (s->ortho) {
        mpq_set_d(f, s->zfar);
        mpq_mul(z, n, q);
        mpq_mul(x, f, t);
        mpq_add(z, z, x);
    } else {
        mpq_set_d(f, s->zfar);
        mpq_mul(z, f, q);
        mpq_mul(x, n, t);
        mpq_add(x, z, x);
        mpq_mul(z, n, f);
        mpq_div(z, z, x);
    }
    mpq_set_si(slope[0], 2 * (long)column + 1 - (long)c->width, c->width);
    mpq_set_si(slope[1], (long)c->height - 2 * (long)row - 1, c->height);
    for (int i = 0; i < 2; i++) {
        mpq_canonicalize(slope[i]);
        mpq_set_d(x, c->half[i]);
        mpq_mul(slope[i], slope[i], x);
        if (!c->ortho)
            mpq_mul(slope[i], slope[i], z);
    }
    for (int k = 0; k < 3; k++) {
        mpq_set_d(x, c->axis[2][k]);
        mpq_mul(relative[k], x, z);
        for (int i = 0; i < 2; i++) {
            mpq_set_d(x, c->axis[i][k]);
            mpq_mul(x, x, slope[i]);
            mpq_add(relative[k], relative[k], x);
        }
    }
    mpq_clears(n, f, t, q, z, slope[0], slope[1], x, NULL);
}

TEST(exact_places) {
    rng r = rng_make("places");
    tally t = {.name = "places"};
    mpq_t want[3], x;
    mpq_inits(want[0], want[1], want[2], x, NULL);
    double worst = 0;
    for (uint64_t n = test_cases(500, 5000, 50000); n > 0; n--) {
        const texture_camera c = random_camera(&r, 1e12, 1e9);
        if (c.setup.spec.mapping == DP_MAPPING_LINEAR || c.setup.curve == DP_CURVE_LOG)
            continue; /* the eye depths of these are tested in test_decode */
        const uint32_t column = (uint32_t)rng_below(&r, c.width), row = (uint32_t)rng_below(&r, c.height);
        const double d = (double)random_window(&r);
        double relative[3], world[3], off[3], distance;
        position_exact(&c, row, column, d, relative, world);
        rational_place(&c, row, column, d, want);
        distance = length(relative);
        float rounded[3];
        for (int k = 0; k < 3; k++) {
            mpq_set_d(x, relative[k]);
            mpq_sub(x, x, want[k]);
            off[k] = mpq_get_d(x);
            mpq_set_d(x, c.origin[k]);
            mpq_add(x, x, want[k]);
            const double place = mpq_get_d(x);
            TALLY(&t, fabs(world[k] - place) <= 0x1p-52 * fabs(place) + 2e-14 * distance, "world: %.17g, not %.17g",
                  world[k], place);
            rounded[k] = (float)world[k];
        }
        worst = fmax(worst, length(off) / distance);
        TALLY(&t, length(off) <= 1e-14 * distance, "off by %g of the distance", length(off) / distance);
        /* The measure of a rounded place is as exact, far from the origin too. */
        for (int k = 0; k < 3; k++) {
            mpq_set_d(x, c.origin[k]);
            mpq_add(want[k], want[k], x);
            mpq_set_d(x, (double)rounded[k]);
            mpq_sub(x, x, want[k]);
            off[k] = mpq_get_d(x);
        }
        const double got = position_off(&c, relative, rounded);
        TALLY(&t, fabs(got - length(off)) <= 1e-14 * (distance + length(off)), "%g away, not %g", got, length(off));
    }
    mpq_clears(want[0], want[1], want[2], x, NULL);
    print_message("# worst share of the distance %.3g\n", worst);
    tally_end(&t);
}

/* ---- Rows -------------------------------------------------------------------------------------------------------- */

enum { ROWS = 8 };

/* Errors never pass their bounds; in some camera each row reaches a share of its bound. */
static void hold(const char *name, double ratio, double origin, double share) {
    rng r = rng_make(name);
    tally t = {.name = name};
    double most[ROWS] = {0};
    size_t rows = 0;
    for (uint64_t n = test_cases(300, 4000, 40000); n > 0; n--) {
        const texture_camera c = random_camera(&r, ratio, origin);
        position_state s;
        position_prepare(&s, &c);
        for (rows = 0; position_get(rows) != NULL; rows++) {
            const position_row *row = position_get(rows);
            for (int k = 0; k < 16 && position_applies(row, &c); k++) {
                const uint32_t i = (uint32_t)rng_below(&r, c.width), j = (uint32_t)rng_below(&r, c.height);
                const float d = random_window(&r);
                const double bound = position_bound(row, &c, i, j, d), error = error_of(row, &s, i, j, d);
                double relative[3];
                position_exact(&c, j, i, (double)d, relative, NULL);
                TALLY(&t, error <= bound, "%s, %s%s, n %.17g, f %.17g, d %.9g at %u, %u of %u, %u: %g above %g",
                      row->name, dp_mapping_get(c.setup.spec.mapping)->name, c.ortho ? " ortho" : "",
                      c.setup.spec.znear, c.setup.spec.zfar, (double)d, i, j, c.width, c.height, error, bound);
                if (bound < 0.1 * (length(relative) + length(c.origin)))
                    most[rows] = fmax(most[rows], error / bound);
            }
        }
    }
    assert_true(rows <= ROWS);
    for (size_t i = 0; i < rows; i++) {
        print_message("# %s, %s: %.3g of the bound\n", name, position_get(i)->name, most[i]);
        TALLY(&t, most[i] > share, "%s: at most %g of its bound", position_get(i)->name, most[i]);
    }
    tally_end(&t);
}

TEST(bounds_at_the_origin) {
    hold("origin", 1e6, 0, 0.25);
}

TEST(bounds_far_from_the_origin) {
    hold("far away", 1e4, 1e6, 0.25);
}

/* In any camera "view" is within 9.3 units of the distance, and two units of the way to the origin more. */
TEST(view_keeps_its_promise) {
    rng r = rng_make("promise");
    tally t = {.name = "promise"};
    for (uint64_t n = test_cases(1000, 10000, 100000); n > 0; n--) {
        const texture_camera c = random_camera(&r, 1e12, rng_below(&r, 2) == 0 ? 0 : 1e6);
        if (c.setup.curve == DP_CURVE_LOG)
            continue; /* its exponent's error grows with the logarithm of far */
        position_state s;
        position_prepare(&s, &c);
        const uint32_t i = (uint32_t)rng_below(&r, c.width), j = (uint32_t)rng_below(&r, c.height);
        const float d = random_window(&r);
        double relative[3];
        position_exact(&c, j, i, (double)d, relative, NULL);
        const double bound = position_bound(position_find("view"), &c, i, j, d), origin = length(c.origin);
        const double promise = (origin > 0 ? 10.3 : 9.3) * length(relative) + 2 * origin;
        TALLY(&t, bound <= promise * (0x1p-24 + 0x1p-41), "%s%s, d %.9g: %g of %g units",
              dp_mapping_get(c.setup.spec.mapping)->name, c.ortho ? " ortho" : "", (double)d, bound * 0x1p24, promise);
    }
    tally_end(&t);
}

/* The rows' loops over any length and place of a line give the bits of one pixel at a time. */
TEST(loops_have_no_edges) {
    enum { WIDTH = 1500 };
    static float d[WIDTH], one[3][WIDTH], all[3][WIDTH];
    rng r = rng_make("loops");
    for (int n = 0; n < 12; n++) {
        texture_camera c = random_camera(&r, 1e4, 10);
        c.width = WIDTH;
        position_state s;
        position_prepare(&s, &c);
        for (int i = 0; i < WIDTH; i++)
            d[i] = i % 100 == 37 ? (float)NAN : random_window(&r);
        for (size_t k = 0; position_get(k) != NULL; k++) {
            if (!position_applies(position_get(k), &c))
                continue;
            for (uint32_t i = 0; i < WIDTH; i++)
                position_get(k)->run(&s, 5, i, &d[i], 1, &one[0][i], &one[1][i], &one[2][i]);
            assert_true(isnan(one[0][37]) && isnan(one[1][37]) && isnan(one[2][37]));
            for (int times = 0; times < 20; times++) {
                const uint32_t from = (uint32_t)rng_below(&r, WIDTH), count = (uint32_t)rng_below(&r, WIDTH + 1 - from);
                position_get(k)->run(&s, 5, from, d + from, count, all[0] + from, all[1] + from, all[2] + from);
                for (int p = 0; p < 3; p++)
                    assert_memory_equal(all[p] + from, one[p] + from, count * sizeof(float));
            }
        }
    }
}

/* ---- Facts ------------------------------------------------------------------------------------------------------- */

/* binary16 ends at 65504: places beyond are infinite, and those below are rounded to 11 bits. */
TEST(half_overflows) {
    dp_spec spec = dp_spec_default();
    camera_spec where = camera_spec_default();
    where.width = where.height = 1; /* the one pixel looks straight ahead */
    spec.mapping = DP_MAPPING_REVERSED;
    spec.znear = 1;
    spec.zfar = INFINITY;
    const texture_camera c = camera_of(&spec, &where);
    position_state s;
    position_prepare(&s, &c);
    const position_row *row = position_find("extents-half");
    static const struct {
        double z, want;
    } known[] = {{1, 1},         {2.5, 2.5},        {2049, 2048},    {2051, 2052},      {65504, 65504},
                 {65519, 65504}, {65528, INFINITY}, {1e6, INFINITY}, {4096.0 / 3, 1365}};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        const float d = (float)(1 / known[i].z);
        float x, y, z;
        row->run(&s, 0, 0, &d, 1, &x, &y, &z);
        assert_true((double)z == known[i].want);
        assert_true(isinf(error_of(row, &s, 0, 0, d)) == isinf(known[i].want));
    }
    assert_true(isinf(position_bound(row, &c, 0, 0, 1e-6f)));
    assert_true(position_bound(row, &c, 0, 0, 0.5f) < 2 * 0x1p-10);
}

static float binary16(int code) {
    const int power = code >> 10, digits = code & 1023;
    return power > 0 ? ldexpf((float)(1024 + digits), power - 25) : ldexpf((float)digits, -24);
}

static void expect_half(float x, float want) {
    for (int sign = 0; sign < 2; sign++, x = -x, want = -want) {
        assert_true(half_of(x) == want);
        assert_true(fabsf(x) >= 0x1p115f || half_below(x) == want);
        assert_true(fabsf(x) > 65504 || (half_within(x) == want && signbit(half_within(x)) == signbit(want)));
    }
}

/* Every number of binary16 stays; between two the nearer one is taken, and in the middle the even one. */
TEST(every_half_is_rounded_to) {
    for (int code = 0; code <= 0x7bff; code++) {
        const float here = binary16(code), middle = 0.5f * (here + binary16(code + 1));
        const float next = code < 0x7bff ? binary16(code + 1) : (float)INFINITY;
        expect_half(here, here);
        expect_half(nextafterf(middle, 0), here);
        expect_half(middle, code % 2 == 0 ? here : next);
        expect_half(nextafterf(middle, INFINITY), next);
    }
    for (int power = 16; power < 128; power++) {
        expect_half(ldexpf(1, power), INFINITY);
        expect_half(nextafterf(ldexpf(2, power), 0), INFINITY);
    }
    expect_half(FLT_MIN, 0);
    assert_true(isinf(half_of(INFINITY)) && half_of(-INFINITY) < 0);
    assert_true(isnan(half_of(NAN)) && isnan(half_below(-NAN)) && isnan(half_within(NAN)));
}

/* At 0.1 to 1000 the usual rows are off by half a unit and more near the far plane, ours by less than a thousandth. */
TEST(the_standard_direction_costs_digits) {
    dp_spec spec = dp_spec_default();
    camera_spec where = camera_spec_default();
    where.width = 1920;
    where.height = 1080;
    where.yaw = 30;
    for (int reversed = 0; reversed < 2; reversed++) {
        spec.mapping = reversed ? DP_MAPPING_REVERSED : DP_MAPPING_D3D;
        const texture_camera c = camera_of(&spec, &where);
        position_state s;
        position_prepare(&s, &c);
        for (size_t k = 0; position_get(k) != NULL; k++) {
            const char *name = position_get(k)->name;
            double worst = 0;
            for (int i = 1; i < 300; i++) {
                const float d = reversed ? (float)i * 0x1p-22f : 1 - (float)i * 0x1p-22f;
                worst = fmax(worst, error_of(position_get(k), &s, 100, 100, d));
            }
            if (strcmp(name, "view") == 0)
                assert_true(worst < 5e-4);
            else if (strcmp(name, "extents-half") != 0)
                assert_true(reversed ? worst < 1e-3 : worst > 0.3);
        }
    }
}

/* Errors of rows that add the camera's place last grow with it by two units; the matrix's by that times z/n, 100 here.
 */
TEST(far_from_the_origin) {
    dp_spec spec = dp_spec_default();
    camera_spec where = camera_spec_default();
    where.width = where.height = 64;
    where.yaw = 20;
    for (int k = 0; k < 3; k++)
        where.origin[k] = 12345.678 * (k + 1);
    const texture_camera c = camera_of(&spec, &where);
    position_state s;
    position_prepare(&s, &c);
    double worst[ROWS] = {0};
    for (size_t k = 0; position_get(k) != NULL; k++)
        for (uint32_t i = 0; i < 64; i++)
            worst[k] = fmax(worst[k], error_of(position_get(k), &s, i, 63 - i, 0.99f));
    const double unit = length(c.origin) * 0x1p-24;
    for (size_t k = 0; position_get(k) != NULL; k++)
        if (strcmp(position_get(k)->name, "matrix") == 0)
            assert_true(worst[k] > 10 * unit);
        else if (strcmp(position_get(k)->name, "extents-half") != 0)
            assert_true(worst[k] > 0.2 * unit && worst[k] < 2.1 * unit);
}

/* The matrix and its inverse are each other's; both directions, both NDCs, both projections. */
TEST(matrices_invert) {
    rng r = rng_make("matrices");
    tally t = {.name = "matrices"};
    for (int n = 0; n < 3000; n++) {
        const texture_camera c = random_camera(&r, 100, 3);
        double m[16], inverse[16];
        if (!position_applies(position_find("matrix"), &c)) {
            TALLY(&t, isnan(position_condition(&c)), "a matrix of %s", dp_mapping_get(c.setup.spec.mapping)->name);
            continue;
        }
        position_matrix(&c, m);
        position_inverse(&c, inverse);
        for (int i = 0; i < 4; i++)
            for (int k = 0; k < 4; k++) {
                double sum = 0, size = 0;
                for (int j = 0; j < 4; j++) {
                    sum += inverse[4 * i + j] * m[4 * j + k];
                    size += fabs(inverse[4 * i + j] * m[4 * j + k]);
                }
                TALLY(&t, fabs(sum - (i == k)) <= 1e-14 * (size + 1), "%d, %d: %g", i, k, sum);
            }
        /* A point of the far plane, or behind all, has NDC 1 or 0 or -1 there. */
        double clip[4], p[4] = {0, 0, 0, 1}, z = isinf(c.setup.spec.zfar) ? 2 * c.setup.spec.znear : c.setup.spec.zfar;
        for (int k = 0; k < 3; k++)
            p[k] = c.origin[k] + z * c.axis[2][k];
        for (int i = 0; i < 4; i++) {
            clip[i] = 0;
            for (int k = 0; k < 4; k++)
                clip[i] += m[4 * i + k] * p[k];
        }
        const double d = isinf(c.setup.spec.zfar) ? 0.5 : c.setup.reversed ? 0 : 1;
        const double want = dp_mapping_get(c.setup.spec.mapping)->ndc_signed ? 2 * d - 1 : d;
        TALLY(&t, fabs(clip[2] / clip[3] - want) < 1e-12, "NDC %g, not %g", clip[2] / clip[3], want);
    }
    tally_end(&t);
}

/* Two matrices whose singular values are known. */
TEST(condition_numbers) {
    dp_spec spec = dp_spec_default();
    camera_spec where = camera_spec_default();
    where.width = where.height = 8;
    where.half_height = 4;
    spec.ortho = 1;
    spec.znear = 1e-9;
    spec.zfar = 8;
    texture_camera c = camera_of(&spec, &where);
    assert_relative(position_condition(&c), 8, 1e-6); /* 1/4, 1/4, 1/8 and 1 */
    spec.ortho = 0;
    spec.znear = 2;
    spec.zfar = INFINITY;
    where.fov_y = 90;
    c = camera_of(&spec, &where); /* clip z = z - 2, w = z: the 2 by 2 block has trace 6 and determinant 4 */
    assert_relative(position_condition(&c), sqrt((6 + sqrt(20)) / (6 - sqrt(20))), 1e-12);
    where.origin[2] = 1e12;
    where.yaw = 10;
    spec.znear = 1e-9;
    c = camera_of(&spec, &where);
    assert_true(isinf(position_condition(&c)));
    position_state s;
    position_prepare(&s, &c); /* nothing aborts; the row gives no number */
    assert_true(isinf(position_bound(position_find("matrix"), &c, 1, 1, 0.5f)));
}

TEST(names) {
    size_t i = 0;
    for (; position_get(i) != NULL; i++)
        assert_ptr_equal(position_find(position_get(i)->name), position_get(i));
    assert_int_equal(i, 5);
    assert_null(position_find("matrices"));
    dp_spec spec = dp_spec_default();
    camera_spec where = camera_spec_default();
    where.width = where.height = 4;
    spec.mapping = DP_MAPPING_LINEAR;
    texture_camera c = camera_of(&spec, &where);
    assert_false(position_applies(position_find("matrix"), &c));
    assert_true(position_applies(position_find("extents"), &c));
    spec.mapping = DP_MAPPING_D3D;
    spec.ortho = 1;
    c = camera_of(&spec, &where);
    assert_true(position_applies(position_find("matrix"), &c));
    assert_false(position_applies(position_find("rays"), &c));
}
