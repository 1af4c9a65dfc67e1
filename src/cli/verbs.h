/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file verbs.h  The commands, one row each. Adding a command is adding a row to verbs.c.
 *
 * Two programs are made of the same objects. The light one holds only what needs libc and libm, and starts as fast as
 * an empty program. A command that needs a heavy library is declared weak in verbs.c: in the light program its `run`
 * is null, and main() hands the whole command line to depthprec-full with verb_run_full().
 */
#ifndef CLI_VERBS_H
#define CLI_VERBS_H

#include <stddef.h>

struct options;

/** Exit statuses; every command returns one of these. */
enum {
    EXIT_FINE = 0,   /**< done */
    EXIT_FAILED = 1, /**< a check or requirement failed */
    EXIT_USAGE = 2,  /**< bad usage or bad input */
    EXIT_IO = 3      /**< could not read or write */
};

/** One bit per command, for the `commands` column of the option table. */
enum {
    VERB_TABLE = 1u << 0,
    VERB_PLOT = 1u << 1,
    VERB_LIST = 1u << 2,
    VERB_HELP = 1u << 3,
    VERB_ZFIGHT = 1u << 4,
    VERB_BUDGET = 1u << 5,
    VERB_CHECK = 1u << 6,
    VERB_SOLVE = 1u << 7,
    VERB_BIAS = 1u << 8,
    VERB_BENCH = 1u << 9,
    VERB_STABILITY = 1u << 10,
    VERB_TEXTURE = 1u << 11
};

typedef struct verb {
    const char *name;
    unsigned bit;                       /**< VERB_... */
    int (*run)(const struct options *); /**< null in a program that was linked without it */
    const char *operand;                /**< how help writes the operand, "FIGURE"; "" when there is none */
    int operand_min, operand_max;       /**< how many operands the command takes */
    const char *operand_hint;           /**< added to the message when one is missing, or null */
    const char *summary;                /**< one line for `depthprec --help` */
    const char *example;                /**< command lines for the command's own help, one a line */
} verb;

extern const verb verb_rows[];
extern const size_t verb_count;

/** The row of a command name; null when there is none. */
const verb *verb_find(const char *name);

/**
 * Runs depthprec-full (beside this program, else in ../libexec/depthprec) with the same arguments.
 * Returns only when that fails: EXIT_IO, after one line on stderr.
 */
int verb_run_full(char **argv);

#endif
