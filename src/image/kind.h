/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file kind.h  For this room alone: where bytes come from, and the row of a kind of file.
 */
#ifndef IMAGE_KIND_H
#define IMAGE_KIND_H

#include "image/image.h"
#include "system/dynload.h"

/** Bytes to read: what is ready first, then the stream. */
typedef struct image_source {
    const unsigned char *ready; /**< the memory, or the first bytes of the stream */
    size_t ready_size;
    FILE *stream;  /**< null: there is only what is ready */
    bool sized;    /**< the length is known: memory, or a regular file */
    uint64_t left; /**< sized: bytes not yet read */
    image_asked asked;
    image_error *error;
} image_source;

/** Writes the sentence, in which control characters become '?'. @return false */
bool source_fail(image_source *source, const char *format, ...) __attribute__((format(printf, 2, 3)));

/** Opens a library for a file of its kind. @return false after its sentence */
bool source_library(image_source *source, const library *l, dynload_function *functions[]);

/** @return how many bytes there were */
size_t source_read(image_source *source, void *to, size_t size);

/** After a short read: the stream failed, or "cut short" within what is named. @return false */
bool source_cut(image_source *source, const char *within);

/** The same for a header: exactly `size` bytes. */
bool source_header(image_source *source, void *to, size_t size);

/** Checks the size of an image and fills all of *out but its data. */
bool source_shape(image_source *source, image *out, uint64_t width, uint64_t height, uint32_t channels,
                  image_type type);

/** Bytes of the whole image. */
size_t image_bytes(const image *image);

/**
 * Makes out->data at least `need` bytes long; *have is its size. Where the length of the source is known, and so was
 * compared with what the image needs, it becomes as long as the image at once, otherwise it grows as bytes arrive.
 */
bool source_grow(image_source *source, image *out, size_t *have, size_t need);

/** Reads all samples, behind which the file must end. @param little  its samples have the lowest byte first */
bool source_samples(image_source *source, image *out, bool little);

/**
 * All bytes, malloc'ed, at most 4 GiB, for readers that seek. From then on the image grows as its rows are
 * read, whatever the length of the source.
 */
bool source_all(image_source *source, unsigned char **bytes, size_t *size);

/** Nothing may follow. */
bool source_ended(image_source *source);

/** Whether this machine stores the lowest byte first. */
static inline bool image_little(void) {
    return __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__;
}

struct image_writer {
    FILE *stream;
    const struct image_kind *kind;
    image_type type;
    uint32_t width, height, channels;
    size_t row_size;
    uint32_t rows_left;
    bool failed;
    const char *note; /**< null: none */
    void *png, *info; /**< of png.c */
};

/** A kind of file. */
typedef struct image_kind {
    const char *name, *ending;
    const char *magic[4];        /**< the first bytes, one or the other; null: no other, of raw none */
    size_t magic_size, magic_at; /**< and how many bytes come before it */
    unsigned types, channels;    /**< bit sets of what it holds */
    bool bottom_up;
    bool (*read)(image_source *source, image *out); /**< the magic is still to be read; on failure data stays for the
                                                         caller to free */
    bool (*begin)(image_writer *writer);            /**< null, as the next two: it is not written */
    bool (*rows)(image_writer *writer, const void *rows, uint32_t count);
    bool (*end)(image_writer *writer); /**< null: nothing follows the samples. Always called, to free */
} image_kind;

extern const image_kind image_kind_png, image_kind_pfm, image_kind_npy, image_kind_dds, image_kind_exr, image_kind_tiff,
    image_kind_pgm, image_kind_raw, image_kind_ros;

/** Writes the samples alone, the lowest byte first on every machine: `rows` of PFM and npy. */
bool image_rows_plain(image_writer *writer, const void *rows, uint32_t count);

#endif
