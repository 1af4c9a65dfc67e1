/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file image.h  Images of numbers: PNG of 8 or 16 bits, PFM, and .npy of f2, f4, f8, u1, u2, u4. DDS, EXR, TIFF, PGM,
 *  raw and ROS's compressedDepth are read; of an EXR one channel, by a library that must be there then, as for TIFF.
 *  Which of several channels is depth image_choose() says.
 *
 * Files are not trusted: sizes are checked before memory is asked for (IMAGE_SIDE_MAX, IMAGE_PIXELS_MAX;
 * what a file of known length cannot hold is refused), and what is damaged, cut short, followed by anything
 * else or not supported gives one sentence and nothing else. NaN and infinities pass.
 */
#ifndef IMAGE_IMAGE_H
#define IMAGE_IMAGE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/** Pixels of an image: at most this many on a side, and 2^28 in all. */
#define IMAGE_SIDE_MAX   65536u
#define IMAGE_PIXELS_MAX (UINT64_C(1) << 28)

typedef enum image_type {
    IMAGE_U8 = 0,
    IMAGE_U16,
    IMAGE_U32,
    IMAGE_F16,
    IMAGE_F32,
    IMAGE_F64,
    IMAGE_TYPE_COUNT
} image_type;

/** Those that are written come first. */
typedef enum image_file {
    IMAGE_PNG = 0,
    IMAGE_PFM,
    IMAGE_NPY,
    IMAGE_WRITTEN_COUNT,
    IMAGE_DDS = IMAGE_WRITTEN_COUNT,
    IMAGE_EXR,
    IMAGE_TIFF,
    IMAGE_PGM,
    IMAGE_RAW,
    IMAGE_ROS,
    IMAGE_FILE_COUNT
} image_file;

enum { IMAGE_ERROR_SIZE = 256, IMAGE_CHANNELS_MAX = 4, IMAGE_NOTE_SIZE = 256, IMAGE_NAMES_SIZE = 128 };

/** Bits for a PNG's words about its colours, by which a program that obeys changes the samples. */
enum { IMAGE_SRGB = 1, IMAGE_GAMMA = 2, IMAGE_PROFILE = 4 };

/** Rows from the top, channels interleaved, samples in the order of this machine's bytes, no padding. */
typedef struct image {
    uint32_t width, height, channels;
    image_type type;
    image_file file;                /**< what it was read from */
    void *data;                     /**< malloc'ed */
    bool named_depth;               /**< its channel is called Z or depth */
    char channel[IMAGE_NAMES_SIZE]; /**< the one that was read or chosen, by name; "" before that, or if it is alone */
    char others[IMAGE_NAMES_SIZE];  /**< the names of all others, "B, G, R", perhaps cut short */
    const char *unlike;             /**< of a kind that reads one channel: "G" or "B", which is not as red; or null */
    const char *says;               /**< the depth format that the file names, "unorm24"; null when it names none */
    unsigned colours;               /**< IMAGE_SRGB, ... */
    uint32_t most;                  /**< the largest sample, where the file says another than the type's; else 0 */
    bool size_assumed;              /**< of a raw one: by its length alone */
    const char *lossy;              /**< the compression, where it may have changed samples: "PXR24"; else null */
    char note[IMAGE_NOTE_SIZE]; /**< of a PNG that depthprec wrote: the note; of compressedDepth the same; else "" */
} image;

/** Why an image was refused. */
typedef struct image_error {
    int unreadable; /**< errno where the system could not open or read the file; 0: its content is at fault */
    char text[IMAGE_ERROR_SIZE]; /**< one sentence without the path: "cut short: ..." */
} image_error;

/** "u1", "u2", ...: as .npy names them; bytes of a sample. Null and 0 when out of range. */
const char *image_type_name(image_type type);
size_t image_type_size(image_type type);

/** Which kind of file to write a name's ending means: ".png", ".pfm", ".npy", in any case. @return false when none of
 *  them */
bool image_file_of(const char *path, image_file *out);

/** "PNG", "PFM", "npy", "DDS", "EXR", "TIFF", "raw", "compressedDepth"; null when out of range. */
const char *image_file_name(image_file file);

/** Properties that a file may leave open. */
typedef struct image_asked {
    const char *channel;    /**< of kinds whose channels have names, others leave it to image_choose(); null: depth */
    uint32_t width, height; /**< pixels, of a raw one; 0: the usual picture of its length */
} image_asked;

/** Reads a file, "-" being stdin; the kind is told from its first bytes, but a name that ends in .raw or .bin says that
 *  there is nothing but samples. */
bool image_read(const char *path, image *out, image_error *error);
/** The same, with what the file may leave open. */
bool image_read_as(const char *path, const image_asked *asked, image *out, image_error *error);
/**
 * The channel of depth of an image that was read: what it is called, and what the others are. Those of kinds without
 * names are R, G, B and A, of a PNG with two Y and A; raw has one.
 * @param asked  its name: it alone is kept, whatever the others hold; null: the first, or what the reader chose
 * @return false after a sentence: there is none of that name, or red differs from green or blue, as in a picture
 */
bool image_choose(image *img, const char *asked, image_error *error);
/** The first from memory, never raw. */
bool image_parse(const void *bytes, size_t size, image *out, image_error *error);
void image_free(image *image);

/** A writer of one image, row by row, so that a large one needs no memory. */
typedef struct image_writer image_writer;

/** Which sample types and channels a kind of file holds: PNG u1 u2, 1 to 4; PFM f4, 1 or 3; npy all, 1 to 4; DDS all
 *  but f8, 1 to 4; EXR u4, f2 and f4, 1; TIFF all, 1 to 4; PGM u1 and u2, 1; raw u2, u4 and f4, 1, or 2 with a
 *  stencil; compressedDepth u2, which may become f4, 1. */
bool image_holds(image_file file, image_type type, uint32_t channels);

/** Writes the header. @return null when out of memory, when the stream failed, or the file cannot hold it; the stream
 *  stays the caller's. PNG: 16 bits as a fast compression has them, see png.c
 *  @param note  shorter than IMAGE_NOTE_SIZE, in a text chunk of a PNG; null: none. Other kinds have no place for it */
image_writer *image_writer_open(FILE *stream, image_file file, image_type type, uint32_t width, uint32_t height,
                                uint32_t channels, const char *note);

/** PFM stores the bottom row first: rows must then be given from the bottom. */
bool image_writer_bottom_up(const image_writer *writer);

/** Writes `count` rows, interleaved, in this machine's byte order. @return false when the stream failed, or more rows
 *  are given than the image has */
bool image_writer_rows(image_writer *writer, const void *rows, uint32_t count);

/** Ends the image and frees the writer. @return false when the stream failed or rows are missing */
bool image_writer_close(image_writer *writer);

#endif
