/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file grain_loops.h  For grain.c and grain_error.c: what their loops are made of. */
#ifndef TEXTURE_GRAIN_LOOPS_H
#define TEXTURE_GRAIN_LOOPS_H

#include "core/engine.h"

/* Perspective set-ups alone: the operations of dp_curve_eye() and dp_curve_span(), in their order. */
typedef struct ranging {
    double top, den, znear, zfar, kappa; /* top: of the quotient that is the eye depth */
    bool reversed, infinite;
} ranging;

static inline ranging ranging_of(const dp_setup *setup) {
    const dp_spec *spec = &setup->spec;
    const bool infinite = isinf(spec->zfar) != 0;
    const double den = dp_point_den(&spec->format), top = infinite ? spec->znear : spec->znear * spec->zfar;
    return (ranging){top * den, den, spec->znear, spec->zfar, setup->kappa, setup->reversed != 0, infinite};
}

/* With what does not change in a loop as constants: so it becomes vectors. */
DP_INLINE ranging ranging_like(const ranging *r, bool reversed, bool infinite) {
    return (ranging){r->top, r->den, r->znear, r->zfar, r->kappa, reversed, infinite};
}

DP_INLINE double eye_of(const ranging *r, double num) {
    const double comp = r->den - num, to_near = r->reversed ? num : comp, to_far = r->reversed ? comp : num;
    return r->top / (r->infinite ? to_near : r->zfar * to_near + r->znear * to_far);
}

DP_INLINE double span_of(const ranging *r, double a, double b, double eyes) {
    const double step = fabs(b - a) / r->den;
    return step == 0 ? 0 : eyes * (step * r->kappa);
}

/* Of a binary floating-point format, as dp_float_value(). */
DP_INLINE double float_value(uint32_t code, int mantissa, int bias) {
    const uint32_t field = code >> mantissa, fraction = code & ((1U << mantissa) - 1U);
    const uint32_t whole = field == 0 ? fraction : fraction | 1U << mantissa;
    const uint64_t exponent = (uint64_t)((field == 0 ? 1U : field) + 1023U - (uint32_t)(bias + mantissa));
    return (double)(int32_t)whole * dp_float64(exponent << 52);
}

#endif
