/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "oracle.h"

#include <math.h>
#include <string.h>

/* ---- formats ---- */

dp_format oracle_unorm(int bits) {
    dp_format format = {.kind = DP_FORMAT_UNORM, .bits = bits, .code_max = (uint32_t)((UINT64_C(1) << bits) - 1)};
    snprintf(format.name, sizeof format.name, "unorm%d", bits);
    return format;
}

dp_format oracle_float(int exponent_bits, int mantissa_bits, int bias) {
    dp_format format = {.kind = DP_FORMAT_FLOAT,
                        .bits = exponent_bits + mantissa_bits,
                        .exponent_bits = exponent_bits,
                        .mantissa_bits = mantissa_bits,
                        .bias = bias,
                        .code_max = (uint32_t)bias << mantissa_bits};
    snprintf(format.name, sizeof format.name, "float%d.%db%d", exponent_bits, mantissa_bits, bias);
    return format;
}

/* x 2^power */
static void scale_q(mpq_t x, long power) {
    if (power >= 0)
        mpq_mul_2exp(x, x, (mp_bitcnt_t)power);
    else
        mpq_div_2exp(x, x, (mp_bitcnt_t)-power);
}

void oracle_value(mpq_t value, const dp_format *format, uint32_t code) {
    if (format->kind == DP_FORMAT_UNORM) {
        mpq_set_ui(value, code, format->code_max);
        mpq_canonicalize(value);
        return;
    }
    int m = format->mantissa_bits;
    uint32_t exponent = code >> m, fraction = code & ((1u << m) - 1);
    if (exponent == 0)
        exponent = 1;
    else
        fraction += 1u << m;
    mpq_set_ui(value, fraction, 1);
    scale_q(value, (long)exponent - format->bias - m);
}

void oracle_boundary(mpq_t boundary, const dp_format *format, dp_rounding rounding, uint32_t code) {
    oracle_value(boundary, format, code);
    if (rounding == DP_ROUND_ZERO)
        return;
    mpq_t below;
    mpq_init(below);
    oracle_value(below, format, code - 1);
    mpq_add(boundary, boundary, below);
    scale_q(boundary, -1);
    mpq_clear(below);
}

/* num/den rounded to an integer. */
static uint64_t round_quotient(const mpz_t num, const mpz_t den, dp_rounding rounding, int ties_up) {
    mpz_t quotient, remainder;
    mpz_inits(quotient, remainder, NULL);
    mpz_fdiv_qr(quotient, remainder, num, den);
    uint64_t code = mpz_get_ui(quotient);
    if (rounding != DP_ROUND_ZERO) {
        mpz_mul_2exp(remainder, remainder, 1);
        int order = mpz_cmp(remainder, den);
        code += order > 0 || (order == 0 && (ties_up || (code & 1)));
    }
    mpz_clears(quotient, remainder, NULL);
    return code;
}

/* floor(log2(num/den)), num > 0 */
static long floor_log2(const mpz_t num, const mpz_t den) {
    long e = (long)mpz_sizeinbase(num, 2) - (long)mpz_sizeinbase(den, 2); /* within one: 2^(e-1) < num/den < 2^(e+1) */
    mpz_t t;
    mpz_init(t);
    if (e >= 0) {
        mpz_mul_2exp(t, den, (mp_bitcnt_t)e);
        e -= mpz_cmp(num, t) < 0;
    } else {
        mpz_mul_2exp(t, num, (mp_bitcnt_t)-e);
        e -= mpz_cmp(t, den) < 0;
    }
    mpz_clear(t);
    return e;
}

uint32_t oracle_round(const dp_format *format, dp_rounding rounding, const mpz_t num, const mpz_t den) {
    if (mpz_sgn(num) <= 0)
        return 0;
    if (mpz_cmp(num, den) >= 0)
        return format->code_max;
    mpz_t t;
    mpz_init(t);
    uint64_t code;
    if (format->kind == DP_FORMAT_UNORM) {
        mpz_mul_ui(t, num, format->code_max);
        code = round_quotient(t, den, rounding, rounding == DP_ROUND_NEAREST);
    } else {
        long e = floor_log2(num, den), lowest = 1 - format->bias;
        if (e < lowest)
            e = lowest;
        long power = format->mantissa_bits - e; /* e < 0, so this is positive: the step is 2^-power */
        mpz_mul_2exp(t, num, (mp_bitcnt_t)power);
        code = round_quotient(t, den, rounding, 0) + ((uint64_t)(e - lowest) << format->mantissa_bits);
    }
    mpz_clear(t);
    return (uint32_t)code;
}

uint32_t oracle_encode(const dp_format *format, dp_rounding rounding, double d) {
    if (!(d > 0))
        return 0;
    if (d >= 1)
        return format->code_max;
    mpq_t x;
    mpq_init(x);
    mpq_set_d(x, d);
    uint32_t code = oracle_round(format, rounding, mpq_numref(x), mpq_denref(x));
    mpq_clear(x);
    return code;
}

/* ---- mappings ---- */

/* The argument of the logarithm, of the depth in o->x: C z + 1, C (z - n) + 1 or z/n. */
static void argument(oracle *o) {
    if (o->over_near) {
        mpfr_div_d(o->x, o->x, o->spec.znear, MPFR_RNDN);
        return;
    }
    if (o->from_near)
        mpfr_sub_d(o->x, o->x, o->spec.znear, MPFR_RNDN);
    mpfr_mul(o->x, o->x, o->log_c, MPFR_RNDN);
    mpfr_add_ui(o->x, o->x, 1, MPFR_RNDN);
}

static int is_moved(const dp_spec *spec) {
    const double *range = spec->depth_range;
    return (range[0] != 0 || range[1] != 0) && (range[0] != 0 || range[1] != 1);
}

/* lo + (hi - lo) d, ends that are binary32 numbers: multiples of 2^-149. */
static void move_window(oracle *o) {
    const float *end = (const float[]){(float)o->spec.depth_range[0], (float)o->spec.depth_range[1]};
    if (!is_moved(&o->spec))
        return;
    mpz_t lo, width;
    mpz_inits(lo, width, NULL);
    mpz_set_d(lo, ldexp((double)end[0], 149));
    mpz_set_d(width, ldexp((double)end[1], 149));
    mpz_sub(width, width, lo);
    mpz_mul(o->a, o->a, width);
    mpz_addmul(o->a, o->g, lo);
    mpz_mul(o->b, o->b, width);
    mpz_addmul(o->b, o->h, lo);
    mpz_mul_2exp(o->g, o->g, 149);
    mpz_mul_2exp(o->h, o->h, 149);
    o->reversed = o->reversed != (end[1] < end[0]);
    mpz_clears(lo, width, NULL);
}

void oracle_init(oracle *o, const dp_spec *spec) {
    memset(o, 0, sizeof *o);
    o->spec = *spec;
    o->over_near = spec->mapping == DP_MAPPING_THREE_WEBGPU;
    o->from_near = o->over_near || spec->mapping == DP_MAPPING_CESIUM;
    o->log = o->from_near || spec->mapping == DP_MAPPING_LOG || spec->mapping == DP_MAPPING_THREE_WEBGL ||
             spec->mapping == DP_MAPPING_OSGEARTH;
    o->reversed = spec->mapping == DP_MAPPING_REVERSED || spec->mapping == DP_MAPPING_GL_REVERSED;
    o->perspective = !spec->ortho && !o->log && spec->mapping != DP_MAPPING_LINEAR;
    o->infinite = isinf(spec->zfar);
    mpz_inits(o->a, o->b, o->g, o->h, o->num, o->den, o->t1, o->t2, o->t3, NULL);
    mpq_inits(o->znear, o->zfar, NULL);
    mpfr_inits2(ORACLE_BITS, o->log_c, o->log_far, o->x, o->y, NULL);
    mpq_set_d(o->znear, spec->znear);
    mpq_set_d(o->zfar, o->infinite ? 0 : spec->zfar);
    int exponent;
    frexp(spec->znear, &exponent);
    /* Every double from near on is a multiple of 2^-shift; about 0 that is 2^-1074, and room for its 53 bits. */
    o->shift = spec->znear > 0 ? (mp_bitcnt_t)(53 - exponent + 8) : 1130;
    mpz_t n, f;
    mpz_inits(n, f, NULL);
    mpq_t t;
    mpq_init(t);
    mpq_mul_2exp(t, o->znear, o->shift);
    mpz_set(n, mpq_numref(t));
    mpq_mul_2exp(t, o->zfar, o->shift);
    mpz_set(f, mpq_numref(t));
    if (o->log) {
        mpfr_set_d(o->log_c, spec->log_c, MPFR_RNDN);
        mpfr_set_d(o->x, spec->zfar, MPFR_RNDN);
        argument(o);
        mpfr_log(o->log_far, o->x, MPFR_RNDN);
    } else if (spec->mapping == DP_MAPPING_LINEAR) { /* z/f */
        mpz_set_ui(o->a, 1);
        mpz_set(o->h, f);
    } else if (spec->ortho) { /* (z-n)/(f-n) or (f-z)/(f-n) */
        mpz_set_si(o->a, o->reversed ? -1 : 1);
        if (o->reversed)
            mpz_set(o->b, f);
        else
            mpz_neg(o->b, n);
        mpz_sub(o->h, f, n);
    } else if (o->infinite) { /* (z-n)/z or n/z */
        mpz_set_ui(o->a, o->reversed ? 0 : 1);
        mpz_set(o->b, n);
        if (!o->reversed)
            mpz_neg(o->b, o->b);
        mpz_set_ui(o->g, 1);
    } else { /* f(z-n)/(z(f-n)) or n(f-z)/(z(f-n)) */
        mpz_sub(o->g, f, n);
        mpz_mul(o->b, n, f);
        if (o->reversed) {
            mpz_neg(o->a, n);
        } else {
            mpz_set(o->a, f);
            mpz_neg(o->b, o->b);
        }
    }
    move_window(o);
    mpz_clears(n, f, NULL);
    mpq_clear(t);
}

void oracle_clear(oracle *o) {
    mpz_clears(o->a, o->b, o->g, o->h, o->num, o->den, o->t1, o->t2, o->t3, NULL);
    mpq_clears(o->znear, o->zfar, NULL);
    mpfr_clears(o->log_c, o->log_far, o->x, o->y, NULL);
}

/* num/den = d(Z/scale), both integers */
static void window_z(oracle *o, const mpz_t z, const mpz_t scale) {
    mpz_mul(o->num, o->a, z);
    mpz_addmul(o->num, o->b, scale);
    mpz_mul(o->den, o->g, z);
    mpz_addmul(o->den, o->h, scale);
}

/* num/den = log(C z + 1)/log(C f + 1), or as the mapping has it, with z in o->x */
static void window_log(oracle *o) {
    argument(o);
    mpfr_log(o->x, o->x, MPFR_RNDN);
    mpfr_div(o->x, o->x, o->log_far, MPFR_RNDN);
    mpfr_exp_t e = mpfr_get_z_2exp(o->num, o->x);
    mpz_set_ui(o->den, 1);
    if (e >= 0)
        mpz_mul_2exp(o->num, o->num, (mp_bitcnt_t)e);
    else
        mpz_mul_2exp(o->den, o->den, (mp_bitcnt_t)-e);
}

static void window_d(oracle *o, double z) {
    if (isinf(z)) {
        mpz_set(o->num, o->a);
        mpz_set(o->den, o->g);
    } else if (o->log) {
        mpfr_set_d(o->x, z, MPFR_RNDN);
        window_log(o);
    } else {
        int exponent;
        double mantissa = frexp(z, &exponent);
        mpz_set_d(o->t1, ldexp(mantissa, 53));
        mpz_mul_2exp(o->t1, o->t1, (mp_bitcnt_t)((long)o->shift + exponent - 53));
        mpz_set_ui(o->t2, 1);
        window_z(o, o->t1, o->t2);
    }
}

static void window_q(oracle *o, const mpq_t z) {
    if (o->log) {
        mpfr_set_q(o->x, z, MPFR_RNDN);
        window_log(o);
    } else {
        mpz_mul_2exp(o->t1, mpq_numref(z), o->shift);
        window_z(o, o->t1, mpq_denref(z));
    }
}

void oracle_window(oracle *o, mpq_t d, double z) {
    window_d(o, z);
    mpz_set(mpq_numref(d), o->num);
    mpz_set(mpq_denref(d), o->den);
    mpq_canonicalize(d);
}

uint32_t oracle_code(oracle *o, double z) {
    window_d(o, z);
    return oracle_round(&o->spec.format, o->spec.rounding, o->num, o->den);
}

uint32_t oracle_code_q(oracle *o, const mpq_t z) {
    window_q(o, z);
    return oracle_round(&o->spec.format, o->spec.rounding, o->num, o->den);
}

/* num/den = Z, with den > 0; or 0 */
static int eye_quotient(oracle *o, const mpz_t p, const mpz_t r) {
    mpz_mul(o->num, o->b, r);
    mpz_submul(o->num, o->h, p);
    mpz_mul(o->den, o->g, p);
    mpz_submul(o->den, o->a, r);
    if (mpz_sgn(o->den) < 0) {
        mpz_neg(o->num, o->num);
        mpz_neg(o->den, o->den);
    }
    return mpz_sgn(o->den) != 0 && (!o->perspective || mpz_sgn(o->num) > 0);
}

/* o->x = z(d) = expm1(d log(C f + 1)) / C, d in o->y */
static void eye_log(oracle *o) {
    mpfr_mul(o->x, o->y, o->log_far, MPFR_RNDN);
    mpfr_expm1(o->x, o->x, MPFR_RNDN);
    if (o->over_near)
        mpfr_mul_d(o->x, o->x, o->spec.znear, MPFR_RNDN);
    else
        mpfr_div(o->x, o->x, o->log_c, MPFR_RNDN);
    if (o->from_near)
        mpfr_add_d(o->x, o->x, o->spec.znear, MPFR_RNDN);
}

int oracle_eye(oracle *o, mpq_t z, const mpq_t d) {
    if (o->log) {
        mpfr_set_q(o->y, d, MPFR_RNDN);
        eye_log(o);
        mpfr_get_q(z, o->x);
        if (mpq_cmp_ui(d, 1, 1) == 0)
            mpq_set(z, o->zfar);
        return 1;
    }
    if (!eye_quotient(o, mpq_numref(d), mpq_denref(d)))
        return 0;
    mpz_set(mpq_numref(z), o->num);
    mpz_mul_2exp(mpq_denref(z), o->den, o->shift);
    mpq_canonicalize(z);
    return 1;
}

double oracle_eye_below(oracle *o, const mpz_t num, const mpz_t den) {
    if (o->log) {
        mpfr_set_z(o->y, num, MPFR_RNDN);
        mpfr_div_z(o->y, o->y, den, MPFR_RNDN);
        eye_log(o);
        return mpfr_get_d(o->x, MPFR_RNDZ);
    }
    if (!eye_quotient(o, num, den))
        return 0;
    mpz_fdiv_q(o->t1, o->num, o->den);
    long exponent = 0;
    double mantissa = mpz_get_d_2exp(&exponent, o->t1); /* truncates */
    return ldexp(mantissa, (int)(exponent - (long)o->shift));
}

/* ---- cells ---- */

void oracle_cell_init(oracle_cell *cell) {
    memset(cell, 0, sizeof *cell);
    mpq_inits(cell->lo, cell->hi, cell->stored, cell->whole, NULL);
}

void oracle_cell_clear(oracle_cell *cell) {
    mpq_clears(cell->lo, cell->hi, cell->stored, cell->whole, NULL);
}

static void clip(const oracle *o, mpq_t z) {
    if (mpq_cmp(z, o->znear) < 0)
        mpq_set(z, o->znear);
    if (!o->infinite && mpq_cmp(z, o->zfar) > 0)
        mpq_set(z, o->zfar);
}

/* What lies beyond the ends of a depth range counts as the end. */
static void hold(const oracle *o, mpq_t d) {
    mpq_t end;
    mpq_init(end);
    const int falls = o->spec.depth_range[1] < o->spec.depth_range[0];
    mpq_set_d(end, (double)(float)o->spec.depth_range[falls]);
    if (is_moved(&o->spec) && mpq_cmp(d, end) < 0)
        mpq_set(d, end);
    mpq_set_d(end, (double)(float)o->spec.depth_range[!falls]);
    if (is_moved(&o->spec) && mpq_cmp(d, end) > 0)
        mpq_set(d, end);
    mpq_clear(end);
}

void oracle_cell_of(oracle *o, oracle_cell *cell, uint32_t code) {
    const dp_format *format = &o->spec.format;
    mpq_t below, above;
    mpq_inits(below, above, NULL);
    if (code > 0)
        oracle_boundary(below, format, o->spec.rounding, code);
    if (code < format->code_max)
        oracle_boundary(above, format, o->spec.rounding, code + 1);
    else
        mpq_set_ui(above, 1, 1);
    hold(o, below);
    hold(o, above);
    cell->lo_infinite = !oracle_eye(o, cell->lo, o->reversed ? above : below);
    cell->hi_infinite = !oracle_eye(o, cell->hi, o->reversed ? below : above);
    oracle_value(below, format, code);
    hold(o, below);
    cell->stored_infinite = !oracle_eye(o, cell->stored, below);
    if (!cell->lo_infinite && !cell->hi_infinite)
        mpq_sub(cell->whole, cell->hi, cell->lo);
    clip(o, cell->lo);
    clip(o, cell->hi);
    mpq_clears(below, above, NULL);
}

/* Whether a <= b, or by no more than 1e-6 of the step above: doubt that a double evaluation of d may have. */
static int near_below(const mpq_t a, const mpq_t b, const mpq_t step) {
    if (mpq_cmp(a, b) > 0)
        return 0;
    mpq_t gap, doubt;
    mpq_inits(gap, doubt, NULL);
    mpq_sub(gap, b, a);
    mpq_set_ui(doubt, 1, 1000000);
    mpq_mul(doubt, doubt, step);
    int close = mpq_cmp(gap, doubt) <= 0;
    mpq_clears(gap, doubt, NULL);
    return close;
}

/*
 * Steps of the format at d, in the direction away from the viewer. Sets step, and larger where it is in doubt.
 * Behind means upwards (d to d + step), or downwards when reversed.
 */
static int steps(const oracle *o, const mpq_t d, mpq_t step, mpq_t larger) {
    const dp_format *format = &o->spec.format;
    if (format->kind == DP_FORMAT_UNORM) {
        mpq_set_ui(step, 1, format->code_max);
        return 0;
    }
    long lowest = 1 - format->bias;
    long e = mpq_sgn(d) > 0 ? floor_log2(mpq_numref(d), mpq_denref(d)) : lowest - 1;
    mpq_t start, end, reach;
    mpq_inits(start, end, reach, NULL);
    mpq_set_ui(start, 1, 1);
    scale_q(start, e);
    int at_start = mpq_sgn(d) > 0 && mpq_equal(start, d);
    int either = 0;
    if (e == 0 || (o->reversed && at_start))
        e--;               /* downwards from a binade end, or at 1, above which nothing is: the binade below */
    int flat = e < lowest; /* subnormal: the binade above has the same step */
    mpq_set_ui(end, 1, 1);
    scale_q(end, e + 1);
    mpq_set_ui(step, 1, 1);
    scale_q(step, (flat ? lowest : e) - format->mantissa_bits);
    mpq_set(larger, step);
    scale_q(larger, flat ? 0 : 1);
    if (o->reversed) {
        either = near_below(d, end, step);
    } else {
        mpq_add(reach, d, step);
        either = near_below(reach, end, step);
        if (mpq_cmp(reach, end) > 0) {
            if (e + 1 >= 0)
                either = 1; /* beyond 1 there are no codes: either step */
            else
                mpq_set(step, larger);
        }
    }
    mpq_clears(start, end, reach, NULL);
    return either && !flat;
}

oracle_separation_kind oracle_separation(oracle *o, double z, mpq_t least, mpq_t most, int *most_infinite) {
    mpq_t d, step, larger, at;
    mpq_inits(d, step, larger, at, NULL);
    mpq_set_d(at, z);
    oracle_window(o, d, z);
    int either = steps(o, d, step, larger);
    oracle_separation_kind kind = either ? ORACLE_SEPARATION_EITHER : ORACLE_SEPARATION_ONE;
    if (o->reversed) {
        mpq_neg(step, step);
        mpq_neg(larger, larger);
    }
    mpq_add(step, d, step);
    if (oracle_eye(o, least, step))
        mpq_sub(least, least, at);
    else
        kind = ORACLE_SEPARATION_NONE;
    *most_infinite = 0;
    if (either) {
        mpq_add(larger, d, larger);
        *most_infinite = !oracle_eye(o, most, larger);
        mpq_sub(most, most, at);
    }
    mpq_clears(d, step, larger, at, NULL);
    return kind;
}

/* ---- numbers ---- */

double oracle_double(const mpq_t x) {
    mpfr_t t;
    mpfr_init2(t, 53);
    mpfr_set_q(t, x, MPFR_RNDN);
    double value = mpfr_get_d(t, MPFR_RNDN);
    mpfr_clear(t);
    return value;
}

double oracle_distance(double got, const mpq_t want) {
    if (!isfinite(got))
        return HUGE_VAL;
    mpq_t t;
    mpq_init(t);
    mpq_set_d(t, got);
    mpq_sub(t, t, want);
    double distance = fabs(oracle_double(t));
    mpq_clear(t);
    return distance;
}

double oracle_relative(double got, const mpq_t want) {
    double distance = oracle_distance(got, want);
    return distance == 0 ? 0 : distance / fabs(oracle_double(want));
}

const char *oracle_describe(const dp_spec *spec, char *text, size_t size) {
    static const char *const mapping[] = {"d3d", "gl",          "reversed",     "gl-reversed", "linear",
                                          "log", "three-webgl", "three-webgpu", "cesium",      "osgearth"};
    static const char *const rounding[] = {"nearest", "even", "zero"};
    snprintf(text, size, "%s %s%s %s near=%a far=%a C=%a range=%a:%a", spec->format.name, spec->ortho ? "ortho " : "",
             mapping[spec->mapping], rounding[spec->rounding], spec->znear, spec->zfar, spec->log_c,
             spec->depth_range[0], spec->depth_range[1]);
    return text;
}
