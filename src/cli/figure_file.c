/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/figure_file.h"

#include <stdlib.h>
#include <string.h>

#include "cli/shell_word.h"

enum { COMMAND_LINE_SIZE = 4096 };

/*
 * The words of the command, for the metadata, quoted where a shell would see more in one than a word, without where the
 * figure was written to, an argument in o->argv: a figure is the same under any name.
 */
static void command_line(const options *o, const char *written, char out[COMMAND_LINE_SIZE]) {
    const char *first = o->operand_count > 0 ? o->operands[0] : NULL;
    snprintf(out, COMMAND_LINE_SIZE, "depthprec %s", o->command->name);
    if (first != NULL)
        append_shell_word(out, COMMAND_LINE_SIZE, first);
    for (char **word = o->argv + 2; *word != NULL; word++) {
        bool next_is_written = word[1] != NULL && word[1] == written;
        bool holds_written = written != NULL && written >= *word && written <= *word + strlen(*word);
        if (*word != first && strcmp(*word, "--") != 0 && !next_is_written && !holds_written)
            append_shell_word(out, COMMAND_LINE_SIZE, *word);
    }
}

int figure_file_type(const options *o, option_id id, const char *path, canvas_format *out) {
    const bool typed = option_given(o, OPTION_TYPE);
    *out = canvas_format_of(path);
    if (typed && *out != CANVAS_FORMAT_COUNT && *out != o->figure.type)
        return option_error(OPTION_TYPE, "must be %s, which is what '%s' ends in, got '%s'",
                            option_word(OPTION_TYPE, *out), path, option_word(OPTION_TYPE, o->figure.type));
    if (*out == CANVAS_FORMAT_COUNT && !typed && strcmp(path, "-") != 0)
        return option_error(id, "must end in .svg, .pdf or .png, or --type say which, got '%s'", path);
    if (*out == CANVAS_FORMAT_COUNT)
        *out = (canvas_format)o->figure.type;
    if (!canvas_writes(*out))
        return option_error(typed ? OPTION_TYPE : id,
                            "must be svg, because this program was built without cairo: rsvg-convert makes %s of it",
                            option_word(OPTION_TYPE, *out));
    return EXIT_FINE;
}

bool figure_file_wanted(const options *o) {
    const bool file = o->out.file != NULL && strcmp(o->out.file, "-") != 0;
    return o->out.form == FORM_TEXT ||
           (file && (option_given(o, OPTION_TYPE) || canvas_format_of(o->out.file) != CANVAS_FORMAT_COUNT));
}

bool figure_file_write(const options *o, const char *path, const chart *c, int width, int height, output *out) {
    char line[COMMAND_LINE_SIZE];
    canvas_bytes bytes;
    canvas_format type;
    command_line(o, path, line);
    if (figure_file_type(o, OPTION_OUTPUT, path, &type) != EXIT_FINE ||
        !draw_chart(c, theme_get(o->figure.theme), type, width, height, line, &bytes))
        return false;
    output_bytes(out, bytes.at, bytes.size);
    free(bytes.at);
    return true;
}
