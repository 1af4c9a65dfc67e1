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

#endif
