/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file figure.h  Parts of the figure of a model's fights. */
#ifndef SCENE_FIGURE_H
#define SCENE_FIGURE_H

#include "scene/eye.h"
#include "scene/find.h"

/** Two surfaces that can fight. */
typedef struct fights_item {
    const finder_finding *finding;
    double from; /**< eye depth from which they can fight, scene units; NaN where at every one */
} fights_item;

typedef struct fights_asked {
    const model *m;
    const finder_found *found;
    const fights_item *item; /**< the nearest fight first */
    size_t count;
    double gap;           /**< of the search, scene units */
    const scene_eye *eye; /**< from which they are judged */
    size_t eyes;          /**< 0: from everywhere */
} fights_asked;

#endif
