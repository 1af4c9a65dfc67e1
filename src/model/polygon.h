/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A polygon of any shape cut into triangles that do not overlap. */
#ifndef MODEL_POLYGON_H
#define MODEL_POLYGON_H

#include "model/source.h"

enum { POLYGON_MAX = 2048 };

/* Corners are vertices of the model, in order. One that crosses itself is cut as far as it goes, its rest as a fan. */
bool polygon_cut(model_source *s, uint32_t *corner, size_t corners, uint32_t surface);

#endif
