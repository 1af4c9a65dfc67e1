/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/message.h"

#include <stdarg.h>
#include <stdio.h>
#include <unistd.h>

#include "report/page.h"
#include "report/terminal.h"

void message(const char *format, ...) {
    char line[1024];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    if (terminal_columns(STDERR_FILENO) == 0) {
        fprintf(stderr, "%s\n", line);
        return;
    }
    output out = {.fd = STDERR_FILENO, .colour = OUTPUT_COLOUR_NEVER};
    page p = page_start(&out, 0);
    page_text(&p, "%s", line);
    fwrite(out.buffer, 1, out.used, stderr);
}
