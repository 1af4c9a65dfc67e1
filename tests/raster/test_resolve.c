/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A prepass that stores depths beside the pixels: random planes at the published positions, in rationals, rounded to
 * binary32 and to the format by the oracle, resolved here. The bias always suffices, and most of it is needed.
 */
#include "oracle.h"
#include "raster/resolve.h"
#include "support.h"

/* The standard positions as Vulkan's specification has them, from the corner of the pixel, times 16. */
static const int positions[][16][2] = {
    {{12, 12}, {4, 4}},
    {{6, 2}, {14, 6}, {2, 10}, {10, 14}},
    {{9, 5}, {7, 11}, {13, 9}, {5, 3}, {3, 13}, {1, 7}, {11, 15}, {15, 1}},
    {{9, 9},
     {7, 5},
     {5, 10},
     {12, 7},
     {3, 6},
     {10, 13},
     {13, 11},
     {11, 3},
     {6, 14},
     {8, 1},
     {4, 2},
     {2, 12},
     {0, 8},
     {15, 4},
     {14, 15},
     {1, 0}},
};

/* A case, and a plane through the pixel where it is drawn again. */
typedef struct drawn_case {
    const resolve_way *way;
    bool halved;
    int samples;
    dp_format format;
    dp_rounding rounding;
    bool reversed;
    int count, x[16], y[16]; /* of what is stored, from the pixel, sixteenths */
    double depth, gx, gy;    /* of the plane, all multiples of 2^-60 */
    mpq_t d, o, x1, value;
} drawn_case;

static void init(drawn_case *c) {
    mpq_inits(c->d, c->o, c->x1, c->value, NULL);
}

static void clear(drawn_case *c) {
    mpq_clears(c->d, c->o, c->x1, c->value, NULL);
}

/* Where the prepass stores: the samples, or of two pixels by two the middle or each, seen from the pixel at `corner`.
 */
static void place(drawn_case *c, unsigned corner) {
    const int right = corner & 1U ? -16 : 16, down = corner & 2U ? -16 : 16;
    if (!c->halved) {
        const int k = c->samples == 2 ? 0 : c->samples == 4 ? 1 : c->samples == 8 ? 2 : 3;
        c->count = c->samples;
        for (int i = 0; i < c->count; i++)
            c->x[i] = positions[k][i][0] - 8, c->y[i] = positions[k][i][1] - 8;
    } else if (strcmp(c->way->name, "centre") == 0) {
        c->count = 1;
        c->x[0] = right / 2, c->y[0] = down / 2;
    } else {
        c->count = 4;
        for (int i = 0; i < 4; i++)
            c->x[i] = i % 2 * right, c->y[i] = i / 2 * down;
    }
}

static dp_format binary32(void) {
    return oracle_float(8, 23, 127);
}

/* A rational, clamped, to binary32. */
static double held(const mpq_t q) {
    const dp_format f = binary32();
    if (mpq_sgn(q) <= 0)
        return 0;
    if (mpq_cmp_ui(q, 1, 1) >= 0)
        return 1;
    return dp_format_value(&f, oracle_round(&f, DP_ROUND_NEAREST, mpq_numref(q), mpq_denref(q)));
}

/* The plane's depth at a place. @return false where that is not from 0 to 1 */
static bool plane_at(drawn_case *c, int x, int y, mpq_t out) {
    mpq_set_d(out, c->depth);
    mpq_set_d(c->x1, ldexp(c->gx * x, -4)); /* exact: few bits */
    mpq_add(out, out, c->x1);
    mpq_set_d(c->x1, ldexp(c->gy * y, -4));
    mpq_add(out, out, c->x1);
    return mpq_sgn(out) >= 0 && mpq_cmp_ui(out, 1, 1) <= 0;
}

/* The mean: numbers read as binary32, and summed two at a time, whichever. */
static uint32_t mean_of(drawn_case *c, rng *r, const uint32_t codes[16]) {
    float left[16];
    int n = c->count;
    for (int i = 0; i < n; i++) {
        oracle_value(c->value, &c->format, codes[i]);
        left[i] = (float)held(c->value);
    }
    const bool in_turn = rng_below(r, 2) == 0;
    while (n > 1) {
        const int a = in_turn ? 0 : (int)rng_below(r, (uint64_t)n), b = in_turn ? 1 : (a + 1) % n;
        const float sum = left[a] + left[b];
        left[a] = sum;
        left[b] = left[--n];
        if (a == n)
            left[b] = sum;
    }
    return oracle_encode(&c->format, c->rounding, (double)(left[0] / (float)c->count));
}

/* What the prepass keeps. @return false where the plane leaves [0, 1]; *most: the greatest depth */
static bool stored_of(drawn_case *c, rng *r, uint32_t *code, double *most) {
    uint32_t codes[16], least = UINT32_MAX, greatest = 0;
    *most = c->depth;
    for (int i = 0; i < c->count; i++) {
        if (!plane_at(c, c->x[i], c->y[i], c->d))
            return false;
        *most = fmax(*most, mpq_get_d(c->d));
        codes[i] = oracle_encode(&c->format, c->rounding, held(c->d));
        least = codes[i] < least ? codes[i] : least;
        greatest = codes[i] > greatest ? codes[i] : greatest;
    }
    const char *name = c->way->name;
    *code = strcmp(name, "min") == 0       ? least
            : strcmp(name, "max") == 0     ? greatest
            : strcmp(name, "average") == 0 ? mean_of(c, r, codes)
            : strcmp(name, "one") == 0     ? codes[rng_below(r, 4)]
                                           : codes[0];
    return true;
}

/* Whether the test passes with the factor, and this share of the constant. */
static bool passes(drawn_case *c, resolve_need need, double share, uint32_t stored) {
    mpq_set_d(c->o, fmax(fabs(c->gx), fabs(c->gy)));
    mpq_set_d(c->x1, need.pixels);
    mpq_mul(c->o, c->o, c->x1);
    mpq_set_d(c->x1, need.window * share);
    mpq_add(c->o, c->o, c->x1);
    mpq_set_d(c->d, c->depth);
    mpq_set_d(c->x1, held(c->d));
    if (c->reversed)
        mpq_add(c->x1, c->x1, c->o);
    else
        mpq_sub(c->x1, c->x1, c->o);
    const uint32_t code = oracle_encode(&c->format, c->rounding, held(c->x1));
    return c->reversed ? code >= stored : code <= stored;
}

static resolve_need need_of(const drawn_case *c, double most) {
    return resolve_needs(c->way, c->halved ? 0 : c->samples, &c->format, c->rounding, c->reversed, most);
}

static void some_case(rng *r, drawn_case *c) {
    static const char *const names[] = {"fp32", "unorm24", "unorm16", "fp16", "float4.20b15", "unorm8"};
    dp_format f[2];
    dp_format_parse(names[rng_below(r, 6)], f);
    c->format = f[0];
    c->halved = rng_below(r, 2) == 0;
    const named_table *t = c->halved ? &resolve_halved_table : &resolve_sampled_table;
    c->way = named_at(t, rng_below(r, t->count));
    c->samples = 2 << rng_below(r, 4);
    c->rounding = (dp_rounding)rng_below(r, DP_ROUNDING_COUNT);
    c->reversed = rng_below(r, 2) == 0;
    place(c, (unsigned)rng_below(r, 4));
}

/* Few bits, so that all that is made of it is exact. */
static double coarse(double x) {
    return rint(x * 0x1p48) * 0x1p-48;
}

/* Slopes of a few steps or large ones, along an axis, a diagonal or anywhere. */
static void some_plane(rng *r, drawn_case *c) {
    const double steep = rng_below(r, 3) == 0 ? rng_log(r, 1e-9, 0.4) : rng_log(r, 1e-9, 1e-5);
    const double a = rng_uniform(r, -1, 1), sign = rng_below(r, 2) == 0 ? 1 : -1;
    const bool even = rng_below(r, 2) == 0;
    c->gx = coarse(steep * (even ? 1 : a));
    c->gy = coarse(steep * sign);
    c->depth = coarse(rng_below(r, 4) == 0 ? rng_log(r, 1e-7, 1) : rng_unit(r));
}

TEST(the_bias_suffices) {
    rng r = rng_make("planes");
    tally t = {.name = "planes"};
    drawn_case c;
    init(&c);
    for (uint64_t i = test_cases(4000, 60000, 400000); i > 0; i--) {
        uint32_t stored;
        double most;
        some_case(&r, &c);
        some_plane(&r, &c);
        if (!stored_of(&c, &r, &stored, &most))
            continue;
        const resolve_need need = need_of(&c, most);
        TALLY(&t, passes(&c, need, 1, stored), "%s%s of %d, %s %s, reversed %d: %.17g %.9g %.9g, F %g, C %.9g",
              c.halved ? "half " : "", c.way->name, c.count, c.format.name, dp_rounding_name(c.rounding), c.reversed,
              c.depth, c.gx, c.gy, need.pixels, need.window);
    }
    assert_true(t.cases > 1000);
    clear(&c);
    tally_end(&t);
}

/* ---- None of it is slack ----------------------------------------------------------------------------------------- */

/* Means need most where all samples are half a code above theirs, and half of those codes are odd: each place is an odd
 * number of half codes from the pixel. Slopes in codes that do so at 2, 4 and 8 samples. */
static void plane_of_halves(rng *r, drawn_case *c) {
    static const double slopes[][2] = {{2, 0}, {1.6, 0.8}, {8, 0}};
    const uint64_t k = rng_below(r, 3);
    const double code = 1 / (double)c->format.code_max, at = (double)rng_below(r, c->format.code_max - 32) + 16;
    c->gx = coarse(slopes[k][0] * code * rng_uniform(r, 0.99, 1.01));
    c->gy = coarse(slopes[k][1] * code * rng_uniform(r, 0.99, 1.01));
    c->depth = coarse(code * (at + rng_uniform(r, -0.03, 0.03)));
}

/* One rounding costs most where the sample is rounded to the lower code, nearly half a step away, and the pixel to the
 * next number, nearly half a step away: both next to the middle of two numbers, whole steps apart. */
static void plane_of_middles(rng *r, drawn_case *c) {
    const double next = 0x1p-34, step = 0x1p-24, toward = c->reversed ? 1 : -1;
    const uint32_t code = c->format.code_max / 2 + (uint32_t)rng_below(r, c->format.code_max / 2 - 8) + 4;
    const double end = 0.5 * (dp_format_value(&c->format, code) + dp_format_value(&c->format, code + 1));
    const double middle = (floor(end / step) + 0.5) * step, apart = (double)rng_below(r, 4) * step;
    const double slope = (apart + 2 * next) / need_of(c, 1).pixels;
    c->gx = coarse(rng_below(r, 2) == 0 ? slope : -slope);
    c->gy = coarse(rng_below(r, 2) == 0 ? slope : -slope);
    c->depth = coarse(middle - toward * (apart + next));
}

/* A few codes of 16 bits, or steps of binary32, about the place where a code begins. */
static void plane_at_a_boundary(rng *r, drawn_case *c) {
    const dp_format *f = &c->format;
    const uint32_t code = f->code_max / 2 + (uint32_t)rng_below(r, f->code_max / 2);
    const double middle = 0.5 * (dp_format_value(f, code) + dp_format_value(f, code + 1));
    const double step = f->bits == 16 ? 1 / (double)f->code_max : 0x1p-24;
    c->gx = coarse(rng_uniform(r, -3, 3) * step);
    c->gy = coarse(rng_uniform(r, -3, 3) * step);
    c->depth = coarse(middle + rng_uniform(r, -1.5, 1.5) * step);
}

static void hard_plane(rng *r, drawn_case *c) {
    if (strcmp(c->way->name, "average") != 0)
        plane_of_middles(r, c);
    else if (c->format.bits == 16 && rng_below(r, 2) == 0)
        plane_of_halves(r, c);
    else
        plane_at_a_boundary(r, c);
}

/* The greatest share of the constant with which a plane of many fails. */
static double share_needed(rng *r, drawn_case *c, uint64_t tries) {
    double share = 0;
    for (uint64_t i = 0; i < tries; i++) {
        uint32_t stored;
        double most;
        place(c, (unsigned)rng_below(r, 4));
        hard_plane(r, c);
        if (c->depth > 1 || !stored_of(c, r, &stored, &most))
            continue;
        const resolve_need need = need_of(c, most);
        while (share < 1 && !passes(c, need, share + 0.01, stored))
            share += 0.01;
    }
    return share;
}

static double share_of(rng *r, const char *way, bool halved, int samples, const char *format, bool reversed) {
    drawn_case c = {.way = halved ? resolve_halved_find(way) : resolve_sampled_find(way),
                    .halved = halved,
                    .samples = samples,
                    .reversed = reversed};
    dp_format f[2];
    dp_format_parse(format, f);
    c.format = f[0];
    init(&c);
    const double share = share_needed(r, &c, test_cases(2000, 20000, 60000));
    clear(&c);
    return share;
}

/*
 * Of one rounding, of one depth and of half a code, at least nine tenths are needed. Of means of 16 samples no plane
 * has all half a code above theirs and the mean between two codes, and in 24 bits and more the roundings of all samples
 * and sums seldom go one way together: what random planes need of these is printed.
 */
TEST(the_constant_is_needed) {
    static const struct {
        const char *way;
        bool halved;
        int samples;
        const char *format;
        bool reversed;
        double least;
    } rows[] = {
        {"min", false, 4, "fp32", false, 0.9},       {"max", false, 8, "fp32", true, 0.9},
        {"sample0", false, 2, "fp32", false, 0.9},   {"min", false, 16, "unorm24", false, 0.9},
        {"one", true, 0, "fp32", true, 0.9},         {"centre", true, 0, "fp32", false, 0.9},
        {"average", false, 2, "unorm16", true, 0.9}, {"average", false, 4, "unorm16", false, 0.9},
        {"average", false, 8, "unorm16", true, 0.9}, {"average", false, 16, "unorm16", true, 0.1},
        {"average", false, 2, "fp32", true, 0.3},    {"average", false, 4, "unorm24", false, 0.1},
    };
    rng r = rng_make("needed");
    tally t = {.name = "shares"};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const double share =
            share_of(&r, rows[i].way, rows[i].halved, rows[i].samples, rows[i].format, rows[i].reversed);
        printf("# %s%s:%d %s: %.2f of the constant needed\n", rows[i].halved ? "half " : "", rows[i].way,
               rows[i].samples, rows[i].format, share);
        TALLY(&t, share >= rows[i].least, "%s:%d %s: %g", rows[i].way, rows[i].samples, rows[i].format, share);
    }
    tally_end(&t);
}

/* Of the factor: a steep plane along the worst corner fails with a hundredth less. */
TEST(the_factor_is_needed) {
    tally t = {.name = "factors"};
    rng r = rng_make("steep");
    drawn_case c;
    init(&c);
    dp_format f[2];
    dp_format_parse("fp32", f);
    c.format = f[0];
    c.rounding = DP_ROUND_NEAREST;
    for (size_t i = 0; i < 2 * (resolve_sampled_table.count + resolve_halved_table.count); i++) {
        const size_t k = i / 2;
        c.reversed = i % 2 == 1;
        c.halved = k >= resolve_sampled_table.count;
        c.way = c.halved ? resolve_halved_get(k - resolve_sampled_table.count) : resolve_sampled_get(k);
        for (c.samples = 2; c.samples <= (c.halved ? 2 : 16); c.samples *= 2) {
            const resolve_need need = need_of(&c, 1);
            resolve_need less = need;
            less.pixels *= 0.99;
            bool failed = need.pixels == 0;
            for (int tries = 0; tries < 200 && !failed; tries++) {
                uint32_t stored;
                double most;
                place(&c, (unsigned)tries);
                c.gx = tries & 4 ? 0.125 : -0.125;
                c.gy = tries & 8 ? 0.125 : -0.125;
                c.depth = 0.5;
                failed = stored_of(&c, &r, &stored, &most) && !passes(&c, less, 1, stored);
            }
            TALLY(&t, failed, "%s%s:%d, reversed %d: less than %g suffices", c.halved ? "half " : "", c.way->name,
                  c.samples, c.reversed, need.pixels);
        }
    }
    clear(&c);
    tally_end(&t);
}

/* By hand, of the published tables: the farthest sample, sample 0, and the mean of 16, which is not the centre. */
TEST(pixels_by_hand) {
    static const double farthest[] = {0.5, 0.5, 0.875, 0.9375}, first[] = {0.5, 0.5, 0.25, 0.125},
                        mean[] = {0, 0, 0, 0.0625};
    dp_format f[2];
    dp_format_parse("fp32", f);
    for (int i = 0; i < 4; i++) {
        const int n = 2 << i;
        assert_true(resolve_needs(resolve_sampled_find("min"), n, f, 0, false, 1).pixels == farthest[i]);
        assert_true(resolve_needs(resolve_sampled_find("min"), n, f, 0, true, 1).pixels == 0);
        assert_true(resolve_needs(resolve_sampled_find("max"), n, f, 0, true, 1).pixels == farthest[i]);
        assert_true(resolve_needs(resolve_sampled_find("sample0"), n, f, 0, true, 1).pixels == first[i]);
        assert_true(resolve_needs(resolve_sampled_find("average"), n, f, 0, false, 1).pixels == mean[i]);
    }
    assert_true(resolve_needs(resolve_halved_find("centre"), 0, f, 0, false, 1).pixels == 1);
    assert_true(resolve_needs(resolve_halved_find("one"), 0, f, 0, false, 1).pixels == 2);
}

/* By hand: half a step of binary32 at the depth, of 1 that below it, where roundings may lead to it. */
TEST(constants_by_hand) {
    static const struct {
        double depth, half;
    } rows[] = {{1, 0x1p-25},         {1 - 0x1p-24, 0x1p-25}, {0.5, 0x1p-25},       {0.5 - 0x1p-25, 0x1p-26},
                {0x1p-126, 0x1p-150}, {0x1p-125, 0x1p-149},   {0x1p-140, 0x1p-150}, {0, 0x1p-150}};
    dp_format f[2];
    dp_format_parse("fp32", f);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const double one = resolve_needs(resolve_sampled_find("min"), 4, f, 0, false, rows[i].depth).window;
        const double mean = resolve_needs(resolve_sampled_find("average"), 2, f, 0, false, rows[i].depth).window;
        assert_true(one == rows[i].half);
        assert_true(mean == 3 * rows[i].half); /* two roundings, and that of the sum, halved */
    }
}
