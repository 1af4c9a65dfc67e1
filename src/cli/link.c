/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * --link: the link that opens the command in the page. The page's state is the commands themselves: the words as a
 * shell takes them are the link's fragment. What the program refuses has no link.
 */
#include "cli/link.h"

#include <string.h>

#include "cli/shell_word.h"
#include "core/append.h"

/* The figures that the page has. */
static const name_list figures = {
    .words = (const char *const[]){"distribution", "share", "error", "interval", "budget", "map", NULL}};

enum { FRAGMENT_MAX = 4096, TEXT_SIZE = FRAGMENT_MAX + 2 };

static bool is_argument(const options *o, const char *word) {
    for (int id = 0; id < OPTION_COUNT; id++)
        if (o->given[id] == word)
            return true;
    return false;
}

static bool is_link(const options *o, const char *word) {
    return (strcmp(word, "--link") == 0 || strncmp(word, "--link=", 7) == 0) && !is_argument(o, word);
}

/* The command first, then the figure, then the options in their order; a blank before each. */
static void command_words(const options *o, char text[TEXT_SIZE]) {
    const bool named = o->argv[1][0] != '-';
    append_shell_word(text, TEXT_SIZE, o->command->name);
    for (int i = 0; i < o->operand_count; i++)
        append_shell_word(text, TEXT_SIZE, o->operands[i]);
    for (char **word = o->argv + 1 + named; *word != NULL && word != o->operands; word++)
        if (strcmp(*word, "--") != 0 && !is_link(o, *word))
            append_shell_word(text, TEXT_SIZE, *word);
}

/* As URLs have it: letters, digits and marks stand for themselves (RFC 3986). @return the length, or 0 where the text
 * is no UTF-8, has control characters, or is too long */
static size_t encode(const char *text, char out[TEXT_SIZE]) {
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.!~*'()";
    out[0] = '\0';
    for (size_t length; *text != '\0'; text += length) {
        length = text_character(text);
        if (length == 0)
            return 0;
        for (size_t i = 0; i < length; i++)
            append(out, TEXT_SIZE, strchr(plain, text[i]) != NULL ? "%c" : "%%%02X", (unsigned char)text[i]);
    }
    return strlen(out) <= FRAGMENT_MAX ? strlen(out) : 0;
}

int link_write(const options *o) {
    char text[TEXT_SIZE] = "", fragment[TEXT_SIZE];
    list_item found;
    output out;
    if (o->command->id == CMD_PLOT && !names_find(&figures, o->operands[0], NULL, &found))
        return option_error(OPTION_LINK, "must be of a figure that the page has, %s, got '%s'",
                            names_join(&figures, ", ", " or ", text), o->operands[0]);
    command_words(o, text);
    if (encode(text + 1, fragment) == 0)
        return option_error(OPTION_LINK, "holds at most %d characters of UTF-8 without control characters",
                            FRAGMENT_MAX);
    output_open(&out, NULL);
    output_format(&out, "%s#", o->out.link);
    output_text(&out, fragment);
    output_char(&out, '\n');
    return output_close(&out);
}
