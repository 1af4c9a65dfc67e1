/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/commands.h"

#include <string.h>

#include "cli/cmd_help/request.h"
#include "cli/list.h"
#include "cli/option/option.h"

#define COMMAND_LISTED(name) &command_##name,
static const command_row *const commands[] = {COMMANDS(COMMAND_LISTED)};

/* In the order in which their headings follow one another; tables that are not named stand behind them. */
#define TABLES(one)                                                                                                    \
    one(camera) one(range) one(table) one(solve) one(origin) one(scene_eye) one(view) one(shadow) one(bias)            \
        one(zfight) one(prepass) one(stored) one(convert) one(scene) one(probe) one(code) one(judge) one(texture)      \
            one(figure) one(output)
#define TABLE_DECLARED(name) extern const option_table name##_options;
#define TABLE_LISTED(name)   &name##_options,
TABLES(TABLE_DECLARED)
const option_table *const option_order[] = {TABLES(TABLE_LISTED) NULL};

const command_row *command_get(size_t index) {
    return index < sizeof commands / sizeof commands[0] ? commands[index] : NULL;
}

bool list_command(size_t index, list_item *item) {
    const command_row *v = command_get(index);
    return v != NULL && list_fill(item, (list_item){.name = v->name, .note = v->summary, .row = v});
}

const command_row *command_find(const char *name) {
    for (size_t i = 0; command_get(i) != NULL; i++)
        if (strcmp(command_get(i)->name, name) == 0)
            return command_get(i);
    return NULL;
}

/* ---- Those that have no options ---------------------------------------------------------------------------------- */

static const name_list shells = {.words = (const char *const[]){"bash", "zsh", "fish", NULL}};

static const name_list helped = {.words = (const char *const[]){"options", NULL}, .get = list_command};

static const option_use uses[] = {END};
static const option_place places[] = {{.table = NULL}};

/* clang-format off */
const command_row command_help = {
    .name = "help", .request = sizeof(help_request), .places = places, .uses = uses, .open = true,
    .operand = "COMMAND|WORD", .operand_min = 0, .operand_max = 3, .names = &helped,
    .summary = "the options of a command, or what a word means",
    .example = "  depthprec help table\n"
    "  depthprec help options\n"
    "  depthprec help _ZBufferParams\n"};

const command_row command_completions = {
    .name = "completions", .request = sizeof(help_request), .places = places, .uses = uses,
    .operand = "SHELL", .operand_min = 1, .operand_max = 1, .names = &shells,
    .summary = "a script that completes commands, options and values",
    .example = "  . <(depthprec completions bash)\n"};
/* clang-format on */
