/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "camera/platform.h"

#include <string.h>
#include <strings.h>

#define DAWN   "2026-08"
#define ANGLE  "2026-08"
#define WEBKIT "2026-08"
#define READ   "2026-11"
#define WGPU   "2024-10, over a year old"

/* clang-format off */
static const platform rows[] = {
    {"chrome-d3d", NULL,
     "WebGPU on Direct3D: D32_FLOAT; with stencil a 32-bit float too, but D24_UNORM_S8 on Qualcomm's D3D12",
     "Dawn, src/dawn/native/d3d/UtilsD3D.cpp",
     "depth24plus", "fp32", "depth24plus-stencil8", PLATFORM_REMAPS_NOT, "webgpu", "d3d11", "spec-d3d",
     BIAS_EXPONENT_N, 0, 0, false, false, "", DAWN},
    {"chrome-vulkan", NULL,
     "WebGPU on Vulkan: D32_SFLOAT; with stencil D24_UNORM_S8 where the device has no D32_SFLOAT_S8",
     "Dawn, src/dawn/native/vulkan/TextureVk.cpp",
     "depth24plus", "fp32", "depth24plus-stencil8", PLATFORM_REMAPS_NOT, "webgpu", "vulkan", "spec-vulkan",
     BIAS_EXPONENT_OPEN, 0, 0, false, false, "", DAWN},
    {"chrome-metal", NULL, "WebGPU on Metal: Depth32Float", "Dawn, src/dawn/native/metal/UtilsMetal.mm",
     "depth24plus", "fp32", "fp32", PLATFORM_REMAPS_NOT, "webgpu", "metal", "spec-vulkan",
     BIAS_EXPONENT_N, 0, 0, false, false, "", DAWN},
    {"chrome-gl", NULL, "WebGPU on OpenGL: DEPTH_COMPONENT32F",
     "Dawn, src/dawn/native/opengl/GLFormat.cpp; Tint's GLSL: 2 z - w",
     "depth24plus", "fp32", "fp32", PLATFORM_SPREADS, "webgpu", "gl", "spec-gl",
     BIAS_EXPONENT_OPEN, 0.5, 0.5, false, false,
     "halves the constant of a bias on desktop GL, where drivers take n+1", DAWN},
    {"firefox-d3d", NULL, "WebGPU on Direct3D: D24_UNORM_S8, with stencil or without",
     "wgpu, wgpu-hal/src/auxil/dxgi/conv.rs",
     "depth24plus", "unorm24", "unorm24", PLATFORM_REMAPS_NOT, "webgpu", "d3d11", "spec-d3d",
     BIAS_EXPONENT_N, 0, 0, false, false, "", WGPU},
    {"firefox-vulkan", NULL, "WebGPU on Vulkan: X8_D24_UNORM where the device has it, else D32_SFLOAT",
     "wgpu, wgpu-hal/src/vulkan/conv.rs",
     "depth24plus", "depth24plus", "depth24plus-stencil8", PLATFORM_REMAPS_NOT, "webgpu", "vulkan", "spec-vulkan",
     BIAS_EXPONENT_OPEN, 0, 0, false, false, "", WGPU},
    {"firefox-metal", NULL, "WebGPU on Metal: Depth24Unorm_Stencil8 where the Mac has it, else Depth32Float",
     "wgpu, wgpu-hal/src/metal/adapter.rs",
     "depth24plus", "depth24plus", "depth24plus-stencil8", PLATFORM_REMAPS_NOT, "webgpu", "metal", "spec-vulkan",
     BIAS_EXPONENT_N, 0, 0, false, false, "", WGPU},
    {"firefox-gl", NULL, "WebGPU on OpenGL: DEPTH_COMPONENT24; with stencil DEPTH24_STENCIL8",
     "wgpu, wgpu-hal/src/gles/conv.rs; naga's GLSL: ADJUST_COORDINATE_SPACE, wgpu issue 4553",
     "depth24plus", "unorm24", "unorm24", PLATFORM_SPREADS, "webgpu", "gl", "spec-gl",
     BIAS_EXPONENT_OPEN, 0, 0, false, true, "drops the clamp of a bias", WGPU},
    {"safari", NULL, "WebGPU on Metal: Depth32Float", "WebKit, Source/WebGPU/WebGPU/Texture.mm",
     "depth24plus", "fp32", "fp32", PLATFORM_REMAPS_NOT, "webgpu", "metal", "spec-vulkan",
     BIAS_EXPONENT_N, 0, 0, false, false, "", WEBKIT},
    {"webgl-d3d", NULL, "WebGL through ANGLE on D3D11: D24_UNORM_S8",
     "ANGLE, src/libANGLE/renderer/d3d/d3d11/texture_format_map.json",
     "DEPTH_COMPONENT24", "unorm24", "unorm24", PLATFORM_REMAPS, "gl", "d3d11", "spec-d3d",
     BIAS_EXPONENT_N, 0, 0, true, false, "cuts fractions of a bias's units: 0.5 becomes 0", ANGLE},
    {"webgl-metal", NULL,
     "WebGL through ANGLE on Metal: 32-bit float; with stencil D24_UNORM_S8 on the Macs that have it; 24 bits are "
     "reported all the same", "ANGLE, src/libANGLE/renderer/metal/mtl_format_map.json",
     "DEPTH_COMPONENT24", "fp32", "depth24plus-stencil8", PLATFORM_REMAPS, "gl", "metal", "spec-vulkan",
     BIAS_EXPONENT_N, 0, 0, false, false, "", ANGLE},
    {"webgl-vulkan", NULL,
     "WebGL through ANGLE on Vulkan: X8_D24, D24_UNORM_S8 or a 32-bit float, as the device has it; remapped only "
     "without VK_EXT_depth_clip_control", "ANGLE, src/libANGLE/renderer/vulkan/vk_format_map.json",
     "DEPTH_COMPONENT24", "depth24plus", "depth24plus-stencil8", PLATFORM_MAY_REMAP, "gl", "vulkan", "spec-vulkan",
     BIAS_EXPONENT_OPEN, 1, 2, false, false,
     "doubles the units of a bias for Intel (not on Windows), PanVK, RADV and NVIDIA", ANGLE},
    {"webgl-gl", NULL, "WebGL through ANGLE on OpenGL: as OpenGL has it", "ANGLE, libANGLE/renderer/gl",
     "DEPTH_COMPONENT24", "unorm24", "unorm24", PLATFORM_REMAPS_NOT, "gl", "gl", "spec-gl",
     BIAS_EXPONENT_OPEN, 0.5, 0.5, false, false, "halves the units of a bias", ANGLE},
    {"vulkan", NULL,
     "a device has X8_D24_UNORM_PACK32 or D32_SFLOAT, with stencil D24_UNORM_S8_UINT or D32_SFLOAT_S8_UINT, or both",
     "Khronos, Vulkan Guide, Depth, Depth Formats",
     "X8_D24_UNORM_PACK32", "depth24plus", "depth24plus-stencil8", PLATFORM_REMAPS_NOT, "vulkan", "vulkan",
     "spec-vulkan",
     BIAS_EXPONENT_OPEN, 0, 0, false, false, "", READ},
    {"d3d11", NULL, "D24_UNORM_S8_UINT is required, and so is D32_FLOAT",
     "Microsoft, Format support for Direct3D Feature Level 11.0 hardware",
     "D24_UNORM_S8_UINT", "unorm24", "unorm24", PLATFORM_REMAPS_NOT, "d3d11", "d3d11", "spec-d3d",
     BIAS_EXPONENT_N, 0, 0, false, false, "", READ},
    {"d3d12", NULL, "D24_UNORM_S8_UINT is required from feature level 12.0 on",
     "Microsoft, Format support for Direct3D Feature Level 12.0 hardware",
     "D24_UNORM_S8_UINT", "unorm24", "unorm24", PLATFORM_REMAPS_NOT, "d3d12", "d3d12", "spec-d3d",
     BIAS_EXPONENT_N, 0, 0, false, false, "", READ},
    {"metal", NULL, "depth24Unorm_stencil8 where isDepth24Stencil8PixelFormatSupported says so, else depth32Float",
     "Apple, Metal, MTLDevice, isDepth24Stencil8PixelFormatSupported",
     "depth24Unorm_stencil8", "depth24plus", "depth24plus-stencil8", PLATFORM_REMAPS_NOT, "metal", "metal",
     "spec-vulkan",
     BIAS_EXPONENT_N, 0, 0, false, false, "", READ},
    {"gl", NULL, "DEPTH_COMPONENT24 and DEPTH24_STENCIL8 are required, of at least 24 bits and never a float",
     "OpenGL 4.6, 8.5.1, Required Texture Formats",
     "DEPTH_COMPONENT24", "unorm24", "unorm24", PLATFORM_REMAPS_NOT, "gl", "gl", "spec-gl",
     BIAS_EXPONENT_OPEN, 0, 0, false, false, "", READ},
};
/* clang-format on */

NAMED_TABLE(platform, rows);

bias_api platform_bias(const platform *p, const bias_api *api) {
    bias_api out = *api;
    if (p == NULL || strcmp(p->api, api->name) != 0)
        return out;
    const bias_api *below = bias_api_find(p->below);
    out.unorm = below->unorm;
    out.real = below->real;
    out.guaranteed = below->guaranteed;
    out.exponent = p->exponent;
    out.scale_least = p->scale_least;
    out.scale_most = p->scale_most;
    out.clamps = api->clamps && !p->drops_clamp;
    out.whole = api->whole || p->cuts;
    return out;
}

const char *platform_stores(const platform *p, const char *given) {
    if (given == NULL || strcmp(p->asks, "depth24plus") != 0)
        return NULL;
    return strcasecmp(given, "depth24plus-stencil8") == 0 ? p->stencil
           : strcasecmp(given, "depth24plus") == 0        ? p->stored
                                                          : NULL;
}
