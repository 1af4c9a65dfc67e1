/* SPDX-License-Identifier: MIT */
/**
 * @file mapping.h  Mappings: how an eye depth becomes a window depth.
 *
 * Eye depth z is measured along the view axis in scene units, positive unless the camera is orthographic; near and far
 * are n and f; d is the window depth in [0, 1] and q = 1 - d its complement. With phi = n/f, which is 0 when f is
 * infinite:
 *
 *     d3d, gl                 d = (1 - n/z) / (1 - phi)       orthographic  (z - n) / (f - n)
 *     reversed, gl-reversed   d = (n/z - phi) / (1 - phi)     orthographic  (f - z) / (f - n)
 *     linear                  d = z / f
 *     log                     d = log(C z + 1) / log(C f + 1); three-webgl and osgearth are this with C = 1
 *     three-webgpu            d = log(z/n) / log(f/n)
 *     cesium                  d = log(C (z - n) + 1) / log(C (f - n) + 1) with C = 1
 *
 * C is 1 per unit of the program: 0.001 for depths in metres of a program that counts in kilometres.
 *
 * gl and d3d are the same real number and differ only in what is rounded before the buffer.
 */
#ifndef DEPTHPREC_MAPPING_H
#define DEPTHPREC_MAPPING_H

#include <stddef.h>

#include "depthprec/status.h"

DP_BEGIN

typedef enum dp_mapping {
    DP_MAPPING_D3D = 0,
    DP_MAPPING_GL,
    DP_MAPPING_REVERSED,
    DP_MAPPING_GL_REVERSED,
    DP_MAPPING_LINEAR,
    DP_MAPPING_LOG,
    DP_MAPPING_THREE_WEBGL,
    DP_MAPPING_THREE_WEBGPU,
    DP_MAPPING_CESIUM,
    DP_MAPPING_OSGEARTH,
    DP_MAPPING_COUNT
} dp_mapping;

/** The curve that a mapping follows under a perspective projection. */
typedef enum dp_curve { DP_CURVE_PERSPECTIVE = 0, DP_CURVE_LINEAR, DP_CURVE_LOG } dp_curve;

/** Who gives a fragment its depth. */
typedef enum dp_writer {
    DP_WRITTEN_BY_MATRIX = 0, /**< the pipeline interpolates what a projection matrix made of vertices */
    DP_WRITTEN_BY_FRAGMENT,   /**< a fragment shader */
    DP_WRITTEN_BY_VERTEX,     /**< a vertex shader, and the pipeline interpolates it, as vertices.h has it */
    DP_WRITTEN_BY_EITHER      /**< one of the two shaders: the program chooses */
} dp_writer;

/** A mapping and its properties. The index of its row is its dp_mapping. */
typedef struct dp_mapping_row {
    const char *name;
    const char *aliases; /**< other accepted spellings, separated by one space */
    dp_curve curve;
    int reversed;       /**< near is stored as 1, far as 0 */
    int ndc_signed;     /**< NDC depth runs over [-1, 1] and is mapped to [0, 1] afterwards */
    int far_infinite;   /**< far may be infinite */
    int ortho;          /**< has an orthographic form */
    int log_from_near;  /**< LOG: near is stored as 0 */
    int log_over_near;  /**< LOG: the logarithm is that of z/n, and has no C */
    dp_writer written;  /**< in a perspective; an orthographic depth is the matrix's */
    int rank;           /**< how much it asks of a renderer: 0 nothing */
    const char *effort; /**< what that is; "" when nothing */
    const char *note;
    const char *source;
} dp_mapping_row;

/** The names of all rows, and of those with a projection matrix (PERSPECTIVE), as messages list them. */
#define DP_MAPPING_NAMES             DP_MAPPING_NAMES_PERSPECTIVE ", linear, " DP_MAPPING_NAMES_LOG
#define DP_MAPPING_NAMES_LOG         "log, three-webgl, three-webgpu, cesium, osgearth"
#define DP_MAPPING_NAMES_PERSPECTIVE "d3d, gl, reversed, gl-reversed"

/** The row of a mapping; null when out of range. */
DP_API const dp_mapping_row *dp_mapping_get(dp_mapping mapping);

/**
 * Finds a mapping by its name or one of its aliases; letter case is ignored.
 * @return DP_OK; DP_ERROR_MAPPING or DP_ERROR_NULL, and *out is left as it was
 */
DP_API dp_status dp_mapping_parse(const char *name, dp_mapping *out);

DP_END
#endif
