/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file request.h  The request that the options of table fill. */
#ifndef QUANTITY_CMD_TABLE_REQUEST_H
#define QUANTITY_CMD_TABLE_REQUEST_H

#include "cli/output/output.h"

typedef struct table_request {
    CAMERA_REQUEST;
    depths looked_up;    /**< window depths of --depth in [0, 1], or codes of --code; count is 0 without them */
    const char *lattice; /**< of a sensor whose levels are asked for; null when not given */
    bool constants;      /**< what shaders are given; the view's shape is then in camera.spec */
} table_request;

extern const option_table table_options;

#endif
