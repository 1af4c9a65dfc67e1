/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file commands.h  The commands, one row each. A new one is an enumerator and a function here, its row in commands.c,
 * its options in option/uses.c, and the row of main.c that runs it.
 */
#ifndef CLI_COMMANDS_H
#define CLI_COMMANDS_H

#include <stddef.h>

#include "cli/option/names.h"

struct options;

struct option_use;

typedef enum command_id {
    CMD_TABLE,
    CMD_BUDGET,
    CMD_SOLVE,
    CMD_CHECK,
    CMD_ZFIGHT,
    CMD_PREPASS,
    CMD_BIAS,
    CMD_WORLD,
    CMD_SCENE,
    CMD_TEXTURE,
    CMD_SHADOW,
    CMD_METHODS,
    CMD_CODE,
    CMD_JUDGE,
    CMD_PROBE,
    CMD_PLOT,
    CMD_LIST,
    CMD_HELP,
    CMD_COMPLETIONS,
    CMD_COUNT
} command_id;

/** What a command does in one of several ways, as each figure is of plot: some options are for some of them. */
typedef struct command_part {
    const char *words; /**< "with --light-box"; null behind the last */
    unsigned bits;
} command_part;

typedef struct command_row {
    const char *name;
    command_id id;                           /**< its index */
    const struct option_use *uses;           /**< the options that it takes, see option/uses.h */
    const char *operand;                     /**< how help writes the operand, "FIGURE"; "" when there is none */
    int operand_min, operand_max;            /**< how many operands the command takes */
    const name_list *names;                  /**< what the first operand may be; null when it is no name */
    const char *summary;                     /**< one line for `depthprec --help` */
    const char *example;                     /**< command lines for the command's own help, one a line */
    int files_from;                          /**< operands from this one on are files that it reads, from 1; 0: none */
    const char *group;                       /**< the heading above this row and those behind it, or null */
    size_t (*part)(const struct options *o); /**< which part is asked for; null where all is one */
    const command_part *parts;               /**< null where they are the figures */
    const char *words;                       /**< of shaders, by which help finds it, one space between; or null */
    unsigned shown;                          /**< the parts whose options its help describes; 0: all */
} command_row;

/** Index: command_id. */
extern const command_row command_rows[CMD_COUNT];
enum { command_count = CMD_COUNT };

/* What main() runs: one cmd_....c each, but for help.c and completions.c. Each returns a status of report/output.h. */
int cmd_table(const struct options *o);
int cmd_budget(const struct options *o);
int cmd_bias(const struct options *o);
int cmd_shadow(const struct options *o);
int cmd_scene(const struct options *o);
int cmd_probe(const struct options *o);
int cmd_code(const struct options *o);
int cmd_judge(const struct options *o);
int cmd_list(const struct options *o);
bool list_knows(const char *word); /**< whether `list WORD` explains it */
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

/** "table, plot, budget": the commands that take the option of that id. @return out */
const char *command_takers(int id, char out[NAMES_SIZE]);

/** The row of a command name; null when there is none. */
const command_row *command_find(const char *name);

#endif
