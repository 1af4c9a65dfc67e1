/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file request.h  The request that the options of texture fill. */
#ifndef TEXTURE_CMD_TEXTURE_REQUEST_H
#define TEXTURE_CMD_TEXTURE_REQUEST_H

#include "cli/output/output.h"
#include "plot/cmd/request.h"
#include "shader/effect.h"
#include "shader/normal.h"
#include "shader/packing.h"
#include "shader/position.h"
#include "texture/cmd_texture/products.h"
#include "texture/moved.h"
#include "texture/stereo.h"
#include "texture/synthetic.h"

enum { IMAGE_PARAMETERS_MAX = 16 };

/** A NAME=VALUE of --parameter; whose it is, and whether there is such a one, is for the command to see. */
typedef struct named_number {
    char name[32];
    double value;
} named_number;

/** A depth image, and what is made of it. Rows and names are null when not given. */
typedef struct texture_asked {
    uint32_t size[2];       /**< --size: columns and rows */
    double eye[3], look[3]; /**< places: of the camera, and what it looks at */
    double last_eye[3], last_look[3];
    const synthetic_row *synthetic;
    named_number parameters[IMAGE_PARAMETERS_MAX];
    size_t parameter_count;
    double sky;             /**< window depth */
    double metric;          /**< scene units of 1 in a sample of metric depth; 0 when not given */
    const moved_row *moved; /**< how its bits were moved on the way into the file; null: they were not */
    stereo_spec stereo;     /**< of disparities, `metric` is then 1; its focal length 0 when not given */
    const char *lattice;    /**< what it was rounded to before; null when not given */
    bool radial;            /**< metric depth is the distance along the ray */
    const char *as;         /**< what eye depth is rounded to; null when not given */
    const char *picture;    /**< file of the colours that an effect is composed on; null when not given */
    double tint[4];         /**< red, green, blue, alpha */
    unsigned hi_z;          /**< a level of the pyramid of the farthest depths, or of */
    bool hi_z_nearest;      /**< ... the nearest */
    dp_format hi_z_format;  /**< what it is rounded to; of no bits where that is the image's own */
    const char *channel;    /**< of FILE, by name; null: that which is depth */
    const packing *packing; /**< of FILE */
    depths pixels;          /**< column and row of each in turn; count is 0 when not given */
    const product_row *product;
    const position_row *position;   /**< of --product position; null for exact as well */
    const normal_row *normal;       /**< of --product normal */
    const effect_row *effect;       /**< of --product effect */
    const packing *pack;            /**< of --product pack */
    const normal_row *normals_by;   /**< of an effect, or of what is packed */
    bool error_map;                 /**< in place of the product */
    const char *error_file;         /**< beside it; or null */
    unsigned normal_format;         /**< of a PNG: 0: y up, 1: y down */
    const char *figure, *histogram; /**< files */
    double overlay;                 /**< errors above it are shown, scene units; 0 when not given */
} texture_asked;

/** The options of the image; its rows name a matrix first, and a picture's size behind --synthetic. */
extern const option_table texture_options;

typedef struct texture_request {
    CAMERA_REQUEST;
    figure_asked figure;
    texture_asked image;
} texture_request;

option_parser parse_product, parse_parameter, parse_error_map, parse_hi_z; /**< see parse.c */

#endif
