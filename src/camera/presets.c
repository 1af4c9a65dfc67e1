/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "camera/computed.h"

#include <math.h>

/* When a row was checked; without a function the planes are its own. */
#define CHECKED "2026-11-21", NULL
#define LATER   "2026-11-28", NULL
#define TODAY   "2026-11-29"

/* In place of the planes: they are the function's. */
#define COMPUTED (double)NAN, (double)NAN

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
    {"maplibre", "maplibre-gl maplibre-gl-js",
     "MapLibre GL JS 6.17, the flat map with neither terrain nor padding; of the depth range flat layers take 14 codes "
     "of 2^16 each and 3D layers the rest",
     "MapLibre GL JS, src/geo/projection/mercator_transform.ts (_calculateNearFarZ), mercator_utils.ts, lng_lat.ts",
     COMPUTED, DP_MAPPING_GL, "unorm24", "m", FOV_OF_MAPS, PRESET_VERTICAL, "spec-gl", "gl", "glsl", "format", TODAY,
     &computed_maplibre},
    {"maplibre-globe", NULL, "MapLibre GL JS 6.17, the globe: near is half a pixel",
     "MapLibre GL JS, src/geo/projection/vertical_perspective_transform.ts (_calcMatrices), globe_utils.ts", COMPUTED,
     DP_MAPPING_GL, "unorm24", "m", FOV_OF_MAPS, PRESET_VERTICAL, "spec-gl", "gl", "glsl", "format", TODAY,
     &computed_maplibre_globe},
    {"deckgl", "deck.gl deck",
     "deck.gl 9.4, MapView: near and far are nearZMultiplier and farZMultiplier, of the canvas's height",
     "deck.gl, modules/core/src/viewports/web-mercator-viewport.ts; math.gl, modules/web-mercator/src/"
     "web-mercator-utils.ts (getProjectionParameters)",
     COMPUTED, DP_MAPPING_GL, "unorm24", "m", FOV_OF_MAPS, PRESET_VERTICAL, "spec-gl", "gl", "glsl", "format", TODAY,
     &computed_deckgl},
    {"deckgl-globe", NULL, "deck.gl 9.4, GlobeView: near is nearZMultiplier heights of the canvas",
     "deck.gl, modules/core/src/viewports/globe-viewport.ts", COMPUTED, DP_MAPPING_GL, "unorm24", "m", FOV_OF_MAPS,
     PRESET_VERTICAL, "spec-gl", "gl", "glsl", "format", TODAY, &computed_deckgl_globe},
    {"mujoco", NULL, "one scene unit is the model's extent: multiply by it; offscreen buffers",
     "MuJoCo, mjVisual.map (znear, zfar), mj_defaultVisual (fovy); google-deepmind/mujoco#978 (reversed, 32-bit float)",
     0.01, 50.0, DP_MAPPING_REVERSED, "fp32", "extents", 45, PRESET_VERTICAL,
     "spec-gl", "gl", "c", "near, far", CHECKED},
};
/* clang-format on */

NAMED_TABLE(preset, rows);
