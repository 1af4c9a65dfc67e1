/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file request.h  A depth bias, and what bias is asked. */
#ifndef BIAS_CMD_BIAS_REQUEST_H
#define BIAS_CMD_BIAS_REQUEST_H

#include "bias/bias.h"
#include "bias/remedy.h"
#include "cli/output/output.h"

typedef struct bias_asked {
    const bias_api *api; /**< --api; null for several: those of `apis` */
    unsigned apis;       /**< 1 << index of bias_api_get(), or-ed */
    double units, factor;
    double clamp;      /**< window depth; 0 is none */
    double slope;      /**< scene units per pixel, not negative */
    double separation; /**< scene units; 0 when not given */
} bias_asked;

extern const option_table bias_options;

/** Preset and platform, which bring an API, too. */
extern const option_use bias_brought[];

typedef struct bias_request {
    CAMERA_REQUEST;
    bias_asked bias;
    bool checked;         /**< --check */
    const remedy *remedy; /**< in place of a bias; null: none */
    double amount;        /**< its number */
    bool drawn;           /**< --rasterize */
    const char *render;   /**< file of a picture; null when not given */
} bias_request;

/** The API of that index among those that are asked for; null behind the last. */
const bias_api *bias_asked_api(const bias_asked *b, size_t index);

/** An API brings its mapping and, where a window is asked for, its format, if neither these nor a preset or platform is
 * given; several APIs bring what they share. To be called before camera_complete(). */
void bias_bring(asked_line *line, const bias_asked *b, camera_asked *camera, bool window);

/** The rule of the preset or platform, where --api was not given. @return as a parser does */
int bias_complete(asked_line *line, const camera_asked *camera);

#endif
