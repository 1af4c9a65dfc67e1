/* SPDX-License-Identifier: MIT */
/* Samples as window depths or codes: blocks that stay in the first-level cache, through the batch kernels. */
#include "core/reading.h"

#include <math.h>
#include <string.h>

#include "core/clones.h"

enum { BLOCK = 1024 };

static const size_t sizes[DP_IMAGE_TYPE_COUNT] = {1, 2, 4, 2, 4, 8};

/* A block of samples side by side, and of depths of either type. */
typedef union block {
    unsigned char bytes[BLOCK * sizeof(double)];
    uint16_t u16[BLOCK];
    float real32[BLOCK];
    double real64[BLOCK];
} block;

/* ---- Loops ------------------------------------------------------------------------------------------------------- */

/* Numbers of [0, 1], NaN in place of others; + 0 turns -0 into 0. */
#define CLEAN(NAME, FROM, TO)                                                                                          \
    CLONES static void NAME(const FROM *from, size_t count, TO *to) {                                                  \
        for (size_t i = 0; i < count; i++)                                                                             \
            to[i] = (TO)(from[i] >= 0 && from[i] <= 1 ? from[i] + 0 : (FROM)__builtin_nanf(""));                       \
    }
CLEAN(clean_float, float, float)
CLEAN(clean_float_double, float, double)
CLEAN(clean_double, double, double)

/* Depths whose code does not exist. */
#define BAR(NAME, FROM, TO)                                                                                            \
    CLONES static void NAME(const FROM *codes, uint32_t code_max, size_t count, TO *d) {                               \
        for (size_t i = 0; i < count; i++)                                                                             \
            d[i] = codes[i] > code_max ? (TO)__builtin_nanf("") : d[i];                                                \
    }
BAR(bar_float_16, uint16_t, float)
BAR(bar_double_16, uint16_t, double)
BAR(bar_double_32, uint32_t, double)

#define BAR_CODES(NAME, FROM)                                                                                          \
    CLONES static void NAME(const FROM *d, size_t count, uint32_t *codes) {                                            \
        for (size_t i = 0; i < count; i++)                                                                             \
            codes[i] = d[i] == d[i] ? codes[i] : UINT32_MAX;                                                           \
    }
BAR_CODES(bar_codes_float, float)
BAR_CODES(bar_codes_double, double)

#define WIDEN(NAME, FROM)                                                                                              \
    CLONES static void NAME(const FROM *from, uint32_t code_max, size_t count, uint32_t *to) {                         \
        for (size_t i = 0; i < count; i++)                                                                             \
            to[i] = from[i] > code_max ? UINT32_MAX : from[i];                                                         \
    }
WIDEN(widen_16, uint16_t)
WIDEN(widen_32, uint32_t)

CLONES static void words_of_bytes(const uint8_t *from, size_t step, size_t count, uint16_t *to) {
    for (size_t i = 0; i < count; i++)
        to[i] = from[i * step];
}

/* -0 of binary16 is 0. All other numbers with a sign, those above 1 and NaN have bits above those of 1. */
CLONES static void unsign(const uint16_t *from, size_t step, size_t count, uint16_t *to) {
    for (size_t i = 0; i < count; i++)
        to[i] = from[i * step] == 0x8000 ? 0 : from[i * step];
}

/* ---- Blocks -------------------------------------------------------------------------------------------------------*/

/* Samples alone, side by side: bytes as words, binary16 without a sign of 0. */
static const void *side_by_side(const dp_image *image, size_t first, size_t count, block *scratch) {
    const size_t step = image->stride, size = sizes[image->type];
    const void *at = (const unsigned char *)image->data + first * step * size;
    if (image->type == DP_IMAGE_U8)
        words_of_bytes(at, step, count, scratch->u16);
    else if (image->type == DP_IMAGE_F16)
        unsign(at, step, count, scratch->u16);
    else if (step == 1)
        return at;
    else
        for (size_t i = 0; i < count; i++)
            memcpy(scratch->bytes + i * size, (const unsigned char *)at + i * step * size, size);
    return scratch;
}

/* A task on window depths and codes; it reads nothing of the set-up but format and rounding. */
static void prepare(dp_batch *batch, const dp_format *format, dp_task task, dp_real real, dp_word word) {
    dp_spec spec = dp_spec_default();
    dp_setup setup;
    spec.format = *format;
    dp_setup_init(&setup, &spec);
    dp_batch_init(batch, &setup, task, real, word, dp_path_best());
}

void dp_reading_begin(dp_reading *r, const dp_image *image, const dp_format *format, dp_real real) {
    dp_format half[2];
    const bool halves = image->type == DP_IMAGE_F16;
    if (halves)
        dp_format_parse("fp16", half);
    r->image = image;
    r->format = halves ? half[0] : *format;
    r->codes = halves || dp_image_holds_codes(image->type, format);
    r->real = real;
    if (r->codes)
        prepare(&r->decode, &r->format, DP_TASK_DECODE, real, image->type == DP_IMAGE_U32 ? DP_WORD_32 : DP_WORD_16);
}

/* Shares of the type's maximum. */
static void shares(const dp_reading *r, const uint16_t *words, size_t count, double *d) {
    const double most = r->image->type == DP_IMAGE_U8 ? 255 : 65535;
    for (size_t i = 0; i < count; i++)
        d[i] = words[i] / most;
}

static void decoded(const dp_reading *r, const void *codes, size_t count, void *d) {
    const uint32_t code_max = r->format.code_max;
    dp_batch_run(&r->decode, codes, d, count);
    if (r->real == DP_REAL_FLOAT)
        bar_float_16(codes, code_max, count, d);
    else if (r->image->type == DP_IMAGE_U32)
        bar_double_32(codes, code_max, count, d);
    else
        bar_double_16(codes, code_max, count, d);
}

static void block_depths(const dp_reading *r, const void *at, size_t count, void *d) {
    if (r->codes)
        decoded(r, at, count, d);
    else if (r->image->type == DP_IMAGE_F32 && r->real == DP_REAL_FLOAT)
        clean_float(at, count, d);
    else if (r->image->type == DP_IMAGE_F32)
        clean_float_double(at, count, d);
    else if (r->image->type == DP_IMAGE_F64)
        clean_double(at, count, d);
    else
        shares(r, at, count, d);
}

/* ---- For the rooms above ----------------------------------------------------------------------------------------- */

/* The number that the bits of a binary16 stand for; NaN for infinities, too. */
static double half_of(uint16_t bits) {
    const int exponent = bits >> 10 & 31, fraction = bits & 1023;
    const double size = exponent == 31  ? (double)NAN
                        : exponent == 0 ? ldexp(fraction, -24)
                                        : ldexp(1024 + fraction, exponent - 25);
    return bits >> 15 ? -size : size;
}

double dp_image_number(const dp_image *image, size_t pixel) {
    const size_t i = pixel * image->stride;
    const void *at = image->data;
    switch (image->type) {
    case DP_IMAGE_U8:
        return ((const uint8_t *)at)[i];
    case DP_IMAGE_U16:
        return ((const uint16_t *)at)[i];
    case DP_IMAGE_U32:
        return ((const uint32_t *)at)[i];
    case DP_IMAGE_F16:
        return half_of(((const uint16_t *)at)[i]);
    case DP_IMAGE_F32:
        return (double)((const float *)at)[i];
    default:
        return ((const double *)at)[i];
    }
}

bool dp_image_holds_codes(dp_image_type type, const dp_format *format) {
    return type <= DP_IMAGE_U32 && 8 * sizes[type] >= (size_t)format->bits;
}

void dp_reading_depths(const dp_reading *r, size_t first, size_t count, double *d) {
    block scratch;
    for (size_t i = 0; i < count; i += BLOCK) {
        const size_t some = count - i < BLOCK ? count - i : BLOCK;
        block_depths(r, side_by_side(r->image, first + i, some, &scratch), some, d + i);
    }
}

/* A sample that is no code becomes the nearest one, from binary32 where samples have no more bits. */
static void encoded(const dp_batch *encode, const dp_reading *r, const void *at, size_t count, uint32_t *codes) {
    block d;
    block_depths(r, at, count, &d);
    dp_batch_run(encode, &d, codes, count);
    if (r->real == DP_REAL_FLOAT)
        bar_codes_float(d.real32, count, codes);
    else
        bar_codes_double(d.real64, count, codes);
}

void dp_image_codes(const dp_image *image, const dp_format *format, size_t first, size_t count, uint32_t *codes) {
    block scratch;
    const bool single = image->type == DP_IMAGE_F16 || image->type == DP_IMAGE_F32;
    const bool are_codes = dp_image_holds_codes(image->type, format);
    dp_reading r;
    dp_batch encode;
    dp_reading_begin(&r, image, format, single ? DP_REAL_FLOAT : DP_REAL_DOUBLE);
    if (!are_codes)
        prepare(&encode, format, DP_TASK_ENCODE, r.real, DP_WORD_32);
    for (size_t i = 0; i < count; i += BLOCK) {
        const size_t some = count - i < BLOCK ? count - i : BLOCK;
        const void *at = side_by_side(image, first + i, some, &scratch);
        if (are_codes && image->type == DP_IMAGE_U32)
            widen_32(at, format->code_max, some, codes + i);
        else if (are_codes)
            widen_16(at, format->code_max, some, codes + i);
        else
            encoded(&encode, &r, at, some, codes + i);
    }
}
