/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file sensor_find.h  The lattice of an image, found or completed from what somebody knows of it. */
#ifndef TEXTURE_SENSOR_FIND_H
#define TEXTURE_SENSOR_FIND_H

#include "texture/sensor.h"

/** Looks at all depths. Never fails: what cannot be found is assumed to be the file's own. */
void sensor_find(const image *img, const sensor_file *file, sensor *out);

/**
 * Completes what a user knows: a row, and of its levels the step and the offset, or how many are from lo to hi. NaN
 * stands for what is not known; an offset is then where most values are, and what they were rounded to between lattice
 * and file is what leaves few of them on no level.
 * @param seen  what sensor_find() found
 */
void sensor_complete(const image *img, const sensor_file *file, const double ends[2], const sensor *seen, sensor *s);

#endif
