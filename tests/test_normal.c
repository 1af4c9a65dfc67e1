/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Normals from depth against analytic ones, against a plain version with branches in double, and against the bound of
 * depthprec(7) on planes. Scenes and references are written here, without the rooms that the methods use.
 */
#include <stdlib.h>
#include <string.h>

#include "support.h"
#include "texture/normal_measure.h"

static const double PI = 3.14159265358979323846;

/* ---- Cameras and planes
 * ---------------------------------------------------------------------------------------------- */

static texture_camera camera_of(const char *format, dp_mapping mapping, double znear, double zfar, bool ortho,
                                uint32_t width, uint32_t height, double extent) {
    dp_spec spec = dp_spec_default();
    dp_format formats[2];
    dp_setup setup;
    texture_camera camera;
    camera_spec view = camera_spec_default();
    assert_int_equal(dp_format_parse(format, formats), 1);
    spec.format = formats[0];
    spec.mapping = mapping;
    spec.znear = znear;
    spec.zfar = zfar;
    spec.ortho = ortho;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    view.width = width;
    view.height = height;
    view.fov_y = view.half_height = extent;
    assert_null(camera_init(&camera, &setup, &view));
    return camera;
}

/* The pixel grid from the definition in camera.h. */
static void slopes(const texture_camera *c, double column, double row, double *sx, double *sy) {
    *sx = (2 * ((column + 0.5) / c->width) - 1) * c->half[0];
    *sy = (2 * (1 - (row + 0.5) / c->height) - 1) * c->half[1];
}

static void unit(double v[3]) {
    const double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int i = 0; i < 3; i++)
        v[i] /= length;
}

/* n . p = d of a unit normal; the depth at a pixel. */
static double plane_at(const texture_camera *c, const double n[3], double d, double column, double row) {
    double sx, sy;
    slopes(c, column, row, &sx, &sy);
    return c->ortho ? (d - n[0] * sx - n[1] * sy) / n[2] : d / (n[0] * sx + n[1] * sy + n[2]);
}

/* A random plane through pixel (column, row) at depth z, its normal `tilt` away from the direction to the eye. */
static double tilted(rng *r, const texture_camera *c, double column, double row, double z, double tilt, double n[3]) {
    double sx, sy, ray[3] = {0, 0, -1};
    slopes(c, column, row, &sx, &sy);
    if (!c->ortho) {
        ray[0] = -sx;
        ray[1] = -sy;
    }
    unit(ray);
    double across[3] = {rng_uniform(r, -1, 1), rng_uniform(r, -1, 1), rng_uniform(r, -1, 1)};
    const double along = across[0] * ray[0] + across[1] * ray[1] + across[2] * ray[2];
    for (int i = 0; i < 3; i++)
        across[i] -= along * ray[i];
    unit(across);
    for (int i = 0; i < 3; i++)
        n[i] = cos(tilt) * ray[i] + sin(tilt) * across[i];
    const double scale = c->ortho ? 1 : z;
    return n[0] * sx * scale + n[1] * sy * scale + n[2] * z;
}

/* ---- An image in memory
 * ---------------------------------------------------------------------------------------------- */

typedef struct picture {
    uint32_t width, height;
    float *eye;
    float *normal[3];
} picture;

static picture picture_of(const texture_camera *c) {
    picture p = {c->width, c->height, NULL, {NULL}};
    p.eye = test_calloc((size_t)c->width * c->height, sizeof *p.eye);
    for (int i = 0; i < 3; i++)
        p.normal[i] = test_calloc((size_t)c->width * c->height, sizeof *p.eye);
    return p;
}

static void picture_free(picture *p) {
    test_free(p->eye);
    for (int i = 0; i < 3; i++)
        test_free(p->normal[i]);
}

static void give(void *context, uint32_t row, float *eye) {
    const picture *p = context;
    assert_true(row < p->height);
    memcpy(eye, p->eye + (size_t)row * p->width, p->width * sizeof *eye);
}

static void take(void *context, const normal_rows *in, const float *const normal[3]) {
    picture *p = context;
    for (int i = 0; i < 3; i++)
        memcpy(p->normal[i] + (size_t)in->row * p->width, normal[i], p->width * sizeof *normal[i]);
}

static void run(const normal_row *m, const texture_camera *c, picture *p) {
    assert_true(normal_run(m, c, 0, c->height, give, take, p));
}

static void found_at(const picture *p, uint32_t column, uint32_t row, double out[3]) {
    for (int i = 0; i < 3; i++)
        out[i] = (double)p->normal[i][(size_t)row * p->width + column];
}

static float eye_at(const picture *p, int64_t column, int64_t row) {
    if (column < 0 || row < 0 || column >= p->width || row >= p->height)
        return (float)NAN;
    return p->eye[row * p->width + column];
}

/* ---- Tests
 * ----------------------------------------------------------------------------------------------------------- */

static void every_row_is_whole(void **state) {
    (void)state;
    size_t count = 0;
    for (; normal_get(count) != NULL; count++) {
        const normal_row *m = normal_get(count);
        assert_ptr_equal(normal_find(m->name), m);
        assert_true(m->note[0] != '\0' && m->source != NULL && m->run != NULL && m->sides != NULL);
        assert_true(m->step >= 1 && m->step <= m->reach && m->reach <= NORMAL_REACH);
    }
    assert_int_equal(count, 6);
    assert_null(normal_find("highest"));
}

static void angles_are_not_cancelled(void **state) {
    (void)state;
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
static void exact_depths_leave_binary32_alone(void **state) {
    (void)state;
    rng r = rng_make("normal exact");
    tally t = {.name = "exact depths"};
    double worst = 0;
    for (uint64_t k = test_cases(300, 3000, 30000); k > 0; k--) {
        const bool ortho = rng_below(&r, 2) == 0;
        texture_camera c = camera_of("fp32", DP_MAPPING_REVERSED, 1e-3, 1e6, ortho, 9, 9, ortho ? 5 : 90);
        picture p = picture_of(&c);
        double n[3];
        const double d = tilted(&r, &c, 4, 4, 10, rng_uniform(&r, 0, 0.6), n);
        for (uint32_t j = 0; j < 9; j++)
            for (uint32_t i = 0; i < 9; i++)
                p.eye[j * 9 + i] = (float)plane_at(&c, n, d, i, j);
        for (size_t m = 0; normal_get(m) != NULL; m++) {
            run(normal_get(m), &c, &p);
            double found[3];
            found_at(&p, 4, 4, found);
            const double angle = normal_angle(n, found);
            worst = fmax(worst, angle);
            TALLY(&t, angle < 3e-6, "%s, %s: %g", normal_get(m)->name, ortho ? "ortho" : "perspective", angle);
        }
        picture_free(&p);
    }
    assert_true(worst > 1e-7);
    tally_end(&t);
}

/* The bound: never passed on planes of any tilt in any format, and reached by some. */
static void planes_are_within_the_bound(void **state) {
    (void)state;
    static const char *const formats[] = {"unorm16", "unorm24", "fp16", "fp32"};
    static const dp_mapping mappings[] = {DP_MAPPING_D3D, DP_MAPPING_REVERSED};
    static const struct {
        uint32_t width, height;
        double extent;
    } sizes[] = {{64, 48, 60}, {1920, 1080, 60}, {7, 5, 100}, {3840, 2160, 30}, {65536, 4096, 5}};
    const normal_row *method = normal_find("projective");
    rng r = rng_make("normal bound");
    tally t = {.name = "plane bound"};
    for (int kind = 0; kind < 16; kind++) {
        double used = 0, tight = 0;
        uint64_t certain = 0;
        for (uint64_t k = test_cases(400, 4000, 100000); k > 0; k--) {
            const size_t size = rng_below(&r, 5);
            const double ratio = rng_log(&r, 20, 1e5), znear = rng_log(&r, 1e-3, 10);
            texture_camera c =
                camera_of(formats[kind % 4], mappings[kind / 4 % 2], znear, znear * ratio, kind / 8 == 1,
                          sizes[size].width, sizes[size].height, kind / 8 == 1 ? znear * 10 : sizes[size].extent);
            const uint32_t column = 1 + (uint32_t)rng_below(&r, c.width - 2);
            const uint32_t row = 1 + (uint32_t)rng_below(&r, c.height - 2);
            const double grazing = rng_log(&r, 1e-4, PI / 2), tilt = PI / 2 - grazing;
            const double z = rng_log(&r, znear * 1.01, znear * ratio * 0.99);
            double n[3];
            const double d = tilted(&r, &c, column, row, z, tilt, n);
            float eye[5][5];
            bool inside = true;
            for (int j = -2; j <= 2; j++)
                for (int i = -2; i <= 2; i++) {
                    const double there = plane_at(&c, n, d, (double)column + i, (double)row + j);
                    const bool near_by = abs(i) + abs(j) <= 1, in_view = there >= znear && there <= znear * ratio;
                    inside = inside && (in_view || !near_by);
                    eye[2 + j][2 + i] = in_view ? (float)dp_stored(&c.setup, dp_code(&c.setup, there)) : (float)NAN;
                }
            const normal_plane plane = {{n[0], n[1], n[2]}, d};
            const double error = normal_plane_error(&c, column, row, &plane, 0x1p-24);
            if (!inside) {
                TALLY(&t, error == INFINITY, "a plane that leaves the view has error %g", error);
                continue;
            }
            const double bound = normal_plane_bound(&c, column, row, &plane, error);
            normal_rows in = {.camera = &c, .row = row, .column = column, .count = 1};
            float slope[2 * NORMAL_REACH + 1], lines[2 * NORMAL_REACH + 1][2 * NORMAL_REACH + 1], normal[3];
            for (int i = -NORMAL_REACH; i <= NORMAL_REACH; i++)
                slope[NORMAL_REACH + i] = (float)camera_slope_x(&c, (double)column + i);
            for (int j = 0; j <= 2 * NORMAL_REACH; j++) {
                for (int i = 0; i <= 2 * NORMAL_REACH; i++)
                    lines[j][i] = abs(i - NORMAL_REACH) <= 2 && abs(j - NORMAL_REACH) <= 2
                                      ? eye[j - NORMAL_REACH + 2][i - NORMAL_REACH + 2]
                                      : (float)NAN;
                in.rows[j] = lines[j] + NORMAL_REACH;
            }
            in.slope_x = slope + NORMAL_REACH;
            method->run(&in, &normal[0], &normal[1], &normal[2]);
            const double got[3] = {(double)normal[0], (double)normal[1], (double)normal[2]};
            const double angle = normal_angle(n, got);
            TALLY(&t, angle <= bound, "%s %s %s, near %g ratio %g z %g, %g from grazing, %ux%u at %u, %u: %g > %g",
                  formats[kind % 4], kind / 4 % 2 ? "reversed" : "d3d", kind / 8 ? "ortho" : "perspective", znear,
                  ratio, z, grazing, c.width, c.height, column, row, angle, bound);
            if (bound < PI / 2) {
                certain++;
                used = fmax(used, angle / bound);
                if (bound > 1e-4)
                    tight = fmax(tight, angle / bound);
            }
        }
        TALLY(&t, certain > 20 && tight > 0.4, "%s %s %s: at most %g of the bound, in %u planes", formats[kind % 4],
              kind / 4 % 2 ? "reversed" : "d3d", kind / 8 ? "ortho" : "perspective", used, (unsigned)certain);
    }
    tally_end(&t);
}

/* The corners of the cube of errors are the worst: no error within it does more, and some do nearly as much. */
static void the_bound_is_that_of_the_worst_errors(void **state) {
    (void)state;
    rng r = rng_make("normal corners");
    tally t = {.name = "worst errors"};
    double used = 0;
    for (uint64_t k = test_cases(300, 3000, 30000); k > 0; k--) {
        const bool ortho = rng_below(&r, 2) == 0;
        texture_camera c = camera_of("unorm24", DP_MAPPING_D3D, 0.1, 1000, ortho, 640, 480, ortho ? 5 : 60);
        const double column = (double)rng_below(&r, 640), row = (double)rng_below(&r, 480);
        double n[3];
        const double d = tilted(&r, &c, column, row, 10, rng_uniform(&r, 0, 1.5), n);
        const normal_plane plane = {{n[0], n[1], n[2]}, d};
        const double step = ortho ? 2 * c.half[1] / 480 : 2 * c.half[1] / 480 / 10; /* of a slope of 45 degrees */
        const double error = step * rng_log(&r, 1e-3, 2);
        const double bound = normal_plane_bound(&c, (uint32_t)column, (uint32_t)row, &plane, error);
        for (int trial = 0; trial < 40; trial++) {
            double places[3][3];
            const int x = rng_below(&r, 2) ? 1 : -1, y = rng_below(&r, 2) ? 1 : -1;
            for (int i = 0; i < 3; i++) {
                const double at_column = column + (i == 1 ? x : 0), at_row = row + (i == 2 ? y : 0);
                const double z = plane_at(&c, n, d, at_column, at_row);
                const double off = trial % 2 ? rng_uniform(&r, -error, error) : rng_below(&r, 2) ? error : -error;
                const double wrong = ortho ? z + off : 1 / (1 / z + off);
                double sx, sy;
                slopes(&c, at_column, at_row, &sx, &sy);
                places[i][0] = sx * (ortho ? 1 : wrong);
                places[i][1] = sy * (ortho ? 1 : wrong);
                places[i][2] = wrong;
                if (!(wrong > 0))
                    goto next; /* behind the eye: not an eye depth */
            }
            double a[3], b[3], cross[3];
            for (int i = 0; i < 3; i++) {
                a[i] = places[1][i] - places[0][i];
                b[i] = places[2][i] - places[0][i];
            }
            const double sign = x * y > 0 ? 1 : -1; /* row numbers grow downwards */
            for (int i = 0; i < 3; i++)
                cross[i] = sign * (a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3]);
            const double angle = normal_angle(n, cross);
            TALLY(&t, angle <= bound, "%s: error %g turns it by %g, bound %g", ortho ? "ortho" : "perspective", error,
                  angle, bound);
            used = fmax(used, bound < PI / 2 ? angle / bound : 0);
        }
    next:;
    }
    tally_end(&t);
    assert_true(used > 0.999);
}

/* ---- A plain version
 * ------------------------------------------------------------------------------------------------- */

/* One axis: the offset of the neighbour that a method should take, 0 for none, in plain terms; *close when two sides
 * are so alike that binary32 may decide either way. */
static int plain_side(const char *name, bool ortho, const float at[9], bool odd, bool *close) {
    const int step = strcmp(name, "medium") == 0 || strcmp(name, "high") == 0 ? 2 : 1;
    const double z = (double)at[4], a = (double)at[4 - step], b = (double)at[4 + step];
    double a2 = (double)at[4 - 2 * step], b2 = (double)at[4 + 2 * step];
    *close = false;
    if (strcmp(name, "low") == 0)
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

/* The normal of the triangle in double. Returns how far binary32 may turn it: places and differences are rounded. */
static double plain_normal(const texture_camera *c, const picture *p, uint32_t column, uint32_t row, int x, int y,
                           double out[3]) {
    const int64_t at[3][2] = {{column, row}, {(int64_t)column + x, row}, {column, (int64_t)row + y}};
    double q[3][3], size = 0, sides = 0, area = 0;
    for (int i = 0; i < 3; i++) {
        const double z = (double)eye_at(p, at[i][0], at[i][1]);
        double sx, sy;
        slopes(c, (double)at[i][0], (double)at[i][1], &sx, &sy);
        q[i][0] = sx * (c->ortho ? 1 : z);
        q[i][1] = sy * (c->ortho ? 1 : z);
        q[i][2] = z;
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
static void patchwork(rng *r, const texture_camera *c, picture *p) {
    for (uint32_t j = 0; j < p->height; j++)
        for (uint32_t i = 0; i < p->width; i++) {
            const uint32_t patch = i / 5 * 7 + j / 4 * 13;
            double n[3] = {sin(patch), cos(patch * 3), -1.5};
            const double z = plane_at(c, n, -1.5 * (5 + patch % 11), i, j);
            p->eye[j * p->width + i] = (float)(rng_below(r, 12) == 0 ? NAN : fmax(z, 0.1) * rng_uniform(r, 1, 1.01));
        }
}

static void methods_are_those_in_plain_words(void **state) {
    (void)state;
    rng r = rng_make("normal plain");
    tally t = {.name = "plain"};
    uint64_t doubtful = 0;
    for (int k = 0; k < 24; k++) {
        const bool ortho = k % 2 == 1;
        texture_camera c =
            camera_of("fp32", DP_MAPPING_REVERSED, 0.1, 100, ortho, 40 + (uint32_t)k, 31, ortho ? 5 : 70);
        picture p = picture_of(&c);
        patchwork(&r, &c, &p);
        for (size_t m = 0; normal_get(m) != NULL; m++) {
            run(normal_get(m), &c, &p);
            for (uint32_t j = 0; j < c.height; j++)
                for (uint32_t i = 0; i < c.width; i++) {
                    float across[9], up[9];
                    bool close_x, close_y;
                    for (int o = -4; o <= 4; o++) {
                        across[4 + o] = eye_at(&p, (int64_t)i + o, j);
                        up[4 - o] = eye_at(&p, i, (int64_t)j + o); /* the first side is below */
                    }
                    const int x = plain_side(normal_get(m)->name, ortho, across, i % 2 == 1, &close_x);
                    const int y = -plain_side(normal_get(m)->name, ortho, up, j % 2 == 0, &close_y);
                    if (close_x || close_y) {
                        doubtful++;
                        continue;
                    }
                    double want[3], got[3];
                    const double rounding = plain_normal(&c, &p, i, j, x, y, want);
                    found_at(&p, i, j, got);
                    const bool none = x == 0 || y == 0 || isnan(want[0] + want[1] + want[2]);
                    const double angle = normal_angle(want, got);
                    const double length = sqrt(got[0] * got[0] + got[1] * got[1] + got[2] * got[2]);
                    TALLY(&t, none ? isnan(got[0]) && isnan(got[1]) && isnan(got[2]) : angle < rounding,
                          "%s, %s at %u, %u: %g, %s", normal_get(m)->name, ortho ? "ortho" : "perspective", i, j, angle,
                          none ? "none expected" : "one expected");
                    TALLY(&t, none || fabs(length - 1) < 3e-7, "length 1 + %g", length - 1);
                }
        }
        picture_free(&p);
    }
    assert_true(doubtful * 50 < t.cases);
    tally_end(&t);
}

/* The tail of a loop, a band of rows and a part of a row give the bits of the whole; so does another unit of length. */
static void parts_and_units_give_the_same_bits(void **state) {
    (void)state;
    rng r = rng_make("normal bits");
    tally t = {.name = "bits"};
    texture_camera c = camera_of("fp32", DP_MAPPING_REVERSED, 0.1, 100, false, 67, 23, 60);
    picture whole = picture_of(&c), other = picture_of(&c);
    patchwork(&r, &c, &whole);
    const size_t bytes = sizeof(float) * 67 * 23;
    for (size_t m = 0; normal_get(m) != NULL; m++) {
        const normal_row *method = normal_get(m);
        run(method, &c, &whole);
        for (int power = -36; power <= 60; power += 12) {
            for (size_t i = 0; i < 67 * 23; i++)
                other.eye[i] = ldexpf(whole.eye[i], power);
            for (uint32_t row = 0; row < 23; row += 5)
                assert_true(normal_run(method, &c, row, 5, give, take, &other));
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
    picture_free(&whole);
    picture_free(&other);
    tally_end(&t);
}

/* Images of every small size, all of a plane: right wherever the neighbours that the method needs are there. */
static void borders_are_never_taken(void **state) {
    (void)state;
    rng r = rng_make("normal border");
    tally t = {.name = "borders"};
    for (uint32_t width = 1; width <= 12; width++)
        for (uint32_t height = 1; height <= 12; height++)
            for (int ortho = 0; ortho < 2; ortho++) {
                texture_camera c =
                    camera_of("fp32", DP_MAPPING_REVERSED, 0.01, 1000, ortho != 0, width, height, ortho ? 5 : 50);
                picture p = picture_of(&c);
                double n[3];
                const double d = tilted(&r, &c, width / 2.0, height / 2.0, 10, 0.3, n);
                for (uint32_t j = 0; j < height; j++)
                    for (uint32_t i = 0; i < width; i++)
                        p.eye[j * width + i] = (float)plane_at(&c, n, d, i, j);
                for (size_t m = 0; normal_get(m) != NULL; m++) {
                    const normal_row *method = normal_get(m);
                    const uint32_t step = (uint32_t)method->step;
                    const bool quads = strcmp(method->name, "low") == 0;
                    run(method, &c, &p);
                    for (uint32_t j = 0; j < height; j++)
                        for (uint32_t i = 0; i < width; i++) {
                            double found[3];
                            found_at(&p, i, j, found);
                            const bool x = quads ? (i | 1) < width : i >= step || i + step < width;
                            const bool y = quads ? (j | 1) < height : j >= step || j + step < height;
                            const bool right = x && y ? normal_angle(n, found) < 1e-4 : isnan(found[0]);
                            TALLY(&t, right, "%s, %ux%u, pixel %u, %u: %g", method->name, width, height, i, j,
                                  normal_angle(n, found));
                        }
                }
                picture_free(&p);
            }
    tally_end(&t);
}

/* A one-pixel feature, far in front of or behind everything: no overflow, no normal that is not one. */
static void lone_pixels_are_harmless(void **state) {
    (void)state;
    tally t = {.name = "lone pixels"};
    texture_camera c = camera_of("fp32", DP_MAPPING_REVERSED, 1e-6, 1e12, false, 11, 11, 60);
    picture p = picture_of(&c);
    for (double wall = 1e-6; wall < 2e12; wall *= 1e3)
        for (double spot = 1e-6; spot < 2e12; spot *= 1e3) {
            for (int i = 0; i < 121; i++)
                p.eye[i] = (float)(i == 60 ? spot : wall);
            for (size_t m = 0; normal_get(m) != NULL; m++) {
                run(normal_get(m), &c, &p);
                for (uint32_t i = 12; i < 108; i++) {
                    double n[3];
                    found_at(&p, i % 11, i / 11, n);
                    const double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
                    const bool there = !isnan(length) || strcmp(normal_get(m)->name, "low") == 0;
                    TALLY(&t, there ? isnan(length) || fabs(length - 1) < 3e-7 : i % 11 == 10 || i / 11 == 10,
                          "%s: wall %g, pixel %g: length %g at %u", normal_get(m)->name, wall, spot, length, i);
                }
            }
        }
    picture_free(&p);
    tally_end(&t);
}

/* ---- What is stated about scenes
 * -------------------------------------------------------------------------------------- */

/* A slanted wall, its lower half nearer by a step: edges that a method can pass on either side. */
static void stepped(const texture_camera *c, const double *p, double column, double row, scene_hit *out) {
    double n[3] = {p[1], p[2], -1};
    const bool near_one = row >= c->height / 2 + 1 && column >= c->width / 3 + 1;
    unit(n);
    *out = (scene_hit){.z = plane_at(c, n, n[2] * (near_one ? p[0] * p[3] : p[0]), column, row),
                       .normal = {n[0], n[1], n[2]},
                       .surface = near_one ? 2 : 1};
}

/* Measured in plain words: every pixel from run() and sides(). */
static void measures_count_what_they_say(void **state) {
    (void)state;
    const scene_row scene = {.name = "stepped", .hit = stepped};
    const double parameters[4] = {4, 1.0, 0.1, 0.9993};
    texture_camera c = camera_of("unorm24", DP_MAPPING_D3D, 0.3, 3000, false, 60, 40, 60);
    normal_measured by[6];
    for (size_t m = 0; normal_get(m) != NULL; m++) {
        const normal_row *method = normal_get(m);
        normal_measured *got = &by[m];
        assert_true(normal_measure(method, &c, &scene, parameters, 0, 40, got));
        picture p = picture_of(&c);
        for (uint32_t i = 0; i < 60 * 40; i++) {
            scene_hit hit;
            stepped(&c, parameters, i % 60, i / 60, &hit);
            p.eye[i] = (float)dp_stored(&c.setup, dp_code(&c.setup, hit.z));
        }
        run(method, &c, &p);
        uint64_t missing = 0, above[2] = {0, 0}, count[2] = {0, 0};
        double sum[2] = {0, 0}, most[2] = {0, 0};
        for (uint32_t i = 0; i < 60 * 40; i++) {
            scene_hit hit, beside;
            double found[3];
            found_at(&p, i % 60, i / 60, found);
            stepped(&c, parameters, i % 60, i / 60, &hit);
            bool edge = false;
            for (int k = method->step; k <= method->reach; k += method->step)
                for (int s = 0; s < 4; s++) {
                    const int x = (int)(i % 60) + (s == 0 ? k : s == 1 ? -k : 0);
                    const int y = (int)(i / 60) + (s == 2 ? k : s == 3 ? -k : 0);
                    stepped(&c, parameters, x, y, &beside);
                    edge = edge || x < 0 || y < 0 || x >= 60 || y >= 40 || beside.surface != hit.surface;
                }
            const double angle = normal_angle(hit.normal, found);
            if (isnan(angle)) {
                missing++;
                continue;
            }
            const normal_spread *s = edge ? &got->edges : &got->inside;
            count[edge]++;
            sum[edge] += angle;
            most[edge] = fmax(most[edge], angle);
            above[edge] += angle > s->p99 * (1 + 1e-6);
        }
        const normal_spread *spreads[2] = {&got->inside, &got->edges};
        assert_true(got->drawn == 2400 && got->sky == 0 && got->missing == missing);
        for (int e = 0; e < 2; e++) {
            assert_true(spreads[e]->count == count[e] && spreads[e]->max == most[e]);
            assert_relative(spreads[e]->mean, sum[e] / (double)count[e], 1e-12);
            assert_true(above[e] * 100 <= count[e] && spreads[e]->p99 <= spreads[e]->max);
        }
        picture_free(&p);
    }
    /* low and medium cannot help taking wrong sides; high does because z bends along a plane; 1/z does not. */
    assert_true(by[0].wrong > 50 && by[1].wrong > 50 && by[2].wrong > 30 && by[3].wrong > 30 && by[4].wrong > 10);
    assert_true(by[5].wrong == 0 && by[5].edges.max < 5e-5);
    for (size_t m = 0; m < 5; m++)
        assert_true(by[m].edges.max > 5e-3);
}

/* A sphere before a wall, the sphere's own normals as reference. */
static void ball(const texture_camera *c, const double *p, double column, double row, scene_hit *out) {
    double sx, sy;
    slopes(c, column, row, &sx, &sy);
    const double q = sx * sx + sy * sy + 1, e = p[0] * p[0] - p[1] * p[1], under = p[0] * p[0] - q * e;
    *out = (scene_hit){.z = p[2], .normal = {0, 0, -1}, .surface = 2};
    if (under < 0)
        return;
    const double z = e / (p[0] + sqrt(under));
    *out = (scene_hit){.z = z, .normal = {sx * z / p[1], sy * z / p[1], (z - p[0]) / p[1]}, .surface = 1};
}

static void spheres_and_their_outline(void **state) {
    (void)state;
    const scene_row scene = {.name = "ball", .hit = ball};
    const double parameters[4] = {10, 3, 14};
    texture_camera c = camera_of("fp32", DP_MAPPING_REVERSED, 0.1, 1000, false, 256, 256, 45);
    normal_measured by[6];
    for (size_t m = 0; normal_get(m) != NULL; m++)
        assert_true(normal_measure(normal_get(m), &c, &scene, parameters, 0, 256, &by[m]));
    for (size_t m = 0; normal_get(m) != NULL; m++)
        assert_true(by[m].inside.mean < 0.05 && by[m].inside.count > 55000);
    assert_true(by[0].wrong > 300 && by[1].wrong > 300 && by[3].wrong * 20 < by[2].wrong);
    assert_true(by[5].wrong * 20 < by[2].wrong && by[5].edges.mean * 5 < by[2].edges.mean);
    print_message("# wrong sides:");
    for (size_t m = 0; normal_get(m) != NULL; m++)
        print_message(" %s %u (edges: mean %.3g, of %u)", normal_get(m)->name, (unsigned)by[m].wrong, by[m].edges.mean,
                      (unsigned)by[m].edges.count);
    print_message("\n");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_row_is_whole),
        cmocka_unit_test(angles_are_not_cancelled),
        cmocka_unit_test(exact_depths_leave_binary32_alone),
        cmocka_unit_test(planes_are_within_the_bound),
        cmocka_unit_test(the_bound_is_that_of_the_worst_errors),
        cmocka_unit_test(methods_are_those_in_plain_words),
        cmocka_unit_test(parts_and_units_give_the_same_bits),
        cmocka_unit_test(borders_are_never_taken),
        cmocka_unit_test(lone_pixels_are_harmless),
        cmocka_unit_test(measures_count_what_they_say),
        cmocka_unit_test(spheres_and_their_outline),
    };
    return run_tap(tests);
}
