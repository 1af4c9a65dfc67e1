/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file preset.h  From a separation to the number of a preset that keeps it: the first one that its row needs, as the
 * zoom of a map.
 */
#ifndef SOLVE_PRESET_H
#define SOLVE_PRESET_H

#include "camera/presets.h"
#include "quantity/quantity.h"

typedef struct preset_problem {
    dp_spec spec; /**< all but the planes that the preset brings */
    const preset *row;
    preset_values values;       /**< the first of them is not read */
    const unit_row *unit;       /**< of a scene unit; null where nothing says it */
    bool near_given, far_given; /**< those planes are the spec's */
    double limit;               /**< the separation may be at most this, scene units, positive */
    double lo, hi;              /**< at these depths; NaN: where the camera looks */
} preset_problem;

typedef struct preset_answer {
    bool possible;
    size_t tried;       /**< numbers from `from` to `to`, all of which pass */
    double from, to;    /**< the numbers that pass; impossible: those that were looked at */
    double least, most; /**< that the parameter may be */
    bool below_outside; /**< just below `from` the depths leave the planes; else the separation is too large there */
    bool above_outside; /**< the same above `to` */
    bool below, above;  /**< `from` is not the least, `to` not the most */
} preset_answer;

/** The number that is solved for; null where the preset needs none. */
const preset_parameter *preset_sought(const preset *row);

/** The camera with that number. @return true; false where it makes none, or the depths lie outside */
bool preset_setup(const preset_problem *p, double number, dp_setup *out, double *lo, double *hi);

/** Whether a number keeps the separation, as `check` judges it. */
bool preset_passes(const preset_problem *p, double number);

/**
 * The longest run of numbers that keep it. Its ends are where bisections end, and pass; in between 512 numbers were
 * tried over the whole range of the parameter and 1024 behind each end, and all that lie in the run passed.
 */
void preset_solve(const preset_problem *p, preset_answer *out);

#endif
