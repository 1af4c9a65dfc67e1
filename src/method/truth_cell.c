/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cells in long double, which is what makes it the truth; software of its own where the processor has none. */
#include <math.h>

#include "method/truth.h"

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
