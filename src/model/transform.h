/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where a node puts its vertices: affine maps, exact to 2^-100 or as an engine has them in binary32. */
#ifndef MODEL_TRANSFORM_H
#define MODEL_TRANSFORM_H

#include "core/engine.h"
#include "model/model.h"

/* Rows of a matrix whose last row is 0 0 0 1. In binary32 the values are in `hi` alone. */
typedef struct transform {
    model_transforms kind;
    dp_pair m[3][4];
} transform;

transform transform_identity(model_transforms kind);

/* Columns first, as glTF has it; its last row is not looked at. */
transform transform_of_matrix(model_transforms kind, const double m[16]);

/* Translation, rotation as a quaternion x y z w that is taken as it is, and scale. */
transform transform_of_parts(model_transforms kind, const double t[3], const double q[4], const double s[3]);

/* outer inner: what `inner` gives is put into `outer`. */
transform transform_times(const transform *outer, const transform *inner);

void transform_point(const transform *t, const double from[3], double to[3]);

/* The direction of axis `k`, of length 1; 0 where it has none. */
void transform_axis(const transform *t, int k, double to[3]);

/* Whether it turns counter-clockwise into clockwise. */
bool transform_mirrors(const transform *t);

bool transform_finite(const transform *t);

#endif
