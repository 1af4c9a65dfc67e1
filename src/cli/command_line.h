/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file command_line.h  The command line for the metadata of a figure. */
#ifndef CLI_COMMAND_LINE_H
#define CLI_COMMAND_LINE_H

#include "cli/options.h"

enum { COMMAND_LINE_SIZE = 4096 };

/**
 * The words of the command, quoted where a shell would see more in one than a word, without where the figure was
 * written to: a figure is the same under any name.
 * @param written  the argument of -o or --figure, as it lies in o->argv
 */
void command_line(const options *o, const char *written, char out[COMMAND_LINE_SIZE]);

#endif
