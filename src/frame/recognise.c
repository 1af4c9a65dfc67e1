/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Three looks: at the bits, which choose the format; at the window depths in that format, which are counted; and, where
 * there are numbers outside [0, 1], at what they may be instead.
 */
#include "frame/recognise.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>

#include "core/append.h"
#include "core/bits.h"
#include "core/elementary.h"
#include "frame/image_depths.h"
#include "frame/recognise_lattice.h"
#include "shader/clones.h"

enum { BLOCK = 2048, FP16_ONE = 0x3C00, WIDENED = 257, REASON_SIZE = 192 };
#define FP32_ONE    UINT32_C(0x3F800000)
#define FP32_LEAST  UINT32_C(0x2F800000) /* bits of 2^-32: images of fp32 have something nearer */
#define UNORM24_MAX UINT32_C(0xFFFFFF)

/* What the bits say. */
typedef struct finding {
    lattice which;
    bool none;   /* of the formats */
    bool single; /* all samples are binary32, or codes */
    bool sure;   /* integers: whether the format is in no doubt */
    bool chance; /* numbers: whether it is depends on how many there are */
    char reason[REASON_SIZE];
} finding;

static void say(finding *f, const char *format, ...) __attribute__((format(printf, 2, 3)));
static void say(finding *f, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(f->reason, sizeof f->reason, format, arguments);
    va_end(arguments);
}

/* ---- Holes ------------------------------------------------------------------------------------------------------- */

/* Of finite numbers. */
typedef struct extent {
    double lo, hi;
    size_t outside; /* of [0, 1] */
} extent;

static extent extent_of(const image *img) {
    extent e = {(double)INFINITY, -(double)INFINITY, 0};
    for (size_t i = 0; i < (size_t)img->width * img->height; i++) {
        const double x = image_sample(img, i);
        if (!isfinite(x))
            continue;
        e.lo = fmin(x, e.lo);
        e.hi = fmax(x, e.hi);
        e.outside += x < 0 || x > 1;
    }
    return e;
}

/* ---- Integers ---------------------------------------------------------------------------------------------------- */

/* Of all samples: the largest, whether all are widened bytes, and which bits differ between any two. */
typedef struct bits_seen {
    uint32_t most, differ;
    bool widened;
} bits_seen;

static bits_seen look_at_bits(const image *img) {
    const uint32_t first = (uint32_t)image_sample(img, 0);
    bits_seen s = {.widened = true};
    for (size_t i = 0; i < (size_t)img->width * img->height; i++) {
        const uint32_t x = (uint32_t)image_sample(img, i);
        s.most = x > s.most ? x : s.most;
        s.differ |= x ^ first;
        s.widened = s.widened && x == WIDENED * (x & 0xFF);
    }
    return s;
}

static void judge_bytes(const image *img, finding *f) {
    f->which = LATTICE_UNORM16;
    say(f, "shares of 255, fewer than any depth format has%s",
        img->channels > 1 ? " (depth packed into channels: --packing unpacks it)" : "");
}

static void judge_words(const image *img, finding *f) {
    const bits_seen s = look_at_bits(img);
    f->which = LATTICE_UNORM16;
    if (s.widened)
        say(f, "16 bits that repeat 8, fewer than any depth format has");
    else if (s.most > FP16_ONE)
        say(f, "codes of unorm16 up to %u, fp16 has none above %d; a finer buffer has lost all but 16 bits", s.most,
            FP16_ONE);
    else
        say(f, "codes up to %u%s, of unorm16 or of fp16", s.most, s.most == FP16_ONE ? ", which is 1 in fp16" : "");
}

static void judge_longs(const image *img, finding *f) {
    const bits_seen s = look_at_bits(img);
    const bool fp32 = s.most <= FP32_ONE && s.most >= FP32_LEAST;
    f->sure = true;
    if (s.most <= 0xFFFF) {
        f->which = LATTICE_UNORM16;
        f->sure = s.most == 0xFFFF;
        say(f, "codes up to %u, of unorm16%s", s.most, f->sure ? "" : " or of unorm24");
    } else if (s.most <= UNORM24_MAX) {
        f->which = LATTICE_UNORM24;
        say(f, "codes of unorm24 up to %u", s.most);
    } else if ((s.differ & 0xFF) == 0 && s.differ != 0 && !(fp32 && (s.differ & 0x1FFF) == 0)) {
        f->none = true;
        say(f, "all low bytes are equal: if they are stencil below 24 bits of depth, shift right by 8 first");
    } else if (fp32) {
        f->which = LATTICE_FP32;
        say(f, "bits of fp32, none above those of 1");
    } else if (s.differ <= UNORM24_MAX) {
        f->none = true;
        say(f, "all high bytes are equal: if they are stencil above 24 bits of depth, take & 0xFFFFFF first");
    } else {
        f->none = true;
        say(f, "whole numbers up to %u are codes of no named format: bits of fp32 end at %u", s.most, FP32_ONE);
    }
}

/* The file names its format. */
static void judge_named(const image *img, finding *f) {
    f->sure = true;
    while (f->which < LATTICE_FP32 && strcmp(lattice_name(f->which), img->says) != 0)
        f->which++;
    say(f, "%s, as the %s names it", img->says, image_file_name(img->file));
}

/* ---- Numbers ----------------------------------------------------------------------------------------------------- */

static void judge_halves(const image *img, finding *f) {
    (void)img;
    f->which = LATTICE_FP16;
    say(f, "numbers of fp16, or rounded to it");
}

static void count_off(const image *img, void (*count)(const double *, size_t, size_t[LATTICE_COUNT]),
                      size_t off[LATTICE_COUNT]) {
    const dp_format any = dp_format_get(0)->format;
    double d[BLOCK];
    for (int k = 0; k < LATTICE_COUNT; k++)
        off[k] = 0;
    for (uint32_t row = 0; row < img->height; row++)
        for (uint32_t x = 0; x < img->width; x += BLOCK) {
            const uint32_t some = img->width - x < BLOCK ? img->width - x : BLOCK;
            image_depths(img, &any, row, x, some, d);
            count(d, some, off);
        }
}

static void judge_numbers(const image *img, finding *f) {
    size_t off[LATTICE_COUNT];
    count_off(img, lattice_single, off);
    f->single = off[LATTICE_FP32] == 0;
    if (!f->single)
        count_off(img, lattice_double, off);
    int k = 0;
    while (k < LATTICE_FP32 && off[k] > 0)
        k++;
    f->which = (lattice)k;
    f->chance = k < LATTICE_FP32;
    f->sure = k == LATTICE_FP32 && f->single;
    if (f->chance)
        return;
    size_t least = SIZE_MAX;
    for (int i = 0; i < LATTICE_FP32; i++)
        if (off[i] < least) {
            least = off[i];
            k = i;
        }
    say(f, "%s%zu of %zu samples are off the lattice of %s, which fits best of the coarser ones",
        f->single ? "" : "finer than fp32: ", least, (size_t)img->width * img->height, lattice_name((lattice)k));
}

/* ---- Window depths ------------------------------------------------------------------------------------------------*/

/* What is counted besides what recognised has. */
typedef struct tally {
    distinct_set seen;
    size_t telling;          /* different numbers that say something about the lattice */
    double expected, bits;   /* how many would lie on it by chance; -log2 of the product */
    size_t low, high, inner; /* below 1/4, above 3/4, neither 0 nor 1 */
} tally;

static void count_new(tally *s, const finding *f, double d) {
    if (!distinct_add(&s->seen, d))
        return;
    const double chance = lattice_chance(f->which, f->single, d);
    s->expected += chance;
    s->telling += chance < 1;
    s->bits -= dp_log2(chance);
}

/* Of at most BLOCK depths, which are NaN or in [0, 1] and so are ordered as their bits are. */
typedef struct counts {
    int64_t lo, hi;
    int32_t invalid, at_zero, at_one, low, high;
} counts;

CLONES static void count_block(const double *d, size_t count, counts *out) {
    counts c = {.lo = INT64_MAX};
    for (size_t i = 0; i < count; i++) {
        const int64_t bits = (int64_t)dp_bits64(d[i]);
        const int64_t valid = d[i] == d[i] ? bits : 0;
        c.lo = bits < c.lo ? bits : c.lo; /* that of a NaN is larger than all others */
        c.hi = valid > c.hi ? valid : c.hi;
        c.invalid += d[i] != d[i];
        c.at_zero += d[i] == 0;
        c.at_one += d[i] == 1;
        c.low += d[i] < 0.25;
        c.high += d[i] > 0.75;
    }
    *out = c;
}

static void count_row(const double *d, size_t count, const finding *f, tally *s, recognised *out) {
    counts c;
    count_block(d, count, &c);
    out->invalid += (size_t)c.invalid;
    out->at_zero += (size_t)c.at_zero;
    out->at_one += (size_t)c.at_one;
    s->low += (size_t)(c.low - c.at_zero);
    s->high += (size_t)(c.high - c.at_one);
    s->inner += count - (size_t)(c.invalid + c.at_zero + c.at_one);
    if ((size_t)c.invalid == count)
        return;
    out->lo = fmin(out->lo, dp_float64((uint64_t)c.lo));
    out->hi = fmax(out->hi, dp_float64((uint64_t)c.hi));
    for (size_t i = 0; i < count && s->seen.count < RECOGNISE_DISTINCT_MAX; i++)
        if (!isnan(d[i]) && (i == 0 || d[i] != d[i - 1]))
            count_new(s, f, d[i]);
}

/* Rows are visited in strides, so that different numbers of all heights are counted before their count is full. */
static uint32_t stride_of(uint32_t height) {
    uint32_t stride = (uint32_t)(0.618 * height);
    while (common_divisor(stride, height) != 1)
        stride++;
    return stride;
}

static void count_all(const image *img, const finding *f, tally *s, recognised *out) {
    const uint32_t stride = stride_of(img->height);
    double d[BLOCK];
    for (uint64_t i = 0; i < img->height; i++)
        for (uint32_t x = 0; x < img->width; x += BLOCK) {
            const uint32_t some = img->width - x < BLOCK ? img->width - x : BLOCK;
            image_depths(img, &out->format, (uint32_t)(i * stride % img->height), x, some, d);
            count_row(d, some, f, s, out);
        }
}

/* ---- Direction ----------------------------------------------------------------------------------------------------*/

/* The sky is the end that far more samples have, where they are not a few; the mass is where nine of ten others are.
 * What may be the holes of metric depth is no sky. */
static const char *direct(const tally *s, recognised *out) {
    const size_t sky = out->at_zero > out->at_one ? out->at_zero : out->at_one;
    const size_t other = out->at_zero + out->at_one - sky;
    const int by_sky = sky < 1 + out->samples / 1000 || sky < 4 * other ? -1 : out->at_zero > out->at_one;
    const int by_mass = s->inner == 0 ? -1 : 10 * s->low >= 9 * s->inner ? 1 : 10 * s->high >= 9 * s->inner ? 0 : -1;
    out->reversed = -1;
    if (s->inner == 0)
        return "nothing drawn shows a direction";
    if (by_sky >= 0 && by_mass >= 0 && by_sky != by_mass)
        return by_mass ? "near 0 but sky at 1: no direction" : "near 1 but sky at 0: no direction";
    out->reversed = by_mass >= 0 ? by_mass : by_sky;
    const size_t inner_values = out->distinct - (out->at_zero > 0) - (out->at_one > 0);
    out->direction = !out->metric && by_sky >= 0 && by_sky == by_mass && other == 0 && 16 * sky >= out->samples &&
                     sky * inner_values >= 16 * s->inner;
    if (out->reversed < 0)
        return "neither sky nor mass shows a direction";
    if (by_mass < 0)
        return by_sky ? "sky at 0: likely reversed" : "sky at 1: likely not reversed";
    if (by_sky < 0)
        return by_mass ? "most are below 1/4: likely reversed" : "most are above 3/4: likely not reversed";
    static const char *const both[2][2] = {
        {"most are above 3/4, sky at 1: likely not reversed", "most are below 1/4, sky at 0: likely reversed"},
        {"most are above 3/4, sky at 1: not reversed", "most are below 1/4, sky at 0: reversed"}};
    return both[out->direction][by_mass];
}

/* ---- Numbers that are no window depth -----------------------------------------------------------------------------*/

static void explain(const image *img, finding *f, const extent *e, recognised *out) {
    if (img->type < IMAGE_F16) {
        say(f, "no window depth: %zu of %zu samples are not in [0, 1]", out->invalid, out->samples);
        return;
    }
    const bool found = e->lo <= e->hi;
    out->metric = found && e->hi > 1;
    const char *hint = out->metric                                       ? ": metric depth? --metric 1 reads it"
                       : found && e->lo < 0 && e->lo >= -1 && e->hi <= 1 ? ": OpenGL's NDC?"
                                                                         : "";
    if (!found)
        say(f, "no window depth: no sample is finite");
    else
        say(f, "no window depth: %zu of %zu samples are not in [0, 1], finite ones go from %.6g to %.6g%s",
            out->invalid, out->samples, e->lo, e->hi, hint);
}

/* Millimetres of a sensor are whole numbers of 16 bits, with 0 where it saw nothing and nothing else below 100. */
static void suspect(const image *img, const tally *s, recognised *out) {
    enum { LEAST = 100, MOST = 30000 };
    double least = 1, most = 0;
    if (img->type != IMAGE_U16 || out->at_zero < 1 + out->samples / 1000)
        return;
    for (size_t i = 0; i < s->seen.size && s->seen.slots != NULL; i++) {
        const double d = dp_float64(s->seen.slots[i]);
        least = d > 0 ? fmin(least, d) : least;
        most = d > 0 ? fmax(most, d) : most;
    }
    out->metric = least * 65535 >= LEAST && most * 65535 <= MOST;
}

/* ---- Together -----------------------------------------------------------------------------------------------------*/

static void (*const judges[IMAGE_TYPE_COUNT])(const image *img, finding *f) = {
    [IMAGE_U8] = judge_bytes,   [IMAGE_U16] = judge_words,   [IMAGE_U32] = judge_longs,
    [IMAGE_F16] = judge_halves, [IMAGE_F32] = judge_numbers, [IMAGE_F64] = judge_numbers,
};

/* What is coarser than the lattice. Bytes are, whatever is in them. */
static void find_steps(const image *img, finding *f, const tally *s, recognised *out) {
    const bool codes = img->type < IMAGE_F16 && f->which != LATTICE_FP32;
    const double tops[] = {[LATTICE_FP16] = (double)INFINITY, 65535, 16777215, (double)INFINITY};
    const grid_source source = {.bits = img->type == IMAGE_F16 ? 11
                                        : f->single            ? 24
                                                               : 53,
                                .finest = tops[f->which],
                                .top = codes ? tops[f->which] : 0,
                                .dyadic = f->which == LATTICE_FP16};
    grid found = img->type == IMAGE_U8 ? (grid){255, (double)INFINITY} : grid_find(&s->seen, &source);
    out->steps = found.steps;
    out->steps_certain = found.bits >= RECOGNISE_BITS;
    if (found.steps == 0 || img->type == IMAGE_U8)
        return;
    out->certain = false;
    append(f->reason, sizeof f->reason, "; all are multiples of 1/%.9g%s", found.steps,
           out->steps_certain ? "" : ", inconclusive");
}

/* How many numbers agree, against how many would without that lattice. */
static void weigh(finding *f, const tally *s, recognised *out) {
    out->certain = f->chance ? s->telling >= RECOGNISE_LEAST && s->bits >= RECOGNISE_BITS : f->sure && s->inner > 0;
    if (!f->chance)
        return;
    const char *more = s->seen.count >= RECOGNISE_DISTINCT_MAX ? "more than " : "";
    say(f, "%s%zu different numbers lie on the lattice of %s", more, s->seen.count, lattice_name(f->which));
    if (!out->certain && 2 * s->expected >= (double)s->seen.count)
        append(f->reason, sizeof f->reason, ": inconclusive, random values would fit as well");
    else
        append(f->reason, sizeof f->reason, ", of random ones %.3g would%s", s->expected,
               out->certain ? "" : ": too few to tell");
}

void recognise(const image *img, recognised *out) {
    finding f = {.single = true};
    tally s = {0};
    dp_format formats[2];
    extent numbers = {0};
    if (img->says != NULL)
        judge_named(img, &f);
    else
        judges[img->type](img, &f);
    dp_format_parse(lattice_name(f.which), formats);
    *out = (recognised){.format = formats[0],
                        .reversed = -1,
                        .samples = (size_t)img->width * img->height,
                        .lo = (double)INFINITY,
                        .hi = -(double)INFINITY};
    distinct_init(&s.seen, out->samples);
    if (!f.none)
        count_all(img, &f, &s, out);
    else
        out->invalid = out->samples;
    if (out->invalid > 0 && img->type >= IMAGE_F16) {
        numbers = extent_of(img);
        out->holes = out->invalid - numbers.outside;
    }
    out->distinct = s.seen.count;
    out->depth = out->invalid == out->holes && out->holes < out->samples;
    if (out->depth) {
        weigh(&f, &s, out);
        find_steps(img, &f, &s, out);
        suspect(img, &s, out);
        out->towards = direct(&s, out);
    } else if (!f.none) {
        explain(img, &f, &numbers, out);
    }
    distinct_free(&s.seen);
    if (out->lo > out->hi)
        out->lo = out->hi = (double)NAN;
    snprintf(out->why, sizeof out->why, "%s%s%s", f.reason, out->towards != NULL ? "; " : "",
             out->towards != NULL ? out->towards : "");
}
