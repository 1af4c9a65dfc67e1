/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file words.h  Words of articles, of shaders and of our own pages: what each means, and which command answers. */
#ifndef CLI_WORDS_H
#define CLI_WORDS_H

#include "core/named.h"

typedef struct word_row {
    NAMED_FIELDS;
    const char *commands; /**< without the program's name, a line each; they run in the order of the rows */
} word_row;

NAMED_ROWS(word_row, word);

/** Questions that people ask, by their name, and the commands that answer. */
NAMED_ROWS(word_row, question);

#endif
