/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Normals from depth against analytic ones and against a plain version with branches in double; borders, units of
 * length, lone pixels. Scenes and references are written here, without the rooms that the methods use.
 */
#include "named.h"
#include "views.h"

static const double PI = 3.14159265358979323846;

/* Places and normals in binary16. */
static bool is_half(const char *name) {
    return strstr(name, "-half") != NULL;
}

/* A number in binary16, of at most 65504; *near: so close to the middle of two that binary32 may decide either way. */
static double half_of(double x, bool *near) {
    int exponent;
    frexp(x, &exponent);
    const double step = ldexp(1, (exponent < -13 ? -13 : exponent) - 11), share = x / step;
    *near = *near || fabs(fabs(share - floor(share)) - 0.5) < 4e-7 * fabs(share);
    return rint(share) * step;
}

TEST(every_row_is_whole) {
    size_t count = 0;
    for (; normal_get(count) != NULL; count++) {
        const normal_row *m = normal_get(count);
        assert_ptr_equal(normal_find(m->name), m);
        assert_true(m->note[0] != '\0' && m->source != NULL && m->run != NULL && m->sides != NULL);
        assert_true(m->step >= 1 && m->step <= m->reach && m->reach <= NORMAL_REACH);
    }
    assert_int_equal(count, 9);
    assert_null(normal_find("highest"));
}

TEST(angles_are_not_cancelled) {
    for (double t = 1e-150; t < 3; t *= 7) {
        const double a[3] = {3e10, 0, 0}, b[3] = {cos(t) * 1e-9, sin(t) * 1e-9, 0};
        assert_relative(normal_angle(a, b), t, 1e-15 + 1e-16 / fmin(t, 1) * (t > 1e-3 ? 4 : 0));
    }
    assert_relative(normal_angle((double[]){0, 2, 0}, (double[]){0, -3, 0}), PI, 1e-15);
    assert_true(normal_angle((double[]){1, 2, 3}, (double[]){1, 2, 3}) == 0);
    assert_true(isnan(normal_angle((double[]){0, 0, 0}, (double[]){0, 1, 0})));
}

/* Depths without quantization, in images so small that the rounding of an eye depth does not show: only binary32 is
 * left. */
TEST(exact_depths_leave_binary32_alone) {
    rng r = rng_make("normal exact");
    tally t = {.name = "exact depths"};
    double worst = 0;
    for (uint64_t k = test_cases(300, 3000, 30000); k > 0; k--) {
        const bool ortho = rng_below(&r, 2) == 0;
        texture_camera c = view_camera("fp32", DP_MAPPING_REVERSED, 1e-3, 1e6, ortho, 9, 9, ortho ? 5 : 90);
        view_picture p = view_picture_of(&c);
        double n[3];
        const double d = view_tilted(&r, &c, 4, 4, 10, rng_uniform(&r, 0, 0.6), n);
        for (uint32_t j = 0; j < 9; j++)
            for (uint32_t i = 0; i < 9; i++)
                p.eye[j * 9 + i] = (float)view_plane(&c, n, d, i, j);
        for (size_t m = 0; normal_get(m) != NULL; m++) {
            view_run(normal_get(m), &c, &p);
            double found[3];
            view_normal(&p, 4, 4, found);
            const double angle = normal_angle(n, found);
            const bool half = is_half(normal_get(m)->name); /* pixels 2 apart at 10, in steps of 1/128 */
            worst = half ? worst : fmax(worst, angle);
            TALLY(&t, angle < (half ? 0.02 : 3e-6), "%s, %s: %g", normal_get(m)->name, ortho ? "ortho" : "perspective",
                  angle);
        }
        view_picture_free(&p);
    }
    assert_true(worst > 1e-7);
    tally_end(&t);
}

/* ---- A plain version -------------------------------------------------------------------------------------------- */

/* One axis: the offset of the neighbour that a method should take, 0 for none, in plain terms; *close when two sides
 * are so alike that binary32 may decide either way. */
static int plain_side(const char *name, bool ortho, const float at[9], bool odd, bool *close) {
    const bool far = strncmp(name, "medium", 6) == 0 || strncmp(name, "high", 4) == 0;
    const int step = far && strstr(name, "-1") == NULL ? 2 : 1;
    const double z = (double)at[4], a = (double)at[4 - step], b = (double)at[4 + step];
    double a2 = (double)at[4 - 2 * step], b2 = (double)at[4 + 2 * step];
    *close = false;
    if (strncmp(name, "low", 3) == 0)
        return odd ? -1 : 1;
    if (isnan(a) || isnan(b))
        return isnan(a) && isnan(b) ? 0 : isnan(b) ? -step : step;
    if (strncmp(name, "medium", 6) == 0)
        return a > b ? -step : step;
    if (isnan(a2) || isnan(b2))
        return isnan(b2) && !isnan(a2) ? -step : step;
    const bool inverse = strcmp(name, "projective") == 0 && !ortho;
    const double off_a = inverse ? fabs(2 / a - 1 / a2 - 1 / z) : fabs(2 * a - a2 - z);
    const double off_b = inverse ? fabs(2 / b - 1 / b2 - 1 / z) : fabs(2 * b - b2 - z);
    const double size = inverse ? 1 / a + 1 / a2 + 1 / b + 1 / b2 + 1 / z : a + a2 + b + b2 + z;
    *close = fabs(off_a - off_b) < 1e-5 * size;
    return off_a < off_b ? -step : step;
}

/* The slopes of a share of the picture in binary16, u from the left and v from below; the depth in binary16. */
static void kept_before(const texture_camera *c, double column, double row, double *sx, double *sy, double *z,
                        bool *near) {
    const double u = (column + 0.5) / c->width, v = 1 - (row + 0.5) / c->height;
    *sx = (2 * half_of(u, near) - 1) * c->half[0];
    *sy = (2 * half_of(v, near) - 1) * c->half[1];
    *z = half_of(*z, near);
}

/* The normal of the triangle in double, of places in binary16 where *near is not null, of neighbours that were `kept`
 * in it before. Returns how far binary32 may
 * turn it: places and differences are rounded. */
static double plain_normal(const texture_camera *c, const view_picture *p, uint32_t column, uint32_t row, int x, int y,
                           bool *near, bool kept, double out[3]) {
    const int64_t at[3][2] = {{column, row}, {(int64_t)column + x, row}, {column, (int64_t)row + y}};
    double q[3][3], size = 0, sides = 0, area = 0;
    for (int i = 0; i < 3; i++) {
        double sx, sy, z = (double)view_eye(p, at[i][0], at[i][1]);
        view_slopes(c, (double)at[i][0], (double)at[i][1], &sx, &sy);
        if (i > 0 && kept)
            kept_before(c, (double)at[i][0], (double)at[i][1], &sx, &sy, &z, near);
        q[i][0] = sx * (c->ortho ? 1 : z);
        q[i][1] = sy * (c->ortho ? 1 : z);
        q[i][2] = z;
        for (int k = 0; k < 3 && near != NULL; k++)
            q[i][k] = half_of(q[i][k], near);
        size = fmax(size, fabs(q[i][0]) + fabs(q[i][1]) + fabs(z));
        for (int k = 0; k < 3; k++)
            sides = fmax(sides, fabs(q[i][k] - q[0][k]));
    }
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        out[i] = (x > 0) == (y > 0) ? 1 : -1;
        out[i] *= (q[1][j] - q[0][j]) * (q[2][k] - q[0][k]) - (q[1][k] - q[0][k]) * (q[2][j] - q[0][j]);
        area = fmax(area, fabs(out[i]));
    }
    return 0x1p-20 * size * sides / area;
}

/* Slanted pieces at different depths, with some sky: something to choose at every turn. */
static void patchwork(rng *r, const texture_camera *c, view_picture *p) {
    for (uint32_t j = 0; j < p->height; j++)
        for (uint32_t i = 0; i < p->width; i++) {
            const uint32_t patch = i / 5 * 7 + j / 4 * 13;
            double n[3] = {sin(patch), cos(patch * 3), -1.5};
            const double z = view_plane(c, n, -1.5 * (5 + patch % 11), i, j);
            p->eye[j * p->width + i] = (float)(rng_below(r, 12) == 0 ? NAN : fmax(z, 0.1) * rng_uniform(r, 1, 1.01));
        }
}

TEST(methods_are_those_in_plain_words) {
    rng r = rng_make("normal plain");
    tally t = {.name = "plain"};
    uint64_t doubtful = 0;
    for (int k = 0; k < 24; k++) {
        const bool ortho = k % 2 == 1;
        texture_camera c =
            view_camera("fp32", DP_MAPPING_REVERSED, 0.1, 100, ortho, 40 + (uint32_t)k, 31, ortho ? 5 : 70);
        view_picture p = view_picture_of(&c);
        patchwork(&r, &c, &p);
        for (size_t m = 0; normal_get(m) != NULL; m++) {
            view_run(normal_get(m), &c, &p);
            for (uint32_t j = 0; j < c.height; j++)
                for (uint32_t i = 0; i < c.width; i++) {
                    float across[9], up[9];
                    bool close_x, close_y;
                    for (int o = -4; o <= 4; o++) {
                        across[4 + o] = view_eye(&p, (int64_t)i + o, j);
                        up[4 - o] = view_eye(&p, i, (int64_t)j + o); /* the first side is below */
                    }
                    const int x = plain_side(normal_get(m)->name, ortho, across, i % 2 == 1, &close_x);
                    const int y = -plain_side(normal_get(m)->name, ortho, up, j % 2 == 0, &close_y);
                    if (close_x || close_y) {
                        doubtful++;
                        continue;
                    }
                    double want[3], got[3];
                    const bool half = is_half(normal_get(m)->name);
                    bool near = false;
                    double rounding =
                        plain_normal(&c, &p, i, j, x, y, half ? &near : NULL, half && normal_get(m)->step == 2, want);
                    if (near) {
                        doubtful++;
                        continue;
                    }
                    rounding += half ? 0x1p-11 : 0; /* of the normal: a root of 3 of 2^-12 */
                    view_normal(&p, i, j, got);
                    const bool none = x == 0 || y == 0 || isnan(want[0] + want[1] + want[2]);
                    const double angle = normal_angle(want, got);
                    const double length = sqrt(got[0] * got[0] + got[1] * got[1] + got[2] * got[2]);
                    TALLY(&t, none ? isnan(got[0]) && isnan(got[1]) && isnan(got[2]) : angle < rounding,
                          "%s, %s at %u, %u: %g, %s", normal_get(m)->name, ortho ? "ortho" : "perspective", i, j, angle,
                          none ? "none expected" : "one expected");
                    TALLY(&t, none || fabs(length - 1) < (half ? 0x1p-11 : 3e-7), "length 1 + %g", length - 1);
                    for (int n = 0; n < 3 && half && !none; n++)
                        TALLY(&t, (near = false, half_of(got[n], &near)) == got[n], "%.17g is no half", got[n]);
                }
        }
        view_picture_free(&p);
    }
    assert_true(doubtful * 50 < t.cases);
    tally_end(&t);
}

/* A plane slanted by 60 degrees on a screen: what a step of u and v near 1 does, which is about a pixel. */
TEST(uv_in_binary16_is_seen_on_a_screen) {
    const double n[3] = {0, sin(PI / 3), -cos(PI / 3)};
    const texture_camera c = view_camera("fp32", DP_MAPPING_REVERSED, 0.1, 1000, false, 1920, 1080, 60);
    view_picture p = view_picture_of(&c);
    double sum = 0, most = 0;
    size_t seen = 0;
    for (uint32_t j = 0; j < c.height; j++)
        for (uint32_t i = 0; i < c.width; i++) {
            const double z = view_plane(&c, n, -10 * cos(PI / 3), i, j);
            p.eye[j * c.width + i] = (float)(z > 0.1 && z < 1000 ? z : (double)NAN);
        }
    view_run(normal_find("medium-half"), &c, &p);
    for (uint32_t j = 0; j < c.height; j++)
        for (uint32_t i = 0; i < c.width; i++) {
            double found[3];
            view_normal(&p, i, j, found);
            const double off = normal_angle(n, found) * 180 / PI;
            if (isnan(off))
                continue;
            sum += off;
            most = fmax(most, off);
            seen++;
        }
    print_message("# %zu pixels, %g degrees, at most %g\n", seen, sum / (double)seen, most);
    assert_true(sum / (double)seen > 4.4 && sum / (double)seen < 4.8 && most > 38 && most < 50);
    view_picture_free(&p);
}

/* The tail of a loop, a band of rows and a part of a row give the bits of the whole; so does another unit of length. */
TEST(parts_and_units_give_the_same_bits) {
    rng r = rng_make("normal bits");
    tally t = {.name = "bits"};
    texture_camera c = view_camera("fp32", DP_MAPPING_REVERSED, 0.1, 100, false, 67, 23, 60);
    view_picture whole = view_picture_of(&c), other = view_picture_of(&c);
    patchwork(&r, &c, &whole);
    const size_t bytes = sizeof(float) * 67 * 23;
    for (size_t m = 0; normal_get(m) != NULL; m++) {
        const normal_row *method = normal_get(m);
        view_run(method, &c, &whole);
        const bool half = is_half(method->name); /* binary16 has its own units */
        for (int power = half ? 0 : -36; power <= (half ? 0 : 60); power += 12) {
            for (size_t i = 0; i < 67 * 23; i++)
                other.eye[i] = ldexpf(whole.eye[i], power);
            for (uint32_t row = 0; row < 23; row += 5)
                view_run_rows(method, &c, &other, row, 5);
            for (int k = 0; k < 3; k++)
                TALLY(&t, memcmp(whole.normal[k], other.normal[k], bytes) == 0, "%s: other bits at 2^%d, plane %d",
                      method->name, power, k);
        }
        for (uint32_t column = 4; column < 63; column++)
            for (uint32_t count = 1; column + count <= 63; count += 7) {
                float slope[67], n[3][67];
                normal_rows in = {.camera = &c, .row = 11, .column = column, .count = count};
                for (uint32_t i = 0; i < 67; i++)
                    slope[i] = (float)camera_slope_x(&c, i);
                in.slope_x = slope + column;
                for (uint32_t k = 0; k <= 2 * NORMAL_REACH; k++)
                    in.rows[k] = whole.eye + (size_t)(11 + k - NORMAL_REACH) * 67 + column;
                method->run(&in, n[0], n[1], n[2]);
                for (int k = 0; k < 3; k++)
                    TALLY(&t, memcmp(n[k], whole.normal[k] + 11 * 67 + column, count * sizeof(float)) == 0,
                          "%s: other bits in columns %u + %u", method->name, column, count);
            }
    }
    view_picture_free(&whole);
    view_picture_free(&other);
    tally_end(&t);
}

/* Images of every small size, all of a plane: right wherever the neighbours that the method needs are there. */
TEST(borders_are_never_taken) {
    rng r = rng_make("normal border");
    tally t = {.name = "borders"};
    for (uint32_t width = 1; width <= 12; width++)
        for (uint32_t height = 1; height <= 12; height++)
            for (int ortho = 0; ortho < 2; ortho++) {
                texture_camera c =
                    view_camera("fp32", DP_MAPPING_REVERSED, 0.01, 1000, ortho != 0, width, height, ortho ? 5 : 10);
                view_picture p = view_picture_of(&c);
                double n[3];
                const double d = view_tilted(&r, &c, width / 2.0, height / 2.0, 10, 0.3, n);
                for (uint32_t j = 0; j < height; j++)
                    for (uint32_t i = 0; i < width; i++)
                        p.eye[j * width + i] = (float)view_plane(&c, n, d, i, j);
                for (size_t m = 0; normal_get(m) != NULL; m++) {
                    const normal_row *method = normal_get(m);
                    const uint32_t step = (uint32_t)method->step;
                    const bool quads = strncmp(method->name, "low", 3) == 0;
                    view_run(method, &c, &p);
                    for (uint32_t j = 0; j < height; j++)
                        for (uint32_t i = 0; i < width; i++) {
                            double found[3];
                            view_normal(&p, i, j, found);
                            const bool x = quads ? (i | 1) < width : i >= step || i + step < width;
                            const bool y = quads ? (j | 1) < height : j >= step || j + step < height;
                            const double most = is_half(method->name) ? 0.2 : 1e-4;
                            const bool right = x && y ? normal_angle(n, found) < most : isnan(found[0]);
                            TALLY(&t, right, "%s, %ux%u, pixel %u, %u: %g", method->name, width, height, i, j,
                                  normal_angle(n, found));
                        }
                }
                view_picture_free(&p);
            }
    tally_end(&t);
}

/* A one-pixel feature, far in front of or behind everything: no overflow, no normal that is not one. */
TEST(lone_pixels_are_harmless) {
    tally t = {.name = "lone pixels"};
    texture_camera c = view_camera("fp32", DP_MAPPING_REVERSED, 1e-6, 1e12, false, 11, 11, 60);
    view_picture p = view_picture_of(&c);
    for (double wall = 1e-6; wall < 2e12; wall *= 1e3)
        for (double spot = 1e-6; spot < 2e12; spot *= 1e3) {
            for (int i = 0; i < 121; i++)
                p.eye[i] = (float)(i == 60 ? spot : wall);
            for (size_t m = 0; normal_get(m) != NULL; m++) {
                view_run(normal_get(m), &c, &p);
                for (uint32_t i = 12; i < 108; i++) {
                    double n[3];
                    view_normal(&p, i % 11, i / 11, n);
                    const double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
                    const bool there = !isnan(length) || strcmp(normal_get(m)->name, "low") == 0 ||
                                       is_half(normal_get(m)->name) /* places coincide, or are too far away */;
                    const double off = is_half(normal_get(m)->name) ? 0x1p-11 : 3e-7;
                    TALLY(&t, there ? isnan(length) || fabs(length - 1) < off : i % 11 == 10 || i / 11 == 10,
                          "%s: wall %g, pixel %g: length %g at %u", normal_get(m)->name, wall, spot, length, i);
                }
            }
        }
    view_picture_free(&p);
    tally_end(&t);
}
