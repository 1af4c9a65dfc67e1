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
    PAGE_NARROW = 60, /* below it labels stand in lines of their own */
    INDENT = 2
};

/* The terminal that shows it, where it is one. */
static int terminal_of(const output *out) {
    return out->paged ? STDOUT_FILENO : out->fd;
}

static int width_of(const output *out) {
    if (out->width > 0)
        return out->width;
    const int columns = terminal_columns(terminal_of(out));
    if (columns == 0)
        return PAGE_WIDTH;
    return columns > PAGE_LEAST ? columns : PAGE_LEAST;
}

page page_start(output *out, int label) {
    const char *term = getenv("TERM");
    const bool suits =
        getenv("NO_COLOR") == NULL && term != NULL && strcmp(term, "dumb") != 0 && isatty(terminal_of(out));
    const bool colour = out->colour == OUTPUT_COLOUR_AUTO ? suits : out->colour == OUTPUT_COLOUR_ALWAYS;
    return (page){.out = out,
                  .label = label,
                  .width = width_of(out),
                  .fitted = out->width == 0 && terminal_columns(terminal_of(out)) > 0,
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

/* Words from `column` on, broken where the page ends, those of further lines `left` blanks from the margin; `join`
 * stands at the end of a line that goes on. A word that is longer than a line of a terminal is broken, too. */
static void put_joined(page *p, int column, int left, const char *text, const char *join) {
    const int width = p->width - (int)strlen(join);
    for (bool first = true; *text != '\0'; first = false) {
        int word = word_length(text, p->unit);
        if (p->fitted && word > width - left)
            word = (int)strcspn(text, " ");
        int seen = seen_length(text, word);
        if (!first && column + 1 + seen > width) {
            output_format(p->out, "%s\n%*s", join, left, "");
            column = left;
            first = true;
        }
        for (int room = width - column - !first; p->fitted && seen == word && word > room && room > 0;
             room = width - left) {
            output_format(p->out, "%s%.*s\n%*s", first ? "" : " ", room, text, left, "");
            text += room;
            seen = word -= room;
            column = left;
            first = true;
        }
        output_format(p->out, "%s%.*s", first ? "" : " ", word, text);
        column += seen + !first;
        text += word + (text[word] == ' ');
    }
}

bool page_fits(const page *p, const char *line, size_t length) {
    return length == 0 || seen_length(line, (int)length - 1) <= p->width;
}

static void put_words(page *p, int column, int left, const char *text) {
    put_joined(p, column, left, text, "");
}

void page_command(page *p, const char *command) {
    output_format(p->out, "%*s", INDENT, "");
    put_joined(p, INDENT, 2 * INDENT, command, INDENT + (int)strlen(command) > p->width ? " \\" : "");
    output_char(p->out, '\n');
}

#define FORMATTED(text, format)                                                                                        \
    char text[1024];                                                                                                   \
    va_list arguments;                                                                                                 \
    va_start(arguments, format);                                                                                       \
    vsnprintf(text, sizeof text, format, arguments);                                                                   \
    va_end(arguments)

void page_text(page *p, const char *format, ...) {
    FORMATTED(text, format);
    const size_t length = strlen(text);
    const bool marked = p->out->cells && length > 0 && text[length - 1] == '.';
    if (marked)
        output_char(p->out, OUTPUT_SENTENCE);
    put_words(p, 0, INDENT, text);
    if (marked)
        output_char(p->out, OUTPUT_SENTENCE);
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
    const bool narrow = p->fitted && p->width < PAGE_NARROW && *label != '\0';
    const int length = (int)strlen(label), room = narrow ? 0 : p->label, left = narrow ? 2 * INDENT : INDENT + p->label;
    if (text == NULL || *text == '\0')
        return;
    output_format(p->out, "%*s%s", INDENT, "", p->strong);
    put_words(p, INDENT, 2 * INDENT, label);
    output_text(p->out, p->plain);
    if (length >= room)
        output_format(p->out, "\n%*s", left, "");
    else
        output_format(p->out, "%*s", room - length, "");
    put_words(p, left, left, text);
    output_char(p->out, '\n');
}
