/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file presets.h  The cameras that engines start with, one row each. Adding an engine is adding a row to presets.c.
 *
 * A value that no public source of first hand confirms is named in `unconfirmed`; the others have been compared with
 * the row's source on the date of `checked`.
 */
#ifndef CAMERA_PRESETS_H
#define CAMERA_PRESETS_H

#include <stdbool.h>

#include "camera/unit.h"
#include "core/named.h"
#include "depthprec/depthprec.h"

/** Which angle an engine's field of view is. */
typedef enum preset_axis { PRESET_VERTICAL = 0, PRESET_HORIZONTAL, PRESET_LARGER } preset_axis;

/** A number that a user of the engine knows, from which its planes follow. */
typedef struct preset_parameter {
    const char *name, *unit; /**< "pitch", "degrees"; "" of what has none */
    double least, most;
    double standard; /**< where it is not given; NaN: it must be */
    double example;  /**< in the sentence that asks for it */
} preset_parameter;

enum { PRESET_PARAMETERS = 8, PRESET_WORDS_SIZE = 160 };

/** The camera that follows from them. Lengths in the unit of the row. */
typedef struct preset_camera {
    double znear, zfar;
    double fov;   /**< degrees, of the axis of the row */
    double focus; /**< the eye depth of what the camera looks at; NaN where nothing says it */
} preset_camera;

/** How an engine computes its camera: @p given has a number for each parameter, in their order. */
typedef struct preset_function {
    preset_parameter parameters[PRESET_PARAMETERS]; /**< behind the last one the name is null; "height" is that of the
                                                         viewport, where there is one */
    void (*compute)(const double *given, preset_camera *out);
} preset_function;

typedef struct preset {
    NAMED_FIELDS;
    double znear; /**< in `unit`; NaN with a function */
    double zfar;  /**< in `unit`, or INFINITY; NaN with a function */
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
    const preset_function *function; /**< null where the planes are the row's */
} preset;

NAMED_ROWS(preset, preset);

/** The words for a preset: "maplibre:zoom=14,pitch=60". */
typedef struct preset_values {
    double given[PRESET_PARAMETERS]; /**< NaN: not given */
    char words[PRESET_WORDS_SIZE];   /**< as it was typed */
    bool sought;                     /**< the first is solved for: its example stands for it, and is not asked for */
} preset_values;

/** How long the first of several is, which commas part as they part the numbers of each. */
size_t preset_length(const char *text);

enum { PRESET_ERROR_SIZE = 512 };

/**
 * Reads NAME or NAME:PARAMETER=NUMBER,...
 * @return true, or false and what it must be; "" where no row has that name, which is then in values->words
 */
bool preset_read(const char *text, const preset **row, preset_values *values, char error[PRESET_ERROR_SIZE]);

/** The index of the parameter of that name; -1 where a row has none. */
int preset_parameter_of(const preset *row, const char *name);

/** The camera of a row and its numbers. @return true, or false and what is needed */
bool preset_make(const preset *row, const preset_values *values, preset_camera *out, char error[PRESET_ERROR_SIZE]);

/** The planes of its camera, and the constant C of its logarithm, 1 for a depth in its own unit, in scene units of
 * `unit`; where that is null, or the preset's is no length, as they are. */
void preset_planes(const preset *p, const preset_camera *camera, const unit_row *unit, double *znear, double *zfar,
                   double *log_c);

/** The vertical field of view of `fov` degrees in a viewport. */
double preset_fov_y(const preset *p, double fov, int width, int height);

#endif
