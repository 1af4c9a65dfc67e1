/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file limit.h  Loops that move the bytes of a family's inputs and outputs, called as its methods are. */
#ifndef METHOD_LIMIT_H
#define METHOD_LIMIT_H

#include "method/method.h"

typedef void limit_run(const dp_setup *setup, const void *state, const method_inputs *in, const method_outputs *out);

limit_run limit_depths;  /**< z to value */
limit_run limit_ranges;  /**< z and hi to value */
limit_run limit_windows; /**< d to eye */
limit_run limit_codes;   /**< d to code */
limit_run limit_places;  /**< d to places */
limit_run limit_eyes;    /**< eye to places */

#endif
