/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The guarantee of many depths at once is that of each alone, to the bit: dp_separation(), which test_reference and
 * test_guarantee judge.
 */
#include <float.h>

#include "core/bits.h"
#include "core/demand.h"
#include "core/guarantee.h"
#include "depthprec/depthprec.h"
#include "support.h"

static const char *const formats[] = {"fp32",    "unorm24",  "unorm16",  "fp16",      "unorm8",    "unorm20",
                                      "unorm32", "float5.9", "float8.7", "float6.23", "float7.12", "unorm23"};
enum { FORMATS = sizeof formats / sizeof formats[0], COUNT = 10000 };

static int make(dp_setup *setup, const char *name, dp_spec spec) {
    dp_format f[2];
    assert_true(dp_format_parse(name, f) > 0);
    spec.format = f[0];
    spec.model = DP_MODEL_FLOAT;
    return dp_setup_init(setup, &spec) == DP_OK;
}

static void compare(tally *t, const dp_setup *s, const double *z, size_t count) {
    static double got[COUNT];
    static dp_stretches stretches;
    const dp_guarantee g = dp_guarantee_make(s);
    dp_stretches_find(&stretches, &g);
    dp_guarantee_many(&g, &stretches, z, got, count);
    for (size_t i = 0; i < count; i++) {
        const double want = dp_separation(s, z[i]);
        TALLY(t, memcmp(&got[i], &want, sizeof want) == 0, "%s %s %s near %.17g far %.17g z %.17g: %.17g, alone %.17g",
              s->spec.format.name, dp_mapping_get(s->spec.mapping)->name, dp_arith_get(s->spec.arith)->name,
              s->spec.znear, s->spec.zfar, z[i], got[i], want);
    }
}

/* Anywhere, beside powers of two, where steps double, next to the planes, and these. */
static double some_depth(rng *r, const dp_setup *s) {
    const double n = s->spec.znear, f = isinf(s->spec.zfar) ? fmin(1e7 * n, 1e20) : s->spec.zfar;
    const uint64_t kind = rng_below(r, 8);
    double z = n > 0.0 ? rng_log(r, n, f) : rng_uniform(r, n, f);
    if (kind == 0)
        z = ldexp(1.0 + ((double)rng_below(r, 9) - 4.0) * 0x1p-24, ilogb(z));
    if (kind == 1)
        z = n + (f - n) * ldexp(rng_unit(r), -(int)rng_below(r, 50));
    if (kind == 2)
        z = f - (f - n) * ldexp(rng_unit(r), -(int)rng_below(r, 50));
    if (kind == 3)
        z = rng_below(r, 2) != 0 ? n : f;
    if (kind == 4)
        z = (double)(float)z;
    return fmax(n, fmin(z, f));
}

/* Those that the headers promise to gain have stretches, from near on and over nearly all binary32 depths. */
TEST(test_cameras_that_gain) {
    static const dp_mapping mappings[] = {DP_MAPPING_D3D, DP_MAPPING_GL, DP_MAPPING_GL_REVERSED, DP_MAPPING_REVERSED};
    static const double ratios[] = {10, 1000, 1e5, 1e9, HUGE_VAL};
    static dp_stretches found;
    for (int f = 0; f < 4; f++)
        for (int m = 0; m < 4; m++)
            for (int k = 0; k < (mappings[m] == DP_MAPPING_REVERSED ? 5 : 3); k++) {
                dp_spec spec = dp_spec_default();
                dp_setup s;
                spec.mapping = mappings[m];
                spec.zfar = ratios[k] * spec.znear;
                assert_true(make(&s, formats[f], spec));
                const dp_guarantee g = dp_guarantee_make(&s);
                dp_stretches_find(&found, &g);
                double covered = 0;
                const double from = spec.znear, to = fmin(spec.zfar, 1e5 * spec.znear);
                for (int i = 0; i < found.count; i++)
                    if (found.list[i].from < to)
                        covered += log(fmin(found.list[i].to, to) / fmax(found.list[i].from, from));
                if (!(covered > 0.9 * log(to / from)))
                    fail_msg("%s %s far/near %g: %g of it", formats[f], dp_mapping_get(mappings[m])->name, ratios[k],
                             covered / log(to / from));
            }
}

/* Cameras of any planes. What is left to dp_guarantee_at() is among them: it has to be told apart. */
TEST(test_random) {
    static double z[COUNT];
    tally t = {.name = "random cameras"};
    rng r = rng_make("random cameras");
    const uint64_t cameras = test_cases(60, 400, 20000);
    for (uint64_t i = 0; i < cameras; i++) {
        dp_spec spec = dp_spec_default();
        dp_setup s;
        spec.znear = rng_log(&r, 1e-6, 1e3);
        const double ratio = rng_log(&r, 1.001, 1e7);
        const uint64_t end = rng_below(&r, 6);
        spec.zfar = end == 0 ? INFINITY : spec.znear * ratio;
        if (end == 1) { /* A is a power of two, or near one */
            spec.znear = ldexp(1.0, (int)rng_below(&r, 8) - 4);
            spec.zfar = spec.znear * ldexp(1.0, 1 + (int)rng_below(&r, 12));
        }
        spec.mapping = (dp_mapping)rng_below(&r, 4);
        spec.rounding = (dp_rounding)rng_below(&r, DP_ROUNDING_COUNT);
        const uint64_t format = rng_below(&r, 3) != 0 ? rng_below(&r, 4) : rng_below(&r, FORMATS);
        const size_t count = 1 + (size_t)rng_below(&r, i % 10 == 0 ? 1000 : 200);
        if (!make(&s, formats[format], spec))
            continue;
        for (size_t k = 0; k < count; k++)
            z[k] = some_depth(&r, &s);
        compare(&t, &s, z, count);
    }
    tally_end(&t);
}

/* Neighbours, one after the other: where one of the roundings changes, and on both sides of it. */
TEST(test_neighbours) {
    static double z[COUNT];
    tally t = {.name = "neighbours"};
    rng r = rng_make("neighbours");
    static const double cameras[][2] = {{0.1, 1000}, {0.3, 1000}, {1, 10}, {0.1, INFINITY}, {0.25, 256}, {5, 5000}};
    const uint64_t windows = test_cases(2, 12, 2000);
    for (int c = 0; c < 6; c++)
        for (int m = 0; m < 4; m++)
            for (int f = 0; f < 4; f++)
                for (uint64_t w = 0; w < windows; w++) {
                    dp_spec spec = dp_spec_default();
                    dp_setup s;
                    spec.znear = cameras[c][0];
                    spec.zfar = cameras[c][1];
                    spec.mapping = (dp_mapping)m;
                    assert_true(make(&s, formats[f], spec));
                    const float from = (float)some_depth(&r, &s);
                    const uint64_t stride = rng_below(&r, 3) == 0 ? 1 + rng_below(&r, 2000) : 1;
                    size_t count = 0;
                    for (float x = from; count < 256; count++) {
                        z[count] = fmax(spec.znear, fmin((double)x, fmin(spec.zfar, 1e30)));
                        for (uint64_t k = 0; k < stride; k++)
                            x = nextafterf(x, FLT_MAX);
                    }
                    compare(&t, &s, z, count);
                }
    tally_end(&t);
}

/* What is decided on the way to the guarantee of a depth, as one number. */
static uint64_t decided(const dp_guarantee *g, uint32_t bits) {
    dp_decisions d = {.count = 0};
    dp_demand ignored;
    dp_chain c = g->chain;
    uint64_t sum = 0;
    c.decisions = &d;
    dp_demand_longest(&c, (dp_span){(double)dp_float32(bits), (double)dp_float32(bits)}, 0.0, &ignored);
    for (int i = 0; i < d.count; i++)
        sum = sum * 6364136223846793005U + dp_bits64(d.made[i]);
    return sum;
}

/* Where a decision changes between two depths, and on both sides of it. */
TEST(test_borders) {
    enum { SIDE = COUNT / 2 };
    static double z[COUNT];
    tally t = {.name = "borders"};
    rng r = rng_make("borders");
    const uint64_t cameras = test_cases(20, 150, 10000);
    for (uint64_t i = 0; i < cameras; i++) {
        dp_spec spec = dp_spec_default();
        dp_setup s;
        spec.znear = rng_log(&r, 1e-3, 10);
        spec.zfar = spec.znear * rng_log(&r, 10, 1e6);
        spec.mapping = (dp_mapping)rng_below(&r, 4);
        assert_true(make(&s, formats[rng_below(&r, 4)], spec));
        const dp_guarantee g = dp_guarantee_make(&s);
        const uint32_t near = dp_bits32(dp_float_up(spec.znear)), far = dp_bits32(dp_float_down(spec.zfar));
        for (int border = 0; border < 4; border++) {
            uint32_t low = near + (uint32_t)rng_below(&r, far - near), high = low;
            high += (uint32_t)rng_below(&r, far - high < 1U << 22 ? far - high + 1 : 1U << 22);
            while (high - low > 1) {
                const uint32_t middle = low + (high - low) / 2;
                *(decided(&g, middle) == decided(&g, low) ? &low : &high) = middle;
            }
            for (uint32_t k = 0; k < COUNT; k++)
                z[k] = fmax(spec.znear, fmin((double)dp_float32(low - SIDE + k), spec.zfar));
            compare(&t, &s, z, COUNT);
        }
    }
    tally_end(&t);
}

/* What is done one by one is done, too. */
TEST(test_others) {
    static double z[COUNT];
    tally t = {.name = "others"};
    rng r = rng_make("others");
    const uint64_t cases = test_cases(1, 3, 100);
    for (uint64_t i = 0; i < cases; i++)
        for (dp_arith a = 0; a < dp_arith_count(); a++)
            for (int m = 0; m < DP_MAPPING_COUNT; m++)
                for (int form = 0; form < 4; form++) {
                    dp_spec spec = dp_spec_default();
                    dp_setup s;
                    spec.znear = form == 1 ? -2.0 : 0.2;
                    spec.zfar = 400.0;
                    spec.mapping = (dp_mapping)m;
                    spec.arith = a;
                    spec.ortho = form == 1;
                    if (form == 2) {
                        spec.depth_range[0] = 0.25;
                        spec.depth_range[1] = 0.75;
                    }
                    if (form == 3)
                        spec.triangles = dp_triangles_default();
                    if (!make(&s, formats[rng_below(&r, 4)], spec))
                        continue;
                    for (size_t k = 0; k < 20; k++)
                        z[k] = some_depth(&r, &s);
                    compare(&t, &s, z, 20);
                }
    tally_end(&t);
}
