/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Which triangles are the surface of a closed body: opaque ones, seen from the front alone, of one node and mesh, that
 * hang together by their edges, each of which is run through as often in one direction as in the other. Corners are the
 * same where their coordinates are. A ray that starts inside such a body leaves it oftener than it enters it.
 */
#ifndef SCENE_BODY_H
#define SCENE_BODY_H

#include <stdint.h>

#include "model/model.h"

#define BODY_NONE UINT32_MAX

/* The number of each triangle's body, or BODY_NONE; to be freed. Null: no memory. */
uint32_t *body_numbers(const model *m);

#endif
