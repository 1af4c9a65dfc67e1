/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The array kernels where memory is the limit: 64 million elements, or as many as a quarter of the free memory holds;
 * on one thread and on all, beside a loop that moves the same bytes on as many. All take turns; the least counts.
 */
#include <math.h>
#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "core/clones.h"
#include "depthprec/depthprec.h"
#include "parallel.h"
#include "timing.h"

enum { RUNS = 7, WAYS = 4 };

typedef struct row {
    const char *what, *format;
    dp_task task;
    dp_real real;
    dp_word word;
} row;

static const row rows[] = {
    {"f32 -> fp16", "fp16", DP_TASK_ENCODE, DP_REAL_FLOAT, DP_WORD_16},
    {"fp16 -> f32", "fp16", DP_TASK_DECODE, DP_REAL_FLOAT, DP_WORD_16},
    {"d -> unorm24", "unorm24", DP_TASK_ENCODE, DP_REAL_FLOAT, DP_WORD_32},
    {"unorm24 -> d", "unorm24", DP_TASK_DECODE, DP_REAL_FLOAT, DP_WORD_32},
    {"eye depth -> unorm24", "unorm24", DP_TASK_CODE, DP_REAL_FLOAT, DP_WORD_32},
    {"unorm24 -> eye depth", "unorm24", DP_TASK_EYE, DP_REAL_FLOAT, DP_WORD_32},
    {"unorm24 -> width, double", "unorm24", DP_TASK_WIDTH, DP_REAL_DOUBLE, DP_WORD_32},
};

#define MOVE(NAME, IN, OUT)                                                                                            \
    CLONES static void NAME(const void *in, void *out, size_t first, size_t last) {                                    \
        const IN *from = in;                                                                                           \
        OUT *to = out;                                                                                                 \
        for (size_t i = first; i < last; i++)                                                                          \
            to[i] = (OUT)(from[i] ^ 1U);                                                                               \
    }
MOVE(move_4_4, uint32_t, uint32_t)
MOVE(move_4_2, uint32_t, uint16_t)
MOVE(move_2_4, uint16_t, uint32_t)
MOVE(move_4_8, uint32_t, uint64_t)

static void move(const dp_batch *b, const void *in, void *out, size_t count, int threads) {
    void (*const mover)(const void *, void *, size_t, size_t) = b->in_size == 2    ? move_2_4
                                                                : b->out_size == 2 ? move_4_2
                                                                : b->out_size == 8 ? move_4_8
                                                                                   : move_4_4;
#pragma omp parallel for num_threads(threads) schedule(static)
    for (int t = 0; t < threads; t++)
        mover(in, out, count * (size_t)t / (size_t)threads, count * ((size_t)t + 1) / (size_t)threads);
}

/* A number per element is drawn for the first million; the others repeat them. */
static void fill(const dp_batch *b, unsigned char *in, size_t count) {
    enum { FRESH = 1 << 20 };
    uint64_t state = 1;
    for (size_t i = 0; i < FRESH && i < count; i++) {
        state = state * 6364136223846793005U + 1442695040888963407U;
        const double unit = (double)(state >> 11) * 0x1p-53;
        const float real = (float)(b->task == DP_TASK_ENCODE ? unit : 0.1 * pow(10000.0, unit));
        const uint32_t code = (uint32_t)(unit * (double)b->setup.spec.format.code_max);
        const uint16_t word = (uint16_t)code;
        const void *const from = b->task == DP_TASK_CODE || b->task == DP_TASK_ENCODE ? (const void *)&real
                                 : b->word == DP_WORD_16                              ? (const void *)&word
                                                                                      : (const void *)&code;
        memcpy(in + i * b->in_size, from, b->in_size);
    }
    for (size_t i = FRESH; i < count; i += FRESH)
        memcpy(in + i * b->in_size, in, (count - i < FRESH ? count - i : FRESH) * b->in_size);
}

static void measure(const row *r, unsigned char *in, unsigned char *out, size_t count, int threads) {
    timing taken[WAYS] = {{.count = 0}};
    double ns[WAYS];
    dp_format format[2];
    dp_spec spec = dp_spec_default();
    dp_setup setup;
    dp_batch b;
    if (dp_format_parse(r->format, format) == 0)
        exit(2);
    spec.format = format[0];
    spec.mapping = DP_MAPPING_D3D;
    if (dp_setup_init(&setup, &spec) != DP_OK ||
        dp_batch_init(&b, &setup, r->task, r->real, r->word, dp_path_best()) != DP_OK)
        exit(2);
    fill(&b, in, count);
    for (int run = -1; run < RUNS; run++)
        for (int w = 0; w < WAYS; w++) {
            const int on = w % 2 == 0 ? 1 : threads;
            const double start = timing_now();
            if (w < 2)
                move(&b, in, out, count, on);
            else
                parallel_batch(&b, in, out, count, on);
            if (run >= 0)
                timing_add(&taken[w], (timing_now() - start) * 1e9 / (double)count);
        }
    for (int w = 0; w < WAYS; w++)
        ns[w] = timing_least(&taken[w]);
    printf("%-31s %8.3f %8.3f %7.2f %9.3f %8.3f %7.2f %9.2f %8.2f\n", r->what, ns[0], ns[2], ns[2] / ns[0], ns[1],
           ns[3], ns[3] / ns[1], ns[2] / ns[3], ns[0] / ns[1]);
}

int main(void) {
    const double free_bytes = (double)sysconf(_SC_AVPHYS_PAGES) * (double)sysconf(_SC_PAGESIZE);
    const size_t most = (size_t)1 << 26;
    const size_t fits = (size_t)(free_bytes / 4 / 12);
    const size_t count = fits < most ? fits : most;
    const int threads = omp_get_max_threads();
    unsigned char *in = aligned_alloc(1U << 21, (count * 4 / (1U << 21) + 1) << 21);
    unsigned char *out = aligned_alloc(1U << 21, (count * 8 / (1U << 21) + 1) << 21);
    if (in == NULL || out == NULL)
        return 2;
    madvise(in, count * 4, MADV_HUGEPAGE);
    madvise(out, count * 8, MADV_HUGEPAGE);
    printf("\n%zu million elements in memory, ns per element; L = a loop that moves the same bytes\n", count / 1000000);
    printf("%-31s %8s %8s %7s %9s %8s %7s %9s %8s\n", "", "L", "ours", "ours/L", "L,", "ours,", "ours/L", "1 thread/",
           "same");
    printf("%-31s %8s %8s %7s %6d thr %4d thr %7s %5d thr %8s\n", "", "1 thr", "1 thr", "", threads, threads, "",
           threads, "of L");
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        measure(&rows[i], in, out, count, threads);
    free(in);
    free(out);
    return 0;
}
