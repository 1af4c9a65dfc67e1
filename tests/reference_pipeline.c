/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The binary32 pipeline of depthprec(7), operation by operation, an array pass each. */
#include "reference_pipeline.h"
#include "nvidia.h"

#include <assert.h>
#include <float.h>
#include <math.h>
#include <string.h>

#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__)
#define CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define CLONES
#endif

/* ---- The set-up -------------------------------------------------------------------------------------------------- */

/* The models as depthprec-camera(7) has them for each row. A row that is not here is taken by its public fields. */
static const struct {
    const char *name;
    bool fused;
    dp_reciprocal reciprocal;
    bool remap;
    dp_conversion conversion;
} rows[] = {
    {"ieee", false, DP_RECIPROCAL_NONE, false, DP_CONVERT_EXACT},
    {"fused", true, DP_RECIPROCAL_NONE, false, DP_CONVERT_EXACT},
    {"reciprocal", false, DP_RECIPROCAL_ROUNDED, false, DP_CONVERT_EXACT},
    {"fused-reciprocal", true, DP_RECIPROCAL_ROUNDED, false, DP_CONVERT_EXACT},
    {"product", false, DP_RECIPROCAL_NONE, false, DP_CONVERT_PRODUCT_EVEN},
    {"mesa", false, DP_RECIPROCAL_ROUNDED, false, DP_CONVERT_PRODUCT_EVEN},
    {"softpipe", false, DP_RECIPROCAL_ROUNDED, false, DP_CONVERT_PRODUCT_ZERO},
    {"nvidia", true, DP_RECIPROCAL_UNIT, false, DP_CONVERT_SIXTEENTHS},
    {"ieee-remap", false, DP_RECIPROCAL_NONE, true, DP_CONVERT_EXACT},
    {"mesa-remap", false, DP_RECIPROCAL_ROUNDED, true, DP_CONVERT_PRODUCT_EVEN},
};

/* The entries of the standard mappings; the reversed ones are 1 - d, so NDC is w - clip (d3d) or -clip (gl). */
static void entries(const dp_spec *s, double *a, double *b) {
    const double n = s->znear;
    const double f = s->zfar;
    const double depth = f - n;
    const bool infinite = isinf(f);
    switch (s->mapping) {
    case DP_MAPPING_D3D:
        *a = s->ortho ? 1.0 / depth : infinite ? 1.0 : f / depth;
        *b = s->ortho ? -n / depth : infinite ? -n : -(n * f) / depth;
        return;
    case DP_MAPPING_REVERSED:
        *a = s->ortho ? -1.0 / depth : infinite ? 0.0 : -n / depth;
        *b = s->ortho ? f / depth : infinite ? n : n * f / depth;
        return;
    default:
        *a = s->ortho ? 2.0 / depth : infinite ? 1.0 : (f + n) / depth;
        *b = s->ortho ? -(f + n) / depth : infinite ? -2.0 * n : -(2.0 * n * f) / depth;
        if (s->mapping == DP_MAPPING_GL_REVERSED)
            *a = -*a, *b = -*b;
    }
}

reference_pipe reference_pipe_make(const dp_setup *setup, bool flush) {
    const dp_spec *s = &setup->spec;
    const dp_arith_row *row = dp_arith_get(s->arith);
    double a;
    double b;
    entries(s, &a, &b);
    reference_pipe p = {.a = (float)a,
                        .b = (float)b,
                        .ortho = s->ortho != 0,
                        .reversed = s->mapping == DP_MAPPING_REVERSED || s->mapping == DP_MAPPING_GL_REVERSED,
                        .fused = row->fused != 0,
                        .reciprocal = row->reciprocal,
                        .remap = row->remap != 0,
                        .flush = flush,
                        .conversion = row->conversion,
                        .rounding = s->rounding,
                        .format = s->format};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        if (strcmp(rows[i].name, row->name) == 0)
            p.fused = rows[i].fused, p.reciprocal = rows[i].reciprocal, p.remap = rows[i].remap,
            p.conversion = rows[i].conversion;
    const bool is_signed = s->mapping == DP_MAPPING_GL || s->mapping == DP_MAPPING_GL_REVERSED;
    p.viewport = is_signed && !p.remap;
    p.remap = is_signed && p.remap;
    return p;
}

/* ---- The window depth -------------------------------------------------------------------------------------------- */

static inline float float_of(uint32_t bits) {
    float x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

static inline uint32_t bits_of(float x) {
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

/* a z + b rounded once: the sum in double, rounded to odd, so that rounding it again does no harm. */
static inline float fused_of(float a, float z, float b) {
    const double p = (double)a * (double)z;
    const double s = p + (double)b;
    const double t = s - p;
    const double e = (p - (s - t)) + ((double)b - t);
    int64_t bits;
    memcpy(&bits, &s, sizeof bits);
    const int64_t inexact = e != 0.0;
    const int64_t even = ~bits & 1;
    const int64_t outward = (e > 0.0) == (s > 0.0) ? 1 : -1;
    bits += inexact & even ? outward : 0;
    double odd;
    memcpy(&odd, &bits, sizeof odd);
    return (float)odd;
}

static inline float flushed(float x, bool flush) {
    return flush && fabsf(x) < FLT_MIN ? 0.0F : x;
}

/* The depth of a rank: positive ones are ordered as their bits, negative ones against them. */
static inline float depth_of(uint32_t rank) {
    const uint32_t zero = 0x80000000U;
    return float_of(rank < zero ? zero | (zero - rank) : rank - zero);
}

CLONES static void clip_of(const reference_pipe *p, uint32_t first, int n, float *restrict z, float *restrict clip) {
    const float a = p->a;
    const float b = p->b;
    for (int i = 0; i < n; i++)
        z[i] = flushed(depth_of(first + (uint32_t)i), p->flush);
    if (p->fused)
        for (int i = 0; i < n; i++)
            clip[i] = fused_of(a, z[i], b);
    else if (p->flush)
        for (int i = 0; i < n; i++)
            clip[i] = flushed(a * z[i], true) + b;
    else
        for (int i = 0; i < n; i++)
            clip[i] = a * z[i] + b;
}

CLONES static void window_of(const reference_pipe *p, uint32_t first, int n, float *restrict out) {
    float z[REFERENCE_CHUNK];
    const bool flush = p->flush;
    clip_of(p, first, n, z, out);
    if (p->ortho)
        for (int i = 0; i < n; i++)
            z[i] = 1.0F;
    for (int i = 0; i < n; i++)
        out[i] = flushed(out[i], flush);
    if (p->remap)
        for (int i = 0; i < n; i++)
            out[i] = flushed(flushed(out[i] + z[i], flush) * 0.5F, flush);
    if (p->reciprocal)
        for (int i = 0; i < n; i++)
            out[i] = flushed(out[i] * flushed(nvidia_inverse(p->reciprocal, z[i]), flush), flush);
    else
        for (int i = 0; i < n; i++)
            out[i] = flushed(out[i] / z[i], flush);
    if (p->viewport)
        for (int i = 0; i < n; i++)
            out[i] = flushed(flushed(0.5F * out[i], flush) + 0.5F, flush);
}

/* ---- The format -------------------------------------------------------------------------------------------------- */

/* A whole number below 2^32 as an integer. */
static inline uint32_t whole(double x) {
    const double shifted = x + 0x1p52;
    uint64_t bits;
    memcpy(&bits, &shifted, sizeof bits);
    return (uint32_t)bits;
}

/*
 * The code of p + e, where p >= 0 is a double and e, far below the last place of p, what it lacks. Magic addition
 * rounds p to even; from there the floor and the fraction are exact.
 */
static inline double rounded(double p, double e, dp_rounding rounding) {
    const double even = (p + 0x1p52) - 0x1p52;
    const double floor_p = even - (double)(even > p);
    const double above = ((p - floor_p) - 0.5) + e;         /* its sign is exact */
    const double below = (double)((p - floor_p) + e < 0.0); /* p was rounded up to a whole number */
    return rounding == DP_ROUND_ZERO      ? floor_p - below
           : rounding == DP_ROUND_NEAREST ? floor_p + (double)(above >= 0.0)
           : above == 0.0                 ? even
                                          : floor_p + (double)(above > 0.0);
}

#define CLAMPED(w) ((w) > 0.0F ? (w) < 1.0F ? (w) : 1.0F : 0.0F) /* NaN becomes 0 */

/* d (2^N - 1) = d 2^N - d exactly, as a double and its error. */
CLONES static void unorm_exact(const reference_pipe *p, const float *restrict w, int n, uint32_t *restrict keys) {
    const double scale = (double)(1ULL << p->format.bits);
    const dp_rounding rounding = p->rounding;
#define LOOP(r)                                                                                                        \
    for (int i = 0; i < n; i++) {                                                                                      \
        const double d = (double)CLAMPED(w[i]);                                                                        \
        const double large = d * scale;                                                                                \
        const double product = large - d;                                                                              \
        keys[i] = whole(rounded(product, (large - product) - d, r));                                                   \
    }
    if (rounding == DP_ROUND_NEAREST)
        LOOP(DP_ROUND_NEAREST)
    else if (rounding == DP_ROUND_ZERO)
        LOOP(DP_ROUND_ZERO)
    else
        LOOP(DP_ROUND_EVEN)
#undef LOOP
}

/* The binary32 product: the exact one rounded once, then to a whole number. */
CLONES static void unorm_product(const reference_pipe *p, const float *restrict w, int n, uint32_t *restrict keys) {
    const float scale = (float)(double)((1ULL << p->format.bits) - 1);
    const double most = (double)((1ULL << p->format.bits) - 1);
    if (p->conversion == DP_CONVERT_PRODUCT_ZERO)
        for (int i = 0; i < n; i++) {
            const double product = rounded((double)(CLAMPED(w[i]) * scale), 0.0, DP_ROUND_ZERO);
            keys[i] = whole(product < most ? product : most);
        }
    else
        for (int i = 0; i < n; i++) {
            const double product = rounded((double)(CLAMPED(w[i]) * scale), 0.0, DP_ROUND_EVEN);
            keys[i] = whole(product < most ? product : most);
        }
}

static void unorm_nvidia(const reference_pipe *p, const float *restrict w, int n, uint32_t *restrict keys) {
    for (int i = 0; i < n; i++)
        keys[i] = (uint32_t)nvidia_code(p->format.bits, CLAMPED(w[i]));
}

/* A multiple of the step of d's binade, in the order of its binary32 bits: no binary32 d leaves binary32. */
CLONES static void float_key(const reference_pipe *p, const float *restrict w, int n, uint32_t *restrict keys) {
    const double least = ldexp(1.0, 1 - p->format.bias);
    const double unit = ldexp(1.0, -p->format.mantissa_bits);
    const double truncate = p->rounding == DP_ROUND_ZERO ? 1.0 : 0.0;
    for (int i = 0; i < n; i++) {
        const double d = (double)CLAMPED(w[i]);
        uint64_t bits;
        memcpy(&bits, &d, sizeof bits);
        bits &= 0x7ff0000000000000U;
        double binade;
        memcpy(&binade, &bits, sizeof binade);
        const double step = (binade > least ? binade : least) * unit;
        const double magic = 0x1.8p52 * step;
        const double even = (d + magic) - magic;
        const double value = even - truncate * (double)(even > d) * step;
        keys[i] = bits_of((float)value);
    }
}

void reference_keys(const reference_pipe *p, uint32_t first, size_t count, uint32_t *keys) {
    const uint32_t flip = p->reversed ? UINT32_MAX : 0;
    for (size_t done = 0; done < count; done += REFERENCE_CHUNK) {
        float w[REFERENCE_CHUNK];
        uint32_t part[REFERENCE_CHUNK];
        const int take = count - done < REFERENCE_CHUNK ? (int)(count - done) : REFERENCE_CHUNK;
        window_of(p, first + (uint32_t)done, take, w);
        if (p->format.kind == DP_FORMAT_FLOAT)
            float_key(p, w, take, part);
        else if (p->conversion == DP_CONVERT_EXACT)
            unorm_exact(p, w, take, part);
        else if (p->conversion == DP_CONVERT_SIXTEENTHS)
            unorm_nvidia(p, w, take, part);
        else
            unorm_product(p, w, take, part);
        for (int i = 0; i < take; i++)
            keys[done + (size_t)i] = part[i] ^ flip;
    }
}

/* ---- One depth --------------------------------------------------------------------------------------------------- */

uint32_t reference_key(const reference_pipe *p, uint32_t rank) {
    uint32_t key;
    reference_keys(p, rank, 1, &key);
    return key;
}

float reference_window(const reference_pipe *p, uint32_t rank) {
    float w;
    window_of(p, rank, 1, &w);
    return w;
}

uint32_t reference_code(const reference_pipe *p, uint32_t key) {
    const uint32_t bits = p->reversed ? ~key : key;
    if (p->format.kind == DP_FORMAT_UNORM)
        return bits;
    const int m = p->format.mantissa_bits;
    const double value = (double)float_of(bits);
    const double least = ldexp(1.0, 1 - p->format.bias);
    if (value < least)
        return (uint32_t)(value / ldexp(least, -m));
    int exponent;
    const double fraction = frexp(value, &exponent); /* value = fraction 2^exponent, fraction in [1/2, 1) */
    const uint32_t field = (uint32_t)(exponent - 1 + p->format.bias);
    return (field << m) + (uint32_t)ldexp(2.0 * fraction - 1.0, m);
}

bool reference_subnormal(const reference_pipe *p, uint32_t rank) {
    const double z = (double)depth_of(rank);
    const double w = p->ortho ? 1.0 : z;
    const double product = fabs((double)p->a * z);
    const double window = fabs(((double)p->a * z + (double)p->b) / w);
    return w > 0x1p125 || fabs(z) < 0x1p-125 || (product > 0.0 && product < 0x1p-125) ||
           (window > 0.0 && window < 0x1p-123);
}
