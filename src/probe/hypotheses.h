/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file hypotheses.h  All that a probe may find, in words: what judges count, and what profiles are written with. */
#ifndef PROBE_HYPOTHESES_H
#define PROBE_HYPOTHESES_H

#include <stddef.h>

#include "probe/probe.h"

typedef enum probe_key {
    KEY_STORED = 0,
    KEY_ROUNDING,
    KEY_DIVISION,
    KEY_PROJECTION,
    KEY_CLIPPING,
    KEY_SUBNORMAL,
    KEY_INVARIANCE,
    KEY_LOG2,
    KEY_QUOTIENT,
    KEY_COVERAGE,
    KEY_PLANE,
    KEY_RASTERIZER,
    KEY_PREDICTION,
    KEY_BIAS,
    KEY_FRACTION,
    KEY_SLOPE,
    PROBE_KEYS
} probe_key;

/** Where the words begin of a key that is asked otherwise of some: of clip z from -w to w, of fp32. */
enum { DIVISION_SIGNED = 3, BIAS_REAL = 3 };

/** "rounding"; null beyond the last key. */
const char *probe_key_name(probe_key key);

/** The hypothesis of that number, null where there are fewer; of KEY_STORED, KEY_INVARIANCE and KEY_PREDICTION what is
 * said, of KEY_LOG2 and KEY_QUOTIENT what is measured. It stays until the next call. */
const char *probe_hypothesis(probe_key key, size_t i);

/** The unit of what is measured of a key: "ulp"; "" of none. */
const char *probe_unit(probe_key key, size_t i);

/** Whether hypotheses of it are counted: the words are those of the nearest where none holds, which they say. */
bool probe_key_counts(probe_key key);

#define PROBE_NEAREST "nothing known; nearest: "
#define PROBE_OR      "; or "

#endif
