/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file uses.h  Which command takes which options, and what is its own of them.
 *
 * A command lists uses: options, and groups of them that several commands take. What a use leaves null is as the row of
 * the option has it. Where an option is found twice the first is meant, so what is a command's own stands before its
 * groups.
 */
#ifndef CLI_OPTION_USES_H
#define CLI_OPTION_USES_H

#include "cli/option/rows.h"

/** What is a command's own of an option; null where it is as the row has it. */
typedef struct option_own {
    const char *argument; /**< how help writes the argument */
    const char *optional; /**< an argument that may be left out, and is written behind "=" */
    const char *help;     /**< what it does */
    const char *also;     /**< what it does beside that */
    const char *standard; /**< the default, which is read as if it were typed, */
    const char *without;  /**< and what it means, or holds without the option; "": nothing is said of it */
    option_parser *parse; /**< another language than the row's */
} option_own;

typedef struct option_use {
    option_id id;
    unsigned parts;                 /**< the parts of the command that take it, see commands.h; 0: all of them */
    const option_own *own;          /**< not null */
    const struct option_use *group; /**< in place of an option: all of these */
} option_use;

/** Nothing of its own. */
extern const option_own option_plain;

/** The uses of each command, for commands.c; and what its parts are, which one is asked for. */
extern const option_use table_uses[], budget_uses[], solve_uses[], check_uses[], zfight_uses[], prepass_uses[],
    bias_uses[], world_uses[], scene_uses[], texture_uses[], shadow_uses[], methods_uses[], code_uses[], judge_uses[],
    probe_uses[], plot_uses[], list_uses[], no_uses[];
extern const command_part table_parts[], solve_parts[], shadow_parts[], texture_parts[], judge_parts[];
size_t table_asked(const options *o), solve_asked(const options *o), shadow_asked(const options *o),
    texture_asked(const options *o), judge_asked(const options *o), plot_asked(const options *o);

/** The use of an option by those parts of a command, ~0u for any; null where they do not take it. */
const option_use *option_used(const command_row *v, unsigned parts, option_id id);

/** Part `index` of a command; false behind the last. */
bool option_part_get(const command_row *v, size_t index, command_part *out);

/** The bits of the part that is asked for, ~0u where the command has none. Operands are known. */
unsigned option_parts(const options *o);

/** Refuses an option of that command which the part of it that is asked for does not take. @return EXIT_FINE, or
 * EXIT_USAGE after one line on stderr */
int option_check_parts(const options *o, const command_row *v);

/** The default of an option for a command, and what holds without it, each null where there is none. */
void option_default(const option_use *use, const char **standard, const char **without);

/** The argument that may be left out; null where there is none. */
const char *option_use_optional(const option_use *use);

/** How help writes the argument for a command, with the names where there is no other; "" when there is none.
 * @return out */
const char *option_use_argument(const option_use *use, char out[OPTION_TEXT_SIZE]);

#endif
