/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/errors.h"

#include <stdio.h>

#include "report/message.h"
#include "report/report.h"

/* The last one, for those who asked for JSON. */
typedef struct fault {
    const char *option, *words;
    char text[1024], name[64];
    unsigned status;
    struct fault *self;
} fault;
static fault last;

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
    snprintf(last.text, sizeof last.text, "%s", line + start);
    snprintf(last.name, sizeof last.name, "%s", option != NULL ? option : "");
    last.option = option != NULL ? last.name : NULL;
    return EXIT_USAGE;
}

void error_write_json(const char *command, int status) {
    static const column fields[] = {{FIELD(fault, option, "option", "")},
                                    {FIELD(fault, words, "text", "")},
                                    {FIELD(fault, status, "status", "")},
                                    {.kind = COLUMN_END}};
    static const column columns[] = {{PART(fault, self, "error", fields), .pointed = true}, {.kind = COLUMN_END}};
    output out;
    last.self = &last;
    last.words = last.text;
    last.status = (unsigned)status;
    if (output_open(&out, NULL) != EXIT_FINE)
        return;
    report_write(&(report_spec){command, columns, &last, .when = 0}, &out, FORM_JSON);
    output_close(&out);
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
