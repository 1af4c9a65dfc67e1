/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file notes.h  The words that cairo does not write: title, description and command into a finished SVG. */
#ifndef DRAW_NOTES_H
#define DRAW_NOTES_H

#include <stddef.h>
#include <stdio.h>

/** All UTF-8, none null. */
typedef struct notes {
    const char *title;
    const char *description; /**< what is shown, one paragraph: for screen readers and search */
    const char *command;     /**< the command line that draws it */
    const char *data;        /**< the digest of the numbers that were drawn */
    const char *axes;        /**< what the axes show, for who lays something over the picture; "" of none */
} notes;

/** Writes an SVG with <title>, <desc> and <metadata> as the first children of its root, and its role and label. */
void notes_write_svg(FILE *out, const char *svg, size_t size, const notes *words);

/** Writes text as the content of an element. */
void notes_write_escaped(FILE *out, const char *text);

/** Copies text into out as valid UTF-8 without control characters; what is neither becomes '?'. @return out */
char *notes_clean(char *out, size_t size, const char *text);

#endif
