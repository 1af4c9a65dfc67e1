/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file truth.h  Images of known depths through `depthprec texture`, in a folder of their own, and what comes back. */
#ifndef TESTS_TRUTH_H
#define TESTS_TRUTH_H

#include <stdbool.h>

#include <jansson.h>

#include "image/image.h"

/* The size of every image. */
enum { WIDTH = 24, HEIGHT = 10, PIXELS = WIDTH * HEIGHT, ARGUMENTS = 24 };

/** A new folder in /tmp, and its removal with what the tests leave there: for cmocka. */
int truth_folder(void **state);
int truth_folder_end(void **state);

/** A path for each name, which stays. */
const char *truth_path(const char *name);

/** Sample i of an image in memory. Binary16 by hand: x is a number of it. */
void truth_store(void *data, image_type type, size_t i, double x);
void truth_write(const char *path, image_file file, image_type type, const void *data);

/** Arguments of texture. Numbers lie in it, so the first one must stay where it is; copies may be added to. */
typedef struct command {
    char text[8][40];
    const char *arguments[ARGUMENTS];
    size_t count;
} command;

void truth_add(command *c, const char *argument);
void truth_add_number(command *c, int slot, const char *name, double value);

/** Runs `depthprec texture ...`; what it says on stderr is in the file "said". @return the exit status */
int truth_run(const char *const *arguments, size_t count);

/** Runs it for a product, in the file of that name; null for no method. */
void truth_product(const command *base, const char *file, const char *what, const char *method, bool error);

/** A product in binary32, `channels` a pixel. */
void truth_floats(const char *name, size_t channels, float *out);
/** A PNG of 16 bits, by what was said of it; NaN where there is no value. */
void truth_greys(const char *name, double out[PIXELS]);
/** The statistics as JSON, and whether words are in what was said on stderr of the last run. */
json_t *truth_statistics(const command *base);
bool truth_said(const char *words);

/** The error of eye depth that the statistics say; INFINITY when it has no bound. */
double truth_maximum(const command *base);

#endif
