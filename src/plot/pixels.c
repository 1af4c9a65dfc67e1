/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Cairo's own writer tries all filters and takes three to four times as long. Figures are areas of few colours and
 * pictures through a scale of colours: without filters they deflate as far as with them.
 *
 * libpng leaves through longjmp when it fails: all state is in a struct outside the function with the setjmp.
 */
#include "plot/pixels.h"

#include <png.h>
#include <setjmp.h>
#include <stdlib.h>

enum { LEVEL = 5, WORDS = 4 };

typedef struct writing {
    FILE *out;
    const pixels *p;
    const notes *words;
    png_structp png;
    png_infop info;
    png_bytep row;
} writing;

static void fail(png_structp png, png_const_charp message) {
    (void)message;
    png_longjmp(png, 1);
}

static void ignore(png_structp png, png_const_charp message) {
    (void)png, (void)message;
}

static void write_words(const writing *w) {
    const char *const pairs[WORDS][2] = {{"Title", w->words->title},
                                         {"Description", w->words->description},
                                         {"Source", w->words->command},
                                         {"Comment", w->words->data}};
    png_text text[WORDS] = {0};
    char keyword[WORDS][16], none[] = "";
    for (int i = 0; i < WORDS; i++) {
        snprintf(keyword[i], sizeof keyword[i], "%s", pairs[i][0]);
        text[i] = (png_text){.compression = PNG_ITXT_COMPRESSION_NONE,
                             .key = keyword[i],
                             .text = (png_charp)(uintptr_t)pairs[i][1], /* libpng copies it */
                             .lang = none,
                             .lang_key = none};
    }
    png_set_text(w->png, w->info, text, WORDS);
}

/* The bytes of a row in the order of the file, whatever the processor's is. */
static void unpack_row(const pixels *p, int y, png_bytep to) {
    const uint32_t *from = p->at + (size_t)y * p->stride;
    const size_t size = p->holes ? 4 : 3;
    for (int x = 0; x < p->width; x++, to += size) {
        to[0] = (png_byte)(from[x] >> 16);
        to[1] = (png_byte)(from[x] >> 8);
        to[2] = (png_byte)from[x];
        if (p->holes)
            to[3] = (png_byte)(from[x] >> 24);
    }
}

static __attribute__((noinline)) bool write_guarded(writing *w) {
    const pixels *p = w->p;
    if (setjmp(png_jmpbuf(w->png)) != 0)
        return false;
    png_init_io(w->png, w->out);
    png_set_compression_level(w->png, LEVEL);
    png_set_filter(w->png, PNG_FILTER_TYPE_BASE, PNG_FILTER_NONE);
    png_set_compression_buffer_size(w->png, 1 << 16);
    png_set_IHDR(w->png, w->info, (png_uint_32)p->width, (png_uint_32)p->height, 8,
                 p->holes ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (w->words != NULL)
        write_words(w);
    png_write_info(w->png, w->info);
    for (int y = 0; y < p->height; y++) {
        unpack_row(p, y, w->row);
        png_write_row(w->png, w->row);
    }
    png_write_end(w->png, NULL);
    return true;
}

bool pixels_write_png(FILE *out, const pixels *p, const notes *words) {
    writing w = {.out = out, .p = p, .words = words, .row = malloc((size_t)p->width * 4)};
    w.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, fail, ignore);
    w.info = w.png != NULL ? png_create_info_struct(w.png) : NULL;
    const bool good = w.info != NULL && w.row != NULL && write_guarded(&w);
    png_destroy_write_struct(&w.png, &w.info);
    free(w.row);
    return good;
}
