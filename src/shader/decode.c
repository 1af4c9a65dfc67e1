/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "shader/decode.h"

#include <math.h>

#include "core/clones.h"
#include "core/elementary.h"
#include "core/engine.h"

/* ---- Constants --------------------------------------------------------------------------------------------------- */

/* f/n - 1 and (f/n - 1)/f, without the cancellation of 1/n - 1/f. */
static double excess(const dp_setup *setup) {
    return (setup->spec.zfar - setup->spec.znear) / setup->spec.znear;
}
static double excess_by_far(const dp_setup *setup) {
    return isinf(setup->spec.zfar) ? 1 / setup->spec.znear : excess(setup) / setup->spec.zfar;
}

zbuffer_params zbuffer_params_of(const dp_setup *setup) {
    const double n = setup->spec.znear, f = setup->spec.zfar;
    if (setup->reversed)
        return (zbuffer_params){(float)excess(setup), 1.0f, (float)excess_by_far(setup), (float)(1 / f)};
    return (zbuffer_params){(float)-excess(setup), (float)(f / n), (float)-excess_by_far(setup), (float)(1 / n)};
}

static decode_constants linear_eye(const dp_setup *setup) {
    const zbuffer_params p = zbuffer_params_of(setup);
    return (decode_constants){DECODE_RECIPROCAL, 0, 1, p.z, p.w};
}

static decode_constants linear_01(const dp_setup *setup) {
    const zbuffer_params p = zbuffer_params_of(setup);
    return (decode_constants){DECODE_RECIPROCAL, 0, 1, p.x, p.y};
}

static decode_constants linear_01_near(const dp_setup *setup) {
    const zbuffer_params p = zbuffer_params_of(setup);
    const bool r = setup->reversed != 0;
    return (decode_constants){DECODE_QUOTIENT, r ? 1.0f : 0.0f, r ? -1.0f : 1.0f, p.x, p.y};
}

static decode_constants ortho_eye(const dp_setup *setup) {
    const double n = setup->spec.znear, f = setup->spec.zfar;
    const bool r = setup->reversed != 0;
    return (decode_constants){DECODE_AFFINE, 0, 1, (float)(r ? n - f : f - n), (float)(r ? f : n)};
}

static decode_constants w_eye(const dp_setup *setup) {
    return (decode_constants){DECODE_AFFINE, 0, 1, (float)setup->spec.zfar, 0};
}

static decode_constants log_eye(const dp_setup *setup) {
    const double c = setup->log_c;
    return (decode_constants){DECODE_EXP2, 0, 1, (float)(dp_log1p(c * setup->spec.zfar) / M_LN2), (float)c};
}

/* All terms positive: q is the share of the way from the far plane, 1 - d or d itself. */
static decode_constants complement(const dp_setup *setup) {
    const double n = setup->spec.znear, f = setup->spec.zfar, c = setup->log_c;
    const bool r = setup->reversed != 0;
    if (setup->curve == DP_CURVE_LOG)
        return (decode_constants){DECODE_EXPM1, 0, 1, (float)dp_log1p(c * f), (float)c};
    if (setup->curve == DP_CURVE_PERSPECTIVE)
        return (decode_constants){DECODE_RECIPROCAL, r ? 0.0f : 1.0f, r ? 1.0f : -1.0f, (float)excess_by_far(setup),
                                  (float)(1 / f)};
    if (!setup->spec.ortho)
        return w_eye(setup);
    return (decode_constants){DECODE_AFFINE, r ? 1.0f : 0.0f, r ? -1.0f : 1.0f, (float)(f - n), (float)n};
}

/* ---- Rows -------------------------------------------------------------------------------------------------------- */

static const char unity[] = "UnityCG.cginc and the Core package's Common.hlsl, _ZBufferParams";

/* clang-format off */
/* The first eye depth that applies to a set-up is the usual one of engines. */
const decode_row decode_rows[] = {
    [DECODE_LINEAR_EYE] = {
        .name = "linear-eye", .note = "LinearEyeDepth: 1/(Z d + W)", .source = unity,
        .quantity = DECODE_EYE, .perspective = true, .far_infinite = true, .constants = linear_eye},
    [DECODE_LINEAR_01] = {
        .name = "linear-01", .note = "Linear01Depth: 1/(X d + Y), eye depth over far", .source = unity,
        .quantity = DECODE_01, .perspective = true, .constants = linear_01},
    [DECODE_LINEAR_01_NEAR] = {
        .name = "linear-01-near", .source = unity,
        .note = "Linear01DepthFromNear: d/(X d + Y), reversed (1 - d)/(X d + Y); 0 at near, 1 at far",
        .quantity = DECODE_01_NEAR, .perspective = true, .constants = linear_01_near},
    [DECODE_ORTHO_EYE] = {
        .name = "ortho-eye", .source = "the Core package's Common.hlsl",
        .note = "orthographic LinearDepthToEyeDepth: n + (f - n) d, reversed f - (f - n) d",
        .quantity = DECODE_EYE, .ortho = true, .constants = ortho_eye},
    [DECODE_W_EYE] = {
        .name = "w-eye", .note = "linear depth times far: f d", .source = "depthprec(7)",
        .quantity = DECODE_EYE, .w = true, .constants = w_eye},
    [DECODE_LOG_EYE] = {
        .name = "log-eye", .note = "logarithmic: ((C f + 1)^d - 1)/C by exp2",
        .source = "Kemen, Logarithmic depth buffer, 2009 (Outerra)",
        .quantity = DECODE_EYE, .log = true, .constants = log_eye},
    [DECODE_COMPLEMENT] = {
        .name = "complement", .source = "depthprec(7)",
        .note = "no cancellation: 1/((1/n - 1/f) q + 1/f), q = 1 - d, reversed d; orthographic n + (f - n)(1 - q); "
                "f d; expm1(d log(C f + 1))/C",
        .quantity = DECODE_EYE, .perspective = true, .ortho = true, .w = true, .log = true, .far_infinite = true,
        .constants = complement},
};
/* clang-format on */

NAMED_TABLE(decode, decode_rows);

bool decode_applies(const decode_row *row, const dp_setup *setup) {
    const bool curve = setup->spec.ortho                      ? row->ortho
                       : setup->curve == DP_CURVE_PERSPECTIVE ? row->perspective
                       : setup->curve == DP_CURVE_LINEAR      ? row->w
                                                              : row->log && setup->anchor == 0;
    return curve && (row->far_infinite || !isinf(setup->spec.zfar));
}

const decode_row *decode_usual(const dp_setup *setup) {
    const decode_row *row = decode_rows, *const last = &decode_rows[DECODE_COMPLEMENT];
    while (row < last && (row->quantity != DECODE_EYE || !decode_applies(row, setup)))
        row++;
    return row;
}

/* ---- Loops: "in place" means the same element, so no iteration waits for another --------------------------------- */

CLONES static void reciprocal_loop(const decode_constants c, const float *d, float *out, size_t count) {
#pragma omp simd
    for (size_t i = 0; i < count; i++)
        out[i] = 1.0f / (c.scale * (c.from + c.sign * d[i]) + c.base);
}

CLONES static void affine_loop(const decode_constants c, const float *d, float *out, size_t count) {
#pragma omp simd
    for (size_t i = 0; i < count; i++)
        out[i] = c.scale * (c.from + c.sign * d[i]) + c.base;
}

CLONES static void quotient_loop(const decode_constants c, const float *d, float *out, size_t count) {
#pragma omp simd
    for (size_t i = 0; i < count; i++)
        out[i] = (c.from + c.sign * d[i]) / (c.scale * d[i] + c.base);
}

static void exp2_loop(const decode_constants c, const float *d, float *out, size_t count) {
    for (size_t i = 0; i < count; i++)
        out[i] = (dp_exp2f(c.scale * (c.from + c.sign * d[i])) - 1.0f) / c.base;
}

static void expm1_loop(const decode_constants c, const float *d, float *out, size_t count) {
    for (size_t i = 0; i < count; i++)
        out[i] = dp_expm1f(c.scale * (c.from + c.sign * d[i])) / c.base;
}

void decode_apply(const decode_constants *c, const float *d, float *out, size_t count) {
    static void (*const loops[])(decode_constants, const float *, float *, size_t) = {
        [DECODE_RECIPROCAL] = reciprocal_loop, [DECODE_AFFINE] = affine_loop,
        [DECODE_QUOTIENT] = quotient_loop,     [DECODE_EXP2] = exp2_loop,
        [DECODE_EXPM1] = expm1_loop,
    };
    loops[c->form](*c, d, out, count);
}

void decode_run(const decode_row *row, const dp_setup *setup, const float *d, float *out, size_t count) {
    const decode_constants c = row->constants(setup);
    decode_apply(&c, d, out, count);
}

/* ---- Exactly ----------------------------------------------------------------------------------------------------- */

/* (C f + 1)^d - 1: the exponent needs more digits than a double has, because its error is multiplied by itself. */
static double exact_power(const dp_setup *setup, double d) {
    const double hi = d * setup->log_hi, lo = fma(d, setup->log_hi, -hi) + d * setup->log_lo, power = dp_expm1(hi);
    return power + lo * (power + 1);
}

/* By the shares of the near and of the far end, rounded: no term has another sign, so none is lost. */
DP_INLINE double perspective_exact(const dp_setup *setup, decode_quantity quantity, double near, double far) {
    const double n = setup->spec.znear, f = setup->spec.zfar;
    const bool infinite = isinf(f) != 0;
    const double below = infinite ? near : f * near + n * far;
    const double above = quantity == DECODE_EYE ? (infinite ? n : n * f) : quantity == DECODE_01 ? n : n * far;
    return above / below;
}

/* How far d has come from one end of the depth range to the other, a share; beyond an end it is that end. */
static double share_from(const dp_setup *setup, int end, double d) {
    return fmin(fmax((d - setup->ends[end]) / (setup->ends[1 - end] - setup->ends[end]), 0), 1);
}

double decode_exact(const dp_setup *setup, decode_quantity quantity, double d) {
    const double n = setup->spec.znear, f = setup->spec.zfar;
    const double rest = 1 - d, lost = (1 - rest) - d; /* 1 - d = rest + lost, for d in [0, 1] */
    const bool r = setup->reversed != 0, infinite = isinf(f);
    /* the shares of the near and of the far end: 1/z = near/n + far/f */
    double near_hi = r ? d : rest, near_lo = r ? 0 : lost, far_hi = r ? rest : d, far_lo = r ? lost : 0;
    if (setup->ranged) {
        near_hi = share_from(setup, 1, d);
        far_hi = share_from(setup, 0, d);
        near_lo = far_lo = 0;
    }
    if (infinite && quantity != DECODE_EYE)
        return 0;
    if (setup->curve == DP_CURVE_LOG) {
        const double c = setup->log_c, beyond = exact_power(setup, d) / c, z = setup->anchor + beyond;
        if (quantity != DECODE_01_NEAR)
            return quantity == DECODE_EYE ? z : z / f;
        if (setup->anchor == n)
            return beyond / (f - n);
        if (z > 4 * n) /* far enough for a plain difference */
            return (z - n) / (f - n);
        const dp_pair top = {setup->log_hi, setup->log_lo};
        return (n + 1 / c) *
               dp_expm1(dp_scaled_difference(d, 1, top, dp_log1p_excess(n, setup->anchor, setup->log_by))) / (f - n);
    }
    if (setup->curve == DP_CURVE_LINEAR && !setup->spec.ortho)
        return quantity == DECODE_EYE ? f * d : quantity == DECODE_01 ? d : fma(f, d, -n) / (f - n);
    if (setup->curve == DP_CURVE_LINEAR) {
        const double sum = n * near_hi + f * far_hi + (n * near_lo + f * far_lo);
        const double z = setup->spans_zero ? dp_curve_eye(setup, dp_point_make(d, 1)) : sum; /* which cancels about 0 */
        return quantity == DECODE_EYE ? z : quantity == DECODE_01 ? z / f : far_hi + far_lo;
    }
    return perspective_exact(setup, quantity, near_hi, far_hi);
}

/* decode_exact() in perspective, as a loop over all that is alike. */
DP_INLINE void perspective_loop(const dp_setup *setup, decode_quantity quantity, bool reversed, const float *restrict d,
                                double *restrict out, size_t count) {
    const dp_setup s = *setup;
    for (size_t i = 0; i < count; i++) {
        const double at = (double)d[i], rest = 1 - at;
        out[i] = perspective_exact(&s, quantity, reversed ? at : rest, reversed ? rest : at);
    }
}

CLONES static void perspective_standard(const dp_setup *setup, decode_quantity quantity, const float *d, double *out,
                                        size_t count) {
    perspective_loop(setup, quantity, false, d, out, count);
}

CLONES static void perspective_reversed(const dp_setup *setup, decode_quantity quantity, const float *d, double *out,
                                        size_t count) {
    perspective_loop(setup, quantity, true, d, out, count);
}

void decode_exact_run(const dp_setup *setup, decode_quantity quantity, const float *d, double *out, size_t count) {
    const bool simple =
        setup->curve == DP_CURVE_PERSPECTIVE && !setup->ranged && !(isinf(setup->spec.zfar) && quantity != DECODE_EYE);
    if (simple)
        (setup->reversed ? perspective_reversed : perspective_standard)(setup, quantity, d, out, count);
    for (size_t i = 0; i < count && !simple; i++)
        out[i] = decode_exact(setup, quantity, (double)d[i]);
}

/* ---- Bound ------------------------------------------------------------------------------------------------------- */

double decode_bound(const decode_row *row, const dp_setup *setup, double d) {
    const decode_constants c = row->constants(setup);
    const double exact = decode_exact(setup, row->quantity, d);
    const bool turned = c.from != 0;
    /* 1 - d is exact from d = 1/2 on; below, it lies in [1/2, 1] and is rounded by half a unit of 1 */
    const double q = turned ? 1 - d : d, q_off = turned && d < 0.5 ? 0.5 / q : 0;
    /* scale and product are rounded once each, base once, but not the 1 of a reversed share; then the sum */
    const bool base_is_one = row->quantity != DECODE_EYE && setup->reversed != 0;
    const double big =
        (2 + (c.form == DECODE_QUOTIENT ? 0 : q_off)) * (double)fabsf(c.scale) * (c.form == DECODE_QUOTIENT ? d : q) +
        (base_is_one ? 0 : (double)fabsf(c.base));
    double off;
    if (exact == 0 && setup->spans_zero)
        return (double)INFINITY; /* a difference */
    if (exact == 0 || isinf(exact))
        return 0; /* a product with 0, or a quotient by 0 */
    if (c.form == DECODE_RECIPROCAL)
        off = big * exact + 2;
    else if (c.form == DECODE_AFFINE)
        off = big / fabs(exact) + 1;
    else if (c.form == DECODE_QUOTIENT)
        off = big * exact / q + 2 + q_off;
    else {
        /* the exponent is rounded relative to itself, its product by half a unit in the last place */
        const double away = setup->log_c * exact, steep = (away + 1) / away;
        const double per = c.form == DECODE_EXP2 ? M_LN2 : 1, product = dp_half_ulp((double)c.scale * d) / DP_UNIT;
        const double power = dp_log1p(away) + per * product;
        /* exp2f within 0.55 ulp and expm1f within 1, as C libraries have them and ours (0.501; test_decode.c
         * looks); the difference with 1, exact below 2^24; then quotient and C */
        off = c.form == DECODE_EXP2 ? (power + 1.1) * steep + (away < 0x1.fffp23 ? 0 : 1) + 2 : power * steep + 4;
    }
    off *= DP_UNIT * (1 + DP_ROUNDINGS32_14); /* the constants are rounded, too, and so is this */
    return off < 0.5 ? off / (1 - off) : (double)INFINITY;
}
