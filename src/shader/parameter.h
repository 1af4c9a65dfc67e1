/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file parameter.h  The numbers that a synthetic image or an effect takes: a list that a null name ends. */
#ifndef SHADER_PARAMETER_H
#define SHADER_PARAMETER_H

#include <stdbool.h>
#include <stddef.h>
#include <string.h>

enum { PARAMETERS_MAX = 8 }; /**< at most in a list, without its end */

/** Where a parameter is used: of an effect, its table over depths has no pixels, and its image no plane in their place.
 */
typedef enum parameter_use { PARAMETER_ALWAYS = 0, PARAMETER_IMAGE, PARAMETER_TABLE } parameter_use;

typedef struct texture_parameter {
    const char *name; /**< "half-width" */
    const char *note; /**< what it is */
    const char *unit; /**< "scene units", "eye01", "1", ... */
    double lo, hi;    /**< allowed range, ends included */
    double value;     /**< default; NaN: none */
    bool whole;       /**< a whole number */
    parameter_use use;
    const char *alias; /**< what shaders call it; or null */
} texture_parameter;

/** The index of a name or alias in a list; -1 when there is none. */
static inline int parameter_find(const texture_parameter *list, const char *name) {
    for (int i = 0; list[i].name != NULL; i++)
        if (strcmp(list[i].name, name) == 0 || (list[i].alias != NULL && strcmp(list[i].alias, name) == 0))
            return i;
    return -1;
}

static inline void parameter_defaults(const texture_parameter *list, double out[PARAMETERS_MAX]) {
    for (int i = 0; i < PARAMETERS_MAX; i++)
        out[i] = list[i].value;
}

#endif
