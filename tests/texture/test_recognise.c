/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Depth images: which lattice their samples are on, and what window depths and codes they hold. */

#include <gmp.h>

#include "core/recognise_lattice.h"
#include "oracle.h"
#include "support.h"
#include "texture/recognise.h"

enum { SIDE = 64, SAMPLES = SIDE * SIDE };
static char why[RECOGNISE_WHY_SIZE];

/* A square image, in one channel. */
typedef struct square {
    image img;
    union {
        uint8_t u8[SAMPLES];
        uint16_t u16[SAMPLES];
        uint32_t u32[SAMPLES];
        float f32[SAMPLES];
        double f64[SAMPLES];
    } data;
} square;

static square *square_of(image_type type) {
    square *s = calloc(1, sizeof *s);
    assert_non_null(s);
    s->img = (image){.width = SIDE, .height = SIDE, .channels = 1, .type = type, .file = IMAGE_NPY, .data = &s->data};
    return s;
}

static dp_format format_of(const char *name) {
    dp_format f[2];
    assert_int_equal(dp_format_parse(name, f), 1);
    return f[0];
}

/* The depth of a code, by the definition alone. */
static double value_of(const dp_format *format, uint32_t code) {
    mpq_t q;
    mpq_init(q);
    oracle_value(q, format, code);
    const double value = oracle_double(q);
    mpq_clear(q);
    return value;
}

static float next_float(float x, int steps) {
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    bits += (uint32_t)steps;
    memcpy(&x, &bits, sizeof bits);
    return x;
}

/* ---- Lattices -----------------------------------------------------------------------------------------------------*/

static void expect(const square *s, const char *format, bool certain, int reversed) {
    dp_recognised r;
    recognise(&s->img, &r, why);
    if (!r.depth || strcmp(r.format.name, format) != 0 || r.certain != certain || r.reversed != reversed)
        fail_msg("wanted %s, certain %d, reversed %d; got depth %d %s, certain %d, reversed %d: %s", format, certain,
                 reversed, r.depth, r.format.name, r.certain, r.reversed, why);
    assert_int_equal(r.samples, SAMPLES);
    assert_int_equal(r.invalid, 0);
}

static const char *const names[] = {"fp16", "unorm16", "unorm24", "fp32"};

/* Codes of the format at the bottom of the range (reversed) or at the top, with the sky's code at the end. */
static uint32_t code_at(rng *r, const dp_format *f, bool reversed, bool sky) {
    if (sky)
        return reversed ? 0 : f->code_max;
    const double d = rng_uniform(r, 0.001, 0.2);
    return dp_format_encode(f, DP_ROUND_NEAREST, reversed ? d : 1 - d);
}

TEST(float_lattices) {
    rng r = rng_make("float lattices");
    for (int wide = 0; wide < 2; wide++)
        for (size_t k = 0; k < 4; k++)
            for (int reversed = 0; reversed < 2; reversed++)
                for (int off = -1; off <= 1; off++) {
                    const dp_format f = format_of(names[k]);
                    square *s = square_of(wide ? IMAGE_F64 : IMAGE_F32);
                    for (int i = 0; i < SAMPLES; i++) {
                        const double value = value_of(&f, code_at(&r, &f, reversed != 0, i % 4 == 0));
                        const bool neighbour = k != 0 && i % 4 == 1; /* a driver's product with the reciprocal */
                        const float narrow = next_float((float)value, neighbour ? off : 0);
                        if (wide && (k == 1 || k == 2)) /* of quotients rounded to double */
                            s->data.f64[i] = value;
                        else if (wide)
                            s->data.f64[i] = (double)narrow;
                        else
                            s->data.f32[i] = narrow;
                    }
                    /* All of [1/4, 1] is within 1 ulp of unorm24 in binary32. */
                    const bool blurred = !wide && !reversed && k >= 2;
                    const char *name = blurred || (wide && !reversed && k == 3) ? "unorm24" : names[k];
                    expect(s, name, !blurred && strcmp(name, names[k]) == 0, reversed);
                    free(s);
                }
}

/* One sample off, and the next finer lattice that holds it is named. */
TEST(one_off) {
    rng r = rng_make("one off");
    static const struct {
        const char *from;
        float sample;
        const char *to;
    } rows[] = {
        {"fp16", 0x1.002p-3F, "unorm24"}, /* all multiples of 2^-24 are within 1 ulp of a code of unorm24 */
        {"fp16", 0x1.00001p-7F, "fp32"},    {"fp16", 0x1.8p-24F, "fp32"}, /* between subnormals */
        {"unorm16", 0.1F, "fp32"},          {"unorm16", 0x1.000002p-10F, "fp32"},
        {"unorm24", 0x1.00001p-6F, "fp32"}, /* a quarter of a code off */
    };
    for (size_t k = 0; k < sizeof rows / sizeof rows[0]; k++) {
        const dp_format f = format_of(rows[k].from);
        square *s = square_of(IMAGE_F32);
        for (int i = 0; i < SAMPLES; i++)
            s->data.f32[i] = (float)value_of(&f, code_at(&r, &f, true, i % 4 == 0));
        expect(s, rows[k].from, true, 1);
        const int at = (int)rng_below(&r, SAMPLES);
        s->data.f32[at] = rows[k].sample;
        expect(s, rows[k].to, true, 1);
        dp_recognised found;
        recognise(&s->img, &found, why);
        if (strcmp(rows[k].to, "fp32") == 0 &&
            (strstr(why, "1 of 4096 samples are off the lattice of ") == NULL || strstr(why, rows[k].from) == NULL))
            fail_msg("row %zu: %s", k, why);
        /* A code of unorm24 beside those of unorm16. */
        if (strcmp(rows[k].from, "unorm16") == 0) {
            const dp_format finer = format_of("unorm24");
            s->data.f32[at] = (float)value_of(&finer, 100 * 257 + 128);
            recognise(&s->img, &found, why);
            assert_string_equal(found.format.name, "fp32"); /* unorm16's are not unorm24's */
        }
        free(s);
    }
}

/* Two ulp beside a code is beside the lattice. */
TEST(two_ulp) {
    const dp_format f = format_of("unorm24");
    for (int steps = -2; steps <= 2; steps++) {
        square *s = square_of(IMAGE_F32);
        for (uint32_t i = 0; i < SAMPLES; i++)
            s->data.f32[i] = next_float((float)value_of(&f, 1000 + 7 * i), steps);
        expect(s, steps == 2 || steps == -2 ? "fp32" : "unorm24", true, 1);
        free(s);
    }
}

/* Every code of every named lattice is recognised as one, whether divided or multiplied with the reciprocal. */
TEST(all_codes) {
    tally t = {.name = "all codes"};
    square *s = square_of(IMAGE_F32);
    for (size_t k = 0; k < 3; k++) {
        const dp_format f = format_of(names[k]);
        const uint32_t stride = k < 2 ? 1 : (uint32_t)test_cases(997, 61, 1);
        const float reciprocal = 1.0F / (float)f.code_max;
        for (int multiplied = 0; multiplied < (k == 0 ? 1 : 2); multiplied++)
            for (uint32_t code = 0; code <= f.code_max;) {
                for (int i = 0; i < SAMPLES; i++) {
                    const uint32_t c = code <= f.code_max ? code : f.code_max;
                    const float product = (float)c * reciprocal;
                    s->data.f32[i] = !multiplied ? (float)((double)c / (double)f.code_max) : product < 1 ? product : 1;
                    if (k == 0)
                        s->data.f32[i] = (float)dp_format_value(&f, c);
                    code += stride;
                }
                dp_recognised found;
                recognise(&s->img, &found, why);
                size_t at = 0;
                while (strcmp(names[at], found.format.name) != 0)
                    at++;
                TALLY(&t, found.depth && at <= k, "%s near %u%s: %s", names[k], code, multiplied ? " multiplied" : "",
                      why);
            }
    }
    free(s);
    tally_end(&t);
}

/* The shares that the header gives, of numbers without a lattice and of codes of unorm24, counted. */
TEST(chances) {
    enum { BLOCK = 4096 };
    const uint64_t blocks = test_cases(64, 512, 2048);
    rng r = rng_make("chances");
    for (int e = -1; e >= -9; e -= 2)
        for (int source = 0; source < 2; source++) {
            size_t off[DP_LATTICE_COUNT] = {0};
            for (uint64_t k = 0; k < blocks; k++) {
                double d[BLOCK];
                for (int i = 0; i < BLOCK; i++) {
                    const double x = ldexp(rng_uniform(&r, 1, 2), e);
                    d[i] = (double)(float)(source == 0 ? x : floor(x * 16777215) / 16777215);
                }
                dp_lattice_single(d, BLOCK, off);
            }
            const double n = (double)(blocks * BLOCK);
            for (int k = 0; k < (source == 0 ? DP_LATTICE_FP32 : DP_LATTICE_UNORM24); k++) {
                const double claim = dp_lattice_chance((dp_lattice)k, true, ldexp(1.5, e));
                const double share = (n - (double)off[k]) / n, noise = 6 * sqrt(claim / n);
                if (share > claim + noise || (source == 0 && share < claim - noise - claim / 1000))
                    fail_msg("%s at 2^%d: %g of the numbers, claimed %g", dp_lattice_name((dp_lattice)k), e, share,
                             claim);
            }
        }
    assert_true(dp_lattice_chance(DP_LATTICE_UNORM24, true, 0) == 1 &&
                dp_lattice_chance(DP_LATTICE_FP16, true, 1) == 1);
    assert_true(dp_lattice_chance(DP_LATTICE_FP32, true, 0.01) == 1);
    assert_relative(dp_lattice_chance(DP_LATTICE_UNORM24, false, 0.6), 3 * 0x1p-53 * 16777215, 1e-15);
}

TEST(too_few) {
    const dp_format f = format_of("unorm24");
    square *s = square_of(IMAGE_F32);
    for (int different = 1; different <= 2 * DP_RECOGNISE_LEAST; different++) {
        for (int i = 0; i < SAMPLES; i++)
            s->data.f32[i] = (float)value_of(&f, 4001 + (uint32_t)(i % different) * 13);
        expect(s, "unorm24", different >= DP_RECOGNISE_LEAST, 1);
    }
    const double bits = -log2(3 * 0x1p-26 * f.code_max); /* that one of [1/8, 1/4) tells: 155 of them are enough */
    for (int different = 100; different <= 200; different++) {
        for (int i = 0; i < SAMPLES; i++)
            s->data.f32[i] = (float)value_of(&f, 2500000 + (uint32_t)(i % different) * 13);
        expect(s, "unorm24", different * bits > DP_RECOGNISE_BITS, 1);
    }
    for (int i = 0; i < SAMPLES; i++)
        s->data.f32[i] = i % 2 ? 0 : 1;
    expect(s, "fp16", false, -1);
    free(s);
}

/* ---- Integers -----------------------------------------------------------------------------------------------------*/

static void fill(square *s, uint32_t lo, uint32_t hi, uint32_t first) {
    for (uint32_t i = 0; i < SAMPLES; i++) {
        const uint32_t x = i == 0 ? first : lo + (uint32_t)((uint64_t)(hi - lo) * i / (SAMPLES - 1));
        if (s->img.type == IMAGE_U8)
            s->data.u8[i] = (uint8_t)x;
        else if (s->img.type == IMAGE_U16 || s->img.type == IMAGE_F16)
            s->data.u16[i] = (uint16_t)x;
        else
            s->data.u32[i] = x;
    }
}

TEST(integers) {
    static const struct {
        image_type type;
        uint32_t lo, hi, first;
        const char *format; /* null: no depth */
        bool certain;
        int reversed;
        const char *why; /* a part */
    } rows[] = {
        {IMAGE_U8, 200, 255, 255, "unorm16", false, 0, "shares of 255"},
        {IMAGE_U16, 60000, 65535, 65535, "unorm16", false, 0,
         "codes of unorm16 up to 65535, fp16 has none above 15360"},
        {IMAGE_U16, 0, 15361, 0, "unorm16", false, 1, "codes of unorm16 up to 15361"},
        {IMAGE_U16, 0, 15360, 0, "unorm16", false, 1, "codes up to 15360, which is 1 in fp16, of unorm16 or of fp16"},
        {IMAGE_U16, 0, 9000, 0, "unorm16", false, 1, "codes up to 9000, of unorm16 or of fp16"},
        {IMAGE_U16, 0, 0, 65535, "unorm16", false, -1, "16 bits that repeat 8"},
        {IMAGE_U32, 0, 9000, 0, "unorm16", false, 1, "codes up to 9000, of unorm16 or of unorm24"},
        {IMAGE_U32, 60000, 65534, 65534, "unorm16", false, 0, "of unorm16 or of unorm24"},
        {IMAGE_U32, 60000, 65535, 65535, "unorm16", true, 0, "codes up to 65535, of unorm16;"},
        {IMAGE_U32, 65535, 65535, 0, "unorm16", false, -1, "codes up to 65535"},
        {IMAGE_U32, 0, 65536, 0, "unorm24", true, 1, "codes of unorm24 up to 65536"},
        {IMAGE_U32, 16000000, 0xFFFFFF, 0xFFFFFF, "unorm24", true, 0, "codes of unorm24 up to 16777215"},
        {IMAGE_U32, 0x3A000000, 0x3E800000, 0, "fp32", true, 1, "bits of fp32"},
        {IMAGE_U32, 0x3F400001, 0x3F800000, 0x3F800000, "fp32", true, 0, "bits of fp32"},
        {IMAGE_U32, 0, 0x1000000, 0, NULL, false, -1, "whole numbers up to 16777216 are codes of no named format"},
        {IMAGE_U32, 0x80000000, 0xFFFFFFFF, 0, NULL, false, -1, "bits of fp32 end at 1065353216"},
        {IMAGE_U32, 0x01000001, 0x01FFFFFF, 0x01000000, NULL, false, -1, "take & 0xFFFFFF first"},
        {IMAGE_U32, 0xFF000001, 0xFFFFFFFF, 0xFF000000, NULL, false, -1, "take & 0xFFFFFF first"},
        {IMAGE_F16, 0x3B01, 0x3C00, 0x3C00, "fp16", false, 0, "numbers of fp16, or rounded to it"},
        {IMAGE_F16, 0, 0x3300, 0x8000, "fp16", false, 1, "sky at 0"},
        {IMAGE_F16, 0, 0x3C01, 0, NULL, false, -1,
         "no window depth: 1 of 4096 samples are not in [0, 1], finite ones go from 0 to 1.00098"},
    };
    for (size_t k = 0; k < sizeof rows / sizeof rows[0]; k++) {
        square *s = square_of(rows[k].type);
        dp_recognised r;
        fill(s, rows[k].lo, rows[k].hi, rows[k].first);
        if (rows[k].format != NULL && strstr(rows[k].why, "sky") != NULL)
            fill(s, rows[k].lo, rows[k].lo + 1, rows[k].first);
        recognise(&s->img, &r, why);
        const bool right = rows[k].format == NULL ? !r.depth
                                                  : r.depth && strcmp(r.format.name, rows[k].format) == 0 &&
                                                        r.certain == rows[k].certain && r.reversed == rows[k].reversed;
        if (rows[k].lo == rows[k].hi && rows[k].format != NULL) /* both ends are in every format */
            assert_false(r.proved);
        if (!right || strstr(why, rows[k].why) == NULL)
            fail_msg("row %zu: depth %d, %s, certain %d, reversed %d: %s", k, r.depth, r.format.name, r.certain,
                     r.reversed, why);
        free(s);
    }
}

/* Widened bytes, and the packing of OpenGL with the stencil in the low byte. */
TEST(packings) {
    square *s = square_of(IMAGE_U16);
    dp_recognised r;
    for (uint32_t i = 0; i < SAMPLES; i++)
        s->data.u16[i] = (uint16_t)(i % 256 * 257);
    recognise(&s->img, &r, why);
    assert_true(r.depth && !r.certain && strstr(why, "16 bits that repeat 8") != NULL);
    s->img.type = IMAGE_U32;
    for (uint32_t stencil = 0; stencil < 256; stencil += 255)
        for (uint32_t most = 0x3F; most < 0x100; most += 0x40) {
            for (uint32_t i = 0; i < SAMPLES; i++)
                s->data.u32[i] = ((most << 24) - 0x101 * i) / 256 * 256 + stencil;
            recognise(&s->img, &r, why);
            assert_true(!r.depth && r.invalid == SAMPLES && strstr(why, "shift right by 8 first") != NULL);
        }
    for (uint32_t i = 0; i < SAMPLES; i++) /* low bytes that differ in a bit */
        s->data.u32[i] = 0x3A000000 + i * 0x180;
    recognise(&s->img, &r, why);
    assert_true(r.depth && strcmp(r.format.name, "fp32") == 0);
    for (uint32_t i = 0; i < SAMPLES; i++) /* fp16 in the bits of fp32: its low bytes are equal too */
        s->data.u32[i] = 0x3E000000 + i % 0xC00 * 0x2000;
    recognise(&s->img, &r, why);
    assert_string_equal(r.format.name, "fp32");
    assert_true(r.depth);
    free(s);
}

/* ---- What is no window depth, and which way it runs ---------------------------------------------------------------*/

TEST(no_depth) {
    static const struct {
        float a, b;
        size_t invalid;
        const char *why;
    } rows[] = {
        {2.5F, 100, SAMPLES,
         "no window depth: 4096 of 4096 samples are not in [0, 1], finite ones go from 2.5 to 100: metric depth? "
         "--metric 1m reads 2.5 to 100 m or --stereo middlebury 3.42 to 6.06 m"},
        {-1, 0.5F, SAMPLES / 2, "finite ones go from -1 to 0.5: OpenGL's NDC?"},
        {-7, 0.5F, SAMPLES / 2, "finite ones go from -7 to 0.5"},
        {(float)NAN, (float)INFINITY, SAMPLES, "no window depth: no sample is finite"},
        {1.0000001F, 0.5F, SAMPLES / 2, "2048 of 4096"},
        {-1e-45F, 0.5F, SAMPLES / 2, "2048 of 4096"},
    };
    for (size_t k = 0; k < sizeof rows / sizeof rows[0]; k++)
        for (int wide = 0; wide < 2; wide++) {
            square *s = square_of(wide ? IMAGE_F64 : IMAGE_F32);
            for (int i = 0; i < SAMPLES; i++) {
                const float x = i % 2 ? rows[k].a : rows[k].b;
                if (wide)
                    s->data.f64[i] = (double)x;
                else
                    s->data.f32[i] = x;
            }
            dp_recognised r;
            recognise(&s->img, &r, why);
            assert_false(r.depth);
            assert_false(r.certain);
            assert_int_equal(r.reversed, -1);
            assert_int_equal(r.invalid, rows[k].invalid);
            if (strstr(why, rows[k].why) == NULL)
                fail_msg("'%s' is not in '%s'", rows[k].why, why);
            if (r.invalid == SAMPLES)
                assert_true(isnan(r.lo) && isnan(r.hi));
            else
                assert_true(r.lo == 0.5 && r.hi == 0.5);
            free(s);
        }
}

/* Numbers with a sign are OpenGL's where all of them are from -1 to 1, and no others. */
TEST(normalized_device) {
    square *s = square_of(IMAGE_F32);
    for (int least = -20; least < 0; least++)
        for (int most = 0; most <= 12; most++) {
            for (int i = 0; i < SAMPLES; i++)
                s->data.f32[i] = (float)(i % 2 ? least : most) / 4;
            dp_recognised r;
            recognise(&s->img, &r, why);
            if (r.depth || (strstr(why, "OpenGL's NDC?") != NULL) != (least >= -4 && most <= 4))
                fail_msg("from %g to %g: %s", least / 4.0, most / 4.0, why);
        }
    free(s);
}

/* Holes are no hindrance: NaN and infinities, of all types that have them. */
TEST(holes) {
    for (int type = IMAGE_F16; type <= IMAGE_F64; type++) {
        square *s = square_of((image_type)type);
        for (int i = 0; i < SAMPLES; i++) {
            const double x = i % 4 == 1 ? NAN : i % 4 == 3 ? INFINITY : 0.25 + i / (4.0 * SAMPLES);
            if (type == IMAGE_F16)
                s->data.u16[i] = i % 4 == 1 ? 0x7E00 : i % 4 == 3 ? 0x7C00 : (uint16_t)(0x3000 + i % 0x800);
            else if (type == IMAGE_F32)
                s->data.f32[i] = (float)x;
            else
                s->data.f64[i] = x;
        }
        dp_recognised r;
        recognise(&s->img, &r, why);
        if (!r.depth || r.holes != SAMPLES / 2 || r.invalid != SAMPLES / 2)
            fail_msg("%s: depth %d, %zu holes of %zu invalid: %s", image_type_name((image_type)type), r.depth, r.holes,
                     r.invalid, why);
        free(s);
    }
}

/* Nine of ten, no fewer. */
TEST(nine_of_ten) {
    for (int reversed = 0; reversed < 2; reversed++)
        for (int percent = 85; percent <= 95; percent++) {
            square *s = square_of(IMAGE_F32);
            for (int i = 0; i < SAMPLES; i++) {
                const double d = (i * 100LL < percent * (long long)SAMPLES ? 0.1 : 0.5) + i * 1e-6;
                s->data.f32[i] = (float)(reversed ? d : 1 - d);
            }
            dp_recognised r;
            recognise(&s->img, &r, why);
            assert_int_equal(r.reversed, percent >= 90 ? reversed : -1);
            assert_false(r.direction);
            free(s);
        }
}

TEST(directions) {
    static const struct {
        double lo, hi; /* of the mass */
        int zeros, ones;
        int reversed;
        const char *why;
    } rows[] = {
        {0.8, 0.99, 0, 0, 0, "most are above 3/4: likely not reversed"},
        {0.01, 0.2, 0, 0, 1, "most are below 1/4: likely reversed"},
        {0.8, 0.99, 0, 900, 0, "most are above 3/4, sky at 1: not reversed"},
        {0.01, 0.2, 900, 0, 1, "most are below 1/4, sky at 0: reversed"},
        {0.8, 0.99, 900, 0, -1, "near 1 but sky at 0: no direction"},
        {0.01, 0.2, 0, 900, -1, "near 0 but sky at 1: no direction"},
        {0.01, 0.2, 900, 100, 1, "sky at 0: likely reversed"},
        {0.01, 0.2, 300, 100, 1, "most are below 1/4: likely reversed"},
        {0.01, 0.2, 0, 4, 1, "most are below 1/4: likely reversed"},
        {0.01, 0.99, 0, 0, -1, "neither sky nor mass shows a direction"},
        {0.26, 0.49, 0, 0, -1, "neither sky nor mass shows a direction"},
        {0.51, 0.74, 0, 0, -1, "neither sky nor mass shows a direction"},
        {0.01, 0.99, 900, 0, 1, "sky at 0: likely reversed"},
        {0.01, 0.99, 0, 900, 0, "sky at 1: likely not reversed"},
        {0.01, 0.99, 900, 900, -1, "neither sky nor mass shows a direction"},
        {0.5, 0.5, SAMPLES, 0, -1, "nothing drawn shows a direction"},
        {0.5, 0.5, 0, SAMPLES, -1, "nothing drawn shows a direction"},
    };
    square *s = square_of(IMAGE_F32);
    for (size_t k = 0; k < sizeof rows / sizeof rows[0]; k++) {
        for (int i = 0; i < SAMPLES; i++)
            s->data.f32[i] = i < rows[k].zeros ? 0
                             : i < rows[k].zeros + rows[k].ones
                                 ? 1
                                 : (float)(rows[k].lo + (rows[k].hi - rows[k].lo) * i / SAMPLES);
        dp_recognised r;
        recognise(&s->img, &r, why);
        assert_int_equal(r.at_zero, rows[k].zeros);
        assert_int_equal(r.at_one, rows[k].ones);
        if (r.reversed != rows[k].reversed || strstr(why, rows[k].why) == NULL)
            fail_msg("row %zu: %d, %s", k, r.reversed, why);
    }
    free(s);
}

/* Counting against a plain count, on an odd shape whose rows are longer than a block. */
TEST(counted) {
    enum { WIDTH = 5003, HEIGHT = 6, COUNT = WIDTH * HEIGHT };
    rng r = rng_make("counted");
    double *d = malloc(COUNT * sizeof *d);
    assert_non_null(d);
    for (uint32_t channels = 1; channels <= 3; channels++) {
        const image img = {.width = WIDTH / channels,
                           .height = HEIGHT,
                           .channels = channels,
                           .type = IMAGE_F64,
                           .file = IMAGE_NPY,
                           .data = d};
        const size_t pixels = (size_t)img.width * HEIGHT;
        size_t zero = 0, one = 0, invalid = 0;
        double lo = 2, hi = -1;
        for (size_t i = 0; i < pixels; i++) {
            const double x = (double)rng_below(&r, 120) / 100 - 0.05;
            for (uint32_t c = 0; c < channels; c++)
                d[i * channels + c] = c == 0 ? x : (double)NAN;
            zero += x == 0;
            one += x == 1;
            invalid += !(x >= 0 && x <= 1);
            lo = x >= 0 && x < lo ? x : lo;
            hi = x <= 1 && x > hi ? x : hi;
        }
        dp_recognised found;
        recognise(&img, &found, why);
        assert_int_equal(found.samples, pixels);
        assert_int_equal(found.at_zero, zero);
        assert_int_equal(found.at_one, one);
        assert_int_equal(found.invalid, invalid);
        assert_true(found.lo == lo && found.hi == hi);
    }
    for (int i = 0; i < COUNT; i++)
        d[i] = (i % 777) / 1000.0;
    const image img = {
        .width = WIDTH, .height = HEIGHT, .channels = 1, .type = IMAGE_F64, .file = IMAGE_NPY, .data = d};
    dp_recognised found;
    recognise(&img, &found, why);
    assert_int_equal(found.distinct, 777);
    free(d);
}

/* ---- The library's function -------------------------------------------------------------------------------------- */

static uint64_t slots[DP_RECOGNISE_SLOTS];

/* Codes in a row, their values by definition. */
static const struct {
    const char *format;
    uint32_t first, different;
    double most; /* that is 1; 0: binary16 of the binade of first */
    dp_reason reason;
    bool proved;
} typed[DP_IMAGE_TYPE_COUNT] = {
    [DP_IMAGE_U8] = {"unorm16", 10, 201, 255, DP_REASON_BYTES, false},
    [DP_IMAGE_U16] = {"unorm16", 20000, 777, 65535, DP_REASON_WORDS, false},
    [DP_IMAGE_U32] = {"unorm24", 70000, 777, 16777215, DP_REASON_LONGS_24, true},
    [DP_IMAGE_F16] = {"fp16", 0x2C00, 777, 0, DP_REASON_HALVES, false},
    [DP_IMAGE_F32] = {"unorm16", 1000, 777, 65535, DP_REASON_LATTICE, true},
    [DP_IMAGE_F64] = {"unorm24", 1000, 777, 16777215, DP_REASON_LATTICE, true},
};

static double typed_value(int type, uint32_t code) {
    const double value = typed[type].most > 0 ? code / typed[type].most : 0x1p-4 * (1 + (code - 0x2C00) / 1024.0);
    return type == DP_IMAGE_F32 ? (double)(float)value : value;
}

typedef enum content { A_CODE, A_HOLE, ANOTHER } content; /* the last: of another channel, no depth either */

static void store(void *data, int type, size_t at, uint32_t code, content of) {
    static const size_t sizes[] = {1, 2, 4, 2, 4, 8};
    const double x = of == A_HOLE ? (double)NAN : of == ANOTHER ? -2.5 : typed_value(type, code);
    const float narrow = (float)x;
    const uint32_t half = of == A_HOLE ? 0x7C00 : 0xC100, bits = of == A_CODE           ? code
                                                                 : type == DP_IMAGE_F16 ? half
                                                                                        : UINT32_MAX;
    unsigned char *to = (unsigned char *)data + at * sizes[type];
    if (type == DP_IMAGE_F32)
        memcpy(to, &narrow, sizeof narrow);
    else if (type == DP_IMAGE_F64)
        memcpy(to, &x, sizeof x);
    else if (type == DP_IMAGE_U32)
        memcpy(to, &bits, sizeof bits);
    else if (type == DP_IMAGE_U8)
        *to = (uint8_t)bits;
    else
        memcpy(to, &(const uint16_t){(uint16_t)bits}, sizeof(uint16_t));
}

/* Each type in rows of any length, between other channels; every fourth number is a hole. */
TEST(each_type_and_stride) {
    static const size_t shapes[][2] = {{SAMPLES, 1}, {1, SAMPLES}, {SIDE, SIDE}};
    double *data = malloc(4 * SAMPLES * sizeof *data);
    assert_non_null(data);
    for (int type = 0; type < DP_IMAGE_TYPE_COUNT; type++)
        for (size_t stride = 1; stride <= 4; stride++)
            for (size_t k = 0; k < 3; k++) {
                const uint32_t last = typed[type].first + typed[type].different - 1;
                const dp_image img = {data, (dp_image_type)type, shapes[k][0], shapes[k][1], stride};
                const bool numbers = type >= DP_IMAGE_F16, codes = type <= DP_IMAGE_U32;
                dp_recognised r;
                for (size_t i = 0; i < stride * SAMPLES; i++)
                    store(data, type, i, typed[type].first + (uint32_t)(i / stride % typed[type].different),
                          i % stride > 0                   ? ANOTHER
                          : numbers && i / stride % 4 == 3 ? A_HOLE
                                                           : A_CODE);
                assert_int_equal(dp_recognise(&img, NULL, slots, &r), DP_OK);
                if (!r.depth || strcmp(r.format.name, typed[type].format) != 0 || r.reason != typed[type].reason ||
                    r.proved != typed[type].proved || r.certain != r.proved || r.samples != SAMPLES ||
                    r.holes != (numbers ? SAMPLES / 4 : 0) || r.invalid != r.holes ||
                    r.distinct != typed[type].different || r.steps != (type == DP_IMAGE_U8 ? 255 : 0))
                    fail_msg(
                        "type %d, stride %zu: %s, reason %d, proved %d, %zu of %zu invalid, %zu different, steps %g",
                        type, stride, r.format.name, r.reason, r.proved, r.invalid, r.samples, r.distinct, r.steps);
                assert_true(r.lo == typed_value(type, typed[type].first) && r.hi == typed_value(type, last));
                assert_true(r.least == (codes ? typed[type].first : r.lo) && r.greatest == (codes ? last : r.hi));
                assert_true(r.at_zero == 0 && r.at_one == 0 && r.sky == -1 && !r.metric && !r.direction);
            }
    free(data);
}

/* One sample that is less, greater, or no byte twice, decides wherever in an image it lies. */
TEST(one_sample_decides) {
    enum { MANY = 1300 };
    static uint32_t longs[MANY];
    static uint16_t shorts[MANY];
    static uint8_t bytes[MANY];
    void *const data[] = {bytes, shorts, longs};
    rng r = rng_make("one sample");
    for (uint64_t n = test_cases(200, 1000, 20000); n > 0; n--) {
        const int type = (int)rng_below(&r, 3);
        const dp_image img = {data[type], (dp_image_type)type, MANY, 1, 1};
        const size_t least = rng_below(&r, MANY), greatest = rng_below(&r, MANY), odd = rng_below(&r, MANY);
        const bool has_odd = rng_below(&r, 2) == 0 && odd != least && odd != greatest && type == DP_IMAGE_U16;
        if (least == greatest)
            continue;
        for (size_t i = 0; i < MANY; i++) {
            const uint32_t byte = i == least ? 11 : i == greatest ? 240 : 99;
            bytes[i] = (uint8_t)byte;
            shorts[i] = (uint16_t)(byte * 0x101 + (has_odd && i == odd ? 1 : 0));
            longs[i] = byte;
        }
        const uint32_t scale = type == DP_IMAGE_U16 ? 0x101 : 1;
        dp_recognised found;
        assert_int_equal(dp_recognise(&img, NULL, slots, &found), DP_OK);
        assert_true(found.least == 11 * scale && found.greatest == 240 * scale);
        if (type == DP_IMAGE_U16)
            assert_int_equal(found.reason == DP_REASON_WIDENED, !has_odd);
    }
}

TEST(no_samples) {
    for (int type = 0; type < DP_IMAGE_TYPE_COUNT; type++)
        for (size_t width = 0; width < 2; width++) {
            const dp_image none = {NULL, (dp_image_type)type, width, 1 - width, 1};
            dp_recognised r;
            assert_int_equal(dp_recognise(&none, NULL, slots, &r), DP_OK);
            assert_true(!r.depth && !r.certain && r.reason == DP_REASON_EMPTY && r.samples == 0 && r.invalid == 0);
            assert_true(isnan(r.lo) && isnan(r.hi) && isnan(r.least) && isnan(r.greatest) && r.reversed == -1);
        }
}

TEST(arguments) {
    static const uint32_t codes[] = {7, 8, 9};
    const dp_image good = {codes, DP_IMAGE_U32, 3, 1, 1}, bare = {NULL, DP_IMAGE_U32, 3, 1, 1};
    const dp_image odd = {codes, DP_IMAGE_TYPE_COUNT, 3, 1, 1};
    const dp_format narrow = format_of("unorm10"), known = format_of("unorm24");
    dp_recognised r = {.samples = 77};
    assert_int_equal(dp_recognise(NULL, NULL, slots, &r), DP_ERROR_NULL);
    assert_int_equal(dp_recognise(&good, NULL, slots, NULL), DP_ERROR_NULL);
    assert_int_equal(dp_recognise(&bare, NULL, slots, &r), DP_ERROR_NULL);
    assert_int_equal(dp_recognise(&odd, NULL, slots, &r), DP_ERROR_BATCH);
    assert_int_equal(dp_recognise(&good, &narrow, slots, &r), DP_ERROR_FORMAT);
    assert_int_equal(r.samples, 77);
    assert_int_equal(dp_recognise(&good, NULL, slots, &r), DP_OK);
    assert_true(strcmp(r.format.name, "unorm16") == 0 && !r.certain && r.distinct == 3 && r.hi == 9 / 65535.0);
    assert_int_equal(dp_recognise(&good, &known, slots, &r), DP_OK);
    assert_true(strcmp(r.format.name, "unorm24") == 0 && r.certain && r.hi == 9 / 16777215.0);
    assert_true(r.reason == DP_REASON_GIVEN && r.greatest == 9);
}

/* Without memory no value is counted; with it, up to a limit, with which steps are not looked for. */
TEST(counted_in_slots) {
    enum { COUNT = 80000, SKY = COUNT / 8 };
    static const uint16_t millimetres[] = {0, 0, 500, 700, 900};
    const dp_image sensor = {millimetres, DP_IMAGE_U16, 5, 1, 1};
    double *d = malloc(COUNT * sizeof *d);
    assert_non_null(d);
    for (int i = 0; i < COUNT; i++)
        d[i] = i < SKY ? 0 : i / 16777215.0;
    const dp_image img = {d, DP_IMAGE_F64, COUNT, 1, 1};
    for (int with = 0; with < 2; with++) {
        dp_recognised r;
        assert_int_equal(dp_recognise(&img, NULL, with ? slots : NULL, &r), DP_OK);
        assert_true(strcmp(r.format.name, "unorm24") == 0 && r.proved == with && r.steps == 0);
        assert_int_equal(r.distinct, with ? DP_RECOGNISE_DISTINCT : 0);
        assert_true(r.at_zero == SKY && r.sky == 1 && r.mass == 1 && r.reversed == 1 && r.direction == with);
        assert_int_equal(dp_recognise(&sensor, NULL, with ? slots : NULL, &r), DP_OK);
        assert_true(r.depth && r.metric == with && r.at_zero == 2);
    }
    free(d);
}

/* An image of `levels` as a type of number holds them, each rounded to its bits; 0: numbers without steps. */
static void fill_levels(square *s, int levels, rng *r) {
    const float tiny = 0x1p-24f; /* a step of subnormal halves */
    for (int i = 0; i < SAMPLES; i++) {
        const double x = levels > 0 ? (double)(i % (levels + 1)) / levels : rng_unit(r);
        if (s->img.type == IMAGE_F64)
            s->data.f64[i] = x;
        else if (s->img.type == IMAGE_F32)
            s->data.f32[i] = (float)x;
        else /* the bits of a half, rounded to nearest by the processor's own sums */
            s->data.u16[i] =
                (uint16_t)(x < 0x1p-14 ? nearbyint(x / (double)tiny)
                                       : ldexp((double)(ilogb(x) + 14), 10) + nearbyint(ldexp(x, 10 - ilogb(x))));
    }
}

/* Levels of images of few bits are found in each type that holds them, with the bits that it has; and in numbers
 * without levels none. */
TEST(levels_in_each_type) {
    static const int levels[] = {255, 511, 1023, 0};
    rng r = rng_make("levels");
    for (int type = IMAGE_F16; type <= IMAGE_F64; type++)
        for (size_t k = 0; k < sizeof levels / sizeof levels[0]; k++) {
            square *s = square_of((image_type)type);
            dp_recognised found;
            fill_levels(s, levels[k], &r);
            recognise(&s->img, &found, why);
            if (found.steps != levels[k])
                fail_msg("type %d: %g steps, not %d", type, found.steps, levels[k]);
            free(s);
        }
}

/* Numbers that are proved to be finer than 24 bits, and are steps of ten. */
TEST(steps_are_no_format) {
    float x[1024];
    for (int i = 0; i < 1024; i++)
        x[i] = (float)(i / 1023.0);
    const dp_image img = {x, DP_IMAGE_F32, 1024, 1, 1};
    dp_recognised r;
    assert_int_equal(dp_recognise(&img, NULL, slots, &r), DP_OK);
    assert_true(r.reason == DP_REASON_SINGLES && r.proved && !r.certain && r.steps == 1023 && r.steps_certain);
    assert_true(r.at_zero == 1 && r.at_one == 1 && r.off > 0 && strcmp(r.closest, "unorm24") == 0);
}
