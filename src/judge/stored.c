/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "judge/stored.h"

#include <math.h>

#include "core/bits.h"

enum { BYTE = 255 };

/* ---- Numbers ----------------------------------------------------------------------------------------------------- */

/* The last of the ten bits behind the first; subnormal numbers have no more than those of 2^-14. */
static double half_step(double v) {
    return ldexp(1, (fabs(v) < 0x1p-14 ? -14 : ilogb(v)) - 10);
}

void stored_half(double *lo, double *hi) {
    static const double most = 65504;
    const bool flushed = fmax(fabs(*lo), fabs(*hi)) < 0x1p-14;
    if (isfinite(*lo))
        *lo = *lo > most ? most : floor(*lo / half_step(*lo)) * half_step(*lo);
    if (isfinite(*hi))
        *hi = *hi < -most ? -most : ceil(*hi / half_step(*hi)) * half_step(*hi);
    *lo = *lo < -most ? -(double)INFINITY : flushed ? fmin(*lo, 0) : *lo;
    *hi = *hi > most ? (double)INFINITY : flushed ? fmax(*hi, 0) : *hi;
}

void stored_bytes(bool cut, double *lo, double *hi) {
    *lo -= (cut ? 1.001 : 0.51) / BYTE;
    *hi += (cut ? 0.001 : 0.51) / BYTE;
}

/* As 1/x with x = 1/v: the estimate is y (2 - x y) of one whose bits are a number less those of x. It is continuous. */
static double quotient(int steps, double v) {
    const double x = 1 / fabs(v);
    double y = (double)dp_float32(0x7ef311c7u - dp_bits32((float)x));
    for (int i = 0; i < steps; i++)
        y = y * (2 - x * y);
    return copysign(y, v);
}

void stored_quotient(int steps, double *lo, double *hi) {
    static const double small = 0x1p-22; /* roundings */
    const double a = quotient(steps, *lo), b = quotient(steps, *hi);
    *lo = fmin(a, b) - small * fabs(a);
    *hi = fmax(a, b) + small * fabs(b);
}

/* ---- Digits ------------------------------------------------------------------------------------------------------ */

typedef struct digits {
    int count;
    bool cut;
    enum { LAST_REST, LAST_WHOLE, LAST_LESS } last;
    double written, read, unit, scale; /* the bases; a digit k is the byte k unit/base; what is read is multiplied */
} digits;

static digits digits_of(int way) {
    return (digits){.count = 4 - way % 3,
                    .cut = way / 3 % 2 != 0,
                    .written = way / 6 % 2 == 0 ? 256 : BYTE,
                    .read = way / 12 % 2 == 0 ? 256 : BYTE,
                    .unit = way / 24 % 2 == 0 ? BYTE : 256,
                    .scale = way / 48 % 2 == 0 ? 1 : 255.0 / 256,
                    .last = (unsigned)way / 96};
}

/* As shaders do it: fract(v (1, 256, ...)), less the next digit over 256, of the last one itself, or nothing. A byte
 * halfway between two may be either. */
static void read_back(const digits *d, double v, double *least, double *most) {
    const double unsure = 0x1p-10;
    double weight = d->scale / BYTE, lo = 0, hi = 0;
    for (int i = 0; i < d->count; i++, weight /= d->read) {
        const double rest = v - floor(v), next = rest * d->written;
        const double less = i + 1 < d->count || d->last == LAST_WHOLE ? next - floor(next)
                            : d->last == LAST_LESS                    ? rest
                                                                      : 0;
        const double digit = rest - less / d->written;
        const double byte = digit * d->unit + (d->cut ? 0 : 0.5);
        lo += weight * fmin(fmax(floor(byte - unsure), 0), BYTE);
        hi += weight * fmin(fmax(floor(byte + unsure), 0), BYTE);
        v = next;
    }
    *least = fmin(*least, lo * (1 - 0x1p-22));
    *most = fmax(*most, hi * (1 + 0x1p-22));
}

void stored_digits(int way, double *lo, double *hi) {
    const digits d = digits_of(way);
    const double at[] = {*lo, 0.5 * (*lo + *hi), *hi};
    const bool inside = *hi >= 0 && *lo <= 1;
    *lo = (double)INFINITY;
    *hi = -(double)INFINITY;
    for (int i = 0; i < 3 && inside; i++) {
        read_back(&d, fmin(fmax(at[i], 0), 1), lo, hi);
        if (at[i] >= 1) /* where it does not become 0 */
            read_back(&d, 1 - 0x1p-40, lo, hi);
    }
}

bool stored_digits_lose(int way) {
    static const double some = 0.31, other = 0.73, small = 0x1p-20;
    double a = some, b = some, c = other, d = other;
    stored_digits(way, &a, &b);
    stored_digits(way, &c, &d);
    return b - a < small && d - c < small && (fabs(a - some) > small || fabs(c - other) > small);
}

const char *stored_digits_name(int way) {
    const digits d = digits_of(way);
    return d.written != d.read                  ? "digits that are written of one base and read of another, in bytes"
           : d.written == 256 && d.unit == BYTE ? "digits k/256 in bytes n/255"
           : d.written == 256                   ? "digits n/255 in bytes, read as k/256"
                                                : "digits k/255 in bytes n/255";
}
