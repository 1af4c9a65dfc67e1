/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "plot/cmd_plot/figure_file.h"

#include <stdlib.h>
#include <string.h>

#include "cli/shell_word.h"

enum { COMMAND_LINE_SIZE = 4096 };

/*
 * The words of the command, for the metadata, quoted where a shell would see more in one than a word, without where the
 * figure was written to, an argument in line->argv: a figure is the same under any name.
 */
static void command_line(const asked_line *line, const char *written, char out[COMMAND_LINE_SIZE]) {
    const char *first = line->operand_count > 0 ? line->operands[0] : NULL;
    snprintf(out, COMMAND_LINE_SIZE, "depthprec %s", line->command->name);
    if (first != NULL)
        append_shell_word(out, COMMAND_LINE_SIZE, first);
    for (char **word = line->argv + 2; *word != NULL; word++) {
        bool next_is_written = word[1] != NULL && word[1] == written;
        bool holds_written = written != NULL && written >= *word && written <= *word + strlen(*word);
        if (*word != first && strcmp(*word, "--") != 0 && !next_is_written && !holds_written)
            append_shell_word(out, COMMAND_LINE_SIZE, *word);
    }
}

int figure_file_type(const asked_line *line, const figure_asked *f, const char *name, const char *path,
                     canvas_format *out) {
    const bool typed = option_given(line, "type");
    *out = canvas_format_of(path);
    if (typed && *out != CANVAS_FORMAT_COUNT && *out != f->type)
        return option_error("type", "must be %s, which is what '%s' ends in, got '%s'", option_word("type", *out), path,
                            option_word("type", f->type));
    if (*out == CANVAS_FORMAT_COUNT && !typed && strcmp(path, "-") != 0)
        return option_error(name, "must end in .svg, .pdf or .png, or --type say which, got '%s'", path);
    if (*out == CANVAS_FORMAT_COUNT)
        *out = (canvas_format)f->type;
    const char *lacks = canvas_lacks(*out);
    if (lacks != NULL)
        return option_error(typed ? "type" : name, "%s", lacks);
    return EXIT_FINE;
}

bool figure_file_wanted(const asked_line *line, const output_asked *o) {
    const bool file = o->file != NULL && strcmp(o->file, "-") != 0;
    return o->form == FORM_TEXT ||
           (file && (option_given(line, "type") || canvas_format_of(o->file) != CANVAS_FORMAT_COUNT));
}

bool figure_file_write(const asked_line *line, const figure_asked *f, const char *path, const chart *c, int width,
                       int height, output *out) {
    char words[COMMAND_LINE_SIZE];
    canvas_bytes bytes;
    canvas_format type;
    command_line(line, path, words);
    if (figure_file_type(line, f, "output", path, &type) != EXIT_FINE ||
        !draw_chart(c, theme_get(f->theme), type, width, height, words, &bytes))
        return false;
    output_bytes(out, bytes.at, bytes.size);
    free(bytes.at);
    return true;
}
