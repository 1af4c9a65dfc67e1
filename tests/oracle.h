/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file oracle.h  Exact answers to compare the library with, written from the definitions alone.
 *
 * Every mapping but the logarithmic one is a quotient of two linear functions of the eye depth,
 *
 *     d = (a Z + b) / (g Z + h),   Z = z 2^shift,
 *
 * and doubles are dyadic, so a, b, g, h and Z are integers (GMP) and nothing is ever rounded. The logarithmic mapping
 * is computed with MPFR to ORACLE_BITS bits and then treated as if it were rational.
 * The oracle shares no code and no tables with the library: only the structs of the public headers.
 */
#ifndef TESTS_ORACLE_H
#define TESTS_ORACLE_H

#include <stdint.h>
#include <stdio.h>

#include <gmp.h>
#include <mpfr.h>

#include "depthprec/depthprec.h"

enum { ORACLE_BITS = 384 };

typedef struct oracle {
    dp_spec spec;
    int log, perspective, reversed, infinite;
    int from_near, over_near; /* LOG: what the logarithm is taken of is 1 at near; it is z/n */
    mp_bitcnt_t shift;
    mpz_t a, b, g, h;
    mpq_t znear, zfar;
    mpfr_t log_c, log_far;      /* LOG: C, and log(C f + 1) */
    mpz_t num, den, t1, t2, t3; /* scratch */
    mpfr_t x, y;
} oracle;

void oracle_init(oracle *o, const dp_spec *spec);
void oracle_clear(oracle *o);

/* ---- formats ---- */

/** The value of a code. */
void oracle_value(mpq_t value, const dp_format *format, uint32_t code);
/** The rounding boundary between code - 1 and code; code >= 1. */
void oracle_boundary(mpq_t boundary, const dp_format *format, dp_rounding rounding, uint32_t code);
/** The code of num/den, which lies in [0, 1]; den > 0. */
uint32_t oracle_round(const dp_format *format, dp_rounding rounding, const mpz_t num, const mpz_t den);
/** The code of any double as the APIs clamp: below 0 and NaN to 0, above 1 to 1. */
uint32_t oracle_encode(const dp_format *format, dp_rounding rounding, double d);
/** A format made from its numbers, without the library. */
dp_format oracle_unorm(int bits);
dp_format oracle_float(int exponent_bits, int mantissa_bits, int bias);

/* ---- mappings ---- */

/** d(z) of a double in [near, far]; z = INFINITY is allowed where far is infinite. */
void oracle_window(oracle *o, mpq_t d, double z);
/** The code of a double in [near, far]; the fast path of the oracle: no fraction is reduced. */
uint32_t oracle_code(oracle *o, double z);
/** The code of a rational depth. */
uint32_t oracle_code_q(oracle *o, const mpq_t z);
/** z(d). @return 0 where no finite depth (> 0 under a perspective) has this d */
int oracle_eye(oracle *o, mpq_t z, const mpq_t d);
/** The greatest double not above z(num/den), where that is finite and positive, else 0: for aiming at boundaries. */
double oracle_eye_below(oracle *o, const mpz_t num, const mpz_t den);

/* ---- cells ---- */

typedef struct oracle_cell {
    mpq_t lo, hi, stored; /* clipped to [near, far]; stored is not */
    mpq_t whole;          /* the width before clipping to near, for tolerances */
    int lo_infinite, hi_infinite, stored_infinite;
} oracle_cell;

void oracle_cell_init(oracle_cell *cell);
void oracle_cell_clear(oracle_cell *cell);
void oracle_cell_of(oracle *o, oracle_cell *cell, uint32_t code);

typedef enum oracle_separation_kind {
    ORACLE_SEPARATION_NONE = 0, /* no depth lies one step behind */
    ORACLE_SEPARATION_ONE,      /* least is the answer */
    ORACLE_SEPARATION_EITHER    /* d, or d + step, is a binade end or very near one: least and most are both right */
} oracle_separation_kind;

/** One step behind z. In the EITHER case most may be infinite: *most_infinite. */
oracle_separation_kind oracle_separation(oracle *o, double z, mpq_t least, mpq_t most, int *most_infinite);

/* ---- numbers ---- */

/** The nearest double. */
double oracle_double(const mpq_t x);
/** |got - want| / |want|, rounded up a little; 0 when both are 0. */
double oracle_relative(double got, const mpq_t want);
/** |got - want|. */
double oracle_distance(double got, const mpq_t want);

/** A set-up as C that reproduces it. */
const char *oracle_describe(const dp_spec *spec, char *text, size_t size);

#endif
