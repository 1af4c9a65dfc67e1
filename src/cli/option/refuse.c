/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How an option is refused: who did not name what is refused is told where it comes from. */
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "cli/option/option.h"

/* A preset or a platform that gave an option its value in place of the user: its own option and name. */
enum { CHOOSERS_MAX = 8 };
static struct chooser { const char *option, *by, *name; } choosers[CHOOSERS_MAX];
static size_t chooser_count;

void option_forget_choosers(void) {
    chooser_count = 0;
}

static struct chooser *chooser_of(const char *option) {
    for (size_t i = 0; i < chooser_count; i++)
        if (strcmp(choosers[i].option, option) == 0)
            return &choosers[i];
    return NULL;
}

void option_chosen(const asked_line *line, const char *by, const char *name, const char *const options[]) {
    for (size_t i = 0; options[i] != NULL; i++) {
        struct chooser *c = chooser_of(options[i]);
        if (option_given(line, options[i]) || (c == NULL && chooser_count == CHOOSERS_MAX))
            continue;
        if (c == NULL)
            c = &choosers[chooser_count++];
        *c = (struct chooser){options[i], by, name};
    }
}

static int refuse(const char *option, const char *format, ...) __attribute__((format(printf, 2, 3)));
static int refuse(const char *option, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    const int status = named_error(option, format, arguments);
    va_end(arguments);
    return status;
}

int option_error(const char *name, const char *format, ...) {
    const struct chooser *c = chooser_of(name);
    char text[1024];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    return c != NULL ? refuse(name, "%s; --%s %s chose it", text, c->by, c->name) : refuse(name, "%s", text);
}

int option_refuse(const option_row *row, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    const int status = named_error(row->name, format, arguments);
    va_end(arguments);
    return status;
}

int option_unreadable(const char *name, const char *path, int number) {
    option_error(name, "%s: %s", path, strerror(number));
    return EXIT_IO;
}
