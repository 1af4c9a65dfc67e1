/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * NumPy's .npy, versions 1.0 to 3.0: a magic, a version, the length of a header, the header (a Python dictionary with
 * the keys descr, fortran_order and shape) and the samples.
 * Source: NEP 1 and numpy.lib.format, https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html
 */
#include <stdlib.h>
#include <string.h>

#include "image/kind.h"

#define MAGIC "\x93NUMPY"
enum { MAGIC_SIZE = 6, HEADER_MAX = 10000, DIMENSIONS = 3 };

/* Where the dictionary is being read, and what it said. */
typedef struct dictionary {
    image_source *source;
    const char *at;
    char descr[16];
    bool fortran;
    uint64_t shape[DIMENSIONS];
    int dimensions;
    const char *shape_text;
    int shape_length;
} dictionary;

static bool expected(dictionary *d, const char *what) {
    return source_fail(d->source, "npy: its header must have %s at '%.24s'", what, d->at);
}

static void blanks(dictionary *d) {
    d->at += strspn(d->at, " \t\r\n");
}

static bool mark(dictionary *d, char c) {
    blanks(d);
    if (*d->at != c)
        return false;
    d->at++;
    return true;
}

/* A short text in quotes, without escapes. */
static bool quoted(dictionary *d, char out[16]) {
    blanks(d);
    const char quote = *d->at;
    if (quote != '\'' && quote != '"')
        return expected(d, "a word in quotes");
    const char *end = strchr(d->at + 1, quote);
    if (end == NULL || end - d->at > 15)
        return expected(d, "a short word in quotes");
    const size_t length = (size_t)(end - d->at - 1);
    memcpy(out, d->at + 1, length);
    out[length] = '\0';
    d->at = end + 1;
    return true;
}

static bool read_descr(dictionary *d) {
    blanks(d);
    if (*d->at == '[')
        return source_fail(d->source, "npy: it holds records; save one field of them, a[\"name\"]");
    return quoted(d, d->descr);
}

static bool read_fortran(dictionary *d) {
    static const char *const names[2] = {"False", "True"};
    blanks(d);
    for (int i = 0; i < 2; i++)
        if (strncmp(d->at, names[i], strlen(names[i])) == 0) {
            d->at += strlen(names[i]);
            d->fortran = i != 0;
            return true;
        }
    return expected(d, "True or False");
}

static bool read_shape(dictionary *d) {
    blanks(d);
    d->shape_text = d->at;
    if (!mark(d, '('))
        return expected(d, "a shape in ( )");
    for (d->dimensions = 0; !mark(d, ')'); d->dimensions++) {
        if (d->dimensions > 0 && !mark(d, ','))
            return expected(d, "a comma");
        if (d->dimensions > 0 && mark(d, ')'))
            break;
        blanks(d);
        const size_t digits = strspn(d->at, "0123456789");
        if (digits < 1 || digits > 18)
            return expected(d, "a whole number");
        if (d->dimensions < DIMENSIONS)
            d->shape[d->dimensions] = strtoull(d->at, NULL, 10);
        d->at += digits;
    }
    d->shape_length = (int)(d->at - d->shape_text);
    return true;
}

static const struct {
    const char *key;
    bool (*read)(dictionary *d);
} keys[] = {{"descr", read_descr}, {"fortran_order", read_fortran}, {"shape", read_shape}};
enum { KEYS = sizeof keys / sizeof keys[0] };

static bool read_dictionary(dictionary *d) {
    unsigned seen = 0;
    if (!mark(d, '{'))
        return expected(d, "'{'");
    while (!mark(d, '}')) {
        char name[16];
        const char *before = d->at;
        int k = 0;
        if (!quoted(d, name))
            return false;
        while (k < KEYS && strcmp(keys[k].key, name) != 0)
            k++;
        if (k == KEYS || (seen >> k & 1U) != 0) {
            d->at = before;
            return expected(d, "descr, fortran_order and shape once each");
        }
        seen |= 1U << k;
        if (!mark(d, ':'))
            return expected(d, "':'");
        if (!keys[k].read(d))
            return false;
        if (!mark(d, ',') && (blanks(d), *d->at != '}'))
            return expected(d, "a comma or '}'");
    }
    blanks(d);
    if (*d->at != '\0')
        return expected(d, "nothing more");
    return seen == (1U << KEYS) - 1 ||
           source_fail(d->source, "npy: its header must have descr, fortran_order and shape");
}

/* "<f4": which byte comes first, and the type. */
static bool read_type(dictionary *d, image_type *type, bool *little) {
    const char order = d->descr[0];
    for (int i = 0; i < IMAGE_TYPE_COUNT && order != '\0'; i++) {
        *type = (image_type)i;
        if (strcmp(d->descr + 1, image_type_name(*type)) != 0)
            continue;
        *little = order == '<' || (order != '>' && image_little());
        if (strchr("<>=", order) != NULL || (order == '|' && image_type_size(*type) == 1))
            return true;
    }
    if (strcmp(d->descr, "|b1") == 0)
        return source_fail(d->source, "npy: its samples are bool, true or false, which is a mask and no depth");
    return source_fail(d->source,
                       "npy: its samples must be f2, f4, f8, u1, u2 or u4, got '%s': save a.astype(\"f4\"), or u4 for "
                       "codes",
                       d->descr);
}

static bool read_sides(dictionary *d, image_type type, image *out) {
    const uint64_t channels = d->dimensions == DIMENSIONS ? d->shape[2] : 1;
    if ((d->dimensions != 2 && d->dimensions != DIMENSIONS) || channels < 1 || channels > IMAGE_CHANNELS_MAX)
        return source_fail(d->source,
                           "npy: its shape must be (height, width) or (height, width, channels) with 1 to %d "
                           "channels, got %.*s",
                           IMAGE_CHANNELS_MAX, d->shape_length < 80 ? d->shape_length : 80, d->shape_text);
    return source_shape(d->source, out, d->shape[1], d->shape[0], (uint32_t)channels, type);
}

/* ---- Samples ------------------------------------------------------------------------------------------------------*/

/* Rows run slowest in Fortran's order of a[row][column][channel]: a stripe of columns at a time, so that what is read
 * from memory is used up. */
static bool transpose(image_source *source, image *out) {
    const size_t width = out->width, height = out->height, channels = out->channels, stripe = 32;
    const size_t size = image_type_size(out->type);
    const unsigned char *from = out->data;
    unsigned char *to = malloc(image_bytes(out));
    if (to == NULL)
        return source_fail(source, "out of memory: %u x %u pixels in Fortran's order need %zu bytes twice", out->width,
                           out->height, image_bytes(out));
    for (size_t k = 0; k < channels; k++)
        for (size_t first = 0; first < width; first += stripe)
            for (size_t y = 0; y < height; y++)
                for (size_t x = first; x < first + stripe && x < width; x++)
                    memcpy(to + ((y * width + x) * channels + k) * size, from + ((k * width + x) * height + y) * size,
                           size);
    free(out->data);
    out->data = to;
    return true;
}

static bool read_npy(image_source *source, image *out) {
    unsigned char head[MAGIC_SIZE + 2], size[4] = {0};
    char text[HEADER_MAX + 1];
    if (!source_header(source, head, sizeof head))
        return false;
    if (head[MAGIC_SIZE] < 1 || head[MAGIC_SIZE] > 3)
        return source_fail(source, "npy: its version must be 1.0, 2.0 or 3.0, got %d.%d", head[MAGIC_SIZE],
                           head[MAGIC_SIZE + 1]);
    if (!source_header(source, size, head[MAGIC_SIZE] == 1 ? 2 : 4))
        return false;
    const uint32_t length = size[0] | (uint32_t)size[1] << 8 | (uint32_t)size[2] << 16 | (uint32_t)size[3] << 24;
    if (length > HEADER_MAX)
        return source_fail(source, "npy: its header must have at most %d bytes, got %u", HEADER_MAX, length);
    if (!source_header(source, text, length))
        return false;
    text[length] = '\0';

    dictionary d = {.source = source, .at = text};
    image_type type = IMAGE_U8;
    bool little = true;
    return read_dictionary(&d) && read_type(&d, &type, &little) && read_sides(&d, type, out) &&
           source_samples(source, out, little) && (!d.fortran || transpose(source, out));
}

/* ---- Writing ------------------------------------------------------------------------------------------------------*/

static bool begin_npy(image_writer *w) {
    enum { SIZE = 192, UNIT = 64 }; /* the samples begin at a multiple of 64 bytes */
    char text[SIZE], channels[16] = "";
    const char order = w->type == IMAGE_U8 ? '|' : '<';
    if (w->channels > 1)
        snprintf(channels, sizeof channels, ", %u", w->channels);
    const int used = snprintf(text, sizeof text, "{'descr': '%c%s', 'fortran_order': False, 'shape': (%u, %u%s), }",
                              order, image_type_name(w->type), w->height, w->width, channels);
    const size_t before = MAGIC_SIZE + 4, all = (before + (size_t)used + 1 + UNIT - 1) / UNIT * UNIT;
    const size_t size = all - before;
    memset(text + used, ' ', size - (size_t)used);
    text[size - 1] = '\n';
    const unsigned char version[4] = {1, 0, (unsigned char)(size & 0xFF), (unsigned char)(size >> 8)};
    return fwrite(MAGIC, 1, MAGIC_SIZE, w->stream) == MAGIC_SIZE &&
           fwrite(version, 1, sizeof version, w->stream) == sizeof version && fwrite(text, 1, size, w->stream) == size;
}

const image_kind image_kind_npy = {
    .name = "npy",
    .ending = ".npy",
    .magic = {MAGIC, NULL},
    .magic_size = MAGIC_SIZE,
    .types = (1U << IMAGE_TYPE_COUNT) - 1,
    .channels = 1U << 1 | 1U << 2 | 1U << 3 | 1U << 4,
    .read = read_npy,
    .begin = begin_npy,
    .rows = image_rows_plain,
};
