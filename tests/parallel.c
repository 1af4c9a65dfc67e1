/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "parallel.h"

#ifdef _OPENMP
#include <omp.h>
#endif

/* A piece takes some 10 us, far above what it costs to hand it out, and stays in the second cache. */
enum { PIECE = 32768 };

void parallel_batch(const dp_batch *batch, const void *in, void *out, size_t count, int threads) {
    const size_t pieces = (count + PIECE - 1) / PIECE;
#ifdef _OPENMP
    const int wanted = threads > 0 ? threads : omp_get_max_threads();
#else
    const int wanted = 1;
    (void)threads;
#endif
    if (pieces < 2 || wanted < 2 || (in == out && batch->in_size != batch->out_size)) {
        dp_batch_run(batch, in, out, count);
        return;
    }
#pragma omp parallel for schedule(static) num_threads(wanted)
    for (size_t i = 0; i < pieces; i++) {
        const size_t first = i * PIECE;
        const size_t some = count - first < PIECE ? count - first : PIECE;
        dp_batch_run(batch, (const char *)in + first * batch->in_size, (char *)out + first * batch->out_size, some);
    }
}
