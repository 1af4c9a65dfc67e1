/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file planes.h  The near and far planes that pairs are of. */
#ifndef JUDGE_PLANES_H
#define JUDGE_PLANES_H

#include "judge/judge.h"

/** By least squares, of a set-up's mapping and projection; far stays the set-up's where values tell a ratio alone.
 * @param alike  whether the line's errors are alike at all depths, after a difference; else relative
 * @return false where they tell nothing */
bool judge_planes_of(const judge_pairs *pairs, const dp_setup *setup, const judge_input *input,
                     const judge_output *output, bool alike, double *znear, double *zfar);

/** Gives a set-up planes of so many digits, or an infinite far plane. @return false where no set-up has them */
bool judge_planes_set(dp_setup *setup, double znear, double zfar, int digits, bool infinite);

#endif
