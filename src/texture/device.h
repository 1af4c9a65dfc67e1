/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file device.h  Data sheets: what depth cameras and data sets write, and what of it is published.
 *
 * Units and ranges are what a file's numbers are compared with; the lattice says how far apart the depths are that are
 * told apart, without a file. Each camera has a calibration of its own: a focal length here is that of the data sheet.
 */
#ifndef TEXTURE_DEVICE_H
#define TEXTURE_DEVICE_H

#include "texture/sensor.h"

typedef struct device_row {
    const char *name, *note;
    double unit;              /**< metres of 1 in a sample; 0: its files hold disparity */
    grain_levels levels;      /**< GRAIN_FINE: nothing is published, or it is finer than the file */
    double focal, baseline;   /**< pixels, metres; 0: has none, or none is published */
    double step, offset;      /**< GRAIN_EVEN: metres; else disparity as stereo.h has it */
    double nearest, farthest; /**< metres: what its depths lie between */
    bool radial;              /**< distances along the ray */
    const char *source;
    bool usual; /**< these depths are usual ones: no sheet has them */
} device_row;

const device_row *device_get(size_t index); /**< null beyond the last */

/** The name of a known device or file with such a step, in metres; null: none. */
const char *device_like(grain_levels levels, double step);

/** Its levels in metres, wherever they begin; the row is that of samples where there are none. */
sensor device_sensor(const device_row *row);

#endif
