/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file frusta.h  Several frusta, one behind the other, each with the whole depth range: how few tell surfaces apart.
 *
 * A renderer draws them from the farthest on and clears the depth buffer between two. Model of the set-up; separations
 * of surfaces that face the camera.
 */
#ifndef SOLVE_FRUSTA_H
#define SOLVE_FRUSTA_H

#include <stddef.h>

#include "quantity/quantity.h"

enum { FRUSTA_MAX = 64 };

typedef struct frustum {
    double znear, zfar;     /**< scene units */
    quantity_worst reached; /**< over all of it: the certified separation where it is worst */
} frustum;

typedef struct frusta_plan {
    bool possible; /**< the frusta cover all, and each meets the limit */
    size_t count;  /**< of the frusta, the nearest first; impossible: those behind `stuck` */
    double stuck;  /**< impossible: no frustum that ends here meets the limit, or FRUSTA_MAX are not enough */
    size_t worst;  /**< the frustum whose separation is largest; 0 without frusta */
    frustum frusta[FRUSTA_MAX];
} frusta_plan;

/**
 * From far on, each frustum as deep as a bisection finds to pass; no plane has more digits than it needs to pass as it
 * is printed. Every frustum is judged as `check` judges, so the plan holds even where the measure is not monotone.
 *
 * @param spec   near and far are those of the whole, far finite
 * @param limit  the separation may be at most this, scene units, positive
 * @return DP_OK (also when impossible), DP_ERROR_NULL, DP_ERROR_RANGE, or what dp_setup_init() has against `spec`
 * Cost: some hundred judgements a frustum.
 */
dp_status frusta_solve(const dp_spec *spec, double limit, frusta_plan *out);

/**
 * The number below which no plan meets the limit, whatever its planes and the model: that of the lattice, proven for
 * UNORM formats. 1 for FLOAT, and where nothing is known.
 */
size_t frusta_at_least(const dp_spec *spec, double limit);

/** Judges one frustum from near to far by the lattice alone: in the model exact, whatever that of `spec` is. It passes
 * where arithmetic, not the lattice, asks for more frusta. */
quantity_worst frusta_lattice(const dp_spec *spec, double limit);

/** The least near with which the lattice alone meets the limit up to `zfar`; NaN where a bisection finds none. */
double frusta_lattice_near(const dp_spec *spec, double zfar, double limit);

/**
 * Frusta of one ratio of far to near from `near` on, the last cut off at far.
 *
 * @param ratio  above 1
 * @return as frusta_solve(); DP_ERROR_RANGE for near <= 0, a ratio or a number out of range
 */
dp_status frusta_by_ratio(const dp_spec *spec, double ratio, frusta_plan *out);

#endif
