/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The command line: words become options of a command, and what their rows read. */
#include <ctype.h>
#include <getopt.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "cli/list.h"
#include "cli/option/option.h"
#include "core/append.h"
#include "depthprec/mapping.h"
#include "system/input.h"

/* ---- Defaults ---------------------------------------------------------------------------------------------------- */

/* Sets the defaults of the rows; those of a command's own follow when its options are read. */
static void set_defaults(asked_line *line) {
    for (const option_place *p = line->command->places; p->table != NULL; p++) {
        void *const group = (char *)line->request + p->at;
        if (p->table->begin != NULL)
            p->table->begin(line, group);
        for (const option_row *row = p->table->rows; row->name != NULL; row++)
            if (row->standard != NULL)
                row->parse(line, row, row->standard, group);
    }
}

static void set_own_defaults(asked_line *line) {
    for (const option_place *p = line->command->places; p->table != NULL; p++)
        for (const option_row *row = p->table->rows; row->name != NULL; row++) {
            const option_taken use = option_used(line->command, line->parts, row);
            if (use.row != NULL && use.own.standard != NULL && !option_given(line, row->name))
                use.parse(line, row, use.own.standard, (char *)line->request + p->at);
        }
}

/* The request of the command; of the line before, nothing. @return an exit status */
static int begin(asked_line *line, const command_row *command) {
    line->command = command;
    line->lengths = &line->own_lengths;
    line->parts = ~0U;
    line->request = asked_allocate(line, command->request);
    if (line->request == NULL)
        return usage_error("no memory for %s", command->name);
    *(asked_line **)line->request = line;
    set_defaults(line);
    return EXIT_FINE;
}

/* ---- Words ------------------------------------------------------------------------------------------------------- */

/* Each name of an option once, for getopt: its letter stands for it, or a number that no letter has. */
typedef struct known {
    const option_row *rows[OPTIONS_MAX + 1];
    size_t count;
    char letters[2 * OPTIONS_MAX + 4];
    struct option longs[OPTIONS_MAX + 1];
    char also[OPTION_TEXT_SIZE]; /* the other names */
    size_t also_used;
} known;

enum { LONG_ONLY = 256 };

static bool takes_argument(const option_row *row) {
    return row->argument != NULL || row->names != NULL;
}

/* An option's other names stand for it, too. */
static void know_also(known *k, const option_row *row, int has, int value) {
    char *name = k->also + k->also_used;
    append(name, sizeof k->also - k->also_used, "%s", row->also);
    k->also_used += strlen(name) + 1;
    for (char *end; name != NULL && k->count < OPTIONS_MAX; name = end) {
        end = strchr(name, ' ');
        if (end != NULL)
            *end++ = '\0';
        k->longs[k->count] = (struct option){name, has, NULL, value};
        k->rows[k->count++] = row;
    }
}

/* The letters begin with the sign by which words come in order, as arguments of an option 1. */
static void know(known *k) {
    const option_row *all[OPTIONS_MAX + 1];
    char *letters = k->letters;
    options_all(all);
    k->count = k->also_used = 0;
    *letters++ = '-';
    *letters++ = ':'; /* a missing argument is told apart from an unknown option */
    for (size_t i = 0; all[i] != NULL; i++) {
        const option_row *row = all[i];
        if (k->count > 0 && strcmp(k->rows[k->count - 1]->name, row->name) == 0)
            continue;
        const int has = takes_argument(row) ? required_argument : optional_argument; /* where it may: read_option() */
        const int value = row->letter != 0 ? row->letter : LONG_ONLY + (int)k->count;
        k->longs[k->count] = (struct option){row->name, has, NULL, value};
        k->rows[k->count++] = row;
        if (row->also != NULL)
            know_also(k, row, has, value);
        if (row->letter != 0) {
            *letters++ = row->letter;
            if (takes_argument(row))
                *letters++ = ':';
        }
    }
    *letters = '\0';
    k->longs[k->count] = (struct option){NULL, 0, NULL, 0};
}

/* The option's row in this command, else in another one. */
static const option_row *row_of_value(const known *k, int value, const command_row *v) {
    for (size_t i = 0; i < k->count; i++)
        if (k->longs[i].val == value) {
            const option_row *own = option_find(v, k->rows[i]->name);
            return own != NULL ? own : k->rows[i];
        }
    return NULL;
}

/* The sentence that a command has for a word that is no option of any; null: none. */
static const char *said_of(const command_word *words, const char *given) {
    const size_t length = strlen(given);
    for (; words != NULL && words->names != NULL; words++)
        for (const char *name = words->names; *name != '\0'; name += strcspn(name, " "), name += *name == ' ')
            if (strcspn(name, " ") == length && strncasecmp(name, given, length) == 0)
                return words->said;
    return NULL;
}

/* getopt has refused: say what and why, with the nearest option that the command takes. */
static int unknown_option(const asked_line *line, const known *k, int refused, const char *argument) {
    if (refused != 0)
        return usage_error("unknown option '-%c'; 'depthprec help %s' lists its options", refused, line->command->name);
    const int length = (int)strcspn(argument, "=");
    const char *taken[OPTIONS_MAX + 1];
    size_t count = 0;
    for (size_t i = 0; i < k->count; i++)
        if (option_used(line->command, ~0U, option_find(line->command, k->rows[i]->name)).row != NULL)
            taken[count++] = k->longs[i].name;
    taken[count] = NULL;
    char text[NAMES_SIZE], given[64] = "";
    const name_list all = {.words = taken};
    append(given, sizeof given, "%.*s", length > 2 ? length - 2 : 0, argument + (length > 2 ? 2 : 0));
    dp_mapping mapping;
    const char *said = said_of(line->command->words, given);
    if (said != NULL)
        return usage_error("'%.*s' is no option: %s", length, argument, said);
    if (dp_mapping_parse(given, &mapping) == DP_OK)
        return usage_error("unknown option '%.*s'; did you mean '--mapping %s'?", length, argument, given);
    if (*names_nearest(&all, "--", given, 2, text) != '\0')
        return usage_error("unknown option '%.*s'%s", length, argument, text);
    return usage_error("unknown option '%.*s'; 'depthprec help %s' lists its options", length, argument,
                       line->command->name);
}

static int wrong_command(const asked_line *line, const option_row *row) {
    char takers[OPTION_TEXT_SIZE];
    const char *said = said_of(line->command->words, row->name);
    if (said != NULL)
        return option_refuse(row, "is not an option of %s: %s", line->command->name, said);
    return option_refuse(row, "is not an option of %s, but of %s%s", line->command->name,
                         option_takers(row->name, takers), row->instead != NULL ? row->instead : "");
}

int check_operand(const command_row *v, const char *what, const name_list *n, const char *given, list_item *found) {
    char text[NAMES_SIZE];
    if (names_find(n, given, NULL, found))
        return EXIT_FINE;
    return usage_error("%s: %.*s %s", v->name, (int)strcspn(what, " "), what, names_refuse(n, given, text));
}

/* Guesses the meaning of a word out of place: a command; two lengths are near and far. @return out */
static const char *nearest_word(char **words, int count, char out[NAMES_SIZE]) {
    if (count < 2 || !isdigit((unsigned char)*words[0]) ||
        !(isdigit((unsigned char)*words[1]) || strcmp(words[1], "inf") == 0))
        return names_nearest(&(name_list){.get = list_command}, "", words[0], 2, out);
    out[0] = '\0';
    append(out, NAMES_SIZE, "; did you mean '-n %s -f %s'?", words[0], words[1]);
    return out;
}

static int check_operands(asked_line *line) {
    const command_row *v = line->command;
    list_item item = {0};
    char text[NAMES_SIZE] = "";
    if (line->operand_count > v->operand_max)
        return usage_error("unexpected argument '%s'%s", line->operands[v->operand_max],
                           nearest_word(line->operands + v->operand_max, line->operand_count - v->operand_max, text));
    if (line->operand_count < v->operand_min)
        return usage_error("%s: needs %s%s%s", v->name, v->operand, v->names != NULL ? ": " : "",
                           v->names != NULL ? names_join(v->names, ", ", " or ", text) : "");
    int status = EXIT_FINE;
    if (v->open && line->operand_count > 0)
        names_find(v->names, line->operands[0], NULL, &item);
    else if (v->names != NULL && line->operand_count > 0)
        status = check_operand(v, v->operand, v->names, line->operands[0], &item);
    line->operand_row = item.row;
    return status;
}

static int read_option(asked_line *line, const option_row *row, const char *argument) {
    const option_taken use = option_used(line->command, ~0U, row);
    const char *before = option_text(line, row->name);
    if (use.row == NULL)
        return wrong_command(line, row);
    if (argument != NULL && !takes_argument(row) && option_use_optional(&use) == NULL)
        return option_refuse(row, "takes no argument, got '%s'", argument);
    if (before != NULL && (takes_argument(row) || argument != NULL) && !row->repeats)
        return option_refuse(row, "must not be given twice, got '%s' too", argument);
    option_give(line, row->name, argument != NULL ? argument : "");
    return use.parse(line, row, argument, option_group(line, row));
}

static int needs_argument(const asked_line *line, const option_row *row) {
    const option_taken use = option_used(line->command, ~0U, row);
    char text[OPTION_TEXT_SIZE];
    return option_refuse(row, "needs an argument, %s",
                         use.row != NULL ? option_use_argument(&use, text) : option_argument(row, text));
}

static int ask_for_help(asked_line *line, const option_row *row, const command_row *about) {
    const int status = begin(line, command_find("help"));
    option_give(line, row->name, "");
    line->operand_row = about;
    line->version = strcmp(row->name, "version") == 0;
    return status;
}

/*
 * Those that are early, or the others; what is wrong with the line is told with the others. argv[0] is the program, or
 * the command in its place.
 */
static int read_words(asked_line *line, const known *k, int argc, char **argv, const command_row *about, bool early) {
    optind = 0; /* start anew, also when an earlier call stopped half-way */
    int found = -1;
    for (int value; (value = getopt_long(argc, argv, k->letters + 1, k->longs, &found)) != -1; found = -1) {
        const char *const word = argv[optind > 1 && optarg == argv[optind - 1] ? optind - 2 : optind - 1];
        /* The beginning of an option is none: of other tools it is a word of its own. */
        const bool cut = found >= 0 && strcspn(word, "=") != strlen(k->longs[found].name) + 2;
        if (cut)
            value = '?';
        const option_row *row = row_of_value(k, value == ':' ? optopt : value, line->command);
        /* An argument that is missing behind a word: musl's getopt returns the option itself, without one. */
        const bool lacks = value == ':' || (value != '?' && takes_argument(row) && optarg == NULL);
        const bool ends = value == '?' || lacks || row->parse == NULL;
        if (early && ends)
            return EXIT_FINE;
        if (value == '?')
            return unknown_option(line, k, cut ? 0 : optopt, cut ? word : argv[optind > 1 ? optind - 1 : 1]);
        if (lacks)
            return needs_argument(line, row);
        if (ends)
            return ask_for_help(line, row, about);
        const int status = row->early == early ? read_option(line, row, optarg) : EXIT_FINE;
        if (status != EXIT_FINE)
            return status;
    }
    line->operands = argv + optind;
    line->operand_count = argc - optind;
    return EXIT_FINE;
}

/* getopt puts words into another order, and C libraries differ in when: of a line that ends half-way, too. So the pass
 * for the early ones has words of its own. */
static int read_options(asked_line *line, const known *k, int argc, char **argv, const command_row *about, bool early) {
    char **words = early ? malloc(((size_t)argc + 1) * sizeof *words) : argv;
    if (words == NULL)
        return usage_error("no memory for %d words", argc);
    if (early)
        memcpy(words, argv, ((size_t)argc + 1) * sizeof *words);
    const int status = read_words(line, k, argc, words, about, early);
    if (early)
        free(words);
    for (const option_place *p = line->command->places; early && p->table != NULL; p++)
        if (p->table->early != NULL)
            p->table->early(line, (char *)line->request + p->at);
    return status;
}

/* Puts the command before all options where the first word that belongs to no option is one. */
static void put_command_first(const known *k, int argc, char **argv) {
    int value;
    opterr = 0;
    optind = 0;
    do
        value = getopt_long(argc, argv, k->letters, k->longs, NULL);
    while (value != -1 && value != '?' && value != ':' && value != 1);
    if (value != 1 || command_find(argv[optind - 1]) == NULL)
        return;
    char *const word = argv[optind - 1];
    memmove(argv + 2, argv + 1, (size_t)(optind - 2) * sizeof *argv);
    argv[1] = word;
}

/* Checks the options together, now that each is read. */
static int finish(asked_line *line) {
    const command_row *v = line->command;
    int status = check_operands(line);
    if (status != EXIT_FINE)
        return status;
    line->parts = option_parts(line);
    set_own_defaults(line);
    if (v->part != NULL)
        status = option_check_parts(line, v, v->part(line->request));
    if (status == EXIT_FINE && v->complete != NULL)
        status = v->complete(line->request);
    return status == EXIT_FINE ? option_check_rules(line) : status;
}

int options_parse(asked_line *line, int argc, char **argv) {
    const command_row *command = command_find("table");
    char text[NAMES_SIZE];
    known k = {.count = 0};
    input_forget();
    option_forget_choosers();
    *line = (asked_line){.argv = argv};
    if (argc < 1)
        return usage_error("no program name was given");
    static char version[] = "--version";
    if (argc > 1 && strcmp(argv[1], version + 2) == 0)
        argv[1] = version; /* as people type it */
    know(&k);
    put_command_first(&k, argc, argv);
    const bool named = argc > 1 && argv[1][0] != '-';
    if (named)
        command = command_find(argv[1]);
    if (command == NULL) {
        nearest_word(argv + 1, argc - 1, text);
        return usage_error("unknown command '%s'%s", argv[1],
                           *text != '\0' ? text : "; 'depthprec --help' lists the commands");
    }
    int status = begin(line, command);
    if (status == EXIT_FINE)
        status = read_options(line, &k, argc - named, argv + named, named ? command : NULL, true);
    if (status == EXIT_FINE)
        status = read_options(line, &k, argc - named, argv + named, named ? command : NULL, false);
    const bool helped = option_given(line, "help") || option_given(line, "version");
    return status == EXIT_FINE && !helped ? finish(line) : status;
}
