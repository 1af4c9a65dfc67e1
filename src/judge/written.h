/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file written.h  A function in a shader file of somebody's, made a compute shader over depths: depths stand at
 * binding 0, values at binding 1, what it knows of the camera at binding 2.
 *
 * The file keeps only what the function needs, on its lines; uniforms become variables that are read there.
 */
#ifndef JUDGE_WRITTEN_H
#define JUDGE_WRITTEN_H

#include <stdbool.h>
#include <stddef.h>

#include "depthprec/setup.h"

enum { WRITTEN_CONSTANTS = 256, WRITTEN_TEXT_SIZE = 512, WRITTEN_CALLS = 16, WRITTEN_NAME_SIZE = 128 };

typedef struct written {
    char *text; /**< malloc'ed */
    unsigned lines;
    float constants[WRITTEN_CONSTANTS];
    size_t used;
    bool camera;                     /**< some are of the camera */
    char open[64];                   /**< a macro that a condition asks for and nobody defines; "": there is none */
    char defines[WRITTEN_TEXT_SIZE]; /**< "near = near (guessed), ..."; "": it knows nothing of a camera */
} written;

/** Whether NAME=VALUE names what a shader can be given: a word or a number. */
bool written_define_known(const char *define);

/** The only function that a file has. @return name, or null with a sentence in `error` that lists them */
const char *written_only(const char *file, bool hlsl, char name[WRITTEN_NAME_SIZE], char error[WRITTEN_TEXT_SIZE]);

/**
 * @param file     the text of the file
 * @param defines  NAME=VALUE
 * @param turns    0; or to be timed: it is called WRITTEN_CALLS times as often for each depth and parts of it
 * @return false with a sentence in `error`: what is not understood, and what to do
 */
bool written_make(const char *file, const char *function, bool hlsl, const dp_setup *setup, const char *const *defines,
                  size_t define_count, unsigned turns, written *out, char error[WRITTEN_TEXT_SIZE]);

#endif
