/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The door of the module: the program's own main() on words that the page has written, what the program makes of such
 * words, and which options a command takes. engine.js is the other side; each call has an instance of its own.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "camera/presets.h"
#include "cli/cmd_help/describe.h"
#include "cli/option/option.h"
#include "report/output.h"
#include "web/page.h"

enum { WORDS_MAX = 1024 };

static char *text;                 /* words, each ended by 0, the command's name first */
static char *words[WORDS_MAX + 2]; /* the program's name before them, null behind them */

int main(int argc, char **argv);

/** Room for the words of a command line in so many bytes; null when out of memory. */
PAGE_EXPORT("words") char *words_room(size_t size) {
    free(text);
    text = calloc(size + 1, 1);
    return text;
}

/* How many words there are with the program's name; 0 where they are too many. */
static int split_words(int count) {
    char *at = text;
    if (count < 0 || count > WORDS_MAX)
        return 0;
    words[0] = "depthprec";
    for (int i = 1; i <= count; i++, at += strlen(at) + 1)
        words[i] = at;
    return count + 1;
}

int page_words(int count, char ***out) {
    *out = words;
    return split_words(count);
}

/** Runs the command of `count` words. @return its exit status */
PAGE_EXPORT("run") int run_words(int count) {
    const int argc = split_words(count);
    const int status = argc > 0 ? main(argc, words) : usage_error("at most %d words make a command", WORDS_MAX);
    fflush(NULL);
    return status;
}

static void say(const char *word) {
    fwrite(word, 1, strlen(word) + 1, stdout);
}

/**
 * Prints the words as the program reads them, each ended by 0: the command, how many operands, the operands, then
 * each option that was given and its argument, "" of none, as the option table has them in order. @return exit status
 */
PAGE_EXPORT("parse") int parse_words(int count) {
    asked_line line;
    const int argc = split_words(count);
    const int status = argc > 0 ? options_parse(&line, argc, words) : usage_error("at most %d words", WORDS_MAX);
    if (status == EXIT_FINE) {
        const option_row *all[OPTIONS_MAX + 1];
        char number[16];
        snprintf(number, sizeof number, "%d", line.operand_count);
        say(line.command->name);
        say(number);
        for (int i = 0; i < line.operand_count; i++)
            say(line.operands[i]);
        options_all(all);
        for (size_t i = 0; all[i] != NULL; i++)
            if (option_find(line.command, all[i]->name) == all[i] && option_given(&line, all[i]->name)) {
                say(all[i]->name);
                say(option_text(&line, all[i]->name));
            }
    }
    if (argc > 0)
        options_release(&line);
    fflush(NULL);
    return status;
}

/* The rows that an option's argument may name, separated by one space; presets whose planes are computed are more than
 * a name. */
static void say_names(const option_row *row) {
    list_item item;
    size_t i = 0;
    while (row->names != NULL && row->names->words != NULL && row->names->words[i] != NULL)
        i++;
    for (; row->names != NULL && names_get(row->names, i, &item); i++) {
        const preset *engine = strcmp(row->name, "preset") == 0 ? item.row : NULL;
        if (engine == NULL || engine->function == NULL)
            printf("%s ", item.name);
    }
    say("");
}

/** The options of the command that is the first word: name, argument ("" of none), help and names of each.
 * @return exit status */
PAGE_EXPORT("takes") int taken_by_words(int count) {
    const option_row *all[OPTIONS_MAX + 1];
    char argument[OPTION_TEXT_SIZE], help[DESCRIPTION_SIZE];
    const command_row *v = split_words(count) > 1 ? command_find(words[1]) : NULL;
    options_all(all);
    for (size_t i = 0; v != NULL && all[i] != NULL; i++) {
        const option_taken use = option_used(v, ~0U, all[i]);
        if (use.row != NULL) {
            say(use.row->name);
            say(option_use_argument(&use, argument));
            say(option_describe(&use, help));
            say_names(use.row);
        }
    }
    fflush(NULL);
    return v != NULL ? EXIT_FINE : EXIT_USAGE;
}

PAGE_EXPORT("version") void say_version(void) {
    printf("%s", dp_version());
    fflush(NULL);
}
