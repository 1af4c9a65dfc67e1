/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Outputs as streams, in the page and the npm package: musl has streams over functions. */
#define _GNU_SOURCE
#include <stdio.h>
#include <sys/types.h>

#include "report/output.h"

static ssize_t stream_write(void *cookie, const char *bytes, size_t size) {
    output_bytes(cookie, bytes, size);
    return (ssize_t)size;
}

FILE *output_stream(output *out) {
    return fopencookie(out, "w", (cookie_io_functions_t){.write = stream_write});
}

bool output_stream_close(output *out, FILE *stream) {
    return fclose(stream) == 0 && !output_failed(out);
}
