/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The array kernels, as ratios within one run: a loop that moves the same bytes, the task in plain C at -O2, and each
 * path take turns on the same arrays in the second cache; the least counts. Separations are measured together and one
 * by one.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "aims.h"
#include "core/guarantee.h"
#include "depthprec/depthprec.h"
#include "timing.h"

enum { COUNT = 131072, RUNS = 61, REPEAT = 4 };

#if defined(__GNUC__) && !defined(__clang__)
#define PLAIN __attribute__((optimize("O2", "no-tree-vectorize"), noinline))
#else
#define PLAIN __attribute__((noinline))
#endif
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define CLONES __attribute__((noinline, target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define CLONES __attribute__((noinline))
#endif

static uint64_t in[COUNT] __attribute__((aligned(4096)));
static uint64_t out[COUNT] __attribute__((aligned(4096)));
static dp_setup setup;

/* ---- The floor: 4 to 4, 4 to 2, 2 to 4, 8 to 4 and 4 to 8 bytes, each value hardly changed ------------------------
 */

#define MOVE(NAME, IN, OUT)                                                                                            \
    CLONES static void NAME(void) {                                                                                    \
        const IN *from = (const IN *)(const void *)in;                                                                 \
        OUT *to = (OUT *)(void *)out;                                                                                  \
        for (size_t i = 0; i < COUNT; i++)                                                                             \
            to[i] = (OUT)(from[i] ^ 1U);                                                                               \
    }
MOVE(move_4_4, uint32_t, uint32_t)
MOVE(move_4_2, uint32_t, uint16_t)
MOVE(move_2_4, uint16_t, uint32_t)
MOVE(move_8_4, uint64_t, uint32_t)
MOVE(move_4_8, uint32_t, uint64_t)

/* ---- Plain C: what one would write first --------------------------------------------------------------------------
 */

PLAIN static void plain_code(void) {
    const float *z = (const float *)(const void *)in;
    uint32_t *code = (uint32_t *)(void *)out;
    const double n = setup.spec.znear;
    const double f = setup.spec.zfar;
    for (size_t i = 0; i < COUNT; i++)
        code[i] = (uint32_t)floor(((double)z[i] - n) / (double)z[i] * (f / (f - n)) * 16777215.0 + 0.5);
}

PLAIN static void plain_eye(void) {
    const uint32_t *code = (const uint32_t *)(const void *)in;
    float *z = (float *)(void *)out;
    const double n = setup.spec.znear;
    const double f = setup.spec.zfar;
    for (size_t i = 0; i < COUNT; i++) {
        const double d = (double)code[i] / 16777215.0;
        z[i] = (float)(n * f / (n * d + f * (1.0 - d)));
    }
}

PLAIN static void plain_encode(void) {
    const float *d = (const float *)(const void *)in;
    uint32_t *code = (uint32_t *)(void *)out;
    for (size_t i = 0; i < COUNT; i++)
        code[i] = (uint32_t)floor((double)d[i] * 16777215.0 + 0.5);
}

PLAIN static void plain_decode(void) {
    const uint32_t *code = (const uint32_t *)(const void *)in;
    float *d = (float *)(void *)out;
    for (size_t i = 0; i < COUNT; i++)
        d[i] = (float)((double)code[i] / 16777215.0);
}

/* ---- Rows ------------------------------------------------------------------------------------------------------- */

typedef struct row {
    const char *what, *format;
    dp_mapping mapping;
    dp_task task;
    dp_real real;
    dp_word word;
    void (*floor)(void);
    void (*plain)(void);
    aim_id aim; /* AIM_COUNT: none */
} row;

static const row rows[] = {
    {"f32 -> fp16", "fp16", DP_MAPPING_D3D, DP_TASK_ENCODE, DP_REAL_FLOAT, DP_WORD_16, move_4_2, NULL, AIM_HALVES},
    {"fp16 -> f32", "fp16", DP_MAPPING_D3D, DP_TASK_DECODE, DP_REAL_FLOAT, DP_WORD_16, move_2_4, NULL, AIM_HALVES},
    {"d -> unorm24", "unorm24", DP_MAPPING_D3D, DP_TASK_ENCODE, DP_REAL_FLOAT, DP_WORD_32, move_4_4, plain_encode,
     AIM_UNORM},
    {"unorm24 -> d", "unorm24", DP_MAPPING_D3D, DP_TASK_DECODE, DP_REAL_FLOAT, DP_WORD_32, move_4_4, plain_decode,
     AIM_UNORM},
    {"eye depth -> unorm24", "unorm24", DP_MAPPING_D3D, DP_TASK_CODE, DP_REAL_FLOAT, DP_WORD_32, move_4_4, plain_code,
     AIM_CODE},
    {"eye depth -> unorm24, reversed", "unorm24", DP_MAPPING_REVERSED, DP_TASK_CODE, DP_REAL_FLOAT, DP_WORD_32,
     move_4_4, NULL, AIM_CODE},
    {"eye depth -> unorm16", "unorm16", DP_MAPPING_D3D, DP_TASK_CODE, DP_REAL_FLOAT, DP_WORD_16, move_4_2, NULL,
     AIM_COUNT},
    {"eye depth -> fp32, reversed", "fp32", DP_MAPPING_REVERSED, DP_TASK_CODE, DP_REAL_FLOAT, DP_WORD_32, move_4_4,
     NULL, AIM_COUNT},
    {"eye depth, double -> unorm24", "unorm24", DP_MAPPING_D3D, DP_TASK_CODE, DP_REAL_DOUBLE, DP_WORD_32, move_8_4,
     NULL, AIM_COUNT},
    {"unorm24 -> eye depth", "unorm24", DP_MAPPING_D3D, DP_TASK_EYE, DP_REAL_FLOAT, DP_WORD_32, move_4_4, plain_eye,
     AIM_EYE},
    {"unorm24 -> eye depth, double", "unorm24", DP_MAPPING_D3D, DP_TASK_EYE, DP_REAL_DOUBLE, DP_WORD_32, move_4_8, NULL,
     AIM_COUNT},
    {"fp32 -> eye depth, reversed", "fp32", DP_MAPPING_REVERSED, DP_TASK_EYE, DP_REAL_FLOAT, DP_WORD_32, move_4_4, NULL,
     AIM_COUNT},
    {"unorm24 -> width, double", "unorm24", DP_MAPPING_D3D, DP_TASK_WIDTH, DP_REAL_DOUBLE, DP_WORD_32, move_4_8, NULL,
     AIM_WIDTH},
};

static void fill(const row *r, const dp_batch *b) {
    uint64_t state = 1;
    for (size_t i = 0; i < COUNT; i++) {
        state = state * 6364136223846793005U + 1442695040888963407U;
        const double unit = (double)(state >> 11) * 0x1p-53;
        const double x = r->task == DP_TASK_ENCODE ? unit : 0.1 * pow(10000.0, unit);
        const uint32_t code = (uint32_t)(unit * (double)setup.spec.format.code_max);
        const float narrow = (float)x;
        const uint16_t word = (uint16_t)code;
        const void *const from = r->task == DP_TASK_CODE || r->task == DP_TASK_ENCODE
                                     ? (r->real == DP_REAL_FLOAT ? (const void *)&narrow : (const void *)&x)
                                     : (r->word == DP_WORD_16 ? (const void *)&word : (const void *)&code);
        memcpy((char *)in + i * b->in_size, from, b->in_size);
    }
}

static void once(const row *r, const dp_batch *b, int which) {
    if (which == 0)
        r->floor();
    else if (which == 1)
        r->plain();
    else
        dp_batch_run(&b[which - 2], in, out, COUNT);
}

static void measure(const row *r) {
    enum { WAYS = 2 + DP_PATH_COUNT };
    static timing taken[WAYS];
    double ns[WAYS];
    dp_batch b[DP_PATH_COUNT];
    dp_format format[2];
    dp_spec spec = dp_spec_default();
    spec.mapping = r->mapping;
    if (dp_format_parse(r->format, format) == 0)
        exit(2);
    spec.format = format[0];
    int has[WAYS] = {1, r->plain != NULL};
    if (dp_setup_init(&setup, &spec) != DP_OK)
        exit(2);
    for (int p = 0; p < DP_PATH_COUNT; p++)
        has[2 + p] = dp_batch_init(&b[p], &setup, r->task, r->real, r->word, (dp_path)p) == DP_OK;
    fill(r, &b[0]);
    memset(taken, 0, sizeof taken);
    for (int run = -2; run < RUNS; run++)
        for (int w = 0; w < WAYS; w++) {
            if (!has[w])
                continue;
            const double start = timing_now();
            for (int k = 0; k < REPEAT; k++)
                once(r, b, w);
            if (run >= 0)
                timing_add(&taken[w], (timing_now() - start) * 1e9 / REPEAT / COUNT);
        }
    printf("%-31s", r->what);
    for (int w = 0; w < WAYS; w++) {
        ns[w] = timing_least(&taken[w]);
        if (has[w])
            printf(" %8.3f", ns[w]);
        else
            printf(" %8s", "-");
    }
    const double best = ns[2 + dp_path_best()];
    printf(" %7.2f", best / ns[0]);
    if (r->aim != AIM_COUNT)
        aim_judge(r->aim, r->what, best / ns[0]);
    printf("\n");
}

/* The guarantee at many depths together, with what prepares that, and one by one; their bits are the same. */
static void measure_separations(const char *format, dp_mapping mapping) {
    enum { DEPTHS = 65536 };
    static double z[DEPTHS], alone[DEPTHS], many[DEPTHS];
    static dp_stretches stretches;
    timing taken[2] = {{.count = 0}};
    dp_format formats[2];
    dp_spec spec = dp_spec_default();
    dp_setup camera;
    char what[64];
    dp_format_parse(format, formats);
    spec.format = formats[0];
    spec.mapping = mapping;
    spec.model = DP_MODEL_FLOAT;
    if (dp_setup_init(&camera, &spec) != DP_OK)
        exit(2);
    const dp_guarantee guarantee = dp_guarantee_make(&camera);
    for (int i = 0; i < DEPTHS; i++)
        z[i] = 0.1 * pow(10000.0, (i + 0.5) / DEPTHS);
    for (int run = -1; run < RUNS; run++)
        for (int which = 0; which < 2; which++) {
            const double start = timing_now();
            for (int i = 0; i < DEPTHS && which == 0; i++)
                alone[i] = dp_guarantee_at(&guarantee, z[i]);
            if (which == 1) {
                dp_stretches_find(&stretches, &guarantee);
                dp_guarantee_many(&guarantee, &stretches, z, many, DEPTHS);
            }
            if (run >= 0)
                timing_add(&taken[which], (timing_now() - start) * 1e9 / DEPTHS);
        }
    if (memcmp(alone, many, sizeof alone) != 0)
        exit(2);
    snprintf(what, sizeof what, "%s %s", format, dp_mapping_get(mapping)->name);
    printf("%-31s %8.1f x%.2f %8.1f x%.2f", what, timing_least(&taken[0]), timing_spread(&taken[0]),
           timing_least(&taken[1]), timing_spread(&taken[1]));
    aim_judge(AIM_SEPARATIONS, what, timing_least(&taken[0]) / timing_least(&taken[1]));
    printf("\n");
}

int main(void) {
    printf("%-31s %8s %8s %8s %8s %8s %7s   %s\n", "arrays, ns per element", "L", "plain C", "baseline", "avx2",
           "avx512", "best/L", "aim");
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        measure(&rows[i]);
    printf("\n%-31s %8s %5s %8s %5s   aim\n", "separations, ns per element", "alone", "", "many", "");
    measure_separations("unorm24", DP_MAPPING_D3D);
    measure_separations("fp32", DP_MAPPING_REVERSED);
    return 0;
}
