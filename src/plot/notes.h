/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file notes.h  The words that cairo does not write: title, description and command into a finished SVG or PNG. */
#ifndef PLOT_NOTES_H
#define PLOT_NOTES_H

#include <stdbool.h>
#include <stddef.h>

/** All UTF-8, none null. */
typedef struct notes {
    const char *title;
    const char *description; /**< what is shown, one paragraph: for screen readers and search */
    const char *command;     /**< the command line that draws it */
    const char *data;        /**< the digest of the numbers that were drawn */
} notes;

typedef struct notes_buffer {
    unsigned char *at;
    size_t size, room;
    bool failed; /**< memory ran out; what is appended later is dropped */
} notes_buffer;

/** @return false when memory ran out */
bool notes_append(notes_buffer *b, const void *bytes, size_t size);

/** Adds <title>, <desc> and <metadata> as the first children of the root, and its role and label. */
bool notes_into_svg(notes_buffer *b, const notes *words);

/** Adds iTXt chunks behind the header. */
bool notes_into_png(notes_buffer *b, const notes *words);

/** Copies text into out as valid UTF-8 without control characters; what is neither becomes '?'. @return out */
char *notes_clean(char *out, size_t size, const char *text);

#endif
