/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file limit.h  Loops that move the bytes of a family's inputs and outputs, called as its methods are. */
#ifndef METHOD_LIMIT_H
#define METHOD_LIMIT_H

#include "method/method.h"

method_run limit_depths;  /**< z to value */
method_run limit_ranges;  /**< z and hi to value */
method_run limit_windows; /**< d to eye */
method_run limit_codes;   /**< d to code */
method_run limit_places;  /**< d to places */
method_run limit_eyes;    /**< eye to places */

#endif
