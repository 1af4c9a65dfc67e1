/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Cairo's own writer tries all filters on one thread and takes three to ten times as long. Figures are areas of few
 * colours and pictures through a scale of colours: without filters they deflate about as far as with them. Bands of
 * rows are deflated on all threads, each with the end of the one above as its dictionary, and are parts of one stream:
 * the bytes do not depend on the number of threads. See RFC 1950 and PNG (third edition) 5 and 11.
 */
#include "draw/pixels.h"

#include <stdlib.h>
#include <string.h>
#include <zlib.h>

enum { LEVEL = 5, BAND = 1 << 20, WINDOW = 1 << 15 };

/* Rows as they are deflated, and what became of them. */
typedef struct band {
    int first, count; /* rows */
    unsigned char *bytes;
    size_t size, raw;
    uLong sum;
} band;

static size_t row_size(const pixels *p) {
    return 1 + (size_t)p->width * (p->holes ? 4 : 3);
}

/* Rows with the filter "none" and the bytes of pixels in the order of the file. */
static void pack_rows(const pixels *p, int first, int count, unsigned char *to) {
    const size_t size = p->holes ? 4 : 3;
    for (int y = first; y < first + count; y++) {
        const uint32_t *from = p->at + (size_t)y * p->stride;
        *to++ = 0;
        for (int x = 0; x < p->width; x++, to += size) {
            to[0] = (unsigned char)(from[x] >> 16);
            to[1] = (unsigned char)(from[x] >> 8);
            to[2] = (unsigned char)from[x];
            if (p->holes)
                to[3] = (unsigned char)(from[x] >> 24);
        }
    }
}

/* Deflates up to a whole byte, or, in the last band, to the end. */
static bool deflate_rows(unsigned char *raw, size_t before, bool last, band *b) {
    z_stream z = {0};
    const size_t window = before < WINDOW ? before : WINDOW;
    if (deflateInit2(&z, LEVEL, Z_DEFLATED, -MAX_WBITS, 9, Z_DEFAULT_STRATEGY) != Z_OK)
        return false;
    const size_t room = deflateBound(&z, (uLong)b->raw) + 16;
    b->bytes = malloc(room);
    z.next_in = raw + before;
    z.avail_in = (uInt)b->raw;
    z.next_out = b->bytes;
    z.avail_out = (uInt)room;
    const bool good = b->bytes != NULL &&
                      (window == 0 || deflateSetDictionary(&z, raw + before - window, (uInt)window) == Z_OK) &&
                      deflate(&z, last ? Z_FINISH : Z_SYNC_FLUSH) == (last ? Z_STREAM_END : Z_OK) && z.avail_in == 0;
    b->size = z.total_out;
    deflateEnd(&z);
    return good;
}

static bool make_band(const pixels *p, band *b) {
    const size_t row = row_size(p);
    const int wanted = (int)(WINDOW / row) + 1, above = b->first < wanted ? b->first : wanted;
    const size_t before = (size_t)above * row;
    b->raw = (size_t)b->count * row;
    unsigned char *raw = malloc(before + b->raw);
    if (raw == NULL)
        return false;
    pack_rows(p, b->first - above, above + b->count, raw);
    b->sum = adler32(1, raw + before, (uInt)b->raw);
    const bool good = deflate_rows(raw, before, b->first + b->count == p->height, b);
    free(raw);
    return good;
}

static void big_endian(unsigned char to[4], uLong v) {
    for (int i = 0; i < 4; i++)
        to[i] = (unsigned char)(v >> (24 - 8 * i));
}

static void chunk(FILE *out, const char type[4], const void *data, size_t size) {
    unsigned char head[8], tail[4];
    big_endian(head, (uLong)size);
    memcpy(head + 4, type, 4);
    const uLong crc = crc32(crc32(0, head + 4, 4), size > 0 ? data : head, (uInt)size);
    big_endian(tail, crc);
    fwrite(head, 1, sizeof head, out);
    if (size > 0)
        fwrite(data, 1, size, out);
    fwrite(tail, 1, sizeof tail, out);
}

/* Keyword, null, no compression (two bytes), no language, no translated keyword, then UTF-8. */
static bool write_words(FILE *out, const char *keyword, const char *content) {
    const size_t key = strlen(keyword) + 5, size = key + strlen(content);
    char *data = calloc(size + 1, 1);
    if (data == NULL)
        return false;
    memcpy(data, keyword, strlen(keyword));
    memcpy(data + key, content, strlen(content));
    chunk(out, "iTXt", data, size);
    free(data);
    return true;
}

static bool write_head(FILE *out, const pixels *p, const notes *words) {
    unsigned char header[13] = {[8] = 8, [9] = p->holes ? 6 : 2};
    big_endian(header, (uLong)p->width);
    big_endian(header + 4, (uLong)p->height);
    fwrite("\x89PNG\r\n\x1a\n", 1, 8, out);
    chunk(out, "IHDR", header, sizeof header);
    return words == NULL ||
           (write_words(out, "Title", words->title) && write_words(out, "Description", words->description) &&
            write_words(out, "Source", words->command) && write_words(out, "Comment", words->data));
}

bool pixels_write_png(FILE *out, const pixels *p, const notes *words) {
    static const unsigned char start[2] = {0x78, 0x5E}; /* deflate, a window of 32 KiB, a fast level */
    const int rows = (int)(BAND / row_size(p)) + 1, count = (p->height + rows - 1) / rows;
    band *bands = calloc((size_t)count, sizeof *bands);
    bool good = write_head(out, p, words);
    if (bands == NULL)
        return false;
#pragma omp parallel for schedule(dynamic) reduction(&& : good) if (count > 1)
    for (int i = 0; i < count; i++) {
        const int first = i * rows, rest = p->height - first;
        bands[i] = (band){.first = first, .count = rest < rows ? rest : rows};
        good = good && make_band(p, &bands[i]);
    }
    uLong sum = 1;
    chunk(out, "IDAT", start, sizeof start);
    for (int i = 0; i < count && good; i++) {
        chunk(out, "IDAT", bands[i].bytes, bands[i].size);
        sum = adler32_combine(sum, bands[i].sum, (z_off_t)bands[i].raw);
    }
    unsigned char end[4];
    big_endian(end, sum);
    chunk(out, "IDAT", end, sizeof end);
    chunk(out, "IEND", NULL, 0);
    for (int i = 0; i < count; i++)
        free(bands[i].bytes);
    free(bands);
    return good && !ferror(out);
}
