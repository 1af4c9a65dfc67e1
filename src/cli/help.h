/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file help.h  Help and version, made from the verb table and the option table. */
#ifndef CLI_HELP_H
#define CLI_HELP_H

#include "cli/options.h"

/** Version and licence on stdout, in GNU layout. @return EXIT_FINE or EXIT_IO */
int options_version(void);

/** `depthprec help [COMMAND]`. */
int cmd_help(const options *o);

#endif
