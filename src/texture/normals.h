/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file normals.h  Normals beside the depths of a frame, as _CameraDepthNormalsTexture has them: packed. */
#ifndef TEXTURE_NORMALS_H
#define TEXTURE_NORMALS_H

#include "texture/frame.h"

/**
 * Makes the normals of a frame from its depths, and packs them. Sky, and what has none, faces the camera.
 * @param error  how far they may be off in an image is asked for: the bound of the method on planes
 * @return false when out of memory
 */
bool frame_normals_make(const frame *f, const normal_row *method, bool error, frame_normals *out);
void frame_normals_free(frame_normals *n);

#endif
