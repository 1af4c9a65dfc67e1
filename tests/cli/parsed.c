/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "parsed.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Tests read thousands of lines and look at what was asked until the next one: the requests live as long as the
 * program. */
static void keep(void *request) {
    static void **kept;
    static size_t count;
    void **more = realloc(kept, (count + 1) * sizeof *kept);
    if (more == NULL)
        abort();
    kept = more;
    kept[count++] = request;
}

int parsed(asked_line *o, int argc, char **argv, char line[1024]) {
    memset(line, 0, 1024);
    FILE *const terminal = stderr;
    stderr = fmemopen(line, 1024, "w");
    const int status = options_parse(o, argc, argv);
    keep(o->request);
    fclose(stderr);
    stderr = terminal;
    line[strcspn(line, "\n")] = '\0';
    return status;
}
