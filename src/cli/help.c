/* SPDX-License-Identifier: GPL-3.0-or-later */
/* help: made from the command table and the option table; and the version. */
#include <stdio.h>
#include <string.h>

#include "cli/option/rows.h"
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

/* In groups by what a person asks of. */
static void list_commands(output *out) {
    page p = page_start(out, 18);
    output_text(out, "What a depth buffer can tell apart: exact precision and certified worst cases.\n\n"
                     "  depthprec -n 10cm -f 1km -F d24,fp32 -m gl,reversed   how far each keeps 1 cm\n"
                     "  depthprec --preset unity,unreal --at 100m             two engines side by side\n\n"
                     "Commands: depthprec [COMMAND] [options]\n");
    for (size_t i = 0; i < command_count; i++) {
        char label[64] = "";
        if (command_rows[i].group != NULL)
            page_title(&p, "%s", command_rows[i].group);
        append(label, sizeof label, "%s%s%.*s", command_rows[i].name, *command_rows[i].operand != '\0' ? " " : "",
               (int)strcspn(command_rows[i].operand, " "), command_rows[i].operand);
        page_note(&p, label, "%s%s", command_rows[i].summary, i == 0 ? " (default)" : "");
    }
    output_text(out, "\n'depthprec help COMMAND' lists its options. Lengths may have a unit: 10cm.\n"
                     "Exit: 0 success, 1 a check failed, 2 bad usage or input, 3 cannot read or write.\n");
}

enum { DESCRIPTION_SIZE = 1024 };

/* "default D: what that means", or "default of solve D, else what holds". */
static void add_default(const char *of, const char *standard, const char *without, bool excepted,
                        char out[DESCRIPTION_SIZE]) {
    append(out, DESCRIPTION_SIZE, "default%s%s%s%s%s", *of != '\0' ? " of " : "", of, standard != NULL ? " " : "",
           standard != NULL ? standard : "",
           without == NULL                ? ""
           : standard != NULL && excepted ? ", "
                                          : ": ");
    append(out, DESCRIPTION_SIZE, "%s", without != NULL ? without : "");
}

/* What is otherwise for some commands. */
static void add_exception(const struct option_exception *e, char out[DESCRIPTION_SIZE]) {
    const bool has_default = e->standard != NULL || e->without != NULL;
    char takers[OPTION_TEXT_SIZE];
    option_takers_of(e->commands, takers);
    append(out, DESCRIPTION_SIZE, "; ");
    if (e->help != NULL)
        append(out, DESCRIPTION_SIZE, "%s: %s%s", takers, e->help, has_default ? ", " : "");
    if (has_default)
        add_default(e->help != NULL ? "" : takers, e->standard, e->without, true, out);
}

/* "what it does (LEAST to MOST UNIT; default D: what that means)" for a command, in its own words; for all of them,
 * those with another default at the end. */
static const char *describe(const command_row *v, const option_row *row, char out[DESCRIPTION_SIZE]) {
    char text[OPTION_TEXT_SIZE];
    const struct option_exception *other = v != NULL ? option_exception_of(row, v) : NULL;
    const char *help = other != NULL && other->help != NULL ? other->help : row->help;
    const char *standard = other != NULL ? other->standard : row->standard;
    const char *without = other != NULL ? other->without : row->without;
    const int before = (int)strcspn(help, "@");
    const bool named = help[before] != '\0', limited = row->least < row->most;
    out[0] = '\0';
    append(out, DESCRIPTION_SIZE, "%.*s", before, help);
    if (named)
        append(out, DESCRIPTION_SIZE, "%s%s", names_join(row->names, ", ", ", ", text), help + before + 1);
    for (int i = 0; i < OPTION_ADDITIONS; i++)
        if (row->adds[i].commands != 0 && (v == NULL || (row->adds[i].commands & v->bit) != 0))
            append(out, DESCRIPTION_SIZE, "; %s", row->adds[i].words);
    if (limited)
        append(out, DESCRIPTION_SIZE, " (%s", option_limits(row, text));
    if (standard != NULL || without != NULL) {
        append(out, DESCRIPTION_SIZE, limited ? "; " : " (");
        add_default("", standard, without, other != NULL, out);
    }
    if (limited || standard != NULL || without != NULL)
        append(out, DESCRIPTION_SIZE, ")");
    for (int i = 0; v == NULL && i < OPTION_EXCEPTIONS; i++)
        if (row->except[i].commands != 0)
            add_exception(&row->except[i], out);
    return out;
}

/* Those of a command; without one, all, and which commands take them. */
static void list_options(page *p, const command_row *v) {
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
        if (row->optional != NULL)
            append(label, sizeof label, "[=%s]", row->optional);
        page_wrapped(p, label, describe(v, row, text));
        snprintf(text, sizeof text, "Taken by %s.", option_takers(row, argument));
        if (v == NULL && ~row->commands != 0)
            page_wrapped(p, "", text);
    }
}

int cmd_help(const options *o) {
    const command_row *v = o->operand_row;
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
        if (v != NULL)
            output_format(&out, "\n'man depthprec-%s' has more.\n", v->name);
    }
    return output_close(&out);
}
