/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Eye depth of a binary32 window depth. Constants are formed in double and rounded once, as an engine uploads them. */
#include <float.h>
#include <math.h>
#include <stdlib.h>
#if defined(__SSE__)
#include <xmmintrin.h>
#endif

#include <gsl/gsl_chebyshev.h>
#include <gsl/gsl_spline.h>

#include "core/bits.h"
#include "core/clones.h"
#include "core/elementary.h"
#include "method/bound.h"
#include "method/estimate.h"
#include "method/truth.h"

/* ---- The rows of shader/decode.h -------------------------------------------------------------------------------- */

CLONES static void scale_all(float *eye, size_t count, float base, float scale) {
    for (size_t i = 0; i < count; i++)
        eye[i] = base + scale * eye[i];
}

/* Shares of far, or of the way from near to far, become depths. */
static void decoded_run(const method_call *c) {
    const decode_row *row = c->row->decode;
    const dp_spec *spec = &c->setup->spec;
    const bool of_far = row->quantity == DECODE_01;
    decode_run(row, c->setup, c->in->d, c->out->eye, c->in->count);
    if (row->quantity != DECODE_EYE)
        scale_all(c->out->eye, c->in->count, of_far ? 0 : (float)spec->znear,
                  (float)(of_far ? spec->zfar : spec->zfar - spec->znear));
}

/* The reciprocal of x > 0 from its bits, within 12 %, then one Newton step. */
static float magic_reciprocal(float x) {
    const float y = dp_float32(0x7ef311c7u - dp_bits32(x));
    return y * (2.0f - x * y);
}

CLONES static void magic_run(const method_call *c) {
    const zbuffer_params p = zbuffer_params_of(c->setup);
    for (size_t i = 0; i < c->in->count; i++)
        c->out->eye[i] = magic_reciprocal(p.z * c->in->d[i] + p.w);
}

/* ---- n f/(f - d (f - n)) ----------------------------------------------------------------------------------------- */

/* product/(base + slope d) */
typedef struct textbook {
    double product, base, slope;
} textbook;

static textbook textbook_of(const dp_setup *setup) {
    double n = setup->spec.znear, f = setup->spec.zfar;
    return setup->reversed ? (textbook){n * f, n, f - n} : (textbook){n * f, f, n - f};
}

CLONES static void textbook_run(const method_call *c) {
    const textbook t = textbook_of(c->setup);
    const float product = (float)t.product, base = (float)t.base, slope = (float)t.slope;
    for (size_t i = 0; i < c->in->count; i++)
        c->out->eye[i] = product / (base + slope * c->in->d[i]);
}

CLONES static void fused_run(const method_call *c) {
    const textbook t = textbook_of(c->setup);
    const float product = (float)t.product, base = (float)t.base, slope = (float)t.slope;
    for (size_t i = 0; i < c->in->count; i++)
        c->out->eye[i] = product / fmaf(slope, c->in->d[i], base);
}

CLONES static void double_run(const method_call *c) {
    const textbook t = textbook_of(c->setup);
    for (size_t i = 0; i < c->in->count; i++)
        c->out->eye[i] = (float)(t.product / (t.base + t.slope * (double)c->in->d[i]));
}

/* ---- n f/(n + (1 - d)(f - n)): all terms positive ---------------------------------------------------------------- */

/* The share of the way from the far plane: 1 - d, or d itself where near is stored as 1. */
static float toward_near(bool reversed, float d) {
    return reversed ? d : 1.0f - d;
}

CLONES static void complement_run(const method_call *c) {
    const double n = c->setup->spec.znear, f = c->setup->spec.zfar;
    const float product = (float)(n * f), base = (float)n, slope = (float)(f - n);
    const bool reversed = c->setup->reversed != 0;
    for (size_t i = 0; i < c->in->count; i++)
        c->out->eye[i] = product / (base + slope * toward_near(reversed, c->in->d[i]));
}

CLONES static void newton_run(const method_call *c) {
    const double n = c->setup->spec.znear, f = c->setup->spec.zfar;
    const float product = (float)(n * f), base = (float)n, slope = (float)(f - n);
    const bool reversed = c->setup->reversed != 0;
    for (size_t i = 0; i < c->in->count; i++) {
        const float x = base + slope * toward_near(reversed, c->in->d[i]), y = estimate_reciprocal(x);
        c->out->eye[i] = product * (y * (2.0f - x * y));
    }
}

#if defined(__SSE__)
typedef struct newton {
    __m128 product, base, slope, from, sign;
} newton;

static __m128 newton_four(const newton *c, __m128 d) {
    const __m128 q = _mm_add_ps(c->from, _mm_mul_ps(c->sign, d)), x = _mm_add_ps(c->base, _mm_mul_ps(c->slope, q));
    const __m128 y = _mm_rcp_ps(x);
    return _mm_mul_ps(c->product, _mm_mul_ps(y, _mm_sub_ps(_mm_set1_ps(2.0f), _mm_mul_ps(x, y))));
}

static void rcpps_run(const method_call *c) {
    const double n = c->setup->spec.znear, f = c->setup->spec.zfar;
    const bool reversed = c->setup->reversed != 0;
    const newton k = {_mm_set1_ps((float)(n * f)), _mm_set1_ps((float)n), _mm_set1_ps((float)(f - n)),
                      _mm_set1_ps(reversed ? 0.0f : 1.0f), _mm_set1_ps(reversed ? 1.0f : -1.0f)};
    size_t i = 0;
    for (; i + 4 <= c->in->count; i += 4)
        _mm_storeu_ps(c->out->eye + i, newton_four(&k, _mm_loadu_ps(c->in->d + i)));
    for (; i < c->in->count; i++)
        c->out->eye[i] = _mm_cvtss_f32(newton_four(&k, _mm_set1_ps(c->in->d[i])));
}
#else
#define rcpps_run NULL
#endif

/* The sum and the product of two as unevaluated pairs (Knuth, Dekker): double only carries the constants in. */
typedef struct pair {
    float hi, lo;
} pair;

static pair pair_of(double x) {
    pair p = {(float)x, 0.0f};
    p.lo = (float)(x - (double)p.hi);
    return p;
}

static pair two_sum(float a, float b) {
    float s = a + b, v = s - a;
    return (pair){s, (a - (s - v)) + (b - v)};
}

/* Halves of 12 bits, so that four products are exact without a fused operation. */
static pair two_product(float a, float b) {
    float ca = 4097.0f * a, cb = 4097.0f * b;
    float ah = ca - (ca - a), bh = cb - (cb - b), al = a - ah, bl = b - bh, p = a * b;
    return (pair){p, ((ah * bh - p) + ah * bl + al * bh) + al * bl};
}

CLONES static void pair_run(const method_call *c) {
    const double n = c->setup->spec.znear, f = c->setup->spec.zfar;
    /* In units of near: then nothing leaves the range of binary32, whatever the scene's units are. */
    const pair slope = pair_of(f / n - 1), product = pair_of(f);
    const float from = c->setup->reversed ? 0.0f : 1.0f, sign = c->setup->reversed ? 1.0f : -1.0f;
    for (size_t i = 0; i < c->in->count; i++) {
        pair q = two_sum(from, sign * c->in->d[i]);
        pair m = two_product(slope.hi, q.hi);
        m.lo += slope.hi * q.lo + slope.lo * q.hi;
        pair x = two_sum(1.0f, m.hi);
        x.lo += m.lo;
        float z = product.hi / x.hi;
        pair back = two_product(z, x.hi);
        c->out->eye[i] = z + (((product.hi - back.hi) - back.lo) + (product.lo - z * x.lo)) / x.hi;
    }
}

/* The engine's formula: n/(phi d + q), which also has a limit for an infinite far plane. */
CLONES static void phi_run(const method_call *c) {
    const double n = c->setup->spec.znear, phi = n / c->setup->spec.zfar;
    const bool reversed = c->setup->reversed != 0;
    for (size_t i = 0; i < c->in->count; i++) {
        double d = (double)c->in->d[i], q = 1 - d;
        c->out->eye[i] = (float)(n / (reversed ? phi * q + d : phi * d + q));
    }
}

/* ---- What is worked out before: over [0, 1] in equal steps of d; z(d) has a pole just beyond its far end --------- */

enum { TABLE = 65536, KNOTS = 4097, ORDER = 40 };

typedef struct table {
    float z[TABLE + 1]; /* the last once more, so that the end needs no test */
} table;

static void *table_open(const dp_setup *setup) {
    table *t = malloc(sizeof *t);
    for (int i = 0; t != NULL && i < TABLE; i++) {
        double last = TABLE - 1;
        t->z[i] = (float)dp_eye(setup, i / last, (last - i) / last);
    }
    if (t != NULL)
        t->z[TABLE] = t->z[TABLE - 1];
    return t;
}

static void table_nearest(const method_call *c) {
    const table *t = c->state;
    for (size_t i = 0; i < c->in->count; i++)
        c->out->eye[i] = t->z[(int)(c->in->d[i] * (TABLE - 1) + 0.5f)];
}

static void table_linear(const method_call *c) {
    const table *t = c->state;
    for (size_t i = 0; i < c->in->count; i++) {
        float at = c->in->d[i] * (TABLE - 1);
        int k = (int)at;
        float part = at - (float)k;
        c->out->eye[i] = t->z[k] + part * (t->z[k + 1] - t->z[k]);
    }
}

typedef struct spline {
    gsl_spline *curve;
    gsl_interp_accel *memory;
} spline;

static void spline_close(void *state) {
    spline *s = state;
    gsl_spline_free(s->curve);
    gsl_interp_accel_free(s->memory);
    free(s);
}

static void *spline_open(const dp_setup *setup) {
    spline *s = calloc(1, sizeof *s);
    double *x = malloc(2 * KNOTS * sizeof *x), *y = x + KNOTS;
    bool good = s != NULL && x != NULL;
    method_start();
    for (int i = 0; good && i < KNOTS; i++) {
        double last = KNOTS - 1;
        x[i] = i / last;
        y[i] = dp_eye(setup, x[i], (last - i) / last);
    }
    if (good) {
        s->curve = gsl_spline_alloc(gsl_interp_cspline, KNOTS);
        s->memory = gsl_interp_accel_alloc();
        good = s->curve != NULL && s->memory != NULL && gsl_spline_init(s->curve, x, y, KNOTS) == 0;
    }
    if (!good && s != NULL) {
        spline_close(s);
        s = NULL;
    }
    free(x);
    return s;
}

static void spline_run(const method_call *c) {
    const spline *s = c->state;
    for (size_t i = 0; i < c->in->count; i++)
        c->out->eye[i] = (float)gsl_spline_eval(s->curve, (double)c->in->d[i], s->memory);
}

static double eye_of(double d, void *setup) {
    return dp_eye(setup, d, 1 - d);
}

static void *chebyshev_open(const dp_setup *setup) {
    method_start();
    gsl_cheb_series *c = gsl_cheb_alloc(ORDER);
    const gsl_function f = {eye_of, (void *)setup};
    if (c != NULL)
        gsl_cheb_init(c, &f, 0, 1);
    return c;
}

static void chebyshev_close(void *state) {
    gsl_cheb_free(state);
}

static void chebyshev_run(const method_call *c) {
    for (size_t i = 0; i < c->in->count; i++)
        c->out->eye[i] = (float)gsl_cheb_eval(c->state, (double)c->in->d[i]);
}

/* ---- Claims ------------------------------------------------------------------------------------------------------ */

/* The square of the error, at most 0.05051, of a reciprocal from the bits of x. */
#define MAGIC 2.552e-3

static double magic_claim(double ratio, double a, double b) {
    const double unity = method_cancelled(ratio, 3, 0);
    (void)a, (void)b;
    return unity + MAGIC * (1 + unity);
}

static double double_claim(double ratio, double a, double b) {
    const double e = (2 * ratio + 1) * 0x1p-53 * (1 + 0x1p-20);
    (void)a, (void)b;
    return (e < 1 ? e / (1 - e) : (double)INFINITY) + DP_UNIT;
}

/* The others interpolate a curve with a pole. Here the roundings of d times 65535 and of the sum with 1/2 move the
 * place by up to 2^-9 of a step. */
static double nearest_claim(double ratio, double a, double b) {
    (void)a, (void)b;
    return (0.5 + 0x1p-9) * (ratio - 1) / (TABLE - 1) + DP_UNIT;
}

static double linear_claim(double ratio, double a, double b) {
    const double g = (ratio - 1) / (TABLE - 1);
    (void)a, (void)b;
    return g / (4 * (1 / g + 1)) + 0x1p-9 * g + 2 * DP_UNIT * (1 + g);
}

static double spline_claim(double ratio, double a, double b) {
    const double g = (ratio - 1) / (KNOTS - 1);
    (void)a, (void)b;
    return 1.25 * g / (10 / g + 4.9) + DP_UNIT * (1 + g / 4);
}

static double chebyshev_claim(double ratio, double a, double b) {
    const double root = sqrt(ratio);
    const double growth = dp_exp((ORDER + 1) * dp_log1p(2 / (root - 1)));
    const double error = 2 / (growth + 1 / growth);
    (void)a, (void)b;
    return error + DP_UNIT * (1 + error) + 0x1p-36;
}

/* ---- Rows, cheapest first ---------------------------------------------------------------------------------------- */

/* Claims of whole roundings are derived: one for each that a result passes through, relative, where no term cancels. */
#define UNIT DP_UNIT
static const char gsl[] = "GNU Scientific Library";

/* clang-format off */
#define CANCELLED(a, b)       FORMULA_TO(METHOD_CANCELLED, method_cancelled, a, b)
#define CANCELLED_FUSED(a, b) FORMULA_TO(METHOD_CANCELLED_FUSED, method_cancelled, a, b)
static const method_row methods[] = {
    {METHOD_LINEARIZE, "ortho-eye", "orthographic: n + (f - n) d in binary32, reversed f - (f - n) d",
     {FULL(3 * UNIT), CANCELLED(3, 0)}, METHOD_ORTHO | METHOD_FLAT, 0.17, "1", 0,
     "the Core package's Common.hlsl", .run = decoded_run, .decode = &decode_rows[DECODE_ORTHO_EYE]},
    {METHOD_LINEARIZE, "ortho-complement", "orthographic: n + (f - n) d in binary32, reversed n + (f - n)(1 - d)",
     {FULL(3 * UNIT), FULL(4 * UNIT)}, METHOD_ORTHO | METHOD_FLAT, 0.18, "1", 0,
     "depthprec(7)", .run = decoded_run, .decode = &decode_rows[DECODE_COMPLEMENT]},
    {METHOD_LINEARIZE, "magic", "1/(Z d + W), the reciprocal from the bits of x and one Newton step",
     {FORMULA_TO(METHOD_CANCELLED, magic_claim, 0, 0), FULL(MAGIC + 7 * UNIT)}, 0, 0.17, "1", 0,
     "the reciprocal by subtraction of bit patterns is folklore", .run = magic_run, .bound = &bound_magic,
     .coarse = "estimate"},
    {METHOD_LINEARIZE, "unity", "1/(Z d + W) in binary32, LinearEyeDepth of Unity with _ZBufferParams",
     {CANCELLED(3, 0), FULL(4 * UNIT)}, METHOD_INFINITE, 0.22, "1", 0,
     "UnityCG.cginc", .run = decoded_run, .decode = &decode_rows[DECODE_LINEAR_EYE], .bound = &bound_unity},
    {METHOD_LINEARIZE, "complement-unity",
     "1/(Z (1 - d) + 1/f), as Unity but of the complement; reversed it is LinearEyeDepth itself",
     {FULL(5 * UNIT), NOWHERE}, METHOD_INFINITE, 0.23, "1", 0,
     "depthprec(7)", .run = decoded_run, .decode = &decode_rows[DECODE_COMPLEMENT], .bound = &bound_complement_unity},
    {METHOD_LINEARIZE, "linear-01", "f times Linear01Depth, 1/(X d + Y), in binary32",
     {CANCELLED_FUSED(2, 2), FULL(6 * UNIT)}, 0, 0.29, "1", 0,
     "UnityCG.cginc", .run = decoded_run, .decode = &decode_rows[DECODE_LINEAR_01], .bound = &bound_linear_01},
    {METHOD_LINEARIZE, "linear-01-near",
     "n + (f - n) times Linear01DepthFromNear, d/(X d + Y) or (1 - d)/(X d + Y), in binary32",
     {CANCELLED_FUSED(2, 4), FULL(8 * UNIT)}, 0, 0.29, "1", 0,
     "the Core package's Common.hlsl", .run = decoded_run, .decode = &decode_rows[DECODE_LINEAR_01_NEAR],
     .bound = &bound_linear_01_near},
    {METHOD_LINEARIZE, "textbook", "n f/(f - d (f - n)) in binary32",
     {CANCELLED(3, 1), FULL(5 * UNIT)}, 0, 0.23, "1", 0,
     "the inverse of the projection, in most tutorials", .run = textbook_run, .bound = &bound_textbook},
    {METHOD_LINEARIZE, "complement", "n f/(n + (1 - d)(f - n)) in binary32: the same number, and no cancellation",
     {FULL(6 * UNIT), FULL(5 * UNIT)}, 0, 0.24, "1", 0,
     "depthprec(7)", .run = complement_run, .bound = &bound_complement},
    {METHOD_LINEARIZE, "complement-newton",
     "n f/(n + (1 - d)(f - n)) in binary32, the reciprocal as estimated by the processor and one Newton step",
     {FULL(10.75 * UNIT), FULL(9.75 * UNIT)}, 0, 0.26, "1", 0,
     "RCPPS: at most 1.5 x 2^-12 relative, on every processor (Intel SDM, AMD APM)", .run = newton_run,
     .timed = rcpps_run, .bound = &bound_newton},
    {METHOD_LINEARIZE, "table-nearest", "the nearest of 65536 depths in equal steps of d, binary32",
     {FORMULA(nearest_claim, 0, 0), FORMULA(nearest_claim, 0, 0)}, 0, 0.6, "1", 0,
     "", .run = table_nearest, .behind = true, .open = table_open, .close = free, .coarse = "table"},
    {METHOD_LINEARIZE, "double", "n f/(f - d (f - n)) in double, rounded to binary32",
     {FORMULA(double_claim, 0, 0), FULL(UNIT)}, 0, 0.58, "1", 0,
     "", .run = double_run, .bound = &bound_double},
    {METHOD_LINEARIZE, "phi-double", "n/(phi d + q) in double, rounded to binary32: what the engine does",
     {FULL(UNIT), FULL(UNIT)}, METHOD_INFINITE, 0.59, "1", 0,
     "depthprec(7)", .run = phi_run, .bound = &bound_phi},
    {METHOD_LINEARIZE, "table-linear", "between two of 65536 depths in equal steps of d, binary32",
     {FORMULA(linear_claim, 0, 0), FORMULA(linear_claim, 0, 0)}, 0, 1.1, "1", 0,
     "", .run = table_linear, .behind = true, .open = table_open, .close = free, .coarse = "table"},
    {METHOD_LINEARIZE, "pair", "the complement form with pairs of binary32 numbers, rounded once",
     {FULL(UNIT + 0x1p-41), FULL(UNIT + 0x1p-41)}, 0, 1.4, "1", 0,
     "Dekker 1971, A floating-point technique for extending the available precision", .run = pair_run,
     .bound = &bound_pair},
    {METHOD_LINEARIZE, "fused", "n f/(f - d (f - n)) in binary32, product and difference in one operation",
     {CANCELLED_FUSED(2, 2), FULL(4 * UNIT)}, 0, 2.2, "1", 0,
     "", .run = fused_run, .bound = &bound_fused},
    {METHOD_LINEARIZE, "log-eye", "logarithmic: ((C f + 1)^d - 1)/C by exp2 in binary32",
     {NOWHERE, NOWHERE, UNCLAIMED}, 0, 4, "1", 0,
     "Kemen, Logarithmic depth buffer, 2009", .run = decoded_run, .decode = &decode_rows[DECODE_LOG_EYE]},
    {METHOD_LINEARIZE, "log-expm1", "logarithmic: expm1(d log(C f + 1))/C in binary32: nothing cancels near the eye",
     {NOWHERE, NOWHERE, FULL(78 * UNIT)}, 0, 8, "1", 0,
     "depthprec(7)", .run = decoded_run, .decode = &decode_rows[DECODE_COMPLEMENT]},
    {METHOD_LINEARIZE, "spline", "cubic spline through 4097 depths in equal steps of d",
     {FORMULA(spline_claim, 0, 0), FORMULA(spline_claim, 0, 0)}, 0, 52, "1", 16384,
     gsl, .run = spline_run, .behind = true, .open = spline_open, .close = spline_close, .coarse = "table"},
    {METHOD_LINEARIZE, "chebyshev", "Chebyshev series of order 40 over d",
     {FORMULA(chebyshev_claim, 0, 0), FORMULA(chebyshev_claim, 0, 0)}, 0, 50, "1", 16384,
     gsl, .run = chebyshev_run, .behind = true, .open = chebyshev_open, .close = chebyshev_close, .coarse = "series"},
};
/* clang-format on */
static const size_t method_count = sizeof methods / sizeof methods[0];

/* The eye depth behind an oblique near plane, in the middle of the picture. */
static double tilted_eye(const dp_setup *setup, double d, double tilt) {
    const double n = setup->spec.znear, near = setup->reversed ? 1 - d : d;
    return n / (1 - near * (1 - n / setup->spec.zfar + tilt));
}

/* Beyond binary32 an exact depth lies next to an infinite far plane only. */
static bool linearize_error_at(const method_call *c, size_t i, method_error *error) {
    const dp_setup *of = c->in->seen != NULL ? c->in->seen : c->setup;
    const double d = (double)c->in->d[i],
                 want = c->in->tilt != 0 ? tilted_eye(of, d, c->in->tilt) : dp_eye(of, d, 1 - d);
    if (c->in->tilt != 0 && !(want > 0 && want <= of->spec.zfar))
        return false; /* behind the far plane of the picture's middle */
    if (of->curve == DP_CURVE_LOG && !(want >= of->spec.znear))
        return false; /* 0 is that of the eye */
    *error = truth_off(c->row->own != NULL ? c->out->value[i] : (double)c->out->eye[i], want, truth_step(want));
    return (!(want > (double)FLT_MAX) || isinf(want)) && !(c->row->own != NULL && isnan(c->out->eye[i]));
}

const method_family_row linearize_family = {
    .name = "linearize",
    .summary = "eye depth of a binary32 window depth",
    .measure = "relative error",
    .cases = {{"fp32 d3d", "fp32", DP_MAPPING_D3D, .gl = true},
              {"fp32 reversed", "fp32", DP_MAPPING_REVERSED, .gl = true},
              {"fp32 log", "fp32", DP_MAPPING_LOG, false}},
    .case_count = 3,
    .inputs = 65536,
    .walked = 1024,
    .per_decade = 2,
    .windows = true,
    .besides = METHOD_BESIDE_ORTHO | METHOD_BESIDE_OBLIQUE | METHOD_BESIDE_LOG,
    .methods = methods,
    .method_count = &method_count,
    .fill = method_windows,
    .judge = linearize_error_at,
    .limit = limit_windows,
};
