/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Depth bias: the step r of a constant, the exponent it follows in fp32, and the rule of the slope. */
#include <math.h>
#include <stddef.h>

#include "core/bits.h"
#include "core/elementary.h"
#include "probe/judge.h"

enum { ACROSS = SHOT_SIZE / PLAN_TILE, AROUND = 9, FACTORS = 3, REACH = 6 /* pixels from the middle to a corner */ };

static const double factors[FACTORS] = {1.0, 2.0, 0.5};

/* Pixels about the middle of a tile, all inside its triangle. */
static int pixel_of(int tile, int which) {
    const int half = PLAN_TILE / 2;
    const int x = tile % ACROSS * PLAN_TILE + half - 1 + which % 3,
              y = tile / ACROSS * PLAN_TILE + half - 2 + which / 3;
    return y * SHOT_SIZE + x;
}

static bool is_flat(int tile) {
    return tile % 4 < PLAN_FLAT;
}

/* ---- fp32 -------------------------------------------------------------------------------------------------------- */

/* The largest depth of a triangle, at one of its corners. */
static double largest_of(const plan_tile *t) {
    const double side = fabs((double)t->slope_x) * REACH - (double)t->slope_y * REACH;
    return (double)t->z + fmax(side, (double)t->slope_y * REACH);
}

/* Whether a pixel moved by `PLAN_BIAS` steps of factor 2^(n - 23), 2^n the power of two at or below `depth`. */
static bool stepped(double before, double after, double depth, double factor, bool flat) {
    const double step = ldexp(factor * PLAN_BIAS, ilogb(depth) - 23);
    const double error = flat ? 0.0 : 0x1p-24; /* one rounding of the sum */
    return fabs(after - before - step) <= error;
}

static void judge_float(probe_result *r) {
    static const char *const words[2 * FACTORS] = {"r = 2^(n-23), largest depth of the primitive in [2^n, 2^(n+1))",
                                                   "r = 2^(n-22), largest depth of the primitive in [2^n, 2^(n+1))",
                                                   "r = 2^(n-24), largest depth of the primitive in [2^n, 2^(n+1))",
                                                   "r = 2^(n-23), depth of the pixel in [2^n, 2^(n+1))",
                                                   "r = 2^(n-22), depth of the pixel in [2^n, 2^(n+1))",
                                                   "r = 2^(n-24), depth of the pixel in [2^n, 2^(n+1))"};
    const shot *without = judge_shot(r, PLAN_UNBIASED, SHOT_D32F), *with = judge_shot(r, PLAN_CONSTANT, SHOT_D32F);
    guess all[2 * FACTORS];
    if (without == NULL || with == NULL)
        return;
    for (int g = 0; g < 2 * FACTORS; g++) {
        all[g] = (guess){words[g], 0};
        for (int i = 0; i < PLAN_TILES * AROUND; i++) {
            const int tile = i / AROUND, pixel = pixel_of(tile, i % AROUND);
            const plan_tile t = plan_tile_of(SHOT_D32F, tile);
            const double before = (double)dp_float32(without->code[pixel]);
            const double after = (double)dp_float32(with->code[pixel]);
            const double depth = g < FACTORS ? largest_of(&t) : before;
            all[g].hits += stepped(before, after, depth, factors[g % FACTORS], is_flat(tile));
        }
    }
    judge_guesses(r, "bias", "d32f", all, 2 * FACTORS, (uint64_t)PLAN_TILES * AROUND);
}

/* ---- UNORM ------------------------------------------------------------------------------------------------------- */

static double code_step(const shot *without, const shot *with, int pixel) {
    return (double)with->code[pixel] - (double)without->code[pixel];
}

/* Codes that were moved, within one: where they were before in their cell is not seen. */
static int judge_unorm(probe_result *r, shot_format format) {
    static const char *const words[FACTORS] = {"r = one code", "r = two codes", "r = half a code"};
    const shot *without = judge_shot(r, PLAN_UNBIASED, format), *with = judge_shot(r, PLAN_CONSTANT, format);
    guess all[FACTORS];
    uint64_t cases = 0;
    if (without == NULL || with == NULL)
        return JUDGE_NONE;
    for (int g = 0; g < FACTORS; g++) {
        all[g] = (guess){words[g], 0};
        cases = 0;
        for (int i = 0; i < PLAN_TILES * AROUND; i++) {
            const int pixel = pixel_of(i / AROUND, i % AROUND);
            if (!is_flat(i / AROUND))
                continue;
            cases++;
            all[g].hits += fabs(code_step(without, with, pixel) - factors[g] * PLAN_BIAS) <= 1.0;
        }
    }
    return judge_guesses(r, "bias", probe_format_name(format), all, FACTORS, cases);
}

/* Tiles lie a quarter above a code: 8 1/2 steps carry them over the next tie, 8 do not. */
static void judge_fraction(probe_result *r, int factor) {
    const shot *without = judge_shot(r, PLAN_UNBIASED, SHOT_D16), *with = judge_shot(r, PLAN_FRACTION, SHOT_D16);
    guess all[2] = {{"fractions of a constant count", 0}, {"fractions of a constant are cut", 0}};
    uint64_t cases = 0;
    if (without == NULL || with == NULL || factor == JUDGE_NONE)
        return;
    for (int i = 0; i < PLAN_TILES * AROUND; i++) {
        if (!is_flat(i / AROUND))
            continue;
        const double step = code_step(without, with, pixel_of(i / AROUND, i % AROUND));
        cases++;
        all[0].hits += step == floor(0.75 + factors[factor] * (PLAN_BIAS + 0.5));
        all[1].hits += step == floor(0.75 + factors[factor] * PLAN_BIAS);
    }
    judge_guesses(r, "fraction", "d16", all, 2, cases);
}

/* ---- Slope ------------------------------------------------------------------------------------------------------- */

static void judge_slope(probe_result *r) {
    const shot *without = judge_shot(r, PLAN_UNBIASED, SHOT_D32F), *with = judge_shot(r, PLAN_SLOPED, SHOT_D32F);
    guess all[3] = {{"slope m = max(|dz/dx|, |dz/dy|)", 0},
                    {"slope m = sqrt((dz/dx)^2 + (dz/dy)^2)", 0},
                    {"slope m = |dz/dx| + |dz/dy|", 0}};
    const double error = 0x1p-20; /* of a step of some 2^-6: a few roundings of slopes and sums in binary32 */
    uint64_t cases = 0;
    if (without == NULL || with == NULL)
        return;
    for (int i = 0; i < PLAN_TILES * AROUND; i++) {
        const int pixel = pixel_of(i / AROUND, i % AROUND);
        const plan_tile t = plan_tile_of(SHOT_D32F, i / AROUND);
        const double x = fabs((double)t.slope_x), y = fabs((double)t.slope_y);
        const double m[3] = {fmax(x, y), dp_hypot(x, y), x + y};
        const double step = (double)dp_float32(with->code[pixel]) - (double)dp_float32(without->code[pixel]);
        if (is_flat(i / AROUND))
            continue;
        cases++;
        for (int g = 0; g < 3; g++)
            all[g].hits += fabs(step - m[g]) <= error;
    }
    judge_guesses(r, "slope", NULL, all, 3, cases);
}

void judge_bias(probe_result *r) {
    const int d16 = judge_unorm(r, SHOT_D16);
    judge_unorm(r, SHOT_D24);
    judge_float(r);
    judge_fraction(r, d16);
    judge_slope(r);
}
