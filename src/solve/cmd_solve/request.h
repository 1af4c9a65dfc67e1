/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file request.h  The request that the options of solve fill. */
#ifndef SOLVE_CMD_SOLVE_REQUEST_H
#define SOLVE_CMD_SOLVE_REQUEST_H

#include "cli/output/output.h"

/** Values of --for, and SOLVE_FOR_ANY when it was not given. The planes come first. */
typedef enum solve_target {
    SOLVE_FOR_NEAR = 0,
    SOLVE_FOR_FAR,
    SOLVE_FOR_FORMAT,
    SOLVE_FOR_MAPPING,
    SOLVE_FOR_SEPARATION,
    SOLVE_FOR_DISTANCE,
    SOLVE_FOR_FRUSTA,
    SOLVE_FOR_ANY
} solve_target;

typedef struct solve_request {
    CAMERA_REQUEST;
    solve_target target;
    double separation, error; /**< scene units; 0 when not given */
} solve_request;

extern const option_table solve_options;

#endif
