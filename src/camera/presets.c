/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "camera/presets.h"

#include <math.h>
#include <stdbool.h>

#define CHECKED "2026-11-21"
#define LATER   "2026-11-28"

/* clang-format off */
static const preset rows[] = {
    {"unity", "unity3d unity-urp unity-hdrp unity-builtin urp hdrp",
     "Direct3D, Metal, Vulkan and consoles; 16-bit and D24 on devices without D32",
     "Unity manual, SL-PlatformDifferences (direction) and URP 14 UniversalRenderer (D32_SFloat_S8_UInt); near, far "
     "and fov as scene files write them",
     0.3, 1000.0, DP_MAPPING_REVERSED, "fp32", "m", 60, PRESET_VERTICAL,
     "spec-vulkan", "d3d11", "hlsl", "near, far, fov", CHECKED},
    {"unity-gl", "unity-webgl unity-gles", "OpenGL and OpenGL ES: not reversed, NDC depth in [-1, 1]",
     "Unity manual, SL-PlatformDifferences: \"other platforms: traditional direction\"",
     0.3, 1000.0, DP_MAPPING_GL, "unorm24", "m", 60, PRESET_VERTICAL, "spec-gl", "gl", "hlsl", "near, far, format, fov",
     CHECKED},
    {"unreal", "unreal-engine ue ue4 ue5",
     "scene units are centimetres: near is 10 cm; NearClipPlane in DefaultEngine.ini replaces it",
     "GNearClippingPlane in CoreGlobals.cpp, as others quote it: the engine's source is not public",
     10.0, (double)INFINITY, DP_MAPPING_REVERSED, "fp32", "cm", 90, PRESET_HORIZONTAL, "spec-vulkan", "d3d11", "hlsl",
     "near, far, mapping, format, fov", CHECKED},
    {"godot-forward", "godot godot4 godot-forward+ godot-forward-plus",
     "Forward+ since 4.3: prefers D32_SFLOAT_S8_UINT",
     "Camera3D class reference; RenderSceneBuffersRD::get_depth_format; godotengine.org/article/introducing-reverse-z",
     0.05, 4000.0, DP_MAPPING_REVERSED, "fp32", "m", 75, PRESET_VERTICAL, "spec-vulkan", "vulkan", "glsl", "", CHECKED},
    {"godot-mobile", NULL,
     "the mobile renderer prefers D24_UNORM_S8_UINT, where reversing gains nothing in the lattice",
     "Camera3D class reference; RenderSceneBuffersRD::get_depth_format with p_storage false",
     0.05, 4000.0, DP_MAPPING_REVERSED, "unorm24", "m", 75, PRESET_VERTICAL,
     "spec-vulkan", "vulkan", "glsl", "", CHECKED},
    {"godot-compatibility", "godot-gl godot-gles3 godot-web",
     "the Compatibility renderer, OpenGL: reversed, but NDC depth stays in [-1, 1], where that gains nothing",
     "Camera3D class reference; rasterizer_scene_gles3.cpp (set_depth_correction without remap, GL_GEQUAL)",
     0.05, 4000.0, DP_MAPPING_GL_REVERSED, "unorm24", "m", 75, PRESET_VERTICAL,
     "spec-gl", "gl", "glsl", "format", LATER},
    {"three", "threejs three.js three-webgl",
     "WebGLRenderer; logarithmicDepthBuffer and reversedDepthBuffer are options, and names for --mapping; browsers "
     "give the canvas 24 bits",
     "three.js, src/cameras/PerspectiveCamera.js; mrdoob/three.js#30941 (the canvas default is integer)",
     0.1, 2000.0, DP_MAPPING_GL, "unorm24", "units", 50, PRESET_VERTICAL,
     "spec-gl", "three", "glsl", "format", CHECKED},
    {"three-webgpu", "three.webgpu threejs-webgpu",
     "WebGPURenderer; depth24plus is unorm24 or fp32 as the browser chooses; reversedDepthBuffer is an option and "
     "takes depth32float", "three.js, src/cameras/PerspectiveCamera.js; mrdoob/three.js#32967, #33184",
     0.1, 2000.0, DP_MAPPING_D3D, "depth24plus", "units", 50, PRESET_VERTICAL,
     "spec-vulkan", "webgpu", "wgsl", "", CHECKED},
    {"r3f", "react-three-fiber @react-three/fiber",
     "React Three Fiber with WebGLRenderer: three with planes of its own; fov 50 on its main branch",
     "react-three-fiber, packages/fiber/src/core/renderer.tsx (new THREE.PerspectiveCamera)",
     0.1, 1000.0, DP_MAPPING_GL, "unorm24", "units", 75, PRESET_VERTICAL,
     "spec-gl", "three", "glsl", "format", LATER},
    {"aframe", "a-frame", "three with planes of its own, for headsets",
     "A-Frame, reference of the component camera", 0.005, 10000.0, DP_MAPPING_GL, "unorm24", "m", 80, PRESET_VERTICAL,
     "spec-gl", "three", "glsl", "format", LATER},
    {"babylon", "babylonjs babylon.js", "WebGL; useReverseDepthBuffer is an option; fov is 0.8 radians",
     "Babylon.js, packages/dev/core/src/Cameras/camera.ts (minZ, maxZ, fov)",
     1.0, 10000.0, DP_MAPPING_GL, "unorm24", "units", 45.836623610465857, PRESET_VERTICAL,
     "spec-gl", "gl", "glsl", "format", LATER},
    {"playcanvas", NULL, "WebGL 2", "PlayCanvas, src/scene/camera.js and reference of CameraComponent",
     0.1, 1000.0, DP_MAPPING_GL, "unorm24", "units", 45, PRESET_VERTICAL, "spec-gl", "gl", "glsl", "format", LATER},
    {"bevy", NULL, "infinite reversed projection; the camera's far of 1000 only culls",
     "bevy_camera/src/projection.rs (perspective_infinite_reverse_rh); CORE_3D_DEPTH_FORMAT",
     0.1, (double)INFINITY, DP_MAPPING_REVERSED, "fp32", "m", 45, PRESET_VERTICAL, "spec-vulkan", "webgpu", "wgsl", "",
     CHECKED},
    {"cesium", "cesiumjs cesium.js", "logarithmic depth, written per fragment; ratios beyond 1e9 take several frusta",
     "CesiumJS, PerspectiveFrustum.js (near, far), Camera.js (fov, of the larger side), writeLogDepth.glsl",
     1.0, 5e8, DP_MAPPING_CESIUM, "unorm24", "m", 60, PRESET_LARGER, "spec-gl", "gl", "glsl", "format", CHECKED},
    {"mujoco", NULL, "one scene unit is the model's extent: multiply by it; offscreen buffers",
     "MuJoCo, mjVisual.map (znear, zfar), mj_defaultVisual (fovy); google-deepmind/mujoco#978 (reversed, 32-bit float)",
     0.01, 50.0, DP_MAPPING_REVERSED, "fp32", "extents", 45, PRESET_VERTICAL,
     "spec-gl", "gl", "c", "near, far", CHECKED},
};
/* clang-format on */

void preset_planes(const preset *p, const unit_row *unit, double *znear, double *zfar, double *log_c) {
    const unit_row *own = unit_find(p->unit);
    *znear = unit_convert(p->znear, own, unit);
    *zfar = unit_convert(p->zfar, own, unit);
    *log_c = 1.0 / unit_convert(1.0, own, unit);
}

double preset_fov_y(const preset *p, int width, int height) {
    const bool vertical = p->axis == PRESET_VERTICAL || (p->axis == PRESET_LARGER && width <= height);
    return vertical ? p->fov : dp_fov_vertical(p->fov, width, height);
}

NAMED_TABLE(preset, rows);
