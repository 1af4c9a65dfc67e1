/* SPDX-License-Identifier: GPL-3.0-or-later */
/* No setlocale here or anywhere: numbers are read and written in the C locale whatever LC_ALL says. */
#include <string.h>

#include "cli/link.h"
#include "method/method.h"
#include "system/input.h"

static int (*const commands[CMD_COUNT])(const options *) = {
    [CMD_TABLE] = cmd_table,
    [CMD_PLOT] = cmd_plot,
    [CMD_ZFIGHT] = cmd_zfight,
    [CMD_PREPASS] = cmd_prepass,
    [CMD_BUDGET] = cmd_budget,
    [CMD_TEXTURE] = cmd_texture,
    [CMD_METHODS] = cmd_methods,
    [CMD_CHECK] = cmd_check,
    [CMD_SOLVE] = cmd_solve,
    [CMD_BIAS] = cmd_bias,
    [CMD_SHADOW] = cmd_shadow,
    [CMD_SCENE] = cmd_scene,
    [CMD_PROBE] = cmd_probe,
    [CMD_JUDGE] = cmd_judge,
    [CMD_WORLD] = cmd_world,
    [CMD_CODE] = cmd_code,
    [CMD_LIST] = cmd_list,
    [CMD_HELP] = cmd_help,
    [CMD_COMPLETIONS] = cmd_completions,
};

static int run(const options *o) {
    if (option_given(o, OPTION_LINK))
        return link_write(o);
    return commands[o->command->id](o);
}

/* An option's file is written: it may be no other option's and none that the command reads. "-" is no file. */
static int refuse_overwriting(const options *o) {
    for (int k = o->command->files_from; k > 0 && k <= o->operand_count; k++)
        input_expect(o->operands[k - 1]);
    for (int id = 0; id < OPTION_COUNT; id++) {
        const char *path = option_written(o, (option_id)id);
        if (path == NULL || strcmp(path, "-") == 0)
            continue;
        if (input_is_read(path))
            return option_error((option_id)id, "must not be a file that is read, got '%s'", path);
        for (int other = 0; other < id; other++) {
            const char *also = option_written(o, (option_id)other);
            const bool beside = id == OPTION_OUTPUT; /* the file beside the output is at fault */
            if (also != NULL && output_same_file(path, also))
                return option_error((option_id)(beside ? other : id), "must not be the file of --%s, got '%s'",
                                    option_name((option_id)(beside ? id : other)), beside ? also : path);
        }
    }
    return EXIT_FINE;
}

int main(int argc, char **argv) {
    options o;
    output_reserve_streams();
    method_start();
    int status = options_parse(&o, argc, argv);
    if (status == EXIT_FINE)
        status = refuse_overwriting(&o);
    if (status == EXIT_FINE)
        status = run(&o);
    options_release(&o);
    return status;
}
