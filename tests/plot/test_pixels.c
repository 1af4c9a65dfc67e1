/* SPDX-License-Identifier: GPL-3.0-or-later */
/* PNG of figures, read back by libpng: every pixel, in one band of rows and in many, and the words. */
#include <png.h>

#include "draw/pixels.h"
#include "support.h"

static const notes words = {"a title", "what \xC3\xA9 it shows", "depthprec plot", "", ""};

static void check_words(const char *bytes, size_t size) {
    FILE *in = fmemopen((void *)(uintptr_t)bytes, size, "rb");
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    png_textp text;
    const char *const want[4][2] = {
        {"Title", words.title}, {"Description", words.description}, {"Source", words.command}, {"Comment", words.data}};
    png_init_io(png, in);
    png_read_info(png, info);
    assert_int_equal(png_get_text(png, info, &text, NULL), 4);
    for (int i = 0; i < 4; i++) {
        assert_string_equal(text[i].key, want[i][0]);
        assert_string_equal(text[i].text, want[i][1]);
        assert_int_equal(text[i].compression, PNG_ITXT_COMPRESSION_NONE);
    }
    png_destroy_read_struct(&png, &info, NULL);
    fclose(in);
}

/* kind 0: noise; 1: one colour; 2: rows that repeat from far above, so that bands look back. */
static uint32_t colour_of(rng *r, int kind, int x, int y) {
    return 0xFF000000u | (kind == 0   ? (uint32_t)rng_below(r, 1 << 24)
                          : kind == 1 ? 0x123456
                                      : ((uint32_t)x * 2654435761u ^ (uint32_t)(y % 3) * 40503u) & 0xFFFFFF);
}

static void check(rng *r, int width, int height, int kind, bool holes) {
    const size_t stride = (size_t)width + 5, count = stride * (size_t)height;
    uint32_t *at = malloc(count * sizeof *at);
    unsigned char *got = malloc((size_t)width * (size_t)height * 4);
    char *bytes = NULL;
    size_t size = 0;
    for (size_t i = 0; i < count; i++) {
        const uint32_t colour = colour_of(r, kind, (int)(i % stride), (int)(i / stride));
        at[i] = !holes ? colour & (i % 3 == 0 ? 0xFFFFFF : UINT32_MAX) : rng_below(r, 3) == 0 ? 0 : colour;
    }
    FILE *out = open_memstream(&bytes, &size);
    assert_true(pixels_write_png(out, &(pixels){at, stride, width, height, holes}, holes ? NULL : &words));
    assert_int_equal(fclose(out), 0);
    png_image image = {.version = PNG_IMAGE_VERSION};
    assert_true(png_image_begin_read_from_memory(&image, bytes, size));
    assert_int_equal(image.format, holes ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB);
    assert_true((int)image.width == width && (int)image.height == height);
    image.format = PNG_FORMAT_RGBA;
    assert_true(png_image_finish_read(&image, NULL, got, 0, NULL) && image.warning_or_error == 0);
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            const unsigned char *p = got + 4 * ((size_t)y * (size_t)width + (size_t)x);
            const uint32_t found = (uint32_t)p[3] << 24 | (uint32_t)p[0] << 16 | (uint32_t)p[1] << 8 | p[2];
            const uint32_t want = at[(size_t)y * stride + (size_t)x] | (holes ? 0 : 0xFF000000u);
            if (found != want)
                fail_msg("%d x %d, kind %d: %08x at %d,%d, not %08x", width, height, kind, found, x, y, want);
        }
    if (!holes)
        check_words(bytes, size);
    free(bytes);
    free(got);
    free(at);
}

TEST(pixels_come_back) {
    static const int sizes[][2] = {{1, 1}, {7, 3}, {1, 900}, {1500, 900}, {16384, 70}, {350000, 2}};
    rng r = rng_make("pixels");
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++)
        for (int kind = 0; kind < 3; kind++)
            for (int holes = 0; holes < 2; holes++)
                check(&r, sizes[i][0], sizes[i][1], kind, holes == 1);
}

TEST(what_cannot_be_written_fails) {
    static const uint32_t at[4] = {0};
    FILE *full = fopen("/dev/full", "wb");
    assert_non_null(full);
    setvbuf(full, NULL, _IONBF, 0);
    assert_false(pixels_write_png(full, &(pixels){at, 2, 2, 2, false}, &words));
    fclose(full);
}
