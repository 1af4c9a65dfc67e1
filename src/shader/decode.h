/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file decode.h  What shaders make of a stored depth: eye depth and its shares, a row each.
 *
 * Every row is a few operations in binary32, none fused, on constants that are formed in double and rounded once, as
 * an engine uploads them. Near and far are n and f.
 */
#ifndef SHADER_DECODE_H
#define SHADER_DECODE_H

#include <stdbool.h>

#include "core/named.h"
#include "depthprec/depthprec.h"

/** The quantity that a decoding gives. */
typedef enum decode_quantity {
    DECODE_EYE = 0, /**< eye depth z, scene units */
    DECODE_01,      /**< z/f; 0 where f is infinite */
    DECODE_01_NEAR, /**< (z - n)/(f - n); 0 where f is infinite */
    DECODE_QUANTITIES
} decode_quantity;

/** _ZBufferParams as an engine uploads it: formed in double, rounded once to binary32. With an infinite far plane the
 *  standard x and y are infinite, and z and w have their limits. */
typedef struct zbuffer_params {
    float x, y, z, w;
} zbuffer_params;
zbuffer_params zbuffer_params_of(const dp_setup *setup);

/** The shape of a row's formula, with q = from + sign d and x = scale q + base. */
typedef enum decode_form {
    DECODE_RECIPROCAL = 0, /**< 1/x */
    DECODE_AFFINE,         /**< x */
    DECODE_QUOTIENT,       /**< q/(scale d + base) */
    DECODE_EXP2,           /**< (2^(scale q) - 1)/base */
    DECODE_EXPM1           /**< (e^(scale q) - 1)/base, the difference formed at once */
} decode_form;

typedef struct decode_constants {
    decode_form form;
    float from, sign; /**< 0 and 1: q is d itself; 1 and -1: its complement */
    float scale, base;
} decode_constants;

typedef struct decode_row {
    NAMED_FIELDS; /**< the note is the formula */
    decode_quantity quantity;
    bool perspective, ortho, w, log; /**< for which curves: W-buffer, logarithmic */
    bool far_infinite;
    decode_constants (*constants)(const dp_setup *setup);
} decode_row;

/** The rows in their order; the last applies to all but logarithms that begin at near. */
enum {
    DECODE_LINEAR_EYE = 0,
    DECODE_LINEAR_01,
    DECODE_LINEAR_01_NEAR,
    DECODE_ORTHO_EYE,
    DECODE_W_EYE,
    DECODE_LOG_EYE,
    DECODE_COMPLEMENT,
    DECODE_ROWS
};
extern const decode_row decode_rows[DECODE_ROWS];

NAMED_ROWS(decode_row, decode);

/** Does the row apply to the set-up's curve, projection and far plane? */
bool decode_applies(const decode_row *row, const dp_setup *setup);

/** The row that engines use for the eye depth of a set-up. Never null. The one that cancels nothing is "complement". */
const decode_row *decode_usual(const dp_setup *setup);

/** `count` window depths in binary32, as a shader would; in place is allowed. NaN stays NaN. Vectorized, but for the
 *  exponentials. */
void decode_apply(const decode_constants *c, const float *d, float *out, size_t count);
void decode_run(const decode_row *row, const dp_setup *setup, const float *d, float *out, size_t count);

/**
 * The quantity exactly, rounded to double: the reference. `d`, in [0, 1], is taken as it is, and so are the planes; of
 * a depth range d is that of the window, beyond an end that of the end, and `decode_run()` knows none.
 *
 * Bound: 2^-50 relative. In perspective all terms have one sign; else 1 - d is carried as an unevaluated sum of
 * two doubles, so nothing cancels at either end.
 * Special cases: INFINITY for the eye depth at an infinite far plane.
 */
double decode_exact(const dp_setup *setup, decode_quantity quantity, double d);
/** The same of many, bit for bit. */
void decode_exact_run(const dp_setup *setup, decode_quantity quantity, const float *d, double *out, size_t count);

/**
 * A bound on the relative error of the row at window depth d, a binary32 number: INFINITY where it has no digit left.
 *
 * Derivation: each rounding counts one unit of 2^-24 in the term that it rounds; the terms of a sum are taken with
 * their magnitudes, so a sum that cancels shows. See depthprec(7). exp2f is taken to be good to 0.55 units in the last
 * place, expm1f to one.
 */
double decode_bound(const decode_row *row, const dp_setup *setup, double d);

#endif
