/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The page in place of report/output_file.c and system/input.c: no files. */
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "draw/canvas.h"
#include "report/output.h"
#include "system/input.h"
#include "web/page.h"

static bool cells;

/** Parts the cells of tables from now on, see output.h. */
PAGE_EXPORT("cells") void part_cells(int on) {
    cells = on != 0;
}

int output_open(output *out, const char *path) {
    *out = (output){.fd = STDOUT_FILENO, .cells = cells};
    if (path == NULL || strcmp(path, "-") == 0)
        return EXIT_FINE;
    fprintf(stderr, "depthprec: the page writes no files, got '%s': leave --output out\n", path);
    return EXIT_IO;
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
