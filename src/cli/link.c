/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * --link: the link that opens the command in the page. The page's state is the commands themselves: the words as a
 * shell takes them are the link's fragment. What the program refuses has no link.
 */
#include "cli/link.h"

#include <string.h>

#include "cli/shell_word.h"
#include "core/append.h"
#include "system/input.h"

/* The figures that the page draws as the program does. Its staircase is of the planes of its set-up, whatever the
 * format. */
static const name_list figures = {
    .words = (const char *const[]){"distribution", "share", "error", "interval", "budget", "map", NULL}};

enum { FRAGMENT_MAX = 4096, TEXT_SIZE = FRAGMENT_MAX + 2 };

static bool is_argument(const asked_line *line, const char *word) {
    size_t i = 0;
    while (i < line->given_count && line->given[i].text != word)
        i++;
    return i < line->given_count;
}

static bool is_link(const asked_line *line, const char *word) {
    return (strcmp(word, "--link") == 0 || strncmp(word, "--link=", 7) == 0) && !is_argument(line, word);
}

/* The command first, then the figure, then the options in their order; a blank before each. */
static void command_words(const asked_line *line, char text[TEXT_SIZE]) {
    const bool named = line->argv[1][0] != '-';
    append_shell_word(text, TEXT_SIZE, line->command->name);
    for (int i = 0; i < line->operand_count; i++)
        append_shell_word(text, TEXT_SIZE, line->operands[i]);
    for (char **word = line->argv + 1 + named; *word != NULL && word != line->operands; word++)
        if (strcmp(*word, "--") != 0 && !is_link(line, *word))
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

int link_write(const asked_line *line) {
    char text[TEXT_SIZE] = "", fragment[TEXT_SIZE];
    list_item found;
    const char *page = option_text(line, "link");
    output out;
    if (line->command->part_get != NULL && !names_find(&figures, line->operands[0], NULL, &found))
        return option_error("link", "must be of a figure that the page draws as here, %s, got '%s'",
                            names_join(&figures, ", ", " or ", text), line->operands[0]);
    for (size_t i = 0; i < line->given_count; i++) {
        const char *name = line->given[i].name, *value = line->given[i].text;
        if (value != NULL && ((strcmp(name, "at") == 0 && value[0] == '@') || input_is_read(value)))
            return option_error("link", "holds no file, which the page could not read: write out what is in --%s %s",
                                name, value);
    }
    command_words(line, text);
    if (encode(text + 1, fragment) == 0)
        return option_error("link", "holds at most %d characters of UTF-8 without control characters", FRAGMENT_MAX);
    output_open(&out, NULL);
    output_format(&out, "%s#", *page != '\0' ? page : "depthprec.html");
    output_text(&out, fragment);
    output_char(&out, '\n');
    return output_close(&out);
}
