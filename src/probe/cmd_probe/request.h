/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file request.h  The request that the options of probe fill. */
#ifndef PROBE_CMD_PROBE_REQUEST_H
#define PROBE_CMD_PROBE_REQUEST_H

#include "cli/output/output.h"

typedef struct probe_request {
    asked_line *line;
    output_asked out;
    const char *device; /**< null when not given */
    const char *keep;   /**< file of raw codes; null when not given */
    uint64_t seed;
} probe_request;

extern const option_table probe_options;

#endif
