/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "judge/pairs.h"

#include <math.h>
#include <stdlib.h>

#include "shader/half.h"

static int by_input(const void *a, const void *b) {
    const double x = ((const judge_pair *)a)->in, y = ((const judge_pair *)b)->in;
    return (x > y) - (x < y);
}

void judge_pairs_look(judge_pairs *p) {
    bool half = true, bytes = true;
    if (p->count > 1) /* none: no array either */
        qsort(p->pairs, p->count, sizeof *p->pairs, by_input);
    for (size_t i = 0; i < p->count; i++) {
        const double v = p->pairs[i].out, k = v * 255;
        p->distinct += i == 0 || p->pairs[i].in != p->pairs[i - 1].in;
        half = half && (!isfinite(v) || half_of((float)v) == (float)v);
        bytes = bytes && v >= 0 && v <= 1 && fabs(k - rint(k)) <= 1e-3;
    }
    p->half = half;
    p->bytes = bytes;
}

void judge_pairs_free(judge_pairs *pairs) {
    free(pairs->pairs);
    pairs->pairs = NULL;
}
