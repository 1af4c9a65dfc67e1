/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file computed.h  How engines compute their planes from what their users know; presets.c has a row for each.
 */
#ifndef CAMERA_COMPUTED_H
#define CAMERA_COMPUTED_H

#include "camera/presets.h"

/** The angle at which a camera is 1.5 heights of the canvas away. */
#define FOV_OF_MAPS 36.86989764584402

/** Maps: lengths in metres at the map's middle, whose eye depth is the focus. */
extern const preset_function computed_maplibre, computed_maplibre_globe, computed_deckgl, computed_deckgl_globe;

/** Viewers, which fit their planes to a sphere or a box around the scene, whose middle is the focus. */
extern const preset_function computed_vtk, computed_vtkjs, computed_model_viewer, computed_x3dom, computed_gltf_viewer,
    computed_babylon, computed_open3d, computed_pyrender;

/** The others have numbers of their own. */
extern const preset_function computed_mujoco, computed_cesium, computed_blender, computed_blender_viewport;

#endif
