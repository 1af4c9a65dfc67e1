/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file request.h  The request that the options of convert fill. */
#ifndef CONVERT_CMD_CONVERT_REQUEST_H
#define CONVERT_CMD_CONVERT_REQUEST_H

#include "camera/cmd/depths.h"
#include "cli/output/output.h"
#include "convert/convert.h"

typedef struct convert_request {
    asked_line *line;
    output_asked out;
    depths codes; /**< whose way is printed; count is 0 without them */
    convert_rule read, write;
    bool saturate, flush;
} convert_request;

extern const option_table convert_options;

#endif
