/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which of several channels is depth, in every kind of file that has them: pixels put together here. */
#include "handmade.h"
#include "image/channel.h"
#include "image/image.h"
#include "printed.h"

enum { WIDE = 5, HIGH = 3, PIXELS = WIDE * HIGH };

/* The sample of the last pixel that is unlike all others, whose colours are the same. */
typedef enum odd { NOTHING = 0, GREEN, BLUE, ALPHA } odd;

/* A sample in bytes that any type has: of floats a small number, of others a code. */
static uint64_t bits_of(image_type type, size_t pixel, size_t channel, odd unlike) {
    const uint64_t base = 3 * pixel + 5,
                   code = base + (pixel == PIXELS - 1 && channel > 0 && channel == (size_t)unlike);
    const float real = (float)code / 128;
    const double wide = (double)code / 128;
    uint64_t out = 0;
    if (type < IMAGE_F16)
        return channel == 3 && unlike != ALPHA ? base : code;
    if (type == IMAGE_F16)
        return 0x3400 + code;
    memcpy(&out, type == IMAGE_F32 ? (const void *)&real : &wide, type == IMAGE_F32 ? 4 : 8);
    if (type == IMAGE_F32 && __BYTE_ORDER__ != __ORDER_LITTLE_ENDIAN__)
        out >>= 32;
    return out;
}

static void samples(handmade *h, image_type type, uint32_t channels, odd unlike, bool little) {
    for (size_t i = 0; i < PIXELS; i++)
        for (uint32_t k = 0; k < channels; k++)
            handmade_number(h, bits_of(type, i, k, unlike), (int)image_type_size(type), little);
}

static void make_png(handmade *h, image_type type, uint32_t channels, odd unlike) {
    handmade raw = {.size = 0};
    const size_t size = image_type_size(type);
    samples(&raw, type, channels, unlike, false);
    handmade_png(h, WIDE, HIGH, (int)(8 * size),
                 channels == 1   ? 0
                 : channels == 2 ? 4
                 : channels == 3 ? 2
                                 : 6,
                 0, channels * size, raw.at);
}

static void make_npy(handmade *h, image_type type, uint32_t channels, odd unlike) {
    char header[128];
    snprintf(header, sizeof header, "{'descr': '%s%s', 'fortran_order': False, 'shape': (%d, %d, %u), }",
             type == IMAGE_U8 ? "|" : "<", image_type_name(type), HIGH, WIDE, channels);
    handmade_npy(h, 1, header);
    samples(h, type, channels, unlike, true);
}

/* Rows of PFM run from the bottom: of one row here, so that the last pixel is the last. */
static void make_pfm(handmade *h, image_type type, uint32_t channels, odd unlike) {
    handmade_text(h, channels == 3 ? "PF\n15 1\n-1.0\n" : "Pf\n15 1\n-1.0\n");
    samples(h, type, channels, unlike, true);
}

static void make_dds(handmade *h, image_type type, uint32_t channels, odd unlike) {
    const handmade_dds_of of =
        channels == 4   ? (handmade_dds_of){.flags = 0x41, .bits = 32, .masks = {0xFF, 0xFF00, 0xFF0000, 0xFF000000}}
        : channels == 2 ? (handmade_dds_of){.flags = 4, .fourcc = 0x30315844, .dxgi = 49}
                        : (handmade_dds_of){.flags = 0x40, .bits = 24, .masks = {0xFF0000, 0xFF00, 0xFF}};
    handmade raw = {.size = 0};
    handmade_dds(h, WIDE, HIGH, &of);
    samples(&raw, type, channels, unlike, true);
    for (size_t i = 0; i < raw.size; i++) /* three of them have blue first */
        handmade_bytes(h, &raw.at[channels == 3 ? i / 3 * 3 + 2 - i % 3 : i], 1);
}

/* One strip of all channels, or one of each. */
static void make_tiff(handmade *h, image_type type, uint32_t channels, odd unlike, bool apart) {
    const uint32_t size = (uint32_t)image_type_size(type), strips = apart ? channels : 1, part = PIXELS * size,
                   bytes = part * channels, arrays = 8 + bytes;
    const uint32_t entries[][4] = {/* tag, type, count, value or place */
                                   {256, 3, 1, WIDE},
                                   {257, 3, 1, HIGH},
                                   {258, 3, channels, arrays},
                                   {259, 3, 1, 1},
                                   {262, 3, 1, channels >= 3 ? 2 : 1},
                                   {273, 4, strips, strips == 1 ? 8 : arrays + 16},
                                   {277, 3, 1, channels},
                                   {278, 3, 1, HIGH},
                                   {279, 4, strips, strips == 1 ? bytes : arrays + 32},
                                   {284, 3, 1, apart ? 2 : 1},
                                   {339, 3, channels, arrays + 8}};
    enum { ENTRIES = sizeof entries / sizeof entries[0] };
    handmade_text(h, "II");
    handmade_number(h, 42, 2, 1);
    handmade_number(h, arrays + 48, 4, 1);
    for (size_t i = 0; i < (size_t)PIXELS * channels; i++)
        handmade_number(h, bits_of(type, apart ? i % PIXELS : i / channels, apart ? i / PIXELS : i % channels, unlike),
                        (int)size, 1);
    for (uint32_t k = 0; k < 8; k++) /* bits, then formats, of four channels */
        handmade_number(h, k < 4 ? 8 * size : type >= IMAGE_F16 ? 3 : 1, 2, 1);
    for (uint32_t k = 0; k < 8; k++)
        handmade_number(h, k < 4 ? 8 + k * part : part, 4, 1);
    handmade_number(h, ENTRIES, 2, 1);
    for (size_t i = 0; i < ENTRIES; i++) {
        handmade_number(h, entries[i][0], 2, 1);
        handmade_number(h, entries[i][1], 2, 1);
        handmade_number(h, entries[i][2], 4, 1);
        if (entries[i][1] == 3 && entries[i][2] == 2) { /* two of 16 bits fit in place */
            handmade_number(h, entries[i][0] == 258 ? 8 * size : type >= IMAGE_F16 ? 3 : 1, 2, 1);
            handmade_number(h, entries[i][0] == 258 ? 8 * size : type >= IMAGE_F16 ? 3 : 1, 2, 1);
        } else {
            handmade_number(h, entries[i][3], 4, 1);
        }
    }
    handmade_number(h, 0, 4, 1);
}

static void make_tiff_apart(handmade *h, image_type type, uint32_t channels, odd unlike) {
    make_tiff(h, type, channels, unlike, true);
}

static void make_tiff_beside(handmade *h, image_type type, uint32_t channels, odd unlike) {
    make_tiff(h, type, channels, unlike, false);
}

static const struct kind {
    const char *name;
    void (*make)(handmade *h, image_type type, uint32_t channels, odd unlike);
    image_type types[IMAGE_TYPE_COUNT];
    size_t type_count;
    uint32_t least, most; /* channels */
} kinds[] = {
    {"PNG", make_png, {IMAGE_U8, IMAGE_U16}, 2, 2, 4},
    {"npy", make_npy, {IMAGE_U8, IMAGE_U16, IMAGE_U32, IMAGE_F16, IMAGE_F32, IMAGE_F64}, 6, 2, 4},
    {"PFM", make_pfm, {IMAGE_F32}, 1, 3, 3},
    {"DDS", make_dds, {IMAGE_U8}, 1, 2, 4},
    {"TIFF", make_tiff_beside, {IMAGE_U8, IMAGE_U16, IMAGE_F32}, 3, 2, 4},
    {"TIFF", make_tiff_apart, {IMAGE_U8, IMAGE_U16, IMAGE_F32}, 3, 2, 4},
};

/* Asked for by name, it alone is left, bit by bit. */
static void check_taken(const image *img, image_type type, uint32_t channel, odd unlike) {
    const size_t size = image_type_size(type);
    assert_int_equal(img->channels, 1);
    for (size_t i = 0; i < PIXELS; i++) {
        uint64_t got = 0;
        for (size_t k = 0; k < size; k++)
            got |= (uint64_t)((const unsigned char *)
                                  img->data)[i * size + (__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__ ? k : size - 1 - k)]
                   << 8 * k;
        assert_true(got == bits_of(type, i, channel, unlike));
    }
}

static void check_file(const struct kind *k, image_type type, uint32_t channels, odd unlike) {
    const char *const names = strcmp(k->name, "PNG") == 0 && channels == 2 ? "YA" : "RGBA";
    const bool colour = channels >= 3 && (unlike == GREEN || unlike == BLUE);
    handmade h = {.size = 0};
    char said[256], others[16] = "", asked[2] = "";
    image img;
    image_error error = {.text = ""};
    k->make(&h, type, channels, unlike);
    for (uint32_t c = 0; c <= channels + 1; c++) { /* of each channel by name, of one that it has not, of none */
        if (!image_parse(h.at, h.size, &img, &error))
            fail_msg("%s of %s, %u channels: %s", k->name, image_type_name(type), channels, error.text);
        assert_int_equal(img.channels, channels);
        asked[0] = c < channels ? names[c] : 'Z';
        const bool good = image_choose(&img, c <= channels ? asked : NULL, &error);
        if (good != (c < channels || (c > channels && !colour)))
            fail_msg("%s of %s, %u channels, odd %d, asked %u: %s", k->name, image_type_name(type), channels, unlike, c,
                     good ? "taken" : error.text);
        if (c == channels) {
            snprintf(said, sizeof said, "%s: has no channel Z, but %c, %c", k->name, names[0], names[1]);
            assert_memory_equal(error.text, said, strlen(said));
        } else if (!good) {
            snprintf(
                said, sizeof said,
                "%s: its channels R and %s differ, so it is a colour picture and no depth: --channel R reads one of "
                "them all the same",
                k->name, unlike == GREEN ? "G" : "B");
            assert_memory_equal(error.text, said, strlen(said));
            assert_int_equal(strstr(error.text, "--packing NAME") != NULL, type == IMAGE_U8);
        } else {
            assert_true(img.channel[0] == names[c < channels ? c : 0] && img.channel[1] == '\0');
            others[0] = '\0';
            for (uint32_t i = 0; i < channels; i++)
                if (i != (c < channels ? c : 0))
                    snprintf(others + strlen(others), sizeof others - strlen(others), "%s%c", *others ? ", " : "",
                             names[i]);
            assert_string_equal(img.others, others);
            if (c < channels)
                check_taken(&img, type, c, unlike);
        }
        image_free(&img);
    }
}

static bool is_here(const struct kind *k) {
    handmade h = {.size = 0};
    image img;
    image_error error;
    k->make(&h, k->types[0], 3, NOTHING);
    const bool good = image_parse(h.at, h.size, &img, &error);
    if (good)
        image_free(&img);
    else if (strstr(error.text, "Debian's package") == NULL)
        fail_msg("%s: %s", k->name, error.text);
    return good;
}

TEST(every_kind) {
    for (const struct kind *k = kinds; k < kinds + sizeof kinds / sizeof kinds[0]; k++)
        for (size_t t = 0; t < k->type_count && is_here(k); t++)
            for (uint32_t channels = k->least; channels <= k->most; channels++)
                for (odd unlike = NOTHING; unlike <= ALPHA; unlike++)
                    check_file(k, k->types[t], channels, unlike);
}

static const char *write_file(const char *name, const handmade *h) {
    const char *path = scratch_file(name);
    FILE *f = fopen(path, "wb");
    assert_non_null(f);
    assert_int_equal(fwrite(h->at, 1, h->size, f), h->size);
    fclose(f);
    return path;
}

/* What Blender, Nuke and others call depth; and what merely ends so, or is of another layer. */
TEST(names_of_depth) {
    static const char *const depth[] = {
        "Z",       "z",     "depth",      "Depth", "ViewLayer.Depth.Z", "ViewLayer.Depth.V", "depth.R", "View.depth.Y",
        "Depth.X", "a.b.Z", "layer.DEPTH"};
    static const char *const other[] = {"R",         "V", "Y",        "zdepth",   "Depth.G", "ViewLayer.Combined.R",
                                        "mydepth.V", "A", "depth.Zz", "Normal.X", "Depth.B", "ViewLayer.Mist.Y"};
    for (size_t i = 0; i < sizeof depth / sizeof depth[0]; i++)
        if (!channel_of_depth(depth[i]))
            fail_msg("%s is no depth", depth[i]);
    for (size_t i = 0; i < sizeof other / sizeof other[0]; i++)
        if (channel_of_depth(other[i]))
            fail_msg("%s is depth", other[i]);
}

/* Lengths, window depths and disparities of a colour picture are refused alike; a packing takes all channels. */
TEST(by_the_program) {
    handmade grey = {.size = 0}, colour = {.size = 0}, one = {.size = 0};
    char path[256], same[256], single[256];
    make_png(&grey, IMAGE_U16, 3, NOTHING);
    make_png(&colour, IMAGE_U8, 3, BLUE);
    make_png(&one, IMAGE_U16, 1, NOTHING);
    snprintf(same, sizeof same, "%s", write_file("grey.png", &grey));
    snprintf(path, sizeof path, "%s", write_file("colour.png", &colour));
    snprintf(single, sizeof single, "%s", write_file("one.png", &one));
    static const char *const readings[] = {"--metric mm", "--format unorm8 -n 1 -m gl", "--stereo kitti-stereo", ""};
    for (size_t i = 0; i < sizeof readings / sizeof readings[0]; i++)
        check_says(2,
                   "PNG: its channels R and B differ, so it is a colour picture and no depth: --channel R reads one of "
                   "them all the same; --packing NAME, a depth that several hold together",
                   "texture %s %s", path, readings[i]);
    check_says(0, "PNG of u1, channel B", "texture %s --metric mm --channel B", path);
    check_says(0, "packed as rgb24", "texture %s --packing rgb24 -n 1 -m gl -F d24", path);
    check_says(2, "", "texture %s --packing rgb24 --channel G -n 1 -m gl -F d24", path);
    printed p = print_of("texture %s --metric mm", same);
    assert_int_equal(p.status, 0);
    assert_non_null(strstr(p.errors, "channel R is read, the others are G, B; --channel NAME reads another"));
    printed_free(&p);
    check_says(0, "\"channel\":\"R\"", "texture %s --metric mm --json -q", same);
    check_says(2, "PNG: has no channel R, but one without a name", "texture %s --metric mm --channel R", single);
}
