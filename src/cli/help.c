/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/help.h"

#include <stdio.h>
#include <string.h>

#include "cli/option_rows.h"
#include "cli/suggest.h"

int options_version(void) {
    output out;
    output_open(&out, NULL);
    output_format(&out, "depthprec %s\n", dp_version());
    output_text(&out, "License GPLv3+: GNU GPL version 3 or later <https://gnu.org/licenses/gpl.html>\n"
                      "The library libdepthprec alone: MIT licence\n"
                      "This is free software: you are free to change and redistribute it.\n"
                      "There is NO WARRANTY, to the extent permitted by law.\n");
    return output_close(&out);
}

static void list_commands(output *out) {
    output_text(out, "What a depth buffer can tell apart: exact precision and certified worst cases.\n\n"
                     "  depthprec                                       the table of a common camera\n"
                     "  depthprec -n 0.05 -f 4000 -F depth24plus        both formats that a browser may choose\n"
                     "  depthprec -n 0.1 -f inf -F fp32 -m reversed     an infinite far plane\n\n"
                     "Usage: depthprec [COMMAND] [options]\n\nCommands\n");
    for (size_t i = 0; i < verb_count; i++) {
        char left[64];
        snprintf(left, sizeof left, "%s%s%s", verb_rows[i].name, *verb_rows[i].operand != '\0' ? " " : "",
                 verb_rows[i].operand);
        output_format(out, "  %-16s %s%s\n", left, verb_rows[i].summary, i == 0 ? " (default)" : "");
    }
    output_text(out, "\n'depthprec help COMMAND' lists the options of a command. Depths are in scene units.\n"
                     "Exit status: 0 fine, 1 a check failed, 2 bad usage or input, 3 could not read or write.\n");
}

static void list_option(output *out, const option_row *row) {
    enum { LEFT = 30 };
    char left[96];
    char letter[5] = "    ";
    if (row->letter != 0)
        snprintf(letter, sizeof letter, "-%c, ", row->letter);
    int length = snprintf(left, sizeof left, "  %s--%s%s%s", letter, row->name, row->argument != NULL ? " " : "",
                          row->argument != NULL ? row->argument : "");
    if (length > LEFT - 2)
        output_format(out, "%s\n%*s", left, LEFT, "");
    else
        output_format(out, "%-*s", LEFT, left);
    for (const char *rest = row->help; *rest != '\0';) {
        int part = (int)strcspn(rest, "\n");
        output_format(out, "%.*s\n", part, rest);
        rest += part + (rest[part] == '\n');
        if (*rest != '\0')
            output_format(out, "%*s", LEFT, "");
    }
}

static void list_options(output *out, const verb *v) {
    output_format(out, "depthprec %s: %s\n\n%s\nUsage: depthprec %s%s%s [options]\n\nOptions\n", v->name, v->summary,
                  v->example, v->name, *v->operand != '\0' ? " " : "", v->operand);
    for (int id = 0; id < OPTION_COUNT; id++)
        if ((option_rows[id].commands & v->bit) != 0)
            list_option(out, &option_rows[id]);
}

int options_help(const verb *v) {
    output out;
    output_open(&out, NULL);
    if (v == NULL)
        list_commands(&out);
    else
        list_options(&out, v);
    return output_close(&out);
}

int cmd_help(const options *o) {
    if (o->operand_count == 0)
        return options_help(NULL);
    const char *name = o->operands[0];
    const verb *v = verb_find(name);
    if (v != NULL)
        return options_help(v);
    suggestion s = suggest_start(name);
    char text[SUGGEST_TEXT_SIZE];
    for (size_t i = 0; i < verb_count; i++)
        suggest_offer(&s, verb_rows[i].name);
    suggest_text(&s, "", text);
    return usage_error("unknown command '%s'%s", name, text[0] != '\0' ? text : "; 'depthprec --help' lists them");
}
