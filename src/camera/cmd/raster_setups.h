/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file raster_setups.h  From options to set-ups of surfaces that a rasterizer draws. */
#ifndef CAMERA_CMD_RASTER_SETUPS_H
#define CAMERA_CMD_RASTER_SETUPS_H

#include "camera/cmd/setups.h"

/** As setups_make(), of the model float in the rasterizer's own arithmetic; view and rasterizer are complete. */
int raster_setups(const camera_asked *c, setups *out);

#endif
