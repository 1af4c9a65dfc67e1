/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pixels without a header: which picture they are, and of what, by files put together here byte by byte. */
#include "image/image.h"
#include "printed.h"

/* `words` of each pixel, the lowest byte first. */
static const char *write_raw(const char *name, uint32_t pixels, uint32_t bytes, uint64_t (*pixel)(uint32_t)) {
    const char *path = scratch_file(name);
    FILE *out = fopen(path, "wb");
    assert_non_null(out);
    for (uint32_t i = 0; i < pixels; i++)
        for (uint32_t b = 0; b < bytes; b++)
            putc((int)(pixel(i) >> 8 * b & 0xFF), out);
    assert_int_equal(fclose(out), 0);
    return path;
}

static uint64_t code_16(uint32_t i) {
    return (uint16_t)(i * 40503U);
}

/* Depths n/z of a reversed buffer, 2^-12 and up. */
static uint32_t float_of(uint32_t i) {
    const float d = (float)(1 + i % 4096) / 4096;
    uint32_t bits;
    memcpy(&bits, &d, sizeof bits);
    return bits;
}

static uint64_t float_32(uint32_t i) {
    return i == 7 ? 0 : float_of(i);
}

static uint64_t float_stencil(uint32_t i) {
    return float_of(i) | (uint64_t)(i % 256) << 32;
}

static uint64_t not_a_depth(uint32_t i) {
    return (i == 100 ? 0x3F800001 : float_of(i)) | (uint64_t)3 << 32;
}

static uint64_t code_24_stencil(uint32_t i) {
    return (i * 2654435761U & 0xFFFFFF) | 0x2A000000;
}

static uint64_t code_24(uint32_t i) {
    return i * 2654435761U & 0xFFFFFF;
}

TEST(what_is_read) {
    static const struct {
        const char *name;
        uint32_t width, height, bytes;
        uint64_t (*pixel)(uint32_t);
        bool given;
        image_type type;
        uint32_t channels;
        const char *says;
    } rows[] = {
        {"a.raw", 1280, 720, 2, code_16, false, IMAGE_U16, 1, NULL},
        {"a.BIN", 1280, 720, 4, float_32, false, IMAGE_F32, 1, "fp32"},
        {"a.bin", 1280, 800, 4, code_24_stencil, false, IMAGE_U32, 1, "unorm24"},
        {"a.Raw", 640, 480, 4, code_24, false, IMAGE_U32, 1, "unorm24"},
        {"a.raw", 1366, 768, 8, float_stencil, false, IMAGE_F32, 2, "fp32"},
        {"a.raw", 31, 17, 2, code_16, true, IMAGE_U16, 1, NULL},
        {"a.raw", 17, 31, 4, float_32, true, IMAGE_F32, 1, "fp32"},
        {"a.raw", 31, 17, 8, float_stencil, true, IMAGE_F32, 2, "fp32"},
    };
    for (size_t k = 0; k < sizeof rows / sizeof rows[0]; k++) {
        const uint32_t count = rows[k].width * rows[k].height;
        const image_asked asked = {.width = rows[k].given ? rows[k].width : 0, .height = rows[k].height};
        image img;
        image_error error;
        if (!image_read_as(write_raw(rows[k].name, count, rows[k].bytes, rows[k].pixel), &asked, &img, &error))
            fail_msg("row %zu: %s", k, error.text);
        assert_int_equal(img.file, IMAGE_RAW);
        assert_true(img.width == rows[k].width && img.height == rows[k].height);
        assert_int_equal(img.type, rows[k].type);
        assert_int_equal(img.channels, rows[k].channels);
        assert_int_equal(img.size_assumed, !rows[k].given);
        assert_true(rows[k].says == NULL ? img.says == NULL : strcmp(img.says, rows[k].says) == 0);
        for (uint32_t i = 0; i < count; i++) {
            const uint64_t want = rows[k].pixel(i);
            uint32_t got = 0;
            memcpy(&got, (char *)img.data + (size_t)i * rows[k].bytes, rows[k].bytes < 4 ? 2 : 4);
            if (rows[k].bytes == 2)
                got = ((uint16_t *)img.data)[i];
            assert_int_equal(got, rows[k].type == IMAGE_U32 ? want & 0xFFFFFF : want & 0xFFFFFFFF);
        }
        image_free(&img);
    }
}

TEST(what_is_refused) {
    static const struct {
        uint32_t pixels, bytes;
        uint64_t (*pixel)(uint32_t);
        uint32_t width, height;
        const char *sentence;
    } rows[] = {
        {1000, 2, code_16, 0, 0, "raw: no usual picture has its 2000 bytes: --size WxH says how many pixels it has"},
        {0, 2, code_16, 0, 0, "raw: no usual picture has its 0 bytes: --size WxH says how many pixels it has"},
        {512 * 512, 2, code_16, 0, 0, "raw: may be 512 x 512 or 256 x 256 pixels: --size says which"},
        {1000, 2, code_16, 100, 11, "raw: 100 x 11 pixels take 2, 4 or 8 bytes each, and it has 2000 bytes in all"},
        {1000, 2, code_16, 20, 5, "raw: 20 x 5 pixels take 2, 4 or 8 bytes each, and it has 2000 bytes in all"},
        {1000, 8, not_a_depth, 50, 20, "raw: pixels of 8 bytes must begin with a binary32 depth from 0 to 1"},
    };
    for (size_t k = 0; k < sizeof rows / sizeof rows[0]; k++) {
        const image_asked asked = {.width = rows[k].width, .height = rows[k].height};
        image img;
        image_error error;
        assert_false(
            image_read_as(write_raw("r.raw", rows[k].pixels, rows[k].bytes, rows[k].pixel), &asked, &img, &error));
        assert_string_equal(error.text, rows[k].sentence);
    }
}

/* A pixel of `edge` among those of `rest`, on either side of what a depth can be. */
static uint32_t edge, rest;

static uint64_t around(uint32_t i) {
    return i == 300 ? edge : rest;
}

TEST(limits_of_depths) {
    static const struct {
        uint32_t edge, rest;
        const char *says;
    } rows[] = {
        {0x2B800000, 0, "fp32"},             /* 2^-40 */
        {0x2B7FFFFF, 0, "unorm24"},          /* the float below */
        {0x3F800000, 0, "fp32"},             /* 1 */
        {0x3F800000, 0x3F800000, "fp32"},    /* a cleared buffer */
        {0x3F800001, 0x3F000000, "unorm24"}, /* the float above 1 */
        {0x80000000, 0x3F000000, "fp32"},    /* -0 */
        {0x80000001, 0x3F000000, "unorm24"}, /* below it */
        {0x7FC00000, 0x3F000000, "unorm24"}, /* NaN */
        {0, 0, "unorm24"},
    };
    for (size_t k = 0; k < sizeof rows / sizeof rows[0]; k++) {
        const image_asked asked = {.width = 20, .height = 20};
        image img;
        image_error error;
        edge = rows[k].edge;
        rest = rows[k].rest;
        if (!image_read_as(write_raw("e.raw", 400, 4, around), &asked, &img, &error))
            fail_msg("row %zu: %s", k, error.text);
        assert_string_equal(img.says, rows[k].says);
        image_free(&img);
    }
}

/* Sizes of screens by their names, and of square maps. */
static const struct {
    const char *name;
    uint32_t width, height;
} screens[] = {
    {"VGA", 640, 480},      {"XGA", 1024, 768},     {"HD", 1280, 720},      {"WXGA", 1280, 800},
    {"SXGA", 1280, 1024},   {"FWXGA", 1366, 768},   {"WXGA+", 1440, 900},   {"HD+", 1600, 900},
    {"UXGA", 1600, 1200},   {"WSXGA+", 1680, 1050}, {"FHD", 1920, 1080},    {"WUXGA", 1920, 1200},
    {"UWFHD", 2560, 1080},  {"QHD", 2560, 1440},    {"WQXGA", 2560, 1600},  {"Retina 15", 2880, 1800},
    {"UWQHD", 3440, 1440},  {"UWQHD+", 3840, 1600}, {"4K UHD", 3840, 2160}, {"5K", 5120, 2880},
    {"8K UHD", 7680, 4320}, {"2^8", 256, 256},      {"2^9", 512, 512},      {"2^10", 1024, 1024},
    {"2^11", 2048, 2048},   {"2^12", 4096, 4096},   {"2^13", 8192, 8192},
};
enum { SCREENS = sizeof screens / sizeof screens[0] };

/* Zeros, as long as pixels of two bytes are. */
static const char *zeros(uint64_t bytes) {
    const char *path = scratch_file("z.raw");
    FILE *out = fopen(path, "wb");
    assert_non_null(out);
    assert_int_equal(fseek(out, (long)bytes - 1, SEEK_SET), 0);
    putc(0, out);
    assert_int_equal(fclose(out), 0);
    return path;
}

TEST(usual_sizes) {
    const image_asked asked = {.width = 0};
    for (int k = 0; k < SCREENS; k++) {
        const uint64_t bytes = (uint64_t)screens[k].width * screens[k].height * 2;
        int other = -1; /* that has as many bytes in wider pixels */
        for (int i = 0; i < SCREENS; i++)
            for (uint64_t wide = 4; wide <= 8; wide *= 2)
                other = (uint64_t)screens[i].width * screens[i].height * wide == bytes ? i : other;
        image img;
        image_error error;
        const bool is_read = image_read_as(zeros(bytes), &asked, &img, &error);
        if (is_read != (other < 0))
            fail_msg("%s: %s", screens[k].name, is_read ? "is read, and may be another" : error.text);
        if (is_read && (img.width != screens[k].width || img.height != screens[k].height || !img.size_assumed))
            fail_msg("%s: read as %u x %u", screens[k].name, (unsigned)img.width, (unsigned)img.height);
        if (is_read) {
            image_free(&img);
            continue;
        }
        char sentence[128];
        snprintf(sentence, sizeof sentence, "raw: may be %u x %u or %u x %u pixels: --size says which",
                 screens[k].width, screens[k].height, screens[other].width, screens[other].height);
        assert_string_equal(error.text, sentence);
    }
}
