/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file known.h  GPUs whose profiles are known, and where another one differs from them. */
#ifndef PROBE_CMD_PROBE_KNOWN_H
#define PROBE_CMD_PROBE_KNOWN_H

#include "probe/probe.h"

enum { KNOWN_TEXT_SIZE = PROBE_WORDS_SIZE + 64 };

typedef struct known_difference {
    char finding[32], expected[KNOWN_TEXT_SIZE], got[KNOWN_TEXT_SIZE]; /**< "bias d16" */
} known_difference;

typedef struct known_comparison {
    char name[2 * SHOT_NAME_SIZE + 2];
    size_t compared, differ; /**< findings of both */
    known_difference difference[PROBE_FINDINGS_MAX];
} known_comparison;

/** The profile of a GPU that is known, as brief.h reads it; null beyond the last. */
const char *known_get(size_t i);

/** Compares what was found with that GPU's. @return false beyond the last */
bool known_compare(size_t i, const probe_result *r, known_comparison *out);

#endif
