/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The code of a binary32 window depth in [0, 1]. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "method/method.h"
#if defined(__x86_64__)
#include <immintrin.h>
#endif

static uint32_t bits_of(float x) {
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

/* ---- fp16 -------------------------------------------------------------------------------------------------------- */

/* Ties to even: below 2^-14 the addition of 1/2 rounds to the step of the subnormals, which are the low bits of the
 * sum; above, half a step less the lowest kept bit is added to the bits. Both are computed and one is chosen. */
static void bits_run(const dp_setup *setup, const void *state, const method_inputs *in, const method_outputs *out) {
    (void)setup;
    (void)state;
    for (size_t i = 0; i < in->count; i++) {
        uint32_t x = bits_of(in->d[i]);
        uint32_t small = bits_of(in->d[i] + 0.5f) - bits_of(0.5f);
        uint32_t normal = (x - (112u << 23) + 0xfffu + (x >> 13 & 1u)) >> 13;
        out->code[i] = (int32_t)x < 113 << 23 ? small : normal;
    }
}

/* For each of the 256 exponents the code of its lowest value and how far its mantissa is shifted: truncates. */
typedef struct half_table {
    uint16_t base[256];
    uint8_t shift[256];
} half_table;

static void *half_open(const dp_setup *setup) {
    half_table *t = calloc(1, sizeof *t);
    for (int e = 0; t != NULL && e < 256; e++) {
        double lowest = ldexp(1.0, e - 127);
        t->base[e] = (uint16_t)dp_format_encode(&setup->spec.format, DP_ROUND_ZERO, fmin(e > 0 ? lowest : 0, 1));
        t->shift[e] = (uint8_t)(e >= 127 || e < 103 ? 24 : e >= 113 ? 13 : 126 - e);
    }
    return t;
}

static void half_run(const dp_setup *setup, const void *state, const method_inputs *in, const method_outputs *out) {
    const half_table *t = state;
    (void)setup;
    for (size_t i = 0; i < in->count; i++) {
        uint32_t x = bits_of(in->d[i]), e = x >> 23;
        out->code[i] = t->base[e] + ((x & 0x7fffffu) >> t->shift[e]);
    }
}

#if defined(__x86_64__)
static bool has_f16c(void) {
    return __builtin_cpu_supports("avx2"); /* has F16C too; clang has no name for it here */
}

__attribute__((target("avx,f16c"))) static void f16c_run(const dp_setup *setup, const void *state,
                                                         const method_inputs *in, const method_outputs *out) {
    (void)setup;
    (void)state;
    size_t i = 0;
    for (; i + 8 <= in->count; i += 8) {
        __m128i half = _mm256_cvtps_ph(_mm256_loadu_ps(in->d + i), _MM_FROUND_TO_NEAREST_INT);
        _mm_storeu_si128((__m128i *)(void *)(out->code + i), _mm_cvtepu16_epi32(half));
        _mm_storeu_si128((__m128i *)(void *)(out->code + i + 4), _mm_cvtepu16_epi32(_mm_srli_si128(half, 8)));
    }
    for (; i < in->count; i++)
        out->code[i] = (uint32_t)_mm_extract_epi16(_mm_cvtps_ph(_mm_set_ss(in->d[i]), _MM_FROUND_TO_NEAREST_INT), 0);
}
#else
static bool has_f16c(void) {
    return false;
}
#define f16c_run bits_run
#endif

/* ---- UNORM ------------------------------------------------------------------------------------------------------- */

static void floor_run(const dp_setup *setup, const void *state, const method_inputs *in, const method_outputs *out) {
    const float most = (float)setup->spec.format.code_max;
    (void)state;
    for (size_t i = 0; i < in->count; i++)
        out->code[i] = (uint32_t)(int32_t)(in->d[i] * most + 0.5f);
}

static void rint_run(const dp_setup *setup, const void *state, const method_inputs *in, const method_outputs *out) {
    const float most = (float)setup->spec.format.code_max;
    (void)state;
    for (size_t i = 0; i < in->count; i++)
        out->code[i] = (uint32_t)(int32_t)rintf(in->d[i] * most);
}

/* The addition of 2^23 leaves whole numbers only, in the low bits of the sum. */
static void magic_run(const dp_setup *setup, const void *state, const method_inputs *in, const method_outputs *out) {
    const float most = (float)setup->spec.format.code_max;
    (void)state;
    for (size_t i = 0; i < in->count; i++)
        out->code[i] = bits_of(in->d[i] * most + 0x1p23f) - bits_of(0x1p23f);
}

static void double_run(const dp_setup *setup, const void *state, const method_inputs *in, const method_outputs *out) {
    const double most = setup->spec.format.code_max;
    (void)state;
    for (size_t i = 0; i < in->count; i++)
        out->code[i] = (uint32_t)(int32_t)((double)in->d[i] * most + 0.5);
}

static void engine_run(const dp_setup *setup, const void *state, const method_inputs *in, const method_outputs *out) {
    (void)state;
    for (size_t i = 0; i < in->count; i++)
        out->code[i] = dp_format_encode(&setup->spec.format, setup->spec.rounding, (double)in->d[i]);
}

#define ANY (METHOD_INFINITE | METHOD_ORTHO)
static const char clause[] = "D3D 11.3 functional specification 3.2.3.6";

/* clang-format off */
const method_row encode_methods[] = {
    {METHOD_ENCODE, "f16c", "fp16 by the processor's own conversion",
     {FULL(0.5)}, ANY, 0.1, "1", 0, "VCVTPS2PH", has_f16c, NULL, f16c_run, NULL},
    {METHOD_ENCODE, "magic", "UNORM: the low bits of fl(fl(d M) + 2^23)",
     {NOWHERE, FULL(0.5 + 0x1p-9), UNCLAIMED}, ANY, 0.2, "1", 0, "", NULL, NULL, magic_run, NULL},
    {METHOD_ENCODE, "floor", "UNORM: floor(fl(fl(d M) + 0.5)) in binary32; with 24 bits d = 1 becomes 2^24, which is no code",
     {NOWHERE, FULL(0.5 + 0x1p-9), UNCLAIMED}, ANY, 0.25, "1", 0, clause, NULL, NULL, floor_run, NULL},
    {METHOD_ENCODE, "rint", "UNORM: fl(d M) in binary32, ties to even",
     {NOWHERE, FULL(0.5 + 0x1p-9), FULL(0.75)}, ANY, 0.4, "1", 0, "", NULL, NULL, rint_run, NULL},
    {METHOD_ENCODE, "floor-double", "UNORM: floor(d M + 0.5) in double: d M is exact, ties go up",
     {NOWHERE, FULL(0.5), FULL(0.5)}, ANY, 0.6, "1", 0, clause, NULL, NULL, double_run, NULL},
    {METHOD_ENCODE, "bits", "fp16 by integer arithmetic on the bits, ties to even",
     {FULL(0.5)}, ANY, 0.7, "1", 0, "", NULL, NULL, bits_run, NULL},
    {METHOD_ENCODE, "table", "fp16 by a table of bases and shifts, truncated",
     {FULL(1.0)}, ANY, 0.9, "1", 0, "van der Zijp 2008, Fast half float conversions", NULL, half_open, half_run, free},
    {METHOD_ENCODE, "engine", "the engine, for each format and rounding",
     {FULL(0.5), FULL(0.5), FULL(0.5)}, ANY, 8, "1", 16384, "depthprec(3)", NULL, NULL, engine_run,
     NULL},
};
/* clang-format on */
const size_t encode_method_count = sizeof encode_methods / sizeof encode_methods[0];

/* Exact: |d - value of the code| in steps of the format around d. d has 24 bits and M at most 24, so d M is a double.
 */
bool encode_judge(const method_row *row, const dp_setup *setup, const method_inputs *in, const method_outputs *out,
                  size_t i, method_error *error) {
    const dp_format *f = &setup->spec.format;
    double d = (double)in->d[i];
    uint32_t code = out->code[i];
    (void)row;
    if (code > f->code_max) {
        *error = (method_error){(double)INFINITY, (double)INFINITY, (double)INFINITY};
        return true;
    }
    double steps;
    if (f->kind == DP_FORMAT_UNORM) {
        steps = fabs(d * f->code_max - code);
    } else {
        uint32_t below = dp_format_encode(f, DP_ROUND_ZERO, d);
        below -= below == f->code_max;
        double base = dp_format_value(f, below);
        steps = fabs(d - dp_format_value(f, code)) / (dp_format_value(f, below + 1) - base);
    }
    double off = fabs(dp_format_value(f, code) - d);
    *error = (method_error){off, d > 0 ? off / d : off > 0 ? (double)INFINITY : 0, steps};
    return true;
}
