/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file option_rows.h  The option table. getopt's arrays, the help of every command and the completion come from it.
 */
#ifndef CLI_OPTION_ROWS_H
#define CLI_OPTION_ROWS_H

#include "cli/options.h"

typedef struct option_row {
    const char *name;     /**< long name without dashes; null in a seat kept free */
    char letter;          /**< short name, 0 when there is none */
    const char *argument; /**< how help writes the argument, "Z"; null when the option takes none */
    unsigned commands;    /**< the VERB_... bits of the commands that take it */
    const char *help;     /**< what it does and its default; a line feed continues below */
    int (*parse)(options *o, const char *value); /**< EXIT_FINE, or EXIT_USAGE after one line on stderr */
} option_row;

/** Index: option_id. */
extern const option_row option_rows[OPTION_COUNT];

#endif
