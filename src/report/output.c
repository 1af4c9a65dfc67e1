/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/output.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static bool stdout_begun; /* by this process */

bool output_begun(void) {
    return stdout_begun;
}

static void write_all(output *out, const char *bytes, size_t size) {
    stdout_begun = stdout_begun || (size > 0 && out->fd == STDOUT_FILENO);
    while (size > 0 && out->error == 0) {
        ssize_t written = write(out->fd, bytes, size);
        if (written < 0 && errno != EINTR)
            out->error = errno;
        if (written > 0) {
            bytes += written;
            size -= (size_t)written;
        }
    }
}

void output_flush(output *out) {
    write_all(out, out->buffer, out->used);
    out->used = 0;
}

void output_bytes(output *out, const void *bytes, size_t size) {
    if (size > OUTPUT_BUFFER_SIZE - out->used)
        output_flush(out);
    if (size > OUTPUT_BUFFER_SIZE) {
        write_all(out, bytes, size);
        return;
    }
    memcpy(out->buffer + out->used, bytes, size);
    out->used += size;
}

void output_text(output *out, const char *text) {
    output_bytes(out, text, strlen(text));
}

void output_format(output *out, const char *format, ...) {
    char line[1024];
    va_list arguments;
    va_start(arguments, format);
    int length = vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    if (length > 0)
        output_bytes(out, line, (size_t)length < sizeof line ? (size_t)length : sizeof line - 1);
}
