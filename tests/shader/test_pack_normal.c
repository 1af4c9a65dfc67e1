/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Packings of normals: each row against an encoding of our own in long double, the measured errors against sampling,
 * areas in the plane of the codes and published figures.
 */
#include "named.h"
#include "pack_measure.h"
#include "support.h"

static const long double PIL = 3.14159265358979323846264338327950288L;

typedef struct vec {
    long double x, y, z;
} vec;

static long double degrees_between(vec a, vec b) {
    const vec c = {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
    return atan2l(sqrtl(c.x * c.x + c.y * c.y + c.z * c.z), a.x * b.x + a.y * b.y + a.z * b.z) * 180 / PIL;
}

/* Stereographic by angles: the radius in the plane is tan(theta/2). */
static long double stereo_error(vec n, int bits, uint32_t codes[3]) {
    const long double most = (long double)((1 << bits) - 1), scale = 1.7777L;
    const long double theta = atan2l(hypotl(n.x, n.y), n.z), phi = atan2l(n.y, n.x);
    const long double radius = tanl(theta / 2);
    codes[0] = (uint32_t)floorl((radius * cosl(phi) / scale / 2 + 0.5L) * most + 0.5L);
    codes[1] = (uint32_t)floorl((radius * sinl(phi) / scale / 2 + 0.5L) * most + 0.5L);
    const long double u = (2 * codes[0] / most - 1) * scale, v = (2 * codes[1] / most - 1) * scale;
    const long double t = 2 * atanl(hypotl(u, v)), p = atan2l(v, u);
    return degrees_between(n, (vec){sinl(t) * cosl(p), sinl(t) * sinl(p), cosl(t)});
}

static long double rounded(long double x) {
    return x < 0 ? ceill(x - 0.5L) : floorl(x + 0.5L);
}

static uint32_t bits_of(long double code, int bits) {
    return (uint32_t)(int64_t)code & ((1U << bits) - 1);
}

static long double sign_of(long double x) {
    return x < 0 ? -1 : 1;
}

static long double oct_error(vec n, int bits, uint32_t codes[3]) {
    const long double most = (long double)((1 << (bits - 1)) - 1);
    const long double s = fabsl(n.x) + fabsl(n.y) + fabsl(n.z);
    long double u = n.x / s, v = n.y / s;
    if (n.z < 0) {
        const long double old = u;
        u = (1 - fabsl(v)) * sign_of(u);
        v = (1 - fabsl(old)) * sign_of(v);
    }
    const long double a = rounded(u * most), b = rounded(v * most);
    codes[0] = bits_of(a, bits);
    codes[1] = bits_of(b, bits);
    vec back = {a / most, b / most, 1 - fabsl(a / most) - fabsl(b / most)};
    if (back.z < 0) {
        const long double old = back.x;
        back.x = (1 - fabsl(back.y)) * sign_of(back.x);
        back.y = (1 - fabsl(old)) * sign_of(back.y);
    }
    return degrees_between(n, back);
}

static long double oct_888_error(vec n, int bits, uint32_t codes[3]) {
    const long double s = fabsl(n.x) + fabsl(n.y) + fabsl(n.z), t = fmaxl(-n.z / s, 0);
    const int i = (int)((0.5L * (n.x / s + sign_of(n.x) * t) + 0.5L) * 4095.5L);
    const int j = (int)((0.5L * (n.y / s + sign_of(n.y) * t) + 0.5L) * 4095.5L);
    (void)bits;
    codes[0] = (uint32_t)(i % 256);
    codes[1] = (uint32_t)(j % 256);
    codes[2] = (uint32_t)(i / 256 + 16 * (j / 256));
    vec back = {2 * i / 4095.0L - 1, 2 * j / 4095.0L - 1, 0};
    back.z = 1 - fabsl(back.x) - fabsl(back.y);
    const long double down = fmaxl(-back.z, 0);
    back.x -= sign_of(back.x) * down;
    back.y -= sign_of(back.y) * down;
    return degrees_between(n, back);
}

static long double xyz_error(vec n, int bits, uint32_t codes[3]) {
    const long double most = (long double)((1 << (bits - 1)) - 1);
    const vec c = {rounded(n.x * most), rounded(n.y * most), rounded(n.z * most)};
    codes[0] = bits_of(c.x, bits);
    codes[1] = bits_of(c.y, bits);
    codes[2] = bits_of(c.z, bits);
    return degrees_between(n, c);
}

static long double own_error(const pack_row *row, vec n, uint32_t codes[3]) {
    static long double (*const all[PACK_LAYOUTS])(vec, int, uint32_t *) = {
        [PACK_STEREO] = stereo_error, [PACK_OCT] = oct_error, [PACK_OCT_888] = oct_888_error, [PACK_XYZ] = xyz_error};
    return all[row->layout](n, row->bits, codes);
}

static vec any_normal(rng *r, const pack_row *row) {
    const long double z = row->sphere ? 2 * (long double)rng_unit(r) - 1 : (long double)rng_unit(r);
    const long double phi = 2 * PIL * (long double)rng_unit(r), radius = sqrtl(1 - z * z);
    return (vec){radius * cosl(phi), radius * sinl(phi), z};
}

/* Random vectors: nothing above the maximum, the mean where it is said to be, the same codes but for ties. */
TEST(test_normals_sampled) {
    rng r = rng_make("normals");
    tally t = {.name = "normals"};
    for (size_t i = 0; i < pack_count(); i++) {
        const pack_row *row = pack_get(i);
        const uint64_t cases = test_cases(20000, 150000, 4000000);
        long double sum = 0, squares = 0;
        double most = 0;
        uint64_t differ = 0;
        if (row->kind == PACK_DEPTH)
            continue;
        const pack_error *e = pack_error_of(row->name);
        for (uint64_t k = 0; k < cases; k++) {
            const vec n = any_normal(&r, row);
            const double in[PACK_INPUTS_MAX] = {(double)n.x, (double)n.y, (double)n.z, 0};
            uint32_t own[3], codes[PACK_CHANNELS_MAX];
            double back[PACK_INPUTS_MAX];
            const long double error = own_error(row, n, own);
            row->encode(row, in, codes);
            row->decode(row, codes, back);
            if (memcmp(own, codes, sizeof own[0] * (size_t)(row->kind == PACK_NORMAL ? row->channels : 2)) != 0)
                differ++;
            else
                TALLY(&t, fabsl(degrees_between(n, (vec){back[0], back[1], back[2]}) - error) < 1e-12L,
                      "%s %La %La %La", row->name, n.x, n.y, n.z);
            if (row->kind == PACK_NORMAL) {
                const double reach = pack_reach(row, codes, false);
                TALLY(&t, error <= (long double)reach && reach <= e->normal.max * 1.01, "%s: %.9Lg, bound %.9g",
                      row->name, error, reach);
                most = fmax(most, (double)error / reach);
            }
            TALLY(&t, error <= (long double)e->normal.max * (1 + 1e-12L), "%s: %.9Lg at %La %La %La", row->name, error,
                  n.x, n.y, n.z);
            sum += error;
            squares += error * error;
        }
        const long double mean = sum / cases, spread = sqrtl((squares / cases - mean * mean) / cases);
        TALLY(&t, row->kind != PACK_NORMAL || most > 0.98, "%s: %g of the bound of a code is reached", row->name, most);
        TALLY(&t, differ <= 1, "%s: %llu codes differ", row->name, (unsigned long long)differ);
        TALLY(&t, fabsl(mean - (long double)e->normal.mean) <= 5 * hypotl(spread, (long double)e->normal_spread),
              "%s: mean %.9Lg +- %.2Lg, %.9g measured", row->name, mean, spread, e->normal.mean);
    }
    tally_end(&t);
}

/* ---- Shaders of binary32, at the corners of codes ---------------------------------------------------------------- */

static float sign_of32(float x) {
    return x < 0 ? -1 : 1;
}

static void stereo_32(vec n, int bits, uint32_t codes[3]) {
    const float most = (float)((1 << bits) - 1), in[] = {(float)n.x, (float)n.y}, z = (float)n.z + 1;
    for (int k = 0; k < 2; k++) {
        const float e = in[k] / z / 1.7777F * 0.5F + 0.5F;
        codes[k] = (uint32_t)floorf(e * most + 0.5F);
    }
}

static void oct_32(vec n, int bits, uint32_t codes[3]) {
    const float most = (float)((1 << (bits - 1)) - 1), s = fabsf((float)n.x) + fabsf((float)n.y) + fabsf((float)n.z);
    const float x = (float)n.x / s, y = (float)n.y / s, down = fmaxf(-(float)n.z / s, 0);
    codes[0] = bits_of(roundf((x + sign_of32(x) * down) * most), bits);
    codes[1] = bits_of(roundf((y + sign_of32(y) * down) * most), bits);
}

static void xyz_32(vec n, int bits, uint32_t codes[3]) {
    const float most = (float)((1 << (bits - 1)) - 1);
    codes[0] = bits_of(roundf((float)n.x * most), bits);
    codes[1] = bits_of(roundf((float)n.y * most), bits);
    codes[2] = bits_of(roundf((float)n.z * most), bits);
}

static vec unit_of(vec n) {
    const long double length = sqrtl(n.x * n.x + n.y * n.y + n.z * n.z);
    return (vec){n.x / length, n.y / length, n.z / length};
}

/* The normal at a place of the codes: whole numbers are what codes stand for, halves where they meet. */
static vec normal_at(const pack_row *row, const long double at[3]) {
    const long double most = (long double)((1 << (row->bits - (row->layout != PACK_STEREO))) - 1);
    const long double x = at[0] / most, y = at[1] / most;
    if (row->layout == PACK_STEREO) {
        const long double u = (2 * x - 1) * 1.7777L, v = (2 * y - 1) * 1.7777L, g = 2 / (1 + u * u + v * v);
        return (vec){g * u, g * v, g - 1};
    }
    vec n = {x, y, row->layout == PACK_XYZ ? at[2] / most : 1 - fabsl(x) - fabsl(y)};
    if (row->layout == PACK_OCT && n.z < 0)
        n = (vec){(1 - fabsl(y)) * sign_of(x), (1 - fabsl(x)) * sign_of(y), n.z};
    return unit_of(n);
}

/* A number that a shader stores under a code is never farther off than is said of it, its own roundings included, which
 * take some normals into a code that is not theirs. */
TEST(test_shaders_at_corners) {
    static void (*const encode[PACK_LAYOUTS])(vec, int, uint32_t *) = {
        [PACK_STEREO] = stereo_32, [PACK_OCT] = oct_32, [PACK_XYZ] = xyz_32};
    rng r = rng_make("corners");
    tally t = {.name = "corners"};
    for (size_t i = 0; i < pack_count(); i++) {
        const pack_row *row = pack_get(i);
        uint64_t beyond = 0;
        if (row->kind != PACK_NORMAL || encode[row->layout] == NULL)
            continue;
        for (uint64_t k = 0; k < test_cases(20000, 60000, 1000000); k++) {
            uint32_t own[3] = {0}, there[3] = {0};
            long double at[3];
            const vec any = any_normal(&r, row);
            own_error(row, any, own);
            for (int c = 0; c < 3; c++) {
                const int half = 1 << (row->bits - 1);
                const int code =
                    row->layout != PACK_STEREO && (int)own[c] >= half ? (int)own[c] - 2 * half : (int)own[c];
                at[c] = code + (rng_below(&r, 2) ? 1 : -1) * (0.5L + rng_uniform(&r, -1, 1) * 0x1p-18L);
            }
            if (row->layout == PACK_XYZ) { /* no unit vector has all three at ends */
                const int c = (int)rng_below(&r, 3);
                const long double a = at[(c + 1) % 3], b = at[(c + 2) % 3],
                                  most = (long double)((1 << (row->bits - 1)) - 1);
                at[c] = sqrtl(fmaxl(most * most - a * a - b * b, 0)) * sign_of(at[c]);
            }
            const vec n = normal_at(row, at);
            encode[row->layout](n, row->bits, there);
            double back[PACK_INPUTS_MAX];
            if (memcmp(own, there, sizeof own[0] * (size_t)row->channels) != 0)
                continue;
            row->decode(row, own, back);
            const long double off = degrees_between(n, (vec){back[0], back[1], back[2]});
            TALLY(&t, off <= (long double)pack_reach(row, own, false), "%s: %.12Lg of %.12g", row->name, off,
                  pack_reach(row, own, false));
            own_error(row, n, there);
            beyond += memcmp(own, there, sizeof own[0] * (size_t)row->channels) != 0;
        }
        printf("# %s: %llu normals of another code\n", row->name, (unsigned long long)beyond);
        TALLY(&t, beyond > 10, "%s: no normal of another code", row->name);
    }
    tally_end(&t);
}

/* The maximum is reached where it is said to be, and nothing about that place, or about any corner of codes, is worse.
 */
TEST(test_normals_worst) {
    rng r = rng_make("normals worst");
    tally t = {.name = "worst"};
    for (size_t i = 0; i < pack_count(); i++) {
        const pack_row *row = pack_get(i);
        uint32_t codes[3];
        if (row->kind == PACK_DEPTH)
            continue;
        const pack_error *e = pack_error_of(row->name);
        const vec at = {e->normal_at[0], e->normal_at[1], e->normal_at[2]};
        TALLY(&t, fabsl(own_error(row, at, codes) - (long double)e->normal.max) <= 1e-6L * (long double)e->normal.max,
              "%s: %.12Lg at the worst place, %.12g", row->name, own_error(row, at, codes), e->normal.max);
        for (uint64_t k = 0; k < test_cases(5000, 50000, 2000000); k++) {
            const long double reach = (long double)rng_log(&r, 1e-9, 1) * (long double)e->normal.max * PIL / 180;
            vec n = {at.x + reach * (2 * (long double)rng_unit(&r) - 1),
                     at.y + reach * (2 * (long double)rng_unit(&r) - 1),
                     at.z + reach * (2 * (long double)rng_unit(&r) - 1)};
            const long double length = sqrtl(n.x * n.x + n.y * n.y + n.z * n.z);
            n = (vec){n.x / length, n.y / length, n.z / length};
            if (!row->sphere && n.z < 0)
                continue;
            TALLY(&t, own_error(row, n, codes) <= (long double)e->normal.max * (1 + 1e-9L), "%s: %.12Lg at %La %La %La",
                  row->name, own_error(row, n, codes), n.x, n.y, n.z);
        }
    }
    tally_end(&t);
}

/* The mean by the areas of the plane of the codes: places x places in each code. */
static long double mean_by_area(const pack_row *row, int side) {
    long double sum = 0, area = 0;
    uint32_t codes[3];
    for (int a = 0; a < side; a++)
        for (int b = 0; b <= a; b++) { /* the plane is alike on both sides of its diagonal */
            const long double u = (2 * (long double)a + 1) / side - 1, v = (2 * (long double)b + 1) / side - 1;
            const long double twice = a == b ? 1 : 2;
            vec n;
            long double weight;
            if (row->layout == PACK_STEREO) {
                const long double x = u * 1.7777L, y = v * 1.7777L, r2 = x * x + y * y;
                if (r2 > 1)
                    continue;
                n = (vec){2 * x / (1 + r2), 2 * y / (1 + r2), (1 - r2) / (1 + r2)};
                weight = twice / ((1 + r2) * (1 + r2));
            } else {
                n = (vec){u, v, 1 - fabsl(u) - fabsl(v)};
                if (n.z < 0) {
                    n.x = (1 - fabsl(v)) * sign_of(u);
                    n.y = (1 - fabsl(u)) * sign_of(v);
                }
                const long double length = sqrtl(n.x * n.x + n.y * n.y + n.z * n.z);
                n = (vec){n.x / length, n.y / length, n.z / length};
                weight = twice / (length * length * length);
            }
            sum += weight * own_error(row, n, codes);
            area += weight;
        }
    return sum / area;
}

/* The error of such a sum falls with the square of the distance of the places, so two of them give a better one. */
TEST(test_means_by_area) {
    static const struct {
        const char *name;
        int codes;
    } rows[] = {{"stereo-8", 255}, {"oct-8", 254}};
    for (size_t i = 0; i < 2; i++) {
        const pack_row *row = pack_find(rows[i].name);
        const int places = (int)test_cases(4, 4, 16) * rows[i].codes;
        const double mean = (double)((4 * mean_by_area(row, 2 * places) - mean_by_area(row, places)) / 3);
        print_message("# %s: mean %.7g by area, %.7g +- %.2g\n", row->name, mean, pack_error_of(row->name)->normal.mean,
                      pack_error_of(row->name)->normal_spread);
        assert_relative(pack_error_of(row->name)->normal.mean, mean, 1e-3);
    }
}

TEST(test_published) {
    static const struct {
        const char *name;
        double mean, max; /* of a sample: a maximum over all is a little above */
    } rows[] = {{"oct-8", 0.337, 0.944}, {"oct-10", 0.0838, 0.235}, {"oct-12", 0.0209, 0.0587}};
    for (size_t i = 0; i < 3; i++) {
        const pack_error *e = pack_error_of(rows[i].name);
        assert_relative(e->normal.mean, rows[i].mean, 2e-3);
        assert_true(e->normal.max > rows[i].max && e->normal.max < 1.02 * rows[i].max);
    }
    const pack_error *e = pack_error_of("stereo-8");
    assert_relative(e->normal.mean, 0.459, 2e-3);
    assert_relative(e->normal.max, (double)(2 * atanl(sqrtl(2) * 1.7777L / 255) * 180 / PIL), 1e-12);
    assert_true(fabs(e->normal.max - 1.130) < 5e-4);
    assert_true(e->normal_at[2] > 1 - 1e-12);
    /* A code is half a step off at most, three times at right angles: the limit of small steps, less its bending. */
    assert_relative(pack_error_of("xyz-12")->normal.max, sqrt(3.0) / 2 / 2047 * 180 / (double)PIL, 1e-3);
    assert_int_equal(pack_error_of("oct-8")->codes, 255 * 255);
}
