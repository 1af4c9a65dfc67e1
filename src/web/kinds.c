/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The page in place of image/png.c and of kinds that need libraries: it hands over a PNG's first 33 bytes and its rows
 * as the browser has inflated them, see image.js.
 */
#include <string.h>

#include "image/kind.h"

enum { HEAD = 33, WIDTH_AT = 16, HEIGHT_AT = 20, BITS_AT = 24, COLOUR_AT = 25, INTERLACED_AT = 28 };

static uint32_t number_at(const unsigned char *at) {
    return (uint32_t)at[0] << 24 | (uint32_t)at[1] << 16 | (uint32_t)at[2] << 8 | at[3];
}

/* Guesses a byte from the one before it, the one above, and the one before that. */
static int guess(int filter, int left, int up, int corner) {
    const int a = up > corner ? up - corner : corner - up, b = left > corner ? left - corner : corner - left;
    const int both = left + up - 2 * corner, c = both < 0 ? -both : both;
    return filter == 1        ? left
           : filter == 2      ? up
           : filter == 3      ? (left + up) / 2
           : a <= b && a <= c ? left
           : b <= c           ? up
                              : corner;
}

static void unfilter(int filter, unsigned char *row, const unsigned char *above, size_t size, size_t step) {
    for (size_t i = 0; filter > 0 && i < size; i++) {
        const bool before = i >= step;
        row[i] = (unsigned char)(row[i] + guess(filter, before ? row[i - step] : 0, above != NULL ? above[i] : 0,
                                                before && above != NULL ? above[i - step] : 0));
    }
}

static bool read_rows(image_source *source, image *out) {
    const size_t step = out->channels * image_type_size(out->type), size = step * out->width;
    unsigned char *row = out->data, filter;
    for (uint32_t y = 0; y < out->height; y++, row += size) {
        if (source_read(source, &filter, 1) != 1 || source_read(source, row, size) != size)
            return source_fail(source, "damaged PNG: it has fewer rows than it says");
        if (filter > 4)
            return source_fail(source, "damaged PNG: no filter is %d", filter);
        unfilter(filter, row, y > 0 ? row - size : NULL, size, step);
    }
    unsigned char *at = out->data;
    for (; out->type == IMAGE_U16 && at < row; at += 2) {
        const unsigned char high = at[0];
        at[0] = at[1];
        at[1] = high;
    }
    return source_ended(source);
}

static bool read_png(image_source *source, image *out) {
    static const uint32_t channels[] = {1, 0, 3, 0, 2, 0, 4}; /* by the type of its colours */
    unsigned char head[HEAD];
    size_t have = 0;
    if (!source_header(source, head, sizeof head))
        return false;
    const int bits = head[BITS_AT], colour = head[COLOUR_AT];
    if (colour > 6 || channels[colour] == 0 || bits < 8 || head[INTERLACED_AT] != 0)
        return source_fail(source, "PNG of a palette, of fewer than 8 bits or interlaced is not read in the page: save "
                                   "it as grey of 16 bits");
    return source_shape(source, out, number_at(head + WIDTH_AT), number_at(head + HEIGHT_AT), channels[colour],
                        bits == 16 ? IMAGE_U16 : IMAGE_U8) &&
           source_grow(source, out, &have, image_bytes(out)) && read_rows(source, out);
}

const image_kind image_kind_png = {
    .name = "PNG", .ending = ".png", .magic = {"\x89PNG\r\n\x1a\n"}, .magic_size = 8, .read = read_png};

static bool read_none(image_source *source, image *out) {
    (void)out;
    return source_fail(source, "this kind of file is not read in the page: save PNG, npy, PFM or PGM");
}

const image_kind image_kind_dds = {
    .name = "DDS", .ending = ".dds", .magic = {"DDS "}, .magic_size = 4, .read = read_none};
const image_kind image_kind_exr = {
    .name = "EXR", .ending = ".exr", .magic = {"\x76\x2f\x31\x01"}, .magic_size = 4, .read = read_none};
const image_kind image_kind_tiff = {
    .name = "TIFF", .ending = ".tif", .magic = {"II*", "MM\0*"}, .magic_size = 4, .read = read_none};
const image_kind image_kind_ros = {.name = "compressedDepth", .ending = ".cdepth", .read = read_none};
