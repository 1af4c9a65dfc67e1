/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The rows of all commands together. */
#include <string.h>

#include "cli/option/option.h"
#include "core/append.h"

/* Adds a row behind the last of its name, which says under which heading it stands; else behind all. */
static size_t add_row(const option_row *out[OPTIONS_MAX + 1], size_t count, const option_row *row) {
    size_t at = count;
    for (size_t i = count; i-- > 0 && at == count;)
        if (out[i]->name[0] == row->name[0] && strcmp(out[i]->name, row->name) == 0)
            at = i + 1;
    if (count == OPTIONS_MAX)
        return count;
    memmove(out + at + 1, out + at, (count - at) * sizeof *out);
    out[at] = row;
    return count + 1;
}

/* Those of a table, once. */
static size_t add_rows(const option_row *out[OPTIONS_MAX + 1], size_t count, const option_row *rows) {
    for (size_t i = 0; i < count; i++)
        if (out[i] == rows)
            return count;
    for (const option_row *row = rows; row->name != NULL; row++)
        count = add_row(out, count, row);
    return count;
}

void options_all(const option_row *out[OPTIONS_MAX + 1]) {
    size_t count = 0;
    for (size_t i = 0; option_order[i] != NULL; i++)
        count = add_rows(out, count, option_order[i]->rows);
    count = add_rows(out, count, option_always);
    for (size_t i = 0; command_get(i) != NULL; i++)
        for (const option_place *p = command_get(i)->places; p->table != NULL; p++)
            count = add_rows(out, count, p->table->rows);
    out[count] = NULL;
}

const char *option_word(const char *name, size_t index) {
    const option_row *all[OPTIONS_MAX + 1];
    list_item item = {0};
    options_all(all);
    for (size_t i = 0; all[i] != NULL && item.name == NULL; i++)
        if (strcmp(all[i]->name, name) == 0)
            names_get(all[i]->names, index, &item);
    return item.name;
}

const char *option_takers(const char *name, char out[OPTION_TEXT_SIZE]) {
    const command_row *v;
    out[0] = '\0';
    for (size_t i = 0; (v = command_get(i)) != NULL; i++)
        if (option_used(v, ~0U, option_find(v, name)).row != NULL)
            append(out, OPTION_TEXT_SIZE, "%s%s", out[0] != '\0' ? ", " : "", v->name);
    return out;
}
