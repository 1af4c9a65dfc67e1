/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The page in place of report/output_file.c and system/input.c: one file may be read, which a person dropped, and one
 * written, rows of numbers that the page draws.
 */
#define _GNU_SOURCE
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "draw/canvas.h"
#include "report/output.h"
#include "system/input.h"
#include "web/page.h"

enum { FD_ROWS = 3 };

static bool cells;
static void *dropped;
static size_t dropped_size;

/** Room for the bytes of the file that may be read, whatever its name; null when out of memory. */
PAGE_EXPORT("file") void *file_room(size_t size) {
    dropped_size = size;
    return dropped = malloc(size + 1);
}

FILE *input_open(const char *path) {
    (void)path;
    errno = ENOENT;
    return dropped != NULL ? fmemopen(dropped, dropped_size, "rb") : NULL;
}

void input_close(FILE *in) {
    if (in != NULL)
        fclose(in);
}

/** Parts the cells of tables from now on, see output.h. */
PAGE_EXPORT("cells") void part_cells(int on) {
    cells = on != 0;
}

int output_open(output *out, const char *path) {
    *out = (output){.fd = STDOUT_FILENO, .cells = cells};
    if (dropped != NULL && path != NULL && strcmp(path, "rows.pfm") == 0)
        out->fd = FD_ROWS;
    if (out->fd == FD_ROWS || path == NULL || strcmp(path, "-") == 0)
        return EXIT_FINE;
    fprintf(stderr, "depthprec: the page writes no files, got '%s': leave --output out\n", path);
    return EXIT_IO;
}

/* Nobody turns pages here. */
void output_page(output *out) {
    (void)out;
}

int output_check(const char *path) {
    output out;
    return output_open(&out, path);
}

int output_close(output *out) {
    output_flush(out);
    return out->error == 0 ? EXIT_FINE : EXIT_IO;
}

void output_abandon(output *out) {
    out->used = 0;
}

canvas_format canvas_format_of(const char *path) {
    (void)path;
    return CANVAS_FORMAT_COUNT; /* --type says it */
}

bool output_same_file(const char *a, const char *b) {
    return strcmp(a, b) == 0;
}

void input_forget(void) {}

void input_expect(const char *path) {
    (void)path;
}

bool input_is_read(const char *path) {
    (void)path;
    return false;
}
