/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file request.h  The request that the options of budget fill. */
#ifndef QUANTITY_CMD_BUDGET_REQUEST_H
#define QUANTITY_CMD_BUDGET_REQUEST_H

#include "camera/cmd/camera.h"
#include "cli/output/output.h"
#include "world/cmd/origin.h"

typedef struct budget_request {
    asked_line *line;
    camera_asked camera;
    output_asked out;
    origin_asked origin;
} budget_request;

#endif
