/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/output/picture.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

#include "cli/errors.h"
#include "draw/pixels.h"
#include "report/output.h"
#include "system/posix.h"

int picture_write(const char *path, const uint32_t *pixel, int width, int height) {
    output out;
    char *bytes = NULL;
    size_t size = 0;
    FILE *stream = pixel != NULL ? open_memstream(&bytes, &size) : NULL;
    bool good = stream != NULL;
    if (good) {
        const pixels all = {.at = pixel, .stride = (size_t)width, .width = width, .height = height};
        good = pixels_write_png(stream, &all, NULL);
    }
    good = (stream == NULL || fclose(stream) == 0) && good;
    int status = good ? output_open(&out, path) : usage_error("%s: no memory for the picture", path);
    if (good && status == EXIT_FINE) {
        output_bytes(&out, bytes, size);
        status = output_close(&out);
    }
    free(bytes);
    return status;
}
