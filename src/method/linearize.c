/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Eye depth of a binary32 window depth. Constants are formed in double and rounded once, as an engine uploads them. */
#include "method/linearize.h"

#include <float.h>
#include <math.h>
#include <string.h>
#if defined(__SSE__)
#include <xmmintrin.h>
#endif

#include "method/claim.h"
#include "method/estimate.h"
#include "texture/decode.h"

static bool is_reversed(const dp_setup *setup) {
    return setup->reversed != 0;
}

/* ---- The rows of texture/decode.h -------------------------------------------------------------------------------- */

static void decode(const char *name, const dp_setup *setup, const method_inputs *in, const method_outputs *out) {
    decode_find(name)->run(setup, in->d, out->eye, in->count);
}

static void unity_run(const dp_setup *setup, const void *state, const method_inputs *in, const method_outputs *out) {
    (void)state;
    decode("linear-eye", setup, in, out);
}

static void complement_unity_run(const dp_setup *setup, const void *state, const method_inputs *in,
                                 const method_outputs *out) {
    (void)state;
    decode("complement", setup, in, out);
}

static void linear_01_run(const dp_setup *setup, const void *state, const method_inputs *in,
                          const method_outputs *out) {
    const float f = (float)setup->spec.zfar;
    (void)state;
    decode("linear-01", setup, in, out);
    for (size_t i = 0; i < in->count; i++)
        out->eye[i] = f * out->eye[i];
}

static void linear_01_near_run(const dp_setup *setup, const void *state, const method_inputs *in,
                               const method_outputs *out) {
    const float n = (float)setup->spec.znear, depth = (float)(setup->spec.zfar - setup->spec.znear);
    (void)state;
    decode("linear-01-near", setup, in, out);
    for (size_t i = 0; i < in->count; i++)
        out->eye[i] = n + depth * out->eye[i];
}

/* The reciprocal of x > 0 from its bits, within 12 %, then one Newton step. */
static float magic_reciprocal(float x) {
    uint32_t bits;
    float y;
    memcpy(&bits, &x, sizeof bits);
    bits = 0x7ef311c7u - bits;
    memcpy(&y, &bits, sizeof y);
    return y * (2.0f - x * y);
}

static void magic_run(const dp_setup *setup, const void *state, const method_inputs *in, const method_outputs *out) {
    const zbuffer_params p = zbuffer_params_of(setup);
    (void)state;
    for (size_t i = 0; i < in->count; i++)
        out->eye[i] = magic_reciprocal(p.z * in->d[i] + p.w);
}

/* ---- n f/(f - d (f - n)) ----------------------------------------------------------------------------------------- */

/* product/(base + slope d) */
typedef struct textbook {
    double product, base, slope;
} textbook;

static textbook textbook_of(const dp_setup *setup) {
    double n = setup->spec.znear, f = setup->spec.zfar;
    return is_reversed(setup) ? (textbook){n * f, n, f - n} : (textbook){n * f, f, n - f};
}

static void textbook_run(const dp_setup *setup, const void *state, const method_inputs *in, const method_outputs *out) {
    const textbook t = textbook_of(setup);
    const float product = (float)t.product, base = (float)t.base, slope = (float)t.slope;
    (void)state;
    for (size_t i = 0; i < in->count; i++)
        out->eye[i] = product / (base + slope * in->d[i]);
}

static void fused_run(const dp_setup *setup, const void *state, const method_inputs *in, const method_outputs *out) {
    const textbook t = textbook_of(setup);
    const float product = (float)t.product, base = (float)t.base, slope = (float)t.slope;
    (void)state;
    for (size_t i = 0; i < in->count; i++)
        out->eye[i] = product / fmaf(slope, in->d[i], base);
}

static void double_run(const dp_setup *setup, const void *state, const method_inputs *in, const method_outputs *out) {
    const textbook t = textbook_of(setup);
    (void)state;
    for (size_t i = 0; i < in->count; i++)
        out->eye[i] = (float)(t.product / (t.base + t.slope * (double)in->d[i]));
}

/* ---- n f/(n + (1 - d)(f - n)): all terms positive ---------------------------------------------------------------- */

/* The share of the way from the far plane: 1 - d, or d itself where near is stored as 1. */
static float toward_near(bool reversed, float d) {
    return reversed ? d : 1.0f - d;
}

static void complement_run(const dp_setup *setup, const void *state, const method_inputs *in,
                           const method_outputs *out) {
    const double n = setup->spec.znear, f = setup->spec.zfar;
    const float product = (float)(n * f), base = (float)n, slope = (float)(f - n);
    const bool reversed = is_reversed(setup);
    (void)state;
    for (size_t i = 0; i < in->count; i++)
        out->eye[i] = product / (base + slope * toward_near(reversed, in->d[i]));
}

static void newton_run(const dp_setup *setup, const void *state, const method_inputs *in, const method_outputs *out) {
    const double n = setup->spec.znear, f = setup->spec.zfar;
    const float product = (float)(n * f), base = (float)n, slope = (float)(f - n);
    const bool reversed = is_reversed(setup);
    (void)state;
    for (size_t i = 0; i < in->count; i++) {
        const float x = base + slope * toward_near(reversed, in->d[i]), y = estimate_reciprocal(x);
        out->eye[i] = product * (y * (2.0f - x * y));
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

static void rcpps_run(const dp_setup *setup, const void *state, const method_inputs *in, const method_outputs *out) {
    const double n = setup->spec.znear, f = setup->spec.zfar;
    const bool reversed = is_reversed(setup);
    const newton c = {_mm_set1_ps((float)(n * f)), _mm_set1_ps((float)n), _mm_set1_ps((float)(f - n)),
                      _mm_set1_ps(reversed ? 0.0f : 1.0f), _mm_set1_ps(reversed ? 1.0f : -1.0f)};
    (void)state;
    size_t i = 0;
    for (; i + 4 <= in->count; i += 4)
        _mm_storeu_ps(out->eye + i, newton_four(&c, _mm_loadu_ps(in->d + i)));
    for (; i < in->count; i++)
        out->eye[i] = _mm_cvtss_f32(newton_four(&c, _mm_set1_ps(in->d[i])));
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

static void pair_run(const dp_setup *setup, const void *state, const method_inputs *in, const method_outputs *out) {
    const double n = setup->spec.znear, f = setup->spec.zfar;
    /* In units of near: then nothing leaves the range of binary32, whatever the scene's units are. */
    const pair slope = pair_of(f / n - 1), product = pair_of(f);
    const float from = is_reversed(setup) ? 0.0f : 1.0f, sign = is_reversed(setup) ? 1.0f : -1.0f;
    (void)state;
    for (size_t i = 0; i < in->count; i++) {
        pair q = two_sum(from, sign * in->d[i]);
        pair m = two_product(slope.hi, q.hi);
        m.lo += slope.hi * q.lo + slope.lo * q.hi;
        pair x = two_sum(1.0f, m.hi);
        x.lo += m.lo;
        float z = product.hi / x.hi;
        pair back = two_product(z, x.hi);
        out->eye[i] = z + (((product.hi - back.hi) - back.lo) + (product.lo - z * x.lo)) / x.hi;
    }
}

/* As the engine has it: n/(phi d + q), which also has a limit for an infinite far plane. */
static void phi_run(const dp_setup *setup, const void *state, const method_inputs *in, const method_outputs *out) {
    const double n = setup->spec.znear, phi = n / setup->spec.zfar;
    const bool reversed = is_reversed(setup);
    (void)state;
    for (size_t i = 0; i < in->count; i++) {
        double d = (double)in->d[i], q = 1 - d;
        out->eye[i] = (float)(n / (reversed ? phi * q + d : phi * d + q));
    }
}

/* ---- Rows, cheapest first ---------------------------------------------------------------------------------------- */

/* Claims of whole roundings are derived: one for each that a result passes through, relative, where no term cancels. */
#define UNIT CLAIM_UNIT
static const char gsl[] = "GNU Scientific Library";

/* clang-format off */
const method_row linearize_methods[] = {
    {METHOD_LINEARIZE, "magic", "1/(Z d + W), the reciprocal from the bits of x and one Newton step",
     {FORMULA_TO(claim_magic, CLAIM_CANCELLED), FULL(CLAIM_MAGIC + 7 * UNIT)}, 0, 0.17, "1", 0,
     "the reciprocal by subtraction of bit patterns is folklore", NULL, NULL, magic_run, NULL},
    {METHOD_LINEARIZE, "unity", "1/(Z d + W) in binary32, LinearEyeDepth of Unity with _ZBufferParams",
     {FORMULA_TO(claim_unity, CLAIM_CANCELLED), FULL(4 * UNIT)}, METHOD_INFINITE, 0.22, "1", 0,
     "UnityCG.cginc", NULL, NULL, unity_run, NULL},
    {METHOD_LINEARIZE, "complement-unity",
     "1/(Z (1 - d) + 1/f), as Unity but of the complement; reversed it is LinearEyeDepth itself",
     {FULL(5 * UNIT), NOWHERE}, METHOD_INFINITE, 0.23, "1", 0,
     "depthprec(7)", NULL, NULL, complement_unity_run, NULL},
    {METHOD_LINEARIZE, "linear-01", "f times Linear01Depth, 1/(X d + Y), in binary32",
     {FORMULA_TO(claim_linear_01, CLAIM_CANCELLED_FUSED), FULL(6 * UNIT)}, 0, 0.29, "1", 0,
     "UnityCG.cginc", NULL, NULL, linear_01_run, NULL},
    {METHOD_LINEARIZE, "linear-01-near",
     "n + (f - n) times Linear01DepthFromNear, d/(X d + Y) or (1 - d)/(X d + Y), in binary32",
     {FORMULA_TO(claim_linear_01_near, CLAIM_CANCELLED_FUSED), FULL(8 * UNIT)}, 0, 0.29, "1", 0,
     "the Core package's Common.hlsl", NULL, NULL, linear_01_near_run, NULL},
    {METHOD_LINEARIZE, "textbook", "n f/(f - d (f - n)) in binary32",
     {FORMULA_TO(claim_textbook, CLAIM_CANCELLED), FULL(5 * UNIT)}, 0, 0.23, "1", 0,
     "the inverse of the projection, in most tutorials", NULL, NULL, textbook_run, NULL},
    {METHOD_LINEARIZE, "complement", "n f/(n + (1 - d)(f - n)) in binary32: the same number, and no cancellation",
     {FULL(6 * UNIT), FULL(5 * UNIT)}, 0, 0.24, "1", 0,
     "depthprec(7)", NULL, NULL, complement_run, NULL},
    {METHOD_LINEARIZE, "complement-newton",
     "n f/(n + (1 - d)(f - n)) in binary32, the reciprocal as estimated by the processor and one Newton step",
     {FULL(10.75 * UNIT), FULL(9.75 * UNIT)}, 0, 0.26, "1", 0,
     "RCPPS: at most 1.5 x 2^-12 relative, on every processor (Intel SDM, AMD APM)", NULL, NULL, newton_run, NULL},
    {METHOD_LINEARIZE, "table-nearest", "the nearest of 65536 depths in equal steps of d, binary32",
     {FORMULA(claim_table_nearest), FORMULA(claim_table_nearest)}, 0, 0.6, "1", 0,
     "", NULL, table_open, table_nearest, table_close},
    {METHOD_LINEARIZE, "double", "n f/(f - d (f - n)) in double, rounded to binary32",
     {FORMULA(claim_double), FULL(UNIT)}, 0, 0.58, "1", 0,
     "", NULL, NULL, double_run, NULL},
    {METHOD_LINEARIZE, "phi-double", "n/(phi d + q) in double, rounded to binary32: what the engine does",
     {FULL(UNIT), FULL(UNIT)}, METHOD_INFINITE, 0.59, "1", 0,
     "depthprec(7)", NULL, NULL, phi_run, NULL},
    {METHOD_LINEARIZE, "table-linear", "between two of 65536 depths in equal steps of d, binary32",
     {FORMULA(claim_table_linear), FORMULA(claim_table_linear)}, 0, 1.1, "1", 0,
     "", NULL, table_open, table_linear, table_close},
    {METHOD_LINEARIZE, "pair", "the complement form with pairs of binary32 numbers, rounded once",
     {FULL(UNIT + 0x1p-41), FULL(UNIT + 0x1p-41)}, 0, 1.4, "1", 0,
     "Dekker 1971, A floating-point technique for extending the available precision", NULL, NULL, pair_run, NULL},
    {METHOD_LINEARIZE, "fused", "n f/(f - d (f - n)) in binary32, product and difference in one operation",
     {FORMULA_TO(claim_fused, CLAIM_CANCELLED_FUSED), FULL(4 * UNIT)}, 0, 2.2, "1", 0,
     "", NULL, NULL, fused_run, NULL},
    {METHOD_LINEARIZE, "spline", "cubic spline through 4097 depths in equal steps of d",
     {FORMULA(claim_spline), FORMULA(claim_spline)}, 0, 52, "1", 16384,
     gsl, NULL, spline_open, spline_run, spline_close},
    {METHOD_LINEARIZE, "chebyshev", "Chebyshev series of order 40 over d",
     {FORMULA(claim_chebyshev), FORMULA(claim_chebyshev)}, 0, 50, "1", 16384,
     gsl, NULL, chebyshev_open, chebyshev_run, chebyshev_close},
};
/* clang-format on */
const size_t linearize_method_count = sizeof linearize_methods / sizeof linearize_methods[0];

method_run *linearize_timed(const method_row *row) {
    return row->run == newton_run ? rcpps_run : NULL;
}

bool linearize_judge(const method_row *row, const dp_setup *setup, const method_inputs *in, const method_outputs *out,
                     size_t i, method_error *error) {
    double d = (double)in->d[i], want = dp_eye(setup, d, 1 - d), got = (double)out->eye[i];
    (void)row;
    if (want > (double)FLT_MAX && !isinf(want)) /* beyond binary32: next to an infinite far plane only */
        return false;
    double off = got == want ? 0 : fabs(got - want); /* both infinite: right */
    if (!(off < (double)INFINITY))
        off = (double)INFINITY;
    float nearest = (float)want;
    double unit = (double)nextafterf(nearest, INFINITY) - (double)nearest;
    *error = (method_error){off,
                            off == 0     ? 0
                            : isinf(off) ? off
                                         : off / want,
                            off == 0     ? 0
                            : isinf(off) ? off
                                         : off / unit};
    return true;
}
