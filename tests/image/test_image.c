/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Images: what is written comes back, and what others wrote is read. */
#include <unistd.h>

#include "handmade.h"
#include "image/image.h"
#include "support.h"
#include "texture/recognise.h"

static bool parse(const handmade *h, image *out, image_error *error) {
    memset(error, 0x55, sizeof *error);
    /* A copy of its own, so that a sanitizer sees every byte read beyond it. */
    unsigned char *bytes = malloc(h->size + (h->size == 0));
    assert_non_null(bytes);
    memcpy(bytes, h->at, h->size);
    const bool good = image_parse(bytes, h->size, out, error);
    free(bytes);
    return good;
}

static void assert_samples(const handmade *h, image_file file, image_type type, uint32_t width, uint32_t height,
                           uint32_t channels, const void *samples) {
    image got;
    image_error error;
    if (!parse(h, &got, &error))
        fail_msg("refused: %s", error.text);
    assert_int_equal(got.file, file);
    assert_int_equal(got.type, type);
    assert_int_equal(got.width, width);
    assert_int_equal(got.height, height);
    assert_int_equal(got.channels, channels);
    assert_memory_equal(got.data, samples, (size_t)width * height * channels * image_type_size(type));
    image_free(&got);
    assert_null(got.data);
}

/* ---- Files of others ----------------------------------------------------------------------------------------------*/

/* Put together by Python's struct and zlib. */
static const unsigned char tiny_png[] = {
    0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44, 0x52,
    0x00, 0x00, 0x00, 0x03, 0x00, 0x00, 0x00, 0x02, 0x10, 0x00, 0x00, 0x00, 0x00, 0xe8, 0x8f, 0xe5,
    0x85, 0x00, 0x00, 0x00, 0x16, 0x49, 0x44, 0x41, 0x54, 0x78, 0x9c, 0x63, 0x60, 0x60, 0x60, 0x60,
    0x14, 0x32, 0x61, 0x68, 0x60, 0xf8, 0xff, 0xef, 0xff, 0x7f, 0x00, 0x0f, 0x4d, 0x04, 0xc3, 0x77,
    0xf7, 0xe7, 0x94, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
static const uint16_t tiny_samples[6] = {0, 1, 0x1234, 0x8000, 0xfffe, 0xffff};

static handmade tiny(void) {
    handmade h = {.size = 0};
    handmade_bytes(&h, tiny_png, sizeof tiny_png);
    return h;
}

TEST(png_of_others) {
    const handmade h = tiny();
    assert_samples(&h, IMAGE_PNG, IMAGE_U16, 3, 2, 1, tiny_samples);

    static const int colours[5] = {0, 0, 4, 2, 6};
    unsigned char pixels[9 * 11 * 8];
    rng r = rng_make("png of others");
    for (size_t i = 0; i < sizeof pixels; i++)
        pixels[i] = (unsigned char)rng_below(&r, 256);
    for (uint32_t channels = 1; channels <= 4; channels++)
        for (int bits = 8; bits <= 16; bits += 8)
            for (int interlace = 0; interlace < 2; interlace++)
                for (uint32_t side = 1; side <= 9; side += 4) {
                    handmade made = {.size = 0};
                    const size_t size = (size_t)bits / 8;
                    handmade_png(&made, side, 11, bits, colours[channels], interlace, channels * size, pixels);
                    uint16_t wide[9 * 11 * 4];
                    for (size_t i = 0; i < side * 11 * channels; i++)
                        wide[i] = (uint16_t)(pixels[2 * i] << 8 | pixels[2 * i + 1]);
                    assert_samples(&made, IMAGE_PNG, bits == 16 ? IMAGE_U16 : IMAGE_U8, side, 11, channels,
                                   bits == 16 ? (const void *)wide : pixels);
                }
}

/* Chunks about colours are stepped over, even where they are damaged. */
TEST(png_chunks) {
    static const char *const names[] = {"tEXt", "zTXt", "iCCP", "gAMA", "sRGB", "pHYs", "xyZz"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        for (int damaged = 0; damaged < 2; damaged++) {
            handmade h = {.size = 0};
            handmade_bytes(&h, tiny_png, 33);
            handmade_chunk(&h, names[i], "what \0 nobody reads", 19);
            h.at[h.size - 1] ^= (unsigned char)damaged;
            handmade_bytes(&h, tiny_png + 33, sizeof tiny_png - 33);
            assert_samples(&h, IMAGE_PNG, IMAGE_U16, 3, 2, 1, tiny_samples);
        }
}

TEST(pfm_of_others) {
    static const uint32_t rows[2][3] = {{0x3F800000, 0x7FC00001, 0xFF800000}, {0x00000001, 0x80000000, 0x3E800000}};
    static const char *const headers[][2] = {{"Pf\n3 2\n1\n", "Pf\n3 2\n-1\n"},
                                             {"Pf 3 2 1.000 ", "Pf\t3\t2\t-1.0e0\t"},
                                             {"Pf\r3\n\n 2\n+1.0\r", "Pf\n3 2 \n -1.0\n"},
                                             {"PF\n1 2\n1.0\n", "PF\n1 2\n-1.0\n"},
                                             {"Pf\r\n3 2\r\n1.0\r\n", "Pf\r\n3 2\r\n-1.0\r\n"},
                                             {"Pf\r\n3 2\r\n1.0\n", "Pf\n3 2\n-1.0\r"},
                                             {"Pf\n# by hand\n3 2 # wide, high\n#\n1\n", "Pf #a#b\r3\v\f2\t-1\v"}};
    for (size_t i = 0; i < sizeof headers / sizeof headers[0]; i++)
        for (int little = 0; little < 2; little++) {
            handmade h = {.size = 0};
            handmade_text(&h, headers[i][little]);
            for (int k = 0; k < 6; k++) /* the bottom row first */
                handmade_number(&h, rows[k < 3][k % 3], 4, little);
            const bool colour = headers[i][0][1] == 'F';
            assert_samples(&h, IMAGE_PFM, IMAGE_F32, colour ? 1 : 3, 2, colour ? 3 : 1, rows);
        }
}

/* Samples are what they are; the largest that a file may hold says how many bytes each has. */
TEST(pgm_of_others) {
    static const struct {
        const char *header;
        uint32_t maxval, most;
    } rows[] = {{"P5\n3 2\n65535\n", 65535, 0},
                {"P5 3 2 255 ", 255, 0},
                {"P5\r\n3 2\r\n255\r\n", 255, 0},
                {"P5\n# CREATOR: GIMP\n3 2\n255\n", 255, 0},
                {"P5\n3 # wide\n2\n#\n10000\n", 10000, 10000},
                {"P5\r3\t2 256\r", 256, 256},
                {"P5\n3 2\n200\n", 200, 200},
                {"P5\n3 2\n1\n", 1, 1}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const bool wide = rows[i].maxval > 255;
        uint8_t bytes[6];
        uint16_t words[6];
        handmade h = {.size = 0};
        image got;
        image_error error;
        handmade_text(&h, rows[i].header);
        for (uint32_t k = 0; k < 6; k++) {
            const uint32_t sample = rows[i].maxval * k / 5;
            bytes[k] = (uint8_t)sample;
            words[k] = (uint16_t)sample;
            handmade_number(&h, sample, wide ? 2 : 1, 0);
        }
        assert_samples(&h, IMAGE_PGM, wide ? IMAGE_U16 : IMAGE_U8, 3, 2, 1, wide ? (const void *)words : bytes);
        assert_true(parse(&h, &got, &error) && got.most == rows[i].most);
        image_free(&got);
    }
}

/* A sample may look like the other half of a line end. */
TEST(pfm_line_ends) {
    static const char *const headers[] = {"Pf\r1 1\r-1\r", "Pf\n1 1\n-1\r", "Pf\r\n1 1\r\n-1\r\n", "Pf\r\n1 1\r\n-1\n"};
    for (size_t i = 0; i < sizeof headers / sizeof headers[0]; i++) {
        static const uint32_t bits = 0x3E80000A; /* LF is its first byte in the file */
        handmade h = {.size = 0};
        handmade_text(&h, headers[i]);
        handmade_number(&h, bits, 4, 1);
        assert_samples(&h, IMAGE_PFM, IMAGE_F32, 1, 1, 1, &bits);
    }
}

/* The lowest `size` bytes of a number as this machine keeps them. */
static void in_memory(unsigned char *at, uint64_t number, int size) {
    for (int i = 0; i < size; i++)
        at[__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__ ? i : size - 1 - i] = (unsigned char)(number >> 8 * i);
}

TEST(npy_of_others) {
    for (int type = 0; type < IMAGE_TYPE_COUNT; type++)
        for (int version = 1; version <= 3; version++)
            for (int order = 0; order < 4; order++)
                for (int fortran = 0; fortran < 2; fortran++) {
                    const int size = (int)image_type_size((image_type)type);
                    if (order == 3 && size > 1)
                        continue;
                    unsigned char want[2 * 3 * 2 * 8];
                    handmade h = {.size = 0};
                    char header[160];
                    snprintf(header, sizeof header, "{'descr': '%c%s', 'fortran_order': %s, 'shape': (2, 3, 2), }",
                             "<>=|"[order], image_type_name((image_type)type), fortran ? "True" : "False");
                    handmade_npy(&h, version, header);
                    const bool little = order == 0 || (order != 1 && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__);
                    for (uint64_t i = 0; i < 12; i++) {
                        const uint64_t sample = UINT64_C(0x0102030405060708) * (i + 1);
                        handmade_number(&h, sample, size, little);
                        const uint64_t to =
                            !fortran ? i : (i % 2 * 3 + i / 2 % 3) * 2 + i / 6; /* row, column, channel */
                        in_memory(want + to * (size_t)size, sample, size);
                    }
                    assert_samples(&h, IMAGE_NPY, (image_type)type, 3, 2, 2, want);
                }
    static const char *const spellings[] = {
        "{\"shape\":(1,2,),\"fortran_order\":False,\"descr\":\"|u1\"}",
        " { 'fortran_order' : False , 'descr':'<u1','shape': ( 1 , 2 )  ,  }      ",
        "{'descr': '|u1', 'fortran_order': True, 'shape': (1, 2), }",
    };
    for (size_t i = 0; i < sizeof spellings / sizeof spellings[0]; i++) {
        handmade h = {.size = 0};
        handmade_npy(&h, 1, spellings[i]);
        handmade_text(&h, "\7\xff");
        assert_samples(&h, IMAGE_NPY, IMAGE_U8, 2, 1, 1, "\7\xff");
    }
}

enum { FOURCC = 4, RGB = 0x41, LUMINANCE = 0x20000 };

/* Two pixels of each format, the lowest byte first: what is read of them, and the depth format that the name says. */
static const struct {
    handmade_dds_of of;
    image_type type;
    uint32_t channels;
    const char *says;
    int shift; /* of 24 bits; -1: none */
} dds_rows[] = {
    {{.dxgi = 41}, IMAGE_F32, 1, NULL, -1},
    {{.dxgi = 40}, IMAGE_F32, 1, "fp32", -1},
    {{.dxgi = 39}, IMAGE_F32, 1, NULL, -1},
    {{.dxgi = 20}, IMAGE_F32, 2, "fp32", -1},
    {{.dxgi = 19}, IMAGE_F32, 2, "fp32", -1},
    {{.dxgi = 21}, IMAGE_F32, 2, "fp32", -1},
    {{.dxgi = 42}, IMAGE_U32, 1, NULL, -1},
    {{.dxgi = 44}, IMAGE_U32, 1, "unorm24", 0},
    {{.dxgi = 45}, IMAGE_U32, 1, "unorm24", 0},
    {{.dxgi = 46}, IMAGE_U32, 1, "unorm24", 0},
    {{.dxgi = 53}, IMAGE_U16, 1, NULL, -1},
    {{.dxgi = 54}, IMAGE_F16, 1, NULL, -1},
    {{.dxgi = 55}, IMAGE_U16, 1, "unorm16", -1},
    {{.dxgi = 56}, IMAGE_U16, 1, NULL, -1},
    {{.dxgi = 57}, IMAGE_U16, 1, NULL, -1},
    {{.dxgi = 61}, IMAGE_U8, 1, NULL, -1},
    {{.dxgi = 49}, IMAGE_U8, 2, NULL, -1},
    {{.dxgi = 28}, IMAGE_U8, 4, NULL, -1},
    {{.dxgi = 31}, IMAGE_U8, 4, NULL, -1},
    {{FOURCC, 114, 0, {0}, 0}, IMAGE_F32, 1, NULL, -1},
    {{FOURCC, 111, 0, {0}, 0}, IMAGE_F16, 1, NULL, -1},
    {{FOURCC, 82, 0, {0}, 0}, IMAGE_F32, 1, "fp32", -1},
    {{FOURCC, 77, 0, {0}, 0}, IMAGE_U32, 1, "unorm24", 8},
    {{FOURCC, 75, 0, {0}, 0}, IMAGE_U32, 1, "unorm24", 8},
    {{FOURCC, 70, 0, {0}, 0}, IMAGE_U16, 1, "unorm16", -1},
    {{FOURCC, 80, 0, {0}, 0}, IMAGE_U16, 1, "unorm16", -1},
    {{FOURCC, 81, 0, {0}, 0}, IMAGE_U16, 1, NULL, -1},
    {{LUMINANCE, 0, 16, {0xFFFF, 0, 0, 0}, 0}, IMAGE_U16, 1, NULL, -1},
    {{LUMINANCE, 0, 8, {0xFF, 0, 0, 0}, 0}, IMAGE_U8, 1, NULL, -1},
    {{RGB, 0, 32, {0xFF, 0xFF00, 0xFF0000, 0xFF000000}, 0}, IMAGE_U8, 4, NULL, -1},
};

TEST(dds_of_others) {
    for (size_t i = 0; i < sizeof dds_rows / sizeof dds_rows[0]; i++) {
        const int size = (int)image_type_size(dds_rows[i].type);
        const uint64_t count = 2 * dds_rows[i].channels;
        unsigned char want[2 * 8];
        handmade h = {.size = 0};
        handmade_dds(&h, 2, 1, &dds_rows[i].of);
        for (uint64_t k = 0; k < count; k++) {
            const uint64_t sample = (k + 1) * 0x3A524361;
            handmade_number(&h, sample, size, 1);
            in_memory(want + k * (size_t)size, dds_rows[i].shift >= 0 ? sample >> dds_rows[i].shift & 0xFFFFFF : sample,
                      size);
        }
        assert_samples(&h, IMAGE_DDS, dds_rows[i].type, 2, 1, dds_rows[i].channels, want);
        image got;
        image_error error;
        dp_recognised found;
        char why[RECOGNISE_WHY_SIZE];
        assert_true(parse(&h, &got, &error));
        if (dds_rows[i].says == NULL)
            assert_null(got.says);
        else
            assert_string_equal(got.says, dds_rows[i].says);
        recognise(&got, &found, why);
        if (dds_rows[i].says != NULL)
            assert_string_equal(found.format.name, dds_rows[i].says);
        image_free(&got);
    }
}

/* Direct3D's older formats of colours begin with blue. */
TEST(dds_blue_first) {
    static const handmade_dds_of formats[] = {{.dxgi = 87},
                                              {RGB, 0, 32, {0xFF0000, 0xFF00, 0xFF, 0xFF000000}, 0},
                                              {RGB & ~1U, 0, 24, {0xFF0000, 0xFF00, 0xFF, 0}, 0}};
    for (size_t i = 0; i < 3; i++) {
        const size_t channels = i < 2 ? 4 : 3;
        static const uint8_t want[2][4] = {{30, 20, 10, 40}, {70, 60, 50, 80}};
        uint8_t samples[8];
        handmade h = {.size = 0};
        handmade_dds(&h, 2, 1, &formats[i]);
        handmade_bytes(&h, (const uint8_t[]){10, 20, 30, 40}, channels);
        handmade_bytes(&h, (const uint8_t[]){50, 60, 70, 80}, channels);
        memcpy(samples, want[0], channels);
        memcpy(samples + channels, want[1], channels);
        assert_samples(&h, IMAGE_DDS, IMAGE_U8, 2, 1, (uint32_t)channels, samples);
    }
}

/* Small codes of 24 bits would be those of 16 bits if the file did not name its format. */
TEST(dds_names_its_format) {
    for (int named = 0; named < 2; named++) {
        handmade h = {.size = 0};
        image got;
        image_error error;
        dp_recognised found;
        char why[RECOGNISE_WHY_SIZE];
        handmade_dds(&h, 3, 1, &(handmade_dds_of){.dxgi = named ? 46 : 42});
        for (uint32_t k = 0; k < 3; k++)
            handmade_number(&h, 7 + k, 4, 1);
        assert_true(parse(&h, &got, &error));
        recognise(&got, &found, why);
        assert_true(found.depth);
        assert_int_equal(found.certain, named);
        assert_string_equal(found.format.name, named ? "unorm24" : "unorm16");
        image_free(&got);
    }
}

/* A large transposition is one too. */
TEST(npy_transposed) {
    enum { WIDTH = 83, HEIGHT = 41, CHANNELS = 3 };
    char header[128];
    const int length =
        snprintf(header, sizeof header, "{'descr': '<u2', 'fortran_order': True, 'shape': (%d, %d, %d)}\n", HEIGHT,
                 WIDTH, CHANNELS);
    const size_t before = 10 + (size_t)length, size = before + WIDTH * HEIGHT * CHANNELS * 2;
    unsigned char *bytes = malloc(size);
    assert_non_null(bytes);
    memcpy(bytes, "\x93NUMPY\1", 7);
    bytes[7] = 0;
    bytes[8] = (unsigned char)length;
    bytes[9] = 0;
    memcpy(bytes + 10, header, (size_t)length);
    unsigned char *to = bytes + before;
    for (int k = 0; k < CHANNELS; k++)
        for (int x = 0; x < WIDTH; x++)
            for (int y = 0; y < HEIGHT; y++, to += 2) {
                const int sample = (y * WIDTH + x) * CHANNELS + k;
                to[0] = (unsigned char)(sample & 0xFF);
                to[1] = (unsigned char)(sample >> 8);
            }
    image got;
    image_error error;
    assert_true(image_parse(bytes, size, &got, &error));
    const uint16_t *samples = got.data;
    for (int i = 0; i < WIDTH * HEIGHT * CHANNELS; i++)
        assert_int_equal(samples[i], i);
    image_free(&got);
    free(bytes);
}

/* ---- Round trips --------------------------------------------------------------------------------------------------*/

static bool write_image(FILE *stream, const image *img, image_file file, uint32_t chunk) {
    image_writer *w = image_writer_open(stream, file, img->type, img->width, img->height, img->channels, NULL);
    if (w == NULL)
        return false;
    const size_t row_size = (size_t)img->width * img->channels * image_type_size(img->type);
    const unsigned char *data = img->data;
    bool good = true;
    if (image_writer_bottom_up(w))
        for (uint32_t row = img->height; row-- > 0;)
            good = image_writer_rows(w, data + row * row_size, 1) && good;
    else
        for (uint32_t row = 0; row < img->height; row += chunk) {
            const uint32_t some = img->height - row < chunk ? img->height - row : chunk;
            good = image_writer_rows(w, data + row * row_size, some) && good;
        }
    return image_writer_close(w) && good;
}

static void there_and_back(const image *img, image_file file, uint32_t chunk) {
    char path[] = "/tmp/depthprec-image-XXXXXX";
    const int fd = mkstemp(path);
    assert_true(fd >= 0);
    FILE *stream = fdopen(fd, "wb");
    assert_non_null(stream);
    assert_true(write_image(stream, img, file, chunk));
    assert_int_equal(fclose(stream), 0);
    image got;
    image_error error;
    const bool good = image_read(path, &got, &error);
    unlink(path);
    if (!good)
        fail_msg("%s of %s: %s", image_file_name(file), image_type_name(img->type), error.text);
    assert_int_equal(got.file, file);
    assert_int_equal(got.type, img->type);
    assert_int_equal(got.width, img->width);
    assert_int_equal(got.height, img->height);
    assert_int_equal(got.channels, img->channels);
    assert_memory_equal(got.data, img->data,
                        (size_t)img->width * img->height * img->channels * image_type_size(img->type));
    image_free(&got);
}

TEST(round_trips) {
    static const uint32_t sizes[][2] = {{1, 1}, {7, 3}, {1, 300}, {300, 1}, {257, 129}};
    static const unsigned held[IMAGE_WRITTEN_COUNT] = {[IMAGE_PNG] = 1 << IMAGE_U8 | 1 << IMAGE_U16,
                                                       [IMAGE_PFM] = 1 << IMAGE_F32,
                                                       [IMAGE_NPY] = (1 << IMAGE_TYPE_COUNT) - 1};
    rng r = rng_make("round trips");
    unsigned char *data = malloc(257 * 129 * 4 * 8);
    assert_non_null(data);
    for (size_t i = 0; i < 257 * 129 * 4 * 8; i++) /* NaN, infinities and -0 are among the floats */
        data[i] = (unsigned char)(i % 64 < 32 ? rng_below(&r, 256) : i % 64 < 48 ? 0xFF : 0x7F + (i & 1));
    for (int file = 0; file < IMAGE_WRITTEN_COUNT; file++)
        for (int type = 0; type < IMAGE_TYPE_COUNT; type++)
            for (uint32_t channels = 1; channels <= 4; channels++) {
                const bool should = (held[file] >> type & 1U) != 0 && (file != IMAGE_PFM || channels % 2 == 1);
                assert_int_equal(image_holds((image_file)file, (image_type)type, channels), should);
                for (size_t s = 0; should && s < sizeof sizes / sizeof sizes[0]; s++) {
                    const image img = {.width = sizes[s][0],
                                       .height = sizes[s][1],
                                       .channels = channels,
                                       .type = (image_type)type,
                                       .data = data};
                    there_and_back(&img, (image_file)file, 1 + (uint32_t)s * 50);
                }
            }
    free(data);
    assert_null(image_writer_open(stdout, IMAGE_DDS, IMAGE_U16, 1, 1, 1, NULL)); /* read alone */
    assert_false(image_holds(IMAGE_NPY, IMAGE_U8, 0));
    assert_false(image_holds(IMAGE_NPY, IMAGE_U8, 5));
    assert_false(image_holds(IMAGE_FILE_COUNT, IMAGE_U8, 1));
    assert_false(image_holds(IMAGE_NPY, IMAGE_TYPE_COUNT, 1));
}

/* The bytes that the header promises: PFM -1.0 and from the bottom, npy as NumPy itself writes it. */
TEST(written_bytes) {
    static const float samples[2] = {1, 0.5F};
    char *bytes = NULL;
    size_t size = 0;
    const image img = {.width = 1, .height = 2, .channels = 1, .type = IMAGE_F32, .data = (void *)samples};
    FILE *stream = open_memstream(&bytes, &size);
    assert_true(write_image(stream, &img, IMAGE_PFM, 1));
    fclose(stream);
    assert_int_equal(size, 20);
    assert_memory_equal(bytes, "Pf\n1 2\n-1.0\n\0\0\0\x3f\0\0\x80\x3f", 20);
    free(bytes);
    stream = open_memstream(&bytes, &size);
    assert_true(write_image(stream, &img, IMAGE_NPY, 1));
    fclose(stream);
    static const char header[] = "\x93NUMPY\1\0v\0{'descr': '<f4', 'fortran_order': False, 'shape': (2, 1), }";
    assert_int_equal(size, 136);
    assert_memory_equal(bytes, header, sizeof header - 1);
    for (size_t i = sizeof header - 1; i < 127; i++)
        assert_int_equal(bytes[i], ' ');
    assert_memory_equal(bytes + 127, "\n\0\0\x80\x3f\0\0\0\x3f", 9);
    free(bytes);
}

TEST(writers_refuse) {
    FILE *stream = tmpfile();
    const uint16_t row[4] = {0};
    assert_non_null(stream);
    assert_null(image_writer_open(stream, IMAGE_PNG, IMAGE_F32, 1, 1, 1, NULL));
    assert_null(image_writer_open(stream, IMAGE_PFM, IMAGE_F32, 1, 1, 2, NULL));
    assert_null(image_writer_open(stream, IMAGE_NPY, IMAGE_F32, 0, 1, 1, NULL));
    assert_null(image_writer_open(stream, IMAGE_NPY, IMAGE_F32, 1, 65537, 1, NULL));
    assert_null(image_writer_open(stream, IMAGE_NPY, IMAGE_F32, 65536, 4097, 1, NULL));
    for (int file = 0; file < IMAGE_WRITTEN_COUNT; file++) {
        const image_type type = file == IMAGE_PFM ? IMAGE_F32 : IMAGE_U16;
        image_writer *w = image_writer_open(stream, (image_file)file, type, 2, 3, 1, NULL);
        assert_true(image_writer_rows(w, row, 1));
        assert_false(image_writer_close(w)); /* rows are missing */
        w = image_writer_open(stream, (image_file)file, type, 2, 1, 1, NULL);
        assert_true(image_writer_rows(w, row, 1));
        assert_false(image_writer_rows(w, row, 1)); /* too many */
        assert_false(image_writer_close(w));
    }
    fclose(stream);
    for (int file = 0; file < IMAGE_WRITTEN_COUNT; file++) {
        stream = fopen("/dev/full", "wb");
        assert_non_null(stream);
        setvbuf(stream, NULL, _IONBF, 0);
        const image img = {.width = 1,
                           .height = 1,
                           .channels = 1,
                           .type = file == IMAGE_PFM ? IMAGE_F32 : IMAGE_U16,
                           .data = (void *)row};
        assert_false(write_image(stream, &img, (image_file)file, 1));
        fclose(stream);
    }
}

/* ---- Names --------------------------------------------------------------------------------------------------------*/

TEST(names) {
    image_file file = IMAGE_FILE_COUNT;
    assert_true(image_file_of("a/b.c/depth.PNG", &file) && file == IMAGE_PNG);
    assert_true(image_file_of("x.pfm", &file) && file == IMAGE_PFM);
    assert_true(image_file_of("x.png.npy", &file) && file == IMAGE_NPY);
    assert_false(image_file_of("png", &file) || image_file_of(".png", &file) || image_file_of("x.pn", &file) ||
                 image_file_of("", &file) || image_file_of("-", &file));
    assert_string_equal(image_type_name(IMAGE_F16), "f2");
    assert_int_equal(image_type_size(IMAGE_F64), 8);
    assert_null(image_type_name(IMAGE_TYPE_COUNT));
    assert_int_equal(image_type_size(IMAGE_TYPE_COUNT), 0);
    assert_string_equal(image_file_name(IMAGE_NPY), "npy");
    assert_null(image_file_name(IMAGE_FILE_COUNT));
}
