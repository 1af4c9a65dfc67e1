/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file request.h  The request of help, which completions are asked by, too. */
#ifndef CLI_CMD_HELP_REQUEST_H
#define CLI_CMD_HELP_REQUEST_H

#include "cli/option/option.h"

typedef struct help_request {
    asked_line *line;
} help_request;

#endif
