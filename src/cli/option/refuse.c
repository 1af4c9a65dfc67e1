/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What options are called, and how one is refused: who did not name what is refused is told where it comes from. */
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "cli/option/rows.h"

const char *option_name(option_id id) {
    return option_rows[id].name;
}

const char *option_word(option_id id, size_t index) {
    list_item item = {0};
    names_get(option_rows[id].names, index, &item);
    return item.name;
}

/* What gave an option its value in place of the user: a preset or a platform; its own option and name. */
static struct chooser {
    option_id by;
    const char *name; /* null where the user or the default did */
} choosers[OPTION_COUNT];

void option_forget_choosers(void) {
    memset(choosers, 0, sizeof choosers);
}

static int error_of(option_id id, const char *format, ...) __attribute__((format(printf, 2, 3)));
static int error_of(option_id id, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    int status = named_error(option_name(id), format, arguments);
    va_end(arguments);
    return status;
}

/* Who did not name what is refused is told where it comes from. */
int option_error(option_id id, const char *format, ...) {
    const struct chooser *c = &choosers[id];
    char text[1024];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    return c->name != NULL ? error_of(id, "%s; --%s %s chose it", text, option_name(c->by), c->name)
                           : error_of(id, "%s", text);
}

void option_chosen(const options *o, option_id by, const char *name, const option_id *ids, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (!option_given(o, ids[i]))
            choosers[ids[i]] = (struct chooser){by, name};
}
