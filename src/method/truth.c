/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "method/truth.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "zfight/census.h"

/* Twice the value of the boundary below a code, exact: half-way to the code before it. */
static long double boundary(const dp_format *f, uint32_t code, bool above) {
    if (f->kind == DP_FORMAT_UNORM)
        return 2.0L * code + (above ? 1 : -1);
    uint32_t other = above ? code + 1 : code - 1;
    return (long double)dp_format_value(f, code) + (long double)dp_format_value(f, other);
}

double truth_width(const dp_setup *setup, uint32_t code, bool *cut) {
    const dp_format *f = &setup->spec.format;
    const long double n = (long double)setup->spec.znear, zfar = (long double)setup->spec.zfar;
    const long double unit = f->kind == DP_FORMAT_UNORM ? 2.0L * f->code_max : 2.0L; /* of twice the value */
    *cut = code == 0 || code == f->code_max;
    long double d1 = code == 0 ? 0 : boundary(f, code, false),
                d2 = code == f->code_max ? unit : boundary(f, code, true);
    const long double width = (d2 - d1) / unit;
    if (setup->curve == DP_CURVE_LINEAR)
        return (double)((zfar - n) * width);
    const long double phi = isinf(setup->spec.zfar) ? 0 : n / zfar, q1 = (unit - d1) / unit, q2 = (unit - d2) / unit;
    d1 /= unit;
    d2 /= unit;
    const long double den1 = setup->reversed ? d1 + phi * q1 : phi * d1 + q1;
    const long double den2 = setup->reversed ? d2 + phi * q2 : phi * d2 + q2;
    const long double rest = isinf(setup->spec.zfar) ? 1 : (zfar - n) / zfar;
    return den1 * den2 > 0 ? (double)(n * rest * width / (den1 * den2)) : (double)INFINITY;
}

static double widest(const dp_setup *setup, uint32_t first, uint32_t last) {
    double most = 0;
    bool cut;
    for (uint32_t code = first; code <= last; code++)
        most = fmax(most, truth_width(setup, code, &cut));
    return most;
}

double truth_worst(const dp_setup *setup, uint32_t first, uint32_t last) {
    enum { EACH = 1 << 17, ABOUT = 2 };
    const dp_format *f = &setup->spec.format;
    if (last - first < EACH)
        return widest(setup, first, last);
    double most = fmax(widest(setup, first, first + ABOUT), widest(setup, last - ABOUT, last));
    for (uint32_t power = 1; f->kind == DP_FORMAT_FLOAT && power << f->mantissa_bits <= f->code_max; power++) {
        const uint32_t at = power << f->mantissa_bits;
        if (at > first + ABOUT && at < last - ABOUT)
            most = fmax(most, widest(setup, at - ABOUT, at + ABOUT));
    }
    return most;
}

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
