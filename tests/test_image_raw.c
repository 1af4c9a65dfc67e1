/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pixels without a header: which picture they are, and of what, by files put together here byte by byte. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "printed.h"
#include "support.h"
#include "texture/image.h"

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

static void what_is_read(void **state) {
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
    (void)state;
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

static void what_is_refused(void **state) {
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
    (void)state;
    for (size_t k = 0; k < sizeof rows / sizeof rows[0]; k++) {
        const image_asked asked = {.width = rows[k].width, .height = rows[k].height};
        image img;
        image_error error;
        assert_false(
            image_read_as(write_raw("r.raw", rows[k].pixels, rows[k].bytes, rows[k].pixel), &asked, &img, &error));
        assert_string_equal(error.text, rows[k].sentence);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(what_is_read), cmocka_unit_test(what_is_refused)};
    return run_tap(tests);
}
