/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Packings: rows and claims; the codes of depths against integers and a shader written out, the measured errors against
 * all binary32 numbers.
 */
#include <ctype.h>

#include "named.h"
#include "pack_measure.h"
#include "support.h"

TEST(test_rows) {
    static const char *const names[] = {"rg-depth", "rg-depth-zero", "rg-depth-fp32", "rg-depth-fp32-zero",
                                        "stereo-8", "oct-8",         "oct-10",        "oct-12",
                                        "xyz-8",    "xyz-10",        "xyz-12",        "depth-normal"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        assert_non_null(pack_find(names[i]));
    for (size_t i = 0; i < pack_count(); i++) {
        const pack_row *row = pack_get(i);
        assert_true(pack_find(row->name) == row); /* no name twice */
        for (const char *c = row->name; *c != '\0'; c++)
            assert_true(islower((unsigned char)*c) || isdigit((unsigned char)*c) || *c == '-');
        assert_true(row->note[0] != '\0' && row->source[0] != '\0');
        assert_true(row->channels >= 2 && row->channels <= PACK_CHANNELS_MAX);
        assert_true((row->kind != PACK_NORMAL) == (row->depth.max > 0));
        assert_true((row->kind != PACK_DEPTH) == (row->normal.max > 0));
    }
    assert_null(pack_find("rg"));
    assert_null(pack_find(""));
    assert_null(pack_get(pack_count()));
}

/* A claim is a bound, and no more than 2 per mille above what is reached. */
static void claim(tally *t, const char *name, const char *what, double got, double claimed) {
    TALLY(t, got <= claimed && got >= claimed * 0.998, "%s: %s %.9g, claimed %.9g", name, what, got, claimed);
}

TEST(test_claims) {
    tally t = {.name = "claims"};
    for (size_t i = 0; i < pack_count(); i++) {
        const pack_row *row = pack_get(i);
        const pack_error *e = pack_error_of(row->name);
        if (row->kind != PACK_NORMAL) {
            claim(&t, row->name, "mean of depth", e->depth.mean, row->depth.mean);
            claim(&t, row->name, "maximum of depth", e->depth.max, row->depth.max);
        }
        if (row->kind != PACK_DEPTH) {
            claim(&t, row->name, "mean of normal", e->normal.mean, row->normal.mean);
            claim(&t, row->name, "maximum of normal", e->normal.max, row->normal.max);
        }
    }
    tally_end(&t);
}

/* ---- Depth ------------------------------------------------------------------------------------------------------- */

typedef struct texel {
    uint32_t x, y;
} texel;

static texel encoded(const pack_row *row, double v) {
    uint32_t codes[PACK_CHANNELS_MAX] = {0};
    row->encode(row, &v, codes);
    return (texel){codes[0], codes[1]};
}

static double decoded(const pack_row *row, texel t) {
    const uint32_t codes[PACK_CHANNELS_MAX] = {t.x, t.y};
    double out;
    row->decode(row, codes, &out);
    return out;
}

/* v = mantissa/2^shift, so floor(255 v) and 65025 v are integer arithmetic. v in [2^-60, 1). */
static texel exact_texel(double v, bool truncates) {
    int exponent;
    const unsigned __int128 mantissa = (unsigned __int128)ldexp(frexp(v, &exponent), 53);
    const int shift = 53 - exponent;
    const unsigned __int128 coarse = mantissa * 255 >> shift;
    const unsigned __int128 half = truncates ? 0 : (unsigned __int128)1 << (shift - 1);
    const unsigned __int128 fine = (mantissa * 65025 + half) >> shift;
    return (texel){(uint32_t)coarse, (uint32_t)(fine - 255 * coarse)};
}

/* Anywhere, at whole 255ths and at the middles of 65025ths, and next to both. */
static double any_depth(rng *r) {
    double v = rng_unit(r);
    if (rng_below(r, 4) == 0)
        v = (double)rng_below(r, 255) / 255;
    else if (rng_below(r, 3) == 0)
        v = ((double)rng_below(r, 65025) + 0.5) / 65025;
    else if (rng_below(r, 4) == 0)
        v = rng_log(r, 0x1p-60, 1);
    for (uint64_t i = rng_below(r, 3); i > 0; i--)
        v = nextafter(v, rng_below(r, 2) ? 0 : 1);
    return fmin(fmax(v, 0x1p-60), 1 - 0x1p-53);
}

TEST(test_rg_exact) {
    rng r = rng_make("rg exact");
    tally t = {.name = "texels"};
    for (uint64_t i = 0; i < test_cases(20000, 1000000, 20000000); i++) {
        const double v = any_depth(&r);
        for (int truncates = 0; truncates < 2; truncates++) {
            const pack_row *row = pack_find(truncates ? "rg-depth-zero" : "rg-depth");
            const texel want = exact_texel(v, truncates), got = encoded(row, v);
            TALLY(&t, got.x == want.x && got.y == want.y, "%s %a: %u %u, %u %u", row->name, v, got.x, got.y, want.x,
                  want.y);
            const long double back = (long double)(255 * want.x + want.y) / 65025;
            TALLY(&t, fabsl((long double)decoded(row, got) - back) <= 0x1p-53L, "%s %u %u", row->name, got.x, got.y);
        }
    }
    tally_end(&t);
}

/* The steps of the shader, a line each; no product and sum may be fused. */
static texel shader_texel(float v, bool truncates) {
    volatile float product = 255.0F * v;
    volatile float fine = product - floorf(product);
    volatile float share = fine * (float)(1.0 / 255.0);
    volatile float coarse = v - floorf(v) - share;
    const double half = truncates ? 0 : 0.5;
    const double x = floor((double)coarse * 255.0 + half), y = floor((double)fine * 255.0 + half);
    return (texel){x < 0 ? 0 : (uint32_t)x, (uint32_t)y};
}

static double shader_depth(texel t) {
    volatile float x = (float)t.x / 255.0F;
    volatile float y = (float)t.y / 255.0F;
    volatile float share = y * (float)(1.0 / 255.0);
    return (double)(x + share);
}

static void shader_case(tally *t, const pack_row *row, const pack_error *e, float v, double *sum) {
    const texel want = shader_texel(v, row->truncates), got = encoded(row, (double)v);
    const double error = fabs(shader_depth(want) - (double)v);
    TALLY(t, got.x == want.x && got.y == want.y && decoded(row, got) == shader_depth(want), "%s %a: %u %u, %u %u",
          row->name, (double)v, got.x, got.y, want.x, want.y);
    TALLY(t, error <= e->depth.max, "%s %a: %a off, %a measured", row->name, (double)v, error, e->depth.max);
    *sum += error;
}

static float any_float(rng *r) {
    const float v = (float)any_depth(r);
    return v < 1 ? v : nextafterf(1, 0);
}

TEST(test_rg_binary32) {
    static const char *const names[] = {"rg-depth-fp32", "rg-depth-fp32-zero"};
    rng r = rng_make("rg binary32");
    tally t = {.name = "shader"};
    for (size_t k = 0; k < 2; k++) {
        const pack_row *row = pack_find(names[k]);
        const pack_error *e = pack_error_of(names[k]);
        const uint64_t cases = test_cases(20000, 2000000, 2000000);
        double sum = 0, unused = 0;
        for (uint64_t i = 0; i < cases; i++) {
            shader_case(&t, row, e, any_float(&r), &unused);
            shader_case(&t, row, e, (float)(rng_below(&r, 1 << 24)) * 0x1p-24F, &sum);
        }
        const double spread = e->depth.max / sqrt((double)cases);
        TALLY(&t, fabs(sum / (double)cases - e->depth.mean) < 4 * spread, "%s: mean %g, %g measured", row->name,
              sum / (double)cases, e->depth.mean);
        const float at = (float)e->depth_at;
        TALLY(&t, fabs(shader_depth(shader_texel(at, row->truncates)) - (double)at) == e->depth.max, "%s at %a",
              row->name, e->depth_at);
    }
    tally_end(&t);
}

/* All 1,065,353,216 of them: no error is above the maximum, and the mean is that of pack_measure(). */
TEST(test_rg_binary32_all) {
    static const char *const names[] = {"rg-depth-fp32", "rg-depth-fp32-zero"};
    tally t = {.name = "all of binary32"};
    if (test_effort() < EFFORT_FULL)
        skip();
    for (size_t k = 0; k < 2; k++) {
        const pack_row *row = pack_find(names[k]);
        const pack_error *e = pack_error_of(names[k]);
        double mean = 0, max = 0;
        for (uint32_t exponent = 0; exponent < 127; exponent++) {
            const double weight = exponent == 0 ? 0x1p-126 : ldexp(1, (int)exponent - 127);
            double sum = 0;
            for (uint32_t m = 0; m < 1U << 23; m++) {
                const uint32_t bits = exponent << 23 | m;
                float v;
                memcpy(&v, &bits, sizeof v);
                const double error = fabs(shader_depth(shader_texel(v, row->truncates)) - (double)v);
                max = fmax(max, error);
                sum += error;
            }
            mean += sum * 0x1p-23 * weight;
        }
        TALLY(&t, max == e->depth.max, "%s: maximum %a, %a measured", row->name, max, e->depth.max);
        TALLY(&t, fabs(mean - e->depth.mean) <= 1e-6 * mean, "%s: mean %.9g, %.9g measured", row->name, mean,
              e->depth.mean);
    }
    tally_end(&t);
}

TEST(test_rg_known) {
    const double step = 1 / 65025.0;
    for (size_t i = 0; i < pack_count(); i++)
        if (pack_get(i)->kind == PACK_DEPTH) {
            assert_true(decoded(pack_get(i), encoded(pack_get(i), 1)) == 0); /* 1 does not survive */
            assert_true(decoded(pack_get(i), encoded(pack_get(i), 0)) == 0);
        }
    /* Quarter and half a step; truncated, half and a whole one, all of it towards 0. */
    const pack_error *e = pack_error_of("rg-depth");
    assert_relative(e->depth.mean, step / 4, 1e-9);
    assert_relative(e->depth.max, step / 2, 1e-9);
    assert_scene(e->depth_bias, 0, 1e-9 * step);
    assert_int_equal(e->depth_codes, 255 * 256);
    e = pack_error_of("rg-depth-zero");
    assert_relative(e->depth.mean, step / 2, 1e-9);
    assert_relative(e->depth.max, step, 1e-9);
    assert_relative(e->depth_bias, -step / 2, 1e-9);
    assert_int_equal(e->depth_codes, 255 * 255);
    /* A coarse code too few: 1/255, and what truncation takes of the fine one. */
    e = pack_error_of("rg-depth-fp32-zero");
    assert_relative(e->depth.max, 1 / 255.0 + step, 1e-3);
    assert_true(e->depth_bias < -60 * step);
    assert_true(pack_error_of("rg-depth-fp32")->depth.max < 0.504 * step);
}

/* Normal in xy, depth in zw. */
TEST(test_both) {
    rng r = rng_make("both");
    const pack_row *both = pack_find("depth-normal"), *normal = pack_find("stereo-8"), *depth = pack_find("rg-depth");
    for (int i = 0; i < 1000; i++) {
        const double v = rng_unit(&r), z = rng_unit(&r), phi = rng_uniform(&r, 0, 6.28), radius = sqrt(1 - z * z);
        const double in[4] = {radius * cos(phi), radius * sin(phi), z, v};
        uint32_t codes[4], first[4], last[4];
        double out[4], want[4];
        both->encode(both, in, codes);
        normal->encode(normal, in, first);
        depth->encode(depth, &v, last);
        assert_true(codes[0] == first[0] && codes[1] == first[1] && codes[2] == last[0] && codes[3] == last[1]);
        both->decode(both, codes, out);
        normal->decode(normal, first, want);
        depth->decode(depth, last, want + 3);
        assert_memory_equal(out, want, sizeof out);
    }
    assert_true(pack_error_of("depth-normal")->normal.max == pack_error_of("stereo-8")->normal.max);
    assert_true(pack_error_of("depth-normal")->depth.max == pack_error_of("rg-depth")->depth.max);
}
