/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bias/limits.h"

#include <math.h>

bool bias_is_missed(const dp_setup *setup) {
    const dp_writer written = dp_mapping_get(setup->spec.mapping)->written;
    return !setup->spec.ortho && (written == DP_WRITTEN_BY_FRAGMENT || written == DP_WRITTEN_BY_EITHER);
}

static bool is_written(const bias_use *use) {
    return bias_is_missed(use->setup);
}

/* Whether r is not the same all over the range. */
static bool has_exponents(const bias_use *use) {
    const dp_format *format = &use->setup->spec.format;
    const bias_unit lo = bias_unit_at(use->state->api, format, dp_window(use->setup, use->lo));
    const bias_unit hi = bias_unit_at(use->state->api, format, dp_window(use->setup, use->hi));
    return lo.least != hi.least;
}

static bool is_clamped(const bias_use *use) {
    return use->slanted && use->state->clamp != 0.0;
}

static bool is_cast(const bias_use *use) {
    return use->infinite && use->state->api->whole;
}

/* clang-format off */
static const bias_limit rows[] = {
    {"written", NULL,
     "what a fragment shader writes replaces the biased depth, as logarithmic depth in three.js and CesiumJS: the "
     "shader must add units times r itself", "OpenGL, Depth Offset; Vulkan, Depth Bias",
     "no API biases a depth that a fragment shader writes: add units times r there", is_written},
    {"exponents", NULL,
     "in a float buffer r doubles with each binade of the polygon's greatest depth, so the same units move a layer by "
     "up to twice as much just beyond one", "Direct3D 11, Depth Bias",
     "r doubles with each binade of the depth: the same units move a layer by other distances", has_exponents},
    {"clamps", NULL,
     "a clamp holds the sum with the slope's part: with one no bias is certain at any slant; WebGPU's compatibility "
     "mode wants it to be 0, WebGL and Direct3D 9 have none", "EXT_polygon_offset_clamp; gpuweb/gpuweb#5241",
     "the clamp holds the sum with the slope's part: with one no bias is certain at any slant", is_clamped},
    {"infinity", NULL,
     "DepthBias of Direct3D and depthBias of WebGPU are integers of 32 bits, which have no infinity: a cast that "
     "saturates makes 2147483647 or -2147483648 of it, in C it is undefined", "ISO C11, 6.3.1.4",
     "an integer of 32 bits has no infinity: in C the cast is undefined, and x86 makes -2147483648 of either sign",
     is_cast},
    {"lines", "points",
     "a bias moves triangles alone: Direct3D and Metal leave lines and points as they are, Vulkan may move them, "
     "WebGPU wants both numbers to be 0 for them, and OpenGL moves triangles drawn as lines with "
     "GL_POLYGON_OFFSET_LINE; push the triangles below away instead, by the same call with the other sign",
     "Direct3D 11, Depth Bias; Vulkan, Depth Bias; gpuweb/gpuweb#4729; OpenGL, Depth Offset",
     "triangles alone are moved, no lines and points: push away what lies below them, with the other sign", NULL},
    {"samples", "msaa centroid",
     "with several samples a pixel each stores the depth of its own place, where the verdict holds; a resolved depth, "
     "or one that a shader takes at the centroid, is that of a place up to a pixel off: ask with --slope",
     "Direct3D 11, Rasterization Rules",
     "a resolved depth, or one at the centroid, is that of a place up to a pixel off: ask with --slope", NULL},
};
/* clang-format on */

NAMED_TABLE(bias_limit, rows);
