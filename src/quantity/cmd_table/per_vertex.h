/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file per_vertex.h  Error of depth that is written per vertex, in reports: under a mapping that is not affine. */
#ifndef QUANTITY_CMD_TABLE_PER_VERTEX_H
#define QUANTITY_CMD_TABLE_PER_VERTEX_H

#include <stdbool.h>

#include "depthprec/depthprec.h"
#include "report/report.h"

/** At a depth; NaN where the mapping is affine on the screen, or no viewport was asked for. */
typedef struct per_vertex {
    double error; /**< the most by which a triangle of the class is too far, scene units */
    double depth; /**< the class whose error is no more than the separation */
} per_vertex;

/** The worst of several depths: the greatest share of z, the smallest class. z is NaN while there are none. */
typedef struct per_vertex_worst {
    double class;                   /**< the one that was asked for */
    double z, error, depth, beyond; /**< beyond: of `depth`, above 1 */
} per_vertex_worst;

extern const column per_vertex_columns[];

/** Is depth written per vertex wrong between vertices? */
bool per_vertex_matters(const dp_setup *setup);

/** @param depth  of the class, as in dp_triangles @param separation  what is told apart at z */
per_vertex per_vertex_at(const dp_setup *setup, double z, double depth, double separation);

per_vertex_worst per_vertex_none(double depth);
void per_vertex_add(per_vertex_worst *worst, const per_vertex *here, double z);

#endif
