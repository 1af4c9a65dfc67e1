/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file exr_made.h  EXR files that the OpenEXR library itself writes, in each compression, scanlines or tiles. */
#ifndef TESTS_EXR_MADE_H
#define TESTS_EXR_MADE_H

#include "image/image.h"

/** A channel of a compression by its number in the file: 0 none, 1 RLE, 2 ZIPS, 3 ZIP, 4 PIZ, 5 PXR24, 6 B44, 7 B44A,
 *  8 DWAA, 9 DWAB. */
typedef struct exr_made {
    int compression;
    image_type type; /**< IMAGE_U32, IMAGE_F16 or IMAGE_F32 */
    const char *channel;
    int tile; /**< side of a tile, 0 for scanlines */
    int width, height;
    const void *samples;
} exr_made;

/** @return null, or why not: the library is not there, or does not write that compression */
const char *exr_make(const char *path, const exr_made *of);

#endif
