/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file commands.h  The commands. Each has its row, command_NAME, beside its options in the file options.c of its
 * folder, and a function, cmd_NAME, which main() gives the request. Its name in COMMANDS is the one line that makes it
 * known.
 */
#ifndef CLI_COMMANDS_H
#define CLI_COMMANDS_H

#include <stddef.h>

#include "cli/option/names.h"

struct option_place;
struct option_rule;
struct option_use;

/** One of several ways of a command, as each figure is of plot: some options are for some of them. */
typedef struct command_part {
    const char *words; /**< "with --light-box"; null behind the last */
    unsigned bits;
} command_part;

/** Words that people type as options and that are none. */
typedef struct command_word {
    const char *names; /**< one space between, in any case; null behind the last */
    const char *said;  /**< what they are, and what to write */
} command_word;

typedef struct command_row {
    const char *name;
    int (*run)(void *request);           /**< what main() runs. @return a status of report/output.h */
    size_t request;                      /**< how large what it is given is, which begins with `asked_line *line` */
    const struct option_place *places;   /**< where the tables of its options put what they read */
    const struct option_use *uses;       /**< which of them it takes */
    const struct option_rule *rules;     /**< what relates two of them; or null */
    int (*complete)(void *request);      /**< what follows from several options; or null. @return an exit status */
    const command_word *words;           /**< those that it answers with a sentence; or null */
    const char *operand;                 /**< how help writes the operand, "FIGURE"; "" when there is none */
    int operand_min, operand_max;        /**< how many operands the command takes */
    const name_list *names;              /**< what the first operand may be; null when it is no name */
    bool open;                           /**< other words than those names may be something, too */
    const char *summary;                 /**< one line for `depthprec --help` */
    const char *example;                 /**< command lines for the command's own help, one a line */
    int files_from;                      /**< operands from this one on are files that it reads, from 1; 0: none */
    const char *group;                   /**< the heading above this row and those behind it, or null */
    size_t (*part)(const void *request); /**< which part is asked for; null where all is one */
    const command_part *parts;           /**< null where part_get() has them */
    bool (*part_get)(size_t index, command_part *out); /**< part `index`; false behind the last */
    const char *part_of;                               /**< how a refusal begins the words of a part; or null */
    unsigned shown;                                    /**< the parts whose options its help describes; 0: all */
} command_row;

/** The commands, in the order of help. */
/* clang-format off */
#define COMMANDS(one) \
    one(table) \
    one(budget) \
    one(solve) \
    one(check) \
    one(zfight) \
    one(prepass) \
    one(convert) \
    one(bias) \
    one(world) \
    one(scene) \
    one(texture) \
    one(shadow) \
    one(methods) \
    one(code) \
    one(judge) \
    one(probe) \
    one(plot) \
    one(list) \
    one(help) \
    one(completions)
/* clang-format on */

/** A command's row, and its function, which returns a status of report/output.h. */
#define COMMAND_DECLARED(name)                                                                                         \
    extern const command_row command_##name;                                                                           \
    int cmd_##name(void *request);
COMMANDS(COMMAND_DECLARED)

/** Command `index`, in the order of help; null behind the last. */
const command_row *command_get(size_t index);

/** The row of a command name; null when there is none. */
const command_row *command_find(const char *name);

/** Whether `list WORD` explains it. */
bool list_knows(const char *word);

#endif
