/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file request.h  What budget is asked. */
#ifndef CLI_BUDGET_REQUEST_H
#define CLI_BUDGET_REQUEST_H

#include "cli/camera/camera.h"
#include "cli/output/output.h"
#include "cli/world/origin.h"

typedef struct budget_request {
    asked_line *line;
    camera_asked camera;
    output_asked out;
    origin_asked origin;
} budget_request;

#endif
