/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bytes that are not trusted: what a file claims is compared with what is there before memory is asked for. */
#include <errno.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "image/kind.h"
#include "system/pages.h"

static const struct {
    const char *name;
    size_t size;
} types[IMAGE_TYPE_COUNT] = {
    [IMAGE_U8] = {"u1", 1},  [IMAGE_U16] = {"u2", 2}, [IMAGE_U32] = {"u4", 4},
    [IMAGE_F16] = {"f2", 2}, [IMAGE_F32] = {"f4", 4}, [IMAGE_F64] = {"f8", 8},
};

const char *image_type_name(image_type type) {
    return (unsigned)type < IMAGE_TYPE_COUNT ? types[type].name : NULL;
}

size_t image_type_size(image_type type) {
    return (unsigned)type < IMAGE_TYPE_COUNT ? types[type].size : 0;
}

bool source_fail(image_source *source, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(source->error->text, sizeof source->error->text, format, arguments);
    va_end(arguments);
    source->error->unreadable = 0;
    for (char *c = source->error->text; *c != '\0'; c++)
        if ((unsigned char)*c < 0x20 || (unsigned char)*c >= 0x7f)
            *c = '?';
    return false;
}

bool source_library(image_source *source, const library *l, dynload_function *functions[]) {
    char error[DYNLOAD_ERROR_SIZE];
    return dynload_open(l, functions, error) || source_fail(source, "%s", error);
}

size_t source_read(image_source *source, void *to, size_t size) {
    const size_t ready = size < source->ready_size ? size : source->ready_size;
    if (ready > 0)
        memcpy(to, source->ready, ready);
    source->ready += ready;
    source->ready_size -= ready;
    size_t got = ready;
    if (got < size && source->stream != NULL) {
        errno = 0;
        got += fread((unsigned char *)to + got, 1, size - got, source->stream);
    }
    if (source->sized)
        source->left -= got < source->left ? got : source->left;
    return got;
}

bool source_cut(image_source *source, const char *within) {
    if (source->stream != NULL && ferror(source->stream)) {
        const int number = errno;
        source_fail(source, "cannot read: %s", strerror(number));
        source->error->unreadable = number;
        return false;
    }
    return source_fail(source, "cut short within its %s", within);
}

bool source_header(image_source *source, void *to, size_t size) {
    return source_read(source, to, size) == size || source_cut(source, "header");
}

bool source_shape(image_source *source, image *out, uint64_t width, uint64_t height, uint32_t channels,
                  image_type type) {
    if (width < 1 || height < 1 || width > IMAGE_SIDE_MAX || height > IMAGE_SIDE_MAX)
        return source_fail(source, "width and height must be from 1 to %u pixels, got %llu x %llu", IMAGE_SIDE_MAX,
                           (unsigned long long)width, (unsigned long long)height);
    if (width * height > IMAGE_PIXELS_MAX)
        return source_fail(source, "must have at most %llu pixels, got %llu x %llu",
                           (unsigned long long)IMAGE_PIXELS_MAX, (unsigned long long)width, (unsigned long long)height);
    out->width = (uint32_t)width;
    out->height = (uint32_t)height;
    out->channels = channels;
    out->type = type;
    return true;
}

size_t image_bytes(const image *img) {
    return (size_t)img->width * img->height * img->channels * image_type_size(img->type);
}

bool source_grow(image_source *source, image *out, size_t *have, size_t need) {
    enum { FIRST = 1 << 20 };
    if (need <= *have)
        return true;
    const size_t all = image_bytes(out);
    size_t size = *have < FIRST ? FIRST : *have;
    while (size < need)
        size *= 2;
    if (source->sized || size > all)
        size = all;
    void *grown = realloc(out->data, size);
    if (grown == NULL)
        return source_fail(source, "out of memory: %u x %u pixels need %zu bytes", out->width, out->height, all);
    pages_large(grown, size);
    out->data = grown;
    *have = size;
    return true;
}

static bool misfit(image_source *source, const image *out, uint64_t there) {
    const size_t all = image_bytes(out);
    return source_fail(source, "%s: %u x %u pixels, %u channel%s of %s, take %zu bytes, and %llu follow%s the header",
                       there < all ? "cut short" : "too long", out->width, out->height, out->channels,
                       out->channels > 1 ? "s" : "", image_type_name(out->type), all, (unsigned long long)there,
                       there == 1 ? "s" : "");
}

static void reverse_bytes(unsigned char *at, size_t bytes, size_t size) {
    for (const unsigned char *end = at + bytes; at < end; at += size)
        for (size_t i = 0; i < size / 2; i++) {
            const unsigned char other = at[i];
            at[i] = at[size - 1 - i];
            at[size - 1 - i] = other;
        }
}

bool source_samples(image_source *source, image *out, bool little) {
    const size_t all = image_bytes(out);
    if (source->sized && source->left != all)
        return misfit(source, out, source->left);
    size_t have = 0;
    for (size_t done = 0; done < all; done = have) {
        if (!source_grow(source, out, &have, done + 1))
            return false;
        const size_t got = source_read(source, (unsigned char *)out->data + done, have - done);
        if (done + got == have)
            continue;
        return source->stream != NULL && ferror(source->stream) ? source_cut(source, "samples")
                                                                : misfit(source, out, done + got);
    }
    if (little != image_little())
        reverse_bytes(out->data, image_bytes(out), image_type_size(out->type));
    return source_ended(source);
}

bool source_all(image_source *source, unsigned char **bytes, size_t *size) {
    enum { FIRST = 1 << 20 };
    const uint64_t most = UINT64_C(1) << 32;
    size_t room = source->sized && source->left < most ? (size_t)source->left + 1 : FIRST, have = 0;
    unsigned char *all = NULL;
    for (bool more = true; more; room *= 2) {
        unsigned char *grown = have > most ? NULL : realloc(all, room);
        if (grown == NULL) {
            free(all);
            return have > most ? source_fail(source, "is larger than 4 GiB") : source_fail(source, "out of memory");
        }
        all = grown;
        have += source_read(source, all + have, room - have);
        more = have == room;
    }
    if (source->stream != NULL && ferror(source->stream)) {
        free(all);
        return source_cut(source, "bytes");
    }
    source->sized = false;
    *bytes = all;
    *size = have;
    return true;
}

bool source_ended(image_source *source) {
    unsigned char more;
    if (source_read(source, &more, 1) == 0)
        return source->stream == NULL || !ferror(source->stream) || source_cut(source, "end");
    return source_fail(source, "something follows the image: a file must hold one image and nothing else");
}

bool image_rows_plain(image_writer *writer, const void *rows, uint32_t count) {
    const size_t size = image_type_size(writer->type);
    if (image_little() || size == 1)
        return fwrite(rows, writer->row_size, count, writer->stream) == count;
    unsigned char some[4096]; /* whole samples */
    const unsigned char *from = rows;
    for (size_t left = writer->row_size * count, bytes; left > 0; left -= bytes, from += bytes) {
        bytes = left < sizeof some ? left : sizeof some;
        memcpy(some, from, bytes);
        reverse_bytes(some, bytes, size);
        if (fwrite(some, 1, bytes, writer->stream) != bytes)
            return false;
    }
    return true;
}
