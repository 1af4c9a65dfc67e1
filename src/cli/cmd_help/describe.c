/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/cmd_help/describe.h"

#include <string.h>

#include "core/append.h"

const char *option_describe(const option_taken *use, char out[DESCRIPTION_SIZE]) {
    const option_row *row = use->row;
    const char *help = use->own.help != NULL ? use->own.help : row->help, *standard, *without;
    char text[OPTION_TEXT_SIZE];
    const int before = row->names != NULL ? (int)strcspn(help, "@") : (int)strlen(help);
    const bool named = help[before] != '\0', limited = row->least < row->most && use->own.parse == NULL;
    option_default(use, &standard, &without);
    out[0] = '\0';
    append(out, DESCRIPTION_SIZE, "%.*s", before, help);
    if (named)
        append(out, DESCRIPTION_SIZE, "%s%s", names_join(row->names, ", ", ", ", text), help + before + 1);
    if (use->own.also != NULL)
        append(out, DESCRIPTION_SIZE, "; %s", use->own.also);
    for (const char *name = row->also; name != NULL; name = strchr(name, ' ') != NULL ? strchr(name, ' ') + 1 : NULL)
        append(out, DESCRIPTION_SIZE, "%s%.*s", name == row->also ? "; also as " : ", ", (int)strcspn(name, " "), name);
    if (limited)
        append(out, DESCRIPTION_SIZE, " (%s", option_limits(row, text));
    if (standard != NULL || without != NULL)
        append(out, DESCRIPTION_SIZE, "%sdefault%s%s%s%s", limited ? "; " : " (", standard != NULL ? " " : "",
               standard != NULL ? standard : "", without != NULL ? ": " : "", without != NULL ? without : "");
    if (limited || standard != NULL || without != NULL)
        append(out, DESCRIPTION_SIZE, ")");
    return out;
}
