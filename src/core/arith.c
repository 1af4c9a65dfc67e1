/* SPDX-License-Identifier: MIT */
#include "depthprec/arith.h"

#include "core/text.h"

/* clang-format off */
static const dp_arith_row rows[] = {
    {"ieee", 0, DP_RECIPROCAL_NONE, 0, DP_CONVERT_EXACT,
     "each operation rounded, true division, exact UNORM conversion with ties up",
     "IEEE 754-2019; D3D 11.3 functional specification 3.2.3.6"},
    {"fused", 1, DP_RECIPROCAL_NONE, 0, DP_CONVERT_EXACT, "as ieee, A z + B fused", "IEEE 754-2019 fusedMultiplyAdd"},
    {"reciprocal", 0, DP_RECIPROCAL_ROUNDED, 0, DP_CONVERT_EXACT, "as ieee, times the rounded reciprocal of w",
     "common in GPUs"},
    {"fused-reciprocal", 1, DP_RECIPROCAL_ROUNDED, 0, DP_CONVERT_EXACT, "as reciprocal, A z + B fused",
     "common in GPUs"},
    {"product", 0, DP_RECIPROCAL_NONE, 0, DP_CONVERT_PRODUCT_EVEN,
     "as ieee, UNORM from the binary32 product, nearest even", "common in software"},
    {"mesa", 0, DP_RECIPROCAL_ROUNDED, 0, DP_CONVERT_PRODUCT_EVEN, "llvmpipe, lavapipe, SwiftShader",
     "stored codes of Mesa 22.3.6 and SwiftShader (Chromium 156)"},
    {"softpipe", 0, DP_RECIPROCAL_ROUNDED, 0, DP_CONVERT_PRODUCT_ZERO, "softpipe: as mesa, truncated",
     "stored codes of Mesa 22.3.6 softpipe"},
    {"nvidia", 1, DP_RECIPROCAL_UNIT, 0, DP_CONVERT_SIXTEENTHS, "NVIDIA: fused, times its own reciprocal of w",
     "stored codes of an NVIDIA H100, driver 580.159.04, by Vulkan and OpenGL; its reciprocals of all significands"},
    {"ieee-remap", 0, DP_RECIPROCAL_NONE, 1, DP_CONVERT_EXACT, "as ieee, [-1, 1] remapped in the vertex shader",
     "GL programs translated to a zero-to-one API"},
    {"mesa-remap", 0, DP_RECIPROCAL_ROUNDED, 1, DP_CONVERT_PRODUCT_EVEN,
     "as mesa, [-1, 1] remapped in the vertex shader", "stored codes of lavapipe and SwiftShader with the remap"},
};
static const dp_log2_row log2_rows[] = {
    {"vulkan", "spirv glsl webgl wgsl webgpu", 0x1p-21, 3.0, 0.0,
     "3 units in the last place, 2^-21 from 0.5 to 2: Vulkan, GLSL, WGSL",
     "Vulkan 1.3 specification, Precision and Operation of SPIR-V Instructions; GLSL, Range and Precision; WGSL, "
     "accuracy of builtin functions"},
    {"d3d", "hlsl direct3d", 0x1p-21, 0.0, 0x1p-21,
     "2^-21 of the result, absolute from 0.5 to 2: Direct3D",
     "Microsoft Learn, log (sm4 - asm)"},
    {"rounded", "", 0.0, 0.5, 0.0, "rounded once: no log2 in binary32 does better", "IEEE 754-2019 9.2"},
};
/* clang-format on */

enum { ROW_COUNT = sizeof rows / sizeof rows[0] };

size_t dp_arith_count(void) {
    return ROW_COUNT;
}

const dp_arith_row *dp_arith_get(dp_arith index) {
    return index < ROW_COUNT ? &rows[index] : NULL;
}

dp_status dp_arith_parse(const char *name, dp_arith *out) {
    if (name == NULL || out == NULL)
        return DP_ERROR_NULL;
    for (size_t i = 0; i < ROW_COUNT; i++)
        if (dp_word_among(name, rows[i].name)) {
            *out = i;
            return DP_OK;
        }
    return DP_ERROR_ARITH;
}

const dp_log2_row *dp_log2_get(dp_log2_rule index) {
    return index < sizeof log2_rows / sizeof log2_rows[0] ? &log2_rows[index] : NULL;
}
