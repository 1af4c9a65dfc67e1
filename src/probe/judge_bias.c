/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Depth bias: the step r of a constant, the exponent it follows in fp32, and the rule of the slope. */
#include <math.h>
#include <stddef.h>

#include "core/bits.h"
#include "core/elementary.h"
#include "probe/judge.h"

enum { ACROSS = SHOT_SIZE / PLAN_TILE, AROUND = 9, FACTORS = 3 };

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

/* Whose depth has the exponent n. DIFFERENCES is what SwiftShader 5 takes for the largest depth: that of the vertex
 * where it anchors the plane, and the differences of the other two from it. Of the tiles that is the second vertex, and
 * another one where a browser that draws by it turns triangles for the sake of OpenGL's last vertex. */
typedef enum source { LARGEST, PIXEL, DIFFERENCES } source;

static const struct { /* in the order of their words */
    source source;
    int factor; /* index of factors */
    int anchor; /* of DIFFERENCES: a vertex */
} steps[] = {
    {LARGEST, 0, 0}, {LARGEST, 1, 0},     {LARGEST, 2, 0},     {PIXEL, 0, 0},       {PIXEL, 1, 0},
    {PIXEL, 2, 0},   {DIFFERENCES, 0, 1}, {DIFFERENCES, 0, 0}, {DIFFERENCES, 0, 2},
};
enum { STEPS = sizeof steps / sizeof steps[0] };

static double depth_of(const shot *s, int tile, int step, double pixel) {
    const source of = steps[step].source;
    const int a = steps[step].anchor;
    double z[3];
    for (int i = 0; i < 3; i++)
        z[i] = (double)judge_clip(s, s->vertex[3 * tile + i]);
    if (of == DIFFERENCES)
        return fmax(z[a], fmax(fabs(z[(a + 1) % 3] - z[a]), fabs(z[(a + 2) % 3] - z[a])));
    return of == LARGEST ? fmax(z[0], fmax(z[1], z[2])) : pixel;
}

/* Whether a pixel moved by `PLAN_BIAS` steps of factor 2^(n - 23), 2^n the power of two at or below `depth`. */
static bool stepped(double before, double after, double depth, double factor, bool flat) {
    const double step = ldexp(factor * PLAN_BIAS, ilogb(depth) - 23);
    const double error = flat ? 0.0 : 0x1p-22; /* a few roundings of both planes */
    return fabs(after - before - step) <= error;
}

static void judge_float(probe_result *r) {
    const shot *without = judge_shot(r, PLAN_UNBIASED, SHOT_D32F), *with = judge_shot(r, PLAN_CONSTANT, SHOT_D32F);
    guess all[STEPS];
    if (without == NULL || with == NULL)
        return;
    judge_words(all, KEY_BIAS, BIAS_REAL, STEPS);
    for (int g = 0; g < STEPS; g++) {
        for (int i = 0; i < PLAN_TILES * AROUND; i++) {
            const int tile = i / AROUND, pixel = pixel_of(tile, i % AROUND);
            const double before = (double)dp_float32(without->code[pixel]);
            const double after = (double)dp_float32(with->code[pixel]);
            all[g].hits +=
                stepped(before, after, depth_of(with, tile, g, before), factors[steps[g].factor], is_flat(tile));
        }
    }
    judge_guesses(r, KEY_BIAS, "d32f", all, STEPS, (uint64_t)PLAN_TILES * AROUND);
}

/* ---- UNORM ------------------------------------------------------------------------------------------------------- */

static double code_step(const shot *without, const shot *with, int pixel) {
    return (double)with->code[pixel] - (double)without->code[pixel];
}

/* Codes that were moved, within one: where they were before in their cell is not seen. */
static int judge_unorm(probe_result *r, shot_format format) {
    const shot *without = judge_shot(r, PLAN_UNBIASED, format), *with = judge_shot(r, PLAN_CONSTANT, format);
    guess all[FACTORS];
    uint64_t cases = 0;
    if (without == NULL || with == NULL)
        return JUDGE_NONE;
    judge_words(all, KEY_BIAS, 0, FACTORS);
    for (int g = 0; g < FACTORS; g++) {
        cases = 0;
        for (int i = 0; i < PLAN_TILES * AROUND; i++) {
            const int pixel = pixel_of(i / AROUND, i % AROUND);
            if (!is_flat(i / AROUND))
                continue;
            cases++;
            all[g].hits += fabs(code_step(without, with, pixel) - factors[g] * PLAN_BIAS) <= 1.0;
        }
    }
    return judge_guesses(r, KEY_BIAS, probe_format_name(format), all, FACTORS, cases);
}

/* Tiles lie a quarter above a code: half a step more carries them over the next tie. */
static void judge_fraction(probe_result *r, int factor) {
    const shot *without = judge_shot(r, PLAN_UNBIASED, SHOT_D16), *with = judge_shot(r, PLAN_FRACTION, SHOT_D16);
    guess all[2];
    uint64_t cases = 0;
    if (without == NULL || with == NULL || factor == JUDGE_NONE)
        return;
    judge_words(all, KEY_FRACTION, 0, 2);
    for (int i = 0; i < PLAN_TILES * AROUND; i++) {
        if (!is_flat(i / AROUND))
            continue;
        const double step = code_step(without, with, pixel_of(i / AROUND, i % AROUND));
        cases++;
        all[0].hits += step == floor(0.75 + factors[factor] * (PLAN_BIAS + 0.5));
        all[1].hits += step == floor(0.75 + factors[factor] * PLAN_BIAS);
    }
    judge_guesses(r, KEY_FRACTION, "d16", all, 2, cases);
}

/* ---- Slope ------------------------------------------------------------------------------------------------------- */

static void judge_slope(probe_result *r) {
    const shot *without = judge_shot(r, PLAN_UNBIASED, SHOT_D32F), *with = judge_shot(r, PLAN_SLOPED, SHOT_D32F);
    guess all[3];
    const double error = 0x1p-20; /* of a step of some 2^-6: a few roundings of slopes and sums in binary32 */
    uint64_t cases = 0;
    if (without == NULL || with == NULL)
        return;
    judge_words(all, KEY_SLOPE, 0, 3);
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
    judge_guesses(r, KEY_SLOPE, NULL, all, 3, cases);
}

void judge_bias(probe_result *r) {
    const int d16 = judge_unorm(r, SHOT_D16);
    judge_unorm(r, SHOT_D24);
    judge_float(r);
    judge_fraction(r, d16);
    judge_slope(r);
}
