/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The census against a plain scalar one, as a ratio within one run: they take turns, and the least is shown with the
 * spread (largest over smallest). The plain one keeps all codes in one array and the least code from each depth on in
 * another, and is compiled at -O2 without vectors, as a first attempt would be. Each of the two answers with and
 * without the guarantee: what zfight prints is how much of it the intervals use.
 */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include "aims.h"
#include "depthprec/depth.h"
#include "timing.h"
#include "zfight/census.h"

enum { RUNS = 5, PLAIN_BLOCK = 1024 };

#if defined(__GNUC__) && !defined(__clang__)
#define PLAIN __attribute__((optimize("O2", "no-tree-vectorize"), noinline))
#else
#define PLAIN __attribute__((noinline))
#endif

typedef struct plain_result {
    uint64_t ties, swaps;
    double longest, used;
} plain_result;

static double plain_step(uint32_t bits) {
    return (double)dp_float32(bits + 1) - (double)dp_float32(bits);
}

/* d3d into fp32, one operation after the other. guaranteed: null where the guarantee is not asked for */
PLAIN static plain_result plain_census(float a, float b, uint32_t first, size_t count, uint32_t *code, uint32_t *least,
                                       const dp_setup *guaranteed) {
    plain_result r = {0, 0, 0.0, 0.0};
    double bound = HUGE_VAL, ahead = guaranteed != NULL ? dp_separation(guaranteed, (double)dp_float32(first)) : bound;
    for (size_t i = 0; i < count; i++) {
        const float z = dp_float32(first + (uint32_t)i);
        const float product = a * z;
        const float clip = product + b;
        const float window = clip / z;
        code[i] = dp_bits32(window > 0.0f ? window < 1.0f ? window : 1.0f : 0.0f);
        if (i > 0) {
            r.ties += code[i] == code[i - 1];
            r.swaps += code[i] < code[i - 1];
        }
    }
    for (size_t i = count; i-- > 0;)
        least[i] = i + 1 < count && least[i + 1] < code[i] ? least[i + 1] : code[i];
    size_t end = 0;
    for (size_t i = 0; i < count; i++) {
        if (end < i)
            end = i;
        while (end + 1 < count && least[end + 1] <= code[i])
            end++;
        if (guaranteed != NULL && i % PLAIN_BLOCK == 0) { /* the lesser one at both ends of a block */
            const double here = ahead;
            ahead = dp_separation(guaranteed, (double)dp_float32(first + (uint32_t)i + PLAIN_BLOCK));
            bound = fmin(here, ahead);
        }
        const double length = (double)dp_float32(first + (uint32_t)end) - (double)dp_float32(first + (uint32_t)i);
        if (least[end] > code[i] || code[end] > code[i] || end == i)
            continue;
        if (length > r.longest)
            r.longest = length;
        if (guaranteed != NULL) {
            const double halves = 0.5 * (plain_step(first + (uint32_t)i) + plain_step(first + (uint32_t)end));
            const double used = (length + halves) / bound;
            r.used = used > r.used ? used : r.used;
        }
    }
    return r;
}

static dp_setup make(const char *format, dp_mapping mapping, double zfar) {
    dp_format formats[2];
    dp_spec spec = dp_spec_default();
    dp_setup setup;
    spec.mapping = mapping;
    spec.model = DP_MODEL_FLOAT;
    spec.zfar = zfar;
    if (dp_format_parse(format, formats) > 0)
        spec.format = formats[0];
    if (dp_setup_init(&setup, &spec) != DP_OK)
        exit(2);
    return setup;
}

static double timed(const census_request *q, census_result *result) {
    const double start = timing_now();
    if (census_run(q, result) != CENSUS_DONE)
        exit(2);
    return timing_now() - start;
}

/* @param aim  AIM_COUNT: none */
static void line(const char *what, double value, const char *unit, const timing *of, aim_id aim) {
    printf("%-44s %11.4g %-8s %6.2f", what, value, unit, timing_spread(of));
    if (aim != AIM_COUNT)
        aim_judge(aim, aim == AIM_CAMERA ? what : "", value);
    printf("\n");
}

/* Both over the farthest binade of the camera, one thread each. */
static void against_plain(void) {
    const dp_setup setup = make("fp32", DP_MAPPING_D3D, 1000.0);
    const uint32_t first = dp_bits32(256.0f);
    const size_t count = (1U << 23) + 1;
    uint32_t *code = malloc(count * sizeof *code);
    uint32_t *least = malloc(count * sizeof *least);
    static census_result result;
    char text[64];
    dp_pipeline p;
    timing plain[2] = {{.count = 0}}, fast[2] = {{.count = 0}}; /* without the guarantee, and with it */
    census_request q[2] = {{.setup = &setup, .lo = 256.0, .hi = 512.0}, census_of_guarantee(&setup, 256.0, 512.0)};
    q[0].threads = q[1].threads = 1;
    if (code == NULL || least == NULL || dp_pipeline_init(&p, &setup) != DP_OK)
        exit(2);
    for (int run = -1; run < RUNS; run++) /* the first one brings the pages in */
        for (int with = 0; with < 2; with++) {
            const double start = timing_thread();
            const plain_result r = plain_census(p.a, p.b, first, count, code, least, with ? &setup : NULL);
            const double middle = timing_thread();
            timed(&q[with], &result);
            const double end = timing_thread();
            if (run >= 0) {
                timing_add(&plain[with], middle - start);
                timing_add(&fast[with], end - middle);
            }
            if (r.ties != result.all.ties || r.swaps != result.all.swaps || r.longest > result.all.longest ||
                fabs(r.used - result.all.slack) > 1e-3) {
                fprintf(stderr, "bench_census: the two do not agree\n");
                exit(2);
            }
        }
    static const char *const names[] = {"census", "zfight"};
    for (int with = 0; with < 2; with++) {
        const double slow = timing_least(&plain[with]), quick = timing_least(&fast[with]);
        snprintf(text, sizeof text, "%s, plain scalar two arrays, -O2", names[with]);
        line(text, 1e9 * slow / (double)count, "ns/depth", &plain[with], AIM_COUNT);
        snprintf(text, sizeof text, "%s, one thread", names[with]);
        line(text, 1e9 * quick / (double)count, "ns/depth", &fast[with], AIM_COUNT);
        snprintf(text, sizeof text, "plain / %s", names[with]);
        line(text, slow / quick, "x", &fast[with], with ? AIM_ZFIGHT : AIM_CENSUS);
    }
    free(code);
    free(least);
}

/* The whole camera 0.1..1000, 112 million depths, on all cores and by each level on one. */
static void whole_camera(void) {
    static const struct {
        const char *format;
        dp_mapping mapping;
    } rows[] = {{"fp32", DP_MAPPING_D3D},
                {"fp32", DP_MAPPING_REVERSED},
                {"unorm24", DP_MAPPING_GL},
                {"unorm16", DP_MAPPING_D3D},
                {"fp16", DP_MAPPING_REVERSED}};
    static census_result result;
    char text[64];
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const dp_setup setup = make(rows[i].format, rows[i].mapping, 1000.0);
        const census_request q = census_of_guarantee(&setup, 0.1, 1000.0);
        timing t = {0};
        for (int k = 0; k < RUNS; k++)
            timing_add(&t, timed(&q, &result));
        snprintf(text, sizeof text, "zfight 0.1..1000, %s %s", rows[i].format, dp_mapping_get(rows[i].mapping)->name);
        const double seconds = timing_least(&t);
        line(text, seconds, "s", &t, AIM_CAMERA);
    }
}

static void each_level(void) {
    const dp_setup setup = make("unorm24", DP_MAPPING_D3D, 1000.0);
    static census_result result;
    char text[64];
    for (size_t i = 0; i < census_level_count; i++) {
        if (!dp_path_available(census_levels[i].path))
            continue;
        const census_request q = {.setup = &setup, .lo = 64.0, .hi = 128.0, .threads = 1, .level = &census_levels[i]};
        timing t = {0};
        for (int k = 0; k < RUNS; k++)
            timing_add(&t, timed(&q, &result));
        snprintf(text, sizeof text, "census unorm24 d3d, one thread, %s", census_levels[i].name);
        const double seconds = timing_least(&t);
        line(text, 1e9 * seconds / (double)result.all.pairs, "ns/depth", &t, AIM_COUNT);
    }
}

int main(void) {
    printf("%-44s %11s %-8s %6s   %-12s\n", "census", "least", "", "spread", "aim");
    against_plain();
    each_level();
    whole_camera();
    return 0;
}
