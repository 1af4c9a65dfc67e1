/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file request.h  The request that the options of budget fill. */
#ifndef QUANTITY_CMD_BUDGET_REQUEST_H
#define QUANTITY_CMD_BUDGET_REQUEST_H

#include "cli/output/output.h"
#include "world/cmd/origin.h"

typedef struct budget_request {
    CAMERA_REQUEST;
    origin_asked origin;
} budget_request;

#endif
