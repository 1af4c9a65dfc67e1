/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The code of a binary32 window depth in [0, 1]. */
#include <math.h>
#include <stdlib.h>

#include "core/bits.h"
#include "core/clones.h"
#include "method/bound.h"
#include "method/method.h"
#if defined(__x86_64__)
#include <immintrin.h>
#endif

/* ---- fp16 -------------------------------------------------------------------------------------------------------- */

/* Ties to even: below 2^-14 the addition of 1/2 rounds to the step of the subnormals, which are the low bits of the
 * sum; above, half a step less the lowest kept bit is added to the bits. Both are computed and one is chosen. */
CLONES static void bits_run(const method_call *c) {
    for (size_t i = 0; i < c->in->count; i++) {
        uint32_t x = dp_bits32(c->in->d[i]);
        uint32_t small = dp_bits32(c->in->d[i] + 0.5f) - dp_bits32(0.5f);
        uint32_t normal = (x - (112u << 23) + 0xfffu + (x >> 13 & 1u)) >> 13;
        c->out->code[i] = (int32_t)x < 113 << 23 ? small : normal;
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

static void half_run(const method_call *c) {
    const half_table *t = c->state;
    for (size_t i = 0; i < c->in->count; i++) {
        uint32_t x = dp_bits32(c->in->d[i]), e = x >> 23;
        c->out->code[i] = t->base[e] + ((x & 0x7fffffu) >> t->shift[e]);
    }
}

#if defined(__x86_64__)
static bool has_f16c(void) {
    return __builtin_cpu_supports("avx2"); /* has F16C too; clang has no name for it here */
}

__attribute__((target("avx,f16c"))) static void f16c_run(const method_call *c) {
    const float *d = c->in->d;
    const size_t count = c->in->count;
    uint32_t *code = c->out->code;
    size_t i = 0;
    for (; i + 8 <= count; i += 8) {
        __m128i half = _mm256_cvtps_ph(_mm256_loadu_ps(d + i), _MM_FROUND_TO_NEAREST_INT);
        _mm_storeu_si128((__m128i *)(void *)(code + i), _mm_cvtepu16_epi32(half));
        _mm_storeu_si128((__m128i *)(void *)(code + i + 4), _mm_cvtepu16_epi32(_mm_srli_si128(half, 8)));
    }
    for (; i < count; i++)
        code[i] = (uint32_t)_mm_extract_epi16(_mm_cvtps_ph(_mm_set_ss(d[i]), _MM_FROUND_TO_NEAREST_INT), 0);
}
#else
static bool has_f16c(void) {
    return false;
}
#define f16c_run bits_run
#endif

/* ---- UNORM ------------------------------------------------------------------------------------------------------- */

CLONES static void floor_run(const method_call *c) {
    const float most = (float)c->setup->spec.format.code_max;
    for (size_t i = 0; i < c->in->count; i++)
        c->out->code[i] = (uint32_t)(int32_t)(c->in->d[i] * most + 0.5f);
}

CLONES static void rint_run(const method_call *c) {
    const float most = (float)c->setup->spec.format.code_max;
    for (size_t i = 0; i < c->in->count; i++)
        c->out->code[i] = (uint32_t)(int32_t)rintf(c->in->d[i] * most);
}

/* The addition of 2^23 leaves whole numbers only, in the low bits of the sum. */
CLONES static void magic_run(const method_call *c) {
    const float most = (float)c->setup->spec.format.code_max;
    for (size_t i = 0; i < c->in->count; i++)
        c->out->code[i] = dp_bits32(c->in->d[i] * most + 0x1p23f) - dp_bits32(0x1p23f);
}

CLONES static void double_run(const method_call *c) {
    const double most = c->setup->spec.format.code_max;
    for (size_t i = 0; i < c->in->count; i++)
        c->out->code[i] = (uint32_t)(int32_t)((double)c->in->d[i] * most + 0.5);
}

static void engine_run(const method_call *c) {
    for (size_t i = 0; i < c->in->count; i++)
        c->out->code[i] = dp_format_encode(&c->setup->spec.format, c->setup->spec.rounding, (double)c->in->d[i]);
}

/* ---- fp32 -------------------------------------------------------------------------------------------------------- */

CLONES static void same_run(const method_call *c) {
    for (size_t i = 0; i < c->in->count; i++)
        c->out->code[i] = dp_bits32(c->in->d[i]);
}

/* The steps as texts, from which code is printed. */
static const bound_steps floor_steps = {.constants = {"M = most; H = 1/2", "M = most; H = 1/2"},
                                        .steps = {"k = whole(d*M + H)", "k = whole(d*M + H)"}};
static const bound_steps rint_steps = {.constants = {"M = most", "M = most"},
                                       .steps = {"k = whole(even(d*M))", "k = whole(even(d*M))"}};
static const bound_steps double_steps = {.wide = true,
                                         .constants = {"M = most; H = 1/2", "M = most; H = 1/2"},
                                         .steps = {"k = whole(d*M + H)", "k = whole(d*M + H)"}};

#define ANY   (METHOD_INFINITE | METHOD_ORTHO)
#define EXACT 0x1p-53
static const char clause[] = "D3D 11.3 functional specification 3.2.3.6";

/* clang-format off */
static const method_row methods[] = {
    {METHOD_ENCODE, "f16c", "fp16 by the processor's own conversion",
     {FULL(0.5)}, ANY, 0.1, "1", 0, "VCVTPS2PH", .run = f16c_run, .available = has_f16c},
    {METHOD_ENCODE, "magic", "UNORM: the low bits of fl(fl(d M) + 2^23)",
     {NOWHERE, FULL(0.5 + 0x1p-9), UNCLAIMED}, ANY, 0.2, "1", 0, "", .run = magic_run, .coarse = "overflow"},
    {METHOD_ENCODE, "floor",
     "UNORM: floor(fl(fl(d M) + 0.5)) in binary32; with 24 bits d = 1 becomes 2^24, which is no code",
     {NOWHERE, FULL(0.5 + 0x1p-9), UNCLAIMED}, ANY, 0.25, "1", 0, clause, .run = floor_run, .bound = &floor_steps,
     .coarse = "overflow"},
    {METHOD_ENCODE, "rint", "UNORM: fl(d M) in binary32, ties to even",
     {NOWHERE, FULL(0.5 + 0x1p-9), FULL(0.75)}, ANY, 0.4, "1", 0, "", .run = rint_run, .bound = &rint_steps},
    {METHOD_ENCODE, "floor-double", "UNORM: floor(d M + 0.5) in double: d M is exact, ties go up",
     {NOWHERE, FULL(0.5), FULL(0.5)}, ANY, 0.6, "1", 0, clause, .run = double_run, .bound = &double_steps},
    {METHOD_ENCODE, "bits", "fp16 by integer arithmetic on the bits, ties to even",
     {FULL(0.5)}, ANY, 0.7, "1", 0, "", .run = bits_run},
    {METHOD_ENCODE, "table", "fp16 by a table of bases and shifts, truncated",
     {FULL(1.0)}, ANY, 0.9, "1", 0,
     "van der Zijp 2008, Fast half float conversions", .run = half_run, .open = half_open, .close = free,
     .behind = true},
    {METHOD_ENCODE, "same", "fp32: the bits of d, which is one",
     {NOWHERE, NOWHERE, NOWHERE, FULL(EXACT)}, ANY, 0.1, "1", 0,
     "IEEE 754-2019", .run = same_run},
    {METHOD_ENCODE, "engine", "the engine, for each format and rounding",
     {FULL(0.5), FULL(0.5), FULL(0.5), FULL(EXACT)}, ANY, 8, "1", 16384, "depthprec(3)", .run = engine_run},
};
/* clang-format on */
static const size_t method_count = sizeof methods / sizeof methods[0];

/* Exact: |d - value of the code| in steps of the format around d. d has 24 bits and M at most 24, so d M is a double.
 */
static bool encode_error_at(const method_call *c, size_t i, method_error *error) {
    const dp_format *f = &c->setup->spec.format;
    const double d = (double)c->in->d[i];
    const uint32_t code = c->out->code[i];
    if (code > f->code_max) {
        *error = (method_error){(double)INFINITY, (double)INFINITY, (double)INFINITY};
        return true;
    }
    double count;
    if (f->kind == DP_FORMAT_UNORM) {
        count = fabs(d * f->code_max - code);
    } else {
        uint32_t below = dp_format_encode(f, DP_ROUND_ZERO, d);
        below -= below == f->code_max;
        double base = dp_format_value(f, below);
        count = fabs(d - dp_format_value(f, code)) / (dp_format_value(f, below + 1) - base);
    }
    double off = fabs(dp_format_value(f, code) - d);
    *error = (method_error){off, d > 0 ? off / d : off > 0 ? (double)INFINITY : 0, count};
    return true;
}

const method_family_row encode_family = {
    .name = "encode",
    .summary = "code of a binary32 window depth",
    .measure = "steps of the format",
    .steps = true,
    .cases = {{"fp16", "fp16", DP_MAPPING_D3D, false},
              {"unorm16", "unorm16", DP_MAPPING_D3D, false},
              {"unorm24", "unorm24", DP_MAPPING_D3D, false},
              {"fp32", "fp32", DP_MAPPING_D3D, false}},
    .case_count = 4,
    .inputs = 65536,
    .walked = 1024,
    .per_decade = 2,
    .windows = true,
    .magnitudes = true,
    .methods = methods,
    .method_count = &method_count,
    .fill = method_windows,
    .judge = encode_error_at,
    .limit = limit_codes,
};
