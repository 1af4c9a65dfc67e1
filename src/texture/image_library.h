/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file image_library.h  For the image rooms alone: libraries that are opened when a file of their kind is named, so
 * that the program runs without them.
 */
#ifndef TEXTURE_IMAGE_LIBRARY_H
#define TEXTURE_IMAGE_LIBRARY_H

#include "texture/image_kind.h"

typedef struct image_library {
    const char *kind;           /**< of file: "EXR" */
    const char *files[3];       /**< one after the other is tried, up to null */
    const char *package;        /**< Debian's, that has it */
    const char *const *symbols; /**< up to null */
} image_library;

/** A function of some library. */
typedef void image_function(void);

/** Opens the library, which then stays open, and finds its symbols. @return false after the sentence */
bool image_library_open(const image_library *library, image_source *source, image_function *functions[]);

#endif
