/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "requirement/measure.h"

#include <math.h>
#include <stdbool.h>

#include "core/engine.h"

/* Half a step in closed form from the whole one: what dp_separation() adds up in the model staged. */
static double half_of(const dp_setup *setup, double z, double s) {
    return setup->curve == DP_CURVE_PERSPECTIVE ? s * z / (2.0 * z + s)
           : setup->curve == DP_CURVE_LINEAR    ? 0.5 * s
                                                : s / (1.0 + sqrt(1.0 + s / (z - setup->anchor + 1.0 / setup->log_c)));
}

/*
 * What the error at z can be, however z is aligned to the codes: half a step behind z, where the midpoint before the
 * code that lies there may be. Truncated codes are those of lower d: a step before z, or behind it when reversed.
 */
static double error_at(const dp_setup *setup, double z) {
    const dp_format *format = &setup->spec.format;
    const bool truncates = setup->spec.rounding == DP_ROUND_ZERO;
    if (setup->spec.model == DP_MODEL_STAGED) {
        const double s = dp_separation(setup, z);
        return truncates || isinf(s) ? s : half_of(setup, z, s) * (1.0 + 0x1p-50);
    }
    const bool is_float = format->kind == DP_FORMAT_FLOAT;
    const double step =
        is_float ? ldexp(1.0, (int)measure_field(setup, z) - format->bias - format->mantissa_bits) : 1.0;
    const double den = (is_float ? 1.0 : (double)format->code_max) * (truncates ? 1.0 : 2.0);
    const bool before = truncates && !setup->reversed;
    return fabs(dp_curve_ahead(setup, before ? -step : step, den, z)) * dp_curve_outward(setup);
}

double measure_at(measure_kind kind, const dp_setup *setup, double z) {
    return kind == MEASURE_SEPARATION ? dp_separation(setup, z) : error_at(setup, z);
}

/* The code of z truncated: exact, so its exponent field tells on which side of a power of two d(z) lies. */
static uint32_t truncated(const dp_setup *setup, double z, dp_setup *floor) {
    *floor = *setup;
    floor->spec.rounding = DP_ROUND_ZERO;
    floor->spec.model = DP_MODEL_EXACT;
    if (!(z > setup->spec.znear && z < setup->spec.zfar)) { /* the codes of the planes are others, too */
        const dp_spec spec = floor->spec;
        dp_setup_init(floor, &spec);
    }
    return dp_code(floor, z);
}

uint32_t measure_field(const dp_setup *setup, double z) {
    const dp_format *format = &setup->spec.format;
    if (format->kind == DP_FORMAT_UNORM)
        return 0;
    dp_setup floor;
    const uint32_t code = truncated(setup, z, &floor);
    uint32_t field = code >> format->mantissa_bits;
    /* Towards d = 1 a step from beyond the last value of a binade ends in the next one, where it is twice as long. */
    if (!setup->reversed && (code + 1) >> format->mantissa_bits > field && dp_error(&floor, code, z) != 0.0)
        field++;
    return field > 1 ? field : 1;
}

double measure_threshold(const dp_setup *setup, uint32_t field) {
    const uint32_t code = field << setup->spec.format.mantissa_bits;
    return dp_format_value(&setup->spec.format, setup->reversed ? code : code - 1);
}

/* The last depth, going away, whose step is that of `field`; it lies inside [lo, hi]. Reversed only. */
static double last_of_field(const dp_setup *setup, uint32_t field, double lo, double hi) {
    const double d = measure_threshold(setup, field);
    double z = fmin(fmax(dp_eye(setup, d, 1.0 - d), lo), hi);
    while (z > lo && measure_field(setup, z) < field)
        z = nextafter(z, 0.0);
    while (z < hi) {
        const double next = nextafter(z, HUGE_VAL);
        if (measure_field(setup, next) < field)
            break;
        z = next;
    }
    return z;
}

/* Under a reversed perspective the steps of a FLOAT shrink towards far: the only case where the inside counts. */
static int has_inside(const dp_setup *setup) {
    return setup->spec.format.kind == DP_FORMAT_FLOAT && setup->reversed && setup->curve == DP_CURVE_PERSPECTIVE;
}

double measure_governing(const dp_setup *setup, double lo, double hi) {
    return setup->reversed && setup->curve == DP_CURVE_LINEAR ? lo : hi;
}

/*
 * At the last depth of a binade h = (1 - z/f) 2^-M, whatever near is; z h / (1 - h) is largest at
 * z/f = r/(1 + r) with r = sqrt(1 - 2^-M).
 */
double measure_summit(measure_kind kind, const dp_setup *setup, double lo, double hi) {
    if (!has_inside(setup) || isinf(setup->spec.zfar))
        return hi;
    const int whole = kind == MEASURE_SEPARATION || setup->spec.rounding == DP_ROUND_ZERO;
    const double r = sqrt(1.0 - ldexp(whole ? 1.0 : 0.5, -setup->spec.format.mantissa_bits));
    return fmin(fmax(setup->spec.zfar * (r / (1.0 + r)), lo), hi);
}

static measure_worst worst_at(measure_kind kind, const dp_setup *setup, double z) {
    return (measure_worst){measure_at(kind, setup, z), z};
}

void measure_parts(measure_kind kind, const dp_setup *setup, double lo, double hi, measure_worst *falling,
                   measure_worst *rising) {
    *falling = worst_at(kind, setup, measure_governing(setup, lo, hi));
    *rising = (measure_worst){0.0, lo};
    if (!(lo < hi) || isinf(hi) || !has_inside(setup))
        return;
    const uint32_t first = measure_field(setup, lo);
    const uint32_t last = measure_field(setup, hi);
    const uint32_t middle = measure_field(setup, measure_summit(kind, setup, lo, hi));
    if (middle > last) {
        const measure_worst w = worst_at(kind, setup, last_of_field(setup, middle, lo, hi));
        if (w.value > falling->value)
            *falling = w;
    }
    if (middle < first)
        *rising = worst_at(kind, setup, last_of_field(setup, middle + 1, lo, hi));
}

measure_worst measure_over(measure_kind kind, const dp_setup *setup, double lo, double hi) {
    measure_worst falling;
    measure_worst rising;
    measure_parts(kind, setup, lo, hi, &falling, &rising);
    return rising.value > falling.value || (rising.value == falling.value && rising.z < falling.z && rising.value > 0.0)
               ? rising
               : falling;
}
