/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * PNG of 8 or 16 bits, grey or colour, with or without alpha and interlacing, by libpng. Samples are taken as they
 * are: what a file says about colours (gamma, profiles, transparency) is noted at most, and the chunks themselves are
 * stepped over. What depthprec wrote may say of itself what its samples are, in a text chunk.
 *
 * libpng leaves through longjmp when it fails. So each call into it is made below a setjmp in a function of its own,
 * and all state is in a struct outside it.
 */
#include <png.h>
#include <setjmp.h>
#include <stdio.h>
#include <string.h>

#include "image/kind.h"

static void ignore(png_structp png, png_const_charp message) {
    (void)png, (void)message;
}

static void fill(png_structp png, png_bytep to, size_t size) {
    image_source *source = png_get_io_ptr(png);
    if (source_read(source, to, size) == size)
        return;
    source_cut(source, "data");
    png_longjmp(png, 1);
}

static void damaged(png_structp png, png_const_charp message) {
    source_fail(png_get_error_ptr(png), "damaged PNG: %s", message);
    png_longjmp(png, 1);
}

#define KEYWORD "depthprec"

/* ---- Reading ----------------------------------------------------------------------------------------------------- */

typedef struct reading {
    image_source *source;
    image *out;
    png_structp png;
    png_infop info;
    size_t have; /* bytes of out->data */
} reading;

/* A linear gamma changes nothing. */
static bool is_linear(const png_byte *data, size_t size) {
    static const png_byte linear[4] = {0, 1, 0x86, 0xA0}; /* 100000 */
    return size == sizeof linear && memcmp(data, linear, sizeof linear) == 0;
}

/* The text behind the keyword; what is no plain character is none of ours. */
static void take_note(image *out, const png_byte *text, size_t size) {
    const size_t length = size < sizeof out->note - 1 ? size : sizeof out->note - 1;
    for (size_t i = 0; i < length; i++)
        out->note[i] = (char)(text[i] >= 0x20 && text[i] < 0x7f ? text[i] : '?');
    out->note[length] = '\0';
}

/* One of the chunks that are looked at. @return 1: it needs no more care */
static int look_at(png_structp png, png_unknown_chunkp chunk) {
    image *out = png_get_user_chunk_ptr(png);
    const char *name = (const char *)chunk->name;
    const size_t key = sizeof KEYWORD;
    if (strcmp(name, "sRGB") == 0)
        out->colours |= IMAGE_SRGB;
    else if (strcmp(name, "iCCP") == 0)
        out->colours |= IMAGE_PROFILE;
    else if (strcmp(name, "gAMA") == 0 && !is_linear(chunk->data, chunk->size))
        out->colours |= IMAGE_GAMMA;
    else if (strcmp(name, "tEXt") == 0 && chunk->size > key && memcmp(chunk->data, KEYWORD, key) == 0)
        take_note(out, chunk->data + key, chunk->size - key);
    return 1;
}

static bool read_header(reading *r) {
    png_read_info(r->png, r->info);
    const int bits = png_get_bit_depth(r->png, r->info);
    if (png_get_color_type(r->png, r->info) == PNG_COLOR_TYPE_PALETTE)
        return source_fail(r->source, "PNG with a palette, not with depths: save it as greyscale");
    if (bits < 8)
        return source_fail(r->source, "PNG of %d bit%s a sample: save it with 8 or 16", bits, bits > 1 ? "s" : "");
    if (!source_shape(r->source, r->out, png_get_image_width(r->png, r->info), png_get_image_height(r->png, r->info),
                      png_get_channels(r->png, r->info), bits == 16 ? IMAGE_U16 : IMAGE_U8))
        return false;
    /* Deflate makes at most 258 bytes of two bits. */
    const uint64_t least = image_bytes(r->out) / 1032;
    if (r->source->sized && r->source->left < least)
        return source_fail(
            r->source, "cut short: %u x %u pixels, %u channel%s of %s, take at least %llu bytes, and %llu follow",
            r->out->width, r->out->height, r->out->channels, r->out->channels > 1 ? "s" : "",
            image_type_name(r->out->type), (unsigned long long)least, (unsigned long long)r->source->left);
    return true;
}

static bool read_rows(reading *r) {
    const size_t row_size = image_bytes(r->out) / r->out->height;
    const int passes = png_set_interlace_handling(r->png);
    if (image_little())
        png_set_swap(r->png); /* of 16 bits alone */
    png_read_update_info(r->png, r->info);
    if (passes > 1 && !source_grow(r->source, r->out, &r->have, image_bytes(r->out)))
        return false;
    for (int pass = 0; pass < passes; pass++)
        for (size_t row = 0; row < r->out->height; row++) {
            if (!source_grow(r->source, r->out, &r->have, (row + 1) * row_size))
                return false;
            png_read_row(r->png, (png_bytep)r->out->data + row * row_size, NULL);
        }
    png_read_end(r->png, NULL);
    return source_ended(r->source);
}

static __attribute__((noinline)) bool read_guarded(reading *r) {
    static const png_byte looked_at[] = "sRGB\0gAMA\0iCCP\0tEXt"; /* each with a 0 */
    if (setjmp(png_jmpbuf(r->png)) != 0)
        return false;
    png_set_read_fn(r->png, r->source, fill);
    png_set_user_limits(r->png, PNG_UINT_31_MAX, PNG_UINT_31_MAX); /* source_shape() says it better */
    png_set_benign_errors(r->png, 0);                              /* data left over or missing are no warning here */
    png_set_keep_unknown_chunks(r->png, PNG_HANDLE_CHUNK_NEVER, NULL, -1);
    png_set_keep_unknown_chunks(r->png, PNG_HANDLE_CHUNK_ALWAYS, looked_at, sizeof looked_at / 5);
    png_set_read_user_chunk_fn(r->png, r->out, look_at);
    return read_header(r) && read_rows(r);
}

static bool read_png(image_source *source, image *out) {
    reading r = {.source = source, .out = out};
    r.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, source, damaged, ignore);
    r.info = r.png != NULL ? png_create_info_struct(r.png) : NULL;
    const bool good = r.info != NULL ? read_guarded(&r) : source_fail(source, "out of memory");
    png_destroy_read_struct(&r.png, &r.info, NULL);
    return good;
}

/* ---- Writing ----------------------------------------------------------------------------------------------------- */

static void broken(png_structp png, png_const_charp message) {
    (void)message;
    png_longjmp(png, 1);
}

static bool begin_png(image_writer *w) {
    static const int colours[] = {0, PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB,
                                  PNG_COLOR_TYPE_RGB_ALPHA};
    char keyword[] = KEYWORD, note[IMAGE_NOTE_SIZE];
    snprintf(note, sizeof note, "%s", w->note != NULL ? w->note : "");
    w->png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, broken, ignore);
    w->info = w->png != NULL ? png_create_info_struct(w->png) : NULL;
    if (w->info == NULL || setjmp(png_jmpbuf((png_structp)w->png)) != 0)
        return false;
    png_init_io(w->png, w->stream);
    png_set_compression_level(w->png, 1);
    png_set_filter(w->png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
    png_set_compression_buffer_size(w->png, 1 << 16);
    png_set_IHDR(w->png, w->info, w->width, w->height, w->type == IMAGE_U16 ? 16 : 8, colours[w->channels],
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    const png_text chunk = {.compression = PNG_TEXT_COMPRESSION_NONE, .key = keyword, .text = note};
    if (w->note != NULL)
        png_set_text(w->png, w->info, &chunk, 1);
    png_write_info(w->png, w->info);
    if (image_little())
        png_set_swap(w->png);
    return true;
}

static bool rows_png(image_writer *w, const void *rows, uint32_t count) {
    if (setjmp(png_jmpbuf((png_structp)w->png)) != 0)
        return false;
    for (uint32_t i = 0; i < count; i++)
        png_write_row(w->png, (png_const_bytep)rows + i * w->row_size);
    return true;
}

static __attribute__((noinline)) bool finish_png(image_writer *w) {
    if (setjmp(png_jmpbuf((png_structp)w->png)) != 0)
        return false;
    png_write_end(w->png, NULL);
    return true;
}

static bool end_png(image_writer *w) {
    const bool good = w->failed || finish_png(w);
    png_destroy_write_struct((png_structpp)&w->png, (png_infopp)&w->info);
    return good;
}

const image_kind image_kind_png = {
    .name = "PNG",
    .ending = ".png",
    .magic = {"\x89PNG\r\n\x1a\n", NULL},
    .magic_size = 8,
    .types = 1U << IMAGE_U8 | 1U << IMAGE_U16,
    .channels = 1U << 1 | 1U << 2 | 1U << 3 | 1U << 4,
    .read = read_png,
    .begin = begin_png,
    .rows = rows_png,
    .end = end_png,
};
