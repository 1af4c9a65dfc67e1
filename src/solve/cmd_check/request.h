/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file request.h  The request that the options of check fill. */
#ifndef SOLVE_CMD_CHECK_REQUEST_H
#define SOLVE_CMD_CHECK_REQUEST_H

#include "cli/output/output.h"

typedef struct checks_request {
    asked_line *line;
    output_asked out;
} checks_request;

#endif
