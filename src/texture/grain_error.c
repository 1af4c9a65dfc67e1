/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How far depths can be off in 1/z: one by one for any grain, in vectors where samples are codes of a perspective. */
#include <math.h>

#include "texture/clones.h"
#include "texture/grain.h"
#include "texture/grain_loops.h"

enum { BLOCK = 256 };

double grain_range_error(const dp_setup *setup, double stored, double lo, double hi, double reading) {
    if (setup->spec.ortho)
        return fmax(stored - lo, hi - stored) + reading * stored;
    const double w = 1 / stored; /* 0 at an infinite far plane */
    return fmax(1 / lo - w, w - 1 / hi) + reading * w;
}

double grain_error_of(const dp_setup *setup, const grain *g, double z, double reading) {
    const grain_range own = grain_range_of(setup, g, dp_code(setup, z));
    const double at[3] = {z, own.lo, own.hi};
    double worst = 0;
    for (int i = 0; i < 3; i++) {
        const uint32_t code = dp_code(setup, at[i]);
        const grain_range range = grain_range_of(setup, g, code);
        worst = fmax(worst, grain_range_error(setup, dp_stored(setup, code), range.lo, range.hi, reading));
    }
    return worst;
}

/* ---- In vectors -------------------------------------------------------------------------------------------------- */

/*
 * On which side of a boundary lies the depth that it was rounded to? The sign of p den (q - z) +- z num (f - n), as
 * dp_curve_gap() has it, in pairs of doubles: each product and sum there loses a few units of 2^-104 of p den z.
 */
typedef struct siding {
    dp_pair scale, width; /* p den, f - n; without a far plane 1 */
    double from;          /* q; without a far plane and reversed 1 stands in the place of q - z */
} siding;

static siding siding_of(const ranging *r) {
    const dp_pair one = {1, 0};
    if (r->infinite)
        return (siding){dp_two_product(r->reversed ? r->znear : 1, r->den), one, r->znear};
    return (siding){dp_two_product(r->reversed ? r->znear : r->zfar, r->den), dp_two_sum(r->zfar, -r->znear),
                    r->reversed ? r->zfar : r->znear};
}

DP_INLINE dp_pair pair_sum(double a, double b) {
    const double s = a + b, t = s - a;
    return (dp_pair){s, (a - (s - t)) + (b - t)};
}

DP_INLINE dp_pair pair_product(dp_pair a, dp_pair b) {
    const double p = a.hi * b.hi;
    return (dp_pair){p, __builtin_fma(a.hi, b.hi, -p) + (a.hi * b.lo + a.lo * b.hi)};
}

/* Positive: the boundary lies behind z. *doubt: no sign, or one that may be wrong. */
DP_INLINE double side_of(const siding *s, const ranging *r, double num, double z, int64_t *doubt) {
    const dp_pair away = pair_sum(s->from, -z), one = {1, 0};
    const dp_pair a = pair_product(s->scale, r->infinite && r->reversed ? one : away);
    const dp_pair b = pair_product(pair_product((dp_pair){z, 0}, (dp_pair){num, 0}), s->width);
    const double sign = r->reversed ? -1 : 1;
    const dp_pair sum = pair_sum(a.hi, sign * b.hi);
    const double side = sum.hi + (sum.lo + (a.lo + sign * b.lo));
    *doubt |= !(fabs(side) > 0x1p-98 * (fabs(b.hi) + fabs(s->scale.hi) * z));
    return side;
}

DP_INLINE double error_of(double stored, double lo, double hi, double reading) {
    const double w = 1 / stored, before = 1 / lo - w, behind = w - 1 / hi;
    return (before > behind ? before : behind) + reading * w;
}

/* Numerators of the codes and boundaries round a code, from below. */
typedef struct around {
    double code[3][BLOCK], boundary[4][BLOCK];
} around;

TEXTURE_CLONES static void around_unorm(const dp_format *format, const uint32_t *restrict codes, size_t count,
                                        around *restrict a) {
    const double most = 2.0 * format->code_max;
    for (size_t i = 0; i < count; i++) {
        const double own = 2.0 * (double)(int32_t)codes[i];
        a->code[0][i] = own - 2;
        a->code[1][i] = own;
        a->code[2][i] = own + 2;
        a->boundary[0][i] = own - 3 > 0 ? own - 3 : 0;
        a->boundary[1][i] = own - 1;
        a->boundary[2][i] = own + 1;
        a->boundary[3][i] = own + 3 < most ? own + 3 : most;
    }
}

TEXTURE_CLONES static void around_float(const dp_format *format, const uint32_t *restrict codes, size_t count,
                                        around *restrict a) {
    const int mantissa = format->mantissa_bits, bias = format->bias;
    const uint32_t most = format->code_max;
    for (size_t i = 0; i < count; i++) {
        const uint32_t code = codes[i];
        double value[5];
        for (uint32_t k = 0; k < 5; k++) {
            const uint32_t at = code + k < 2 ? 0 : code + k - 2;
            value[k] = float_value(at < most ? at : most, mantissa, bias);
        }
        for (int k = 0; k < 3; k++)
            a->code[k][i] = value[k + 1];
        for (int k = 0; k < 4; k++)
            a->boundary[k][i] = 0.5 * (value[k] + value[k + 1]);
    }
}

/* The code's own error, and those of its neighbours where the ends of its range, rounded, are theirs. In doubt where
 * that cannot be told: at the ends of window depth, and where cells are hardly wider than the roundings. */
DP_INLINE void errors_loop(const ranging r, const siding *s, const around *restrict a, double reading, size_t count,
                           double *restrict error, int64_t *restrict doubts) {
    const int before = r.reversed ? 2 : 0, behind = 2 - before, lowest = r.reversed ? 3 : 0, step = r.reversed ? -1 : 1;
    for (size_t i = 0; i < count; i++) {
        const double end0 = eye_of(&r, a->boundary[lowest][i]), lo = eye_of(&r, a->boundary[lowest + step][i]);
        const double hi = eye_of(&r, a->boundary[lowest + 2 * step][i]);
        const double end3 = eye_of(&r, a->boundary[lowest + 3 * step][i]);
        const double own = error_of(eye_of(&r, a->code[1][i]), lo, hi, reading);
        const double near = error_of(eye_of(&r, a->code[before][i]), end0, lo, reading);
        const double far = error_of(eye_of(&r, a->code[behind][i]), hi, end3, reading);
        int64_t doubt = !(lo > r.znear && hi < r.zfar && hi - lo > 0x1p-45 * hi && a->code[0][i] >= 0);
        const double at_lo = side_of(s, &r, a->boundary[lowest + step][i], lo, &doubt);
        const double at_hi = side_of(s, &r, a->boundary[lowest + 2 * step][i], hi, &doubt);
        const double worse = at_lo > 0 && near > own ? near : own;
        error[i] = at_hi < 0 && far > worse ? far : worse;
        doubts[i] = doubt;
    }
}

TEXTURE_CLONES static void errors_in_vectors(const ranging *r, const siding *s, const around *a, double reading,
                                             size_t count, double *error, int64_t *doubts) {
    if (r->infinite && r->reversed)
        errors_loop(ranging_like(r, true, true), s, a, reading, count, error, doubts);
    else if (r->infinite)
        errors_loop(ranging_like(r, false, true), s, a, reading, count, error, doubts);
    else if (r->reversed)
        errors_loop(ranging_like(r, true, false), s, a, reading, count, error, doubts);
    else
        errors_loop(ranging_like(r, false, false), s, a, reading, count, error, doubts);
}

/* ---- Numbers that were codes of UNORM: see codes_of() of grain.c ------------------------------------------------- */

typedef struct quotients {
    double most;  /* code_max */
    double units; /* in the last place, by which a number may be off */
    double least; /* subnormal */
    int bits;
} quotients;

/* How many codes on either side the number of a code may have been. */
DP_INLINE double codes_beside(const quotients *q, double code) {
    const double v = code / q->most;
    const uint64_t exponent = v > 0 ? (dp_bits64(v) >> 52) - 1022 : 0;
    const double unit = dp_float64((exponent + 1023 - (uint64_t)q->bits) << 52);
    return floor(0.5 + q->units * (unit > q->least ? unit : q->least) * q->most);
}

DP_INLINE double number_error(const ranging *r, const quotients *q, double code, double reading) {
    const double beside = codes_beside(q, code), first = code - beside, last = code + beside;
    const double below = first > 0 ? 2 * first - 1 : 0, above = last < q->most ? 2 * last + 1 : 2 * q->most;
    return error_of(eye_of(r, 2 * code), eye_of(r, r->reversed ? above : below), eye_of(r, r->reversed ? below : above),
                    reading);
}

DP_INLINE void numbers_loop(const ranging r, const siding *s, const quotients *q, const uint32_t *restrict codes,
                            double reading, size_t count, double *restrict error, int64_t *restrict doubts) {
    for (size_t i = 0; i < count; i++) {
        const double code = (double)(int32_t)codes[i], beside = codes_beside(q, code);
        const double first = code - beside, last = code + beside;
        const double near_end = r.reversed ? 2 * last + 1 : 2 * first - 1;
        const double far_end = r.reversed ? 2 * first - 1 : 2 * last + 1;
        const double lo = eye_of(&r, near_end), hi = eye_of(&r, far_end), outwards = r.reversed ? 1 : -1;
        int64_t doubt = !(lo > r.znear && hi < r.zfar && hi - lo > 0x1p-42 * hi && first > 1 && last + 1 < q->most);
        const double at_lo = side_of(s, &r, near_end, lo, &doubt);
        const double at_hi = side_of(s, &r, far_end, hi, &doubt);
        const double nearest = r.reversed ? last : first, farthest = r.reversed ? first : last;
        const double own = number_error(&r, q, code, reading);
        const double near = number_error(&r, q, at_lo > 0 ? nearest + outwards : nearest, reading);
        const double far = number_error(&r, q, at_hi < 0 ? farthest - outwards : farthest, reading);
        const double worse = near > own ? near : own;
        error[i] = far > worse ? far : worse;
        doubts[i] = doubt;
    }
}

TEXTURE_CLONES static void numbers_in_vectors(const ranging *r, const siding *s, const quotients *q,
                                              const uint32_t *codes, double reading, size_t count, double *error,
                                              int64_t *doubts) {
    if (r->reversed)
        numbers_loop(ranging_like(r, true, false), s, q, codes, reading, count, error, doubts);
    else
        numbers_loop(ranging_like(r, false, false), s, q, codes, reading, count, error, doubts);
}

static bool are_numbers(const dp_setup *setup, const grain *g) {
    return setup->curve == DP_CURVE_PERSPECTIVE && !isinf(setup->spec.zfar) && g != NULL && g->kind == GRAIN_FLOATS &&
           g->buffer && setup->spec.format.kind == DP_FORMAT_UNORM && setup->spec.rounding == DP_ROUND_NEAREST;
}

static bool in_vectors(const dp_setup *setup, const grain *g) {
    return setup->curve == DP_CURVE_PERSPECTIVE && (g == NULL || g->kind == GRAIN_CODES) &&
           setup->spec.rounding == DP_ROUND_NEAREST && setup->spec.format.bits < 32;
}

/* A depth's error is its code's. */
static void one_by_one(const dp_setup *setup, const grain *g, const double *z, const uint32_t *codes, size_t count,
                       double reading, grain_memo *memo, double *out) {
    for (size_t i = 0; i < count; i++) {
        const size_t slot = codes[i] % GRAIN_MEMO;
        if (!(z[i] >= setup->spec.znear && z[i] <= setup->spec.zfar))
            continue; /* many are beyond the planes at borders */
        if (memo == NULL || memo->code[slot] != codes[i] + 1) {
            out[i] = grain_error_of(setup, g, z[i], reading);
            if (memo == NULL)
                continue;
            memo->code[slot] = codes[i] + 1;
            memo->error[slot] = out[i];
        }
        out[i] = memo->error[slot];
    }
}

static void finish_doubts(const dp_setup *setup, const grain *g, const double *z, const uint32_t *codes,
                          const int64_t *doubts, size_t count, double reading, grain_memo *memo, double *out) {
    for (size_t i = 0; i < count; i++)
        if (doubts[i] != 0 || codes[i] == 0 || codes[i] == setup->spec.format.code_max)
            one_by_one(setup, g, z + i, codes + i, 1, reading, memo, out + i);
}

void grain_errors_of(const dp_setup *setup, const grain *g, const double *z, size_t count, double reading,
                     grain_memo *memo, double *out) {
    const dp_format *format = &setup->spec.format;
    const bool vectors = in_vectors(setup, g), numbers = are_numbers(setup, g);
    const quotients q = {format->code_max, numbers && g->bits > 11 ? 1.5 : 1, numbers ? g->least : 0,
                         numbers ? g->bits : 0};
    const ranging r = ranging_of(setup);
    const siding s = siding_of(&r);
    dp_batch batch;
    dp_batch_init(&batch, setup, DP_TASK_CODE, DP_REAL_DOUBLE, DP_WORD_32, dp_path_best()); /* a checked set-up */
    for (size_t first = 0; first < count; first += BLOCK) {
        const size_t some = count - first < BLOCK ? count - first : BLOCK;
        uint32_t codes[BLOCK];
        int64_t doubts[BLOCK];
        dp_batch_run(&batch, z + first, codes, some);
        if (vectors) {
            around a;
            if (format->kind == DP_FORMAT_UNORM)
                around_unorm(format, codes, some, &a);
            else
                around_float(format, codes, some, &a);
            errors_in_vectors(&r, &s, &a, reading, some, out + first, doubts);
        } else if (numbers) {
            numbers_in_vectors(&r, &s, &q, codes, reading, some, out + first, doubts);
        } else {
            one_by_one(setup, g, z + first, codes, some, reading, memo, out + first);
            continue;
        }
        finish_doubts(setup, g, z + first, codes, doubts, some, reading, memo, out + first);
    }
}
