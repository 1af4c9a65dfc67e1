/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file request.h  What methods is asked. */
#ifndef CLI_METHODS_REQUEST_H
#define CLI_METHODS_REQUEST_H

#include "cli/camera/camera.h"
#include "cli/judge/request.h"
#include "cli/output/output.h"

/** As judge does, it takes functions of somebody's. */
typedef judge_request methods_request;

#endif
