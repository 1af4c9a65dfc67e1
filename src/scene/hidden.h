/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Whether closed bodies hide an overlap: from every point of it that is tried, a little before its surfaces, of all
 * closed bodies (body.h) a ray first meets the inside of one, and leaves this one oftener than it enters it. Tried are
 * the corners, moved inward by 2^-10, the middles of the sides and the centroid. "A little" is the gap asked for, but
 * at most 2^-10 of the overlap's longest diagonal: a body that lies against the overlap hides it, too, although a slit
 * as flat as that may show it.
 *
 * These hide nothing: a body with a hole in it, or whose neighbours' corners are not at the same coordinates, bodies of
 * blended or two-sided materials, and walls that face into their room. What is hidden wrongly: an overlap that shows
 * itself only between the points tried, in a hollow of the body or through a masked part of its texture, and one seen
 * by a camera inside a body.
 */
#ifndef SCENE_HIDDEN_H
#define SCENE_HIDDEN_H

#include <stdbool.h>
#include <stdint.h>

#include "model/model.h"
#include "scene/overlap.h"
#include "scene/tree.h"

typedef struct hidden_among {
    const model *m;
    const tree *t;        /* its items are triangles */
    const double *origin; /* of its boxes */
    const uint32_t *body; /* body_numbers() */
    double gap;           /* scene units: asked for */
    double against;       /* how far before the surfaces the rays start at least */
} hidden_among;

/* Seen from the front of the overlap's first triangle, else from behind it. */
bool hidden_from(const hidden_among *among, const overlap *o, bool front);

#endif
