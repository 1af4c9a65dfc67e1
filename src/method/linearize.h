/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file linearize.h  The methods of the linearize family that prepare a table, a spline or a series. */
#ifndef METHOD_LINEARIZE_H
#define METHOD_LINEARIZE_H

#include "method/method.h"

enum { LINEARIZE_TABLE = 65536, LINEARIZE_KNOTS = 4097, LINEARIZE_ORDER = 40 };

void *table_open(const dp_setup *setup);
void table_close(void *state);
void table_nearest(const dp_setup *, const void *state, const method_inputs *, const method_outputs *);
void table_linear(const dp_setup *, const void *state, const method_inputs *, const method_outputs *);

void *spline_open(const dp_setup *setup);
void spline_close(void *state);
void spline_run(const dp_setup *, const void *state, const method_inputs *, const method_outputs *);

void *chebyshev_open(const dp_setup *setup);
void chebyshev_close(void *state);
void chebyshev_run(const dp_setup *, const void *state, const method_inputs *, const method_outputs *);

#endif
