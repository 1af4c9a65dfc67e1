/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "shader/sample_rounding.h"

#include <math.h>

#include "core/clones.h"
#include "core/engine.h"

enum { GRAIN_ROW = 256 };

const char *grain_rounding_name(grain_rounding rounding) {
    static const char *const names[] = {"unknown", "nearest", "zero"};
    return names[rounding];
}

/* Numbers that the buffer may have held, in units of 1/den. */
typedef struct span {
    double lo, hi, den;
} span;

/* The unit in the last place of a number of so many bits. */
static double unit_of(const grain *g, double v) {
    int exponent;
    frexp(v, &exponent);
    return v > 0 ? fmax(ldexp(1, exponent - g->bits), g->least) : g->least;
}

double grain_number_gap(const grain *g, double v) {
    return g->kind == GRAIN_STEPS ? 1 / g->steps : unit_of(g, v);
}

/* Each binade above the least has half as many as all below it together. */
double grain_numbers_below(const grain *g, double v) {
    const double gap = grain_number_gap(g, v), whole = ceil(v / gap * (1 - DP_ROUNDINGS_510));
    return g->kind == GRAIN_STEPS ? whole : whole + ldexp(ilogb(gap / g->least), g->bits - 1);
}

/* Steps that were rounded to numbers may have been the next ones. */
static span steps_span_of(const grain *g, double steps, double v) {
    const double blur = g->bits > 0 ? floor(0.5 + 1.5 * unit_of(g, v) * steps) : 0;
    const double first = rint(v * steps) - blur, last = rint(v * steps) + blur;
    const double cut = first * (steps / (steps + 1)) * (1 - DP_ROUNDINGS_6);
    const double below[] = {[GRAIN_ANY] = fmin(first - 0.5, cut), [GRAIN_NEAREST] = first - 0.5, [GRAIN_ZERO] = first};
    const double above[] = {[GRAIN_ANY] = last + 1, [GRAIN_NEAREST] = last + 0.5, [GRAIN_ZERO] = last + 1};
    const double margin = g->margin * steps, down = first - below[g->rounding], up = above[g->rounding] - last;
    return (span){first - (g->mirrored ? up : down) - margin, last + (g->mirrored ? down : up) + margin, steps};
}

static span steps_span(const grain *g, double v) {
    const span s = steps_span_of(g, g->steps, v);
    span all = {s.lo / s.den, s.hi / s.den, 1};
    if (g->own == 0 && g->whole == 0)
        return s;
    const double others[] = {g->own, g->whole > 0 ? g->whole + 1 : 0};
    for (int i = 0; i < 2; i++) {
        const span other = steps_span_of(g, others[i], v);
        if (others[i] > 0)
            all = (span){fmin(all.lo, other.lo / other.den), fmax(all.hi, other.hi / other.den), 1};
    }
    if (g->whole > 0)
        all = (span){fmin(all.lo, s.lo / g->whole), fmax(all.hi, s.hi / g->whole), 1};
    return all;
}

static span floats_span(const grain *g, double v) {
    const double unit = unit_of(g, v);
    const double below[] = {[GRAIN_ANY] = 0.5, [GRAIN_NEAREST] = 0.5, [GRAIN_ZERO] = 0};
    const double above[] = {[GRAIN_ANY] = 1, [GRAIN_NEAREST] = 0.5, [GRAIN_ZERO] = 1};
    return (span){v - below[g->rounding] * unit - g->margin, v + above[g->rounding] * unit + g->margin, 1};
}

double grain_level_gap(const grain *g, double v) {
    int exponent;
    frexp(v / g->level, &exponent);
    return g->levels == GRAIN_HALF ? ldexp(g->level, exponent > -13 ? exponent - 11 : -24) : g->level;
}

/* A depth that was rounded to multiples of a step, or cut off, before the file rounded it. */
static span between_span(const grain *g, span s) {
    const double below[] = {[GRAIN_ANY] = 0.5, [GRAIN_NEAREST] = 0.5, [GRAIN_ZERO] = 0};
    const double above[] = {[GRAIN_ANY] = 1, [GRAIN_NEAREST] = 0.5, [GRAIN_ZERO] = 1};
    return (span){s.lo - below[g->rounding] * g->between * s.den, s.hi + above[g->rounding] * g->between * s.den,
                  s.den};
}

/* A depth lies at most a step from its level, on either side: cut-off numbers of binary16 lie above theirs,
 * which way others were cut is not known. */
static span level_span(const grain *g, span s) {
    const double half = g->levels == GRAIN_HALF ? 0.5 : 1;
    const double below[] = {[GRAIN_ANY] = half, [GRAIN_NEAREST] = 0.5, [GRAIN_ZERO] = 0};
    const double above[] = {[GRAIN_ANY] = 1, [GRAIN_NEAREST] = 0.5, [GRAIN_ZERO] = 1};
    const double lo = s.lo / s.den, hi = s.hi / s.den;
    const double down = below[g->rounding] * grain_level_gap(g, lo), up = above[g->rounding] * grain_level_gap(g, hi);
    if (g->levels != GRAIN_INVERSE)
        return (span){lo - down, hi + up, 1};
    const double least = 1 / hi - down;
    return (span){1 / (1 / fmax(lo, 0) + up), least > 0 ? 1 / least : (double)INFINITY, 1};
}

/* The numbers that a sample may have been, where there is no buffer. */
static span sample_span(const grain *g, double v) {
    const span s = between_span(g, g->kind == GRAIN_STEPS ? steps_span(g, v) : floats_span(g, v));
    return g->levels == GRAIN_FINE ? s : level_span(g, s);
}

/*
 * Codes of UNORM came back as a quotient, or as a product with the rounded reciprocal, which may be a neighbour of
 * that: within 1.5 units, and the code was taken that is nearest to it. Binary16 was made of something finer, perhaps
 * cut off.
 */
double grain_quotient_units(const grain *g) {
    return g->bits > 11 ? 1.5 : 1;
}

double grain_quotient_codes(const grain *g, const dp_format *format, double v) {
    return floor(0.5 + grain_quotient_units(g) * unit_of(g, v) * format->code_max);
}

/* The outermost codes whose numbers are in the span. */
static void codes_within(const dp_format *format, span s, uint32_t code, uint32_t *first, uint32_t *last) {
    const double lo = s.lo / s.den * (1 - DP_ROUNDINGS_6), hi = s.hi / s.den * (1 + DP_ROUNDINGS_6);
    *first = dp_format_encode(format, DP_ROUND_ZERO, lo);
    *last = dp_format_encode(format, DP_ROUND_ZERO, hi);
    if (dp_format_value(format, *first) < lo)
        ++*first;
    if (*first > code)
        *first = code;
    if (*last < code)
        *last = code;
}

static void codes_of(const dp_setup *setup, const grain *g, uint32_t code, uint32_t *first, uint32_t *last) {
    const dp_format *format = &setup->spec.format;
    const double v = dp_format_value(format, code);
    *first = *last = code;
    if (g == NULL || g->kind == GRAIN_CODES)
        return;
    if (g->kind == GRAIN_FLOATS && format->kind == DP_FORMAT_UNORM) {
        const double around = grain_quotient_codes(g, format, v);
        *first = code > around ? code - (uint32_t)around : 0;
        *last = code + around < format->code_max ? code + (uint32_t)around : format->code_max;
    } else {
        codes_within(format, g->kind == GRAIN_STEPS ? steps_span(g, v) : floats_span(g, v), code, first, last);
    }
}

/* From the boundary below the first code to that above the last one; window depth ends at 0 and 1. */
static void boundaries(const dp_setup *setup, const grain *g, uint32_t code, dp_point *below, dp_point *above) {
    const dp_format *format = &setup->spec.format;
    const dp_rounding rounding = setup->spec.rounding;
    uint32_t first, last;
    codes_of(setup, g, code, &first, &last);
    *below = first > 0 ? dp_point_below(format, rounding, first) : dp_point_of_code(format, 0);
    *above = last < format->code_max ? dp_point_below(format, rounding, last + 1)
                                     : dp_point_of_code(format, format->code_max);
}

/* Whether ranges end on boundaries of the format. */
static bool is_of_codes(const grain *g) {
    return g == NULL || g->kind == GRAIN_CODES || g->buffer;
}

/* The window depths that became a code. */
static void ends_of(const dp_setup *setup, const grain *g, uint32_t code, dp_point *below, dp_point *above) {
    if (is_of_codes(g)) {
        boundaries(setup, g, code, below, above);
        return;
    }
    const span s = sample_span(g, dp_format_value(&setup->spec.format, code));
    *below = dp_point_make(fmax(s.lo, 0), s.den);
    *above = dp_point_make(fmin(s.hi, s.den), s.den);
}

double grain_window_reach(const dp_setup *setup, const grain *g, uint32_t code) {
    const dp_point own = dp_point_of_code(&setup->spec.format, code);
    dp_point below, above;
    ends_of(setup, g, code, &below, &above);
    const double to_below = is_of_codes(g) ? own.num - below.num : own.num / own.den * below.den - below.num;
    const double to_above = is_of_codes(g) ? above.num - own.num : above.num - own.num / own.den * above.den;
    return fmax(to_below / below.den, to_above / above.den) * GRAIN_OUTWARD;
}

grain_points grain_points_of(const dp_setup *setup, const grain *g, uint32_t code) {
    dp_point below, above;
    ends_of(setup, g, code, &below, &above);
    return (grain_points){dp_point_of_code(&setup->spec.format, code), setup->reversed ? above : below,
                          setup->reversed ? below : above};
}

grain_range grain_range_of(const dp_setup *setup, const grain *g, uint32_t code) {
    const grain_points p = grain_points_of(setup, g, code);
    if (g != NULL && g->levels != GRAIN_FINE && p.to_far.num >= p.to_far.den)
        return (grain_range){dp_curve_eye(setup, p.to_near), (double)INFINITY, (double)INFINITY};
    return (grain_range){
        .lo = dp_curve_eye(setup, p.to_near),
        .hi = dp_curve_eye(setup, p.to_far),
        .reach = fmax(dp_curve_span(setup, p.to_near, p.own), dp_curve_span(setup, p.own, p.to_far)) * GRAIN_OUTWARD,
    };
}

/* ---- Many at a time ---------------------------------------------------------------------------------------------- */

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

/* The value of a code of a binary floating-point format, as dp_float_value(). */
DP_INLINE double float_value(uint32_t code, int mantissa, int bias) {
    const uint32_t field = code >> mantissa, fraction = code & ((1U << mantissa) - 1U);
    const uint32_t whole = field == 0 ? fraction : fraction | 1U << mantissa;
    const uint64_t exponent = (uint64_t)((field == 0 ? 1U : field) + 1023U - (uint32_t)(bias + mantissa));
    return (double)(int32_t)whole * dp_float64(exponent << 52);
}

/* Numerators of a code, of the boundary below the first code and of that above the last. */
typedef struct numerators {
    double own[GRAIN_ROW], below[GRAIN_ROW], above[GRAIN_ROW];
} numerators;

DP_INLINE void ranges_loop(const ranging r, const numerators *restrict n, size_t count, double *restrict stored,
                           double *restrict lo, double *restrict hi, double *restrict reach) {
    for (size_t i = 0; i < count; i++) {
        const double to_near = r.reversed ? n->above[i] : n->below[i], to_far = r.reversed ? n->below[i] : n->above[i];
        const double own = n->own[i], near = eye_of(&r, to_near), at = eye_of(&r, own), far = eye_of(&r, to_far);
        const double before = span_of(&r, to_near, own, near * at), behind = span_of(&r, own, to_far, at * far);
        stored[i] = at;
        lo[i] = near;
        hi[i] = far;
        reach[i] = (before > behind ? before : behind) * GRAIN_OUTWARD;
    }
}

CLONES static void ranges_in_vectors(const ranging *r, const numerators *n, size_t count, double *stored, double *lo,
                                     double *hi, double *reach) {
    if (r->infinite && r->reversed)
        ranges_loop(ranging_like(r, true, true), n, count, stored, lo, hi, reach);
    else if (r->infinite)
        ranges_loop(ranging_like(r, false, true), n, count, stored, lo, hi, reach);
    else if (r->reversed)
        ranges_loop(ranging_like(r, true, false), n, count, stored, lo, hi, reach);
    else
        ranges_loop(ranging_like(r, false, false), n, count, stored, lo, hi, reach);
}

/* Each code by itself, rounded to nearest. */
CLONES static void float_numerators(const dp_format *format, const uint32_t *restrict codes, size_t count,
                                    numerators *restrict n) {
    const int mantissa = format->mantissa_bits, bias = format->bias;
    const uint32_t most = format->code_max;
    for (size_t i = 0; i < count; i++) {
        const uint32_t code = codes[i] <= most ? codes[i] : 0;
        const uint32_t before = code > 0 ? code - 1 : 0, behind = code < most ? code + 1 : most;
        const double own = float_value(code, mantissa, bias);
        n->own[i] = own;
        n->below[i] = 0.5 * (float_value(before, mantissa, bias) + own);
        n->above[i] = 0.5 * (own + float_value(behind, mantissa, bias));
    }
}

CLONES static void unorm_numerators(const dp_format *format, const uint32_t *restrict codes, size_t count,
                                    numerators *restrict n) {
    const uint32_t most = format->code_max;
    for (size_t i = 0; i < count; i++) {
        const uint32_t code = codes[i] <= most ? codes[i] : 0;
        const double own = 2.0 * (double)(int32_t)code;
        n->own[i] = own;
        n->below[i] = own - (code > 0 ? 1 : 0);
        n->above[i] = own + (code < most ? 1 : 0);
    }
}

/* As many codes on either side, which all of a binade have in common. */
static void around_numerators(const dp_format *format, const grain *g, const uint32_t *codes, size_t count,
                              numerators *n) {
    const double most = format->code_max;
    double around = 0;
    uint64_t last = UINT64_MAX;
    for (size_t i = 0; i < count; i++) {
        const double code = codes[i] <= format->code_max ? codes[i] : 0, v = code / most;
        const uint64_t binade = dp_bits64(v) >> 52;
        if (binade != last)
            around = grain_quotient_codes(g, format, v);
        last = binade;
        n->own[i] = 2 * code;
        n->below[i] = code > around ? 2 * (code - around) - 1 : 0;
        n->above[i] = code + around < most ? 2 * (code + around) + 1 : 2 * most;
    }
}

static void numerators_of(const dp_setup *setup, const grain *g, const uint32_t *codes, size_t count, numerators *n) {
    const dp_format *format = &setup->spec.format;
    const bool alone = (g == NULL || g->kind == GRAIN_CODES) && setup->spec.rounding != DP_ROUND_ZERO;
    if (alone && format->bits < 32) {
        (format->kind == DP_FORMAT_UNORM ? unorm_numerators : float_numerators)(format, codes, count, n);
        return;
    }
    if (g != NULL && g->kind == GRAIN_FLOATS && format->kind == DP_FORMAT_UNORM &&
        setup->spec.rounding != DP_ROUND_ZERO) {
        around_numerators(format, g, codes, count, n);
        return;
    }
    for (size_t i = 0; i < count; i++) {
        const uint32_t code = codes[i] <= format->code_max ? codes[i] : 0;
        dp_point below, above;
        boundaries(setup, g, code, &below, &above);
        n->own[i] = dp_point_of_code(format, code).num;
        n->below[i] = below.num;
        n->above[i] = above.num;
    }
}

static void one_by_one(const dp_setup *setup, const grain *g, const uint32_t *codes, size_t count,
                       const grain_rows *out) {
    for (size_t i = 0; i < count; i++) {
        const bool again = i > 0 && codes[i] == codes[i - 1]; /* neighbours often share a code */
        const uint32_t code = codes[i] <= setup->spec.format.code_max ? codes[i] : 0;
        const grain_range range =
            again ? (grain_range){out->lo[i - 1], out->hi[i - 1], out->reach[i - 1]} : grain_range_of(setup, g, code);
        out->stored[i] = again ? out->stored[i - 1] : dp_stored(setup, code);
        out->lo[i] = range.lo;
        out->hi[i] = range.hi;
        out->reach[i] = range.reach;
    }
}

void grain_ranges_of(const dp_setup *setup, const grain *g, const uint32_t *codes, size_t count,
                     const grain_rows *out) {
    if (setup->curve != DP_CURVE_PERSPECTIVE || setup->ranged || !is_of_codes(g)) {
        one_by_one(setup, g, codes, count, out);
        return;
    }
    const ranging r = ranging_of(setup);
    numerators n;
    for (size_t i = 0; i < count; i += GRAIN_ROW) {
        const size_t some = count - i < GRAIN_ROW ? count - i : GRAIN_ROW;
        numerators_of(setup, g, codes + i, some, &n);
        ranges_in_vectors(&r, &n, some, out->stored + i, out->lo + i, out->hi + i, out->reach + i);
    }
}
