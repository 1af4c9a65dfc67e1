/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file request.h  The request that the options of world fill. */
#ifndef WORLD_CMD_WORLD_REQUEST_H
#define WORLD_CMD_WORLD_REQUEST_H

#include "cli/output/output.h"
#include "world/cmd/origin.h"

typedef struct world_request {
    CAMERA_REQUEST;
    origin_asked origin;
    depths distances;  /**< of the camera from the world's origin; count is 0 when not given */
    double separation; /**< scene units; 0 when not given */
} world_request;

extern const option_table world_options;

#endif
