/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file presets.h  The cameras that engines start with, one row each. Adding an engine is adding a row to presets.c.
 *
 * A value that no public source of first hand confirms is named in `unconfirmed`; the others have been compared with
 * the row's source on the date of `checked`.
 */
#ifndef CAMERA_PRESETS_H
#define CAMERA_PRESETS_H

#include "camera/unit.h"
#include "core/named.h"
#include "depthprec/depthprec.h"

/** Which angle an engine's field of view is. */
typedef enum preset_axis { PRESET_VERTICAL = 0, PRESET_HORIZONTAL, PRESET_LARGER } preset_axis;

typedef struct preset {
    NAMED_FIELDS;
    double znear; /**< in `unit` */
    double zfar;  /**< in `unit`, or INFINITY */
    dp_mapping mapping;
    const char *format;      /**< a name for dp_format_parse(): depth24plus stands for two formats */
    const char *unit;        /**< what the scene is measured in, "m", "cm", "units" when it is left open */
    double fov;              /**< degrees */
    preset_axis axis;        /**< of `fov` */
    const char *raster;      /**< a name of `list rasterizers`: what the APIs it runs on promise at least */
    const char *api;         /**< a name of `list apis`: what its users, or the engine itself, write a bias for */
    const char *language;    /**< what its users write, a name of `list languages` */
    const char *unconfirmed; /**< the values without a source of first hand, "near, fov"; "" when there are none */
    const char *checked;     /**< the day on which source and values were compared, ISO 8601 */
} preset;

NAMED_ROWS(preset, preset);

/** Its planes, and the constant C of its logarithm, 1 for a depth in its own unit, in scene units of `unit`; where that
 * is null, or the preset's is no length, as they are. */
void preset_planes(const preset *p, const unit_row *unit, double *znear, double *zfar, double *log_c);

/** The vertical field of view in a viewport, degrees. */
double preset_fov_y(const preset *p, int width, int height);

#endif
