/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file stop.h  Long work that Ctrl-C ends: nothing is written then, and the shell sees what ended us.
 *
 *     stop_watch();
 *     while (... && !stop_asked()) ...
 *     stop_end(&out);        // does not return where it was asked
 */
#ifndef CLI_STOP_H
#define CLI_STOP_H

#include <stdbool.h>

#include "report/output.h"

/** From here on SIGINT is only noted, unless it is ignored. */
void stop_watch(void);

bool stop_asked(void);

/** Where it was asked: abandons the output, says so on stderr, and ends as by SIGINT. */
void stop_end(output *out);

#endif
