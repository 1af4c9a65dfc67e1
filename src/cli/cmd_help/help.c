/* SPDX-License-Identifier: GPL-3.0-or-later */
/* help: made from the command table and the option table; and the version. */
#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include "cli/cmd_help/describe.h"
#include "cli/cmd_help/request.h"
#include "cli/cmd_list/request.h"
#include "cli/list.h"
#include "cli/words.h"
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
        const size_t indent = strspn(lines, " ");
        snprintf(line, sizeof line, "%s%.*s", indent > 0 ? "" : "depthprec ", (int)(length - indent), lines + indent);
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
    const command_row *v;
    for (size_t i = 0; (v = command_get(i)) != NULL; i++) {
        char label[64] = "";
        if (v->group != NULL)
            page_title(&p, "%s", v->group);
        append(label, sizeof label, "%s%s%.*s", v->name, *v->operand != '\0' ? " " : "", (int)strcspn(v->operand, " "),
               v->operand);
        page_note(&p, label, "%s%s", v->summary, i == 0 ? " (default)" : "");
    }
    output_char(out, '\n');
    page_text(&p,
              "'depthprec help COMMAND' lists its options, 'help questions' what people ask, 'help WORD' says what a "
              "word means. Lengths may have a unit: 10cm.");
    page_text(&p, "A bug: tell who gave you depthprec the command, what it printed, and 'depthprec version'.");
    page_text(&p, "Exit: 0 success, 1 a check failed, 2 bad usage or input, 3 cannot read or write.");
}

/* "-n, --near Z". */
static void label_of(const option_taken *use, char label[128]) {
    const option_row *row = use->row;
    char argument[OPTION_TEXT_SIZE];
    option_use_argument(use, argument);
    snprintf(label, 128, "    ");
    if (row->letter != 0)
        snprintf(label, 128, "-%c, ", row->letter);
    append(label, 128, "--%s%s%s", row->name, *argument != '\0' ? " " : "", argument);
    if (option_use_optional(use) != NULL)
        append(label, 128, "[=%s]", option_use_optional(use));
}

/* Those of a command; without one, all by their first row, and which commands take them. */
static void list_options(page *p, const command_row *v) {
    const option_row *all[OPTIONS_MAX + 1];
    const unsigned parts = v != NULL && v->shown != 0 ? v->shown : ~0U;
    const char *group = NULL, *shown = NULL, *last = "";
    options_all(all);
    for (size_t i = 0; all[i] != NULL; i++) {
        const option_taken use = v != NULL ? option_used(v, parts, all[i]) : (option_taken){.row = all[i]};
        char label[128], text[DESCRIPTION_SIZE], takers[OPTION_TEXT_SIZE];
        group = all[i]->group != NULL ? all[i]->group : group;
        if (use.row == NULL || strcmp(use.row->name, last) == 0)
            continue;
        last = use.row->name;
        if (group != shown)
            output_format(p->out, "\n%s\n", group);
        shown = group;
        label_of(&use, label);
        page_wrapped(p, label, option_describe(&use, text));
        snprintf(text, sizeof text, "Taken by %s.", option_takers(last, takers));
        if (v == NULL && all[i]->parse != NULL)
            page_wrapped(p, "", text);
    }
}

/* The options that a part takes beside those that are shown, and a command which describes the first of them. */
static const char *others_of(const command_row *v, unsigned part, char text[DESCRIPTION_SIZE],
                             char takers[OPTION_TEXT_SIZE]) {
    const option_row *all[OPTIONS_MAX + 1];
    options_all(all);
    text[0] = '\0';
    for (size_t i = 0; all[i] != NULL; i++) {
        if (option_used(v, part, all[i]).row == NULL || option_used(v, v->shown, all[i]).row != NULL)
            continue;
        if (text[0] == '\0')
            option_takers(all[i]->name, takers);
        append(text, DESCRIPTION_SIZE, "%s--%s", text[0] != '\0' ? ", " : "", all[i]->name);
    }
    takers[strcspn(takers, ",")] = '\0';
    return text;
}

/* Options of single parts, which the command describes that has their name, or the first word of it, else the first
 * that takes them. */
static void list_others(page *p, const command_row *v) {
    command_part part;
    bool headed = false;
    for (size_t i = 0; v->shown != 0 && option_part_get(v, i, &part); i++) {
        char text[DESCRIPTION_SIZE], takers[OPTION_TEXT_SIZE] = "", label[64], name[64];
        if (*others_of(v, part.bits, text, takers) == '\0')
            continue;
        if (!headed)
            output_format(p->out, "\nOptions of single figures\n");
        headed = true;
        snprintf(label, sizeof label, "  %s %s", v->name, part.words);
        snprintf(name, sizeof name, "%.*s", (int)strcspn(part.words, "-"), part.words);
        append(text, sizeof text, ": see 'depthprec help %s'", command_find(name) != NULL ? name : takers);
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

/* Whether two words are the same but for blanks, hyphens, underscores and case; `length` is that of the first. */
static bool is_spelled(const char *name, size_t length, const char *text) {
    static const char apart[] = " -_";
    size_t i = 0;
    for (;; i++, text++) {
        for (; i < length && strchr(apart, name[i]) != NULL; i++)
            ;
        text += strspn(text, apart);
        if (i == length || *text == '\0')
            return i == length && *text == '\0';
        if (tolower((unsigned char)name[i]) != tolower((unsigned char)*text))
            return false;
    }
}

static bool is_word(const word_row *row, const char *text) {
    if (is_spelled(row->name, strlen(row->name), text))
        return true;
    size_t length;
    for (const char *list = row->aliases; list != NULL && *list != '\0'; list += length + (list[length] == ' ')) {
        length = strcspn(list, " ");
        if (is_spelled(list, length, text))
            return true;
    }
    return false;
}

/* The operands are one word with blanks in it; a member such as _ZBufferParams.z is looked up by what it belongs to. */
static const word_row *word_of(const asked_line *line, char word[NAMES_SIZE]) {
    char whole[NAMES_SIZE];
    word[0] = '\0';
    for (int i = 0; i < line->operand_count; i++)
        append(word, NAMES_SIZE, "%s%s", i > 0 ? " " : "", line->operands[i]);
    const word_row *row = word_find(word);
    snprintf(whole, sizeof whole, "%.*s", (int)strcspn(word, ".(["), word);
    for (size_t i = 0; row == NULL && *whole != '\0' && (row = word_get(i)) != NULL && !is_word(row, whole); i++)
        row = NULL;
    return row;
}

/* The commands, the words and the lists, for the nearest. */
static bool list_all(size_t index, list_item *item) {
    static const name_list parts[] = {{.get = list_command}, {.rows = &word_table}, {.get = list_topic}};
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++) {
        size_t count = 0;
        for (; names_get(&parts[i], count, item); count++)
            if (count == index)
                return true;
        index -= count;
    }
    return false;
}

static int refuse_word(const char *word) {
    char near[NAMES_SIZE];
    names_nearest(&(name_list){.get = list_all}, "", word, 3, near);
    return usage_error("help: nothing is called '%.64s'%s", word,
                       *near != '\0' ? near
                                     : "; 'depthprec help' lists the commands, 'depthprec list words' the words");
}

/* Prints the meaning of a word and the commands that answer. */
static int say_word(const word_row *row) {
    output out;
    output_open(&out, NULL);
    output_page(&out);
    page p = page_start(&out, 2);
    page_text(&p, "%s: %s", row->name, row->note);
    say_examples(&p, row->commands);
    return output_close(&out);
}

static int help_word(const help_request *o) {
    char word[NAMES_SIZE];
    const word_row *row = word_of(o->line, word);
    if (row != NULL)
        return say_word(row);
    return o->line->operand_count == 1 && list_knows(word) ? cmd_list(&(list_request){.line = o->line})
                                                           : refuse_word(word);
}

int cmd_help(void *request) {
    const help_request *o = request;
    const command_row *v = o->line->operand_row;
    output out;
    if (o->line->command == &command_help && o->line->operand_count > 0 &&
        (o->line->operand_count > 1 || !names_find(o->line->command->names, o->line->operands[0], NULL, NULL)))
        return help_word(o);
    output_open(&out, NULL);
    output_page(&out);
    page p = page_start(&out, 28);
    if (o->line->version)
        version(&p);
    else if (v == NULL && o->line->operand_count == 0)
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
