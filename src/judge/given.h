/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file given.h  What a shader may be given of a camera: its numbers by a word, and by the names that people use. */
#ifndef JUDGE_GIVEN_H
#define JUDGE_GIVEN_H

#include <stdbool.h>

#include "depthprec/setup.h"

enum { GIVEN_FLOATS = 16, GIVEN_NAME_SIZE = 64 };

/** A value of one number or several. */
typedef struct given_row {
    const char *word;
    unsigned floats;     /**< how many, at most GIVEN_FLOATS; of a matrix row by row, for column vectors */
    const char *numbers; /**< a letter each, see number() in given.c; null: `fill` makes them */
    void (*fill)(const dp_setup *s, double out[GIVEN_FLOATS]);
    const char *names; /**< by which it is guessed, without underscores and in small letters; "": in HLSL, where cameras
                            look along +z, it is guessed in place of the row above */
} given_row;

/** The row of a word; null: none. */
const given_row *given_find(const char *word);

/** The row that a name suggests, "camera.near" by its last word; null: none. */
const given_row *given_guess(const char *name, bool hlsl);

/** Its numbers in a set-up. */
void given_fill(const given_row *row, const dp_setup *setup, double out[GIVEN_FLOATS]);

#endif
