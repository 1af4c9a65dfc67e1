/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file request.h  The request that the options of prepass fill. */
#ifndef ZFIGHT_CMD_PREPASS_REQUEST_H
#define ZFIGHT_CMD_PREPASS_REQUEST_H

#include "cli/output/output.h"
#include "raster/vertex_compare.h"
#include "zfight/cmd_prepass/stored.h"

/** Vertices, and the vertex programs that place them. */
typedef struct prepass_request {
    CAMERA_REQUEST;
    uint64_t sample, seed;
    double world;                                 /**< no coordinate of a camera exceeds it, scene units */
    const vertex_program *against[VERTEX_OTHERS]; /**< in the order given, each once */
    size_t against_count;
    const vertex_program *program; /**< what they are compared with */
    unsigned vertices;             /**< how they are drawn: a vertex_spread */
    stored_asked stored;           /**< in place of vertices, where there is a case */
} prepass_request;

extern const option_table prepass_options;

#endif
