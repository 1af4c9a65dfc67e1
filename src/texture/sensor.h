/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file sensor.h  What a depth was rounded to before it became a sample of metric depth: the lattice of the sensor, of
 * a format or of a depth buffer, which is what the image resolves. The file's own step says nothing about that.
 *
 * Quantization alone is looked at: noise is not.
 */
#ifndef TEXTURE_SENSOR_H
#define TEXTURE_SENSOR_H

#include "image/image.h"
#include "shader/sample_rounding.h"

/** The share of the pixels that lie on a lattice that is found. */
#define SENSOR_SHARE 0.875

typedef struct sensor_row {
    const char *name; /**< "file", "inverse", "even", "binary16" */
    const char *note;
    const char *gap;    /**< between levels */
    const char *source; /**< who makes such depths, and where that is written */
    grain_levels levels;
} sensor_row;

const sensor_row *sensor_get(size_t index); /**< null beyond the last */

/** The row of such levels: each kind has one. */
const sensor_row *sensor_row_of(grain_levels levels);

/** The rounding of the file itself. */
typedef struct sensor_file {
    double step;  /**< samples are multiples of it, in scene units; 0: numbers */
    double unit;  /**< of an integer, at most the step; 0: numbers */
    int digits;   /**< numbers: significant bits, 11, 24 or 53; 0: integers */
    double scale; /**< scene units of 1 in a sample */
    double again; /**< what was rounded to before that, scene units: multiples of it; 0: nothing was */
} sensor_file;

/** The lattice that was found or given. Numbers that it does not have are NaN. */
typedef struct sensor {
    const sensor_row *row;
    bool given;                /**< by somebody who knows */
    bool found;                /**< by the rule above, and no other row explains the values as well; else assumed */
    double file_step;          /**< what the file itself rounded to, step or unit of it */
    double again;              /**< multiples that the levels were rounded to before that; 0: they were not */
    bool again_seen;           /**< the samples show them; else it is a step that is large enough */
    double step, step_off;     /**< of 1/z, or of z, and how far off it is at most */
    double offset, offset_off; /**< the level nearest to 0, in the unit of the step */
    double levels;             /**< from the nearest to the farthest depth, whether used or not */
    double bits;               /**< -log2 of the chance of random values, less that of all lattices tried */
    double off_pixels;         /**< on no level: interpolated, or of something else */
    double residual;           /**< of all others: how far the farthest is from its level, scene units, where all are
                                    shifted alike so that this is least; of a found one without values that are rare */
    const sensor_row *other;   /**< explains the values, too; null: none does */
    const char *like;          /**< a standard lattice with such a step; null: none is known */
} sensor;

/** From levels of samples to levels of scene units, `scale` of them a sample's 1. */
void sensor_scale(sensor *s, double scale);

/** Where it is known how many levels there are from lo to hi: their step and offset. */
void sensor_between(double lo, double hi, sensor *s);

/** From a level at z to the next farther one, scene units, INFINITY where there is none; NaN where the row is "file"
 * and its samples are numbers. */
double sensor_gap(const sensor *s, double z);

/** How many levels there are from lo on and below hi; NaN as above */
double sensor_levels(const sensor *s, double lo, double hi);

/** Which level is at z, counted from the offset in steps, not rounded. */
double sensor_level(const sensor *s, double z);

/** From one number of binary16 to the next at z, subnormals included. */
double sensor_half_gap(double z);

/** The nearest level; NaN beyond the farthest one. */
double sensor_round(const sensor *s, double z);

/** Beyond which nothing lies that was rounded to a depth up to z; z where that has no end. */
double sensor_end(const sensor *s, double z);

/** Sets the levels of `g`, from which ranges are made: for window depths of a linear mapping that ends at zfar. */
void sensor_into(const sensor *s, double zfar, grain *g);

#endif
