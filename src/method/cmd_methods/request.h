/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file request.h  The request that the options of methods fill. */
#ifndef METHOD_CMD_METHODS_REQUEST_H
#define METHOD_CMD_METHODS_REQUEST_H

#include "judge/cmd_judge/request.h"

/** As judge does, it takes functions of somebody's. */
typedef judge_request methods_request;

#endif
