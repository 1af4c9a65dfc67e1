/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file sensor_surface.h  Depths that lie on a lattice because of what they show, not because they were rounded to it.
 */
#ifndef TEXTURE_SENSOR_SURFACE_H
#define TEXTURE_SENSOR_SURFACE_H

#include "texture/sensor.h"

/** Whether a smooth surface explains the levels. @param scale  scene units of 1 in a sample */
bool sensor_is_surface(const image *img, const sensor *s, double scale);

/** Whether the lattice is one that several coarser ones share. */
bool sensor_is_put_together(const image *img, const sensor_file *file, const sensor *s);

#endif
