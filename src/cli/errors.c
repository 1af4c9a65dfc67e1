/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/errors.h"

#include <stdio.h>

#include "report/message.h"
#include "report/output.h"

/* One line whatever the arguments hold: control characters would break it, and a long argument would bury it. */
int named_error(const char *option, const char *format, va_list arguments) {
    char line[1024];
    size_t start = (size_t)snprintf(line, sizeof line, "depthprec: %s%s%s", option ? "--" : "", option ? option : "",
                                    option ? ": " : "");
    vsnprintf(line + start, sizeof line - start, format, arguments);
    for (char *c = line; *c != '\0'; c++)
        if ((unsigned char)*c < 0x20 || *c == 0x7f)
            *c = '?';
    message("%s", line);
    return EXIT_USAGE;
}

int usage_error(const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    int status = named_error(NULL, format, arguments);
    va_end(arguments);
    return status;
}

const char *error_word(const char *word, size_t length, char out[ERROR_WORD_SIZE]) {
    const size_t shown = length < ERROR_WORD_SHOWN ? length : ERROR_WORD_SHOWN;
    for (size_t i = 0; i < shown; i++)
        out[i] = word[i] > ' ' && word[i] < 0x7f ? word[i] : '?';
    snprintf(out + shown, 4, "%s", length > shown ? "..." : "");
    return out;
}
