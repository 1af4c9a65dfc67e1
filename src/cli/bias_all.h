/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file bias_all.h  The bias that is needed, in the terms of every API. */
#ifndef CLI_BIAS_ALL_H
#define CLI_BIAS_ALL_H

#include "cli/options.h"

enum { BIAS_CALL_SIZE = 128 };

/** What a program writes to set a bias, "glPolygonOffset(0, -1528)". Lives until the statement ends. */
typedef struct bias_call_text {
    char text[BIAS_CALL_SIZE];
} bias_call_text;

bias_call_text bias_call(const bias_api *api, double units, double factor);

/** What bias_needed() gives, with the sign that brings a layer nearer; NaN where none is enough. */
double bias_signed(const dp_setup *setup, double units);

/** Writes it for the depths of --at, or the range. @return an exit status */
int bias_all_write(const options *o);

#endif
