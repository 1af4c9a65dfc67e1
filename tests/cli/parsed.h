/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file parsed.h  A command line as the program reads it. */
#ifndef TESTS_PARSED_H
#define TESTS_PARSED_H

#include "cli/option/option.h"

/** options_parse(); `line` becomes the first line that it says on stderr, "" for none. */
int parsed(asked_line *o, int argc, char **argv, char line[1024]);

/** The request of the command of that name on it. */
#define ASKED(command, line) ((const command##_request *)(line).request)

#endif
