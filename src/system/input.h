/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file input.h  The files that a run reads: one function opens them all and remembers which they are, so that no
 * output is written over one of them.
 */
#ifndef SYSTEM_INPUT_H
#define SYSTEM_INPUT_H

#include <stdbool.h>
#include <stdio.h>

/** Opens a file to read, "-" for stdin, and remembers it. @return null with errno */
FILE *input_open(const char *path);

/** Null is allowed; stdin stays open. errno stays. */
void input_close(FILE *in);

/** Forgets the files of an earlier run in this process. */
void input_forget(void);

/** Remembers a file that will be read, so that an output is refused before any work. */
void input_expect(const char *path);

/** Is the path one of a regular file that is remembered, by whatever name? False of "-", which is no file. */
bool input_is_read(const char *path);

#endif
