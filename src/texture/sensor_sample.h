/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file sensor_sample.h  A sample of metric depth: what the file leaves open of it, and which depths an image has. */
#ifndef TEXTURE_SENSOR_SAMPLE_H
#define TEXTURE_SENSOR_SAMPLE_H

#include "texture/sensor.h"
#include "texture/sensor_fit.h"

typedef struct sensor_interval {
    double lo, hi;
} sensor_interval;

bool sensor_is_depth(double x); /**< a hole is none */

/** The eye depths, in scene units, that the sample x may have been: before it was stored it was rounded to multiples,
 * or cut off. */
sensor_interval sensor_interval_of(const sensor_file *file, double x);

/** The same as a value of levels that are even in it. */
fit_value sensor_value_of(grain_levels levels, sensor_interval z);

bool sensor_holds_half(sensor_interval z); /**< whether a number of binary16 lies in it */

/** Whether the sample may be on a level. */
bool sensor_holds(const sensor *s, const sensor_file *file, double x);

/** Whether it is, and tells on which. */
bool sensor_tells(const sensor *s, const sensor_file *file, double x);

/** The depths of an image, each once, upwards, and how many pixels have it. */
typedef struct sensor_depths {
    double *samples, *pixels;
    size_t count;
} sensor_depths;

/** One pixel of so many is looked at. */
size_t sensor_stride(const image *img);

/** @return false without memory; sensor_depths_free() in either case */
bool sensor_gather(const image *img, sensor_depths *d);

void sensor_depths_free(sensor_depths *d);

int sensor_compare(const void *a, const void *b); /**< of doubles, for qsort() */

#endif
