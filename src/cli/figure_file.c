/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/figure_file.h"

#include <stdlib.h>

#include "cli/command_line.h"

int figure_size_check(const options *o) {
    if (o->width > 0 && (o->width < DRAW_WIDTH_MIN || o->width > DRAW_SIZE_MAX))
        return option_error(OPTION_WIDTH, "must be from %d to %d px, got %d", DRAW_WIDTH_MIN, DRAW_SIZE_MAX, o->width);
    if (o->height > 0 && (o->height < DRAW_HEIGHT_MIN || o->height > DRAW_SIZE_MAX))
        return option_error(OPTION_HEIGHT, "must be from %d to %d px, got %d", DRAW_HEIGHT_MIN, DRAW_SIZE_MAX,
                            o->height);
    return EXIT_FINE;
}

bool figure_file_write(const options *o, const char *path, const chart *c, int width, int height, output *out) {
    char command[COMMAND_LINE_SIZE];
    canvas_bytes bytes;
    command_line(o, path, command);
    if (!draw_chart(c, theme_get(o->theme), canvas_format_of(path), width, height, command, &bytes))
        return false;
    output_bytes(out, bytes.at, bytes.size);
    free(bytes.at);
    return true;
}
