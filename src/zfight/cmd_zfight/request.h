/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file request.h  The request that the options of zfight fill. */
#ifndef ZFIGHT_CMD_ZFIGHT_REQUEST_H
#define ZFIGHT_CMD_ZFIGHT_REQUEST_H

#include "cli/output/output.h"

typedef struct zfight_request {
    CAMERA_REQUEST;
    uint64_t sample; /**< pairs to draw; 0 when not given */
    uint64_t seed;
    bool drawn;        /**< --rasterize: the surfaces are drawn */
    double separation; /**< scene units; 0 when not given */
} zfight_request;

extern const option_table zfight_options;

#endif
