/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file parallel.h  Large arrays on several threads. The bits do not depend on their number. */
#ifndef TESTS_PARALLEL_H
#define TESTS_PARALLEL_H

#include "depthprec/batch.h"

/**
 * dp_batch_run() on `threads` threads, or on as many as OpenMP would take when 0. Arrays too small to be worth it stay
 * on one, and so do arrays in place whose elements shrink, because the pieces would overlap.
 */
void parallel_batch(const dp_batch *batch, const void *in, void *out, size_t count, int threads);

#endif
