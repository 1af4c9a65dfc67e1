/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file output.h  Where data go: stdout, or a file that appears only when it is complete.
 *
 *     output out;
 *     int status = output_open(&out, o->output);     // null or "-" is stdout
 *     if (status != EXIT_FINE)
 *         return status;
 *     output_text(&out, "hello\n");                  // as often as needed; errors are remembered
 *     return output_close(&out);                     // EXIT_FINE, or EXIT_IO after one line on stderr
 *
 * A file is written under a temporary name in the same folder and renamed by output_close(), so an interrupted or
 * failed run leaves an old file as it was. A target that exists and is no regular file (a device, a fifo) is written
 * straight to. Two outputs may be open at a time. Output is collected in a buffer: a short one is a single write(2).
 */
#ifndef REPORT_OUTPUT_H
#define REPORT_OUTPUT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/** Exit statuses; every command returns one of these. */
enum {
    EXIT_FINE = 0,   /**< done */
    EXIT_FAILED = 1, /**< a check or requirement failed */
    EXIT_USAGE = 2,  /**< bad usage or bad input */
    EXIT_IO = 3      /**< could not read or write */
};

/** The forms in which data are written. */
typedef enum output_form { FORM_TEXT = 0, FORM_JSON, FORM_CSV } output_form;

/** Whether text is dressed for a terminal: where it is one and NO_COLOR is not set, always, or never. */
typedef enum output_colour { OUTPUT_COLOUR_AUTO = 0, OUTPUT_COLOUR_ALWAYS, OUTPUT_COLOUR_NEVER } output_colour;

enum { OUTPUT_SENTENCE = 0x1E }; /* U+001E */
enum { OUTPUTS_MAX = 2, OUTPUT_BUFFER_SIZE = 1 << 16, OUTPUT_UNLIMITED = 1 << 30 };

typedef struct output {
    int fd;
    int error;        /**< errno of the first write that failed; later writes are dropped */
    const char *path; /**< the name for messages */
    char *target;     /**< what the temporary file is renamed to; null when writing straight */
    char *temporary;
    bool paged; /**< by a pager, on the terminal of stdout */
    int width;  /**< characters in a line of text; 0: as the terminal or the page has it */
    output_colour colour;
    bool cells;           /**< U+001F stands before each cell of a table, for who makes another table of it, and
                               OUTPUT_SENTENCE before and behind each sentence from the margin on */
    const char *measured; /**< of what was measured on a GPU: which; null where nothing was. Told beside the data */
    size_t used;          /**< bytes waiting in the buffer */
    char buffer[OUTPUT_BUFFER_SIZE];
} output;

/**
 * Opens an output. Call it after all options are checked and before long work, so that a missing folder is told at
 * once.
 * @param path  null or "-" for stdout; not the empty string
 * @return EXIT_FINE; after one line on stderr EXIT_IO, or EXIT_USAGE of a file that is read (system/input.h)
 */
int output_open(output *out, const char *path);

/**
 * Whether a file could be opened, for one that is written after long work; nothing is left behind. Devices, fifos and
 * links that point nowhere are not tried. @return as output_open()
 */
int output_check(const char *path);

/** Gives what follows to a pager, where it is text for a terminal; of an output that was opened just now. */
void output_page(output *out);

/** Adds bytes. Failures are remembered for output_close(); a loop may ask output_failed() to stop early. */
void output_bytes(output *out, const void *bytes, size_t size);
void output_text(output *out, const char *text);
void output_format(output *out, const char *format, ...) __attribute__((format(printf, 2, 3)));

static inline void output_char(output *out, char c) {
    if (out->used == OUTPUT_BUFFER_SIZE)
        output_bytes(out, &c, 1);
    else
        out->buffer[out->used++] = c;
}

static inline bool output_failed(const output *out) {
    return out->error != 0;
}

/** A stream into the output, beside which nothing else is written; null when out of memory. */
FILE *output_stream(output *out);

/** Ends the stream. @return false when not all of it could be written, which the output remembers */
bool output_stream_close(output *out, FILE *stream);

/** Writes what waits, closes, renames. @return as output_open() (a closed pipe is quiet) */
int output_close(output *out);

/** Do two paths name one regular file, or one that would be made? */
bool output_same_file(const char *a, const char *b);

/**
 * Closed standard streams are opened on the null device, so that no file takes their number and a message ends in data.
 * Each the wrong way round: who reads or writes there is still told that it is closed. Call it first of all.
 */
void output_reserve_streams(void);

/** Whether this process has written to stdout. */
bool output_begun(void);

/** Writes what waits now, and goes on. */
void output_flush(output *out);

/** Gives up: removes the temporary file, says nothing. For a command that fails half-way. */
void output_abandon(output *out);

#endif
