/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "texture/sensor_buffer.h"

#include <math.h>

#include "core/elementary.h"

enum { DIGITS_MOST = 3, FAR_EXPONENT = 6, EXPONENT_LEAST = -12 };

static const double RARE = 0x1p-20; /* one in a million */

static const int all_bits[] = {16, 24};

/* A search for planes that have at most so many digits. */
typedef struct attempt {
    const sensor *s;
    double lo;
    int digits;
    double chance; /* how many planes of a random lattice would do */
    int matches;
    sensor_buffer last;
} attempt;

static double power_of_10(int exponent) {
    double power = 1;
    for (int i = 0; i < exponent; i++)
        power *= 10;
    return power;
}

/* k 10^exponent, rounded once. */
static double decimal(double k, int exponent) {
    return exponent < 0 ? k / power_of_10(-exponent) : k * power_of_10(exponent);
}

/* The nearest number of so many digits, and how far apart these are there. */
static double nearest(double z, int digits, double *apart) {
    const int exponent = (int)floor(dp_log10(z)) - digits + 1;
    *apart = decimal(1, exponent);
    return decimal(rint(decimal(z, -exponent)), exponent);
}

static void try_far(attempt *a, double zfar) {
    const sensor *s = a->s;
    const double inverse = 1 / zfar, index = rint((inverse - s->offset) / s->step);
    const double level_off = s->offset_off + fabs(index) * s->step_off;
    const double off = fabs(s->offset + index * s->step - inverse);
    for (size_t i = 0; i < sizeof all_bits / sizeof all_bits[0]; i++) {
        const double span = ldexp(1, all_bits[i]) - 1, at = 1 / (inverse + span * s->step);
        const double near_off = at * at * (span * s->step_off + 0x1p-50 / at);
        double apart;
        if (!(at > decimal(1, EXPONENT_LEAST)))
            continue;
        const double znear = nearest(at, a->digits, &apart);
        a->chance += fmin(2 * level_off / s->step, 1) * fmin(2 * near_off / apart, 1);
        if (off > level_off || fabs(znear - at) > near_off || znear > a->lo + near_off)
            continue;
        a->matches++;
        a->last =
            (sensor_buffer){all_bits[i], znear, zfar, near_off, isinf(zfar) ? (double)NAN : level_off * zfar * zfar};
    }
}

bool sensor_buffer_find(const sensor *s, double lo, double hi, sensor_buffer *out) {
    *out = (sensor_buffer){.bits = 0};
    if (!s->found || s->row->levels != GRAIN_INVERSE || !(hi > decimal(1, EXPONENT_LEAST)))
        return false;
    for (int digits = 1; digits <= DIGITS_MOST && out->bits == 0; digits++) {
        attempt a = {.s = s, .lo = lo, .digits = digits};
        const int least = (int)power_of_10(digits - 1);
        try_far(&a, (double)INFINITY);
        for (int exponent = (int)floor(dp_log10(hi)) - digits + 1; exponent < FAR_EXPONENT - digits + 1; exponent++)
            for (int k = least; k < 10 * least; k++)
                if (decimal(k, exponent) * (1 + 0x1p-20) >= hi)
                    try_far(&a, decimal(k, exponent));
        if (!(a.chance < RARE))
            return false;
        if (a.matches == 1) /* of several there are as many with more digits */
            *out = a.last;
    }
    return out->bits > 0;
}
