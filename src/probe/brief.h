/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file brief.h  A profile in a few hundred characters, as a link carries it.
 *
 *     NAME~DRIVER~API~8~mesa~llvmpipe~a0s1_b0s1...    8w: clip z from -w to w; a finding is its key, format, certainty,
 *                                                     and which hypotheses
 */
#ifndef PROBE_BRIEF_H
#define PROBE_BRIEF_H

#include "probe/probe.h"

enum { BRIEF_SIZE = 2048 };

/** Writes the chosen device and what was found of it, in characters that an address needs not escape but blanks and
 * commas; others of its name become '?'. */
void brief_write(const probe_result *r, char out[BRIEF_SIZE]);

/**
 * Reads it: what a report says. A finding that is sure has no cases, and none has the hypothesis that comes next.
 * @param formats  what the device calls its formats; null: not known
 * @param r        to be freed by probe_free()
 * @return false with a sentence in `error`
 */
bool brief_read(const char *text, const char *const formats[SHOT_FORMATS], probe_result *r,
                char error[SHOT_ERROR_SIZE]);

#endif
