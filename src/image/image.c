/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "image/image.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "core/append.h"
#include "image/kind.h"
#include "system/input.h"
#include "system/posix.h"

enum { HEAD_SIZE = 20 };

static const image_kind *const kinds[IMAGE_FILE_COUNT] = {
    [IMAGE_PNG] = &image_kind_png, [IMAGE_PFM] = &image_kind_pfm, [IMAGE_NPY] = &image_kind_npy,
    [IMAGE_DDS] = &image_kind_dds, [IMAGE_EXR] = &image_kind_exr, [IMAGE_TIFF] = &image_kind_tiff,
    [IMAGE_PGM] = &image_kind_pgm, [IMAGE_RAW] = &image_kind_raw, [IMAGE_ROS] = &image_kind_ros};

/* Files that people have instead, so that they are told what to do and not only what is wrong. */
static const struct {
    const char *magic;
    size_t size;
    const char *what;
} others[] = {
    {"PK\3\4", 4, "a zip archive: of an .npz, unpack the .npy"},
    {"\xff\xd8\xff", 3, "JPEG, which keeps no depths: save PNG of 16 bits, PFM or .npy"},
    {"P2", 2, "PGM in plain text: convert it to P5"},
    {"P6", 2, "PPM, which has colours: convert it to PNG"},
    {"\xabKTX", 4, "KTX: save its pixels as .npy"},
    {"#?RADIANCE", 8, "Radiance HDR: convert it to PFM"},
};

const char *image_file_name(image_file file) {
    return (unsigned)file < IMAGE_FILE_COUNT ? kinds[file]->name : NULL;
}

static bool ends(const char *path, const char *ending) {
    const size_t length = strlen(path), size = strlen(ending);
    return length > size && strcasecmp(path + length - size, ending) == 0;
}

bool image_file_of(const char *path, image_file *out) {
    for (int i = 0; i < IMAGE_WRITTEN_COUNT; i++)
        if (ends(path, kinds[i]->ending)) {
            *out = (image_file)i;
            return true;
        }
    return false;
}

/* ---- Reading ----------------------------------------------------------------------------------------------------- */

static bool begins(const unsigned char *head, size_t size, const char *magic, size_t magic_size) {
    return magic != NULL && size >= magic_size && memcmp(head, magic, magic_size) == 0;
}

static bool unknown(image_source *source, const unsigned char *head, size_t size) {
    char known[64] = "neither ";
    for (int i = 0; i < IMAGE_RAW; i++)
        append(known, sizeof known, "%s%s", i == 0 ? "" : i + 1 < IMAGE_RAW ? ", " : " nor ", kinds[i]->name);
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++)
        if (begins(head, size, others[i].magic, others[i].size))
            return source_fail(source, "%s, but %s", known, others[i].what);
    return size == 0 ? source_fail(source, "is empty") : source_fail(source, "%s by its first bytes", known);
}

static bool read_kind(image_source *source, image_file file, image *out) {
    image read = {.file = file};
    if (!kinds[file]->read(source, &read)) {
        free(read.data);
        return false;
    }
    *out = read;
    return true;
}

/* The first bytes are looked at and left to the reader of the kind. */
static bool read_source(image_source *source, image *out) {
    const unsigned char *head = source->ready;
    const size_t size = source->ready_size < HEAD_SIZE ? source->ready_size : HEAD_SIZE;
    for (int i = 0; i < IMAGE_FILE_COUNT; i++)
        for (size_t k = 0; k < sizeof kinds[i]->magic / sizeof kinds[i]->magic[0]; k++)
            if (size > kinds[i]->magic_at &&
                begins(head + kinds[i]->magic_at, size - kinds[i]->magic_at, kinds[i]->magic[k], kinds[i]->magic_size))
                return read_kind(source, (image_file)i, out);
    return unknown(source, head, size);
}

bool image_parse(const void *bytes, size_t size, image *out, image_error *error) {
    image_source source = {.ready = bytes, .ready_size = size, .sized = true, .left = size, .error = error};
    return read_source(&source, out);
}

static bool unreadable(image_source *source, int number) {
    source_fail(source, "cannot read: %s", strerror(number));
    source->error->unreadable = number;
    return false;
}

/* How much a regular file still holds; a pipe does not say. */
static bool find_length(image_source *source) {
    struct stat status;
    const int file = fileno(source->stream);
    if (file < 0) /* memory */
        return true;
    if (fstat(file, &status) != 0)
        return unreadable(source, errno);
    if (S_ISDIR(status.st_mode))
        return unreadable(source, EISDIR);
    const off_t at = lseek(file, 0, SEEK_CUR);
    if (S_ISREG(status.st_mode) && at >= 0 && status.st_size >= at) {
        source->sized = true;
        source->left = (uint64_t)(status.st_size - at);
    }
    return true;
}

bool image_read(const char *path, image *out, image_error *error) {
    return image_read_as(path, &(image_asked){.channel = NULL}, out, error);
}

bool image_read_as(const char *path, const image_asked *asked, image *out, image_error *error) {
    FILE *stream = input_open(path);
    image_source source = {.stream = stream, .asked = *asked, .error = error};
    if (stream == NULL)
        return unreadable(&source, errno);
    unsigned char head[HEAD_SIZE];
    bool good = find_length(&source);
    if (good) {
        errno = 0;
        source.ready = head;
        source.ready_size = fread(head, 1, sizeof head, stream);
        good = ferror(stream)                             ? unreadable(&source, errno)
               : ends(path, ".raw") || ends(path, ".bin") ? read_kind(&source, IMAGE_RAW, out)
                                                          : read_source(&source, out);
    }
    input_close(stream);
    return good;
}

void image_free(image *img) {
    free(img->data);
    img->data = NULL;
}

/* ---- Writing ----------------------------------------------------------------------------------------------------- */

bool image_holds(image_file file, image_type type, uint32_t channels) {
    return (unsigned)file < IMAGE_FILE_COUNT && (unsigned)type < IMAGE_TYPE_COUNT && channels >= 1 &&
           channels <= IMAGE_CHANNELS_MAX && (kinds[file]->types >> type & 1U) != 0 &&
           (kinds[file]->channels >> channels & 1U) != 0;
}

image_writer *image_writer_open(FILE *stream, image_file file, image_type type, uint32_t width, uint32_t height,
                                uint32_t channels, const char *note) {
    if ((unsigned)file >= IMAGE_WRITTEN_COUNT || !image_holds(file, type, channels) || width < 1 || height < 1 ||
        width > IMAGE_SIDE_MAX || height > IMAGE_SIDE_MAX || (uint64_t)width * height > IMAGE_PIXELS_MAX)
        return NULL;
    image_writer *writer = malloc(sizeof *writer);
    if (writer == NULL)
        return NULL;
    *writer = (image_writer){.stream = stream,
                             .kind = kinds[file],
                             .type = type,
                             .width = width,
                             .height = height,
                             .channels = channels,
                             .row_size = (size_t)width * channels * image_type_size(type),
                             .rows_left = height,
                             .note = note};
    if (writer->kind->begin(writer))
        return writer;
    writer->failed = true;
    image_writer_close(writer);
    return NULL;
}

bool image_writer_bottom_up(const image_writer *writer) {
    return writer->kind->bottom_up;
}

bool image_writer_rows(image_writer *writer, const void *rows, uint32_t count) {
    if (writer->failed || count > writer->rows_left || !writer->kind->rows(writer, rows, count)) {
        writer->failed = true;
        return false;
    }
    writer->rows_left -= count;
    return true;
}

bool image_writer_close(image_writer *writer) {
    if (writer->rows_left > 0)
        writer->failed = true;
    if (writer->kind->end != NULL && !writer->kind->end(writer))
        writer->failed = true;
    const bool good = !writer->failed;
    free(writer);
    return good;
}
