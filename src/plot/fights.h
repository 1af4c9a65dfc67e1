/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file fights.h  What the figure of a model's fights is made of. */
#ifndef PLOT_FIGHTS_H
#define PLOT_FIGHTS_H

#include "scene/find.h"

/** Two surfaces that can fight before the far plane. */
typedef struct fights_item {
    const finder_finding *finding;
    double certain_to; /**< eye depth up to which they are told apart, scene units; NaN where not even at near */
} fights_item;

typedef struct fights_asked {
    const model *m;
    const finder_found *found;
    const fights_item *item; /**< the nearest fight first */
    size_t count;
    double gap;         /**< of the search, scene units */
    double znear, zfar; /**< of the camera; the latter may be INFINITY */
} fights_asked;

#endif
