/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bias/bias.h"

#include <math.h>

#include "core/elementary.h"

#define UNSCALED 0.0, 0.0

/* clang-format off */
static const bias_api rows[] = {
    {"d3d11", "d3d10 direct3d11",
     "DepthBias is an integer; all is computed in binary32, at the vertices, after clipping",
     "Direct3D 11 programming guide, output merger stage, Depth Bias",
     BIAS_CODE, BIAS_EXPONENT, BIAS_EXPONENT_N, true, true, true, false, "D3D11_RASTERIZER_DESC.DepthBias = U",
     ", SlopeScaledDepthBias = F", UNSCALED, "hlsl", NULL, NULL, true},
    {"d3d12", "direct3d12", "DepthBias is an integer; the rule of d3d11",
     "Direct3D 12, D3D12_RASTERIZER_DESC, which refers to Depth Bias of Direct3D 11",
     BIAS_CODE, BIAS_EXPONENT, BIAS_EXPONENT_N, true, true, true, false, "D3D12_RASTERIZER_DESC.DepthBias = U",
     ", SlopeScaledDepthBias = F", UNSCALED, "hlsl", NULL, NULL, true},
    {"webgpu", "wgpu", "depthBias is an integer; depth24plus may follow either rule (gpuweb/gpuweb#6350)",
     "WebGPU, biased fragment depth; gpuweb/cts depth_bias.spec.ts",
     BIAS_CODE, BIAS_EXPONENT, BIAS_EXPONENT_N, true, true, false, false, "depthBias: U", ", depthBiasSlopeScale: F",
     UNSCALED, "wgsl", NULL, NULL, true},
    {"metal", "mtl",
     "depthBias is a float; for integer buffers r is the smallest positive value that the buffer holds",
     "Metal, MTLRenderCommandEncoder, setDepthBias(_:slopeScale:clamp:)",
     BIAS_CODE, BIAS_EXPONENT, BIAS_EXPONENT_N, false, true, false, false,
     "setDepthBias(U, slopeScale: F, clamp: 0)", "", UNSCALED, "msl", NULL, NULL, false},
    {"vulkan", "vk", "for integer buffers r is the implementation's choice, at most 2 x 2^-N",
     "Vulkan specification, Depth Bias Computation",
     BIAS_BOUND, BIAS_EXPONENT, BIAS_EXPONENT_OPEN, false, true, false, true, "depthBiasConstantFactor = U",
     ", depthBiasSlopeFactor = F", UNSCALED, "glsl", NULL, NULL, false},
    {"vulkan-exact", "vk-exact",
     "VK_EXT_depth_bias_control with depthBiasExact: r = 2^-N, less than the distance of two codes",
     "Vulkan specification, Depth Bias Computation; VK_EXT_depth_bias_control",
     BIAS_POWER, BIAS_EXPONENT, BIAS_EXPONENT_OPEN, false, true, false, false, "depthBiasConstantFactor = U",
     ", depthBiasSlopeFactor = F", UNSCALED, "glsl", NULL, NULL, false},
    {"vulkan-unorm", "vk-unorm",
     "representation LEAST_REPRESENTABLE_VALUE_FORCE_UNORM with depthBiasExact: one r for all depths of a float buffer",
     "Vulkan specification, Depth Bias Computation; VK_EXT_depth_bias_control",
     BIAS_POWER, BIAS_MANTISSA, BIAS_EXPONENT_OPEN, false, true, false, false, "depthBiasConstantFactor = U",
     ", depthBiasSlopeFactor = F", UNSCALED, "glsl", NULL, NULL, false},
    {"vulkan-float", "vk-float", "representation FLOAT: r = 1, units are window depth, as in d3d9",
     "Vulkan specification, Depth Bias Computation; VK_EXT_depth_bias_control",
     BIAS_ONE, BIAS_ONE, BIAS_EXPONENT_OPEN, false, true, false, false, "depthBiasConstantFactor = U",
     ", depthBiasSlopeFactor = F", UNSCALED, "glsl", NULL, NULL, false},
    {"gl", "opengl gles webgl",
     "glPolygonOffset(factor, units); the clamp is EXT_polygon_offset_clamp or GL 4.6; for integer buffers r is the "
     "implementation's choice, 2^-N is assumed", "OpenGL specification, Depth Offset; EXT_polygon_offset_clamp",
     BIAS_FREE, BIAS_EXPONENT, BIAS_EXPONENT_OPEN, false, true, false, true, "glPolygonOffset(F, U)", "",
     UNSCALED, "glsl", "gl", "unorm24", false},
    {"three", "threejs three.js polygonOffset",
     "of a material with polygonOffset = true, handed to gl.polygonOffset(): see gl; WebGL has no clamp",
     "three.js, src/renderers/webgl/WebGLState.js (setPolygonOffset)",
     BIAS_FREE, BIAS_EXPONENT, BIAS_EXPONENT_OPEN, false, false, false, true,
     "polygonOffsetFactor = F, polygonOffsetUnits = U", "", UNSCALED, "glsl", "gl", "unorm24", false},
    {"d3d9", "direct3d9 d3d8to9", "D3DRS_DEPTHBIAS is a window depth; there is no clamp",
     "Direct3D 9, Depth Bias: Offset = m D3DRS_SLOPESCALEDEPTHBIAS + D3DRS_DEPTHBIAS",
     BIAS_ONE, BIAS_ONE, BIAS_EXPONENT_OPEN, false, false, false, false, "D3DRS_DEPTHBIAS = U",
     ", D3DRS_SLOPESCALEDEPTHBIAS = F", UNSCALED, "hlsl", NULL, "unorm24", false},
};
/* clang-format on */
enum { ROW_COUNT = sizeof rows / sizeof rows[0] };

NAMED_TABLE(bias_api, rows);

bias_api bias_next(const bias_api *api) {
    bias_api next = *api;
    next.exponent = BIAS_EXPONENT_NEXT;
    return next;
}

/* ---- What the APIs add ------------------------------------------------------------------------------------------- */

static double to_binary32(double value) {
    return (double)(float)value;
}

double bias_offset(const bias_state *state, double r, double m) {
    double o = state->units * r + state->factor * m;
    if (state->api->binary32) /* two binary32 factors: the products are exact in double, so each is rounded once */
        o = to_binary32(to_binary32(state->units) * r);
    if (state->api->binary32)
        o = to_binary32(o + to_binary32(to_binary32(state->factor) * to_binary32(m)));
    if (state->clamp > 0.0)
        return fmin(o, state->clamp);
    return state->clamp < 0.0 ? fmax(o, state->clamp) : o;
}

/* ---- Between window depth and scene ------------------------------------------------------------------------------ */

int bias_sign(const dp_setup *setup) {
    return setup->reversed ? 1 : -1;
}

double bias_window_slope(const dp_setup *setup, double z, double slope) {
    const double c = setup->log_c;
    if (isinf(z) || slope == 0.0)
        return 0.0;
    return setup->curve == DP_CURVE_PERSPECTIVE ? slope / (setup->kappa * z * z)
           : setup->curve == DP_CURVE_LINEAR    ? slope / setup->kappa
                                                : slope * c / ((c * (z - setup->anchor) + 1.0) * setup->kappa);
}

/* How far z moves when its window depth moves by t towards far; the result lies between the planes. */
static double shift_of(const dp_setup *setup, double z, double t) {
    const double c = setup->log_c;
    /* perspective: 1/z' = 1/z - t kappa */
    return setup->curve == DP_CURVE_PERSPECTIVE ? t * setup->kappa * z * (z / (1.0 - t * setup->kappa * z))
           : setup->curve == DP_CURVE_LINEAR    ? t * setup->kappa
                                                : (c * (z - setup->anchor) + 1.0) / c * dp_expm1(t * setup->kappa);
}

bias_effect bias_at(const dp_setup *setup, const bias_state *state, double slope, double z) {
    const dp_format *format = &setup->spec.format;
    const double d = dp_window(setup, z);
    bias_effect effect = {.z = z, .r = bias_unit_at(state->api, format, d), .code = dp_code(setup, z)};
    effect.m = bias_window_slope(setup, z, slope);
    effect.offset = bias_offset(state, effect.r.least, effect.m);
    effect.depth = d + effect.offset;
    if (effect.offset == 0.0) {
        effect.moved = effect.code;
        effect.to = z;
        return effect;
    }
    const double low = setup->low, high = low + setup->span;
    effect.limited = effect.depth < low || effect.depth > high;
    effect.depth = fmin(fmax(effect.depth, low), high);
    effect.moved = dp_format_encode(format, setup->spec.rounding, effect.depth);
    if (effect.limited) {
        effect.to = (effect.depth == high) != (setup->reversed != 0) ? setup->spec.zfar : setup->spec.znear;
        effect.shift = effect.to - z;
        return effect;
    }
    effect.shift = shift_of(setup, z, -effect.offset * bias_sign(setup));
    effect.to = z + effect.shift;
    return effect;
}
