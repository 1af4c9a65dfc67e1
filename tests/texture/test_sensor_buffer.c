/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The depth buffer behind levels that are even in 1/z: of images whose depths were rounded to codes of 16 and 24 bits
 * here, in long double, planes are named as they were or not at all; of planes that nobody would choose, of disparity,
 * and of levels that are not found, nothing is named.
 */
#include "support.h"
#include "texture/metric.h"
#include "texture/sensor_buffer.h"

enum { W = 96, H = 64, N = W * H };

static void store(const double *z, image *img) {
    float *samples = malloc(N * sizeof *samples);
    assert_non_null(samples);
    for (int i = 0; i < N; i++)
        samples[i] = (float)z[i];
    *img = (image){.width = W, .height = H, .channels = 1, .type = IMAGE_F32, .data = samples};
}

/* The depths of a wavy surface from lo to hi, as a buffer gives them back. */
static void render(rng *r, double znear, double zfar, int bits, double lo, double hi, double *z) {
    const long double inverse_far = isinf(zfar) ? 0 : 1 / (long double)zfar;
    const long double span = 1 / (long double)znear - inverse_far, most = ldexpl(1, bits) - 1;
    const double phase = rng_uniform(r, 0.02, 0.4), tilt = rng_uniform(r, 0.2, 0.8);
    for (int i = 0; i < N; i++) {
        const double wave = 0.5 + 0.4 * sin(phase * (i % W + 1.7 * (i / W))) * tilt + 0.1 * (rng_unit(r) - 0.5);
        const long double d = (1 / (long double)znear - 1 / ((long double)lo + (hi - lo) * (long double)wave)) / span;
        z[i] = (double)(1 / (1 / (long double)znear - rintl(d * most) / most * span));
    }
}

static bool name(const double *z, sensor_buffer *out) {
    image img;
    metric m;
    double lo = INFINITY, hi = 0;
    store(z, &img);
    for (int i = 0; i < N; i++) {
        lo = fmin(lo, (double)(float)z[i]);
        hi = fmax(hi, (double)(float)z[i]);
    }
    assert_null(metric_convert(&img, 1, INFINITY, NULL, &m));
    const bool named = sensor_buffer_find(&m.sensor, lo, hi, out);
    assert_true(named == (out->bits > 0) && (!named || m.sensor.found));
    image_free(&img);
    return named;
}

static double round_to(double x, int digits) {
    char text[32];
    snprintf(text, sizeof text, "%.*e", digits - 1, x);
    return strtod(text, NULL);
}

TEST(planes_come_out) {
    tally t = {.name = "planes"};
    rng r = rng_make("planes");
    const uint64_t cases = test_cases(20, 60, 1500);
    uint64_t named[2] = {0, 0};
    static double z[N];
    for (uint64_t i = 0; i < cases; i++) {
        const int bits = i % 2 == 0 ? 16 : 24, digits = 1 + (int)rng_below(&r, 2);
        const double znear = round_to(rng_log(&r, 0.01, 0.5), digits);
        const double zfar = i % 5 == 0 ? INFINITY : round_to(rng_log(&r, 30, 2000), digits);
        const double hi = rng_uniform(&r, 5, 25);
        sensor_buffer b;
        render(&r, znear, zfar, bits, 1, hi, z);
        if (!name(z, &b))
            continue;
        named[i % 2]++;
        TALLY(&t, b.bits == bits && b.znear == znear && b.zfar == zfar, "%d bits, %g to %g: named %d, %.17g to %.17g",
              bits, znear, zfar, b.bits, b.znear, b.zfar);
        TALLY(&t, b.znear_off < 1e-4 * znear && isinf(zfar) == isnan(b.zfar_off), "off by %g and %g", b.znear_off,
              b.zfar_off);
    }
    print_message("# named %llu of %llu of 16 bits, %llu of 24\n", (unsigned long long)named[0],
                  (unsigned long long)cases / 2, (unsigned long long)named[1]);
    assert_true(named[0] * 40 > cases); /* about half of those of 16 bits; of 24 bits a few pixels tell little */
    tally_end(&t);
}

/* Planes with many digits, and bits that no format has. */
TEST(planes_of_nobody) {
    tally t = {.name = "nobody"};
    rng r = rng_make("nobody");
    static double z[N];
    for (uint64_t i = 0; i < test_cases(6, 30, 1000); i++) {
        sensor_buffer b;
        const bool odd = i % 3 == 0;
        const double znear = odd ? 0.1 : rng_log(&r, 0.01, 0.5), zfar = odd ? 100 : rng_log(&r, 30, 2000);
        render(&r, znear, zfar, odd ? 15 + 2 * (int)rng_below(&r, 2) : 16, 1, 20, z);
        TALLY(&t, !name(z, &b), "%.17g to %.17g: named %d bits, %g to %g", znear, zfar, b.bits, b.znear, b.zfar);
    }
    tally_end(&t);
}

/* Random levels, known as well as those of images are and better: of disparity, or of nothing. */
TEST(random_levels) {
    tally t = {.name = "levels"};
    rng r = rng_make("levels");
    const uint64_t cases = test_cases(300, 2000, 100000);
    sensor_buffer b;
    size_t inverse = 0;
    while (sensor_get(inverse)->levels != GRAIN_INVERSE)
        inverse++;
    for (uint64_t i = 0; i < cases; i++) {
        sensor s = {.row = sensor_get(inverse), .found = true, .step = rng_log(&r, 1e-7, 0.02)};
        s.offset = s.step * rng_uniform(&r, -0.5, 0.5);
        s.step_off = s.step * rng_log(&r, 1e-9, 1e-3);
        s.offset_off = s.step * rng_log(&r, 1e-6, 0.4);
        TALLY(&t, !sensor_buffer_find(&s, 0.5, rng_log(&r, 2, 60), &b), "step %.17g from %.17g: named %d, %g to %g",
              s.step, s.offset, b.bits, b.znear, b.zfar);
    }
    tally_end(&t);
}

/* Only what is found, of these levels, and with all depths between the planes. */
TEST(what_is_not_so) {
    static double z[N];
    rng r = rng_make("so");
    sensor_buffer b;
    size_t inverse = 0, even = 0;
    while (sensor_get(inverse)->levels != GRAIN_INVERSE)
        inverse++;
    while (sensor_get(even)->levels != GRAIN_EVEN)
        even++;
    const double span = 1 / 0.1 - 1 / 100.0;
    sensor s = {.row = sensor_get(inverse), .found = true, .step = span / 65535, .step_off = 1e-12, .offset_off = 1e-9};
    s.offset = 0.01 - 66 * s.step;
    assert_true(sensor_buffer_find(&s, 0.2, 90, &b) && b.bits == 16 && b.znear == 0.1 && b.zfar == 100);
    assert_relative(b.znear_off, 0.01 * 65535 * 1e-12, 1e-3);
    assert_relative(b.zfar_off, 1e4 * (1e-9 + 66 * 1e-12), 1e-6);
    const sensor fine = {.row = s.row, .found = true, .step = 5 / ldexp(1, 24), .step_off = 1e-14, .offset_off = 5e-9};
    assert_false(sensor_buffer_find(&fine, 0.5, 90, &b)); /* near would be 0.2 + 1.2e-8 */
    sensor exact = fine;
    exact.step = 5 / (ldexp(1, 24) - 1);
    assert_true(sensor_buffer_find(&exact, 0.5, 90, &b) && b.bits == 24 && b.znear == 0.2 && isinf(b.zfar));
    assert_true(isnan(b.zfar_off));
    assert_false(sensor_buffer_find(&s, 0.05, 90, &b)); /* nearer than near */
    assert_false(sensor_buffer_find(&s, 0.2, 101, &b)); /* farther than far */
    s.found = false;
    assert_false(sensor_buffer_find(&s, 0.2, 90, &b));
    s.found = true;
    s.offset += 0.01 * s.step; /* no level at 1/far */
    assert_false(sensor_buffer_find(&s, 0.2, 90, &b));
    s.offset -= 0.01 * s.step;
    s.row = sensor_get(even);
    assert_false(sensor_buffer_find(&s, 0.2, 90, &b));
    s.row = sensor_get(inverse);
    s.step = NAN;
    assert_false(sensor_buffer_find(&s, 0.2, 90, &b));
    assert_false(sensor_buffer_find(&s, NAN, NAN, &b));
    render(&r, 0.1, 100, 16, 1, 20, z);
    assert_true(name(z, &b));
}

int main(void) {
    return run_listed(NULL, NULL);
}

/* Steps of 1/z of (1/0.24)/65535 from 0 on are those of near 0.24 with an infinite far and, since 5 x 13107 = 65535, of
 * near 0.2 with far 1.2: of depths that either may have, neither is named. Nor of others of that shape. */
TEST(two_cameras) {
    static const double nears[] = {0.24, 0.36, 0.42, 0.54, 0.66, 0.78};
    size_t inverse = 0;
    while (sensor_get(inverse)->levels != GRAIN_INVERSE)
        inverse++;
    for (size_t i = 0; i < sizeof nears / sizeof nears[0]; i++)
        for (int bits = 16; bits <= 24; bits += 8) {
            const double n = nears[i], span = ldexp(1, bits) - 1;
            const sensor s = {.row = sensor_get(inverse),
                              .found = true,
                              .step = 1 / n / span,
                              .step_off = 1e-9 / span,
                              .offset_off = 1e-12};
            sensor_buffer b;
            assert_false(sensor_buffer_find(&s, 1.01 * n, 4.9 * n, &b));
            assert_int_equal(b.bits, 0);
            assert_true(sensor_buffer_find(&s, 1.01 * n, 5.1 * n, &b)); /* beyond the far of the second */
            assert_true(b.bits == bits && b.znear == n && isinf(b.zfar));
        }
}

/* As many digits as are looked for, of levels that are known well; one more is nobody's. */
TEST(planes_of_three_digits) {
    static const struct {
        double znear, zfar;
        bool named;
    } planes[] = {{0.125, INFINITY, true}, {0.217, INFINITY, true},   {0.0523, 731, true},
                  {1.07, 946, true},       {0.1253, INFINITY, false}, {0.5237, 731.9, false}};
    size_t inverse = 0;
    while (sensor_get(inverse)->levels != GRAIN_INVERSE)
        inverse++;
    for (size_t i = 0; i < sizeof planes / sizeof planes[0]; i++)
        for (int bits = 16; bits <= 24; bits += 8) {
            const double n = planes[i].znear, f = planes[i].zfar, span = ldexp(1, bits) - 1;
            const sensor s = {.row = sensor_get(inverse),
                              .found = true,
                              .step = (1 / n - 1 / f) / span,
                              .step_off = 1e-11 / span,
                              .offset = remainder(1 / f, (1 / n - 1 / f) / span),
                              .offset_off = 1e-13};
            sensor_buffer b;
            assert_int_equal(sensor_buffer_find(&s, 2 * n, 400 * n, &b), planes[i].named);
            assert_true(!planes[i].named || (b.bits == bits && b.znear == n && b.zfar == f));
        }
}
