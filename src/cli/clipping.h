/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file clipping.h  What binary32 clipping draws of what lies between the planes: words around dp_pipeline_planes().
 */
#ifndef CLI_CLIPPING_H
#define CLI_CLIPPING_H

#include <stdbool.h>

#include "cli/setups.h"

typedef struct clipping {
    double znear, zfar; /**< the effective planes; both NaN when nothing is drawn, or there is no pipeline */
    bool loses;         /**< depths that binary32 has between the planes are not drawn */
} clipping;

/** Of a set-up of the model fp32; NaN and false for the others. */
clipping clipping_of(const dp_setup *setup);

/** A line on stderr: what clipping keeps, these planes and `rest` behind them, or nothing where znear is NaN. */
void clipping_say(const dp_setup *setup, double znear, double zfar, const char *rest);

/** The same for each set-up that loses geometry. */
void clipping_warn(const setups *all);

#endif
