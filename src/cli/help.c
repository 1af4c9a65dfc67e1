/* SPDX-License-Identifier: GPL-3.0-or-later */
/* help: made from the command table and the option table; and the version. */
#include <stdio.h>
#include <string.h>

#include "cli/option/uses.h"
#include "core/append.h"
#include "report/page.h"

/* In GNU layout. */
static void version(page *p) {
    page_text(p, "depthprec %s", dp_version());
    page_text(p, "License GPLv3+: GNU GPL version 3 or later <https://gnu.org/licenses/gpl.html>");
    page_text(p, "The library libdepthprec alone: MIT licence");
    page_text(p, "This is free software: you are free to change and redistribute it.");
    page_text(p, "There is NO WARRANTY, to the extent permitted by law.");
}

/* Lines of commands, each indented. */
static void say_examples(page *p, const char *lines) {
    char line[256];
    for (size_t length; *lines != '\0'; lines += length + (lines[length] == '\n')) {
        length = strcspn(lines, "\n");
        snprintf(line, sizeof line, "%.*s", (int)length, lines + strspn(lines, " "));
        line[length - strspn(lines, " ")] = '\0';
        page_command(p, line);
    }
}

/* In groups by what a person asks of. */
static void list_commands(output *out) {
    page p = page_start(out, 18);
    page_text(&p, "What a depth buffer resolves, and up to which distance: exact and proven.");
    output_char(out, '\n');
    page_command(&p, "depthprec -n 10cm -f 1km -F d24,fp32 -m gl,reversed   each resolves 1 cm up to");
    page_command(&p, "depthprec --preset unity,unreal --at 100m             two engines side by side");
    output_char(out, '\n');
    page_text(&p, "Commands: depthprec [COMMAND] [options]");
    for (size_t i = 0; i < command_count; i++) {
        char label[64] = "";
        if (command_rows[i].group != NULL)
            page_title(&p, "%s", command_rows[i].group);
        append(label, sizeof label, "%s%s%.*s", command_rows[i].name, *command_rows[i].operand != '\0' ? " " : "",
               (int)strcspn(command_rows[i].operand, " "), command_rows[i].operand);
        page_note(&p, label, "%s%s", command_rows[i].summary, i == 0 ? " (default)" : "");
    }
    output_char(out, '\n');
    page_text(&p, "'depthprec help COMMAND' lists its options. Lengths may have a unit: 10cm.");
    page_text(&p, "Exit: 0 success, 1 a check failed, 2 bad usage or input, 3 cannot read or write.");
}

enum { DESCRIPTION_SIZE = 1024 };

/* "what it does (LEAST to MOST UNIT; default D: what that means)". */
static const char *describe(const option_use *use, char out[DESCRIPTION_SIZE]) {
    const option_row *row = &option_rows[use->id];
    const char *help = use->own->help != NULL ? use->own->help : row->help, *standard, *without;
    char text[OPTION_TEXT_SIZE];
    const int before = row->names != NULL ? (int)strcspn(help, "@") : (int)strlen(help);
    const bool named = help[before] != '\0', limited = row->least < row->most && use->own->parse == NULL;
    option_default(use, &standard, &without);
    out[0] = '\0';
    append(out, DESCRIPTION_SIZE, "%.*s", before, help);
    if (named)
        append(out, DESCRIPTION_SIZE, "%s%s", names_join(row->names, ", ", ", ", text), help + before + 1);
    if (use->own->also != NULL)
        append(out, DESCRIPTION_SIZE, "; %s", use->own->also);
    if (limited)
        append(out, DESCRIPTION_SIZE, " (%s", option_limits(row, text));
    if (standard != NULL || without != NULL)
        append(out, DESCRIPTION_SIZE, "%sdefault%s%s%s%s", limited ? "; " : " (", standard != NULL ? " " : "",
               standard != NULL ? standard : "", without != NULL ? ": " : "", without != NULL ? without : "");
    if (limited || standard != NULL || without != NULL)
        append(out, DESCRIPTION_SIZE, ")");
    return out;
}

/* "-n, --near Z". */
static void label_of(const option_use *use, char label[128]) {
    const option_row *row = &option_rows[use->id];
    char argument[OPTION_TEXT_SIZE];
    option_use_argument(use, argument);
    snprintf(label, 128, "    ");
    if (row->letter != 0)
        snprintf(label, 128, "-%c, ", row->letter);
    append(label, 128, "--%s%s%s", row->name, *argument != '\0' ? " " : "", argument);
    if (option_use_optional(use) != NULL)
        append(label, 128, "[=%s]", option_use_optional(use));
}

/* Those of a command; without one, all, and which commands take them. */
static void list_options(page *p, const command_row *v) {
    const unsigned parts = v != NULL && v->shown != 0 ? v->shown : ~0U;
    const char *group = NULL, *shown = NULL;
    for (int id = 0; id < OPTION_COUNT; id++) {
        const option_row *row = &option_rows[id];
        const option_use general = {.id = (option_id)id, .own = &option_plain};
        const option_use *use = v != NULL ? option_used(v, parts, (option_id)id) : &general;
        char label[128], text[DESCRIPTION_SIZE], takers[OPTION_TEXT_SIZE];
        group = row->group != NULL ? row->group : group;
        if (use == NULL)
            continue;
        if (group != shown)
            output_format(p->out, "\n%s\n", group);
        shown = group;
        label_of(use, label);
        page_wrapped(p, label, describe(use, text));
        snprintf(text, sizeof text, "Taken by %s.", command_takers(id, takers));
        if (v == NULL && id != OPTION_HELP && id != OPTION_VERSION)
            page_wrapped(p, "", text);
    }
}

/* Options of single parts, which the command that has their name describes, or the first that takes them. */
static void list_others(page *p, const command_row *v) {
    command_part part;
    bool headed = false;
    for (size_t i = 0; v->shown != 0 && option_part_get(v, i, &part); i++) {
        char text[DESCRIPTION_SIZE] = "", takers[OPTION_TEXT_SIZE], label[64];
        const char *like = command_find(part.words) != NULL ? part.words : NULL;
        for (int id = 0; id < OPTION_COUNT; id++) {
            if (option_used(v, part.bits, (option_id)id) == NULL || option_used(v, v->shown, (option_id)id) != NULL)
                continue;
            append(text, sizeof text, "%s--%s", text[0] != '\0' ? ", " : "", option_rows[id].name);
            if (like == NULL) {
                like = command_takers(id, takers);
                takers[strcspn(takers, ",")] = '\0';
            }
        }
        if (text[0] == '\0')
            continue;
        if (!headed)
            output_format(p->out, "\nOptions of single figures\n");
        headed = true;
        snprintf(label, sizeof label, "  %s %s", v->name, part.words);
        append(text, sizeof text, ": see 'depthprec help %s'", like);
        page_wrapped(p, label, text);
    }
}

static void say_usage(page *p, const command_row *v) {
    page_text(p, "depthprec %s: %s", v->name, v->summary);
    output_char(p->out, '\n');
    say_examples(p, v->example);
    output_char(p->out, '\n');
    page_text(p, "Usage: depthprec %s%s%s [options]", v->name, *v->operand != '\0' ? " " : "", v->operand);
}

int cmd_help(const options *o) {
    const command_row *v = o->operand_row;
    output out;
    list_item item;
    const name_list *names = o->command->names;
    if (o->command->id == CMD_HELP && o->operand_count > 0 && !names_find(names, o->operands[0], NULL, &item))
        return list_knows(o->operands[0])
                   ? cmd_list(o)
                   : check_operand(o->command, o->command->operand, names, o->operands[0], &item);
    output_open(&out, NULL);
    page p = page_start(&out, 28);
    if (o->version)
        version(&p);
    else if (v == NULL && o->operand_count == 0)
        list_commands(&out);
    else {
        if (v == NULL)
            page_text(&p, "The options of all commands, and which take them");
        else
            say_usage(&p, v);
        list_options(&p, v);
        if (v != NULL) {
            list_others(&p, v);
            output_char(&out, '\n');
            page_text(&p, "'man depthprec-%s' has more.", v->name);
        }
    }
    return output_close(&out);
}
