/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file biased.h  A bias in a requirement file: bias = { api = "gl"; units = -2; factor = -1; }. */
#ifndef SOLVE_BIASED_H
#define SOLVE_BIASED_H

#include "bias/verdict.h"
#include "solve/reader.h"

/** Reads the group into n->bias and n->goal; n has camera and range. */
bool reader_bias(reader *r, setting *group, need *n);

/** Judges it facing the camera and, where the camera has a viewport, for its slope or at any slant; *setup is that of
 * the answer, which is the first that is not "enough", and *sloped whether it is of the slope. */
bias_verdict need_bias(const need *n, const dp_setup *asked, dp_setup *setup, bool *sloped);

#endif
