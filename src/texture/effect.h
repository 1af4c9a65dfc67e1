/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file effect.h  Effects that consume depth, a row each: what an error of the depth does to them.
 */
#ifndef TEXTURE_EFFECT_H
#define TEXTURE_EFFECT_H

#include <stdbool.h>
#include <stddef.h>

#include "texture/camera.h"

enum { EFFECT_PARAMETERS_MAX = 3 };

typedef struct effect_parameter {
    const char *name;     /**< "half-width"; null ends the list */
    const char *unit;     /**< "scene units", "1", "1/eye01" */
    double lo, hi, value; /**< allowed range and default */
} effect_parameter;

typedef struct effect_row {
    const char *name; /**< "intersection", "force-field", "fog", "scan-line", "water-line", "height-fog", "edge",
                           "motion-blur", "depth-of-field" */
    const char *note; /**< the formula */
    effect_parameter parameters[EFFECT_PARAMETERS_MAX + 1];
    int wanted; /**< the parameter whose smallest usable value is looked for */
    const char *source;
    /** The effect's output (before it is stored in 8 bits) at eye depth z of a pixel whose world height grows by
     *  `rise` per unit of eye depth. */
    double (*output)(const dp_setup *setup, const double *parameters, double z, double rise);
} effect_row;

const effect_row *effect_get(size_t index);
const effect_row *effect_find(const char *name);

/** The largest change of the output, in levels of 1/255, between depths stored as the code of z. */
double effect_error(const effect_row *row, const dp_setup *setup, const double *parameters, double z, double rise);

/** The smallest value of the wanted parameter for which quantization at z stays below `levels` levels; NaN if none in
 *  its range. */
double effect_smallest(const effect_row *row, const dp_setup *setup, const double *parameters, double z, double rise,
                       double levels);

#endif
