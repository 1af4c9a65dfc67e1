/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file limits.h  What no bias does, and where. */
#ifndef BIAS_LIMITS_H
#define BIAS_LIMITS_H

#include "bias/bias.h"

/** A bias, and where it is used. */
typedef struct bias_use {
    const dp_setup *setup;
    const bias_state *state;
    bool slanted;  /**< surfaces at any slant are asked about */
    bool infinite; /**< infinite units were asked for */
    double lo, hi; /**< eye depths, hi finite */
} bias_use;

typedef struct bias_limit {
    NAMED_FIELDS;
    const char *said;                     /**< in a line, where it applies */
    bool (*applies)(const bias_use *use); /**< null: to every bias */
} bias_limit;

NAMED_ROWS(bias_limit, bias_limit);

/** Whether a fragment shader may write the depth, which no API then biases: not an orthographic one, which is
 * interpolated. */
bool bias_is_missed(const dp_setup *setup);

#endif
