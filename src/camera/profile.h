/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file profile.h  What 'depthprec probe --json' wrote of a GPU, where a name of a row may stand.
 *
 *     profile gpu = {.measured = ""};
 *     char name[PROFILE_NAME_SIZE], error[PROFILE_ERROR_SIZE];
 *     if (profile_is_file(text) && profile_add(&gpu, text, "raster", name, error) != 0)
 *         ...                                      // a sentence that names the file
 */
#ifndef CAMERA_PROFILE_H
#define CAMERA_PROFILE_H

#include <stdbool.h>
#include <stddef.h>

#include "bias/bias.h"
#include "camera/platform.h"
#include "depthprec/depthprec.h"

enum {
    PROFILE_NAME_SIZE = 64,
    PROFILE_ERROR_SIZE = 1024,
    PROFILE_MEASURED_SIZE = 512,
    PROFILE_FORMATS_MAX = 8,
    PROFILE_FORMATS_SIZE = 256
};

/** A depth format, and r of a bias in it: 2^-N of a UNORM format and 2^(n - M) of a float one, times at least `least`
 * and at most `most`; 0, 0 where not each of the GPUs was measured for sure. */
typedef struct profile_format {
    dp_format format;
    double least, most;
    bool cuts; /**< fractions of a constant are cut: 0.5 becomes 0 */
} profile_format;

/** Properties that hold on each GPU whose profile was added; all zero: no profile. */
typedef struct profile {
    char measured[PROFILE_MEASURED_SIZE];       /**< "NAME, driver DRIVER", each once; "" without a profile */
    profile_format stored[PROFILE_FORMATS_MAX]; /**< what all of them store; see profile_stores() */
    size_t stored_count;
    const char *api; /**< of list apis: what they were asked by, "vulkan" or "gl"; null where by several */
} profile;

/** Whether a text means a file: it has a point or a slash, which no name of a row has. */
bool profile_is_file(const char *text);

/**
 * Reads a profile.
 * @param key   of the row that is asked for: "arith" or "raster"
 * @param name  receives the row's name, of which nothing but its length is known
 * @return 0; else, with a sentence in `error` and *to as it was, a number of errno where the file cannot be read, or -1
 */
int profile_add(profile *to, const char *path, const char *key, char name[PROFILE_NAME_SIZE],
                char error[PROFILE_ERROR_SIZE]);

/** Whether the GPUs store depth in that format; true without a profile. */
bool profile_stores(const profile *p, const dp_format *format);

/** The names of what they store, "fp32 or unorm16"; "nothing". @return out */
const char *profile_formats(const profile *p, char out[PROFILE_FORMATS_SIZE]);

/** r as it was measured of an API's bias in that format, as it arrives by a platform, or null; null where it was not.
 */
const profile_format *profile_biased(const profile *p, const platform *by, const bias_api *api,
                                     const dp_format *format);

/** platform_bias() with the r that was measured, where one was; the convention of the exponent is then not open. */
bias_api profile_bias(const profile *p, const platform *by, const bias_api *api, const dp_format *format);

#endif
