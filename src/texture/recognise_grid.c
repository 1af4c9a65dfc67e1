/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Images that hold less than their samples could: 8 bits repeated in 16, ten bits scaled to 16, k/255 as numbers, bits
 * shifted up.
 */
#include <math.h>

#include "core/bits.h"
#include "texture/recognise.h"
#include "texture/recognise_lattice.h"

enum { BITS_LEAST = 8, BITS_MOST = 16 };

/* How far a sample near d may lie beside the grid, in steps of it: integers half a code, numbers 1.5 units. */
static double tolerance(const grid_source *s, double d, double steps) {
    int exponent;
    if (s->top > 0)
        return 0.5 * (1 + 0x1p-20) * steps / s->top;
    frexp(d, &exponent);
    return 1.5 * ldexp(1, exponent - s->bits) * steps;
}

/* -log2 of the chance; negative when one is off. */
static double agreement(const distinct_set *set, const grid_source *s, double steps, bool shifted) {
    double bits = 0;
    for (size_t i = 0; i < set->size; i++) {
        const double d = dp_float64(set->slots[i]); /* empty slots are NaN */
        if (!(d > 0 && d < 1))
            continue;
        const double k = d * steps, most = shifted ? 0x1p-20 : tolerance(s, d, steps);
        if (fabs(k - rint(k)) > most)
            return -1;
        bits -= fmin(log2(s->top > 0 ? steps / s->top : 2 * most), 0);
    }
    return bits;
}

double grid_agreement(const distinct_set *set, const grid_source *s, double steps) {
    return agreement(set, s, steps, false);
}

static bool better(grid *best, const distinct_set *set, const grid_source *s, double steps, bool shifted) {
    if (!(steps < s->finest))
        return false;
    const double bits = agreement(set, s, steps, shifted);
    if (!(bits > 0))
        return false;
    *best = (grid){steps, bits};
    return true;
}

grid grid_find(const distinct_set *set, const grid_source *s) {
    grid best = {0};
    if (set->slots == NULL || set->count == 0 || set->count >= RECOGNISE_DISTINCT_MAX)
        return best;
    if (agreement(set, s, 1, false) >= 0) /* nothing but 0 and 1: any number of bits */
        return (grid){ldexp(1, BITS_LEAST) - 1, 0};
    for (int n = BITS_LEAST; n <= BITS_MOST; n++) {
        const double power = ldexp(1, n);
        if (better(&best, set, s, power - 1, false))
            break;
        if ((!s->dyadic || n == BITS_LEAST) && better(&best, set, s, power, false))
            break;
        if (s->top > power && better(&best, set, s, s->top / exp2(ceil(log2(s->top + 1)) - n), true))
            break;
    }
    return best;
}
