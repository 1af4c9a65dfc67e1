/* SPDX-License-Identifier: MIT */
/*
 * Three looks: at the bits, which choose the format; at the window depths in that format, which are counted; and, where
 * there are numbers outside [0, 1], at what they may be instead.
 */
#include "depthprec/recognise.h"

#include <math.h>
#include <string.h>

#include "core/bits.h"
#include "core/clones.h"
#include "core/elementary.h"
#include "core/reading.h"
#include "core/recognise_lattice.h"

enum { BLOCK = 2048, FP16_ONE = 0x3C00, WIDENED = 257 };
#define FP32_ONE    UINT32_C(0x3F800000)
#define FP32_LEAST  UINT32_C(0x2F800000) /* bits of 2^-32: images of fp32 have something nearer */
#define UNORM24_MAX UINT32_C(0xFFFFFF)

/* The lattice that the samples' bits show. */
typedef struct finding {
    dp_lattice which;
    bool single; /* all samples are binary32, or codes */
    bool sure;   /* integers: whether the format is in no doubt */
    bool chance; /* numbers: whether it is depends on how many there are */
} finding;

/* ---- Samples as they are ----------------------------------------------------------------------------------------- */

/* The extent of the finite samples. */
typedef struct extent {
    double least, greatest;
    size_t outside;  /* numbers: how many, of [0, 1] */
    uint32_t differ; /* integers: which bits differ between any two, */
    bool widened;    /* and whether all are widened bytes */
} extent;

static void words_of(const dp_image *image, size_t first, size_t count, uint32_t *words) {
    const size_t stride = image->stride, from = first * stride;
    const uint8_t *const bytes = image->data;
    const uint16_t *const shorts = image->data;
    const uint32_t *const longs = image->data;
    for (size_t i = 0; i < count; i++)
        words[i] = image->type == DP_IMAGE_U8    ? bytes[from + i * stride]
                   : image->type == DP_IMAGE_U16 ? shorts[from + i * stride]
                                                 : longs[from + i * stride];
}

/* Whole numbers, many at a time. */
static void widen_words(extent *e, const uint32_t *words, size_t count, uint32_t first) {
    uint32_t least = UINT32_MAX, greatest = 0, differ = 0, other = 0;
    for (size_t i = 0; i < count; i++) {
        const uint32_t bits = words[i];
        least = bits < least ? bits : least;
        greatest = bits > greatest ? bits : greatest;
        differ |= bits ^ first;
        other |= bits ^ WIDENED * (bits & 0xFF);
    }
    e->least = least < e->least ? least : e->least;
    e->greatest = greatest > e->greatest ? greatest : e->greatest;
    e->differ |= differ;
    e->widened = e->widened && other == 0;
}

static extent extent_of(const dp_image *image, size_t count) {
    enum { WORDS = 512 };
    uint32_t words[WORDS];
    const bool integers = image->type < DP_IMAGE_F16;
    extent e = {.least = (double)INFINITY, .greatest = -(double)INFINITY, .widened = true};
    for (size_t i = 0; i < count && !integers; i++) {
        const double x = dp_image_number(image, i);
        if (!isfinite(x))
            continue;
        e.least = x < e.least ? x : e.least;
        e.greatest = x > e.greatest ? x : e.greatest;
        e.outside += x < 0 || x > 1;
    }
    for (size_t i = 0; i < count && integers; i += WORDS) {
        const size_t some = count - i < WORDS ? count - i : WORDS;
        words_of(image, i, some, words);
        widen_words(&e, words, some, (uint32_t)dp_image_number(image, 0));
    }
    return e;
}

/* ---- Formats ----------------------------------------------------------------------------------------------------- */

static dp_reason judge_longs(const extent *e, finding *f) {
    const uint32_t most = e->greatest > 0 ? (uint32_t)e->greatest : 0;
    const bool fp32 = most <= FP32_ONE && most >= FP32_LEAST;
    f->sure = true;
    if (most <= 0xFFFF) {
        f->which = DP_LATTICE_UNORM16;
        f->sure = most == 0xFFFF;
        return DP_REASON_LONGS_16;
    }
    if (most <= UNORM24_MAX) {
        f->which = DP_LATTICE_UNORM24;
        return DP_REASON_LONGS_24;
    }
    if ((e->differ & 0xFF) == 0 && e->differ != 0 && !(fp32 && (e->differ & 0x1FFF) == 0))
        return DP_REASON_STENCIL_LOW;
    f->which = fp32 ? DP_LATTICE_FP32 : f->which;
    return fp32 ? DP_REASON_LONGS_32 : e->differ <= UNORM24_MAX ? DP_REASON_STENCIL_HIGH : DP_REASON_LARGE;
}

static void count_off(const dp_image *image, size_t all, void (*count)(const double *, size_t, size_t[]),
                      size_t off[DP_LATTICE_COUNT]) {
    double d[BLOCK];
    dp_reading r;
    dp_reading_begin(&r, image, &dp_format_get(0)->format, DP_REAL_DOUBLE);
    for (int k = 0; k < DP_LATTICE_COUNT; k++)
        off[k] = 0;
    for (size_t i = 0; i < all; i += BLOCK) {
        const size_t some = all - i < BLOCK ? all - i : BLOCK;
        dp_reading_depths(&r, i, some, d);
        count(d, some, off);
    }
}

static dp_reason judge_numbers(const dp_image *image, finding *f, dp_recognised *out) {
    size_t off[DP_LATTICE_COUNT];
    count_off(image, out->samples, dp_lattice_single, off);
    f->single = off[DP_LATTICE_FP32] == 0;
    if (!f->single)
        count_off(image, out->samples, dp_lattice_double, off);
    int k = 0, closest = 0;
    while (k < DP_LATTICE_FP32 && off[k] > 0)
        k++;
    f->which = (dp_lattice)k;
    f->chance = k < DP_LATTICE_FP32;
    f->sure = k == DP_LATTICE_FP32 && f->single;
    if (f->chance)
        return DP_REASON_LATTICE;
    for (int i = 1; i < DP_LATTICE_FP32; i++)
        closest = off[i] < off[closest] ? i : closest;
    out->closest = dp_lattice_name((dp_lattice)closest);
    out->off = off[closest];
    return f->single ? DP_REASON_SINGLES : DP_REASON_DOUBLES;
}

static dp_reason judge(const dp_image *image, const extent *e, finding *f, dp_recognised *out) {
    switch (image->type) {
    case DP_IMAGE_U8:
        f->which = DP_LATTICE_UNORM16;
        return DP_REASON_BYTES;
    case DP_IMAGE_U16:
        f->which = DP_LATTICE_UNORM16;
        return e->widened ? DP_REASON_WIDENED : e->greatest > FP16_ONE ? DP_REASON_WORDS : DP_REASON_WORDS_LOW;
    case DP_IMAGE_U32:
        return judge_longs(e, f);
    case DP_IMAGE_F16:
        f->which = DP_LATTICE_FP16;
        return DP_REASON_HALVES;
    default:
        return judge_numbers(image, f, out);
    }
}

/* ---- Window depths ------------------------------------------------------------------------------------------------*/

/* Counts that are needed besides those of dp_recognised. */
typedef struct tally {
    dp_distinct seen;
    size_t telling;          /* different numbers that say something about the lattice */
    double expected, bits;   /* how many would lie on it by chance; -log2 of the product */
    size_t low, high, inner; /* below 1/4, above 3/4, neither 0 nor 1 */
} tally;

static void count_new(tally *s, const finding *f, double d) {
    if (!dp_distinct_add(&s->seen, d))
        return;
    const double chance = dp_lattice_chance(f->which, f->single, d);
    s->expected += chance;
    s->telling += chance < 1;
    s->bits -= dp_log2(chance);
}

/* Counts over at most BLOCK depths, which are NaN or in [0, 1] and so are ordered as their bits are. */
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

static void count_row(const double *d, size_t count, const finding *f, tally *s, dp_recognised *out) {
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
    for (size_t i = 0; i < count && s->seen.count < DP_RECOGNISE_DISTINCT; i++)
        if (!isnan(d[i]) && (i == 0 || d[i] != d[i - 1]))
            count_new(s, f, d[i]);
}

/* Rows are visited in strides, so that different numbers of all heights are counted before their count is full. */
static size_t stride_of(size_t height) {
    size_t stride = (size_t)(0.618 * (double)height);
    while (dp_common_divisor(stride, height) != 1)
        stride++;
    return stride;
}

static void count_all(const dp_image *image, const finding *f, tally *s, dp_recognised *out) {
    const size_t stride = stride_of(image->height);
    double d[BLOCK];
    dp_reading r;
    dp_reading_begin(&r, image, &out->format, DP_REAL_DOUBLE);
    for (size_t i = 0, row = 0; i < image->height; i++) {
        for (size_t x = 0; x < image->width; x += BLOCK) {
            const size_t some = image->width - x < BLOCK ? image->width - x : BLOCK;
            dp_reading_depths(&r, row * image->width + x, some, d);
            count_row(d, some, f, s, out);
        }
        row = row < image->height - stride ? row + stride : row - (image->height - stride);
    }
}

/* ---- Direction ----------------------------------------------------------------------------------------------------*/

/* The sky is the end that far more samples have, where they are not a few; the mass is where nine of ten others are.
 * Depths that may be the holes of metric depth are no sky. */
static void direct(const tally *s, dp_recognised *out) {
    const size_t most = out->at_zero > out->at_one ? out->at_zero : out->at_one;
    const size_t other = out->at_zero + out->at_one - most;
    out->sky = most < 1 + out->samples / 1000 || most < 4 * other ? -1 : out->at_zero > out->at_one;
    out->mass = s->inner == 0 ? -1 : 10 * s->low >= 9 * s->inner ? 1 : 10 * s->high >= 9 * s->inner ? 0 : -1;
    if (s->inner == 0 || (out->sky >= 0 && out->mass >= 0 && out->sky != out->mass))
        return;
    out->reversed = out->mass >= 0 ? out->mass : out->sky;
    if (out->distinct == 0) /* there is no memory to count in */
        return;
    const uint64_t inner_values = out->distinct - (out->at_zero > 0) - (out->at_one > 0);
    out->direction = !out->metric && out->sky >= 0 && out->sky == out->mass && other == 0 &&
                     16 * most >= out->samples && most * inner_values >= 16 * s->inner;
}

/* ---- Conclusions --------------------------------------------------------------------------------------------------*/

/* Millimetres of a sensor are whole numbers of 16 bits, with 0 where it saw nothing and nothing else below 100. */
static void suspect(const dp_image *image, const tally *s, dp_recognised *out) {
    enum { LEAST = 100, MOST = 30000 };
    double least = 1, most = 0;
    if (image->type != DP_IMAGE_U16 || out->distinct == 0 || out->at_zero < 1 + out->samples / 1000)
        return;
    for (size_t i = 0; i < s->seen.size; i++) {
        const double d = dp_float64(s->seen.slots[i]);
        least = d > 0 ? fmin(least, d) : least;
        most = d > 0 ? fmax(most, d) : most;
    }
    out->metric = least * 65535 >= LEAST && most * 65535 <= MOST;
}

/* Looks for a grid coarser than the lattice. Bytes are one, whatever is in them. */
static void find_steps(const dp_image *image, const finding *f, const tally *s, dp_recognised *out) {
    const bool codes = image->type < DP_IMAGE_F16 && f->which != DP_LATTICE_FP32;
    const double tops[] = {[DP_LATTICE_FP16] = (double)INFINITY, 65535, 16777215, (double)INFINITY};
    const dp_grid_source source = {.bits = image->type == DP_IMAGE_F16 ? 11
                                           : f->single                 ? 24
                                                                       : 53,
                                   .finest = tops[f->which],
                                   .top = codes ? tops[f->which] : 0,
                                   .dyadic = f->which == DP_LATTICE_FP16};
    const dp_grid found =
        image->type == DP_IMAGE_U8 ? (dp_grid){255, (double)INFINITY} : dp_grid_find(&s->seen, &source);
    out->steps = found.steps;
    out->steps_certain = found.bits >= DP_RECOGNISE_BITS;
}

/* How many numbers agree, against how many would without that lattice. */
static void weigh(const finding *f, const tally *s, dp_recognised *out) {
    out->proved =
        f->chance ? s->telling >= DP_RECOGNISE_LEAST && s->bits >= DP_RECOGNISE_BITS : f->sure && s->inner > 0;
    out->certain = out->proved && out->steps == 0;
    out->expected = f->chance ? s->expected : 0;
}

/* Whether there is depth, and which; if not, why. */
static void conclude(const dp_image *image, const extent *e, const finding *f, const tally *s, dp_recognised *out) {
    const bool some = out->holes < out->samples, looked = image->type < DP_IMAGE_F16 || out->invalid > 0;
    out->depth = out->invalid == out->holes && some;
    if (out->depth) {
        find_steps(image, f, s, out);
        weigh(f, s, out);
        suspect(image, s, out);
        direct(s, out);
    } else if (out->reason >= DP_REASON_GIVEN) {
        out->reason = some ? DP_REASON_OUTSIDE : DP_REASON_EMPTY;
        out->metric = image->type >= DP_IMAGE_F16 && some && e->greatest > 1;
    }
    if (out->lo > out->hi)
        out->lo = out->hi = (double)NAN;
    out->least = !looked ? out->lo : some ? e->least : (double)NAN;
    out->greatest = !looked ? out->hi : some ? e->greatest : (double)NAN;
}

/* ---- Public ------------------------------------------------------------------------------------------------------ */

/* Which of the named lattices a format is; DP_LATTICE_COUNT for none. */
static dp_lattice named(const dp_format *format) {
    int k = 0;
    while (k < DP_LATTICE_COUNT && strcmp(dp_lattice_name((dp_lattice)k), format->name) != 0)
        k++;
    return (dp_lattice)k;
}

dp_status dp_recognise(const dp_image *image, const dp_format *known, uint64_t *slots, dp_recognised *out) {
    if (image == NULL || out == NULL)
        return DP_ERROR_NULL;
    const size_t all = image->width * image->height;
    if (image->data == NULL && all > 0)
        return DP_ERROR_NULL;
    if ((unsigned)image->type >= DP_IMAGE_TYPE_COUNT)
        return DP_ERROR_BATCH;
    finding f = {.which = known != NULL ? named(known) : DP_LATTICE_FP16, .single = true, .sure = known != NULL};
    if (f.which == DP_LATTICE_COUNT)
        return DP_ERROR_FORMAT;
    dp_format formats[2];
    tally s = {0};
    extent e = {.least = (double)INFINITY, .greatest = -(double)INFINITY};
    const bool integers = image->type < DP_IMAGE_F16;
    if (integers)
        e = extent_of(image, all);
    *out = (dp_recognised){
        .samples = all, .sky = -1, .mass = -1, .reversed = -1, .lo = (double)INFINITY, .hi = -(double)INFINITY};
    out->reason = known != NULL ? DP_REASON_GIVEN : judge(image, &e, &f, out);
    dp_format_parse(dp_lattice_name(f.which), formats);
    out->format = formats[0];
    dp_distinct_init(&s.seen, slots, all);
    if (out->reason < DP_REASON_GIVEN)
        out->invalid = all;
    else if (all > 0)
        count_all(image, &f, &s, out);
    if (!integers && out->invalid > 0) {
        e = extent_of(image, all);
        out->holes = out->invalid - e.outside;
    }
    out->distinct = s.seen.count;
    conclude(image, &e, &f, &s, out);
    return DP_OK;
}
