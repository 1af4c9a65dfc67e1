/* SPDX-License-Identifier: GPL-3.0-or-later */
/* help: made from the verb table and the option table; and the version. */
#include <stdio.h>
#include <string.h>

#include "cli/option_rows.h"
#include "core/append.h"
#include "report/page.h"

/* In GNU layout. */
static void version(output *out) {
    output_format(out, "depthprec %s\n", dp_version());
    output_text(out, "License GPLv3+: GNU GPL version 3 or later <https://gnu.org/licenses/gpl.html>\n"
                     "The library libdepthprec alone: MIT licence\n"
                     "This is free software: you are free to change and redistribute it.\n"
                     "There is NO WARRANTY, to the extent permitted by law.\n");
}

static void list_commands(output *out) {
    page p = page_start(out, 17);
    output_text(out, "What a depth buffer can tell apart: exact precision and certified worst cases.\n\n"
                     "  depthprec                                       the table of a common camera\n"
                     "  depthprec -n 0.05 -f 4000 -F depth24plus        both formats that a browser may choose\n"
                     "  depthprec -n 0.1 -f inf -F fp32 -m reversed     an infinite far plane\n\n"
                     "Usage: depthprec [COMMAND] [options]\n\nCommands\n");
    for (size_t i = 0; i < verb_count; i++) {
        char label[64] = "";
        append(label, sizeof label, "%s%s%s", verb_rows[i].name, *verb_rows[i].operand != '\0' ? " " : "",
               verb_rows[i].operand);
        page_note(&p, label, "%s%s", verb_rows[i].summary, i == 0 ? " (default)" : "");
    }
    output_text(out, "\n'depthprec help COMMAND' lists the options of a command. Depths are in scene units.\n"
                     "Exit status: 0 fine, 1 a check failed, 2 bad usage or input, 3 could not read or write.\n");
}

enum { DESCRIPTION_SIZE = 1024 };

/* "what it does (LEAST to MOST UNIT; default D: what that means)" for a command; for all of them, those with another
 * default at the end. */
static const char *describe(const verb *v, const option_row *row, char out[DESCRIPTION_SIZE]) {
    char text[OPTION_TEXT_SIZE];
    const int before = (int)strcspn(row->help, "@");
    const bool named = row->help[before] != '\0', limited = row->least < row->most;
    const bool other = v != NULL && (row->except.commands & v->bit) != 0;
    const char *standard = other ? NULL : row->standard, *meaning = other ? row->except.text : row->without;
    out[0] = '\0';
    append(out, DESCRIPTION_SIZE, "%.*s", before, row->help);
    if (named)
        append(out, DESCRIPTION_SIZE, "%s%s", names_join(row->names, ", ", ", ", text), row->help + before + 1);
    if (limited)
        append(out, DESCRIPTION_SIZE, " (%s", option_limits(row, text));
    if (standard != NULL || meaning != NULL)
        append(out, DESCRIPTION_SIZE, "%sdefault%s%s%s%s", limited ? "; " : " (", standard != NULL ? " " : "",
               standard != NULL ? standard : "", meaning != NULL ? ": " : "", meaning != NULL ? meaning : "");
    for (size_t i = 0; v == NULL && i < verb_count; i++)
        if ((row->except.commands & verb_rows[i].bit) != 0)
            append(out, DESCRIPTION_SIZE, "; of %s: %s", verb_rows[i].name, row->except.text);
    if (limited || standard != NULL || meaning != NULL)
        append(out, DESCRIPTION_SIZE, ")");
    return out;
}

/* Those of a command; without one, all, and which commands take them. */
static void list_options(page *p, const verb *v) {
    const char *group = NULL, *shown = NULL;
    for (int id = 0; id < OPTION_COUNT; id++) {
        const option_row *row = &option_rows[id];
        char label[128] = "    ", text[DESCRIPTION_SIZE], argument[OPTION_TEXT_SIZE];
        group = row->group != NULL ? row->group : group;
        if (v != NULL && (row->commands & v->bit) == 0)
            continue;
        if (group != shown)
            output_format(p->out, "\n%s\n", group);
        shown = group;
        if (row->letter != 0)
            snprintf(label, sizeof label, "-%c, ", row->letter);
        option_argument(row, argument);
        append(label, sizeof label, "--%s%s%s", row->name, *argument != '\0' ? " " : "", argument);
        page_wrapped(p, label, describe(v, row, text));
        snprintf(text, sizeof text, "Taken by %s.", option_takers(row, argument));
        if (v == NULL && ~row->commands != 0)
            page_wrapped(p, "", text);
    }
}

int cmd_help(const options *o) {
    const verb *v = o->operand_row;
    output out;
    output_open(&out, NULL);
    page p = page_start(&out, 28);
    if (o->version)
        version(&out);
    else if (v == NULL && o->operand_count == 0)
        list_commands(&out);
    else {
        if (v == NULL)
            output_text(&out, "The options of all commands, and which take them\n");
        else
            output_format(&out, "depthprec %s: %s\n\n%s\nUsage: depthprec %s%s%s [options]\n", v->name, v->summary,
                          v->example, v->name, *v->operand != '\0' ? " " : "", v->operand);
        list_options(&p, v);
    }
    return output_close(&out);
}
