/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file resolved.h  How far a set-up goes: the depths up to which three common separations are guaranteed. */
#ifndef QUANTITY_CMD_RESOLVED_H
#define QUANTITY_CMD_RESOLVED_H

#include "camera/cmd/setups.h"
#include "report/number.h"

enum { RESOLVED_LIMITS = 3, RESOLVED_MIDDLE = 1, RESOLVED_DIGITS = 3, RESOLVED_TEXT_SIZE = 256 };

/** A separation: 1 mm, 1 cm or 10 cm in that unit, or so many parts of a metre in scene units where it is null. */
double resolved_limit(size_t i, const unit_row *unit);
number_text resolved_limit_text(size_t i, const unit_row *unit);

/** For dp_setup_guaranteed(): the depth up to which each separation is guaranteed; NaN: not even at near. */
void resolved_up_to(const dp_setup *full, const unit_row *unit, double up_to[RESOLVED_LIMITS]);

/** "82800 m", "the far plane" where nothing is beyond it, rounded to the safe side; the unit may be null. @return out
 */
const char *resolved_text(double zfar, double up_to, const unit_row *unit, char out[RESOLVED_TEXT_SIZE]);

#endif
