/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file commands.h  The commands, one row each. A new one is a bit and a function here, its row in commands.c, and the
 * row of main.c that runs it.
 */
#ifndef CLI_COMMANDS_H
#define CLI_COMMANDS_H

#include <stddef.h>

#include "cli/option/names.h"

struct options;

/** One bit per command, for the `commands` column of the option table. */
enum {
    CMD_TABLE = 1u << 0,
    CMD_PLOT = 1u << 1,
    CMD_LIST = 1u << 2,
    CMD_HELP = 1u << 3,
    CMD_ZFIGHT = 1u << 4,
    CMD_BUDGET = 1u << 5,
    CMD_CHECK = 1u << 6,
    CMD_SOLVE = 1u << 7,
    CMD_BIAS = 1u << 8,
    CMD_METHODS = 1u << 9,
    CMD_PREPASS = 1u << 10,
    CMD_TEXTURE = 1u << 11,
    CMD_COMPLETIONS = 1u << 12,
    CMD_SHADOW = 1u << 13,
    CMD_SCENE = 1u << 15,
    CMD_PROBE = 1u << 17,
    CMD_WORLD = 1u << 18
};

typedef struct command_row {
    const char *name;
    unsigned bit;                 /**< VERB_... */
    const char *operand;          /**< how help writes the operand, "FIGURE"; "" when there is none */
    int operand_min, operand_max; /**< how many operands the command takes */
    const name_list *names;       /**< what the first operand may be; null when it is no name */
    const char *summary;          /**< one line for `depthprec --help` */
    const char *example;          /**< command lines for the command's own help, one a line */
    int files_from;               /**< operands from this one on are files that it reads, counted from 1; 0: none */
    const char *group;            /**< the heading above this row and those behind it; null where the last goes on */
} command_row;

extern const command_row command_rows[];
extern const size_t command_count;

/* What main() runs: one cmd_....c each, but for help.c and completions.c. Each returns a status of report/output.h. */
int cmd_table(const struct options *o);
int cmd_budget(const struct options *o);
int cmd_bias(const struct options *o);
int cmd_shadow(const struct options *o);
int cmd_scene(const struct options *o);
int cmd_probe(const struct options *o);
int cmd_list(const struct options *o);
int cmd_plot(const struct options *o);
int cmd_zfight(const struct options *o);
int cmd_prepass(const struct options *o);
int cmd_methods(const struct options *o);
int cmd_check(const struct options *o);
int cmd_solve(const struct options *o);
int cmd_texture(const struct options *o);
int cmd_world(const struct options *o);
int cmd_help(const struct options *o);
int cmd_completions(const struct options *o);

/** The row of a command name; null when there is none. */
const command_row *command_find(const char *name);

#endif
