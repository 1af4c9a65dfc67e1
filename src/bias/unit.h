/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file unit.h  The worth of one unit of a bias, in window depth, before a depth is known: by its exponent alone. */
#ifndef BIAS_UNIT_H
#define BIAS_UNIT_H

#include "bias/bias.h"

/** The exponent of the binary32 number nearest to d, not below the lowest that numbers of the format have. */
int bias_exponent_of(const dp_format *format, double d);

/** r before anything multiplies it, of a primitive whose greatest window depth has the exponent e. */
double bias_worth(const bias_api *api, const dp_format *format, int e);

/** bias_unit's `least`, likewise. */
double bias_unit_least(const bias_api *api, const dp_format *format, int e);

#endif
