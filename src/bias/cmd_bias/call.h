/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file call.h  A bias as a program writes it. */
#ifndef BIAS_CMD_BIAS_CALL_H
#define BIAS_CMD_BIAS_CALL_H

#include "bias/bias.h"
#include "report/number.h"

enum { BIAS_CALL_SIZE = 128 };

/** The call that sets a bias, "glPolygonOffset(0, -1528)". Lives until the statement ends. */
typedef struct bias_call_text {
    char text[BIAS_CALL_SIZE];
} bias_call_text;

bias_call_text bias_call(const bias_api *api, double units, double factor);

/** The same of units and factor in words, "U" and "F"; without what a factor adds where that is "0". */
bias_call_text bias_call_of(const bias_api *api, const char *units, const char *factor);

/** Units in nine digits or, on the safe side, in fewer. */
number_text bias_short(double units);

/** The units of bias_needed(), with the sign that brings a layer nearer; NaN where none are enough. */
double bias_signed(const dp_setup *setup, double units);

#endif
