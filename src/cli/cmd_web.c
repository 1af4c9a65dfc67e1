/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * web: the link that opens commands in the page. The page's state is the commands themselves: the words as a shell
 * takes them are the link's fragment. Each but the first stands behind a word ';': a second set-up, what is asked of
 * the first. What the program refuses has no link.
 */
#include <string.h>

#include "cli/names.h"
#include "cli/options.h"
#include "cli/shell_word.h"
#include "core/append.h"

/* What the page has of the program. */
enum { SHOWN = VERB_TABLE | VERB_PLOT | VERB_ZFIGHT | VERB_BUDGET | VERB_SOLVE | VERB_BIAS };
static const name_list figures = {
    .words = (const char *const[]){"distribution", "share", "error", "interval", "budget", "map", NULL}};

enum { COMMANDS_MAX = 7, WORDS_MAX = 1000, FRAGMENT_MAX = 4096, TEXT_SIZE = FRAGMENT_MAX + 2 };

static int check_shown(const options *o) {
    char text[NAMES_SIZE];
    list_item found;
    if ((o->verb->bit & SHOWN) == 0)
        return usage_error("web: the page has table, plot, zfight, budget, solve and bias, got '%s'", o->verb->name);
    if (o->verb->bit == VERB_PLOT && !names_find(&figures, o->operands[0], NULL, &found))
        return usage_error("web: the page has the figures %s, got '%s'", names_join(&figures, ", ", " and ", text),
                           o->operands[0]);
    return EXIT_FINE;
}

/* Has the program itself read one command, and adds its words to the text. */
static int add_command(char **words, int count, char text[TEXT_SIZE]) {
    char *argv[WORDS_MAX + 2] = {(char[]){"depthprec"}};
    options o;
    if (count == 0)
        return usage_error("web: needs a command on either side of ';'");
    memcpy(argv + 1, words, (size_t)count * sizeof *words); /* they are put into another order when they are read */
    int status = options_parse(&o, count + 1, argv);
    if (status == EXIT_FINE)
        status = check_shown(&o);
    const bool named = verb_find(argv[1]) != NULL;
    options_release(&o);
    if (status != EXIT_FINE)
        return status;
    if (!named)
        append_shell_word(text, TEXT_SIZE, o.verb->name);
    for (int i = 0; i < count; i++)
        append_shell_word(text, TEXT_SIZE, words[i]);
    return EXIT_FINE;
}

static int read_commands(const options *o, char text[TEXT_SIZE]) {
    int commands = 0, status = EXIT_FINE;
    for (int first = 0, last; status == EXIT_FINE && first <= o->operand_count; first = last + 1) {
        for (last = first; last < o->operand_count && strcmp(o->operands[last], ";") != 0; last++)
            ;
        if (++commands > COMMANDS_MAX)
            return usage_error("web: the page shows at most %d commands", COMMANDS_MAX);
        if (commands > 1)
            append(text, TEXT_SIZE, " ;");
        status = add_command(o->operands + first, last - first, text);
    }
    return status;
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

int cmd_web(const options *o) {
    char text[TEXT_SIZE] = "", fragment[TEXT_SIZE];
    if (o->page[strcspn(o->page, "# \n")] != '\0')
        return option_error(OPTION_PAGE, "must be a URL without '#' and blanks, got '%s'", o->page);
    const int status = read_commands(o, text);
    if (status != EXIT_FINE)
        return status;
    if (encode(text + 1, fragment) == 0)
        return usage_error("web: a link holds at most %d characters of UTF-8 without control characters", FRAGMENT_MAX);
    output out;
    output_open(&out, NULL);
    output_text(&out, o->page);
    output_char(&out, '#');
    output_text(&out, fragment);
    output_char(&out, '\n');
    return output_close(&out);
}
