/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/page.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Where the words of a wrapped note end. */
enum { PAGE_WIDTH = 96, INDENT = 2 };

page page_start(output *out, int label) {
    const char *term = getenv("TERM");
    const bool colour = getenv("NO_COLOR") == NULL && term != NULL && strcmp(term, "dumb") != 0 && isatty(out->fd);
    return (page){.out = out,
                  .label = label,
                  .strong = colour ? "\033[1m" : "",
                  .soft = colour ? "\033[2m" : "",
                  .plain = colour ? "\033[0m" : ""};
}

static void put(page *p, const char *format, va_list arguments) {
    char line[1024];
    vsnprintf(line, sizeof line, format, arguments);
    output_text(p->out, line);
}

void page_title(page *p, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    output_text(p->out, p->strong);
    put(p, format, arguments);
    output_format(p->out, "%s\n", p->plain);
    va_end(arguments);
}

/* A label that is too long is parted from its words by one blank. */
static void put_label(page *p, const char *label) {
    const int pad = p->label - (int)strlen(label);
    output_format(p->out, "%*s%s%s%s%*s", INDENT, "", p->strong, label, p->plain, pad > 0 ? pad : 1, "");
}

void page_note(page *p, const char *label, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    put_label(p, label);
    put(p, format, arguments);
    output_char(p->out, '\n');
    va_end(arguments);
}

void page_line(page *p, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    output_format(p->out, "%*s", INDENT, "");
    put(p, format, arguments);
    output_char(p->out, '\n');
    va_end(arguments);
}

void page_wrapped(page *p, const char *label, const char *text) {
    const int left = INDENT + p->label;
    int column = left;
    if (text == NULL || *text == '\0')
        return;
    if ((int)strlen(label) >= p->label) { /* alone on a line */
        output_format(p->out, "%*s%s%s%s\n", INDENT, "", p->strong, label, p->plain);
        label = "";
    }
    put_label(p, label);
    while (*text != '\0') {
        const int word = (int)strcspn(text, " ");
        if (column > left && column + 1 + word > PAGE_WIDTH) {
            output_format(p->out, "\n%*s", left, "");
            column = left;
        }
        output_format(p->out, "%s%.*s", column > left ? " " : "", word, text);
        column += word + (column > left);
        text += word + (text[word] == ' ');
    }
    output_char(p->out, '\n');
}
