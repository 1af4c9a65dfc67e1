/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * TIFF by libtiff: one image of whole numbers of 8, 16 or 32 bits or of floats of 16, 32 or 64, grey or colour, strips
 * or tiles, channels beside each other or apart, in any compression that the library has.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/kind.h"

#if __has_include(<tiffio.h>)

#include <tiffio.h>

#include "system/dynload.h"

/* The functions of the library that are called. */
#define FUNCTIONS(X)                                                                                                   \
    X(TIFFSetErrorHandler)                                                                                             \
    X(TIFFSetWarningHandler)                                                                                           \
    X(TIFFClientOpen)                                                                                                  \
    X(TIFFClose)                                                                                                       \
    X(TIFFGetField)                                                                                                    \
    X(TIFFGetFieldDefaulted)                                                                                           \
    X(TIFFIsTiled)                                                                                                     \
    X(TIFFScanlineSize64)                                                                                              \
    X(TIFFReadScanline)                                                                                                \
    X(TIFFTileSize64)                                                                                                  \
    X(TIFFReadTile)                                                                                                    \
    X(TIFFReadDirectory)
DYNLOAD_FUNCTIONS(FUNCTIONS)
static const library libtiff = {"TIFF", {"libtiff.so.6", "libtiff.so.5", NULL}, "libtiff6", symbols};

/* Everything of a file. */
typedef struct reading {
    functions call;
    image_source *source;
    image *out;
    unsigned char *bytes;
    size_t size;
    uint64_t at; /* where the library reads */
    TIFF *file;
    size_t have;     /* bytes of out->data */
    uint32_t planes; /* of channels that lie apart; else 1 */
} reading;

static tmsize_t give(thandle_t of, void *to, tmsize_t size) {
    reading *r = (reading *)of;
    const uint64_t left = r->at < r->size ? r->size - r->at : 0, some = (uint64_t)size < left ? (uint64_t)size : left;
    memcpy(to, r->bytes + (some > 0 ? r->at : 0), some);
    r->at += some;
    return (tmsize_t)some;
}

static tmsize_t take_nothing(thandle_t of, void *from, tmsize_t size) {
    (void)of, (void)from, (void)size;
    return 0;
}

static toff_t seek(thandle_t of, toff_t offset, int from) {
    reading *r = (reading *)of;
    r->at = offset + (from == SEEK_CUR ? r->at : from == SEEK_END ? r->size : 0);
    return r->at;
}

static int leave_open(thandle_t of) {
    (void)of;
    return 0;
}

static toff_t give_size(thandle_t of) {
    return ((const reading *)of)->size;
}

static uint32_t number(const reading *r, uint32_t tag) {
    uint16_t value = 0;
    return r->call.TIFFGetFieldDefaulted(r->file, tag, &value) == 1 ? value : 0;
}

static bool find_type(reading *r, image_type *type) {
    static const struct {
        uint32_t format, bits;
        image_type type;
    } types[] = {{SAMPLEFORMAT_UINT, 8, IMAGE_U8},     {SAMPLEFORMAT_UINT, 16, IMAGE_U16},
                 {SAMPLEFORMAT_UINT, 32, IMAGE_U32},   {SAMPLEFORMAT_IEEEFP, 16, IMAGE_F16},
                 {SAMPLEFORMAT_IEEEFP, 32, IMAGE_F32}, {SAMPLEFORMAT_IEEEFP, 64, IMAGE_F64}};
    const uint32_t format = number(r, TIFFTAG_SAMPLEFORMAT), bits = number(r, TIFFTAG_BITSPERSAMPLE);
    for (size_t i = 0; i < sizeof types / sizeof types[0]; i++)
        if (types[i].format == format && types[i].bits == bits) {
            *type = types[i].type;
            return true;
        }
    return source_fail(r->source,
                       "TIFF: its samples must be whole numbers of 8, 16 or 32 bits or floats of 16, 32 or "
                       "64, got %u bits of format %u",
                       bits, format);
}

static bool find_shape(reading *r) {
    const uint32_t colours = number(r, TIFFTAG_PHOTOMETRIC), channels = number(r, TIFFTAG_SAMPLESPERPIXEL);
    uint32_t width = 0, height = 0;
    image_type type = IMAGE_U8;
    r->call.TIFFGetField(r->file, TIFFTAG_IMAGEWIDTH, &width);
    r->call.TIFFGetField(r->file, TIFFTAG_IMAGELENGTH, &height);
    r->planes = number(r, TIFFTAG_PLANARCONFIG) == PLANARCONFIG_SEPARATE ? channels : 1;
    if (colours == PHOTOMETRIC_MINISWHITE)
        return source_fail(r->source, "TIFF: its 0 is white: save it with 0 as black");
    if (colours != PHOTOMETRIC_MINISBLACK && colours != PHOTOMETRIC_RGB)
        return source_fail(r->source, "TIFF: it is neither grey nor RGB, but of photometric interpretation %u",
                           colours);
    if (number(r, TIFFTAG_ORIENTATION) != ORIENTATION_TOPLEFT)
        return source_fail(r->source, "TIFF: its first row is not the top one, or not from the left: orientation %u",
                           number(r, TIFFTAG_ORIENTATION));
    if (channels < 1 || channels > IMAGE_CHANNELS_MAX)
        return source_fail(r->source, "TIFF: it must have 1 to %d channels, got %u", IMAGE_CHANNELS_MAX, channels);
    return find_type(r, &type) && source_shape(r->source, r->out, width, height, channels, type);
}

/* Null where it gives back what it was given. LERC and WebP may do so, too, which nothing in the file says. */
static const char *lossy_name(const reading *r) {
    static const uint32_t exact[] = {COMPRESSION_NONE,          COMPRESSION_LZW,     COMPRESSION_PACKBITS,
                                     COMPRESSION_ADOBE_DEFLATE, COMPRESSION_DEFLATE, COMPRESSION_LZMA,
                                     COMPRESSION_ZSTD};
    static const struct {
        uint32_t how;
        const char *name;
    } lossy[] = {{COMPRESSION_JPEG, "JPEG"},
                 {COMPRESSION_OJPEG, "JPEG"},
                 {COMPRESSION_LERC, "LERC"},
                 {COMPRESSION_WEBP, "WebP"},
                 {COMPRESSION_PIXARLOG, "PixarLog"}};
    const uint32_t how = number(r, TIFFTAG_COMPRESSION);
    for (size_t i = 0; i < sizeof exact / sizeof exact[0]; i++)
        if (how == exact[i])
            return NULL;
    for (size_t i = 0; i < sizeof lossy / sizeof lossy[0]; i++)
        if (how == lossy[i].how)
            return lossy[i].name;
    return "an unknown one";
}

static bool damaged(reading *r, uint64_t row) {
    return source_fail(r->source, "damaged TIFF: row %llu cannot be read", (unsigned long long)row);
}

/* Pixels of one plane, or of all channels, to where they belong in a row of the image. */
static void place(const reading *r, uint32_t plane, const unsigned char *from, uint32_t x, uint32_t y, uint32_t count) {
    const size_t size = image_type_size(r->out->type), pixel = r->out->channels * size, part = pixel / r->planes;
    unsigned char *to = (unsigned char *)r->out->data + ((size_t)y * r->out->width + x) * pixel + plane * part;
    for (uint32_t i = 0; i < count; i++)
        memcpy(to + i * pixel, from + i * part, part);
}

static bool read_strips(reading *r, uint32_t plane) {
    const size_t row = image_bytes(r->out) / r->out->height, part = row / r->planes;
    if (r->call.TIFFScanlineSize64(r->file) != part)
        return source_fail(r->source, "damaged TIFF: its rows have another size than its width says");
    unsigned char *line = malloc(part);
    bool good = line != NULL || source_fail(r->source, "out of memory");
    for (uint32_t y = 0; good && y < r->out->height; y++) {
        good = source_grow(r->source, r->out, &r->have, (y + (size_t)1) * row) &&
               (r->call.TIFFReadScanline(r->file, line, y, (uint16_t)plane) == 1 || damaged(r, y));
        if (good)
            place(r, plane, line, 0, y, r->out->width);
    }
    free(line);
    return good;
}

static bool read_tile(reading *r, uint32_t plane, unsigned char *tile, const uint32_t at[2], const uint32_t sides[2]) {
    const size_t row = image_bytes(r->out) / r->out->height, part = row / r->out->width / r->planes;
    const uint32_t columns = r->out->width - at[0] < sides[0] ? r->out->width - at[0] : sides[0];
    const uint32_t rows = r->out->height - at[1] < sides[1] ? r->out->height - at[1] : sides[1];
    if (!source_grow(r->source, r->out, &r->have, (at[1] + (size_t)rows) * row))
        return false;
    if (r->call.TIFFReadTile(r->file, tile, at[0], at[1], 0, (uint16_t)plane) < 0)
        return damaged(r, at[1]);
    for (uint32_t i = 0; i < rows; i++)
        place(r, plane, tile + (size_t)i * sides[0] * part, at[0], at[1] + i, columns);
    return true;
}

static bool read_tiles(reading *r, uint32_t plane) {
    const uint64_t most = UINT64_C(1) << 28;
    const size_t part = r->out->channels / r->planes * image_type_size(r->out->type);
    uint32_t sides[2] = {0, 0};
    r->call.TIFFGetField(r->file, TIFFTAG_TILEWIDTH, &sides[0]);
    r->call.TIFFGetField(r->file, TIFFTAG_TILELENGTH, &sides[1]);
    const uint64_t size = (uint64_t)sides[0] * sides[1] * part;
    if (sides[0] < 1 || sides[1] < 1 || sides[0] > most || sides[1] > most / sides[0] || size > most ||
        r->call.TIFFTileSize64(r->file) != size)
        return source_fail(r->source,
                           "damaged TIFF: its tiles have another size than they say, or more than 2^28 bytes");
    unsigned char *tile = malloc(size);
    bool good = tile != NULL || source_fail(r->source, "out of memory");
    for (uint64_t y = 0; good && y < r->out->height; y += sides[1])
        for (uint64_t x = 0; good && x < r->out->width; x += sides[0])
            good = read_tile(r, plane, tile, (const uint32_t[]){(uint32_t)x, (uint32_t)y}, sides);
    free(tile);
    return good;
}

static bool read_file(reading *r) {
    r->call.TIFFSetErrorHandler(NULL); /* it would print */
    r->call.TIFFSetWarningHandler(NULL);
    r->file = r->call.TIFFClientOpen("image", "rm", (thandle_t)r, give, take_nothing, seek, leave_open, give_size, NULL,
                                     NULL);
    if (r->file == NULL)
        return source_fail(r->source, "damaged TIFF: its first directory cannot be read");
    if (!find_shape(r))
        return false;
    r->out->lossy = lossy_name(r);
    const bool tiled = r->call.TIFFIsTiled(r->file) != 0;
    for (uint32_t plane = 0; plane < r->planes; plane++)
        if (!(tiled ? read_tiles(r, plane) : read_strips(r, plane)))
            return false;
    return r->call.TIFFReadDirectory(r->file) != 1 ||
           source_fail(r->source, "TIFF: it has several images: a file must hold one image and nothing else");
}

static bool read_tiff(image_source *source, image *out) {
    reading r = {.source = source, .out = out};
    if (!source_library(source, &libtiff, r.call.all) || !source_all(source, &r.bytes, &r.size))
        return false;
    const bool good = read_file(&r);
    if (r.file != NULL)
        r.call.TIFFClose(r.file);
    free(r.bytes);
    return good;
}

#else

static bool read_tiff(image_source *source, image *out) {
    (void)out;
    return source_fail(source, "TIFF is not read by this build, which had no header tiffio.h: Debian's package "
                               "libtiff-dev has it");
}

#endif

const image_kind image_kind_tiff = {
    .name = "TIFF",
    .ending = ".tif",
    .magic = {"II*\0", "MM\0*", "II+\0", "MM\0+"},
    .magic_size = 4,
    .types = (1U << IMAGE_TYPE_COUNT) - 1,
    .channels = 1U << 1 | 1U << 2 | 1U << 3 | 1U << 4,
    .read = read_tiff,
};
