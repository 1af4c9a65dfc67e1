/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file handmade.h  Image files put together byte by byte, without the program's writers and without libpng. */
#ifndef TESTS_HANDMADE_H
#define TESTS_HANDMADE_H

#include <stddef.h>
#include <stdint.h>

enum { HANDMADE_SIZE = 4096 };

typedef struct handmade {
    unsigned char at[HANDMADE_SIZE];
    size_t size;
} handmade;

void handmade_bytes(handmade *h, const void *bytes, size_t size);
void handmade_text(handmade *h, const char *text);
/** The lowest `size` bytes of a number, the highest or the lowest first. */
void handmade_number(handmade *h, uint64_t number, int size, int little);

/** npy: magic, version, a header padded by one newline; samples follow. */
void handmade_npy(handmade *h, int version, const char *header);

/** The header of a DDS about its pixels. */
typedef struct handmade_dds_of {
    uint32_t flags, fourcc, bits, masks[4]; /**< of the pixel format */
    uint32_t dxgi;                          /**< 0: no second header, else fourcc is DX10 */
} handmade_dds_of;

/** DDS: magic and headers of one image; pixels follow. */
void handmade_dds(handmade *h, uint32_t width, uint32_t height, const handmade_dds_of *of);

/** As zlib has them, in one stored block of Deflate. At most 65535 bytes. */
void handmade_zlib(handmade *h, const handmade *bytes);
/** A PNG chunk with its length and checksum. */
void handmade_chunk(handmade *h, const char *type, const void *data, size_t size);
/** Signature and IHDR. */
void handmade_ihdr(handmade *h, uint32_t width, uint32_t height, int bits, int colour, int interlace);
/** IDAT: `rows` as they are, filter bytes among them, by handmade_zlib(). */
void handmade_idat(handmade *h, const handmade *rows);
/** A whole PNG of `pixel` bytes a pixel, row by row or in the seven passes of Adam7. */
void handmade_png(handmade *h, uint32_t width, uint32_t height, int bits, int colour, int interlace, size_t pixel,
                  const unsigned char *pixels);

#endif
