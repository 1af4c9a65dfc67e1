/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file reference_pipeline.h  A second binary32 pipeline, written from depthprec(7) alone, for runs of depths.
 *
 * It shares nothing with the library but the public specification of a set-up. Codes come out as *keys*: numbers in
 * the order of the codes, complemented where the mapping is reversed, so that a correct buffer has rising keys with
 * distance. Two depths have the same key exactly if they have the same code.
 */
#ifndef TESTS_REFERENCE_PIPELINE_H
#define TESTS_REFERENCE_PIPELINE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "depthprec/setup.h"

enum { REFERENCE_CHUNK = 1024 };

typedef struct reference_pipe {
    float a, b; /**< z_clip = A z + B */
    bool ortho, reversed;
    bool fused;
    dp_reciprocal reciprocal;
    bool remap;    /**< signed NDC is moved to [0, 1] before the divide */
    bool viewport; /**< signed NDC is moved to [0, 1] after it */
    bool flush;    /**< subnormal eye depths and results of operations become 0 */
    dp_conversion conversion;
    dp_rounding rounding;
    dp_format format;
} reference_pipe;

/** The pipeline of a set-up; mappings with a pipeline only. */
reference_pipe reference_pipe_make(const dp_setup *setup, bool flush);

/** The keys of `count` binary32 depths that follow each other, the first having the rank `first`: see reference.h. */
void reference_keys(const reference_pipe *p, uint32_t first, size_t count, uint32_t *keys);

/** The key of one depth. */
uint32_t reference_key(const reference_pipe *p, uint32_t rank);

/** The window depth before the clamp. */
float reference_window(const reference_pipe *p, uint32_t rank);

/** The code that a key stands for. */
uint32_t reference_code(const reference_pipe *p, uint32_t key);

/** Whether this depth or an operation on it is a subnormal number, so that flushing may matter. */
bool reference_subnormal(const reference_pipe *p, uint32_t rank);

#endif
