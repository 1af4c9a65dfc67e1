/* SPDX-License-Identifier: GPL-3.0-or-later */
/* No setlocale here or anywhere: numbers are read and written in the C locale whatever LC_ALL says. */
#include <string.h>

#include "cli/link.h"
#include "cli/option/option.h"
#include "method/method.h"
#include "report/output.h"
#include "system/input.h"

/* In the order of command_get(). */
#define COMMAND_RUN(name) cmd_##name,
static int (*const runs[])(void *request) = {COMMANDS(COMMAND_RUN)};

static int run(const asked_line *line) {
    size_t i = 0;
    while (command_get(i) != line->command)
        i++;
    return option_given(line, "link") ? link_write(line) : runs[i](line->request);
}

/* The file that an option names for writing, or null. "-" is none, whatever lies in the folder. */
static const char *file_of(const asked_line *line, const char *name) {
    const char *path = option_written(line, name);
    return path != NULL && strcmp(path, "-") != 0 ? path : NULL;
}

/* An option's file is written: it may be no other option's and none that the command reads. */
static int refuse_overwriting(const asked_line *line) {
    const option_row *all[OPTIONS_MAX + 1];
    for (int k = line->command->files_from; k > 0 && k <= line->operand_count; k++)
        input_expect(line->operands[k - 1]);
    options_all(all);
    for (size_t i = 0; all[i] != NULL; i++) {
        const char *name = all[i]->name, *path = file_of(line, name);
        if (path == NULL)
            continue;
        if (input_is_read(path))
            return option_error(name, "must not be a file that is read, got '%s'", path);
        for (size_t k = 0; k < i; k++) {
            const char *other = all[k]->name, *also = file_of(line, other);
            const bool beside = strcmp(name, "output") == 0; /* the file beside the output is at fault */
            if (also != NULL && strcmp(other, name) != 0 && output_same_file(path, also))
                return option_error(beside ? other : name, "must not be the file of --%s, got '%s'",
                                    beside ? name : other, beside ? also : path);
        }
    }
    return EXIT_FINE;
}

/* Whoever asked for JSON gets what is wrong as JSON, too, where nothing is written yet. */
static void tell_fault(const asked_line *line, char **argv, int status) {
    while (*argv != NULL && strcmp(*argv, "--json") != 0 && strcmp(*argv, "--") != 0)
        argv++;
    if (status >= EXIT_USAGE && *argv != NULL && strcmp(*argv, "--json") == 0 && !output_begun())
        error_write_json(line->command != NULL ? line->command->name : "table", status);
}

int main(int argc, char **argv) {
    asked_line line;
    output_reserve_streams();
    method_start();
    int status = options_parse(&line, argc, argv);
    if (status == EXIT_FINE)
        status = refuse_overwriting(&line);
    if (status == EXIT_FINE)
        status = run(&line);
    tell_fault(&line, argv, status);
    options_release(&line);
    return status;
}
