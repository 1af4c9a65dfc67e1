/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/page.h"

#include <ctype.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "report/terminal.h"

enum {
    PAGE_WIDTH = 80, /* where nothing says how wide it is */
    PAGE_LEAST = 40,
    INDENT = 2
};

static int width_of(const output *out) {
    if (out->width > 0)
        return out->width;
    const int columns = terminal_columns(out->fd);
    if (columns == 0)
        return PAGE_WIDTH;
    return columns > PAGE_LEAST ? columns : PAGE_LEAST;
}

page page_start(output *out, int label) {
    const char *term = getenv("TERM");
    const bool suits = getenv("NO_COLOR") == NULL && term != NULL && strcmp(term, "dumb") != 0 && isatty(out->fd);
    const bool colour = out->colour == OUTPUT_COLOUR_AUTO ? suits : out->colour == OUTPUT_COLOUR_ALWAYS;
    return (page){.out = out,
                  .label = label,
                  .width = width_of(out),
                  .strong = colour ? "\033[1m" : "",
                  .soft = colour ? "\033[2m" : "",
                  .good = colour ? "\033[32m" : "",
                  .bad = colour ? "\033[1;31m" : "",
                  .plain = colour ? "\033[0m" : ""};
}

static bool is_word(const char *text, const char *unit) {
    return unit != NULL && text[0] == ' ' && strncmp(text + 1, unit, strlen(unit)) == 0 &&
           !isalnum((unsigned char)text[1 + strlen(unit)]);
}

/* Does a blank with a unit behind it stand here? An inch is a word where lengths are not in inches. */
static bool is_unit(const char *text, const char *unit) {
    static const char *const names[] = {"nm", "um", "mm", "cm", "ft", "m", "km"};
    bool is = is_word(text, unit);
    for (size_t i = 0; i < sizeof names / sizeof names[0] && !is; i++)
        is = is_word(text, names[i]);
    return is;
}

/* The next word, with what belongs to it: "z = 5 m", "12 %". */
static int word_length(const char *text, const char *unit) {
    size_t length = strcspn(text, " ");
    while (strncmp(text + length, " = ", 3) == 0 || strncmp(text + length, " %", 2) == 0 ||
           (length > 0 && isdigit((unsigned char)text[length - 1]) && is_unit(text + length, unit))) {
        length += text[length + 1] == '=' ? 3 : 1;
        length += strcspn(text + length, " ");
    }
    return (int)length;
}

/* Characters that are seen: what dresses them is not. */
static int seen_length(const char *text, int length) {
    int seen = 0;
    for (int i = 0; i < length; i++) {
        if (text[i] == '\033')
            i += (int)strcspn(text + i, "m");
        else
            seen++;
    }
    return seen;
}

/* Words from `column` on, broken where the page ends, those of further lines `left` blanks from the margin. */
static void put_words(page *p, int column, int left, const char *text) {
    for (bool first = true; *text != '\0'; first = false) {
        const int word = word_length(text, p->unit);
        const int seen = seen_length(text, word);
        if (!first && column + 1 + seen > p->width) {
            output_format(p->out, "\n%*s", left, "");
            column = left;
            first = true;
        }
        output_format(p->out, "%s%.*s", first ? "" : " ", word, text);
        column += seen + !first;
        text += word + (text[word] == ' ');
    }
}

#define FORMATTED(text, format)                                                                                        \
    char text[1024];                                                                                                   \
    va_list arguments;                                                                                                 \
    va_start(arguments, format);                                                                                       \
    vsnprintf(text, sizeof text, format, arguments);                                                                   \
    va_end(arguments)

void page_text(page *p, const char *format, ...) {
    FORMATTED(text, format);
    put_words(p, 0, INDENT, text);
    output_char(p->out, '\n');
}

void page_title(page *p, const char *format, ...) {
    FORMATTED(text, format);
    output_text(p->out, p->strong);
    put_words(p, 0, INDENT, text);
    output_format(p->out, "%s\n", p->plain);
}

void page_line(page *p, const char *format, ...) {
    FORMATTED(text, format);
    output_format(p->out, "%*s", INDENT, "");
    put_words(p, INDENT, INDENT, text);
    output_char(p->out, '\n');
}

void page_note(page *p, const char *label, const char *format, ...) {
    FORMATTED(text, format);
    page_wrapped(p, label, text);
}

void page_wrapped(page *p, const char *label, const char *text) {
    const int length = (int)strlen(label), left = INDENT + p->label;
    if (text == NULL || *text == '\0')
        return;
    output_format(p->out, "%*s%s%s%s", INDENT, "", p->strong, label, p->plain);
    if (length >= p->label)
        output_format(p->out, "\n%*s", left, "");
    else
        output_format(p->out, "%*s", p->label - length, "");
    put_words(p, left, left, text);
    output_char(p->out, '\n');
}
