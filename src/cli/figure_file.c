/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/figure_file.h"

#include <stdlib.h>

#include "cli/command_line.h"

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
