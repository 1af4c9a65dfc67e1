/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file origin.h  Where vertices come from: the terms of a budget beyond the camera, and schemes for large worlds. */
#ifndef WORLD_CMD_ORIGIN_H
#define WORLD_CMD_ORIGIN_H

#include "camera/cmd/camera.h"
#include "cli/option/option.h"
#include "world/world.h"

enum { ORIGIN_SCHEMES_MAX = 16 };

typedef struct origin_asked {
    dp_budget_terms
        terms; /**< --interpolation, --from-origin, --composition, --linearize, --log2; zero when not given */
    world_scheme schemes[ORIGIN_SCHEMES_MAX]; /**< in the order given, each once */
    size_t scheme_count;
    bool shared_origin; /**< both surfaces are of meshes with one origin */
} origin_asked;

extern const option_table origin_options;

/** The terms of a budget. */
extern const option_use origin_terms[];

/** Sizes of the schemes in what a scene unit is, once that is known; --share needs one of meshes with origins.
 * @return as a parser does */
int origin_complete(asked_line *line, const origin_asked *o);

#endif
