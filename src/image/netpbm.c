/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * PGM: "P5", width, height and the largest sample as words, one blank, and samples of one byte up to 255, else of two,
 * the higher one first. Whoever writes lengths has them as they are, whatever the largest.
 *
 * PFM: "Pf" (one channel) or "PF" (three), width, height and scale as words, one blank, and binary32 samples, the
 * bottom row first. The sign of the scale says which byte comes first. Its magnitude is 1 here and nothing else,
 * because some programs multiply the samples by it and others do not.
 *
 * Between the words may be any blanks, and comments from # to the end of their line. The one blank before the samples
 * is CR LF where that also follows the first word: the samples themselves may begin with any byte.
 * Sources: https://netpbm.sourceforge.net/doc/pgm.html; Paul Debevec's description of PFM,
 * http://www.pauldebevec.com/Research/HDR/PFM/
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "image/kind.h"

enum { WORD_SIZE = 32, HEADER_MAX = 10000 };

/* The header, a character at a time. */
typedef struct header {
    image_source *source;
    const char *name;
    char magic[3];
    size_t size; /* what was read of it */
    char last;
    bool returns; /* CR LF follows the magic */
} header;

static bool next(header *h) {
    if (h->size++ >= HEADER_MAX)
        return source_fail(h->source, "%s: its header must have at most %d bytes", h->name, HEADER_MAX);
    return source_header(h->source, &h->last, 1);
}

static bool is_blank(char c) {
    return c != '\0' && strchr(" \t\n\v\f\r", c) != NULL;
}

/* Skips to the first character that is neither blank nor comment. */
static bool skip(header *h) {
    bool comment = false;
    do {
        if (!next(h))
            return false;
        comment = comment ? h->last != '\n' && h->last != '\r' : h->last == '#';
    } while (comment || is_blank(h->last));
    return true;
}

/* A word and the one blank behind it; what is before it is skipped. */
static bool word(header *h, const char *what, char out[WORD_SIZE]) {
    size_t length = 0;
    if (!skip(h))
        return false;
    while (!is_blank(h->last)) {
        if (length + 1 >= WORD_SIZE || h->last < 0x21 || h->last > 0x7e)
            return source_fail(h->source, "%s: its %s must be a number", h->name, what);
        out[length++] = h->last;
        if (!next(h))
            return false;
    }
    out[length] = '\0';
    return true;
}

static bool side(header *h, const char *what, uint64_t *out) {
    char text[WORD_SIZE];
    if (!word(h, what, text))
        return false;
    const size_t length = strlen(text);
    if (strspn(text, "0123456789") != length || length > 18)
        return source_fail(h->source, "%s: its %s must be a whole number, got '%s'", h->name, what, text);
    *out = strtoull(text, NULL, 10);
    return true;
}

static bool read_scale(header *h, bool *little) {
    char text[WORD_SIZE], *end;
    if (!word(h, "scale", text))
        return false;
    const double scale = strtod(text, &end);
    *little = scale < 0;
    if (*end == '\0' && fabs(scale) == 1)
        return true;
    return source_fail(h->source,
                       "PFM: its scale must be 1 or -1, got '%s': programs disagree on whether it multiplies the "
                       "samples; write 1 or -1 there once they are what they should be",
                       text);
}

/* Rows come from the bottom. */
static void flip(image *img) {
    const size_t words = (size_t)img->width * img->channels;
    uint32_t *low = img->data, *high = low + words * (img->height - 1);
    for (; low < high; low += words, high -= words)
        for (size_t i = 0; i < words; i++) {
            const uint32_t other = low[i];
            low[i] = high[i];
            high[i] = other;
        }
}

/* The magic, the blank behind it, and the sides. */
static bool begin(header *h, uint64_t sides[2]) {
    if (!source_header(h->source, h->magic, 2) || !next(h))
        return false;
    if (!is_blank(h->last))
        return source_fail(h->source, "%s: a blank must follow '%s'", h->name, h->magic);
    h->returns = h->last == '\r' && h->source->ready_size > 0 && *h->source->ready == '\n';
    return side(h, "width", &sides[0]) && side(h, "height", &sides[1]);
}

/* The blank before the samples. */
static bool end(header *h, const char *last) {
    return !h->returns || h->last != '\r' || (next(h) && h->last == '\n') ||
           source_fail(h->source, "%s: CR LF must follow its %s, as it follows '%s'", h->name, last, h->magic);
}

static bool read_pfm(image_source *source, image *out) {
    header h = {.source = source, .name = "PFM"};
    uint64_t sides[2] = {0};
    bool little = true;
    if (!begin(&h, sides) || !read_scale(&h, &little) || !end(&h, "scale") ||
        !source_shape(source, out, sides[0], sides[1], h.magic[1] == 'F' ? 3 : 1, IMAGE_F32) ||
        !source_samples(source, out, little))
        return false;
    flip(out);
    return true;
}

static bool read_pgm(image_source *source, image *out) {
    header h = {.source = source, .name = "PGM"};
    uint64_t sides[2] = {0}, most = 0;
    if (!begin(&h, sides) || !side(&h, "maxval", &most) || !end(&h, "maxval"))
        return false;
    if (most < 1 || most > UINT16_MAX)
        return source_fail(source, "PGM: its maxval must be from 1 to 65535, got %llu", (unsigned long long)most);
    const image_type type = most > UINT8_MAX ? IMAGE_U16 : IMAGE_U8;
    if (!source_shape(source, out, sides[0], sides[1], 1, type) || !source_samples(source, out, false))
        return false;
    out->most = most == UINT8_MAX || most == UINT16_MAX ? 0 : (uint32_t)most;
    for (size_t i = 0; i < (size_t)out->width * out->height && out->most > 0; i++) {
        const unsigned sample = type == IMAGE_U8 ? ((uint8_t *)out->data)[i] : ((uint16_t *)out->data)[i];
        if (sample > out->most)
            return source_fail(source, "PGM: a sample is %u, above its maxval of %u", sample, out->most);
    }
    return true;
}

static bool begin_pfm(image_writer *w) {
    return fprintf(w->stream, "%s\n%u %u\n-1.0\n", w->channels == 3 ? "PF" : "Pf", w->width, w->height) > 0;
}

const image_kind image_kind_pfm = {
    .name = "PFM",
    .ending = ".pfm",
    .magic = {"Pf", "PF"},
    .magic_size = 2,
    .types = 1U << IMAGE_F32,
    .channels = 1U << 1 | 1U << 3,
    .bottom_up = true,
    .read = read_pfm,
    .begin = begin_pfm,
    .rows = image_rows_plain,
};

const image_kind image_kind_pgm = {
    .name = "PGM",
    .ending = ".pgm",
    .magic = {"P5"},
    .magic_size = 2,
    .types = 1U << IMAGE_U8 | 1U << IMAGE_U16,
    .channels = 1U << 1,
    .read = read_pgm,
};
