/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file request.h  The request that the options of list fill. */
#ifndef CLI_CMD_LIST_REQUEST_H
#define CLI_CMD_LIST_REQUEST_H

#include "cli/output/output.h"

typedef struct list_request {
    asked_line *line;
    output_asked out;
    double tolerance; /**< a share */
} list_request;

#endif
