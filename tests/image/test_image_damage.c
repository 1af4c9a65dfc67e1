/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Images that are damaged, cut short, too long, too large or something else: each is refused in one sentence. */
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "handmade.h"
#include "image/image.h"
#include "support.h"

static bool parse(const unsigned char *bytes, size_t size, image *out, image_error *error) {
    memset(error, 0x55, sizeof *error);
    /* A copy of its own, so that a sanitizer sees every byte read beyond it. */
    unsigned char *copy = malloc(size + (size == 0));
    assert_non_null(copy);
    memcpy(copy, bytes, size);
    const bool good = image_parse(copy, size, out, error);
    free(copy);
    return good;
}

static bool is_sentence(const image_error *error) {
    const char *end = memchr(error->text, '\0', sizeof error->text);
    if (end == NULL || end == error->text)
        return false;
    for (const char *c = error->text; c < end; c++)
        if (*c < 0x20 || *c > 0x7e)
            return false;
    return true;
}

static void refused(const handmade *h, const char *sentence) {
    image got = {.data = NULL};
    image_error error;
    if (parse(h->at, h->size, &got, &error)) {
        image_free(&got);
        fail_msg("accepted instead of: %s", sentence);
    }
    assert_null(got.data);
    assert_false(error.unreadable);
    assert_string_equal(error.text, sentence);
}

/* ---- Sentences ----------------------------------------------------------------------------------------------------*/

TEST(other_files) {
    static const struct {
        const char *bytes;
        size_t size;
        const char *sentence;
    } rows[] = {
        {"", 0, "is empty"},
        {"P", 1, "neither PNG, PFM, npy, DDS, EXR, TIFF nor PGM by its first bytes"},
        {"\x89PNG\r\n\n\n", 8, "neither PNG, PFM, npy, DDS, EXR, TIFF nor PGM by its first bytes"},
        {"hello, depth", 12, "neither PNG, PFM, npy, DDS, EXR, TIFF nor PGM by its first bytes"},
        {"PK\3\4....", 8,
         "neither PNG, PFM, npy, DDS, EXR, TIFF nor PGM, but a zip archive: of an .npz, unpack the .npy"},
        {"\xff\xd8\xff\xe0....", 8,
         "neither PNG, PFM, npy, DDS, EXR, TIFF nor PGM, but JPEG, which keeps no depths: save PNG of 16 bits, PFM or "
         ".npy"},
        {"P2\n1 1\n", 7, "neither PNG, PFM, npy, DDS, EXR, TIFF nor PGM, but PGM in plain text: convert it to P5"},
        {"P6\n1 1\n", 7,
         "neither PNG, PFM, npy, DDS, EXR, TIFF nor PGM, but PPM, which has colours: convert it to PNG"},
        {"\xabKTX 20\xbb", 8, "neither PNG, PFM, npy, DDS, EXR, TIFF nor PGM, but KTX: save its pixels as .npy"},
        {"#?RADIANCE", 10, "neither PNG, PFM, npy, DDS, EXR, TIFF nor PGM, but Radiance HDR: convert it to PFM"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        handmade h = {.size = 0};
        handmade_bytes(&h, rows[i].bytes, rows[i].size);
        refused(&h, rows[i].sentence);
    }
}

TEST(pfm_sentences) {
    static const char *const rows[][2] = {
        {"Pf", "cut short within its header"},
        {"Pfx1 1 1\n", "PFM: a blank must follow 'Pf'"},
        {"Pf\n", "cut short within its header"},
        {"Pf\n1 1 -1.0", "cut short within its header"},
        {"Pf\n# never ends", "cut short within its header"},
        {"Pf\r\n1 1\r\n-1\rabcd", "PFM: CR LF must follow its scale, as it follows 'Pf'"},
        {"Pf\n-1 1 1\n", "PFM: its width must be a whole number, got '-1'"},
        {"Pf\n1 1x 1\n", "PFM: its height must be a whole number, got '1x'"},
        {"Pf\n1 1\a 1\n", "PFM: its height must be a number"},
        {"Pf\n1 11111111111111111111111111111111111 1\n", "PFM: its height must be a number"},
        {"Pf\n1 1111111111111111111 1\n", "PFM: its height must be a whole number, got '1111111111111111111'"},
        {"Pf\n0 1 1\n", "width and height must be from 1 to 65536 pixels, got 0 x 1"},
        {"Pf\n1 65537 1\n", "width and height must be from 1 to 65536 pixels, got 1 x 65537"},
        {"Pf\n999999999999999999 1 1\n", "width and height must be from 1 to 65536 pixels, got 999999999999999999 x 1"},
        {"Pf\n65536 4097 1\n", "must have at most 268435456 pixels, got 65536 x 4097"},
        {"Pf\n1 1 -0.00392\n",
         "PFM: its scale must be 1 or -1, got '-0.00392': programs disagree on whether it multiplies the samples; "
         "write 1 or -1 there once they are what they should be"},
        {"Pf\n1 1 -1.0\nabc", "cut short: 1 x 1 pixels, 1 channel of f4, take 4 bytes, and 3 follow the header"},
        {"PF\n1 2 1.0\na", "cut short: 1 x 2 pixels, 3 channels of f4, take 24 bytes, and 1 follows the header"},
        {"Pf\n1 1 -1.0\nabcde", "too long: 1 x 1 pixels, 1 channel of f4, take 4 bytes, and 5 follow the header"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        handmade h = {.size = 0};
        handmade_text(&h, rows[i][0]);
        refused(&h, rows[i][1]);
    }
    static const char *const scales[] = {"0", "inf", "-nan", "1.0x", "2", "-", "0x2"};
    for (size_t i = 0; i < sizeof scales / sizeof scales[0]; i++) {
        handmade h = {.size = 0};
        char sentence[256];
        handmade_text(&h, "Pf\n1 1\n");
        handmade_text(&h, scales[i]);
        handmade_text(&h, "\nabcd");
        snprintf(sentence, sizeof sentence,
                 "PFM: its scale must be 1 or -1, got '%s': programs disagree on whether it multiplies the samples; "
                 "write 1 or -1 there once they are what they should be",
                 scales[i]);
        refused(&h, sentence);
    }
}

TEST(pgm_sentences) {
    static const char *const rows[][2] = {
        {"P5", "cut short within its header"},
        {"P5x1 1 1\n", "PGM: a blank must follow 'P5'"},
        {"P5\n1 1 255", "cut short within its header"},
        {"P5\n# never ends", "cut short within its header"},
        {"P5\r\n1 1\r\n255\ra", "PGM: CR LF must follow its maxval, as it follows 'P5'"},
        {"P5\n-1 1 255\n", "PGM: its width must be a whole number, got '-1'"},
        {"P5\n1 1\a 255\n", "PGM: its height must be a number"},
        {"P5\n1 1 255.0\n", "PGM: its maxval must be a whole number, got '255.0'"},
        {"P5\n1 1 0\na", "PGM: its maxval must be from 1 to 65535, got 0"},
        {"P5\n1 1 65536\naaaa", "PGM: its maxval must be from 1 to 65535, got 65536"},
        {"P5\n0 1 255\n", "width and height must be from 1 to 65536 pixels, got 0 x 1"},
        {"P5\n65536 4097 255\n", "must have at most 268435456 pixels, got 65536 x 4097"},
        {"P5\n2 1 256\nabc", "cut short: 2 x 1 pixels, 1 channel of u2, take 4 bytes, and 3 follow the header"},
        {"P5\n1 1 255\nab", "too long: 1 x 1 pixels, 1 channel of u1, take 1 bytes, and 2 follow the header"},
        {"P5\n1 2 9\n\11\12", "PGM: a sample is 10, above its maxval of 9"},
        {"P5\n2 1 4095\n\17\377\20\01", "PGM: a sample is 4097, above its maxval of 4095"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        handmade h = {.size = 0};
        handmade_text(&h, rows[i][0]);
        refused(&h, rows[i][1]);
    }
}

/* A header without end, as a pipe may have one. */
TEST(pfm_endless) {
    enum { SIZE = 10002 };
    unsigned char *bytes = malloc(SIZE + 1);
    image got;
    image_error error;
    assert_non_null(bytes);
    memset(bytes, '#', SIZE + 1);
    memcpy(bytes, "Pf\n", 3);
    assert_false(parse(bytes, SIZE + 1, &got, &error));
    assert_string_equal(error.text, "PFM: its header must have at most 10000 bytes");
    assert_false(parse(bytes, SIZE - 1, &got, &error));
    assert_string_equal(error.text, "cut short within its header");
    free(bytes);
}

TEST(npy_sentences) {
    static const char *const rows[][2] = {
        {"", "npy: its header must have '{' at ''"},
        {"{", "npy: its header must have a word in quotes at ''"},
        {"{descr: 1}", "npy: its header must have a word in quotes at 'descr: 1}?'"},
        {"{'descr", "npy: its header must have a short word in quotes at ''descr?'"},
        {"{'a_word_of_many_letters': 1}",
         "npy: its header must have a short word in quotes at ''a_word_of_many_letters''"},
        {"{'order': 'C'}", "npy: its header must have descr, fortran_order and shape once each at ''order': 'C'}?'"},
        {"{'descr': '<f4', 'descr': '<f4'}",
         "npy: its header must have descr, fortran_order and shape once each at ''descr': '<f4'}?'"},
        {"{'descr' '<f4'}", "npy: its header must have ':' at ''<f4'}?'"},
        {"{'descr': f4}", "npy: its header must have a word in quotes at 'f4}?'"},
        {"{'descr': [('a', '<f4')]}", "npy: it holds records; save one field of them, a[\"name\"]"},
        {"{'fortran_order': 0}", "npy: its header must have True or False at '0}?'"},
        {"{'shape': 3}", "npy: its header must have a shape in ( ) at '3}?'"},
        {"{'shape': (3 4)}", "npy: its header must have a comma at '4)}?'"},
        {"{'shape': (3, -4)}", "npy: its header must have a whole number at '-4)}?'"},
        {"{'shape': (1111111111111111111,)}", "npy: its header must have a whole number at '1111111111111111111,)}?'"},
        {"{'shape': (3, 4) 'descr'}", "npy: its header must have a comma or '}' at ''descr'}?'"},
        {"{'shape': (3, 4)} x", "npy: its header must have nothing more at 'x?'"},
        {"{'shape': (3, 4)}", "npy: its header must have descr, fortran_order and shape"},
        {"{'descr': '<i4', 'fortran_order': False, 'shape': (3, 4)}",
         "npy: its samples must be f2, f4, f8, u1, u2 or u4, got '<i4': save a.astype(\"f4\"), or u4 for codes"},
        {"{'descr': '|b1', 'fortran_order': False, 'shape': (3, 4)}",
         "npy: its samples are bool, true or false, which is a mask and no depth"},
        {"{'descr': '', 'fortran_order': False, 'shape': (3, 4)}",
         "npy: its samples must be f2, f4, f8, u1, u2 or u4, got '': save a.astype(\"f4\"), or u4 for codes"},
        {"{'descr': '|u2', 'fortran_order': False, 'shape': (3, 4)}",
         "npy: its samples must be f2, f4, f8, u1, u2 or u4, got '|u2': save a.astype(\"f4\"), or u4 for codes"},
        {"{'descr': '|u1', 'fortran_order': False, 'shape': ()}",
         "npy: its shape must be (height, width) or (height, width, channels) with 1 to 4 channels, got ()"},
        {"{'descr': '|u1', 'fortran_order': False, 'shape': (12,)}",
         "npy: its shape must be (height, width) or (height, width, channels) with 1 to 4 channels, got (12,)"},
        {"{'descr': '|u1', 'fortran_order': False, 'shape': (1, 3, 4, 1)}",
         "npy: its shape must be (height, width) or (height, width, channels) with 1 to 4 channels, got (1, 3, 4, 1)"},
        {"{'descr': '|u1', 'fortran_order': False, 'shape': (4, 3, 480)}",
         "npy: its shape must be (height, width) or (height, width, channels) with 1 to 4 channels, got (4, 3, 480)"},
        {"{'descr': '|u1', 'fortran_order': False, 'shape': (4, 3, 0)}",
         "npy: its shape must be (height, width) or (height, width, channels) with 1 to 4 channels, got (4, 3, 0)"},
        {"{'descr': '|u1', 'fortran_order': False, 'shape': (0, 3)}",
         "width and height must be from 1 to 65536 pixels, got 3 x 0"},
        {"{'descr': '<f8', 'fortran_order': False, 'shape': (4096, 65536, 4)}",
         "cut short: 65536 x 4096 pixels, 4 channels of f8, take 8589934592 bytes, and 0 follow the header"},
        {"{'descr': '<f8', 'fortran_order': True, 'shape': (4096, 65537)}",
         "width and height must be from 1 to 65536 pixels, got 65537 x 4096"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        handmade h = {.size = 0};
        handmade_npy(&h, 1, rows[i][0]);
        refused(&h, rows[i][1]);
    }
    handmade h = {.size = 0};
    handmade_npy(&h, 4, "{}");
    refused(&h, "npy: its version must be 1.0, 2.0 or 3.0, got 4.0");
    h.at[6] = 0;
    refused(&h, "npy: its version must be 1.0, 2.0 or 3.0, got 0.0");
    h.at[6] = 2;
    h.at[10] = 1;
    refused(&h, "npy: its header must have at most 10000 bytes, got 65539");
}

/* A DDS with that in a word of it is refused with the sentence, or read where there is none. */
static void with_word(handmade *h, uint32_t word, uint32_t value, const char *sentence) {
    image got;
    image_error error;
    for (int k = 0; k < 4; k++)
        h->at[4 * word + (uint32_t)k] = (unsigned char)(value >> 8 * k);
    if (sentence != NULL) {
        refused(h, sentence);
        return;
    }
    if (!parse(h->at, h->size, &got, &error))
        fail_msg("%#x in word %u: %s", value, word, error.text);
    image_free(&got);
}

/* A word of the header that is another, and what is said of it. */
TEST(dds_sentences) {
    static const struct {
        uint32_t dxgi, word, value;
        const char *sentence;
    } rows[] = {
        {0, 1, 108, "DDS: its header must have 124 bytes, got 108"},
        {0, 4, 65537, "width and height must be from 1 to 65536 pixels, got 65537 x 2"},
        {0, 5, 9, NULL}, /* the pitch */
        {0, 3, 3, "cut short: 2 x 3 pixels, 1 channel of f4, take 24 bytes, and 16 follow the header"},
        {0, 3, 1, "too long: 2 x 1 pixels, 1 channel of f4, take 8 bytes, and 16 follow the header"},
        {0, 3, 0, "width and height must be from 1 to 65536 pixels, got 2 x 0"},
        {0, 21, 0x35545844, "DDS: no depth is read from format DXT5: save R32F, R16 or R24X8, or its pixels as .npy"},
        {0, 21, 36, "DDS: no depth is read from D3D format 36: save R32F, R16 or R24X8, or its pixels as .npy"},
        {0, 20, 0x40,
         "DDS: no depth is read from pixels of 0 bits with these masks: save R32F, R16 or R24X8, or its pixels as "
         ".npy"},
        {0, 6, 4, NULL}, /* no depth without its flag */
        {41, 32, 98, "DDS: no depth is read from DXGI format 98: save R32F, R16 or R24X8, or its pixels as .npy"},
        {41, 33, 4, "DDS: it has several images, a cube, volume or array: save one slice"},
        {41, 35, 1, NULL}, /* an array of one */
        {41, 35, 2, "DDS: it has several images, a cube, volume or array: save one slice"},
        {41, 35, 6, "DDS: it has several images, a cube, volume or array: save one slice"},
        {41, 7, 5, NULL}, /* nor levels without theirs */
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        handmade h = {.size = 0};
        handmade_dds(&h, 2, 2, &(handmade_dds_of){.flags = 4, .fourcc = 114, .dxgi = rows[i].dxgi});
        handmade_bytes(&h, "0123456789abcdef", 16);
        with_word(&h, rows[i].word, rows[i].value, rows[i].sentence);
    }
}

/* Levels and slices count where their flag says that they are there; one of them is the image. */
TEST(dds_of_several) {
    static const char several[] = "DDS: it has several images, a cube, volume or array: save one slice";
    static const struct {
        uint32_t flag, word, value;
        const char *sentence;
    } rows[] = {
        {0x20000, 7, 0, NULL},
        {0x20000, 7, 1, NULL},
        {0x20000, 7, 2, "DDS: it has 2 mip levels: save the largest alone"},
        {0x20000, 6, 2, NULL},
        {0x800000, 6, 0, NULL},
        {0x800000, 6, 1, NULL},
        {0x800000, 6, 2, several},
        {0x800000, 7, 2, NULL},
        {0, 28, 0x400, NULL},
        {0, 28, 0x200, several},
        {0, 28, 0x200000, several},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        handmade h = {.size = 0};
        handmade_dds(&h, 2, 2, &(handmade_dds_of){.flags = 4, .fourcc = 114});
        handmade_bytes(&h, "0123456789abcdef", 16);
        h.at[10] |= (unsigned char)(rows[i].flag >> 16);
        with_word(&h, rows[i].word, rows[i].value, rows[i].sentence);
    }
}

TEST(png_sentences) {
    static const unsigned char pixels[16] = {0};
    static const struct {
        uint32_t width, height;
        int bits, colour;
        const char *sentence;
    } rows[] = {
        {1, 1, 8, 3, "PNG with a palette, not with depths: save it as greyscale"},
        {1, 1, 1, 0, "PNG of 1 bit a sample: save it with 8 or 16"},
        {1, 1, 4, 0, "PNG of 4 bits a sample: save it with 8 or 16"},
        {65537, 1, 8, 0, "width and height must be from 1 to 65536 pixels, got 65537 x 1"},
        {0x7FFFFFFF, 0x7FFFFFFF, 8, 0, "width and height must be from 1 to 65536 pixels, got 2147483647 x 2147483647"},
        {65536, 4097, 8, 0, "must have at most 268435456 pixels, got 65536 x 4097"},
        {65536, 4096, 16, 6,
         "cut short: 65536 x 4096 pixels, 4 channels of u2, take at least 2080895 bytes, and 29 follow"},
        {2, 1, 16, 0, "damaged PNG: Not enough image data"},
        {1, 2, 8, 0, "damaged PNG: Not enough image data"},
        {0, 1, 8, 0, "damaged PNG: Invalid IHDR data"},
        {1, 1, 7, 0, "damaged PNG: Invalid IHDR data"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        handmade h = {.size = 0}, data = {.size = 0};
        handmade_ihdr(&h, rows[i].width, rows[i].height, rows[i].bits, rows[i].colour, 0);
        if (rows[i].colour == 3)
            handmade_chunk(&h, "PLTE", pixels, 3);
        handmade_bytes(&data, pixels, 2);
        handmade_idat(&h, &data);
        handmade_chunk(&h, "IEND", NULL, 0);
        refused(&h, rows[i].sentence);
    }

    handmade good = {.size = 0}, h;
    handmade_png(&good, 1, 1, 8, 0, 0, 1, pixels);
    h = good;
    h.at[h.size - 16] ^= 1;
    refused(&h, "damaged PNG: IDAT: CRC error");
    h = good;
    h.at[h.size - 20] ^= 1;
    refused(&h, "damaged PNG: IDAT: incorrect data check");
    h = good;
    handmade_text(&h, "\n");
    refused(&h, "something follows the image: a file must hold one image and nothing else");
    h.size = good.size - 12;
    refused(&h, "cut short within its data");
    h.size = 33;
    handmade_chunk(&h, "IEND", NULL, 0);
    refused(&h, "damaged PNG: IEND: out of place");
    h.size = 33;
    handmade rest = {.size = 0};
    handmade_bytes(&rest, pixels, 3); /* one byte more than the rows have */
    handmade_idat(&h, &rest);
    handmade_chunk(&h, "IEND", NULL, 0);
    refused(&h, "damaged PNG: IDAT: Too much image data");
}

/* ---- Every byte ---------------------------------------------------------------------------------------------------*/

enum { SMALL = 14 };

/* Small files of each kind, all of them right. */
static size_t small_files(handmade files[SMALL]) {
    static const unsigned char samples[9 * 9 * 8] = {1, 2, 3, 0x3c, 5, 6, 7, 0x3f};
    size_t n = 0;
    memset(files, 0, SMALL * sizeof *files);
    handmade_png(&files[n++], 3, 2, 16, 0, 0, 2, samples);
    handmade_png(&files[n++], 2, 2, 8, 6, 0, 4, samples);
    handmade_png(&files[n++], 9, 9, 16, 2, 1, 6, samples);
    handmade_text(&files[n], "Pf\n3 2\n-1.0\n");
    handmade_bytes(&files[n++], samples, 24);
    handmade_text(&files[n], "PF\n2 2\n1\n");
    handmade_bytes(&files[n++], samples, 48);
    handmade_text(&files[n], "P5\n3 2\n200\n");
    handmade_bytes(&files[n++], samples, 6);
    handmade_text(&files[n], "P5 3 2 # wide, high\n50000 ");
    handmade_bytes(&files[n++], samples, 12);
    static const char *const headers[] = {"{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }",
                                          "{'descr': '>f4', 'fortran_order': True, 'shape': (2, 1, 3), }",
                                          "{'descr': '|u1', 'fortran_order': False, 'shape': (6, 4)}"};
    for (int i = 0; i < 3; i++) {
        handmade_npy(&files[n], 1 + i, headers[i]);
        handmade_bytes(&files[n++], samples, 24);
    }
    handmade_dds(&files[n], 3, 2, &(handmade_dds_of){.dxgi = 46});
    handmade_bytes(&files[n++], samples, 24);
    handmade_dds(&files[n], 6, 2, &(handmade_dds_of){.flags = 4, .fourcc = 111});
    handmade_bytes(&files[n++], samples, 24);
    return n;
}

TEST(cut_anywhere) {
    handmade files[SMALL];
    tally t = {.name = "cut anywhere"};
    const size_t count = small_files(files);
    for (size_t i = 0; i < count; i++) {
        image got;
        image_error error;
        assert_true(parse(files[i].at, files[i].size, &got, &error));
        image_free(&got);
        for (size_t size = 0; size < files[i].size; size++) {
            const bool good = parse(files[i].at, size, &got, &error);
            TALLY(&t, !good && is_sentence(&error) && !error.unreadable, "file %zu cut to %zu bytes: %s", i, size,
                  good ? "accepted" : error.text);
            if (good)
                image_free(&got);
        }
        handmade more = files[i];
        handmade_text(&more, "x");
        TALLY(&t, !parse(more.at, more.size, &got, &error) && is_sentence(&error), "file %zu and one byte", i);
    }
    tally_end(&t);
}

/* Each bit of a PNG is under a checksum; PFM, PGM and npy have none, and then an image comes of it or a sentence. */
TEST(bits_flipped) {
    handmade files[SMALL];
    tally t = {.name = "bits flipped"};
    const size_t count = small_files(files);
    for (size_t i = 0; i < count; i++)
        for (size_t bit = 0; bit < 8 * files[i].size; bit++) {
            handmade h = files[i];
            image got;
            image_error error;
            h.at[bit / 8] ^= (unsigned char)(1U << bit % 8);
            const bool good = parse(h.at, h.size, &got, &error), png = h.at[1] == 'P' && i < 3;
            TALLY(&t, good ? !png : is_sentence(&error), "file %zu, bit %zu: %s", i, bit,
                  good ? "accepted" : error.text);
            if (good) {
                TALLY(&t, (size_t)got.width * got.height * got.channels * image_type_size(got.type) <= h.size,
                      "file %zu, bit %zu: an image larger than its file", i, bit);
                image_free(&got);
            }
        }
    tally_end(&t);
}

/* libpng would write to stderr by itself. */
TEST(nothing_printed) {
    FILE *caught = tmpfile();
    assert_non_null(caught);
    const int before = dup(STDERR_FILENO);
    assert_true(dup2(fileno(caught), STDERR_FILENO) >= 0);
    cut_anywhere(state);
    bits_flipped(state);
    png_sentences(state);
    fflush(stderr);
    dup2(before, STDERR_FILENO);
    close(before);
    struct stat status;
    assert_int_equal(fstat(fileno(caught), &status), 0);
    fclose(caught);
    assert_int_equal(status.st_size, 0);
}

/* ---- Files and pipes ----------------------------------------------------------------------------------------------*/

TEST(unreadable_paths) {
    image got;
    image_error error;
    assert_false(image_read("/nonexistent/depth.png", &got, &error));
    assert_true(error.unreadable);
    assert_string_equal(error.text, "cannot read: No such file or directory");
    assert_false(image_read("/", &got, &error));
    assert_true(error.unreadable);
    assert_string_equal(error.text, "cannot read: Is a directory");
    assert_false(image_read("/dev/null", &got, &error));
    assert_false(error.unreadable);
    assert_string_equal(error.text, "is empty");
    assert_false(image_read("/dev/zero", &got, &error));
    assert_string_equal(error.text, "neither PNG, PFM, npy, DDS, EXR, TIFF nor PGM by its first bytes");
}

/* A child that may not have more than 128 MiB beyond what it has says to a file or a pipe, as stdin. */
static void from_stdin(const unsigned char *bytes, size_t size, bool pipe_it, const char *sentence) {
    int ends[2] = {-1, -1};
    FILE *file = tmpfile();
    assert_non_null(file);
    fflush(stdout);
    if (pipe_it) {
        assert_int_equal(pipe(ends), 0);
    } else {
        fputs("skipped", file); /* stdin need not be at its beginning */
        assert_int_equal(fwrite(bytes, 1, size, file), size);
        fflush(file);
        lseek(fileno(file), 7, SEEK_SET);
    }
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        dup2(pipe_it ? ends[0] : fileno(file), STDIN_FILENO);
        if (pipe_it)
            close(ends[1]);
#ifndef __SANITIZE_ADDRESS__
        const struct rlimit limit = {160 << 20, 160 << 20};
        setrlimit(RLIMIT_AS, &limit);
#endif
        image got;
        image_error error = {.text = "fine"};
        const bool good = image_read("-", &got, &error);
        if (good)
            image_free(&got);
        _exit(strcmp(error.text, sentence) == 0 && good == (strcmp(sentence, "fine") == 0) ? 0 : 1);
    }
    if (pipe_it) {
        close(ends[0]);
        FILE *to = fdopen(ends[1], "wb");
        fwrite(bytes, 1, size, to);
        fclose(to);
    }
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    fclose(file);
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
        fail_msg("%s of %zu bytes: not '%s'", pipe_it ? "pipe" : "file", size, sentence);
}

TEST(huge_claims) {
    handmade npy = {.size = 0}, pfm = {.size = 0}, png = {.size = 0}, data = {.size = 0};
    handmade_npy(&npy, 1, "{'descr': '<f8', 'fortran_order': False, 'shape': (4096, 65536, 4), }");
    handmade_text(&npy, "abc");
    handmade_text(&pfm, "PF\n65536 4096\n-1\nab");
    handmade_ihdr(&png, 65536, 4096, 16, 6, 0);
    static const unsigned char zeros[64];
    handmade_bytes(&data, zeros, sizeof zeros);
    handmade_idat(&png, &data);
    handmade_chunk(&png, "IEND", NULL, 0);
    for (int piped = 0; piped < 2; piped++) {
        from_stdin(npy.at, npy.size, piped != 0,
                   "cut short: 65536 x 4096 pixels, 4 channels of f8, take 8589934592 bytes, and 3 follow the header");
        from_stdin(pfm.at, pfm.size, piped != 0,
                   "cut short: 65536 x 4096 pixels, 3 channels of f4, take 3221225472 bytes, and 2 follow the header");
        from_stdin(png.at, png.size, piped != 0,
                   piped ? "damaged PNG: Not enough image data"
                         : "cut short: 65536 x 4096 pixels, 4 channels of u2, take at least 2080895 bytes, and 91 "
                           "follow");
    }
}

/* Larger than what a pipe holds, and than the first piece of memory. */
TEST(large_pipes) {
    enum { SIDE = 900, SAMPLES = SIDE * SIDE };
    char *bytes[IMAGE_WRITTEN_COUNT];
    float *samples = calloc(SAMPLES, sizeof *samples);
    assert_non_null(samples);
    for (int file = 0; file < IMAGE_WRITTEN_COUNT; file++) {
        size_t size = 0;
        FILE *stream = open_memstream(&bytes[file], &size);
        image_writer *w =
            image_writer_open(stream, (image_file)file, file == IMAGE_PNG ? IMAGE_U16 : IMAGE_F32, SIDE, SIDE, 1, NULL);
        assert_non_null(w);
        assert_true(image_writer_rows(w, samples, SIDE));
        assert_true(image_writer_close(w));
        fclose(stream);
        const unsigned char *at = (const unsigned char *)bytes[file];
        from_stdin(at, size, true, "fine");
        from_stdin(at, size, false, "fine");
        if (file != IMAGE_PNG)
            from_stdin(at, size - 1, true,
                       "cut short: 900 x 900 pixels, 1 channel of f4, take 3240000 bytes, and 3239999 follow the "
                       "header");
        else
            from_stdin(at, size - 1, true, "cut short within its data");
        bytes[file][size] = 'x'; /* where the stream put a 0 */
        if (file != IMAGE_PNG)
            from_stdin(at, size + 1, false,
                       "too long: 900 x 900 pixels, 1 channel of f4, take 3240000 bytes, and 3240001 follow the "
                       "header");
        from_stdin(at, size + 1, true, "something follows the image: a file must hold one image and nothing else");
        free(bytes[file]);
    }
    free(samples);
}
