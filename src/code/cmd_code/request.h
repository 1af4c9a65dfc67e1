/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file request.h  The request that the options of code fill. */
#ifndef CODE_CMD_CODE_REQUEST_H
#define CODE_CMD_CODE_REQUEST_H

#include "cli/output/output.h"
#include "code/language.h"

typedef struct code_request {
    CAMERA_REQUEST;
    const code_language *language;
    unsigned what; /**< linearize, projection: in the order of the names */
    bool uniforms;
} code_request;

extern const option_table code_options;

#endif
