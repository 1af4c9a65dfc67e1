/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Which triangles are the surface of a closed body: opaque ones, seen from the front alone, of one node and mesh, that
 * hang together by their edges, each of which is run through as often in one direction as in the other. Corners are the
 * same where their coordinates are. A ray that starts inside such a body leaves it once oftener than it enters it.
 */
#ifndef SCENE_BODY_H
#define SCENE_BODY_H

#include <stdbool.h>
#include <stdint.h>

#include "model/model.h"

/* A flag for each triangle, to be freed; null: no memory. */
uint8_t *body_closed(const model *m);

#endif
