/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "zfight/kernel.h"

#include <math.h>

/* Inlined into one function per instruction set, which the vectorizer then sees with constant bounds. */
#define KERNEL static inline __attribute__((always_inline))

/* ---- Conversions: window depth in [0, 1] to code ----------------------------------------------------------------- */

/* Adding 1.5 2^52 rounds a double to a whole number, to nearest even, and leaves it in the low bits. */
KERNEL uint32_t whole_even(double x) {
    return (uint32_t)dp_bits64(x + 0x1.8p52);
}

KERNEL uint32_t whole_zero(double x) {
    return (uint32_t)(int32_t)x;
}

typedef struct float_rule {
    int shift;            /* bits that the mantissa loses */
    uint32_t rebias;      /* difference of the biases, in place */
    int32_t normal;       /* bits of the least normal value */
    float up[2];          /* the product of both turns the lowest binade's step into 1 */
    uint32_t round, even; /* half a step less one, and whether ties look at the bit above */
} float_rule;

static float_rule float_rule_of(const dp_format *f, int nearest) {
    const int shift = 23 - f->mantissa_bits;
    const int rounds = nearest && shift > 0;
    return (float_rule){.shift = shift,
                        .rebias = (uint32_t)(127 - f->bias) << f->mantissa_bits,
                        .normal = (int32_t)dp_bits32((float)ldexp(1.0, 1 - f->bias)),
                        .up = {(float)ldexp(1.0, f->bias - 1), (float)ldexp(1.0, f->mantissa_bits)},
                        .round = rounds ? (1U << (shift - 1)) - 1U : 0U,
                        .even = rounds ? 1U : 0U};
}

KERNEL uint32_t float_code(float_rule r, int32_t d, int nearest) {
    const uint32_t bits = (uint32_t)d;
    const uint32_t normal = ((bits + r.round + (bits >> r.shift & r.even)) >> r.shift) - r.rebias;
    const int32_t small = d < r.normal ? d : r.normal;                   /* so that the side not taken converts too */
    const float steps = dp_float32((uint32_t)small) * r.up[0] * r.up[1]; /* exact; at most 2^23 */
    const uint32_t subnormal = nearest ? dp_bits32(steps + 0x1p23f) - dp_bits32(0x1p23f) : (uint32_t)(int32_t)steps;
    return d < r.normal ? subnormal : normal;
}

/*
 * Window depths are clamped as integers, which order them alike and cost no branch. An UNORM product of 24 + N bits is
 * exact in double, and so is its sum with 0.5 wherever that decides (N <= 24).
 */
#define CONVERT(CODE)                                                                                                  \
    for (size_t i = 0; i < count; i++) {                                                                               \
        int32_t bits;                                                                                                  \
        memcpy(&bits, &window[i], sizeof bits);                                                                        \
        bits = bits > 0 ? bits : 0;                                                                                    \
        bits = bits < one ? bits : one;                                                                                \
        const float d = dp_float32((uint32_t)bits);                                                                    \
        (void)d;                                                                                                       \
        key[i] = (int32_t)((CODE) ^ flip);                                                                             \
    }                                                                                                                  \
    break

KERNEL void convert(const census_plan *plan, const float *restrict window, size_t count, int32_t *restrict key) {
    const dp_format *format = &plan->pipeline.format;
    const uint32_t flip = plan->flip;
    const double top = (double)format->code_max;
    const float factor = (float)format->code_max;
    const int32_t one = 127 << 23;
    switch (plan->conversion) {
    case CENSUS_BITS:
        CONVERT((uint32_t)bits);
    case CENSUS_UP:
        CONVERT(whole_zero((double)d * top + 0.5));
    case CENSUS_EVEN:
        CONVERT(whole_even((double)d * top));
    case CENSUS_ZERO:
        CONVERT(whole_zero((double)d * top));
    case CENSUS_PRODUCT_EVEN:
        CONVERT(whole_even((double)(d * factor)));
    case CENSUS_PRODUCT_ZERO:
        CONVERT((uint32_t)(int32_t)(d * factor));
    case CENSUS_FLOAT_EVEN: {
        const float_rule rule = float_rule_of(format, 1);
        CONVERT(float_code(rule, bits, 1));
    }
    case CENSUS_FLOAT_ZERO: {
        const float_rule rule = float_rule_of(format, 0);
        CONVERT(float_code(rule, bits, 0));
    }
    case CENSUS_PLAIN:
        CONVERT(dp_pipeline_convert(&plan->pipeline, d));
    }
}

static census_conversion conversion_of(const dp_pipeline *p) {
    const dp_format *f = &p->format;
    if (f->kind == DP_FORMAT_FLOAT) {
        if (f->mantissa_bits == 23 && f->bias == 127)
            return CENSUS_BITS;
        return f->bias > 127 ? CENSUS_PLAIN : p->rounding == DP_ROUND_ZERO ? CENSUS_FLOAT_ZERO : CENSUS_FLOAT_EVEN;
    }
    if (f->bits > 24 || p->arith->conversion == DP_CONVERT_SIXTEENTHS)
        return CENSUS_PLAIN;
    static const census_conversion exact[DP_ROUNDING_COUNT] = {
        [DP_ROUND_NEAREST] = CENSUS_UP, [DP_ROUND_EVEN] = CENSUS_EVEN, [DP_ROUND_ZERO] = CENSUS_ZERO};
    static const census_conversion rows[] = {
        [DP_CONVERT_PRODUCT_EVEN] = CENSUS_PRODUCT_EVEN, [DP_CONVERT_PRODUCT_ZERO] = CENSUS_PRODUCT_ZERO};
    return p->arith->conversion == DP_CONVERT_EXACT ? exact[p->rounding] : rows[p->arith->conversion];
}

census_plan census_plan_make(const dp_pipeline *pipeline) {
    return (census_plan){.pipeline = *pipeline,
                         .conversion = conversion_of(pipeline),
                         .flip = pipeline->reversed ? 0x7FFFFFFFU : 0x80000000U};
}

/* ---- The pipeline, an array pass per operation ------------------------------------------------------------------- */

#define EACH for (size_t i = 0; i < count; i++)

/* z_clip into `value`; @return how many of the depths clipping loses */
KERNEL uint32_t clip(const dp_pipeline *p, const float *restrict z, size_t count, float *restrict value) {
    const float a = p->a;
    const float b = p->b;
    const int remap = p->ndc_signed && p->arith->remap;
    if (p->arith->fused)
        EACH value[i] = fmaf(a, z[i], b);
    else
        EACH value[i] = a * z[i] + b;
    if (remap && p->ortho)
        EACH value[i] = (value[i] + 1.0f) * 0.5f;
    else if (remap)
        EACH value[i] = (value[i] + z[i]) * 0.5f;

    uint32_t lost = 0;
    const float lower = p->ndc_signed && !remap ? -1.0f : 0.0f; /* times w, which is exact */
    if (p->ortho)
        EACH lost += !((value[i] >= lower) & (value[i] <= 1.0f));
    else
        EACH lost += !((value[i] >= lower * z[i]) & (value[i] <= z[i]));
    return lost;
}

KERNEL uint32_t codes(const census_plan *plan, const float *restrict z, size_t count, int32_t *restrict key) {
    const dp_pipeline *p = &plan->pipeline;
    float value[CENSUS_BLOCK] __attribute__((aligned(64)));
    const uint32_t lost = clip(p, z, count, value);
    const dp_arith_row unit = {.reciprocal = DP_RECIPROCAL_UNIT};
    const dp_pipeline by_unit = {.arith = &unit};
    /* An orthographic w is 1, whose reciprocal is 1: neither kind of division changes anything. */
    if (!p->ortho && p->arith->reciprocal == DP_RECIPROCAL_ROUNDED)
        EACH value[i] = value[i] * (1.0f / z[i]);
    else if (!p->ortho && p->arith->reciprocal == DP_RECIPROCAL_UNIT)
        EACH value[i] = dp_pipeline_divide(&by_unit, value[i], z[i]);
    else if (!p->ortho)
        EACH value[i] = value[i] / z[i];
    const float scale = p->scale, offset = p->offset;
    if (p->moved && p->arith->fused)
        EACH value[i] = fmaf(scale, value[i], offset);
    else if (p->moved)
        EACH value[i] = scale * value[i] + offset;
    convert(plan, value, count, key);
    return lost;
}

/* ---- A block ----------------------------------------------------------------------------------------------------- */

KERNEL void look(const int32_t *restrict key, census_sight *restrict sight) {
    int32_t least[CENSUS_RUNS], greatest[CENSUS_RUNS];
    uint32_t tied[CENSUS_RUNS] = {0}, swapped[CENSUS_RUNS] = {0};
    memcpy(least, key, sizeof least);
    memcpy(greatest, key, sizeof greatest);
    for (size_t row = 1; row < CENSUS_RUN; row++)
        for (size_t run = 0; run < CENSUS_RUNS; run++) {
            const int32_t farther = key[(row - 1) * CENSUS_RUNS + run], k = key[row * CENSUS_RUNS + run];
            tied[run] += farther == k;
            swapped[run] += farther < k;
            least[run] = k < least[run] ? k : least[run];
            greatest[run] = k > greatest[run] ? k : greatest[run];
        }
    uint32_t ties = 0, swaps = 0;
    for (size_t run = 0; run < CENSUS_RUNS; run++) {
        ties += tied[run];
        swaps += swapped[run];
    }
    const int32_t *nearest = key + CENSUS_BLOCK - CENSUS_RUNS; /* of each run; its neighbour heads the next run */
    for (size_t run = 1; run < CENSUS_RUNS; run++) {
        ties += nearest[run - 1] == key[run];
        swaps += nearest[run - 1] < key[run];
    }
    sight->ties = ties;
    sight->swaps = swaps;
    memcpy(sight->least, least, sizeof sight->least);
    memcpy(sight->greatest, greatest, sizeof sight->greatest);
}

/* A few rows at a time: while one waits for its divisions, a processor is busy with the passes of the next. */
KERNEL void block_keys(const census_plan *plan, uint32_t first, uint32_t last, int32_t *key, census_sight *sight) {
    enum { ROWS = 8 };
    float z[ROWS * CENSUS_RUNS] __attribute__((aligned(64)));
    sight->clipped = 0;
    for (uint32_t from = 0; from < CENSUS_RUN; from += ROWS) {
        const uint32_t top = first + CENSUS_BLOCK - 1 - from;
        for (uint32_t row = 0; row < ROWS; row++)
            for (uint32_t run = 0; run < CENSUS_RUNS; run++) {
                const uint32_t rank = top - run * CENSUS_RUN - row;
                z[row * CENSUS_RUNS + run] = dp_ranked32(rank < last ? rank : last);
            }
        sight->clipped += codes(plan, z, ROWS * CENSUS_RUNS, key + from * CENSUS_RUNS);
    }
    look(key, sight);
}

KERNEL void resolved_up_to(const int32_t *restrict key, const int32_t *restrict beyond, int32_t *restrict reach) {
    int32_t least[CENSUS_RUNS];
    memcpy(least, beyond, sizeof least);
    for (size_t row = 0; row < CENSUS_RUN; row++)
        for (size_t run = 0; run < CENSUS_RUNS; run++) {
            const int32_t k = key[row * CENSUS_RUNS + run];
            least[run] = k < least[run] ? k : least[run];
            reach[row * CENSUS_RUNS + run] = least[run];
        }
}

/* The depth `delay` steps farther stands `delay` rows up, or, for the first rows, in the run before. */
KERNEL uint32_t disorder(const int32_t *restrict key, const int32_t *restrict reach, const int32_t *restrict before,
                         unsigned delay) {
    uint32_t seen[CENSUS_RUNS] = {0};
    uint32_t head[CENSUS_RUNS] = {0}; /* of the first rows; seat 0 is judged by `before` */
    const size_t offset = (size_t)delay * CENSUS_RUNS;
    for (size_t row = delay; row < CENSUS_RUN; row++)
        for (size_t run = 0; run < CENSUS_RUNS; run++) {
            const size_t i = row * CENSUS_RUNS + run;
            seen[run] |= key[i] >= reach[i - offset];
        }
    for (size_t row = 0; row < delay; row++) {
        const int32_t *other = reach + CENSUS_BLOCK - offset + row * CENSUS_RUNS - 1;
        for (size_t run = 0; run < CENSUS_RUNS; run++)
            head[run] |= key[row * CENSUS_RUNS + run] >= other[run];
    }
    head[0] = 0;
    for (size_t row = 0; row < delay; row++)
        head[0] |= key[row * CENSUS_RUNS] >= before[CENSUS_RUN - delay + row];
    uint32_t mask = 0;
    for (unsigned run = 0; run < CENSUS_RUNS; run++)
        mask |= (seen[run] | head[run]) << run;
    return mask;
}

/* ---- Levels ------------------------------------------------------------------------------------------------------ */

#define KEYS(NAME, TARGET)                                                                                             \
    TARGET static void keys_##NAME(const census_plan *plan, const float *z, size_t count, int32_t *key) {              \
        codes(plan, z, count, key);                                                                                    \
    }                                                                                                                  \
    TARGET static void block_##NAME(const census_plan *plan, uint32_t first, uint32_t last, int32_t *key,              \
                                    census_sight *sight) {                                                             \
        block_keys(plan, first, last, key, sight);                                                                     \
    }

#define SCANS(NAME, TARGET)                                                                                            \
    TARGET static void reach_##NAME(const int32_t *key, const int32_t *beyond, int32_t *reach) {                       \
        resolved_up_to(key, beyond, reach);                                                                            \
    }                                                                                                                  \
    TARGET static uint32_t disorder_##NAME(const int32_t *key, const int32_t *reach, const int32_t *before,            \
                                           unsigned delay) {                                                           \
        return disorder(key, reach, before, delay);                                                                    \
    }

KEYS(baseline, )
SCANS(baseline, )

#if defined(__x86_64__)
#define AVX2   __attribute__((target("avx2,fma")))
#define AVX512 __attribute__((target("avx512f,avx512bw,avx512dq,avx512vl,fma")))
KEYS(avx2, AVX2)
SCANS(avx2, AVX2) /* slower in AVX-512, whose comparisons end in registers of their own */
KEYS(avx512, AVX512)
#endif

const census_level census_levels[] = {
    {"baseline", DP_PATH_BASELINE, keys_baseline, block_baseline, reach_baseline, disorder_baseline},
#if defined(__x86_64__)
    {"avx2", DP_PATH_AVX2, keys_avx2, block_avx2, reach_avx2, disorder_avx2},
    {"avx512", DP_PATH_AVX512, keys_avx512, block_avx512, reach_avx2, disorder_avx2},
#endif
};
const size_t census_level_count = sizeof census_levels / sizeof census_levels[0];

const census_level *census_level_best(void) {
    const census_level *best = &census_levels[0];
    for (size_t i = 1; i < census_level_count; i++)
        if (dp_path_available(census_levels[i].path))
            best = &census_levels[i];
    return best;
}
