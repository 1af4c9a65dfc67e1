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

/** From a list of at most 32 functions, LIST(X) with X(name) for each: `functions`, to call them by name, and
 * `symbols`, their names in the same order. */
#define IMAGE_LIBRARY_FUNCTIONS(LIST)                                                                                  \
    typedef union functions {                                                                                          \
        struct {                                                                                                       \
            LIST(IMAGE_LIBRARY_MEMBER)                                                                                 \
        };                                                                                                             \
        image_function *all[32];                                                                                       \
    } functions;                                                                                                       \
    static const char *const symbols[] = {LIST(IMAGE_LIBRARY_NAME) NULL};
#define IMAGE_LIBRARY_MEMBER(name) __typeof__(name) *name;
#define IMAGE_LIBRARY_NAME(name)   #name,

/** Opens the library, which then stays open, and finds its symbols. @return false after the sentence */
bool image_library_open(const image_library *library, image_source *source, image_function *functions[]);

#endif
