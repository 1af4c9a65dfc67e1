/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file plane_error.h  The plane that an error needs: |stored - z| of the codes that the depths really have. */
#ifndef NEED_PLANE_ERROR_H
#define NEED_PLANE_ERROR_H

#include "need/plane.h"

/**
 * From the plane that will do however the depths are aligned to the codes, on through the codes that the deciding depth
 * takes, to the first value that fails: all from there to `until` pass. Models exact and staged.
 *
 * @param lattice  what solve() found in the model exact
 */
void plane_error_solve(const solve_problem *problem, const solve_result *lattice, plane_answer *out);

#endif
