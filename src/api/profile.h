/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file profile.h  What 'depthprec probe --json' wrote of a GPU, where a name of a row may stand.
 *
 *     profile gpu = {.measured = ""};
 *     char name[PROFILE_NAME_SIZE], error[PROFILE_ERROR_SIZE];
 *     if (profile_is_file(text) && !profile_add(&gpu, text, "raster", name, error))
 *         ...                                      // a sentence that names the file
 */
#ifndef API_PROFILE_H
#define API_PROFILE_H

#include <stdbool.h>
#include <stddef.h>

#include "depthprec/depthprec.h"

enum {
    PROFILE_NAME_SIZE = 64,
    PROFILE_ERROR_SIZE = 1024,
    PROFILE_MEASURED_SIZE = 512,
    PROFILE_FORMATS_MAX = 8,
    PROFILE_FORMATS_SIZE = 256
};

/** What holds on each of the GPUs whose profiles were added; all zero: no profile. */
typedef struct profile {
    char measured[PROFILE_MEASURED_SIZE];  /**< "NAME, driver DRIVER", each once; "" without a profile */
    dp_format stored[PROFILE_FORMATS_MAX]; /**< the depth formats that all of them store; see profile_stores() */
    size_t stored_count;
} profile;

/** Whether a text means a file: it has a point or a slash, which no name of a row has. */
bool profile_is_file(const char *text);

/**
 * Reads a profile.
 * @param key   of the row that is asked for: "arith" or "raster"
 * @param name  receives the row's name, of which nothing but its length is known
 * @return false with a sentence in `error`, and *to is as it was
 */
bool profile_add(profile *to, const char *path, const char *key, char name[PROFILE_NAME_SIZE],
                 char error[PROFILE_ERROR_SIZE]);

/** Whether the GPUs store depth in that format; true without a profile. */
bool profile_stores(const profile *p, const dp_format *format);

/** The names of what they store, "fp32 or unorm16"; "nothing". @return out */
const char *profile_formats(const profile *p, char out[PROFILE_FORMATS_SIZE]);

#endif
