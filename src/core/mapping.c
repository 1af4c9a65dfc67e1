/* SPDX-License-Identifier: MIT */
#include "depthprec/mapping.h"

#include "core/text.h"

/* clang-format off */
static const dp_mapping_row rows[DP_MAPPING_COUNT] = {
    [DP_MAPPING_D3D] = {
        .name = "d3d",
        .aliases = "zo vulkan vk metal webgpu standard directx direct3d d3d11 d3d12 rh_zo lh_zo GL_ZERO_TO_ONE",
        .curve = DP_CURVE_PERSPECTIVE, .far_infinite = 1, .ortho = 1,
        .effort = "",
        .note = "clip depth in [0, 1], near stored as 0: D3D, Vulkan, Metal, WebGPU",
        .source = "D3D 11.3 functional specification 15.6; Vulkan 1.3 specification 27.4",
    },
    [DP_MAPPING_GL] = {
        .name = "gl", .aliases = "no opengl gles webgl rh_no lh_no GL_NEGATIVE_ONE_TO_ONE",
        .curve = DP_CURVE_PERSPECTIVE, .ndc_signed = 1, .far_infinite = 1, .ortho = 1,
        .effort = "",
        .note = "NDC depth in [-1, 1], then remapped to [0, 1], near stored as 0: OpenGL, WebGL",
        .source = "OpenGL 4.6 core specification 13.8",
    },
    [DP_MAPPING_REVERSED] = {
        .name = "reversed",
        .aliases = "rev reverse reversed-z reverse-z reversedz inverted reversed_zo reversed-d3d d3d-reversed "
                   "reversedDepthBuffer reverseDepthBuffer",
        .curve = DP_CURVE_PERSPECTIVE, .reversed = 1, .far_infinite = 1, .ortho = 1,
        .rank = 1, .effort = "clear to 0, compare greater; OpenGL: glClipControl",
        .note = "clip depth in [0, 1], near stored as 1",
        .source = "Lapidous and Jiao, Optimal depth buffer for low-cost graphics hardware, 1999; Reed 2015",
    },
    [DP_MAPPING_GL_REVERSED] = {
        .name = "gl-reversed", .aliases = "reversed-gl glrev gl_reversed reversed_no",
        .curve = DP_CURVE_PERSPECTIVE, .reversed = 1, .ndc_signed = 1, .far_infinite = 1, .ortho = 1,
        .rank = 1, .effort = "clear to 0, compare greater; NDC rounding spoils it",
        .note = "NDC depth in [-1, 1] with near at +1: the rounding of NDC spoils what reversing gains",
        .source = "ARB_clip_control, issue 5",
    },
    [DP_MAPPING_LINEAR] = {
        .name = "linear", .aliases = "w w-buffer wbuffer linear01",
        .curve = DP_CURVE_LINEAR, .written = DP_WRITTEN_BY_EITHER,
        .rank = 4, .effort = "the fragment shader writes depth, so no early z",
        .note = "W-buffer, Unity's linear 0-1 depth: eye depth over far; near is not stored as 0",
        .source = "Blinn, W pleasure, W fun, IEEE CG&A 18(3), 1998",
    },
    [DP_MAPPING_LOG] = {
        .name = "log", .aliases = "logarithmic logdepth",
        .curve = DP_CURVE_LOG, .written = DP_WRITTEN_BY_EITHER,
        .rank = 4, .effort = "the fragment shader writes depth, so no early z",
        .note = "logarithmic depth, log(C z + 1)/log(C f + 1)",
        .source = "Kemen, Logarithmic depth buffer, 2009 (Outerra)",
    },
    [DP_MAPPING_THREE_WEBGL] = {
        .name = "three-webgl", .aliases = "three threejs three.js logarithmicDepthBuffer",
        .curve = DP_CURVE_LOG, .written = DP_WRITTEN_BY_FRAGMENT,
        .rank = 4, .effort = "the fragment shader writes depth, so no early z",
        .note = "three.js, WebGLRenderer: log2(1 + w)/log2(far + 1), near ignored",
        .source = "three.js, logdepthbuf_fragment.glsl.js and WebGLRenderer's logDepthBufFC",
    },
    [DP_MAPPING_THREE_WEBGPU] = {
        .name = "three-webgpu", .aliases = "ulrich",
        .curve = DP_CURVE_LOG, .log_from_near = 1, .log_over_near = 1, .written = DP_WRITTEN_BY_FRAGMENT,
        .rank = 4, .effort = "the fragment shader writes depth, so no early z",
        .note = "three.js, WebGPURenderer: log2(w/near)/log2(far/near), near at least 1e-6",
        .source = "three.js, ViewportDepthNode.js, viewZToLogarithmicDepth; Ulrich",
    },
    [DP_MAPPING_CESIUM] = {
        .name = "cesium", .aliases = "cesiumjs",
        .curve = DP_CURVE_LOG, .log_from_near = 1, .written = DP_WRITTEN_BY_FRAGMENT,
        .rank = 4, .effort = "the fragment shader writes depth, so no early z",
        .note = "log2(1 + w - near)/log2(far - near + 1), per fragment",
        .source = "CesiumJS, vertexLogDepth.glsl and writeLogDepth.glsl",
    },
    [DP_MAPPING_OSGEARTH] = {
        .name = "osgearth", .aliases = "osgearth-vertex",
        .curve = DP_CURVE_LOG, .ndc_signed = 1, .written = DP_WRITTEN_BY_VERTEX,
        .rank = 4, .effort = "the vertex shader writes depth: triangles must be small",
        .note = "osgEarth without fragment depth: log2(1 + w)/log2(far + 1), interpolated",
        .source = "osgEarth, LogDepthBuffer.VertOnly.vert.glsl",
    },
};
/* clang-format on */

const dp_mapping_row *dp_mapping_get(dp_mapping mapping) {
    return (unsigned)mapping < DP_MAPPING_COUNT ? &rows[mapping] : NULL;
}

dp_status dp_mapping_parse(const char *name, dp_mapping *out) {
    if (name == NULL || out == NULL)
        return DP_ERROR_NULL;
    for (unsigned i = 0; i < DP_MAPPING_COUNT; i++)
        if (dp_word_among(name, rows[i].name) || dp_word_among(name, rows[i].aliases)) {
            *out = (dp_mapping)i;
            return DP_OK;
        }
    return DP_ERROR_MAPPING;
}
