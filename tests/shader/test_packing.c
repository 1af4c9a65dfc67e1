/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Packed textures: every code there and back, shaders of others within what is claimed, what was resampled, and the
 * program's own files. */
#include <unistd.h>

#include "handmade.h"
#include "shader/packing.h"
#include "support.h"
#include "texture/image_depths.h"
#include "truth.h"

/* ---- Every code ---------------------------------------------------------------------------------------------------*/

/* The value of each texel, written apart from the table. */
static long double rg(const uint8_t *t) {
    return t[0] / 255.0L + t[1] / 65025.0L;
}
static long double of_depth_normals(const uint8_t *t) {
    return rg(t + 2);
}
static long double three_new(const uint8_t *t) { /* unpackRGBAToDepth: dot(v, (255/256)(1, 2^-8, 2^-16), 2^-24) */
    return t[0] / 256.0L + t[1] / 65536.0L + t[2] / 16777216.0L + t[3] / 255.0L / 16777216.0L;
}
static long double three_old(const uint8_t *t) { /* 255/256 / (2^24, 2^16, 2^8, 1) of channels over 255 */
    return t[3] / 256.0L + t[2] / 65536.0L + t[1] / 16777216.0L + t[0] / 4294967296.0L;
}
static long double big(const uint8_t *t) {
    return (t[0] * 65536 + t[1] * 256 + t[2]) / 16777215.0L;
}
static long double small(const uint8_t *t) {
    return (t[2] * 65536 + t[1] * 256 + t[0]) / 16777215.0L;
}
static long double byte(const uint8_t *t) {
    return t[0] / 255.0L;
}

typedef struct stands_for {
    const char *name;
    int first, count; /* the channels that count */
    long double (*depth)(const uint8_t *texel);
    bool twice; /* some numbers have two texels: x, 255 and x + 1, 0 */
} stands_for;

static const stands_for all[] = {
    {"depth-normals", 2, 2, of_depth_normals, true},
    {"rg", 0, 2, rg, true},
    {"rgba", 0, 4, three_new, true},
    {"rgba-r166", 0, 4, three_old, false},
    {"rgb24", 0, 3, big, false},
    {"rgb24-le", 0, 3, small, false},
    {"carla", 0, 3, small, false},
    {"linear01", 0, 1, byte, false},
};
enum { ALL = sizeof all / sizeof all[0] };

static void look_at(tally *t, const stands_for *s, const packing *p, const uint8_t texel[4]) {
    uint8_t back[4] = {texel[0], texel[1], texel[2], texel[3]};
    const long double want = fminl(s->depth(texel), 1);
    const uint64_t number = packing_number(p, texel);
    const double got = packing_depth(p, number);
    TALLY(t, fabsl(got - want) <= 0x1p-53L * want, "%s %d,%d,%d,%d: %.17g instead of %.20Lg", s->name, texel[0],
          texel[1], texel[2], texel[3], got, want);
    packing_texel(p, packing_nearest(p, got), back);
    const bool same = memcmp(back, texel, 4) == 0;
    TALLY(t, same || (s->twice && fabsl(fminl(s->depth(back), 1) - want) <= 0x1p-60L * want),
          "%s %d,%d,%d,%d came back as %d,%d,%d,%d", s->name, texel[0], texel[1], texel[2], texel[3], back[0], back[1],
          back[2], back[3]);
}

/* All texels of up to three bytes; of four, all of the two middle ones beside both ends and some of the others. */
TEST(every_code) {
    tally t = {.name = "every code"};
    rng r = rng_make("every code");
    for (size_t i = 0; i < ALL; i++) {
        const packing *p = packing_find(all[i].name);
        const int bytes = all[i].count < 3 ? all[i].count : 3;
        const uint64_t step = test_cases(bytes < 2 ? 1 : bytes < 3 ? 7 : 1021, 1, 1);
        for (uint64_t code = 0; code < UINT64_C(1) << 8 * bytes; code += step) {
            uint8_t texel[4] = {9, 9, 9, 9};
            for (int k = 0; k < bytes; k++)
                texel[all[i].first + k] = (uint8_t)(code >> 8 * k);
            if (all[i].count == 4)
                texel[3] = (uint8_t)(code % 4 < 2 ? 255 * (code % 4) : rng_below(&r, 256));
            look_at(&t, &all[i], p, texel);
        }
    }
    tally_end(&t);
}

/* The same through images and the numbers that come of them. */
TEST(every_code_in_images) {
    enum { SIDE = 256 };
    for (size_t i = 0; i < ALL; i++) {
        const packing *p = packing_find(all[i].name);
        image img = {.width = SIDE, .height = SIDE, .channels = p->channels, .type = IMAGE_U8};
        uint8_t *given = malloc(SIDE * SIDE * 4);
        unpacked out;
        img.data = malloc(SIDE * SIDE * p->channels);
        assert_true(given != NULL && img.data != NULL);
        for (size_t k = 0; k < SIDE * SIDE; k++) {
            const uint64_t code = all[i].count < 3 ? k : (k * 65537 + k / 3) & 0xFFFFFFFF;
            memset(given + 4 * k, (int)(k % 251), 4);
            for (int c = 0; c < all[i].count; c++)
                given[4 * k + (size_t)(all[i].first + c)] = (uint8_t)(code >> 8 * c);
            memcpy((uint8_t *)img.data + k * p->channels, given + 4 * k, p->channels);
        }
        if (!packing_convert(p, false, &img, &out))
            fail_msg("%s: %s", p->name, out.wrong);
        assert_int_equal(img.channels, 1);
        tally t = {.name = all[i].name};
        for (size_t k = 0; k < SIDE * SIDE; k++) {
            const double d =
                img.type == IMAGE_F32 ? (double)((const float *)img.data)[k] : ((const double *)img.data)[k];
            const long double want = fminl(all[i].depth(given + 4 * k), 1);
            TALLY(&t, fabsl(d - want) <= (img.type == IMAGE_F32 ? 0x1p-24L : 0x1p-53L) * want, "pixel %zu", k);
            TALLY(&t, packing_nearest(p, d) == (uint64_t)rintl(want * (long double)p->steps), "pixel %zu back", k);
            if (p->encoded != NULL)
                TALLY(&t, memcmp(out.normals + 2 * k, given + 4 * k, 2) == 0, "normal %zu", k);
        }
        assert_true((p->encoded != NULL) == (out.normals != NULL));
        tally_end(&t);
        image_free(&img);
        free(out.normals);
        free(given);
    }
}

/* ---- Shaders of others --------------------------------------------------------------------------------------------*/

static float fraction(float x) {
    return x - floorf(x);
}
static bool truncates;
static uint8_t stored(float x) { /* what a render target makes of it, or one that truncates */
    return (uint8_t)floor(fmin(fmax((double)x, 0), 1) * 255 + (truncates ? 0 : 0.5));
}

/* The weight by which a shader multiplies a channel: a quotient, which may be off by an ulp. Truncation shows that. */
static float quotient(float x) {
    return truncates ? nextafterf(x, 0) : x;
}

static void shader_rg(float v, uint8_t *t) { /* EncodeFloatRG */
    const float y = fraction(255.0F * v);
    t[0] = stored(fraction(v) - y * (1.0F / 255.0F));
    t[1] = stored(y);
}
static void shader_depth_normals(float v, uint8_t *t) {
    shader_rg(v, t + 2);
    t[0] = t[1] = 128;
}
static void shader_rgba(float v, uint8_t *t) { /* r167 */
    const float scaled = v * 16777216.0F, a = fraction(scaled), r24 = floorf(scaled) / 256.0F, b = fraction(r24);
    const float r16 = floorf(r24) / 256.0F, g = fraction(r16);
    const float up = quotient(256.0F / 255.0F);
    t[0] = stored(floorf(r16) * quotient(1.0F / 255.0F));
    t[1] = stored(g * up);
    t[2] = stored(b * up);
    t[3] = stored(a);
}
static void shader_rgba_r166(float v, uint8_t *t) {
    float r[4] = {fraction(v * 16777216.0F), fraction(v * 65536.0F), fraction(v * 256.0F), v};
    for (int k = 3; k > 0; k--)
        r[k] -= r[k - 1] * (1.0F / 256.0F);
    for (int k = 0; k < 4; k++)
        t[k] = stored(r[k] * quotient(256.0F / 255.0F));
}
static void shader_byte(float v, uint8_t *t) {
    t[0] = stored(v);
}

static void shader_carla(float v, uint8_t *t) { /* cut off */
    const uint32_t code = (uint32_t)floor((double)v * 16777215);
    for (int k = 0; k < 3; k++)
        t[k] = (uint8_t)(code >> 8 * k);
}

static const struct {
    const char *name;
    void (*run)(float v, uint8_t *texel);
} shaders[] = {{"rg", shader_rg},       {"depth-normals", shader_depth_normals},
               {"rgba", shader_rgba},   {"rgba-r166", shader_rgba_r166},
               {"carla", shader_carla}, {"linear01", shader_byte}};

static float any_depth(rng *r, uint64_t k) {
    return (float)(k % 3 == 0   ? rng_unit(r)
                   : k % 3 == 1 ? 1 - rng_log(r, 1e-8, 1)
                                : rng_log(r, 1e-9, 1)) *
           (1 - 0x1p-24F);
}

/* A depth that a shader packed decodes to it within half a step and what the row says that binary32 adds. */
TEST(shaders_of_others) {
    tally t = {.name = "shaders of others"};
    rng r = rng_make("shaders of others");
    const uint64_t cases = test_cases(2000, 300000, 5000000);
    for (size_t i = 0; i < sizeof shaders / sizeof shaders[0]; i++) {
        const packing *p = packing_find(shaders[i].name);
        const double most = 0.5 / p->steps + p->off;
        double worst = 0;
        for (uint64_t k = 0; k < cases; k++) {
            const float v = any_depth(&r, k);
            uint8_t texel[4] = {0};
            shaders[i].run(v, texel);
            const double off = fabs(packing_depth(p, packing_number(p, texel)) - (double)v);
            worst = fmax(worst, off);
            TALLY(&t, off <= most + 0x1p-53, "%s of %.9g: off by %.4g, at most %.4g", p->name, (double)v, off, most);
        }
        print_message("# %s: %.3f of the bound is used\n", p->name, worst / most);
        assert_true(worst >= 0.5 * most || test_effort() == EFFORT_QUICK);
    }
    tally_end(&t);
}

/* The depths that the only pixel of an image may have, less 1: between 1 and 2 orthographic depth is 1 + d. */
static grain_range depths_behind(const packing *p, const uint8_t *texel, double *depth) {
    image img = {.width = 1, .height = 1, .channels = p->channels, .type = IMAGE_U8, .data = malloc(p->channels)};
    dp_format formats[2];
    dp_setup setup;
    dp_spec spec = dp_spec_default();
    unpacked out;
    uint32_t code;
    memcpy(img.data, texel, p->channels);
    assert_true(packing_convert(p, truncates, &img, &out));
    dp_format_parse(p->format, formats);
    spec.format = formats[0];
    spec.ortho = true;
    spec.znear = 1;
    spec.zfar = 2;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    image_codes(&img, &formats[0], 0, 0, 1, &code);
    *depth = packing_depth(p, packing_number(p, texel));
    grain_range range = grain_range_of(&setup, &out.grain, code);
    range.lo -= 1;
    range.hi -= 1;
    image_free(&img);
    free(out.normals);
    return range;
}

/* The depth that a shader packed lies in the range that its texel is given, which is not twice too wide. */
TEST(ranges_of_others) {
    tally t = {.name = "ranges of others"};
    rng r = rng_make("ranges of others");
    const uint64_t cases = test_cases(50000, 100000, 1000000);
    for (size_t i = 0; i < 2 * sizeof shaders / sizeof shaders[0]; i++) {
        const packing *p = packing_find(shaders[i / 2].name);
        double used = 0;
        truncates = i % 2 == 1;
        for (uint64_t k = 0; k < cases; k++) {
            const double v = (double)any_depth(&r, k);
            uint8_t texel[4] = {0};
            double depth;
            shaders[i / 2].run((float)v, texel);
            const grain_range range = depths_behind(p, texel, &depth);
            used = fmax(used, v > depth ? (v - depth) / (range.hi - depth) : (depth - v) / (depth - range.lo));
            TALLY(&t, v >= range.lo - 0x1p-42 && v <= range.hi + 0x1p-42, "%s%s of %.9g: %.12g to %.12g", p->name,
                  truncates ? ", truncated" : "", v, range.lo, range.hi);
        }
        print_message("# %s%s: %.3f of the range is used\n", p->name, truncates ? ", truncated" : "", used);
        assert_true(used >= 0.5);
    }
    truncates = false;
    tally_end(&t);
}

/* More than 24 bits are more than a binary32 number holds, and some programs pack with all of them: the range of a
 * texel has its depth and half a step to both sides, and two units in the last place of 1 at most besides. */
TEST(ranges_of_all_bits) {
    static const char *const names[] = {"rgba", "rgba-r166"};
    tally t = {.name = "ranges of all bits"};
    rng r = rng_make("ranges of all bits");
    for (uint64_t i = 0; i < test_cases(2000, 100000, 1000000); i++) {
        const packing *p = packing_find(names[i % 2]);
        uint8_t texel[4];
        double depth;
        for (int k = 0; k < 4; k++)
            texel[k] = (uint8_t)rng_below(&r, 255);
        const grain_range range = depths_behind(p, texel, &depth);
        const double half = 0.5 / p->steps;
        TALLY(&t, range.lo <= depth - half + 0x1p-42 && range.hi >= depth + half - 0x1p-42,
              "%s of %.12g: %.12g to %.12g", p->name, depth, range.lo, range.hi);
        TALLY(&t, range.lo >= depth - half - 0x1.01p-23 && range.hi <= depth + half + 0x1.01p-23,
              "%s of %.12g: as wide as %.12g to %.12g", p->name, depth, range.lo, range.hi);
    }
    tally_end(&t);
}

/* Unity's DecodeViewNormalStereo, and what is seen head-on. */
TEST(packed_normals) {
    tally t = {.name = "packed normals"};
    for (int x = 0; x < 256; x++)
        for (int y = 0; y < 256; y++) {
            const uint8_t texel[2] = {(uint8_t)x, (uint8_t)y};
            const double vx = x / 255.0 * 2 * 1.7777 - 1.7777, vy = y / 255.0 * 2 * 1.7777 - 1.7777;
            const double g = 2 / (vx * vx + vy * vy + 1);
            double n[3];
            uint8_t back[2];
            packing_normal(texel, n);
            TALLY(&t, fabs(n[0] - g * vx) + fabs(n[1] - g * vy) + fabs(n[2] - (g - 1)) < 1e-14, "%d,%d", x, y);
            packing_normal_texel(n, back);
            TALLY(&t, memcmp(back, texel, 2) == 0, "%d,%d came back as %d,%d", x, y, back[0], back[1]);
        }
    tally_end(&t);
}

/* Every texel, and the normals of its square, by the formula above: rounded within half a step each way, cut less than
 * a step below. The bound holds at the corners and inside, and in the middle of the disc it is nearly reached. */
TEST(packed_normals_reach) {
    tally t = {.name = "reaches of packed normals"};
    rng r = rng_make("reaches of packed normals");
    for (int truncated = 0; truncated < 2; truncated++) {
        double used = 0;
        for (int x = 0; x < 256; x++)
            for (int y = 0; y < 256; y++) {
                const uint8_t texel[2] = {(uint8_t)x, (uint8_t)y};
                const double reach = packing_normal_reach(texel, truncated != 0);
                double mid[3];
                packing_normal(texel, mid);
                for (int corner = 0; corner < 5; corner++) {
                    double v[2];
                    for (int k = 0; k < 2; k++) {
                        const double part = corner < 4 ? (corner >> k & 1) : rng_unit(&r);
                        v[k] = ((texel[k] + (truncated ? part : part - 0.5)) / 255.0 * 2 - 1) * 1.7777;
                    }
                    const double g = 2 / (v[0] * v[0] + v[1] * v[1] + 1);
                    const double apart = fabs(g * v[0] - mid[0]) + fabs(g * v[1] - mid[1]);
                    used = fmax(used, apart / reach);
                    TALLY(&t, apart <= reach, "%d,%d%s: %g, bound %g", x, y, truncated ? " cut" : "", apart, reach);
                }
            }
        printf("# %s: %.3f of the reach is used\n", truncated ? "cut" : "rounded", used);
        assert_true(used > 0.9);
    }
    tally_end(&t);
}

/* ---- Samples that are none ----------------------------------------------------------------------------------------*/

enum { SIDE = 64 };

/* A slope through many coarse codes, or noise; packed as rg. */
static void draw(uint8_t *texels, int side, bool noise, double slope) {
    const packing *p = packing_find("rg");
    rng r = rng_make("a slope");
    for (int y = 0; y < side; y++)
        for (int x = 0; x < side; x++) {
            const double v = noise ? rng_unit(&r) : 0.1 + (x + 0.37 * y) * slope;
            packing_texel(p, packing_nearest(p, v), texels + 2 * (y * side + x));
        }
}

static bool accepted(const uint8_t *texels, uint32_t side, unpacked *out) {
    image img = {.width = side, .height = side, .channels = 2, .type = IMAGE_U8, .data = malloc(2 * side * side)};
    memcpy(img.data, texels, 2 * side * side);
    const bool good = packing_convert(packing_find("rg"), false, &img, out);
    assert_true(good || (img.type == IMAGE_U8 && memcmp(img.data, texels, 2 * side * side) == 0));
    image_free(&img);
    return good;
}

/* Enlarged to twice the size, each channel by itself. */
static void enlarge(const uint8_t *given, uint8_t *larger) {
    for (int y = 0; y < 2 * SIDE; y++)
        for (int x = 0; x < 2 * SIDE; x++)
            for (int k = 0; k < 2; k++) {
                const int x0 = x / 2, x1 = x0 + x % 2 < SIDE ? x0 + x % 2 : x0;
                const int y0 = y / 2, y1 = y0 + y % 2 < SIDE ? y0 + y % 2 : y0;
                const int sum = given[2 * (y0 * SIDE + x0) + k] + given[2 * (y0 * SIDE + x1) + k] +
                                given[2 * (y1 * SIDE + x0) + k] + given[2 * (y1 * SIDE + x1) + k];
                larger[2 * (y * 2 * SIDE + x) + k] = (uint8_t)((sum + 2) / 4);
            }
}

TEST(resampled) {
    static const double slopes[] = {1e-5, 1e-4, 3e-4, 7e-4, 1e-3};
    uint8_t given[SIDE * SIDE * 2], larger[4 * SIDE * SIDE * 2], smaller[SIDE * SIDE / 2], doubled[4 * SIDE * SIDE * 2];
    unpacked out;
    for (size_t i = 0; i < sizeof slopes / sizeof slopes[0]; i++) {
        draw(given, SIDE, false, slopes[i]);
        enlarge(given, larger);
        for (int y = 0; y < 2 * SIDE; y++)
            for (int x = 0; x < 2 * SIDE; x++)
                for (int k = 0; k < 2; k++) {
                    const int x0 = x / 2, y0 = y / 2;
                    doubled[2 * (y * 2 * SIDE + x) + k] = given[2 * (y0 * SIDE + x0) + k];
                    if (x % 2 == 0 && y % 2 == 0 && x < 2 * SIDE - 2 && y < 2 * SIDE - 2 && x / 2 % 2 == 0 &&
                        y / 2 % 2 == 0)
                        smaller[2 * (y / 4 * (SIDE / 2) + x / 4) + k] =
                            (uint8_t)((given[2 * (y0 * SIDE + x0) + k] + given[2 * (y0 * SIDE + x0 + 1) + k] +
                                       given[2 * ((y0 + 1) * SIDE + x0) + k] +
                                       given[2 * ((y0 + 1) * SIDE + x0 + 1) + k] + 2) /
                                      4);
                }
        assert_true(accepted(given, SIDE, &out));
        assert_true(accepted(doubled, 2 * SIDE, &out)); /* by nearest neighbours */
        if (slopes[i] < 3e-4)
            continue; /* too few steps of the coarse channel to tell */
        assert_false(accepted(larger, 2 * SIDE, &out));
        assert_non_null(strstr(out.wrong, "was resampled"));
        if (slopes[i] < 7e-4)
            assert_false(accepted(smaller, SIDE / 2, &out));
    }
    draw(given, SIDE, true, 0);
    assert_true(accepted(given, SIDE, &out));
}

/* Thin things before a slope, as near to it as a coarse step or much nearer to the eye: fences whose pales are a pixel
 * wide, wire meshes, grass, and, far before it, posts where the slope's coarse code steps and nowhere else. They are
 * what they are; enlarged, what stands apart is refused. */
TEST(thin_things) {
    static const double slopes[] = {3e-4, 7e-4, 1e-3}, nearer[] = {0.0012, 0.003, 0.05};
    uint8_t given[SIDE * SIDE * 2], larger[4 * SIDE * SIDE * 2];
    rng r = rng_make("thin things");
    unpacked out;
    for (int kind = 0; kind < 6; kind++)
        for (size_t i = kind < 5 ? 0 : 6; i < 9; i++) {
            const double by = nearer[i / 3];
            for (int y = 0; y < SIDE; y++)
                for (int x = 0; x < SIDE; x++) {
                    const double behind = 0.1 + (x + 0.37 * y) * slopes[i % 3];
                    const bool steps = floor(255 * behind) > floor(255 * (behind - slopes[i % 3]));
                    const bool thin = kind == 0   ? x % 2 == 1
                                      : kind == 1 ? x % 3 == 0
                                      : kind == 2 ? x % 5 == 0 || y % 4 == 0
                                      : kind == 3 ? rng_below(&r, 3) == 0
                                      : kind == 4 ? (x + y) % 4 == 0
                                                  : steps;
                    const double away = kind == 3 ? rng_unit(&r) * by : by;
                    packing_texel(packing_find("rg"), packing_nearest(packing_find("rg"), behind - (thin ? away : 0)),
                                  given + 2 * (y * SIDE + x));
                }
            if (!accepted(given, SIDE, &out))
                fail_msg("kind %d, slope %g, %g nearer: %s", kind, slopes[i % 3], by, out.wrong);
            enlarge(given, larger);
            if (kind == 2 && by == 0.05)
                assert_false(accepted(larger, 2 * SIDE, &out));
        }
}

/* A truncated fine channel is full where the coarse one is a step short: that is counted. */
TEST(truncated) {
    const packing *p = packing_find("rg");
    uint8_t given[SIDE * SIDE * 2];
    unpacked out;
    rng r = rng_make("truncated texels");
    for (int i = 0; i < SIDE * SIDE; i++) {
        const double v = 0.1 + (i % SIDE + 0.37 * (i / SIDE)) * 1e-3, fine = 255 * v - floor(255 * v);
        const double rounded = rng_below(&r, 2) == 0 ? 1 - 1e-9 : 1 + 1e-9; /* as binary32 leaves it */
        given[2 * i] = (uint8_t)floor(255 * (v - fine / 255) * rounded);
        given[2 * i + 1] = (uint8_t)floor(255 * fine);
    }
    image img = {.width = SIDE, .height = SIDE, .channels = 2, .type = IMAGE_U8, .data = malloc(sizeof given)};
    memcpy(img.data, given, sizeof given);
    assert_true(packing_convert(p, true, &img, &out));
    assert_true(out.grain.margin >= p->off + p->cut);
    for (int i = 0; i < SIDE * SIDE; i++) {
        const double v = 0.1 + (i % SIDE + 0.37 * (i / SIDE)) * 1e-3, got = (double)((const float *)img.data)[i];
        assert_true(v - got >= -1e-7 && v - got <= out.grain.margin + 1 / p->steps + 1e-7);
    }
    image_free(&img);
}

/* A wall that leans, as a shader in binary32 packs and a target truncates it: where the coarse channel steps it is torn
 * as averages are. */
TEST(truncation_tears) {
    enum { ACROSS = 32, DOWN = 96 };
    for (int truncated = 0; truncated < 2; truncated++) {
        unpacked out;
        image img = {
            .width = ACROSS, .height = DOWN, .channels = 2, .type = IMAGE_U8, .data = malloc(2 * ACROSS * DOWN)};
        for (int i = 0; i < ACROSS * DOWN; i++) {
            const float v = (float)(0.38979433010788372 + 0.0011586887735863763 * (i / ACROSS));
            const float scaled = v * 255, fine = scaled - floorf(scaled), less = fine / 255, coarse = v - less;
            ((uint8_t *)img.data)[2 * i] = (uint8_t)floorf(coarse * 255);
            ((uint8_t *)img.data)[2 * i + 1] = (uint8_t)floorf(fine * 255);
        }
        assert_int_equal(packing_convert(packing_find("rg"), truncated != 0, &img, &out), truncated);
        assert_true(truncated || strncmp(out.wrong, "was resampled", 13) == 0);
        image_free(&img);
    }
}

TEST(wider_samples) {
    static const image_type types[] = {IMAGE_U16, IMAGE_F32, IMAGE_F64};
    for (size_t i = 0; i < sizeof types / sizeof types[0]; i++)
        for (int between = 0; between < 2; between++) {
            unpacked out;
            image img = {.width = 2, .height = 2, .channels = 2, .type = types[i]};
            img.data = calloc(8, 8);
            for (size_t k = 0; k < 8; k++) {
                const double code = 31.0 * (double)k + (between && k == 6 ? 0.01 : 0);
                truth_store(img.data, types[i], k, types[i] == IMAGE_U16 ? rint(code * 257) : code / 255);
            }
            assert_int_equal(packing_convert(packing_find("rg"), false, &img, &out), !between);
            if (between)
                assert_string_equal(
                    out.wrong, "pixel 1,1 lies between the codes of 8 bits: it was resampled, or is not of 8 bits");
            else
                for (size_t k = 0; k < 4; k++)
                    assert_true(fabs((double)((const float *)img.data)[k] -
                                     (62.0 * (double)k * 255 + 62.0 * (double)k + 31) / 65025) < 1e-7);
            image_free(&img);
        }
    image img = {.width = 1, .height = 1, .channels = 2, .type = IMAGE_U8, .data = calloc(8, 1)};
    unpacked out;
    assert_false(packing_convert(packing_find("rgb24"), false, &img, &out));
    assert_string_equal(out.wrong, "the packing rgb24 takes 3 channels, got 2");
    img.type = IMAGE_U32;
    assert_false(packing_convert(packing_find("rg"), false, &img, &out));
    assert_string_equal(out.wrong,
                        "the packing rg takes samples of u1, or of u2, f4 or f8 that were of 8 bits, got u4");
    image_free(&img);
}

/* Alpha of 0 and 1 alone tells nothing: pixels that were cleared have no colour either way. */
TEST(premultiplied) {
    enum { CLEARED = 2 };
    rng r = rng_make("premultiplied");
    for (int times = 0; times <= CLEARED; times++) {
        image img = {.width = 32, .height = 32, .channels = 4, .type = IMAGE_U8, .data = malloc(4096)};
        uint8_t *texels = img.data;
        unpacked out;
        for (size_t k = 0; k < 4096; k++)
            texels[k] = (uint8_t)(times == CLEARED && k % 4 == 3 ? 255 * (k / 4 % 3 != 0) : rng_below(&r, 256));
        for (size_t k = 0; k < 4096 && times > 0; k++)
            texels[k] = k % 4 == 3 ? texels[k] : (uint8_t)(texels[k] * texels[k / 4 * 4 + 3] / 255);
        assert_true(packing_convert(packing_find("rgba"), false, &img, &out));
        assert_int_equal(out.premultiplied, times == 1);
        image_free(&img);
    }
}

/* ---- The program --------------------------------------------------------------------------------------------------*/

static bool holds(const char *file, const char *text) {
    char said[4096] = "";
    FILE *f = fopen(truth_path(file), "r");
    assert_non_null(f);
    said[fread(said, 1, sizeof said - 1, f)] = '\0';
    fclose(f);
    return strstr(said, text) != NULL;
}

static bool was_said(const char *text) {
    return holds("said", text);
}

static int run(const char *const *words) {
    size_t count = 0;
    while (words[count] != NULL)
        count++;
    return truth_run(words, count);
}

static void same_files(const char *a, const char *b) {
    image one, other;
    image_error error;
    assert_true(image_read(truth_path(a), &one, &error));
    assert_true(image_read(truth_path(b), &other, &error));
    assert_int_equal(one.channels, other.channels);
    assert_memory_equal(one.data, other.data, (size_t)PIXELS * one.channels);
    assert_string_equal(one.note, other.note);
    image_free(&one);
    image_free(&other);
}

/* A ramp of depths is packed, read back without an option within what the error map says, and packed again. */
TEST(there_and_back) {
    float depths[PIXELS], eyes[PIXELS], errors[PIXELS];
    for (int i = 0; i < PIXELS; i++)
        depths[i] = (float)i / PIXELS * 0.9F + 0.05F;
    truth_write(truth_path("in.npy"), IMAGE_NPY, IMAGE_F32, depths);
    for (size_t i = 0; i < 2 * ALL; i++) {
        const bool ortho = i % 2 != 0;
        const char *name = all[i / 2].name;
        const char *in = truth_path("in.npy"), *png = truth_path("in.png"), *again = truth_path("eye.png");
        char product[64];
        snprintf(product, sizeof product, "pack:%s", name);
        assert_int_equal(run((const char *const[]){in, "-n", "0.5", "-f", "40", "-F", "fp32", "-m", "d3d", "--product",
                                                   product, "-o", png, ortho ? "--ortho" : NULL, NULL}),
                         0);
        const command base = {.arguments = {png, "-q"}, .count = 2};
        char field[48];
        snprintf(field, sizeof field, "\"packing\":\"%s\"", name);
        assert_int_equal(run((const char *const[]){png, "-q", "--json", "-o", truth_path("said.json"), NULL}), 0);
        assert_true(holds("said.json", field));
        truth_product(&base, "eye.npy", "eye", NULL, false);
        truth_product(&base, "map.npy", "eye", NULL, true);
        truth_floats("eye.npy", 1, eyes);
        truth_floats("map.npy", 1, errors);
        tally t = {.name = name};
        for (int k = 0; k < PIXELS; k++) {
            const double d = (double)depths[k], z = ortho ? 0.5 + 39.5 * d : 1 / (1 / 0.5 - d * (1 / 0.5 - 1 / 40.0));
            TALLY(&t, fabs((double)eyes[k] - z) <= (double)errors[k] && errors[k] < 0.5F * eyes[k],
                  "pixel %d: %.9g instead of %.9g, at most %.3g off", k, (double)eyes[k], z, (double)errors[k]);
        }
        tally_end(&t);
        assert_int_equal(run((const char *const[]){png, "-q", "--product", product, "-o", again, NULL}), 0);
        same_files("in.png", "eye.png");
    }
}

/* Where nothing is drawn lies the far plane, which is said. */
TEST(holes) {
    static const struct {
        const char *packing, *mapping;
        uint8_t far[3];
    } rows[] = {{"rgb24", "d3d", {255, 255, 255}}, {"rgb24", "reversed", {0, 0, 0}}, {"rg", "reversed", {255, 0}}};
    float depths[PIXELS];
    for (int i = 0; i < PIXELS; i++)
        depths[i] = i < 2 ? (float)NAN : 0.5F;
    truth_write(truth_path("in.npy"), IMAGE_NPY, IMAGE_F32, depths);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        image img;
        image_error error;
        char product[64];
        snprintf(product, sizeof product, "pack:%s", rows[i].packing);
        assert_int_equal(
            run((const char *const[]){truth_path("in.npy"), "-n", "1", "-f", "40", "-F", "fp32", "-m", rows[i].mapping,
                                      "--product", product, "-o", truth_path("eye.npy"), NULL}),
            0);
        assert_true(was_said("eye.npy: 2 pixels hold no depth and are written as the far plane"));
        assert_true(image_read(truth_path("eye.npy"), &img, &error));
        const uint8_t *texels = img.data;
        assert_memory_equal(texels, rows[i].far, img.channels);
        assert_memory_equal(texels + img.channels, rows[i].far, img.channels);
        assert_memory_not_equal(texels + 2 * (size_t)img.channels, rows[i].far, img.channels);
        image_free(&img);
    }
}

static float decode_rg(const uint8_t *t) { /* DecodeFloatRG */
    return (float)t[0] / 255.0F + (float)t[1] / 255.0F * (1.0F / 255.0F);
}

/* frac makes the camera of the far plane. --product pack writes what reads back as the far plane, and says so; of all
 * depths before it, to the last binary32 number, both write the nearest number. */
TEST(the_far_plane_wraps) {
    uint8_t shader[2], ours[2];
    float depths[PIXELS];
    image img;
    image_error error;
    shader_rg(1, shader);
    assert_true(shader[0] == 0 && shader[1] == 0 && decode_rg(shader) == 0);
    for (int k = 0; k < 100000; k++) {
        const float v = 1 - (float)(k + 1) * 0x1p-24F;
        shader_rg(v, shader);
        packing_texel(packing_find("rg"), packing_nearest(packing_find("rg"), (double)v), ours);
        const double exact = 65025 * (double)v, off = 65025 * packing_find("rg")->off;
        assert_true(fabs(exact - (255 * shader[0] + shader[1])) <= 0.5 + off);
        assert_true(fabs(exact - (255 * ours[0] + ours[1])) <= 0.5);
    }
    for (int i = 0; i < PIXELS; i++)
        depths[i] = i < 5 ? 1 : 0.5F;
    truth_write(truth_path("in.npy"), IMAGE_NPY, IMAGE_F32, depths);
    assert_int_equal(run((const char *const[]){truth_path("in.npy"), "-n", "1", "-f", "40", "-F", "fp32", "-m", "d3d",
                                               "--product", "pack:rg", "-o", truth_path("eye.npy"), NULL}),
                     0);
    assert_true(was_said("eye.npy: 5 pixels at the far plane are written as 255, 0, which shaders read as 1; "
                         "EncodeFloatRG writes 0, 0, which they read as 0, the camera"));
    assert_true(image_read(truth_path("eye.npy"), &img, &error));
    const uint8_t *texels = img.data;
    assert_true(texels[8] == 255 && texels[9] == 0 && decode_rg(texels + 8) == 1 && decode_rg(texels + 10) < 1);
    image_free(&img);
    assert_int_equal(run((const char *const[]){truth_path("in.npy"), "-n", "1", "-f", "40", "-F", "fp32", "-m", "d3d",
                                               "--product", "pack:rgba", "-o", truth_path("eye.npy"), NULL}),
                     0);
    assert_false(was_said("at the far plane"));
}

static void write_texels(const uint8_t *texels, uint32_t channels) {
    FILE *f = fopen(truth_path("in.npy"), "wb");
    assert_non_null(f);
    image_writer *w = image_writer_open(f, IMAGE_NPY, IMAGE_U8, WIDTH, HEIGHT, channels, NULL);
    assert_true(w != NULL && image_writer_rows(w, texels, HEIGHT) && image_writer_close(w));
    assert_int_equal(fclose(f), 0);
}

/* A target that was cleared to black, with a few depths; `cleared` pixels of it are still 0, or hold a normal alone. */
static void write_cleared(const packing *p, int cleared, bool normal) {
    uint8_t texels[4 * PIXELS] = {0};
    for (int i = 0; i < cleared && normal; i++)
        packing_normal_texel((const double[]){0, 0.6, 0.8}, texels + (size_t)i * p->channels);
    for (int i = cleared; i < PIXELS; i++)
        packing_texel(p, packing_nearest(p, 0.2 + 0.003 * i), texels + (size_t)i * p->channels);
    write_texels(texels, p->channels);
}

/* A pixel that no surface writes has no depth: sky, or with --sky 0 a hole. Without frac a 0 is what it says. */
TEST(cleared_to_black) {
    static const struct {
        const char *packing, *sky, *znear, *counts, *zeros, *said;
    } rows[] = {
        {"depth-normals", "0.0001", "1", "\"invalid\":0,\"sky\":{\"pixels\":7,", "\"zeros\":7},\"lo\":8.8",
         "in.npy: 7 pixels hold 0, a clear to black or the far plane after frac: they count as sky; --sky 0 makes"},
        {"rg", "0.0001", "1", "\"invalid\":0,\"sky\":{\"pixels\":7,", "\"zeros\":7},\"lo\":8.8",
         "in.npy: 7 pixels hold 0, a clear to black or the far plane after frac: they count as sky; --sky 0 makes"},
        {"rg", "0", "1", "\"invalid\":7,\"sky\":{\"pixels\":0,", "\"zeros\":7},\"lo\":8.8",
         "in.npy: 7 pixels hold 0, a clear to black or the far plane after frac: they are holes"},
        {"rg", "0.0001", "0.0003", "\"invalid\":0,\"sky\":{\"pixels\":7,", "\"zeros\":7},\"lo\":8.8",
         "after frac, or depths up to 0.000313: they count"}, /* half of 40/65025, and binary32 */
        {"linear01", "0.0001", "1", "\"invalid\":0,\"sky\":{\"pixels\":0,", "\"zeros\":0},\"lo\":0,", NULL}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        float eyes[PIXELS], fog[PIXELS];
        const char *const in = truth_path("in.npy");
        const bool depth = rows[i].said == NULL;
        write_cleared(packing_find(rows[i].packing), 7, false);
        assert_int_equal(
            run((const char *const[]){in, "-n", rows[i].znear, "-f", "40", "--packing", rows[i].packing, "--sky",
                                      rows[i].sky, "--json", "-o", truth_path("said.json"), NULL}),
            0);
        assert_true(depth ? !was_said("hold 0") : was_said(rows[i].said));
        assert_true(holds("said.json", rows[i].counts) && holds("said.json", rows[i].zeros));
        const command base = {.arguments = {in, "-q", "-n", rows[i].znear, "-f", "40", "--packing", rows[i].packing,
                                            "--sky", rows[i].sky},
                              .count = 10};
        truth_product(&base, "eye.npy", "eye", NULL, false);
        truth_floats("eye.npy", 1, eyes);
        truth_product(&base, "map.npy", "effect", "fog", false);
        truth_floats("map.npy", 1, fog);
        for (int k = 0; k < PIXELS; k++)
            assert_true(k < 7 && !depth ? isnan(eyes[k]) && isnan(fog[k]) : (eyes[k] > 0) == (k >= 7) && fog[k] < 1);
    }
}

/* The packed normals of a wall that is seen head-on: towards the camera, which is against the view axis. */
TEST(normals_come_back) {
    float normals[3 * PIXELS];
    const char *png = truth_path("in.png"), *npy = truth_path("place.npy");
    assert_int_equal(
        run((const char *const[]){"--synthetic", "plane", "--size", "24x10", "-n", "1", "-f", "20", "--fov", "40",
                                  "--parameter", "tilt=30", "--product", "pack:depth-normals", "-o", png, NULL}),
        0);
    assert_int_equal(run((const char *const[]){png, "--product", "packed-normal", "-o", npy, NULL}), 0);
    truth_floats("place.npy", 3, normals);
    double want[3];
    packing_normal((const uint8_t[]){128, 128}, want);
    for (int i = 0; i < PIXELS; i++) {
        const double n[3] = {(double)normals[3 * i], (double)normals[3 * i + 1], (double)normals[3 * i + 2]};
        assert_true(fabs(n[0] * n[0] + n[1] * n[1] + n[2] * n[2] - 1) < 1e-6);
        assert_true(n[2] < -0.8 && n[2] > -0.92); /* tilted by 30 degrees */
    }
    assert_int_equal(run((const char *const[]){truth_path("in.npy"), "--product", "packed-normal", "-o", npy, NULL}),
                     2);
    assert_true(was_said("--product: packed-normal needs FILE with --packing depth-normals or camera-normals"));
}

/* Where nothing was drawn there is no normal beside the depth, whatever counts as sky; of sky there is none either. */
TEST(cleared_normals) {
    static const struct {
        const char *sky;
        double from; /* the depth from which on all is sky */
    } rows[] = {{"0.0001", 1}, {"none", 1}, {"0", 1}, {"0.3", 0.7}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        for (int map = 0; map < 4; map++) {
            float normals[3 * PIXELS];
            const char *npy = truth_path("place.npy");
            write_cleared(packing_find("depth-normals"), 7, map / 2 == 1);
            assert_int_equal(run((const char *const[]){truth_path("in.npy"), "--packing", "depth-normals", "--sky",
                                                       rows[i].sky, "--product", "packed-normal", "-q", "-o", npy,
                                                       map % 2 ? "--error-map" : NULL, NULL}),
                             0);
            truth_floats("place.npy", map % 2 ? 1 : 3, normals);
            /* A normal at what is read as the far plane is kept where nothing counts as sky. */
            const bool kept = map / 2 == 1 && strcmp(rows[i].sky, "none") == 0;
            for (int k = 0; k < PIXELS; k++)
                assert_true(isnan(normals[map % 2 ? k : 3 * k]) == (k < 7 ? !kept : 0.2 + 0.003 * k > rows[i].from));
        }
}

/* A pass of one's own that writes eye depth over far in binary32, to targets of more than 8 bits: within the bound, of
 * which 16 bits reach nearly all. */
TEST(linear01_of_any_type) {
    static const image_type types[] = {IMAGE_U16, IMAGE_F16, IMAGE_F32, IMAGE_F64};
    static const float over_far = 1.0F / 500;
    rng r = rng_make("linear01");
    for (size_t t = 0; t < sizeof types / sizeof types[0]; t++) {
        double given[PIXELS], data[PIXELS], most = 0;
        float eyes[PIXELS], bounds[PIXELS];
        for (int i = 0; i < PIXELS; i++) {
            const float z = (float)(0.3 + 499 * rng_unit(&r) * rng_unit(&r)), stored = z * over_far;
            const int halves = stored < 0x1p-14F ? -24 : ilogbf(stored) - 10;
            given[i] = (double)z;
            truth_store(data, types[t], (size_t)i,
                        types[t] == IMAGE_U16   ? floor((double)stored * 65535 + 0.5)
                        : types[t] == IMAGE_F16 ? ldexp(rint(ldexp((double)stored, -halves)), halves)
                                                : (double)stored);
        }
        truth_write(truth_path("in.npy"), IMAGE_NPY, types[t], data);
        assert_int_equal(
            run((const char *const[]){truth_path("in.npy"), "--packing", "linear01", "-f", "500", "--product", "eye",
                                      "-o", truth_path("eye.npy"), "--error-map", NULL}),
            0);
        truth_floats("eye.npy", 1, bounds);
        assert_int_equal(run((const char *const[]){truth_path("in.npy"), "--packing", "COMPUTE_DEPTH_01", "-f", "500",
                                                   "--product", "eye", "-o", truth_path("eye.npy"), NULL}),
                         0);
        truth_floats("eye.npy", 1, eyes);
        for (int i = 0; i < PIXELS; i++) {
            const double off = fabs((double)eyes[i] - given[i]);
            if (!(off <= (double)bounds[i]))
                fail_msg("%s: %g is off by %g, bound %g", image_type_name(types[t]), given[i], off, (double)bounds[i]);
            most = fmax(most, off / (double)bounds[i]);
        }
        assert_true(most > (types[t] <= IMAGE_F16 ? 0.9 : 0.3));
    }
}

/* ---- Normals alone ------------------------------------------------------------------------------------------------*/

/* The shader: SNORM to the nearest; or folded octahedral, 12 bits each, cut off, with the third channel for high bits.
 */
static void camera_texel(const float n[3], bool oct, uint8_t texel[3]) {
    const float size = fabsf(n[0]) + fabsf(n[1]) + fabsf(n[2]), fold = n[2] < 0 ? -n[2] / size : 0;
    int code[2];
    for (int i = 0; i < 3; i++)
        texel[i] = (uint8_t)(int)roundf(n[i] * 127);
    for (int i = 0; i < 2; i++) {
        const float at = n[i] / size + (n[i] >= 0 ? fold : -fold);
        code[i] = (int)(fminf(fmaxf(at * 0.5F + 0.5F, 0), 1) * 4095.5F);
        texel[i] = oct ? (uint8_t)(code[i] % 256) : texel[i];
    }
    texel[2] = oct ? (uint8_t)(code[0] / 256 + code[1] / 256 * 16) : texel[2];
}

static double degrees_between(const double a[3], const double b[3]) {
    const double c[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    return atan2(sqrt(c[0] * c[0] + c[1] * c[1] + c[2] * c[2]), a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) * 180 / M_PI;
}

/* _CameraNormalsTexture of a camera that looks along the world's x, so that its right is the world's -z: what comes out
 * is within the bound of each pixel, which some come close to; a cleared texel has none. */
TEST(normals_of_the_camera) {
    rng r = rng_make("camera normals");
    double most = 0;
    for (int round = 0; round < 16; round++) {
        const bool oct = round % 2 == 1;
        const char *name = oct ? "camera-normals-oct" : "camera-normals", *in = truth_path("in.npy");
        uint8_t texels[3 * PIXELS] = {0};
        float given[3 * PIXELS], normals[3 * PIXELS], bounds[PIXELS];
        for (int i = 1; i < PIXELS; i++) {
            const double z = 2 * rng_unit(&r) - 1, turn = 2 * M_PI * rng_unit(&r), across = sqrt(1 - z * z);
            float *n = given + 3 * (size_t)i;
            n[0] = (float)(across * cos(turn));
            n[1] = (float)(across * sin(turn));
            n[2] = (float)z;
            camera_texel(n, oct, texels + 3 * (size_t)i);
        }
        write_texels(texels, 3);
        assert_int_equal(run((const char *const[]){in, "--packing", name, "--look", "1,0,0", "--product", "normal",
                                                   "-o", truth_path("place.npy"), NULL}),
                         0);
        truth_floats("place.npy", 3, normals);
        assert_int_equal(run((const char *const[]){in, "--packing", name, "--product", "packed-normal", "--error-map",
                                                   "-o", truth_path("map.npy"), NULL}),
                         0);
        truth_floats("map.npy", 1, bounds);
        assert_true(isnan(normals[0]) && isnan(normals[1]) && isnan(normals[2]) && isnan(bounds[0]));
        for (int i = 1; i < PIXELS; i++) {
            const float *n = given + 3 * (size_t)i, *o = normals + 3 * (size_t)i;
            const double own[3] = {-(double)n[2], (double)n[1], (double)n[0]};
            const double off = degrees_between(own, (const double[]){(double)o[0], (double)o[1], (double)o[2]});
            assert_true(off <= (double)bounds[i] && (double)bounds[i] < (oct ? 0.1095 : 0.391));
            most = fmax(most, off / (double)bounds[i]);
        }
    }
    assert_true(most > 0.95);
    uint8_t half[3 * PIXELS];
    for (int i = 0; i < 3 * PIXELS; i++)
        half[i] = (uint8_t)(i % 3 == 2 ? 255 : 128); /* 0.5 n + 0.5 of z */
    write_texels(half, 3);
    assert_int_equal(run((const char *const[]){truth_path("in.npy"), "--packing", "camera-normals", "--product",
                                               "normal", "-o", truth_path("place.npy"), NULL}),
                     2);
    assert_true(was_said("240 of 240 texels hold no vector of length 1: no SNORM normals"));
}

/* A plane whose normal is 124 degrees from the axis, seen at the left edge of a view of 160 degrees: stereographic
 * channels end at 1.7777, which is tan of half of 121.3 degrees; octahedral ones hold it. */
TEST(normals_that_are_lost) {
    const double n[2] = {sin(124 * M_PI / 180), -cos(124 * M_PI / 180)}, wide = tan(80 * M_PI / 180) * WIDTH / HEIGHT;
    float depths[PIXELS];
    for (int i = 0; i < PIXELS; i++) {
        const double slope = ((2.0 * (i % WIDTH) + 1) / WIDTH - 1) * wide, towards = n[0] * slope + n[1];
        depths[i] = towards < -0.5 ? (float)(-10 / towards) : 0;
    }
    const char *in = truth_path("eye.npy"), *png = truth_path("in.png");
    FILE *f = fopen(in, "wb");
    image_writer *w = image_writer_open(f, IMAGE_NPY, IMAGE_F32, WIDTH, HEIGHT, 1, NULL);
    assert_true(w != NULL && image_writer_rows(w, depths, HEIGHT) && image_writer_close(w));
    assert_int_equal(fclose(f), 0);
    for (int oct = 0; oct < 2; oct++) {
        float seen[3 * PIXELS];
        double worst = 0;
        int lost = 0;
        char words[128];
        assert_int_equal(
            run((const char *const[]){in, "--metric", "1", "-f", "100", "--fov", "160", "--product",
                                      oct ? "pack:camera-normals-oct" : "pack:depth-normals", "-o", png, NULL}),
            0);
        snprintf(words, sizeof words, "have normals that stereo-8 does not hold: they come back up to");
        assert_true(was_said(words) == (oct == 0));
        if (oct)
            continue;
        assert_int_equal(
            run((const char *const[]){png, "--product", "packed-normal", "-o", truth_path("place.npy"), "-q", NULL}),
            0);
        truth_floats("place.npy", 3, seen);
        for (int i = 0; i < PIXELS; i++) {
            const double back[3] = {(double)seen[3 * i], (double)seen[3 * i + 1], (double)seen[3 * i + 2]};
            const double off = degrees_between(back, (const double[]){n[0], 0, n[1]});
            lost += depths[i] > 0 && off > 1.2;
            worst = depths[i] > 0 ? fmax(worst, off) : worst;
        }
        assert_true(lost > 20 && fabs(worst - 2.7) < 0.1);
        assert_int_equal(run((const char *const[]){in, "--metric", "1", "-f", "100", "--fov", "160", "--product",
                                                   "pack:depth-normals", "-o", png, NULL}),
                         0);
        snprintf(words, sizeof words, "%d pixels have normals that stereo-8 does not hold: they come back up to %.2f",
                 lost, worst);
        if (!was_said(words))
            fail_msg("not said: %s", words);
    }
}

TEST(warnings) {
    static const struct {
        const char *chunk, *data;
        size_t size;
        const char *said;
    } rows[] = {{"sRGB", "\0", 1, "has an sRGB chunk"},
                {"gAMA", "\0\0\xb1\x8f", 4, "has a gAMA chunk"},
                {"gAMA", "\0\1\x86\xa0", 4, NULL}, /* 1 */
                {"iCCP", "x\0\0whatever", 11, "has an iCCP chunk"},
                {"tEXt", "Author\0me", 9, NULL}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        static const unsigned char pixels[24] = {1, 2, 3, 4, 5, 6, 7, 8, 9};
        handmade h = {.size = 0}, with = {.size = 0};
        handmade_png(&h, 4, 2, 8, 2, 0, 3, pixels);
        handmade_bytes(&with, h.at, 33);
        handmade_chunk(&with, rows[i].chunk, rows[i].data, rows[i].size);
        handmade_bytes(&with, h.at + 33, h.size - 33);
        FILE *f = fopen(truth_path("in.png"), "wb");
        assert_int_equal(fwrite(with.at, 1, with.size, f), with.size);
        fclose(f);
        assert_int_equal(run((const char *const[]){truth_path("in.png"), "--packing", "rgb24", "-m", "d3d", "--product",
                                                   "eye", "-o", truth_path("eye.npy"), NULL}),
                         0);
        assert_int_equal(was_said("chunk"), rows[i].said != NULL);
        assert_true(rows[i].said == NULL || was_said(rows[i].said));
    }
}

/* Colours that are not grey are refused where nobody says that depth is packed into them, or asks for a channel. */
TEST(colours_may_be_packed) {
    static const struct {
        int colour; /* of PNG: 0 grey, 2 RGB, 6 RGBA */
        size_t channels;
        unsigned char pixels[32];
        bool said;
    } rows[] = {{2, 3, {1, 2, 3, 4, 5, 6, 7, 8, 9}, true},
                {2, 3, {9, 9, 9, 7, 7, 7, 5, 5, 5}, false},
                {2, 3, {9, 9, 9, 7, 7, 7, 5, 5, 5, [21] = 3, 3, 4}, true},
                {2, 3, {9, 9, 9, [21] = 3, 4, 3}, true},
                {6, 4, {9, 9, 9, 255, 4, 4, 4, 255, 4, 4, 4, 255}, false},
                {6, 4, {9, 9, 1, 255, 4, 4, 4, 255}, true},
                {0, 1, {1, 2, 3, 4, 5, 6, 7, 8}, false}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        handmade h = {.size = 0};
        handmade_png(&h, 4, 2, 8, rows[i].colour, 0, rows[i].channels, rows[i].pixels);
        FILE *f = fopen(truth_path("in.png"), "wb");
        assert_int_equal(fwrite(h.at, 1, h.size, f), h.size);
        fclose(f);
        assert_int_equal(run((const char *const[]){truth_path("in.png"), "-F", "d24", "-m", "d3d", "--product", "eye",
                                                   "-o", truth_path("eye.npy"), NULL}),
                         rows[i].said ? 2 : 0);
        if (was_said("--packing NAME, a depth that several hold together") != rows[i].said)
            fail_msg("row %zu", i);
        if (rows[i].said)
            assert_int_equal(run((const char *const[]){truth_path("in.png"), "-F", "d24", "-m", "d3d", "--channel", "G",
                                                       "--product", "eye", "-o", truth_path("eye.npy"), NULL}),
                             0);
        assert_false(rows[i].said && was_said("--packing"));
    }
}

/* A file's words on itself are read as options are: what they refuse is refused, and terminals see plain text. */
TEST(notes_of_others) {
    static const struct {
        const char *text;
        int status;
        const char *said;
    } rows[] = {
        {"product=depth packing=rgb24 near=0.5 far=40 mapping=reversed", 0, NULL},
        {"product=depth packing=rgb25 near=0.5 far=40", 2, "--packing: must be"},
        {"product=depth packing=rgb24 near=-1 far=40", 2, "--near: must be from 1e-12 to 1e12"},
        {"product=\033[31mred", 2, "holds ?[31mred, as depthprec wrote them"},
        {"unknown=1 packing=rgb24 output=/tmp/x ortho=3", 0, NULL},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        static const unsigned char pixels[24] = {1, 2, 3, 4, 5, 6, 7, 8, 9};
        char text[128];
        const int length = snprintf(text, sizeof text, "depthprec%c%s", 0, rows[i].text);
        handmade h = {.size = 0}, with = {.size = 0};
        handmade_png(&h, 4, 2, 8, 2, 0, 3, pixels);
        handmade_bytes(&with, h.at, 33);
        handmade_chunk(&with, "tEXt", text, (size_t)length);
        handmade_bytes(&with, h.at + 33, h.size - 33);
        FILE *f = fopen(truth_path("in.png"), "wb");
        assert_int_equal(fwrite(with.at, 1, with.size, f), with.size);
        fclose(f);
        assert_int_equal(
            run((const char *const[]){truth_path("in.png"), "--product", "eye", "-o", truth_path("eye.npy"), NULL}),
            rows[i].status);
        if (rows[i].said != NULL && !was_said(rows[i].said))
            fail_msg("not said: %s", rows[i].said);
    }
}

/* Options stand against others; what is not known to be safe is never written. */
TEST(refusals) {
    static const uint8_t pixels[4 * 2 * 3] = {1, 2, 3};
    const char *in = truth_path("in.png"), *out = truth_path("map.png");
    handmade h = {.size = 0};
    handmade_png(&h, 4, 2, 8, 2, 0, 3, pixels);
    FILE *f = fopen(in, "wb");
    assert_true(f != NULL && fwrite(h.at, 1, h.size, f) == h.size && fclose(f) == 0);
    const struct {
        const char *words[12];
        const char *said;
    } rows[] = {
        {{in, "--packing", "rg", "-m", "d3d"},
         "--mapping: does not apply with --packing rg, which is not window depth"},
        {{in, "--packing", "rg", "-F", "fp32"}, "--format: does not apply with --packing rg"},
        {{in, "--packing", "rg", "--metric", "1"}, "--metric: conflicts with --packing"},
        {{in, "--packing", "depth-normals"}, "the packing depth-normals takes 4 channels, got 3"},
        {{"--synthetic", "plane", "--packing", "rg"}, "--packing: needs FILE"},
        {{in, "--packing", "rgb24", "--product", "pack:rg"}, "--product pack needs -o FILE"},
        {{in, "--product", "pack:rg", "-o", "x.pfm"}, "must end in .png or .npy for --product pack, got 'x.pfm'"},
        {{in, "--product", "pack:rg", "--json", "-o", out}, "--json: conflicts with --product pack"},
        {{in, "--product", "pack:rg:low", "-o", out},
         "--product: takes NORMALS with effect:outline and packings of normals, got 'low'"},
        {{"--synthetic", "plane", "-f", "inf", "--product", "pack:rg", "-o", out}, "it needs a finite far plane"},
        {{"--synthetic", "plane", "--ortho", "-n", "-5", "-f", "9", "--product", "pack:rg", "-o", out},
         "it needs near not less than 0"},
        {{in, "--metric", "1", "--channel", "R", "--product", "pack:rgb24", "-o", out},
         "rgb24 holds window depth, which"},
        {{in, "--packing", "camera-normals"}, "camera-normals holds normals and no depth: --product packed-normal"},
        {{in, "--packing", "camera-normals", "--product", "packed-normal", "--error-map", "-o", out},
         "must end in .pfm or .npy for the bounds of packed normals"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        assert_int_equal(run(rows[i].words), 2);
        if (!was_said(rows[i].said))
            fail_msg("not said: %s", rows[i].said);
        assert_int_not_equal(access(out, F_OK), 0);
    }
}

int main(void) {
    return run_listed(truth_folder, truth_folder_end);
}
