/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file reach.h  How far a set-up goes: the depths up to which three common separations are guaranteed. */
#ifndef CLI_REACH_H
#define CLI_REACH_H

#include "cli/options.h"
#include "report/number.h"

enum { REACH_LIMITS = 3, REACH_MIDDLE = 1, REACH_DIGITS = 3, REACH_TEXT_SIZE = 256 };

/** A separation: 1 mm, 1 cm or 10 cm in that unit, or so many parts of a metre in scene units where it is null. */
double reach_limit(size_t i, const unit_row *unit);
number_text reach_limit_text(size_t i, const unit_row *unit);

/** The same set-up in another model. */
dp_setup reach_in(const dp_setup *setup, dp_model model);

/** Of dp_setup_guaranteed(): the depth up to which each separation is guaranteed; NaN: not even at near. */
void reach_of(const dp_setup *full, const unit_row *unit, double up_to[REACH_LIMITS]);

/** "82800 m", "the far plane" where nothing is beyond it, rounded to the safe side; the unit may be null. @return out
 */
const char *reach_text(double zfar, double up_to, const unit_row *unit, char out[REACH_TEXT_SIZE]);

#endif
