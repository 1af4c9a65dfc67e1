/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file link.h  --link: the link that opens a command in the page depthprec.html. */
#ifndef CLI_LINK_H
#define CLI_LINK_H

#include "cli/option/option.h"

/** Prints the link of a command that has been read. @return an exit status, after one line on stderr if not fine */
int link_write(const asked_line *line);

#endif
