/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file shell_word.h  Words of a command line as a shell takes them. */
#ifndef CLI_SHELL_WORD_H
#define CLI_SHELL_WORD_H

#include <stddef.h>

/** Adds a blank and the word to the text in `out`, which has `size` bytes: in quotes where a shell would see more in it
 * than a word. What does not fit is cut off. */
void append_shell_word(char *out, size_t size, const char *word);

#endif
