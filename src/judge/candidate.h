/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file candidate.h  A candidate beside pairs, and beside another: what its values may be after all that is lost. */
#ifndef JUDGE_CANDIDATE_H
#define JUDGE_CANDIDATE_H

#include "judge/judge.h"

enum { JUDGE_STEPS = 16 }; /* half units in the last place of binary32 that a function may lose */

/** The value of a candidate at a depth; NaN where it has none. */
double judge_value_at(const judge_candidate *c, judge_depth at);

/** Whether `out` may be a window depth, anywhere from lo to hi and beyond the planes, that was clamped to its range. */
bool judge_clamps(const judge_candidate *c, double lo, double hi, double out);

/** Whether it explains a pair with so much precision lost. */
bool judge_fits_pair(const judge_candidate *c, const judge_pairs *p, judge_precision precision, const judge_pair *pair);

/** Whether it explains all of them; of codes, and of digits in bytes, only where that tells something. */
bool judge_fits(const judge_candidate *c, const judge_pairs *p, judge_precision precision);

/** The input at which two candidates part most, by the most of a value; NaN where they never do. */
double judge_parts(const judge_candidate *a, const judge_candidate *b, const judge_pairs *p, judge_precision precision);

/** Whether two that never part have different names worth telling: those of one camera by chance, or of one set-up, or
 * a multiple of eye depth that is known as a slip. */
bool judge_is_another(const judge_candidate *a, const judge_candidate *b, const judge_pairs *p);

#endif
