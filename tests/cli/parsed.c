/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "parsed.h"

#include <stdio.h>
#include <string.h>

int parsed(asked_line *o, int argc, char **argv, char line[1024]) {
    memset(line, 0, 1024);
    FILE *const terminal = stderr;
    stderr = fmemopen(line, 1024, "w");
    const int status = options_parse(o, argc, argv);
    fclose(stderr);
    stderr = terminal;
    line[strcspn(line, "\n")] = '\0';
    return status;
}
