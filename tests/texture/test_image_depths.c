/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Samples as window depths and as codes: every type in every format, against one number at a time. */
#include "oracle.h"
#include "support.h"
#include "texture/image_depths.h"

enum { WIDTH = 3001, HEIGHT = 3, SAMPLES = WIDTH * HEIGHT };

static const char *const formats[] = {"fp16",    "fp32",    "unorm16", "unorm24",    "unorm1",
                                      "unorm10", "unorm32", "unorm8",  "float3.3b5", "float8.23b255"};
enum { FORMATS = sizeof formats / sizeof formats[0] };

static dp_format format_of(const char *name) {
    dp_format f[2];
    assert_int_equal(dp_format_parse(name, f), 1);
    return f[0];
}

/* ---- What a sample means, written once more, without the batch ----------------------------------------------------*/

static double half_value(uint16_t bits) {
    const int exponent = bits >> 10 & 31, fraction = bits & 1023;
    const double magnitude = exponent == 31  ? (fraction ? (double)NAN : (double)INFINITY)
                             : exponent == 0 ? ldexp(fraction, -24)
                                             : ldexp(1024 + fraction, exponent - 25);
    return bits >> 15 ? -magnitude : magnitude;
}

static double raw(const image *img, size_t i) {
    switch (img->type) {
    case IMAGE_U8:
        return ((const uint8_t *)img->data)[i];
    case IMAGE_U16:
        return ((const uint16_t *)img->data)[i];
    case IMAGE_U32:
        return ((const uint32_t *)img->data)[i];
    case IMAGE_F16:
        return half_value(((const uint16_t *)img->data)[i]);
    case IMAGE_F32:
        return (double)((const float *)img->data)[i];
    default:
        return ((const double *)img->data)[i];
    }
}

static bool codes_expected(image_type type, const dp_format *f) {
    static const int bits[IMAGE_TYPE_COUNT] = {[IMAGE_U8] = 8, [IMAGE_U16] = 16, [IMAGE_U32] = 32};
    return bits[type] >= f->bits;
}

static double depth_expected(const image *img, const dp_format *f, size_t i) {
    double x = raw(img, i);
    if (codes_expected(img->type, f))
        return x <= f->code_max ? dp_format_value(f, (uint32_t)x) : (double)NAN;
    if (img->type <= IMAGE_U32)
        x /= img->type == IMAGE_U8 ? 255 : img->type == IMAGE_U16 ? 65535 : 4294967295.0;
    return x >= 0 && x <= 1 ? x : (double)NAN;
}

static bool same(double a, double b) {
    return (isnan(a) && isnan(b)) || (a == b && !signbit(a));
}

/* A stretch of a row in both ways. */
static void compare(tally *t, const image *img, const dp_format *f, uint32_t row, uint32_t column, uint32_t count) {
    double d[WIDTH];
    uint32_t codes[WIDTH];
    image_depths(img, f, row, column, count, d);
    image_codes(img, f, row, column, count, codes);
    for (uint32_t i = 0; i < count; i++) {
        const size_t at = ((size_t)row * img->width + column + i) * img->channels;
        const double want = depth_expected(img, f, at);
        const uint32_t code = isnan(want)                    ? UINT32_MAX
                              : codes_expected(img->type, f) ? (uint32_t)raw(img, at)
                                                             : oracle_encode(f, DP_ROUND_NEAREST, want);
        TALLY(t, same(d[i], want) && codes[i] == code, "%s as %s, %u channels, sample %.17g: %.17g %u, not %.17g %u",
              image_type_name(img->type), f->name, img->channels, raw(img, at), d[i], codes[i], want, code);
    }
}

/* Numbers near [0, 1], its ends, and all that are none. */
static void store_number(void *data, image_type type, size_t i, double x) {
    if (type == IMAGE_F32)
        ((float *)data)[i] = (float)x;
    else
        ((double *)data)[i] = x;
}

static void random_numbers(rng *r, void *data, image_type type) {
    static const double odd[] = {0,      -0.0,  1,        1.0000001, 1 + 0x1p-52, 1 - 0x1p-53, -1e-300,
                                 5e-324, 1e-45, HUGE_VAL, -HUGE_VAL, 2,           0.5};
    enum { ODD = sizeof odd / sizeof odd[0] };
    for (size_t i = 0; i < SAMPLES; i++) {
        const uint64_t kind = rng_below(r, 8);
        store_number(data, type, i,
                     kind == 0   ? odd[rng_below(r, ODD)]
                     : kind == 1 ? (double)NAN
                     : kind < 5  ? rng_unit(r)
                                 : rng_log(r, 1e-12, 1));
    }
}

static void random_bits(rng *r, void *data, size_t size, uint32_t most) {
    for (size_t i = 0; i < SAMPLES; i++) {
        const uint64_t bits = i % 8 == 0 ? UINT64_MAX - i % 3 : rng_below(r, (uint64_t)most + 2);
        memcpy((unsigned char *)data + i * size, &bits, size); /* the low byte is first, or all are random alike */
    }
}

TEST(every_type_and_format) {
    tally t = {.name = "every type and format"};
    rng r = rng_make("types and formats");
    void *data = malloc(SAMPLES * sizeof(double));
    assert_non_null(data);
    for (size_t k = 0; k < FORMATS; k++)
        for (int type = 0; type < IMAGE_TYPE_COUNT; type++) {
            const dp_format f = format_of(formats[k]);
            if (type >= IMAGE_F32)
                random_numbers(&r, data, (image_type)type);
            else
                random_bits(&r, data, image_type_size((image_type)type), type == IMAGE_F16 ? 0x3C00 : f.code_max);
            for (uint32_t channels = 1; channels <= 4; channels++) {
                const image img = {.width = WIDTH / channels,
                                   .height = HEIGHT,
                                   .channels = channels,
                                   .type = (image_type)type,
                                   .file = IMAGE_NPY,
                                   .data = data};
                assert_int_equal(image_are_codes(&img, &f), codes_expected((image_type)type, &f));
                for (uint32_t row = 0; row < HEIGHT; row++)
                    compare(&t, &img, &f, row, 0, img.width);
                const uint32_t column = (uint32_t)rng_below(&r, img.width);
                compare(&t, &img, &f, 1, column, 1 + (uint32_t)rng_below(&r, img.width - column));
                compare(&t, &img, &f, HEIGHT - 1, img.width, 0);
            }
        }
    free(data);
    tally_end(&t);
}

/* All of a type's values at a time. */
TEST(all_words) {
    tally t = {.name = "all words"};
    uint16_t *words = malloc(65536 * sizeof *words);
    uint8_t bytes[256];
    assert_non_null(words);
    for (int i = 0; i < 65536; i++)
        words[i] = (uint16_t)i;
    for (int i = 0; i < 256; i++)
        bytes[i] = (uint8_t)i;
    for (size_t k = 0; k < FORMATS; k++) {
        const dp_format f = format_of(formats[k]);
        for (int type = IMAGE_U16; type <= IMAGE_F16; type += IMAGE_F16 - IMAGE_U16) {
            const image img = {
                .width = 2048, .height = 32, .channels = 1, .type = (image_type)type, .file = IMAGE_NPY, .data = words};
            for (uint32_t row = 0; row < 32; row++)
                compare(&t, &img, &f, row, 0, 2048);
        }
        const image img = {
            .width = 256, .height = 1, .channels = 1, .type = IMAGE_U8, .file = IMAGE_PNG, .data = bytes};
        compare(&t, &img, &f, 0, 0, 256);
    }
    free(words);
    tally_end(&t);
}

/* Codes of unorm16 and unorm24 come back from every type that can carry them. */
TEST(codes_return) {
    enum { COUNT = 4096 };
    tally t = {.name = "codes return"};
    for (int k = 0; k < 2; k++) {
        const dp_format f = format_of(k == 0 ? "unorm16" : "unorm24");
        const uint32_t stride = k == 0 ? 1 : (uint32_t)test_cases(997, 61, 1);
        for (uint64_t first = 0; first <= f.code_max; first += COUNT * (uint64_t)stride) {
            uint32_t codes[COUNT], got[COUNT];
            uint16_t words[COUNT];
            float single[COUNT], product[COUNT];
            double wide[COUNT];
            for (uint32_t i = 0; i < COUNT; i++) {
                const uint64_t code = first + (uint64_t)i * stride;
                codes[i] = code < f.code_max ? (uint32_t)code : f.code_max;
                words[i] = (uint16_t)codes[i];
                wide[i] = (double)codes[i] / (double)f.code_max;
                single[i] = (float)wide[i];
                product[i] = (float)codes[i] * (1.0F / (float)f.code_max);
                product[i] = product[i] < 1 ? product[i] : 1;
            }
            const image images[] = {
                {.width = COUNT, .height = 1, .channels = 1, .type = IMAGE_U32, .file = IMAGE_NPY, .data = codes},
                {.width = COUNT, .height = 1, .channels = 1, .type = IMAGE_F64, .file = IMAGE_NPY, .data = wide},
                {.width = COUNT, .height = 1, .channels = 1, .type = IMAGE_F32, .file = IMAGE_NPY, .data = single},
                {.width = COUNT, .height = 1, .channels = 1, .type = IMAGE_F32, .file = IMAGE_NPY, .data = product},
                {.width = COUNT, .height = 1, .channels = 1, .type = IMAGE_U16, .file = IMAGE_PNG, .data = words},
            };
            /* Near 1 a step of binary32 is one of unorm24, so that a rounded product there may be its neighbour. */
            for (int j = 0; j < 5 - k; j++) {
                image_codes(&images[j], &f, 0, 0, COUNT, got);
                for (int i = 0; i < COUNT; i++) {
                    const bool near_one = k == 1 && j == 3 && single[i] >= 0.25F;
                    const uint32_t apart = got[i] > codes[i] ? got[i] - codes[i] : codes[i] - got[i];
                    TALLY(&t, apart <= (near_one ? 1U : 0U), "%s %u in image %d: %u", f.name, codes[i], j, got[i]);
                }
            }
        }
    }
    tally_end(&t);
}

/* Each number of binary16, the second channel being another; infinities are none. */
TEST(each_half) {
    static uint16_t both[2 * 65536];
    const image img = {.data = both, .type = IMAGE_F16, .width = 65536, .height = 1, .channels = 2};
    for (size_t i = 0; i < 65536; i++) {
        both[2 * i] = (uint16_t)i;
        both[2 * i + 1] = (uint16_t)~i;
    }
    for (size_t i = 0; i < 65536; i++) {
        const double want = half_value((uint16_t)i), got = image_sample(&img, i);
        assert_true(isfinite(want) ? got == want : isnan(got));
    }
}
