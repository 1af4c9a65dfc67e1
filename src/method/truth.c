/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "method/truth.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "zfight/census.h"

double truth_step(double z) {
    float x = (float)z;
    return (double)nextafterf(x, INFINITY) - (double)x;
}

bool truth_window(const dp_setup *setup, double z, double *lo, double *hi) {
    enum { LEAST = 1 << 12, MOST = 1 << 15 };
    dp_budget b = {0};
    dp_budget_at(setup, z, NULL, &b);
    const double step = truth_step(z), most = MOST * truth_step(z / 2);
    double reach = fmin(fmax(8 * b.separation, LEAST * step), most);
    *lo = fmax(z - reach, setup->spec.znear);
    *hi = fmin(z + reach, setup->spec.zfar);
    return 8 * b.separation <= most;
}

/* codes[i] of every depth, and the greatest code (in the order of depth) so far tells which later depth is no better.
 */
double truth_longest(const dp_setup *setup, double lo, double hi, double least) {
    dp_pipeline p;
    const uint64_t count = census_count(lo, hi);
    if (count < 2 || dp_pipeline_init(&p, setup) != DP_OK)
        return least;
    int64_t *key = malloc(2 * count * sizeof *key);
    if (key == NULL)
        return (double)NAN;
    int64_t *rest = key + count;
    float first = (float)lo;
    if ((double)first < lo)
        first = nextafterf(first, INFINITY);
    float z = first;
    for (uint64_t i = 0; i < count; i++, z = nextafterf(z, INFINITY))
        key[i] = p.reversed ? -(int64_t)dp_pipeline_code(&p, z) : (int64_t)dp_pipeline_code(&p, z);
    for (uint64_t i = count; i-- > 0;)
        rest[i] = i + 1 < count && rest[i + 1] < key[i] ? rest[i + 1] : key[i];
    double longest = least;
    uint64_t end = 0;
    for (uint64_t i = 0; i < count; i++) {
        end = end < i ? i : end;
        while (end + 1 < count && rest[end + 1] <= key[i])
            end++;
        longest = fmax(longest, (double)dp_float32(dp_bits32(first) + (uint32_t)end) -
                                    (double)dp_float32(dp_bits32(first) + (uint32_t)i));
    }
    free(key);
    return longest;
}

method_error truth_off(double got, double want, double step) {
    const double off = fabs(got - want);
    if (got == want)
        return (method_error){0, 0, 0};
    if (!(off < (double)INFINITY))
        return (method_error){(double)INFINITY, (double)INFINITY, (double)INFINITY};
    return (method_error){off, off / want, off / step};
}

method_error truth_error(const method_row *row, double got, double want) {
    const double least = want * (1 - METHOD_ROUNDING), most = want * (1 + METHOD_ROUNDING);
    const bool wrong =
        ((row->domain & METHOD_ABOVE) != 0 && got < least) || ((row->domain & METHOD_BELOW) != 0 && got > most);
    return truth_off(wrong ? (double)NAN : got, want, nextafter(want, DBL_MAX) - want);
}
