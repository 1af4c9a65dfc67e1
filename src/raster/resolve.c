/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "raster/resolve.h"

#include <math.h>
#include <stdlib.h>

/* clang-format off */
static const resolve_way of_samples[] = {
    {"min", NULL, "the least depth of the samples of a pixel", "Vulkan, VK_RESOLVE_MODE_MIN_BIT", RESOLVE_LEAST, 0},
    {"max", NULL, "the greatest", "Vulkan, VK_RESOLVE_MODE_MAX_BIT", RESOLVE_GREATEST, 0},
    {"average", "mean", "their sum in binary32, in any order, by how many there are",
     "Vulkan, VK_RESOLVE_MODE_AVERAGE_BIT", RESOLVE_MEAN, 0},
    {"sample0", "sample-zero first", "sample 0, whose depth is kept", "Vulkan, VK_RESOLVE_MODE_SAMPLE_ZERO_BIT",
     RESOLVE_FIRST, 0},
};
static const resolve_way of_halves[] = {
    {"centre", "center drawn", "drawn at that size: the middle of four pixels", NULL, RESOLVE_FIRST, 1},
    {"one", "corner point", "one of the four pixels is kept, whichever", NULL, RESOLVE_ANY, 4},
    {"min", NULL, "the least depth of the four", NULL, RESOLVE_LEAST, 4},
    {"max", NULL, "the greatest", NULL, RESOLVE_GREATEST, 4},
};

/* From the centre: Vulkan, Multisampling, Standard sample locations; D3D11_STANDARD_MULTISAMPLE_PATTERN is the same. */
static const struct {
    int count;
    bool halved;
    resolve_place at[RESOLVE_SAMPLES_MOST];
} patterns[] = {
    {2, false, {{4, 4}, {-4, -4}}},
    {4, false, {{-2, -6}, {6, -2}, {-6, 2}, {2, 6}}},
    {8, false, {{1, -3}, {-1, 3}, {5, 1}, {-3, -5}, {-5, 5}, {-7, -1}, {3, 7}, {7, -7}}},
    {16, false, {{1, 1}, {-1, -3}, {-3, 2}, {4, -1}, {-5, -2}, {2, 5}, {5, 3}, {3, -5}, {-2, 6}, {0, -7}, {-4, -6},
        {-6, 4}, {-8, 0}, {7, -4}, {6, 7}, {-7, -8}}},
    {1, true, {{8, 8}}},
    {4, true, {{0, 0}, {16, 0}, {0, 16}, {16, 16}}},
};
/* clang-format on */

NAMED_TABLE(resolve_sampled, of_samples);
NAMED_TABLE(resolve_halved, of_halves);

/* ---- The slope --------------------------------------------------------------------------------------------------- */

resolve_place resolve_at(int count, bool halved, int index) {
    for (size_t i = 0; i < sizeof patterns / sizeof patterns[0]; i++)
        if (patterns[i].count == count && patterns[i].halved == halved && index >= 0 && index < count)
            return patterns[i].at[index];
    return (resolve_place){0, 0};
}

static int count_of(const resolve_way *way, int samples) {
    return way->places > 0 ? way->places : samples;
}

static double beside(int x, int y, int of) {
    return (abs(x) + abs(y)) / (16.0 * of);
}

static double farthest(int count, bool halved) {
    double most = 0;
    for (int i = 0; i < count; i++) {
        const resolve_place at = resolve_at(count, halved, i);
        most = fmax(most, beside(at.x, at.y, 1));
    }
    return most;
}

static double middle(int count, bool halved) {
    int x = 0, y = 0;
    for (int i = 0; i < count; i++) {
        const resolve_place at = resolve_at(count, halved, i);
        x += at.x;
        y += at.y;
    }
    return beside(x, y, count);
}

/* The pixel lies among the places, so one of them is no nearer on any plane, and one no farther. */
static double pixels_of(const resolve_way *way, int count, bool reversed) {
    const bool halved = way->places > 0;
    const resolve_place first = resolve_at(count, halved, 0);
    switch (way->kept) {
    case RESOLVE_FIRST:
        return beside(first.x, first.y, 1);
    case RESOLVE_LEAST:
        return reversed ? 0 : farthest(count, halved);
    case RESOLVE_GREATEST:
        return reversed ? farthest(count, halved) : 0;
    case RESOLVE_MEAN:
        return middle(count, halved);
    case RESOLVE_ANY:
        break;
    }
    return farthest(count, halved);
}

/* ---- Roundings --------------------------------------------------------------------------------------------------- */

/* The exponent of a window depth; that of 1 is what is below 1, which is where a rounding may lead to it. */
static int exponent_of(double depth) {
    int e = -126;
    if (depth >= 0x1p-126)
        (void)frexp(depth, &e);
    return depth >= 0x1p-126 ? (e < 1 ? e - 1 : -1) : -127;
}

/* Half a step of binary32. */
static double half_step(int e) {
    return ldexp(1, e > -127 ? e - 24 : -150);
}

/* The most by which a format changes a binary32 number in the direction that costs something. */
static double format_error(const dp_format *f, dp_rounding rounding, bool reversed, int e) {
    const int lowest = 1 - f->bias;
    const double step =
        f->kind == DP_FORMAT_UNORM ? 1 / (double)f->code_max : ldexp(1, (e > lowest ? e : lowest) - f->mantissa_bits);
    if (f->kind == DP_FORMAT_FLOAT && step <= 2 * half_step(e))
        return 0; /* it has all of them */
    return rounding == DP_ROUND_ZERO ? (reversed ? 0 : step) : step / 2;
}

/* Half steps of binary32 by which the mean of so many may be off: the sum of k of them is at most k, whose half steps
 * are those of 1 times the next power of two. One after the other costs most. */
static double sum_error(int count) {
    double all = 0;
    for (int k = 2, power = 2; k <= count; k++) {
        power = k > power ? 2 * power : power;
        all += power;
    }
    return all / count;
}

resolve_need resolve_needs(const resolve_way *way, int samples, const dp_format *format, dp_rounding rounding,
                           bool reversed, double depth) {
    const int count = count_of(way, samples), e = exponent_of(depth);
    const double half = half_step(e);
    resolve_need need = {.pixels = pixels_of(way, count, reversed)};
    if (way->kept == RESOLVE_MEAN) {
        const double read = format->kind == DP_FORMAT_UNORM ? half : 0;
        need.window = 2 * half + format_error(format, rounding, reversed, e) + read + sum_error(count) * half;
    } else if (need.pixels > 0) {
        need.window = half;
    }
    return need;
}
