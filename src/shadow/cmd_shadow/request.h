/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file request.h  The request about shadow maps, of shadow and of their figure. */
#ifndef SHADOW_CMD_SHADOW_REQUEST_H
#define SHADOW_CMD_SHADOW_REQUEST_H

#include "bias/cmd_bias/request.h"
#include "cli/output/output.h"

typedef struct shadow_asked {
    uint32_t size[2]; /**< texels */
    unsigned cascades;
    double lambda;                      /**< of their split: 0 even, 1 logarithmic */
    double light_box[3];                /**< width, height, depth, scene units; 0 when not given */
    double spot;                        /**< the angle across a spot light's map, degrees; 0 when not given */
    bool point;                         /**< six faces of a cube */
    bool distance;                      /**< the maps of a spot or point light hold distances */
    unsigned engines;                   /**< 1 << index of shadow_engine_get(), or-ed */
    const struct shadow_engine *engine; /**< the first that was named, whose numbers are given; null: none */
    double bias, normal_bias;           /**< NaN when not given */
    bool checked;                       /**< whether an engine's bias is enough decides the exit status */
    bool drawn;                         /**< --rasterize */
    const char *render;                 /**< file of a picture; null when not given */
    double casters;                     /**< scene units */
    unsigned kernel;                    /**< the filter reads so many texels in either direction */
    unsigned filter;                    /**< the same of --filter; 0 when not given */
    double angle;                       /**< of a receiver's normal to the light, degrees */
    double world;                       /**< no coordinate of a position exceeds it, scene units */
    double curvature;                   /**< radius of curvature of receivers, scene units; NaN when not given */
    double facet;                       /**< of the circles about their triangles, scene units */
    dp_spec camera; /**< of the depth texture that receivers are rebuilt from: format, mapping, far */
} shadow_asked;

/** Which part is asked for. */
size_t shadow_part_asked(const asked_line *line);

/** The options of the maps; help shows their size where it shows that of images. */
extern const option_table shadow_options, shadow_size_options;

/** The options that a figure of shadow maps takes. */
extern const option_use shadow_map_uses[], shadow_cascade_uses[];
#define SHADOW_FROM_ORIGIN     "no coordinate of a position exceeds R"
#define SHADOW_FROM_ORIGIN_OUT "positions are relative to the centre of the light's box, or to the light"

/** The parts of the command: cascades of a view, a box, a light that has a place. */
enum { SHADOW_CASCADED = 0, SHADOW_BOXED, SHADOW_PLACED };

typedef struct shadow_request {
    CAMERA_REQUEST;
    shadow_asked shadow;
    bias_asked bias;
} shadow_request;

#endif
