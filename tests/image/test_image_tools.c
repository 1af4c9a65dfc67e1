/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Images of other writers: EXR and TIFF put together here, and whatever the tools on this machine make of them. */
#include "handmade.h"
#include "image/image.h"
#include "printed.h"
#include "system/dynload.h"

enum { ACROSS = 23, DOWN = 11, ALL = ACROSS * DOWN };

/* ---- Samples ------------------------------------------------------------------------------------------------------*/

/* Sample i of a type: codes and numbers that differ, of binary16 small fractions that it has. */
static uint64_t bits_of(image_type type, size_t i) {
    const uint32_t code = (uint32_t)(i * 2654435761U >> 3);
    float real = (float)(i + 1) / (float)(ALL + 7);
    double wide = (double)(i + 1) / (ALL + 7);
    uint32_t bits;
    uint64_t bits64;
    memcpy(&bits, &real, sizeof bits);
    memcpy(&bits64, &wide, sizeof bits64);
    switch (type) {
    case IMAGE_U8:
        return code & 0xFF;
    case IMAGE_U16:
        return code & 0xFFFF;
    case IMAGE_U32:
        return code & 0xFFFFFF;
    case IMAGE_F16:
        return 0x3400 + i; /* from 0.25 on */
    case IMAGE_F32:
        return bits;
    default:
        return bits64;
    }
}

static void assert_bits(const image *img, image_type type, size_t channel) {
    assert_int_equal(img->type, type);
    assert_int_equal(img->width, ACROSS);
    assert_int_equal(img->height, DOWN);
    const size_t size = image_type_size(type);
    for (size_t i = 0; i < ALL; i++) {
        uint64_t got = 0;
        const unsigned char *at = (const unsigned char *)img->data + (i * img->channels + channel) * size;
        for (size_t k = 0; k < size; k++)
            got |= (uint64_t)at[__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__ ? k : size - 1 - k] << 8 * k;
        if (got != bits_of(type, i))
            fail_msg("sample %zu: %llx instead of %llx", i, (unsigned long long)got,
                     (unsigned long long)bits_of(type, i));
    }
}

/* ---- EXR ----------------------------------------------------------------------------------------------------------*/

typedef struct exr_channel {
    const char *name;
    image_type type;
    bool other; /* zeros in place of the samples */
} exr_channel;

static void attribute(handmade *h, const char *name, const char *type, const handmade *value) {
    handmade_bytes(h, name, strlen(name) + 1);
    handmade_bytes(h, type, strlen(type) + 1);
    handmade_number(h, value->size, 4, 1);
    handmade_bytes(h, value->at, value->size);
}

static void number_attribute(handmade *h, const char *name, const char *type, size_t size) {
    const handmade value = {.size = size};
    attribute(h, name, type, &value);
}

static void exr_header(handmade *h, const exr_channel *channels, size_t count, const int *shown, const char *part) {
    handmade list = {.size = 0}, box = {.size = 0}, display = {.size = 0}, one = {.size = 0};
    for (size_t k = 0; k < count; k++) {
        handmade_bytes(&list, channels[k].name, strlen(channels[k].name) + 1);
        handmade_number(&list, channels[k].type == IMAGE_U32 ? 0 : channels[k].type == IMAGE_F16 ? 1 : 2, 4, 1);
        handmade_number(&list, 0, 4, 1);
        handmade_number(&list, 1, 4, 1);
        handmade_number(&list, 1, 4, 1);
    }
    handmade_number(&list, 0, 1, 1);
    for (int k = 0; k < 4; k++) {
        static const int ends[4] = {-3, 5, ACROSS - 4, DOWN + 4};
        handmade_number(&box, (uint64_t)ends[k], 4, 1);
        handmade_number(&display, (uint64_t)(ends[k] + (shown != NULL ? shown[k] : 0)), 4, 1);
    }
    handmade_number(&one, 0x3F800000, 4, 1);
    attribute(h, "channels", "chlist", &list);
    if (part != NULL) {
        handmade name = {.size = 0}, type = {.size = 0}, chunks = {.size = 0};
        handmade_text(&name, part);
        handmade_text(&type, "scanlineimage");
        handmade_number(&chunks, DOWN, 4, 1);
        attribute(h, "name", "string", &name);
        attribute(h, "type", "string", &type);
        attribute(h, "chunkCount", "int", &chunks);
    }
    number_attribute(h, "compression", "compression", 1);
    attribute(h, "dataWindow", "box2i", &box);
    attribute(h, "displayWindow", "box2i", &display);
    number_attribute(h, "lineOrder", "lineOrder", 1);
    attribute(h, "pixelAspectRatio", "float", &one);
    number_attribute(h, "screenWindowCenter", "v2f", 8);
    attribute(h, "screenWindowWidth", "float", &one);
    handmade_number(h, 0, 1, 1);
}

static void exr_row(handmade *h, size_t y, const exr_channel *channels, size_t count, size_t row) {
    handmade_number(h, y + 5, 4, 1);
    handmade_number(h, row, 4, 1);
    for (size_t k = 0; k < count; k++)
        for (size_t x = 0; x < ACROSS; x++)
            handmade_number(h, channels[k].other ? 0 : bits_of(channels[k].type, y * ACROSS + x),
                            (int)image_type_size(channels[k].type), 1);
}

/* Scanlines without compression; the channels in the order of their names. */
static void make_exr(handmade *h, const exr_channel *channels, size_t count, const int *shown) {
    size_t row = 0;
    handmade_number(h, 20000630, 4, 1);
    handmade_number(h, 2, 4, 1);
    exr_header(h, channels, count, shown, NULL);
    for (size_t k = 0; k < count; k++)
        row += ACROSS * image_type_size(channels[k].type);
    for (size_t y = 0, at = h->size + 8 * DOWN; y < DOWN; y++, at += 8 + row)
        handmade_number(h, at, 8, 1);
    for (size_t y = 0; y < DOWN; y++)
        exr_row(h, y, channels, count, row);
}

/* The same in parts of one channel each, called by their names. */
static void make_parts(handmade *h, const exr_channel *channels, const char *const *names, size_t count) {
    size_t at = 0;
    handmade_number(h, 20000630, 4, 1);
    handmade_number(h, 2 | 0x1000, 4, 1);
    for (size_t k = 0; k < count; k++)
        exr_header(h, &channels[k], 1, NULL, names[k]);
    handmade_number(h, 0, 1, 1);
    at = h->size + 8 * DOWN * count;
    for (size_t k = 0; k < count; k++)
        for (size_t y = 0; y < DOWN; y++, at += 12 + ACROSS * image_type_size(channels[k].type))
            handmade_number(h, at, 8, 1);
    for (size_t k = 0; k < count; k++)
        for (size_t y = 0; y < DOWN; y++) {
            handmade_number(h, k, 4, 1);
            exr_row(h, y, &channels[k], 1, ACROSS * image_type_size(channels[k].type));
        }
}

/* Is EXR or TIFF read by this build, on this machine? Otherwise it says so by name. */
static bool is_read(const char *kind, const handmade *h) {
    image img;
    image_error error;
    if (image_parse(h->at, h->size, &img, &error)) {
        image_free(&img);
        return true;
    }
    if (strstr(error.text, "Debian's package") == NULL)
        fail_msg("%s: %s", kind, error.text);
    print_message("# skipped: %s\n", error.text);
    return false;
}

static bool exr_is_read(void) {
    handmade h = {.size = 0};
    make_exr(&h, &(exr_channel){"Z", IMAGE_F32, false}, 1, NULL);
    return is_read("EXR", &h);
}

static const char *write_file(const char *name, const handmade *h) {
    const char *path = scratch_file(name);
    FILE *f = fopen(path, "wb");
    assert_non_null(f);
    assert_int_equal(fwrite(h->at, 1, h->size, f), h->size);
    fclose(f);
    return path;
}

#define COLOUR_OF(read, other)                                                                                         \
    "EXR: its channels R and " other " differ, so it is a colour picture and no depth: --channel " read                \
    " reads one of them all the same"
#define COLOUR(other) COLOUR_OF("R", other)

static const struct {
    exr_channel channels[3];
    size_t count;
    const char *asked;
    image_type type;
    const char *sentence;
} channel_rows[] = {
    {{{"A", IMAGE_F16, true}, {"R", IMAGE_F16, true}, {"Z", IMAGE_F32, false}}, 3, NULL, IMAGE_F32, NULL},
    {{{"B", IMAGE_F16, true}, {"G", IMAGE_F16, true}, {"R", IMAGE_F16, false}}, 3, "R", IMAGE_F16, NULL},
    {{{"B", IMAGE_F16, false}, {"G", IMAGE_F16, false}, {"R", IMAGE_F16, false}}, 3, NULL, IMAGE_F16, NULL},
    {{{"B", IMAGE_F32, true}, {"G", IMAGE_F32, false}, {"R", IMAGE_F32, false}}, 3, NULL, IMAGE_F32, COLOUR("B")},
    {{{"A", IMAGE_F32, true}, {"G", IMAGE_F16, false}, {"R", IMAGE_F32, false}}, 3, NULL, IMAGE_F32, COLOUR("G")},
    {{{"A", IMAGE_F32, true}, {"R", IMAGE_F32, false}}, 2, NULL, IMAGE_F32, NULL},
    {{{"A", IMAGE_F32, true}, {"depth", IMAGE_U32, false}}, 2, NULL, IMAGE_U32, NULL},
    {{{"R", IMAGE_F32, true}, {"depth", IMAGE_U32, false}}, 2, NULL, IMAGE_U32, NULL},
    {{{"R", IMAGE_F32, true}, {"far.depth", IMAGE_F32, false}}, 2, NULL, IMAGE_F32, NULL},
    {{{"A", IMAGE_F32, true}, {"z", IMAGE_F32, false}}, 2, NULL, IMAGE_F32, NULL},
    {{{"V.Depth.Z", IMAGE_F32, false}, {"V.RGB.R", IMAGE_F16, true}}, 2, NULL, IMAGE_F32, NULL},
    {{{"layer.z", IMAGE_F32, false}, {"v.RGB.R", IMAGE_F16, true}}, 2, NULL, IMAGE_F32, NULL},
    {{{"A", IMAGE_F16, true}, {"DEPTH", IMAGE_F32, false}}, 2, NULL, IMAGE_F32, NULL},
    {{{"V.Depth.V", IMAGE_F32, false}, {"V.RGB.R", IMAGE_F16, true}}, 2, NULL, IMAGE_F32, NULL},
    {{{"Depth.B", IMAGE_F16, true}, {"Depth.G", IMAGE_F16, true}, {"Depth.R", IMAGE_F16, false}},
     3,
     NULL,
     IMAGE_F16,
     COLOUR_OF("Depth.R", "G")},
    {{{"R", IMAGE_F16, true}, {"depth.X", IMAGE_F32, false}, {"depth.Y", IMAGE_F32, true}}, 3, NULL, IMAGE_F32, NULL},
    {{{"A.Z", IMAGE_F32, true}, {"undepth.R", IMAGE_F32, true}, {"z.y", IMAGE_F32, false}}, 3, "z.y", IMAGE_F32, NULL},
    {{{"X", IMAGE_F32, true}, {"Y", IMAGE_F32, true}, {"Z", IMAGE_F32, true}},
     3,
     NULL,
     IMAGE_F32,
     "EXR: has no channel Z, depth or R, but X, Y, Z: --channel NAME takes one"},
    {{{"N.X", IMAGE_F32, true}, {"N.Y", IMAGE_F32, true}, {"N.Z", IMAGE_F32, true}},
     3,
     NULL,
     IMAGE_F32,
     "EXR: has no channel Z, depth or R, but N.X, N.Y, N.Z: --channel NAME takes one"},
    {{{"X", IMAGE_F32, true}, {"Y", IMAGE_F32, true}, {"Z", IMAGE_F32, false}}, 3, "Z", IMAGE_F32, NULL},
    {{{"Y", IMAGE_F16, false}}, 1, NULL, IMAGE_F16, NULL},
    {{{"Q", IMAGE_F16, false}, {"Z", IMAGE_F32, true}}, 2, "Q", IMAGE_F16, NULL},
    {{{"X", IMAGE_F32, true}, {"Y", IMAGE_F32, true}},
     2,
     NULL,
     IMAGE_F32,
     "EXR: has no channel Z, depth or R, but X, Y: --channel NAME takes one"},
    {{{"X", IMAGE_F32, true}, {"Z", IMAGE_F32, true}}, 2, "z", IMAGE_F32, "EXR: has no channel z, but X, Z"},
};

TEST(exr_channels) {
    if (!exr_is_read())
        skip();
    for (size_t i = 0; i < sizeof channel_rows / sizeof channel_rows[0]; i++) {
        handmade h = {.size = 0};
        image img;
        image_error error = {.text = ""};
        make_exr(&h, channel_rows[i].channels, channel_rows[i].count, NULL);
        bool good =
            image_read_as(write_file("c.exr", &h), &(image_asked){.channel = channel_rows[i].asked}, &img, &error);
        if (good && !image_choose(&img, channel_rows[i].asked, &error)) {
            image_free(&img);
            good = false;
        }
        if (good != (channel_rows[i].sentence == NULL))
            fail_msg("row %zu: %s", i, good ? "accepted" : error.text);
        if (!good) {
            assert_string_equal(error.text, channel_rows[i].sentence);
            continue;
        }
        assert_int_equal(img.file, IMAGE_EXR);
        assert_int_equal(img.channels, 1);
        assert_bits(&img, channel_rows[i].type, 0);
        image_free(&img);
    }
}

/* The one that is read and the others, as many as there is room for. */
TEST(exr_names) {
    static const exr_channel few[] = {{"A", IMAGE_F16, true}, {"B.mask", IMAGE_F32, true}, {"Z", IMAGE_F32, false}};
    exr_channel many[5];
    char names[5][64];
    if (!exr_is_read())
        skip();
    for (size_t i = 0; i < 5; i++) {
        snprintf(names[i], sizeof names[i], "layer%02zu.a.rather.long.name", i);
        many[i] = (exr_channel){i < 4 ? names[i] : "z.Z", IMAGE_F16, i < 4};
    }
    for (int k = 0; k < 2; k++) {
        handmade h = {.size = 0};
        image img;
        image_error error;
        make_exr(&h, k == 0 ? few : many, k == 0 ? 3 : 5, NULL);
        assert_true(image_parse(h.at, h.size, &img, &error));
        assert_string_equal(img.channel, k == 0 ? "Z" : "z.Z");
        if (k == 0)
            assert_string_equal(img.others, "A, B.mask");
        else
            assert_non_null(strstr(img.others, "layer02.a.rather.long.name, ..."));
        assert_true(strlen(img.others) < sizeof img.others);
        image_free(&img);
    }
}

/* The part that holds the depth is read of several, by the name of the channel or of the part, which both have. */
TEST(exr_parts) {
    static const struct {
        exr_channel channels[2];
        const char *names[2], *asked, *read, *others;
    } rows[] = {
        {{{"R", IMAGE_F16, true}, {"Z", IMAGE_F32, false}}, {"rgba", "side"}, NULL, "side.Z", "rgba.R"},
        {{{"R", IMAGE_F16, true}, {"V", IMAGE_F32, false}}, {"rgba", "depth"}, NULL, "depth.V", "rgba.R"},
        {{{"Z", IMAGE_F32, false}, {"Z", IMAGE_F16, true}}, {"left", "right"}, NULL, "left.Z", "right.Z"},
        {{{"Z", IMAGE_F32, true}, {"Z", IMAGE_F16, false}}, {"left", "right"}, "right.Z", "right.Z", "left.Z"},
        {{{"Z", IMAGE_F32, false}, {"R", IMAGE_F16, true}}, {"left", "right"}, "Z", "left.Z", "right.R"},
        {{{"R", IMAGE_F16, true}, {"Z", IMAGE_F32, true}}, {"rgba", "side"}, "side.R", NULL, NULL},
    };
    if (!exr_is_read())
        skip();
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        handmade h = {.size = 0};
        image img;
        image_error error = {.text = ""};
        make_parts(&h, rows[i].channels, rows[i].names, 2);
        const bool good =
            image_read_as(write_file("parts.exr", &h), &(image_asked){.channel = rows[i].asked}, &img, &error);
        if (good != (rows[i].read != NULL))
            fail_msg("row %zu: %s", i, good ? img.channel : error.text);
        if (!good) {
            assert_string_equal(error.text, "EXR: has no channel side.R, but rgba.R, side.Z");
            continue;
        }
        assert_string_equal(img.channel, rows[i].read);
        assert_string_equal(img.others, rows[i].others);
        assert_bits(&img, rows[i].channels[0].other ? rows[i].channels[1].type : rows[i].channels[0].type, 0);
        image_free(&img);
    }
}

/* A display window whose edges lie so much beyond those of the data window, left, top, right, bottom: what is there of
 * the data is where it belongs, and the rest is no number. */
TEST(exr_windows) {
    static const int rows[][4] = {{0, 0, 2, 0}, {-2, -1, 3, 4}, {2, 1, -3, -2}, {5, -2, 4, -1}, {-7, 3, -20, 9}};
    if (!exr_is_read())
        skip();
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        for (image_type type = IMAGE_U32; type <= IMAGE_F32; type++) {
            const int *e = rows[i], width = ACROSS + e[2] - e[0], height = DOWN + e[3] - e[1];
            const bool whole = e[0] >= 0 && e[1] >= 0 && e[2] <= 0 && e[3] <= 0;
            handmade h = {.size = 0};
            image img;
            image_error error = {.text = ""};
            make_exr(&h, &(exr_channel){"Z", type, false}, 1, e);
            if (!image_parse(h.at, h.size, &img, &error)) {
                assert_true(type == IMAGE_U32 && !whole);
                assert_non_null(strstr(error.text, "whole numbers have none for no depth"));
                continue;
            }
            assert_true(type != IMAGE_U32 || whole);
            assert_int_equal(img.width, width);
            assert_int_equal(img.height, height);
            for (int y = 0; y < height; y++)
                for (int x = 0; x < width; x++) {
                    const int column = x + e[0], row = y + e[1];
                    const bool there = column >= 0 && column < ACROSS && row >= 0 && row < DOWN;
                    const size_t at = (size_t)(y * width + x), of = (size_t)(row * ACROSS + column);
                    const uint64_t bits =
                        type == IMAGE_F16 ? ((const uint16_t *)img.data)[at] : ((const uint32_t *)img.data)[at];
                    const uint64_t infinite = type == IMAGE_F16 ? 0x7C00 : 0x7F800000,
                                   most = type == IMAGE_F16 ? 0x7FFF : 0x7FFFFFFF;
                    assert_true(there ? bits == bits_of(type, of) : (bits & most) > infinite);
                }
            image_free(&img);
        }
    handmade h = {.size = 0};
    image img;
    image_error error;
    make_exr(&h, &(exr_channel){"Z", IMAGE_F32, false}, 1, (const int[]){ACROSS, 0, ACROSS, 0});
    assert_false(image_parse(h.at, h.size, &img, &error));
    assert_string_equal(error.text, "EXR: its data window -3,5 to 19,15 has no pixel of its display window");
}

/* ---- TIFF ---------------------------------------------------------------------------------------------------------*/

typedef struct tiff_of {
    image_type type;
    uint32_t channels, photometric, orientation, format, bits, directories; /* 0: as the type has them */
    bool big, apart; /* apart: two channels, one behind the other */
    bool wide;       /* BigTIFF */
    uint32_t compression;
    void (*pack)(handmade *to, const handmade *from);
} tiff_of;

static void tiff_samples(handmade *h, const tiff_of *of, uint32_t channels) {
    const int size = (int)image_type_size(of->type), little = !of->big;
    for (size_t i = 0; i < (size_t)ALL * channels; i++)
        if (of->apart)
            handmade_number(h, bits_of(of->type, i % ALL) + i / ALL, size, little);
        else
            handmade_number(h, bits_of(of->type, i / channels) + i % channels, size, little);
}

/* A directory of numbers of 2 and 4 bytes: of more samples than two only two fit here, and two are enough. */
static void tiff_directory(handmade *h, const tiff_of *of, const uint32_t (*entries)[3], int count, uint32_t channels,
                           uint32_t part) {
    const int little = !of->big, room = of->wide ? 8 : 4;
    handmade_number(h, (uint64_t)count, of->wide ? 8 : 2, little);
    for (int i = 0; i < count; i++) {
        const bool of_strips = entries[i][0] == 273 || entries[i][0] == 279;
        const bool several =
            (of->apart && of_strips) || (channels > 2 && (entries[i][0] == 258 || entries[i][0] == 339));
        const int size = entries[i][1] == 4 ? 4 : 2;
        handmade_number(h, entries[i][0], 2, little);
        handmade_number(h, entries[i][1], 2, little);
        handmade_number(h, several ? 2 : 1, room, little);
        handmade_number(h, entries[i][2], size, little);
        if (size == 2)
            handmade_number(h, several ? entries[i][2] + (entries[i][0] == 273 ? part : 0) : 0, 2, little);
        handmade_number(h, 0, room - 4, little);
    }
}

/* One strip, or one for each channel. */
static void make_tiff(handmade *h, const tiff_of *of) {
    const int size = (int)image_type_size(of->type), little = !of->big, head = of->wide ? 16 : 8;
    const uint32_t channels = of->channels > 0 ? of->channels : 1;
    handmade plain = {.size = 0}, packed = {.size = 0};
    tiff_samples(&plain, of, channels);
    if (of->pack != NULL)
        of->pack(&packed, &plain);
    const handmade *samples = of->pack != NULL ? &packed : &plain;
    const uint32_t bytes = (uint32_t)samples->size, part = of->apart ? bytes / 2 : bytes;
    const uint32_t entries[][3] = {/* tag, type, value */
                                   {256, 3, ACROSS},
                                   {257, 3, DOWN},
                                   {258, 3, of->bits > 0 ? of->bits : 8 * (uint32_t)size},
                                   {259, 3, of->pack != NULL ? of->compression : 1},
                                   {262, 3, of->photometric > 0 ? of->photometric - 1 : 1},
                                   {273, of->apart ? 3 : 4, (uint32_t)head},
                                   {274, 3, of->orientation > 0 ? of->orientation : 1},
                                   {277, 3, channels},
                                   {278, 3, DOWN},
                                   {279, of->apart ? 3 : 4, part},
                                   {284, 3, of->apart ? 2 : 1},
                                   {339, 3,
                                    of->format > 0          ? of->format
                                    : of->type >= IMAGE_F16 ? 3
                                                            : 1}};
    handmade_text(h, of->big ? "MM" : "II");
    handmade_number(h, of->wide ? 43 : 42, 2, little);
    if (of->wide) {
        handmade_number(h, 8, 2, little);
        handmade_number(h, 0, 2, little);
    }
    handmade_number(h, (uint64_t)head + bytes, of->wide ? 8 : 4, little);
    handmade_bytes(h, samples->at, samples->size);
    for (uint32_t d = 0; d <= of->directories; d++) {
        tiff_directory(h, of, entries, sizeof entries / sizeof entries[0], channels, part);
        handmade_number(h, d < of->directories ? h->size + (of->wide ? 8 : 4) : 0, of->wide ? 8 : 4, little);
    }
}

static bool tiff_is_read(void) {
    handmade h = {.size = 0};
    make_tiff(&h, &(tiff_of){.type = IMAGE_U16});
    return is_read("TIFF", &h);
}

TEST(tiff_types) {
    if (!tiff_is_read())
        skip();
    for (int type = 0; type < IMAGE_TYPE_COUNT; type++)
        for (int how = 0; how < 4; how++)
            for (uint32_t channels = 1; channels <= 2; channels++) {
                const bool big = how % 2 != 0, wide = how / 2 != 0;
                handmade h = {.size = 0};
                image img;
                image_error error;
                if (ALL * channels * image_type_size((image_type)type) > HANDMADE_SIZE - 300)
                    continue;
                make_tiff(&h, &(tiff_of){.type = (image_type)type, .channels = channels, .big = big, .wide = wide});
                if (!image_parse(h.at, h.size, &img, &error))
                    fail_msg("%s: %s", image_type_name((image_type)type), error.text);
                assert_int_equal(img.file, IMAGE_TIFF);
                assert_int_equal(img.channels, channels);
                assert_bits(&img, (image_type)type, 0);
                image_free(&img);
            }
}

/* Channels that lie apart are put beside each other. */
TEST(tiff_apart) {
    handmade h = {.size = 0};
    image img;
    image_error error;
    if (!tiff_is_read())
        skip();
    make_tiff(&h, &(tiff_of){.type = IMAGE_U16, .channels = 2, .apart = true});
    if (!image_parse(h.at, h.size, &img, &error))
        fail_msg("%s", error.text);
    assert_int_equal(img.channels, 2);
    assert_bits(&img, IMAGE_U16, 0);
    image_free(&img);
}

/* Two tiles of 16 x 16, which reach beyond the picture on the right and below. */
TEST(tiff_tiles) {
    enum { SIDE = 16, BYTES = SIDE * SIDE * 2, HEAD = 8 };
    static const uint32_t entries[][4] = {/* tag, type, and one value or two */
                                          {256, 3, ACROSS, 0},    {257, 3, DOWN, 0}, {258, 3, 16, 0},
                                          {259, 3, 1, 0},         {262, 3, 1, 0},    {277, 3, 1, 0},
                                          {322, 3, SIDE, 0},      {323, 3, SIDE, 0}, {324, 3, HEAD, HEAD + BYTES},
                                          {325, 3, BYTES, BYTES}, {339, 3, 1, 0}};
    handmade h = {.size = 0};
    image img;
    image_error error;
    if (!tiff_is_read())
        skip();
    handmade_text(&h, "II");
    handmade_number(&h, 42, 2, 1);
    handmade_number(&h, HEAD + 2 * BYTES, 4, 1);
    for (size_t tile = 0; tile < 2; tile++)
        for (size_t y = 0; y < SIDE; y++)
            for (size_t x = tile * SIDE; x < (tile + 1) * SIDE; x++)
                handmade_number(&h, x < ACROSS && y < DOWN ? bits_of(IMAGE_U16, y * ACROSS + x) : 0xEEEE, 2, 1);
    handmade_number(&h, sizeof entries / sizeof entries[0], 2, 1);
    for (size_t i = 0; i < sizeof entries / sizeof entries[0]; i++) {
        handmade_number(&h, entries[i][0], 2, 1);
        handmade_number(&h, entries[i][1], 2, 1);
        handmade_number(&h, entries[i][3] > 0 ? 2 : 1, 4, 1);
        handmade_number(&h, entries[i][2], 2, 1);
        handmade_number(&h, entries[i][3], 2, 1);
    }
    handmade_number(&h, 0, 4, 1);
    if (!image_parse(h.at, h.size, &img, &error))
        fail_msg("%s", error.text);
    assert_bits(&img, IMAGE_U16, 0);
    image_free(&img);
}

/* Rows of bytes as they are. */
static void pack_bits(handmade *to, const handmade *from) {
    const size_t row = from->size / DOWN; /* at most 128 */
    for (size_t at = 0; at < from->size; at += row) {
        handmade_number(to, row - 1, 1, 1);
        handmade_bytes(to, from->at + at, row);
    }
}

/* Codes of 9 bits, the highest first: the table is cleared before it has more. */
static void pack_lzw(handmade *to, const handmade *from) {
    uint64_t bits = 0;
    int count = 0;
    for (size_t at = 0; at <= from->size; at++) {
        const uint32_t codes[] = {256, at < from->size ? from->at[at] : 257};
        for (int k = at % 200 == 0 ? 0 : 1; k < 2; k++) {
            bits = bits << 9 | codes[k];
            for (count += 9; count >= 8; count -= 8)
                handmade_number(to, bits >> (count - 8) & 255, 1, 1);
        }
    }
    handmade_number(to, bits << (8 - count) & 255, 1, 1);
}

/* A frame of one block as it is. */
static void pack_zstd(handmade *to, const handmade *from) {
    handmade_number(to, 0xFD2FB528, 4, 1);
    handmade_number(to, 0x60, 1, 1);
    handmade_number(to, from->size - 256, 2, 1);
    handmade_number(to, from->size << 3 | 1, 3, 1);
    handmade_bytes(to, from->at, from->size);
}

/* Those that lose nothing are not said to. */
TEST(tiff_compressions) {
    static const struct {
        uint32_t compression;
        void (*pack)(handmade *to, const handmade *from);
    } rows[] = {{5, pack_lzw}, {8, handmade_zlib}, {32773, pack_bits}, {32946, handmade_zlib}, {50000, pack_zstd}};
    if (!tiff_is_read())
        skip();
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        handmade h = {.size = 0};
        image img;
        image_error error;
        make_tiff(&h, &(tiff_of){.type = IMAGE_U16, .compression = rows[i].compression, .pack = rows[i].pack});
        if (!image_parse(h.at, h.size, &img, &error)) {
            if (rows[i].pack != pack_zstd) /* which the library may lack */
                fail_msg("%u: %s", rows[i].compression, error.text);
            continue;
        }
        if (img.lossy != NULL)
            fail_msg("%u: said to have lost by %s", rows[i].compression, img.lossy);
        assert_bits(&img, IMAGE_U16, 0);
        image_free(&img);
    }
}

/* A block of 8 by 8 samples, all 128, as JPEG in a TIFF: it is read, and told to be what a compression made of depths.
 */
TEST(tiff_jpeg) {
    static const unsigned char tables[] = {
        0xff, 0xc0, 0, 11, 8,    0, 8, 0, 8,  1, 1,    0x11, 0, /* 8 bits, 8 by 8, one component */
        0xff, 0xc4, 0, 20, 0x00, 1, 0, 0, 0,  0, 0,    0,    0,
        0,    0,    0, 0,  0,    0, 0, 0, 0, /* the code 0: no difference */
        0xff, 0xc4, 0, 20, 0x10, 1, 0, 0, 0,  0, 0,    0,    0,
        0,    0,    0, 0,  0,    0, 0, 0, 0, /* the code 0: end of block */
        0xff, 0xda, 0, 8,  1,    1, 0, 0, 63, 0, 0x3f, 0xff, 0xd9};
    enum { BYTES = 2 + 4 + 65 + sizeof tables };
    static const uint32_t entries[][2] = {/* tag, value */
                                          {256, 8}, {257, 8}, {258, 8}, {259, 7},    {262, 1},
                                          {273, 8}, {277, 1}, {278, 8}, {279, BYTES}};
    handmade h = {.size = 0};
    image img = {.data = NULL};
    image_error error;
    if (!tiff_is_read())
        skip();
    handmade_text(&h, "II");
    handmade_number(&h, 42, 2, 1);
    handmade_number(&h, 8 + BYTES, 4, 1);
    handmade_number(&h, 0xffd8, 2, 0);
    handmade_number(&h, 0xffdb0043, 4, 0);
    for (int i = 0; i < 65; i++)
        handmade_number(&h, i > 0, 1, 0);
    for (size_t i = 0; i < sizeof tables; i++)
        handmade_number(&h, tables[i], 1, 0);
    handmade_number(&h, sizeof entries / sizeof entries[0], 2, 1);
    for (size_t i = 0; i < sizeof entries / sizeof entries[0]; i++) {
        handmade_number(&h, entries[i][0], 2, 1);
        handmade_number(&h, 4, 2, 1);
        handmade_number(&h, 1, 4, 1);
        handmade_number(&h, entries[i][1], 4, 1);
    }
    handmade_number(&h, 0, 4, 1);
    if (!image_parse(h.at, h.size, &img, &error))
        fail_msg("%s", error.text);
    assert_int_equal(img.width, 8);
    for (int i = 0; i < 64; i++)
        assert_int_equal(((const uint8_t *)img.data)[i], 128);
    assert_non_null(img.lossy);
    assert_string_equal(img.lossy, "JPEG");
    image_free(&img);
}

/* 1 alone is as rows are read: from the top, each from the left. */
TEST(tiff_orientations) {
    if (!tiff_is_read())
        skip();
    for (uint32_t orientation = 1; orientation <= 8; orientation++) {
        handmade h = {.size = 0};
        image img = {.data = NULL};
        image_error error;
        char want[128];
        make_tiff(&h, &(tiff_of){.orientation = orientation});
        const bool read = image_parse(h.at, h.size, &img, &error);
        assert_int_equal(read, orientation == 1);
        snprintf(want, sizeof want, "TIFF: its first row is not the top one, or not from the left: orientation %u",
                 orientation);
        if (!read)
            assert_string_equal(error.text, want);
        image_free(&img);
    }
}

TEST(tiff_sentences) {
    static const struct {
        tiff_of of;
        const char *sentence;
    } rows[] = {
        {{.photometric = 1}, "TIFF: its 0 is white: save it with 0 as black"},
        {{.photometric = 9}, "TIFF: it is neither grey nor RGB, but of photometric interpretation 8"},
        {{.format = 2},
         "TIFF: its samples must be whole numbers of 8, 16 or 32 bits or floats of 16, 32 or 64, got 8 bits of "
         "format 2"},
        {{.bits = 4},
         "TIFF: its samples must be whole numbers of 8, 16 or 32 bits or floats of 16, 32 or 64, got 4 bits of "
         "format 1"},
        {{.directories = 1}, "TIFF: it has several images: a file must hold one image and nothing else"},
    };
    if (!tiff_is_read())
        skip();
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        handmade h = {.size = 0};
        image img = {.data = NULL};
        image_error error;
        make_tiff(&h, &rows[i].of);
        if (image_parse(h.at, h.size, &img, &error))
            fail_msg("accepted instead of: %s", rows[i].sentence);
        assert_string_equal(error.text, rows[i].sentence);
        assert_false(error.unreadable);
    }
}

/* ---- Damage -------------------------------------------------------------------------------------------------------*/

static void is_image_or_sentence(tally *t, const handmade *h, const char *what, size_t at) {
    image img = {.data = NULL};
    image_error error;
    memset(&error, 0x55, sizeof error);
    unsigned char *copy = malloc(h->size + 1); /* a copy of its own, so that a sanitizer sees more */
    assert_non_null(copy);
    memcpy(copy, h->at, h->size);
    if (image_parse(copy, h->size, &img, &error)) {
        TALLY(t, img.width <= 65536 && img.height <= 65536 && img.data != NULL, "%s %zu: an image", what, at);
        image_free(&img);
    } else {
        const char *end = memchr(error.text, '\0', sizeof error.text);
        TALLY(t, end != NULL && end > error.text && img.data == NULL, "%s %zu: no sentence", what, at);
    }
    free(copy);
}

/* Cut anywhere in front of its last sample it is refused; with any byte wrong an image comes of it, or a sentence. */
TEST(damaged_files) {
    tally t = {.name = "damaged files"};
    handmade files[2] = {{.size = 0}, {.size = 0}};
    const bool there[2] = {exr_is_read(), tiff_is_read()};
    const size_t step = test_cases(41, 3, 1);
    make_exr(&files[0], &(exr_channel){"Z", IMAGE_F32, false}, 1, NULL);
    make_tiff(&files[1], &(tiff_of){.type = IMAGE_U16});
    for (int f = 0; f < 2; f++)
        for (size_t at = 4; there[f] && at < files[f].size - 4;
             at += step) { /* behind a TIFF is the next one's place */
            handmade cut = files[f], wrong = files[f];
            image img;
            image_error error;
            cut.size = at;
            const bool good = image_parse(cut.at, cut.size, &img, &error);
            TALLY(&t, !good, "file %d cut to %zu bytes: accepted", f, at);
            if (good)
                image_free(&img);
            wrong.at[at] ^= (unsigned char)(1U << at % 8);
            is_image_or_sentence(&t, &wrong, "a bit of byte", at);
            wrong.at[at] = 0xFF;
            is_image_or_sentence(&t, &wrong, "byte", at);
        }
    if (t.cases > 0)
        tally_end(&t);
    else
        skip();
}

TEST(missing_libraries) {
    static const char *const symbols[] = {"exit", "no_such_function_of_it", NULL};
    const library absent = {"EXR", {"libnothing-of-that-name.so.7", NULL}, "libnothing7", symbols};
    const library present = {"EXR", {"libnothing-of-that-name.so.7", "libc.so.6", NULL}, "libc6", symbols};
    char error[DYNLOAD_ERROR_SIZE];
    dynload_function *found[2];
    assert_false(dynload_open(&absent, found, error));
    assert_string_equal(error, "EXR needs a library that is not there, libnothing-of-that-name.so.7: Debian's "
                               "package libnothing7 has it");
    assert_false(dynload_open(&present, found, error));
    assert_string_equal(error, "EXR: libnothing-of-that-name.so.7 has no no_such_function_of_it");
}

/* ---- Tools --------------------------------------------------------------------------------------------------------*/

/* A command makes `out` of what lies in the folder: a.exr of floats and h.exr of halves, a.tif and a.raw of u2, f.tif
 * of floats, a.png of 16 bits, b.png of 8. */
typedef struct tool_row {
    const char *tool, *command, *out;
    image_type type;
} tool_row;

static const tool_row tools[] = {
    {"exrmaketiled", "exrmaketiled -z none -t 8 8 a.exr out.exr", "out.exr", IMAGE_F32},
    {"exrmaketiled", "exrmaketiled -z rle -t 16 4 a.exr out.exr", "out.exr", IMAGE_F32},
    {"exrmaketiled", "exrmaketiled -z zip -t 64 64 a.exr out.exr", "out.exr", IMAGE_F32},
    {"exrmaketiled", "exrmaketiled -z piz -t 7 5 a.exr out.exr", "out.exr", IMAGE_F32},
    {"exrmaketiled", "exrmaketiled -z zip -m -t 8 8 a.exr out.exr", "out.exr", IMAGE_F32},
    {"exrmaketiled", "exrmaketiled -z pxr24 -t 8 8 h.exr out.exr", "out.exr", IMAGE_F16},
    {"exrmaketiled", "exrmaketiled -z piz -t 8 8 h.exr out.exr", "out.exr", IMAGE_F16},
    {"exrmultipart", "exrmultipart -combine -i y.exr a.exr -o out.exr -override 1", "out.exr", IMAGE_F32},
    {"tiffcp", "tiffcp -c none a.tif out.tif", "out.tif", IMAGE_U16},
    {"tiffcp", "tiffcp -c lzw a.tif out.tif", "out.tif", IMAGE_U16},
    {"tiffcp", "tiffcp -c zip -r 2 a.tif out.tif", "out.tif", IMAGE_U16},
    {"tiffcp", "tiffcp -c packbits a.tif out.tif", "out.tif", IMAGE_U16},
    {"tiffcp", "tiffcp -c lzw:2 a.tif out.tif", "out.tif", IMAGE_U16},
    {"tiffcp", "tiffcp -c zip:3 f.tif out.tif", "out.tif", IMAGE_F32},
    {"tiffcp", "tiffcp -c zstd:2 a.tif out.tif", "out.tif", IMAGE_U16},
    {"tiffcp", "tiffcp -c zstd:3 f.tif out.tif", "out.tif", IMAGE_F32},
    {"tiffcp", "tiffcp -c lzma:2 a.tif out.tif", "out.tif", IMAGE_U16},
    {"tiffcp", "tiffcp -c zip:2 f.tif out.tif", "out.tif", IMAGE_F32},
    {"tiffcp", "tiffcp -c lerc f.tif out.tif", "out.tif", IMAGE_F32},
    {"tiffcp", "tiffcp -c jpeg c.tif out.tif", "out.tif", IMAGE_U8},
    {"tiffcp", "tiffcp -t -w 16 -l 16 a.tif out.tif", "out.tif", IMAGE_U16},
    {"tiffcp", "tiffcp -t -w 16 -l 16 -c zip f.tif out.tif", "out.tif", IMAGE_F32},
    {"tiffcp", "tiffcp -B a.tif out.tif", "out.tif", IMAGE_U16},
    {"tiffcp", "tiffcp -8 -r 3 a.tif out.tif", "out.tif", IMAGE_U16},
    {"raw2tiff", "raw2tiff -w 23 -l 11 -d short -p minisblack a.raw out.tif", "out.tif", IMAGE_U16},
    {"convert", "convert a.png -depth 16 -compress none out.tif", "out.tif", IMAGE_U16},
    {"convert", "convert a.png -depth 16 -compress zip out.tif", "out.tif", IMAGE_U16},
    {"convert", "convert a.tif -depth 16 -define png:color-type=0 out.png", "out.png", IMAGE_U16},
    {"convert", "convert b.png -depth 8 -define dds:compression=none -define dds:mipmaps=0 out.dds", "out.dds",
     IMAGE_U8},
};

/* The filters that may have changed samples. LERC has not here, but nothing in the file says so. */
static const char *lossy_in(const char *command) {
    return strstr(command, "-c lerc") != NULL ? "LERC" : strstr(command, "-c jpeg") != NULL ? "JPEG" : NULL;
}

/* The program of that name, and ImageMagick's where several are called so. */
static bool has(const char *tool) {
    char command[128];
    snprintf(command, sizeof command, "command -v %s >/dev/null 2>&1", tool);
    return system(command) == 0 &&
           (strcmp(tool, "convert") != 0 || system("convert -version 2>&1 | grep -q 'Version: ImageMagick'") == 0);
}

static void in_folder(char folder[256]) {
    snprintf(folder, 256, "%s", scratch_file("x"));
    *strrchr(folder, '/') = '\0';
}

static void prepare(void) {
    handmade exr = {.size = 0}, half = {.size = 0}, other = {.size = 0}, tiff = {.size = 0}, real = {.size = 0};
    handmade small = {.size = 0};
    handmade raw = {.size = 0}, wide = {.size = 0}, narrow = {.size = 0}, pixels = {.size = 0}, bytes = {.size = 0};
    make_exr(&exr, &(exr_channel){"Z", IMAGE_F32, false}, 1, NULL);
    make_exr(&half, (const exr_channel[]){{"G", IMAGE_F16, false}, {"R", IMAGE_F16, false}}, 2, NULL);
    make_exr(&other, &(exr_channel){"Y", IMAGE_F16, true}, 1, NULL);
    make_tiff(&tiff, &(tiff_of){.type = IMAGE_U16});
    make_tiff(&real, &(tiff_of){.type = IMAGE_F32});
    make_tiff(&small, &(tiff_of){.type = IMAGE_U8});
    for (size_t i = 0; i < ALL; i++) {
        handmade_number(&raw, bits_of(IMAGE_U16, i), 2, __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__);
        handmade_number(&pixels, bits_of(IMAGE_U16, i), 2, 0);
        handmade_number(&bytes, bits_of(IMAGE_U8, i), 1, 0);
    }
    handmade_png(&wide, ACROSS, DOWN, 16, 0, 0, 2, pixels.at);
    handmade_png(&narrow, ACROSS, DOWN, 8, 0, 0, 1, bytes.at);
    write_file("a.exr", &exr);
    write_file("h.exr", &half);
    write_file("y.exr", &other);
    write_file("a.tif", &tiff);
    write_file("f.tif", &real);
    write_file("c.tif", &small);
    write_file("a.raw", &raw);
    write_file("a.png", &wide);
    write_file("b.png", &narrow);
}

/* One image of each writer that is there, read back to the bit. */
TEST(made_by_tools) {
    char folder[256], command[1024];
    const bool exr = exr_is_read(), tiff = tiff_is_read();
    const char *skipped = "";
    in_folder(folder);
    prepare();
    for (const tool_row *row = tools; row < tools + sizeof tools / sizeof tools[0]; row++) {
        image img;
        image_error error;
        const char *ending = strrchr(row->out, '.');
        if (!has(row->tool) || (!exr && strcmp(ending, ".exr") == 0) || (!tiff && strcmp(ending, ".tif") == 0)) {
            if (strcmp(skipped, row->tool) != 0)
                print_message("# skipped: what %s writes\n", row->tool);
            skipped = row->tool;
            continue;
        }
        snprintf(command, sizeof command, "cd '%s' && rm -f out.* && %s >tool.log 2>&1", folder, row->command);
        if (system(command) != 0)
            fail_msg("%s", row->command);
        if (!image_read(scratch_file(row->out), &img, &error))
            fail_msg("%s: %s", row->command, error.text);
        const char *lossy = lossy_in(row->command);
        if ((img.lossy == NULL) != (lossy == NULL) || (lossy != NULL && strcmp(img.lossy, lossy) != 0))
            fail_msg("%s: changed by %s", row->command, img.lossy != NULL ? img.lossy : "nothing");
        if (lossy == NULL || strcmp(lossy, "LERC") == 0)
            assert_bits(&img, row->type, 0);
        image_free(&img);
    }
}

/* Each version, order and type that NumPy writes is read; a mask is refused by name. */
TEST(made_by_numpy) {
    static const char script[] = "import numpy as n\n"
                                 "a = n.arange(1, 254).reshape(11, 23)\n"
                                 "w = lambda f, a, v: n.lib.format.write_array(open(f, 'wb'), a, version=(v, 0))\n"
                                 "for v in 1, 2, 3:\n"
                                 "    w('v%d.npy' % v, (a / n.float32(260)).astype('f4'), v)\n"
                                 "    w('t%d.npy' % v, n.asfortranarray((a / n.float32(260)).astype('>f4')), v)\n"
                                 "n.save('m.npy', a > 9)\n";
    char folder[256], command[512];
    in_folder(folder);
    handmade text = {.size = 0};
    handmade_text(&text, script);
    write_file("n.py", &text);
    snprintf(command, sizeof command, "cd '%s' && { python3 n.py || /usr/bin/python3 n.py; } >tool.log 2>&1", folder);
    if (system(command) != 0) {
        print_message("# skipped: what NumPy writes\n");
        skip();
    }
    for (int v = 1; v <= 3; v++)
        for (int fortran = 0; fortran < 2; fortran++) {
            char name[16];
            image img;
            image_error error;
            snprintf(name, sizeof name, "%c%d.npy", fortran ? 't' : 'v', v);
            if (!image_read(scratch_file(name), &img, &error))
                fail_msg("%s: %s", name, error.text);
            assert_int_equal(img.type, IMAGE_F32);
            for (int i = 0; i < ALL; i++)
                assert_true(((const float *)img.data)[i] == (float)(i + 1) / 260.0F);
            image_free(&img);
        }
    image img;
    image_error error;
    assert_false(image_read(scratch_file("m.npy"), &img, &error));
    assert_string_equal(error.text, "npy: its samples are bool, true or false, which is a mask and no depth");
}

/* The program by itself: a channel by name, and none where there are no names. */
TEST(by_the_program) {
    handmade h = {.size = 0};
    char path[256];
    if (!exr_is_read())
        skip();
    make_exr(&h, (const exr_channel[]){{"Q", IMAGE_F32, false}, {"Z", IMAGE_F32, true}}, 2, NULL);
    snprintf(path, sizeof path, "%s", write_file("q.exr", &h));
    check_says(0, "23 x 11 pixels, EXR of f4, channel Q", "texture %s --channel Q -q", path);
    check_says(2, "channel Z is read, the others are Q; --channel NAME reads another", "texture %s --metric 1", path);
    check_says(0, "\"channel\":\"Z\"", "texture %s --format fp32 -m gl -n 1 --json -q", path);
    check_says(2, "EXR: has no channel X, but Q, Z", "texture %s --channel X -q", path);
    prepare();
    check_says(2, "PNG: has no channel Z, but one without a name", "texture %s --channel Z", scratch_file("a.png"));
    check_says(2, "--channel: needs FILE", "texture --synthetic plane --channel Z");
}
