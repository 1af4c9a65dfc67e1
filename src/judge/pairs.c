/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "judge/pairs.h"

#include <math.h>
#include <stdlib.h>

#include "shader/half.h"

static int by_input(const void *a, const void *b) {
    const double x = ((const judge_pair *)a)->in, y = ((const judge_pair *)b)->in;
    return (x > y) - (x < y);
}

/* Printed with fewer digits, too, as long as these tell such numbers from others. */
static bool is_half(double v, const judge_digits *digits) {
    const double near = isfinite(v) ? (double)half_of((float)v) : v;
    return v == near || fabs(v - near) <= fmin(digits->absolute + digits->relative * fabs(v), 0x1p-15 * fabs(near));
}

void judge_pairs_look(judge_pairs *p) {
    p->half = p->bytes = p->whole = p->shares = true;
    if (p->count > 1) /* none: no array either */
        qsort(p->pairs, p->count, sizeof *p->pairs, by_input);
    for (size_t i = 0; i < p->count; i++) {
        const double v = p->pairs[i].out, k = v * 255;
        p->distinct += i == 0 || p->pairs[i].in != p->pairs[i - 1].in;
        p->half = p->half && is_half(v, &p->out_digits);
        p->bytes = p->bytes && v >= 0 && v <= 1 && fabs(k - rint(k)) <= 1e-3;
        p->whole = p->whole && v == floor(v);
        p->shares = p->shares && v >= 0 && v <= 1.01;
    }
}

void judge_pairs_free(judge_pairs *pairs) {
    free(pairs->pairs);
    pairs->pairs = NULL;
}
