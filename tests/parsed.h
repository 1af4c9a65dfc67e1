/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file parsed.h  A command line as the program reads it. */
#ifndef TESTS_PARSED_H
#define TESTS_PARSED_H

#include "cli/option/options.h"

/** options_parse(); `line` becomes the first line that it says on stderr, "" for none. */
int parsed(options *o, int argc, char **argv, char line[1024]);

#endif
