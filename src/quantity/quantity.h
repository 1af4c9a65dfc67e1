/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file quantity.h  The quantities that can be asked of a depth and of all depths of a range, a row each: requirements
 *                   and `solve` limit them, `check` judges by them, curves show them, so that all say the same number.
 */
#ifndef QUANTITY_QUANTITY_H
#define QUANTITY_QUANTITY_H

#include <stdbool.h>

#include "core/named.h"
#include "depthprec/depthprec.h"

/** The index of its row. */
typedef enum quantity_kind {
    QUANTITY_SEPARATION = 0, /**< dp_separation(): how far behind z a surface must lie to be told apart */
    QUANTITY_ERROR,          /**< |stored - z|; of computed depths at most, whatever a shader's log2 */
    QUANTITY_TIES,           /**< the share of neighbouring binary32 depths that are not stored in order */
    QUANTITY_BIAS,           /**< a depth bias that is given, and the least that is enough; judged by bias/verdict.h */
    QUANTITY_LIMITED,        /**< a requirement may limit those above it */
    QUANTITY_INTERVAL = QUANTITY_LIMITED, /**< the width of the cell of z: depths in it share a code */
    QUANTITY_DENSITY,                     /**< how many codes a scene unit of depth has at least */
    QUANTITY_COUNT
} quantity_kind;

/** The worst of a range, in the model of the set-up. */
typedef struct quantity_worst {
    double value;  /**< the bound; of a separation that is judged, what is reached where the bound says no more */
    double z;      /**< the depth that is worst */
    uint32_t code; /**< stored there; 0 where it is no quantity of cells */
    bool passed;   /**< certified: it is no more than the limit at every depth asked about */
} quantity_worst;

typedef struct quantity_row {
    NAMED_FIELDS; /**< its key in JSON, in CSV and in a requirement file; the note: what is measured, in a verdict */
    const char *axis; /**< the label of the axis of its curve; null: it has none */
    const char *unit; /**< of that axis; null: a share of 1 */
    bool of_surfaces; /**< of two surfaces, guaranteed in binary32 and at any slant; else of depths at a point */
    /** At a depth in [near, far]; null where it is no quantity of one depth. */
    double (*at)(const dp_setup *setup, double z);
    /**
     * Over [lo, hi], near <= lo < hi <= far: never below `at` of a depth in it; null where none is.
     * @param limit  scene units, positive; NaN to ask what is reached: then `value` is the certified bound
     */
    quantity_worst (*over)(const dp_setup *setup, double lo, double hi, double limit);
    /** Whether it is at most `limit` at all depths of [lo, hi] in each camera of a run, see core/engine.h; null where
     * no plane is solved for. */
    int (*within)(const dp_setup *outer, const dp_setup *inner, double lo, double hi, double limit);
    /** From the worst cell of a slice of depths; null where it is no quantity of cells. */
    double (*of_cells)(const dp_worst *worst);
} quantity_row;

NAMED_ROWS(quantity_row, quantity);

/** Whether a model judges it: in float there are no cells, but what the shader of a logarithm computes has an error. */
bool quantity_has_model(quantity_kind q, dp_model model, dp_mapping mapping);

/** Over a range, or at a depth where lo = hi; of a row that has both. */
quantity_worst quantity_over(quantity_kind q, const dp_setup *setup, double lo, double hi, double limit);

/** The certified bound over [lo, hi], lo <= hi; NaN where that is no range of the set-up, or its model has no cells. */
double quantity_bound(quantity_kind q, const dp_setup *setup, double lo, double hi);

/**
 * The set-up in which a spec is judged. That is dp_setup_init()'s, but in the model float, which knows only the
 * pipeline, a logarithmic depth is what its shader computes: dp_setup_guaranteed().
 *
 * @return what dp_setup_init() has against it
 */
dp_status quantity_setup(const dp_spec *spec, dp_setup *out);

#endif
